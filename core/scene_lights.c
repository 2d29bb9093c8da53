// Lights stand in the order of the file, an area light where its shape stands.
#include "scene_build.h"
#include "scene_value.h"

#include <math.h>
#include <string.h>

/// Lengths and angles of a spot's to_world may differ by rounding of what the file says.
#define ALIKE 1e-6

static bool is_type(const pm_xml *object, const char *type)
{
    const char *given = pm_xml_attribute(object, "type");
    return given != NULL && strcmp(given, type) == 0;
}

/// `name` and to_world exclude each other, as in Mitsuba.
static void check_either(pm_scene_file *source, const pm_xml *emitter, const char *name)
{
    if (pm_scene_value_find(emitter, name) != NULL &&
        pm_scene_value_find(emitter, "to_world") != NULL) {
        PM_FAULT(source, emitter, "%s takes either %s or to_world",
                 pm_xml_attribute(emitter, "type"), name);
    }
}

static void read_point(pm_scene_file *source, const pm_xml *emitter, pm_light *light,
                       pm_vec3 *origin)
{
    check_either(source, emitter, "position");
    light->type = PM_LIGHT_POINT;
    light->position = pm_scene_value_triple(source, emitter, "position", pm_vec(0.0, 0.0, 0.0));
    *origin = pm_scene_value_transform(source, emitter, "to_world").origin;
    light->emitted = pm_scene_value_emission(source, emitter, "intensity");
}

static void read_directional(pm_scene_file *source, const pm_xml *emitter, pm_light *light)
{
    check_either(source, emitter, "direction");
    pm_transform to_world = pm_scene_value_transform(source, emitter, "to_world");
    pm_vec3 way = pm_scene_value_triple(source, emitter, "direction", to_world.column[2]);
    double reach = pm_vec_reach(way);
    if (reach == 0.0) {
        PM_FAULT(source, emitter, "directional direction must not be zero");
        way = pm_vec(0.0, 0.0, 1.0);
        reach = 1.0;
    }
    light->type = PM_LIGHT_DIRECTIONAL;
    light->direction = pm_vec_normalize(pm_vec_scale(way, 1.0 / reach));
    light->emitted = pm_scene_value_emission(source, emitter, "irradiance");
}

/// Mitsuba measures the angle to the axis before to_world, so one that scales unevenly would
/// give an oval cone.
static bool keeps_round(const pm_transform *to_world)
{
    const pm_vec3 *column = to_world->column;
    for (int i = 0; i < 3; i++) {
        double length = pm_vec_length(column[i]);
        double next = pm_vec_length(column[(i + 1) % 3]);
        double across = pm_vec_dot(column[i], column[(i + 1) % 3]);
        if (fabs(length - next) > ALIKE * length || fabs(across) > ALIKE * length * next) {
            return false;
        }
    }
    return true;
}

/// The two angles, in degrees as Mitsuba has them. Where Mitsuba would take a beam wider than
/// its cutoff, or less than nothing, as something else in silence, it is a fault here.
static void read_cone(pm_scene_file *source, const pm_xml *emitter, pm_light *light)
{
    double cutoff = pm_scene_value_number(source, emitter, "cutoff_angle", 20.0);
    if (!(cutoff > 0.0 && cutoff < 180.0)) {
        PM_FAULT(source, pm_scene_value_find(emitter, "cutoff_angle"),
                 "spot cutoff_angle must lie between 0 and 180 degrees, got %g", cutoff);
        cutoff = 20.0;
    }
    double beam = pm_scene_value_number(source, emitter, "beam_width", 0.75 * cutoff);
    if (!(beam >= 0.0 && beam <= cutoff)) {
        PM_FAULT(source, pm_scene_value_find(emitter, "beam_width"),
                 "spot beam_width must lie in [0, %g], its cutoff_angle, got %g", cutoff, beam);
        beam = cutoff;
    }
    light->cutoff = cutoff * (PM_PI / 180.0);
    light->beam = beam * (PM_PI / 180.0);
}

static void read_spot(pm_scene_file *source, const pm_xml *emitter, pm_light *light,
                      pm_vec3 *origin)
{
    pm_transform to_world = pm_scene_value_transform(source, emitter, "to_world");
    pm_vec3 way = to_world.column[2];
    if (!keeps_round(&to_world)) {
        PM_FAULT(source, emitter,
                 "to_world must keep a spot's cone round: scale x, y and z alike");
    }
    light->type = PM_LIGHT_SPOT;
    light->direction = pm_vec_normalize(pm_vec_scale(way, 1.0 / pm_vec_reach(way)));
    *origin = to_world.origin;
    light->emitted = pm_scene_value_emission(source, emitter, "intensity");
    read_cone(source, emitter, light);
}

