/* The step of bodies that do not deform (motion.h). */
#include "mpm/motion/motion.h"
#include "mpm/motion/motion_springs.h"
#include "mpm/motion/motion_ties.h"

#include "base/memory.h"
#include "math/tensor.h"

#include <math.h>
#include <string.h>

/* ---- which bodies ---- */

floe_status motions_create(mpm *s)
{
    if (s->n_bodies == s->n_deforming) return FLOE_OK;
    TRY(memory_new(s->ctx, &s->motions, 1, sizeof *s->motions));
    for (int b = s->n_deforming; b < s->n_bodies; ++b) {
        body_motion *m = &s->motions->body[s->motions->n++];
        m->given = &s->scene->body[s->body[b].scene_body].motion;
        m->body = b;
        for (int a = 0; a < 3; ++a) {
            m->slides[a] = a < s->mesh->dim && !(s->mesh->geometry == MESH_AXISYMMETRIC && a == 0);
            m->turns[a] =
                s->mesh->geometry != MESH_AXISYMMETRIC && (s->mesh->dim == 3 || (s->mesh->dim == 2 && a == 2));
        }
    }
    return FLOE_OK;
}

void motions_free(mpm *s)
{
    memory_free(s->ctx, &s->motions);
}

/* Whether the body has points in the cells along a side. */
static bool reaches_side(const mpm *s, int body, int axis, int side)
{
    const int along = side == SIDE_LOWER ? 0 : s->mesh->n[axis] - 1;
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        const double *x = field_get(s->domain->fields[b], P_POS, body, axis);
        for (size_t k = 0; k < s->points[b][body].n; ++k)
            if (mesh_cell_of(s->mesh, axis, x[k]) == along) return true;
    }
    return false;
}

/* A free body starts with its spin about the centre of mass, which its points tell. */
static void set_turning(mpm *s, body_motion *m)
{
    rigid_field f = {.c = {0.0}};
    const double *w = m->given->turning;
    if (w[0] == 0.0 && w[1] == 0.0 && w[2] == 0.0) return;
    rigid_sum_points(s, m->body, &m->sums);
    for (int a = 0; a < 3; ++a) {
        f.c[a] = m->sums.centre[a];
        f.v[a] = m->slides[a] ? s->scene->body[s->body[m->body].scene_body].velocity[a] : 0.0;
        f.w[a] = m->turns[a] ? w[a] : 0.0;
    }
    rigid_set_points(s, m->body, &f);
}

/* The image of a body that a mirror cuts moves as the body does: along the mirror, and about the normal to it. */
void motions_start(mpm *s)
{
    for (int i = 0; s->motions && i < s->motions->n; ++i) {
        body_motion *m = &s->motions->body[i];
        for (int a = 0; a < s->mesh->dim; ++a)
            for (int side = 0; side < 2; ++side) {
                if (s->scene->bc.side[a][side].kind != BC_SYMMETRY || !reaches_side(s, m->body, a, side)) continue;
                m->slides[a] = false;
                m->turns[(a + 1) % 3] = m->turns[(a + 2) % 3] = false;
            }
        if (m->given->kind == MOTION_RIGID) set_turning(s, m);
    }
}

/* A whole body falls, not its points; and one with a prescribed motion does not. */
void motions_take_body_forces(mpm *s)
{
    for (int i = 0; s->motions && i < s->motions->n; ++i) {
        body_motion *m = &s->motions->body[i];
        for (int a = 0; a < 3; ++a) {
            const bool falls = !motion_is_prescribed(m->given) && a < s->mesh->dim;
            m->acceleration[a] = falls ? s->acceleration[m->body][a] : 0.0;
            s->acceleration[m->body][a] = 0.0;
        }
    }
}

void motion_take_field(mpm *s, int body, const double force[3], const double moment[3])
{
    body_motion *m = &s->motions->body[body - s->n_deforming];
    const bool moves = !motion_is_prescribed(m->given);
    for (int a = 0; a < 3; ++a) {
        m->field_force[a] = moves ? force[a] : 0.0;
        m->field_moment[a] = moves ? moment[a] : 0.0;
    }
}

/* ---- the step ---- */

