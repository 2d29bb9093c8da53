// The offset rule: rays that leave a hit neither meet their own primitive again nor leave the
// closed surface they are in, whatever its size, however they refract. 10 million rays.
#include "intersect.h"
#include "leaks.h"
#include "shapes.h"
#include "test.h"

enum { WALK = 1000 }; // rays of one walk; each walk has random numbers of its own

/// A closed room (its normals inward or outward) and a sphere in it that rays enter and leave.
typedef struct {
    pm_intersector world;
    int sphere;    // index of its shape
    double inward; // 1: the walls' normals point into the room; -1: out of it
    pm_vec3 start;
} room;

typedef struct {
    pm_ray ray;
    pm_hit left;  // where the ray started; shape PM_NONE in the air
    bool in_ball; // the ray runs inside the sphere
} walker;

/// Books the meeting `hit` of the walker's ray.
static void judge(const room *in, const walker *at, const pm_hit *hit, pm_leaks *sum)
{
    bool on_ball = hit->shape == in->sphere;
    bool same = hit->shape == at->left.shape && hit->primitive == at->left.primitive;
    double facing = pm_vec_dot(hit->normal, at->ray.direction);
    double expected = on_ball ? (at->in_ball ? 1.0 : -1.0) : -in->inward;
    sum->again += same && !at->in_ball;
    sum->wrong += facing * expected < 0.0 || (at->in_ball && !on_ball);
}

static walker walker_at(const room *in, pm_rng *rng)
{
    pm_vec3 direction = pm_shapes_direction(rng);
    return (walker){.ray = {in->start, direction, HUGE_VAL, 0.0, PM_NONE},
                    .left = {.shape = PM_NONE}};
}

/// One ray, and the next one from where it ends: from a wall back into the room, from the
/// sphere to either side.
static void step(const room *in, walker *at, pm_rng *rng, pm_leaks *sum)
{
    pm_hit hit;
    sum->rays++;
    if (!pm_closest(&in->world, &at->ray, &hit)) {
        sum->leaks++;
        *at = walker_at(in, rng);
        return;
    }
    judge(in, at, &hit, sum);
    bool on_ball = hit.shape == in->sphere;
    double side = on_ball ? (pm_rng_draw(rng) < 0.5 ? 1.0 : -1.0) : in->inward;
    pm_vec3 direction = pm_leaks_leaving(pm_vec_scale(hit.normal, side), rng);
    at->in_ball = on_ball && side < 0.0;
    at->left = hit;
    at->ray = pm_hit_ray(&hit, direction, 0.0, PM_NONE);
}

static pm_leaks walk_room(const room *in, long rays)
{
    long leaks = 0;
    long again = 0;
    long wrong = 0;
    long walks = rays / WALK + 1;
#pragma omp parallel for schedule(static) reduction(+ : leaks, again, wrong)
    for (long i = 0; i < walks; i++) {
        pm_leaks one = {0};
        pm_rng rng = pm_shapes_rng((uint64_t)i, 0);
        walker at = walker_at(in, &rng);
        for (int j = 0; j < WALK; j++) {
            step(in, &at, &rng, &one);
        }
        leaks += one.leaks;
        again += one.again;
        wrong += one.wrong;
    }
    return (pm_leaks){walks * WALK, leaks, again, wrong};
}

static void check_room(pm_shape *shapes, size_t count, double inward, double size)
{
    long rays = 1666667 / PM_LEAKS_THINNED;
    pm_scene scene = pm_shapes_scene(shapes, count);
    room in = {.sphere = (int)count - 1, .inward = inward};
    in.start = pm_vec_scale(pm_vec(0.0, 0.0, 0.7), size);
    CHECK_OK(pm_intersect_embree(&scene, &in.world));
    pm_leaks sum = walk_room(&in, rays);
    pm_intersector_free(&in.world);
    pm_leaks_check(&sum, size, rays);
}

static void rectangles_hold(void)
{
    pm_frame turned = pm_shapes_askew();
    for (int i = 0; i < 3; i++) {
        pm_shape shapes[7];
        pm_shapes_room(&turned, pm_vec(0.1 * pm_leaks_sizes[i], 0.0, 0.0), pm_leaks_sizes[i],
                       shapes);
        shapes[6] = pm_shapes_sphere(pm_vec_scale(pm_vec(0.1, -0.2, -0.2), pm_leaks_sizes[i]),
                                     0.4 * pm_leaks_sizes[i]);
        check_room(shapes, 7, 1.0, pm_leaks_sizes[i]);
    }
}

static void cube_holds(void)
{
    pm_frame turned = pm_shapes_upright();
    for (int i = 0; i < 3; i++) {
        pm_shape shapes[2] = {
            pm_shapes_cube(&turned, pm_vec(0.0, 0.0, 0.0), pm_leaks_sizes[i]),
            pm_shapes_sphere(pm_vec_scale(pm_vec(0.2, -0.3, -0.2), pm_leaks_sizes[i]),
                             0.4 * pm_leaks_sizes[i])};
        check_room(shapes, 2, -1.0, pm_leaks_sizes[i]);
        pm_shapes_free(shapes, 2);
    }
}

static void small_room_far_out_holds(void)
{
    pm_frame turned = pm_shapes_askew();
    pm_vec3 center = pm_vec(100.0, -40.0, 70.0);
    pm_shape shapes[7];
    pm_shapes_room(&turned, center, 1.0, shapes);
    shapes[6] = pm_shapes_sphere(pm_vec_add(center, pm_vec(0.1, -0.2, -0.2)), 0.4);
    pm_scene scene = pm_shapes_scene(shapes, 7);
    room in = {.sphere = 6, .inward = 1.0};
    in.start = pm_vec_add(center, pm_vec(0.0, 0.0, 0.7));
    CHECK_OK(pm_intersect_embree(&scene, &in.world));
    pm_leaks sum = walk_room(&in, 400000 / PM_LEAKS_THINNED);
    pm_intersector_free(&in.world);
    pm_leaks_check(&sum, 1.0, 400000 / PM_LEAKS_THINNED);
}

PM_TESTS({"offset.1", "5 million rays between rectangles and through a sphere never leak",
          rectangles_hold},
         {"offset.2", "5 million rays in a cube mesh and through a sphere never leak",
          cube_holds},
         {"offset.3", "a room a hundred times its size away from the middle does not leak",
          small_room_far_out_holds})
