/* Solids that are all but incompressible are told by what their laws do, whatever their parameters are called; those beyond round-off too. */
#include "check.h"

#include "mpm/mpm.h"

/* A law in Young's modulus and Poisson's ratio. */
typedef struct young {
    double modulus, ratio;
} young;

static double bulk_of(const void *par)
{
    const young *y = par;
    return y->modulus / (3.0 * (1.0 - 2.0 * y->ratio));
}

static double shear_of(const void *par)
{
    const young *y = par;
    return y->modulus / (2.0 * (1.0 + y->ratio));
}

static void nearly_incompressible_bodies_are_found(void **state)
{
    (void)state;
    const solid_model law = {.name = "young", .bulk_modulus = bulk_of, .shear_modulus = shear_of};
    const young soft = {1e7, 0.3}, locking = {1e7, 0.4999999};
    static mpm s;
    int body = -1;
    s.basis = basis_find("quadratic");
    s.n_bodies = 1;
    s.body[0] = (mpm_body){.law = &law, .law_par = &soft, .scene_body = 4};
    check_close(mpm_implicit_bulk_ratio(&s, &body), 2.0 * 1.3 / (3.0 * 0.4),
                1e-14); /* K/G = 2 (1 + nu) / (3 (1 - 2 nu)) */
    assert_int_equal(body, 4);
    check_true(mpm_implicit_bulk_ratio(&s, &body) < mpm_implicit_most_bulk_ratio());
    s.n_bodies = 2;
    s.body[1] = (mpm_body){.law = &law, .law_par = &locking, .scene_body = 2};
    check_close_relative(mpm_implicit_bulk_ratio(&s, &body), 2.0 * 1.4999999 / (3.0 * 0.0000002), 1e-7);
    assert_int_equal(body, 2);
    check_true(mpm_implicit_bulk_ratio(&s, &body) > mpm_implicit_most_bulk_ratio());
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(nearly_incompressible_bodies_are_found)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
