// The programs of labs 3 to 6 on scenes with a known answer: what they store, find and
// estimate.
#include "command.h"
#include "test.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char square[] = "scenes/square-over-floor.xml"; // 0.752275 W/m^2 below its middle
static const char globe[] = "scenes/integrating-sphere.xml"; // rho 0.6, 4 pi W, radius 1
static const char sparse[] = "scenes/sparse.xml";            // 0.052589 W in its caustic map
static const char open_air[] = "scenes/mesh-spheres.xml";    // one point light over a floor
static const char spheres[] = "scenes/cornell-spheres.xml";  // with a caustic

static char *run(const char *line, const char *scene, const char *output)
{
    pm_test_ran ran = pm_command_run(line, scene, output);
    CHECK_THAT(ran.exit_code == 0, "%s: exit code %d: %s", line, ran.exit_code, ran.err);
    char *out = strdup(ran.out);
    CHECK(out != NULL);
    pm_test_ran_free(&ran);
    return out;
}

static json_t *run_json(const char *line, const char *scene, const char *output)
{
    char *out = run(line, scene, output);
    json_error_t error;
    json_t *object = json_loads(out, 0, &error);
    CHECK_THAT(object != NULL, "%s: no JSON: %s", line, error.text);
    free(out);
    return object;
}

static json_t *key(json_t *object, const char *name)
{
    json_t *value = json_object_get(object, name);
    CHECK_THAT(value != NULL, "no key %s", name);
    return value;
}

static double number(json_t *object, const char *name)
{
    json_t *value = key(object, name);
    CHECK_THAT(json_is_number(value), "%s is no number", name);
    return json_number_value(value);
}

static double channel(json_t *object, const char *name, size_t which)
{
    return json_number_value(json_array_get(key(object, name), which));
}

// --- emission and tracing: where photons are sent
// ---------------------------------------------

/// What is sent and what is not add up to the lights' flux.
static void check_books(json_t *report, json_t *sent, json_t *lights)
{
    json_t *projection = key(report, "projection");
    for (size_t c = 0; c < 3; c++) {
        double flux = 0.0;
        for (size_t i = 0; i < json_array_size(lights); i++) {
            flux += channel(json_array_get(lights, i), "flux", c);
        }
        double dark = channel(projection, "dark", c);
        CHECK_NEAR(json_number_value(json_array_get(sent, c)) + dark, flux, 1e-12 * flux);
    }
    double all = number(projection, "cells");
    double lit = all > 0.0 ? number(projection, "active") / all : 1.0;
    CHECK_NEAR(number(projection, "saved"), 3000.0 / lit - 3000.0, 1.0); // of one light
}

static void aimed_programs_keep_the_books(void)
{
    static const char *const choice[2] = {"on", "off"};
    for (int i = 0; i < 2; i++) {
        char line[80];
        snprintf(line, sizeof line, "emission {S} -n 3000 --projection %s --json", choice[i]);
        json_t *emission = run_json(line, open_air, NULL);
        json_t *lights = key(emission, "lights");
        check_books(emission, key(emission, "power_sum"), lights);
        json_t *projection = key(emission, "projection");
        CHECK((number(projection, "cells") > 0.0) == (i == 0));
        CHECK(number(json_array_get(lights, 0), "photons") == 3000.0);
        CHECK_CONTAINS(json_string_value(key(projection, "why")), i == 0 ? "aimed" : "off");
        snprintf(line, sizeof line, "tracing {S} -n 3000 --projection %s --json", choice[i]);
        json_t *tracing = run_json(line, open_air, NULL);
        check_books(tracing, key(key(tracing, "flux"), "emitted"), lights);
        CHECK(number(tracing, "emitted") == 3000.0);
        json_decref(emission);
        json_decref(tracing);
    }
}

static void closed_rooms_are_not_aimed_in(void)
{
    json_t *on = run_json("emission {S} -n 3000 --json", globe, NULL);
    json_t *off = run_json("emission {S} -n 3000 --projection off --json", globe, NULL);
    CHECK(number(key(on, "projection"), "cells") == 0.0);
    CHECK(number(key(on, "projection"), "active") == 0.0);
    CHECK(json_equal(key(on, "power_sum"), key(off, "power_sum")));
    json_decref(on);
    json_decref(off);
}

