// Where photons start and where they go, for each kind of light: moments, chi-square on cells
// of equal probability, and positions.
#include "emit.h"

#include "chance.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

#include <stdlib.h>

enum { COUNT = 200000 };
static const pm_rng_source source = {.seed = 2, .stream = PM_STREAM_TEST};

/// `COUNT` rays of the scene's light 0; free() them.
static pm_ray *rays_of(const pm_scenes *s)
{
    pm_ray *rays = calloc(COUNT, sizeof *rays);
    CHECK(rays != NULL);
    for (uint64_t i = 0; i < COUNT; i++) {
        pm_rng rng = pm_rng_at(&source, i, 0);
        CHECK_OK(pm_emit_ray(&s->scene, &s->lights[0], NULL, &rng, &rays[i]));
        CHECK_NEAR(pm_vec_length(rays[i].direction), 1.0, 1e-14);
        CHECK(rays[i].t_max == HUGE_VAL && rays[i].wavelength == 0.0);
        CHECK(rays[i].medium == s->lights[0].medium);
    }
    return rays;
}

static pm_ray *point_rays(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_point(&s, pm_vec(1.0, -2.0, 3.0), pm_gray(1.0));
    pm_scenes_ready(&s);
    pm_ray *rays = rays_of(&s);
    pm_scenes_free(&s);
    return rays;
}

/// n!! for odd n; (-1)!! is 1.
static double odd_factorial(int n)
{
    double product = 1.0;
    for (; n > 1; n -= 2) {
        product *= n;
    }
    return product;
}

/// Mean of x^a y^b z^c over the unit sphere.
static double sphere_moment(int a, int b, int c)
{
    if (a % 2 || b % 2 || c % 2) {
        return 0.0;
    }
    double top = odd_factorial(a - 1) * odd_factorial(b - 1) * odd_factorial(c - 1);
    return top / odd_factorial(a + b + c + 1);
}

static void check_sphere_moment(const pm_ray *rays, int a, int b, int c)
{
    double sum = 0.0;
    for (size_t i = 0; i < COUNT; i++) {
        pm_vec3 d = rays[i].direction;
        sum += pow(d.x, a) * pow(d.y, b) * pow(d.z, c);
    }
    double mean = sphere_moment(a, b, c);
    double variance = sphere_moment(2 * a, 2 * b, 2 * c) - mean * mean;
    CHECK_NEAR(sum / COUNT, mean, pm_chance_bound(variance, COUNT));
}

static void point_moments(void)
{
    CHECK_NEAR(sphere_moment(0, 0, 2), 1.0 / 3.0, 1e-15);
    CHECK_NEAR(sphere_moment(0, 0, 4), 1.0 / 5.0, 1e-15);
    CHECK_NEAR(sphere_moment(2, 0, 2), 1.0 / 15.0, 1e-15);
    pm_ray *rays = point_rays();
    for (int a = 0; a <= 4; a++) {
        for (int b = 0; a + b <= 4; b++) {
            for (int c = a + b == 0; a + b + c <= 4; c++) {
                check_sphere_moment(rays, a, b, c);
            }
        }
    }
    free(rays);
}

/// Cell 0..n-1 of a value in [0, 1]; the end belongs to the last.
static int cell_of(double u, int n)
{
    int cell = (int)(u * n);
    return cell < 0 ? 0 : cell < n ? cell : n - 1;
}

static double turn_of(double y, double x)
{
    double turn = atan2(y, x) / (2.0 * PM_PI);
    return turn < 0.0 ? turn + 1.0 : turn;
}

static void point_fills_equal_cells(void)
{
    enum { HIGH = 16, AROUND = 32 };
    static uint64_t cells[HIGH * AROUND];
    pm_ray *rays = point_rays();
    for (size_t i = 0; i < COUNT; i++) {
        pm_vec3 d = rays[i].direction;
        int row = cell_of(0.5 * (1.0 - d.z), HIGH);
        cells[row * AROUND + cell_of(turn_of(d.y, d.x), AROUND)]++;
        CHECK(rays[i].origin.x == 1.0 && rays[i].origin.y == -2.0 && rays[i].origin.z == 3.0);
    }
    CHECK_EVEN(cells, HIGH * AROUND);
    free(rays);
}

static int compare_heights(const void *a, const void *b)
{
    double left = ((const pm_ray *)a)->direction.z;
    double right = ((const pm_ray *)b)->direction.z;
    return (left > right) - (left < right);
}

