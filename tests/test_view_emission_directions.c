// `view directions`: dots lie where photons go, colours are the density that is due, and what
// is counted meets the light's law, unless a mistake was made.
#include "command.h"
#include "ray_tally.h"
#include "rng.h"
#include "scene_read.h"
#include "seen.h"

#include <stdio.h>
#include <stdlib.h>

/// Lights 0 to 4: a bulb of 4 pi W, a spot, a sun, another bulb, a lamp that faces down.
static const char stage[] =
    "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/>"
    "<transform name=\"to_world\"><lookat origin=\"5,5,8\" target=\"5,5,5\" up=\"0,1,0\"/>"
    "</transform></sensor>"
    "<emitter type=\"point\" id=\"bulb\"><point name=\"position\" x=\"5\" y=\"5\" z=\"5\"/>"
    "<rgb name=\"intensity\" value=\"1, 1, 1\"/></emitter>"
    "<emitter type=\"spot\" id=\"spot\"><transform name=\"to_world\"><lookat "
    "origin=\"5,5.4,5\" "
    "target=\"5,5,5\" up=\"0,0,1\"/></transform><float name=\"cutoff_angle\" value=\"20\"/>"
    "<rgb name=\"intensity\" value=\"1, 1, 1\"/></emitter>"
    "<emitter type=\"directional\" id=\"sun\"><vector name=\"direction\" x=\"0\" y=\"-1\" "
    "z=\"0\"/>"
    "<rgb name=\"irradiance\" value=\"1, 1, 1\"/></emitter>"
    "<emitter type=\"point\" id=\"dim\"><point name=\"position\" x=\"5.2\" y=\"5\" z=\"5\"/>"
    "<rgb name=\"intensity\" value=\"0.1, 0.1, 0.1\"/></emitter>"
    "<shape type=\"rectangle\" id=\"plate\"><transform name=\"to_world\"><scale value=\"0.5\"/>"
    "<rotate x=\"1\" angle=\"90\"/><translate x=\"5\" y=\"5.5\" z=\"5\"/></transform>"
    "<emitter type=\"area\" id=\"lamp\"><rgb name=\"radiance\" value=\"1\"/></emitter></shape>"
    "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"0.5\"/>"
    "<rotate x=\"1\" angle=\"-90\"/><translate x=\"5\" y=\"4.5\" z=\"5\"/></transform></shape>"
    "</scene>";

#define RAYS "ox,oy,oz,dx,dy,dz,r,g,b,light\n"
#define FULL "12.566371,12.566371,12.566371" // of the bulb
#define BULB "5,5,5,0.8,0,0.6," FULL ",0\n"
#define LAMP(x, y, z) "5,5.49,5," x "," y "," z ",3.1415927,3.1415927,3.1415927,4\n"

enum { BULB_LIGHT = 0, LAMP_LIGHT = 4 };

static const char *scene_file(void)
{
    return pm_command_write("stage.xml", stage);
}

static pm_seen look(const char *rows, const char *option)
{
    char line[256];
    snprintf(line, sizeof line, "view directions {S} --scene {O} --size 640x480 %s", option);
    return pm_seen_look(line, pm_command_write("rays.csv", rows), scene_file());
}

/// A direction on the first sphere, which stands about the scene's middle: (5, 5, 5).
static const uint8_t *on_sphere(const pm_seen *s, pm_vec3 way)
{
    return pm_seen_pixel(s, 0, pm_vec_along(pm_vec(5.0, 5.0, 5.0), way, 1.01));
}

static void dot_lies_where_the_photon_goes(void)
{
    pm_seen s = look(RAYS BULB, "");
    CHECK_COLOUR(on_sphere(&s, pm_vec(0.8, 0.0, 0.6)), 245.0, 245.0, 245.0, 12.0);
    const uint8_t *full = pm_seen_scale(&s, 0, 1.0);
    CHECK_COLOUR(on_sphere(&s, pm_vec(0.8, 0.36, 0.48)), full[0], full[1], full[2], 12.0);
    CHECK_NEAR(pm_seen_number(&s, "scales.0.high"), 1.0 / (4.0 * PM_PI), 1e-9);
    CHECK_NEAR(pm_seen_number(&s, "scales.0.low"), 0.0, 0.0);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "1 photon");
    // One photon is one band: all of the sphere, and its density the one that is due.
    int x = 0;
    int y = 0;
    pm_seen_chart(&s, 0, 90.0, 1.0 / (4.0 * PM_PI), &x, &y);
    CHECK_COLOUR(pm_seen_at(&s, x, y), 245.0, 245.0, 245.0, 12.0);
    pm_seen_chart(&s, 0, 45.0, 1.0 / (4.0 * PM_PI), &x, &y);
    const uint8_t orange[3] = {230, 159, 0};
    CHECK(pm_seen_near(&s, x, y, 2, orange, 60));
    pm_seen_free(&s);
}

