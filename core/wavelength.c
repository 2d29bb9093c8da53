// The standard observer's curves as sums of Gaussian lobes, each with a width of its own to
// either side, taken to linear sRGB and shorn of what lies below 0.
//
// @source Wyman, Sloan, Shirley, "Simple Analytic Approximations to the CIE XYZ Color Matching
// Functions", JCGT 2(2), 2013; IEC 61966-2-1 for the primaries and the white point
#include "wavelength.h"

#define LOBES_MAX 3

typedef struct {
    double height;
    double middle;          // [nm]
    double narrow_to_least; // [1/nm] one over the width on the side of short wavelengths
    double narrow_to_most;  // and of long ones
} lobe;

/// x, y and z of the 2 degree observer of 1931; lobes of height 0 fill up.
static const lobe observer[3][LOBES_MAX] = {
    {{0.362, 442.0, 0.0624, 0.0374},
     {1.056, 599.8, 0.0264, 0.0323},
     {-0.065, 501.1, 0.0490, 0.0382}},
    {{0.821, 568.8, 0.0213, 0.0247}, {0.286, 530.9, 0.0613, 0.0322}},
    {{1.217, 437.0, 0.0845, 0.0278}, {0.681, 459.0, 0.0385, 0.0725}},
};

/// From XYZ to linear red, green and blue.
static const double to_rgb[3][3] = {
    {3.2404542, -1.5371385, -0.4985314},
    {-0.9692660, 1.8760108, 0.0415560},
    {0.0556434, -0.2040259, 1.0572252},
};

/// Means over the range of what is left above 0: integrals to 18 digits, cut at the zeros.
static const double means[3] = {0.517738084047591159, 0.339529178944423261,
                                0.321471787032604986};

static double curve(const lobe lobes[LOBES_MAX], double wavelength)
{
    double sum = 0.0;
    for (int i = 0; i < LOBES_MAX; i++) {
        double off = wavelength - lobes[i].middle;
        double narrow = off < 0.0 ? lobes[i].narrow_to_least : lobes[i].narrow_to_most;
        double t = off * narrow;
        sum += lobes[i].height * exp(-0.5 * t * t);
    }
    return sum;
}

pm_spectrum pm_wavelength_weight(double wavelength)
{
    double xyz[3];
    for (int i = 0; i < 3; i++) {
        xyz[i] = curve(observer[i], wavelength);
    }
    pm_spectrum weight;
    for (int c = 0; c < 3; c++) {
        double value = to_rgb[c][0] * xyz[0] + to_rgb[c][1] * xyz[1] + to_rgb[c][2] * xyz[2];
        weight.c[c] = value > 0.0 ? value / means[c] : 0.0;
    }
    return weight;
}

double pm_wavelength_spread(const pm_rng_source *source, uint64_t photon)
{
    // No photon has this index. The golden section of 2^64 spreads any run of photons evenly.
    pm_rng rng = pm_rng_at(source, UINT64_MAX, 0);
    uint64_t shift = (uint64_t)(pm_rng_draw(&rng) * 0x1p53) << 11;
    uint64_t turns = shift + photon * 0x9E3779B97F4A7C15u;
    return (double)(turns >> 11) * 0x1p-53;
}
