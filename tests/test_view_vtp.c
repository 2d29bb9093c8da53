// -o FILE.vtp: the numbers behind a picture, read back by VTK (tests/vtp/print.cc) and compared
// with what was put in by hand. The room's middle is not the origin, so that coordinates of
// another origin would show.
#include "command.h"
#include "room.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/// The file that `view KIND FILE` writes, as VTK reads it. The caller's reference.
static json_t *write_and_read(const char *kind, const char *file, const char *options)
{
    char line[256];
    const char *vtp = pm_command_path("out.vtp");
    pm_command_write("out.vtp", "to be replaced");
    snprintf(line, sizeof line, "view %s {S} --scene {O} %s -o %s", kind, options, vtp);
    pm_test_ran made = pm_command_run(line, file, pm_room_scene());
    CHECK_THAT(made.exit_code == 0 && made.err[0] == '\0', "exit %d: %s", made.exit_code,
               made.err);
    const char *const print[] = {PM_TEST_VTP, vtp, NULL};
    pm_test_ran read = pm_test_run(print, 60.0);
    CHECK_THAT(read.exit_code == 0 && read.err[0] == '\0', "VTK cannot read it: %s", read.err);
    json_t *all = json_loads(read.out, 0, NULL);
    CHECK_THAT(all != NULL, "no JSON: %.200s", read.out);
    pm_test_ran_free(&made);
    pm_test_ran_free(&read);
    return all;
}

static const json_t *array_of(const json_t *all, const char *where, const char *name)
{
    const json_t *array = json_object_get(json_object_get(all, where), name);
    CHECK_THAT(array != NULL, "there is no %s among %s", name, where);
    return array;
}

static double value(const json_t *array, size_t i, size_t component)
{
    const json_t *number = json_array_get(json_array_get(array, i), component);
    CHECK_THAT(json_is_number(number), "entry %zu has no number", i);
    return json_number_value(number);
}

static void check_tuple(const json_t *array, size_t i, const double *want, size_t count,
                        double tolerance)
{
    for (size_t c = 0; c < count; c++) {
        CHECK_NEAR(value(array, i, c), want[c], tolerance);
    }
}

#define ROWS                                                                                   \
    "x,y,z,dx,dy,dz,r,g,b,map,path,bounce,light\n"                                             \
    "5.2,5.3,4.6,0,0,-1,0.5,0.25,0.125,global,LD,0,0\n"                                        \
    "4.9,4.7,5.1,0.6,-0.8,0,1,0,2,global,LSSD,2,0\n"                                           \
    "4.9,4.7,5.1,0.6,-0.8,0,3,0,4,caustic,LSSD,2,0\n"

static void photons_keep_all_their_numbers(void)
{
    static const double place[3][3] = {{5.2, 5.3, 4.6}, {4.9, 4.7, 5.1}, {4.9, 4.7, 5.1}};
    static const double power[3][3] = {{0.5, 0.25, 0.125}, {1, 0, 2}, {3, 0, 4}};
    static const double way[3][3] = {{0, 0, -1}, {0.6, -0.8, 0}, {0.6, -0.8, 0}};
    static const double bounce[3] = {0, 2, 2};
    static const double map[3] = {0, 0, 1};
    const double light = 0.0;
    json_t *all = write_and_read("photons", pm_command_write("p.csv", ROWS), "");
    const json_t *points = json_object_get(all, "points");
    CHECK(json_array_size(points) == 3);
    CHECK(json_is_true(json_object_get(all, "double")));
    CHECK(json_array_size(json_object_get(all, "verts")) == 3);
    for (size_t i = 0; i < 3; i++) {
        check_tuple(points, i, place[i], 3, 1e-7);
        check_tuple(array_of(all, "point_arrays", "power [W]"), i, power[i], 3, 0.0);
        check_tuple(array_of(all, "point_arrays", "direction"), i, way[i], 3, 1e-7);
        check_tuple(array_of(all, "point_arrays", "bounce"), i, &bounce[i], 1, 0.0);
        check_tuple(array_of(all, "point_arrays", "light"), i, &light, 1, 0.0);
        check_tuple(array_of(all, "point_arrays", "map"), i, &map[i], 1, 0.0);
    }
    const json_t *names = array_of(all, "fields", "map names");
    CHECK(strcmp(json_string_value(json_array_get(names, 1)), "caustic") == 0);
    json_decref(all);
}

/// How many entries of an array are numbers.
static size_t count_numbers(const json_t *array)
{
    size_t count = 0;
    for (size_t i = 0; i < json_array_size(array); i++) {
        count += json_is_number(json_array_get(json_array_get(array, i), 0)) ? 1 : 0;
    }
    return count;
}

