// Events arrive in photon order, and those of one photon in the order they happened.
#include "path_dump.h"

pm_status pm_path_dump_begin(const char *path, const pm_scene *scene, uint64_t emitted,
                             pm_path_dump *dump)
{
    *dump = (pm_path_dump){.scene = scene, .scale = 1.0 / (double)emitted};
    PM_TRY(pm_file_begin(path, &dump->file));
    fputs("photon,step,event,x,y,z,r,g,b\n", dump->file.stream);
    return PM_OK;
}

static void row(const pm_path_dump *dump, uint64_t photon, uint32_t step, char event,
                pm_vec3 at, pm_spectrum power)
{
    pm_vec3 place = pm_vec_add(at, dump->scene->center);
    pm_spectrum watts = pm_spectrum_scale(power, dump->scale);
    fprintf(dump->file.stream, "%llu,%u,%c,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n",
            (unsigned long long)photon, step, event, place.x, place.y, place.z, watts.c[0],
            watts.c[1], watts.c[2]);
}

/// Where the ray leaves the bounding sphere; from outside it, one radius on.
static pm_vec3 way_out(const pm_scene *scene, pm_vec3 from, pm_vec3 direction)
{
    double b = pm_vec_dot(from, direction);
    double c = pm_vec_dot(from, from) - scene->radius * scene->radius;
    double exit = -b + sqrt(fmax(0.0, b * b - c));
    return pm_vec_along(from, direction, exit > 0.0 ? exit : scene->radius);
}

static char letter(const pm_event *event)
{
    switch (event->kind) {
    case PM_EVENT_ESCAPED:
        return 'E';
    case PM_EVENT_CUT:
        return 'C';
    default:
        return event->scatter == 0 || event->kind == PM_EVENT_DONE ? 'A' : event->scatter;
    }
}

/// Writes the row that waits. With the direction in which the photon went on it is known
/// whether that was through the surface.
static void release_row(pm_path_dump *dump, const pm_vec3 *onward)
{
    if (!dump->waits) {
        return;
    }
    bool through = onward != NULL && pm_vec_dot(*onward, dump->normal) < 0.0;
    row(dump, dump->current, dump->step, through ? 'T' : 'S', dump->at, dump->power);
    dump->waits = false;
}

static void begin_photon(pm_path_dump *dump, const pm_start *start)
{
    release_row(dump, NULL); // a stage that forgot its photon: the row is as it was told
    row(dump, start->photon, 0, 'L', start->ray.origin, start->power);
    dump->begun = true;
    dump->current = start->photon;
}

void pm_path_dump_event(void *context, const pm_start *start, const pm_event *event)
{
    pm_path_dump *dump = context;
    if (!dump->begun || dump->current != start->photon) {
        begin_photon(dump, start);
    }
    release_row(dump, &event->direction);
    pm_vec3 at = event->kind == PM_EVENT_ESCAPED
                     ? way_out(dump->scene, event->from, event->direction)
                     : event->position;
    char what = letter(event);
    if (what != 'S' || event->lobes == NULL) {
        row(dump, start->photon, event->bounce + 1, what, at, event->carried);
        return;
    }
    dump->waits = true;
    dump->step = event->bounce + 1;
    dump->at = at;
    dump->normal = event->lobes->normal;
    dump->power = event->carried;
}

pm_status pm_path_dump_commit(pm_path_dump *dump)
{
    release_row(dump, NULL);
    return pm_file_commit(&dump->file);
}
