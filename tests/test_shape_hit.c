// Rays against single primitives: naive formulas in long double, and the borders by hand.
#include "shape_hit.h"

#include "shape.h"
#include "shapes.h"
#include "test.h"

// --- hits against naive formulas ------------------------------------------------------------

typedef struct {
    long double x, y, z;
} wide;

static wide widen(pm_vec3 a)
{
    return (wide){(long double)a.x, (long double)a.y, (long double)a.z};
}

static wide minus(wide a, wide b)
{
    return (wide){a.x - b.x, a.y - b.y, a.z - b.z};
}

static wide along(wide a, wide b, long double f)
{
    return (wide){a.x + b.x * f, a.y + b.y * f, a.z + b.z * f};
}

static long double dot(wide a, wide b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static wide cross(wide a, wide b)
{
    return (wide){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Moeller and Trumbore; `limit` bounds u + v for a triangle and each alone for a
/// parallelogram.
static long double naive_flat(wide corner, wide edge1, wide edge2, bool triangle, wide o,
                              wide d)
{
    wide p = cross(d, edge2);
    long double det = dot(edge1, p);
    wide from = minus(o, corner);
    long double u = dot(from, p) / det;
    wide q = cross(from, edge1);
    long double v = dot(d, q) / det;
    bool inside = u >= 0.0L && v >= 0.0L && (triangle ? u + v <= 1.0L : u <= 1.0L && v <= 1.0L);
    return inside ? dot(edge2, q) / det : -1.0L;
}

/// The first positive root of a t^2 + 2 b t + c that `shape` has within its ends.
static long double naive_round(const pm_shape *shape, wide o, wide d)
{
    wide axis = widen(shape->axis);
    long double radius = (long double)shape->radius;
    long double length = (long double)shape->length;
    bool open = shape->type == PM_SHAPE_CYLINDER;
    wide from = minus(o, widen(shape->center));
    wide w = open ? along(from, axis, -dot(from, axis)) : from;
    wide v = open ? along(d, axis, -dot(d, axis)) : d;
    long double a = dot(v, v);
    long double b = dot(w, v);
    long double root2 = b * b - a * (dot(w, w) - radius * radius);
    for (int side = -1; side <= 1 && root2 >= 0.0L; side += 2) {
        long double t = (-b + (long double)side * sqrtl(root2)) / a;
        long double height = dot(along(from, d, t), axis);
        if (t > 0.0L && (!open || (height >= 0.0L && height <= length))) {
            return t;
        }
    }
    return -1.0L;
}

static long double naive_disk(const pm_shape *shape, wide o, wide d)
{
    wide from = minus(o, widen(shape->center));
    long double t = -dot(from, widen(shape->axis)) / dot(d, widen(shape->axis));
    wide out = along(from, d, t);
    long double radius = (long double)shape->radius;
    return dot(out, out) <= radius * radius ? t : -1.0L;
}

/// Negative: no hit.
static long double naive_hit(const pm_shape *shape, const pm_ray *ray)
{
    wide o = widen(ray->origin);
    wide d = widen(ray->direction);
    if (shape->type == PM_SHAPE_MESH) {
        wide v0 = widen(shape->vertices[0]);
        return naive_flat(v0, minus(widen(shape->vertices[1]), v0),
                          minus(widen(shape->vertices[2]), v0), true, o, d);
    }
    if (shape->type == PM_SHAPE_RECTANGLE) {
        return naive_flat(widen(shape->corner), widen(shape->edge[0]), widen(shape->edge[1]),
                          false, o, d);
    }
    return shape->type == PM_SHAPE_DISK ? naive_disk(shape, o, d) : naive_round(shape, o, d);
}

static pm_ray ray_from(pm_vec3 origin, pm_vec3 direction)
{
    return (pm_ray){origin, direction, HUGE_VAL, 0.0, PM_NONE};
}

static void hits_are_naive_hits(void)
{
    long hits[PM_SHAPES_KINDS] = {0};
    for (uint64_t seed = 0; seed < 2000; seed++) {
        pm_shape shapes[PM_SHAPES_KINDS];
        pm_shapes_each(seed, shapes);
        pm_rng rng = pm_shapes_rng(seed, 3);
        for (int i = 0; i < 100 * PM_SHAPES_KINDS; i++) {
            const pm_shape *shape = &shapes[i % PM_SHAPES_KINDS];
            pm_vec3 origin = pm_shapes_inside(&rng, 2.0);
            pm_ray ray = ray_from(origin, pm_shapes_direction(&rng));
            double t = -1.0;
            bool hit = pm_shape_hit(shape, 0, &ray, HUGE_VAL, &t);
            double want = (double)naive_hit(shape, &ray);
            CHECK_THAT(hit == (want > 0.0), "kind %d, seed %d: hit %d, t wanted %.17g",
                       i % PM_SHAPES_KINDS, (int)seed, hit, want);
            CHECK_THAT(!hit || fabs(t - want) <= 1e-9 * (1.0 + want),
                       "kind %d: %.17g, not %.17g", i % PM_SHAPES_KINDS, t, want);
            hits[i % PM_SHAPES_KINDS] += hit;
        }
        pm_shapes_free(shapes, PM_SHAPES_KINDS);
    }
    for (int i = 0; i < PM_SHAPES_KINDS; i++) {
        CHECK_THAT(hits[i] > 2000, "only %ld hits on kind %d", hits[i], i);
    }
}

static void sphere_from_far(void)
{
    pm_shape ball = pm_shapes_sphere(pm_vec(0.1, -0.2, 0.3), 0.01);
    pm_rng rng = pm_shapes_rng(0, 4);
    for (int i = 0; i < 100000; i++) {
        pm_vec3 normal = pm_shapes_direction(&rng);
        pm_vec3 direction = pm_shapes_direction(&rng);
        double cosine = pm_vec_dot(normal, direction);
        if (fabs(cosine) < 1e-2) {
            continue; // the meeting itself is ill-conditioned
        }
        direction = cosine < 0.0 ? direction : pm_vec_negate(direction);
        pm_vec3 target = pm_vec_along(ball.center, normal, ball.radius);
        pm_ray ray = ray_from(pm_vec_along(target, direction, -1e4 * ball.radius), direction);
        pm_hit hit = {0};
        CHECK(pm_shape_hit(&ball, 0, &ray, HUGE_VAL, &hit.t));
        CHECK_NEAR(hit.t / ball.radius, 1e4, 1e-9);
        pm_shape_complete(&ball, &ray, &hit);
        CHECK_NEAR(pm_vec_length(pm_vec_sub(hit.normal, normal)), 0.0, 1e-9);
    }
}

static void flat_rays_miss(void)
{
    pm_vec3 zero = pm_vec(0.0, 0.0, 0.0);
    pm_vec3 x = pm_vec(1.0, 0.0, 0.0);
    pm_vec3 y = pm_vec(0.0, 1.0, 0.0);
    pm_shape flat[4] = {
        pm_shapes_rectangle(zero, x, y), pm_shapes_disk(zero, pm_vec(0, 0, 1), 1.0),
        pm_shapes_triangle(zero, x, y), pm_shapes_triangle(zero, x, pm_vec_scale(x, 2.0))};
    pm_ray inside = ray_from(pm_vec(-1.0, 0.25, 0.0), x);
    pm_ray across = ray_from(pm_vec(0.5, 0.0, 1.0), pm_vec(0.0, 0.0, -1.0));
    for (int i = 0; i < 4; i++) {
        double t = 7.0;
        CHECK(!pm_shape_hit(&flat[i], 0, &inside, HUGE_VAL, &t));
        CHECK(t == 7.0);
    }
    double t = 7.0;
    CHECK(pm_shape_hit(&flat[2], 0, &across, HUGE_VAL, &t)); // on its edge
    CHECK_NEAR(t, 1.0, 0.0);
    CHECK(!pm_shape_hit(&flat[3], 0, &across, HUGE_VAL, &t)); // no area
    pm_shapes_free(flat, 4);
}

static void hits_lie_before_the_end(void)
{
    pm_shape ball = pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 1.0);
    pm_ray ray = ray_from(pm_vec(0.0, 0.0, -3.0), pm_vec(0.0, 0.0, 1.0));
    double t = 0.0;
    CHECK(!pm_shape_hit(&ball, 0, &ray, 1.999, &t));
    CHECK(pm_shape_hit(&ball, 0, &ray, 2.0, &t) && t == 2.0);
    ray.origin = pm_vec(0.0, 0.0, 0.5);
    CHECK(pm_shape_hit(&ball, 0, &ray, HUGE_VAL, &t) && t == 0.5); // from inside: the far side
    ray.origin = pm_vec(0.0, 0.0, 1.5);
    CHECK(!pm_shape_hit(&ball, 0, &ray, HUGE_VAL, &t)); // behind the ray
}

PM_TESTS(
    {"shape_hit.1", "hits on every kind are those of the naive formulas", hits_are_naive_hits},
    {"shape_hit.2", "a sphere seen from 10,000 radii away is met where it is", sphere_from_far},
    {"shape_hit.3", "rays in a plane, and triangles without area, give no hit", flat_rays_miss},
    {"shape_hit.4", "a hit lies between the ray's start and its end", hits_lie_before_the_end})
