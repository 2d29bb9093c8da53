// What shadow photons, the global map's caustics, irradiance at photons and projection maps
// save and cost: light BIN FOLDER WHAT, from the top folder; WHAT is direct, caustics,
// precompute or projection. Pictures are made by the programs themselves and compared by
// `compare`; each figure is followed by what it is.
#include "exr.h"

#include <jansson.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/// Where programs are, and where pictures go.
typedef struct {
    const char *bin, *folder;
} bench;

/// Runs a program with --json; the words start with its name.
/// NULL, with a line on standard error, when it fails.
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static json_t *
run(const bench *b, const char *format, ...)
{
    char words[1024];
    char command[2048];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(words, sizeof words, format, arguments);
    va_end(arguments);
    snprintf(command, sizeof command, "'%s'/%s --json", b->bin, words);
    FILE *pipe = popen(command, "r");
    json_t *object = pipe != NULL ? json_loadf(pipe, 0, NULL) : NULL;
    int code = pipe != NULL ? pclose(pipe) : -1;
    if (code != 0 || object == NULL) {
        fprintf(stderr, "%s: failed\n", command);
        json_decref(object);
        return NULL;
    }
    return object;
}

/// A number by its dotted path; NaN where it is missing.
static double number(const json_t *object, const char *dotted)
{
    char key[64];
    while (object != NULL && *dotted != '\0') {
        int length = (int)strcspn(dotted, ".");
        snprintf(key, sizeof key, "%.*s", length, dotted);
        object = json_object_get(object, key);
        dotted += length + (dotted[length] == '.');
    }
    return json_is_number(object) ? json_number_value(object) : (double)NAN;
}

/// rel_mse and mean ratio (green) of one layer of picture `a` against `b`.
typedef struct {
    double rel_mse, ratio;
} error;

static error compare(const bench *b, const char *layer, const char *a, const char *right)
{
    char key[64];
    json_t *object = run(b, "compare '%s/%s.exr' '%s/%s.exr'", b->folder, a, b->folder, right);
    snprintf(key, sizeof key, "layers.%s.rel_mse", layer);
    error found = {.rel_mse = number(object, key)};
    const json_t *part = json_object_get(json_object_get(object, "layers"), layer);
    found.ratio = json_number_value(json_array_get(json_object_get(part, "mean_ratio"), 1));
    json_decref(object);
    return found;
}

/// As a root, in per cent; a negative square means that it is within the reference's noise.
static double percent(double rel_mse)
{
    return rel_mse > 0.0 ? 100.0 * sqrt(rel_mse) : 0.0;
}

static void print(const char *what, double value, const char *unit)
{
    printf("  %-62s %12.5g %s\n", what, value, unit);
}

/// Takes the reference and tells whether there was an object.
static bool done(json_t *object)
{
    json_decref(object);
    return object != NULL;
}

static json_t *run_direct(const bench *b, const char *scene, const char *way, const char *out)
{
    return run(b, "render %s --only direct --size 128x128 --direct %s -o '%s/%s.exr'", scene,
               way, b->folder, out);
}

static bool direct_in(const bench *b, const char *scene)
{
    printf("%s, direct layer, 128x128, 200000 shadow photons\n", scene);
    json_t *rays = run_direct(b, scene, "rays", "rays");
    json_t *photons = run_direct(b, scene, "photons", "photons");
    json_t *again = run_direct(b, scene, "rays --seed 2", "again");
    double shot = number(photons, "direct.rays");
    double spared = number(photons, "direct.spared");
    print("shadow rays, --direct rays", number(rays, "direct.rays"), "");
    print("shadow rays, --direct photons", shot, "");
    print("spared", 100.0 * spared / (shot + spared), "%");
    print("rel_rmse, photons against rays of the same seed",
          percent(compare(b, "direct", "photons", "rays").rel_mse), "%");
    print("rel_rmse, rays against rays of another seed",
          percent(compare(b, "direct", "again", "rays").rel_mse), "%");
    print("seconds of the picture, rays", number(rays, "seconds.total"), "s");
    print("seconds of the picture and the shadow photons, photons",
          number(photons, "seconds.total"), "s");
    bool good = rays != NULL && photons != NULL && again != NULL;
    json_decref(rays);
    json_decref(photons);
    json_decref(again);
    return good;
}

static bool measure_direct(const bench *b)
{
    return direct_in(b, "scenes/cornell-spheres.xml") &&
           direct_in(b, "tests/bench/thin-shadows.xml");
}

