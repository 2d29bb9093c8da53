// The offset rule: rays that leave a hit neither meet their own primitive again nor slip
// through the seams of closed surfaces, whatever the size of the scene.
//
// 10 million rays in a run of the tests. Under the sanitizers, which slow a ray about
// tenfold, a twentieth of that.
#include "intersect.h"
#include "shapes.h"
#include "test.h"

#if defined(__SANITIZE_ADDRESS__)
#define THINNED 20
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define THINNED 20
#endif
#endif
#ifndef THINNED
#define THINNED 1
#endif

enum { WALK = 1000 }; // rays of one walk; each walk has random numbers of its own

static const double sizes[3] = {1e-3, 1.0, 1e4};

/// What went wrong, and in how many rays.
typedef struct {
    long rays;
    long leaks; // nothing met inside a closed surface
    long again; // the flat primitive, or the sphere from outside, that the ray has just left
    long wrong; // a surface met from a side where the ray cannot be, or out of turn
} tally;

static void check_clean(const tally *sum, double size, long rays)
{
    CHECK_THAT(sum->leaks == 0 && sum->again == 0 && sum->wrong == 0,
               "size %g: of %ld rays %ld leaked, %ld met what they left, %ld met a wrong side",
               size, sum->rays, sum->leaks, sum->again, sum->wrong);
    CHECK_THAT(sum->rays >= rays, "size %g: only %ld of %ld rays were shot", size, sum->rays,
               rays);
}

/// A unit vector on the side of `normal`: a fifth of them grazing, with cosines from 1e-9 to 1.
static pm_vec3 leaving(pm_vec3 normal, pm_rng *rng)
{
    double choice = pm_rng_draw(rng);
    double height = pm_rng_draw(rng);
    double turn = 2.0 * PM_PI * pm_rng_draw(rng);
    double z = choice < 0.2 ? pow(10.0, -9.0 * height) : height;
    double across = sqrt(1.0 - z * z);
    pm_frame frame = pm_frame_around(normal);
    return pm_frame_to_world(&frame, pm_vec(across * cos(turn), across * sin(turn), z));
}

// --- walks in a room with a sphere
// ---------------------------------------------------------------

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
static void judge(const room *in, const walker *at, const pm_hit *hit, tally *sum)
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
static void step(const room *in, walker *at, pm_rng *rng, tally *sum)
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
    pm_vec3 direction = leaving(pm_vec_scale(hit.normal, side), rng);
    at->in_ball = on_ball && side < 0.0;
    at->left = hit;
    at->ray = pm_hit_ray(&hit, direction, 0.0, PM_NONE);
}

static tally walk_room(const room *in, long rays)
{
    long leaks = 0;
    long again = 0;
    long wrong = 0;
    long walks = rays / WALK + 1;
#pragma omp parallel for schedule(static) reduction(+ : leaks, again, wrong)
    for (long i = 0; i < walks; i++) {
        tally one = {0};
        pm_rng rng = pm_shapes_rng((uint64_t)i, 0);
        walker at = walker_at(in, &rng);
        for (int j = 0; j < WALK; j++) {
            step(in, &at, &rng, &one);
        }
        leaks += one.leaks;
        again += one.again;
        wrong += one.wrong;
    }
    return (tally){walks * WALK, leaks, again, wrong};
}

/// A basis along no coordinate axis.
static pm_frame askew(void)
{
    return pm_frame_around(pm_vec_normalize(pm_vec(0.3, -0.7, 0.5)));
}

