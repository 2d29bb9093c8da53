// The CSV of a map: rows against the map itself, paths against events made by hand.
#include "photon_dump.h"
#include "test.h"

#include <stdio.h>
#include <string.h>

static char text[4096];

static const char *read_dump(const char *path)
{
    FILE *file = fopen(path, "r");
    CHECK(file != NULL);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    return text;
}

static void meet(pm_photon_dump *dump, uint32_t bounce, char scatter)
{
    pm_event event = {.kind = PM_EVENT_SURFACE, .scatter = scatter, .bounce = bounce};
    pm_photon_dump_event(dump, NULL, &event);
}

static void deposit(pm_photon_dump *dump, uint32_t bounce, double power)
{
    pm_deposit given = {.position = pm_vec(1.0, 2.0, 3.0),
                        .direction = pm_vec(0.0, 0.0, -1.0),
                        .normal = pm_vec(0.0, 0.0, 1.0),
                        .power = pm_rgb(power, 2.0 * power, 0.0),
                        .bounce = bounce,
                        .light = 4};
    CHECK_OK(pm_photon_dump_deposit(dump, &given));
}

static void rows_spell_paths_and_powers(void)
{
    char path[512];
    snprintf(path, sizeof path, "%s/dump.csv", pm_test_folder());
    pm_scene scene = {.center = pm_vec(100.0, 0.0, 0.0)};
    pm_photon_dump dump;
    CHECK_OK(pm_photon_dump_begin(path, &scene, &dump));
    pm_photon_dump_map(&dump, PM_MAP_GLOBAL, true, 8);
    deposit(&dump, 0, 4.0); // LD
    meet(&dump, 0, 'D');
    deposit(&dump, 1, 2.0); // LDD
    meet(&dump, 1, 0);      // absorbed
    meet(&dump, 0, 'S');    // the next photon
    meet(&dump, 1, 'S');
    deposit(&dump, 2, 1.0);         // LSSD
    deposit(&dump, 2, (double)NAN); // no photon of the map
    pm_photon_dump_map(&dump, PM_MAP_CAUSTIC, true, 2);
    deposit(&dump, 2, 1.0);
    CHECK_OK(pm_photon_dump_commit(&dump));
    pm_photon_dump_free(&dump);
    const char *want = "x,y,z,dx,dy,dz,r,g,b,map,path,bounce,light\n"
                       "101,2,3,0,0,-1,0.5,1,0,global,LD,0,4\n"
                       "101,2,3,0,0,-1,0.25,0.5,0,global,LDD,1,4\n"
                       "101,2,3,0,0,-1,0.125,0.25,0,global,LSSD,2,4\n"
                       "101,2,3,0,0,-1,0.5,1,0,caustic,LSSD,2,4\n";
    const char *got = read_dump(path);
    CHECK_THAT(strcmp(got, want) == 0, "got\n%s", got);
}

static void packed_rows_are_what_the_map_returns(void)
{
    char path[512];
    snprintf(path, sizeof path, "%s/dump.csv", pm_test_folder());
    pm_scene scene = {0};
    pm_photon_dump dump;
    CHECK_OK(pm_photon_dump_begin(path, &scene, &dump));
    pm_photon_dump_map(&dump, PM_MAP_GLOBAL, false, 1);
    deposit(&dump, 0, 1.0);
    CHECK_OK(pm_photon_dump_commit(&dump));
    pm_photon_dump_free(&dump);
    // 64.5 / 64 and 128.5 / 64 by the bytes of (1, 2, 0).
    CHECK_CONTAINS(read_dump(path), ",1.0078125,2.0078125,0,global,LD,0,4\n");
}

static void long_paths_are_kept_whole(void)
{
    char path[512];
    snprintf(path, sizeof path, "%s/dump.csv", pm_test_folder());
    pm_scene scene = {0};
    pm_photon_dump dump;
    CHECK_OK(pm_photon_dump_begin(path, &scene, &dump));
    pm_photon_dump_map(&dump, PM_MAP_GLOBAL, true, 1);
    for (uint32_t bounce = 0; bounce < 1000; bounce++) {
        meet(&dump, bounce, bounce % 2 ? 'D' : 'S');
    }
    deposit(&dump, 1000, 1.0);
    CHECK_OK(pm_photon_dump_commit(&dump));
    pm_photon_dump_free(&dump);
    const char *spelled = strstr(read_dump(path), ",LSDSD");
    CHECK(spelled != NULL && strcspn(spelled + 1, ",") == 1002);
}

PM_TESTS({"photon_dump.1", "rows spell each photon's path and scaled power",
          rows_spell_paths_and_powers},
         {"photon_dump.2", "packed photons are dumped as the map returns them",
          packed_rows_are_what_the_map_returns},
         {"photon_dump.3", "a path of a thousand events is kept whole",
          long_paths_are_kept_whole})