static void colour_is_the_density_due(void)
{
    pm_seen s = look(RAYS LAMP("0", "-1", "0"), "");
    double angle = 52.5 * PM_PI / 180.0; // from the normal, which points down
    const uint8_t *due = pm_seen_scale(&s, 0, cos(angle));
    CHECK_COLOUR(on_sphere(&s, pm_vec(0.0, -cos(angle), sin(angle))), due[0], due[1], due[2],
                 10.0);
    CHECK_COLOUR(on_sphere(&s, pm_vec(0.0, 0.5, sqrt(0.75))), 44.0, 47.0, 58.0, 3.0);
    CHECK_NEAR(pm_seen_number(&s, "scales.0.high"), 1.0 / PM_PI, 1e-9);
    pm_seen_free(&s);
}

/// Two photons of the lamp that carry half its power, one of them upwards.
static void strays_and_missing_power_are_said(void)
{
    static const char rows[] =
        RAYS BULB "5,5.49,5,0,-1,0,0.78539816,0.78539816,0.78539816,4\n"
                  "5,5.49,5,0,0.6,0.8,0.78539816,0.78539816,0.78539816,4\n";
    pm_seen s = look(rows, "--light lamp");
    CHECK(json_array_size(pm_seen_member(&s, "panels")) == 1);
    CHECK_COLOUR(on_sphere(&s, pm_vec(0.0, 0.6, 0.8)), 213.0, 94.0, 0.0, 12.0);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "2 photons, 1 where none is due");
    CHECK_CONTAINS(pm_seen_text(&s, "note"),
                   "50 % of the power of lamp is sent (the rest is dark)");
    CHECK_NEAR(pm_seen_number(&s, "lights.0.strays"), 1.0, 0.0);
    CHECK_NEAR(pm_seen_number(&s, "lights.0.sent"), 0.5, 1e-6);
    CHECK_NEAR(pm_seen_number(&s, "lights.0.density.0"), 0.25 / (2.0 * PM_PI), 1e-6);
    pm_seen_free(&s);
}

static void four_lights_are_shown(void)
{
    static const char rows[] = RAYS BULB "5,5.4,5,0,-1,0,1,1,1,1\n5,6,5,0,-1,0,1,1,1,2\n"
                                         "5.2,5,5,0,0,1,1,1,1,3\n" LAMP("0", "-1", "0");
    pm_seen s = look(rows, "");
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "; 4 of 5 lights, --light picks");
    CHECK(json_array_size(pm_seen_member(&s, "panels")) == 4);
    CHECK(json_array_size(pm_seen_member(&s, "charts")) == 3); // none of the sun
    CHECK_NEAR(pm_seen_number(&s, "lights.2.strays"), 0.0, 0.0);
    pm_seen_free(&s);
    char line[256];
    snprintf(line, sizeof line, "view directions {S} --scene {O} --light dim -o %s",
             pm_command_path("out.png"));
    pm_test_ran ran =
        pm_command_run(line, pm_command_write("rays.csv", RAYS BULB), scene_file());
    pm_command_check_refusal(line, &ran, "rays.csv: holds no photon of the light \"dim\"");
    pm_test_ran_free(&ran);
}

// --- the count ---------------------------------------------------------------------------

/// The largest distance from the law, in standard deviations that a band should have.
static double farthest(const pm_ray_tally *tally)
{
    double most = 0.0;
    double due = 1.0 / tally->bands;
    double deviation = sqrt(due * (1.0 - due) / (double)tally->count);
    for (int i = 0; i < tally->bands; i++) {
        double got =
            tally->density[i] * pm_light_law_solid(tally->border[i], tally->border[i + 1]);
        most = pm_most(most, fabs(got - due) / deviation);
    }
    return most;
}

