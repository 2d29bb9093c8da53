// Lines in a fixed order; floating point in hexadecimal, so that no bit is lost.
#include "photon_header.h"

#include "text.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MAGIC "comment photonlab photons version "

static const char *const map_names[PM_MAP_COUNT] = {"global", "caustic", "volume"};

size_t pm_photon_header_row(const pm_photon_header *header)
{
    size_t row = sizeof(pm_photon);
    row += header->map.unpacked ? sizeof(pm_photon_exact) : 0;
    row += header->has_bounce ? 4 : 0;
    row += header->has_light ? 4 : 0;
    row += header->has_path ? 8 : 0;
    row += header->has_normal ? 12 : 0;
    return row;
}

static void put_comments(pm_text *p, const pm_photon_header *header)
{
    const pm_photon_map *map = &header->map;
    pm_text_put(p, "comment map %s\n", map_names[map->kind]);
    pm_text_put(p, "comment packing %s\n", map->unpacked ? "off" : "on");
    pm_text_put(p, "comment balanced %s\n", map->balanced ? "yes" : "no");
    pm_text_put(p, "comment scaled %s\n", map->scaled ? "yes" : "no");
    pm_text_put(p, "comment emitted %" PRIu64 "\n", map->emitted);
    pm_text_put(p, "comment scale %a\n", map->scale);
    pm_text_put(p, "comment refused %" PRIu64 "\n", map->refused);
    pm_text_put(p, "comment clamped %" PRIu64 "\n", map->clamped);
    pm_text_put(p, "comment vanished %" PRIu64 "\n", map->vanished);
    pm_text_put(p, "comment seed %" PRIu32 "\n", header->info.seed);
    pm_text_put(p, "comment scene %016" PRIx64 "\n", header->info.scene_hash);
    pm_text_put(p, "comment center %a %a %a\n", header->info.center.x, header->info.center.y,
                header->info.center.z);
    pm_text_put(p, "comment crc32 %08" PRIx32 "\n", header->crc);
}

static void put_properties(pm_text *p, const pm_photon_header *header)
{
    pm_text_put(p, "property float x\nproperty float y\nproperty float z\n");
    pm_text_put(p, "property uchar power_r\nproperty uchar power_g\nproperty uchar power_b\n"
                   "property uchar power_e\n");
    pm_text_put(p, "property uchar theta\nproperty uchar phi\nproperty ushort flags\n");
    if (header->map.unpacked) {
        pm_text_put(p,
                    "property float exact_r\nproperty float exact_g\nproperty float exact_b\n");
        pm_text_put(
            p, "property float exact_dx\nproperty float exact_dy\nproperty float exact_dz\n");
    }
    if (header->has_bounce) {
        pm_text_put(p, "property uint bounce\n");
    }
    if (header->has_light) {
        pm_text_put(p, "property uint light\n");
    }
    if (header->has_path) {
        pm_text_put(p,
                    "property uint path_low\nproperty uint path_high\n"); // PLY has no 64 bits
    }
    if (header->has_normal) {
        pm_text_put(p, "property float nx\nproperty float ny\nproperty float nz\n");
    }
}

size_t pm_photon_header_print(const pm_photon_header *header, char *text)
{
    pm_text p = {.room = PM_PHOTON_HEADER_ROOM};
    p.start = text;
    pm_text_put(&p, "ply\nformat binary_little_endian 1.0\n" MAGIC "%d\n",
                PM_PHOTON_FILE_VERSION);
    put_comments(&p, header);
    pm_text_put(&p, "element vertex %" PRIu32 "\n", header->map.count);
    put_properties(&p, header);
    pm_text_put(&p, "end_header\n");
    return p.length;
}

static const char *find_value(const char *text, const char *key)
{
    const char *at = strstr(text, key);
    return at == NULL ? "" : at + strlen(key);
}

size_t pm_photon_header_crc_at(const char *text)
{
    static const char key[] = "\ncomment crc32 ";
    const char *line = strstr(text, key);
    return line == NULL ? 0 : (size_t)(line - text) + strlen(key);
}

static uint64_t parse_count(const char *text, const char *key)
{
    return strtoull(find_value(text, key), NULL, 10);
}

