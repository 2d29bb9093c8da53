// Writing: the header with an empty CRC, the photons, then the CRC into its place. Bytes are
// put one by one, least significant first, so that every machine writes the same file.
// Reading is in photon_file_read.c.
#include "photon_file.h"

#include "file.h"
#include "photon_header.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#define ROWS 1024  // encoded at a time
#define ROW_MAX 96 // bytes, all columns

static uint8_t *put_16(uint8_t *at, uint16_t value)
{
    at[0] = (uint8_t)value;
    at[1] = (uint8_t)(value >> 8);
    return at + 2;
}

static uint8_t *put_32(uint8_t *at, uint32_t value)
{
    return put_16(put_16(at, (uint16_t)value), (uint16_t)(value >> 16));
}

static uint8_t *put_floats(uint8_t *at, const float *values, int count)
{
    for (int i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        at = put_32(at, bits);
    }
    return at;
}

static uint8_t *put_bytes(uint8_t *at, const uint8_t *bytes, size_t count)
{
    memcpy(at, bytes, count);
    return at + count;
}

static uint8_t *put_row(uint8_t *at, const pm_photon_map *map, const pm_photon_columns *columns,
                        uint32_t i)
{
    const pm_photon *photon = &map->photons[i];
    at = put_floats(at, photon->position, 3);
    at = put_bytes(at, photon->power, 4);
    at = put_bytes(at, photon->direction, 2);
    at = put_16(at, photon->flags);
    if (map->unpacked) {
        at = put_floats(at, map->exact[i].power, 3);
        at = put_floats(at, map->exact[i].direction, 3);
    }
    if (columns->bounce != NULL) {
        at = put_32(at, columns->bounce[i]);
    }
    if (columns->light != NULL) {
        at = put_32(at, columns->light[i]);
    }
    if (columns->path != NULL) {
        at = put_32(at, (uint32_t)columns->path[i]);
        at = put_32(at, (uint32_t)(columns->path[i] >> 32));
    }
    if (columns->normal != NULL) {
        at = put_floats(at, columns->normal[i], 3);
    }
    return at;
}

static bool write_counted(FILE *stream, const void *bytes, size_t size, uint32_t *crc)
{
    *crc = (uint32_t)crc32(*crc, bytes, (uInt)size);
    return fwrite(bytes, 1, size, stream) == size;
}

static bool write_rows(FILE *stream, const pm_photon_map *map, const pm_photon_columns *columns,
                       uint32_t *crc)
{
    uint8_t rows[ROWS * ROW_MAX];
    uint8_t *at = rows;
    for (uint32_t i = 0; i < map->count; i++) {
        at = put_row(at, map, columns, i);
        bool full = i % ROWS == ROWS - 1 || i + 1 == map->count;
        if (full && !write_counted(stream, rows, (size_t)(at - rows), crc)) {
            return false;
        }
        at = full ? rows : at;
    }
    return true;
}

static bool write_all(FILE *stream, const pm_photon_map *map, const pm_photon_columns *columns,
                      pm_photon_header *header)
{
    char text[PM_PHOTON_HEADER_ROOM];
    uint32_t crc = 0;
    size_t length = pm_photon_header_print(header, text);
    if (!write_counted(stream, text, length, &crc) || !write_rows(stream, map, columns, &crc)) {
        return false;
    }
    header->crc = crc;
    pm_photon_header_print(header, text);
    size_t digits = pm_photon_header_crc_at(text);
    return fseek(stream, (long)digits, SEEK_SET) == 0 &&
           fwrite(text + digits, 1, 8, stream) == 8;
}

pm_status pm_photon_file_write(const char *path, const pm_photon_map *map,
                               const pm_photon_file_info *info,
                               const pm_photon_columns *columns)
{
    const pm_photon_columns none = {0};
    const pm_photon_columns *used = columns != NULL ? columns : &none;
    pm_photon_header header = {.map = *map,
                               .info = *info,
                               .has_bounce = used->bounce != NULL,
                               .has_light = used->light != NULL,
                               .has_path = used->path != NULL,
                               .has_normal = used->normal != NULL};
    pm_file file;
    PM_TRY(pm_file_begin(path, &file));
    errno = 0;
    if (!write_all(file.stream, map, used, &header)) {
        pm_status status = pm_status_fail(PM_EIO, "%s: cannot be written: %s", path,
                                          errno != 0 ? strerror(errno) : "unknown reason");
        pm_file_abandon(&file);
        return status;
    }
    return pm_file_commit(&file);
}

void pm_photon_columns_free(pm_photon_columns *columns)
{
    free(columns->bounce);
    free(columns->light);
    free(columns->path);
    free(columns->normal);
    *columns = (pm_photon_columns){0};
}
