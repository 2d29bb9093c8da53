// view: pictures of what the other programs wrote. Nothing is traced here: a kind of picture is
// a reader, a few things to draw, and a title.
//
//     view photons MAP.ply [MAP.ply ...] --scene SCENE.xml -o out.png
//     view paths PATHS.csv --scene SCENE.xml [--paths N] -o out.png
//     view tree MAP.ply --scene SCENE.xml [--depth D] -o out.png
//     view irradiance GRID.csv --scene SCENE.xml -o out.png
//     view contact A.exr B.exr ... -o sheet.png
#include "contact.h"
#include "draw.h"
#include "figure.h"
#include "grid_file.h"
#include "path_file.h"
#include "photon_cloud.h"
#include "photon_file.h"
#include "photon_map.h"
#include "program.h"
#include "scene_read.h"
#include "tree_split.h"
#include "viewpoint.h"

#include <jansson.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define NOTE_MAX 512
#define FILES_MAX 4
// Photons behind a tree: so bright, and so many at most.
#define BACKDROP 0.6
#define BACKDROP_MOST 20000

/// One picture on its way: what it is made from and of.
typedef struct {
    const pm_options *options;
    const char *const *files;
    int file_count;
    pm_scene scene;
    pm_figure *figure;
    pm_photon_cloud clouds[FILES_MAX]; // drawn without a copy: freed after the figure
    int cloud_count;
    uint64_t drawn; // photons, paths, split planes or grid points
    char note[NOTE_MAX];
} picture;

/// A kind of picture; `draw` draws its data in the scene and writes the note.
typedef struct {
    const char *name;
    int files_most;
    const char *title;
    pm_status (*draw)(picture *p); // NULL: there is no scene around it
} kind;

/// 1234567 as 1,234,567; `text` holds 32.
static const char *grouped(uint64_t value, char *text)
{
    char digits[32];
    int count = snprintf(digits, sizeof digits, "%llu", (unsigned long long)value);
    char *to = text;
    for (int i = 0; i < count; i++) {
        if (i > 0 && (count - i) % 3 == 0) {
            *to++ = ',';
        }
        *to++ = digits[i];
    }
    *to = '\0';
    return text;
}

/// Adds to the note; what does not fit is cut.
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static void
add_note(picture *p, const char *format, ...)
{
    size_t used = strlen(p->note);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(p->note + used, sizeof p->note - used, format, arguments);
    va_end(arguments);
}

/// Reads a photon file of this scene.
static pm_status read_map(const picture *p, const char *path, pm_photon_map *map)
{
    pm_photon_file_info info = {0};
    PM_TRY(pm_photon_file_read(path, map, &info, NULL));
    if (info.scene_hash != p->scene.hash) {
        pm_photon_map_free(map);
        return pm_status_fail(
            PM_EINPUT,
            "%s: these photons were traced in another scene than %s, or in an "
            "earlier version of it; write the file again",
            path, p->scene.path);
    }
    return PM_OK;
}

/// Unpacks a map as the picture's next cloud.
static pm_status add_cloud(picture *p, const char *path)
{
    pm_photon_map map = {0};
    PM_TRY(read_map(p, path, &map));
    pm_status status = pm_photon_cloud_make(&map, PM_MAP_MAX, &p->clouds[p->cloud_count]);
    pm_photon_map_free(&map);
    if (status == PM_OK) {
        p->drawn += p->clouds[p->cloud_count++].count;
    }
    return status;
}

/// So large that all dots together cover about the same area, whatever their number.
static double dot_size(uint64_t count)
{
    double size = 1.4 * sqrt(1e5 / (double)(count > 0 ? count : 1));
    return fmin(fmax(size, 1.0), 4.0);
}

/// One scale for all maps where their photons are equally strong, else one each.
static pm_status add_photon_scales(const picture *p)
{
    double first = p->clouds[0].full_power;
    bool same = true;
    for (int i = 1; i < p->cloud_count; i++) {
        same = same && fabs(p->clouds[i].full_power - first) <= 0.01 * first;
    }
    for (int i = 0; i < (same ? 1 : p->cloud_count); i++) {
        char heading[64];
        snprintf(heading, sizeof heading, "%s%spower of a photon [W]",
                 same ? "" : p->clouds[i].name, same ? "" : " map:\n");
        PM_TRY(pm_draw_photon_scale(p->figure, heading, p->clouds[i].full_power));
    }
    return PM_OK;
}

static pm_status draw_photons(picture *p)
{
    add_note(p,
             "every dot is a photon, in the colour of the light it brings (not of the wall it "
             "hits)\n");
    for (int i = 0; i < p->file_count; i++) {
        PM_TRY(add_cloud(p, p->files[i]));
    }
    for (int i = 0; i < p->cloud_count; i++) {
        char stored[32];
        char emitted[32];
        const pm_photon_cloud *cloud = &p->clouds[i];
        add_note(p, "%s%s map: %s stored of %s emitted", i > 0 ? "   |   " : "", cloud->name,
                 grouped(cloud->count, stored), grouped(cloud->emitted, emitted));
        PM_TRY(pm_draw_photons(p->figure, cloud, dot_size(p->drawn), 1.0));
    }
    return add_photon_scales(p);
}

