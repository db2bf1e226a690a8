/* Newton's method for a load increment. */
#include "mpm/implicit/implicit.h"

#include "mpm/implicit/implicit_constants.h"
#include "mpm/implicit/implicit_contact.h"
#include "mpm/implicit/implicit_volume.h"

#include <math.h>
#include <string.h>

static double constrained_norm(const struct mpm_implicit *w, const double *x)
{
    double sum = 0.0;
    for (size_t k = 0; k < w->components; ++k) sum += x[k] * x[k];
    return sqrt(sum);
}

/* Stress and internal forces at the displacement u, and the residual of the unconstrained components. */
static floe_status evaluate_residual(mpm *s, const double *u)
{
    struct mpm_implicit *w = s->implicit;
    implicit_follow_surfaces(s, u);
    TRY(implicit_strain(s, u));
    implicit_internal_force(s, w->internal);
    implicit_edge_force(s, u, w->internal);
    TRY(enclosed_gases_force(s, u, w->gas_force));
    for (size_t k = 0; k < w->components; ++k) {
        w->residual[k] = w->external[k] + w->gas_force[k] + w->internal[k];
        if (w->unbalanced) w->residual[k] -= w->unbalanced_left * w->unbalanced[k];
        if (w->mass) w->residual[k] += 0.5 * (w->internal_first[k] - w->internal[k]) - motion_force(s, k, u[k]);
        if (w->constrained[k] || !w->reached[k]) w->residual[k] = 0.0;
    }
    implicit_contact_forces(s);
    return FLOE_OK;
}

/* The increment from u that satisfies the constraints and the active contact conditions. False: u satisfies them. */
static bool find_constraint_step(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    bool any = false;
    for (size_t k = 0; k < w->components; ++k) {
        w->constraint_step[k] = w->constrained[k] ? w->prescribed[k] - w->u[k] : 0.0;
        any = any || w->constraint_step[k] != 0.0;
    }
    return implicit_contact_closing_step(s, w->u, w->constraint_step) || any;
}

/* Moves the residual of that increment to the other components. */
static void solve_increment(mpm *s, const node_matrix *m)
{
    struct mpm_implicit *w = s->implicit;
    node_matrix_apply(m, w->constraint_step, w->trial);
    for (size_t k = 0; k < w->components; ++k)
        if (!w->constrained[k]) w->residual[k] -= w->trial[k];
    implicit_contact_project(s, w->residual);
}

static void assemble_all(mpm *s, node_matrix *m, const double *tangent)
{
    implicit_assemble(s, m, tangent);
    implicit_assemble_edges(s, m);
    implicit_assemble_surfaces(s, m);
    implicit_assemble_springs(s, m);
    if (s->implicit->mass) motion_stiffen(s, m);
}

static void constrain_matrix(mpm *s, node_matrix *m)
{
    implicit_contact_project_matrix(s, m);
    node_matrix_constrain(m, s->implicit->constrained);
}

/* The matrix of the displacements, and where bodies share changes of volume another to precondition it with (implicit_volume.h). */
static void make_matrix(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    node_matrix *m = multigrid_matrix(w->solver), *exact = w->volume ? w->volume->exact : m;
    assemble_all(s, exact, w->tangent);
    if (w->volume) assemble_all(s, m, w->volume->tangent);
    if (find_constraint_step(s)) solve_increment(s, exact);
    constrain_matrix(s, exact);
    if (w->volume) constrain_matrix(s, m);
}

/* No body may be free to move; one that is comes to rest on a body that it touches, if there is one. */
static floe_status check_free(mpm *s)
{
    const floe_status status = implicit_check_rigid_motions(s);
    if (status != FLOE_DIVERGED || !implicit_contact_bind_all(s)) return status;
    context_clear(s->ctx);
    make_matrix(s);
    return implicit_check_rigid_motions(s);
}

/* The matrix at u. Loads on nodes outside the support of all points are dropped. */
static floe_status renew_matrix(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    const bool first = !w->ready;
    TRY(implicit_tangents(s, w->u));
    if (first) TRY(node_matrix_shape(multigrid_matrix(w->solver), w->row));
    if (first && w->volume) TRY(node_matrix_shape(w->volume->exact, w->row));
    make_matrix(s);
    if (first && !w->mass) TRY(check_free(s));
    w->ready = true;
    return multigrid_prepare(w->solver);
}

