// Ray queries: Embree against the plain oracle to the last bit, scaling by powers of two,
// shadow rays between surfaces, null surfaces, and scenes with little in them.
#include "intersect.h"

#include "intersect_plain.h"
#include "shape.h"
#include "shapes.h"
#include "test.h"

#include <float.h>
#include <string.h>

enum { MIXED = 4 * PM_SHAPES_KINDS + 2 };

/// All kinds, overlapping at random, with a mesh of many triangles.
static void mixed_shapes(uint64_t seed, pm_shape shapes[MIXED])
{
    for (uint64_t i = 0; i < 4; i++) {
        pm_shapes_each(4 * seed + i, &shapes[PM_SHAPES_KINDS * i]);
    }
    pm_rng rng = pm_shapes_rng(seed, 8);
    pm_vec3 center = pm_shapes_inside(&rng, 1.0);
    shapes[MIXED - 2] = pm_shapes_torus(center, 0.8, 0.3, 30, 12);
    shapes[MIXED - 1] = pm_shapes_ball(center, 0.4, 10, 20);
}

/// Every second ray has an end; of eight, one starts far outside and one runs along an axis.
static pm_ray random_ray(int index, pm_rng *rng)
{
    pm_vec3 origin = pm_shapes_inside(rng, 2.5);
    pm_vec3 direction = pm_shapes_direction(rng);
    double end = pm_rng_draw(rng) * 4.0;
    if (index % 8 == 3) {
        double far = pow(10.0, 1.0 + 4.0 * pm_rng_draw(rng));
        origin = pm_vec_along(origin, direction, -far);
        end += far;
    }
    if (index % 8 == 4) {
        direction = pm_vec(index % 3 == 0, index % 3 == 1, -(index % 3 == 2));
    }
    return (pm_ray){origin, direction, index % 2 ? end : HUGE_VAL, 0.0, PM_NONE};
}

