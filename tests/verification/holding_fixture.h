/* What a simulation holds, told so that it can be compared with that of a scene that is another one in form only: points by where they
 * were at the start and of what material, cells by their place. */
#ifndef TESTS_VERIFICATION_HOLDING_FIXTURE_H
#define TESTS_VERIFICATION_HOLDING_FIXTURE_H

#include "coupled_fixture.h"
#include "map_fixture.h"

enum { HOLDING_FIELDS = FIELD_COUNT, HOLDING_MATERIALS = SCENE_MAX_MATERIALS + 1 };

/* Arrays are malloc'ed; NULL: there is none. Of cells by material of the scene, the last for what all share. */
typedef struct holding {
    int dim, n[3];
    size_t points, cells;
    int *material;                    /* of points */
    double *point[HOLDING_FIELDS][9]; /* NAN where a body lacks the field */
    double *cell[HOLDING_FIELDS][HOLDING_MATERIALS][3];
    double time, step, speed; /* s, s; m/s: a cell in a step */
    double density;           /* kg/m3: the largest */
    double size;              /* m: of the domain */
} holding;

FIXTURE double *holding_reserve(size_t n)
{
    double *x = malloc((n + 1) * sizeof *x);
    assert_non_null(x);
    for (size_t k = 0; k < n; ++k) x[k] = (double)NAN;
    return x;
}

FIXTURE bool is_enclosed_gas(field_id id)
{
    const field_info *info = field_describe(id);
    return (info->class == FIELD_STATE || info->class == FIELD_FIXED) && id != P_ID;
}

FIXTURE void hold_body(holding *h, const sim *s, int body, size_t start, const point_list *list)
{
    for (size_t k = 0; k < list->n; ++k) h->material[start + k] = s->mpm->body[body].scene_material;
    for (int id = 0; id < FIELD_COUNT; ++id) {
        const field_info *info = field_describe((field_id)id);
        if (info->centring != FIELD_POINT || !is_enclosed_gas((field_id)id)) continue;
        if (!fields_has(s->domain->fields[0], (field_id)id, body)) continue;
        for (int c = 0; c < field_component_count(info->components, h->dim); ++c) {
            if (!h->point[id][c]) h->point[id][c] = holding_reserve(h->points);
            gather_points(s, list, (field_id)id, c, 1, h->point[id][c] + start);
        }
    }
}

FIXTURE void hold_points(holding *h, const sim *s)
{
    for (int pass = 0; pass < 2 && s->mpm; ++pass) {
        size_t start = 0;
        if (pass == 1) h->material = malloc((h->points + 1) * sizeof *h->material);
        for (int b = 0; b < s->mpm->n_bodies; ++b) {
            point_list list;
            check_ok(s->ctx, point_list_make(&list, s, b));
            if (pass == 1) hold_body(h, s, b, start, &list);
            start += list.n;
            point_list_free(s->ctx, &list);
        }
        h->points = start;
    }
}

FIXTURE void hold_cells(holding *h, const sim *s)
{
    for (int id = 0; id < FIELD_COUNT && s->ice; ++id) {
        const field_info *info = field_describe((field_id)id);
        if (info->centring != FIELD_CELL || !is_enclosed_gas((field_id)id)) continue;
        const bool shared = id == C_PRESSURE || id == C_PRESSURE_STEP;
        for (int r = 0; r < (shared ? 1 : s->ice->n_materials); ++r) {
            if (!fields_has(s->domain->fields[0], (field_id)id, r)) continue;
            const int to = shared ? SCENE_MAX_MATERIALS : s->ice->material[r].scene_material;
            for (int c = 0; c < field_component_count(info->components, h->dim); ++c) {
                h->cell[id][to][c] = holding_reserve(h->cells);
                gather_cells(s, (field_id)id, r, c, 1, h->cell[id][to][c]);
            }
        }
    }
}

/* A fluid of which a cell holds nothing has no velocity, energy or specific volume: what stands there is of what was dropped, if any ever
 * came. */
