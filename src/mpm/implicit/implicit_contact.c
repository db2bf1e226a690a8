/* Contact in the nodal equations: the active conditions, and the projections of displacements and forces on them. */
#include "mpm/implicit/implicit_contact.h"
#include "mpm/implicit/implicit_view.h"
#include "mpm/nodes/node_place.h"

#include "base/memory.h"
#include "mpm/contact/contact.h"
#include "mpm/implicit/implicit_constants.h"

#include <math.h>
#include <string.h>

const char *implicit_contact_obstacle(const mpm *s)
{
    if (!s->contact) return NULL;
    if (s->cells != CELLS_NONE) return "bodies are in contact beside fluids on cells";
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].fluid) return "bodies are in contact beside fluids";
    if (s->n_groups * s->mesh->dim > NODE_MATRIX_COMPONENTS)
        return "more bodies are in contact than a node holds: 12 in one dimension, 6 in two, 4 in three, all others "
               "counting as one";
    if (s->scene->contact.kind == CONTACT_FRICTION && s->scene->contact.friction > 0.0)
        return "contact.friction other than 0 has no symmetric matrix; use 0, or kind: release, which sticks while it "
               "is pressed";
    return NULL;
}

floe_status implicit_contact_create(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    if (!s->contact) return FLOE_OK;
    TRY(memory_new(s->ctx, &w->contact, 1, sizeof *w->contact));
    if (implicit_measures_gaps(s)) {
        TRY(memory_new(s->ctx, &w->contact->spot_of, w->grid.size, sizeof *w->contact->spot_of));
    }
    return memory_new(s->ctx, &w->contact->raw, w->components, sizeof *w->contact->raw);
}

void implicit_contact_free(mpm *s)
{
    struct implicit_contact *c = s->implicit->contact;
    if (!c) return;
    void *owned[] = {&c->spot, &c->row, &c->Q, &c->L, &c->raw, &c->spot_of};
    for (size_t k = 0; k < sizeof owned / sizeof *owned; ++k) memory_free(s->ctx, owned[k]);
    memory_free(s->ctx, &s->implicit->contact);
}

static int components_of(const mpm *s)
{
    return s->implicit->layers * s->mesh->dim;
}

static floe_status reserve_contact(mpm *s)
{
    struct implicit_contact *c = s->implicit->contact;
    if (c->spots == c->spots_reserved) {
        c->spots_reserved = c->spots_reserved ? 2 * c->spots_reserved : 64;
        TRY(memory_resize(s->ctx, &c->spot, c->spots_reserved, sizeof *c->spot));
    }
    if (c->rows + SPOT_ROWS <= c->rows_reserved) return FLOE_OK;
    c->rows_reserved = 2 * c->rows_reserved + SPOT_ROWS;
    TRY(memory_resize(s->ctx, &c->row, c->rows_reserved, sizeof *c->row));
    TRY(memory_resize(s->ctx, &c->Q, c->rows_reserved * (size_t)components_of(s), sizeof *c->Q));
    return memory_resize(s->ctx, &c->L, c->rows_reserved * SPOT_ROWS, sizeof *c->L);
}

/* What a node's contact conditions depend on; they have no component that is constrained. */
typedef struct spot_view {
    int dim, layer[2];
    bool constrained[3];
} spot_view;

static void add_contact_row(struct implicit_contact *c, const spot_view *v, const double along[3], double gap, int lead)
{
    contact_spot *spot = &c->spot[c->spots];
    c->row[c->rows++] = (contact_row){.layer = {v->layer[0], v->layer[1]},
                                      .along = {along[0], along[1], along[2]},
                                      .gap = gap,
                                      .lead = lead,
                                      .active = gap <= 0.0};
    spot->rows++;
}

/* Conditions across n, zero: along all axes, that come and go with the one before them, or are there for good. */
static void add_across(struct implicit_contact *c, const spot_view *v, const double n[3], int lead)
{
    double found[3][3];
    int count = 1;
    memcpy(found[0], n, sizeof found[0]);
    for (int axis = 0; axis < v->dim; ++axis) {
        double t[3] = {0.0, 0.0, 0.0}, square = 0.0;
        if (v->constrained[axis] || count > v->dim) continue;
        t[axis] = 1.0;
        for (int k = 0; k < count; ++k) {
            const double part = found[k][axis];
            for (int a = 0; a < 3; ++a) t[a] -= part * found[k][a];
        }
        for (int a = 0; a < 3; ++a) square += t[a] * t[a];
        if (!(square > MPM_CONTACT_DEPENDENT)) continue;
        for (int a = 0; a < 3; ++a) found[count][a] = t[a] / sqrt(square);
        add_contact_row(c, v, found[count], 0.0, lead);
        c->row[c->rows - 1].bound = lead < 0;
        if (count == 2) return; /* no third direction is left */
        count++;
    }
}

