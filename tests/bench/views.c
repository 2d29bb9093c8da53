// What pictures cost: views BIN FOLDER, from the top folder. The data are made first and not
// timed; then every kind of picture is made once. Promises are about the wall clock of a
// machine with two cores and nothing else to do; processor time is told beside it. A million
// photons have bounds of their own.
#include "clock.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#define SCENE "scenes/cornell-spheres.xml"
#define LINE_MAX_BYTES 4096
#define ALL_SECONDS 180.0 // of all pictures together

/// In a call, @ stands for the folder and % for that of the programs, which begins it unless it
/// begins with a script.
static const char *const data[] = {
    "storage " SCENE " --global-photons 641000 --caustic-photons 0 -o @/million.ply"
    " --dump @/million.csv",
    "storage " SCENE " -n 100000 -o @/map.ply --dump @/photons.csv",
    "storage " SCENE " -n 50000 --packing off -o @/exact.ply",
    "emission " SCENE
    " -n 20000 --dump @/rays.csv --cells @/cells.csv --report @/emission.json",
    "tracing " SCENE " -n 2000 --dump @/paths.csv",
    "balancing " SCENE " -n 20000 --at 0,-0.99,0 -k 50 -o @/tree.ply --dump @/trees.csv"
    " --visits @/visits.csv",
    "radiance " SCENE " -n 100000 --on floor --grid 100x100 --dump @/grid.csv",
    "radiance " SCENE " -n 100000 -k 500 --at 0.5,-1,0.5 --normal 0,1,0 --gathered @/near.csv",
    "filtering " SCENE
    " -n 100000 -k 200 --at 0.5,-1,0.5 --normal 0,1,0 --gathered @/kernel.csv"
    " --report @/filtering.json",
    "filtering " SCENE " -n 100000 --on floor --grid 100x100 --dump @/edge.csv",
    "filtering " SCENE " -n 1000 --at 0.5,-1,0.5 --normal 0,1,0 --curves @/curves.csv",
    "render " SCENE " --size 200x200 --spp 1 --gather 0 --png @/eye.png -o @/picture.exr",
    "reference " SCENE " --size 200x200 --spp 4 -o @/reference.exr",
    "./visualize/trade_sample.sh % @/trade.json",
};

typedef struct {
    const char *what, *call;
    double seconds;   // promised
    double megabytes; // promised
} picture;

static const picture pictures[] = {
    {"a million photons", "photons @/million.ply --scene " SCENE, 3.0, 700.0},
    {"a million photons, .vtp", "photons @/million.ply --scene " SCENE " -o @/million.vtp", 6.0,
     700.0},
    {"a million photons from a table", "photons @/million.csv --scene " SCENE " --by bounce",
     8.0, 700.0},
    {"photons", "photons @/photons.csv --scene " SCENE " --by map", 4.0, 500.0},
    {"packing", "packing @/exact.ply @/exact.caustic.ply", 4.0, 500.0},
    {"emission", "emission @/rays.csv --scene " SCENE, 4.0, 500.0},
    {"directions", "directions @/rays.csv --scene " SCENE, 4.0, 500.0},
    {"cells", "cells @/cells.csv --scene " SCENE, 4.0, 500.0},
    {"shares", "shares @/emission.json", 4.0, 500.0},
    {"paths", "paths @/paths.csv --scene " SCENE, 4.0, 500.0},
    {"growth", "growth @/paths.csv --scene " SCENE " -o @/growth.webp", 30.0, 500.0},
    {"tree", "tree @/tree.ply --scene " SCENE, 4.0, 500.0},
    {"trees", "trees @/trees.csv @/tree.ply --scene " SCENE, 4.0, 500.0},
    {"search", "search @/visits.csv @/tree.ply --scene " SCENE, 4.0, 500.0},
    {"gather", "gather @/near.csv --scene " SCENE, 4.0, 500.0},
    {"irradiance", "irradiance @/grid.csv --scene " SCENE, 4.0, 500.0},
    {"bias", "bias @/grid.csv --scene " SCENE, 4.0, 500.0},
    {"kernels", "kernels @/curves.csv", 4.0, 500.0},
    {"weights", "weights @/kernel.csv @/filtering.json --scene " SCENE, 4.0, 500.0},
    {"edge", "edge @/edge.csv --scene " SCENE, 4.0, 500.0},
    {"layers", "layers @/picture.exr", 4.0, 500.0},
    {"error", "error @/picture.exr @/reference.exr", 4.0, 500.0},
    {"effort", "effort @/picture.exr", 4.0, 500.0},
    {"trade", "trade @/trade.json", 4.0, 500.0},
    {"contact", "contact @/picture.exr @/reference.exr", 4.0, 500.0},
};

