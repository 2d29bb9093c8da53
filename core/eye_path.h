// A path from the eye, one move at a time: to the next surface, on through a null one, through
// a medium, and the turn that a mirror, glass or narrow gloss gives it. Who is asked for light
// on the way is compose's business.
//
// Invariant: `weight` is the factor on radiance found at the path's present end, for what the
// eye sees of it.
#ifndef PM_EYE_PATH_H
#define PM_EYE_PATH_H

#include "material.h"
#include "trace.h"

typedef struct {
    pm_ray ray;
    pm_spectrum weight; // factor on radiance found at its end
    uint32_t specular;  // S events so far
    pm_vec3 from;       // the last of them, or where the path began
    double pdf;         // [1/sr] with which that event drew the ray; 0 for smooth lobes
} pm_eye_path;

/// A surface on a path from the eye, and what it does to light towards lobes.wi.
typedef struct {
    pm_hit hit;
    pm_lobes lobes;
    uint64_t pixel; // and which of its samples, and which vertex of the sample's paths this is
    uint32_t sample;
    uint32_t vertex;
    pm_vec3 from; // where the last ray started at a surface or the eye
    double pdf;   // [1/sr] with which the S lobe there drew this ray; 0 for smooth lobes, the
                  // eye and D lobes
} pm_vertex;

/// A part of a path inside one medium.
typedef struct {
    pm_ray ray; // its medium is set; ends at t_max, INFINITY where nothing is met
    uint64_t pixel;
    uint32_t sample;
    uint32_t number; // which stretch of the sample's paths this is, from 1
} pm_stretch;

/// The path that begins along `ray`.
pm_eye_path pm_eye_path_along(const pm_ray *ray);

/// Whether the path meets a surface, null ones too; writes hit, lobes, from and pdf of `at` if
/// so.
bool pm_eye_path_meet(const pm_intersector *world, const pm_eye_path *path, pm_vertex *at);

/// The path goes on straight, beyond the null surface `at`.
void pm_eye_path_pass(pm_eye_path *path, const pm_vertex *at);

/// Takes from the weight what the medium takes on the way to `at`, or to infinity where the
/// path has not `met` it.
///
/// @param through  [out] the way; its number is left 0
/// @return false where the way leads through no medium, and nothing is changed
bool pm_eye_path_attenuate(const pm_scene *scene, pm_eye_path *path, bool met,
                           const pm_vertex *at, pm_stretch *through);

/// Takes a wavelength, as light does that meets glass that disperses, and looks at the lobes
/// anew.
///
/// @param u      where in the range of wavelengths, in [0, 1]
/// @param share  of the path that goes on with it
void pm_eye_path_colour(const pm_scene *scene, double u, double share, pm_eye_path *path,
                        pm_vertex *at);

/// Whether the path may have one more S event at a vertex.
/// @param cut  [in, out] counts the ends that only `max_specular` makes
bool pm_eye_path_may_turn(const pm_eye_path *path, const pm_vertex *at, uint32_t max_specular,
                          uint64_t *cut);

/// The path after S lobe `which`; `weight` holds that lobe's albedo already.
pm_eye_path pm_eye_path_turned(const pm_eye_path *path, const pm_vertex *at, int which,
                               pm_spectrum weight, pm_rng *rng);

/// Turns the path by one of the S lobes, chosen by roulette; false when it ends.
/// @param goes_on  [out]
pm_status pm_eye_path_choose(pm_eye_path *path, const pm_vertex *at, pm_roulette_rule rule,
                             pm_rng *rng, bool *goes_on);

#endif
