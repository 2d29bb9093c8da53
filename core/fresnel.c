// Fresnel's formulas, in forms that keep their digits near index 1 and at grazing angles.
#include "fresnel.h"

#include "quadrature.h"
#include "vec.h"

static double square(double x)
{
    return x * x;
}

double pm_fresnel_dielectric(double cos_i, double eta, double *cos_t)
{
    if (eta == 1.0) { // both sides alike, at grazing angles too
        *cos_t = cos_i;
        return 0.0;
    }
    // 1 - eta^2 sin^2, in a form that loses no digits where eta is near 1 or light grazes.
    double cos2_t = (1.0 - eta) * (1.0 + eta) + square(eta * cos_i);
    if (cos2_t <= 0.0) {
        *cos_t = 0.0;
        return 1.0;
    }
    *cos_t = sqrt(cos2_t);
    double across = eta * cos_i + *cos_t;
    double along = cos_i + eta * *cos_t;
    double r_s = (eta * cos_i - *cos_t) / across;
    double r_p = (cos_i - eta * *cos_t) / along;
    return 0.5 * (square(r_s) + square(r_p));
}

double pm_fresnel_pane(double cos_i, double eta)
{
    // R + T R T + T R^3 T + .. = 2 R / (1 + R), since T = 1 - R.
    double cos_t;
    double face = pm_fresnel_dielectric(cos_i, eta, &cos_t);
    return 2.0 * face / (1.0 + face);
}

double pm_fresnel_conductor(double cos_i, double eta, double k)
{
    double cos2 = square(cos_i);
    double sin2 = 1.0 - cos2;
    double t0 = (eta - 1.0) * (eta + 1.0) - square(k) + cos2; // eta^2 - k^2 - sin^2
    double a2_plus_b2 = sqrt(square(t0) + 4.0 * square(eta) * square(k));
    double t1 = a2_plus_b2 + cos2;
    double t2 = 2.0 * cos_i * sqrt(pm_most(0.0, 0.5 * (a2_plus_b2 + t0)));
    if (t1 + t2 == 0.0) { // index 1, exactly grazing
        return 0.0;
    }
    double r_s = (t1 - t2) / (t1 + t2);
    double t3 = cos2 * a2_plus_b2 + square(sin2);
    double t4 = t2 * sin2;
    return 0.5 * r_s * (1.0 + (t3 - t4) / (t3 + t4));
}

double pm_fresnel_diffuse_through(double eta)
{
    if (eta > 1.0) {
        // The same interface from its thinner side, where no light is reflected totally and
        // the integrand is smooth: n^2 times the share is alike on both sides.
        return pm_fresnel_diffuse_through(1.0 / eta) / square(eta);
    }
    double node[PM_QUADRATURE_MAX];
    double weight[PM_QUADRATURE_MAX];
    pm_quadrature_nodes(PM_QUADRATURE_MAX, node, weight);
    double sum = 0.0;
    for (int i = 0; i < PM_QUADRATURE_MAX; i++) {
        // Cosine = node^2: crowded where light grazes, and reflectance changes fastest.
        double cosine = square(node[i]);
        double cos_t;
        double through = 1.0 - pm_fresnel_dielectric(cosine, eta, &cos_t);
        sum += weight[i] * 4.0 * cosine * node[i] * through;
    }
    return sum;
}
