// The scene file named on the command line becomes something rays can be asked of.
#include "world.h"

#include "camera.h"
#include "scene_read.h"

pm_status pm_world_open(const pm_options *options, bool needs_camera, pm_world *world)
{
    *world = (pm_world){0};
    PM_TRY(pm_scene_read(options->positional[0], options->define, options->define_count,
                         needs_camera, &world->scene));
    if (options->width > 0) {
        pm_camera_resize(&world->scene.camera, options->width, options->height);
    }
    return pm_intersect_embree(&world->scene, &world->rays);
}

void pm_world_close(pm_world *world)
{
    pm_intersector_free(&world->rays);
    pm_scene_free(&world->scene);
}