FIXTURE void forget_absent(holding *h)
{
    for (int id = 0; id < FIELD_COUNT; ++id)
        for (int r = 0; r < SCENE_MAX_MATERIALS && id != C_RHO; ++r)
            for (int c = 0; c < 3 && h->cell[id][r][c] && h->cell[C_RHO][r][0]; ++c)
                for (size_t k = 0; k < h->cells; ++k)
                    if (h->cell[C_RHO][r][0][k] == 0.0) h->cell[id][r][c][k] = 0.0;
}

FIXTURE holding hold(const sim *s)
{
    holding h = {.dim = s->mesh.dim, .cells = mesh_cells(&s->mesh), .time = s->time, .step = s->dt};
    double least = INFINITY;
    for (int a = 0; a < 3; ++a) h.n[a] = s->mesh.n[a];
    for (int a = 0; a < h.dim; ++a) {
        least = fmin(least, s->mesh.h[a]);
        h.size = fmax(h.size, fmax(fabs(s->mesh.lower[a]), fabs(s->mesh.upper[a])));
    }
    h.speed = s->dt > 0.0 ? least / s->dt : 0.0;
    hold_points(&h, s);
    hold_cells(&h, s);
    forget_absent(&h);
    for (size_t k = 0; k < h.points; ++k) h.density = fmax(h.density, h.point[P_MASS][0][k] / h.point[P_VOLUME0][0][k]);
    for (int r = 0; r < SCENE_MAX_MATERIALS; ++r)
        for (size_t k = 0; k < h.cells && h.cell[C_RHO][r][0]; ++k) h.density = fmax(h.density, h.cell[C_RHO][r][0][k]);
    return h;
}

FIXTURE void holding_free(holding *h)
{
    double **all = &h->point[0][0];
    for (size_t k = 0; k < sizeof h->point / sizeof(double *); ++k) free(all[k]);
    all = &h->cell[0][0][0];
    for (size_t k = 0; k < sizeof h->cell / sizeof(double *); ++k) free(all[k]);
    free(h->material);
    memset(h, 0, sizeof *h);
}

/* ---- who is who ---- */

/* How a changed scene goes with the first: the map, and which material is which. */
typedef struct transformation {
    scene_map map;
    int material[SCENE_MAX_MATERIALS]; /* of the first scene, by that of the changed one; -1: none */
    double depth;  /* m: of the changed scene, one cell thick, where the first has two axes; else 1 */
    long moved[3]; /* cells by which all was moved along periodic axes */
} transformation;

/* Sorts indices by these numbers. */
static const double *sort_by;

FIXTURE int by_number(const void *a, const void *b)
{
    const double x = sort_by[*(const size_t *)a], y = sort_by[*(const size_t *)b];
    return (x > y) - (x < y);
}

/* For each point of `changed` that of `first`, by its place mapped back; false where there is none within `reach` or two have the same. */
FIXTURE bool match_points(const holding *first, const holding *changed, const transformation *k, double reach,
                          size_t *partner)
{
    if (first->points != changed->points) return false;
    size_t *order = malloc((first->points + 1) * sizeof *order);
    bool *taken = calloc(first->points + 1, sizeof *taken), fine = true;
    for (size_t i = 0; i < first->points; ++i) order[i] = i;
    sort_by = first->point[P_POS][0];
    if (first->points > 0) qsort(order, first->points, sizeof *order, by_number);
    for (size_t i = 0; i < changed->points && fine; ++i) {
        double x[3] = {0.0}, old[3];
        for (int a = 0; a < changed->dim; ++a) x[a] = changed->point[P_POS][a][i];
        map_back(&k->map, x, old);
        size_t lo = 0, hi = first->points, best = first->points;
        while (lo < hi) {
            const size_t middle = (lo + hi) / 2;
            if (sort_by[order[middle]] < old[0] - reach)
                lo = middle + 1;
            else
                hi = middle;
        }
        double nearest = reach;
        for (; lo < first->points && sort_by[order[lo]] <= old[0] + reach; ++lo) {
            double apart = 0.0;
            for (int a = 0; a < first->dim; ++a) apart = fmax(apart, fabs(first->point[P_POS][a][order[lo]] - old[a]));
            if (apart > nearest || taken[order[lo]]) continue;
            if (first->material[order[lo]] != k->material[changed->material[i]]) continue;
            nearest = apart;
            best = order[lo];
        }
        fine = best < first->points;
        if (fine) taken[best] = true;
        partner[i] = best;
    }
    free(order);
    free(taken);
    return fine;
}

