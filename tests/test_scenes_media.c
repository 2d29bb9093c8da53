// The scenes with media and with a prism, each held to what its head comment says that it must
// give, by single rays.
#include "intersect_plain.h"
#include "material.h"
#include "medium.h"
#include "scene_read.h"
#include "test.h"

#include <stdio.h>
#include <string.h>

typedef struct {
    pm_scene scene;
    pm_intersector world;
} opened;

/// `o` must stay where it is: the queries point at its scene.
static void open_world(opened *o, const char *name, const pm_define *defines, int count)
{
    char path[128];
    snprintf(path, sizeof path, "scenes/%s.xml", name);
    CHECK_OK(pm_scene_read(path, defines, count, true, &o->scene));
    CHECK_OK(pm_intersect_plain(&o->scene, &o->world));
}

static void close_world(opened *o)
{
    pm_intersector_free(&o->world);
    pm_scene_free(&o->scene);
}

/// A ray from a point in the file's coordinates, in the medium of that id or in none.
static pm_ray ray_in(const opened *o, pm_vec3 from, pm_vec3 way, double length,
                     const char *medium)
{
    int found = PM_NONE;
    for (int i = 0; i < o->scene.medium_count; i++) {
        found = strcmp(o->scene.media[i].id, medium) == 0 ? i : found;
    }
    CHECK(found != PM_NONE || medium[0] == '\0');
    return (pm_ray){pm_vec_sub(from, o->scene.center), pm_vec_normalize(way), length, 0.0,
                    found};
}

static void fog_fills_the_cornell_box(void)
{
    opened o;
    open_world(&o, "cornell-fog", NULL, 0);
    const pm_ray across =
        ray_in(&o, pm_vec(-0.4999, 0.5, 0.0), pm_vec(1.0, 0.0, 0.0), 0.9998, "");
    CHECK_NEAR(pm_medium_clear(&o.world, &across), 0.55013, 0.5e-5);
    CHECK(o.scene.camera.medium == PM_NONE && o.scene.lights[0].medium != PM_NONE);
    close_world(&o);
}

static void sun_reaches_the_floor_through_fog(void)
{
    opened o;
    open_world(&o, "sun", NULL, 0);
    const pm_light *sun = &o.scene.lights[0];
    pm_vec3 at = pm_vec(0.0, 0.5, 1e-5);
    const pm_ray up = ray_in(&o, at, pm_vec_negate(sun->direction), HUGE_VAL, "");
    double share = pm_medium_clear(&o.world, &up);
    CHECK_NEAR(sun->emitted.c[0] * -sun->direction.z * share, 10.9506, 1e-3);
    CHECK_NEAR(sun->emitted.c[0] * sun->direction.x * 2.4, 46.08, 1e-4);
    pm_ray barred = up;
    barred.origin.x += 0.3; // below the bar between the openings, and beside the pedestal
    barred.origin.y -= 0.4;
    CHECK(pm_medium_clear(&o.world, &barred) == 0.0);
    close_world(&o);
}

/// The ray after the last glass that it passes on its way to something opaque.
static pm_ray bend(const opened *o, pm_ray ray)
{
    pm_ray bent = ray;
    for (int turns = 0; turns < 10; turns++) {
        pm_hit hit;
        pm_lobes lobes;
        CHECK(pm_closest(&o->world, &ray, &hit));
        pm_material_lobes(&o->scene, &hit, &ray, &lobes);
        int through = PM_NONE;
        for (int i = 0; i < lobes.count; i++) {
            through = lobes.lobe[i].type == PM_LOBE_TRANSMIT ? i : through;
        }
        if (through == PM_NONE && !lobes.passes) {
            break;
        }
        pm_vec3 onward = ray.direction;
        int medium = lobes.medium_beyond;
        if (through != PM_NONE) {
            pm_scatter scatter;
            pm_rng rng = pm_rng_at(&(pm_rng_source){1, PM_STREAM_CAMERA, 0}, 0, 0);
            pm_material_sample(&lobes, through, &rng, &scatter);
            onward = scatter.wo;
            medium = scatter.medium;
        }
        ray = pm_hit_ray(&hit, onward, ray.wavelength, medium);
        bent = through != PM_NONE ? ray : bent;
    }
    return bent;
}

