// Events arrive in photon order and, of one photon, in the order they happened, each before the
// deposit that follows it; an event's bounce is its place in the path, so nothing is reset.
#include "photon_dump.h"

#include "map_make.h"
#include "photon_map.h"
#include "store.h"

#include <stdlib.h>

pm_status pm_photon_dump_begin(const char *path, const pm_scene *scene, pm_photon_dump *dump)
{
    *dump = (pm_photon_dump){.scene = scene};
    PM_TRY(pm_file_begin(path, &dump->file));
    fputs("x,y,z,dx,dy,dz,r,g,b,map,path,bounce,light\n", dump->file.stream);
    return PM_OK;
}

void pm_photon_dump_map(pm_photon_dump *dump, pm_map_kind kind, bool unpacked, uint64_t emitted)
{
    pm_photon_map_free(&dump->one);
    dump->one = (pm_photon_map){.kind = kind, .unpacked = unpacked};
    dump->emitted = emitted;
}

static pm_status grow(pm_photon_dump *dump, uint32_t bounce)
{
    if (bounce < dump->room) {
        return PM_OK;
    }
    size_t room = 2 * (size_t)bounce + 64;
    char *moved = realloc(dump->events, room);
    if (moved == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for a path of %u events", bounce);
    }
    dump->events = moved;
    dump->room = (uint32_t)room;
    return PM_OK;
}

void pm_photon_dump_event(void *context, const pm_start *start, const pm_event *event)
{
    pm_photon_dump *dump = context;
    (void)start;
    if (event->scatter == 0 || dump->status != PM_OK) {
        return;
    }
    dump->status = grow(dump, event->bounce);
    if (dump->status == PM_OK) {
        dump->events[event->bounce] = event->scatter;
    }
}

static void write_row(const pm_photon_dump *dump, const pm_deposit *deposit)
{
    pm_photon_view photon = pm_store_unpack(&dump->one, 0);
    pm_vec3 at = pm_vec_add(photon.position, dump->scene->center);
    pm_vec3 way = photon.direction;
    const double *power = photon.power.c;
    FILE *out = dump->file.stream;
    fprintf(out, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%s,L", at.x, at.y, at.z, way.x,
            way.y, way.z, power[0], power[1], power[2], pm_map_name(dump->one.kind));
    if (deposit->bounce > 0) { // before the first event there is no room for events
        fwrite(dump->events, 1, deposit->bounce, out);
    }
    fprintf(out, "%c,%u,%u\n", deposit->in_medium ? 'V' : 'D', deposit->bounce, deposit->light);
}

pm_status pm_photon_dump_deposit(void *context, const pm_deposit *deposit)
{
    pm_photon_dump *dump = context;
    PM_TRY(dump->status);
    dump->one.count = 0;
    dump->one.scaled = false;
    PM_TRY(pm_store_push(&dump->one, deposit));
    if (dump->one.count == 1) { // else the map refuses it, too
        PM_TRY(pm_store_scale(&dump->one, dump->emitted));
        write_row(dump, deposit);
    }
    return PM_OK;
}

pm_status pm_photon_dump_commit(pm_photon_dump *dump)
{
    return pm_file_commit(&dump->file);
}

void pm_photon_dump_free(pm_photon_dump *dump)
{
    pm_file_abandon(&dump->file);
    pm_photon_map_free(&dump->one);
    free(dump->events);
    dump->events = NULL;
    dump->room = 0;
}