/* For each cell of `changed` that of `first`. */
FIXTURE void match_cells(const holding *first, const holding *changed, const transformation *k, size_t *partner)
{
    for (size_t c = 0; c < changed->cells; ++c) {
        const long at[3] = {(long)(c % (size_t)changed->n[0]), (long)(c / (size_t)changed->n[0]) % changed->n[1],
                            (long)(c / ((size_t)changed->n[0] * (size_t)changed->n[1]))};
        long old[3] = {0};
        for (int a = 0; a < first->dim; ++a) {
            const long i = (at[a] - k->moved[a] + changed->n[a]) % changed->n[a];
            old[k->map.from[a]] = k->map.sign[a] > 0.0 ? i : changed->n[a] - 1 - i;
        }
        partner[c] = ((size_t)old[2] * (size_t)first->n[1] + (size_t)old[1]) * (size_t)first->n[0] + (size_t)old[0];
    }
}

/* ---- how far apart ---- */

/* Row and column of component c of a tensor field (field_list.h). */
FIXTURE void pair_of(field_components components, int dim, int c, int *i, int *j)
{
    static const int row[] = {0, 1, 2, 0, 1, 2}, column[] = {0, 1, 2, 1, 2, 0};
    if (components == FIELD_STRESS) {
        *i = row[c];
        *j = column[c];
    } else if (components == FIELD_DEFORM && (dim == 1 || (dim == 2 && c == 4))) {
        *i = *j = dim == 1 ? c : 2;
    } else {
        *i = c / dim;
        *j = c % dim;
    }
}

/* The component that has this row and column, -1 if there is none. */
FIXTURE int component_at(field_components components, int dim, int row, int column)
{
    for (int c = 0; c < field_component_count(components, dim); ++c) {
        int i, j;
        pair_of(components, dim, c, &i, &j);
        if ((i == row && j == column) || (components == FIELD_STRESS && i == column && j == row)) return c;
    }
    return -1;
}

enum { NOT_COMPARED = -2, MUST_VANISH = -1 };

/* Component of the first scene's field that is component c of the changed one's, and its sign; 0: the sign is left open. Across a slab
 * what points carry, and so what their stress is found to give, is round-off times the square of its depth over a cell's (mpm/transfer/
 * carry.c): mirrors stop it, and velocities across have to vanish. */
FIXTURE int component_of(field_id id, const transformation *k, int dim, int c, double *sign)
{
    const scene_map *m = &k->map;
    const field_info *info = field_describe(id);
    *sign = 1.0;
    if (info->components == FIELD_SCALAR) return c;
    if (info->components == FIELD_VECTOR) {
        if (c >= m->dim) return id == P_HALF || id == C_STRESS_ACCEL ? NOT_COMPARED : MUST_VANISH;
        const bool directed = id == P_TANGENT || id == P_NORMAL || id == P_SURFACE_1 || id == P_SURFACE_2;
        *sign = id == P_HALF ? 1.0 : directed ? 0.0 : m->sign[c];
        return m->from[c];
    }
    int i, j;
    pair_of(info->components, dim, c, &i, &j);
    if (id == P_AFFINE && i >= m->dim && j < m->dim) return NOT_COMPARED;
    *sign = (i < m->dim ? m->sign[i] : 1.0) * (j < m->dim ? m->sign[j] : 1.0);
    const int old = component_at(info->components, m->dim, i < m->dim ? m->from[i] : i, j < m->dim ? m->from[j] : j);
    return old < 0 ? MUST_VANISH : old;
}