/* Moment about the body's centre of mass of forces that change with place. */
static void field_moment_about_centre(const body_motion *m, double moment[3])
{
    vec_cross(m->field_force, m->sums.centre, moment);
    for (int a = 0; a < 3; ++a) moment[a] += m->field_moment[a];
}

/* Forces beside cells are those of the start of the step, and act half before and half after it (second order); those
 * of points alone act in between two half steps, and those of an implicit pressure before the motion that they go with (theory 7.8). */
static double share_before(const mpm *s)
{
    return s->cells == CELLS_NONE || s->forces_at_end ? 1.0 : 0.5;
}

static void start_prescribed(const mpm *s, body_motion *m)
{
    double travelled[3], axis[3], angle, spin;
    const double t = s->time;
    motion_rates(m->given, t, m->now.v, &spin);
    motion_axis(m->given, axis);
    motion_travel(m->given, 0.0, t, travelled, &angle);
    for (int a = 0; a < 3; ++a) {
        const double about = m->given->about[a];
        m->now.c[a] = isnan(about) ? m->sums.centre[a] : about + travelled[a];
        m->now.w[a] = spin * axis[a];
    }
    m->next = m->end = m->now;
    motion_travel(m->given, t, t + s->dt, travelled, &angle);
    motion_rates(m->given, t + s->dt, m->end.v, &spin);
    rigid_rotation(axis, angle, m->turn);
    for (int a = 0; a < 3; ++a) {
        m->next.v[a] = travelled[a] / s->dt;
        m->next.w[a] = angle / s->dt * axis[a];
        m->end.c[a] = m->now.c[a] + travelled[a];
        m->end.w[a] = spin * axis[a];
    }
}

static void start_free(const mpm *s, body_motion *m)
{
    for (int a = 0; a < 3; ++a) {
        m->now.c[a] = m->sums.centre[a];
        m->now.v[a] = m->slides[a] && m->sums.mass > 0.0 ? m->sums.momentum[a] / m->sums.mass : 0.0;
        m->impulse[a] = (m->sums.mass * m->acceleration[a] + m->field_force[a]) * s->kick;
    }
    field_moment_about_centre(m, m->moment);
    for (int a = 0; a < 3; ++a) m->moment[a] *= s->kick;
    rigid_spin(m->sums.inertia, m->turns, m->sums.spin, m->now.w);
    rigid_free_turn(m->sums.inertia, m->sums.spin, m->turns, s->dt, m->coast);
}

/* Velocity and moment of momentum after a share of what others have given. */
static void kick_body(const body_motion *m, double share, rigid_field *f, double momentum[3])
{
    for (int a = 0; a < 3; ++a) {
        const double impulse = m->impulse[a] + m->loads[a], moment = m->moment[a] + m->load_moment[a];
        f->v[a] = m->now.v[a] + (m->slides[a] && m->sums.mass > 0.0 ? share * impulse / m->sums.mass : 0.0);
        momentum[a] = m->sums.spin[a] + share * moment;
    }
}

/* The whole step of a free body, with what others have given so far: kick, free motion, kick (theory 4.17). */
static void solve_free(const mpm *s, body_motion *m)
{
    const double share = share_before(s);
    rigid_field half = m->now;
    double momentum[3], inertia[6], first[3], last[3];
    kick_body(m, 1.0, &m->next, momentum);
    memcpy(m->next.c, m->now.c, sizeof m->now.c);
    rigid_spin(m->sums.inertia, m->turns, momentum, m->next.w);
    kick_body(m, share, &half, momentum);
    rigid_spin(m->sums.inertia, m->turns, momentum, first);
    rigid_free_turn(m->sums.inertia, momentum, m->turns, s->dt, m->turn);
    rigid_turn_inertia(m->turn, m->sums.inertia, inertia);
    rigid_spin(inertia, m->turns, momentum, last);
    for (int a = 0; a < 3; ++a) m->end.c[a] = m->now.c[a] + s->dt * half.v[a];
    kick_body(m, 1.0, &m->end, momentum);
    rigid_spin(inertia, m->turns, momentum, m->end.w);
    for (int a = 0; a < 3; ++a) {
        m->working[0][a] = 0.5 * (m->now.v[a] + m->end.v[a]);
        m->working[1][a] = 0.5 * (share * (m->now.w[a] + first[a]) + (1.0 - share) * (last[a] + m->end.w[a]));
    }
}