static pm_status draw_paths(picture *p)
{
    pm_path_set paths;
    char drawn[32];
    char all[32];
    PM_TRY(pm_path_file_read(p->files[0], &p->scene, &paths));
    pm_status status = pm_draw_paths(p->figure, &paths, p->options->paths, &p->drawn);
    add_note(p,
             "from the light until a surface absorbs them or they leave the scene\n"
             "%s of %s paths drawn",
             grouped(p->drawn, drawn), grouped(paths.path_count, all));
    pm_path_file_free(&paths);
    return status;
}

static pm_status draw_splits(picture *p, const pm_photon_map *map)
{
    pm_tree_split_set tree;
    char count[32];
    char shown[32];
    PM_TRY(pm_tree_split_make(map, p->files[0], (int)p->options->depth, &tree));
    p->drawn = tree.count;
    add_note(
        p,
        "every plane goes through the median photon of its cell and cuts its longest side\n"
        "%s photons, tree %d deep; the first %d depths: %s planes",
        grouped(map->count, count), tree.height, tree.depths, grouped(tree.count, shown));
    pm_status status = pm_photon_cloud_make(map, BACKDROP_MOST, &p->clouds[0]);
    if (status == PM_OK) {
        p->cloud_count = 1;
        add_note(p, ", %s photons as dots", grouped(p->clouds[0].count, shown));
        status = pm_draw_photons(p->figure, &p->clouds[0], 1.0, BACKDROP);
    }
    if (status == PM_OK) {
        status = pm_draw_tree(p->figure, &tree);
    }
    pm_tree_split_free(&tree);
    return status;
}

static pm_status draw_tree(picture *p)
{
    pm_photon_map map = {0};
    PM_TRY(read_map(p, p->files[0], &map));
    pm_status status = draw_splits(p, &map);
    pm_photon_map_free(&map);
    return status;
}

static pm_status draw_irradiance(picture *p)
{
    pm_grid grid;
    PM_TRY(pm_grid_file_read(p->files[0], &p->scene, &grid));
    p->drawn = grid.columns * grid.rows;
    uint64_t fewest = UINT64_MAX;
    uint64_t most = 0;
    for (uint64_t i = 0; i < p->drawn; i++) {
        fewest = grid.points[i].found < fewest ? grid.points[i].found : fewest;
        most = grid.points[i].found > most ? grid.points[i].found : most;
    }
    add_note(p,
             "light arriving on a square metre, estimated from the photons nearest to each "
             "point\n%llu x %llu points, ",
             (unsigned long long)grid.columns, (unsigned long long)grid.rows);
    if (fewest < most) {
        add_note(p, "%llu to ", (unsigned long long)fewest);
    }
    add_note(p, "%llu photons each", (unsigned long long)most);
    pm_status status = pm_draw_irradiance(p->figure, &grid);
    pm_grid_file_free(&grid);
    return status;
}

static const kind kinds[] = {
    {"photons", FILES_MAX, "Photon map: where the light landed", draw_photons},
    {"paths", 1, "Photon paths", draw_paths},
    {"tree", 1, "kd-tree: how the photons are divided", draw_tree},
    {"irradiance", 1, "Irradiance", draw_irradiance},
    {"contact", PM_CONTACT_MOST, "Contact sheet", NULL},
};

static const kind *find_kind(const char *name)
{
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        if (strcmp(kinds[i].name, name) == 0) {
            return &kinds[i];
        }
    }
    return NULL;
}

static json_t *vector_json(pm_vec3 v)
{
    return json_pack("[f,f,f]", v.x, v.y, v.z);
}

/// Takes the reference.
static pm_status print_object(json_t *all)
{
    if (all == NULL || json_dumpf(all, stdout, JSON_COMPACT) != 0) {
        json_decref(all);
        return PM_FAIL(PM_EIO, "%s", "cannot write JSON to standard output");
    }
    printf("\n");
    json_decref(all);
    return PM_OK;
}

/// Where everything is in the picture: with this a reader finds the pixel of any point.
static pm_status print_json(const picture *p, const pm_viewpoint *v)
{
    json_t *camera = json_pack("{s:o,s:o,s:o,s:o,s:[f,f],s:[f,f]}", "position",
                               vector_json(pm_vec_add(v->position, p->scene.center)), "right",
                               vector_json(v->right), "up", vector_json(v->up), "forward",
                               vector_json(v->forward), "tan", v->tan_x, v->tan_y, "shift",
                               v->shift_x, v->shift_y);
    json_t *all =
        json_pack("{s:s,s:[i,i],s:I,s:s,s:o}", "picture", p->options->output, "size", v->width,
                  v->height, "drawn", (json_int_t)p->drawn, "note", p->note, "camera", camera);
    return print_object(all);
}

