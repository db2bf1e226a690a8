#include "run/spoil.h"

#include "io/gather.h"
#include "run/measure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name;
    double motion, velocity; /* NAN: velocities as at the start */
} table[] = {
#define SPOILER_ENTRY(enumerator, name, motion, velocity, doc) [enumerator] = {name, motion, velocity},
    SPOILER_LIST(SPOILER_ENTRY)
#undef SPOILER_ENTRY
};

const char *spoiler_name(spoiler kind)
{
    return (size_t)kind < SPOILER_COUNT ? table[kind].name : "";
}

spoiler spoiler_find(const char *name, size_t length)
{
    for (size_t k = 0; k < SPOILER_COUNT; k++)
        if (strlen(table[k].name) == length && strncmp(table[k].name, name, length) == 0) return (spoiler)k;
    return SPOILER_COUNT;
}

static double mixed_value(spoiler kind, bool is_velocity, double start, double end)
{
    if (!is_velocity) return start + table[kind].motion * (end - start);
    return isnan(table[kind].velocity) ? start : table[kind].velocity * end;
}

/* ---- fields ---- */

/* The state at the end is kept in the arrays of the next step, which nobody needs between steps. */
static floe_status keep_cells(void *user, field_id id, int instance)
{
    const sim *s = user;
    const field_info *info = field_describe(id);
    if (info->class != FIELD_STATE || info->centring == FIELD_POINT) return FLOE_OK;
    for (int b = 0; b < s->mesh.n_blocks; b++)
        for (int c = 0; c < field_component_count(info->components, s->mesh.dim); c++) {
            const fields *f = s->domain->fields[b];
            memcpy(field_next(f, id, instance, c), field_get(f, id, instance, c),
                   s->mesh.block[b].size * sizeof(double));
        }
    return FLOE_OK;
}

static floe_status save_points(void *user, field_id id, int instance)
{
    const sim *s = user;
    const field_info *info = field_describe(id);
    if (info->class != FIELD_STATE || info->centring != FIELD_POINT) return FLOE_OK;
    for (int b = 0; b < s->mesh.n_blocks; b++)
        for (int c = 0; c < field_component_count(info->components, s->mesh.dim); c++) {
            const fields *f = s->domain->fields[b];
            memcpy(field_next(f, id, instance, c), field_get(f, id, instance, c),
                   s->mpm->points[b][instance].n * sizeof(double));
        }
    return FLOE_OK;
}

typedef struct mixing {
    const sim *start, *end;
    spoiler kind;
    point_list from, to; /* of the body in progress, at the start and at the end */
} mixing;

static floe_status mix_cells(void *user, field_id id, int instance)
{
    const mixing *m = user;
    const field_info *info = field_describe(id);
    if (info->class != FIELD_STATE || info->centring == FIELD_POINT) return FLOE_OK;
    for (int b = 0; b < m->end->mesh.n_blocks; b++)
        for (int c = 0; c < field_component_count(info->components, m->end->mesh.dim); c++) {
            const double *start = field_get(m->start->domain->fields[b], id, instance, c);
            const double *end = field_next(m->end->domain->fields[b], id, instance, c);
            double *to = field_get(m->end->domain->fields[b], id, instance, c);
            for (size_t i = 0; i < m->end->mesh.block[b].size; i++)
                to[i] = mixed_value(m->kind, id == C_VEL, start[i], end[i]);
        }
    return FLOE_OK;
}

/* Points that were not there at the start stay as they are. */
static floe_status mix_points(void *user, field_id id, int instance)
{
    const mixing *m = user;
    const field_info *info = field_describe(id);
    if (info->class != FIELD_STATE || info->centring != FIELD_POINT || instance != m->to.body) return FLOE_OK;
    for (int c = 0; c < field_component_count(info->components, m->end->mesh.dim); c++) {
        size_t k = 0;
        for (size_t i = 0; i < m->to.n; i++) {
            const point_place to = m->to.place[i];
            while (k < m->from.n && m->from.place[k].id < to.id) k++;
            if (k == m->from.n || m->from.place[k].id != to.id) continue;
            const point_place from = m->from.place[k];
            const double start = field_get(m->start->domain->fields[from.block], id, instance, c)[from.index];
            const double end = field_next(m->end->domain->fields[to.block], id, instance, c)[to.index];
            field_get(m->end->domain->fields[to.block], id, instance, c)[to.index] =
                mixed_value(m->kind, id == P_VEL || id == P_AFFINE, start, end);
        }
    }
    return FLOE_OK;
}

