/* Small tensors as plain arrays, in three dimensions.
 *
 *   vector     double[3]   x y z
 *   tensor     double[9]   row-major: xx xy xz yx yy yz zx zy zz, so that a[3*i+j] is row i, column j
 *   symmetric  double[6]   xx yy zz xy yz zx: each off-diagonal component once, as it is (no factor 2)
 *
 * Results come last. Unless said otherwise a result must not share storage with an argument. Products are written out
 * with constant indices so that, inlined into a loop over points, they become scalars and the loop vectorizes.
 * All functions are pure: no state, no allocation, no failure but the one in a return value. */
#ifndef MATH_TENSOR_H
#define MATH_TENSOR_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

/* ---- vectors ---- */

static inline double vec_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double vec_norm(const double a[3])
{
    return sqrt(vec_dot(a, a));
}

/* |a - b|^2. */
static inline double vec_distance2(const double a[3], const double b[3])
{
    const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return vec_dot(d, d);
}

static inline void vec_cross(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

/* n = (b - a) x (c - a): the normal of a triangle, as long as twice its area. */
static inline void triangle_normal(const double a[3], const double b[3], const double c[3], double n[3])
{
    const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    vec_cross(u, v, n);
}

/* y += factor * x. */
static inline void vec_add_scaled(double factor, const double x[3], double y[3])
{
    for (int i = 0; i < 3; i++) y[i] += factor * x[i];
}

/* Scales a to length 1 and returns its former length; a vector of length 0 stays as it is. */
static inline double vec_normalize(double a[3])
{
    const double length = vec_norm(a);
    if (length > 0.0) {
        for (int i = 0; i < 3; i++) a[i] /= length;
    }
    return length;
}

/* ---- full tensors ---- */

static inline void tensor_identity(double a[9])
{
    for (int k = 0; k < 9; k++) a[k] = k % 4 == 0 ? 1.0 : 0.0;
}

static inline void tensor_copy(const double a[9], double b[9])
{
    for (int k = 0; k < 9; k++) b[k] = a[k];
}

/* b += factor * a. */
static inline void tensor_add_scaled(double factor, const double a[9], double b[9])
{
    for (int k = 0; k < 9; k++) b[k] += factor * a[k];
}

static inline void tensor_transpose(const double a[9], double t[9])
{
    t[0] = a[0], t[1] = a[3], t[2] = a[6];
    t[3] = a[1], t[4] = a[4], t[5] = a[7];
    t[6] = a[2], t[7] = a[5], t[8] = a[8];
}

/* y = a x. */
static inline void tensor_apply(const double a[9], const double x[3], double y[3])
{
    y[0] = a[0] * x[0] + a[1] * x[1] + a[2] * x[2];
    y[1] = a[3] * x[0] + a[4] * x[1] + a[5] * x[2];
    y[2] = a[6] * x[0] + a[7] * x[1] + a[8] * x[2];
}

/* c = a b. */
static inline void tensor_multiply(const double a[9], const double b[9], double c[9])
{
    c[0] = a[0] * b[0] + a[1] * b[3] + a[2] * b[6];
    c[1] = a[0] * b[1] + a[1] * b[4] + a[2] * b[7];
    c[2] = a[0] * b[2] + a[1] * b[5] + a[2] * b[8];
    c[3] = a[3] * b[0] + a[4] * b[3] + a[5] * b[6];
    c[4] = a[3] * b[1] + a[4] * b[4] + a[5] * b[7];
    c[5] = a[3] * b[2] + a[4] * b[5] + a[5] * b[8];
    c[6] = a[6] * b[0] + a[7] * b[3] + a[8] * b[6];
    c[7] = a[6] * b[1] + a[7] * b[4] + a[8] * b[7];
    c[8] = a[6] * b[2] + a[7] * b[5] + a[8] * b[8];
}

/* c = a^T b. */
static inline void tensor_transposed_multiply(const double a[9], const double b[9], double c[9])
{
    double t[9];
    tensor_transpose(a, t);
    tensor_multiply(t, b, c);
}

/* c = a b^T. */
static inline void tensor_multiply_transposed(const double a[9], const double b[9], double c[9])
{
    double t[9];
    tensor_transpose(b, t);
    tensor_multiply(a, t, c);
}

static inline double tensor_trace(const double a[9])
{
    return a[0] + a[4] + a[8];
}

static inline double tensor_det(const double a[9])
{
    return a[0] * (a[4] * a[8] - a[5] * a[7]) + a[1] * (a[5] * a[6] - a[3] * a[8]) + a[2] * (a[3] * a[7] - a[4] * a[6]);
}

/* The second invariant: the sum of the principal 2x2 minors. */
static inline double tensor_second_invariant(const double a[9])
{
    return a[0] * a[4] - a[1] * a[3] + a[4] * a[8] - a[5] * a[7] + a[8] * a[0] - a[6] * a[2];
}

/* a : b, the sum of products of like components. */
static inline double tensor_contract(const double a[9], const double b[9])
{
    double sum = 0.0;
    for (int k = 0; k < 9; k++) sum += a[k] * b[k];
    return sum;
}

/* Frobenius norm. */
static inline double tensor_norm(const double a[9])
{
    return sqrt(tensor_contract(a, a));
}

/* b = a^-1 by cofactors; returns det a. Where that is 0 (or NaN), b is not finite: the caller looks at the return
 * value. */
static inline double tensor_inverse(const double a[9], double b[9])
{
    const double det = tensor_det(a);
    const double scale = 1.0 / det;
    b[0] = scale * (a[4] * a[8] - a[5] * a[7]);
    b[1] = scale * (a[2] * a[7] - a[1] * a[8]);
    b[2] = scale * (a[1] * a[5] - a[2] * a[4]);
    b[3] = scale * (a[5] * a[6] - a[3] * a[8]);
    b[4] = scale * (a[0] * a[8] - a[2] * a[6]);
    b[5] = scale * (a[2] * a[3] - a[0] * a[5]);
    b[6] = scale * (a[3] * a[7] - a[4] * a[6]);
    b[7] = scale * (a[1] * a[6] - a[0] * a[7]);
    b[8] = scale * (a[0] * a[4] - a[1] * a[3]);
    return det;
}

/* d = a - (tr a / 3) I. d may be a. */
static inline void tensor_deviator(const double a[9], double d[9])
{
    const double mean = tensor_trace(a) / 3.0;
    for (int k = 0; k < 9; k++) d[k] = k % 4 == 0 ? a[k] - mean : a[k];
}

/* s = (a + a^T) / 2: the stretch rate of a velocity gradient. */
static inline void tensor_symmetric_part(const double a[9], double s[6])
{
    s[0] = a[0], s[1] = a[4], s[2] = a[8];
    s[3] = 0.5 * (a[1] + a[3]);
    s[4] = 0.5 * (a[5] + a[7]);
    s[5] = 0.5 * (a[6] + a[2]);
}

/* w = (a - a^T) / 2: the spin of a velocity gradient. */
static inline void tensor_skew_part(const double a[9], double w[9])
{
    double t[9];
    tensor_transpose(a, t);
    for (int k = 0; k < 9; k++) w[k] = 0.5 * (a[k] - t[k]);
}

/* ---- symmetric tensors ---- */

static inline void symmetric_to_tensor(const double s[6], double a[9])
{
    a[0] = s[0], a[1] = s[3], a[2] = s[5];
    a[3] = s[3], a[4] = s[1], a[5] = s[4];
    a[6] = s[5], a[7] = s[4], a[8] = s[2];
}

static inline double symmetric_trace(const double s[6])
{
    return s[0] + s[1] + s[2];
}

static inline double symmetric_det(const double s[6])
{
    return s[0] * (s[1] * s[2] - s[4] * s[4]) + s[3] * (s[4] * s[5] - s[3] * s[2]) + s[5] * (s[3] * s[4] - s[1] * s[5]);
}

/* a : b; off-diagonal components count twice. */
static inline double symmetric_contract(const double a[6], const double b[6])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

/* d = s - (tr s / 3) I; returns the mean tr s / 3. d may be s. */
static inline double symmetric_deviator(const double s[6], double d[6])
{
    const double mean = symmetric_trace(s) / 3.0;
    for (int k = 0; k < 6; k++) d[k] = k < 3 ? s[k] - mean : s[k];
    return mean;
}

/* Equivalent (von Mises) stress sqrt(3/2 s' : s'). */
static inline double symmetric_von_mises(const double s[6])
{
    double d[6];
    symmetric_deviator(s, d);
    return sqrt(1.5 * symmetric_contract(d, d));
}

/* r = a s a^T: a symmetric tensor pushed forward, or rotated. r may be s. */
static inline void symmetric_congruence(const double a[9], const double s[6], double r[6])
{
    double full[9], left[9], both[9];
    symmetric_to_tensor(s, full);
    tensor_multiply(a, full, left);
    tensor_multiply_transposed(left, a, both);
    tensor_symmetric_part(both, r);
}

/* One Jacobi rotation in the (p, q) plane: a becomes R^T a R with a[p][q] = 0, v becomes v R.
 * Golub and Van Loan, Matrix Computations, 4th ed., section 8.5.2 (the smaller of the two angles). */
static inline void jacobi_rotate_(double a[9], double v[9], int p, int q)
{
    const double apq = a[3 * p + q];
    if (apq == 0.0) return;
    const double tau = (a[3 * q + q] - a[3 * p + p]) / (2.0 * apq);
    const double t = (tau >= 0.0 ? 1.0 : -1.0) / (fabs(tau) + hypot(1.0, tau));
    const double c = 1.0 / sqrt(1.0 + t * t);
    const double s = t * c;
    const int r = 3 - p - q;
    const double arp = a[3 * r + p], arq = a[3 * r + q];
    a[3 * p + p] -= t * apq;
    a[3 * q + q] += t * apq;
    a[3 * p + q] = a[3 * q + p] = 0.0;
    a[3 * r + p] = a[3 * p + r] = c * arp - s * arq;
    a[3 * r + q] = a[3 * q + r] = s * arp + c * arq;
    for (int i = 0; i < 3; i++) {
        const double vip = v[3 * i + p], viq = v[3 * i + q];
        v[3 * i + p] = c * vip - s * viq;
        v[3 * i + q] = s * vip + c * viq;
    }
}

/* Exchanges eigenvalues p and q and the columns p and q of v where they are out of order. */
static inline void eigen_order_(double values[3], double v[9], int p, int q)
{
    if (!(values[p] > values[q])) return;
    const double value = values[p];
    values[p] = values[q];
    values[q] = value;
    for (int i = 0; i < 3; i++) {
        const double component = v[3 * i + p];
        v[3 * i + p] = v[3 * i + q];
        v[3 * i + q] = component;
    }
}

/* Eigenvalues in ascending order, and orthonormal eigenvectors as the columns of `vectors` (vector k has components
 * vectors[3*i+k]), by cyclic Jacobi rotations: accurate to round-off of the largest eigenvalue, repeated ones included
 * (closed forms by acos lose half the digits there). Components that are not finite give results that are not. */
static inline void symmetric_eigen(const double s[6], double values[3], double vectors[9])
{
    enum { SWEEPS = 12 }; /* convergence is quadratic: 5 or 6 are enough */
    double a[9];
    symmetric_to_tensor(s, a);
    tensor_identity(vectors);
    for (int sweep = 0; sweep < SWEEPS && (a[1] != 0.0 || a[2] != 0.0 || a[5] != 0.0); sweep++) {
        jacobi_rotate_(a, vectors, 0, 1);
        jacobi_rotate_(a, vectors, 0, 2);
        jacobi_rotate_(a, vectors, 1, 2);
    }
    for (int k = 0; k < 3; k++) values[k] = a[4 * k];
    eigen_order_(values, vectors, 0, 1);
    eigen_order_(values, vectors, 1, 2);
    eigen_order_(values, vectors, 0, 1);
}

/* s = V diag(values) V^T: the inverse of symmetric_eigen; with f(values) in place of values, the tensor function
 * f(s). */
static inline void symmetric_from_eigen(const double values[3], const double vectors[9], double s[6])
{
    static const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
    for (int k = 0; k < 6; k++) {
        s[k] = 0.0;
        for (int e = 0; e < 3; e++) s[k] += values[e] * vectors[3 * row[k] + e] * vectors[3 * column[k] + e];
    }
}

/* ---- exponential and polar decomposition ---- */

/* The largest absolute row sum; NaN if a component is. */
static inline double tensor_row_norm(const double a[9])
{
    double norm = 0.0;
    for (int i = 0; i < 3; i++) {
        const double sum = fabs(a[3 * i]) + fabs(a[3 * i + 1]) + fabs(a[3 * i + 2]);
        if (!(sum <= norm) && !isnan(norm)) norm = sum;
    }
    return norm;
}

/* e = exp(a) - I for a row norm up to 1, to round-off of its own size: a small motion keeps all its digits. The Taylor
 * series, to the degree at which the next term is below round-off (1/19! for norm 1), every power reduced to a^2, a and
 * I by Cayley-Hamilton, a^3 = I1 a^2 - I2 a + I3, so that a term costs a few scalar operations and no product. Beyond
 * norm 1 that reduction would cancel (Moler and Van Loan, SIAM Review 45, 2003, method 8). */
static inline void tensor_exp_minus_identity(const double a[9], double e[9])
{
    static const double inverse[19] = {0,        1.0,      1.0 / 2,  1.0 / 3,  1.0 / 4,  1.0 / 5,  1.0 / 6,
                                       1.0 / 7,  1.0 / 8,  1.0 / 9,  1.0 / 10, 1.0 / 11, 1.0 / 12, 1.0 / 13,
                                       1.0 / 14, 1.0 / 15, 1.0 / 16, 1.0 / 17, 1.0 / 18};
    const double norm = tensor_row_norm(a);
    const int degree = norm <= 1e-2 ? 7 : norm <= 1e-1 ? 10 : 18;
    const double i1 = tensor_trace(a), i2 = tensor_second_invariant(a), i3 = tensor_det(a);
    /* a^k / k! = c2 a^2 + c1 a + c0 I; sums of each over k. The terms a and a^2/2 are added last. */
    double c2 = 0.5, c1 = 0.0, c0 = 0.0;
    double sum2 = 0.0, sum1 = 0.0, sum0 = 0.0;
    for (int k = 3; k <= degree; k++) {
        const double next2 = (i1 * c2 + c1) * inverse[k], next1 = (c0 - i2 * c2) * inverse[k];
        const double next0 = i3 * c2 * inverse[k];
        c2 = next2, c1 = next1, c0 = next0;
        sum2 += c2, sum1 += c1, sum0 += c0;
    }
    double square[9];
    tensor_multiply(a, a, square);
    for (int k = 0; k < 9; k++) e[k] = (0.5 + sum2) * square[k] + (sum1 * a[k] + (k % 4 == 0 ? sum0 : 0.0)) + a[k];
}

/* e = exp(a), by scaling and squaring: to round-off up to norm 1, and about `norm` times that beyond.
 * What is not finite, or beyond any squaring, gives NaN. */
static inline void tensor_exp(const double a[9], double e[9])
{
    const double norm = tensor_row_norm(a);
    double x[9], square[9];
    int squarings = 0;
    if (!(norm < 1e15)) {
        for (int k = 0; k < 9; k++) e[k] = (double)NAN;
        return;
    }
    if (norm > 1.0) (void)frexp(norm, &squarings);
    const double scale = norm > 1.0 ? ldexp(1.0, -squarings) : 1.0;
    for (int k = 0; k < 9; k++) x[k] = scale * a[k];
    tensor_exp_minus_identity(x, e);
    /* (I + e)^2 = I + (2 e + e^2): I is added once, at the end, and e keeps the digits of what differs from it. */
    for (int n = 0; n < squarings; n++) {
        tensor_multiply(e, e, square);
        for (int k = 0; k < 9; k++) e[k] = 2.0 * e[k] + square[k];
    }
    for (int k = 0; k < 9; k += 4) e[k] += 1.0;
}

/* f = r u with r a rotation and u symmetric positive (xx yy zz xy yz zx), by Newton's iteration
 * r <- (g r + r^-T / g) / 2 with Higham's scaling g (SIAM J. Sci. Stat. Comput. 7, 1986). False, with nothing useful in
 * r and u, unless det f > 0. */
static inline bool tensor_polar(const double f[9], double r[9], double u[6])
{
    enum { ITERATIONS = 30 };
    const double det = tensor_det(f);
    if (!(det > 0.0) || !isfinite(det)) return false;
    tensor_copy(f, r);
    double change = 1.0;
    for (int n = 0; n < ITERATIONS && change > 1e-15; n++) {
        double inverse[9], transposed[9];
        if (!(tensor_inverse(r, inverse) > 0.0)) return false;
        tensor_transpose(inverse, transposed);
        /* Near the end the scale is 1 to round-off and only adds noise. */
        const double g = change > 1e-2 ? sqrt(tensor_norm(inverse) / tensor_norm(r)) : 1.0;
        change = 0.0;
        for (int k = 0; k < 9; k++) {
            const double next = 0.5 * (g * r[k] + transposed[k] / g);
            change = fmax(change, fabs(next - r[k]));
            r[k] = next;
        }
        if (change < 1e-8) change = 0.0; /* quadratic: the step just made was the last that matters */
    }
    double product[9];
    tensor_transposed_multiply(r, f, product);
    tensor_symmetric_part(product, u);
    return change == 0.0;
}

#endif
