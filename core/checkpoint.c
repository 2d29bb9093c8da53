// A line with the version, the text of what it is of (checkpoint_text.h), an empty line, the
// sums, the CRC-32 of all that. What is written and what is read is one list (walk()), so the
// two cannot differ.
#include "checkpoint.h"

#include "checkpoint_text.h"
#include "file.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#define MAGIC "photonlab checkpoint version "
#define VERSION "1\n"
#define CRC_BYTES 4u
#define BLOCK 65536u // bytes at a time

/// Numbers on their way to a file or from one.
typedef struct {
    FILE *stream;
    bool writing;
    bool failed;
    uint32_t crc; // of what was written
    uint8_t block[BLOCK];
    size_t used, filled; // bytes of the block
} channel;

// --- bytes -----------------------------------------------------------------------------------

static void flush_block(channel *to)
{
    to->crc = (uint32_t)crc32(to->crc, to->block, (uInt)to->used);
    to->failed = to->failed || fwrite(to->block, 1, to->used, to->stream) != to->used;
    to->used = 0;
}

static void put_byte(channel *to, uint8_t byte)
{
    if (to->used == BLOCK) {
        flush_block(to);
    }
    to->block[to->used++] = byte;
}

static uint8_t get_byte(channel *from)
{
    if (from->used == from->filled) {
        from->filled = fread(from->block, 1, BLOCK, from->stream);
        from->used = 0;
    }
    if (from->filled == 0) {
        from->failed = true;
        return 0;
    }
    return from->block[from->used++];
}

static void put_text(channel *to, const char *text)
{
    for (; *text != '\0'; text++) {
        put_byte(to, (uint8_t)*text);
    }
}

/// Hands a number over in the channel's direction.
static void pass_count(channel *by, uint64_t *count)
{
    uint64_t value = by->writing ? *count : 0;
    for (int i = 0; i < 8; i++) {
        if (by->writing) {
            put_byte(by, (uint8_t)(value >> (8 * i)));
        } else {
            value |= (uint64_t)get_byte(by) << (8 * i);
        }
    }
    *count = value;
}

static void pass_real(channel *by, double *real)
{
    uint64_t bits;
    memcpy(&bits, real, sizeof bits);
    pass_count(by, &bits);
    memcpy(real, &bits, sizeof bits);
}

static void pass_spectrum(channel *by, pm_spectrum *spectrum)
{
    for (int c = 0; c < 3; c++) {
        pass_real(by, &spectrum->c[c]);
    }
}

// --- what is kept ----------------------------------------------------------------------------

/// All that a picture's report says; shapes and media have no books there.
static void walk_audit(channel *by, pm_audit *audit)
{
    pass_count(by, &audit->photons);
    pass_count(by, &audit->ended_absorbed);
    pass_count(by, &audit->ended_escaped);
    pass_count(by, &audit->ended_lost);
    pass_count(by, &audit->events);
    for (int i = 0; i < PM_AUDIT_BOUNCES; i++) {
        pass_count(by, &audit->bounces[i]);
    }
    pass_spectrum(by, &audit->emitted);
    pass_spectrum(by, &audit->absorbed);
    pass_spectrum(by, &audit->escaped);
    pass_spectrum(by, &audit->lost);
    pass_spectrum(by, &audit->roulette);
    pass_spectrum(by, &audit->roulette_variance);
    pass_spectrum(by, &audit->dispersion);
    pass_spectrum(by, &audit->dispersion_variance);
    pass_real(by, &audit->largest);
}

static void walk_map(channel *by, pm_progressive_map *map)
{
    pass_real(by, &map->first);
    pass_count(by, &map->sum.emitted);
    pass_count(by, &map->sum.stored);
    pass_count(by, &map->sum.refused);
    pass_count(by, &map->sum.clamped);
    pass_count(by, &map->sum.vanished);
    pass_count(by, &map->sum.bytes);
    pass_spectrum(by, &map->sum.power);
    pass_count(by, &map->pass.emitted);
    pass_count(by, &map->pass.deposits);
    pass_spectrum(by, &map->pass.deposited);
    pass_real(by, &map->pass.seconds);
    pass_real(by, &map->pass.emit_cpu);
    pass_real(by, &map->pass.trace_cpu);
    pass_real(by, &map->pass.store_cpu);
    pass_real(by, &map->balance_seconds);
    walk_audit(by, &map->pass.audit);
}