static void clear_loads(body_motion *m)
{
    memset(m->loads, 0, sizeof m->loads);
    memset(m->load_moment, 0, sizeof m->load_moment);
    m->load_work = 0.0;
}

/* Where each body is, and how it would move without the others. */
floe_status mpm_begin_motions(mpm *s)
{
    for (int i = 0; i < s->motions->n; ++i) {
        body_motion *m = &s->motions->body[i];
        rigid_sum_points(s, m->body, &m->sums);
        memset(m->impulse, 0, sizeof m->impulse);
        memset(m->moment, 0, sizeof m->moment);
        memset(m->contact, 0, sizeof m->contact);
        memset(m->contact_moment, 0, sizeof m->contact_moment);
        m->work = m->contact_work = 0.0;
        clear_loads(m);
        if (motion_is_prescribed(m->given)) {
            start_prescribed(s, m);
        } else {
            start_free(s, m);
            solve_free(s, m);
        }
    }
    return FLOE_OK;
}

floe_status mpm_motion_momenta(mpm *s)
{
    motions_impose(s, N_MOMENTUM, true);
    return FLOE_OK;
}

void motion_clear_loads(mpm *s, int group)
{
    if (motion_of_group(s, group)) clear_loads(motion_of_group(s, group));
}

static void add_turn(const double r[3], const double impulse[3], double moment[3])
{
    double turn[3];
    vec_cross(r, impulse, turn);
    vec_add_scaled(1.0, turn, moment);
}

void rigid_add_moment(const body_motion *m, const double x[3], const double impulse[3], double moment[3])
{
    const double r[3] = {x[0] - m->now.c[0], x[1] - m->now.c[1], x[2] - m->now.c[2]};
    add_turn(r, impulse, moment);
}

void motion_load(const mpm *s, body_motion *m, const double x[3], const double force[3])
{
    double impulse[3], next[3], velocity[3], path[3];
    for (int a = 0; a < 3; ++a) {
        impulse[a] = s->kick * force[a];
        m->loads[a] += impulse[a];
    }
    rigid_add_moment(m, x, impulse, m->load_moment);
    motion_of_place(s, m, x, next, velocity, path);
    for (int a = 0; a < 3; ++a) m->load_work += force[a] * path[a];
}

/* The centre moves on with its velocity, and the body turns on. */
static void foresee_turn(const mpm *s, const body_motion *m, double centre[3], double turn[9])
{
    const double ahead = (1.0 - share_before(s)) * s->dt;
    for (int a = 0; a < 3; ++a) centre[a] = m->now.c[a] + ahead * m->now.v[a];
    if (motion_is_prescribed(m->given)) {
        double axis[3], angle;
        motion_axis(m->given, axis);
        motion_travel(m->given, s->time, s->time + ahead, centre, &angle);
        for (int a = 0; a < 3; ++a) centre[a] += m->now.c[a];
        rigid_rotation(axis, angle, turn);
    } else {
        rigid_free_turn(m->sums.inertia, m->sums.spin, m->turns, ahead, turn);
    }
}

bool motion_has_body(const mpm *s, int body)
{
    return body >= s->n_deforming;
}

void motion_foresee(const mpm *s, int body, const double x[3], double ahead[3])
{
    const body_motion *m = motion_of_group(s, s->body[body].group);
    double centre[3], turn[9], r[3];
    if (share_before(s) == 1.0) {
        memmove(ahead, x, 3 * sizeof *x);
        return;
    }
    foresee_turn(s, m, centre, turn);
    for (int a = 0; a < 3; ++a) r[a] = x[a] - m->now.c[a];
    for (int a = 0; a < 3; ++a)
        ahead[a] = centre[a] + turn[3 * a] * r[0] + turn[3 * a + 1] * r[1] + turn[3 * a + 2] * r[2];
}

