// Triangle meshes from PLY and OBJ files, by Assimp. Only positions and triangles are taken:
// smooth normals, texture coordinates and materials of the file are not modelled.
#ifndef PM_MESH_H
#define PM_MESH_H

#include "arena.h"
#include "status.h"
#include "vec.h"

#include <stdint.h>

typedef enum {
    PM_MESH_PLY,
    PM_MESH_OBJ,
} pm_mesh_format;

typedef struct {
    pm_vec3 *vertices; // in the file's own coordinates
    uint32_t (*triangles)[3];
    uint32_t vertex_count, triangle_count;
} pm_mesh;

#define PM_MESH_REASON 240 // bytes

/// Reads the mesh in `path`. Faces of OBJ files with more than three corners become fans, as in
/// Mitsuba; PLY files must have triangles only, as in Mitsuba.
///
/// @param arena   takes the arrays
/// @param mesh    [out] untouched unless PM_OK
/// @param reason  [out] unless PM_OK: what is wrong with the file, without its path
/// @return PM_EINPUT when the file is not a mesh, has no triangle, an index beyond its vertices
/// or
///         a coordinate that is not finite; PM_EIO when it cannot be read; PM_ENOMEM
pm_status pm_mesh_read(const char *path, pm_mesh_format format, pm_arena *arena, pm_mesh *mesh,
                       char reason[PM_MESH_REASON]);

#endif
