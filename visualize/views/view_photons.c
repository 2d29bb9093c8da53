// view photons: where the light landed, photon by photon. Files are photon maps, or the table
// that storage dumps, which also knows each photon's bounces and light.
#include "draw_photons.h"
#include "photon_classes.h"
#include "photon_cloud.h"
#include "photon_file.h"
#include "photon_map.h"
#include "photon_table.h"
#include "view.h"
#include "view_kinds.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FILES_MOST 4
#define CLOUDS_MOST (FILES_MOST * PM_MAP_COUNT)

/// The clouds of one picture, drawn without a copy.
typedef struct {
    pm_photon_cloud cloud[CLOUDS_MOST];
    int count;
} clouds;

static void release_clouds(void *data)
{
    clouds *all = data;
    for (int i = 0; i < all->count; i++) {
        pm_photon_cloud_free(&all->cloud[i]);
    }
    free(all);
}

// --- reading --------------------------------------------------------------------------------

static pm_status make_cloud(const pm_view *view, const char *path, const pm_photon_map *map,
                            const pm_photon_file_info *info, const pm_photon_columns *columns,
                            pm_photon_cloud *cloud)
{
    PM_TRY(pm_view_check_hash(view, path, info->scene_hash));
    PM_TRY(pm_photon_cloud_make(map, PM_MAP_MAX, cloud));
    return pm_photon_cloud_mark(cloud, columns);
}

/// Unpacks a map as the next cloud.
static pm_status add_map(pm_view *view, clouds *all, const char *path)
{
    pm_photon_map map = {0};
    pm_photon_file_info info = {0};
    pm_photon_columns columns = {0};
    PM_TRY(pm_photon_file_read(path, &map, &info, &columns));
    pm_status status = make_cloud(view, path, &map, &info, &columns, &all->cloud[all->count++]);
    pm_photon_map_free(&map);
    pm_photon_columns_free(&columns);
    return status;
}

/// The maps of a table that have photons; one without any is a cloud, too.
static pm_status add_table(pm_view *view, clouds *all, const char *path)
{
    pm_photon_cloud read[PM_MAP_COUNT];
    PM_TRY(pm_photon_table_read(path, &view->scene, read));
    for (pm_map_kind map = 0; map < PM_MAP_COUNT; map++) {
        if (read[map].count > 0 || map == PM_MAP_GLOBAL) {
            all->cloud[all->count++] = read[map];
        } else {
            pm_photon_cloud_free(&read[map]);
        }
    }
    return PM_OK;
}

static bool is_table(const char *path)
{
    size_t length = strlen(path);
    return length > 4 && strcmp(path + length - 4, ".csv") == 0;
}

static pm_status read_files(pm_view *view, clouds *all)
{
    for (int i = 0; i < view->file_count; i++) {
        const char *path = view->files[i];
        PM_TRY(is_table(path) ? add_table(view, all, path) : add_map(view, all, path));
    }
    for (int i = 0; i < all->count; i++) {
        view->drawn += all->cloud[i].count;
    }
    return PM_OK;
}

// --- drawing --------------------------------------------------------------------------------

/// So large that all dots together cover about the same area, whatever their number.
static double dot_size(uint64_t count)
{
    double size = 1.4 * sqrt(1e5 / (double)(count > 0 ? count : 1));
    return fmin(fmax(size, 1.0), 4.0);
}

/// One scale for all maps where their photons are equally strong, else one each.
static pm_status add_scales(const pm_view *view, const clouds *all)
{
    double first = all->cloud[0].full_power;
    bool same = true;
    for (int i = 1; i < all->count; i++) {
        same = same && fabs(all->cloud[i].full_power - first) <= 0.01 * first;
    }
    for (int i = 0; i < (same ? 1 : all->count); i++) {
        char heading[64];
        snprintf(heading, sizeof heading, "%s%spower of a photon [W]",
                 same ? "" : all->cloud[i].name, same ? "" : " map:\n");
        PM_TRY(pm_draw_photon_scale(view->figure, heading, all->cloud[i].full_power));
    }
    return PM_OK;
}

static pm_status draw_by_power(pm_view *view, const clouds *all)
{
    for (int i = 0; i < all->count; i++) {
        PM_TRY(pm_draw_photons(view->figure, &all->cloud[i], dot_size(view->drawn), 1.0));
    }
    return add_scales(view, all);
}

static pm_status add_classes(const pm_view *view, const pm_photon_classes *classes)
{
    static const char *const headings[] = {[PM_BY_MAP] = "photons in each map",
                                           [PM_BY_BOUNCE] = "events on the way",
                                           [PM_BY_LIGHT] = "photons of each light"};
    char text[PM_PHOTON_CLASSES_MAX][PM_PHOTON_CLASS_TEXT + PM_VIEW_GROUPED_MAX];
    pm_legend_entry entries[PM_PHOTON_CLASSES_MAX];
    int shown = 0;
    for (int i = 0; i < classes->count; i++) {
        const pm_photon_class *class = &classes->list[i];
        char count[PM_VIEW_GROUPED_MAX];
        snprintf(text[i], sizeof text[i], "%s:  %s", class->text,
                 pm_view_grouped(class->count, count));
        if (class->count > 0 || classes->by == PM_BY_LIGHT) {
            entries[shown++] = (pm_legend_entry){PM_SWATCH_DOT, class->colour, text[i]};
        }
    }
    return pm_figure_legend(view->figure, headings[classes->by], entries, shown);
}

