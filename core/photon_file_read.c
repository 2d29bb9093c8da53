// Reading: the header decides how long the file must be, before anything is allocated; the CRC
// decides whether it is believed.
#include "photon_file.h"

#include "file.h"
#include "photon_header.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#define ROWS 1024
#define ROW_MAX 96

typedef struct {
    const char *path;
    FILE *stream;
    pm_photon_header header;
    size_t length; // of the header
    uint32_t crc;
    pm_photon_map map;
    pm_photon_columns columns;
} reading;

static const uint8_t *get_16(const uint8_t *at, uint16_t *value)
{
    *value = (uint16_t)(at[0] | at[1] << 8);
    return at + 2;
}

static const uint8_t *get_32(const uint8_t *at, uint32_t *value)
{
    *value = at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
    return at + 4;
}

static const uint8_t *get_floats(const uint8_t *at, float *values, int count)
{
    for (int i = 0; i < count; i++) {
        uint32_t bits;
        at = get_32(at, &bits);
        memcpy(&values[i], &bits, sizeof bits);
    }
    return at;
}

static const uint8_t *get_bytes(const uint8_t *at, uint8_t *bytes, size_t count)
{
    memcpy(bytes, at, count);
    return at + count;
}

static const uint8_t *get_row(const uint8_t *at, reading *r, uint32_t i)
{
    pm_photon *photon = &r->map.photons[i];
    at = get_floats(at, photon->position, 3);
    at = get_bytes(at, photon->power, 4);
    at = get_bytes(at, photon->direction, 2);
    at = get_16(at, &photon->flags);
    if (r->map.unpacked) {
        at = get_floats(at, r->map.exact[i].power, 3);
        at = get_floats(at, r->map.exact[i].direction, 3);
    }
    if (r->columns.bounce != NULL) {
        at = get_32(at, &r->columns.bounce[i]);
    }
    if (r->columns.light != NULL) {
        at = get_32(at, &r->columns.light[i]);
    }
    if (r->columns.path != NULL) {
        uint32_t low;
        uint32_t high;
        at = get_32(get_32(at, &low), &high);
        r->columns.path[i] = (uint64_t)high << 32 | low;
    }
    if (r->columns.normal != NULL) {
        at = get_floats(at, r->columns.normal[i], 3);
    }
    return at;
}

static pm_status read_header(reading *r)
{
    char text[PM_PHOTON_HEADER_ROOM];
    size_t got = fread(text, 1, sizeof text - 1, r->stream);
    text[got] = '\0';
    PM_TRY(pm_photon_header_parse(r->path, text, &r->header, &r->length));
    memset(text + pm_photon_header_crc_at(text), '0', 8);
    r->crc = (uint32_t)crc32(0, (const Bytef *)text, (uInt)r->length);
    if (fseek(r->stream, (long)r->length, SEEK_SET) != 0) {
        return pm_status_fail(PM_EIO, "%s: cannot be read: %s", r->path, strerror(errno));
    }
    return PM_OK;
}

static pm_status check_length(const reading *r, uint64_t bytes)
{
    uint64_t wanted =
        r->length + (uint64_t)r->header.map.count * pm_photon_header_row(&r->header);
    if (bytes == wanted) {
        return PM_OK;
    }
    return pm_status_fail(
        PM_EINPUT, "%s: is %s: its %" PRIu32 " photons need %" PRIu64 " bytes, it has %" PRIu64,
        r->path, bytes < wanted ? "cut" : "too long", r->header.map.count, wanted, bytes);
}

// An array for one entry a photon when `needed`; false without memory.
static bool make_column(bool needed, uint32_t count, size_t size, void **column)
{
    *column = needed ? malloc((size_t)count * size + 1) : NULL;
    return !needed || *column != NULL;
}