static void expand(const char *bin, const char *folder, const char *call, char *line)
{
    int used = call[0] == '.' ? 0 : snprintf(line, LINE_MAX_BYTES, "%s/", bin);
    for (const char *c = call; *c != '\0' && used < LINE_MAX_BYTES - 1; c++) {
        const char letter[2] = {*c, '\0'};
        const char *piece = *c == '@' ? folder : *c == '%' ? bin : letter;
        used += snprintf(line + used, LINE_MAX_BYTES - (size_t)used, "%s", piece);
    }
}

typedef struct {
    double seconds, cpu, megabytes;
    int code;
} cost;

static double seconds_of(struct timeval t)
{
    return (double)t.tv_sec + 1e-6 * (double)t.tv_usec;
}

/// Runs the line in a process of its own, whose only child it is, so that the memory is its.
static cost measure(const char *line)
{
    int ends[2];
    cost c = {.code = -1};
    if (pipe(ends) != 0) {
        return c;
    }
    pid_t child = fork();
    if (child == 0) {
        struct rusage used;
        double start = pm_seconds_now();
        cost own = {.code = system(line)};
        own.seconds = pm_seconds_now() - start;
        getrusage(RUSAGE_CHILDREN, &used);
        own.cpu = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
        own.megabytes = (double)used.ru_maxrss / 1024.0;
        bool sent = write(ends[1], &own, sizeof own) == (ssize_t)sizeof own;
        _exit(sent ? 0 : 1);
    }
    close(ends[1]);
    if (child < 0 || read(ends[0], &c, sizeof c) != (ssize_t)sizeof c) {
        c.code = -1;
    }
    close(ends[0]);
    waitpid(child, NULL, 0);
    return c;
}

/// False when it fails or breaks its promise.
static bool time_picture(const char *bin, const char *folder, const picture *p, double *seconds)
{
    char call[LINE_MAX_BYTES];
    char line[LINE_MAX_BYTES];
    snprintf(call, sizeof call, "view %s%s", p->call,
             strstr(p->call, " -o ") != NULL ? "" : " -o @/view.png");
    expand(bin, folder, call, line);
    cost c = measure(line);
    *seconds += c.seconds;
    bool kept = c.code == 0 && c.seconds <= p->seconds && c.megabytes <= p->megabytes;
    printf("%-32s %6.2f s of %3.0f (cpu %5.2f) %5.0f MB of %3.0f %s\n", p->what, c.seconds,
           p->seconds, c.cpu, c.megabytes, p->megabytes,
           kept          ? "kept"
           : c.code == 0 ? "MISSED"
                         : "FAILED");
    fflush(stdout);
    return kept;
}

int main(int argc, char **argv)
{
    const char *bin = argc > 1 ? argv[1] : "build/bin";
    const char *folder = argc > 2 ? argv[2] : "build";
    bool kept = true;
    double seconds = 0.0;
    for (size_t i = 0; i < sizeof data / sizeof data[0]; i++) {
        char line[LINE_MAX_BYTES];
        expand(bin, folder, data[i], line);
        strncat(line, " >/dev/null", sizeof line - strlen(line) - 1);
        kept = system(line) == 0 && kept; // what is missing fails again below, by its name
    }
    for (size_t i = 0; i < sizeof pictures / sizeof pictures[0]; i++) {
        kept = time_picture(bin, folder, &pictures[i], &seconds) && kept;
    }
    bool fast = seconds <= ALL_SECONDS;
    printf("%-32s %6.2f s of %3.0f %s\n", "all", seconds, ALL_SECONDS,
           fast ? "kept" : "MISSED");
    return kept && fast ? 0 : 1;
}
