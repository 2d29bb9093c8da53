// The lab programs on scenes with media: books, replays, dumps, files, and the fluence at a
// point against its closed form.
#include "command.h"
#include "test.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// A ball of fog of radius 2 with a point light of 4 pi W in its middle, over a floor and
/// beside a glass ball, both in the fog; the scene is not centred about it.
static const char foggy[] =
    "<scene version=\"3.0.0\"><default name=\"albedo\" value=\"0.5\"/>"
    "<medium type=\"homogeneous\" id=\"fog\"><float name=\"sigma_t\" value=\"0.7\"/>"
    "<rgb name=\"albedo\" value=\"$albedo\"/></medium>"
    "<shape type=\"sphere\" id=\"rim\"><point name=\"center\" value=\"3 0 0\"/>"
    "<float name=\"radius\" value=\"2\"/><bsdf type=\"null\"/>"
    "<ref name=\"interior\" id=\"fog\"/></shape>"
    "<shape type=\"sphere\" id=\"ball\"><point name=\"center\" value=\"3 0 -1\"/>"
    "<float name=\"radius\" value=\"0.3\"/><bsdf type=\"dielectric\"/></shape>"
    "<shape type=\"rectangle\" id=\"floor\"><transform name=\"to_world\">"
    "<translate x=\"3\" z=\"-1.5\"/></transform></shape>"
    "<emitter type=\"point\" id=\"lamp\"><point name=\"position\" value=\"3 0 0\"/>"
    "<rgb name=\"intensity\" value=\"1 2 4\"/></emitter></scene>";

static char *run(const char *line, const char *output)
{
    pm_test_ran ran = pm_command_run(line, pm_command_write("fog.xml", foggy), output);
    CHECK_THAT(ran.exit_code == 0, "%s: exit code %d: %s", line, ran.exit_code, ran.err);
    char *out = strdup(ran.out);
    CHECK(out != NULL);
    pm_test_ran_free(&ran);
    return out;
}

static json_t *run_json(const char *line, const char *output)
{
    char *out = run(line, output);
    json_error_t error;
    json_t *object = json_loads(out, 0, &error);
    CHECK_THAT(object != NULL, "%s: no JSON: %s", line, error.text);
    free(out);
    return object;
}

/// A value by its keys, one below the other: "by_medium fog incident".
static json_t *find(json_t *object, const char *keys)
{
    char copy[128];
    snprintf(copy, sizeof copy, "%s", keys);
    for (char *key = strtok(copy, " "); key != NULL; key = strtok(NULL, " ")) {
        object = json_object_get(object, key);
        CHECK_THAT(object != NULL, "no key %s of %s", key, keys);
    }
    return object;
}

static double channel(json_t *object, const char *keys, size_t which)
{
    return json_number_value(json_array_get(find(object, keys), which));
}

static char *read_file(const char *path)
{
    FILE *file = fopen(path, "r");
    CHECK(file != NULL && fseek(file, 0, SEEK_END) == 0);
    long bytes = ftell(file);
    rewind(file);
    char *text = calloc((size_t)bytes + 1, 1);
    CHECK(text != NULL && fread(text, 1, (size_t)bytes, file) == (size_t)bytes);
    fclose(file);
    return text;
}

static void tracing_keeps_books_of_media(void)
{
    json_t *object = run_json("tracing {S} -n 5000 --json", "");
    double collisions = json_number_value(find(object, "by_medium fog collisions"));
    CHECK(collisions > 1000.0);
    for (size_t c = 0; c < 3; c++) {
        double incident = channel(object, "by_medium fog incident", c);
        double power = 4.0 * 3.14159265358979 * (double)(1 << c);
        CHECK_NEAR(incident, collisions * power / 5000.0, 1e-6 * incident);
        double absorbed = channel(object, "by_medium fog absorbed", c) +
                          channel(object, "by_shape ball absorbed", c) +
                          channel(object, "by_shape floor absorbed", c);
        CHECK_NEAR(absorbed, channel(object, "flux absorbed", c), 1e-10);
        CHECK_NEAR(channel(object, "flux dispersion", c), 0.0, 0.0);
        CHECK_NEAR(channel(object, "flux dispersion_sd", c), 0.0, 0.0);
    }
    json_decref(object);
    char *lines = run("tracing {S} -n 5000", "");
    CHECK_CONTAINS(lines, "fog: ");
    CHECK_CONTAINS(lines, " collisions, ");
    free(lines);
}

static void replays_and_paths_show_media(void)
{
    // Some of the first eight photons turn in the fog.
    int turned = 0;
    for (int i = 0; i < 8; i++) {
        char line[64];
        snprintf(line, sizeof line, "tracing {S} -n 20 --photon %d", i);
        char *lines = run(line, "");
        turned += strstr(lines, "turns (medium)     fog ") != NULL;
        free(lines);
    }
    CHECK_THAT(turned > 0, "%d photons turned", turned);
    const char *path = pm_command_path("paths.csv");
    free(run("tracing {S} -n 200 --dump {O}", path));
    char *text = read_file(path);
    CHECK_CONTAINS(text, ",V,");
    free(text);
    json_t *object = run_json("tracing {S} -n 20 --photon 0 --json", "");
    json_t *events = find(object, "events");
    CHECK(json_array_size(events) > 0);
    json_decref(object);
}