static pm_status make_arrays(reading *r)
{
    const pm_photon_header *h = &r->header;
    uint32_t count = h->map.count;
    void *photons;
    void *exact;
    void *bounce;
    void *light;
    void *path;
    void *normal;
    bool made = make_column(count > 0, count, sizeof(pm_photon), &photons);
    made &= make_column(count > 0 && h->map.unpacked, count, sizeof(pm_photon_exact), &exact);
    made &= make_column(h->has_bounce, count, sizeof(uint32_t), &bounce);
    made &= make_column(h->has_light, count, sizeof(uint32_t), &light);
    made &= make_column(h->has_path, count, sizeof(uint64_t), &path);
    made &= make_column(h->has_normal, count, sizeof(float[3]), &normal);
    r->map = h->map;
    r->map.photons = photons;
    r->map.exact = exact;
    r->map.capacity = count;
    r->columns = (pm_photon_columns){bounce, light, path, normal};
    return made ? PM_OK : PM_FAIL(PM_ENOMEM, "no memory for %" PRIu32 " photons", count);
}

static pm_status read_rows(reading *r)
{
    uint8_t rows[ROWS * ROW_MAX];
    size_t row = pm_photon_header_row(&r->header);
    for (uint32_t i = 0; i < r->map.count;) {
        uint32_t left = r->map.count - i;
        uint32_t count = left < ROWS ? left : ROWS;
        if (fread(rows, row, count, r->stream) != count) {
            return pm_status_fail(PM_EIO, "%s: cannot be read to its end", r->path);
        }
        r->crc = (uint32_t)crc32(r->crc, rows, (uInt)(count * row));
        const uint8_t *at = rows;
        for (uint32_t end = i + count; i < end; i++) {
            at = get_row(at, r, i);
        }
    }
    if (r->crc != r->header.crc) {
        return pm_status_fail(PM_EINPUT,
                              "%s: is altered: its CRC-32 is %08" PRIx32
                              ", its header says %08" PRIx32,
                              r->path, r->crc, r->header.crc);
    }
    return PM_OK;
}

// What no writer of ours makes, CRC or not.
static pm_status check_photons(const reading *r)
{
    for (uint32_t i = 0; i < r->map.count; i++) {
        const float *at = r->map.photons[i].position;
        if (!isfinite(at[0]) || !isfinite(at[1]) || !isfinite(at[2])) {
            return pm_status_fail(PM_EINPUT,
                                  "%s: photon %" PRIu32 " has a position that is not finite",
                                  r->path, i);
        }
        if ((r->map.photons[i].flags & PM_PHOTON_AXIS) > 2) {
            return pm_status_fail(PM_EINPUT, "%s: photon %" PRIu32 " has no split axis",
                                  r->path, i);
        }
    }
    return PM_OK;
}

static pm_status read_all(reading *r, uint64_t bytes)
{
    PM_TRY(read_header(r));
    PM_TRY(check_length(r, bytes));
    PM_TRY(make_arrays(r));
    PM_TRY(read_rows(r));
    return check_photons(r);
}

pm_status pm_photon_file_read(const char *path, pm_photon_map *map, pm_photon_file_info *info,
                              pm_photon_columns *columns)
{
    uint64_t bytes;
    PM_TRY(pm_file_size(path, &bytes));
    reading r = {.path = path, .stream = fopen(path, "rb")};
    if (r.stream == NULL) {
        return pm_status_fail(PM_EIO, "%s: cannot be read: %s", path, strerror(errno));
    }
    pm_status status = read_all(&r, bytes);
    fclose(r.stream);
    if (status != PM_OK) {
        free(r.map.photons);
        free(r.map.exact);
        pm_photon_columns_free(&r.columns);
        return status;
    }
    *map = r.map;
    *info = r.header.info;
    if (columns != NULL) {
        *columns = r.columns;
    } else {
        pm_photon_columns_free(&r.columns);
    }
    return PM_OK;
}

bool pm_photon_file_is(const char *path)
{
    static const char third_line[] = "\ncomment photonlab photons ";
    char text[128];
    FILE *stream = fopen(path, "rb");
    if (stream == NULL) {
        return false;
    }
    size_t got = fread(text, 1, sizeof text - 1, stream);
    fclose(stream);
    text[got] = '\0';
    return strncmp(text, "ply", 3) == 0 && strstr(text, third_line) != NULL;
}
