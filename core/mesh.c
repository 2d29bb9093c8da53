// Assimp is given the bytes, not the path, so that it opens no further files, and is asked for
// no post-processing: its own steps stop the whole program on faces without corners. It does
// not notice indices beyond the vertices, files cut short, or coordinates that are not finite,
// so all of that is checked here.
#include "mesh.h"

#include "ply.h"

#include <assimp/cimport.h>
#include <assimp/scene.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
static pm_status
say(char *reason, pm_status code, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reason, PM_MESH_REASON, format, arguments);
    va_end(arguments);
    return code;
}

typedef struct {
    char *bytes; // zero-terminated
    size_t size;
} blob;

static pm_status read_open(FILE *stream, blob *file, char *reason)
{
    struct stat about;
    if (fstat(fileno(stream), &about) != 0 || !S_ISREG(about.st_mode)) {
        return say(reason, PM_EIO, "is not a file");
    }
    if ((uint64_t)about.st_size >= UINT32_MAX) {
        return say(reason, PM_EINPUT, "is larger than 4 GiB");
    }
    size_t size = (size_t)about.st_size;
    char *bytes = malloc(size + 1);
    if (bytes == NULL) {
        return say(reason, PM_ENOMEM, "does not fit into memory");
    }
    if (fread(bytes, 1, size, stream) != size) {
        free(bytes);
        return say(reason, PM_EIO, "cannot be read to its end");
    }
    bytes[size] = '\0';
    *file = (blob){bytes, size};
    return PM_OK;
}

static pm_status read_blob(const char *path, blob *file, char *reason)
{
    FILE *stream = fopen(path, "rb");
    if (stream == NULL) {
        return say(reason, PM_EIO, "cannot be read: %s", strerror(errno));
    }
    pm_status status = read_open(stream, file, reason);
    fclose(stream);
    return status;
}

/// What can be said before Assimp reads: `ply` stays zero for other formats.
static pm_status check_start(const blob *file, pm_mesh_format format, pm_ply *ply, char *reason)
{
    if (file->size == 0) {
        return say(reason, PM_EINPUT, "is empty");
    }
    if (format == PM_MESH_PLY) {
        const char *wrong = pm_ply_check(file->bytes, file->size, ply);
        return wrong == NULL ? PM_OK : say(reason, PM_EINPUT, "%s", wrong);
    }
    if (strncmp(file->bytes, "ply", 3) == 0) {
        return say(reason, PM_EINPUT, "is a PLY file, not an OBJ file");
    }
    return PM_OK;
}

/// Corners and triangles of all parts together; faces that are no polygon are refused.
static pm_status measure(const struct aiScene *parts, bool triangles_only, uint64_t *vertices,
                         uint64_t *triangles, char *reason)
{
    *vertices = 0;
    *triangles = 0;
    for (unsigned p = 0; p < parts->mNumMeshes; p++) {
        const struct aiMesh *part = parts->mMeshes[p];
        *vertices += part->mNumVertices;
        for (unsigned f = 0; f < part->mNumFaces; f++) {
            unsigned corners = part->mFaces[f].mNumIndices;
            if (corners < 3) {
                return say(reason, PM_EINPUT, "face %u has %u corners, not three", f + 1,
                           corners);
            }
            if (corners > 3 && triangles_only) {
                return say(reason, PM_EINPUT,
                           "face %u has %u corners: a PLY mesh must have triangles only", f + 1,
                           corners);
            }
            *triangles += corners - 2;
        }
    }
    if (*triangles == 0) {
        return say(reason, PM_EINPUT, "has no triangle");
    }
    if (*vertices > INT32_MAX || *triangles > INT32_MAX) {
        return say(reason, PM_EINPUT, "has more than 2^31 - 1 vertices or triangles");
    }
    return PM_OK;
}

