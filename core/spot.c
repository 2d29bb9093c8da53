// Over the solid angle of the beam the intensity is 1; beyond it falls to 0 linearly in the
// angle. Everything is over 2 pi times the beam's intensity.
//
// Invariant: no difference of nearly equal numbers, so that a spot of a millionth of a degree
// is cut as finely as a wide one.
#include "spot.h"

#define STEPS 64 // more than halving alone needs to come down to rounding

/// 1 - cos d
static double versine(double d)
{
    double sine = sin(0.5 * d);
    return 2.0 * sine * sine;
}

/// d - sin d
static double sine_gap(double d)
{
    if (d > 0.5) {
        return d - sin(d);
    }
    double s = d * d;
    double tail = 1.0 - s / 72.0 * (1.0 - s / 110.0 * (1.0 - s / 156.0));
    return d * s / 6.0 * (1.0 - s / 20.0 * (1.0 - s / 42.0 * tail));
}

/// Power between the beam's edge and `d` radians beyond it: the integral from 0 to d of
/// (1 - x / width) sin(beam + x).
static double fading_power(const pm_light *light, double d)
{
    double width = light->cutoff - light->beam;
    double left = (width - d) / width;
    double by_sine = left * sin(d) + versine(d) / width;
    double by_cosine = left * versine(d) + sine_gap(d) / width;
    return sin(light->beam) * by_sine + cos(light->beam) * by_cosine;
}

/// How far beyond the beam's edge `power` of all the `fading` is reached: Newton's method, kept
/// between two bounds. It starts where it would be if the sine were the same all over.
static double fading_angle(const pm_light *light, double power, double fading)
{
    double width = light->cutoff - light->beam;
    double low = 0.0;
    double high = width;
    double d = width * (1.0 - sqrt(pm_most(0.0, 1.0 - power / fading)));
    for (int i = 0; i < STEPS; i++) {
        double excess = fading_power(light, d) - power;
        *(excess > 0.0 ? &high : &low) = d;
        double next = d - excess / ((1.0 - d / width) * sin(light->beam + d));
        if (!(next > low && next < high)) {
            next = 0.5 * (low + high);
        }
        double moved = fabs(next - d);
        d = next;
        if (moved <= 0x1p-51 * d) {
            break;
        }
    }
    return d;
}

double pm_spot_angle(const pm_light *light, double u)
{
    double width = light->cutoff - light->beam;
    double beam = versine(light->beam);
    double fading = width > 0.0 ? fading_power(light, width) : 0.0;
    double wanted = u * (beam + fading);
    if (wanted <= beam) {
        return 2.0 * asin(sqrt(0.5 * wanted));
    }
    return light->beam + fading_angle(light, wanted - beam, fading);
}
