// `view emission` and `view shares`: photons stand where they start, in the colour of their
// light, and all counts are those of the files.
#include "command.h"
#include "emission_report.h"
#include "ray_pick.h"
#include "scene_read.h"
#include "seen.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

/// A room of a wall and a floor about (5, 5, 5), seen along -z, with two bulbs and a sun above.
static const char stage[] =
    "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/>"
    "<transform name=\"to_world\"><lookat origin=\"5,5,8\" target=\"5,5,5\" up=\"0,1,0\"/>"
    "</transform></sensor>"
    "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"0.5\"/>"
    "<translate x=\"5\" y=\"5\" z=\"4.5\"/></transform></shape>"
    "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"0.5\"/>"
    "<rotate x=\"1\" angle=\"-90\"/><translate x=\"5\" y=\"4.5\" z=\"5\"/></transform></shape>"
    "<emitter type=\"point\" id=\"left\"><point name=\"position\" x=\"4.7\" y=\"5.2\" z=\"5\"/>"
    "<rgb name=\"intensity\" value=\"1, 1, 1\"/></emitter>"
    "<emitter type=\"point\" id=\"right\"><point name=\"position\" x=\"5.3\" y=\"5.2\" "
    "z=\"5\"/>"
    "<rgb name=\"intensity\" value=\"1, 1, 1\"/></emitter>"
    "<emitter type=\"directional\" id=\"sun\"><vector name=\"direction\" x=\"0\" y=\"-1\" "
    "z=\"0\"/>"
    "<rgb name=\"irradiance\" value=\"1, 1, 1\"/></emitter></scene>";

#define RAYS "ox,oy,oz,dx,dy,dz,r,g,b,light\n"
#define LEFT RAYS "4.7,5.2,5,0,-1,0,6,6,6,0\n"

static const char *scene_file(void)
{
    return pm_command_write("stage.xml", stage);
}

static pm_seen look(const char *rows, const char *option)
{
    char line[256];
    snprintf(line, sizeof line, "view emission {S} --scene {O} --size 640x480 %s", option);
    return pm_seen_look(line, pm_command_write("rays.csv", rows), scene_file());
}

// Bounds: x and z from 4.5 to 5.5, y from 4.5 to 5.5; the sun's second ray passes beside them.
#define FOUR LEFT "5.3,5.2,5,0,-1,0,6,6,6,1\n5,6.9,5,0,-1,0,1,1,1,2\n6.1,6.9,5,0,-1,0,1,1,1,2\n"

static void photons_stand_where_they_start(void)
{
    pm_seen s = look(FOUR, "");
    // A hand's breadth down the arrow, clear of the word on the light.
    const uint8_t *left = pm_seen_pixel(&s, 0, pm_vec(4.7, 5.11, 5.0));
    const uint8_t *right = pm_seen_pixel(&s, 0, pm_vec(5.3, 5.11, 5.0));
    const uint8_t *neither = pm_seen_pixel(&s, 0, pm_vec(5.15, 5.11, 5.0));
    const uint8_t *sun = pm_seen_pixel(&s, 0, pm_vec(5.0, 5.5 + 0.02 * 0.5 * sqrt(3.0), 5.0));
    CHECK_THAT(left[0] > left[1] + 15 && left[1] > left[2] + 25, "no orange: %d %d %d", left[0],
               left[1], left[2]);
    CHECK_THAT(right[2] > right[1] + 12 && right[1] > right[0] + 20, "no blue: %d %d %d",
               right[0], right[1], right[2]);
    CHECK_THAT(sun[1] > sun[0] + 50 && sun[1] > sun[2] + 15, "no green: %d %d %d", sun[0],
               sun[1], sun[2]);
    CHECK_THAT(neither[0] < 70 && neither[2] < 70, "%d %d %d where no photon is", neither[0],
               neither[1], neither[2]);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "4 photons leave; 1 from outside goes past");
    CHECK_NEAR(pm_seen_number(&s, "drawn"), 3.0, 0.0);
    CHECK_NEAR(pm_seen_number(&s, "lights.2.past"), 1.0, 0.0);
    pm_seen_free(&s);
}

static void one_light_is_seen_alone(void)
{
    pm_seen s = look(FOUR, "--light right");
    const uint8_t *left = pm_seen_pixel(&s, 0, pm_vec(4.7, 5.11, 5.0));
    const uint8_t *right = pm_seen_pixel(&s, 0, pm_vec(5.3, 5.11, 5.0));
    CHECK_THAT(left[0] < 70, "the other light is drawn: %d %d %d", left[0], left[1], left[2]);
    CHECK_THAT(right[2] > 100, "the light is not drawn: %d %d %d", right[0], right[1],
               right[2]);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "1 photon leaves");
    pm_seen_free(&s);
}

