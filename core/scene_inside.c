// Only shapes that part media decide. A straight line from a point to a point on one of them
// first meets one of them, and from the side of the medium that the first point is in; so lines
// to many of them agree, or the shapes do not close.
#include "scene_inside.h"

#include "intersect_plain.h"
#include "shape.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define LINES 16      // from each point
#define POINTS_MOST 6 // looked from, for one object

typedef struct {
    pm_scene_file *source;
    const pm_xml *object; // sensor or emitter that is looked at
    pm_scene bounds;      // the scene with nothing but the shapes that part media
    pm_intersector world; // of bounds
} finder;

/// For messages.
typedef struct {
    char text[80];
} called;

static called call(const pm_scene *scene, int medium)
{
    called name = {"no medium"};
    if (medium != PM_NONE) {
        snprintf(name.text, sizeof name.text, "medium \"%.60s\"", scene->media[medium].id);
    }
    return name;
}

static double fraction(double x)
{
    return x - floor(x);
}

/// A place on a shape, another one for each number; inside a face of a mesh.
static pm_vec3 place_on(const pm_shape *shape, int number)
{
    // Steps whose multiples fill a square evenly and never fall on edges or diagonals.
    double u = fraction(0.5 + 0.7548776662466927 * number);
    double v = fraction(0.5 + 0.5698402909980532 * number);
    if (shape->type != PM_SHAPE_MESH) {
        pm_hit hit;
        pm_shape_point(shape, u, v, &hit);
        return hit.position;
    }
    const uint32_t *corner = shape->triangles[(uint32_t)(u * shape->triangle_count)];
    const pm_vec3 *vertex = shape->vertices;
    double a = 0.2 + 0.3 * v;
    pm_vec3 place = pm_vec_scale(vertex[corner[0]], a);
    place = pm_vec_along(place, vertex[corner[1]], 0.3);
    return pm_vec_along(place, vertex[corner[2]], 0.7 - a);
}

/// The medium at `from` as one line tells it; false when the line meets nothing.
static bool ask(const finder *f, pm_vec3 from, int line, int *medium, const pm_shape **by)
{
    int shapes = f->bounds.shape_count;
    int which = shapes <= LINES ? line % shapes : (int)((int64_t)line * shapes / LINES);
    pm_vec3 way = pm_vec_sub(place_on(&f->bounds.shapes[which], line), from);
    pm_ray ray = {from, pm_vec_normalize(way), HUGE_VAL, 0.0, PM_NONE};
    pm_hit hit;
    if (!(pm_vec_length(way) > 0.0) || !pm_closest(&f->world, &ray, &hit)) {
        return false;
    }
    *by = &f->bounds.shapes[hit.shape];
    *medium = pm_vec_dot(hit.normal, ray.direction) < 0.0 ? (*by)->exterior : (*by)->interior;
    return true;
}

/// The medium at `from`; PM_NONE after a fault.
static int find_at(const finder *f, pm_vec3 from)
{
    int medium = PM_NONE;
    const pm_shape *by = NULL;
    for (int i = 0; i < LINES; i++) {
        int other;
        const pm_shape *other_by;
        if (!ask(f, from, i, &other, &other_by)) {
            continue;
        }
        if (by != NULL && other != medium) {
            PM_FAULT(f->source, f->object,
                     "the shapes that part media do not close, or it stands on one of them: "
                     "seen from this %s, \"%.60s\" tells of %s and \"%.60s\" of %s",
                     f->object->tag, by->id, call(&f->bounds, medium).text, other_by->id,
                     call(&f->bounds, other).text);
            return PM_NONE;
        }
        medium = other;
        by = other_by;
    }
    return medium;
}

/// The medium at all of the points, which must be the same.
static int find_at_all(const finder *f, const pm_vec3 *points, int count)
{
    int before = f->source->faults.count;
    int medium = find_at(f, points[0]);
    for (int i = 1; i < count && f->source->faults.count == before; i++) {
        int other = find_at(f, points[i]);
        if (other != medium && f->source->faults.count == before) {
            PM_FAULT(f->source, f->object,
                     "this %s lies in %s and in %s: move it to one side of their boundary",
                     f->object->tag, call(&f->bounds, medium).text,
                     call(&f->bounds, other).text);
        }
    }
    return medium;
}

/// Just off the surface of an area light.
static int find_off(const finder *f, const pm_shape *shape)
{
    if (shape->boundary) {
        return shape->exterior;
    }
    static const double square[4][2] = {{0.21, 0.33}, {0.72, 0.18}, {0.37, 0.81}, {0.86, 0.64}};
    pm_vec3 points[4];
    for (int i = 0; i < 4; i++) {
        pm_hit hit;
        pm_shape_point(shape, square[i][0], square[i][1], &hit);
        points[i] = pm_hit_leave(&hit, hit.normal);
    }
    return find_at_all(f, points, 4);
}

/// Where the light that shines from outside enters.
static int find_outside(const finder *f, const pm_light *light)
{
    double far = 2.0 * f->source->scene.radius;
    if (light->type == PM_LIGHT_DIRECTIONAL) {
        return find_at(f, pm_vec_scale(light->direction, -far));
    }
    pm_vec3 points[POINTS_MOST] = {{far, 0.0, 0.0},  {-far, 0.0, 0.0}, {0.0, far, 0.0},
                                   {0.0, -far, 0.0}, {0.0, 0.0, far},  {0.0, 0.0, -far}};
    return find_at_all(f, points, POINTS_MOST);
}

static bool is_outside(const pm_light *light)
{
    return light->type == PM_LIGHT_DIRECTIONAL || light->type == PM_LIGHT_CONSTANT;
}

