/* Newton's method for a load increment. */
#include "mpm/balance/balance.h"

#include "mpm/balance/balance_contact.h"
#include "mpm/surface/skin.h"
#include "mpm/surface/traction.h"

#include <math.h>
#include <string.h>

enum { MOST_NEWTON = 30, MOST_TURNS = 60 /* with contacts */, MOST_HALVINGS = 6 };
/* Conjugate gradients leave this share of what a step of Newton's method has to take away. */
static const double forcing = 1e-4;
/* A step that leaves more than this share is worth a new matrix. */
static const double slow = 1e-2;
/* Digits that differences of velocities may lose. */
static const double round_off = 1e-6;
/* One that leaves that many times more goes astray, unless it is the first, which turns what hardly resists at rest. */
static const double astray = 1e4;

static double norm(const struct mpm_balance *w, const double *x)
{
    double sum = 0.0;
    for (size_t k = 0; k < w->components; ++k) sum += x[k] * x[k];
    return sqrt(sum);
}

/* Stress at u, forces of the points, and what is left of them and the loads where nothing is held. */
static floe_status evaluate(mpm *s, const double *u)
{
    struct mpm_balance *w = s->balance;
    TRY(balance_strain(s, u));
    balance_pull(s, w->inner);
    balance_pull_edges(s, u, w->inner);
    TRY(rooms_push(s, u, w->pushed));
    for (size_t k = 0; k < w->components; ++k) {
        w->left[k] = w->outer[k] + w->pushed[k] + w->inner[k];
        if (w->unbalanced) w->left[k] -= w->keep * w->unbalanced[k];
        if (w->mass) w->left[k] += 0.5 * (w->inner_first[k] - w->inner[k]) - motion_force(s, k, u[k]);
        if (w->held[k] || !w->reached[k]) w->left[k] = 0.0;
    }
    contact_rest_take(s);
    return FLOE_OK;
}

/* The way from u to where what is held, and what bodies in contact bind, must be. False: they are there. */
static bool find_way(mpm *s)
{
    struct mpm_balance *w = s->balance;
    bool any = false;
    for (size_t k = 0; k < w->components; ++k) {
        w->way[k] = w->held[k] ? w->target[k] - w->u[k] : 0.0;
        any = any || w->way[k] != 0.0;
    }
    return contact_rest_way(s, w->u, w->way) || any;
}

/* What that way asks of the others. */
static void drive(mpm *s, const node_matrix *m)
{
    struct mpm_balance *w = s->balance;
    node_matrix_apply(m, w->way, w->trial);
    for (size_t k = 0; k < w->components; ++k)
        if (!w->held[k]) w->left[k] -= w->trial[k];
    contact_rest_project(s, w->left);
}

static void make_matrix(mpm *s)
{
    struct mpm_balance *w = s->balance;
    node_matrix *m = node_multigrid_matrix(w->solver);
    balance_assemble(s);
    balance_assemble_edges(s, m);
    if (w->mass) motion_stiffen(s, m);
    if (find_way(s)) drive(s, m);
    contact_rest_stiffen(s, m);
    node_matrix_hold(m, w->held);
}

/* Nothing may be free to move; what is comes to rest on what it meets, if it meets anything. */
static floe_status check_free(mpm *s)
{
    const floe_status status = balance_check_free(s);
    if (status != FLOE_DIVERGED || !contact_rest_close(s)) return status;
    context_clear(s->ctx);
    make_matrix(s);
    return balance_check_free(s);
}

/* The matrix at u. Loads of nodes that no point reaches have nothing to push. */
static floe_status renew_matrix(mpm *s)
{
    struct mpm_balance *w = s->balance;
    const bool first = !w->ready;
    TRY(balance_tangents(s, w->u));
    if (first) TRY(node_matrix_shape(node_multigrid_matrix(w->solver), w->row));
    make_matrix(s);
    if (first && !w->mass) TRY(check_free(s));
    w->ready = true;
    return node_multigrid_prepare(w->solver);
}