static void add_meeting(const mpm *s, const contact_node *node, const contact_meeting *m, const spot_view *v)
{
    static const double none[3] = {0.0, 0.0, 0.0};
    struct implicit_contact *c = s->implicit->contact;
    const contact_kind kind = m->named ? s->scene->contact.kind : CONTACT_STICK;
    const bool met = contact_has_met(node, m), has_normal = m->n[0] != 0.0 || m->n[1] != 0.0 || m->n[2] != 0.0;
    if (met && kind != CONTACT_FRICTION && (kind == CONTACT_STICK || !has_normal)) {
        add_across(c, v, none, -1);
        return;
    }
    if (!has_normal) return;
    add_contact_row(c, v, m->n, met ? 0.0 : m->gap, -1);
    if (met && kind == CONTACT_RELEASE) add_across(c, v, m->n, c->spot[c->spots].rows - 1);
}

static floe_status find_at(mpm *s, const int global[MESH_MAX_DIM], int at)
{
    const struct mpm_implicit *w = s->implicit;
    struct implicit_contact *c = w->contact;
    contact_meeting list[CONTACT_MAX_PAIRS];
    contact_node node;
    int group[MPM_MAX_GROUPS];
    spot_view view = {.dim = s->mesh->dim};
    contact_look(s, owner_of_node(s->mesh, global).block, global, group, &node);
    for (int a = 0; a < s->mesh->dim; ++a)
        node.constrained[a] = view.constrained[a] = w->constrained[implicit_index(w, 0, a, at)];
    const int n = contact_find_meetings(&s->scene->contact, &node, list);
    TRY(reserve_contact(s));
    c->spot[c->spots] = (contact_spot){.node = at, .first = c->rows};
    for (int k = 0; k < n && c->spot[c->spots].rows + s->mesh->dim <= SPOT_ROWS; ++k) {
        view.layer[0] = implicit_layer(s, group[list[k].a]);
        view.layer[1] = implicit_layer(s, group[list[k].b]);
        if (!w->reached[implicit_index(w, view.layer[0], 0, at)] ||
            !w->reached[implicit_index(w, view.layer[1], 0, at)])
            continue;
        add_meeting(s, &node, &list[k], &view);
    }
    if (c->spot[c->spots].rows > 0) c->spots++;
    return FLOE_OK;
}

/* Tangential conditions are active as their normal one is. */
static void bind_led_conditions(struct implicit_contact *c)
{
    for (size_t k = 0; k < c->spots; ++k) {
        contact_row *row = c->row + c->spot[k].first;
        for (int i = 0; i < c->spot[k].rows; ++i)
            if (row[i].lead >= 0) row[i].active = row[row[i].lead].active;
    }
}

static double row_dot(const mpm *s, const contact_row *r, const double *q)
{
    double sum = 0.0;
    for (int a = 0; a < s->mesh->dim; ++a)
        sum += r->along[a] * (q[r->layer[0] * s->mesh->dim + a] - q[r->layer[1] * s->mesh->dim + a]);
    return sum;
}

/* The row of Q of condition i of a node, and of L, from those before it. */
static void orthogonalise_condition(const mpm *s, const contact_spot *spot, int i)
{
    struct implicit_contact *c = s->implicit->contact;
    const int n = components_of(s), dim = s->mesh->dim;
    const contact_row *r = &c->row[spot->first + (size_t)i];
    double *Q = c->Q + spot->first * (size_t)n, *q = Q + i * n, *L = c->L + (spot->first + (size_t)i) * SPOT_ROWS;
    memset(q, 0, (size_t)n * sizeof *q);
    memset(L, 0, SPOT_ROWS * sizeof *L);
    if (!r->active) return;
    for (int a = 0; a < dim; ++a) {
        q[r->layer[0] * dim + a] = r->along[a];
        q[r->layer[1] * dim + a] = -r->along[a];
    }
    for (int j = 0; j < i; ++j) {
        const double *other = Q + j * n;
        for (int k = 0; k < n; ++k) L[j] += q[k] * other[k];
        for (int k = 0; k < n; ++k) q[k] -= L[j] * other[k];
    }
    double square = 0.0;
    for (int k = 0; k < n; ++k) square += q[k] * q[k];
    L[i] = square > MPM_CONTACT_DEPENDENT ? sqrt(square) : 0.0;
    for (int k = 0; k < n; ++k) q[k] = L[i] > 0.0 ? q[k] / L[i] : 0.0;
}

