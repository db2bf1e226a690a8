#include "mpm/implicit/implicit_walls.h"

#include "base/memory.h"
#include "mpm/implicit/implicit.h"
#include "mpm/implicit/implicit_chunks.h"
#include "mpm/implicit/implicit_constants.h"
#include "mpm/motion/motion_ties.h"
#include "mpm/nodes/node.h"
#include "mpm/nodes/sides.h"
#include "mpm/nodes/supports.h"
#include "mpm/state/stress.h"
#include "solve/skyline.h"

#include <math.h>
#include <string.h>

/* Arrays on the solver's grid, owned. */
struct implicit_walls {
    node_matrix *matrix; /* M + s dt^2 K, with rows of what is fixed */
    skyline *factors;    /* without them */
    bool *fixed;         /* constrained, or without points */
    double *load;        /* N, and N s */
    double *change;      /* m/s: v^L - v by the forces so far */
    double *answer;      /* m/s: by others */
    double *pulled;      /* N s: what the change of constrained nodes does to the others */
};

floe_status stiff_create(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    TRY(memory_new(s->ctx, &w->walls, 1, sizeof *w->walls));
    struct implicit_walls *k = w->walls;
    TRY(node_matrix_create(&k->matrix, s->ctx, &w->grid, s->mesh->dim, implicit_width(s), implicit_arm(s)));
    TRY(skyline_create(&k->factors, s->ctx));
    double **array[] = {&k->load, &k->change, &k->answer, &k->pulled};
    for (size_t n = 0; n < sizeof array / sizeof *array; ++n)
        TRY(memory_new(s->ctx, array[n], w->components, sizeof(double)));
    return memory_new(s->ctx, &k->fixed, w->components, sizeof *k->fixed);
}

void stiff_free(mpm *s)
{
    struct implicit_walls *k = s->implicit->walls;
    if (!k) return;
    node_matrix_destroy(&k->matrix);
    skyline_destroy(&k->factors);
    void *owned[] = {&k->load, &k->change, &k->answer, &k->pulled, &k->fixed};
    for (size_t n = 0; n < sizeof owned / sizeof *owned; ++n) memory_free(s->ctx, owned[n]);
    memory_free(s->ctx, &s->implicit->walls);
}

/* ---- the matrix ---- */

/* V (K - 2/3 G) I I + 2 V G, as large as the fastest wave in the state of the point asks for. */
static void tangent_of_moduli(const struct mpm_implicit *w, double bulk, double shear, double *tangent)
{
    const int n = w->n_gradient;
    const double lame = bulk - 2.0 / 3.0 * shear;
    for (int r = 0; r < n; ++r)
        for (int c = 0; c < n; ++c) {
            const int i = w->gradient[r] / 3, j = w->gradient[r] % 3, k = w->gradient[c] / 3, l = w->gradient[c] % 3;
            const double turned = (i == k && j == l ? shear : 0.0) + (i == l && j == k ? shear : 0.0);
            tangent[r * n + c] = turned + (i == j && k == l ? lame : 0.0);
        }
}

/* Points of a chunk. Laws that yield or relax do so from an elastic step, and none is stiffer than its waves are fast. */
static floe_status stiffen_chunk(mpm *s, int blk, int body, size_t start, size_t end, const double *u, solid_batch *b)
{
    const struct mpm_implicit *w = s->implicit;
    const mpm_body *m = &s->body[body];
    const size_t square = (size_t)w->n_gradient * (size_t)w->n_gradient;
    const double *volume0 = field_get(s->domain->fields[blk], P_VOLUME0, body, 0);
    const double bulk = m->law->bulk_modulus(m->law_par), shear = m->law->shear_modulus(m->law_par);
    double speed[SOLID_CHUNK];
    (void)u;
    if (body >= s->n_deforming) return FLOE_OK;
    load_speed_batch(s, blk, body, start, end, b);
    m->law->wave_speed(m->law_par, s->scene->reference_pressure, b, speed);
    for (size_t k = start; k < end; ++k) {
        const size_t at = k - start;
        const double modulus = b->rho0[at] * speed[at] * speed[at], rest = bulk + 4.0 / 3.0 * shear;
        const double share = volume0[k] * fmax(1.0, modulus / rest);
        tangent_of_moduli(w, share * bulk, share * shear, w->tangent + (w->first[blk][body] + k) * square);
    }
    return FLOE_OK;
}

