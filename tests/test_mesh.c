// Meshes: what is read, from both formats and all kinds of PLY, and what is refused.
#include "mesh.h"
#include "ply.h"
#include "scene_text.h"
#include "test.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

static const char head[] =
    "ply\nformat %s 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\n"
    "property list uchar int vertex_indices\nend_header\n";

static pm_status read(const char *path, pm_mesh_format format, pm_arena *arena, pm_mesh *mesh)
{
    char reason[PM_MESH_REASON] = "";
    pm_status status = pm_mesh_read(path, format, arena, mesh, reason);
    return status == PM_OK ? PM_OK : pm_status_fail(status, "%s", reason);
}

static double area(const pm_mesh *mesh)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *c = mesh->triangles[i];
        pm_vec3 a = pm_vec_sub(mesh->vertices[c[1]], mesh->vertices[c[0]]);
        pm_vec3 b = pm_vec_sub(mesh->vertices[c[2]], mesh->vertices[c[0]]);
        sum += 0.5 * pm_vec_length(pm_vec_cross(a, b));
    }
    return sum;
}

/// Six times the volume within: positive when the triangles turn outward.
static double volume6(const pm_mesh *mesh)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *c = mesh->triangles[i];
        sum += pm_vec_dot(mesh->vertices[c[0]],
                          pm_vec_cross(mesh->vertices[c[1]], mesh->vertices[c[2]]));
    }
    return sum;
}

static void both_formats(void)
{
    pm_arena arena = {0};
    pm_mesh ply = {0};
    pm_mesh obj = {0};
    CHECK_OK(read("scenes/meshes/icosphere.ply", PM_MESH_PLY, &arena, &ply));
    CHECK_OK(read("scenes/meshes/icosphere.obj", PM_MESH_OBJ, &arena, &obj));
    CHECK(ply.vertex_count == 162 && ply.triangle_count == 320);
    CHECK(obj.triangle_count == 320);
    // Of the same icosphere in double: coordinates have six decimals.
    CHECK_NEAR(area(&ply), 12.32984859523469, 1e-5);
    CHECK_NEAR(volume6(&ply), 6.0 * 4.047044679978851, 1e-5);
    CHECK_NEAR(area(&obj), area(&ply), 1e-12);
    CHECK_NEAR(volume6(&obj), volume6(&ply), 1e-12);
    pm_arena_free(&arena);
}

static void polygons(void)
{
    pm_arena arena = {0};
    pm_mesh mesh = {0};
    const char *path = pm_scene_text_write(
        "fan.obj", "v 0 0 0\nv 2 0 0\nv 3 1 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4 5\nf -5 -4 -1\n");
    CHECK_OK(read(path, PM_MESH_OBJ, &arena, &mesh));
    CHECK(mesh.triangle_count == 4);
    CHECK_NEAR(area(&mesh), 5.0 + 2.0, 1e-12);
    pm_arena_free(&arena);
}

/// The triangle of `head` in binary, either way round. Its length.
static size_t make_binary(bool big, unsigned char *bytes, size_t room)
{
    const float xyz[9] = {0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 2.0f, 0.0f};
    int wrote =
        snprintf((char *)bytes, room, head, big ? "binary_big_endian" : "binary_little_endian");
    size_t used = (size_t)wrote;
    uint32_t word[12];
    memcpy(word, xyz, sizeof xyz);
    for (uint32_t i = 0; i < 3; i++) {
        word[9 + i] = i;
    }
    for (int i = 0; i < 12; i++) {
        if (i == 9) {
            bytes[used++] = 3;
        }
        for (int b = 0; b < 4; b++) {
            bytes[used++] = (unsigned char)(word[i] >> 8 * (big ? 3 - b : b));
        }
    }
    return used;
}

static void write_bytes(const char *path, const unsigned char *bytes, size_t size)
{
    FILE *stream = fopen(path, "wb");
    CHECK(stream != NULL);
    CHECK(fwrite(bytes, 1, size, stream) == size);
    CHECK(fclose(stream) == 0);
}

static void binary(void)
{
    unsigned char bytes[1000];
    for (int big = 0; big < 2; big++) {
        pm_arena arena = {0};
        pm_mesh mesh = {0};
        size_t size = make_binary(big == 1, bytes, sizeof bytes);
        const char *path = pm_scene_text_write("binary.ply", "");
        write_bytes(path, bytes, size);
        CHECK_OK(read(path, PM_MESH_PLY, &arena, &mesh));
        CHECK(mesh.triangle_count == 1);
        CHECK_NEAR(area(&mesh), 1.0, 0.0);
        pm_arena_free(&arena);
    }
}

static void cut_anywhere(void)
{
    unsigned char bytes[1000];
    size_t size = make_binary(false, bytes, sizeof bytes);
    pm_ply ply;
    CHECK(pm_ply_check((char *)bytes, size, &ply) == NULL);
    for (size_t length = 0; length < size; length++) {
        unsigned char cut[1000];
        memcpy(cut, bytes, length);
        cut[length] = '\0';
        CHECK_THAT(pm_ply_check((char *)cut, length, &ply) != NULL,
                   "a file cut to %zu of %zu bytes passes", length, size);
    }
}

static void check_header(const char *text, const char *wrong)
{
    pm_ply ply;
    const char *said = pm_ply_check(text, strlen(text), &ply);
    CHECK_CONTAINS(said == NULL ? "nothing" : said, wrong);
}

static void headers(void)
{
    check_header("", "not a PLY file");
    check_header("plyx\n", "not a PLY file");
    check_header("ply\nformat ascii 1.0\n", "end_header");
    check_header("ply\nend_header\n", "no format");
    check_header("ply\nformat text 1.0\nend_header\n", "a format that is not");
    check_header("ply\nformat ascii 2.0\nend_header\n", "a format that is not");
    check_header("ply\nformat ascii 1.0\nend_headers\nend_header\n", "none of PLY");
    check_header("ply\nformat ascii 1.0\nproper float x\nend_header\n", "none of PLY");
    check_header("ply\nformat ascii 1.0\nproperty float x\nend_header\n", "before its first");
    check_header("ply\nformat ascii 1.0\nelement face -3\nend_header\n", "without a count");
    check_header("ply\nformat ascii 1.0\nelement face 1\nproperty real x\nend_header\n",
                 "unknown type");
    check_header(
        "ply\nformat binary_little_endian 1.0\nelement vertex 9\nelement face 9999999999\n"
        "end_header\n",
        "cut short");
    check_header("ply\nformat ascii 1.0\ncomment photonlab photons 1\nelement vertex 9\n"
                 "end_header\n",
                 "photon file");
}

PM_TESTS({"mesh.1", "the icosphere is the same from PLY and from OBJ", both_formats},
         {"mesh.2", "polygons of OBJ become fans, negative indices count from the end",
          polygons},
         {"mesh.3", "binary PLY is read in both byte orders", binary},
         {"mesh.4", "a PLY file cut at any byte is refused", cut_anywhere},
         {"mesh.5", "a PLY header that makes no sense is refused", headers})
