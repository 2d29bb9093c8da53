// Where estimates are asked for: one point, a file, a grid; and every way of asking wrongly.
#include "probe.h"
#include "shapes.h"
#include "test.h"

#include <stdio.h>
#include <string.h>

static pm_shape shapes[2];

/// A floor named "floor" and one named "wall", in a scene centred at (10, 20, 30).
static pm_scene room(void)
{
    shapes[0] = pm_shapes_rectangle(pm_vec(-1.0, -2.0, 0.0), pm_vec(2.0, 0.0, 0.0),
                                    pm_vec(0.0, 4.0, 0.0));
    shapes[0].id = "floor";
    shapes[1] = pm_shapes_rectangle(pm_vec(-1.0, 2.0, 0.0), pm_vec(2.0, 0.0, 0.0),
                                    pm_vec(0.0, 0.0, 1.0));
    shapes[1].id = "wall";
    shapes[1].flipped = true;
    pm_scene scene = pm_shapes_scene(shapes, 2);
    scene.center = pm_vec(10.0, 20.0, 30.0);
    return scene;
}

static const char *write_points(const char *text)
{
    static char path[512];
    snprintf(path, sizeof path, "%s/points.txt", pm_test_folder());
    FILE *file = fopen(path, "w");
    CHECK(file != NULL && fputs(text, file) >= 0 && fclose(file) == 0);
    return path;
}

static void check_vector(pm_vec3 got, double x, double y, double z)
{
    CHECK_NEAR(got.x, x, 1e-14);
    CHECK_NEAR(got.y, y, 1e-14);
    CHECK_NEAR(got.z, z, 1e-14);
}

static void one_point_is_centred(void)
{
    pm_scene scene = room();
    pm_options options = pm_options_defaults();
    options.has_at = options.has_normal = true;
    options.at = pm_vec(10.5, 20.0, 30.0);
    options.normal = pm_vec(0.0, 0.0, 1.0);
    pm_probes probes;
    CHECK_OK(pm_probes_make("lab", &options, &scene, &probes));
    CHECK(probes.count == 1 && probes.columns == 1);
    check_vector(probes.points[0].at, 0.5, 0.0, 0.0);
    check_vector(probes.points[0].normal, 0.0, 0.0, 1.0);
    pm_probes_free(&probes);
}

static void a_file_has_a_point_a_line(void)
{
    pm_scene scene = room();
    pm_options options = pm_options_defaults();
    options.points = write_points("# corners\n10 20 30  0 0 2\n\n11,20,30,3e-320,0,4e-320\r\n");
    pm_probes probes;
    CHECK_OK(pm_probes_make("lab", &options, &scene, &probes));
    CHECK(probes.count == 2 && probes.columns == 2);
    check_vector(probes.points[0].normal, 0.0, 0.0, 1.0);
    check_vector(probes.points[1].at, 1.0, 0.0, 0.0);
    CHECK_NEAR(pm_vec_length(probes.points[1].normal), 1.0, 1e-14);
    CHECK_NEAR(probes.points[1].normal.x, 0.6, 1e-3); // denormal numbers have few digits
    pm_probes_free(&probes);
}

static void a_grid_covers_its_rectangle(void)
{
    pm_scene scene = room();
    pm_options options = pm_options_defaults();
    options.on = "floor";
    options.grid_w = 2;
    options.grid_h = 4;
    pm_probes probes;
    CHECK_OK(pm_probes_make("lab", &options, &scene, &probes));
    CHECK(probes.count == 8 && probes.columns == 2);
    check_vector(probes.points[0].at, -0.5, -1.5, 0.0);
    check_vector(probes.points[1].at, 0.5, -1.5, 0.0);
    check_vector(probes.points[7].at, 0.5, 1.5, 0.0);
    check_vector(probes.points[3].normal, 0.0, 0.0, 1.0);
    pm_probes_free(&probes);
    options.on = "wall"; // turned over
    CHECK_OK(pm_probes_make("lab", &options, &scene, &probes));
    check_vector(probes.points[0].normal, 0.0, 1.0, 0.0);
    pm_probes_free(&probes);
}