static void find_fixed(const mpm *s)
{
    const struct mpm_implicit *w = s->implicit;
    for (size_t k = 0; k < w->components; ++k)
        w->walls->fixed[k] = w->constrained[k] || !w->reached[k] || !(w->mass[k % w->grid.size] > 0.0);
}

/* Of the terms of a sum, each may take points as far as the first does (theory 4.2). */
static double stiffness_share(const mpm *s)
{
    return MPM_WALL_STIFFNESS * (s->transfer->restore ? s->order : 1);
}

static void assemble(mpm *s)
{
    const struct mpm_implicit *w = s->implicit;
    node_matrix *m = w->walls->matrix;
    const double share = stiffness_share(s) * s->kick * s->kick;
    const size_t entries = (size_t)m->rows * (size_t)m->slots * (size_t)(m->components * m->components);
    implicit_assemble(s, m, w->tangent);
    implicit_stiffen_edges(s, m);
    for (size_t k = 0; k < entries; ++k) m->value[k] *= share;
    for (int row = 0; row < m->rows; ++row)
        for (int c = 0; c < m->components; ++c)
            node_matrix_entries(m, row, c, c)[m->slots / 2] += w->mass[m->place[row]];
}

/* Constrained nodes take their velocity. */
static void move_constrained(const mpm *s)
{
    const struct mpm_implicit *w = s->implicit;
    struct implicit_walls *k = w->walls;
    for (size_t n = 0; n < w->components; ++n)
        k->change[n] =
            w->constrained[n] && w->reached[n] ? w->prescribed[n] / s->dt - damping_left(s) * w->velocity[n] : 0.0;
    node_matrix_apply(k->matrix, k->change, k->pulled);
}

/* The change of velocity by all that N_FORCE has. */
static void change_by_forces(mpm *s)
{
    const struct mpm_implicit *w = s->implicit;
    struct implicit_walls *k = w->walls;
    memset(k->load, 0, w->components * sizeof *k->load);
    for (int g = 0; g < s->n_deforming_groups; ++g) implicit_collect(s, N_FORCE, g, k->load);
    for (size_t n = 0; n < w->components; ++n) k->answer[n] = s->kick * k->load[n] - k->pulled[n];
    skyline_solve(k->factors, k->answer, k->answer);
    for (size_t n = 0; n < w->components; ++n)
        if (!k->fixed[n]) k->change[n] = k->answer[n];
}

floe_status mpm_find_stiffness(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    struct implicit_walls *k = w->walls;
    if (!walls_are_stiff(s)) return FLOE_OK;
    TRY(implicit_locate(s));
    implicit_constrain(s);
    implicit_find_reached(s);
    TRY(node_matrix_shape(k->matrix, w->row));
    motion_begin(s);
    find_fixed(s);
    TRY(visit_chunks(s, NULL, stiffen_chunk));
    assemble(s);
    TRY(skyline_shape(k->factors, k->matrix, k->fixed));
    TRY(skyline_factor(k->factors, k->matrix));
    move_constrained(s);
    change_by_forces(s);
    return FLOE_OK;
}

floe_status stiff_work(mpm *s, double *work)
{
    struct mpm_implicit *w = s->implicit;
    struct implicit_walls *k = w->walls;
    TRY(implicit_locate(s));
    implicit_find_reached(s);
    TRY(node_matrix_shape(k->matrix, w->row));
    for (size_t n = 0; n < w->components; ++n) k->fixed[n] = !w->reached[n];
    TRY(visit_chunks(s, NULL, stiffen_chunk));
    implicit_assemble(s, k->matrix, w->tangent);
    TRY(skyline_shape(k->factors, k->matrix, k->fixed));
    *work = skyline_work(k->factors);
    return FLOE_OK;
}