static void storage_writes_the_volume_map(void)
{
    const char *csv = pm_command_path("photons.csv");
    json_t *object = run_json("storage {S} -n 5000 --json --dump {O}", csv);
    double stored = json_number_value(find(object, "maps volume stored"));
    CHECK(stored > 1000.0 && json_number_value(find(object, "maps volume emitted")) == 5000.0);
    json_decref(object);
    char *text = read_file(csv);
    static const char *const classes[] = {",volume,LV,",   ",volume,LSSV,", ",volume,LDV,",
                                          ",volume,LVV,",  ",global,LVD,",  ",global,LD,",
                                          ",caustic,LSSD,"};
    for (size_t i = 0; i < sizeof classes / sizeof classes[0]; i++) {
        CHECK_CONTAINS(text, classes[i]);
    }
    CHECK(strstr(text, ",caustic,LV") == NULL && strstr(text, ",caustic,LD") == NULL);
    int rows = 0;
    for (const char *row = text; (row = strstr(row, ",volume,")) != NULL; row++) {
        rows++;
    }
    CHECK_NEAR(rows, stored, 0.0);
    free(text);
}

static void files_of_volume_maps_are_checked(void)
{
    free(run("storage {S} -n 2000 -o {O}", pm_command_path("map.ply")));
    char *good = run("storage --check {O}", pm_command_path("map.volume.ply"));
    CHECK_CONTAINS(good, "photons of the volume map, 2000 emitted");
    free(good);
}

static void fluence_is_that_of_the_closed_form(void)
{
    // 1 m from the lamp, fog that only takes light: flux exp(-0.7) / (4 pi 1 m^2).
    static const char line[] = "radiance {S} -D albedo=0 --at 3.6,0.8,0 -n 20000 -k 100 "
                               "--runs 6 --json";
    json_t *object = run_json(line, "");
    CHECK(strcmp(json_string_value(find(object, "medium")), "fog") == 0);
    for (size_t c = 0; c < 3; c++) {
        double want = exp(-0.7) * (double)(1 << c);
        double sd = channel(object, "sd", c) / sqrt(6.0);
        CHECK(sd < 0.1 * want);
        // The ball of 100 photons is about 0.2 m in radius, over which the fluence is bent.
        CHECK_NEAR(channel(object, "fluence", c), want, 5.0 * sd + 0.02 * want);
    }
    json_decref(object);
}

static void refused(const char *line, const char *words)
{
    pm_test_ran ran = pm_command_run(line, pm_command_write("fog.xml", foggy), "");
    pm_command_check_refusal(line, &ran, words);
    pm_test_ran_free(&ran);
}

static void points_without_a_medium_need_a_normal(void)
{
    refused("radiance {S} --at 0,0,0 -n 10",
            "radiance: --at 0,0,0 lies in no medium: on a surface it needs --normal");
    refused("filtering {S} --at 3,1,0 -n 10", "filtering: --at needs --normal X,Y,Z: its");
}

static void programs_count_media(void)
{
    pm_test_ran ran = pm_command_run("render {S} --check", "scenes/glass-fog.xml", "");
    CHECK_CONTAINS(ran.out, " 1 light, 1 medium\n");
    pm_test_ran_free(&ran);
    ran = pm_command_run("render {S} --check --json", "scenes/glass-fog.xml", "");
    json_t *object = json_loads(ran.out, 0, NULL);
    CHECK(json_integer_value(find(object, "media")) == 1);
    json_decref(object);
    pm_test_ran_free(&ran);
    object = run_json("storage {S} -n 500 --volume-photons 70 --json", "");
    CHECK(json_integer_value(find(object, "maps global emitted")) == 500);
    CHECK(json_integer_value(find(object, "maps volume emitted")) == 70);
    json_decref(object);
}

PM_TESTS({"media_programs.1", "tracing keeps books of each medium",
          tracing_keeps_books_of_media},
         {"media_programs.2", "replays and dumped paths show what happened in a medium",
          replays_and_paths_show_media},
         {"media_programs.3", "storage dumps the classes of a volume map",
          storage_writes_the_volume_map},
         {"media_programs.4", "a photon file of a volume map is written and checked",
          files_of_volume_maps_are_checked},
         {"media_programs.5", "the fluence at a point is that of the closed form",
          fluence_is_that_of_the_closed_form},
         {"media_programs.6", "a point without a normal outside all media is refused",
          points_without_a_medium_need_a_normal},
         {"media_programs.7", "media are counted, and photons of their map are set apart",
          programs_count_media})