static void sparse_caustics_are_found(void)
{
    // The share of the lamp's power that meets the ball, from the scene's head; every photon
    // that the map holds carries the same power.
    enum { COUNT = 40000 };
    double stored[2];
    for (int i = 0; i < 2; i++) {
        char line[80];
        snprintf(line, sizeof line, "storage {S} -n %d --packing off --projection %s --json",
                 COUNT, i == 0 ? "on" : "off");
        json_t *report = run_json(line, sparse, NULL);
        json_t *map = key(key(report, "maps"), "caustic");
        stored[i] = number(map, "stored");
        CHECK(number(map, "emitted") == COUNT);
        CHECK_NEAR(channel(map, "power", 1), 0.052589, 5.0 * 0.052589 / sqrt(stored[i]));
        json_decref(report);
    }
    CHECK_THAT(stored[0] > 50.0 * stored[1], "%g photons aimed, %g unaimed", stored[0],
               stored[1]);
}

// --- storage --------------------------------------------------------------------------------

static void storage_holds_the_power_of_the_globe(void)
{
    // Hits per photon are geometric with mean 1 / (1 - rho), power Phi for each.
    json_t *report = run_json("storage {S} -n 40000 --json", globe, NULL);
    json_t *map = key(key(report, "maps"), "global");
    double stored = number(map, "stored");
    double sigma = sqrt(0.6) / 0.4 * sqrt(40000.0);
    CHECK_NEAR(stored, 40000.0 * 2.5, 5.0 * sigma);
    double bias = channel(key(report, "packing"), "power_bias", 0);
    double per_hit = 4.0 * 3.14159265358979 / 40000.0;
    CHECK_NEAR(channel(map, "power", 0), stored * per_hit * (1.0 + bias),
               stored * per_hit * 1e-6);
    CHECK(fabs(bias) <= 0.5 / 128.0);
    CHECK(number(report, "bytes_per_photon") == 20.0 && number(map, "emitted") == 40000.0);
    CHECK_NEAR(number(key(report, "packing"), "angle_mean_deg"), 0.354, 0.01);
    CHECK(number(key(report, "packing"), "angle_max_deg") < 0.79);
    CHECK(number(key(key(report, "maps"), "caustic"), "emitted") == 0.0); // nothing needs it
    json_decref(report);
    report = run_json("storage {S} -n 4000 --packing off --json", globe, NULL);
    CHECK(number(report, "bytes_per_photon") == 44.0);
    map = key(key(report, "maps"), "global");
    double exact = number(map, "stored") * 4.0 * 3.14159265358979 / 4000.0;
    CHECK_NEAR(channel(map, "power", 0), exact, exact * 1e-6);
    json_decref(report);
}

static void stored_files_check_and_alterations_do_not(void)
{
    const char *path = pm_command_path("map.ply");
    free(run("storage {S} -n 5000 -o {O}", spheres, path));
    json_t *report = run_json("storage --check {O} --json", NULL, path);
    json_t *again = run_json("storage {S} -n 5000 --json", spheres, NULL);
    json_t *map = key(key(report, "maps"), "global");
    CHECK(json_equal(key(map, "power"), key(key(key(again, "maps"), "global"), "power")));
    json_decref(report);
    json_decref(again);
    char *out = run("storage --check {O}", NULL, pm_command_path("map.caustic.ply"));
    CHECK_CONTAINS(out, "photons of the caustic map");
    free(out);
    FILE *file = fopen(path, "r+b");
    CHECK(file != NULL && fseek(file, -5, SEEK_END) == 0);
    int byte = fgetc(file);
    CHECK(fseek(file, -5, SEEK_END) == 0 && fputc(byte ^ 1, file) != EOF && fclose(file) == 0);
    pm_test_ran ran = pm_command_run("storage --check {O}", NULL, path);
    CHECK(ran.exit_code == 2);
    CHECK_CONTAINS(ran.err, "map.ply");
    pm_test_ran_free(&ran);
}