void motion_push(mpm *s, int body, const double ahead[3], const double force[3])
{
    body_motion *m = motion_of_group(s, s->body[body].group);
    double centre[3], turn[9], x[3];
    memcpy(x, ahead, sizeof x);
    if (share_before(s) != 1.0) {
        foresee_turn(s, m, centre, turn);
        for (int a = 0; a < 3; ++a) x[a] += m->now.c[a] - centre[a]; /* the moment is about the centre there */
    }
    motion_load(s, m, x, force);
}

double motion_compliance(mpm *s, int body, const double x[3], const double unit[3])
{
    const body_motion *m = motion_of_group(s, s->body[body].group);
    double r[3], turn[3], w[3], out = 0.0;
    rigid_sums sums;
    if (motion_is_prescribed(m->given)) return 0.0;
    rigid_sum_points(s, m->body, &sums);
    if (!(sums.mass > 0.0)) return 0.0;
    for (int a = 0; a < 3; ++a) r[a] = x[a] - sums.centre[a];
    vec_cross(r, unit, turn);
    rigid_spin(sums.inertia, m->turns, turn, w);
    for (int a = 0; a < 3; ++a) out += (m->slides[a] ? unit[a] * unit[a] / sums.mass : 0.0) + turn[a] * w[a];
    return out;
}

void motions_solve(mpm *s)
{
    for (int i = 0; s->motions && i < s->motions->n; ++i)
        if (!motion_is_prescribed(s->motions->body[i].given)) solve_free(s, &s->motions->body[i]);
}

/* Nodes move as forces on the surface and on the volume say. */
void motions_predict(mpm *s)
{
    motions_solve(s);
    if (s->motions) motions_impose(s, N_VEL_L, false);
}

void motion_change(const body_motion *m, const double impulse[3], const double moment[3], rigid_field *out)
{
    *out = (rigid_field){.c = {m->now.c[0], m->now.c[1], m->now.c[2]}};
    if (motion_is_prescribed(m->given) || !(m->sums.mass > 0.0)) return;
    for (int a = 0; a < 3; ++a) out->v[a] = m->slides[a] ? impulse[a] / m->sums.mass : 0.0;
    rigid_spin(m->sums.inertia, m->turns, moment, out->w);
}

static void take_given(body_motion *m, const double impulse[3], const double moment[3], double work, motion_giver giver)
{
    for (int a = 0; a < 3; ++a) {
        m->impulse[a] += impulse[a];
        m->moment[a] += moment[a];
        if (giver != MOTION_BY_CONTACT) continue;
        m->contact[a] += impulse[a];
        m->contact_moment[a] += moment[a];
    }
    m->work += work;
    if (giver == MOTION_BY_CONTACT) m->contact_work += work;
}

void motion_pull_fixed(const mpm *s, int body, const double x[3], const double impulse[3], const double about[3])
{
    body_motion *m = motion_of_group(s, s->body[body].group);
    double moment[3] = {about[0], about[1], about[2]};
    rigid_add_moment(m, x, impulse, moment);
    take_given(m, impulse, moment, 0.0, MOTION_BY_CONTACT);
}

void motion_give(mpm *s, body_motion *m, const double impulse[3], const double moment[3], double work,
                 motion_giver giver)
{
    take_given(m, impulse, moment, work, giver);
    if (!motion_is_prescribed(m->given)) solve_free(s, m);
}

/* ---- the end of the step ---- */

/* Momentum, moment of momentum about a fixed point and energy of the body's points as the step leaves them. */
typedef struct rigid_state {
    double momentum[3], spin[3], kinetic;
} rigid_state;

static rigid_state state_at_end(const body_motion *m)
{
    double inertia[6], r[3], centre[3], v[3], own[3] = {0.0};
    rigid_state out = {.kinetic = 0.0};
    rigid_turn_inertia(m->turn, m->sums.inertia, inertia);
    for (int a = 0; a < 3; ++a) r[a] = m->sums.centre[a] - m->now.c[a];
    for (int a = 0; a < 3; ++a)
        centre[a] = m->end.c[a] + m->turn[3 * a] * r[0] + m->turn[3 * a + 1] * r[1] + m->turn[3 * a + 2] * r[2];
    rigid_velocity(&m->end, centre, v);
    static const int at[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) own[a] += inertia[at[a][b]] * m->end.w[b];
    for (int a = 0; a < 3; ++a) {
        out.momentum[a] = m->sums.mass * v[a];
        out.kinetic += 0.5 * m->sums.mass * v[a] * v[a] + 0.5 * m->end.w[a] * own[a];
        out.spin[a] = own[a];
    }
    add_turn(centre, out.momentum, out.spin);
    return out;
}

