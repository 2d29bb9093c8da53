// A span of a ray through one medium, and distances drawn along it at which light may be
// scattered: where much light gets back to the ray's start, and where a light is near.
//
// Invariant: pm_span_pdf() is the density with which pm_span_draw() draws, and is above 0 all
// along the span. Half of the draws go by what the medium lets through. The other half, where
// there is a centre, see from there every piece of the span under the same angle, so that the
// square of the distance to the centre cancels.
// @source Kulla and Fajardo, "Importance Sampling Techniques for Path Tracing in Participating
// Media", CGF 31(4), 2012
#ifndef PM_SPAN_H
#define PM_SPAN_H

#include "intersect.h"

typedef struct {
    double begin, end; // [m] from the ray's start; end may be INFINITY
    double sigma_t;    // [1/m]
    double ends;       // share of the light that starts at `begin` that does not get to `end`
    double foot;       // [m] where the ray is nearest to the centre
    double apart;      // [m] how far that is
    double angle;      // of the span as seen from the centre; 0: there is none
} pm_span;

/// All of `along`, without a centre.
pm_span pm_span_all(const pm_ray *along, double sigma_t);

/// Gives it a centre; `blur` [m] is added to how far that is apart, squares to squares. None
/// where the ray leads right through a centre without blur.
void pm_span_about(pm_span *span, const pm_ray *along, pm_vec3 centre, double blur);

/// Shortens a span whose centre is a spot's apex to what lies in its cone.
/// @return false when nothing is left; the span is spoilt then
bool pm_span_clip(pm_span *span, const pm_ray *along, const pm_light *spot);

/// A distance [m] from the ray's start, by a uniform number in [0, 1).
double pm_span_draw(const pm_span *span, double u);

/// Density [1/m] of that draw at `t` in the span.
double pm_span_pdf(const pm_span *span, double t);

#endif
