// A stretch has the colour of the event that it starts from, and so has that event's dot: one
// legend serves both, and a path can be followed from dot to dot.
//
// Every path has a first stretch and nearly every one a diffuse bounce: drawn as strongly as
// the few that meet a mirror or glass, they would bury these.
#include "path_strokes.hh"

#include <algorithm>
#include <cmath>

namespace {

const double strongest = 0.6; // opacity of a first stretch among few paths
const double few = 40.0;

double length_from(const pm_path_vertex *path, uint64_t i)
{
    return pm_vec_length(pm_vec_sub(path[i + 1].position, path[i].position));
}

} // namespace

double pm_path_length(const pm_path_vertex *path, uint64_t count)
{
    double sum = 0.0;
    for (uint64_t i = 0; i + 1 < count; i++) {
        sum += length_from(path, i);
    }
    return sum;
}

pm_path_strokes::pm_path_strokes(bool by_bounce_, uint64_t paths)
    : by_bounce(by_bounce_),
      common(strongest * std::sqrt(std::min(1.0, few / static_cast<double>(paths))))
{
}

pm_colour pm_path_strokes::colour_from(const pm_path_vertex *path, uint64_t i) const
{
    if (by_bounce) {
        return pm_path_bounce_colour(i);
    }
    return pm_colour_named(pm_path_look_at(pm_path_look_of(path[i].event))->colour);
}

double pm_path_strokes::opacity_from(const pm_path_vertex *path, uint64_t i) const
{
    if (i == 0) {
        return common;
    }
    bool plain = by_bounce ? i == 1 : path[i].event == 'D';
    return plain ? std::sqrt(common) : 1.0;
}

/// The first `part` of the way from vertex i to the next; towards nowhere it fades.
void pm_path_strokes::stretch(const pm_path_vertex *path, uint64_t i, double part)
{
    pm_colour colour = colour_from(path, i);
    double opacity = opacity_from(path, i);
    pm_vec3 way = pm_vec_sub(path[i + 1].position, path[i].position);
    pm_vec3 end = part < 1.0 ? pm_vec_along(path[i].position, way, part) : path[i + 1].position;
    double left = path[i + 1].event == 'E' ? 1.0 - part : 1.0;
    if (left < 1.0) {
        faint.fading_line(path[i].position, end, colour, opacity, opacity * left);
    } else {
        (opacity < 1.0 ? faint : bright).line(path[i].position, end, colour, opacity);
    }
    if (part < 1.0) {
        heads.dot(end, pm_colour_named(PM_COLOUR_WHITE), left);
    }
}

void pm_path_strokes::add(const pm_path_vertex *path, uint64_t count, double reach)
{
    double travelled = 0.0;
    for (uint64_t i = 0; i < count; i++) {
        bool last = i + 1 == count;
        events[pm_path_look_of(path[i].event)]++;
        if (i > 0 && path[i].event != 'E') {
            dots.dot(path[i].position, colour_from(path, by_bounce && last ? i - 1 : i), 1.0);
        }
        if (last) {
            return;
        }
        bounces[pm_path_bounce_class(i)]++;
        double length = length_from(path, i);
        if (travelled + length > reach) {
            stretch(path, i, (reach - travelled) / length);
            moving++;
            return;
        }
        stretch(path, i, 1.0);
        travelled += length;
    }
}

std::vector<vtkSmartPointer<vtkActor>> pm_path_strokes::show(pm_figure *figure) const
{
    std::vector<vtkSmartPointer<vtkActor>> actors = {
        faint.actor(figure->pixels(1.7), 1.0),
        bright.actor(figure->pixels(2.3), 1.0),
        dots.actor(1.0, figure->pixels(by_bounce ? 4.5 : 6.5)),
        heads.actor(1.0, figure->pixels(8.0)),
    };
    for (const auto &actor : actors) {
        figure->renderer->AddActor(actor);
    }
    return actors;
}