static void precondition(void *user, double *x, double *y)
{
    const mpm *s = user;
    const struct mpm_balance *w = s->balance;
    node_multigrid_cycle(w->solver, x, y);
    for (size_t k = 0; k < w->components; ++k)
        if (w->held[k]) y[k] = 0.0;
    contact_rest_project(s, y);
}

static void multiply(void *user, double *x, double *y)
{
    const mpm *s = user;
    node_multigrid_apply(s->balance->solver, x, y);
    rooms_stiffen(s->balance, x, y);
}

/* How large the forces are, or were at the start, so that what is left can be told from nothing. */
static double force_scale(const mpm *s)
{
    const struct mpm_balance *w = s->balance;
    double inertia = 0.0;
    for (size_t k = 0; w->mass && k < w->components; ++k) {
        const double impulse = w->mass[k % w->grid.size] * w->velocity[k];
        inertia += impulse * impulse;
    }
    return norm(w, w->outer) + norm(w, w->pushed) + fmax(norm(w, w->inner), norm(w, w->inner_first)) +
           round_off * sqrt(inertia) * 2.0 / s->dt;
}

/* A step along the change, halved while points are beyond their law. */
static floe_status take_change(mpm *s)
{
    struct mpm_balance *w = s->balance;
    double share = 1.0;
    for (int halving = 0; halving <= MOST_HALVINGS; ++halving, share *= 0.5) {
        context_clear(s->ctx);
        for (size_t k = 0; k < w->components; ++k) w->trial[k] = w->u[k] + share * w->change[k];
        const floe_status status = evaluate(s, w->trial);
        if (status == FLOE_RETRY) continue;
        TRY(status);
        memcpy(w->u, w->trial, w->components * sizeof *w->u);
        return FLOE_OK;
    }
    return FLOE_RETRY;
}

static floe_status solve_change(mpm *s, double tolerance)
{
    struct mpm_balance *w = s->balance;
    for (size_t k = 0; k < w->components; ++k)
        if (w->held[k]) w->left[k] = 0.0;
    const double had = norm(w, w->left);
    const cg_result r = cg_solve(w->krylov, multiply, precondition, s, w->left, NULL, tolerance, w->change);
    w->krylov_iterations += r.iterations;
    if (!r.converged && !(r.residual < 0.1 * had))
        return fail(s->ctx, FLOE_RETRY,
                    "the matrix of the load increment cannot be solved with: %d iterations left %g of %g", r.iterations,
                    r.residual, had);
    return FLOE_OK;
}

static floe_status newton(mpm *s)
{
    struct mpm_balance *w = s->balance;
    const double tolerance = s->scene->time.tolerance;
    const int most = w->contact ? MOST_TURNS : MOST_NEWTON;
    bool stale = true;
    double before = INFINITY;
    for (w->newton = 0;; ++w->newton) {
        const bool turned = contact_rest_decide(s, w->u), driven = find_way(s);
        const double left = norm(w, w->left), scale = force_scale(s);
        if (!turned && !driven && left <= tolerance * scale) return FLOE_OK;
        if (turned) before = INFINITY;
        if (w->newton == most || (w->newton > 1 && !(left <= astray * before)))
            return fail(s->ctx, FLOE_RETRY, "after %d iterations of Newton's method %.3g of the forces is left",
                        w->newton, left / scale);
        if (stale || turned || driven || left > slow * before) TRY(renew_matrix(s));
        stale = false;
        TRY(solve_change(s, fmax(forcing * norm(w, w->left), 0.1 * tolerance * scale)));
        for (size_t k = 0; k < w->components; ++k) w->change[k] += w->way[k];
        TRY(take_change(s));
        before = left;
    }
}

