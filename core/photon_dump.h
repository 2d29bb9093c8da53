// What a map holds, photon by photon, as CSV, with what the 20 bytes have no room for: the path
// that led there, its number of events and its light.
#ifndef PM_PHOTON_DUMP_H
#define PM_PHOTON_DUMP_H

#include "file.h"
#include "trace.h"

/// Writes `x,y,z,dx,dy,dz,r,g,b,map,path,bounce,light`. Position, direction and power are what
/// the map returns, the power scaled; path spells the events from the light to the deposit:
/// LD, LSSD, LV. Coordinates are the scene file's.
typedef struct {
    pm_file file;
    const pm_scene *scene;
    pm_photon_map one; // of the map's kind and packing, through which every photon goes
    uint64_t emitted;  // of the map
    char *events;      // of the current photon so far, S D V
    uint32_t room;
    pm_status status; // of an event: tracing cannot be told
} pm_photon_dump;

/// Opens the file and writes its header.
pm_status pm_photon_dump_begin(const char *path, const pm_scene *scene, pm_photon_dump *dump);

/// Turns to the next map: `emitted` photons are sent to fill it.
void pm_photon_dump_map(pm_photon_dump *dump, pm_map_kind kind, bool unpacked,
                        uint64_t emitted);

/// One event and one deposit: the two of pm_trace_sink, with the dump as context.
void pm_photon_dump_event(void *dump, const pm_start *start, const pm_event *event);
pm_status pm_photon_dump_deposit(void *dump, const pm_deposit *deposit);

/// Renames the file to its final name.
pm_status pm_photon_dump_commit(pm_photon_dump *dump);

/// Frees what it holds; removes the file when it was not committed.
void pm_photon_dump_free(pm_photon_dump *dump);

#endif
