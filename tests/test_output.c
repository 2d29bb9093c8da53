// What programs put out: the keys of their JSON, and the same bytes for any number of threads.
#include "command.h"
#include "test.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char scene[] = "scenes/cornell-spheres.xml";

// Keys a program's object must have; a dot leads into an object or an array's first element.
static const struct {
    const char *line, *keys;
} contract[] = {
    {"emission {S} -n 2000 --json",
     "lights.id lights.type lights.flux lights.photons power_sum projection.cells "
     "projection.active"},
    {"tracing {S} -n 2000 --json",
     "emitted deposits deposits_per_photon bounces flux.emitted flux.absorbed flux.escaped "
     "flux.lost flux.roulette flux.roulette_sd flux.dispersion flux.dispersion_sd "
     "by_shape.floor.incident by_shape.floor.absorbed"},
    {"storage {S} -n 2000 --json",
     "bytes_per_photon maps.global.emitted maps.global.stored maps.global.power "
     "maps.caustic.emitted maps.caustic.stored maps.caustic.power maps.volume.emitted "
     "maps.volume.stored maps.volume.power packing.power_bias packing.power_rms "
     "packing.angle_mean_deg packing.angle_max_deg"},
    {"balancing {S} -n 2000 --json",
     "photons height build_s visited_mean visited_mean_unbalanced queries_per_s"},
    {"radiance {S} -n 2000 --at 0,0,0 --normal 0,1,0 --runs 2 --json",
     "irradiance sd radius found"},
    {"filtering {S} -n 2000 --at 0,0,0 --normal 0,1,0 --json",
     "filters.none.mean filters.cone.rms filters.gaussian.normalisation "
     "filters.epanechnikov.mean"},
    {"render {S} --size 8x8 --photons 2000 --gather 1 --spp 1 --json -o {O}",
     "plan.direct.needed plan.direct.why plan.specular plan.caustic plan.indirect plan.volume "
     "plan.dispersion plan.projection.why plan.caustic.paths plan.caustic.missing maps flux "
     "maps.global.projection.cells maps.caustic.projection.active "
     "maps.caustic.projection.dark maps.caustic.projection.saved maps.caustic.projection.why "
     "direct.rays direct.spared gather.near precompute.places precompute.seconds choices "
     "settings.max_bounces settings.only settings.view settings.caps.specular "
     "settings.light_samples settings.direct settings.caustics settings.precompute "
     "settings.projection settings.photons.global seconds.total seconds.shadows "
     "seconds.irradiance peak_bytes"},
    {"render {S} --explain --json",
     "plan.direct.needed plan.direct.why plan.projection.why photons.global photons.caustic "
     "choices not_offered.what not_offered.why"},
    {"reference {S} --size 8x8 --spp 2 --json -o {O}",
     "spp seconds rel_error blind cut settings.seed settings.spp settings.light_paths"},
};

static const json_t *find_key(const json_t *from, const char *dotted)
{
    char key[64];
    while (from && *dotted) {
        int length = (int)strcspn(dotted, ".");
        snprintf(key, sizeof key, "%.*s", length, dotted);
        from = json_is_array(from) ? json_array_get(from, 0) : from;
        from = json_object_get(from, key);
        dotted += length + (dotted[length] == '.');
    }
    return from;
}

static void check_keys(const char *line, const json_t *object, const char *keys)
{
    char key[128];
    for (const char *at = keys; *at;) {
        int length = (int)strcspn(at, " ");
        snprintf(key, sizeof key, "%.*s", length, at);
        CHECK_THAT(find_key(object, key) != NULL, "%s: the key \"%s\" is missing", line, key);
        at += length;
        at += strspn(at, " ");
    }
}

static void have_keys_of_contract(void)
{
    for (size_t i = 0; i < sizeof contract / sizeof contract[0]; ++i) {
        const char *line = contract[i].line;
        pm_test_ran ran = pm_command_run(line, scene, pm_command_path("out.exr"));
        CHECK_THAT(ran.exit_code == 0, "%s: exit code %d: %s", line, ran.exit_code, ran.err);
        json_error_t fault;
        json_t *object = json_loads(ran.out, 0, &fault);
        CHECK_THAT(json_is_object(object), "%s: not one JSON object: %s", line, fault.text);
        check_keys(line, object, contract[i].keys);
        json_decref(object);
        pm_test_ran_free(&ran);
    }
}

static char *read_bytes(const char *path, size_t *length)
{
    FILE *file = fopen(path, "rb");
    CHECK_THAT(file && fseek(file, 0, SEEK_END) == 0, "%s: cannot be read", path);
    *length = (size_t)ftell(file);
    rewind(file);
    char *bytes = malloc(*length + 1);
    CHECK(bytes && fread(bytes, 1, *length, file) == *length);
    fclose(file);
    return bytes;
}

