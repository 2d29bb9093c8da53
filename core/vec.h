// Vectors of three doubles: points [m], directions and normals, always in centred world space.
// Everything that is computed is double; only what is stored in bulk (photons, pixels) is
// float.
#ifndef PM_VEC_H
#define PM_VEC_H

#include <math.h>

#define PM_PI 3.14159265358979323846

typedef struct {
    double x, y, z;
} pm_vec3;

/// An orthonormal right-handed basis; `n` is the axis that directions are sampled around.
typedef struct {
    pm_vec3 s, t, n;
} pm_frame;

/// Minimum and maximum by one comparison; gcc calls fmin() and fmax() through libm.
static inline double pm_least(double a, double b)
{
    return a < b ? a : b;
}

static inline double pm_most(double a, double b)
{
    return a > b ? a : b;
}

static inline pm_vec3 pm_vec(double x, double y, double z)
{
    return (pm_vec3){x, y, z};
}

static inline pm_vec3 pm_vec_add(pm_vec3 a, pm_vec3 b)
{
    return (pm_vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline pm_vec3 pm_vec_sub(pm_vec3 a, pm_vec3 b)
{
    return (pm_vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline pm_vec3 pm_vec_scale(pm_vec3 a, double f)
{
    return (pm_vec3){a.x * f, a.y * f, a.z * f};
}

static inline pm_vec3 pm_vec_negate(pm_vec3 a)
{
    return (pm_vec3){-a.x, -a.y, -a.z};
}

/// a + b * f
static inline pm_vec3 pm_vec_along(pm_vec3 a, pm_vec3 b, double f)
{
    return (pm_vec3){a.x + b.x * f, a.y + b.y * f, a.z + b.z * f};
}

static inline double pm_vec_dot(pm_vec3 a, pm_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline pm_vec3 pm_vec_cross(pm_vec3 a, pm_vec3 b)
{
    return (pm_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline double pm_vec_length(pm_vec3 a)
{
    return sqrt(pm_vec_dot(a, a));
}

/// Unit vector along `a`, which must not be zero.
static inline pm_vec3 pm_vec_normalize(pm_vec3 a)
{
    return pm_vec_scale(a, 1.0 / pm_vec_length(a));
}

/// Largest of |x|, |y|, |z|.
static inline double pm_vec_reach(pm_vec3 a)
{
    return pm_most(fabs(a.x), pm_most(fabs(a.y), fabs(a.z)));
}

static inline double pm_vec_axis(pm_vec3 a, int axis)
{
    return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

/// Componentwise minimum and maximum, for bounding boxes.
static inline pm_vec3 pm_vec_min(pm_vec3 a, pm_vec3 b)
{
    return (pm_vec3){pm_least(a.x, b.x), pm_least(a.y, b.y), pm_least(a.z, b.z)};
}

static inline pm_vec3 pm_vec_max(pm_vec3 a, pm_vec3 b)
{
    return (pm_vec3){pm_most(a.x, b.x), pm_most(a.y, b.y), pm_most(a.z, b.z)};
}

/// The mirror image of `wi` about the unit normal `n`; both point away from the surface.
static inline pm_vec3 pm_vec_reflect(pm_vec3 wi, pm_vec3 n)
{
    return pm_vec_sub(pm_vec_scale(n, 2.0 * pm_vec_dot(wi, n)), wi);
}

/// A basis around the unit vector `n`, the same one for the same `n`, without a singular
/// direction.
/// @source Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017
static inline pm_frame pm_frame_around(pm_vec3 n)
{
    double sign = copysign(1.0, n.z);
    double a = -1.0 / (sign + n.z);
    double b = n.x * n.y * a;
    return (pm_frame){{1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x},
                      {b, sign + n.y * n.y * a, -n.y},
                      n};
}

/// The world direction with coordinates `local` in the basis.
static inline pm_vec3 pm_frame_to_world(const pm_frame *frame, pm_vec3 local)
{
    pm_vec3 flat = pm_vec_add(pm_vec_scale(frame->s, local.x), pm_vec_scale(frame->t, local.y));
    return pm_vec_along(flat, frame->n, local.z);
}

/// A direction about `n` from a point of the unit square, with density cosine / pi [1/sr]: the
/// square's unit disc, lifted onto the hemisphere.
static inline pm_vec3 pm_frame_cosine(const pm_frame *frame, const double u[2])
{
    double radius = sqrt(u[0]);
    double phi = 2.0 * PM_PI * u[1];
    pm_vec3 local = pm_vec(radius * cos(phi), radius * sin(phi), sqrt(1.0 - u[0]));
    return pm_frame_to_world(frame, local);
}

#endif
