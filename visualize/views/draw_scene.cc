// The scene, faintly: what is drawn on it has to stay the brightest thing in the picture.
#include "draw_scene.h"
#include "core.hh"
#include "drawing.hh"
#include "figure.hh"

#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace {

const int sides = 72; // of a circle
const double edge_opacity = 0.55;
const double face_opacity = 0.10;
const double crease_cosine = 0.87; // edges between flatter triangles are not drawn

/// What a shape is, for its colour and its word.
struct look {
    pm_colour edge, face;
    const char *word;              // NULL: none
    double opacity = face_opacity; // of its faces; 0: only edges are drawn
};

look look_of(const pm_scene *scene, const pm_shape *shape)
{
    pm_colour plain = pm_colour_named(PM_COLOUR_GREY);
    if (shape->light != PM_NONE) {
        pm_colour yellow = pm_colour_named(PM_COLOUR_YELLOW);
        return {yellow, yellow, "light"};
    }
    const int side = shape->material[0] != PM_NONE ? 0 : 1;
    if (shape->material[side] == PM_NONE) {
        return {plain, plain, nullptr};
    }
    const pm_material *material = &scene->materials[shape->material[side]];
    const double *rho = material->reflectance.c;
    switch (material->type) {
    case PM_BSDF_DIFFUSE:
    case PM_BSDF_PLASTIC:
    case PM_BSDF_ROUGH_PLASTIC:
        return {plain, pm_colour_linear(rho[0], rho[1], rho[2]), nullptr};
    case PM_BSDF_DIELECTRIC:
    case PM_BSDF_THIN_DIELECTRIC:
        return {pm_colour_named(PM_COLOUR_SKY), pm_colour_named(PM_COLOUR_SKY), "glass"};
    case PM_BSDF_CONDUCTOR:
        return {pm_colour_named(PM_COLOUR_WHITE), plain, "mirror"};
    case PM_BSDF_ROUGH_CONDUCTOR:
        return {pm_colour_named(PM_COLOUR_WHITE), plain, "metal"};
    case PM_BSDF_NULL:
        break;
    }
    // Nothing is there, or only the end of a medium: what is inside has to be seen.
    pm_colour dim = pm_colour_dim(plain, 0.6);
    return {dim, dim, shape->boundary ? "medium" : nullptr, 0.0};
}

std::vector<pm_vec3> circle(pm_vec3 center, pm_vec3 normal, double radius)
{
    pm_frame frame = pm_frame_around(normal);
    std::vector<pm_vec3> rim;
    for (int i = 0; i < sides; i++) {
        double phi = 2.0 * PM_PI * i / sides;
        pm_vec3 out = pm_vec_add(pm_vec_scale(frame.s, std::cos(phi)),
                                 pm_vec_scale(frame.t, std::sin(phi)));
        rim.push_back(pm_vec_along(center, out, radius));
    }
    return rim;
}

pm_vec3 draw_rectangle(pm_drawing *drawing, const pm_shape *s, const look &l)
{
    pm_vec3 right = pm_vec_add(s->corner, s->edge[0]);
    const std::vector<pm_vec3> rim = {s->corner, right, pm_vec_add(right, s->edge[1]),
                                      pm_vec_add(s->corner, s->edge[1])};
    drawing->polygon(rim, l.face, l.opacity);
    drawing->outline(rim, l.edge, edge_opacity);
    return pm_vec_scale(pm_vec_add(rim[0], rim[2]), 0.5);
}

pm_vec3 draw_disk(pm_drawing *drawing, const pm_shape *s, const look &l)
{
    const std::vector<pm_vec3> rim = circle(s->center, s->axis, s->radius);
    drawing->polygon(rim, l.face, l.opacity);
    drawing->outline(rim, l.edge, edge_opacity);
    return s->center;
}

