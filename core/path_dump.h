// What every photon did, vertex by vertex, as CSV: what `view paths` draws and a student reads.
#ifndef PM_PATH_DUMP_H
#define PM_PATH_DUMP_H

#include "file.h"
#include "trace.h"

/// Writes `photon,step,event,x,y,z,r,g,b`: one row per vertex. Event L leaves the light, S, D
/// and V are what a surface or medium did, A was absorbed there, E escaped (where it leaves the
/// scene's bounding sphere), C was cut by a cap. r,g,b is the power [W] carried on, after
/// division by the photons emitted. Coordinates are the scene file's.
typedef struct {
    pm_file file;
    const pm_scene *scene;
    double scale;     // 1 / photons emitted
    uint64_t current; // photon whose L row is written
    bool begun;
} pm_path_dump;

/// Opens the file and writes its header.
pm_status pm_path_dump_begin(const char *path, const pm_scene *scene, uint64_t emitted,
                             pm_path_dump *dump);

/// One event (the form of pm_trace_sink.event, the dump as context).
void pm_path_dump_event(void *dump, const pm_start *start, const pm_event *event);

#endif
