/* Free rigid bodies, and the deforming bodies that stick to them: both are accelerated with their joint mass and inertia. */
#include "mpm/motion/motion_parts.h"

#include "math/small_solve.h"

#include <math.h>
#include <string.h>

/* ---- free bodies and those that stick to them ---- */

enum { DOFS = MOTION_DOFS, SUM_LOAD = DOFS * DOFS, SUM_JOINED = SUM_LOAD + DOFS };

void motion_unit(int dof, const double r[3], double v[3])
{
    const int a = dof % 3, b = (a + 1) % 3, c = (a + 2) % 3;
    v[0] = v[1] = v[2] = 0.0;
    if (dof < 3) {
        v[a] = 1.0;
        return;
    }
    v[b] = -r[c];
    v[c] = r[b];
}

/* Masses and momenta of what sticks to a body at a node, for each of its degrees of freedom. */
static void join_node(mpm *s, int blk, ptrdiff_t at, const double x[3], const void *user, double *sum)
{
    const int body_group = *(const int *)user;
    const fields *f = s->domain->fields[blk];
    const body_motion *m = motion_of_group(s, body_group);
    double r[3], mode[DOFS][3];
    if (leader_at(s, f, at) != body_group) return;
    for (int a = 0; a < 3; ++a) r[a] = x[a] - m->now.c[a];
    for (int d = 0; d < DOFS; ++d) motion_unit(d, r, mode[d]);
    for (int g = 0; g < s->n_deforming_groups; ++g) {
        const double mass = field_get(f, N_MASS, g, 0)[at];
        if (!(mass > 0.0) || !sticks_to_motions(s, g)) continue;
        for (int d = 0; d < DOFS; ++d)
            for (int a = 0; a < s->mesh->dim; ++a) {
                sum[SUM_LOAD + d] += mass * mode[d][a] * field_get(f, N_VEL_L, g, a)[at];
                for (int e = 0; e < DOFS; ++e) sum[DOFS * d + e] += mass * mode[d][a] * mode[e][a];
            }
    }
}

