/* Small tensors: identities that hold for any argument, each to round-off times a stated factor. */
#include "check.h"

#include "math/tensor.h"

#include <float.h>
#include <string.h>

enum { TRIALS = 2000 };

static void random_tensor(uint64_t *seed, double size, double a[9])
{
    for (int k = 0; k < 9; k++) a[k] = check_random(seed, -size, size);
}

static void random_symmetric(uint64_t *seed, double s[6])
{
    for (int k = 0; k < 6; k++) s[k] = check_random(seed, -1.0, 1.0);
}

static void check_tensor_close(const double a[9], const double b[9], double tol)
{
    for (int k = 0; k < 9; k++) check_close(a[k], b[k], tol);
}

static void vectors(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int trial = 0; trial < TRIALS; trial++) {
        double a[3], b[3], c[3];
        for (int i = 0; i < 3; i++) a[i] = check_random(&seed, -1.0, 1.0), b[i] = check_random(&seed, -1.0, 1.0);
        vec_cross(a, b, c);
        check_close(vec_dot(a, c), 0.0, 4 * DBL_EPSILON);
        check_close(vec_dot(c, c) + vec_dot(a, b) * vec_dot(a, b), vec_dot(a, a) * vec_dot(b, b), 20 * DBL_EPSILON);
        const double length = vec_norm(a);
        check_close(vec_distance2(a, b), vec_dot(a, a) + vec_dot(b, b) - 2 * vec_dot(a, b), 20 * DBL_EPSILON);
        check_close(vec_normalize(a), length, 0.0);
        check_close(vec_norm(a), 1.0, 4 * DBL_EPSILON);
        vec_add_scaled(-1.0, a, a);
        check_close(vec_normalize(a), 0.0, 0.0);
        check_close(a[0], 0.0, 0.0);
    }
}

static void products_by_definition(void **state)
{
    (void)state;
    uint64_t seed = 2;
    double a[9], b[9], ab[9], atb[9], abt[9], x[3] = {1.0, -2.0, 3.0}, y[3];
    random_tensor(&seed, 1.0, a);
    random_tensor(&seed, 1.0, b);
    tensor_multiply(a, b, ab);
    tensor_transposed_multiply(a, b, atb);
    tensor_multiply_transposed(a, b, abt);
    tensor_apply(a, x, y);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            double sums[3] = {0.0, 0.0, 0.0};
            for (int k = 0; k < 3; k++) {
                sums[0] += a[3 * i + k] * b[3 * k + j];
                sums[1] += a[3 * k + i] * b[3 * k + j];
                sums[2] += a[3 * i + k] * b[3 * j + k];
            }
            check_close(ab[3 * i + j], sums[0], 4 * DBL_EPSILON);
            check_close(atb[3 * i + j], sums[1], 4 * DBL_EPSILON);
            check_close(abt[3 * i + j], sums[2], 4 * DBL_EPSILON);
        }
        check_close(y[i], vec_dot(&a[(size_t)(3 * i)], x), 0.0);
    }
}

static void determinant_and_inverse(void **state)
{
    (void)state;
    uint64_t seed = 3;
    double identity[9];
    tensor_identity(identity);
    for (int trial = 0; trial < TRIALS; trial++) {
        double a[9], b[9], ab[9], inverse[9], product[9];
        random_tensor(&seed, 1.0, a);
        random_tensor(&seed, 1.0, b);
        tensor_multiply(a, b, ab);
        check_close(tensor_det(ab), tensor_det(a) * tensor_det(b), 200 * DBL_EPSILON);
        const double det = tensor_inverse(a, inverse);
        check_close(det, tensor_det(a), 0.0);
        tensor_multiply(a, inverse, product);
        /* Cofactors carry round-off of size 1, which the inverse magnifies by 1/det. */
        check_tensor_close(product, identity, 20 * DBL_EPSILON * (1.0 + 1.0 / fabs(det)));
    }
    const double singular[9] = {1.0, 2.0, 3.0, 2.0, 4.0, 6.0, 0.0, 0.0, 1.0};
    double inverse[9];
    check_close(tensor_inverse(singular, inverse), 0.0, 0.0);
    check_true(!isfinite(inverse[0]));
}

