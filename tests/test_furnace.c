// Whole pictures whose radiance is known in closed form: furnaces, and a dome over a mirror,
// which is an integrating sphere folded in half.
#include "camera.h"
#include "pictures.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

static const double wall_albedo = 0.5;

static pm_render_settings settings_of(uint32_t rays, uint64_t photons)
{
    pm_render_settings settings = pm_pictures_settings();
    settings.photons[PM_MAP_GLOBAL] = photons;
    settings.photons[PM_MAP_CAUSTIC] = photons;
    settings.light.rays = rays;
    settings.light.estimate.shape = PM_GATHER_SPHERE; // exact on the inside of a sphere
    settings.light.estimate.k = 50;
    settings.unpacked = true;
    return settings;
}

/// A globe that glows and reflects: L = 1 / (1 - albedo) = emission 1 + direct + indirect.
static void furnace_begin(pm_scenes *s, double albedo)
{
    pm_scenes_begin(s);
    int globe = pm_scenes_globe(s, 1.0, pm_scenes_diffuse(s, pm_gray(albedo)));
    pm_scenes_lamp(s, globe, pm_gray(1.0));
}

static void check_furnace(const pm_scenes *s, uint32_t rays)
{
    double want = wall_albedo * wall_albedo / (1.0 - wall_albedo);
    pm_render_settings settings = settings_of(rays, 20000);
    pm_pictures_means means = pm_pictures_repeat(s, settings, 8);
    for (int c = 0; c < 3; c++) {
        CHECK_CLOSE("indirect", means.mean[PM_LAYER_INDIRECT].c[c], want,
                    means.variance[PM_LAYER_INDIRECT].c[c], 0.0);
    }
    pm_image image = pm_pictures_take(s, &settings);
    for (int i = 0; i < image.width * image.height; i++) {
        int x = i % image.width;
        int y = i / image.width;
        CHECK_NEAR(pm_pictures_at(&image, "emission.R", x, y), 1.0, 1e-6);
        CHECK_NEAR(pm_pictures_at(&image, "direct.G", x, y), wall_albedo, 1e-6);
        CHECK_NEAR(pm_pictures_at(&image, "specular.B", x, y), 0.0, 0.0);
        CHECK_NEAR(pm_pictures_at(&image, "caustic.R", x, y), 0.0, 0.0);
        // One lookup of 50 photons each, at worst.
        double bound = 5.0 * want / sqrt(49.0);
        CHECK_NEAR(pm_pictures_at(&image, "G", x, y), 1.0 + wall_albedo + want, bound);
    }
    pm_image_free(&image);
}

static void every_pixel_of_a_furnace_is_the_same(void)
{
    pm_scenes s;
    furnace_begin(&s, wall_albedo);
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.3, -0.2, 0.1), pm_vec(0.0, 1.0, 0.2), 1.0, 12);
    check_furnace(&s, 0);
    check_furnace(&s, 16);
    pm_scenes_free(&s);
}

// Discs reach over the edges of a box, so indirect light may be a little low there.
static void a_furnace_with_edges_is_right_in_the_mean(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    int first = pm_scenes_room(&s, 1.0, pm_scenes_diffuse(&s, pm_gray(wall_albedo)));
    for (int wall = first; wall < first + 6; wall++) {
        pm_scenes_lamp(&s, wall, pm_gray(1.0));
    }
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.3, -0.2, 0.1), pm_vec(0.0, 1.0, 0.2), 1.0, 12);
    for (uint32_t rays = 0; rays <= 16; rays += 16) {
        pm_render_settings settings = settings_of(rays, 50000);
        settings.light.estimate.shape = PM_GATHER_DISC;
        settings.light.estimate.k = 20;
        pm_pictures_means means = pm_pictures_repeat(&s, settings, 6);
        CHECK_NEAR(means.mean[PM_LAYER_EMISSION].c[0], 1.0, 1e-6);
        CHECK_CLOSE("direct", means.mean[PM_LAYER_DIRECT].c[1], wall_albedo,
                    means.variance[PM_LAYER_DIRECT].c[1], 0.0);
        CHECK_CLOSE("indirect", means.mean[PM_LAYER_INDIRECT].c[2], 0.5,
                    means.variance[PM_LAYER_INDIRECT].c[2], 0.03);
    }
    pm_scenes_free(&s);
}

