/* Contact in the balance of forces: what binds, and what it takes of displacements and forces. */
#include "mpm/balance/balance_contact.h"

#include "base/memory.h"
#include "mpm/contact/contact.h"

#include <math.h>
#include <string.h>

/* What counts as nothing: of displacements, as a share of the largest; of the length of a condition that others nearly
 * make up. */
static const double little = 1e-7, dependent = 1e-6;

const char *contact_rest_obstacle(const mpm *s)
{
    if (!s->contact) return NULL;
    if (s->coupled || s->seals) return "bodies are in contact beside fluids on cells";
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

floe_status contact_rest_create(mpm *s)
{
    struct mpm_balance *w = s->balance;
    if (!s->contact) return FLOE_OK;
    TRY(memory_new(s->ctx, &w->contact, 1, sizeof *w->contact));
    if (balance_measures_gaps(s)) {
        TRY(memory_new(s->ctx, &w->contact->spot_of, w->grid.size, sizeof *w->contact->spot_of));
    }
    return memory_new(s->ctx, &w->contact->raw, w->components, sizeof *w->contact->raw);
}

void contact_rest_free(mpm *s)
{
    struct balance_contact *c = s->balance->contact;
    if (!c) return;
    void *owned[] = {&c->spot, &c->row, &c->Q, &c->L, &c->raw, &c->spot_of};
    for (size_t k = 0; k < sizeof owned / sizeof *owned; ++k) memory_free(s->ctx, owned[k]);
    memory_free(s->ctx, &s->balance->contact);
}

static int components_of(const mpm *s)
{
    return s->balance->layers * s->mesh->dim;
}

static floe_status reserve(mpm *s)
{
    struct balance_contact *c = s->balance->contact;
    if (c->spots == c->spot_room) {
        c->spot_room = c->spot_room ? 2 * c->spot_room : 64;
        TRY(memory_resize(s->ctx, &c->spot, c->spot_room, sizeof *c->spot));
    }
    if (c->rows + SPOT_ROWS <= c->row_room) return FLOE_OK;
    c->row_room = 2 * c->row_room + SPOT_ROWS;
    TRY(memory_resize(s->ctx, &c->row, c->row_room, sizeof *c->row));
    TRY(memory_resize(s->ctx, &c->Q, c->row_room * (size_t)components_of(s), sizeof *c->Q));
    return memory_resize(s->ctx, &c->L, c->row_room * SPOT_ROWS, sizeof *c->L);
}

/* A node, as it is looked at: components that nothing holds. */
typedef struct spot_view {
    int dim, layer[2];
    bool held[3];
} spot_view;

static void add_row(struct balance_contact *c, const spot_view *v, const double along[3], double gap, int lead)
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
static void add_across(struct balance_contact *c, const spot_view *v, const double n[3], int lead)
{
    double found[3][3];
    int count = 1;
    memcpy(found[0], n, sizeof found[0]);
    for (int axis = 0; axis < v->dim; ++axis) {
        double t[3] = {0.0, 0.0, 0.0}, square = 0.0;
        if (v->held[axis] || count > v->dim) continue;
        t[axis] = 1.0;
        for (int k = 0; k < count; ++k) {
            const double part = found[k][axis];
            for (int a = 0; a < 3; ++a) t[a] -= part * found[k][a];
        }
        for (int a = 0; a < 3; ++a) square += t[a] * t[a];
        if (!(square > dependent)) continue;
        for (int a = 0; a < 3; ++a) found[count][a] = t[a] / sqrt(square);
        add_row(c, v, found[count], 0.0, lead);
        c->row[c->rows - 1].bound = lead < 0;
        if (count == 2) return; /* no third direction is left */
        count++;
    }
}

static void add_meeting(const mpm *s, const contact_node *node, const contact_meeting *m, const spot_view *v)
{
    static const double none[3] = {0.0, 0.0, 0.0};
    struct balance_contact *c = s->balance->contact;
    const contact_kind kind = m->named ? s->scene->contact.kind : CONTACT_STICK;
    const bool met = contact_has_met(node, m), has_normal = m->n[0] != 0.0 || m->n[1] != 0.0 || m->n[2] != 0.0;
    if (met && kind != CONTACT_FRICTION && (kind == CONTACT_STICK || !has_normal)) {
        add_across(c, v, none, -1);
        return;
    }
    if (!has_normal) return;
    add_row(c, v, m->n, met ? 0.0 : m->gap, -1);
    if (met && kind == CONTACT_RELEASE) add_across(c, v, m->n, c->spot[c->spots].rows - 1);
}

static floe_status find_at(mpm *s, const int global[MESH_MAX_DIM], int at)
{
    const struct mpm_balance *w = s->balance;
    struct balance_contact *c = w->contact;
    contact_meeting list[CONTACT_MAX_PAIRS];
    contact_node node;
    int cell[MESH_MAX_DIM], group[MPM_MAX_GROUPS];
    spot_view view = {.dim = s->mesh->dim};
    for (int a = 0; a < MESH_MAX_DIM; ++a)
        cell[a] = a < s->mesh->dim && global[a] == s->mesh->n[a] ? global[a] - 1 : global[a];
    contact_look(s, mesh_block_of(s->mesh, cell), global, group, &node);
    for (int a = 0; a < s->mesh->dim; ++a) node.held[a] = view.held[a] = w->held[balance_at(w, 0, a, at)];
    const int n = contact_find_meetings(&s->scene->contact, &node, list);
    TRY(reserve(s));
    c->spot[c->spots] = (contact_spot){.node = at, .first = c->rows};
    for (int k = 0; k < n && c->spot[c->spots].rows + s->mesh->dim <= SPOT_ROWS; ++k) {
        view.layer[0] = balance_layer(s, group[list[k].a]);
        view.layer[1] = balance_layer(s, group[list[k].b]);
        if (!w->reached[balance_at(w, view.layer[0], 0, at)] || !w->reached[balance_at(w, view.layer[1], 0, at)])
            continue;
        add_meeting(s, &node, &list[k], &view);
    }
    if (c->spot[c->spots].rows > 0) c->spots++;
    return FLOE_OK;
}

/* Conditions that others lead bind as those do. */
static void follow(struct balance_contact *c)
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
static void orthogonalise(const mpm *s, const contact_spot *spot, int i)
{
    struct balance_contact *c = s->balance->contact;
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
    L[i] = square > dependent ? sqrt(square) : 0.0;
    for (int k = 0; k < n; ++k) q[k] = L[i] > 0.0 ? q[k] / L[i] : 0.0;
}

static void settle(mpm *s)
{
    struct balance_contact *c = s->balance->contact;
    follow(c);
    for (size_t k = 0; k < c->spots; ++k)
        for (int i = 0; i < c->spot[k].rows; ++i) orthogonalise(s, &c->spot[k], i);
}

floe_status contact_rest_find(mpm *s)
{
    const struct mpm_balance *w = s->balance;
    struct balance_contact *c = w->contact;
    int node[MESH_MAX_DIM];
    if (!c) return FLOE_OK;
    c->spots = c->rows = 0;
    for (node[2] = 0; node[2] < w->grid.n[2]; ++node[2])
        for (node[1] = 0; node[1] < w->grid.n[1]; ++node[1])
            for (node[0] = 0; node[0] < w->grid.n[0]; ++node[0]) {
                const int at = (int)solve_index(&w->grid, node[0], node[1], node[2]);
                int layers = 0;
                for (int l = 0; l < w->layers; ++l) layers += w->reached[balance_at(w, l, 0, at)];
                if (layers > 1) TRY(find_at(s, node, at));
            }
    contact_gap_measure(s);
    settle(s);
    return FLOE_OK;
}

/* All components of a node, from an array and to it. */
static void load_spot(const mpm *s, const contact_spot *spot, const double *x, double *out)
{
    for (int k = 0; k < components_of(s); ++k) out[k] = x[(size_t)k * s->balance->grid.size + (size_t)spot->node];
}

static void store_spot(const mpm *s, const contact_spot *spot, const double *in, double *x)
{
    for (int k = 0; k < components_of(s); ++k) x[(size_t)k * s->balance->grid.size + (size_t)spot->node] = in[k];
}

/* out = Q x; and x without that part. */
static void split(const mpm *s, const contact_spot *spot, double *x, double out[SPOT_ROWS])
{
    const int n = components_of(s);
    for (int i = 0; i < spot->rows; ++i) {
        const double *q = s->balance->contact->Q + (spot->first + (size_t)i) * (size_t)n;
        out[i] = 0.0;
        for (int k = 0; k < n; ++k) out[i] += q[k] * x[k];
        for (int k = 0; k < n; ++k) x[k] -= out[i] * q[k];
    }
}

void contact_rest_project(const mpm *s, double *x)
{
    const struct balance_contact *c = s->balance->contact;
    for (size_t k = 0; c && k < c->spots; ++k) {
        double at[NODE_MATRIX_COMPONENTS], taken[SPOT_ROWS];
        load_spot(s, &c->spot[k], x, at);
        split(s, &c->spot[k], at, taken);
        store_spot(s, &c->spot[k], at, x);
    }
}

/* C^T push is what the projection takes: L^T push = Q left. */
static void find_pushes(const mpm *s, const contact_spot *spot)
{
    const struct balance_contact *c = s->balance->contact;
    double at[NODE_MATRIX_COMPONENTS], push[SPOT_ROWS];
    load_spot(s, spot, c->raw, at);
    split(s, spot, at, push);
    for (int i = spot->rows - 1; i >= 0; --i) {
        const double *L = c->L + (spot->first + (size_t)i) * SPOT_ROWS;
        push[i] = L[i] > 0.0 ? push[i] / L[i] : 0.0;
        for (int j = 0; j < i; ++j) push[j] -= L[j] * push[i];
        c->row[spot->first + (size_t)i].push = push[i];
    }
}

void contact_rest_take(mpm *s)
{
    struct mpm_balance *w = s->balance;
    struct balance_contact *c = w->contact;
    if (!c) return;
    memcpy(c->raw, w->left, w->components * sizeof *c->raw);
    for (size_t k = 0; k < c->spots; ++k) find_pushes(s, &c->spot[k]);
    contact_rest_project(s, w->left);
}

static double largest(const struct mpm_balance *w, const double *x)
{
    double most = 0.0;
    for (size_t k = 0; k < w->components; ++k) most = fmax(most, fabs(x[k]));
    return most;
}

/* What the condition is broken by (m). */
static double excess(const mpm *s, const contact_spot *spot, const contact_row *r, const double *u)
{
    double at[NODE_MATRIX_COMPONENTS];
    load_spot(s, spot, u, at);
    return row_dot(s, r, at) - r->gap;
}

bool contact_rest_decide(mpm *s, const double *u)
{
    struct mpm_balance *w = s->balance;
    struct balance_contact *c = w->contact;
    bool changed = false;
    if (!c) return false;
    double most = 0.0;
    for (size_t k = 0; k < c->rows; ++k) most = fmax(most, fabs(c->row[k].push));
    const double pull = s->scene->time.tolerance * most, way = little * largest(w, u);
    for (size_t k = 0; k < c->spots; ++k)
        for (int i = 0; i < c->spot[k].rows; ++i) {
            contact_row *r = &c->row[c->spot[k].first + (size_t)i];
            if (r->bound || r->lead >= 0) continue;
            const bool binds = r->active ? r->push >= -pull : excess(s, &c->spot[k], r, u) > way;
            changed = changed || binds != r->active;
            r->active = binds;
        }
    if (!changed) return false;
    settle(s);
    memcpy(w->left, c->raw, w->components * sizeof *w->left);
    contact_rest_take(s);
    return true;
}

bool contact_rest_close(mpm *s)
{
    struct mpm_balance *w = s->balance;
    struct balance_contact *c = w->contact;
    bool changed = false;
    for (size_t k = 0; c && k < c->rows; ++k) {
        changed = changed || !c->row[k].active;
        c->row[k].active = true;
    }
    if (!changed) return false;
    settle(s);
    memcpy(w->left, c->raw, w->components * sizeof *w->left);
    contact_rest_take(s);
    return true;
}

bool contact_rest_way(const mpm *s, const double *u, double *way)
{
    const struct balance_contact *c = s->balance->contact;
    const int n = components_of(s);
    bool any = false;
    const double least = c ? 1e-2 * little * largest(s->balance, u) : 0.0;
    for (size_t k = 0; c && k < c->spots; ++k) {
        const contact_spot *spot = &c->spot[k];
        double part[SPOT_ROWS], sum[NODE_MATRIX_COMPONENTS] = {0.0};
        for (int i = 0; i < spot->rows; ++i) {
            const contact_row *r = &c->row[spot->first + (size_t)i];
            const double *L = c->L + (spot->first + (size_t)i) * SPOT_ROWS;
            part[i] = 0.0;
            if (!(L[i] > 0.0)) continue;
            part[i] = -excess(s, spot, r, u);
            any = any || fabs(part[i]) > least;
            for (int j = 0; j < i; ++j) part[i] -= L[j] * part[j];
            part[i] /= L[i];
            for (int a = 0; a < n; ++a) sum[a] += part[i] * c->Q[(spot->first + (size_t)i) * (size_t)n + (size_t)a];
        }
        for (int a = 0; a < n; ++a) way[(size_t)a * s->balance->grid.size + (size_t)spot->node] += sum[a];
    }
    return any;
}

void contact_rest_stiffen(const mpm *s, node_matrix *m)
{
    const struct balance_contact *c = s->balance->contact;
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

void contact_rest_enter(mpm *s)
{
    const struct balance_contact *c = s->balance->contact;
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