/* What is left of the forces, and what it took. */
static void say(const mpm *s)
{
    const struct mpm_balance *w = s->balance;
    const double scale = force_scale(s);
    context_log(s->ctx, w->mass ? LOG_DETAIL : LOG_INFO,
                "%s to t = %.6g%s: %d iterations of Newton's method, %d of conjugate gradients, %.1e of the "
                "forces left",
                w->mass ? "step" : "load increment", s->time + s->dt, scene_time_unit(s->scene), w->newton,
                w->krylov_iterations, scale > 0.0 ? norm(w, w->left) / scale : 0.0);
}

/* What walls, loads and body forces have done: the points have it, as the nodes' forces changed evenly on the way. */
static void enter_work(mpm *s)
{
    const struct mpm_balance *w = s->balance;
    double work = 0.0;
    for (size_t k = 0; k < w->components; ++k) work -= 0.5 * (w->inner_first[k] + w->inner[k]) * w->u[k];
    work -= rooms_enter(s);
    balance_enter_edges(s);
    contact_rest_enter(s);
    if (w->mass)
        motion_enter(s);
    else
        ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_SOURCE, work);
    ledger_tally(s->ledger, COUNT_BALANCE_ITERATIONS, w->newton);
    ledger_tally(s->ledger, COUNT_BALANCE_KRYLOV, w->krylov_iterations);
}

static void drop_unreached(const struct mpm_balance *w, double *force)
{
    for (size_t k = 0; k < w->components; ++k)
        if (!w->reached[k]) force[k] = 0.0;
}

/* From where the nodes would be without forces. */
static floe_status start_motion(mpm *s)
{
    motion_begin(s);
    motion_guess(s, s->balance->u);
    return evaluate(s, s->balance->u);
}

/* Forces that were not in balance at the start, and the share of them that is left to later increments. */
static void find_unbalanced(mpm *s)
{
    struct mpm_balance *w = s->balance;
    balance_weigh(s, w->acceleration_first, false, w->outer_first);
    drop_unreached(w, w->outer_first);
    w->keep = fmax(0.0, 1.0 - s->dt / (s->scene->time.end - s->time));
    if (w->keep < round_off) w->keep = 0.0;
    rooms_push_first(s, w->unbalanced);
    for (size_t k = 0; k < w->components; ++k)
        w->unbalanced[k] = w->held[k] ? 0.0 : w->unbalanced[k] + w->outer_first[k] + w->inner_first[k];
}

/* The points where they are, what holds the nodes, and what pushes them. */
static floe_status prepare(mpm *s)
{
    struct mpm_balance *w = s->balance;
    TRY(balance_locate(s));
    TRY(balance_find_edges(s));
    balance_hold(s);
    balance_reach(s);
    TRY(contact_rest_find(s));
    balance_weigh(s, s->work->acceleration, true, w->outer);
    TRY(rooms_squeeze(s));
    drop_unreached(w, w->outer);
    for (int r = 0; r < w->n_rooms; ++r) drop_unreached(w, w->room[r].push);
    return rooms_begin(s);
}

/* The forces at the start of the step, and the first guess of where it leads. */
static floe_status start(mpm *s)
{
    struct mpm_balance *w = s->balance;
    memset(w->u, 0, w->components * sizeof *w->u);
    w->ready = false;
    w->krylov_iterations = 0;
    w->keep = 0.0;
    TRY(evaluate(s, w->u));
    memcpy(w->inner_first, w->inner, w->components * sizeof *w->inner);
    if (w->mass) return start_motion(s);
    if (!w->unbalanced) return FLOE_OK;
    find_unbalanced(s);
    return evaluate(s, w->u);
}

/* Points, surfaces and rooms follow the nodes. */
static floe_status follow(mpm *s)
{
    carry_surfaces(s, balance_way);
    carry_skins(s, balance_way);
    TRY(balance_move(s));
    rooms_store(s);
    enter_work(s);
    return FLOE_OK;
}

floe_status mpm_balance_solve(mpm *s)
{
    TRY(prepare(s));
    TRY(start(s));
    TRY(newton(s));
    say(s);
    return follow(s);
}
