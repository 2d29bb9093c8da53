// Pixels to rays and points to pixels, for the pinhole camera of a scene.
#ifndef PM_CAMERA_H
#define PM_CAMERA_H

#include "intersect.h"

/// The ray through the film point (u, v) in [0,1]^2, v down.
static inline pm_ray pm_camera_ray(const pm_camera *camera, double u, double v)
{
    pm_vec3 across = pm_vec_scale(camera->right, (2.0 * u - 1.0) * camera->tan_x);
    pm_vec3 up = pm_vec_scale(camera->up, (1.0 - 2.0 * v) * camera->tan_y);
    pm_vec3 direction = pm_vec_add(camera->forward, pm_vec_add(across, up));
    return (pm_ray){camera->position, pm_vec_normalize(direction), HUGE_VAL, 0.0,
                    camera->medium};
}

/// Gives the camera another film. The field of view stays along x.
static inline void pm_camera_resize(pm_camera *camera, int width, int height)
{
    camera->tan_y = camera->tan_x * height / width;
    camera->width = width;
    camera->height = height;
}

/// Where a point is seen. False behind the camera or off the film; else the pixel.
static inline bool pm_camera_pixel(const pm_camera *camera, pm_vec3 point, int *x, int *y)
{
    pm_vec3 way = pm_vec_sub(point, camera->position);
    double depth = pm_vec_dot(way, camera->forward);
    if (!(depth > 0.0)) {
        return false;
    }
    double u = 0.5 * (1.0 + pm_vec_dot(way, camera->right) / (depth * camera->tan_x));
    double v = 0.5 * (1.0 - pm_vec_dot(way, camera->up) / (depth * camera->tan_y));
    if (!(u >= 0.0 && u < 1.0 && v >= 0.0 && v < 1.0)) {
        return false;
    }
    *x = (int)(u * camera->width);
    *y = (int)(v * camera->height);
    return true;
}

#endif