static void no_direction_comes_twice(void)
{
    pm_ray *rays = point_rays();
    qsort(rays, COUNT, sizeof *rays, compare_heights);
    for (size_t i = 1; i < COUNT; i++) {
        CHECK(rays[i].direction.z != rays[i - 1].direction.z);
    }
    free(rays);
}

// --- area lights

/// Cosines about normals: mean of cos^k is 2 / (k + 2).
static void check_cosines(const double *cosine)
{
    for (int k = 1; k <= 4; k++) {
        double sum = 0.0;
        for (size_t i = 0; i < COUNT; i++) {
            sum += pow(cosine[i], k);
        }
        double mean = 2.0 / (k + 2);
        CHECK_NEAR(sum / COUNT, mean, pm_chance_bound(2.0 / (2 * k + 2) - mean * mean, COUNT));
    }
    double within = 0.0;
    for (size_t i = 0; i < COUNT; i++) {
        within += cosine[i] >= 0.5;
    }
    CHECK_NEAR(within / COUNT, 0.75, pm_chance_bound(0.75 * 0.25, COUNT));
}

/// A tilted rectangle with edges of unlike length, perhaps flipped, in the air.
static pm_ray *rectangle_rays(bool flipped, pm_shape *shape)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_shape lamp = pm_shapes_rectangle(pm_vec(1.0, 2.0, -0.5), pm_vec(0.0, 0.3, 0.4),
                                        pm_vec(2.0, 0.0, 0.0));
    lamp.flipped = flipped;
    pm_scenes_lamp(&s, pm_scenes_add(&s, lamp, PM_NONE, PM_NONE), pm_gray(1.0));
    pm_scenes_ready(&s);
    *shape = s.shapes[0];
    pm_ray *rays = rays_of(&s);
    pm_scenes_free(&s);
    return rays;
}

static void square_sends_by_cosine(void)
{
    enum { FINE = 16 };
    for (int flipped = 0; flipped < 2; flipped++) {
        static double cosine[COUNT];
        static uint64_t cells[FINE * FINE];
        pm_shape shape;
        pm_ray *rays = rectangle_rays(flipped, &shape);
        pm_vec3 s = pm_vec(1.0, 0.0, 0.0);
        pm_vec3 t = pm_vec(0.0, 0.6, 0.8);
        pm_vec3 normal = pm_vec(0.0, flipped ? -0.8 : 0.8, flipped ? 0.6 : -0.6);
        for (size_t i = 0; i < COUNT; i++) {
            pm_vec3 d = rays[i].direction;
            cosine[i] = pm_vec_dot(d, normal);
            CHECK(cosine[i] > 0.0);
            double turn = turn_of(pm_vec_dot(d, s), pm_vec_dot(d, t));
            int row = cell_of(cosine[i] * cosine[i], FINE);
            cells[row * FINE + cell_of(turn, FINE)]++;
        }
        check_cosines(cosine);
        CHECK_EVEN(cells, FINE * FINE);
        free(rays);
    }
}

static void square_starts_everywhere(void)
{
    enum { FINE = 16 };
    static uint64_t cells[FINE * FINE];
    pm_shape shape;
    pm_ray *rays = rectangle_rays(false, &shape);
    double together = 0.0; // place on the lamp against direction
    for (size_t i = 0; i < COUNT; i++) {
        pm_vec3 from = pm_vec_sub(rays[i].origin, shape.corner);
        double u = pm_vec_dot(from, shape.edge[0]) / 0.25;
        double v = pm_vec_dot(from, shape.edge[1]) / 4.0;
        cells[cell_of(u, FINE) * FINE + cell_of(v, FINE)]++;
        double height = pm_vec_dot(from, pm_vec(0.0, 0.8, -0.6));
        CHECK_NEAR(height, PM_OFFSET * shape.reach, 1e-9 * PM_OFFSET * shape.reach + 1e-15);
        together += (v - 0.5) * rays[i].direction.x;
    }
    CHECK_EVEN(cells, FINE * FINE);
    // Variances 1/12 of v and 1/4 of a tangential component.
    CHECK_NEAR(together / COUNT, 0.0, pm_chance_bound(1.0 / 48.0, COUNT));
    free(rays);
}