static void two_kinds_of_things_keep_their_arrays(void)
{
    static const pm_vec3 tall[] = {
        {4.8, 4.5, 4.8}, {5.2, 4.6, 5.2}, {4.9, 4.55, 5.0}, {5.2, 5.4, 4.8}, {4.8, 4.52, 5.2}};
    const char *map = pm_room_map("tree.ply", tall, 5, pm_rgb(1.0, 2.0, 4.0), true);
    json_t *all = write_and_read("tree", map, "--depth 1");
    CHECK(json_array_size(json_object_get(all, "points")) == 5 + 4);
    CHECK(json_array_size(json_object_get(all, "polys")) == 1);
    CHECK(count_numbers(array_of(all, "point_arrays", "power [W]")) == 5);
    const json_t *axis = array_of(all, "cell_arrays", "axis");
    const json_t *kind = array_of(all, "cell_arrays", "kind");
    CHECK(json_array_size(axis) == 6 && json_array_size(kind) == 6);
    for (size_t i = 0; i < 5; i++) { // dots come before faces; a photon has no axis
        CHECK_NEAR(value(axis, i, 0), -1.0, 0.0);
    }
    CHECK_NEAR(value(axis, 5, 0), 1.0, 0.0);
    CHECK(fabs(value(kind, 0, 0) - value(kind, 5, 0)) > 0.5);
    json_decref(all);
}

static void paths_are_lines(void)
{
    const char *csv = pm_command_write("paths.csv", "photon,step,event,x,y,z,r,g,b\n"
                                                    "7,0,L,4.6,5.4,5,1,2,3\n"
                                                    "7,1,D,5.3,5.4,5,1,1,1\n"
                                                    "7,2,A,5.3,4.7,5,0,0,0\n");
    static const double corner[3] = {5.3, 4.7, 5.0};
    static const double sent[3] = {1.0, 2.0, 3.0};
    const double number = 7.0;
    json_t *all = write_and_read("paths", csv, "");
    const json_t *lines = json_object_get(all, "lines");
    CHECK(json_array_size(lines) == 1 && json_array_size(json_array_get(lines, 0)) == 3);
    check_tuple(json_object_get(all, "points"), 2, corner, 3, 1e-7);
    check_tuple(array_of(all, "point_arrays", "power [W]"), 0, sent, 3, 1e-7);
    check_tuple(array_of(all, "cell_arrays", "photon"), 0, &number, 1, 0.0);
    json_decref(all);
}

static void a_picture_without_data_is_refused(void)
{
    const pm_vec3 none = {5.0, 5.0, 5.0};
    const char *map = pm_room_map("none.ply", &none, 0, pm_gray(1.0), false);
    char line[256];
    struct stat there;
    snprintf(line, sizeof line, "view photons {S} --scene {O} -o %s",
             pm_command_path("none.vtp"));
    pm_test_ran ran = pm_command_run(line, map, pm_room_scene());
    pm_command_check_refusal("photons", &ran, "none.vtp: there are no numbers in space");
    CHECK(stat(pm_command_path("none.vtp"), &there) != 0);
    pm_test_ran_free(&ran);
}

static void the_same_data_are_the_same_bytes(void)
{
    char line[512];
    const char *csv = pm_command_write("p.csv", ROWS);
    snprintf(line, sizeof line, "view photons {S} --scene {O} -o %s", pm_command_path("b.vtp"));
    json_decref(write_and_read("photons", csv, ""));
    pm_test_ran again = pm_command_run(line, csv, pm_room_scene());
    CHECK(again.exit_code == 0);
    const char *const compare[] = {"/usr/bin/cmp", pm_command_path("out.vtp"),
                                   pm_command_path("b.vtp"), NULL};
    pm_test_ran compared = pm_test_run(compare, 10.0);
    CHECK_THAT(compared.exit_code == 0, "%s", compared.out);
    pm_test_ran_free(&again);
    pm_test_ran_free(&compared);
}

PM_TESTS({"view_vtp.1", "photons keep place, power, direction, bounce, light and map",
          photons_keep_all_their_numbers},
         {"view_vtp.2", "a file of split planes and photons has the arrays of both",
          two_kinds_of_things_keep_their_arrays},
         {"view_vtp.3", "a path is one line with its events' powers", paths_are_lines},
         {"view_vtp.4", "a picture without data behind it is refused and leaves no file",
          a_picture_without_data_is_refused},
         {"view_vtp.5", "the same data give the same bytes", the_same_data_are_the_same_bytes})