static void a_grid_covers_a_part_of_its_rectangle(void)
{
    pm_scene scene = room();
    pm_options options = pm_options_defaults();
    const double part[4] = {0.5, 0.25, 1.0, 0.75};
    options.on = "floor";
    options.grid_w = options.grid_h = 2;
    options.has_part = true;
    memcpy(options.part, part, sizeof part);
    pm_probes probes;
    CHECK_OK(pm_probes_make("lab", &options, &scene, &probes));
    CHECK(probes.count == 4 && probes.columns == 2);
    check_vector(probes.points[0].at, 0.25, -0.5, 0.0);
    check_vector(probes.points[3].at, 0.75, 0.5, 0.0);
    pm_probes_free(&probes);
    options.on = NULL;
    options.grid_w = options.grid_h = 0;
    options.has_at = options.has_normal = true;
    pm_probes none = {0};
    CHECK_FAILS(pm_probes_make("lab", &options, &scene, &none), PM_EINPUT,
                "--part goes with --on only");
}

static void refuse(const pm_options *options, pm_status code, const char *why)
{
    pm_scene scene = room();
    pm_probes probes = {.count = 7};
    CHECK_FAILS(pm_probes_make("lab", options, &scene, &probes), code, why);
    CHECK(probes.count == 7 && probes.points == NULL);
}

static void wrong_ways_of_asking_are_refused(void)
{
    pm_options options = pm_options_defaults();
    refuse(&options, PM_EINPUT, "lab: say where by exactly one of");
    options.has_at = true;
    refuse(&options, PM_EINPUT, "--at needs --normal");
    options.on = "floor";
    refuse(&options, PM_EINPUT, "got 2 of them");
    options.has_at = false;
    refuse(&options, PM_EINPUT, "--on needs --grid");
    options.grid_w = options.grid_h = 2;
    options.on = "flor";
    refuse(&options, PM_EINPUT, "the nearest is \"floor\"");
    options.on = "floor";
    options.has_normal = true;
    refuse(&options, PM_EINPUT, "--normal goes with --at only");
    options.has_normal = false;
    options.on = NULL;
    options.points = "points.txt";
    refuse(&options, PM_EINPUT, "--grid goes with --on only");
}

static void wrong_files_are_refused_line_by_line(void)
{
    pm_options options = pm_options_defaults();
    options.points = "nowhere/points.txt";
    refuse(&options, PM_EIO, "nowhere/points.txt: cannot be opened");
    options.points = pm_test_folder();
    refuse(&options, PM_EIO, "cannot be read");
    options.points = write_points("# nothing\n\n");
    refuse(&options, PM_EINPUT, "holds no point");
    options.points = write_points("0 0 0 0 0 1\n1 2 3\n");
    refuse(&options, PM_EINPUT, "points.txt:2: \"1 2 3\" is not six numbers");
    options.points = write_points("0 0 0 0 0 0\n0 0 nan 0 0 1\n");
    refuse(&options, PM_EINPUT, "points.txt:1: \"0 0 0 0 0 0\" has a normal of length 0");
    options.points = write_points("0 0 0 0 0 1 5\n");
    refuse(&options, PM_EINPUT, "points.txt:1:");
}

PM_TESTS({"probe.1", "a point comes in file coordinates and leaves centred",
          one_point_is_centred},
         {"probe.2", "a file has a point a line, comments and blank lines",
          a_file_has_a_point_a_line},
         {"probe.3", "a grid covers its rectangle row by row", a_grid_covers_its_rectangle},
         {"probe.4", "asking in no way, two ways or half a way is refused",
          wrong_ways_of_asking_are_refused},
         {"probe.5", "a wrong file of points is refused line by line",
          wrong_files_are_refused_line_by_line},
         {"probe.6", "a grid covers the part of its rectangle that is asked for",
          a_grid_covers_a_part_of_its_rectangle})
