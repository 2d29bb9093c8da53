// Photon paths: a stretch has the colour of the event that it starts from, an event is a dot of
// its own colour. So one legend serves both, and a path can be followed from dot to dot.
#include "draw_paths.h"
#include "core.hh"
#include "drawing.hh"
#include "figure.hh"

namespace {

const double path_opacity = 0.55;

struct event_look {
    char event;
    pm_colour_name colour;
    const char *text;
};

const event_look looks[] = {
    {'L', PM_COLOUR_YELLOW, "leaves the light"},
    {'S', PM_COLOUR_SKY, "mirror or glass"},
    {'D', PM_COLOUR_ORANGE, "diffuse bounce"},
    {'V', PM_COLOUR_GREEN, "scattered in a medium"},
    {'A', PM_COLOUR_PURPLE, "absorbed"},
    {'E', PM_COLOUR_WHITE, "escaped (line fades)"},
    {'C', PM_COLOUR_VERMILLION, "cut: too many bounces"},
};

const size_t look_count = sizeof looks / sizeof looks[0];

/// How often each event occurs in what is drawn, in the order of `looks`.
typedef uint64_t event_counts[look_count];

size_t find_look(char event)
{
    size_t i = 0;
    while (i + 1 < look_count && looks[i].event != event) {
        i++;
    }
    return i;
}

pm_status add_legend(pm_figure *figure, const event_counts &counts)
{
    std::vector<std::string> texts;
    for (size_t i = 0; i < look_count; i++) {
        texts.push_back(looks[i].text + (": " + std::to_string(counts[i])));
    }
    std::vector<pm_legend_entry> entries;
    for (size_t i = 0; i < look_count; i++) {
        if (counts[i] > 0) {
            entries.push_back({looks[i].event == 'E' ? PM_SWATCH_NONE : PM_SWATCH_DOT,
                               pm_colour_named(looks[i].colour), texts[i].c_str()});
        }
    }
    PM_TRY(pm_figure_legend(figure, "dot: what happens there", entries.data(),
                            static_cast<int>(entries.size())));
    const pm_legend_entry note[] = {
        {PM_SWATCH_NONE, pm_colour_named(PM_COLOUR_WHITE), "in the colour of the event"},
        {PM_SWATCH_NONE, pm_colour_named(PM_COLOUR_WHITE), "that it starts from"},
    };
    return pm_figure_legend(figure, "line: on the way", note, 2);
}

void add_path(const pm_path_vertex *path, uint64_t count, pm_drawing *lines, pm_drawing *dots,
              event_counts *counts)
{
    for (uint64_t i = 0; i < count; i++) {
        size_t look = find_look(path[i].event);
        pm_colour colour = pm_colour_named(looks[look].colour);
        (*counts)[look]++;
        if (i + 1 < count && path[i + 1].event == 'E') {
            lines->fading_line(path[i].position, path[i + 1].position, colour, path_opacity);
        } else if (i + 1 < count) {
            lines->line(path[i].position, path[i + 1].position, colour, path_opacity);
        }
        if (path[i].event != 'E') {
            dots->dot(path[i].position, colour, 1.0);
        }
    }
}

} // namespace

pm_status pm_draw_paths(pm_figure *figure, const pm_path_set *paths, uint64_t most,
                        uint64_t *drawn)
{
    return pm_figure_guard("paths", [&] {
        pm_drawing lines;
        pm_drawing dots;
        event_counts counts = {};
        uint64_t count = paths->path_count < most ? paths->path_count : most;
        for (uint64_t i = 0; i < count; i++) {
            uint64_t p = i * paths->path_count / count;
            add_path(&paths->vertices[paths->first[p]], paths->first[p + 1] - paths->first[p],
                     &lines, &dots, &counts);
        }
        figure->renderer->AddActor(lines.actor(figure->pixels(1.7), 1.0));
        figure->renderer->AddActor(dots.actor(1.0, figure->pixels(6.0)));
        *drawn = count;
        return add_legend(figure, counts);
    });
}