static void parts_add_up(void **state)
{
    (void)state;
    uint64_t seed = 4;
    double a[9], s[6], w[9], d[9], full[9];
    random_tensor(&seed, 1.0, a);
    tensor_symmetric_part(a, s);
    tensor_skew_part(a, w);
    symmetric_to_tensor(s, full);
    tensor_add_scaled(1.0, w, full);
    check_tensor_close(full, a, DBL_EPSILON);
    tensor_deviator(a, d);
    check_close(tensor_trace(d), 0.0, 4 * DBL_EPSILON);
    check_close(tensor_contract(a, w), tensor_contract(w, w), 8 * DBL_EPSILON);
    check_close(tensor_norm(a) * tensor_norm(a), tensor_contract(a, a), 8 * DBL_EPSILON);
    /* Component order: xx yy zz xy yz zx. */
    const double order[9] = {1.0, 4.0, 6.0, 4.0, 2.0, 5.0, 6.0, 5.0, 3.0};
    tensor_symmetric_part(order, s);
    for (int k = 0; k < 6; k++) check_close(s[k], k + 1.0, 0.0);
}

static void symmetric_matches_full(void **state)
{
    (void)state;
    uint64_t seed = 5;
    for (int trial = 0; trial < TRIALS; trial++) {
        double s[6], t[6], d[6], a[9], b[9];
        random_symmetric(&seed, s);
        random_symmetric(&seed, t);
        symmetric_to_tensor(s, a);
        symmetric_to_tensor(t, b);
        check_close(symmetric_trace(s), tensor_trace(a), 0.0);
        check_close(symmetric_det(s), tensor_det(a), 8 * DBL_EPSILON);
        check_close(symmetric_contract(s, t), tensor_contract(a, b), 16 * DBL_EPSILON);
        const double mean = symmetric_deviator(s, d);
        check_close(symmetric_trace(d), 0.0, 4 * DBL_EPSILON);
        check_close(symmetric_contract(d, d) + 3.0 * mean * mean, symmetric_contract(s, s), 20 * DBL_EPSILON);
    }
    const double uniaxial[6] = {-7.0, 0.0, 0.0, 0.0, 0.0, 0.0}, shear[6] = {0.0, 0.0, 0.0, 0.0, 2.0, 0.0};
    check_close(symmetric_von_mises(uniaxial), 7.0, 8 * DBL_EPSILON);
    check_close(symmetric_von_mises(shear), 2.0 * sqrt(3.0), 8 * DBL_EPSILON);
}

static void check_eigen(const double s[6])
{
    double values[3], vectors[9], back[6], product[9], identity[9];
    symmetric_eigen(s, values, vectors);
    symmetric_from_eigen(values, vectors, back);
    const double size = sqrt(symmetric_contract(s, s));
    for (int k = 0; k < 6; k++) check_close(back[k], s[k], 30 * DBL_EPSILON * size);
    check_true(values[0] <= values[1] && values[1] <= values[2]);
    tensor_identity(identity);
    tensor_transposed_multiply(vectors, vectors, product);
    check_tensor_close(product, identity, 30 * DBL_EPSILON);
}

