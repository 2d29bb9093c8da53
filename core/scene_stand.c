// The camera and each light are looked at in turn, at their elements, so that every fault has
// its line.
#include "scene_stand.h"

#include "scene_build.h"
#include "scene_inside.h"
#include "shape.h"

#include <stdio.h>
#include <string.h>

typedef struct {
    pm_scene_file *source;
    const pm_xml *object; // sensor or emitter
    pm_scene_inside inside;
    int around; // medium around the whole scene
} finder;

/// For messages.
typedef struct {
    char text[80];
} called;

static called call(const finder *f, int medium)
{
    called name = {"no medium"};
    if (medium != PM_NONE) {
        snprintf(name.text, sizeof name.text, "medium \"%.60s\"",
                 f->source->scene.media[medium].id);
    }
    return name;
}

static void report(const finder *f, const pm_xml *at, const pm_scene_place *place)
{
    PM_FAULT(
        f->source, at, "%s: of one place \"%.60s\" tells %s and \"%.60s\" %s",
        at == f->object
            ? "this light or sensor stands on a shape that parts media, or they do not close"
            : "the shapes that part media do not close, or cut or touch each "
              "other",
        place->by->id, call(f, place->medium).text, place->against->id,
        call(f, place->other).text);
}

/// PM_NONE after a fault.
static int find_at(const finder *f, pm_vec3 from)
{
    pm_scene_place place = pm_scene_inside_at(&f->inside, from);
    if (place.against == NULL) {
        return place.medium;
    }
    report(f, f->object, &place);
    return PM_NONE;
}

/// The medium at all of the points, which must be the same.
static int find_at_all(const finder *f, const pm_vec3 *points, int count)
{
    const pm_faults *faults = &f->source->faults;
    int before = faults->count;
    int medium = find_at(f, points[0]);
    for (int i = 1; i < count && faults->count == before; i++) {
        int other = find_at(f, points[i]);
        if (other != medium && faults->count == before) {
            PM_FAULT(f->source, f->object,
                     "this %s lies in %s and in %s: keep it on one side of their boundary",
                     f->object->tag, call(f, medium).text, call(f, other).text);
        }
    }
    return medium;
}

/// Just off the surface of an area light.
static int find_off(const finder *f, const pm_shape *shape)
{
    static const double square[4][2] = {{0.21, 0.33}, {0.72, 0.18}, {0.37, 0.81}, {0.86, 0.64}};
    pm_vec3 points[4];
    for (int i = 0; i < 4; i++) {
        pm_hit hit;
        pm_shape_point(shape, square[i][0], square[i][1], &hit);
        points[i] = pm_hit_leave(&hit, hit.normal);
    }
    return find_at_all(f, points, 4);
}

static bool is_outside(const pm_light *light)
{
    return light->type == PM_LIGHT_DIRECTIONAL || light->type == PM_LIGHT_CONSTANT;
}

static int find_light(const finder *f, const pm_light *light)
{
    if (is_outside(light)) {
        return f->around;
    }
    if (light->type == PM_LIGHT_AREA) {
        return find_off(f, &f->source->scene.shapes[light->shape]);
    }
    return find_at(f, light->position);
}

static void check_named(const finder *f, int named, int found)
{
    if (named == PM_NONE || named == found) {
        return;
    }
    if (f->inside.bounds.shape_count == 0) {
        PM_FAULT(f->source, f->object,
                 "this %s names %s, another one %s: no shape parts media, so one is everywhere",
                 f->object->tag, call(f, named).text, call(f, found).text);
    } else {
        PM_FAULT(f->source, f->object,
                 "this %s names %s and stands in %s by the shapes around it", f->object->tag,
                 call(f, named).text, call(f, found).text);
    }
}

static void check_arrives(const finder *f, const pm_light *light)
{
    int medium = light->medium;
    if (is_outside(light) && medium != PM_NONE &&
        f->source->scene.media[medium].sigma_t > 0.0) {
        PM_FAULT(f->source, f->object,
                 "nothing of a %s light arrives through %s, which has no end: put the medium "
                 "into a closed shape",
                 pm_xml_attribute(f->object, "type"), call(f, medium).text);
    }
}

static void stand_light(const finder *f, pm_light *light)
{
    int before = f->source->faults.count;
    int named = light->medium;
    light->medium = f->inside.bounds.shape_count == 0 ? f->around : find_light(f, light);
    if (f->source->faults.count == before) {
        check_named(f, named, light->medium);
    }
    if (f->source->faults.count == before) {
        check_arrives(f, light);
    }
}

static void stand_camera(const finder *f, pm_camera *camera)
{
    int before = f->source->faults.count;
    int named = camera->medium;
    camera->medium =
        f->inside.bounds.shape_count == 0 ? f->around : find_at(f, camera->position);
    if (f->source->faults.count > before) {
        return;
    }
    check_named(f, named, camera->medium);
    if (named == PM_NONE && camera->medium != PM_NONE) {
        // Mitsuba's emitters need not: its paths begin at the sensor.
        pm_scene_file_note(f->source, f->object,
                           "the sensor stands in %s; Mitsuba has it in none unless the sensor "
                           "names the medium",
                           call(f, camera->medium).text);
    }
}

/// Without shapes that part media: what the sensor names, or else the first emitter that names
/// one.
static int find_everywhere(const pm_scene *scene)
{
    int medium = scene->camera.medium;
    for (int i = 0; i < scene->light_count && medium == PM_NONE; i++) {
        medium = scene->lights[i].medium;
    }
    return medium;
}

/// The element that `shape` was made from.
static const pm_xml *element_of(const pm_scene_file *source, const pm_shape *shape)
{
    for (pm_xml *e = source->root; e != NULL; e = pm_xml_following(source->root, e)) {
        if (strcmp(e->tag, "shape") == 0 && source->scene.shapes[e->index].id == shape->id) {
            return e;
        }
    }
    return source->root;
}

static void find_around(finder *f)
{
    if (f->inside.bounds.shape_count == 0) {
        f->around = find_everywhere(&f->source->scene);
        return;
    }
    pm_scene_place place = pm_scene_inside_around(&f->inside);
    f->around = place.medium;
    if (place.against != NULL) {
        report(f, element_of(f->source, place.against), &place);
    }
}

static void stand_all(finder *f)
{
    pm_xml *root = f->source->root;
    pm_scene *scene = &f->source->scene;
    for (pm_xml *e = root; e != NULL; e = pm_xml_following(root, e)) {
        f->object = e;
        if (strcmp(e->tag, "sensor") == 0) {
            stand_camera(f, &scene->camera);
        } else if (strcmp(e->tag, "emitter") == 0) {
            stand_light(f, &scene->lights[e->index]);
        }
    }
}

void pm_scene_stand(pm_scene_file *source)
{
    if (source->scene.medium_count == 0) {
        return;
    }
    finder f = {.source = source};
    if (!pm_scene_inside_begin(source, &f.inside)) {
        pm_faults_fail(&source->faults, PM_ENOMEM);
        return;
    }
    find_around(&f);
    if (pm_faults_none(&source->faults)) {
        stand_all(&f);
    }
    pm_intersector_free(&f.inside.world);
    if (pm_faults_none(&source->faults)) {
        pm_scene_drop_media(source);
    }
}
