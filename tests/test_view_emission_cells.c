// `view cells`: lit and dark stand where the light's cells are, and are those that emission
// uses.
#include "cell_file.h"
#include "command.h"
#include "light_law.h"
#include "scene_read.h"
#include "seen.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#define CELLS "map,light,flat,row,column,near,far,azimuth,azimuth_end,lit\n"
#define ROW(row, column, near, far, from, to, lit)                                             \
    "global,0,0," row "," column "," near "," far "," from "," to "," lit "\n"
#define UPPER(lit0, lit1)                                                                      \
    ROW("0", "0", "0", "1.5707963", "0", "3.1415927", lit0)                                    \
    ROW("0", "1", "0", "1.5707963", "3.1415927", "6.2831853", lit1)
#define LOWER(lit0, lit1)                                                                      \
    ROW("1", "0", "1.5707963", "3.1415927", "0", "3.1415927", lit0)                            \
    ROW("1", "1", "1.5707963", "3.1415927", "3.1415927", "6.2831853", lit1)

static const double yellow[3] = {240, 228, 66};
static const double dark[3] = {84, 90, 110};

/// The colour of a place of the unrolled square, as parts of its sides.
static void check_unrolled(const pm_seen *s, double across, double down, const double want[3])
{
    int x = (int)(pm_seen_number(s, "maps.0.x") + across * pm_seen_number(s, "maps.0.width"));
    int y = (int)(pm_seen_number(s, "maps.0.y") + down * pm_seen_number(s, "maps.0.height"));
    CHECK_COLOUR(pm_seen_at(s, x, y), want[0], want[1], want[2], 3.0);
}

static void lit_cells_are_bright(void)
{
    const char *file = pm_command_write("cells.csv", CELLS UPPER("0", "1") LOWER("0", "0"));
    pm_seen s = pm_seen_look("view cells {S} --size 640x480", file, NULL);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "light 0; global map: 1 of 4 cells lit");
    check_unrolled(&s, 0.75, 0.25, yellow);
    check_unrolled(&s, 0.25, 0.25, dark);
    check_unrolled(&s, 0.75, 0.75, dark);
    check_unrolled(&s, 0.25, 0.75, dark);
    // On the sphere azimuths count from x to y: the lit quarter has y < 0 and z > 0. It is the
    // one that faces the eye.
    const uint8_t *lit = pm_seen_pixel(&s, 0, pm_vec(0.0, -0.7071, 0.7071));
    const uint8_t *below = pm_seen_pixel(&s, 0, pm_vec(0.0, -0.8, -0.6));
    CHECK_THAT(lit[0] > 200 && lit[1] > 190 && lit[2] < 120, "not lit: %d %d %d", lit[0],
               lit[1], lit[2]);
    CHECK_THAT(below[0] < 120, "not dark: %d %d %d", below[0], below[1], below[2]);
    pm_seen_free(&s);
}

static const char sunny[] = "scenes/mesh-spheres.xml"; // 10,172 of 16,384 cells

static void emit_sunny(void)
{
    char line[1024];
    char report[256];
    char cells[256];
    snprintf(report, sizeof report, "%s", pm_command_path("report.json"));
    snprintf(cells, sizeof cells, "%s", pm_command_path("cells.csv"));
    snprintf(line, sizeof line, "emission {S} -n 500 --dump {O} --cells %s --report %s", cells,
             report);
    pm_test_ran ran = pm_command_run(line, sunny, pm_command_path("rays.csv"));
    CHECK_THAT(ran.exit_code == 0, "emission: %s", ran.err);
    pm_test_ran_free(&ran);
}

static void cells_are_the_reports(void)
{
    emit_sunny();
    json_t *report = json_load_file(pm_command_path("report.json"), 0, NULL);
    json_t *projection = json_object_get(report, "projection");
    json_int_t cells = json_integer_value(json_object_get(projection, "cells"));
    json_int_t active = json_integer_value(json_object_get(projection, "active"));
    pm_seen s = pm_seen_look("view cells {S} --scene {O} --size 640x480",
                             pm_command_path("cells.csv"), sunny);
    CHECK(cells == 16384 && active > 0 && active < cells);
    CHECK_NEAR(pm_seen_number(&s, "maps.0.cells"), (double)cells, 0.0);
    CHECK_NEAR(pm_seen_number(&s, "maps.0.active"), (double)active, 0.0);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "sun; global map: 10,172 of 16,384 cells lit");
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "caustic map: nothing to aim at");
    json_decref(report);
    pm_seen_free(&s);
}

