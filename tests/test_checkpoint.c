// Checkpoints: back as they were, and refused when altered, cut, of another version, or of
// other work.
#include "bytes.h"
#include "checkpoint.h"
#include "command.h"
#include "pictures.h"
#include "shapes.h"
#include "test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { SIDE = 4, STRIDE = 97 };

typedef struct {
    pm_scenes s;
    pm_render_settings settings;
    pm_progressive done;
} work;

/// A room with a mirror ball.
static void begin(work *w)
{
    *w = (work){0};
    pm_scenes_begin(&w->s);
    pm_scenes_room(&w->s, 1.0, pm_scenes_diffuse(&w->s, pm_rgb(0.6, 0.5, 0.4)));
    pm_scenes_wear(&w->s, pm_shapes_sphere(pm_vec(0.2, 0.1, -0.5), 0.3),
                   pm_scenes_mirror(&w->s, pm_gray(0.9)));
    pm_scenes_point(&w->s, pm_vec(-0.2, 0.0, 0.6), pm_gray(1.0));
    pm_scenes_ready(&w->s);
    w->s.scene.hash = 0x1234;
    pm_pictures_look(&w->s, pm_vec(-0.9, -0.9, 0.2), pm_vec(0.2, 0.1, -0.6), 0.8, SIDE);
    w->settings = pm_pictures_settings();
    w->settings.photons[PM_MAP_GLOBAL] = w->settings.photons[PM_MAP_CAUSTIC] = 300;
    w->settings.light.spp = 1;
    w->settings.light.light_samples = 1;
    w->settings.light.estimate.k = 20;
}

static void end(work *w)
{
    pm_progressive_free(&w->done);
    pm_scenes_free(&w->s);
}

static void do_passes(work *w, uint32_t passes)
{
    while (w->done.passes < passes) {
        pm_render_maps maps = {0};
        CHECK_OK(pm_progressive_pass(&w->s.world, &w->settings, &w->done, &maps));
        pm_render_maps_free(&maps);
    }
}

static pm_status write_to(const work *w, const char *path)
{
    return pm_checkpoint_write(path, &w->s.scene, &w->settings, &w->done);
}

static pm_status read_from(const work *w, const char *path, pm_progressive *progressive)
{
    return pm_checkpoint_read(path, &w->s.scene, &w->settings, progressive);
}

/// Forgets the sums and takes those of the file.
static void resume(work *w, const char *path)
{
    CHECK_OK(write_to(w, path));
    pm_progressive_free(&w->done);
    CHECK_OK(read_from(w, path, &w->done));
}

static void check_same(const pm_progressive *a, const pm_progressive *b)
{
    size_t count = (size_t)a->width * (size_t)a->height * (size_t)PM_SUM_PLANES;
    CHECK(a->passes == b->passes && a->width == b->width && a->height == b->height);
    CHECK(memcmp(a->sum, b->sum, count * sizeof *a->sum) == 0);
    CHECK(a->eye.lookups == b->eye.lookups && a->eye.shadow_rays == b->eye.shadow_rays);
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        const pm_progressive_map *one = &a->map[kind];
        const pm_progressive_map *other = &b->map[kind];
        CHECK_NEAR(one->first, other->first, 0.0);
        CHECK(memcmp(&one->sum, &other->sum, sizeof one->sum) == 0);
        CHECK(one->pass.emitted == other->pass.emitted);
        CHECK(one->pass.deposits == other->pass.deposits);
        CHECK(one->pass.audit.events == other->pass.audit.events);
        CHECK(memcmp(one->pass.audit.bounces, other->pass.audit.bounces,
                     sizeof one->pass.audit.bounces) == 0);
        CHECK_NEAR(one->pass.audit.absorbed.c[2], other->pass.audit.absorbed.c[2], 0.0);
        CHECK_NEAR(one->pass.audit.roulette_variance.c[0],
                   other->pass.audit.roulette_variance.c[0], 0.0);
        CHECK_NEAR(one->pass.audit.largest, other->pass.audit.largest, 0.0);
    }
}