static pm_map_kind parse_kind(const char *text)
{
    const char *name = find_value(text, "\ncomment map ");
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        if (strncmp(name, map_names[kind], strlen(map_names[kind])) == 0) {
            return (pm_map_kind)kind;
        }
    }
    return PM_MAP_GLOBAL; // printed again it differs, and is refused
}

static bool has(const char *text, const char *line)
{
    return strstr(text, line) != NULL;
}

// Reads what it can; that it is the whole text is checked by printing it again.
static pm_photon_header parse_lines(const char *text)
{
    pm_photon_header header = {0};
    pm_photon_map *map = &header.map;
    map->kind = parse_kind(text);
    map->unpacked = has(text, "\ncomment packing off\n");
    map->balanced = has(text, "\ncomment balanced yes\n");
    map->scaled = has(text, "\ncomment scaled yes\n");
    map->emitted = parse_count(text, "\ncomment emitted ");
    map->scale = strtod(find_value(text, "\ncomment scale "), NULL);
    map->refused = parse_count(text, "\ncomment refused ");
    map->clamped = parse_count(text, "\ncomment clamped ");
    map->vanished = parse_count(text, "\ncomment vanished ");
    map->count = (uint32_t)parse_count(text, "\nelement vertex ");
    header.info.seed = (uint32_t)parse_count(text, "\ncomment seed ");
    header.info.scene_hash = strtoull(find_value(text, "\ncomment scene "), NULL, 16);
    char *next;
    header.info.center.x = strtod(find_value(text, "\ncomment center "), &next);
    header.info.center.y = strtod(next, &next);
    header.info.center.z = strtod(next, &next);
    header.crc = (uint32_t)strtoul(find_value(text, "\ncomment crc32 "), NULL, 16);
    header.has_bounce = has(text, "\nproperty uint bounce\n");
    header.has_light = has(text, "\nproperty uint light\n");
    header.has_path = has(text, "\nproperty uint path_low\n");
    header.has_normal = has(text, "\nproperty float nx\n");
    return header;
}

static pm_status check_kind_of_file(const char *path, const char *text)
{
    if (strncmp(text, "ply\n", 4) != 0 && strncmp(text, "ply\r\n", 5) != 0) {
        return pm_status_fail(PM_EINPUT, "%s: is not a PLY file", path);
    }
    const char *version = strstr(text, "\n" MAGIC);
    if (version == NULL) {
        return pm_status_fail(PM_EINPUT,
                              "%s: is a PLY file, but not of photons (a mesh, perhaps)", path);
    }
    version += strlen("\n" MAGIC);
    size_t digits = strcspn(version, "\n");
    char ours[16];
    snprintf(ours, sizeof ours, "%d", PM_PHOTON_FILE_VERSION);
    if (digits != strlen(ours) || strncmp(version, ours, digits) != 0) {
        return pm_status_fail(PM_EINPUT,
                              "%s: is a photon file of version %.*s; version %s is read", path,
                              (int)(digits < 16 ? digits : 16), version, ours);
    }
    return PM_OK;
}

pm_status pm_photon_header_parse(const char *path, const char *text, pm_photon_header *header,
                                 size_t *length)
{
    PM_TRY(check_kind_of_file(path, text));
    const char *end = strstr(text, "\nend_header\n");
    if (end == NULL) {
        return pm_status_fail(PM_EINPUT, "%s: is cut or altered inside its header", path);
    }
    size_t found = (size_t)(end - text) + strlen("\nend_header\n");
    char own[PM_PHOTON_HEADER_ROOM];
    memcpy(own, text, found);
    own[found] = '\0';
    pm_photon_header parsed = parse_lines(own);
    char again[PM_PHOTON_HEADER_ROOM];
    bool counts = parsed.map.count <= PM_MAP_MAX && isfinite(parsed.map.scale);
    if (!counts || pm_photon_header_print(&parsed, again) != found ||
        memcmp(own, again, found) != 0) {
        return pm_status_fail(PM_EINPUT, "%s: its header is altered", path);
    }
    *header = parsed;
    *length = found;
    return PM_OK;
}