static bool same_vec(pm_vec3 a, pm_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static bool same_hit(const pm_hit *a, const pm_hit *b)
{
    return a->t == b->t && a->shape == b->shape && a->primitive == b->primitive &&
           same_vec(a->position, b->position) && same_vec(a->normal, b->normal) &&
           same_vec(a->inner, b->inner) && a->offset == b->offset;
}

static void embree_is_the_oracle(void)
{
    long hits[PM_SHAPES_KINDS] = {0};
    for (uint64_t seed = 0; seed < 8; seed++) {
        pm_shape shapes[MIXED];
        mixed_shapes(seed, shapes);
        pm_scene scene = pm_shapes_scene(shapes, MIXED);
        pm_intersector embree;
        pm_intersector plain;
        CHECK_OK(pm_intersect_embree(&scene, &embree));
        CHECK_OK(pm_intersect_plain(&scene, &plain));
        for (int i = 0; i < 2000; i++) {
            pm_rng rng = pm_shapes_rng(seed << 32 | (uint64_t)i, 9);
            pm_ray ray = random_ray(i, &rng);
            pm_hit got;
            pm_hit want;
            bool met = pm_closest(&embree, &ray, &got);
            CHECK(met == pm_closest(&plain, &ray, &want));
            CHECK_THAT(!met || same_hit(&got, &want),
                       "seed %d, ray %d: shape %d at %.17g, oracle: shape %d at %.17g",
                       (int)seed, i, got.shape, got.t, want.shape, want.t);
            CHECK(pm_blocked(&embree, &ray) == met);
            CHECK(pm_blocked(&plain, &ray) == met);
            hits[met ? shapes[got.shape].type : 0] += met;
        }
        pm_intersector_free(&embree);
        pm_intersector_free(&plain);
        pm_shapes_free(shapes, MIXED);
    }
    for (int i = 0; i < PM_SHAPES_KINDS; i++) {
        CHECK_THAT(hits[i] > 100, "kind %d was met only %ld times", i, hits[i]);
    }
}

static pm_hit scaled_hit(pm_hit hit, double factor)
{
    hit.t *= factor;
    hit.position = pm_vec_scale(hit.position, factor);
    hit.inner = pm_vec_scale(hit.inner, factor);
    hit.offset *= factor;
    return hit;
}

static void check_scaling(const pm_intersector *world, pm_shape *shapes, double factor)
{
    pm_shape scaled[MIXED];
    for (int i = 0; i < MIXED; i++) {
        scaled[i] = pm_shapes_scaled(&shapes[i], factor);
    }
    pm_scene scene = pm_shapes_scene(scaled, MIXED);
    pm_intersector other;
    CHECK_OK(pm_intersect_embree(&scene, &other));
    for (int i = 0; i < 20000; i++) {
        pm_rng rng = pm_shapes_rng((uint64_t)i, 10);
        pm_ray ray = random_ray(i, &rng);
        pm_ray longer = ray;
        longer.origin = pm_vec_scale(ray.origin, factor);
        longer.t_max *= factor;
        pm_hit here;
        pm_hit there;
        bool met = pm_closest(world, &ray, &here);
        CHECK(met == pm_closest(&other, &longer, &there));
        if (met) {
            pm_hit want = scaled_hit(here, factor);
            CHECK_THAT(same_hit(&there, &want), "x %g, ray %d: t %.17g, not %.17g", factor, i,
                       there.t, want.t);
        }
    }
    pm_intersector_free(&other);
    pm_shapes_free(scaled, MIXED);
}

static void scaling_keeps_bits(void)
{
    pm_shape shapes[MIXED];
    mixed_shapes(1, shapes);
    pm_scene scene = pm_shapes_scene(shapes, MIXED);
    pm_intersector world;
    CHECK_OK(pm_intersect_embree(&scene, &world));
    check_scaling(&world, shapes, 0x1p20);
    check_scaling(&world, shapes, 0x1p-20);
    check_scaling(&world, shapes, 0x1p-60);
    check_scaling(&world, shapes, 0x1p60);
    pm_intersector_free(&world);
    pm_shapes_free(shapes, MIXED);
}

// --- shadow rays -------------------------------------------------------------------------

/// The shadow ray between two points; false when they do not face each other.
static bool shadow_ray(const pm_hit *from, const pm_hit *to, pm_ray *ray)
{
    pm_vec3 way = pm_vec_sub(to->position, from->position);
    if (pm_vec_dot(way, from->normal) <= 0.0 || pm_vec_dot(way, to->normal) >= 0.0) {
        return false;
    }
    pm_vec3 origin = pm_hit_leave(from, way);
    pm_vec3 gap = pm_vec_sub(pm_hit_leave(to, pm_vec_negate(way)), origin);
    *ray = (pm_ray){origin, pm_vec_normalize(gap), pm_vec_length(gap), 0.0, PM_NONE};
    return true;
}

static pm_hit random_point(const pm_shape *shape, pm_rng *rng)
{
    pm_hit hit = {0};
    double u = pm_rng_draw(rng);
    double v = pm_rng_draw(rng);
    pm_shape_point(shape, u, v, &hit);
    return hit;
}

/// A room with lamps that touch it: in the plane of a wall, standing on the floor and against a
/// wall with their edges, and hanging in the air.
static void lamps_that_touch_are_seen(void)
{
    enum { WALLS = 6, ALL = 9 };
    pm_frame flat = pm_shapes_upright();
    static const double sizes[3] = {1e-3, 1.0, 1e4};
    for (int s = 0; s < 3; s++) {
        double a = sizes[s];
        pm_shape shapes[ALL];
        pm_shapes_room(&flat, pm_vec(0.0, 0.0, 0.0), a, shapes);
        shapes[6] = pm_shapes_rectangle(pm_vec(-0.2 * a, -0.2 * a, a),
                                        pm_vec(0.0, 0.4 * a, 0.0), pm_vec(0.4 * a, 0.0, 0.0));
        shapes[7] = pm_shapes_rectangle(pm_vec(-a, -0.5 * a, -a), pm_vec(0.3 * a, 0.0, 0.0),
                                        pm_vec(0.0, 0.0, 0.3 * a));
        shapes[8] =
            pm_shapes_disk(pm_vec(0.5 * a, 0.0, 0.9 * a), pm_vec(0.0, 0.0, -1.0), 0.1 * a);
        long seen = 0;
        for (int lamp = WALLS; lamp < ALL; lamp++) {
            pm_shape pair[WALLS + 1];
            memcpy(pair, shapes, WALLS * sizeof *shapes);
            pair[WALLS] = shapes[lamp];
            pm_scene scene = pm_shapes_scene(pair, WALLS + 1);
            pm_intersector world;
            CHECK_OK(pm_intersect_embree(&scene, &world));
            for (int i = 0; i < 60000; i++) {
                pm_rng rng = pm_shapes_rng((uint64_t)i, 11);
                pm_hit from = random_point(&pair[i % WALLS], &rng);
                pm_hit to = random_point(&pair[WALLS], &rng);
                pm_ray ray;
                if (shadow_ray(&from, &to, &ray)) {
                    CHECK_THAT(!pm_blocked(&world, &ray), "size %g, lamp %d, point %d", a, lamp,
                               i);
                    seen++;
                }
            }
            pm_intersector_free(&world);
        }
        CHECK(seen > 60000);
    }
}

static void ball_between_blocks(void)
{
    pm_frame flat = pm_shapes_upright();
    pm_shape shapes[7];
    pm_shapes_room(&flat, pm_vec(0.0, 0.0, 0.0), 1.0, shapes);
    shapes[6] = pm_shapes_sphere(pm_vec(0.1, 0.2, -0.1), 0.5);
    pm_scene scene = pm_shapes_scene(shapes, 7);
    pm_intersector world;
    CHECK_OK(pm_intersect_embree(&scene, &world));
    long blocked = 0;
    for (int i = 0; i < 100000; i++) {
        pm_rng rng = pm_shapes_rng((uint64_t)i, 12);
        pm_hit from = random_point(&shapes[i % 6], &rng);
        pm_hit to = random_point(&shapes[i / 6 % 6], &rng);
        pm_ray ray;
        if (!shadow_ray(&from, &to, &ray)) {
            continue;
        }
        pm_vec3 out = pm_vec_sub(shapes[6].center, ray.origin);
        double miss = pm_vec_length(pm_vec_cross(out, ray.direction)) - shapes[6].radius;
        CHECK_THAT(fabs(miss) < 1e-9 || pm_blocked(&world, &ray) == (miss < 0.0), "point %d",
                   i);
        blocked += miss < 0.0;
    }
    CHECK(blocked > 10000);
    pm_intersector_free(&world);
}

static void null_surfaces_let_pass(void)
{
    pm_material materials[2] = {{.type = PM_BSDF_NULL}, {.type = PM_BSDF_DIFFUSE}};
    pm_vec3 x = pm_vec(2.0, 0.0, 0.0);
    pm_vec3 y = pm_vec(0.0, 2.0, 0.0);
    pm_shape shapes[3] = {pm_shapes_rectangle(pm_vec(-1.0, -1.0, 1.0), x, y),
                          pm_shapes_sphere(pm_vec(0.0, 0.0, 3.0), 0.5),
                          pm_shapes_rectangle(pm_vec(-1.0, -1.0, 5.0), x, y)};
    pm_scene scene = pm_shapes_scene(shapes, 3);
    scene.materials = materials;
    scene.material_count = 2;
    for (int i = 0; i < 3; i++) {
        shapes[i].material[0] = shapes[i].material[1] = i / 2;
    }
    pm_intersector worlds[2];
    CHECK_OK(pm_intersect_embree(&scene, &worlds[0]));
    CHECK_OK(pm_intersect_plain(&scene, &worlds[1]));
    for (int i = 0; i < 2; i++) {
        pm_ray ray = {pm_vec(0.1, 0.2, 0.0), pm_vec(0.0, 0.0, 1.0), 4.9, 0.0, PM_NONE};
        pm_hit hit;
        CHECK(pm_closest(&worlds[i], &ray, &hit) && hit.shape == 0);
        CHECK(!pm_blocked(&worlds[i], &ray));
        ray.t_max = 5.1;
        CHECK(pm_blocked(&worlds[i], &ray));
        pm_intersector_free(&worlds[i]);
    }
}

/// Where a medium ends right on a floor, and a ray that passed its end would start below both.
static void walls_stand_before_null_surfaces_on_them(void)
{
    pm_material materials[2] = {{.type = PM_BSDF_NULL}, {.type = PM_BSDF_DIFFUSE}};
    pm_vec3 x = pm_vec(1.3, 0.4, 0.3);
    pm_vec3 y = pm_vec(-0.2, 1.1, 0.7);
    pm_vec3 corner = pm_vec(-0.5, -0.8, -0.1);
    pm_shape shapes[2] = {
        pm_shapes_rectangle(corner, x, y),
        pm_shapes_rectangle(pm_vec_along(corner, x, -0.1), pm_vec_scale(x, 1.2), y)};
    for (int i = 0; i < 2; i++) {
        shapes[i].material[0] = shapes[i].material[1] = i;
    }
    pm_scene scene = pm_shapes_scene(shapes, 2);
    scene.materials = materials;
    scene.material_count = 2;
    pm_intersector worlds[2];
    CHECK_OK(pm_intersect_embree(&scene, &worlds[0]));
    CHECK_OK(pm_intersect_plain(&scene, &worlds[1]));
    pm_rng rng = pm_shapes_rng(5, 9);
    int leaks = 0;
    for (int i = 0; i < 2000; i++) {
        pm_ray ray = random_ray(8 * i, &rng);
        pm_hit hits[2];
        bool met = pm_closest(&worlds[0], &ray, &hits[0]);
        CHECK(pm_closest(&worlds[1], &ray, &hits[1]) == met);
        leaks += met && (hits[0].shape != 1 || !same_hit(&hits[0], &hits[1]));
    }
    CHECK(leaks == 0);
    pm_intersector_free(&worlds[0]);
    pm_intersector_free(&worlds[1]);
}

// --- scenes with little in them, and what must not happen --------------------------------

static void check_nothing_there(pm_shape *shapes, size_t count)
{
    pm_scene scene = pm_shapes_scene(shapes, count);
    pm_intersector worlds[2];
    CHECK_OK(pm_intersect_embree(&scene, &worlds[0]));
    CHECK_OK(pm_intersect_plain(&scene, &worlds[1]));
    for (int i = 0; i < 2; i++) {
        pm_ray ray = {pm_vec(0.0, 0.0, 0.0), pm_vec(0.0, 0.0, 1.0), HUGE_VAL, 0.0, PM_NONE};
        pm_hit hit = {.shape = 77};
        CHECK(!pm_closest(&worlds[i], &ray, &hit));
        CHECK(hit.shape == 77);
        CHECK(!pm_blocked(&worlds[i], &ray));
        pm_intersector_free(&worlds[i]);
        pm_intersector_free(&worlds[i]);
    }
}

static void empty_scenes_give_nothing(void)
{
    pm_vec3 ahead = pm_vec(0.0, 0.0, 1.0);
    pm_shape flat[3] = {
        pm_shapes_triangle(ahead, ahead, ahead),
        pm_shapes_triangle(pm_vec(-1.0, 0.0, 1.0), ahead, pm_vec(1.0, 0.0, 1.0)),
        pm_shapes_triangle(ahead, pm_vec(0.0, 1.0, 1.0), ahead)};
    check_nothing_there(NULL, 0);
    check_nothing_there(flat, 3);
    flat[2].triangle_count = 0;
    check_nothing_there(&flat[2], 1);
    pm_shapes_free(flat, 3);
}

static void equal_distances_go_to_the_first(void)
{
    pm_frame flat = pm_shapes_upright();
    pm_shape shapes[8];
    for (int i = 0; i < 8; i++) {
        shapes[i] = pm_shapes_cube(&flat, pm_vec(0.0, 0.0, 0.0), 1.0);
    }
    pm_scene scene = pm_shapes_scene(shapes, 8);
    pm_intersector world;
    CHECK_OK(pm_intersect_embree(&scene, &world));
    for (uint64_t i = 0; i < 1000; i++) {
        pm_rng rng = pm_shapes_rng(i, 13);
        pm_ray ray = {pm_vec(0.0, 0.0, 0.0), pm_shapes_direction(&rng), HUGE_VAL, 0.0, PM_NONE};
        pm_hit hit;
        CHECK(pm_closest(&world, &ray, &hit));
        CHECK_THAT(hit.shape == 0, "ray %d: shape %d of eight equal ones", (int)i, hit.shape);
    }
    pm_intersector_free(&world);
    pm_shapes_free(shapes, 8);
}

/// Flush-to-zero or denormals-are-zero, set in some thread, would lose dim photons.
static void denormals_survive(void)
{
    pm_shape ball = pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 1.0);
    pm_scene scene = pm_shapes_scene(&ball, 1);
    pm_intersector world;
    CHECK_OK(pm_intersect_embree(&scene, &world));
    long lost = 0;
#pragma omp parallel for reduction(+ : lost)
    for (int i = 0; i < 64; i++) {
        pm_ray ray = {pm_vec(0.0, 0.0, 0.0), pm_vec(0.0, 0.0, 1.0), HUGE_VAL, 0.0, PM_NONE};
        pm_hit hit;
        volatile double least = DBL_MIN;
        volatile float least_float = FLT_MIN;
        lost += !pm_closest(&world, &ray, &hit);
        lost += least * 0.25 == 0.0 || least_float * 0.25f == 0.0f;
        least = least * 0.25;
        lost += least * 4.0 != DBL_MIN;
    }
    CHECK(lost == 0);
    pm_intersector_free(&world);
}

PM_TESTS({"intersect.1", "Embree gives the oracle's hits to the last bit",
          embree_is_the_oracle},
         {"intersect.2", "hits scale with the scene by powers of two, bit for bit",
          scaling_keeps_bits},
         {"intersect.3", "lamps that touch a wall are seen from every point they face",
          lamps_that_touch_are_seen},
         {"intersect.4", "a ball blocks the shadow rays through it, and no others",
          ball_between_blocks},
         {"intersect.5", "null surfaces are met and do not block", null_surfaces_let_pass},
         {"intersect.6", "no shapes, and triangles without area, give no hit",
          empty_scenes_give_nothing},
         {"intersect.7", "of surfaces at the same distance the first is met",
          equal_distances_go_to_the_first},
         {"intersect.8", "denormal numbers survive ray queries in every thread",
          denormals_survive},
         {"intersect.9", "a wall is met before a null surface that lies on it",
          walls_stand_before_null_surfaces_on_them})