static void sums_come_back_and_go_on(void)
{
    work whole;
    work parts;
    begin(&whole);
    begin(&parts);
    do_passes(&whole, 9);
    static const uint32_t stops[] = {1, 2, 5, 8, 9};
    for (int i = 0; i < 5; i++) {
        do_passes(&parts, stops[i]);
        resume(&parts, pm_command_path("a.checkpoint"));
        resume(&parts, pm_command_path("a.checkpoint"));
    }
    check_same(&whole.done, &parts.done);
    CHECK(pm_command_count_files() == 1);
    pm_render_maps maps = {0};
    CHECK_OK(pm_progressive_books(&parts.s.scene, &parts.settings, &parts.done, &maps));
    CHECK_OK(pm_audit_check(&maps.pass[PM_MAP_GLOBAL].audit));
    pm_render_maps_free(&maps);
    end(&whole);
    end(&parts);
}

// --- the file --------------------------------------------------------------------------------

typedef struct {
    uint8_t *bytes;
    size_t count;
    const char *path;
} saved;

static saved save(const work *w)
{
    saved file = {.path = pm_command_path("b.checkpoint")};
    CHECK_OK(write_to(w, file.path));
    file.bytes = pm_bytes_read(file.path, &file.count);
    return file;
}

static void altered_bytes_are_refused(void)
{
    work w;
    begin(&w);
    do_passes(&w, 2);
    saved file = save(&w);
    pm_progressive back = {0};
    CHECK(file.count > 40 * (size_t)STRIDE);
    for (size_t i = 0; i < file.count; i += i < 8 || i + 8 > file.count ? 1 : STRIDE) {
        file.bytes[i] = (uint8_t)(file.bytes[i] ^ 4);
        pm_bytes_write(file.path, file.bytes, file.count);
        CHECK_FAILS(read_from(&w, file.path, &back), PM_EINPUT, file.path);
        file.bytes[i] = (uint8_t)(file.bytes[i] ^ 4);
    }
    CHECK(back.sum == NULL && back.passes == 0);
    pm_bytes_write(file.path, file.bytes, file.count);
    CHECK_OK(read_from(&w, file.path, &back));
    pm_progressive_free(&back);
    file.bytes[file.count / 2] = (uint8_t)(file.bytes[file.count / 2] + 1);
    pm_bytes_write(file.path, file.bytes, file.count);
    CHECK_FAILS(read_from(&w, file.path, &back), PM_EINPUT, "is cut or altered: its CRC-32 is");
    free(file.bytes);
    end(&w);
}

static void cut_files_are_refused(void)
{
    work w;
    begin(&w);
    do_passes(&w, 1);
    saved file = save(&w);
    pm_progressive back = {0};
    for (size_t count = 0; count < file.count; count += count + 8 < file.count ? STRIDE : 1) {
        pm_bytes_write(file.path, file.bytes, count);
        CHECK_FAILS(read_from(&w, file.path, &back), PM_EINPUT, file.path);
    }
    pm_bytes_write(file.path, file.bytes, file.count - 1);
    CHECK_FAILS(read_from(&w, file.path, &back), PM_EINPUT, "is cut or altered");
    FILE *stream = fopen(file.path, "wb");
    CHECK(stream != NULL && fwrite(file.bytes, 1, file.count, stream) == file.count);
    CHECK(fputc('x', stream) == 'x' && fclose(stream) == 0);
    CHECK_FAILS(read_from(&w, file.path, &back), PM_EINPUT, "is cut or altered");
    free(file.bytes);
    end(&w);
}