pm_vec3 draw_cylinder(pm_drawing *drawing, const pm_shape *s, const look &l)
{
    const std::vector<pm_vec3> near = circle(s->center, s->axis, s->radius);
    pm_vec3 end = pm_vec_along(s->center, s->axis, s->length);
    const std::vector<pm_vec3> far = circle(end, s->axis, s->radius);
    for (size_t i = 0; i < sides; i++) {
        size_t next = (i + 1) % sides;
        const pm_vec3 side[4] = {near[i], near[next], far[next], far[i]};
        drawing->quad(side, l.face, l.opacity);
    }
    drawing->outline(near, l.edge, edge_opacity);
    drawing->outline(far, l.edge, edge_opacity);
    return pm_vec_scale(pm_vec_add(s->center, end), 0.5);
}

/// The sphere as it is seen: its outline, filled. From inside, only three great circles.
void draw_sphere(pm_drawing *drawing, const pm_shape *s, const look &l, pm_vec3 eye)
{
    pm_vec3 to = pm_vec_sub(eye, s->center);
    double distance = pm_vec_length(to);
    if (distance > s->radius) {
        pm_vec3 n = pm_vec_scale(to, 1.0 / distance);
        double ratio = s->radius / distance;
        const std::vector<pm_vec3> rim = circle(pm_vec_along(s->center, n, s->radius * ratio),
                                                n, s->radius * std::sqrt(1.0 - ratio * ratio));
        drawing->polygon(rim, l.face, l.opacity);
        drawing->outline(rim, l.edge, edge_opacity);
    }
    const pm_vec3 axes[3] = {pm_vec(1, 0, 0), pm_vec(0, 1, 0), pm_vec(0, 0, 1)};
    for (const pm_vec3 &axis : axes) {
        drawing->outline(circle(s->center, axis, s->radius), l.edge, 0.35 * edge_opacity);
    }
}

pm_vec3 triangle_normal(const pm_shape *s, uint32_t index)
{
    const uint32_t *v = s->triangles[index];
    return pm_vec_cross(pm_vec_sub(s->vertices[v[1]], s->vertices[v[0]]),
                        pm_vec_sub(s->vertices[v[2]], s->vertices[v[0]]));
}

bool is_flat(pm_vec3 a, pm_vec3 b)
{
    return pm_vec_dot(a, b) > crease_cosine * pm_vec_length(a) * pm_vec_length(b);
}

/// For each vertex the first one at its place: files may hold a vertex once a triangle.
std::vector<uint32_t> weld(const pm_shape *s)
{
    std::map<std::tuple<double, double, double>, uint32_t> first;
    std::vector<uint32_t> welded(s->vertex_count);
    for (uint32_t i = 0; i < s->vertex_count; i++) {
        const pm_vec3 &v = s->vertices[i];
        welded[i] = first.emplace(std::make_tuple(v.x, v.y, v.z), i).first->second;
    }
    return welded;
}

/// Draws the edges that have one triangle, or two that meet at an angle.
void draw_creases(pm_drawing *drawing, const pm_shape *s, pm_colour colour)
{
    const std::vector<uint32_t> welded = weld(s);
    typedef std::pair<uint32_t, uint32_t> edge;
    std::map<edge, uint32_t> open;
    std::vector<edge> creases;
    for (uint32_t i = 0; i < s->triangle_count; i++) {
        for (int k = 0; k < 3; k++) {
            uint32_t a = welded[s->triangles[i][k]];
            uint32_t b = welded[s->triangles[i][(k + 1) % 3]];
            edge e = a < b ? edge(a, b) : edge(b, a);
            auto other = open.find(e);
            if (other == open.end()) {
                open[e] = i;
                continue;
            }
            if (!is_flat(triangle_normal(s, other->second), triangle_normal(s, i))) {
                creases.push_back(e);
            }
            open.erase(other);
        }
    }
    for (const auto &left : open) {
        creases.push_back(left.first);
    }
    for (const edge &e : creases) {
        drawing->line(s->vertices[e.first], s->vertices[e.second], colour, edge_opacity);
    }
}