static void settle_conditions(mpm *s)
{
    struct implicit_contact *c = s->implicit->contact;
    bind_led_conditions(c);
    for (size_t k = 0; k < c->spots; ++k)
        for (int i = 0; i < c->spot[k].rows; ++i) orthogonalise_condition(s, &c->spot[k], i);
}

floe_status implicit_contact_find(mpm *s)
{
    const struct mpm_implicit *w = s->implicit;
    struct implicit_contact *c = w->contact;
    int node[MESH_MAX_DIM];
    if (!c) return FLOE_OK;
    c->spots = c->rows = 0;
    for (node[2] = 0; node[2] < w->grid.n[2]; ++node[2])
        for (node[1] = 0; node[1] < w->grid.n[1]; ++node[1])
            for (node[0] = 0; node[0] < w->grid.n[0]; ++node[0]) {
                const int at = (int)solve_index(&w->grid, node[0], node[1], node[2]);
                int layers = 0;
                for (int l = 0; l < w->layers; ++l) layers += w->reached[implicit_index(w, l, 0, at)];
                if (layers > 1) TRY(find_at(s, node, at));
            }
    implicit_contact_measure_gaps(s);
    settle_conditions(s);
    return FLOE_OK;
}

/* All components of a node, from an array and to it. */
static void load_spot(const mpm *s, const contact_spot *spot, const double *x, double *out)
{
    for (int k = 0; k < components_of(s); ++k) out[k] = x[(size_t)k * s->implicit->grid.size + (size_t)spot->node];
}

static void store_spot(const mpm *s, const contact_spot *spot, const double *in, double *x)
{
    for (int k = 0; k < components_of(s); ++k) x[(size_t)k * s->implicit->grid.size + (size_t)spot->node] = in[k];
}

/* out = Q x, and removes that component from x. */
static void split_by_conditions(const mpm *s, const contact_spot *spot, double *x, double out[SPOT_ROWS])
{
    const int n = components_of(s);
    for (int i = 0; i < spot->rows; ++i) {
        const double *q = s->implicit->contact->Q + (spot->first + (size_t)i) * (size_t)n;
        out[i] = 0.0;
        for (int k = 0; k < n; ++k) out[i] += q[k] * x[k];
        for (int k = 0; k < n; ++k) x[k] -= out[i] * q[k];
    }
}

void implicit_contact_project(const mpm *s, double *x)
{
    const struct implicit_contact *c = s->implicit->contact;
    for (size_t k = 0; c && k < c->spots; ++k) {
        double at[NODE_MATRIX_COMPONENTS], taken[SPOT_ROWS];
        load_spot(s, &c->spot[k], x, at);
        split_by_conditions(s, &c->spot[k], at, taken);
        store_spot(s, &c->spot[k], at, x);
    }
}

/* C^T lambda is the part that the projection removes: L^T lambda = Q residual. */
static void find_pushes(const mpm *s, const contact_spot *spot)
{
    const struct implicit_contact *c = s->implicit->contact;
    double at[NODE_MATRIX_COMPONENTS], normal_force[SPOT_ROWS];
    load_spot(s, spot, c->raw, at);
    split_by_conditions(s, spot, at, normal_force);
    for (int i = spot->rows - 1; i >= 0; --i) {
        const double *L = c->L + (spot->first + (size_t)i) * SPOT_ROWS;
        normal_force[i] = L[i] > 0.0 ? normal_force[i] / L[i] : 0.0;
        for (int j = 0; j < i; ++j) normal_force[j] -= L[j] * normal_force[i];
        c->row[spot->first + (size_t)i].normal_force = normal_force[i];
    }
}

void implicit_contact_forces(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    struct implicit_contact *c = w->contact;
    if (!c) return;
    memcpy(c->raw, w->residual, w->components * sizeof *c->raw);
    for (size_t k = 0; k < c->spots; ++k) find_pushes(s, &c->spot[k]);
    implicit_contact_project(s, w->residual);
}

static double largest_gap(const struct mpm_implicit *w, const double *x)
{
    double most = 0.0;
    for (size_t k = 0; k < w->components; ++k) most = fmax(most, fabs(x[k]));
    return most;
}

/* By how much the condition is violated (m). */
static double condition_excess(const mpm *s, const contact_spot *spot, const contact_row *r, const double *u)
{
    double at[NODE_MATRIX_COMPONENTS];
    load_spot(s, spot, u, at);
    return row_dot(s, r, at) - r->gap;
}