/// LS+D in the caustic map, L(S|D)*D in the global one, as many events as `bounce` says.
static void check_row(const char *row)
{
    char map[16];
    char path[600];
    unsigned bounce;
    unsigned light;
    int read = sscanf(row,
                      "%*[^,],%*[^,],%*[^,],%*[^,],%*[^,],%*[^,],%*[^,],%*[^,],%*[^,],"
                      "%15[^,],%599[^,],%u,%u",
                      map, path, &bounce, &light);
    CHECK_THAT(read == 4, "row %s", row);
    size_t events = strlen(path) - 2;
    CHECK(path[0] == 'L' && path[events + 1] == 'D' && events == bounce && light == 0);
    if (strcmp(map, "caustic") == 0) {
        CHECK_THAT(events > 0 && strspn(path + 1, "S") == events, "path %s", path);
    } else {
        CHECK(strcmp(map, "global") == 0 && strspn(path + 1, "SD") == events + 1);
    }
}

static void dumped_paths_belong_to_their_maps(void)
{
    const char *path = pm_command_path("dump.csv");
    json_t *report = run_json("storage {S} -n 3000 --dump {O} --json", spheres, path);
    double stored = number(key(key(report, "maps"), "global"), "stored") +
                    number(key(key(report, "maps"), "caustic"), "stored");
    json_decref(report);
    FILE *file = fopen(path, "r");
    char row[2048];
    CHECK(file != NULL && fgets(row, sizeof row, file) != NULL);
    CHECK(strcmp(row, "x,y,z,dx,dy,dz,r,g,b,map,path,bounce,light\n") == 0);
    int rows = 0;
    for (; fgets(row, sizeof row, file) != NULL; rows++) {
        check_row(row);
    }
    fclose(file);
    CHECK(rows == (int)stored);
}

// --- balancing ------------------------------------------------------------------------------

static void balancing_counts_its_looks(void)
{
    json_t *report = run_json("balancing {S} -n 20000 -k 50 --json", spheres, NULL);
    double photons = number(report, "photons");
    CHECK(photons > 20000.0 && number(report, "height") == floor(log2(photons)));
    double visited = number(report, "visited_mean");
    CHECK(visited > 50.0 && visited < 50.0 * 8.0);
    CHECK(number(report, "visited_mean_unbalanced") > visited);
    CHECK(number(report, "build_s") > 0.0 && number(report, "queries_per_s") > 0.0);
    json_decref(report);
}

static void balanced_files_say_so(void)
{
    const char *path = pm_command_path("tree.ply");
    free(run("balancing {S} -n 2000 -o {O}", spheres, path));
    char *out = run("storage --check {O}", NULL, path);
    CHECK_CONTAINS(out, ", balanced");
    free(out);
}

// --- radiance and filtering -----------------------------------------------------------------

static void radiance_meets_the_closed_form(void)
{
    json_t *report =
        run_json("radiance {S} -n 50000 -r 0.1 -k 2000 --runs 12 --threads 1 --at 0,0,0 "
                 "--normal 0,0,1 --json",
                 square, NULL);
    double sd = channel(report, "sd", 1);
    double mean = channel(report, "irradiance", 1);
    // Half the kernel's second moment per axis times the Laplacian: less than 0.3 % here.
    CHECK_NEAR(mean, 0.752275, 5.0 * sd / sqrt(12.0) + 0.003 * 0.752275);
    CHECK(sd > 0.0 && sd < 0.1);
    CHECK_NEAR(number(report, "radius"), 0.1, 1e-12);
    double count = 50000.0 * 0.752275 * 0.0314159 / 3.14159;
    CHECK_NEAR(number(report, "found"), count, 5.0 * sqrt(count / 12.0) + 0.003 * count);
    json_decref(report);
}

