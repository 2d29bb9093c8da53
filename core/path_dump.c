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

void pm_path_dump_event(void *context, const pm_start *start, const pm_event *event)
{
    pm_path_dump *dump = context;
    if (!dump->begun || dump->current != start->photon) {
        row(dump, start->photon, 0, 'L', start->ray.origin, start->power);
        dump->begun = true;
        dump->current = start->photon;
    }
    pm_vec3 at = event->kind == PM_EVENT_ESCAPED
                     ? way_out(dump->scene, event->from, event->direction)
                     : event->position;
    row(dump, start->photon, event->bounce + 1, letter(event), at, event->carried);
}
