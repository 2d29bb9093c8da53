// Selection: Floyd and Rivest's sampled guesses on large runs, the middle of three middles on
// small ones, and the median of medians once those have been wrong too often.
//
// Invariant of every round: photons before `low` are not above the wanted one, those after
// `high` not below it.
#include "select.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

// Guaranteed pivots are taken after looking at this many photons per photon.
#define PATIENCE 12

// Runs above this size are worth a sample.
#define SAMPLED 600

#define BLOCK 64u

static void swap(const pm_photon_run *r, uint32_t a, uint32_t b)
{
    pm_photon photon = r->photons[a];
    r->photons[a] = r->photons[b];
    r->photons[b] = photon;
    if (r->exact != NULL) {
        pm_photon_exact exact = r->exact[a];
        r->exact[a] = r->exact[b];
        r->exact[b] = exact;
    }
}

static float coordinate(const pm_photon_run *r, uint32_t index, int axis)
{
    return r->photons[index].position[axis];
}

/// Which of three indices has the middle coordinate.
static uint32_t median_of_3(const pm_photon_run *r, uint32_t a, uint32_t b, uint32_t c,
                            int axis)
{
    float x = coordinate(r, a, axis);
    float y = coordinate(r, b, axis);
    float z = coordinate(r, c, axis);
    if (x < y) {
        return y < z ? b : x < z ? c : a;
    }
    return x < z ? a : y < z ? c : b;
}

/// A guess at the median of low .. high: the middle of three middles, spread evenly.
static uint32_t ninther(const pm_photon_run *r, uint32_t low, uint32_t high, int axis)
{
    uint32_t step = (high - low) / 8;
    uint32_t middle = low + (high - low) / 2;
    if (step == 0) {
        return median_of_3(r, low, middle, high, axis);
    }
    uint32_t a = median_of_3(r, low, low + step, low + 2 * step, axis);
    uint32_t b = median_of_3(r, middle - step, middle, middle + step, axis);
    uint32_t c = median_of_3(r, high - 2 * step, high - step, high, axis);
    return median_of_3(r, a, b, c, axis);
}

/// Where in a block of photons, taken upwards or downwards from `start`, those are that a
/// partition must move. Counting without a branch: half of all branches would be guessed wrong.
static uint32_t misplaced(const pm_photon_run *r, uint32_t start, bool upwards, float pivot,
                          int axis, uint8_t offsets[BLOCK])
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < BLOCK; i++) {
        offsets[count] = (uint8_t)i;
        float x = coordinate(r, upwards ? start + i : start - i, axis);
        count += upwards ? x >= pivot : x <= pivot;
    }
    return count;
}

/// Partitions from both ends block by block, as long as two blocks lie between *i and *j.
/// @source Edelkamp and Weiss, "BlockQuicksort", ESA 2016
static void partition_blocks(const pm_photon_run *r, uint32_t *i, uint32_t *j, float pivot,
                             int axis)
{
    uint8_t up[BLOCK];
    uint8_t down[BLOCK];
    uint32_t ups = 0;
    uint32_t downs = 0;
    uint32_t up_done = 0;
    uint32_t down_done = 0;
    while (*j - *i > 2 * BLOCK) {
        if (up_done == ups) {
            ups = misplaced(r, *i, true, pivot, axis, up);
            up_done = 0;
        }
        if (down_done == downs) {
            downs = misplaced(r, *j - 1, false, pivot, axis, down);
            down_done = 0;
        }
        while (up_done < ups && down_done < downs) {
            swap(r, *i + up[up_done++], *j - 1 - down[down_done++]);
        }
        *i += up_done == ups ? BLOCK : 0;
        *j -= down_done == downs ? BLOCK : 0;
    }
}

