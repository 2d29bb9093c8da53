// Ray queries by Embree 3 or 4.
//
// Embree keeps the tree of boxes and walks it; every primitive is user geometry, decided in
// double by pm_shape_hit(). Invariant: a box handed to Embree is larger than its primitive by
// more than a float ray can be away from the double ray it stands for, so a hit in double is
// never culled and the answer does not depend on the tree. For that
// - lengths are scaled by a power of two that brings the scene's largest coordinate to [1, 2),
// - rays that start far outside start next to the scene,
// - boxes are grown by BOX_GROWTH, and a ray's float end by the same.
// None of this moves a hit. MXCSR is never touched: denormal numbers stay numbers.
#include "intersect.h"

#include "shape.h"
#include "shape_hit.h"

#include <math.h>
#include <stdlib.h>

#if PM_EMBREE == 4
#include <embree4/rtcore.h>
typedef struct RTCRayQueryContext embree_context;
#else
#include <embree3/rtcore.h>
typedef struct RTCIntersectContext embree_context;
#endif

/// How far from the middle of the scene, in its largest coordinates, Embree's rays start at
/// most.
#define RAY_ROOM 8.0

/// Rounding of origin (at most RAY_ROOM * 2 * 2^-24) and of direction (distances stay below
/// 4 * RAY_ROOM) add up to less than 2^-18 of the scaled scene, which is 1 to 2 long.
#define BOX_GROWTH 0x1p-17

/// What stands behind one geometry of Embree's; its number there is that of the shape.
typedef struct {
    const pm_shape *shape;
    bool is_null;
    double scale;
} subject;

typedef struct {
    RTCDevice device;
    RTCScene tree;
    const pm_shape *shapes;
    subject *subjects; // one a shape
    double extent;     // [m] largest |coordinate| of any shape
    double scale;      // Embree's unit is 1/scale metres
} world;

/// One query, found again in Embree's callbacks through its first member.
typedef struct {
    embree_context context;
    const world *world;
    const pm_ray *ray;
    bool past_null; // null surfaces are not met
    double skipped; // [m] of the double ray before Embree's starts
    double t;       // [m] nearest so far, or t_max
    unsigned shape; // RTC_INVALID_GEOMETRY_ID: none so far
    uint32_t primitive;
} query;

static float to_embree(const world *at, double length)
{
    return (float)(length * at->scale);
}

// --- queries -----------------------------------------------------------------------------

/// The float ray for `ask->ray`, of which at least `ask->skipped` may be left out. False when
/// the ray cannot meet the scene.
static bool start_ray(query *ask, struct RTCRay *ray)
{
    const world *at = ask->world;
    const pm_ray *exact = ask->ray;
    double nearest = -pm_vec_dot(exact->origin, exact->direction); // to the middle of the scene
    double outside = nearest - 0.5 * RAY_ROOM * at->extent;
    ask->skipped = outside > ask->skipped ? outside : ask->skipped;
    pm_vec3 origin = pm_vec_along(exact->origin, exact->direction, ask->skipped);
    if (!(pm_vec_reach(origin) <= RAY_ROOM * at->extent) || ask->t <= ask->skipped) {
        return false;
    }
    double rest = (ask->t - ask->skipped) * at->scale;
    double end = rest < 4.0 * RAY_ROOM ? rest : 4.0 * RAY_ROOM;
    *ray = (struct RTCRay){
        .org_x = to_embree(at, origin.x),
        .org_y = to_embree(at, origin.y),
        .org_z = to_embree(at, origin.z),
        .dir_x = (float)exact->direction.x,
        .dir_y = (float)exact->direction.y,
        .dir_z = (float)exact->direction.z,
        .tfar = (float)(end + BOX_GROWTH),
        .mask = ~0u,
    };
    return true;
}

static void start_context(query *ask)
{
#if PM_EMBREE == 4
    rtcInitRayQueryContext(&ask->context);
#else
    rtcInitIntersectContext(&ask->context);
#endif
}

static void walk_closest(query *ask, struct RTCRayHit *found)
{
#if PM_EMBREE == 4
    struct RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &ask->context;
    rtcIntersect1(ask->world->tree, found, &arguments);
#else
    rtcIntersect1(ask->world->tree, &ask->context, found);
#endif
}

