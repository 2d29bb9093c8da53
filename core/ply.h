// What a PLY file says about itself, and whether all of it is there. Assimp reads on past the
// end of a file that was cut short, so this is asked first.
#ifndef PM_PLY_H
#define PM_PLY_H

#include <stddef.h>
#include <stdint.h>

typedef struct {
    uint64_t vertices, faces;
} pm_ply;

/// Checks a whole PLY file in memory, ascii or binary of either byte order.
///
/// @param bytes  `size` of them and a zero
/// @param ply    [out] untouched unless the result is NULL; both counts are > 0
/// @return NULL, or what is wrong, to follow the file's name: "is cut short" ...
const char *pm_ply_check(const char *bytes, size_t size, pm_ply *ply);

#endif
