// What every photon did, vertex by vertex, as CSV: what `view paths` draws and a student reads.
//
// Tracing has one word, S, for a mirror and for glass. Which of them it was shows only in the
// way that the photon takes next, so such a row waits for the event after it.
#ifndef PM_PATH_DUMP_H
#define PM_PATH_DUMP_H

#include "file.h"
#include "trace.h"

#include <stdbool.h>

/// Writes `photon,step,event,x,y,z,r,g,b`: one row per vertex, those of a photon together.
/// Events: L leaves the light; D, S, T and V are what a surface or medium did: D a diffuse
/// lobe, S a specular one (delta or narrow) that left on the side it came from, T one that went
/// on through the surface, V a collision in a medium; A was absorbed there, E escaped (where it
/// leaves the scene's bounding sphere), C was cut by a cap. r,g,b is the power [W] carried on,
/// after division by the photons emitted. Coordinates are the scene file's.
typedef struct {
    pm_file file;
    const pm_scene *scene;
    double scale;     // 1 / photons emitted
    uint64_t current; // photon whose L row is written
    bool begun;
    bool waits; // an S row of the current photon, S or T by where the next event comes from
    uint32_t step;
    pm_vec3 at, normal; // normal on the side that it came from
    pm_spectrum power;
} pm_path_dump;

/// Opens the file and writes its header.
pm_status pm_path_dump_begin(const char *path, const pm_scene *scene, uint64_t emitted,
                             pm_path_dump *dump);

/// One event (the form of pm_trace_sink.event, the dump as context).
void pm_path_dump_event(void *dump, const pm_start *start, const pm_event *event);

/// Writes what waits, and the file is there. Without this, pm_file_abandon(&dump->file).
pm_status pm_path_dump_commit(pm_path_dump *dump);

#endif