static void sphere_light(void)
{
    enum { HIGH = 16, AROUND = 16 };
    static double cosine[COUNT];
    static uint64_t cells[HIGH * AROUND];
    pm_vec3 center = pm_vec(0.5, 0.0, -1.0);
    pm_scenes s;
    pm_scenes_begin(&s);
    int ball = pm_scenes_add(&s, pm_shapes_sphere(center, 0.25), PM_NONE, PM_NONE);
    pm_scenes_lamp(&s, ball, pm_gray(1.0));
    pm_scenes_ready(&s);
    pm_ray *rays = rays_of(&s);
    for (size_t i = 0; i < COUNT; i++) {
        pm_vec3 out = pm_vec_sub(rays[i].origin, center);
        CHECK(pm_vec_length(out) > 0.25 && pm_vec_length(out) < 0.25 + 1e-5);
        pm_vec3 normal = pm_vec_normalize(out);
        cosine[i] = pm_vec_dot(normal, rays[i].direction);
        int row = cell_of(0.5 * (1.0 - normal.z), HIGH);
        cells[row * AROUND + cell_of(turn_of(normal.y, normal.x), AROUND)]++;
    }
    check_cosines(cosine);
    CHECK_EVEN(cells, HIGH * AROUND);
    free(rays);
    pm_scenes_free(&s);
}

static void disk_light(void)
{
    enum { OUT = 16, AROUND = 16 };
    static double cosine[COUNT];
    static uint64_t cells[OUT * AROUND];
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_shape disk = pm_shapes_disk(pm_vec(0.0, 2.0, 0.0), pm_vec(0.0, -1.0, 0.0), 0.5);
    pm_scenes_lamp(&s, pm_scenes_add(&s, disk, PM_NONE, PM_NONE), pm_gray(1.0));
    pm_scenes_ready(&s);
    pm_ray *rays = rays_of(&s);
    for (size_t i = 0; i < COUNT; i++) {
        pm_vec3 at = rays[i].origin;
        CHECK(at.y < 2.0 && at.y > 2.0 - 1e-5);
        cosine[i] = -rays[i].direction.y;
        int row = cell_of((at.x * at.x + at.z * at.z) / 0.25, OUT);
        cells[row * AROUND + cell_of(turn_of(at.z, at.x), AROUND)]++;
    }
    check_cosines(cosine);
    CHECK_EVEN(cells, OUT * AROUND);
    free(rays);
    pm_scenes_free(&s);
}

static void mesh_light(void)
{
    // A cube: each of its faces gets a sixth of the photons, which leave it outward.
    static double cosine[COUNT];
    const pm_frame upright = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    uint64_t faces[6] = {0};
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_shape cube = pm_shapes_cube(&upright, pm_vec(0.0, 0.0, 0.0), 1.0);
    pm_scenes_lamp(&s, pm_scenes_add(&s, cube, PM_NONE, PM_NONE), pm_gray(1.0));
    pm_scenes_ready(&s);
    pm_ray *rays = rays_of(&s);
    for (size_t i = 0; i < COUNT; i++) {
        for (int axis = 0; axis < 3; axis++) {
            double at = pm_vec_axis(rays[i].origin, axis);
            if (fabs(at) > 1.0) {
                faces[2 * axis + (at > 0.0)]++;
                cosine[i] = copysign(1.0, at) * pm_vec_axis(rays[i].direction, axis);
            }
        }
    }
    CHECK(faces[0] + faces[1] + faces[2] + faces[3] + faces[4] + faces[5] == COUNT);
    CHECK_EVEN(faces, 6);
    check_cosines(cosine);
    free(rays);
    pm_scenes_free(&s);
}

// --- directional lights

/// A floor from -1 to 1 under a sun that stands `angle` from the zenith.
static void sunlit_floor(pm_scenes *s, double angle)
{
    pm_scenes_begin(s);
    pm_scenes_wear(s, pm_scenes_square(2.0, 0.0, false), pm_scenes_diffuse(s, pm_gray(0.5)));
    pm_scenes_sun(s, pm_vec(sin(angle), 0.0, -cos(angle)), pm_gray(3.0));
    pm_scenes_ready(s);
}