static pm_status make(picture *p, const kind *k)
{
    int width = p->options->width > 0 ? p->options->width : 1200;
    int height = p->options->height > 0 ? p->options->height : 900;
    pm_viewpoint viewpoint = pm_viewpoint_of(&p->scene, width, height);
    PM_TRY(pm_figure_open(&viewpoint, &p->figure));
    PM_TRY(pm_draw_scene(p->figure, &p->scene));
    PM_TRY(k->draw(p));
    const char *title = p->options->title != NULL ? p->options->title : k->title;
    PM_TRY(pm_figure_title(p->figure, title, p->note));
    PM_TRY(pm_figure_write(p->figure, p->options->output));
    return p->options->json ? print_json(p, &viewpoint) : PM_OK;
}

/// Everything about a contact sheet, which has no scene and no camera.
static pm_status make_contact(const pm_options *options, const char *title, pm_contact *sheet)
{
    PM_TRY(pm_contact_lay(sheet));
    PM_TRY(pm_contact_write(sheet, title, options->output));
    return options->json ? print_object(pm_contact_json(sheet, options->output)) : PM_OK;
}

static pm_status draw_contact(const picture *p, const kind *k)
{
    const pm_options *options = p->options;
    pm_contact sheet;
    if (options->scene != NULL || options->width > 0) {
        return pm_status_fail(PM_EINPUT,
                              "view: contact takes no %s: a sheet is as large as its pictures "
                              "ask, and they are whole",
                              options->scene != NULL ? "--scene" : "--size");
    }
    PM_TRY(pm_contact_read(p->files, p->file_count, options->exposure, &sheet));
    const char *title = options->title != NULL ? options->title : k->title;
    pm_status status = make_contact(options, title, &sheet);
    pm_contact_free(&sheet);
    return status;
}

static pm_status check_files(const picture *p, const kind *k)
{
    if (p->file_count < 1 || p->file_count > k->files_most) {
        return pm_status_fail(PM_EINPUT, "view: %s takes 1 to %d files, got %d", k->name,
                              k->files_most, p->file_count);
    }
    return PM_OK;
}

/// A kind that draws its data in the scene it came from.
static pm_status draw_in_scene(picture *p, const kind *k)
{
    const pm_options *options = p->options;
    if (options->scene == NULL) {
        return pm_status_fail(PM_EINPUT, "view: --scene SCENE.xml must be given for %s",
                              k->name);
    }
    PM_TRY(pm_scene_read(options->scene, options->define, options->define_count, false,
                         &p->scene));
    pm_status status = make(p, k);
    pm_figure_close(p->figure);
    for (int i = 0; i < p->cloud_count; i++) {
        pm_photon_cloud_free(&p->clouds[i]);
    }
    pm_scene_free(&p->scene);
    return status;
}

static pm_status run(const pm_options *options)
{
    const kind *k = find_kind(options->positional[0]);
    if (k == NULL) {
        return pm_status_fail(
            PM_EINPUT,
            "view: KIND must be photons, paths, tree, irradiance or contact, got \"%s\"",
            options->positional[0]);
    }
    picture p = {.options = options,
                 .files = options->positional + 1,
                 .file_count = options->positional_count - 1};
    PM_TRY(check_files(&p, k));
    return k->draw != NULL ? draw_in_scene(&p, k) : draw_contact(&p, k);
}

int main(int argc, char **argv)
{
    static const pm_options_program program = {
        .name = "view",
        .does = "Draws what other programs wrote: photons, paths, the kd-tree, irradiance,"
                " sheets of pictures.",
        .positional = "KIND FILE...",
        .positional_least = 2,
        .positional_most = 1 + PM_CONTACT_MOST,
        .options = "o scene depth paths size title exposure",
        .needs = "o",
        .notes =
            "KIND and its FILE: photons MAP.ply [MAP.ply ...], paths PATHS.csv (tracing "
            "--dump),\n"
            "tree MAP.ply, irradiance GRID.csv (radiance --grid --dump); each with --scene.\n"
            "contact A.exr B.exr ...: one sheet of pictures of one size, SCENE.SETTINGS.exr;\n"
            "neighbours of one scene share an exposure, to which --exposure adds. What their\n"
            "reports say (render --report SCENE.SETTINGS.json) stands beneath them.\n"
            "Other pictures are 1200x900 unless --size says otherwise. --json prints the "
            "camera,\n"
            "so that a program can find the pixel of any point.",
    };
    pm_options options;
    int code = 0;
    if (!pm_program_start(argc, argv, &program, &options, &code)) {
        return code;
    }
    return pm_program_end(run(&options));
}