static pm_status take_vertices(const struct aiMesh *part, pm_mesh *mesh, char *reason)
{
    for (unsigned i = 0; i < part->mNumVertices; i++) {
        const struct aiVector3D *v = &part->mVertices[i];
        pm_vec3 at = {(double)v->x, (double)v->y, (double)v->z};
        if (!isfinite(at.x) || !isfinite(at.y) || !isfinite(at.z)) {
            return say(reason, PM_EINPUT, "vertex %u has a coordinate that is not finite",
                       i + 1);
        }
        mesh->vertices[mesh->vertex_count++] = at;
    }
    return PM_OK;
}

static pm_status take_faces(const struct aiMesh *part, uint32_t first, pm_mesh *mesh,
                            char *reason)
{
    for (unsigned f = 0; f < part->mNumFaces; f++) {
        const struct aiFace *face = &part->mFaces[f];
        for (unsigned c = 0; c < face->mNumIndices; c++) {
            if (face->mIndices[c] >= part->mNumVertices) {
                return say(reason, PM_EINPUT,
                           "face %u has vertex index %d; there are %u vertices", f + 1,
                           (int)face->mIndices[c], part->mNumVertices);
            }
        }
        for (unsigned c = 2; c < face->mNumIndices; c++) {
            uint32_t *corner = mesh->triangles[mesh->triangle_count++];
            corner[0] = first + face->mIndices[0];
            corner[1] = first + face->mIndices[c - 1];
            corner[2] = first + face->mIndices[c];
        }
    }
    return PM_OK;
}

static pm_status take(const struct aiScene *parts, pm_mesh_format format, pm_arena *arena,
                      pm_mesh *mesh, char *reason)
{
    uint64_t vertices;
    uint64_t triangles;
    PM_TRY(measure(parts, format == PM_MESH_PLY, &vertices, &triangles, reason));
    pm_mesh taken = {0};
    taken.vertices = pm_arena_take(arena, (size_t)vertices, sizeof *taken.vertices);
    taken.triangles = pm_arena_take(arena, (size_t)triangles, sizeof *taken.triangles);
    if (taken.vertices == NULL || taken.triangles == NULL) {
        return say(reason, PM_ENOMEM, "does not fit into memory");
    }
    for (unsigned p = 0; p < parts->mNumMeshes; p++) {
        uint32_t first = taken.vertex_count;
        PM_TRY(take_vertices(parts->mMeshes[p], &taken, reason));
        PM_TRY(take_faces(parts->mMeshes[p], first, &taken, reason));
    }
    *mesh = taken;
    return PM_OK;
}

static pm_status read_bytes(const blob *file, pm_mesh_format format, pm_arena *arena,
                            pm_mesh *mesh, char *reason)
{
    pm_ply ply = {0};
    PM_TRY(check_start(file, format, &ply, reason));
    const struct aiScene *parts = aiImportFileFromMemory(file->bytes, (unsigned)file->size, 0,
                                                         format == PM_MESH_PLY ? "ply" : "obj");
    if (parts == NULL) {
        return say(reason, PM_EINPUT, "cannot be understood: %.160s", aiGetErrorString());
    }
    pm_mesh taken;
    pm_status status = take(parts, format, arena, &taken, reason);
    aiReleaseImport(parts);
    PM_TRY(status);
    if (format == PM_MESH_PLY &&
        (taken.vertex_count != ply.vertices || taken.triangle_count != ply.faces)) {
        return say(reason, PM_EINPUT,
                   "gives %u vertices and %u faces where its header has others",
                   taken.vertex_count, taken.triangle_count);
    }
    *mesh = taken;
    return PM_OK;
}

pm_status pm_mesh_read(const char *path, pm_mesh_format format, pm_arena *arena, pm_mesh *mesh,
                       char reason[PM_MESH_REASON])
{
    blob file = {NULL, 0};
    PM_TRY(read_blob(path, &file, reason));
    pm_status status = read_bytes(&file, format, arena, mesh, reason);
    free(file.bytes);
    return status;
}
