// Photon files: everything comes back bit for bit, and a file that differs in one bit, is cut,
// or is something else is refused.
#include "bytes.h"
#include "photon_file.h"
#include "photon_header.h"
#include "photon_map.h"
#include "store.h"
#include "test.h"

#include <assimp/cimport.h>
#include <assimp/scene.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>
#include <zlib.h>

static const pm_photon_file_info info = {
    .seed = 4294967295u, .scene_hash = 0x0123456789abcdefu, .center = {1e6, -0.1, 1.0 / 3.0}};

static const char *path_of(const char *name)
{
    static char path[4096];
    snprintf(path, sizeof path, "%s/%s", pm_test_folder(), name);
    return path;
}

static pm_photon_map make_map(uint32_t count, bool unpacked)
{
    pm_photon_map map = {.kind = PM_MAP_CAUSTIC, .unpacked = unpacked};
    for (uint32_t i = 0; i < count; i++) {
        double t = 0.1 + 0.7 * i;
        pm_deposit deposit = {.position = {cos(t), t, -t * 1e-3},
                              .direction = {cos(t), sin(t), 0.0},
                              .normal = {0.0, 1.0, 0.0},
                              .power = pm_rgb(t, 2.0 * t, 1e-4 * t),
                              .caustic = i % 2 == 0,
                              .first = i % 3 == 0};
        CHECK_OK(pm_store_push(&map, &deposit));
    }
    CHECK_OK(pm_store_scale(&map, 3 * (uint64_t)count + 7));
    return map;
}

static void check_same(const pm_photon_map *a, const pm_photon_map *b)
{
    CHECK(a->kind == b->kind && a->unpacked == b->unpacked && a->scaled == b->scaled);
    CHECK(a->balanced == b->balanced && a->count == b->count && a->emitted == b->emitted);
    CHECK(memcmp(&a->scale, &b->scale, sizeof a->scale) == 0);
    CHECK(a->refused == b->refused && a->clamped == b->clamped && a->vanished == b->vanished);
    if (a->count > 0) {
        CHECK(memcmp(a->photons, b->photons, a->count * sizeof *a->photons) == 0);
    }
    if (a->count > 0 && a->unpacked) {
        CHECK(memcmp(a->exact, b->exact, a->count * sizeof *a->exact) == 0);
    }
}

static void maps_come_back(void)
{
    static const uint32_t counts[5] = {0, 1, 2, 1024, 3000};
    for (int i = 0; i < 10; i++) {
        pm_photon_map map = make_map(counts[i / 2], i % 2 == 1);
        pm_photon_map back = {0};
        pm_photon_file_info told;
        map.balanced = i % 4 == 0;
        map.refused = (uint64_t)i;
        CHECK_OK(pm_photon_file_write(path_of("m.ply"), &map, &info, NULL));
        CHECK_OK(pm_photon_file_read(path_of("m.ply"), &back, &told, NULL));
        check_same(&map, &back);
        CHECK(told.seed == info.seed && told.scene_hash == info.scene_hash);
        CHECK(told.center.x == 1e6 && told.center.y == -0.1 && told.center.z == 1.0 / 3.0);
        pm_photon_map_free(&map);
        pm_photon_map_free(&back);
    }
}

static void columns_come_back(void)
{
    enum { COUNT = 1500 };
    static uint32_t bounce[COUNT];
    static uint32_t light[COUNT];
    static uint64_t path[COUNT];
    static float normal[COUNT][3];
    for (uint32_t i = 0; i < COUNT; i++) {
        bounce[i] = i;
        light[i] = ~i;
        path[i] = 0x123456789abcdef1u * (i + 1);
        normal[i][1] = (float)i;
    }
    pm_photon_map map = make_map(COUNT, true);
    for (int choice = 0; choice < 16; choice++) {
        pm_photon_columns columns = {choice & 1 ? bounce : NULL, choice & 2 ? light : NULL,
                                     choice & 4 ? path : NULL, choice & 8 ? normal : NULL};
        pm_photon_columns back;
        pm_photon_map got = {0};
        pm_photon_file_info told;
        CHECK_OK(pm_photon_file_write(path_of("m.ply"), &map, &info, &columns));
        CHECK_OK(pm_photon_file_read(path_of("m.ply"), &got, &told, &back));
        check_same(&map, &got);
        CHECK((back.bounce != NULL) == ((choice & 1) != 0));
        CHECK((back.normal != NULL) == ((choice & 8) != 0));
        CHECK(!back.bounce || memcmp(back.bounce, bounce, sizeof bounce) == 0);
        CHECK(!back.light || memcmp(back.light, light, sizeof light) == 0);
        CHECK(!back.path || memcmp(back.path, path, sizeof path) == 0);
        CHECK(!back.normal || memcmp(back.normal, normal, sizeof normal) == 0);
        pm_photon_columns_free(&back);
        pm_photon_map_free(&got);
    }
    pm_photon_map_free(&map);
}

