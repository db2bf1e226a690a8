/* grad T at a point by the nodes of a tile's window. Private to mpm/thermal. */
#ifndef MPM_TEMPERATURE_GRADIENT_H
#define MPM_TEMPERATURE_GRADIENT_H

#include "mpm/transfer/locate.h"

/* At the only point of `at`; `T` in the window's order. gradient: K/m by axis. */
static inline void temperature_gradient(const stencils *at, const double *T, int dim, int basis, double gradient[3])
{
    gradient[0] = gradient[1] = gradient[2] = 0.0;
    FOR_PIECES(j, 0, dim, basis)
    FOR_ROWS(*at, j, dim, basis, {
        double along = 0.0, sum = 0.0;
        for (int x = 0; x < basis_support(basis); ++x) {
            along += at->dw[0][x][j] * T[row + x];
            sum += at->w[0][x][j] * T[row + x];
        }
        gradient[0] += W * along;
        if (dim > 1) gradient[1] += at->dw[1][y_][j] * (dim > 2 ? at->w[2][z_][j] : 1.0) * sum;
        if (dim > 2) gradient[2] += at->w[1][y_][j] * at->dw[2][z_][j] * sum;
    });
}

#endif