static void walk_eye(channel *by, pm_eye_report *eye)
{
    pass_real(by, &eye->seconds);
    pass_real(by, &eye->cpu);
    pass_count(by, &eye->lookups);
    pass_count(by, &eye->cut);
    pass_count(by, &eye->near);
    pass_count(by, &eye->shadow_rays);
    pass_count(by, &eye->shadow_spared);
}

static void walk(channel *by, pm_progressive *progressive)
{
    uint64_t passes = progressive->passes;
    pass_count(by, &passes);
    progressive->passes =
        passes > UINT32_MAX ? UINT32_MAX : (uint32_t)passes; // too many are refused
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        walk_map(by, &progressive->map[kind]);
    }
    walk_eye(by, &progressive->eye);
    pass_count(by, &progressive->shadow_photons);
    pass_count(by, &progressive->places);
    pass_real(by, &progressive->shadow_seconds);
    pass_real(by, &progressive->irradiance_seconds);
    pass_real(by, &progressive->beams_seconds);
    size_t count =
        (size_t)progressive->width * (size_t)progressive->height * (size_t)PM_SUM_PLANES;
    for (size_t i = 0; i < count && !by->failed; i++) {
        pass_real(by, &progressive->sum[i]);
    }
}

// --- writing ---------------------------------------------------------------------------------

static bool write_all(FILE *stream, const char *text, const pm_progressive *progressive)
{
    channel to = {.stream = stream, .writing = true};
    pm_progressive same = *progressive; // walk() changes nothing of it when writing
    put_text(&to, MAGIC VERSION);
    put_text(&to, text);
    put_text(&to, "\n");
    walk(&to, &same);
    flush_block(&to);
    uint32_t crc = to.crc;
    for (unsigned i = 0; i < CRC_BYTES; i++) {
        put_byte(&to, (uint8_t)(crc >> (8 * i)));
    }
    flush_block(&to);
    return !to.failed;
}

pm_status pm_checkpoint_write(const char *path, const pm_scene *scene,
                              const pm_render_settings *settings,
                              const pm_progressive *progressive)
{
    char text[PM_CHECKPOINT_TEXT_ROOM];
    pm_checkpoint_text_print(scene, settings, text);
    pm_file file;
    PM_TRY(pm_file_begin(path, &file));
    errno = 0;
    if (!write_all(file.stream, text, progressive)) {
        pm_status status = pm_status_fail(PM_EIO, "%s: cannot be written: %s", path,
                                          errno != 0 ? strerror(errno) : "unknown reason");
        pm_file_abandon(&file);
        return status;
    }
    return pm_file_commit(&file);
}

// --- reading ---------------------------------------------------------------------------------

static pm_status check_version(const char *path, FILE *stream)
{
    char line[sizeof MAGIC VERSION] = "";
    size_t got = fread(line, 1, sizeof line - 1, stream);
    line[got] = '\0';
    if (strncmp(line, MAGIC, strlen(MAGIC)) != 0) {
        return pm_status_fail(PM_EINPUT, "%s: is no checkpoint of photonlab", path);
    }
    if (strcmp(line, MAGIC VERSION) != 0) {
        return pm_status_fail(PM_EINPUT,
                              "%s: is a checkpoint of another version, this program goes on "
                              "with version %.1s only: begin another file",
                              path, VERSION);
    }
    return PM_OK;
}

