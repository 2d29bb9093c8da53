// The region's row says how many photons it holds, so a file that lost its end is noticed.
#include "gathered_file.h"

#include "csv.h"

#include <stdlib.h>
#include <string.h>

enum { WHAT, NUMBER, X, Y, Z, NX, NY, NZ, DX, DY, DZ, RED, GREEN, BLUE, DISTANCE, WEIGHT };

static pm_status read_spectrum(const pm_csv *csv, pm_spectrum *spectrum)
{
    for (int c = 0; c < 3; c++) {
        PM_TRY(pm_csv_positive(csv, RED + c, &spectrum->c[c]));
    }
    return PM_OK;
}

static pm_status read_region(const pm_csv *csv, const pm_scene *scene, pm_gathered *g)
{
    const char *what = csv->field[WHAT];
    g->disc = strcmp(what, "disc") == 0;
    if (!g->disc && strcmp(what, "sphere") != 0) {
        return pm_status_fail(PM_EINPUT,
                              "%s:%ld: the first row must be the region, sphere or disc, got "
                              "\"%.20s\"",
                              csv->path, csv->line, what);
    }
    PM_TRY(pm_csv_count(csv, NUMBER, UINT32_MAX, &g->found));
    PM_TRY(pm_csv_point(csv, X, scene, &g->at));
    PM_TRY(pm_csv_unit(csv, NX, &g->normal));
    PM_TRY(read_spectrum(csv, &g->irradiance));
    PM_TRY(pm_csv_positive(csv, DISTANCE, &g->radius));
    PM_TRY(pm_csv_positive(csv, WEIGHT, &g->flatness));
    if (!(g->flatness > 0.0 && g->flatness <= 1.0) || (g->radius == 0.0 && g->found > 0)) {
        return pm_status_fail(
            PM_EINPUT,
            "%s:%ld: a region with photons has a radius > 0 and is at most as "
            "high as wide, got radius %g, height over radius %g",
            csv->path, csv->line, g->radius, g->flatness);
    }
    return PM_OK;
}

static pm_status read_fate(const pm_csv *csv, pm_gathered_fate *fate)
{
    static const char *const words[] = {"counted", "rim", "near", "behind"};
    for (int i = 0; i < (int)(sizeof words / sizeof words[0]); i++) {
        if (strcmp(csv->field[WHAT], words[i]) == 0) {
            *fate = (pm_gathered_fate)i;
            return PM_OK;
        }
    }
    return pm_status_fail(
        PM_EINPUT, "%s:%ld: what must be one of counted, rim, near, behind, got \"%.20s\"",
        csv->path, csv->line, csv->field[WHAT]);
}

static pm_status read_photon(const pm_csv *csv, const pm_scene *scene,
                             pm_gathered_photon *photon)
{
    PM_TRY(read_fate(csv, &photon->fate));
    PM_TRY(pm_csv_point(csv, X, scene, &photon->position));
    PM_TRY(pm_csv_unit(csv, NX, &photon->normal));
    PM_TRY(pm_csv_unit(csv, DX, &photon->direction));
    PM_TRY(read_spectrum(csv, &photon->power));
    PM_TRY(pm_csv_positive(csv, DISTANCE, &photon->distance));
    return pm_csv_positive(csv, WEIGHT, &photon->weight);
}

static pm_status grow(pm_gathered *g, uint64_t *room)
{
    if (g->count < *room) {
        return PM_OK;
    }
    uint64_t wanted = *room == 0 ? 1024 : *room * 2;
    pm_gathered_photon *bigger = wanted <= SIZE_MAX / sizeof *bigger
                                     ? realloc(g->photons, (size_t)wanted * sizeof *bigger)
                                     : NULL;
    if (bigger == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %llu photons", (unsigned long long)wanted);
    }
    g->photons = bigger;
    *room = wanted;
    return PM_OK;
}

static pm_status read_photons(pm_csv *csv, const pm_scene *scene, pm_gathered *g)
{
    uint64_t room = 0;
    uint64_t inside = 0;
    uint64_t rims = 0;
    for (bool more = true;; g->count++) {
        PM_TRY(pm_csv_next(csv, &more));
        if (!more) {
            break;
        }
        PM_TRY(grow(g, &room));
        PM_TRY(read_photon(csv, scene, &g->photons[g->count]));
        pm_gathered_fate fate = g->photons[g->count].fate;
        inside += fate == PM_GATHERED_COUNTED || fate == PM_GATHERED_RIM;
        rims += fate == PM_GATHERED_RIM;
    }
    if (inside != g->found || rims > 1) {
        return pm_status_fail(PM_EINPUT,
                              "%s:%ld: the region holds %llu photons, at most one of them the "
                              "rim, but the file has %llu with %llu; write it again",
                              csv->path, csv->line, (unsigned long long)g->found,
                              (unsigned long long)inside, (unsigned long long)rims);
    }
    return PM_OK;
}

static pm_status read_all(pm_csv *csv, const pm_scene *scene, pm_gathered *g)
{
    bool more = false;
    PM_TRY(pm_csv_next(csv, &more));
    if (!more) {
        return pm_status_fail(PM_EINPUT, "%s:%ld: the file holds no region", csv->path,
                              csv->line);
    }
    PM_TRY(read_region(csv, scene, g));
    return read_photons(csv, scene, g);
}

pm_status pm_gathered_file_read(const char *path, const pm_scene *scene, pm_gathered *gathered)
{
    pm_csv csv;
    pm_gathered got = {0};
    pm_status status = pm_csv_open(path, PM_GATHERED_HEADER, "radiance --gathered", &csv);
    if (status == PM_OK) {
        status = read_all(&csv, scene, &got);
    }
    pm_csv_close(&csv);
    if (status != PM_OK) {
        pm_gathered_file_free(&got);
        return status;
    }
    *gathered = got;
    return PM_OK;
}

void pm_gathered_file_free(pm_gathered *gathered)
{
    free(gathered->photons);
    *gathered = (pm_gathered){0};
}
