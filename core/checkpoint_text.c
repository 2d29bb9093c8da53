// Settings stand in the order of --help. The camera is no part of the scene's hash, so it has
// one of its own.
#include "checkpoint_text.h"

#include "text.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FAULTS_ROOM 4096

/// The shortest of two ways to write a double that is read back as the same.
static void put_real(pm_text *p, const char *name, double value)
{
    char text[32];
    snprintf(text, sizeof text, "%.15g", value);
    bool exact = strtod(text, NULL) == value;
    pm_text_put(p, "%s %.*g\n", name, exact ? 15 : 17, value);
}

static void put_word(pm_text *p, const char *name, const char *const *words, int which)
{
    pm_text_put(p, "%s %s\n", name, words[which]);
}

/// FNV-1a over little-endian bytes.
static uint64_t add_number(uint64_t hash, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 8; i++) {
        hash ^= (bits >> (8 * i)) & 0xff;
        hash *= UINT64_C(1099511628211);
    }
    return hash;
}

static uint64_t camera_hash(const pm_camera *camera)
{
    const pm_vec3 *const vectors[] = {&camera->position, &camera->right, &camera->up,
                                      &camera->forward};
    uint64_t hash = UINT64_C(14695981039346656037);
    for (int i = 0; i < 4; i++) {
        for (int axis = 0; axis < 3; axis++) {
            hash = add_number(hash, pm_vec_axis(*vectors[i], axis));
        }
    }
    hash = add_number(add_number(hash, camera->tan_x), camera->tan_y);
    return add_number(hash, camera->medium);
}

static void put_photons(pm_text *p, const pm_render_settings *settings)
{
    static const char *const rules[] = {"max", "average"};
    static const char *const on_off[] = {"on", "off"};
    pm_text_put(p, "photons %" PRIu64 "\n", settings->total);
    pm_text_put(p, "global-photons %" PRIu64 "\n", settings->photons[PM_MAP_GLOBAL]);
    pm_text_put(p, "caustic-photons %" PRIu64 "\n", settings->photons[PM_MAP_CAUSTIC]);
    pm_text_put(p, "volume-photons %" PRIu64 "\n", settings->photons[PM_MAP_VOLUME]);
    put_word(p, "roulette", rules, settings->roulette == PM_ROULETTE_MAX ? 0 : 1);
    pm_text_put(p, "max-bounces %" PRIu32 "\n", settings->max_bounces);
    put_word(p, "packing", on_off, settings->unpacked);
    put_word(p, "projection", on_off, settings->everywhere);
}

static void put_estimate(pm_text *p, const pm_estimate_settings *estimate)
{
    static const char *const shapes[] = {"disc", "sphere"};
    static const char *const filters[] = {"none", "cone", "gaussian", "epanechnikov"};
    static const char *const constants[] = {"unbiased", "lecture"};
    pm_text_put(p, "k %" PRIu32 "\n", estimate->k);
    put_real(p, "r", estimate->radius);
    put_word(p, "shape", shapes, (int)estimate->shape);
    put_real(p, "flatness", estimate->flatness);
    put_word(p, "filter", filters, (int)estimate->filter);
    put_word(p, "kernel-constants", constants, (int)estimate->constants);
}

static void put_picture(pm_text *p, const pm_render_settings *settings)
{
    static const char *const direct[] = {"rays", "photons"};
    static const char *const caustics[] = {"map", "global"};
    static const char *const media[] = {"beams", "march"};
    static const char *const off_on[] = {"off", "on"};
    bool all = settings->only == PM_NONE;
    pm_text_put(p, "gather %" PRIu32 "\n", settings->light.rays);
    pm_text_put(p, "spp %" PRIu32 "\n", settings->light.spp);
    pm_text_put(p, "light-samples %" PRIu32 "\n", settings->light.light_samples);
    put_word(p, "direct", direct, settings->direct_photons);
    put_word(p, "caustics", caustics, settings->light.caustics_global);
    put_word(p, "media", media, settings->light.media == PM_MEDIA_MARCH ? 1 : 0);
    put_real(p, "march-step", settings->light.step);
    put_word(p, "precompute", off_on, settings->precompute);
    pm_text_put(p, "only %s\n", all ? "all" : pm_layer_name((pm_layer)settings->only));
}

size_t pm_checkpoint_text_print(const pm_scene *scene, const pm_render_settings *settings,
                                char *text)
{
    pm_text p = {.room = PM_CHECKPOINT_TEXT_ROOM};
    p.start = text;
    pm_text_put(&p, "scene %016" PRIx64 "\n", scene->hash);
    pm_text_put(&p, "camera %016" PRIx64 "\n", camera_hash(&scene->camera));
    pm_text_put(&p, "size %dx%d\n", scene->camera.width, scene->camera.height);
    pm_text_put(&p, "seed %" PRIu32 "\n", settings->seed);
    put_photons(&p, settings);
    put_estimate(&p, &settings->light.estimate);
    put_picture(&p, settings);
    return p.length;
}

/// Whether both first lines, one of which may be empty, have the same name.
static bool same_name(const char *found, const char *wanted)
{
    size_t name = strcspn(wanted, " ");
    return name > 0 && strncmp(found, wanted, name) == 0 && found[name] == ' ';
}

/// The first lines differ in their names: the rest cannot be compared.
static pm_status refuse_name(const char *path, const char *found, const char *wanted)
{
    return pm_status_fail(PM_EINPUT,
                          "%s: says \"%.*s\" where \"%.*s\" belongs: begin another file", path,
                          (int)strcspn(found, "\n"), found, (int)strcspn(wanted, " "), wanted);
}

/// Adds a fault if the first lines, of one name, differ.
static void compare_line(const char *path, const char *found, const char *wanted, char *faults)
{
    size_t used = strlen(faults);
    size_t name = strcspn(wanted, " ");
    size_t line = strcspn(wanted, "\n");
    size_t old = strcspn(found, "\n");
    if (old == line && memcmp(found, wanted, line) == 0) {
        return;
    }
    snprintf(faults + used, FAULTS_ROOM - used,
             "%s%s: its passes were made with %.*s %.*s, this is %.*s: go on with the same, or "
             "begin another file",
             used > 0 ? "\n" : "", path, (int)name, wanted, (int)(old - name - 1),
             found + name + 1, (int)(line - name - 1), wanted + name + 1);
}

pm_status pm_checkpoint_text_compare(const char *path, const char *found, const char *wanted)
{
    char faults[FAULTS_ROOM] = "";
    while (*wanted != '\0' || *found != '\0') {
        if (!same_name(found, wanted)) {
            return refuse_name(path, found, wanted);
        }
        compare_line(path, found, wanted, faults);
        found += strcspn(found, "\n");
        found += *found == '\n' ? 1 : 0;
        wanted += strcspn(wanted, "\n") + 1;
    }
    return faults[0] == '\0' ? PM_OK : pm_status_fail(PM_EINPUT, "%s", faults);
}
