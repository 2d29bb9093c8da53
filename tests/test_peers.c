// Our pictures against Mitsuba's, which tests/peers/measure.py measured once and wrote to
// tests/peers/mitsuba.json: means over regions, with their errors. Mitsuba itself is not
// needed.
//
// Compared is what Mitsuba showed: the whole picture but for lamps; where it traced light to
// the camera (ring, water), all pixels that see something diffuse first.
#include "reference.h"
#include "render.h"
#include "scene_read.h"
#include "test.h"

#include <jansson.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>

enum { SIDE = 64, GRID = 4, REGIONS = GRID * GRID + 1, RUNS = 4 }; // the last is the whole

/// Radiance by region: mean over independent pictures, and the variance of that mean.
typedef struct {
    bool counts[REGIONS];
    double mean[REGIONS][3];
    double variance[REGIONS][3];
} regions;

/// What Mitsuba gave for one scene.
typedef struct {
    json_t *file;
    char path[128];
    bool from_lights;          // it traced light to the camera
    const char *letters[SIDE]; // see measure.py
    int pixels[REGIONS];
    regions seen;
} peer;

// --- Mitsuba's side

static bool is_counted(const peer *p, int x, int y)
{
    char letter = p->letters[y][x];
    return letter == '.' || (letter == 'S' && !p->from_lights);
}

static int region_at(int x, int y)
{
    return y / (SIDE / GRID) * GRID + x / (SIDE / GRID);
}

static json_t *entry_of(const json_t *file, const char *name, char path[128])
{
    size_t i = 0;
    json_t *entry = NULL;
    bool whole = strstr(name, ".xml") != NULL;
    snprintf(path, 128, whole ? "%s" : "scenes/%s.xml", name);
    json_array_foreach(json_object_get(file, "scenes"), i, entry)
    {
        if (strcmp(json_string_value(json_object_get(entry, "scene")), path) == 0) {
            return entry;
        }
    }
    pm_test_fail(__FILE__, __LINE__, "mitsuba.json has no %s", path);
}

static double number_in(const json_t *entry, const char *key, size_t channel)
{
    return json_number_value(json_array_get(json_object_get(entry, key), channel));
}

static void read_region(peer *p, int region, const json_t *entry)
{
    p->seen.counts[region] = json_is_object(entry);
    for (size_t c = 0; c < 3 && p->seen.counts[region]; c++) {
        double error = number_in(entry, "error", c);
        p->seen.mean[region][c] = number_in(entry, "mean", c);
        p->seen.variance[region][c] = error * error;
    }
}

/// Counts pixels, and makes the last region of the others that count.
static void add_up(peer *p)
{
    const int whole = REGIONS - 1;
    for (int i = 0; i < SIDE * SIDE; i++) {
        p->pixels[region_at(i % SIDE, i / SIDE)] += is_counted(p, i % SIDE, i / SIDE);
    }
    for (int r = 0; r < whole; r++) {
        p->pixels[whole] += p->seen.counts[r] ? p->pixels[r] : 0;
    }
    p->seen.counts[whole] = true;
    for (int r = 0; r < whole; r++) {
        double weight = p->seen.counts[r] ? (double)p->pixels[r] / p->pixels[whole] : 0.0;
        for (int c = 0; c < 3; c++) {
            p->seen.mean[whole][c] += weight * p->seen.mean[r][c];
            p->seen.variance[whole][c] += weight * weight * p->seen.variance[r][c];
        }
    }
}

static peer open_peer(const char *name)
{
    peer p = {0};
    json_error_t error;
    p.file = json_load_file("tests/peers/mitsuba.json", 0, &error);
    CHECK_THAT(p.file != NULL, "mitsuba.json:%d: %s", error.line, error.text);
    CHECK(json_integer_value(json_object_get(p.file, "side")) == SIDE);
    CHECK(json_integer_value(json_object_get(p.file, "grid")) == GRID);
    json_t *entry = entry_of(p.file, name, p.path);
    const char *integrator = json_string_value(json_object_get(entry, "integrator"));
    p.from_lights = strcmp(integrator, "ptracer") == 0;
    for (size_t y = 0; y < SIDE; y++) {
        const json_t *rows = json_object_get(entry, "pixels");
        p.letters[y] = json_string_value(json_array_get(rows, y));
        CHECK(p.letters[y] != NULL && strlen(p.letters[y]) == SIDE);
    }
    for (int r = 0; r < REGIONS - 1; r++) {
        const json_t *all = json_object_get(entry, "regions");
        read_region(&p, r, json_array_get(all, (size_t)r));
    }
    add_up(&p);
    return p;
}

// --- our side

