// A query goes down the boxes, four at a time, and looks at the balls of a leaf, eight at a
// time, both in floats; what may count is then judged in double.
//
// Invariant: floats only leave out what is farther away than their slack. For that the ray
// begins where it enters the box of all, so no coordinate is much above 1.
#include "beams.h"

#include "medium.h"

#define WAITING_MAX (3 * PM_BEAMS_LEVELS + 4) // each level puts off three nodes at most

/// A query on its way. Lengths in the beams' unit, along the ray from where it enters.
typedef struct {
    const pm_beams *beams;
    const pm_medium *medium;
    double origin[3], direction[3];
    double start, end;         // of the ray itself
    double sigma_t;            // per unit
    float from[3], towards[3]; // origin and direction
    float inverse[3];          // 1 / direction, may be infinite
    float until;               // the end, no earlier
    double sum[3], radius_sum;
    uint32_t found;
} walk;

/// Where a line enters and leaves what lies between two planes, across an axis. A line inside
/// one of them gives NaN, which leaves the pair out.
static void cut(double low, double high, double origin, double direction, double *enter,
                double *leave)
{
    double one = (low - origin) / direction;
    double other = (high - origin) / direction;
    bool backward = signbit(direction); // of -0, too
    double in = backward ? other : one;
    double out = backward ? one : other;
    *enter = in > *enter ? in : *enter;
    *leave = out < *leave ? out : *leave;
}

/// Starts a walk where the ray enters the box of all balls; false if it misses it.
static bool begin(const pm_beams *beams, const pm_medium *medium, const pm_ray *along, walk *w)
{
    const double side = 1.0 + (double)PM_BEAMS_SLACK;
    double enter = 0.0;
    double leave = along->t_max / beams->unit;
    double length = leave;
    *w = (walk){.beams = beams, .medium = medium};
    for (int axis = 0; axis < 3; axis++) {
        w->origin[axis] = pm_vec_axis(along->origin, axis) / beams->unit;
        w->direction[axis] = pm_vec_axis(along->direction, axis);
        cut(-side, side, w->origin[axis], w->direction[axis], &enter, &leave);
    }
    for (int axis = 0; axis < 3; axis++) {
        w->origin[axis] += enter * w->direction[axis];
        w->from[axis] = (float)w->origin[axis];
        w->towards[axis] = (float)w->direction[axis];
        w->inverse[axis] = 1.0f / w->towards[axis];
    }
    w->start = -enter;
    w->end = length - enter;
    w->until = (float)(leave - enter) + PM_BEAMS_SLACK;
    w->sigma_t = medium->sigma_t * beams->unit;
    return enter < leave;
}

/// Share of a disc's kernel that lies before a line at `y` < 1 radii from its middle: across
/// the line the kernel adds up to 16 / (5 pi) (1 - y^2)^(5/2).
static double share_before(double y)
{
    double phi = asin(y);
    double part = 5.0 / 16.0 * phi + 15.0 / 64.0 * sin(2.0 * phi) +
                  3.0 / 64.0 * sin(4.0 * phi) + 1.0 / 192.0 * sin(6.0 * phi);
    return 0.5 + 16.0 / (5.0 * PM_PI) * part;
}

/// Share of a disc about the ray that lies inside the medium, where it ends beside a photon;
/// `across` leads from there to the ray. 0 where the ray itself lies beyond the end.
static double share_inside(const walk *w, uint32_t index, const double across[3], double radius)
{
    const pm_rim *rim = &w->beams->rim[index];
    double left = (double)rim->distance;
    double cosine = 0.0;
    if (isinf(left)) {
        return 1.0;
    }
    for (int axis = 0; axis < 3; axis++) {
        left -= (double)rim->normal[axis] * across[axis];
        cosine += (double)rim->normal[axis] * w->direction[axis];
    }
    if (left < 0.0) {
        return 0.0;
    }
    double sine = sqrt(pm_most(0.0, (1.0 - cosine) * (1.0 + cosine)));
    return left < radius * sine ? share_before(left / (radius * sine)) : 1.0;
}

/// The light of one photon that counts, at `t`; `u` is (d / r)^2.
static void add(walk *w, uint32_t index, double t, double u, double radius, double share)
{
    const pm_photon_exact *light = &w->beams->light[index];
    double weight = (1.0 - u) * (1.0 - u) / (radius * radius * share);
    weight *= exp(-w->sigma_t * (t - w->start));
    if (w->medium->g != 0.0) {
        double cosine = 0.0;
        for (int axis = 0; axis < 3; axis++) {
            cosine -= (double)light->direction[axis] * w->direction[axis];
        }
        weight *= pm_medium_phase(w->medium, cosine);
    }
    for (int c = 0; c < 3; c++) {
        w->sum[c] += weight * (double)light->power[c];
    }
    w->radius_sum += radius;
    w->found++;
}