static void filtering_shows_what_the_lecture_loses(void)
{
    json_t *report =
        run_json("filtering {S} -n 20000 -k 50 --runs 20 --threads 1 --at 0,0,0 --normal 0,0,1 "
                 "--json",
                 square, NULL);
    json_t *filters = key(report, "filters");
    static const char *const names[] = {"none", "cone", "gaussian", "epanechnikov"};
    for (int i = 0; i < 4; i++) {
        json_t *row = key(filters, names[i]);
        double rms = channel(row, "rms", 0);
        CHECK_NEAR(channel(row, "mean", 0), 0.752275, 5.0 * rms / sqrt(19.0) + 0.01);
        CHECK_NEAR(number(row, "mean_weight") / number(row, "normalisation"), 1.0, 1e-6);
    }
    json_t *lecture = key(filters, "gaussian-lecture");
    CHECK_NEAR(number(lecture, "mean_weight"), 0.531155, 1e-6);
    CHECK_NEAR(channel(lecture, "mean", 0) / channel(key(filters, "gaussian"), "mean", 0),
               0.536, 0.01);
    CHECK(number(key(filters, "differential"), "kept") <= 50.0);
    json_decref(report);
}

static void grids_are_dumped_row_by_row(void)
{
    const char *path = pm_command_path("grid.csv");
    free(run("radiance {S} -n 2000 -k 20 --on floor --grid 3x2 --dump {O}", square, path));
    FILE *file = fopen(path, "r");
    char row[512];
    CHECK(file != NULL && fgets(row, sizeof row, file) != NULL);
    CHECK(strcmp(row, "i,j,x,y,z,nx,ny,nz,r,g,b,radius,found\n") == 0);
    for (unsigned n = 0; n < 6; n++) {
        unsigned i;
        unsigned j;
        CHECK(fgets(row, sizeof row, file) != NULL);
        CHECK(sscanf(row, "%u,%u,", &i, &j) == 2 && i == n % 3 && j == n / 3);
    }
    CHECK(fgets(row, sizeof row, file) == NULL);
    fclose(file);
}

static void threads_change_no_byte(void)
{
    static const char *const lines[] = {
        "storage {S} -n 5000 --json", "storage {S} -n 5000 --packing off --json",
        "radiance {S} -n 5000 --runs 3 --on floor --grid 4x4 --json",
        "filtering {S} -n 5000 --on floor --grid 2x2 --json"};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        char line[128];
        snprintf(line, sizeof line, "%s --threads 1", lines[i]);
        char *one = run(line, square, NULL);
        snprintf(line, sizeof line, "%s --threads 7", lines[i]);
        char *seven = run(line, square, NULL);
        CHECK_THAT(strcmp(one, seven) == 0, "%s differs", line);
        free(one);
        free(seven);
    }
}

PM_TESTS({"lab_programs.1", "storage holds the power and the hits of the integrating sphere",
          storage_holds_the_power_of_the_globe},
         {"lab_programs.2", "a stored file checks, an altered one does not",
          stored_files_check_and_alterations_do_not},
         {"lab_programs.3", "dumped paths belong to the maps they are in",
          dumped_paths_belong_to_their_maps},
         {"lab_programs.4", "balancing counts the photons it looks at",
          balancing_counts_its_looks},
         {"lab_programs.5", "a balanced file says that it is", balanced_files_say_so},
         {"lab_programs.6", "radiance below a square light meets the closed form",
          radiance_meets_the_closed_form},
         {"lab_programs.7", "filtering shows what the lecture's Gaussian loses",
          filtering_shows_what_the_lecture_loses},
         {"lab_programs.8", "a grid is dumped row by row", grids_are_dumped_row_by_row},
         {"lab_programs.10", "emission and tracing say what was never sent, aimed or not",
          aimed_programs_keep_the_books},
         {"lab_programs.11", "in a closed room nothing is aimed",
          closed_rooms_are_not_aimed_in},
         {"lab_programs.12", "storage finds the caustic of a sparse scene, as its head says",
          sparse_caustics_are_found},
         {"lab_programs.9", "the number of threads changes no byte", threads_change_no_byte})