bool stiff_meets_free_body(const mpm *s)
{
    const struct mpm_implicit *w = s->implicit;
    for (int blk = 0; blk < s->mesh->n_blocks; ++blk)
        for (int body = s->n_deforming; body < s->n_bodies; ++body)
            for (size_t k = 0; k < s->points[blk][body].n; ++k) {
                weighted_node node[IMPLICIT_NODES];
                if (motion_is_prescribed(&s->scene->body[s->body[body].scene_body].motion)) continue;
                const int n = implicit_nodes(s, &w->weights[w->first[blk][body] + k], node);
                for (int i = 0; i < n; ++i)
                    if (w->row[node[i].at]) return true;
            }
    return false;
}

/* ---- nodes ---- */

static size_t place_on_grid(const mpm *s, const int node[MESH_MAX_DIM])
{
    return (size_t)solve_index(&s->implicit->grid, node[0], node[1], node[2]);
}

void stiff_node(const mpm *s, const int node[MESH_MAX_DIM], double change[3], double give[3])
{
    const struct mpm_implicit *w = s->implicit;
    const struct implicit_walls *k = w->walls;
    const size_t at = place_on_grid(s, node);
    const int row = k->matrix->row[at];
    for (int c = 0; c < s->mesh->dim; ++c) {
        const size_t n = (size_t)c * w->grid.size + at;
        change[c] = k->change[n];
        give[c] =
            row < 0 || k->fixed[n] ? 0.0 : s->kick / node_matrix_entries(k->matrix, row, c, c)[k->matrix->slots / 2];
    }
}

void stiff_begin(const mpm *s)
{
    memset(s->implicit->walls->answer, 0, s->implicit->components * sizeof(double));
}

void stiff_push(const mpm *s, const int node[MESH_MAX_DIM], const double force[3])
{
    const struct mpm_implicit *w = s->implicit;
    for (int c = 0; c < s->mesh->dim; ++c)
        w->walls->answer[(size_t)c * w->grid.size + place_on_grid(s, node)] += s->kick * force[c];
}

void stiff_solve(const mpm *s)
{
    struct implicit_walls *k = s->implicit->walls;
    skyline_solve(k->factors, k->answer, k->answer);
}

void stiff_answer(const mpm *s, const int node[MESH_MAX_DIM], double change[3])
{
    const struct mpm_implicit *w = s->implicit;
    for (int c = 0; c < s->mesh->dim; ++c)
        change[c] = w->walls->answer[(size_t)c * w->grid.size + place_on_grid(s, node)];
}

/* ---- the end of the search ---- */

/* A value of the solver's grid at every copy of its node. */
typedef void copy_visitor(mpm *s, const fields *f, int group, int c, ptrdiff_t at, size_t n);

static void visit_copies(mpm *s, int group, copy_visitor *visit)
{
    const struct mpm_implicit *w = s->implicit;
    const mesh *m = s->mesh;
    for (int blk = 0; blk < m->n_blocks; ++blk) {
        const block *b = &m->block[blk];
        int lo[MESH_MAX_DIM] = {0, 0, 0}, end[MESH_MAX_DIM] = {1, 1, 1};
        for (int a = 0; a < m->dim; ++a) {
            lo[a] = -MESH_GHOST;
            end[a] = b->n[a] + MESH_GHOST;
        }
        for (int k = lo[2]; k < end[2]; ++k)
            for (int j = lo[1]; j < end[1]; ++j)
                for (int i = lo[0]; i < end[0]; ++i) {
                    int node[MESH_MAX_DIM] = {b->lo[0] + i, b->lo[1] + j, b->lo[2] + k};
                    bool inside = true;
                    for (int a = 0; a < m->dim; ++a) {
                        node[a] = mesh_index_around(m, a, node[a]);
                        inside = inside && node[a] >= 0 && node[a] <= m->n[a];
                    }
                    const size_t place = inside ? place_on_grid(s, node) : 0;
                    for (int c = 0; inside && w->row[place] && c < m->dim; ++c)
                        visit(s, s->domain->fields[blk], group, c, mesh_index(b, i, j, k),
                              (size_t)c * w->grid.size + place);
                }
    }
}

