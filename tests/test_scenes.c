// The scenes of the folder, each held to what its head comment says that it must give. The
// figures are looked for in the comment as well, so that neither can change alone.
#include "chance.h"
#include "photon_map.h"
#include "photon_pass.h"
#include "scene_text.h"
#include "test.h"

#include <dirent.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// What a head comment says.
typedef struct {
    const char *scene;
    const char *light; // its id
    const char *power; // [W] of that light in red, as written in the head
    uint32_t triangles;
} row;

static const row rows[] = {
    {"cornell-diffuse", "light-source", "6.45", 24},
    {"cornell-fog", "light-source", "6.45", 12},
    {"cornell-glossy", "light-source", "6.45", 0},
    {"cornell-spheres", "light-source", "6.45", 0},
    {"furnace", "glow", "75.398", 12},
    {"furnace-walls", "floor-glow", "12.566", 0},
    {"glass-fog", "light", "42.6367", 12},
    {"integrating-sphere", "lamp", "12.566", 0},
    {"lecture", "light-source", "6.45", 12},
    {"lights", "strong", "82.905", 0},
    {"lights", "stage-light", "1.91132", 0},
    {"lights", "weak", "0.075398", 0},
    {"lights", "sky", "5.7192", 0},
    {"mesh-spheres", "sun", "810.53", 640},
    {"prism", "beam", "8.24131", 8},
    {"prism", "lamp", "2.26195", 8},
    {"ring", "sun", "170.02", 0},
    {"shell", "warm", "117.62", 52000},
    {"shell", "cool", "20.106", 52000},
    {"sparse", "lamp", "50.2655", 24},
    {"square-over-floor", "light-source", "3.14159", 0},
    {"sun", "sun", "273.696", 24},
    {"water", "sun", "109.61", 73728},
};
enum { ROWS = sizeof rows / sizeof rows[0] };

static pm_scene open_scene(const char *name, const pm_define *defines, int count)
{
    char path[128];
    snprintf(path, sizeof path, "scenes/%s.xml", name);
    pm_scene scene;
    CHECK_OK(pm_scene_read(path, defines, count, true, &scene));
    return scene;
}

static uint32_t triangles_of(const pm_scene *scene)
{
    uint32_t sum = 0;
    for (int i = 0; i < scene->shape_count; i++) {
        sum += scene->shapes[i].triangle_count;
    }
    return sum;
}

/// The bytes of a file and a zero; the caller frees them.
static char *bytes_of(const char *path, size_t *length)
{
    enum { ROOM = 1 << 20 };
    FILE *in = fopen(path, "rb");
    CHECK_THAT(in != NULL, "%s cannot be opened", path);
    char *bytes = calloc(1, ROOM + 1);
    CHECK(bytes != NULL);
    *length = fread(bytes, 1, ROOM, in);
    CHECK_THAT(*length < ROOM, "%s is not smaller than 1 MiB", path);
    fclose(in);
    return bytes;
}

static void every_scene_is_listed(void)
{
    DIR *folder = opendir("scenes");
    CHECK(folder != NULL);
    for (struct dirent *entry = NULL; (entry = readdir(folder)) != NULL;) {
        char *end = strrchr(entry->d_name, '.');
        if (end == NULL || strcmp(end, ".xml") != 0) {
            continue;
        }
        *end = '\0';
        bool listed = false;
        for (int i = 0; i < ROWS; i++) {
            listed = listed || strcmp(rows[i].scene, entry->d_name) == 0;
        }
        CHECK_THAT(listed, "scenes/%s.xml has no row in this test", entry->d_name);
    }
    closedir(folder);
}

static void heads_teach_and_promise(void)
{
    for (int i = 0; i < ROWS; i++) {
        char path[128];
        size_t length = 0;
        snprintf(path, sizeof path, "scenes/%s.xml", rows[i].scene);
        char *text = bytes_of(path, &length);
        char *end = strstr(text, "-->");
        CHECK_THAT(end != NULL && end < strstr(text, "<scene"), "%s has no head", path);
        *end = '\0';
        CHECK_CONTAINS(text, "Teaches: ");
        CHECK_CONTAINS(text, "Must give: ");
        CHECK_CONTAINS(text, rows[i].power);
        free(text);
    }
}

/// Half a unit of the last digit of a decimal number.
static double half_digit(const char *number)
{
    const char *point = strchr(number, '.');
    return 0.5 * pow(10.0, -(double)strlen(point + 1));
}

static void lights_send_what_heads_promise(void)
{
    for (int i = 0; i < ROWS; i++) {
        pm_scene scene = open_scene(rows[i].scene, NULL, 0);
        int found = 0;
        for (int l = 0; l < scene.light_count; l++) {
            if (strcmp(scene.lights[l].id, rows[i].light) == 0) {
                found++;
                CHECK_NEAR(scene.lights[l].flux.c[0], atof(rows[i].power),
                           1.0001 * half_digit(rows[i].power));
            }
        }
        CHECK_THAT(found == 1, "%s: %d lights %s", rows[i].scene, found, rows[i].light);
        CHECK(triangles_of(&scene) == rows[i].triangles);
        pm_scene_free(&scene);
    }
}