static pm_frame upright(void)
{
    return (pm_frame){{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
}

static void check_room(pm_shape *shapes, size_t count, double inward, double size)
{
    long rays = 1666667 / THINNED;
    pm_scene scene = pm_shapes_scene(shapes, count);
    room in = {.sphere = (int)count - 1, .inward = inward};
    in.start = pm_vec_scale(pm_vec(0.0, 0.0, 0.7), size);
    CHECK_OK(pm_intersect_embree(&scene, &in.world));
    tally sum = walk_room(&in, rays);
    pm_intersector_free(&in.world);
    check_clean(&sum, size, rays);
}

static void rectangles_hold(void)
{
    pm_frame turned = askew();
    for (int i = 0; i < 3; i++) {
        pm_shape shapes[7];
        pm_shapes_room(&turned, pm_vec(0.1 * sizes[i], 0.0, 0.0), sizes[i], shapes);
        shapes[6] =
            pm_shapes_sphere(pm_vec_scale(pm_vec(0.1, -0.2, -0.2), sizes[i]), 0.4 * sizes[i]);
        check_room(shapes, 7, 1.0, sizes[i]);
    }
}

static void cube_holds(void)
{
    pm_frame turned = upright();
    for (int i = 0; i < 3; i++) {
        pm_shape shapes[2] = {
            pm_shapes_cube(&turned, pm_vec(0.0, 0.0, 0.0), sizes[i]),
            pm_shapes_sphere(pm_vec_scale(pm_vec(0.2, -0.3, -0.2), sizes[i]), 0.4 * sizes[i])};
        check_room(shapes, 2, -1.0, sizes[i]);
        pm_shapes_free(shapes, 2);
    }
}

static void small_room_far_out_holds(void)
{
    pm_frame turned = askew();
    pm_vec3 center = pm_vec(100.0, -40.0, 70.0);
    pm_shape shapes[7];
    pm_shapes_room(&turned, center, 1.0, shapes);
    shapes[6] = pm_shapes_sphere(pm_vec_add(center, pm_vec(0.1, -0.2, -0.2)), 0.4);
    pm_scene scene = pm_shapes_scene(shapes, 7);
    room in = {.sphere = 6, .inward = 1.0};
    in.start = pm_vec_add(center, pm_vec(0.0, 0.0, 0.7));
    CHECK_OK(pm_intersect_embree(&scene, &in.world));
    tally sum = walk_room(&in, 400000 / THINNED);
    pm_intersector_free(&in.world);
    check_clean(&sum, 1.0, 400000 / THINNED);
}

// --- rays aimed at seams
// -------------------------------------------------------------------------

/// An edge that two primitives share.
typedef struct {
    pm_vec3 from, to;
} seam;

/// A closed surface, its seams and its inside.
typedef struct {
    pm_intersector world;
    const pm_shape *mesh; // seams are its triangles' edges
    const seam *seams;    // else these
    uint32_t seam_count;
    double inward; // as in a room
    double size;
    double ring, aside; // inside is what lies within `aside` of a ring, in sizes
} vessel;

static pm_vec3 point_inside(const vessel *in, pm_rng *rng)
{
    double turn = 2.0 * PM_PI * pm_rng_draw(rng);
    pm_vec3 aside = pm_shapes_inside(rng, in->aside);
    pm_vec3 core = pm_vec(in->ring * cos(turn), in->ring * sin(turn), 0.0);
    return pm_vec_scale(pm_vec_add(core, aside), in->size);
}

static seam pick_seam(const vessel *in, pm_rng *rng)
{
    uint32_t which = (uint32_t)(pm_rng_draw(rng) * in->seam_count);
    if (!in->mesh) {
        return in->seams[which];
    }
    const uint32_t *corner = in->mesh->triangles[which / 3];
    return (seam){in->mesh->vertices[corner[which % 3]],
                  in->mesh->vertices[corner[(which + 1) % 3]]};
}

/// A vertex in a third of the cases, else a point of an edge as exact as doubles are.
static pm_vec3 pick_target(const seam *at, pm_rng *rng)
{
    double choice = pm_rng_draw(rng);
    double along = pm_rng_draw(rng);
    return choice < 0.33 ? at->from
                         : pm_vec_along(at->from, pm_vec_sub(at->to, at->from), along);
}

/// From `hit` along the seam (or the seam's shadow, if a nearer wall was hit): in the plane of
/// the wall but for 1e-3 to 1e-12.
static pm_vec3 along_seam(const pm_hit *hit, double inward, const seam *at, pm_rng *rng)
{
    pm_vec3 way = pm_vec_sub(at->to, at->from);
    pm_vec3 flat = pm_vec_along(way, hit->normal, -pm_vec_dot(way, hit->normal));
    if (pm_vec_length(flat) < 1e-3 * pm_vec_length(way)) { // met at a corner, by the third wall
        flat = pm_frame_around(hit->normal).s;
    }
    double lift = pow(10.0, -3.0 - 9.0 * pm_rng_draw(rng));
    return pm_vec_normalize(pm_vec_along(pm_vec_normalize(flat), hit->normal, inward * lift));
}

static void follow(const vessel *in, const pm_hit *hit, pm_vec3 direction, tally *sum)
{
    pm_ray ray = pm_hit_ray(hit, direction, 0.0, PM_NONE);
    pm_hit next;
    sum->rays++;
    if (!pm_closest(&in->world, &ray, &next)) {
        sum->leaks++;
        return;
    }
    sum->again += next.shape == hit->shape && next.primitive == hit->primitive;
    sum->wrong += pm_vec_dot(next.normal, direction) * in->inward > 0.0;
}

/// Three rays: one aimed at a seam, one from there anywhere, one from there along the seam.
static void probe(const vessel *in, pm_rng *rng, tally *sum)
{
    seam at = pick_seam(in, rng);
    pm_vec3 target = pick_target(&at, rng);
    pm_vec3 origin = point_inside(in, rng);
    pm_vec3 way = pm_vec_sub(target, origin);
    pm_ray ray = {origin, pm_vec_normalize(way), HUGE_VAL, 0.0, PM_NONE};
    pm_hit hit;
    sum->rays++;
    if (!pm_closest(&in->world, &ray, &hit)) {
        sum->leaks++;
        return;
    }
    sum->leaks += hit.t > pm_vec_length(way) * (1.0 + 1e-9);
    follow(in, &hit, leaving(pm_vec_scale(hit.normal, in->inward), rng), sum);
    follow(in, &hit, along_seam(&hit, in->inward, &at, rng), sum);
}

static void check_seams(vessel *in, pm_shape *shapes, size_t count)
{
    long probes = 100000 / THINNED;
    long leaks = 0;
    long again = 0;
    long wrong = 0;
    long rays = 0;
    pm_scene scene = pm_shapes_scene(shapes, count);
    CHECK_OK(pm_intersect_embree(&scene, &in->world));
#pragma omp parallel for schedule(static) reduction(+ : rays, leaks, again, wrong)
    for (long i = 0; i < probes; i++) {
        tally one = {0};
        pm_rng rng = pm_shapes_rng((uint64_t)i, 1);
        probe(in, &rng, &one);
        rays += one.rays;
        leaks += one.leaks;
        again += one.again;
        wrong += one.wrong;
    }
    pm_intersector_free(&in->world);
    tally sum = {rays, leaks, again, wrong};
    check_clean(&sum, in->size, 3 * probes);
}

static void room_seams_hold(void)
{
    for (int i = 0; i < 3; i++) {
        pm_frame turned = askew();
        pm_shape walls[6];
        seam seams[24];
        pm_shapes_room(&turned, pm_vec(0.0, 0.0, 0.0), sizes[i], walls);
        for (int j = 0; j < 24; j++) {
            const pm_shape *wall = &walls[j / 4];
            pm_vec3 far = pm_vec_add(pm_vec_add(wall->corner, wall->edge[0]), wall->edge[1]);
            pm_vec3 from = j & 1 ? far : wall->corner;
            double sense = j & 1 ? -1.0 : 1.0;
            seams[j] = (seam){from, pm_vec_along(from, wall->edge[j >> 1 & 1], sense)};
        }
        vessel in = {
            .seams = seams, .seam_count = 24, .inward = 1.0, .size = sizes[i], .aside = 0.5};
        check_seams(&in, walls, 6);
    }
}

static void check_mesh_seams(pm_shape mesh, double size, double ring, double aside)
{
    vessel in = {.mesh = &mesh,
                 .seam_count = 3 * mesh.triangle_count,
                 .inward = -1.0,
                 .size = size,
                 .ring = ring,
                 .aside = aside};
    check_seams(&in, &mesh, 1);
    pm_shapes_free(&mesh, 1);
}

static void mesh_seams_hold(void)
{
    pm_vec3 middle = pm_vec(0.0, 0.0, 0.0);
    pm_frame flat = upright();
    pm_frame turned = askew();
    for (int i = 0; i < 3; i++) {
        double size = sizes[i];
        check_mesh_seams(pm_shapes_cube(&flat, middle, size), size, 0.0, 0.5);
        check_mesh_seams(pm_shapes_cube(&turned, middle, size), size, 0.0, 0.5);
        check_mesh_seams(pm_shapes_ball(middle, size, 60, 120), size, 0.0, 0.5);
        check_mesh_seams(pm_shapes_torus(middle, 0.7 * size, 0.25 * size, 120, 50), size, 0.7,
                         0.1);
    }
}

static void wedge_holds(void)
{
    for (int i = 0; i < 3; i++) {
        pm_shape lens = pm_shapes_ball(pm_vec(0.0, 0.0, 0.0), sizes[i], 2, 4);
        for (uint32_t j = 0; j < lens.vertex_count; j++) {
            lens.vertices[j].z *= 0.2; // faces meet at 2 atan(0.2 sqrt(2)), 32 degrees
        }
        check_mesh_seams(lens, sizes[i], 0.0, 0.08);
    }
}

PM_TESTS(
    {"offset.1", "5 million rays between rectangles and through a sphere never leak",
     rectangles_hold},
    {"offset.2", "5 million rays in a cube mesh and through a sphere never leak", cube_holds},
    {"offset.3", "a room a hundred times its size away from the middle does not leak",
     small_room_far_out_holds},
    {"offset.4", "rays aimed at the edges and corners of a room do not leak", room_seams_hold},
    {"offset.5", "rays aimed at the edges and vertices of meshes do not leak", mesh_seams_hold},
    {"offset.6", "walls that meet at 32 degrees do not leak", wedge_holds})