/// Whether the ray starts in a lit cell of the disc across its light.
static bool starts_lit(const pm_cell_map *map, const pm_frame *axis, pm_vec3 from)
{
    double x = pm_vec_dot(from, axis->s);
    double y = pm_vec_dot(from, axis->t);
    double azimuth = atan2(y, x);
    azimuth += azimuth < 0.0 ? 2.0 * PM_PI : 0.0;
    const double slack = 1e-6; // the files have nine digits
    for (uint32_t i = 0; i < map->rows * map->columns; i++) {
        const pm_cell *c = &map->cells[i];
        if (c->lit && hypot(x, y) > c->near - slack && hypot(x, y) < c->far + slack &&
            azimuth > c->azimuth - slack && azimuth < c->azimuth_end + slack) {
            return true;
        }
    }
    return false;
}

static void photons_leave_through_lit_cells(void)
{
    emit_sunny();
    pm_scene scene;
    pm_ray_set rays;
    pm_cell_set cells;
    CHECK_OK(pm_scene_read(sunny, NULL, 0, false, &scene));
    CHECK_OK(pm_ray_file_read(pm_command_path("rays.csv"), &scene, &rays));
    CHECK_OK(pm_cell_file_read(pm_command_path("cells.csv"), &cells));
    CHECK(strcmp(cells.maps[0].map, "global") == 0 && cells.maps[0].flat);
    CHECK(rays.count == 500);
    pm_light_law law = pm_light_law_of(&scene, 0);
    for (uint64_t i = 0; i < rays.count; i++) {
        CHECK_THAT(starts_lit(&cells.maps[0], &law.axis, rays.rays[i].origin),
                   "photon %d starts in the dark", (int)i);
    }
    pm_cell_file_free(&cells);
    pm_ray_file_free(&rays);
    pm_scene_free(&scene);
}

static void broken_cells_are_refused(void)
{
    static const struct {
        const char *text, *part;
    } bad[] = {
        {"map,light\n", "x.csv:1: the header must be"},
        {CELLS, "x.csv:2: the file holds no cell"},
        {CELLS UPPER("0", "2"), "x.csv:3: lit must be a whole number from 0 to 1"},
        {CELLS LOWER("0", "0"), "x.csv:2: cells must stand row by row"},
        {CELLS UPPER("0", "0") ROW("1", "1", "1.57", "3.14", "0", "3", "0"),
         "x.csv:4: cells must stand row by row"},
        {CELLS UPPER("0", "0") ROW("2", "0", "1.57", "3.14", "0", "3", "0"),
         "x.csv:4: cells must stand row by row"},
        {CELLS UPPER("0", "0") ROW("1", "0", "1.57", "3.14", "0", "3", "0"),
         "x.csv:5: the map before ends in the middle of a row"},
        {CELLS ROW("0", "0", "2", "1", "0", "3", "0"), "x.csv:2: a cell must end behind"},
        {CELLS ROW("0", "0", "0", "4", "0", "3", "0"), "x.csv:2: angles are radians"},
        {CELLS ROW("0", "0", "-1", "1", "0", "3", "0"), "x.csv:2: near must be >= 0"},
    };
    pm_cell_set cells;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        const char *file = pm_command_write("x.csv", bad[i].text);
        CHECK_FAILS(pm_cell_file_read(file, &cells), PM_EINPUT, bad[i].part);
    }
    char line[512];
    struct stat there;
    snprintf(line, sizeof line, "view cells {S} -o %s", pm_command_path("out.png"));
    pm_test_ran ran = pm_command_run(line, pm_command_write("x.csv", CELLS), NULL);
    pm_command_check_refusal(line, &ran, "x.csv:2: the file holds no cell");
    CHECK(stat(pm_command_path("out.png"), &there) != 0);
    pm_test_ran_free(&ran);
}

PM_TESTS({"view_cells.1", "lit cells are bright about the light and unrolled",
          lit_cells_are_bright},
         {"view_cells.2", "counts of cells are the report's", cells_are_the_reports},
         {"view_cells.3", "every photon leaves through a cell that is written as lit",
          photons_leave_through_lit_cells},
         {"view_cells.4", "broken cell files are refused and leave no picture",
          broken_cells_are_refused})