static void sun_starts_before_everything(void)
{
    enum { OUT = 16, AROUND = 16 };
    static uint64_t cells[OUT * AROUND];
    pm_scenes s;
    sunlit_floor(&s, 0.6);
    pm_vec3 along = s.lights[0].direction;
    pm_vec3 across = pm_vec_cross(along, pm_vec(0.0, 1.0, 0.0));
    double radius = s.scene.radius;
    CHECK_NEAR(radius, sqrt(2.0), 1e-15);
    pm_ray *rays = rays_of(&s);
    for (size_t i = 0; i < COUNT; i++) {
        CHECK_NEAR(pm_vec_dot(rays[i].direction, along), 1.0, 1e-15);
        CHECK(pm_vec_dot(rays[i].origin, along) <= -radius);
        double x = pm_vec_dot(rays[i].origin, across) / radius;
        double y = rays[i].origin.y / radius;
        CHECK(x * x + y * y < 1.0 + 1e-12);
        cells[cell_of(x * x + y * y, OUT) * AROUND + cell_of(turn_of(y, x), AROUND)]++;
    }
    CHECK_EVEN(cells, OUT * AROUND);
    free(rays);
    pm_scenes_free(&s);
}

/// How many of the rays meet a patch of the floor.
static double rays_on(const pm_ray *rays, pm_vec3 low, pm_vec3 high)
{
    double met = 0.0;
    for (size_t i = 0; i < COUNT; i++) {
        double t = -rays[i].origin.z / rays[i].direction.z;
        pm_vec3 at = pm_vec_along(rays[i].origin, rays[i].direction, t);
        met += at.x >= low.x && at.x < high.x && at.y >= low.y && at.y < high.y;
    }
    return met;
}

static void check_patch(const pm_scenes *s, const pm_ray *rays, pm_vec3 low, pm_vec3 high,
                        double irradiance)
{
    double flux = s->lights[0].flux.c[0];
    double area = (high.x - low.x) * (high.y - low.y);
    double share = irradiance * area / flux;
    CHECK_NEAR(rays_on(rays, low, high) / COUNT * flux / area, irradiance,
               flux / area * pm_chance_bound(share * (1.0 - share), COUNT));
}

static void sun_lights_by_cosine(void)
{
    static const double angles[2] = {0.0, PM_PI / 3.0};
    for (int i = 0; i < 2; i++) {
        pm_scenes s;
        sunlit_floor(&s, angles[i]);
        double want = 3.0 * cos(angles[i]);
        pm_ray *rays = rays_of(&s);
        check_patch(&s, rays, pm_vec(-0.5, -0.5, 0.0), pm_vec(0.5, 0.5, 0.0), want);
        check_patch(&s, rays, pm_vec(-1.0, -1.0, 0.0), pm_vec(-0.7, -0.7, 0.0), want);
        check_patch(&s, rays, pm_vec(0.7, 0.7, 0.0), pm_vec(1.0, 1.0, 0.0), want);
        free(rays);
        pm_scenes_free(&s);
    }
}

static void unknown_light_is_refused(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 0.0), pm_gray(1.0));
    pm_scenes_ready(&s);
    s.lights[0].type = (pm_light_type)99;
    pm_rng rng = pm_rng_at(&source, 0, 0);
    pm_ray ray = {.t_max = 5.0};
    CHECK_FAILS(pm_emit_ray(&s.scene, &s.lights[0], NULL, &rng, &ray), PM_EINPUT,
                "unknown light type 99");
    CHECK(ray.t_max == 5.0);
    pm_scenes_free(&s);
}

PM_TESTS({"emit.20", "a point light is isotropic in all moments up to the fourth",
          point_moments},
         {"emit.21", "a point light fills cells of equal solid angle alike",
          point_fills_equal_cells},
         {"emit.22", "no two photons take the same direction", no_direction_comes_twice},
         {"emit.23", "a square sends by the cosine about its normal, flipped or not",
          square_sends_by_cosine},
         {"emit.24", "a square's photons start all over it, an offset above it",
          square_starts_everywhere},
         {"emit.25", "a sphere's photons leave by the cosine from everywhere on it",
          sphere_light},
         {"emit.26", "a disk's photons leave by the cosine from everywhere on it", disk_light},
         {"emit.27", "a mesh's faces send by their areas, outward", mesh_light},
         {"emit.28", "a sun's photons start evenly on the scene's disc, before everything",
          sun_starts_before_everything},
         {"emit.29", "a sun lights a floor by the cosine, its corners included",
          sun_lights_by_cosine},
         {"emit.30", "a light of unknown type is refused", unknown_light_is_refused})
