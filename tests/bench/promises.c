// Speed and memory against what photonlab promises: promises BIN, from the top folder. Rates of
// one core are taken from CPU time, so that other work on the machine hardly disturbs them; the
// picture is timed on the wall.
#include "balance.h"
#include "clock.h"
#include "photon_map.h"
#include "photon_pass.h"
#include "rng.h"
#include "scene_read.h"
#include "store.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char scene_path[] = "scenes/cornell-spheres.xml";

typedef struct {
    const char *what, *unit;
    double promised;
    bool at_least; // the promise is a lower bound, else an upper one
} promise;

static void print_measure(promise p, double measured)
{
    double ratio = p.at_least ? measured / p.promised : p.promised / measured;
    printf("%-46s %12.4g %-9s %s %8.4g %8.2fx %s\n", p.what, measured, p.unit,
           p.at_least ? "at least" : "at most ", p.promised, ratio,
           ratio >= 1.0 ? "kept" : "MISSED");
}

// A field of /proc/self/status in bytes: "VmRSS" now, "VmHWM" at its highest.
static double memory(const char *field)
{
    char line[256];
    double bytes = 0.0;
    FILE *file = fopen("/proc/self/status", "r");
    while (file && fgets(line, sizeof line, file)) {
        if (strncmp(line, field, strlen(field)) == 0) {
            bytes = 1024.0 * strtod(line + strlen(field) + 1, NULL);
        }
    }
    if (file) {
        fclose(file);
    }
    return bytes;
}

static pm_status trace(uint64_t count, pm_photon_map *map, double *cpu_seconds)
{
    pm_scene scene;
    pm_intersector world;
    PM_TRY(pm_scene_read(scene_path, NULL, 0, false, &scene));
    pm_status status = pm_intersect_embree(&scene, &world);
    if (status == PM_OK) {
        pm_pass_settings settings = {.seed = 1, .count = count};
        double start = pm_cpu_seconds_now();
        status = pm_photon_pass(&world, PM_MAP_GLOBAL, &settings, map, NULL);
        *cpu_seconds = pm_cpu_seconds_now() - start;
        pm_intersector_free(&world);
    }
    pm_scene_free(&scene);
    return status;
}

// Memory first: nothing big has been allocated and freed yet, so all growth is the pass's.
static pm_status measure_pass(void)
{
    static const promise memory_promise = {"memory while tracing / of the finished map",
                                           "times", 1.5, false};
    static const promise speed = {"photon pass, cornell-spheres, one core", "photons/s", 4e5,
                                  true};
    const uint64_t count = 4000000;
    pm_photon_map map = {0};
    double seconds = 0.0;
    double before = memory("VmRSS");
    PM_TRY(trace(count, &map, &seconds));
    print_measure(memory_promise,
                  (memory("VmHWM") - before) / (double)pm_photon_map_bytes(&map));
    print_measure(speed, (double)count / seconds);
    pm_photon_map_free(&map);
    return PM_OK;
}

static pm_status fill_at_random(pm_photon_map *map, uint32_t count)
{
    const pm_rng_source source = {.seed = 1, .stream = PM_STREAM_TEST};
    for (uint32_t i = 0; i < count; ++i) {
        pm_rng rng = pm_rng_at(&source, i, 0);
        double x = pm_rng_draw(&rng);
        double y = pm_rng_draw(&rng);
        double z = pm_rng_draw(&rng);
        pm_deposit deposit = {.position = {x, y, z},
                              .direction = {0.0, 0.0, -1.0},
                              .normal = {0.0, 0.0, 1.0},
                              .power = pm_gray(1.0)};
        PM_TRY(pm_store_push(map, &deposit));
    }
    return pm_store_scale(map, count);
}

static pm_status measure_tree(void)
{
    static const promise speed = {"tree over 1,000,000 photons, one core", "s", 0.5, false};
    pm_photon_map map = {0};
    pm_status status = fill_at_random(&map, 1000000);
    double start = pm_cpu_seconds_now();
    if (status == PM_OK) {
        status = pm_balance_build(&map);
    }
    if (status == PM_OK) {
        print_measure(speed, pm_cpu_seconds_now() - start);
    }
    pm_photon_map_free(&map);
    return status;
}

static pm_status measure_picture(const char *bin)
{
    static const promise speed = {"picture 256x256, 300,000 photons, k 100, 2 cores", "s", 15.0,
                                  false};
    char line[1024];
    snprintf(line, sizeof line,
             "'%s/render' %s --size 256x256 --global-photons 200000 --caustic-photons 100000"
             " -k 100 --gather 0 --threads 2 -o build/bench.exr >/dev/null",
             bin, scene_path);
    double start = pm_seconds_now();
    if (system(line) != 0) {
        return PM_FAIL(PM_EIO, "%s: failed", line);
    }
    print_measure(speed, pm_seconds_now() - start);
    return PM_OK;
}

int main(int argc, char **argv)
{
    pm_status status = measure_pass();
    if (status == PM_OK) {
        status = measure_tree();
    }
    if (status == PM_OK) {
        status = measure_picture(argc > 1 ? argv[1] : "build/bin");
    }
    if (status != PM_OK) {
        fprintf(stderr, "%s\n", pm_status_message());
    }
    return pm_status_exit_code(status);
}