/// The CRC-32 of all but the last bytes, which must say the same.
static pm_status check_crc(const char *path, FILE *stream, uint64_t bytes)
{
    uint8_t block[BLOCK];
    uint32_t crc = 0;
    uint64_t left = bytes - CRC_BYTES; // longer than that: it has its first line
    rewind(stream);
    while (left > 0) {
        size_t part = left < BLOCK ? (size_t)left : BLOCK;
        if (fread(block, 1, part, stream) != part) {
            return pm_status_fail(PM_EIO, "%s: cannot be read to its end", path);
        }
        crc = (uint32_t)crc32(crc, block, (uInt)part);
        left -= part;
    }
    uint32_t said = 0;
    size_t got = fread(block, 1, CRC_BYTES, stream);
    for (size_t i = 0; i < got; i++) {
        said |= (uint32_t)block[i] << (8 * i);
    }
    if (got != CRC_BYTES || said != crc) {
        return pm_status_fail(PM_EINPUT,
                              "%s: is cut or altered: its CRC-32 is %08" PRIx32
                              ", its end says %08" PRIx32,
                              path, crc, said);
    }
    return PM_OK;
}

/// What stands between the first line and the empty one.
static pm_status read_text(const char *path, channel *from, char *text)
{
    size_t length = 0;
    while (length < 2 || text[length - 1] != '\n' || text[length - 2] != '\n') {
        if (from->failed || length == PM_CHECKPOINT_TEXT_ROOM - 1) {
            return pm_status_fail(PM_EINPUT, "%s: does not say what it is of", path);
        }
        text[length++] = (char)get_byte(from);
    }
    text[length - 1] = '\0';
    return PM_OK;
}

static pm_status read_sums(const char *path, channel *from, pm_progressive *sums)
{
    walk(from, sums);
    for (unsigned i = 0; i < CRC_BYTES; i++) {
        (void)get_byte(from);
    }
    bool whole = !from->failed;
    (void)get_byte(from);
    if (!whole || !from->failed) {
        return pm_status_fail(PM_EINPUT, "%s: holds %s numbers than its picture has", path,
                              whole ? "more" : "fewer");
    }
    if (sums->passes == 0 || sums->passes > PM_PROGRESSIVE_MOST) {
        return pm_status_fail(PM_EINPUT, "%s: holds %" PRIu32 " passes, from 1 to %u can be",
                              path, sums->passes, PM_PROGRESSIVE_MOST);
    }
    return PM_OK;
}

static pm_status read_all(const char *path, FILE *stream, uint64_t bytes, const char *wanted,
                          pm_progressive *sums)
{
    char text[PM_CHECKPOINT_TEXT_ROOM];
    PM_TRY(check_version(path, stream));
    PM_TRY(check_crc(path, stream, bytes));
    if (fseek(stream, (long)strlen(MAGIC VERSION), SEEK_SET) != 0) {
        return pm_status_fail(PM_EIO, "%s: cannot be read: %s", path, strerror(errno));
    }
    channel from = {.stream = stream};
    PM_TRY(read_text(path, &from, text));
    PM_TRY(pm_checkpoint_text_compare(path, text, wanted));
    return read_sums(path, &from, sums);
}

pm_status pm_checkpoint_read(const char *path, const pm_scene *scene,
                             const pm_render_settings *settings, pm_progressive *progressive)
{
    char wanted[PM_CHECKPOINT_TEXT_ROOM];
    uint64_t bytes;
    pm_checkpoint_text_print(scene, settings, wanted);
    PM_TRY(pm_file_size(path, &bytes));
    FILE *stream = fopen(path, "rb");
    if (stream == NULL) {
        return pm_status_fail(PM_EIO, "%s: cannot be read: %s", path, strerror(errno));
    }
    pm_progressive sums = {0};
    pm_status status = pm_progressive_begin(scene, &sums);
    status = status == PM_OK ? read_all(path, stream, bytes, wanted, &sums) : status;
    fclose(stream);
    if (status != PM_OK) {
        pm_progressive_free(&sums);
        return status;
    }
    *progressive = sums;
    return PM_OK;
}