static bool measure_caustics(const bench *b)
{
    static const char *const source[] = {"map", "global"};
    const char *scene = "scenes/ring.xml";
    printf("%s, caustic layer, 96x96, 400000 photons in all, against light tracing\n", scene);
    if (!done(run(b,
                  "reference %s --size 96x96 --spp 16 --light-paths 4000000 -o '%s/truth.exr'",
                  scene, b->folder))) {
        return false;
    }
    for (int i = 0; i < 2; i++) {
        json_t *made = run(b,
                           "render %s --only caustic --size 96x96 --photons 400000 "
                           "--caustics %s -o '%s/%s.exr'",
                           scene, source[i], b->folder, source[i]);
        error found = compare(b, "caustic", source[i], "truth");
        printf(" --caustics %s\n", source[i]);
        print("rel_rmse", percent(found.rel_mse), "%");
        print("mean over the reference's, green", found.ratio, "");
        print("seconds", number(made, "seconds.total"), "s");
        if (!done(made)) {
            return false;
        }
    }
    return true;
}

static bool measure_precompute(const bench *b)
{
    static const char *const way[] = {"off", "on"};
    const char *scene = "scenes/cornell-spheres.xml";
    printf("%s, indirect layer, 64x64, gather 64, against the reference\n", scene);
    if (!done(run(b, "reference %s --size 64x64 --spp 512 -o '%s/truth.exr'", scene,
                  b->folder))) {
        return false;
    }
    for (int i = 0; i < 2; i++) {
        json_t *made =
            run(b, "render %s --only indirect --size 64x64 --precompute %s -o '%s/%s.exr'",
                scene, way[i], b->folder, way[i]);
        error found = compare(b, "indirect", way[i], "truth");
        printf(" --precompute %s\n", way[i]);
        print("rel_rmse", percent(found.rel_mse), "%");
        print("mean over the reference's, green", found.ratio, "");
        print("seconds of the irradiance at photons", number(made, "precompute.seconds"), "s");
        print("seconds of the gather", number(made, "seconds.picture"), "s");
        print("searches in the global map", number(made, "gather.lookups"), "");
        if (!done(made)) {
            return false;
        }
    }
    return true;
}

/// Sums over pixels of the caustic layer's green in two pictures: their mean, and the variance
/// of one, half the square of their difference.
static bool add_pair(const bench *b, double *mean, double *variance)
{
    static const char *const name[] = {"one", "other"};
    pm_image image[2] = {0};
    char path[1024];
    bool good = true;
    for (int i = 0; i < 2; i++) {
        snprintf(path, sizeof path, "%s/%s.exr", b->folder, name[i]);
        good = pm_exr_read(path, &image[i]) == PM_OK && good;
    }
    int count = image[0].width * image[0].height;
    for (int i = 0; good && i < count; i++) {
        double one = (double)pm_image_plane(&image[0], "caustic.G")[i];
        double other = (double)pm_image_plane(&image[1], "caustic.G")[i];
        *mean += (one + other) / 2.0 / count;
        *variance += (one - other) * (one - other) / 2.0 / count;
    }
    pm_image_free(&image[0]);
    pm_image_free(&image[1]);
    return good;
}

static bool projection_of(const bench *b, const char *way)
{
    enum { PAIRS = 8 };
    double mean = 0.0;
    double variance = 0.0;
    double saved = 0.0;
    for (int i = 0; i < 2 * PAIRS; i++) {
        json_t *made = run(b,
                           "render scenes/sparse.xml --only caustic --size 32x32 --spp 64 "
                           "-n 50000 -k 50000 -r 0.1 --seed %d --projection %s -o '%s/%s.exr'",
                           i + 1, way, b->folder, i % 2 == 0 ? "one" : "other");
        saved = number(made, "maps.caustic.projection.saved");
        bool good = done(made);
        if (!good || (i % 2 == 1 && !add_pair(b, &mean, &variance))) {
            return false;
        }
    }
    printf(" --projection %s\n", way);
    print("mean of the caustic layer, green", mean / PAIRS, "W/m2/sr");
    print("variance of a pixel", variance / PAIRS, "squared");
    print("photons saved", saved, "");
    return true;
}

static bool measure_projection(const bench *b)
{
    puts("scenes/sparse.xml, caustic layer, 32x32, 50000 photons, estimates of radius 0.1, 16 "
         "seeds");
    return projection_of(b, "off") && projection_of(b, "on");
}

int main(int argc, char **argv)
{
    static const struct {
        const char *name;
        bool (*measure)(const bench *b);
    } table[] = {{"direct", measure_direct},
                 {"caustics", measure_caustics},
                 {"precompute", measure_precompute},
                 {"projection", measure_projection}};
    if (argc != 4) {
        fputs("usage: light BIN FOLDER direct|caustics|precompute|projection\n", stderr);
        return 2;
    }
    bench b = {argv[1], argv[2]};
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        if (strcmp(table[i].name, argv[3]) == 0) {
            return table[i].measure(&b) ? 0 : 1;
        }
    }
    fprintf(stderr, "light: no measure is called %s\n", argv[3]);
    return 2;
}