static pm_status paint(pm_view *view, pm_photon_classes *classes, const pm_photon_cloud *cloud)
{
    pm_colour *colours = malloc(((size_t)cloud->count + 1) * sizeof *colours);
    if (colours == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory to draw %u photons", cloud->count);
    }
    pm_photon_classes_paint(classes, cloud, colours);
    pm_status status =
        pm_draw_painted_photons(view->figure, cloud, colours, dot_size(view->drawn));
    free(colours);
    return status;
}

static json_t *counts_json(const pm_photon_classes *classes)
{
    json_t *counts = json_object();
    for (int i = 0; i < classes->count; i++) {
        json_object_set_new(counts, classes->list[i].text,
                            json_integer((json_int_t)classes->list[i].count));
    }
    return counts;
}

static pm_status draw_by_class(pm_view *view, const clouds *all, pm_by by)
{
    pm_photon_classes classes = pm_photon_classes_make(by, &view->scene);
    for (int i = 0; i < all->count; i++) {
        PM_TRY(paint(view, &classes, &all->cloud[i]));
    }
    pm_view_fact(view, "classes", counts_json(&classes));
    return add_classes(view, &classes);
}

// --- what is asked for ----------------------------------------------------------------------

/// Photon files seldom say where a photon has been.
static pm_status check_by(const clouds *all, pm_by by)
{
    static const char *const words[] = {
        [PM_BY_POWER] = "power", [PM_BY_MAP] = "map",     [PM_BY_BOUNCE] = "bounce",
        [PM_BY_LIGHT] = "light", [PM_BY_EVENT] = "event",
    };
    if (by == PM_BY_EVENT) {
        return pm_status_fail(PM_EINPUT, "%s",
                              "view: --by must be power, map, bounce or light for photons, got "
                              "\"event\"");
    }
    for (int i = 0; i < all->count; i++) {
        const pm_photon_cloud *cloud = &all->cloud[i];
        bool marked = by == PM_BY_BOUNCE ? cloud->bounce != NULL
                                         : by != PM_BY_LIGHT || cloud->light != NULL;
        if (!marked && cloud->count > 0) {
            return pm_status_fail(PM_EINPUT,
                                  "view: the photon file of the %s map does not say the %s of "
                                  "its photons; give the table of `storage --dump` instead",
                                  cloud->name, words[by]);
        }
    }
    return PM_OK;
}

static void write_note(pm_view *view, const clouds *all, pm_by by)
{
    static const char *const lines[] = {
        [PM_BY_POWER] =
            "every dot is a photon, in the colour of the light it brings (not of the wall it "
            "hits)",
        [PM_BY_MAP] = "every dot is a photon; what came over mirror or glass alone is stored "
                      "in the caustic map, too",
        [PM_BY_BOUNCE] = "every dot is a photon, coloured by how often it was reflected or let "
                         "through before it landed",
        [PM_BY_LIGHT] = "every dot is a photon, in the colour of the light it comes from",
    };
    pm_view_note(view, "%s\n", lines[by]);
    for (int i = 0; i < all->count; i++) {
        char stored[PM_VIEW_GROUPED_MAX];
        const pm_photon_cloud *cloud = &all->cloud[i];
        pm_view_note(view, "%s%s map: %s stored", i > 0 ? "   |   " : "", cloud->name,
                     pm_view_grouped(cloud->count, stored));
        if (cloud->emitted > 0) {
            char emitted[PM_VIEW_GROUPED_MAX];
            pm_view_note(view, " of %s emitted", pm_view_grouped(cloud->emitted, emitted));
        }
    }
}

static pm_status draw(pm_view *view)
{
    clouds *all = calloc(1, sizeof *all);
    if (all == NULL) {
        return PM_FAIL(PM_ENOMEM, "%s", "no memory for photons");
    }
    PM_TRY(pm_view_keep(view, all, release_clouds));
    pm_by by = view->options->by < 0 ? PM_BY_POWER : (pm_by)view->options->by;
    PM_TRY(read_files(view, all));
    PM_TRY(check_by(all, by));
    write_note(view, all, by);
    return by == PM_BY_POWER ? draw_by_power(view, all) : draw_by_class(view, all, by);
}

const pm_view_kind pm_view_photons = {
    .name = "photons",
    .files = "MAP.ply ... | PHOTONS.csv (storage -o, --dump)",
    .shows = "where the light landed",
    .files_least = 1,
    .files_most = FILES_MOST,
    .scene = PM_VIEW_IN_SCENE,
    .options = "by",
    .title = "Photon map: where the light landed",
    .draw = draw,
};