static void add_glass_ball(pm_scenes *s)
{
    pm_scenes_wear(s, pm_shapes_sphere(pm_vec(0.0, 0.4, 0.0), 0.3), pm_scenes_glass(s, 1.5));
    pm_scenes_ready(s);
}

static void glass_in_a_glowing_globe_cannot_be_seen(void)
{
    pm_scenes s;
    furnace_begin(&s, 0.0);
    add_glass_ball(&s);
    pm_pictures_look(&s, pm_vec(0.0, -0.6, 0.0), pm_vec(0.0, 1.0, 0.0), 0.6, 24);
    pm_render_settings settings = settings_of(0, 1000);
    pm_image image = pm_pictures_take(&s, &settings);
    double through_glass = 0.0;
    for (int i = 0; i < image.width * image.height; i++) {
        int x = i % image.width;
        int y = i / image.width;
        CHECK_NEAR(pm_pictures_at(&image, "R", x, y), 1.0, 1e-6);
        through_glass += pm_pictures_at(&image, "specular.R", x, y);
    }
    CHECK(through_glass > 50.0);
    pm_image_free(&image);
    pm_scenes_free(&s);
}

// Seen through the ball, what its shadow takes the caustic gives back.
static void glass_in_a_white_furnace_cannot_be_seen(void)
{
    pm_scenes s;
    furnace_begin(&s, wall_albedo);
    add_glass_ball(&s);
    pm_pictures_look(&s, pm_vec(0.0, -0.6, 0.0), pm_vec(0.0, 1.0, 0.0), 0.2, 12);
    for (uint32_t rays = 0; rays <= 16; rays += 16) {
        pm_pictures_means means = pm_pictures_repeat(&s, settings_of(rays, 20000), 8);
        CHECK_NEAR(means.mean[PM_LAYER_EMISSION].c[0], 0.0, 0.0);
        CHECK_CLOSE("all that is seen through the ball", means.mean[PM_LAYER_SPECULAR].c[0],
                    1.0 / (1.0 - wall_albedo), means.variance[PM_LAYER_SPECULAR].c[0], 0.002);
    }
    pm_scenes_free(&s);
}

// --- a dome over a mirror --------------------------------------------------------------------
//
// By reflection it is a whole integrating sphere with two lamps. On the dome: LD comes from the
// lamp, LSD from its image, and all else is rho Phi / ((1 - rho) 2 pi R^2) everywhere.

static const double dome_flux = 4.0;
static const pm_vec3 dome_lamp = {0.2, 0.1, 0.5};
static const pm_vec3 dome_image = {0.2, 0.1, -0.5};

static void dome_begin(pm_scenes *s)
{
    pm_scenes_begin(s);
    pm_scenes_globe(s, 1.0, pm_scenes_diffuse(s, pm_gray(wall_albedo)));
    pm_scenes_wear(s, pm_scenes_square(3.0, 0.0, false), pm_scenes_mirror(s, pm_gray(1.0)));
    pm_scenes_point(s, dome_lamp, pm_gray(dome_flux));
    pm_scenes_ready(s);
}

/// Mean over the film of what the dome sends of the light of a lamp at `from`.
static double from_lamp(const pm_scenes *s, pm_vec3 from)
{
    enum { SIDE = 64 };
    double sum = 0.0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        double u = (i % SIDE + 0.5) / SIDE;
        double v = (i / SIDE + 0.5) / SIDE;
        pm_ray ray = pm_camera_ray(&s->scene.camera, u, v);
        pm_hit hit;
        CHECK(pm_closest(&s->world, &ray, &hit) && hit.shape == 0);
        pm_vec3 way = pm_vec_sub(from, hit.position);
        double distance2 = pm_vec_dot(way, way);
        double cosine = pm_vec_dot(way, hit.normal) / sqrt(distance2);
        sum += wall_albedo / PM_PI * dome_flux / (4.0 * PM_PI * distance2) * cosine;
    }
    return sum / (SIDE * SIDE);
}

