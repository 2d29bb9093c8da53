// Integrals over [0, 1] by Gauss and Legendre: `count` nodes are exact for polynomials of
// degree 2 count - 1.
#ifndef PM_QUADRATURE_H
#define PM_QUADRATURE_H

#define PM_QUADRATURE_MAX 64

/// @param count   of nodes, 1 to PM_QUADRATURE_MAX
/// @param node    [out] `count` places in (0, 1), ascending
/// @param weight  [out] their weights, which add up to 1
void pm_quadrature_nodes(int count, double *node, double *weight);

#endif