static void read_constant(pm_scene_file *source, const pm_xml *emitter, int index)
{
    pm_light *lights = source->scene.lights;
    for (int i = 0; i < index; i++) {
        if (lights[i].type == PM_LIGHT_CONSTANT) {
            PM_FAULT(source, emitter,
                     "a scene takes at most one constant emitter; there is one at line %d",
                     lights[i].line);
        }
    }
    lights[index].type = PM_LIGHT_CONSTANT;
    lights[index].emitted = pm_scene_value_emission(source, emitter, "radiance");
}

/// Areas of the triangles 0..i, so that a point can be picked uniformly.
static void sum_areas(pm_scene_file *source, pm_shape *shape)
{
    shape->area_below =
        pm_scene_file_take(source, shape->triangle_count, sizeof *shape->area_below);
    double sum = 0.0;
    for (uint32_t i = 0; shape->area_below != NULL && i < shape->triangle_count; i++) {
        const uint32_t *corner = shape->triangles[i];
        const pm_vec3 *v = shape->vertices;
        pm_vec3 across = pm_vec_cross(pm_vec_sub(v[corner[1]], v[corner[0]]),
                                      pm_vec_sub(v[corner[2]], v[corner[0]]));
        sum += 0.5 * pm_vec_length(across);
        shape->area_below[i] = sum;
    }
}

static void read_area(pm_scene_file *source, const pm_xml *emitter, int index)
{
    pm_light *light = &source->scene.lights[index];
    light->type = PM_LIGHT_AREA;
    light->emitted = pm_scene_value_emission(source, emitter, "radiance");
    light->shape = emitter->parent->index;
    if (light->shape == PM_NONE) {
        return;
    }
    pm_shape *shape = &source->scene.shapes[light->shape];
    if (shape->light != PM_NONE) {
        PM_FAULT(source, emitter, "a shape takes at most one emitter");
    }
    shape->light = index;
    if (shape->type == PM_SHAPE_MESH && shape->area_below == NULL) {
        sum_areas(source, shape);
    }
}

static void read_emitter(pm_scene_file *source, pm_xml *emitter, int index)
{
    emitter->index = index;
    pm_light *light = &source->scene.lights[index];
    *light = (pm_light){.line = emitter->line, .shape = PM_NONE, .medium = PM_NONE};
    light->id = pm_scene_file_name(source, emitter);
    light->medium = pm_scene_build_stand(source, emitter);
    bool inside = strcmp(emitter->parent->tag, "shape") == 0;
    if (is_type(emitter, "area") != inside) {
        PM_FAULT(source, emitter, "emitter \"%s\" %s", pm_xml_attribute(emitter, "type"),
                 inside ? "cannot stand inside a shape; \"area\" can"
                        : "stands inside the shape that emits");
    } else if (inside) {
        read_area(source, emitter, index);
    } else if (is_type(emitter, "point")) {
        read_point(source, emitter, light, &source->light_origin[index]);
    } else if (is_type(emitter, "directional")) {
        read_directional(source, emitter, light);
    } else if (is_type(emitter, "spot")) {
        read_spot(source, emitter, light, &source->light_origin[index]);
    } else if (is_type(emitter, "constant")) {
        read_constant(source, emitter, index);
    }
}

void pm_scene_build_lights(pm_scene_file *source)
{
    pm_scene *scene = &source->scene;
    size_t count = (size_t)pm_scene_file_count(source, "emitter");
    scene->lights = pm_scene_file_take(source, count, sizeof *scene->lights);
    source->light_origin = pm_arena_take(&source->tree, count, sizeof *source->light_origin);
    if (scene->lights == NULL || source->light_origin == NULL) {
        pm_faults_fail(&source->faults, PM_ENOMEM);
        return;
    }
    for (pm_xml *e = source->root; e != NULL; e = pm_xml_following(source->root, e)) {
        if (strcmp(e->tag, "emitter") == 0 && pm_xml_attribute(e, "type") != NULL) {
            read_emitter(source, e, scene->light_count++);
        }
    }
    if (count == 0) {
        pm_faults_add(&source->faults, source->root->file, 0,
                      "the scene has no emitter, so it is dark: add one");
    }
}