pm_vec3 draw_mesh(pm_drawing *drawing, const pm_shape *s, const look &l)
{
    pm_vec3 sum = pm_vec(0, 0, 0);
    vtkIdType first = 0;
    for (uint32_t i = 0; i < s->vertex_count; i++) {
        vtkIdType id = drawing->vertex(s->vertices[i], l.face, l.opacity);
        first = i == 0 ? id : first;
        sum = pm_vec_add(sum, s->vertices[i]);
    }
    for (uint32_t i = 0; i < s->triangle_count; i++) {
        const uint32_t *v = s->triangles[i];
        drawing->triangle(first + v[0], first + v[1], first + v[2]);
    }
    draw_creases(drawing, s, l.edge);
    return pm_vec_scale(sum, s->vertex_count > 0 ? 1.0 / s->vertex_count : 0.0);
}

/// Where a word about a shape goes: in its middle, but at a corner where it only bounds a
/// medium, whose middle other things fill.
pm_vec3 place_word(const pm_shape *shape, const look &l, pm_vec3 middle)
{
    bool hollow = l.opacity == 0.0 && shape->type == PM_SHAPE_MESH && shape->vertex_count > 0;
    return hollow ? shape->vertices[0] : middle;
}

/// Draws a shape, but a sphere, which looks different for every eye; returns its middle.
pm_vec3 draw_shape(pm_drawing *drawing, const pm_shape *shape, const look &l)
{
    switch (shape->type) {
    case PM_SHAPE_RECTANGLE:
        return draw_rectangle(drawing, shape, l);
    case PM_SHAPE_SPHERE:
        return shape->center;
    case PM_SHAPE_DISK:
        return draw_disk(drawing, shape, l);
    case PM_SHAPE_CYLINDER:
        return draw_cylinder(drawing, shape, l);
    case PM_SHAPE_MESH:
        break;
    }
    return draw_mesh(drawing, shape, l);
}

void draw_spheres(pm_drawing *drawing, const pm_scene *scene, pm_vec3 eye)
{
    for (int i = 0; i < scene->shape_count; i++) {
        const pm_shape *shape = &scene->shapes[i];
        if (shape->type == PM_SHAPE_SPHERE) {
            draw_sphere(drawing, shape, look_of(scene, shape), eye);
        }
    }
}

/// The scene outlives the figure, so it can be asked again.
void add_spheres(pm_figure *figure, const pm_scene *scene)
{
    pm_drawing drawing;
    draw_spheres(&drawing, scene, figure->viewpoint.position);
    pm_figure_facing(figure, drawing.actor(figure->pixels(1.2), 1.0, 4.0),
                     [scene](pm_vec3 eye) {
                         pm_drawing again;
                         draw_spheres(&again, scene, eye);
                         return again.data();
                     });
}

pm_status draw_all(pm_figure *figure, const pm_scene *scene, bool with_words)
{
    pm_drawing drawing;
    for (int i = 0; i < scene->shape_count; i++) {
        look l = look_of(scene, &scene->shapes[i]);
        pm_vec3 middle = draw_shape(&drawing, &scene->shapes[i], l);
        if (with_words && l.word != nullptr) {
            pm_vec3 place = place_word(&scene->shapes[i], l, middle);
            PM_TRY(pm_figure_mark(figure, place, l.word));
        }
    }
    for (int i = 0; i < scene->light_count; i++) {
        pm_light_type type = scene->lights[i].type;
        if (with_words && (type == PM_LIGHT_POINT || type == PM_LIGHT_SPOT)) {
            PM_TRY(pm_figure_mark(figure, scene->lights[i].position, "light"));
        }
    }
    pm_figure_scenery(figure, scene, drawing.actor(figure->pixels(1.2), 1.0, 4.0));
    add_spheres(figure, scene);
    return PM_OK;
}

} // namespace

pm_status pm_draw_scene(pm_figure *figure, const pm_scene *scene)
{
    return pm_figure_guard("the scene", [&] { return draw_all(figure, scene, true); });
}

pm_status pm_draw_scene_wordless(pm_figure *figure, const pm_scene *scene)
{
    return pm_figure_guard("the scene", [&] { return draw_all(figure, scene, false); });
}