/// Judges one ball.
static void ask_ball(walk *w, uint32_t leaf, int place)
{
    const pm_beam_leaf *balls = &w->beams->leaf[leaf];
    double across[3]; // from the ball to the ray
    double t = 0.0;
    double distance2 = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        across[axis] = w->origin[axis] - (double)balls->at[axis][place];
        t -= across[axis] * w->direction[axis];
    }
    for (int axis = 0; axis < 3; axis++) {
        across[axis] += t * w->direction[axis];
        distance2 += across[axis] * across[axis];
    }
    double radius = (double)balls->radius[place];
    if (!(distance2 < radius * radius && t > w->start && t < w->end)) {
        return;
    }
    uint32_t index = leaf * PM_BEAMS_LEAF + (uint32_t)place;
    double share = share_inside(w, index, across, radius);
    if (share > 0.0) {
        add(w, index, t, distance2 / (radius * radius), radius, share);
    }
}

/// Which balls of a leaf the line may touch.
static void touch(const walk *w, const pm_beam_leaf *balls, int touches[PM_BEAMS_LEAF])
{
    for (int i = 0; i < PM_BEAMS_LEAF; i++) {
        float x = balls->at[0][i] - w->from[0];
        float y = balls->at[1][i] - w->from[1];
        float z = balls->at[2][i] - w->from[2];
        float t = x * w->towards[0] + y * w->towards[1] + z * w->towards[2];
        x -= t * w->towards[0];
        y -= t * w->towards[1];
        z -= t * w->towards[2];
        float radius = balls->radius[i] + PM_BEAMS_SLACK;
        touches[i] = x * x + y * y + z * z < radius * radius;
    }
}

static void ask_leaf(walk *w, uint32_t leaf)
{
    int touches[PM_BEAMS_LEAF];
    touch(w, &w->beams->leaf[leaf], touches);
    for (int i = 0; i < PM_BEAMS_LEAF; i++) {
        if (touches[i]) {
            ask_ball(w, leaf, i);
        }
    }
}

/// Which boxes of a node the ray runs through.
static void cross(const walk *w, const pm_beam_node *node, int crosses[PM_BEAMS_WIDE])
{
    float enter[PM_BEAMS_WIDE] = {0};
    float leave[PM_BEAMS_WIDE];
    for (int i = 0; i < PM_BEAMS_WIDE; i++) {
        leave[i] = w->until;
    }
    for (int axis = 0; axis < 3; axis++) {
        bool forward = w->inverse[axis] > 0.0f;
        const float *near = forward ? node->low[axis] : node->high[axis];
        const float *far = forward ? node->high[axis] : node->low[axis];
        for (int i = 0; i < PM_BEAMS_WIDE; i++) {
            float in = (near[i] - w->from[axis]) * w->inverse[axis];
            float out = (far[i] - w->from[axis]) * w->inverse[axis];
            enter[i] = in > enter[i] ? in : enter[i];
            leave[i] = out < leave[i] ? out : leave[i];
        }
    }
    for (int i = 0; i < PM_BEAMS_WIDE; i++) {
        crosses[i] = enter[i] < leave[i];
    }
}

/// A node put off: a place in its level.
typedef struct {
    int level;
    uint32_t place;
} pending;

static void go_down(walk *w)
{
    pending later[WAITING_MAX];
    int waiting = 0;
    later[waiting++] = (pending){w->beams->levels - 1, 0};
    while (waiting > 0) {
        pending at = later[--waiting];
        int crosses[PM_BEAMS_WIDE];
        cross(w, &w->beams->node[w->beams->first[at.level] + at.place], crosses);
        for (uint32_t i = 0; i < PM_BEAMS_WIDE; i++) {
            uint32_t child = at.place * PM_BEAMS_WIDE + i;
            if (crosses[i] && at.level == 0) {
                ask_leaf(w, child);
            } else if (crosses[i]) {
                later[waiting++] = (pending){at.level - 1, child};
            }
        }
    }
}

pm_beam pm_beams_query(const pm_beams *beams, const pm_medium *medium, const pm_ray *along)
{
    walk w;
    if (beams->levels == 0 || !begin(beams, medium, along, &w)) {
        return (pm_beam){0};
    }
    go_down(&w);
    double phase = medium->g == 0.0 ? pm_medium_phase(medium, 1.0) : 1.0;
    double each = 3.0 / PM_PI * phase * beams->scale / (beams->unit * beams->unit);
    pm_beam found = {.found = w.found};
    for (int c = 0; c < 3; c++) {
        found.radiance.c[c] = w.sum[c] * medium->albedo.c[c] * each;
    }
    found.radius = w.found > 0 ? w.radius_sum / w.found * beams->unit : 0.0;
    return found;
}