static floe_status mix_body(mixing *m, int body)
{
    TRY(point_list_make(&m->from, m->start, body));
    floe_status status = point_list_make(&m->to, m->end, body);
    if (status == FLOE_OK) status = fields_visit(m->end->domain->fields[0], mix_points, m);
    point_list_free(m->end->ctx, &m->from);
    point_list_free(m->end->ctx, &m->to);
    return status;
}

static floe_status mix_columns(const spoiled_run *r, spoiler kind)
{
    mixing m = {.start = r->start.sim, .end = r->end.sim, .kind = kind};
    TRY(fields_visit(m.end->domain->fields[0], mix_cells, &m));
    for (int b = 0; m.end->mpm && b < m.end->mpm->n_bodies; b++) TRY(mix_body(&m, b));
    return FLOE_OK;
}

floe_status spoil_open(spoiled_run *r, scene *start, scene *end, const char *dir)
{
    *r = (spoiled_run){0};
    TRY(setup_begin(&r->start, start));
    TRY(setup_begin(&r->end, end));
    TRY(output_recall(&r->files, r->end.sim, dir));
    TRY(fields_visit(r->end.sim->domain->fields[0], keep_cells, r->end.sim));
    return r->end.sim->mpm ? fields_visit(r->end.sim->domain->fields[0], save_points, r->end.sim) : FLOE_OK;
}

void spoil_close(spoiled_run *r)
{
    output_end(&r->files);
    if (r->start.scene) setup_end(&r->start);
    if (r->end.scene) setup_end(&r->end);
}

/* ---- history ---- */

typedef enum column_kind { COLUMN_KEPT, COLUMN_VELOCITY, COLUMN_SQUARE, COLUMN_ABOUT_START } column_kind;

static bool begins_with(const char *text, const char *with)
{
    return strncmp(text, with, strlen(with)) == 0;
}

static column_kind kind_of(const char *name)
{
    static const char *const kept[] = {"time",           "steps",   "rejected_steps", "dt",      "mass", "drift_",
                                       "largest_drift_", "ledger_", "gas_in_solids",  "outside_"};
    static const char *const square[] = {"kinetic", "strain"};
    static const char *const velocity[] = {"momentum", "velocity_", "angular_momentum"};
    for (size_t i = 0; i < sizeof kept / sizeof kept[0]; i++)
        if (begins_with(name, kept[i])) return COLUMN_KEPT;
    for (size_t i = 0; i < sizeof square / sizeof square[0]; i++)
        if (begins_with(name, square[i])) return COLUMN_SQUARE;
    for (size_t i = 0; i < sizeof velocity / sizeof velocity[0]; i++)
        if (begins_with(name, velocity[i])) return COLUMN_VELOCITY;
    return strstr(name, "_velocity_") ? COLUMN_VELOCITY : COLUMN_ABOUT_START;
}

static double spoil_value(column_kind column, spoiler kind, double first, double value)
{
    if (column == COLUMN_KEPT) return value;
    if (column == COLUMN_ABOUT_START) return mixed_value(kind, false, first, value);
    if (column == COLUMN_VELOCITY || isnan(table[kind].velocity)) return mixed_value(kind, true, first, value);
    return table[kind].velocity * table[kind].velocity * value;
}

void spoil_history(csv_table *rows, spoiler kind)
{
    for (size_t k = 0; k < rows->n_columns; k++) {
        csv_column *column = &rows->column[k];
        const column_kind of = kind_of(column->name);
        for (size_t row = rows->n_rows; row-- > 0;)
            column->value[row] = spoil_value(of, kind, column->value[0], column->value[row]);
    }
}

floe_status spoil_measure(spoiled_run *r, spoiler kind, const csv_table *rows, run_summary *out)
{
    TRY(mix_columns(r, kind));
    TRY(measure_errors(r->end.sim, &r->end.solution, out));
    return measure_history_rows(r->end.sim, rows, out);
}