static void glass_ball_has_its_focus_in_fog(void)
{
    opened o;
    open_world(&o, "glass-fog", NULL, 0);
    CHECK(o.scene.lights[0].medium != PM_NONE && o.scene.camera.medium == PM_NONE);
    const pm_vec3 lamp = pm_vec(-1.6, 0.0, 0.0);
    pm_ray ray = ray_in(&o, lamp, pm_vec(1.3, 0.0, 1e-4), HUGE_VAL, "fog");
    ray = bend(&o, ray);
    CHECK_THAT(ray.medium != PM_NONE, "beyond the ball is no fog");
    pm_vec3 from = pm_vec_add(ray.origin, o.scene.center);
    double focus = from.x - from.z * ray.direction.x / ray.direction.z;
    CHECK_NEAR(focus, 0.626087, 1e-3);
    const pm_ray metre = ray_in(&o, pm_vec(0.0, -0.5, 0.5), pm_vec(1.0, 0.0, 0.0), 1.0, "fog");
    CHECK_NEAR(pm_medium_clear(&o.world, &metre), exp(-0.3), 1e-12);
    close_world(&o);
}

static void prism_turns_each_colour_as_it_should(void)
{
    static const struct {
        double wavelength, turned; // [nm], [degrees], as in the head
    } colours[] = {{450.0, 72.4355}, {550.0, 68.3757}, {650.0, 66.4869}};
    opened o;
    open_world(&o, "prism", NULL, 0);
    for (size_t i = 0; i < sizeof colours / sizeof colours[0]; i++) {
        const pm_vec3 slit = pm_vec(-0.449, 0.0, 0.16);
        pm_ray ray = ray_in(&o, slit, o.scene.lights[0].direction, HUGE_VAL, "");
        ray.wavelength = colours[i].wavelength;
        ray = bend(&o, ray);
        double turned = atan2(ray.direction.y, ray.direction.x) * 180.0 / PM_PI;
        CHECK_NEAR(turned, colours[i].turned, 1e-3);
        pm_hit hit;
        CHECK(pm_closest(&o.world, &ray, &hit));
        CHECK_THAT(strcmp(o.scene.shapes[hit.shape].id, "screen") == 0, "%g nm end on %s",
                   colours[i].wavelength, o.scene.shapes[hit.shape].id);
    }
    close_world(&o);
}

static void slit_lets_no_other_light_in(void)
{
    opened o;
    open_world(&o, "prism", NULL, 0);
    pm_vec3 lamp = pm_vec_add(o.scene.lights[0].position, o.scene.center);
    for (int i = 0; i < 60 * 60; i++) {
        double x = -0.44 + 1.33 * (i % 60) / 59.0;
        double y = -0.59 + 1.48 * (i / 60) / 59.0;
        pm_vec3 here = pm_vec(x, y, 1e-4);
        pm_vec3 way = pm_vec_normalize(pm_vec_sub(lamp, here));
        const pm_ray up = ray_in(&o, here, way, HUGE_VAL, "");
        bool in_line = fabs(y) < 0.0083; // the slit's half width, seen from the lamp
        CHECK_THAT(in_line || pm_blocked(&o.world, &up), "the beam at x %g, y %g", x, y);
    }
    close_world(&o);
}

static void lecture_changes_lamps_and_fog(void)
{
    const pm_define hard[] = {{"radiance", "0"}, {"bulb", "0.513, 0.363, 0.222"}};
    opened soft;
    open_world(&soft, "lecture", NULL, 0);
    opened bulb;
    open_world(&bulb, "lecture", hard, 2);
    CHECK(soft.scene.light_count == 2 && bulb.scene.light_count == 2);
    for (int c = 0; c < 3; c++) {
        double want = soft.scene.lights[0].flux.c[c] + soft.scene.lights[1].flux.c[c];
        double got = bulb.scene.lights[0].flux.c[c] + bulb.scene.lights[1].flux.c[c];
        CHECK_NEAR(got, want, 1e-5 * want);
    }
    CHECK(soft.scene.media[0].sigma_t == 0.0);
    close_world(&soft);
    close_world(&bulb);
}

PM_TESTS({"scenes_media.1", "light that crosses cornell-fog keeps the share that its head says",
          fog_fills_the_cornell_box},
         {"scenes_media.2", "the sun reaches the floor of its room as its head says",
          sun_reaches_the_floor_through_fog},
         {"scenes_media.3", "the ball of glass-fog has its focus where its head says",
          glass_ball_has_its_focus_in_fog},
         {"scenes_media.4", "the prism turns each colour as its head says, onto the screen",
          prism_turns_each_colour_as_it_should},
         {"scenes_media.5", "the prism's table has the beam's light through the slit only",
          slit_lets_no_other_light_in},
         {"scenes_media.6", "the lecture's bulb has the power of its square, and fog is off",
          lecture_changes_lamps_and_fog})