/* What body forces give a free body. */
static void enter_body_force(mpm *s, const body_motion *m)
{
    double impulse[3], moment[3], work = 0.0;
    field_moment_about_centre(m, moment);
    for (int a = 0; a < 3; ++a) {
        impulse[a] = (m->sums.mass * m->acceleration[a] + m->field_force[a]) * s->kick;
        moment[a] *= s->kick;
        work += impulse[a] * m->working[0][a] + moment[a] * m->working[1][a];
        if (a < s->mesh->dim)
            ledger_add(s->ledger, (ledger_quantity)(LEDGER_MOMENTUM_X + a), LEDGER_SOURCE, impulse[a]);
    }
    add_turn(m->sums.centre, impulse, moment);
    ledger_turn(s->ledger, LEDGER_SOURCE, moment, 1.0);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_SOURCE, work);
}

/* The work that others did on the body: on a free one that by which its energy has changed. `work`: on a prescribed one. */
static double work_on_body(const body_motion *m, const double impulse[3], const double moment[3], double work)
{
    if (motion_is_prescribed(m->given)) return work;
    double sum = 0.0;
    for (int a = 0; a < 3; ++a) sum += impulse[a] * m->working[0][a] + moment[a] * m->working[1][a];
    return sum;
}

/* What the prescription, or a mirror, has given beyond what others have. */
static void enter_prescription(mpm *s, const body_motion *m)
{
    const rigid_state end = state_at_end(m);
    double impulse[3], moment[3], before[3], turned[3];
    for (int a = 0; a < 3; ++a) {
        impulse[a] = m->impulse[a] + m->loads[a];
        moment[a] = m->moment[a] + m->load_moment[a];
        before[a] = m->sums.spin[a];
        turned[a] = moment[a];
    }
    add_turn(m->sums.centre, m->sums.momentum, before);
    add_turn(m->now.c, impulse, turned);
    for (int a = 0; a < s->mesh->dim; ++a)
        ledger_add(s->ledger, (ledger_quantity)(LEDGER_MOMENTUM_X + a), LEDGER_BOUNDARY,
                   end.momentum[a] - m->sums.momentum[a] - impulse[a]);
    for (int a = 0; a < 3; ++a) turned[a] = end.spin[a] - before[a] - turned[a];
    ledger_turn(s->ledger, LEDGER_BOUNDARY, turned, 1.0);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_BOUNDARY,
               end.kinetic - m->sums.kinetic - work_on_body(m, impulse, moment, m->work + m->load_work));
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_CONTACT,
               work_on_body(m, m->contact, m->contact_moment, m->contact_work));
}

static void note_force(const mpm *s, body_motion *m)
{
    double turning[3];
    field_moment_about_centre(m, turning);
    for (int a = 0; a < 3; ++a) {
        const double weight = (m->sums.mass * m->acceleration[a] + m->field_force[a]) * s->kick;
        m->force[a] = (m->impulse[a] + m->loads[a] - weight) / s->kick;
        m->torque[a] = (m->moment[a] + m->load_moment[a]) / s->kick - turning[a];
    }
}

floe_status motions_move(mpm *s)
{
    for (int i = 0; s->motions && i < s->motions->n; ++i) {
        body_motion *m = &s->motions->body[i];
        TRY(rigid_move_points(s, m));
        if (!motion_is_prescribed(m->given)) enter_body_force(s, m);
        enter_prescription(s, m);
        note_force(s, m);
    }
    return FLOE_OK;
}

bool mpm_motion_force(const mpm *s, int body, double force[3], double moment[3])
{
    if (!s->motions || body < s->n_deforming) return false;
    const body_motion *m = &s->motions->body[body - s->n_deforming];
    memcpy(force, m->force, sizeof m->force);
    memcpy(moment, m->torque, sizeof m->torque);
    return true;
}
