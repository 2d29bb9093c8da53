// How far one picture is from another that is taken as right. Errors are of luminance
// (Rec. 709), relative to the mean of the right picture over the pixels that count.
//
// Left out are emitters, seen directly or through specular events (mask.emitter of either
// picture), grown by one pixel, and a frame of 4: there one subpixel decides everything.
#ifndef PM_COMPARE_H
#define PM_COMPARE_H

#include "coherence.h"
#include "image.h"
#include "layer.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define PM_COMPARE_FRAME 4
#define PM_COMPARE_SIGMA 5.0 // z from which a difference is not chance
#define PM_COMPARE_SHARED                                                                      \
    0.01                        // of the mean: coherent differences below may be noise that
                                // pixels share, as a photon map's, unless both have halves
#define PM_COMPARE_PAIRS_MIN 30 // tile pairs below which z says nothing

/// Two pictures of one size with finite channels R G B. They stay the caller's.
typedef struct {
    const pm_image *image[2]; // A, and B, which is right
    uint8_t *counted;         // width * height; 0: left out
    uint64_t count;           // pixels counted
} pm_compare_pair;

/// One layer, or the whole picture.
typedef struct {
    char name[16];        // "" for the whole picture
    bool halves;          // rel_mse is free of B's own noise and may be negative
    double rel_mse;       // NaN where B is black and A is not
    double rel_rmse;      // its root; 0 for a negative one
    double mean_b;        // luminance of B
    double mean_ratio[3]; // A over B by channel; NaN where B is black and A is not
    double max;           // largest |A - B|, in the pictures' unit
    int max_x, max_y;
    bool noise_known; // both pictures have halves
    pm_coherence coherence;
} pm_compare_part;

typedef enum {
    PM_COMPARE_EQUAL, // every counted pixel is the same
    PM_COMPARE_NOISE,
    PM_COMPARE_UNCERTAIN, // coherent, but so small that shared noise explains it; or too few
                          // pixels
    PM_COMPARE_FAULT,
} pm_compare_verdict;

/// Checks the pictures and decides which pixels count.
///
/// @param names  of the two, for messages
/// @param masked  false: every pixel counts
/// @param pair   [out] untouched unless PM_OK; free with pm_compare_pair_free()
/// @return PM_EINPUT with a line: sizes differ, a channel is missing, a pixel is not finite, or
///         no pixel is left
pm_status pm_compare_pair_make(const pm_image *a, const pm_image *b, const char *const names[2],
                               bool masked, pm_compare_pair *pair);
void pm_compare_pair_free(pm_compare_pair *pair);

/// Whether both pictures have the three channels of `layer`.
bool pm_compare_has(const pm_compare_pair *pair, const char *layer);

/// Measures a layer that both have; "" for the whole picture.
/// @param part  [out]
pm_status pm_compare_measure(const pm_compare_pair *pair, const char *layer,
                             pm_compare_part *part);

/// Fault or noise, with a sentence for the user: a fault when the picture or one of its layers
/// leans (coherence.h), or a layer is black in one picture only.
/// @param layers    `count` of them
/// @param sentence  [out] of at most `room` bytes
pm_compare_verdict pm_compare_judge(const pm_compare_part *whole, const pm_compare_part *layers,
                                    int count, char *sentence, size_t room);

/// Writes a PNG of A - B: red where A is brighter, blue where it is darker, black where they
/// agree, grey where it does not count.
/// @param full  [out] difference of full colour: 99 % of the pixels lie within
pm_status pm_compare_picture(const pm_compare_pair *pair, const char *path, double *full);

#endif
