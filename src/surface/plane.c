#include "surface/plane.h"

#include "math/tensor.h"

#include <math.h>
#include <string.h>

/* Variance along an axis, over the largest, below which the points do not extend along it. */
static const double flat = 1e-12;

double surface_weight(double s)
{
    return s < 1.0 ? (1.0 - s) * (1.0 - s) : 0.0;
}

void surface_frame_about(int dim, const double n[3], surface_frame *out)
{
    memcpy(out->n, n, sizeof out->n);
    if (dim < 3) {
        const double u[3] = {n[1], -n[0], 0.0}, v[3] = {0.0, 0.0, 1.0};
        memcpy(out->u, u, sizeof u);
        memcpy(out->v, v, sizeof v);
        return;
    }
    int least = 0;
    for (int a = 1; a < 3; ++a)
        if (fabs(n[a]) < fabs(n[least])) least = a;
    double axis[3] = {0};
    axis[least] = 1.0;
    vec_cross(axis, n, out->u);
    vec_normalize(out->u);
    vec_cross(n, out->u, out->v);
}

/* Second moments about the weighted middle, xx yy zz xy yz zx. */
static void find_moments(int n, const surface_neighbour *near, double reach, double moment[6])
{
    double sum = 1.0, middle[3] = {0}; /* the point itself, at 0, of weight 1 */
    for (int k = 0; k < n; ++k) {
        const double w = surface_weight(near[k].square / (reach * reach));
        sum += w;
        vec_add_scaled(w, near[k].d, middle);
    }
    for (int a = 0; a < 3; ++a) middle[a] /= sum;
    for (int c = 0; c < 6; ++c) moment[c] = 0.0;
    for (int k = -1; k < n; ++k) {
        const double w = k < 0 ? 1.0 : surface_weight(near[k].square / (reach * reach));
        double d[3];
        for (int a = 0; a < 3; ++a) d[a] = (k < 0 ? 0.0 : near[k].d[a]) - middle[a];
        for (int c = 0; c < 3; ++c) {
            moment[c] += w * d[c] * d[c];
            moment[3 + c] += w * d[c] * d[(c + 1) % 3];
        }
    }
}

bool surface_plane(int dim, int n, const surface_neighbour *near, double reach, surface_frame *out)
{
    double moment[6], value[3], vector[9], normal[3];
    if (n == 0 || !(reach > 0.0)) return false;
    find_moments(n, near, reach, moment);
    const double size = moment[0] + moment[1] + moment[2];
    if (dim < 3) moment[2] = 2.0 * size; /* out of the plane: never the least */
    symmetric_eigen(moment, value, vector);
    const double largest = dim < 3 ? value[1] : value[2];
    if (!(largest > flat * reach * reach) || (dim == 3 && !(value[1] > flat * largest))) return false;
    for (int a = 0; a < 3; ++a) normal[a] = vector[3 * a];
    surface_frame_about(dim, normal, out);
    return true;
}