double motion_inertia(const body_motion *m, int d, int e)
{
    static const int inertia_at[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    if (d >= 3 && e >= 3) return m->sums.inertia[inertia_at[d - 3][e - 3]];
    return d == e ? m->sums.mass : 0.0;
}

/* (mass + joined) of the degrees of freedom of the body, solved for what `load` gives; others stay 0. */
static void solve_dofs(const body_motion *m, const double joined[DOFS * DOFS], const double load[DOFS],
                       double out[DOFS])
{
    double A[DOFS * DOFS] = {0.0}, b[DOFS] = {0.0};
    int dof[DOFS], n = 0;
    memset(out, 0, DOFS * sizeof *out);
    for (int d = 0; d < DOFS; ++d)
        if (motion_is_free(m, d)) dof[n++] = d;
    for (int i = 0; i < n; ++i) {
        b[i] = load[dof[i]];
        for (int j = 0; j < n; ++j) A[n * i + j] = motion_inertia(m, dof[i], dof[j]) + joined[DOFS * dof[i] + dof[j]];
    }
    if (n == 0 || !small_solve_symmetric(n, A, b)) return;
    for (int i = 0; i < n; ++i) out[dof[i]] = b[i];
}

/* By how much what sticks to it changes its motion: load less what it would have at the body's velocity. */
static void solve_joined(body_motion *m, const double sum[SUM_JOINED])
{
    double load[DOFS], change[DOFS];
    for (int d = 0; d < DOFS; ++d) {
        load[d] = sum[SUM_LOAD + d];
        for (int e = 0; e < DOFS; ++e) load[d] -= sum[DOFS * d + e] * (e < 3 ? m->next.v[e] : m->next.w[e - 3]);
    }
    solve_dofs(m, sum, load, change);
    for (int d = 0; d < DOFS; ++d) *(d < 3 ? &m->next.v[d] : &m->next.w[d - 3]) += change[d];
}

void join_free_bodies(mpm *s)
{
    for (int g = s->n_deforming_groups; g < s->n_groups; ++g) {
        body_motion *m = motion_of_group(s, g);
        double sum[SUM_JOINED];
        if (motion_is_prescribed(m->given)) continue;
        motion_sum_nodes(s, join_node, &g, SUM_JOINED, sum);
        solve_joined(m, sum);
    }
}

/* ---- contact ---- */

/* A contact at a node of a free body. */
typedef struct free_contact {
    double impulse[3]; /* N s: on the body, as if it could not be moved */
    double mass;       /* kg: of what it touches */
    double normal[3];  /* 0: they stick */
    bool found;
} free_contact;

static bool touches(uint32_t bits, int group, bool *slides)
{
    *slides = (bits >> group & 1U) == 0;
    return !*slides || (bits >> (group + MPM_MAX_GROUPS) & 1U) != 0;
}

static free_contact look_at_contact(const mpm *s, const fields *f, int group, ptrdiff_t at, const double x[3])
{
    const imposed what = {N_VEL_L, false, false};
    const double mass = field_get(f, N_MASS, group, 0)[at];
    free_contact c = {.mass = 0.0};
    bool slides = true, any = true;
    double v[3], square = 0.0;
    if (!(mass > 0.0)) return c;
    rigid_at(s, motion_of_group(s, group), &what, x, v);
    for (int a = 0; a < s->mesh->dim; ++a) {
        c.impulse[a] = mass * (field_get(f, N_VEL_L, group, a)[at] - v[a]);
        square += c.impulse[a] * c.impulse[a];
    }
    const uint32_t bits = (uint32_t)field_get(f, N_TOUCH, group, 0)[at];
    for (int g = 0; g < s->n_deforming_groups; ++g) {
        if (!touches(bits, g, &any)) continue;
        slides = slides && any;
        c.mass += field_get(f, N_MASS, g, 0)[at];
    }
    c.found = square > 0.0 && c.mass > 0.0;
    for (int a = 0; a < 3 && slides && c.found; ++a) c.normal[a] = c.impulse[a] / sqrt(square);
    return c;
}

/* Of a change of the body's velocity at the contact, what the others follow. */
static void follow_change(const free_contact *c, double v[3])
{
    const double along = v[0] * c->normal[0] + v[1] * c->normal[1] + v[2] * c->normal[2];
    if (c->normal[0] == 0.0 && c->normal[1] == 0.0 && c->normal[2] == 0.0) return;
    for (int a = 0; a < 3; ++a) v[a] = along * c->normal[a];
}

static void add_contact(mpm *s, int blk, ptrdiff_t at, const double x[3], const void *user, double *sum)
{
    const int group = *(const int *)user;
    const body_motion *m = motion_of_group(s, group);
    const free_contact c = look_at_contact(s, s->domain->fields[blk], group, at, x);
    double r[3], mode[DOFS][3];
    if (!c.found) return;
    for (int a = 0; a < 3; ++a) r[a] = x[a] - m->now.c[a];
    for (int d = 0; d < DOFS; ++d) motion_unit(d, r, mode[d]);
    for (int d = 0; d < DOFS; ++d)
        for (int a = 0; a < s->mesh->dim; ++a) sum[SUM_LOAD + d] += mode[d][a] * c.impulse[a];
    for (int e = 0; e < DOFS; ++e) {
        double followed[3] = {mode[e][0], mode[e][1], mode[e][2]};
        follow_change(&c, followed);
        for (int d = 0; d < DOFS; ++d)
            for (int a = 0; a < s->mesh->dim; ++a) sum[DOFS * d + e] += c.mass * mode[d][a] * followed[a];
    }
}

/* How a free body is moved by its contacts. */
typedef struct contact_change {
    int group;
    rigid_field field;
} contact_change;

/* The change that a contact gives the others at a node. */
typedef struct node_change {
    free_contact contact;
    double dv[3];     /* m/s */
    uint32_t touched; /* N_TOUCH */
} node_change;

static bool velocity_change_at(const mpm *s, const contact_change *change, const fields *f, ptrdiff_t at,
                               const double x[3], node_change *out)
{
    out->contact = look_at_contact(s, f, change->group, at, x);
    if (!out->contact.found) return false;
    rigid_velocity(&change->field, x, out->dv);
    follow_change(&out->contact, out->dv);
    out->touched = (uint32_t)field_get(f, N_TOUCH, change->group, 0)[at];
    return true;
}

/* What contact gives the others, by the mean of velocities before and after: the change of it. */
static void add_gain(mpm *s, int blk, ptrdiff_t at, const double x[3], const void *user, double *sum)
{
    const fields *f = s->domain->fields[blk];
    node_change c;
    bool slides;
    if (!velocity_change_at(s, user, f, at, x, &c)) return;
    for (int g = 0; g < s->n_deforming_groups; ++g) {
        if (!touches(c.touched, g, &slides)) continue;
        const double mass = field_get(f, N_MASS, g, 0)[at];
        for (int a = 0; a < s->mesh->dim; ++a) {
            const double v = field_get(f, N_VEL_L, g, a)[at], before = field_get(f, N_MOMENTUM, g, a)[at] / mass;
            const double given = -c.contact.impulse[a] * mass / c.contact.mass;
            *sum += 0.5 * (mass * c.dv[a] * (before + v + c.dv[a]) + given * c.dv[a]);
        }
    }
}

static void change_node(mpm *s, int blk, ptrdiff_t at, const double x[3], void *user)
{
    const int group = ((const contact_change *)user)->group;
    const fields *f = s->domain->fields[blk];
    node_change c;
    bool slides;
    if (!velocity_change_at(s, user, f, at, x, &c)) return;
    const double own = field_get(f, N_MASS, group, 0)[at];
    for (int a = 0; a < s->mesh->dim; ++a) {
        for (int g = 0; g < s->n_deforming_groups; ++g)
            if (touches(c.touched, g, &slides)) field_get(f, N_VEL_L, g, a)[at] += c.dv[a];
        field_get(f, N_VEL_L, group, a)[at] -= c.contact.mass / own * c.dv[a];
    }
}

void share_contacts(mpm *s)
{
    for (int g = s->n_deforming_groups; g < s->n_groups; ++g) {
        const body_motion *m = motion_of_group(s, g);
        contact_change change = {.group = g};
        double sum[SUM_JOINED], mode[DOFS], gain;
        if (motion_is_prescribed(m->given)) continue;
        motion_sum_nodes(s, add_contact, &g, SUM_JOINED, sum);
        solve_dofs(m, sum, sum + SUM_LOAD, mode);
        memcpy(change.field.c, m->now.c, sizeof m->now.c);
        memcpy(change.field.v, mode, sizeof change.field.v);
        memcpy(change.field.w, mode + 3, sizeof change.field.w);
        motion_sum_nodes(s, add_gain, &change, 1, &gain);
        ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_CONTACT, gain);
        motion_visit_nodes(s, change_node, &change);
    }
}