static void eigenvalues_rebuild(void **state)
{
    (void)state;
    uint64_t seed = 6;
    for (int trial = 0; trial < TRIALS; trial++) {
        double s[6];
        random_symmetric(&seed, s);
        check_eigen(s);
        for (int k = 3; k < 6; k++) s[k] *= 1e-12; /* nearly diagonal */
        check_eigen(s);
        for (int k = 0; k < 6; k++) s[k] *= 1e150; /* no overflow on the way */
        check_eigen(s);
    }
    check_eigen((const double[6]){0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
    check_eigen((const double[6]){2.0, 2.0, 2.0, 0.0, 0.0, 0.0});
    check_eigen((const double[6]){1.0, 1.0, 1.0, 1.0, 1.0, 1.0}); /* 0, 0, 3 */
    check_eigen((const double[6]){1.0, 1.0 + 1e-15, 1.0, 1e-15, 1e-16, 0.0});
}

/* A number as the unevaluated sum of two doubles, which is the same on every machine, where long double need not be longer (nor is it under
 * valgrind). Dekker, Numerische Mathematik 18 (1971): round-off of some 2^-104. */
typedef struct pair {
    double high, low;
} pair;

static pair pair_sum(double a, double b)
{
    const double sum = a + b, part = sum - a;
    return (pair){sum, (a - (sum - part)) + (b - part)};
}

/* The product of two doubles, exactly: halves of 26 bits have products without round-off. */
static pair pair_product(double a, double b)
{
    const double splitter = 134217729.0, product = a * b; /* 2^27 + 1 */
    const double a_high = splitter * a - (splitter * a - a), a_low = a - a_high;
    const double b_high = splitter * b - (splitter * b - b), b_low = b - b_high;
    return (pair){product, a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low)};
}

static pair pair_add(pair a, pair b)
{
    const pair high = pair_sum(a.high, b.high), low = pair_sum(a.low, b.low);
    const pair sum = pair_sum(high.high, high.low + low.high);
    return pair_sum(sum.high, sum.low + low.low);
}

static pair pair_multiply(pair a, pair b)
{
    const pair product = pair_product(a.high, b.high);
    return pair_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

static pair pair_divide(pair a, double by)
{
    const double quotient = a.high / by;
    const pair back = pair_product(quotient, by);
    return pair_sum(quotient, ((a.high - back.high) - back.low + a.low) / by);
}

static void pair_matrix_multiply(const pair a[9], const pair b[9], pair ab[9])
{
    for (int k = 0; k < 9; k++) {
        ab[k] = (pair){0.0, 0.0};
        for (int m = 0; m < 3; m++) ab[k] = pair_add(ab[k], pair_multiply(a[k / 3 * 3 + m], b[3 * m + k % 3]));
    }
}

/* exp(a): the plain series, on a scaled argument. */
static void exact_exp(const double a[9], double e[9])
{
    enum { HALVINGS = 6, TERMS = 30 };
    pair x[9], term[9], sum[9], product[9];
    for (int k = 0; k < 9; k++) {
        x[k] = (pair){ldexp(a[k], -HALVINGS), 0.0};
        term[k] = sum[k] = (pair){k % 4 == 0 ? 1.0 : 0.0, 0.0};
    }
    for (int n = 1; n <= TERMS; n++) {
        pair_matrix_multiply(term, x, product);
        for (int k = 0; k < 9; k++) {
            term[k] = pair_divide(product[k], n);
            sum[k] = pair_add(sum[k], term[k]);
        }
    }
    for (int n = 0; n < HALVINGS; n++) {
        pair_matrix_multiply(sum, sum, product);
        memcpy(sum, product, sizeof sum);
    }
    for (int k = 0; k < 9; k++) e[k] = sum[k].high;
}

/* The reference itself, where its digits are known: e = 2.718281828459045 + 1.4456468917292502e-16, and a third is not a double. */
static void pairs_hold_twice_the_digits(void **state)
{
    (void)state;
    const double epsilon = DBL_EPSILON;
    pair sum = {1.0, 0.0}, term = sum;
    for (int n = 1; n <= 30; n++) {
        term = pair_divide(term, n);
        sum = pair_add(sum, term);
    }
    check_close(sum.high, 2.7182818284590452354, 0.0);
    check_close(sum.low, 1.4456468917292502e-16, 16 * epsilon * epsilon);
    const pair third = pair_divide((pair){1.0, 0.0}, 3.0), one = pair_multiply(third, (pair){3.0, 0.0});
    check_close((one.high - 1.0) + one.low, 0.0, 4 * epsilon * epsilon);
}

static void exponential_is_accurate(void **state)
{
    (void)state;
    uint64_t seed = 7;
    for (int trial = 0; trial < TRIALS; trial++) {
        double a[9], minus[9], e[9], inverse[9], product[9], reference[9], identity[9];
        random_tensor(&seed, pow(10.0, check_random(&seed, -6.0, -0.48)), a); /* row norm up to 1 */
        for (int k = 0; k < 9; k++) minus[k] = -a[k];
        tensor_exp(a, e);
        exact_exp(a, reference);
        check_tensor_close(e, reference, 8 * DBL_EPSILON);
        check_close_relative(tensor_det(e), exp(tensor_trace(a)), 16 * DBL_EPSILON);
        tensor_exp(minus, inverse);
        tensor_multiply(e, inverse, product);
        tensor_identity(identity);
        check_tensor_close(product, identity, 16 * DBL_EPSILON);
    }
}

static void exponential_scales_and_squares(void **state)
{
    (void)state;
    uint64_t seed = 8;
    for (int trial = 0; trial < TRIALS; trial++) {
        double a[9], e[9], reference[9];
        random_tensor(&seed, 3.0, a);
        tensor_exp(a, e);
        exact_exp(a, reference);
        const double size = tensor_norm(reference);
        check_tensor_close(e, reference, 100 * DBL_EPSILON * size * tensor_row_norm(a));
    }
    /* A quarter turn about z, and a nilpotent shear. */
    const double turn[9] = {0.0, -acos(0.0), 0.0, acos(0.0), 0.0, 0.0, 0.0, 0.0, 0.0};
    const double turned[9] = {0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0};
    const double shear[9] = {0.0, 50.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    double e[9];
    tensor_exp(turn, e);
    check_tensor_close(e, turned, 8 * DBL_EPSILON);
    tensor_exp(shear, e);
    check_close(e[1], 50.0, 0.0);
    check_close(tensor_det(e), 1.0, 0.0);
}

static void exponential_keeps_small_motion(void **state)
{
    (void)state;
    const double a[9] = {1e-20, 2e-20, 0.0, 0.0, -1e-20, 3e-20, 0.0, 0.0, 5e-20};
    double e[9];
    tensor_exp_minus_identity(a, e);
    for (int k = 0; k < 9; k++) check_close(e[k], a[k], 1e-36);
}

static void exponential_of_bad_input_is_nan(void **state)
{
    (void)state;
    double a[9] = {0.0}, e[9];
    a[4] = (double)INFINITY;
    tensor_exp(a, e);
    check_true(isnan(e[0]));
    a[4] = 0.0;
    for (int k = 0; k < 9; k++) {
        a[k] = (double)NAN;
        check_true(isnan(tensor_row_norm(a)));
        tensor_exp(a, e);
        check_true(isnan(e[0]));
        a[k] = 0.0;
    }
    a[4] = -1e9; /* large, yet its exponential is a number */
    tensor_exp(a, e);
    check_close(e[4], 0.0, DBL_EPSILON);
}

static void polar_decomposition(void **state)
{
    (void)state;
    uint64_t seed = 9;
    double identity[9];
    tensor_identity(identity);
    for (int trial = 0; trial < TRIALS; trial++) {
        double f[9], r[9], u[6], full[9], product[9], values[3], vectors[9];
        random_tensor(&seed, 1.0, f);
        if (tensor_det(f) < 0.0) {
            check_true(!tensor_polar(f, r, u));
            for (int k = 0; k < 9; k++) f[k] = -f[k];
        }
        if (tensor_det(f) < 1e-3) continue;
        check_true(tensor_polar(f, r, u));
        tensor_transposed_multiply(r, r, product);
        check_tensor_close(product, identity, 50 * DBL_EPSILON);
        check_close(tensor_det(r), 1.0, 50 * DBL_EPSILON);
        symmetric_to_tensor(u, full);
        tensor_multiply(r, full, product);
        check_tensor_close(product, f, 200 * DBL_EPSILON);
        symmetric_eigen(u, values, vectors);
        check_true(values[0] > 0.0);
    }
    const double singular[9] = {0.0}, bad[9] = {(double)NAN, 0, 0, 0, 1, 0, 0, 0, 1};
    double r[9], u[6];
    check_true(!tensor_polar(singular, r, u));
    check_true(!tensor_polar(bad, r, u));
    check_true(tensor_polar(identity, r, u));
    check_tensor_close(r, identity, 0.0);
}

static void congruence_rotates(void **state)
{
    (void)state;
    uint64_t seed = 10;
    double s[6], back[6], spin[9] = {0.0, -0.3, 0.2, 0.3, 0.0, -0.7, -0.2, 0.7, 0.0}, r[9], t[9];
    random_symmetric(&seed, s);
    tensor_exp(spin, r);
    tensor_transpose(r, t);
    symmetric_congruence(r, s, back);
    check_close(symmetric_trace(back), symmetric_trace(s), 8 * DBL_EPSILON);
    symmetric_congruence(t, back, back); /* in place */
    for (int k = 0; k < 6; k++) check_close(back[k], s[k], 16 * DBL_EPSILON);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vectors),
        cmocka_unit_test(products_by_definition),
        cmocka_unit_test(determinant_and_inverse),
        cmocka_unit_test(parts_add_up),
        cmocka_unit_test(symmetric_matches_full),
        cmocka_unit_test(eigenvalues_rebuild),
        cmocka_unit_test(pairs_hold_twice_the_digits),
        cmocka_unit_test(exponential_is_accurate),
        cmocka_unit_test(exponential_scales_and_squares),
        cmocka_unit_test(exponential_keeps_small_motion),
        cmocka_unit_test(exponential_of_bad_input_is_nan),
        cmocka_unit_test(polar_decomposition),
        cmocka_unit_test(congruence_rotates),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