/* The size that a difference of a field is over: its largest number, or what waves of a cell a step would make. */
FIXTURE double size_of_field(const holding *h, field_id id, double largest)
{
    const char *unit = field_describe(id)->unit;
    if (strcmp(unit, "m/s") == 0) return fmax(largest, h->speed);
    if (strcmp(unit, "Pa") == 0) return fmax(largest, h->density * h->speed * h->speed);
    if (strcmp(unit, "J/kg") == 0) return fmax(largest, h->speed * h->speed);
    if (strcmp(unit, "m") == 0) return fmax(largest, h->size);
    if (strcmp(unit, "1/s") == 0 && h->step > 0.0) return fmax(largest, 1.0 / h->step);
    if (strcmp(unit, "1") == 0) return fmax(largest, 1.0);
    return largest;
}

typedef struct apart {
    double worst; /* over the size of the field */
    const char *field;
} apart;

/* The largest number of a field's components, which what has to vanish is over. */
FIXTURE double largest_of(double *const *component, int components, size_t n)
{
    double largest = 0.0;
    for (int c = 0; c < components; ++c)
        for (size_t i = 0; i < n && component[c]; ++i) largest = fmax(largest, fabs(component[c][i]));
    return largest;
}

/* `largest`: what the field's largest number is at least. */
FIXTURE void compare_arrays(apart *out, const holding *h, field_id id, const double *first, const double *changed,
                            double sign, double depth, size_t n, const size_t *partner, double largest)
{
    const char *unit = field_describe(id)->unit;
    const double share = strcmp(unit, "kg") == 0 || strcmp(unit, "m3") == 0 ? 1.0 / depth : 1.0;
    double worst = 0.0;
    for (size_t i = 0; i < n; ++i) {
        const double a = first ? first[partner[i]] : 0.0, b = share * changed[i];
        if (isnan(a) && isnan(b)) continue;
        largest = fmax(largest, fabs(a));
        const double off = sign == 0.0 ? fabs(fabs(a) - fabs(b)) : fabs(sign * a - b);
        if (!(off <= worst)) worst = off;
    }
    if (worst == 0.0) return;
    const double relative = worst / size_of_field(h, id, largest);
    if (relative <= out->worst) return;
    out->worst = isnan(relative) ? (double)INFINITY : relative;
    out->field = field_describe(id)->name;
}

/* How far what they hold is apart, over the size of the field; places are in the velocities and strains. */
FIXTURE apart holdings_apart(const holding *first, const holding *changed, const transformation *k,
                             const size_t *points, const size_t *cells)
{
    apart out = {0};
    for (int id = 0; id < FIELD_COUNT; ++id)
        for (int c = 0; c < 9; ++c) {
            double sign;
            if (!changed->point[id][c] || id == P_REST || id == P_POS) continue;
            const int old = component_of((field_id)id, k, changed->dim, c, &sign);
            if (old == NOT_COMPARED || (old >= 0 && !first->point[id][old])) continue;
            compare_arrays(&out, first, (field_id)id, old < 0 ? NULL : first->point[id][old], changed->point[id][c],
                           sign, k->depth, changed->points, points,
                           old < 0 ? largest_of(first->point[id], 9, first->points) : 0.0);
        }
    for (int id = 0; id < FIELD_COUNT; ++id)
        for (int r = 0; r < HOLDING_MATERIALS; ++r)
            for (int c = 0; c < 3; ++c) {
                double sign;
                const int was = r == SCENE_MAX_MATERIALS ? r : k->material[r];
                if (!changed->cell[id][r][c] || was < 0) continue;
                const int old = component_of((field_id)id, k, changed->dim, c, &sign);
                if (old == NOT_COMPARED || (old >= 0 && !first->cell[id][was][old])) continue;
                compare_arrays(&out, first, (field_id)id, old < 0 ? NULL : first->cell[id][was][old],
                               changed->cell[id][r][c], sign, k->depth, changed->cells, cells,
                               old < 0 ? largest_of(first->cell[id][was], 3, first->cells) : 0.0);
            }
    const double late = fabs(first->time - changed->time) / fmax(first->time, 1e-300);
    if (!(late <= out.worst)) out = (apart){late, "time"};
    return out;
}

#endif