static void refuse(const char *path, const char *message)
{
    pm_photon_map map = {.count = 77};
    pm_photon_file_info told;
    CHECK_FAILS(pm_photon_file_read(path, &map, &told, NULL), PM_EINPUT, message);
    CHECK(map.count == 77);
}

static uint8_t *make_file(uint32_t count, size_t *size)
{
    pm_photon_map map = make_map(count, false);
    CHECK_OK(pm_photon_file_write(path_of("m.ply"), &map, &info, NULL));
    pm_photon_map_free(&map);
    return pm_bytes_read(path_of("m.ply"), size);
}

static void layout_is_that_of_the_design(void)
{
    size_t size;
    uint8_t *bytes = make_file(2, &size);
    char text[PM_PHOTON_HEADER_ROOM] = "";
    memcpy(text, bytes, size - 40);
    CHECK(strncmp(text, "ply\nformat binary_little_endian 1.0\n", 36) == 0);
    CHECK_CONTAINS(text, "comment photonlab photons version 1\ncomment map caustic\n");
    CHECK_CONTAINS(text, "comment emitted 13\ncomment scale 0x1.3b13b13b13b14p-4\n");
    CHECK_CONTAINS(text, "element vertex 2\nproperty float x\nproperty float y\n"
                         "property float z\nproperty uchar power_r\n");
    CHECK_CONTAINS(text, "property uchar phi\nproperty ushort flags\nend_header\n");
    CHECK(strcmp(text + strlen(text) - 11, "end_header\n") == 0);
    // The CRC is zlib's, over the whole file with zeros in the place of its digits.
    char *digits = (char *)bytes + pm_photon_header_crc_at((char *)bytes);
    unsigned long told = strtoul(digits, NULL, 16);
    memset(digits, '0', 8);
    CHECK(crc32(0, bytes, (uInt)size) == told);
    free(bytes);
}

static void every_altered_bit_is_refused(void)
{
    size_t size;
    uint8_t *bytes = make_file(5, &size);
    for (size_t bit = 0; bit < 8 * size; bit++) {
        pm_photon_map map = {.count = 77};
        pm_photon_file_info told;
        bytes[bit / 8] ^= (uint8_t)(1 << bit % 8);
        pm_bytes_write(path_of("bad.ply"), bytes, size);
        bytes[bit / 8] ^= (uint8_t)(1 << bit % 8);
        pm_status status = pm_photon_file_read(path_of("bad.ply"), &map, &told, NULL);
        CHECK_THAT(status == PM_EINPUT, "bit %zu of byte %zu", bit % 8, bit / 8);
        CHECK_CONTAINS(pm_status_message(), "bad.ply: ");
        pm_status_clear();
        CHECK(map.count == 77);
    }
    free(bytes);
}

static void every_cut_is_refused(void)
{
    size_t size;
    uint8_t *bytes = make_file(5, &size);
    size_t header = size - 5 * sizeof(pm_photon);
    for (size_t cut = 0; cut < size; cut++) {
        pm_bytes_write(path_of("cut.ply"), bytes, cut);
        refuse(path_of("cut.ply"), cut >= header ? "cut.ply: is cut: its 5 photons need"
                                   : cut < 4     ? "is not a PLY file"
                                                 : "");
    }
    bytes[size] = 0;
    pm_bytes_write(path_of("long.ply"), bytes, size + 1);
    refuse(path_of("long.ply"), "long.ply: is too long: its 5 photons need");
    free(bytes);
}

// Changes the header's text and mends the CRC, as a careful forger or another program would.
static void forge(const char *from, const char *to)
{
    size_t size;
    uint8_t *bytes = make_file(5, &size);
    uint8_t forged[8192];
    char *at = strstr((char *)bytes, from);
    CHECK(at != NULL);
    size_t before = (size_t)(at - (char *)bytes);
    memcpy(forged, bytes, before);
    memcpy(forged + before, to, strlen(to));
    memcpy(forged + before + strlen(to), at + strlen(from), size - before - strlen(from));
    size_t length = size - strlen(from) + strlen(to);
    char *digits = (char *)forged + pm_photon_header_crc_at((char *)forged);
    memset(digits, '0', 8);
    char crc[9];
    snprintf(crc, sizeof crc, "%08lx", crc32(0, forged, (uInt)length));
    memcpy(digits, crc, 8);
    pm_bytes_write(path_of("forged.ply"), forged, length);
    free(bytes);
}