// --- meshes

static void meshes_are_made_again_byte_for_byte(void)
{
    static const char *const names[] = {"water.ply", "shell.ply", "shell-coarse.ply"};
    const char *const argv[] = {PM_TEST_MESHES, pm_test_folder(), NULL};
    pm_test_ran ran = pm_test_run(argv, 20.0);
    CHECK_THAT(ran.exit_code == 0, "%s", ran.err);
    pm_test_ran_free(&ran);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char path[512];
        size_t length[2];
        snprintf(path, sizeof path, "scenes/meshes/%s", names[i]);
        char *kept = bytes_of(path, &length[0]);
        snprintf(path, sizeof path, "%s/%s", pm_test_folder(), names[i]);
        char *made = bytes_of(path, &length[1]);
        CHECK_THAT(length[0] == length[1] && memcmp(kept, made, length[0]) == 0,
                   "%s is not what the program makes", names[i]);
        free(kept);
        free(made);
    }
}

static void shell_takes_its_coarse_mesh(void)
{
    const pm_define coarse = {"mesh", "meshes/shell-coarse.ply"};
    pm_scene fine = open_scene("shell", NULL, 0);
    pm_scene plain = open_scene("shell", &coarse, 1);
    CHECK(triangles_of(&fine) > 50000 && triangles_of(&plain) == 5000);
    pm_scene_free(&fine);
    pm_scene_free(&plain);
}

// --- photons

typedef struct {
    pm_scene scene;
    pm_intersector world;
    pm_photon_map map;
    pm_pass_report report;
} pass;

/// Traces a map of a scene that is open; `tap` may be NULL.
static void run_pass(pass *p, pm_map_kind kind, uint64_t photons, const pm_trace_sink *tap)
{
    pm_pass_settings settings = {.seed = 3, .count = photons};
    if (tap != NULL) {
        settings.tap = *tap;
    }
    omp_set_num_threads(1);
    CHECK_OK(pm_intersect_embree(&p->scene, &p->world));
    CHECK_OK(pm_photon_pass(&p->world, kind, &settings, &p->map, &p->report));
}

static void end_pass(pass *p)
{
    pm_photon_map_free(&p->map);
    pm_pass_report_free(&p->report);
    pm_intersector_free(&p->world);
    pm_scene_free(&p->scene);
}

/// Bound for a sum over photons of Phi / n times their hits, in [W]: hits are geometric in the
/// channel that rules the roulette, with the albedo as its ratio.
static double hits_bound(double flux, double albedo, uint64_t photons)
{
    double variance = albedo / ((1.0 - albedo) * (1.0 - albedo));
    return flux * pm_chance_bound(variance, (double)photons);
}

static void furnace_walls_get_their_irradiance(void)
{
    enum { PHOTONS = 100000 };
    static const double rho[3] = {0.6, 0.5, 0.4};
    pass p = {.scene = open_scene("furnace", NULL, 0)};
    run_pass(&p, PM_MAP_GLOBAL, PHOTONS, NULL);
    double flux = p.scene.lights[0].flux.c[0];
    for (int c = 0; c < 3; c++) {
        // pi L_e / (1 - rho) on 24 m^2. Green and blue scatter less than red, which rules.
        CHECK_NEAR(p.report.deposited.c[c], 24.0 * PM_PI / (1.0 - rho[c]),
                   hits_bound(flux, rho[0], PHOTONS));
    }
    CHECK(p.report.audit.ended_escaped == 0);
    end_pass(&p);
}

typedef struct {
    double first, later; // [W] times photons, in red
} hits;

static pm_status add_hit(void *context, const pm_deposit *deposit)
{
    hits *h = context;
    *(deposit->first ? &h->first : &h->later) += deposit->power.c[0];
    return PM_OK;
}

static void sphere_gets_its_indirect_light(void)
{
    enum { PHOTONS = 100000 };
    hits h = {0.0, 0.0};
    pm_trace_sink tap = {&h, add_hit, NULL};
    pass p = {.scene = open_scene("integrating-sphere", NULL, 0)};
    run_pass(&p, PM_MAP_GLOBAL, PHOTONS, &tap);
    double flux = p.scene.lights[0].flux.c[0];
    CHECK_NEAR(h.first / PHOTONS, flux, 1e-9 * flux);
    CHECK_NEAR(h.later / PHOTONS, 1.5 * 4.0 * PM_PI, hits_bound(flux, 0.6, PHOTONS));
    end_pass(&p);
}

static void mirror_box_stores_nothing(void)
{
    pass p = {0};
    CHECK_OK(pm_scene_text_read(
        &p.scene, "<shape type='cube'><boolean name='flip_normals' value='true'/>"
                  "<transform name='to_world'><scale value='2'/></transform>"
                  "<bsdf type='conductor'><string name='material' value='none'/>"
                  "<rgb name='specular_reflectance' value='0.9'/></bsdf></shape>"));
    run_pass(&p, PM_MAP_GLOBAL, 10000, NULL);
    CHECK(p.map.count == 0 && p.report.deposits == 0);
    CHECK(p.report.audit.ended_absorbed == 10000);
    end_pass(&p);
}