static void open_world(const peer *p, pm_scene *scene, pm_intersector *world)
{
    char side[16];
    snprintf(side, sizeof side, "%d", SIDE);
    const pm_define size[2] = {{"width", side}, {"height", side}};
    CHECK_OK(pm_scene_read(p->path, size, 2, true, scene));
    CHECK_OK(pm_intersect_embree(scene, world));
    omp_set_num_threads(1); // the runner keeps the other cores busy
}

/// Adds the means of one picture, and their squares, to `sums`. Channels: "R" after `prefix`.
static void add_picture(const peer *p, const pm_image *image, const char *prefix, regions *sums)
{
    static const char letters[3] = {'R', 'G', 'B'};
    for (int c = 0; c < 3; c++) {
        char name[PM_IMAGE_NAME_ROOM];
        snprintf(name, sizeof name, "%s%c", prefix, letters[c]);
        const float *plane = pm_image_plane(image, name);
        CHECK_THAT(plane != NULL, "there is no channel %s", name);
        double sum[REGIONS] = {0.0};
        for (int i = 0; i < SIDE * SIDE; i++) {
            int region = region_at(i % SIDE, i / SIDE);
            if (is_counted(p, i % SIDE, i / SIDE) && p->seen.counts[region]) {
                sum[region] += (double)plane[i];
                sum[REGIONS - 1] += (double)plane[i];
            }
        }
        for (int r = 0; r < REGIONS; r++) {
            double mean = p->seen.counts[r] ? sum[r] / p->pixels[r] : 0.0;
            sums->mean[r][c] += mean;
            sums->variance[r][c] += mean * mean;
        }
    }
}

/// Turns sums over RUNS pictures into means and the variances of these.
static void finish(regions *sums)
{
    for (int r = 0; r < REGIONS; r++) {
        for (int c = 0; c < 3; c++) {
            double mean = sums->mean[r][c] / RUNS;
            double square = fmax(0.0, sums->variance[r][c] / RUNS - mean * mean);
            sums->mean[r][c] = mean;
            sums->variance[r][c] = square / (RUNS - 1);
        }
    }
}

/// How a scene is rendered, and how far the density estimate may lead astray: its blur moves
/// light from bright places to dark ones near by, which share in it by the mean of the picture.
typedef struct {
    uint64_t global_photons, caustic_photons, volume_photons;
    uint32_t k;
    uint32_t spp; // eye samples, with two gather rays and a shadow ray each
    double slack; // of a region's value
    double blur;  // of the whole's value
} quality;

static const quality plain = {60000, 60000, 0, 16, 4, 0.015, 0.0};
static const quality sharp = {20000, 100000, 0, 10, 4, 0.05, 0.0125}; // caustics with edges
// Discs lie flat: where a surface is curved or ribbed within their radius they lose photons.
static const quality curved = {300000, 60000, 0, 10, 4, 0.015, 0.0};
static const quality foggy = {30000, 30000, 30000, 16, 2, 0.02, 0.0};

static regions take_render(const peer *p, const pm_intersector *world, quality q)
{
    regions ours = {0};
    for (uint32_t seed = 1; seed <= RUNS; seed++) {
        pm_render_settings settings = pm_render_defaults();
        settings.seed = seed;
        settings.photons[PM_MAP_GLOBAL] = q.global_photons;
        settings.photons[PM_MAP_CAUSTIC] = q.caustic_photons;
        settings.photons[PM_MAP_VOLUME] = q.volume_photons;
        settings.light.spp = q.spp;
        settings.light.rays = 2 * q.spp;
        settings.light.light_samples = q.spp;
        settings.light.estimate.k = q.k;
        pm_render_maps maps = {0};
        pm_image image;
        pm_eye_report report;
        CHECK_OK(pm_render_make_maps(world, &settings, &maps));
        CHECK_OK(pm_render_image(world, &settings, &maps, &image, &report));
        add_picture(p, &image, "", &ours);
        pm_image_free(&image);
        pm_render_maps_free(&maps);
    }
    finish(&ours);
    return ours;
}

static regions take_reference(const peer *p, const pm_intersector *world, uint32_t spp)
{
    regions ours = {0};
    for (uint32_t seed = 1; seed <= RUNS / 2; seed++) {
        pm_reference_settings settings = pm_reference_defaults();
        settings.seed = seed;
        settings.spp = spp;
        settings.light_paths = p->from_lights ? 400000 : 0;
        pm_image image;
        pm_reference_report report;
        CHECK_OK(pm_reference_image(world, &settings, &image, &report));
        add_picture(p, &image, "half1.", &ours);
        add_picture(p, &image, "half2.", &ours);
        pm_image_free(&image);
    }
    finish(&ours);
    return ours;
}

// --- side by side

