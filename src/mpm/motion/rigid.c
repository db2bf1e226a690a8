/* Kinematics of rigid bodies (theory 4.17). */
#include "mpm/motion/motion.h"

#include "math/small_solve.h"

#include <math.h>
#include <string.h>

/* Angle (rad) of a part of a free turn: classical Runge-Kutta is off by 1e-14 of the energy in a radian. */
static const double part_of_turn = 1e-3;

void rigid_velocity(const rigid_field *f, const double x[3], double out[3])
{
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        out[a] = f->v[a] + f->w[b] * (x[c] - f->c[c]) - f->w[c] * (x[b] - f->c[b]);
    }
}

static const int inertia_at[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

void rigid_spin(const double inertia[6], const bool turns[3], const double momentum[3], double w[3])
{
    double A[9] = {0.0}, b[3] = {0.0};
    int axis[3], n = 0;
    memset(w, 0, 3 * sizeof *w);
    for (int a = 0; a < 3; ++a)
        if (turns[a]) axis[n++] = a;
    for (int i = 0; i < n; ++i) {
        b[i] = momentum[axis[i]];
        for (int j = 0; j < n; ++j) A[n * i + j] = inertia[inertia_at[axis[i]][axis[j]]];
    }
    if (n == 0 || !small_solve_symmetric(n, A, b)) return; /* points on a line do not resist a turn about it */
    for (int i = 0; i < n; ++i) w[axis[i]] = b[i];
}

/* The rotation of a unit quaternion. */
static void rotation_of(const double q[4], double R[9])
{
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double value[9] = {1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z),       2.0 * (x * z + w * y),
                             2.0 * (x * y + w * z),       1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x),
                             2.0 * (x * z - w * y),       2.0 * (y * z + w * x),       1.0 - 2.0 * (x * x + y * y)};
    memcpy(R, value, sizeof value);
}

void rigid_rotation(const double axis[3], double angle, double turn[9])
{
    const double s = sin(0.5 * angle);
    rotation_of((const double[]){cos(0.5 * angle), s * axis[0], s * axis[1], s * axis[2]}, turn);
}

/* R A R^T of a symmetric A. */
void rigid_turn_inertia(const double turn[9], const double inertia[6], double out[6])
{
    static const int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
    for (int e = 0; e < 6; ++e) {
        out[e] = 0.0;
        for (int k = 0; k < 3; ++k)
            for (int l = 0; l < 3; ++l)
                out[e] += turn[3 * pair[e][0] + k] * inertia[inertia_at[k][l]] * turn[3 * pair[e][1] + l];
    }
}

/* What a free turn is solved with. */
typedef struct free_turn {
    const double *inertia, *momentum;
    const bool *turns;
} free_turn;

/* dq/dt = w q / 2, w in space: w = R I^-1 R^T L. */
static void turn_rate(const free_turn *t, const double q[4], double rate[4])
{
    double R[9], body[3], slow[3], w[3];
    rotation_of(q, R);
    for (int a = 0; a < 3; ++a) body[a] = R[a] * t->momentum[0] + R[3 + a] * t->momentum[1] + R[6 + a] * t->momentum[2];
    rigid_spin(t->inertia, t->turns, body, slow);
    for (int a = 0; a < 3; ++a) w[a] = R[3 * a] * slow[0] + R[3 * a + 1] * slow[1] + R[3 * a + 2] * slow[2];
    rate[0] = -0.5 * (w[0] * q[1] + w[1] * q[2] + w[2] * q[3]);
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        rate[1 + a] = 0.5 * (w[a] * q[0] + w[b] * q[1 + c] - w[c] * q[1 + b]);
    }
}

static void take_part(const free_turn *t, double dt, double q[4])
{
    static const double weight[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0}, ahead[4] = {0.0, 0.5, 0.5, 1.0};
    double sum[4] = {0.0}, rate[4] = {0.0}, length = 0.0;
    for (int k = 0; k < 4; ++k) {
        double at[4];
        for (int i = 0; i < 4; ++i) at[i] = q[i] + ahead[k] * dt * rate[i];
        turn_rate(t, at, rate);
        for (int i = 0; i < 4; ++i) sum[i] += weight[k] * rate[i];
    }
    for (int i = 0; i < 4; ++i) {
        q[i] += dt * sum[i];
        length += q[i] * q[i];
    }
    for (int i = 0; i < 4; ++i) q[i] /= sqrt(length);
}

void rigid_free_turn(const double inertia[6], const double spin_momentum[3], const bool turns[3], double dt,
                     double turn[9])
{
    const free_turn t = {inertia, spin_momentum, turns};
    double w[3], q[4] = {1.0, 0.0, 0.0, 0.0};
    rigid_spin(inertia, turns, spin_momentum, w);
    const double rate = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    if (!(turns[0] && turns[1] && turns[2])) { /* about one axis, if any */
        const double axis[3] = {turns[0] ? 1.0 : 0.0, turns[1] ? 1.0 : 0.0, turns[2] ? 1.0 : 0.0};
        rigid_rotation(axis, dt * (w[0] + w[1] + w[2]), turn);
        return;
    }
    const int parts = (int)ceil(fmax(1.0, fmin(1e6, rate * dt / part_of_turn)));
    for (int k = 0; k < parts; ++k) take_part(&t, dt / parts, q);
    rotation_of(q, turn);
}