static double dome_indirect(void)
{
    double irradiance = wall_albedo * dome_flux / ((1.0 - wall_albedo) * 2.0 * PM_PI);
    return wall_albedo / PM_PI * irradiance;
}

// Unequal numbers of photons, so that a map scaled by the other's number shows.
static void check_dome(const pm_scenes *s, uint32_t rays, uint64_t global, uint64_t caustic)
{
    pm_render_settings settings = settings_of(rays, global);
    settings.photons[PM_MAP_CAUSTIC] = caustic;
    settings.light.estimate.k = 20;
    pm_pictures_means means = pm_pictures_repeat(s, settings, 8);
    CHECK_CLOSE("direct", means.mean[PM_LAYER_DIRECT].c[0], from_lamp(s, dome_lamp), 0.0, 1e-3);
    CHECK_CLOSE("caustic", means.mean[PM_LAYER_CAUSTIC].c[0], from_lamp(s, dome_image),
                means.variance[PM_LAYER_CAUSTIC].c[0], 0.003);
    CHECK_CLOSE("indirect", means.mean[PM_LAYER_INDIRECT].c[0], dome_indirect(),
                means.variance[PM_LAYER_INDIRECT].c[0], 0.005);
    CHECK_NEAR(means.mean[PM_LAYER_SPECULAR].c[0], 0.0, 0.0);
}

static void a_dome_over_a_mirror_is_half_a_sphere(void)
{
    pm_scenes s;
    dome_begin(&s);
    pm_pictures_look(&s, pm_vec(-0.1, 0.2, 0.3), pm_vec(0.0, 0.0, 1.0), 0.5, 12);
    check_dome(&s, 0, 40000, 8000);
    check_dome(&s, 32, 8000, 40000);
    pm_scenes_free(&s);
}

static void a_mirror_shows_the_dome(void)
{
    pm_scenes s;
    dome_begin(&s);
    pm_pictures_look(&s, pm_vec(-0.1, 0.2, 0.3), pm_vec(0.0, 0.0, -1.0), 0.3, 12);
    pm_pictures_means seen = pm_pictures_repeat(&s, settings_of(16, 20000), 8);

    // The same by a camera that stands behind the mirror, in the mirrored half.
    s.scene.camera.position.z = -s.scene.camera.position.z;
    s.scene.camera.forward.z = 1.0;
    double want = 0.0;
    s.shapes[1].corner.z -= 10.0; // the mirror is out of the way
    want = from_lamp(&s, dome_lamp) + from_lamp(&s, dome_image) + dome_indirect();
    CHECK_CLOSE("all that the mirror shows", seen.mean[PM_LAYER_SPECULAR].c[0], want,
                seen.variance[PM_LAYER_SPECULAR].c[0], 0.005);
    pm_scenes_free(&s);
}

PM_TESTS({"furnace.1", "every pixel of a glowing globe is Le / (1 - rho), gathered or not",
          every_pixel_of_a_furnace_is_the_same},
         {"furnace.2", "a glowing box is Le / (1 - rho) but for what discs lose at edges",
          a_furnace_with_edges_is_right_in_the_mean},
         {"furnace.3", "a glass ball in a globe that only glows cannot be seen at all",
          glass_in_a_glowing_globe_cannot_be_seen},
         {"furnace.4", "a glass ball in a white furnace cannot be seen",
          glass_in_a_white_furnace_cannot_be_seen},
         {"furnace.5", "under a dome on a mirror each layer is that of half a sphere",
          a_dome_over_a_mirror_is_half_a_sphere},
         {"furnace.6", "the mirror shows the dome with all its light", a_mirror_shows_the_dome})