// --- water

/// Adds what came down through the water; what the surface mirrors up to the walls flies up.
static pm_status add_sunken(void *context, const pm_deposit *deposit)
{
    if (deposit->direction.z < 0.0) {
        *(double *)context += deposit->power.c[0];
    }
    return PM_OK;
}

/// Share of unpolarised light that goes into water of this index.
static double enters(double cosine, double index)
{
    double a = acos(cosine);
    double b = asin(sin(a) / index);
    double s = sin(a - b) / sin(a + b);
    double p = tan(a - b) / tan(a + b);
    return 1.0 - 0.5 * (s * s + p * p);
}

/// Power in red that one triangle of the surface lets in; 0 where a wall's rim shades it.
static double let_in(const pass *p, const pm_shape *water, uint32_t triangle)
{
    const pm_light *sun = &p->scene.lights[0];
    const uint32_t *corner = water->triangles[triangle];
    pm_vec3 a = water->vertices[corner[0]];
    pm_vec3 b = water->vertices[corner[1]];
    pm_vec3 c = water->vertices[corner[2]];
    pm_vec3 twice = pm_vec_cross(pm_vec_sub(b, a), pm_vec_sub(c, a));
    double area = 0.5 * pm_vec_length(twice);
    double cosine = -pm_vec_dot(pm_vec_normalize(twice), sun->direction);
    pm_vec3 middle = pm_vec_scale(pm_vec_add(pm_vec_add(a, b), c), 1.0 / 3.0);
    pm_vec3 up = pm_vec_negate(sun->direction);
    pm_ray ray = {pm_vec_along(middle, up, 1e-3), up, HUGE_VAL, 0.0, PM_NONE};
    if (pm_blocked(&p->world, &ray)) {
        return 0.0;
    }
    const pm_material *m = &p->scene.materials[water->material[0]];
    return sun->emitted.c[0] * area * cosine * enters(cosine, m->int_ior / m->ext_ior);
}

static void pool_gets_what_the_surface_lets_in(void)
{
    enum { PHOTONS = 100000 };
    double sunken = 0.0;
    pm_trace_sink tap = {&sunken, add_sunken, NULL};
    pass p = {.scene = open_scene("water", NULL, 0)};
    run_pass(&p, PM_MAP_CAUSTIC, PHOTONS, &tap);
    const pm_shape *water = &p.scene.shapes[0];
    CHECK(strcmp(water->id, "surface") == 0);
    double want = 0.0;
    for (uint32_t i = 0; i < water->triangle_count; i++) {
        want += let_in(&p, water, i);
    }
    double flux = p.scene.lights[0].flux.c[0];
    double share = want / flux;
    CHECK_NEAR(want, 54.82, 0.01); // as its head says
    CHECK_NEAR(sunken / PHOTONS, want, flux * pm_chance_bound(share * (1.0 - share), PHOTONS));
    end_pass(&p);
}

static void ring_is_the_one_of_the_closed_form(void)
{
    pm_scene scene = open_scene("ring", NULL, 0);
    const pm_shape *ring = &scene.shapes[1];
    CHECK(ring->type == PM_SHAPE_CYLINDER && ring->material[0] == ring->material[1]);
    CHECK_NEAR(ring->radius, 1.0, 1e-12);
    CHECK_NEAR(ring->length, 0.4, 1e-12);
    CHECK_NEAR(scene.lights[0].direction.x, cos(PM_PI / 6.0), 1e-7);
    CHECK_NEAR(scene.lights[0].direction.z, -0.5, 1e-7);
    pm_scene_free(&scene);
}

PM_TESTS({"scenes.1", "every scene of the folder is held to its head comment",
          every_scene_is_listed},
         {"scenes.2", "every head says what the scene teaches and what it must give",
          heads_teach_and_promise},
         {"scenes.3", "lights send the power, meshes have the triangles that heads promise",
          lights_send_what_heads_promise},
         {"scenes.4", "the meshes in git are those that their program makes",
          meshes_are_made_again_byte_for_byte},
         {"scenes.5", "the shell takes its coarse mesh by a define",
          shell_takes_its_coarse_mesh},
         {"scenes.6", "the furnace's walls get pi L / (1 - rho), and nothing leaks",
          furnace_walls_get_their_irradiance},
         {"scenes.7", "the integrating sphere gets 1.5 W/m^2 of indirect light",
          sphere_gets_its_indirect_light},
         {"scenes.8", "a box of mirrors stores no photon", mirror_box_stores_nothing},
         {"scenes.9", "the pool gets what its waves let in",
          pool_gets_what_the_surface_lets_in},
         {"scenes.10", "the ring scene is the ring of the closed form",
          ring_is_the_one_of_the_closed_form})
