// Mitsuba's camera looks along +z with y up, and its x runs to the left of the picture.
#include "scene_build.h"
#include "scene_value.h"

#include <math.h>
#include <string.h>

enum { FILM_MOST = 65536 };

/// As Mitsuba: the camera-to-world transform may turn and mirror, but not scale or shear.
#define RIGID 1e-3

static void note_unused(pm_scene_file *source, const pm_xml *parent)
{
    for (const pm_xml *e = parent->child; e != NULL; e = e->next) {
        if (strcmp(e->tag, "integrator") == 0 || strcmp(e->tag, "sampler") == 0) {
            pm_scene_file_note(source, e, "the %s is not used", e->tag);
        } else if (strcmp(e->tag, "rfilter") == 0) {
            pm_scene_file_note(source, e, "the rfilter is not used: pixels are box-filtered");
        }
    }
}

static void note_clip(pm_scene_file *source, const pm_xml *sensor, const char *name)
{
    const pm_xml *given = pm_scene_value_find(sensor, name);
    pm_scene_value_positive(source, sensor, name, 1.0);
    if (given != NULL) {
        pm_scene_file_note(source, given, "%s is not used: nothing is clipped", name);
    }
}

static void read_film(pm_scene_file *source, const pm_xml *sensor)
{
    pm_camera *camera = &source->scene.camera;
    const pm_xml *film = NULL;
    for (const pm_xml *e = sensor->child; e != NULL; e = e->next) {
        if (strcmp(e->tag, "film") != 0) {
            continue;
        }
        if (film != NULL) {
            PM_FAULT(source, e, "a sensor takes at most one film");
        }
        film = e;
    }
    // Mitsuba's defaults.
    camera->width = 768;
    camera->height = 576;
    if (film != NULL) {
        camera->width = pm_scene_value_count(source, film, "width", FILM_MOST, camera->width);
        camera->height =
            pm_scene_value_count(source, film, "height", FILM_MOST, camera->height);
        note_unused(source, film);
    }
}

/// Half the view along x when `tangent` is that along `axis`.
static double along_x(const char *axis, double tangent, double aspect)
{
    if (strcmp(axis, "y") == 0 || (strcmp(axis, "smaller") == 0 && aspect > 1.0) ||
        (strcmp(axis, "larger") == 0 && aspect < 1.0)) {
        return tangent * aspect;
    }
    if (strcmp(axis, "diagonal") == 0) {
        return tangent / sqrt(1.0 + 1.0 / (aspect * aspect));
    }
    return tangent;
}

static const char *read_axis(pm_scene_file *source, const pm_xml *sensor)
{
    static const char *const known[5] = {"x", "y", "diagonal", "smaller", "larger"};
    const char *axis = pm_scene_value_text(sensor, "fov_axis", "x");
    for (int i = 0; i < 5; i++) {
        if (strcmp(axis, known[i]) == 0) {
            return axis;
        }
    }
    PM_FAULT(source, pm_scene_value_find(sensor, "fov_axis"),
             "fov_axis must be x, y, diagonal, smaller or larger, got \"%.60s\"", axis);
    return "x";
}

static void read_view(pm_scene_file *source, const pm_xml *sensor)
{
    pm_camera *camera = &source->scene.camera;
    double aspect = (double)camera->width / (double)camera->height;
    const char *axis = read_axis(source, sensor);
    // Without fov Mitsuba takes a 50 mm lens on a film of 36 mm x 24 mm, along the diagonal.
    double tangent = sqrt(36.0 * 36.0 + 24.0 * 24.0) / (2.0 * 50.0);
    if (pm_scene_value_find(sensor, "fov") == NULL) {
        axis = "diagonal";
    } else {
        double fov = pm_scene_value_number(source, sensor, "fov", 45.0);
        if (!(fov > 0.0 && fov < 180.0)) {
            PM_FAULT(source, pm_scene_value_find(sensor, "fov"),
                     "fov must lie between 0 and 180 degrees, got %g", fov);
        }
        tangent = tan(fov * (PM_PI / 360.0));
    }
    camera->tan_x = along_x(axis, tangent, aspect);
    camera->tan_y = camera->tan_x / aspect;
}

static void read_stand(pm_scene_file *source, const pm_xml *sensor)
{
    pm_camera *camera = &source->scene.camera;
    pm_transform to_world = pm_scene_value_transform(source, sensor, "to_world");
    const pm_vec3 *column = to_world.column;
    for (int i = 0; i < 3; i++) {
        if (fabs(pm_vec_length(column[i]) - 1.0) > RIGID ||
            fabs(pm_vec_dot(column[i], column[(i + 1) % 3])) > RIGID) {
            PM_FAULT(source, sensor, "to_world must not scale or shear a sensor");
            return;
        }
    }
    camera->right = pm_vec_negate(pm_vec_normalize(column[0]));
    camera->up = pm_vec_normalize(column[1]);
    camera->forward = pm_vec_normalize(column[2]);
    source->camera_origin = to_world.origin;
}

static void read_sensor(pm_scene_file *source, const pm_xml *sensor)
{
    if (source->scene.has_camera) {
        PM_FAULT(source, sensor, "a scene takes at most one sensor");
        return;
    }
    source->scene.has_camera = true;
    source->scene.camera.medium = pm_scene_build_stand(source, sensor);
    note_unused(source, sensor);
    note_clip(source, sensor, "near_clip");
    note_clip(source, sensor, "far_clip");
    read_film(source, sensor);
    read_view(source, sensor);
    read_stand(source, sensor);
}

void pm_scene_build_camera(pm_scene_file *source)
{
    source->scene.camera.medium = PM_NONE;
    note_unused(source, source->root);
    for (const pm_xml *e = source->root->child; e != NULL; e = e->next) {
        if (strcmp(e->tag, "sensor") == 0) {
            read_sensor(source, e);
        }
    }
}
