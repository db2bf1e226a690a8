/* Thick walls about a centre under pressure, in static balance: the deck of row E7, and how far its stresses are from exact ones. */
#ifndef TESTS_VERIFICATION_THICK_WALL_FIXTURE_H
#define TESTS_VERIFICATION_THICK_WALL_FIXTURE_H

#include "coupled_fixture.h"

/* Errors of the radial and the hoop stress: sums over the points of what they are off, over those of what they should be. */
typedef struct stress_errors {
    double (*exact)(double r, bool hoop);
    int dim;
    bool axial;                  /* the plane is (r, z) */
    double off[2], all[2];       /* radial, hoop */
    double volume, square, cube; /* of the points; and its sums with r^2 and r^3 */
} stress_errors;

FIXTURE void add_errors(void *user, const fields *f, int body, size_t k)
{
    stress_errors *e = user;
    double x[3] = {0.0}, s[6] = {0.0}, r = 0.0;
    for (int a = 0; a < e->dim; ++a) x[a] = field_get(f, P_POS, body, a)[k];
    for (int c = 0; c < (e->dim == 3 ? 6 : 4); ++c) s[c] = field_get(f, P_STRESS, body, c)[k];
    for (int a = 0; a < e->dim; ++a) r += x[a] * x[a];
    r = sqrt(r);
    for (int a = 0; a < 3; ++a) x[a] /= r;
    const double radial = s[0] * x[0] * x[0] + s[1] * x[1] * x[1] + (e->dim == 3 ? s[2] * x[2] * x[2] : 0.0) +
                          2.0 * (s[3] * x[0] * x[1] + s[4] * x[1] * x[2] + s[5] * x[2] * x[0]);
    const double hoop = e->dim == 3 ? 0.5 * (s[0] + s[1] + s[2] - radial) : e->axial ? s[2] : s[0] + s[1] - radial;
    const double volume = field_get(f, P_VOLUME0, body, 0)[k] * field_get(f, P_J, body, 0)[k];
    e->off[0] += volume * fabs(radial - e->exact(r, false));
    e->off[1] += volume * fabs(hoop - e->exact(r, true));
    for (int h = 0; h < 2; ++h) e->all[h] += volume * fabs(e->exact(r, h));
    e->volume += volume;
    e->square += volume * r * r;
    e->cube += volume * r * r * r;
}

/* Balance of the cylinder of row E7 with settings of its own. */
FIXTURE stress_errors balance(const char *const *set, size_t n_set, double (*expected)(double, bool), double *krylov)
{
    trial t;
    deck_begin(&t, "defaults/e7_cylinder", set, n_set);
    trial_start(&t);
    trial_run(&t, t.scene->time.end);
    stress_errors e = {
        .exact = expected, .dim = t.scene->mesh.dim, .axial = t.scene->mesh.geometry == MESH_AXISYMMETRIC};
    visit_points(&t, 0, add_errors, &e);
    *krylov = (double)t.sim->ledger.count[COUNT_BALANCE_KRYLOV];
    trial_end(&t);
    for (int h = 0; h < 2; ++h) e.off[h] /= e.all[h];
    return e;
}

#define STATIC "time.solver=static", "time.end=1", "damping=null", "verify=null"

#endif
