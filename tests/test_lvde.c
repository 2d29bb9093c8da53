// Light that fog throws onto a wall, and fog seen in mirrors and through panes: pictures
// against volumetric path tracing, layer by layer. Walls are black but for one, so that nothing
// else makes up for a path class that is forgotten or counted twice.
#include "pictures.h"
#include "references.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

/// What maps may be off by.
static const double map_slack = 0.02;

static void check_layer(pm_layer layer, const pm_pictures_means *got,
                        const pm_pictures_means *want)
{
    for (int c = 0; c < 3; c++) {
        double variance = got->variance[layer].c[c] + want->variance[layer].c[c];
        CHECK_CLOSE(pm_layer_name(layer), got->mean[layer].c[c], want->mean[layer].c[c],
                    variance, map_slack);
    }
}

/// All layers of the picture, with so many gather rays and the fog asked in this way, against
/// `want`.
static void check_picture(const pm_scenes *s, uint32_t rays, pm_media_query media,
                          const pm_pictures_means *want)
{
    pm_render_settings settings = pm_pictures_settings();
    settings.photons[PM_MAP_GLOBAL] = 10000;
    settings.photons[PM_MAP_VOLUME] = 6000;
    settings.photons[PM_MAP_CAUSTIC] = 5000;
    settings.light.estimate.k = 20;
    settings.light.rays = rays;
    settings.light.media = media;
    settings.light.step = 0.1;
    pm_pictures_means got = pm_pictures_repeat(s, settings, 6);
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        check_layer((pm_layer)layer, &got, want);
    }
}

/// A black room of half width 1 with a white floor; returns the black.
static int begin_room(pm_scenes *s)
{
    pm_scenes_begin(s);
    int black = pm_scenes_diffuse(s, pm_gray(0.0));
    int walls = pm_scenes_room(s, 1.0, black);
    s->shapes[walls + 4].material[0] = pm_scenes_diffuse(s, pm_rgb(0.8, 0.4, 0.8));
    return black;
}

// --- onto walls -----------------------------------------------------------------------------

/// Fog all over the room, a lamp under its ceiling, and a black screen: the floor below that is
/// lit by the fog alone.
static void begin_foggy_room(pm_scenes *s)
{
    int black = begin_room(s);
    int fog = pm_scenes_medium(s, 0.8, pm_rgb(0.6, 0.6, 0.3), 0.2);
    int lamp = pm_scenes_add(s, pm_scenes_square(0.4, 0.9, true), black, black);
    pm_scenes_lamp(s, lamp, pm_rgb(30.0, 30.0, 60.0));
    s->lights[0].medium = fog;
    pm_scenes_wear(s, pm_scenes_square(0.8, 0.0, false), black);
    pm_scenes_ready(s);
    pm_pictures_look(s, pm_vec(0.0, 0.0, -0.5), pm_vec(0.0, 0.0, -1.0), 0.9, 8);
    s->scene.camera.medium = fog;
}

static void fog_lights_the_floor(void)
{
    pm_scenes s;
    begin_foggy_room(&s);
    pm_pictures_means want = pm_references_trace(&s, 1024);
    CHECK(want.mean[PM_LAYER_INDIRECT].c[0] > 1e-3);
    CHECK(want.mean[PM_LAYER_VOLUME].c[0] > 1e-3);
    CHECK(pm_spectrum_is_black(want.mean[PM_LAYER_DIRECT]));
    check_picture(&s, 16, PM_MEDIA_BEAMS, &want);
    check_picture(&s, 0, PM_MEDIA_BEAMS, &want);
    pm_scenes_free(&s);
}

/// A ball of fog in a clear room, with a spot aimed at it.
static void add_ball_and_spot(pm_scenes *s)
{
    static const double cone[2] = {0.3, 0.4};
    int fog = pm_scenes_medium(s, 2.0, pm_rgb(0.5, 0.5, 0.3), 0.0);
    pm_shape ball = pm_shapes_sphere(pm_vec(0.0, 0.0, -0.3), 0.4);
    pm_scenes_bound(s, ball, fog, PM_NONE);
    pm_scenes_spot(s, pm_vec(-0.9, 0.0, -0.3), pm_vec(1.0, 0.0, 0.0), cone, pm_gray(3.0));
}

static void a_ball_of_fog_lights_the_floor(void)
{
    // Gather rays go in and out of the fog; what it hides of the walls is black anyway.
    pm_scenes s;
    begin_room(&s);
    add_ball_and_spot(&s);
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, -0.95, -0.5), pm_vec(0.0, -0.5, -1.0), 0.2, 8);
    pm_pictures_means want = pm_references_trace(&s, 1024);
    CHECK(want.mean[PM_LAYER_INDIRECT].c[0] > 1e-3);
    CHECK(pm_spectrum_is_black(want.mean[PM_LAYER_VOLUME]));
    check_picture(&s, 16, PM_MEDIA_BEAMS, &want);
    check_picture(&s, 16, PM_MEDIA_MARCH, &want);
    pm_scenes_free(&s);
}

// --- in mirrors and through panes -----------------------------------------------------------

static void check_behind(pm_scenes *s)
{
    add_ball_and_spot(s);
    pm_scenes_ready(s);
    pm_pictures_means want = pm_references_trace(s, 512);
    CHECK(want.mean[PM_LAYER_SPECULAR].c[0] > 0.01);
    CHECK(pm_spectrum_is_black(want.mean[PM_LAYER_VOLUME]));
    check_picture(s, 0, PM_MEDIA_BEAMS, &want);
    check_picture(s, 0, PM_MEDIA_MARCH, &want);
    pm_scenes_free(s);
}

static void fog_shows_through_panes(void)
{
    pm_scenes s;
    begin_room(&s);
    pm_shape pane = pm_shapes_rectangle(pm_vec(-1.0, -0.6, -1.0), pm_vec(2.0, 0.0, 0.0),
                                        pm_vec(0.0, 0.0, 2.0));
    pm_scenes_wear(&s, pane, pm_scenes_pane(&s, 1.5));
    pm_pictures_look(&s, pm_vec(0.0, -0.95, -0.3), pm_vec(0.0, 0.0, -0.3), 0.3, 8);
    check_behind(&s);
}

static void fog_shows_in_mirrors(void)
{
    pm_scenes s;
    begin_room(&s);
    s.shapes[3].material[0] = pm_scenes_mirror(&s, pm_gray(0.9));
    pm_pictures_look(&s, pm_vec(0.0, 0.5, -0.3), pm_vec(0.0, 1.0, -0.3), 0.2, 8);
    check_behind(&s);
}

PM_TESTS({"lvde.1", "fog lights a floor that no lamp lights, once", fog_lights_the_floor},
         {"lvde.2", "a ball of fog lights the floor under it", a_ball_of_fog_lights_the_floor},
         {"lvde.3", "fog shows through a pane, once", fog_shows_through_panes},
         {"lvde.4", "fog shows in a mirror, once", fog_shows_in_mirrors})
