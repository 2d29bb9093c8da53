// Both forms of a photon come out of the same unpacking: once from the exact values beside it,
// once from its bytes.
#include "packing_loss.h"

#include "report.h"
#include "store.h"

#include <math.h>

static double ratio(double a, double b)
{
    return b > 0.0 ? a / b : 0.0;
}

static double degrees(double radians)
{
    return radians * (180.0 / PM_PI);
}

pm_photon_map pm_packing_loss_bytes(const pm_photon_map *map)
{
    pm_photon_map bytes = *map;
    bytes.unpacked = false;
    bytes.exact = NULL;
    return bytes;
}

double pm_packing_loss_angle(pm_vec3 a, pm_vec3 b)
{
    return atan2(pm_vec_length(pm_vec_cross(a, b)), pm_vec_dot(a, b));
}

static void add(pm_packing_loss *loss, const pm_photon_view *exact,
                const pm_photon_view *packed)
{
    loss->exact = pm_spectrum_add(loss->exact, exact->power);
    loss->packed = pm_spectrum_add(loss->packed, packed->power);
    for (int c = 0; c < 3; c++) {
        double error = packed->power.c[c] - exact->power.c[c];
        loss->error2 += error * error;
        loss->power2 += exact->power.c[c] * exact->power.c[c];
    }
    double angle = pm_packing_loss_angle(exact->direction, packed->direction);
    loss->angle_sum += angle;
    loss->angle_max = fmax(loss->angle_max, angle);
    loss->count++;
}

void pm_packing_loss_add(pm_packing_loss *loss, const pm_photon_map *map)
{
    pm_photon_map bytes = pm_packing_loss_bytes(map);
    for (uint32_t i = 0; i < map->count; i++) {
        pm_photon_view exact = pm_store_unpack(map, i);
        pm_photon_view packed = pm_store_unpack(&bytes, i);
        add(loss, &exact, &packed);
    }
}

pm_spectrum pm_packing_loss_bias(const pm_packing_loss *loss)
{
    pm_spectrum bias;
    for (int c = 0; c < 3; c++) {
        bias.c[c] = ratio(loss->packed.c[c] - loss->exact.c[c], loss->exact.c[c]);
    }
    return bias;
}

double pm_packing_loss_rms(const pm_packing_loss *loss)
{
    return sqrt(ratio(loss->error2, loss->power2));
}

double pm_packing_loss_mean_degrees(const pm_packing_loss *loss)
{
    return degrees(ratio(loss->angle_sum, (double)loss->count));
}

double pm_packing_loss_max_degrees(const pm_packing_loss *loss)
{
    return degrees(loss->angle_max);
}

json_t *pm_packing_loss_json(const pm_packing_loss *loss)
{
    json_t *object = pm_report_add(json_object(), "power_bias",
                                   pm_report_spectrum(pm_packing_loss_bias(loss)));
    object = pm_report_add(object, "power_rms", json_real(pm_packing_loss_rms(loss)));
    object =
        pm_report_add(object, "angle_mean_deg", json_real(pm_packing_loss_mean_degrees(loss)));
    return pm_report_add(object, "angle_max_deg", json_real(pm_packing_loss_max_degrees(loss)));
}
