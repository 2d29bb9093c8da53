// Fitting is exact: the eight corners of the bounds are projected onto the plane z = 1, and the
// box around them is scaled and shifted into the free part of the picture.
#include "viewpoint.h"

#include <math.h>

// Half fields of view wider than this bend a box out of shape; then the camera moves back.
#define TAN_MOST 0.8

// Distance, in scene radii, that a camera is moved back to.
#define DISTANCE 3.5

typedef struct {
    double low[2], high[2]; // on the plane at distance 1
} extent;

typedef struct {
    pm_vec3 low, high;
} box;

// Parts of a picture that are kept free.
typedef struct {
    double top, bottom, left, right;
} margins;

static const margins of_figure = {PM_VIEWPOINT_TOP, PM_VIEWPOINT_BOTTOM, PM_VIEWPOINT_LEFT,
                                  PM_VIEWPOINT_RIGHT};
static const margins of_panel = {0.03, 0.03, 0.03, 0.03};

static pm_vec3 local(const pm_viewpoint *v, pm_vec3 point)
{
    pm_vec3 to = pm_vec_sub(point, v->position);
    return pm_vec(pm_vec_dot(to, v->right), pm_vec_dot(to, v->up), pm_vec_dot(to, v->forward));
}

static pm_vec3 corner(const box *b, int index)
{
    return pm_vec(index & 1 ? b->high.x : b->low.x, index & 2 ? b->high.y : b->low.y,
                  index & 4 ? b->high.z : b->low.z);
}

/// False when a corner of the box is behind the camera or far outside of a usable picture.
static bool measure(const pm_viewpoint *v, const box *b, extent *out)
{
    *out = (extent){{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    for (int i = 0; i < 8; i++) {
        pm_vec3 at = local(v, corner(b, i));
        if (!(at.z > 0.0)) {
            return false;
        }
        double on[2] = {at.x / at.z, at.y / at.z};
        for (int axis = 0; axis < 2; axis++) {
            out->low[axis] = fmin(out->low[axis], on[axis]);
            out->high[axis] = fmax(out->high[axis], on[axis]);
        }
    }
    return fmax(fmax(-out->low[0], out->high[0]), fmax(-out->low[1], out->high[1])) <= TAN_MOST;
}

static void orient(pm_viewpoint *v, const pm_scene *scene)
{
    if (scene->has_camera) {
        v->position = scene->camera.position;
        v->right = scene->camera.right;
        v->up = scene->camera.up;
        v->forward = scene->camera.forward;
        return;
    }
    v->forward = pm_vec_normalize(pm_vec(-0.5, -0.35, -1.0));
    v->right = pm_vec_normalize(pm_vec_cross(v->forward, pm_vec(0.0, 1.0, 0.0)));
    v->up = pm_vec_cross(v->right, v->forward);
    v->position = pm_vec_scale(v->forward, -DISTANCE * scene->radius);
}

static void fit(pm_viewpoint *v, const extent *e, const margins *m)
{
    double aspect = (double)v->width / v->height;
    double free_x = 2.0 * (1.0 - m->left - m->right);
    double free_y = 2.0 * (1.0 - m->top - m->bottom);
    double wide = (e->high[0] - e->low[0]) / (free_x * aspect);
    double tall = (e->high[1] - e->low[1]) / free_y;
    v->tan_y = wide > 0.0 || tall > 0.0 ? fmax(wide, tall) : TAN_MOST;
    v->tan_x = v->tan_y * aspect;
    v->shift_x = (e->low[0] + e->high[0]) / (2.0 * v->tan_x) - (m->left - m->right);
    v->shift_y = (e->low[1] + e->high[1]) / (2.0 * v->tan_y) - (m->bottom - m->top);
}

static pm_viewpoint of_scene(const pm_scene *scene, int width, int height, const margins *m)
{
    pm_viewpoint v = {.width = width, .height = height};
    box bounds = {scene->low, scene->high};
    orient(&v, scene);
    extent e;
    if (!measure(&v, &bounds, &e)) {
        v.position = pm_vec_scale(v.forward, -DISTANCE * scene->radius);
        measure(&v, &bounds, &e);
    }
    fit(&v, &e, m);
    return v;
}

pm_viewpoint pm_viewpoint_of(const pm_scene *scene, int width, int height)
{
    return of_scene(scene, width, height, &of_figure);
}

pm_viewpoint pm_viewpoint_fill(const pm_scene *scene, int width, int height)
{
    return of_scene(scene, width, height, &of_panel);
}

pm_viewpoint pm_viewpoint_box(pm_vec3 low, pm_vec3 high, pm_vec3 forward, pm_vec3 up, int width,
                              int height)
{
    pm_viewpoint v = {.width = width, .height = height, .forward = forward};
    box bounds = {low, high};
    pm_vec3 middle = pm_vec_scale(pm_vec_add(low, high), 0.5);
    double radius = 0.5 * pm_vec_length(pm_vec_sub(high, low));
    v.right = pm_vec_normalize(pm_vec_cross(forward, up));
    v.up = pm_vec_cross(v.right, forward);
    v.position = pm_vec_along(middle, forward, -DISTANCE * radius);
    extent e;
    measure(&v, &bounds, &e);
    fit(&v, &e, &of_panel);
    return v;
}

bool pm_viewpoint_project(const pm_viewpoint *v, pm_vec3 point, double *x, double *y)
{
    pm_vec3 at = local(v, point);
    if (!(at.z > 0.0)) {
        return false;
    }
    *x = (1.0 + at.x / (at.z * v->tan_x) - v->shift_x) * 0.5 * v->width;
    *y = (1.0 - at.y / (at.z * v->tan_y) + v->shift_y) * 0.5 * v->height;
    return true;
}