static void what_is_no_checkpoint_is_refused(void)
{
    work w;
    begin(&w);
    pm_progressive back = {0};
    CHECK_FAILS(read_from(&w, pm_command_write("a", ""), &back), PM_EINPUT, "no checkpoint");
    CHECK_FAILS(read_from(&w, pm_command_write("a", "ply\nformat"), &back), PM_EINPUT,
                "no checkpoint of photonlab");
    CHECK_FAILS(read_from(&w, pm_command_write("a", "photonlab checkpoint version 7\n"), &back),
                PM_EINPUT, "another version, this program goes on with version 1 only");
    CHECK_FAILS(read_from(&w, pm_command_path("missing"), &back), PM_EIO, "missing");
    CHECK_FAILS(read_from(&w, pm_test_folder(), &back), PM_EIO, "directory");
    do_passes(&w, 1);
    CHECK_FAILS(write_to(&w, pm_command_path("no/such/file")), PM_EIO, "no/such/file");
    end(&w);
}

/// The file with `cut` bytes after `place` replaced by text, and a CRC-32 that fits.
static void rewrite(const saved *file, const char *place, size_t cut, const char *text)
{
    size_t at = 0;
    while (memcmp(file->bytes + at, place, strlen(place)) != 0) {
        at++;
        CHECK(at + strlen(place) < file->count);
    }
    at += strlen(place);
    size_t count = file->count - cut + strlen(text);
    uint8_t *bytes = malloc(count);
    CHECK(bytes != NULL && cut < file->count - at);
    memcpy(bytes, file->bytes, at);
    memcpy(bytes + at, text, strlen(text));
    memcpy(bytes + at + strlen(text), file->bytes + at + cut, file->count - at - cut);
    uint32_t crc = (uint32_t)crc32(0, bytes, (uInt)(count - 4));
    for (size_t i = 0; i < 4; i++) {
        bytes[count - 4 + i] = (uint8_t)(crc >> (8 * i));
    }
    pm_bytes_write(file->path, bytes, count);
    free(bytes);
}

/// Files of other programs, whole in themselves.
static void other_contents_are_refused_in_a_line(void)
{
    static const struct {
        const char *place;
        size_t cut;
        const char *text, *words;
    } others[] = {
        {"seed 1\n", 10, "", "says \"global-photons 300\" where \"photons\""},
        {"seed 1\n", 0, "hue 7\n", "says \"hue 7\" where \"photons\" belongs"},
        {"only all\n", 0, "hue 7\n", "says \"hue 7\" where \"\" belongs"},
        {"march-step 0", 1, "", "says \"only all\" where \"precompute\" belongs"},
        {"only all\n\n", 5, "\1\1\1\1\1", " passes, from 1 to 268435455 can be"},
        {"only all\n\n", 8, "", "holds fewer numbers than its picture has"},
        {"only all\n\n", 0, "12345678", "numbers than its picture has"},
    };
    work w;
    begin(&w);
    do_passes(&w, 1);
    saved file = save(&w);
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        rewrite(&file, others[i].place, others[i].cut, others[i].text);
        pm_progressive back = {0};
        CHECK_FAILS(read_from(&w, file.path, &back), PM_EINPUT, others[i].words);
    }
    pm_status_clear();
    rewrite(&file, "seed 1\n", 10, "");
    pm_progressive back = {0};
    CHECK(read_from(&w, file.path, &back) == PM_EINPUT);
    CHECK(strchr(pm_status_message(), '\n') == NULL); // one fault, one line
    free(file.bytes);
    end(&w);
}

// --- other work ------------------------------------------------------------------------------

/// What the line must say after "were made with ".
static void check_other(work *w, const char *path, const char *words)
{
    pm_progressive back = {0};
    CHECK_FAILS(read_from(w, path, &back), PM_EINPUT, words);
    CHECK(back.sum == NULL);
}

// Another value of one setting, and what is said of it.
#define OTHER(field, value, words)                                                             \
    do {                                                                                       \
        w->settings.field = (value);                                                           \
        check_other(w, path, words);                                                           \
        w->settings = old;                                                                     \
    } while (0)