static json_t *load(const char *path)
{
    json_t *object = json_load_file(path, 0, NULL);
    CHECK_THAT(object != NULL, "%s: no JSON", path);
    return object;
}

static void counts_are_the_reports(void)
{
    char line[512];
    snprintf(line, sizeof line, "emission {S} -n 400 --dump {O} --report %s",
             pm_command_path("report.json"));
    pm_test_ran ran = pm_command_run(line, "scenes/lights.xml", pm_command_path("rays.csv"));
    CHECK_THAT(ran.exit_code == 0, "emission: %s", ran.err);
    pm_test_ran_free(&ran);
    json_t *report = load(pm_command_path("report.json"));
    pm_seen s = pm_seen_look("view emission {S} --scene {O} --size 640x480",
                             pm_command_path("rays.csv"), "scenes/lights.xml");
    json_t *lights = json_object_get(report, "lights");
    for (size_t i = 0; i < json_array_size(lights); i++) {
        char key[64];
        const json_t *light = json_array_get(lights, i);
        snprintf(key, sizeof key, "lights.%zu.photons", i);
        CHECK_NEAR(pm_seen_number(&s, key),
                   (double)json_integer_value(json_object_get(light, "photons")), 0.0);
        snprintf(key, sizeof key, "lights.%zu.power.1", i);
        double watts = json_number_value(json_array_get(json_object_get(light, "flux"), 1));
        CHECK_NEAR(pm_seen_number(&s, key), watts, 1e-6 * watts);
    }
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "400 photons leave");
    json_decref(report);
    pm_seen_free(&s);
}

static void all_lights_are_thinned_alike(void)
{
    enum { MANY = 10000 };
    pm_light lights[2] = {{.type = PM_LIGHT_POINT}, {.type = PM_LIGHT_POINT}};
    pm_scene scene = {.lights = lights, .light_count = 2, .radius = 1.0};
    pm_ray_set rays = {calloc(MANY, sizeof *rays.rays), MANY};
    CHECK(rays.rays != NULL);
    for (uint32_t i = 0; i < MANY; i++) {
        rays.rays[i].light = i % 2; // a step of 100 through all would meet light 0 alone
    }
    pm_ray_choice choice;
    CHECK_OK(pm_ray_pick(&rays, &scene, PM_NONE, 100, 10, &choice));
    uint64_t of_second = 0;
    for (uint64_t i = 0; i < choice.count; i++) {
        of_second += choice.shown[i].ray->light;
    }
    CHECK_NEAR((double)choice.count, 100.0, 2.0);
    CHECK_NEAR((double)of_second, 50.0, 1.0);
    CHECK_NEAR((double)choice.arrows, 10.0, 2.0);
    pm_ray_pick_free(&choice);
    pm_ray_file_free(&rays);
}

/// The program refuses its input and leaves no picture.
static void check_refused(const char *call, const char *file, const char *part)
{
    char line[512];
    struct stat there;
    snprintf(line, sizeof line, "%s -o %s", call, pm_command_path("out.png"));
    pm_test_ran ran = pm_command_run(line, file, scene_file());
    pm_command_check_refusal(line, &ran, part);
    CHECK(stat(pm_command_path("out.png"), &there) != 0);
    pm_test_ran_free(&ran);
}

static void broken_rays_are_refused(void)
{
    static const struct {
        const char *text, *part;
    } bad[] = {
        {"ox,oy\n", "x.csv:1: the header must be"},
        {RAYS, "x.csv:2: the file holds no ray"},
        {LEFT "4.7,5.2,5,0,-1,0,6,6,0\n", "x.csv:3: a row has 10 fields, got 9"},
        {LEFT "4.7,5.2,5,1,1,1,6,6,6,0\n",
         "x.csv:3: a direction must have the length 1, got 1.73"},
        {LEFT "4.7,5.2,5,nan,1,0,6,6,6,0\n", "x.csv:3: dx must be a finite number"},
        {LEFT "4.7,5.2,5,0,1,0,6,-6,6,0\n", "x.csv:3: g must be >= 0, got -6"},
        {LEFT "4.7,5.2,5,0,1,0,6,6,6,3\n", "x.csv:3: light 3 is not in"},
        {LEFT "4.7,99,5,0,1,0,6,6,6,0\n", "x.csv:3: the point 4.7,99,5 lies far outside"},
        {LEFT "4.7,5.2,5,0,1,0,6,6,6,0", "x.csv:3: the file ends in the middle"},
    };
    pm_scene scene;
    pm_ray_set rays;
    CHECK_OK(pm_scene_read(scene_file(), NULL, 0, false, &scene));
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        const char *file = pm_command_write("x.csv", bad[i].text);
        CHECK_FAILS(pm_ray_file_read(file, &scene, &rays), PM_EINPUT, bad[i].part);
    }
    pm_scene_free(&scene);
    check_refused("view emission {S} --scene {O}", pm_command_write("x.csv", LEFT "1\n"),
                  "x.csv:3: a row has 10 fields, got 1");
    check_refused("view emission {S} --scene {O} --light midle",
                  pm_command_write("x.csv", LEFT), "lights (left, right, sun), got \"midle\"");
}