static void all_kinds_of_lights_meet_their_law(void)
{
    pm_scene scene;
    pm_ray_set rays;
    pm_test_ran ran = pm_command_run("emission {S} -n 20000 --dump {O}", "scenes/lights.xml",
                                     pm_command_path("rays.csv"));
    CHECK_THAT(ran.exit_code == 0, "emission: %s", ran.err);
    pm_test_ran_free(&ran);
    CHECK_OK(pm_scene_read("scenes/lights.xml", NULL, 0, false, &scene));
    CHECK_OK(pm_ray_file_read(pm_command_path("rays.csv"), &scene, &rays));
    for (int i = 0; i < scene.light_count; i++) {
        pm_light_law law = pm_light_law_of(&scene, i);
        pm_ray_tally tally = pm_ray_tally_make(&rays, &law, i, PM_RAY_BANDS_MAX);
        CHECK(tally.count > 100 && tally.bands > 3);
        CHECK_NEAR((double)tally.strays, 0.0, 0.0);
        CHECK_NEAR(tally.sent, 1.0, 1e-6);
        CHECK_THAT(farthest(&tally) < 5.0, "%s is %g standard deviations off its law",
                   scene.lights[i].id, farthest(&tally));
    }
    pm_ray_file_free(&rays);
    pm_scene_free(&scene);
}

/// Directions as a stage may make them: `way` from three numbers.
static pm_ray_tally tally_of(const pm_scene *scene, int light, pm_vec3 (*way)(const double *u))
{
    enum { COUNT = 5000 };
    pm_rng_source source = {.seed = 1, .stream = PM_STREAM_TEST, .pass = 0};
    pm_ray_set rays = {calloc(COUNT, sizeof *rays.rays), COUNT};
    CHECK(rays.rays != NULL);
    for (uint64_t i = 0; i < COUNT; i++) {
        double u[3];
        pm_rng rng = pm_rng_at(&source, i, 0);
        for (int k = 0; k < 3; k++) {
            u[k] = pm_rng_draw(&rng);
        }
        rays.rays[i].light = (uint32_t)light;
        rays.rays[i].direction = way(u);
        rays.rays[i].power = pm_spectrum_scale(scene->lights[light].flux, 1.0 / COUNT);
    }
    pm_light_law law = pm_light_law_of(scene, light);
    pm_ray_tally tally = pm_ray_tally_make(&rays, &law, light, PM_RAY_BANDS_MAX);
    pm_ray_file_free(&rays);
    return tally;
}

/// About -y: the height is uniform over the hemisphere, as without a cosine.
static pm_vec3 without_cosine(const double *u)
{
    double aside = sqrt(1.0 - u[0] * u[0]);
    double phi = 2.0 * PM_PI * u[1];
    return pm_vec(aside * cos(phi), -u[0], aside * sin(phi));
}

static pm_vec3 with_cosine(const double *u)
{
    const double root[2] = {sqrt(u[0]), u[1]};
    return without_cosine(root);
}

static pm_vec3 three_numbers(const double *u)
{
    return pm_vec_normalize(pm_vec(u[0] + 1e-9, u[1], u[2]));
}

static void mistakes_jump_to_the_eye(void)
{
    pm_scene scene;
    CHECK_OK(pm_scene_read(scene_file(), NULL, 0, false, &scene));
    pm_ray_tally good = tally_of(&scene, LAMP_LIGHT, with_cosine);
    pm_ray_tally flat = tally_of(&scene, LAMP_LIGHT, without_cosine);
    pm_ray_tally octant = tally_of(&scene, BULB_LIGHT, three_numbers);
    CHECK_THAT(farthest(&good) < 5.0, "the cosine is %g off", farthest(&good));
    // Uniform over the hemisphere: 1/(2 pi) all over, half of 1/pi about the normal.
    CHECK_NEAR(flat.density[0], 0.5 / PM_PI, 6.0 * flat.error[0]);
    CHECK(flat.density[0] < good.density[0] - 5.0 * good.error[0]);
    CHECK(farthest(&flat) > 15.0);
    // All in one octant: nothing below the equator.
    CHECK(octant.photons[octant.bands - 1] == 0 && farthest(&octant) > 10.0);
    pm_scene_free(&scene);
}

PM_TESTS({"view_directions.1",
          "a dot lies where its photon goes, on the sphere and in the chart",
          dot_lies_where_the_photon_goes},
         {"view_directions.2", "the sphere has the colour of the density that is due",
          colour_is_the_density_due},
         {"view_directions.3", "photons where none is due are red, and power not sent is said",
          strays_and_missing_power_are_said},
         {"view_directions.4", "four of more lights are shown", four_lights_are_shown},
         {"view_directions.5", "photons of all kinds of lights meet their law",
          all_kinds_of_lights_meet_their_law},
         {"view_directions.6", "a forgotten cosine and three random numbers are found out",
          mistakes_jump_to_the_eye})