static void apply_preconditioner(void *user, double *x, double *y)
{
    const mpm *s = user;
    const struct mpm_implicit *w = s->implicit;
    multigrid_cycle(w->solver, x, y);
    for (size_t k = 0; k < w->components; ++k)
        if (w->constrained[k]) y[k] = 0.0;
    implicit_contact_project(s, y);
}

static void multiply_tangent(void *user, double *x, double *y)
{
    const mpm *s = user;
    multigrid_apply(s->implicit->solver, x, y);
    enclosed_gases_stiffness(s->implicit, x, y);
    implicit_springs_stiffness(s, x, y);
}

/* Scale of the forces, now or at the start, against which the residual is measured. */
static double force_scale(const mpm *s)
{
    const struct mpm_implicit *w = s->implicit;
    double inertia = 0.0;
    for (size_t k = 0; w->mass && k < w->components; ++k) {
        const double impulse = w->mass[k % w->grid.size] * w->velocity[k];
        inertia += impulse * impulse;
    }
    return constrained_norm(w, w->external) + constrained_norm(w, w->gas_force) +
           fmax(constrained_norm(w, w->internal), constrained_norm(w, w->internal_first)) +
           MPM_NEWTON_ROUND_OFF * sqrt(inertia) * 2.0 / s->dt;
}

/* A step along the change, halved while points are beyond their law. */
static floe_status take_change(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    double share = 1.0;
    for (int halving = 0; halving <= MPM_MOST_HALVINGS; ++halving, share *= 0.5) {
        context_clear(s->ctx);
        for (size_t k = 0; k < w->components; ++k) w->trial[k] = w->u[k] + share * w->change[k];
        const floe_status status = evaluate_residual(s, w->trial);
        if (status == FLOE_RETRY) continue;
        TRY(status);
        memcpy(w->u, w->trial, w->components * sizeof *w->u);
        return FLOE_OK;
    }
    return FLOE_RETRY;
}

static floe_status solve_change(mpm *s, double tolerance)
{
    struct mpm_implicit *w = s->implicit;
    for (size_t k = 0; k < w->components; ++k)
        if (w->constrained[k]) w->residual[k] = 0.0;
    const double had = constrained_norm(w, w->residual);
    if (w->volume) return implicit_solve_volume(s, had > 0.0 ? tolerance / had : 1.0);
    const cg_system system = {multiply_tangent, apply_preconditioner, s, CG_WEIGHTED, NULL};
    const cg_result r = cg_solve_afresh(w->krylov, &system, tolerance, w->residual, w->change);
    w->krylov_iterations += r.iterations;
    if (!r.converged && !(r.residual < 0.1 * had))
        return fail(s->ctx, FLOE_RETRY,
                    "the matrix of the load increment cannot be solved with: %d iterations left %g of %g", r.iterations,
                    r.residual, had);
    return FLOE_OK;
}

static floe_status iterate_newton(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    const double tolerance = s->scene->time.tolerance;
    const int most = w->contact ? MPM_MOST_CONTACT_ITERATIONS : MPM_MOST_NEWTON;
    bool stale = true;
    double before = INFINITY;
    for (w->newton = 0;; ++w->newton) {
        if (context_must_stop(s->ctx)) return FLOE_INTERRUPTED;
        const bool turned = implicit_contact_update(s, w->u), driven = find_constraint_step(s);
        const double left = constrained_norm(w, w->residual), scale = force_scale(s);
        if (!turned && !driven && left <= tolerance * scale) return FLOE_OK;
        if (turned) before = INFINITY;
        if (w->newton == most || (w->newton > 1 && !(left <= MPM_NEWTON_DIVERGED * before)))
            return fail(s->ctx, FLOE_RETRY, "after %d iterations of Newton's method %.3g of the forces is left",
                        w->newton, left / scale);
        if (stale || turned || driven || left > MPM_NEWTON_SLOW * before) TRY(renew_matrix(s));
        stale = false;
        TRY(solve_change(s, fmax(MPM_NEWTON_FORCING * constrained_norm(w, w->residual), 0.1 * tolerance * scale)));
        for (size_t k = 0; k < w->components; ++k) w->change[k] += w->constraint_step[k];
        TRY(take_change(s));
        before = left;
    }
}

