/* Solids that are all but incompressible. A displacement of the basis that keeps the volume at every point is next to
 * none, so that they take their load by bulk stress that cancels between points: they lock. On a cylinder of ten cells
 * under pressure (docs/results/extreme.md, load_at_once) a Poisson's ratio of 0.49 leaves 2 and 1 % in the hoop stress
 * with quadratic and cubic splines, 50 % with hat functions; one of 0.4999 leaves more than the stress itself. */
#include "mpm/implicit/implicit.h"
#include "mpm/implicit/implicit_constants.h"

static double ratio_of(const mpm_body *b)
{
    if (!b->law || !b->law->shear_modulus) return 0.0; /* membranes */
    const double shear = b->law->shear_modulus(b->law_par);
    return shear > 0.0 ? b->law->bulk_modulus(b->law_par) / shear : 0.0;
}

double mpm_implicit_most_bulk_ratio(const mpm *s)
{
    (void)s;
    return MPM_MOST_BULK;
}

double mpm_implicit_bulk_ratio(const mpm *s, int *body)
{
    double worst = 0.0;
    for (int b = 0; b < s->n_bodies; ++b)
        if (ratio_of(&s->body[b]) > worst) {
            worst = ratio_of(&s->body[b]);
            *body = s->body[b].scene_body;
        }
    return worst;
}