static void walk_blocked(query *ask, struct RTCRay *ray)
{
#if PM_EMBREE == 4
    struct RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &ask->context;
    rtcOccluded1(ask->world->tree, ray, &arguments);
#else
    rtcOccluded1(ask->world->tree, &ask->context, ray);
#endif
}

/// The answer to a query, which asks up to `ask->t`.
static bool answer(query *ask, pm_hit *hit)
{
    struct RTCRayHit found = {.hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
    ask->shape = RTC_INVALID_GEOMETRY_ID;
    if (!start_ray(ask, &found.ray)) {
        return false;
    }
    start_context(ask);
    walk_closest(ask, &found);
    if (ask->shape == RTC_INVALID_GEOMETRY_ID) {
        return false;
    }
    *hit = (pm_hit){.t = ask->t, .shape = (int)ask->shape, .primitive = ask->primitive};
    pm_shape_complete(&ask->world->shapes[ask->shape], ask->ray, hit);
    return true;
}

static bool closest(const void *state, const pm_ray *ray, pm_hit *hit)
{
    query ask = {.world = state, .ray = ray, .t = ray->t_max};
    if (!answer(&ask, hit)) {
        return false;
    }
    if (ask.world->subjects[hit->shape].is_null) {
        double end = hit->t + pm_hit_passed(hit, ray->direction);
        query behind = {
            .world = state,
            .ray = ray,
            .past_null = true,
            .skipped = pm_most(0.0, hit->t - hit->offset),
            .t = pm_least(end, ray->t_max),
        };
        (void)answer(&behind, hit);
    }
    return true;
}

static bool blocked(const void *state, const pm_ray *ray)
{
    query ask = {.world = state, .ray = ray, .t = ray->t_max, .shape = RTC_INVALID_GEOMETRY_ID};
    struct RTCRay shadow;
    if (!start_ray(&ask, &shadow)) {
        return false;
    }
    start_context(&ask);
    walk_blocked(&ask, &shadow);
    return ask.shape != RTC_INVALID_GEOMETRY_ID;
}

// --- Embree's callbacks ------------------------------------------------------------------

static void bound(const struct RTCBoundsFunctionArguments *arguments)
{
    const subject *of = arguments->geometryUserPtr;
    pm_box box = pm_shape_box(of->shape, arguments->primID);
    *arguments->bounds_o = (struct RTCBounds){
        .lower_x = (float)(box.low.x * of->scale - BOX_GROWTH),
        .lower_y = (float)(box.low.y * of->scale - BOX_GROWTH),
        .lower_z = (float)(box.low.z * of->scale - BOX_GROWTH),
        .upper_x = (float)(box.high.x * of->scale + BOX_GROWTH),
        .upper_y = (float)(box.high.y * of->scale + BOX_GROWTH),
        .upper_z = (float)(box.high.z * of->scale + BOX_GROWTH),
    };
}

static bool comes_first(const query *ask, double t, unsigned shape, uint32_t primitive)
{
    if (t != ask->t || ask->shape == RTC_INVALID_GEOMETRY_ID) {
        return true; // pm_shape_hit() lets no later t through
    }
    return shape < ask->shape || (shape == ask->shape && primitive < ask->primitive);
}

static void meet_closest(const struct RTCIntersectFunctionNArguments *arguments)
{
    query *ask = (query *)arguments->context;
    const subject *of = arguments->geometryUserPtr;
    double t;
    if (!arguments->valid[0] || (ask->past_null && of->is_null) ||
        !pm_shape_hit(of->shape, arguments->primID, ask->ray, ask->t, &t) ||
        !comes_first(ask, t, arguments->geomID, arguments->primID)) {
        return;
    }
    ask->t = t;
    ask->shape = arguments->geomID;
    ask->primitive = arguments->primID;

    // From here on Embree need not walk further than this hit.
    struct RTCRayHit *found = (struct RTCRayHit *)arguments->rayhit;
    double end = (t - ask->skipped) * of->scale;
    found->ray.tfar = fminf(found->ray.tfar, (float)(end + BOX_GROWTH));
    found->hit.geomID = arguments->geomID;
    found->hit.primID = arguments->primID;
}

static void meet_blocked(const struct RTCOccludedFunctionNArguments *arguments)
{
    query *ask = (query *)arguments->context;
    const subject *of = arguments->geometryUserPtr;
    double t;
    if (!arguments->valid[0] || of->is_null ||
        !pm_shape_hit(of->shape, arguments->primID, ask->ray, ask->t, &t)) {
        return;
    }
    ask->shape = arguments->geomID;
    ((struct RTCRay *)arguments->ray)->tfar = -INFINITY; // Embree's sign for "blocked: stop"
}

// --- building ----------------------------------------------------------------------------

static pm_status embree_status(RTCDevice device)
{
    enum RTCError code = rtcGetDeviceError(device);
    switch (code) {
    case RTC_ERROR_NONE:
        return PM_OK;
    case RTC_ERROR_OUT_OF_MEMORY:
        return PM_FAIL(PM_ENOMEM,
                       "Embree has no memory for the scene's tree; use smaller meshes");
    case RTC_ERROR_UNSUPPORTED_CPU:
        return PM_FAIL(PM_ELIMIT, "Embree does not run on this processor, it needs SSE2");
    default:
        return PM_FAIL(PM_ELIMIT, "Embree could not build the scene's tree (error %d)",
                       (int)code);
    }
}

static double extent_of(const pm_scene *scene)
{
    double extent = 0.0;
    for (int i = 0; i < scene->shape_count; i++) {
        uint32_t count = pm_shape_primitives(&scene->shapes[i]);
        for (uint32_t j = 0; j < count; j++) {
            pm_box box = pm_shape_box(&scene->shapes[i], j);
            extent = fmax(extent, fmax(pm_vec_reach(box.low), pm_vec_reach(box.high)));
        }
    }
    return extent;
}

static void attach(const world *at, unsigned index)
{
    RTCGeometry geometry = rtcNewGeometry(at->device, RTC_GEOMETRY_TYPE_USER);
    uint32_t primitives = pm_shape_primitives(at->subjects[index].shape);
    rtcSetGeometryUserPrimitiveCount(geometry, primitives);
    rtcSetGeometryUserData(geometry, &at->subjects[index]);
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
    rtcSetGeometryBoundsFunction(geometry, bound, NULL);
    rtcSetGeometryIntersectFunction(geometry, meet_closest);
    rtcSetGeometryOccludedFunction(geometry, meet_blocked);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(at->tree, geometry, index);
    rtcReleaseGeometry(geometry);
}

static pm_status build(const pm_scene *scene, world *at)
{
    at->shapes = scene->shapes;
    at->extent = extent_of(scene);
    at->scale = at->extent > 0.0 ? ldexp(1.0, -ilogb(at->extent)) : 1.0;
    at->device = rtcNewDevice("set_affinity=0");
    if (!at->device) {
        return embree_status(NULL);
    }
    at->tree = rtcNewScene(at->device);
    rtcSetSceneFlags(at->tree, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(at->tree, RTC_BUILD_QUALITY_MEDIUM);
    for (int i = 0; i < scene->shape_count; i++) {
        const pm_shape *shape = &scene->shapes[i];
        at->subjects[i] = (subject){shape, pm_shape_is_null(scene, shape), at->scale};
        attach(at, (unsigned)i);
    }
    rtcCommitScene(at->tree);
    return embree_status(at->device);
}

static void release(void *state)
{
    world *at = state;
    if (at->tree) {
        rtcReleaseScene(at->tree);
    }
    if (at->device) {
        rtcReleaseDevice(at->device);
    }
    free(at->subjects);
    free(at);
}

pm_status pm_intersect_embree(const pm_scene *scene, pm_intersector *out)
{
    world *at = calloc(1, sizeof *at);
    if (!at) {
        return PM_FAIL(PM_ENOMEM, "no memory for ray queries (%zu bytes)", sizeof *at);
    }
    size_t count = (size_t)scene->shape_count;
    at->subjects = calloc(count + 1, sizeof *at->subjects);
    if (!at->subjects) {
        release(at);
        return PM_FAIL(PM_ENOMEM, "no memory for ray queries of %zu shapes", count);
    }
    pm_status status = build(scene, at);
    if (status != PM_OK) {
        release(at);
        return status;
    }
    *out = (pm_intersector){scene, at, closest, blocked, release};
    return PM_OK;
}