static void check_photons(work *w, const char *path)
{
    const pm_render_settings old = w->settings;
    OTHER(seed, 2, "c.checkpoint: its passes were made with seed 1, this is 2: go on with");
    OTHER(photons[PM_MAP_GLOBAL], 301, "made with global-photons 300, this is 301");
    OTHER(photons[PM_MAP_CAUSTIC], 0, "made with caustic-photons 300, this is 0");
    OTHER(photons[PM_MAP_VOLUME], 5, "made with volume-photons 100000, this is 5");
    OTHER(total, 9000, "made with photons 0, this is 9000");
    OTHER(roulette, PM_ROULETTE_AVERAGE, "made with roulette max, this is average");
    OTHER(max_bounces, 7, "made with max-bounces 0, this is 7");
    OTHER(unpacked, true, "made with packing on, this is off");
    OTHER(everywhere, true, "made with projection on, this is off");
    OTHER(light.estimate.k, 21, "made with k 20, this is 21");
    OTHER(light.estimate.radius, 0.1, "made with r inf, this is 0.1:");
    OTHER(light.estimate.shape, PM_GATHER_SPHERE, "made with shape disc, this is sphere");
    OTHER(light.estimate.flatness, nextafter(0.1, 1.0),
          "made with flatness 0.1, this is 0.10000000000000002");
    OTHER(light.estimate.filter, PM_FILTER_GAUSSIAN, "made with filter none, this is gaussian");
    OTHER(light.estimate.constants, PM_CONSTANTS_LECTURE,
          "made with kernel-constants unbiased, this is lecture");
}

static void check_picture(work *w, const char *path)
{
    const pm_render_settings old = w->settings;
    OTHER(light.rays, 4, "made with gather 0, this is 4");
    OTHER(light.spp, 2, "made with spp 1, this is 2");
    OTHER(light.light_samples, 2, "made with light-samples 1, this is 2");
    OTHER(direct_photons, true, "made with direct rays, this is photons");
    OTHER(light.caustics_global, true, "made with caustics map, this is global");
    OTHER(light.media, PM_MEDIA_MARCH, "made with media beams, this is march");
    OTHER(light.step, 0.25, "made with march-step 0, this is 0.25");
    OTHER(precompute, true, "made with precompute off, this is on");
    OTHER(only, PM_LAYER_CAUSTIC, "made with only all, this is caustic");
}

static void other_settings_are_refused_by_name(void)
{
    work w;
    begin(&w);
    do_passes(&w, 1);
    const char *path = pm_command_path("c.checkpoint");
    CHECK_OK(write_to(&w, path));
    check_photons(&w, path);
    check_picture(&w, path);
    pm_progressive back = {0};
    CHECK_OK(read_from(&w, path, &back));
    pm_progressive_free(&back);
    end(&w);
}

static void other_scenes_are_refused_by_name(void)
{
    work w;
    begin(&w);
    do_passes(&w, 1);
    const char *path = pm_command_path("d.checkpoint");
    CHECK_OK(write_to(&w, path));
    w.s.scene.hash++;
    check_other(&w, path, "made with scene 0000000000001234, this is 0000000000001235");
    w.s.scene.hash--;
    w.s.scene.camera.width++;
    check_other(&w, path, "made with size 4x4, this is 5x4");
    w.s.scene.camera.width--;
    w.s.scene.camera.position.x += 0x1p-40;
    check_other(&w, path, "made with camera ");
    w.s.scene.camera.tan_x *= 2.0;
    w.settings.seed = 9;
    check_other(&w, path, "were made with seed 1, this is 9"); // a line for each
    end(&w);
}

PM_TESTS({"checkpoint.1", "sums come back bit for bit and go on as if nothing had happened",
          sums_come_back_and_go_on},
         {"checkpoint.2", "an altered byte is refused wherever it is",
          altered_bytes_are_refused},
         {"checkpoint.3", "a file that was cut or grew is refused", cut_files_are_refused},
         {"checkpoint.4", "other files, other versions and folders are refused",
          what_is_no_checkpoint_is_refused},
         {"checkpoint.5", "every other setting is refused by its name and both values",
          other_settings_are_refused_by_name},
         {"checkpoint.6", "another scene, camera or size is refused by name",
          other_scenes_are_refused_by_name},
         {"checkpoint.7", "what other programs might keep is refused, a fault in a line",
          other_contents_are_refused_in_a_line})