static int find_light(const finder *f, const pm_light *light)
{
    if (is_outside(light)) {
        return find_outside(f, light);
    }
    return light->type == PM_LIGHT_AREA ? find_off(f, &f->source->scene.shapes[light->shape])
                                        : find_at(f, light->position);
}

static void check_named(const finder *f, int named, int found)
{
    if (named != PM_NONE && named != found) {
        PM_FAULT(f->source, f->object,
                 "this %s stands in %s by the shapes around it, and not in %s that it names",
                 f->object->tag, call(&f->bounds, found).text, call(&f->bounds, named).text);
    }
}

static void check_outside(const finder *f, const pm_light *light)
{
    const pm_scene *scene = &f->source->scene;
    if (is_outside(light) && light->medium != PM_NONE &&
        scene->media[light->medium].sigma_t > 0.0) {
        PM_FAULT(f->source, f->object,
                 "nothing of a %s light arrives through %s, which has no end: put the medium "
                 "into a closed shape",
                 pm_xml_attribute(f->object, "type"), call(scene, light->medium).text);
    }
}

/// The one medium that sensor and emitters name where no shape parts media.
static int find_everywhere(pm_scene_file *source)
{
    const pm_scene *scene = &source->scene;
    int medium = scene->has_camera ? scene->camera.medium : PM_NONE;
    for (int i = 0; i < scene->light_count; i++) {
        int named = scene->lights[i].medium;
        medium = medium == PM_NONE ? named : medium;
    }
    return medium;
}

static void stand_light(const finder *f, pm_light *light, int everywhere)
{
    int before = f->source->faults.count;
    int named = light->medium;
    light->medium = f->bounds.shape_count == 0 ? everywhere : find_light(f, light);
    if (f->source->faults.count == before) {
        check_named(f, named, light->medium);
        check_outside(f, light);
    }
}

static void stand_camera(const finder *f, pm_camera *camera, int everywhere)
{
    int before = f->source->faults.count;
    int named = camera->medium;
    camera->medium = f->bounds.shape_count == 0 ? everywhere : find_at(f, camera->position);
    if (f->source->faults.count > before) {
        return;
    }
    check_named(f, named, camera->medium);
    if (named == PM_NONE && camera->medium != PM_NONE) {
        pm_scene_file_note(
            f->source, f->object,
            "the sensor stands in %s; Mitsuba knows only when the sensor names it",
            call(&f->bounds, camera->medium).text);
    }
}

static void stand(finder *f)
{
    pm_scene *scene = &f->source->scene;
    int everywhere = find_everywhere(f->source);
    for (pm_xml *e = f->source->root; e != NULL; e = pm_xml_following(f->source->root, e)) {
        f->object = e;
        if (strcmp(e->tag, "sensor") == 0) {
            stand_camera(f, &scene->camera, everywhere);
        } else if (strcmp(e->tag, "emitter") == 0 && e->index != PM_NONE) {
            stand_light(f, &scene->lights[e->index], everywhere);
        }
    }
}

/// False without memory.
static bool gather_bounds(finder *f)
{
    pm_scene *scene = &f->source->scene;
    f->bounds = *scene;
    f->bounds.shapes =
        pm_arena_take(&f->source->tree, (size_t)scene->shape_count, sizeof *scene->shapes);
    f->bounds.shape_count = 0;
    for (int i = 0; f->bounds.shapes != NULL && i < scene->shape_count; i++) {
        if (scene->shapes[i].boundary) {
            f->bounds.shapes[f->bounds.shape_count++] = scene->shapes[i];
        }
    }
    return f->bounds.shapes != NULL && pm_intersect_plain(&f->bounds, &f->world) == PM_OK;
}

/// Calls `each` with every place where an index of a medium stands.
static void each_stand(pm_scene *scene, void (*each)(int *medium, int *table), int *table)
{
    for (int i = 0; i < scene->shape_count; i++) {
        each(&scene->shapes[i].interior, table);
        each(&scene->shapes[i].exterior, table);
    }
    for (int i = 0; i < scene->light_count; i++) {
        each(&scene->lights[i].medium, table);
    }
    if (scene->has_camera) {
        each(&scene->camera.medium, table);
    }
}

static void mark(int *medium, int *table)
{
    if (*medium != PM_NONE) {
        table[*medium] = 1;
    }
}

static void rename_by(int *medium, int *table)
{
    *medium = *medium == PM_NONE ? PM_NONE : table[*medium];
}

static void drop_unused(pm_scene_file *source)
{
    pm_scene *scene = &source->scene;
    int *table = pm_arena_take(&source->tree, (size_t)scene->medium_count, sizeof *table);
    if (table == NULL) {
        pm_faults_fail(&source->faults, PM_ENOMEM);
        return;
    }
    each_stand(scene, mark, table);
    for (pm_xml *e = source->root; e != NULL; e = pm_xml_following(source->root, e)) {
        if (strcmp(e->tag, "medium") == 0 && table[e->index] == 0) {
            pm_scene_file_note(source, e, "nothing is in this medium: it is not used");
        }
    }
    int kept = 0;
    for (int i = 0; i < scene->medium_count; i++) {
        if (table[i] != 0) {
            scene->media[kept] = scene->media[i];
            table[i] = kept++;
        }
    }
    scene->medium_count = kept;
    each_stand(scene, rename_by, table);
}

void pm_scene_inside(pm_scene_file *source)
{
    if (source->scene.medium_count == 0) {
        return;
    }
    finder f = {.source = source};
    if (!gather_bounds(&f)) {
        pm_faults_fail(&source->faults, PM_ENOMEM);
        return;
    }
    stand(&f);
    pm_intersector_free(&f.world);
    if (pm_faults_none(&source->faults)) {
        drop_unused(source);
    }
}