/// Splits low .. high by `pivot`: afterwards none before *below is above it, none from *above
/// on is below it, and what lies between equals it. Stopping at equal coordinates halves a run
/// of them.
static void partition(const pm_photon_run *r, uint32_t low, uint32_t high, float pivot,
                      int axis, uint32_t *below, uint32_t *above)
{
    uint32_t i = low;
    uint32_t j = high + 1; // one past what is still to be looked at
    partition_blocks(r, &i, &j, pivot, axis);
    while (i < j) {
        while (i < j && coordinate(r, i, axis) < pivot) {
            i++;
        }
        while (i < j && coordinate(r, j - 1, axis) > pivot) {
            j--;
        }
        if (i < j) {
            swap(r, i, j - 1);
            i++;
            j--;
        }
    }
    *below = j;
    *above = i;
}

static void insertion_sort(const pm_photon_run *r, uint32_t low, uint32_t high, int axis)
{
    for (uint32_t i = low + 1; i <= high; i++) {
        for (uint32_t j = i; j > low && coordinate(r, j, axis) < coordinate(r, j - 1, axis);
             j--) {
            swap(r, j, j - 1);
        }
    }
}

/// A guess close to the photon of rank `place`, put there: the one that has its rank in a
/// sample of n^(2/3) / 2, spread evenly. Guessing a little towards the far side leaves `place`
/// in the smaller part, and the next guess leaves next to nothing: about 1.5 n looks in all.
/// @source Floyd and Rivest, "Expected time bounds for selection", CACM 18(3), 1975
static void guess_from_sample(const pm_photon_run *r, uint32_t low, uint32_t high,
                              uint32_t place, int axis)
{
    double n = (double)(high - low) + 1.0;
    double rank = (double)(place - low) / n;
    double sample = 0.5 * cbrt(n * n);
    double far = 0.5 * sqrt(log(n) * sample) * (rank < 0.5 ? -1.0 : 1.0);
    double first = fmax((double)place - rank * sample + far, (double)low);
    double last = fmin((double)place + (1.0 - rank) * sample + far, (double)high);
    uint32_t from = (uint32_t)fmin(first, (double)place);
    uint32_t to = (uint32_t)fmax(last, (double)place);
    uint32_t step = (high - low) / (to - from + 1);
    for (uint32_t i = from; i <= to; i++) {
        swap(r, i, low + (i - from) * step);
    }
    pm_select_place(r, from, to, place, axis);
}

/// A pivot that leaves at least three tenths on either side: the median of the medians of five.
/// @source Blum et al., "Time bounds for selection", JCSS 7(4), 1973
static uint32_t median_of_medians(const pm_photon_run *r, uint32_t low, uint32_t high, int axis)
{
    uint32_t groups = (high - low + 1) / 5;
    for (uint32_t g = 0; g < groups; g++) {
        uint32_t first = low + 5 * g;
        insertion_sort(r, first, first + 4, axis);
        swap(r, low + g, first + 2);
    }
    uint32_t middle = low + groups / 2;
    pm_select_place(r, low, low + groups - 1, middle, axis);
    return middle;
}

void pm_select_place(const pm_photon_run *r, uint32_t low, uint32_t high, uint32_t place,
                     int axis)
{
    uint64_t patience = (uint64_t)PATIENCE * (high - low + 1);
    while (high - low >= 8) {
        uint64_t size = (uint64_t)high - low + 1;
        bool patient = patience >= size;
        patience -= patient ? size : 0;
        uint32_t guess = place;
        if (!patient) {
            guess = median_of_medians(r, low, high, axis);
        } else if (size > SAMPLED) {
            guess_from_sample(r, low, high, place, axis);
        } else {
            guess = ninther(r, low, high, axis);
        }
        uint32_t below;
        uint32_t above;
        partition(r, low, high, coordinate(r, guess, axis), axis, &below, &above);
        if (place >= below && place < above) {
            return;
        }
        high = place < below ? below - 1 : high;
        low = place < below ? low : above;
    }
    insertion_sort(r, low, high, axis);
}
