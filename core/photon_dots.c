// Photons are drawn in map order by one thread: a few rays each, and the same picture every
// time.
#include "photon_dots.h"

#include "camera.h"
#include "interrupt.h"
#include "map_power.h"
#include "photon_map.h"
#include "store.h"

#define CHECK_EVERY 4096u // photons between looks at SIGINT

/// Whether nothing stands between a photon and the camera.
static bool seen(const pm_intersector *world, const pm_photon_view *photon)
{
    const pm_camera *camera = &world->scene->camera;
    double lift = 4.0 * PM_OFFSET * pm_vec_reach(photon->position);
    pm_vec3 from = pm_vec_along(photon->position, photon->normal, lift);
    pm_vec3 way = pm_vec_sub(camera->position, from);
    double length = pm_vec_length(way);
    if (length == 0.0) {
        return true;
    }
    pm_ray ray = {from, pm_vec_scale(way, 1.0 / length), length, 0.0, PM_NONE};
    return !pm_blocked(world, &ray);
}

static pm_layer layer_of(const pm_photon_view *photon)
{
    return photon->first     ? PM_LAYER_DIRECT
           : photon->caustic ? PM_LAYER_CAUSTIC
                             : PM_LAYER_INDIRECT;
}

static void draw(const pm_intersector *world, const pm_photon_view *photon, double scale,
                 const pm_picture *picture)
{
    int x;
    int y;
    const pm_camera *camera = &world->scene->camera;
    if (!pm_camera_pixel(camera, photon->position, &x, &y) || !seen(world, photon)) {
        return;
    }
    size_t index = (size_t)y * (size_t)camera->width + (size_t)x;
    pm_layer layer = layer_of(photon);
    pm_pixel pixel = {0};
    for (int c = 0; c < 3; c++) {
        for (int l = 0; l < PM_LAYER_COUNT; l++) {
            pixel.layer[l].c[c] = (double)picture->layer[l][c][index];
        }
        pixel.layer[layer].c[c] += photon->power.c[c] * scale;
    }
    pm_picture_set(picture, index, &pixel);
}

static pm_status draw_map(const pm_intersector *world, const pm_photon_map *map,
                          bool skip_caustic, const pm_picture *picture)
{
    double mean = pm_spectrum_mean(pm_map_power(map)) / map->count;
    for (uint32_t i = 0; i < map->count && mean > 0.0; i++) {
        pm_photon_view photon = pm_store_unpack(map, i);
        if (!(skip_caustic && photon.caustic)) {
            draw(world, &photon, 1.0 / mean, picture);
        }
        if (i % CHECK_EVERY == 0) {
            PM_TRY(pm_interrupt_check());
        }
    }
    return PM_OK;
}

pm_status pm_photon_dots(const pm_intersector *world, const pm_render_maps *maps,
                         const pm_picture *picture)
{
    bool has_caustic = maps->has[PM_MAP_CAUSTIC];
    if (maps->has[PM_MAP_GLOBAL]) {
        PM_TRY(draw_map(world, &maps->map[PM_MAP_GLOBAL], has_caustic, picture));
    }
    if (has_caustic) {
        PM_TRY(draw_map(world, &maps->map[PM_MAP_CAUSTIC], false, picture));
    }
    return PM_OK;
}
