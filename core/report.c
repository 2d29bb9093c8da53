// Values are built bottom up; a missing one makes every value above it missing.
#include "report.h"

#include "file.h"
#include "light.h"
#include "map_make.h"

json_t *pm_report_add(json_t *object, const char *key, json_t *value)
{
    if (object == NULL || value == NULL || json_object_set(object, key, value) != 0) {
        json_decref(value);
        json_decref(object);
        return NULL;
    }
    json_decref(value);
    return object;
}

json_t *pm_report_append(json_t *array, json_t *value)
{
    if (array == NULL || value == NULL || json_array_append(array, value) != 0) {
        json_decref(value);
        json_decref(array);
        return NULL;
    }
    json_decref(value);
    return array;
}

static json_t *triple(double a, double b, double c)
{
    return json_pack("[f,f,f]", a, b, c);
}

json_t *pm_report_spectrum(pm_spectrum spectrum)
{
    return triple(spectrum.c[0], spectrum.c[1], spectrum.c[2]);
}

json_t *pm_report_vector(pm_vec3 vector)
{
    return triple(vector.x, vector.y, vector.z);
}

static pm_spectrum deviation(pm_spectrum variance)
{
    return pm_rgb(sqrt(variance.c[0]), sqrt(variance.c[1]), sqrt(variance.c[2]));
}

json_t *pm_report_flux(const pm_audit *audit)
{
    json_t *flux = json_object();
    flux = pm_report_add(flux, "emitted", pm_report_spectrum(audit->emitted));
    flux = pm_report_add(flux, "absorbed", pm_report_spectrum(audit->absorbed));
    flux = pm_report_add(flux, "escaped", pm_report_spectrum(audit->escaped));
    flux = pm_report_add(flux, "lost", pm_report_spectrum(audit->lost));
    flux = pm_report_add(flux, "roulette", pm_report_spectrum(audit->roulette));
    flux = pm_report_add(flux, "roulette_sd",
                         pm_report_spectrum(deviation(audit->roulette_variance)));
    flux = pm_report_add(flux, "dispersion", pm_report_spectrum(audit->dispersion));
    return pm_report_add(flux, "dispersion_sd",
                         pm_report_spectrum(deviation(audit->dispersion_variance)));
}

json_t *pm_report_plan(const pm_plan *plan)
{
    json_t *object = json_object();
    for (pm_plan_part part = 0; part < PM_PLAN_COUNT; part++) {
        const pm_plan_item *item = &plan->item[part];
        json_t *entry = json_pack("{s:b,s:s,s:s,s:s?}", "needed", item->needed, "why",
                                  item->why, "paths", pm_plan_paths(plan, part), "missing",
                                  item->missing ? item->left_out : NULL);
        object = pm_report_add(object, pm_plan_name(part), entry);
    }
    return object;
}

json_t *pm_report_projection(const pm_projections *projections, uint64_t emitted)
{
    json_int_t saved = (json_int_t)pm_projection_saved(projections, emitted);
    json_t *object = json_pack("{s:I,s:I}", "cells", (json_int_t)projections->cells, "active",
                               (json_int_t)projections->active);
    object = pm_report_add(object, "dark", pm_report_spectrum(projections->dark));
    object = pm_report_add(object, "saved", json_integer(saved));
    return pm_report_add(object, "why", json_string(projections->why));
}

json_t *pm_report_lights(const pm_scene *scene, const uint64_t *share)
{
    json_t *array = json_array();
    for (int i = 0; i < scene->light_count; i++) {
        const pm_light *light = &scene->lights[i];
        json_t *entry =
            json_pack("{s:s,s:s}", "id", light->id, "type", pm_light_name(light->type));
        entry = pm_report_add(entry, "flux", pm_report_spectrum(light->flux));
        if (share != NULL) {
            entry = pm_report_add(entry, "photons", json_integer((json_int_t)share[i]));
        }
        array = pm_report_append(array, entry);
    }
    return array;
}

json_t *pm_report_photons(const uint64_t photons[PM_MAP_COUNT])
{
    json_t *object = json_object();
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        json_t *count = json_integer((json_int_t)photons[kind]);
        object = pm_report_add(object, pm_map_name(kind), count);
    }
    return object;
}

json_t *pm_report_by_shape(const pm_scene *scene, const pm_audit *audit)
{
    json_t *object = json_object();
    for (int i = 0; i < scene->shape_count; i++) {
        const pm_audit_shape *books = &audit->shapes[i];
        json_t *entry = json_object();
        entry = pm_report_add(entry, "incident", pm_report_spectrum(books->incident));
        entry = pm_report_add(entry, "absorbed", pm_report_spectrum(books->absorbed));
        object = pm_report_add(object, scene->shapes[i].id, entry);
    }
    return object;
}

json_t *pm_report_by_medium(const pm_scene *scene, const pm_audit *audit)
{
    json_t *object = json_object();
    for (int i = 0; i < scene->medium_count; i++) {
        const pm_audit_medium *books = &audit->media[i];
        json_t *entry = json_pack("{s:I}", "collisions", (json_int_t)books->collisions);
        entry = pm_report_add(entry, "incident", pm_report_spectrum(books->incident));
        entry = pm_report_add(entry, "absorbed", pm_report_spectrum(books->absorbed));
        object = pm_report_add(object, scene->media[i].id, entry);
    }
    return object;
}

json_t *pm_report_map_sum(const pm_map_sum *sum)
{
    json_t *object = json_pack("{s:I,s:I}", "emitted", (json_int_t)sum->emitted, "stored",
                               (json_int_t)sum->stored);
    object = pm_report_add(object, "power", pm_report_spectrum(sum->power));
    object = pm_report_add(object, "refused", json_integer((json_int_t)sum->refused));
    object = pm_report_add(object, "clamped", json_integer((json_int_t)sum->clamped));
    object = pm_report_add(object, "vanished", json_integer((json_int_t)sum->vanished));
    return pm_report_add(object, "bytes", json_integer((json_int_t)sum->bytes));
}

json_t *pm_report_map(const pm_photon_map *map)
{
    pm_map_sum sum = pm_map_sum_of(map);
    return pm_report_map_sum(&sum);
}

json_t *pm_report_notes(const pm_scene *scene)
{
    json_t *array = json_array();
    for (int i = 0; i < scene->note_count; i++) {
        array = pm_report_append(array, json_string(scene->notes[i]));
    }
    return array;
}

static pm_status write_file(const char *path, const json_t *object)
{
    pm_file file;
    PM_TRY(pm_file_begin(path, &file));
    json_dumpf(object, file.stream, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
    fputc('\n', file.stream);
    return pm_file_commit(&file);
}

pm_status pm_report_end(const pm_options *options, json_t *object)
{
    if (object == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for the report, or a number in it is not finite");
    }
    pm_status status = PM_OK;
    if (options->report != NULL) {
        status = write_file(options->report, object);
    }
    if (status == PM_OK && options->json) {
        json_dumpf(object, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
        putchar('\n');
    }
    json_decref(object);
    return status;
}