static void other_files_are_named(void)
{
    static const char mesh[] = "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\n"
                               "element face 0\nproperty list uchar int vertex_indices\n"
                               "end_header\n";
    pm_bytes_write(path_of("mesh.ply"), (const uint8_t *)mesh, sizeof mesh - 1);
    refuse(path_of("mesh.ply"), "mesh.ply: is a PLY file, but not of photons (a mesh");
    CHECK(!pm_photon_file_is(path_of("mesh.ply")));
    pm_bytes_write(path_of("text"), (const uint8_t *)"hello\n", 6);
    refuse(path_of("text"), "text: is not a PLY file");
    pm_bytes_write(path_of("empty"), (const uint8_t *)"", 0);
    refuse(path_of("empty"), "empty: is not a PLY file");
    CHECK(!pm_photon_file_is(path_of("empty")) && !pm_photon_file_is(path_of("none")));
    pm_photon_map map;
    pm_photon_file_info told;
    CHECK_FAILS(pm_photon_file_read(path_of("none"), &map, &told, NULL), PM_EIO,
                "none: cannot be read: No such file");
    CHECK_FAILS(pm_photon_file_read(pm_test_folder(), &map, &told, NULL), PM_EIO,
                "it is a directory");
}

static void other_versions_and_forgeries_are_refused(void)
{
    forge("photons version 1", "photons version 1"); // the forger's CRC is right
    pm_photon_map map;
    pm_photon_file_info told;
    CHECK_OK(pm_photon_file_read(path_of("forged.ply"), &map, &told, NULL));
    pm_photon_map_free(&map);
    CHECK(pm_photon_file_is(path_of("forged.ply")));
    forge("photons version 1", "photons version 12");
    refuse(path_of("forged.ply"), "is a photon file of version 12; version 1 is read");
    forge("comment map caustic", "comment map castic");
    refuse(path_of("forged.ply"), "its header is altered");
    forge("element vertex 5", "element vertex 4294967301"); // 2^32 + 5
    refuse(path_of("forged.ply"), "its header is altered");
    forge("element vertex 5", "element vertex 2147483648");
    refuse(path_of("forged.ply"), "its header is altered");
    forge("element vertex 5", "element vertex 2147483647");
    refuse(path_of("forged.ply"), "is cut: its 2147483647 photons need 42949");
    forge("comment scale 0x1", "comment scale nan");
    refuse(path_of("forged.ply"), "its header is altered");
    forge("property ushort flags", "property ushort flags\nproperty uchar red");
    refuse(path_of("forged.ply"), "its header is altered");
}

static void photons_that_are_none_are_refused(void)
{
    pm_photon_map map = make_map(5, false);
    map.photons[3].position[1] = NAN;
    CHECK_OK(pm_photon_file_write(path_of("nan.ply"), &map, &info, NULL));
    refuse(path_of("nan.ply"), "nan.ply: photon 3 has a position that is not finite");
    map.photons[3].position[1] = 0.0F;
    map.photons[4].flags |= 3;
    CHECK_OK(pm_photon_file_write(path_of("axis.ply"), &map, &info, NULL));
    refuse(path_of("axis.ply"), "axis.ply: photon 4 has no split axis");
    pm_photon_map_free(&map);
}

static void no_room_leaves_no_file(void)
{
    pm_photon_map map = make_map(5000, false);
    signal(SIGXFSZ, SIG_IGN);
    struct rlimit limit = {50000, 50000};
    CHECK(setrlimit(RLIMIT_FSIZE, &limit) == 0);
    CHECK_FAILS(pm_photon_file_write(path_of("m.ply"), &map, &info, NULL), PM_EIO,
                "m.ply: cannot be written: File too large");
    CHECK_THAT(rmdir(pm_test_folder()) == 0, "a file was left behind");
    pm_photon_map_free(&map);
}

// Somebody else's reader finds the photons where we put them.
static void assimp_reads_the_positions(void)
{
    pm_photon_map map = make_map(50, false);
    CHECK_OK(pm_photon_file_write(path_of("m.ply"), &map, &info, NULL));
    const struct aiScene *scene = aiImportFile(path_of("m.ply"), 0);
    CHECK_THAT(scene != NULL, "%s", aiGetErrorString());
    CHECK(scene->mNumMeshes == 1 && scene->mMeshes[0]->mNumVertices == 50);
    for (uint32_t i = 0; i < 50; i++) {
        CHECK(scene->mMeshes[0]->mVertices[i].y == map.photons[i].position[1]);
    }
    aiReleaseImport(scene);
    pm_photon_map_free(&map);
}

PM_TESTS({"photon_file.1", "a map comes back bit for bit, packed or not", maps_come_back},
         {"photon_file.2", "any choice of columns comes back bit for bit", columns_come_back},
         {"photon_file.3", "the header is the PLY that the design describes",
          layout_is_that_of_the_design},
         {"photon_file.4", "a file with any one bit altered is refused",
          every_altered_bit_is_refused},
         {"photon_file.5", "a file that was cut anywhere, or grew, is refused",
          every_cut_is_refused},
         {"photon_file.6", "a mesh, a text, nothing and a folder are refused by name",
          other_files_are_named},
         {"photon_file.7", "another version and an impossible header are refused, CRC or not",
          other_versions_and_forgeries_are_refused},
         {"photon_file.8", "photons without a place or a split axis are refused",
          photons_that_are_none_are_refused},
         {"photon_file.9", "no room leaves no file", no_room_leaves_no_file},
         {"photon_file.10", "another program's reader finds the positions",
          assimp_reads_the_positions})
