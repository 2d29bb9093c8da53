// The seams of closed surfaces: rays aimed exactly at shared edges and vertices from inside,
// and rays that leave from there, stay inside.
#include "intersect.h"
#include "leaks.h"
#include "shapes.h"
#include "test.h"

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
    double ring, aside; // inside is what lies within `aside` of a ring, in pm_leaks_sizes
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

static void follow(const vessel *in, const pm_hit *hit, pm_vec3 direction, pm_leaks *sum)
{
    pm_ray ray = pm_hit_ray(hit, direction, 0.0, PM_NONE);
    pm_hit next;
    sum->rays++;
    if (!pm_closest(&in->world, &ray, &next)) {
        sum->leaks++;
        return;
    }
    bool flat = in->world.scene->shapes[next.shape].type != PM_SHAPE_CYLINDER;
    sum->again += flat && next.shape == hit->shape && next.primitive == hit->primitive;
    sum->wrong += pm_vec_dot(next.normal, direction) * in->inward > 0.0;
}

/// Three rays: one aimed at a seam, one from there anywhere, one from there along the seam.
static void probe(const vessel *in, pm_rng *rng, pm_leaks *sum)
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
    follow(in, &hit, pm_leaks_leaving(pm_vec_scale(hit.normal, in->inward), rng), sum);
    follow(in, &hit, along_seam(&hit, in->inward, &at, rng), sum);
}

static void check_seams(vessel *in, pm_shape *shapes, size_t count)
{
    long probes = 50000 / PM_LEAKS_THINNED;
    long leaks = 0;
    long again = 0;
    long wrong = 0;
    long rays = 0;
    pm_scene scene = pm_shapes_scene(shapes, count);
    CHECK_OK(pm_intersect_embree(&scene, &in->world));
#pragma omp parallel for schedule(static) reduction(+ : rays, leaks, again, wrong)
    for (long i = 0; i < probes; i++) {
        pm_leaks one = {0};
        pm_rng rng = pm_shapes_rng((uint64_t)i, 1);
        probe(in, &rng, &one);
        rays += one.rays;
        leaks += one.leaks;
        again += one.again;
        wrong += one.wrong;
    }
    pm_intersector_free(&in->world);
    pm_leaks sum = {rays, leaks, again, wrong};
    pm_leaks_check(&sum, in->size, 3 * probes);
}

static void room_seams_hold(void)
{
    for (int i = 0; i < 3; i++) {
        pm_frame turned = pm_shapes_askew();
        pm_shape walls[6];
        seam seams[24];
        pm_shapes_room(&turned, pm_vec(0.0, 0.0, 0.0), pm_leaks_sizes[i], walls);
        for (int j = 0; j < 24; j++) {
            const pm_shape *wall = &walls[j / 4];
            pm_vec3 far = pm_vec_add(pm_vec_add(wall->corner, wall->edge[0]), wall->edge[1]);
            pm_vec3 from = j & 1 ? far : wall->corner;
            double sense = j & 1 ? -1.0 : 1.0;
            seams[j] = (seam){from, pm_vec_along(from, wall->edge[j >> 1 & 1], sense)};
        }
        vessel in = {.seams = seams,
                     .seam_count = 24,
                     .inward = 1.0,
                     .size = pm_leaks_sizes[i],
                     .aside = 0.5};
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
    pm_frame flat = pm_shapes_upright();
    pm_frame turned = pm_shapes_askew();
    for (int i = 0; i < 3; i++) {
        double size = pm_leaks_sizes[i];
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
        pm_shape lens = pm_shapes_ball(pm_vec(0.0, 0.0, 0.0), pm_leaks_sizes[i], 2, 4);
        for (uint32_t j = 0; j < lens.vertex_count; j++) {
            lens.vertices[j].z *= 0.2; // faces meet at 2 atan(0.2 sqrt(2)), 32 degrees
        }
        check_mesh_seams(lens, pm_leaks_sizes[i], 0.0, 0.08);
    }
}

/// A cylinder closed by two disks; its seams are taken as short pieces of tangents.
static void can_holds(void)
{
    enum { AROUND = 200 };
    for (int i = 0; i < 3; i++) {
        pm_frame turned = pm_shapes_askew();
        pm_vec3 low = pm_vec_scale(turned.n, -0.9 * pm_leaks_sizes[i]);
        pm_vec3 high = pm_vec_scale(turned.n, 0.9 * pm_leaks_sizes[i]);
        pm_shape shapes[3] = {
            pm_shapes_cylinder(low, turned.n, 1.8 * pm_leaks_sizes[i], pm_leaks_sizes[i]),
            pm_shapes_disk(low, pm_vec_negate(turned.n), pm_leaks_sizes[i]),
            pm_shapes_disk(high, turned.n, pm_leaks_sizes[i])};
        seam seams[AROUND];
        for (int j = 0; j < AROUND; j++) {
            double turn = 2.0 * PM_PI * j / AROUND;
            pm_vec3 out = pm_frame_to_world(&turned, pm_vec(cos(turn), sin(turn), 0.0));
            pm_vec3 rim = pm_vec_along(j % 2 ? high : low, out, pm_leaks_sizes[i]);
            pm_vec3 way = pm_vec_cross(turned.n, out);
            seams[j] = (seam){rim, pm_vec_along(rim, way, 1e-9 * pm_leaks_sizes[i])};
        }
        vessel in = {.seams = seams,
                     .seam_count = AROUND,
                     .inward = -1.0,
                     .size = pm_leaks_sizes[i],
                     .aside = 0.5};
        check_seams(&in, shapes, 3);
    }
}

PM_TESTS({"seams.1", "rays aimed at the edges and corners of a room do not leak",
          room_seams_hold},
         {"seams.2", "rays aimed at the edges and vertices of meshes do not leak",
          mesh_seams_hold},
         {"seams.3", "walls that meet at 32 degrees do not leak", wedge_holds},
         {"seams.4", "rays aimed at the rims of a closed cylinder do not leak", can_holds})
