// Ray queries. A pm_intersector is a scene made ready for them, by Embree (intersect.c) or by
// the plain double-precision oracle (intersect_plain.c); everything else sees only this table.
//
// Both decide every hit by the same double-precision geometry (shape_hit.h, shape.h) and among
// hits at the same t by the lower shape, then primitive; so they agree to the last bit. Embree,
// whose own rays are float, only says which primitives are worth asking.
//
// Of a null surface and another one less than an offset behind it, the other one is met: a ray
// that passed the null surface would start beyond both. So a medium may end right on a wall.
//
// Offset rule. A hit is recomputed on its primitive in double. A ray that leaves it starts
// moved along the geometric normal, to the side it leaves by, by 2^-19 of the largest
// coordinate of hit and primitive. Nothing depends on the size of the whole scene and no
// epsilon is absolute.
#ifndef PM_INTERSECT_H
#define PM_INTERSECT_H

#include "scene.h"
#include "status.h"

#define PM_OFFSET 0x1p-19

/// A ray from `origin` along the unit `direction`, up to the distance `t_max` [m] (INFINITY:
/// all).
typedef struct {
    pm_vec3 origin;
    pm_vec3 direction;
    double t_max;
    double wavelength; // [nm] of a dispersed path; 0 for all three channels
    int medium;        // index of the medium it runs in, or PM_NONE
} pm_ray;

typedef struct {
    double t;           // [m] from the ray's origin
    pm_vec3 position;   // on the primitive
    pm_vec3 normal;     // unit geometric normal of the shape, whichever side was hit
    pm_vec3 inner;      // position, near the primitive's edges drawn in from them by a few
                        // offsets: where leaving rays start
    double offset;      // [m], see above
    int shape;          // index into scene->shapes
    uint32_t primitive; // triangle of a mesh, else 0
} pm_hit;

typedef struct {
    const pm_scene *scene;
    void *state;
    bool (*closest)(const void *state, const pm_ray *ray, pm_hit *hit);
    bool (*blocked)(const void *state, const pm_ray *ray);
    void (*release)(void *state);
} pm_intersector;

/// Makes `scene` ready for ray queries by Embree. The scene must outlive the intersector.
/// @param out  [out] untouched unless PM_OK; release with pm_intersector_free()
/// @return PM_ENOMEM when Embree has no memory; PM_ELIMIT when it does not run on this
/// processor
pm_status pm_intersect_embree(const pm_scene *scene, pm_intersector *out);

/// Releases it; a zeroed one is fine.
static inline void pm_intersector_free(pm_intersector *world)
{
    if (world->release) {
        world->release(world->state);
    }
    *world = (pm_intersector){0};
}

/// The nearest surface that `ray` meets at 0 < t <= t_max, null surfaces too. False, and `hit`
/// untouched, when there is none. Safe to call from many threads.
static inline bool pm_closest(const pm_intersector *world, const pm_ray *ray, pm_hit *hit)
{
    return world->closest(world->state, ray, hit);
}

/// Whether any surface but a null one lies on the ray at 0 < t <= t_max. Safe from many
/// threads.
static inline bool pm_blocked(const pm_intersector *world, const pm_ray *ray)
{
    return world->blocked(world->state, ray);
}

/// Where a ray that leaves `hit` towards the unit `direction` starts.
static inline pm_vec3 pm_hit_leave(const pm_hit *hit, pm_vec3 direction)
{
    double side = pm_vec_dot(direction, hit->normal) < 0.0 ? -1.0 : 1.0;
    return pm_vec_along(hit->inner, hit->normal, side * hit->offset);
}

/// How far behind `hit` a ray along the unit `direction` starts that passes it [m].
static inline double pm_hit_passed(const pm_hit *hit, pm_vec3 direction)
{
    return hit->offset / fabs(pm_vec_dot(direction, hit->normal));
}

/// The ray from `hit` along the unit `direction`, without end.
static inline pm_ray pm_hit_ray(const pm_hit *hit, pm_vec3 direction, double wavelength,
                                int medium)
{
    return (pm_ray){pm_hit_leave(hit, direction), direction, HUGE_VAL, wavelength, medium};
}

#endif
