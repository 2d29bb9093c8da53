// JSON that programs share: every bit of a double, a fixed order of keys, one object in the
// place that was asked for.
#include "report.h"
#include "test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *path_of(const char *name)
{
    static char path[4096];
    snprintf(path, sizeof path, "%s/%s", pm_test_folder(), name);
    return path;
}

static void check_dump(json_t *value, const char *want)
{
    CHECK(value != NULL);
    char *text = json_dumps(value, JSON_COMPACT | JSON_ENCODE_ANY | JSON_REAL_PRECISION(17));
    CHECK_THAT(strcmp(text, want) == 0, "got  %s\nwant %s", text, want);
    free(text);
    json_decref(value);
}

static void doubles_keep_every_bit(void)
{
    const double values[3] = {1.0 / 3.0, 0.1, 5e-324};
    pm_options options = {.report = path_of("r.json")};
    json_t *object = json_object();
    object =
        pm_report_add(object, "x", pm_report_vector(pm_vec(values[0], values[1], values[2])));
    CHECK_OK(pm_report_end(&options, object));
    json_t *back = json_load_file(path_of("r.json"), 0, NULL);
    CHECK(back != NULL);
    for (size_t i = 0; i < 3; i++) {
        double got = json_real_value(json_array_get(json_object_get(back, "x"), i));
        CHECK_THAT(memcmp(&got, &values[i], sizeof got) == 0, "%.17g came back as %.17g",
                   values[i], got);
    }
    json_decref(back);
}

static void keys_keep_their_order(void)
{
    json_t *object = json_object();
    object = pm_report_add(object, "zebra", json_integer(1));
    object = pm_report_add(object, "apple", pm_report_spectrum(pm_rgb(1.0, 2.0, 0.5)));
    object = pm_report_add(object, "m", json_true());
    check_dump(object, "{\"zebra\":1,\"apple\":[1.0,2.0,0.5],\"m\":true}");
}

static void flux_has_the_keys_of_the_contract(void)
{
    pm_audit audit = {.emitted = pm_gray(4.0),
                      .absorbed = pm_gray(3.0),
                      .escaped = pm_gray(0.75),
                      .lost = pm_gray(0.25),
                      .roulette = pm_rgb(-1.0, 0.0, 1.0),
                      .roulette_variance = pm_rgb(4.0, 9.0, 0.25),
                      .dispersion = pm_rgb(0.5, -0.5, 0.0),
                      .dispersion_variance = pm_rgb(1.0, 0.25, 0.0)};
    check_dump(pm_report_flux(&audit),
               "{\"emitted\":[4.0,4.0,4.0],\"absorbed\":[3.0,3.0,3.0],"
               "\"escaped\":[0.75,0.75,0.75],\"lost\":[0.25,0.25,0.25],"
               "\"roulette\":[-1.0,0.0,1.0],\"roulette_sd\":[2.0,3.0,0.5],"
               "\"dispersion\":[0.5,-0.5,0.0],\"dispersion_sd\":[1.0,0.5,0.0]}");
}

static void plan_says_what_and_why(void)
{
    pm_plan plan = {0};
    for (pm_plan_part part = 0; part < PM_PLAN_COUNT; part++) {
        snprintf(plan.item[part].why, sizeof plan.item[part].why, "reason %d", (int)part);
        plan.item[part].needed = part % 2 == 0;
    }
    static const char *const parts[] = {"direct", "specular",   "caustic",   "indirect",
                                        "volume", "dispersion", "projection"};
    json_t *object = pm_report_plan(&plan);
    CHECK(json_object_size(object) == 7);
    for (int i = 0; i < 7; i++) {
        json_t *item = json_object_get(object, parts[i]);
        char why[32];
        snprintf(why, sizeof why, "reason %d", i);
        CHECK_THAT(item != NULL, "no part %s", parts[i]);
        CHECK(json_is_true(json_object_get(item, "needed")) == (i % 2 == 0));
        CHECK(strcmp(json_string_value(json_object_get(item, "why")), why) == 0);
    }
    CHECK(
        strcmp(json_string_value(json_object_get(json_object_get(object, "caustic"), "paths")),
               "LS+D") == 0);
    CHECK(json_is_null(json_object_get(json_object_get(object, "caustic"), "missing")));
    json_decref(object);
    pm_plan_miss(&plan, PM_PLAN_CAUSTIC, "LS+D is missing");
    object = pm_report_plan(&plan);
    json_t *missing = json_object_get(json_object_get(object, "caustic"), "missing");
    CHECK(strcmp(json_string_value(missing), "LS+D is missing") == 0);
    json_decref(object);
}