/* Logs the residual and the iterations. */
static void log_residual(const mpm *s)
{
    const struct mpm_implicit *w = s->implicit;
    const double scale = force_scale(s);
    context_log(s->ctx, w->mass ? LOG_DETAIL : LOG_INFO,
                "%s to t = %.6g%s: %d iterations of Newton's method, %d of conjugate gradients, %.1e of the "
                "forces left",
                w->mass ? "step" : "load increment", s->time + s->dt, scene_time_unit(s->scene), w->newton,
                w->krylov_iterations, scale > 0.0 ? constrained_norm(w, w->residual) / scale : 0.0);
}

/* Work of walls, loads and body forces; forces change linearly with the displacement over the increment. */
static void enter_constraint_work(mpm *s)
{
    const struct mpm_implicit *w = s->implicit;
    double work = 0.0;
    for (size_t k = 0; k < w->components; ++k) work -= 0.5 * (w->internal_first[k] + w->internal[k]) * w->u[k];
    work -= enclosed_gases_enter(s);
    work += implicit_springs_gain(s, w->u); /* their energy is strain energy too */
    implicit_enter_edges(s);
    implicit_contact_enter(s);
    if (w->mass)
        motion_enter(s);
    else
        ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_SOURCE, work);
    ledger_tally(s->ledger, COUNT_BALANCE_ITERATIONS, w->newton);
    ledger_tally(s->ledger, COUNT_BALANCE_KRYLOV, w->krylov_iterations);
}

/* From where the nodes would be without forces. */
static floe_status start_motion(mpm *s)
{
    motion_begin(s);
    motion_guess(s, s->implicit->u);
    return evaluate_residual(s, s->implicit->u);
}

/* Forces that were not in balance at the start, and the share of them that is left to later increments. */
static void find_unbalanced(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    implicit_body_force(s, w->acceleration_first, false, w->external_first);
    implicit_drop_unreached(w, w->external_first);
    w->unbalanced_left = fmax(0.0, 1.0 - s->dt / (s->scene->time.end - s->time));
    if (w->unbalanced_left < MPM_NEWTON_ROUND_OFF) w->unbalanced_left = 0.0;
    enclosed_gases_first_force(s, w->unbalanced);
    for (size_t k = 0; k < w->components; ++k)
        w->unbalanced[k] = w->constrained[k] ? 0.0 : w->unbalanced[k] + w->external_first[k] + w->internal_first[k];
}

/* Shape functions of the points, constraints and external forces. */
static floe_status prepare_system(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    TRY(implicit_locate(s));
    TRY(implicit_find_patches(s));
    TRY(implicit_find_edges(s));
    implicit_constrain(s);
    implicit_find_reached(s);
    TRY(implicit_springs_find(s));
    TRY(implicit_contact_find(s));
    implicit_body_force(s, s->acceleration, true, w->external);
    TRY(enclosed_gases_smear(s));
    implicit_drop_unreached(w, w->external);
    memcpy(w->steady, w->external, w->components * sizeof *w->steady);
    for (int r = 0; r < w->n_gases; ++r) implicit_drop_unreached(w, w->gas_set[r].unit_force);
    return enclosed_gases_begin(s);
}

static bool some_law_needs_time(const mpm *s)
{
    for (int body = 0; body < s->n_bodies; ++body)
        if (s->body[body].law->needs & SOLID_NEEDS_TIME) return true;
    return false;
}

/* Forces at the start of the step, and the first guess of the displacement. Stress that relaxes is out of balance without any. */
static floe_status start_step(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    memset(w->u, 0, w->components * sizeof *w->u);
    w->ready = false;
    w->krylov_iterations = 0;
    w->unbalanced_left = 0.0;
    w->law_time = 0.0;
    TRY(evaluate_residual(s, w->u));
    memcpy(w->internal_first, w->internal, w->components * sizeof *w->internal);
    w->law_time = s->dt;
    if (w->mass) return start_motion(s);
    if (w->unbalanced) find_unbalanced(s);
    return w->unbalanced || some_law_needs_time(s) ? evaluate_residual(s, w->u) : FLOE_OK;
}

/* Updates points, surfaces and enclosed gases from the displacement of the nodes. */
static floe_status update_points(mpm *s)
{
    implicit_move_surfaces(s, s->implicit->u);
    TRY(implicit_move(s));
    enclosed_gases_store(s);
    enter_constraint_work(s);
    return FLOE_OK;
}

floe_status mpm_implicit_solve(mpm *s)
{
    TRY(prepare_system(s));
    TRY(start_step(s));
    TRY(iterate_newton(s));
    log_residual(s);
    return update_points(s);
}
