// Our bsdfs beside Mitsuba 3's, from tests/peers/materials.txt (made by materials.py there).
#include "scene_text.h"
#include "scenes.h"
#include "test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// How far a value may lie off, of itself: Mitsuba works in float. Beckmann's masking is a
/// rational fit there, below 0.35 % off (and used twice); what a coat keeps in is a fit as
/// well.
static double tolerance_of(const pm_material *material)
{
    switch (material->type) {
    case PM_BSDF_PLASTIC:
        return 3e-3;
    case PM_BSDF_ROUGH_PLASTIC:
        return 8e-3;
    case PM_BSDF_ROUGH_CONDUCTOR:
        return material->microfacet == PM_MICROFACET_GGX ? 2e-5 : 7e-3;
    default:
        return 1e-5;
    }
}

static pm_lobes lobes_of(const pm_scene *scene, pm_vec3 wi)
{
    pm_hit hit = {.normal = pm_vec(0.0, 0.0, 1.0), .offset = PM_OFFSET};
    pm_lobes lobes;
    pm_ray along = {.direction = pm_vec_negate(wi), .medium = PM_NONE};
    pm_material_lobes(scene, &hit, &along, &lobes);
    return lobes;
}

static void check_value(const pm_scene *scene, const double *row)
{
    pm_lobes lobes = lobes_of(scene, pm_vec_normalize(pm_vec(row[0], row[1], row[2])));
    pm_vec3 wo = pm_vec_normalize(pm_vec(row[3], row[4], row[5]));
    pm_spectrum sum = pm_gray(0.0);
    for (int i = 0; i < lobes.count; i++) {
        sum = pm_spectrum_add(sum, pm_material_value(&lobes, i, wo));
    }
    for (int c = 0; c < 3; c++) {
        double want = row[6 + c];
        CHECK_NEAR(sum.c[c] * wo.z, want, tolerance_of(scene->materials) * want + 1e-9);
    }
}

static void check_smooth(const pm_scene *scene, const double *row)
{
    pm_lobes lobes = lobes_of(scene, pm_scenes_slant(row[0]));
    CHECK(lobes.count == 2);
    for (int i = 0; i < 2; i++) {
        CHECK_NEAR(lobes.lobe[i].albedo.c[0], row[1 + i], 1e-5);
    }
}

/// The numbers of a line, at most 9; their count.
static int numbers_of(const char *text, double *row)
{
    int count = 0;
    for (char *end; count < 9; count++, text = end) {
        row[count] = strtod(text, &end);
        if (end == text) {
            break;
        }
    }
    return count;
}

static void as_mitsuba(void)
{
    FILE *table = fopen("tests/peers/materials.txt", "r");
    CHECK(table != NULL);
    pm_scene scene = {0};
    char line[500];
    int rows = 0;
    while (fgets(line, sizeof line, table) != NULL) {
        double row[9];
        if (strncmp(line, "bsdf ", 5) == 0) {
            pm_scene_free(&scene);
            CHECK_OK(
                pm_scene_text_read(&scene, "<shape type='rectangle'>%s</shape>", line + 5));
        } else if (strncmp(line, "smooth ", 7) == 0) {
            CHECK(numbers_of(line + 7, row) == 3);
            check_smooth(&scene, row);
            rows++;
        } else {
            CHECK(numbers_of(line, row) == 9);
            check_value(&scene, row);
            rows++;
        }
    }
    pm_scene_free(&scene);
    fclose(table);
    CHECK_THAT(rows == 64, "%d rows", rows);
}

PM_TESTS({"material.50", "values are Mitsuba's, for every bsdf that has any", as_mitsuba})
