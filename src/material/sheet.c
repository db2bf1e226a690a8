#include "material/sheet.h"

#include "math/tensor.h"

#include <math.h>

void sheet_start(const double normal[3], double stretch, sheet_point *p)
{
    int least = 0;
    for (int i = 1; i < 3; i++)
        if (fabs(normal[i]) < fabs(normal[least])) least = i;
    double axis[3] = {0};
    axis[least] = 1.0;
    vec_cross(axis, normal, p->a[0]);
    vec_normalize(p->a[0]);
    vec_cross(normal, p->a[0], p->a[1]);
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 3; i++) p->a[k][i] *= stretch;
}

bool sheet_stretch(const double L[9], double dt, sheet_point *p)
{
    double normal[3];
    for (int k = 0; k < 2; k++) {
        const double a[3] = {p->a[k][0], p->a[k][1], p->a[k][2]};
        for (int i = 0; i < 3; i++) p->a[k][i] += dt * vec_dot(L + 3 * (ptrdiff_t)i, a);
    }
    vec_cross(p->a[0], p->a[1], normal);
    const double area = vec_norm(normal);
    return isfinite(area) && area > 0.0;
}

void sheet_turn(const double normal[3], sheet_point *p)
{
    double old[3], w[3];
    vec_cross(p->a[0], p->a[1], old);
    vec_normalize(old);
    const double side = vec_dot(old, normal);
    if (fabs(side) < 1e-3) return; /* no shortest way */
    vec_cross(old, normal, w);
    for (int i = 0; i < 3 && side < 0.0; i++) w[i] = -w[i];
    for (int k = 0; k < 2; k++) { /* Rodrigues: a + w x a + w x (w x a) / (1 + cosine) */
        double once[3], twice[3];
        vec_cross(w, p->a[k], once);
        vec_cross(w, once, twice);
        vec_add_scaled(1.0, once, p->a[k]);
        vec_add_scaled(1.0 / (1.0 + fabs(side)), twice, p->a[k]);
    }
}

void sheet_strain(const sheet_point *p, double strain[2], double direction[2][3])
{
    const double c11 = vec_dot(p->a[0], p->a[0]), c22 = vec_dot(p->a[1], p->a[1]), c12 = vec_dot(p->a[0], p->a[1]);
    double normal[3];
    vec_cross(p->a[0], p->a[1], normal);
    const double mean = 0.5 * (c11 + c22), half = 0.5 * (c11 - c22), largest = mean + hypot(half, c12);
    const double angle = 0.5 * atan2(c12, half), N[2] = {cos(angle), sin(angle)};
    strain[0] = 0.5 * log(largest);
    strain[1] = 0.5 * log(vec_dot(normal, normal)) - strain[0];
    for (int i = 0; i < 3; i++) direction[0][i] = N[0] * p->a[0][i] + N[1] * p->a[1][i];
    vec_normalize(direction[0]);
    vec_normalize(normal);
    vec_cross(normal, direction[0], direction[1]);
}

void sheet_stress(const membrane_response *r, const sheet_point *p, double stress[6], double *J)
{
    static const int row[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
    double e[2], m[2][3], s[2];
    sheet_strain(p, e, m);
    membrane_stress(r, 1, &e[0], &e[1], &s[0], &s[1]);
    for (int c = 0; c < 6; c++)
        stress[c] = s[0] * m[0][row[c][0]] * m[0][row[c][1]] + s[1] * m[1][row[c][0]] * m[1][row[c][1]];
    *J = membrane_volume_ratio(r->section, e[0], e[1]);
}

double sheet_energy(const membrane_response *r, const sheet_point *p)
{
    double e[2], m[2][3];
    sheet_strain(p, e, m);
    return membrane_energy(r, e[0], e[1]);
}
