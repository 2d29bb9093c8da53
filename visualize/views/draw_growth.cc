// A frame takes off what the one before put on: its actors in the panel, and its words on the
// page together with the place where the right column goes on. All else stays as it is.
#include "draw_growth.h"
#include "core.hh"
#include "figure.hh"
#include "path_legend.hh"
#include "path_strokes.hh"

extern "C" {
#include "path_pick.h"
}

#include <vtkPropCollection.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

namespace {

const double light_speed = 0.299792458; // [m/ns], without glass or water on the way

/// One path of the set.
struct course {
    const pm_path_vertex *vertices;
    uint64_t count;
};

} // namespace

struct pm_growth {
    pm_figure *figure;
    std::vector<course> courses;
    bool by_bounce;
    double length;
    std::unique_ptr<pm_path_strokes> whole;
    std::vector<vtkSmartPointer<vtkActor>> actors; // of the frame
    int page_props;                                // that are no frame's
    double column_top;

    std::unique_ptr<pm_path_strokes> strokes_to(double reach) const
    {
        auto strokes = std::make_unique<pm_path_strokes>(by_bounce, courses.size());
        for (const course &c : courses) {
            strokes->add(c.vertices, c.count, reach);
        }
        return strokes;
    }

    void take_off()
    {
        for (const auto &actor : actors) {
            figure->renderer->RemoveActor(actor);
        }
        actors.clear();
        vtkPropCollection *props = figure->page->GetViewProps();
        while (props->GetNumberOfItems() > page_props) {
            figure->page->RemoveViewProp(props->GetLastProp());
        }
        figure->column_top = column_top;
    }
};

namespace {

void pick_courses(const pm_path_set *paths, uint64_t most, pm_growth *growth)
{
    uint64_t count = std::min<uint64_t>(paths->path_count, most);
    for (uint64_t i = 0; i < count; i++) {
        uint64_t p = pm_path_pick(paths->path_count, count, i);
        course c = {&paths->vertices[paths->first[p]], paths->first[p + 1] - paths->first[p]};
        growth->courses.push_back(c);
        growth->length = std::max(growth->length, pm_path_length(c.vertices, c.count));
    }
}

std::string fixed(double value, const char *unit)
{
    char text[64];
    std::snprintf(text, sizeof text, "%.2f %s", value, unit);
    return text;
}

/// How far light has come, how long that took, and how many photons still fly.
pm_status write_clock(pm_figure *figure, double metres, uint64_t moving)
{
    const std::string texts[] = {
        "flown: " + fixed(metres, "m"),
        "which takes light " + fixed(metres / light_speed, "ns"),
        "on their way: " + std::to_string(moving),
    };
    pm_colour white = pm_colour_named(PM_COLOUR_WHITE);
    const pm_legend_entry entries[] = {
        {PM_SWATCH_NONE, white, texts[0].c_str()},
        {PM_SWATCH_NONE, white, texts[1].c_str()},
        {PM_SWATCH_DOT, white, texts[2].c_str()},
    };
    return pm_figure_legend(figure, "by now", entries, 3);
}

} // namespace

pm_status pm_growth_open(pm_figure *figure, const pm_path_set *paths, uint64_t most,
                         bool by_bounce, pm_growth **growth)
{
    return pm_figure_guard("paths", [&] {
        auto begun = std::make_unique<pm_growth>();
        begun->figure = figure;
        begun->by_bounce = by_bounce;
        pick_courses(paths, most, begun.get());
        begun->whole = begun->strokes_to(HUGE_VAL);
        begun->page_props = figure->page->GetViewProps()->GetNumberOfItems();
        begun->column_top = figure->column_top;
        *growth = begun.release();
        return PM_OK;
    });
}

double pm_growth_length(const pm_growth *growth)
{
    return growth->length;
}

pm_status pm_growth_show(pm_growth *growth, double reach)
{
    return pm_figure_guard("paths", [&] {
        growth->take_off();
        auto strokes = growth->strokes_to(reach);
        growth->actors = strokes->show(growth->figure);
        PM_TRY(growth->by_bounce
                   ? pm_path_legend_by_bounce(growth->figure, *strokes, *growth->whole)
                   : pm_path_legend_by_event(growth->figure, *strokes, *growth->whole));
        return write_clock(growth->figure, reach, strokes->moving);
    });
}

void pm_growth_close(pm_growth *growth)
{
    delete growth;
}