bool implicit_contact_update(mpm *s, const double *u)
{
    struct mpm_implicit *w = s->implicit;
    struct implicit_contact *c = w->contact;
    bool changed = false;
    if (!c) return false;
    double most = 0.0;
    for (size_t k = 0; k < c->rows; ++k) most = fmax(most, fabs(c->row[k].normal_force));
    const double tolerated_tension = s->scene->time.tolerance * most, step = MPM_CONTACT_NOTHING * largest_gap(w, u);
    for (size_t k = 0; k < c->spots; ++k)
        for (int i = 0; i < c->spot[k].rows; ++i) {
            contact_row *r = &c->row[c->spot[k].first + (size_t)i];
            if (r->bound || r->lead >= 0) continue;
            const bool binds =
                r->active ? r->normal_force >= -tolerated_tension : condition_excess(s, &c->spot[k], r, u) > step;
            changed = changed || binds != r->active;
            r->active = binds;
        }
    if (!changed) return false;
    settle_conditions(s);
    memcpy(w->residual, c->raw, w->components * sizeof *w->residual);
    implicit_contact_forces(s);
    return true;
}

bool implicit_contact_bind_all(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    struct implicit_contact *c = w->contact;
    bool changed = false;
    for (size_t k = 0; c && k < c->rows; ++k) {
        changed = changed || !c->row[k].active;
        c->row[k].active = true;
    }
    if (!changed) return false;
    settle_conditions(s);
    memcpy(w->residual, c->raw, w->components * sizeof *w->residual);
    implicit_contact_forces(s);
    return true;
}

bool implicit_contact_closing_step(const mpm *s, const double *u, double *step)
{
    const struct implicit_contact *c = s->implicit->contact;
    const int n = components_of(s);
    bool any = false;
    const double least = c ? 1e-2 * MPM_CONTACT_NOTHING * largest_gap(s->implicit, u) : 0.0;
    for (size_t k = 0; c && k < c->spots; ++k) {
        const contact_spot *spot = &c->spot[k];
        double part[SPOT_ROWS], sum[NODE_MATRIX_COMPONENTS] = {0.0};
        for (int i = 0; i < spot->rows; ++i) {
            const contact_row *r = &c->row[spot->first + (size_t)i];
            const double *L = c->L + (spot->first + (size_t)i) * SPOT_ROWS;
            part[i] = 0.0;
            if (!(L[i] > 0.0)) continue;
            part[i] = -condition_excess(s, spot, r, u);
            any = any || fabs(part[i]) > least;
            for (int j = 0; j < i; ++j) part[i] -= L[j] * part[j];
            part[i] /= L[i];
            for (int a = 0; a < n; ++a) sum[a] += part[i] * c->Q[(spot->first + (size_t)i) * (size_t)n + (size_t)a];
        }
        for (int a = 0; a < n; ++a) step[(size_t)a * s->implicit->grid.size + (size_t)spot->node] += sum[a];
    }
    return any;
}

void implicit_contact_project_matrix(const mpm *s, node_matrix *m)
{
    const struct implicit_contact *c = s->implicit->contact;
    const int n = components_of(s);
    for (size_t k = 0; c && k < c->spots; ++k) {
        const contact_spot *spot = &c->spot[k];
        const int row = m->row[spot->node];
        double stiffness = 0.0;
        for (int a = 0; a < n; ++a) stiffness = fmax(stiffness, node_matrix_entries(m, row, a, a)[m->slots / 2]);
        for (int i = 0; i < spot->rows; ++i)
            if (c->L[(spot->first + (size_t)i) * SPOT_ROWS + (size_t)i] > 0.0)
                node_matrix_project(m, row, 1, c->Q + (spot->first + (size_t)i) * (size_t)n, stiffness);
    }
}

void implicit_contact_enter(mpm *s)
{
    const struct implicit_contact *c = s->implicit->contact;
    long long stick = 0, slip = 0, release = 0;
    for (size_t k = 0; c && k < c->spots; ++k) {
        const contact_row *row = c->row + c->spot[k].first;
        for (int i = 0; i < c->spot[k].rows; ++i) {
            const bool led = i + 1 < c->spot[k].rows && row[i + 1].lead == i;
            if (row[i].lead >= 0 || (row[i].bound && i > 0)) continue;
            stick += row[i].active && (row[i].bound || led);
            slip += row[i].active && !row[i].bound && !led;
            release += !row[i].active;
        }
    }
    ledger_tally(s->ledger, COUNT_CONTACT_STICK, stick);
    ledger_tally(s->ledger, COUNT_CONTACT_SLIP, slip);
    ledger_tally(s->ledger, COUNT_CONTACT_RELEASE, release);
}
