// An entry a colour that occurs, each with how often.
#include "path_legend.hh"

namespace {

/// Entries whose texts live as long as they do.
struct entry_list {
    std::vector<pm_legend_entry> entries;
    std::vector<std::string> texts;

    void add(pm_swatch swatch, pm_colour colour, const std::string &text)
    {
        entries.push_back({swatch, colour, nullptr});
        texts.push_back(text);
    }

    pm_status show(pm_figure *figure, const char *heading)
    {
        for (size_t i = 0; i < entries.size(); i++) {
            entries[i].text = texts[i].c_str();
        }
        return pm_figure_legend(figure, heading, entries.data(),
                                static_cast<int>(entries.size()));
    }
};

std::string bounce_words(int bounces)
{
    if (bounces == 0) {
        return "from the light";
    }
    std::string number = std::to_string(bounces);
    return bounces == 1                     ? "after 1 bounce"
           : bounces + 1 == PM_PATH_BOUNCES ? "after " + number + " or more"
                                            : "after " + number + " bounces";
}

pm_status explain_lines(pm_figure *figure)
{
    entry_list lines;
    lines.add(PM_SWATCH_NONE, pm_colour_named(PM_COLOUR_WHITE), "A line has the colour of");
    lines.add(PM_SWATCH_NONE, pm_colour_named(PM_COLOUR_WHITE), "the dot that it starts from.");
    return lines.show(figure, "dots and lines");
}

} // namespace

pm_status pm_path_legend_by_event(pm_figure *figure, const pm_path_strokes &so_far,
                                  const pm_path_strokes &whole)
{
    entry_list list;
    for (int i = 0; i < PM_PATH_EVENTS; i++) {
        const pm_path_look *look = pm_path_look_at(i);
        if (whole.events[i] > 0) {
            bool line = look->event == 'L' || look->event == 'E';
            list.add(line ? PM_SWATCH_LINE : PM_SWATCH_DOT, pm_colour_named(look->colour),
                     look->text + (": " + std::to_string(so_far.events[i])));
        }
    }
    PM_TRY(list.show(figure, "what happens to them"));
    return explain_lines(figure);
}

pm_status pm_path_legend_by_bounce(pm_figure *figure, const pm_path_strokes &so_far,
                                   const pm_path_strokes &whole)
{
    entry_list list;
    for (int i = 0; i < PM_PATH_BOUNCES; i++) {
        if (whole.bounces[i] > 0) {
            list.add(PM_SWATCH_LINE, pm_path_bounce_colour(static_cast<uint64_t>(i)),
                     bounce_words(i) + ": " + std::to_string(so_far.bounces[i]));
        }
    }
    return list.show(figure, "stretches of path");
}