// --- shares ------------------------------------------------------------------------------

#define LIGHT(id, flux, photons)                                                               \
    "{\"id\": \"" id "\", \"type\": \"point\", \"flux\": [" flux "], \"photons\": " photons "}"
#define REST "], \"power_sum\": [4, 4, 4], \"projection\": {\"cells\": 0, \"active\": 0}}\n"

static void bars_are_as_high_as_the_shares(void)
{
    const char *file = pm_command_write(
        "report.json",
        "{\"lights\": [" LIGHT("a", "3, 2, 4", "30") ", " LIGHT("b", "1, 1, 1", "20") REST);
    pm_seen s = pm_seen_look("view shares {S} --size 640x480", file, NULL);
    const struct {
        double x, height;
        double red, green, blue;
    } bar[] = {{-0.19, 75.0, 230, 159, 0},
               {0.19, 60.0, 86, 180, 233},
               {0.81, 25.0, 230, 159, 0},
               {1.19, 40.0, 86, 180, 233}};
    for (size_t i = 0; i < 4; i++) {
        int x = 0;
        int y = 0;
        pm_seen_chart(&s, 0, bar[i].x, bar[i].height - 2.0, &x, &y);
        CHECK_COLOUR(pm_seen_at(&s, x, y), bar[i].red, bar[i].green, bar[i].blue, 6.0);
        pm_seen_chart(&s, 0, bar[i].x + 0.16, bar[i].height + 1.5, &x, &y);
        CHECK_THAT(pm_seen_at(&s, x, y)[1] < 90, "bar %zu is higher than %g %%", i,
                   bar[i].height);
    }
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "50 photons carry 4 of 4 W");
    pm_seen_free(&s);
}

static void broken_reports_are_refused(void)
{
    static const struct {
        const char *text, *part;
    } bad[] = {
        {"", "x.json:1: this is not JSON"},
        {"{\"lights\": [\n  }\n", "x.json:2: this is not JSON"},
        {"[]\n", "x.json: lights must be a list of lights"},
        {"{\"lights\": [" LIGHT("a", "1, 1", "1") REST, "x.json: lights[].flux must be three"},
        {"{\"lights\": [" LIGHT("a", "1, -1, 1", "1") REST,
         "lights[].flux must be three numbers >="},
        {"{\"lights\": [" LIGHT("a", "1, 1, 1", "-1") REST, "lights[].photons must be a whole"},
        {"{\"lights\": [" LIGHT("a", "0, 0, 0", "0") REST, "no light sends any power"},
        {"{\"lights\": [" LIGHT("a", "1, 1, 1", "1") "]}", "x.json: power_sum must be"},
    };
    pm_emission_report report;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        const char *file = pm_command_write("x.json", bad[i].text);
        CHECK_FAILS(pm_emission_report_read(file, &report), PM_EINPUT, bad[i].part);
    }
    check_refused("view shares {S}", pm_command_write("x.json", "{\"lights\": [\n  }\n"),
                  "x.json:2: this is not JSON");
    check_refused("view shares {S}", pm_command_path("missing.json"),
                  "missing.json: cannot read");
}

PM_TESTS({"view_emission.1", "photons are drawn where they start or come into the scene",
          photons_stand_where_they_start},
         {"view_emission.2", "--light shows one light alone", one_light_is_seen_alone},
         {"view_emission.3", "counts and powers of the lights are the report's",
          counts_are_the_reports},
         {"view_emission.4", "lights that take turns are thinned alike",
          all_lights_are_thinned_alike},
         {"view_emission.5", "broken ray files are refused and leave no picture",
          broken_rays_are_refused},
         {"view_shares.1", "bars are as high as the shares of power and photons",
          bars_are_as_high_as_the_shares},
         {"view_shares.2", "broken reports are refused and leave no picture",
          broken_reports_are_refused})
