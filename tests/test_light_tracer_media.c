// Light paths in fog against eye paths: one connects collisions to the camera, the other to the
// lights, so no estimator is shared.
#include "films.h"
#include "light.h"
#include "references.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

/// The layers that light paths can bring; the others need a smooth lobe next to the eye, or
/// none.
static void agree(const pm_pictures_means *got, const pm_pictures_means *want)
{
    static const pm_layer layers[] = {PM_LAYER_VOLUME, PM_LAYER_DIRECT, PM_LAYER_CAUSTIC,
                                      PM_LAYER_INDIRECT};
    for (int i = 0; i < 4; i++) {
        pm_references_agree(layers[i], got, want);
    }
}

/// Ends the test when 5 sigma of this channel are more than `share` of it.
static void check_noise(const pm_pictures_means *means, pm_layer layer, double share)
{
    double sigma = sqrt(means->variance[layer].c[0]);
    CHECK_THAT(5.0 * sigma < share * means->mean[layer].c[0], "%s is too noisy: %g of %g",
               pm_layer_name(layer), sigma, means->mean[layer].c[0]);
}

/// A ball of coloured fog with a core over a floor, under one kind of light that stands in
/// clear air.
static void ball_begin(pm_scenes *s, pm_light_type type)
{
    const double cone[2] = {0.3, 0.6};
    pm_scenes_begin(s);
    int fog = pm_scenes_medium(s, 1.5, pm_rgb(0.9, 0.6, 0.3), 0.4);
    pm_scenes_wear(s, pm_scenes_square(3.0, 0.0, false), pm_scenes_diffuse(s, pm_gray(0.1)));
    pm_scenes_bound(s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.6), 0.5), fog, PM_NONE);
    pm_scenes_wear(s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.6), 0.25),
                   pm_scenes_diffuse(s, pm_gray(0.8)));
    if (type == PM_LIGHT_POINT) {
        pm_scenes_point(s, pm_vec(0.5, 0.2, 1.6), pm_gray(10.0));
    } else if (type == PM_LIGHT_SPOT) {
        pm_scenes_spot(s, pm_vec(0.5, 0.2, 2.0), pm_vec(-0.3, 0.0, -1.0), cone, pm_gray(2.0));
    } else if (type == PM_LIGHT_DIRECTIONAL) {
        pm_scenes_sun(s, pm_vec(0.5, 0.2, -1.0), pm_gray(1.0));
    } else if (type == PM_LIGHT_AREA) {
        int lamp = pm_scenes_wear(s, pm_scenes_square(0.8, 1.3, true), PM_NONE);
        pm_scenes_lamp(s, lamp, pm_gray(5.0));
    } else {
        pm_scenes_sky(s, pm_gray(1.0));
    }
    pm_scenes_ready(s);
    pm_pictures_look(s, pm_vec(0.2, -1.6, 1.0), pm_vec(0.0, 0.0, 0.6), 0.35, 8);
}

static void fog_in_every_light_is_what_eyes_find(void)
{
    for (pm_light_type type = PM_LIGHT_POINT; type <= PM_LIGHT_CONSTANT; type++) {
        pm_scenes s;
        ball_begin(&s, type);
        pm_pictures_means got = pm_films_repeat(&s, 2000, 12);
        pm_pictures_means want = pm_references_trace(&s, 64);
        CHECK_THAT(want.mean[PM_LAYER_VOLUME].c[0] > 0.0, "%s", pm_light_name(type));
        agree(&got, &want);
        check_noise(&want, PM_LAYER_VOLUME, 0.6);
        check_noise(&got, PM_LAYER_VOLUME, 0.6);
        pm_scenes_free(&s);
    }
}

/// A cube of fog in a room, and a glass ball that lets a caustic out of it and into it.
static void room_begin(pm_scenes *s)
{
    pm_frame upright = pm_shapes_upright();
    pm_scenes_begin(s);
    int fog = pm_scenes_medium(s, 1.0, pm_rgb(0.8, 0.9, 0.5), 0.5);
    pm_scenes_room(s, 1.0, pm_scenes_diffuse(s, pm_rgb(0.6, 0.3, 0.5)));
    pm_scenes_bound(s, pm_shapes_cube(&upright, pm_vec(0.0, 0.4, -0.2), 0.5), fog, PM_NONE);
    // Half in the fog, half out of it: nothing says what it holds.
    pm_scenes_wear(s, pm_shapes_sphere(pm_vec(0.0, 0.4, 0.3), 0.2), pm_scenes_glass(s, 1.5));
}

static void caustics_in_fog_are_what_eyes_find(void)
{
    pm_scenes s;
    room_begin(&s);
    int lamp = pm_scenes_wear(&s, pm_scenes_square(1.0, 0.8, true), PM_NONE);
    pm_scenes_lamp(&s, lamp, pm_rgb(4.0, 3.0, 2.0));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, -0.95, 0.0), pm_vec(0.0, 1.0, -0.2), 0.7, 8);
    pm_pictures_means got = pm_films_repeat(&s, 3000, 12);
    pm_pictures_means want = pm_references_trace(&s, 64);
    agree(&got, &want);
    CHECK(got.mean[PM_LAYER_CAUSTIC].c[0] > 0.0);
    check_noise(&want, PM_LAYER_VOLUME, 0.5);
    check_noise(&got, PM_LAYER_VOLUME, 0.5);
    pm_scenes_free(&s);
}

// Eye paths scatter light of a point that comes straight, light paths what glass sends: no more
// and no less.
static void the_two_passes_share_the_fog(void)
{
    pm_scenes s;
    room_begin(&s);
    pm_scenes_point(&s, pm_vec(0.02, 0.36, 0.7), pm_rgb(6.0, 5.0, 4.0));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, -0.95, 0.0), pm_vec(0.0, 1.0, -0.2), 0.7, 8);
    pm_pictures_means want = pm_films_repeat(&s, 2500, 12);
    pm_reference_settings settings = pm_references_settings(8);
    pm_pictures_means eye = pm_references_repeat(&s, settings, 12);
    settings.light_paths = 2500;
    pm_pictures_means got = pm_references_repeat(&s, settings, 12);
    agree(&got, &want);
    // The eye's part is the same in both.
    CHECK(got.mean[PM_LAYER_VOLUME].c[0] > 1.05 * eye.mean[PM_LAYER_VOLUME].c[0]);
    CHECK(eye.mean[PM_LAYER_CAUSTIC].c[0] == 0.0 && got.mean[PM_LAYER_CAUSTIC].c[0] > 0.0);
    pm_scenes_free(&s);
}

static void first_events_are_left_to_eye_paths(void)
{
    pm_scenes s;
    ball_begin(&s, PM_LIGHT_POINT);
    pm_film_pair left = pm_films_of(&s, 2000, false);
    for (int i = 0; i < left.pixels * PM_LAYER_COUNT; i++) {
        CHECK(pm_spectrum_is_black(left.half[0][i]));
    }
    pm_films_free(&left);
    pm_scenes_free(&s);
}

PM_TESTS({"light_tracer_media.1",
          "fog in every kind of light, traced from there, is what eyes find",
          fog_in_every_light_is_what_eyes_find},
         {"light_tracer_media.2",
          "a lamp's caustics in fog and behind it are what eye paths find",
          caustics_in_fog_are_what_eyes_find},
         {"light_tracer_media.3",
          "with light paths the reference has all light that fog scatters, and once",
          the_two_passes_share_the_fog},
         {"light_tracer_media.4", "light that only fog scatters is left to eye paths",
          first_events_are_left_to_eye_paths})
