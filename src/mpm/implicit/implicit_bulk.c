/* The largest ratio of bulk to shear modulus of a scene's solids. No ratio causes locking (implicit_volume.h), but the change of volume for a given stress
 * decreases with it, in the end to round-off. */
#include "mpm/implicit/implicit.h"
#include "mpm/implicit/implicit_constants.h"

static double ratio_of(const mpm_body *b)
{
    if (!b->law || !b->law->shear_modulus) return 0.0; /* membranes */
    const double shear = b->law->shear_modulus(b->law_par);
    return shear > 0.0 ? b->law->bulk_modulus(b->law_par) / shear : 0.0;
}

double mpm_implicit_most_bulk_ratio(void)
{
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