static void projections_say_what_they_saved(void)
{
    pm_projections aim = {.cells = 100,
                          .active = 25,
                          .dark = pm_rgb(3.0, 1.5, 0.75),
                          .sent = 0.25,
                          .why = "aimed"};
    check_dump(pm_report_projection(&aim, 1000),
               "{\"cells\":100,\"active\":25,\"dark\":[3.0,1.5,0.75],\"saved\":3000,"
               "\"why\":\"aimed\"}");
}

static void lights_and_shapes_go_by_id(void)
{
    pm_light lights[2] = {{.type = PM_LIGHT_POINT, .id = "bulb", .flux = pm_gray(2.0)},
                          {.type = PM_LIGHT_AREA, .id = "area@7", .flux = pm_gray(1.0)}};
    pm_shape shape = {.id = "floor"};
    pm_scene scene = {.lights = lights, .light_count = 2, .shapes = &shape, .shape_count = 1};
    uint64_t share[2] = {3000000000u, 5};
    check_dump(pm_report_lights(&scene, share),
               "[{\"id\":\"bulb\",\"type\":\"point\",\"flux\":[2.0,2.0,2.0],"
               "\"photons\":3000000000},{\"id\":\"area@7\",\"type\":\"area\","
               "\"flux\":[1.0,1.0,1.0],\"photons\":5}]");
    pm_audit_shape books = {.incident = pm_gray(1.0), .absorbed = pm_gray(0.5)};
    pm_audit audit = {.shapes = &books};
    check_dump(pm_report_by_shape(&scene, &audit),
               "{\"floor\":{\"incident\":[1.0,1.0,1.0],\"absorbed\":[0.5,0.5,0.5]}}");
}

static void media_go_by_id(void)
{
    pm_medium media[2] = {{.id = "fog"}, {.id = "medium@12"}};
    pm_scene scene = {.media = media, .medium_count = 2};
    pm_audit_medium books[2] = {
        {.collisions = 5000000000u, .incident = pm_gray(2.0), .absorbed = pm_gray(0.5)}};
    pm_audit audit = {.media = books};
    check_dump(pm_report_by_medium(&scene, &audit),
               "{\"fog\":{\"collisions\":5000000000,\"incident\":[2.0,2.0,2.0],"
               "\"absorbed\":[0.5,0.5,0.5]},\"medium@12\":{\"collisions\":0,"
               "\"incident\":[0.0,0.0,0.0],\"absorbed\":[0.0,0.0,0.0]}}");
}

static void nan_is_no_json(void)
{
    pm_options options = {.report = path_of("r.json")};
    json_t *object = json_object();
    object = pm_report_add(object, "good", json_integer(1));
    object = pm_report_add(object, "bad", pm_report_spectrum(pm_rgb(1.0, (double)NAN, 1.0)));
    object = pm_report_add(object, "after", json_integer(2));
    CHECK_FAILS(pm_report_end(&options, object), PM_ENOMEM, "a number in it is not finite");
    CHECK_THAT(access(path_of("r.json"), F_OK) != 0, "a report was written all the same");
}

static void a_report_that_cannot_be_written_is_told(void)
{
    pm_options options = {.report = path_of("no/r.json")};
    CHECK_FAILS(pm_report_end(&options, json_object()), PM_EIO,
                "no/r.json: cannot be written: No such file or directory");
}

PM_TESTS({"report.1", "a double comes back from JSON with every bit", doubles_keep_every_bit},
         {"report.9", "media are reported by their ids, collisions beyond 32 bits too",
          media_go_by_id},
         {"report.2", "keys stand in the order in which they were added",
          keys_keep_their_order},
         {"report.3", "flux has the keys of the contract, deviations as roots",
          flux_has_the_keys_of_the_contract},
         {"report.4", "the plan says of each part whether it is needed and why",
          plan_says_what_and_why},
         {"report.8", "a projection says its cells, what was never sent and what that saved",
          projections_say_what_they_saved},
         {"report.5", "lights and shapes go by their ids", lights_and_shapes_go_by_id},
         {"report.6", "NaN fails the report, and no file is written", nan_is_no_json},
         {"report.7", "a report that cannot be written is told by its path",
          a_report_that_cannot_be_written_is_told})