/// Mean over the regions of the variance over the squared mean: four pictures tell too little
/// about a region of its own.
static double usual_variance(const regions *r)
{
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < REGIONS - 1; i++) {
        for (int c = 0; c < 3 && r->mean[i][c] > 0.0; c++) {
            sum += r->variance[i][c] / (r->mean[i][c] * r->mean[i][c]);
            count++;
        }
    }
    return count > 0 ? sum / count : 0.0;
}

/// Our variance in each region, and in the whole as if they were independent, at the least.
static void raise_variance(const peer *p, regions *ours)
{
    double usual = usual_variance(ours);
    for (int c = 0; c < 3; c++) {
        double whole = 0.0;
        for (int r = 0; r < REGIONS - 1; r++) {
            double mean = ours->mean[r][c];
            double weight = (double)p->pixels[r] / p->pixels[REGIONS - 1];
            ours->variance[r][c] = fmax(ours->variance[r][c], usual * mean * mean);
            whole += p->seen.counts[r] ? weight * weight * ours->variance[r][c] : 0.0;
        }
        ours->variance[REGIONS - 1][c] = fmax(ours->variance[REGIONS - 1][c], whole);
    }
}

static void check(const peer *p, const char *what, regions *ours, double slack, double blur)
{
    raise_variance(p, ours);
    for (int i = 0; i < 3 * REGIONS; i++) {
        int r = i / 3;
        int c = i % 3;
        double want = p->seen.mean[r][c];
        double variance = ours->variance[r][c] + p->seen.variance[r][c];
        double bound =
            5.0 * sqrt(variance) + slack * want + blur * p->seen.mean[REGIONS - 1][c];
        CHECK_THAT(!p->seen.counts[r] || fabs(ours->mean[r][c] - want) <= bound,
                   "%s of %s: region %d of %d, channel %d: got %.6g, Mitsuba %.6g, bound %.3g",
                   what, p->path, r, REGIONS, c, ours->mean[r][c], want, bound);
    }
}

static void compare(const char *name, quality q)
{
    peer p = open_peer(name);
    pm_scene scene;
    pm_intersector world = {0};
    open_world(&p, &scene, &world);
    regions ours = take_render(&p, &world, q);
    check(&p, "render", &ours, q.slack, q.blur);
    ours = take_reference(&p, &world, 16 * q.spp);
    check(&p, "reference", &ours, 0.002, 0.0);
    pm_intersector_free(&world);
    pm_scene_free(&scene);
    json_decref(p.file);
}

static void cornell_diffuse(void)
{
    compare("cornell-diffuse", plain);
}

static void cornell_fog(void)
{
    compare("cornell-fog", foggy);
}

static void sun(void)
{
    compare("sun", foggy);
}

static void nested(void)
{
    compare("tests/peers/nested.xml", foggy);
}

static void cornell_glossy(void)
{
    compare("cornell-glossy", plain);
}

static void cornell_spheres(void)
{
    compare("cornell-spheres", plain);
}

static void furnace(void)
{
    compare("furnace", plain);
}

static void integrating_sphere(void)
{
    compare("integrating-sphere", plain);
}

static void lights(void)
{
    compare("lights", curved);
}

static void mesh_spheres(void)
{
    compare("mesh-spheres", plain);
}

static void ring(void)
{
    compare("ring", sharp);
}

static void shell(void)
{
    compare("shell", curved);
}

static void sparse(void)
{
    compare("sparse", plain);
}

static void square_over_floor(void)
{
    compare("square-over-floor", plain);
}

static void water(void)
{
    compare("water", sharp);
}

PM_TESTS({"peers.1", "cornell-diffuse is what Mitsuba makes of it", cornell_diffuse},
         {"peers.2", "cornell-glossy is what Mitsuba makes of it", cornell_glossy},
         {"peers.3", "cornell-spheres is what Mitsuba makes of it", cornell_spheres},
         {"peers.4", "furnace is what Mitsuba makes of it", furnace},
         {"peers.5", "integrating-sphere is what Mitsuba makes of it", integrating_sphere},
         {"peers.6", "lights is what Mitsuba makes of it", lights},
         {"peers.7", "mesh-spheres is what Mitsuba makes of it", mesh_spheres},
         {"peers.8", "ring is what Mitsuba makes of it, by light traced to the camera", ring},
         {"peers.9", "shell is what Mitsuba makes of it", shell},
         {"peers.10", "sparse is what Mitsuba makes of it", sparse},
         {"peers.11", "square-over-floor is what Mitsuba makes of it", square_over_floor},
         {"peers.13", "cornell-fog is what Mitsuba makes of it", cornell_fog},
         {"peers.14", "sun is what Mitsuba makes of it", sun},
         {"peers.15", "media in a medium, dense and coloured, are what Mitsuba makes of them",
          nested},
         {"peers.12", "water is what Mitsuba makes of it, by light traced to the camera",
          water})