static void write_force(mpm *s, const fields *f, int group, int c, ptrdiff_t at, size_t n)
{
    field_get(f, N_FORCE, group, c)[at] = s->implicit->walls->load[n];
}

static bool some_are_led(const mpm *s)
{
    for (size_t k = 0; supports_lead_group(s, 0) && k < s->supports->n; ++k)
        if (s->supports->node[k].led) return true;
    return false;
}

/* The moment of what the stiffness gives to the nodes: what supports have of it. */
static void add_given_moment(const mpm *s, size_t n, double given, double moment[3])
{
    const size_t size = s->implicit->grid.size;
    double x[MESH_MAX_DIM];
    implicit_place(s, n % size, x);
    add_moment(moment, x, (int)(n / size), given);
}

/* Whether images beyond a mirror push along an axis. */
static bool is_mirrored(const mpm *s, int axis)
{
    return !s->mesh->periodic[axis] && (wall_mirrors(s, 0, axis, SIDE_LOWER) || wall_mirrors(s, 0, axis, SIDE_UPPER));
}

static void enter_given(mpm *s, bool led, const double given[MESH_MAX_DIM], const double moment[3])
{
    for (int a = 0; a < s->mesh->dim; ++a)
        if (led || is_mirrored(s, a))
            ledger_add(s->ledger, (ledger_quantity)(LEDGER_MOMENTUM_X + a), LEDGER_BOUNDARY, given[a]);
    ledger_turn(s->ledger, LEDGER_BOUNDARY, moment, 1.0);
}

/* A fixed body that alone holds solids has all of it. */
static void pull_body(mpm *s, const double given[MESH_MAX_DIM], const double moment[3])
{
    static const double origin[3] = {0.0, 0.0, 0.0};
    double taken[3] = {0.0}, turned[3];
    for (int a = 0; a < s->mesh->dim; ++a) taken[a] = -given[a];
    for (int a = 0; a < 3; ++a) turned[a] = -moment[a];
    motion_pull_fixed(s, s->supports->region[0].body, origin, taken, turned);
}

/* The forces with that of the stiffness. Free nodes get what their change of velocity takes, to the bit. */
void stiff_take(mpm *s)
{
    const struct mpm_implicit *w = s->implicit;
    struct implicit_walls *k = w->walls;
    double work = 0.0, given[MESH_MAX_DIM] = {0.0}, moment[3] = {0.0};
    const bool led = some_are_led(s);
    change_by_forces(s);
    node_matrix_apply(k->matrix, k->change, k->answer);
    for (size_t n = 0; n < w->components; ++n) {
        const double taken = w->mass[n % w->grid.size] * k->change[n];
        const double force = k->fixed[n] ? k->load[n] + (taken - k->answer[n]) / s->kick : taken / s->kick;
        if (w->reached[n]) given[n / w->grid.size] += s->kick * (force - k->load[n]);
        if (w->reached[n] && led) add_given_moment(s, n, s->kick * (force - k->load[n]), moment);
        if (w->reached[n]) work += s->kick * (force - k->load[n]) * (w->velocity[n] + 0.5 * k->change[n]);
        k->load[n] = force;
    }
    for (int g = 0; g < s->n_deforming_groups; ++g) visit_copies(s, g, write_force);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_DAMPING, work);
    if (supports_lead_by_body(s))
        pull_body(s, given, moment);
    else
        enter_given(s, led, given, moment);
}

static void write_lightest(mpm *s, const fields *f, int group, int c, ptrdiff_t at, size_t n)
{
    const struct mpm_implicit *w = s->implicit;
    if (field_get(f, N_MASS, group, 0)[at] > small_node(s) || w->walls->fixed[n]) return;
    field_get(f, N_VEL_L, group, c)[at] = damping_left(s) * w->velocity[n] + w->walls->change[n];
    field_get(f, N_ACCEL, group, c)[at] = w->walls->change[n] / s->kick;
}

void stiff_lightest(mpm *s, int group)
{
    visit_copies(s, group, write_lightest);
}