// What may differ between two runs is time and memory.
static void drop_measurements(json_t *object)
{
    static const char *const measured[] = {"seconds", "peak_bytes", "build_s", "queries_per_s",
                                           "threads"};
    for (size_t i = 0; i < sizeof measured / sizeof measured[0]; ++i) {
        json_object_del(object, measured[i]);
    }
    const char *key;
    json_t *value;
    json_object_foreach(object, key, value)
    {
        drop_measurements(value);
    }
}

static char *without_measurements(const char *text, size_t *length)
{
    json_t *object = json_loads(text, 0, NULL);
    CHECK(json_is_object(object));
    drop_measurements(object);
    char *kept = json_dumps(object, 0);
    json_decref(object);
    *length = strlen(kept);
    return kept;
}

// Runs `line` with this number of threads and gives its JSON, or its file {O}.
static char *run_with(const char *line, int threads, size_t *length)
{
    char whole[512];
    char name[32];
    snprintf(whole, sizeof whole, "%s --threads %d", line, threads);
    snprintf(name, sizeof name, "out%d", threads);
    const char *path = pm_command_path(name);
    pm_test_ran ran = pm_command_run(whole, scene, path);
    CHECK_THAT(ran.exit_code == 0, "%s: exit code %d: %s", whole, ran.exit_code, ran.err);
    char *bytes = strstr(line, "--json") ? without_measurements(ran.out, length)
                                         : read_bytes(path, length);
    pm_test_ran_free(&ran);
    return bytes;
}

static const char *const same_lines[] = {
    "render {S} --size 48x48 --photons 20000 --gather 4 --spp 2 -o {O}",
    "render {S} --size 48x48 --photons 20000 --gather 4 --spp 2 --png {O}",
    "render {S} --size 32x32 --photons 5000 --gather 4 --spp 1 --direct photons --precompute "
    "on "
    "--caustics global --projection off -o {O}",
    "reference {S} --size 48x48 --spp 4 -o {O}",
    "storage {S} -n 20000 -o {O}",
    "storage {S} -n 20000 --packing off -o {O}",
    "storage {S} -n 20000 --dump {O}",
    "emission {S} -n 20000 --dump {O}",
    "tracing {S} -n 20000 --dump {O}",
    "tracing {S} -n 20000 --json",
    "balancing {S} -n 20000 --json",
    "radiance {S} -n 20000 --runs 3 --at 0,0,0 --normal 0,1,0 --json",
    "filtering {S} -n 20000 --at 0,0,0 --normal 0,1,0 --json",
    "render {S} --size 48x48 --photons 20000 --gather 4 --spp 2 -o {O} --json",
};

static void give_same_bytes(void)
{
    pm_test_limit(180.0);
    for (size_t i = 0; i < sizeof same_lines / sizeof same_lines[0]; ++i) {
        size_t length = 0;
        char *one = run_with(same_lines[i], 1, &length);
        CHECK(length > 0);
        for (int threads = 2; threads <= 7; threads += 5) {
            size_t other_length = 0;
            char *other = run_with(same_lines[i], threads, &other_length);
            CHECK_THAT(length == other_length && memcmp(one, other, length) == 0,
                       "%s: %d threads give other bytes than one", same_lines[i], threads);
            free(other);
        }
        free(one);
    }
}

static void differ_by_seed(void)
{
    size_t lengths[2];
    char *one = run_with("storage {S} -n 2000 -o {O} --seed 1", 1, &lengths[0]);
    char *two = run_with("storage {S} -n 2000 -o {O} --seed 2", 1, &lengths[1]);
    CHECK(lengths[0] != lengths[1] || memcmp(one, two, lengths[0]) != 0);
    free(one);
    free(two);
}

static void explain_themselves(void)
{
    static const char *const names[] = {"emission",  "tracing",   "storage",
                                        "balancing", "radiance",  "filtering",
                                        "render",    "reference", "compare"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
        char line[64];
        snprintf(line, sizeof line, "%s --help", names[i]);
        pm_test_ran ran = pm_command_run(line, NULL, NULL);
        CHECK_THAT(ran.exit_code == 0 && ran.err[0] == '\0', "%s: exit code %d: %s", line,
                   ran.exit_code, ran.err);
        CHECK_CONTAINS(ran.out, names[i]);
        CHECK_CONTAINS(ran.out, "--seed");
        pm_test_ran_free(&ran);
    }
}

PM_TESTS({"output.1", "each program's JSON is one object with the keys of the contract",
          have_keys_of_contract},
         {"output.2", "1, 2 and 7 threads give the same bytes", give_same_bytes},
         {"output.3", "another seed gives other photons", differ_by_seed},
         {"output.4", "--help explains a program on standard output", explain_themselves})
