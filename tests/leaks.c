// Rays counted in closed surfaces.
#include "leaks.h"

#include "test.h"

const double pm_leaks_sizes[3] = {1e-3, 1.0, 1e4};

void pm_leaks_check(const pm_leaks *sum, double size, long rays)
{
    CHECK_THAT(sum->leaks == 0 && sum->again == 0 && sum->wrong == 0,
               "size %g: of %ld rays %ld leaked, %ld met what they left, %ld met a wrong side",
               size, sum->rays, sum->leaks, sum->again, sum->wrong);
    CHECK_THAT(sum->rays >= rays, "size %g: only %ld of %ld rays were shot", size, sum->rays,
               rays);
}

pm_vec3 pm_leaks_leaving(pm_vec3 normal, pm_rng *rng)
{
    double choice = pm_rng_draw(rng);
    double height = pm_rng_draw(rng);
    double turn = 2.0 * PM_PI * pm_rng_draw(rng);
    double z = choice < 0.2 ? pow(10.0, -9.0 * height) : height;
    double across = sqrt(1.0 - z * z);
    pm_frame frame = pm_frame_around(normal);
    return pm_frame_to_world(&frame, pm_vec(across * cos(turn), across * sin(turn), z));
}
