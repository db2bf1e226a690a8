/* A one-dimensional scene beside its exact solution. */
#include "base/memory.h"
#include "base/strbuf.h"
#include "io/file.h"
#include "io/names.h"
#include "run/samples.h"
#include "run/subject.h"
#include "verify/metric.h"

#include <stdlib.h>

/* The rows are x, then for each quantity what the run has and what is exact. */
typedef struct line {
    exact_quantity quantity[SCENE_MAX_METRICS];
    int n_quantities;
    size_t width; /* numbers a row */
    double *row;  /* counted memory, owned */
    size_t n;
} line;

/* Quantities of the metrics, each once. */
static void choose_quantities(const scene_verify *v, line *l)
{
    for (int i = 0; i < v->n_metrics; i++) {
        metric m;
        bool known = false;
        if (metric_parse(NULL, v->metric[i], &m) != FLOE_OK || m.quantity == EXACT_QUANTITY_COUNT) continue;
        for (int k = 0; k < l->n_quantities; k++) known = known || l->quantity[k] == m.quantity;
        if (!known) l->quantity[l->n_quantities++] = m.quantity;
    }
    l->width = 1 + 2 * (size_t)l->n_quantities;
}

static void add_point_samples(const point_samples *p, line *l)
{
    for (size_t i = 0; i < p->list.n; i++) {
        double *row = l->row + l->width * l->n++;
        row[0] = p->x[0][i];
        for (int k = 0; k < l->n_quantities; k++) {
            row[1 + 2 * k] = point_value(p, l->quantity[k], i);
            row[2 + 2 * k] = point_exact(p, l->quantity[k], i);
        }
    }
}

static void add_cell_samples(const cell_samples *c, line *l)
{
    const mesh *m = &c->s->mesh;
    for (size_t i = 0; i < c->n; i++) {
        if (cell_weight(c, i) == 0.0) continue; /* no value where there is no material */
        double *row = l->row + l->width * l->n++;
        row[0] = 0.5 * (mesh_node(m, 0, (int)i) + mesh_node(m, 0, (int)i + 1));
        for (int k = 0; k < l->n_quantities; k++) {
            row[1 + 2 * k] = cell_value(c, l->quantity[k], i);
            row[2 + 2 * k] = cell_exact(c, l->quantity[k], i);
        }
    }
}

static floe_status collect_line(const subject *what, line *l)
{
    if (what->cells >= 0) {
        cell_samples c;
        TRY(cell_samples_take(&c, what->s, what->solution, what->cells));
        add_cell_samples(&c, l);
        cell_samples_free(&c);
    }
    for (int b = 0; what->s->mpm && b < what->s->mpm->n_bodies; b++) {
        point_samples p;
        if (!what->body[b]) continue;
        TRY(point_samples_take(&p, what->s, what->solution, b));
        add_point_samples(&p, l);
        point_samples_free(&p);
    }
    return FLOE_OK;
}

static size_t count_line_samples(const subject *what)
{
    size_t n = what->cells >= 0 ? mesh_cells(&what->s->mesh) : 0;
    for (int b = 0; what->s->mpm && b < what->s->mpm->n_bodies; b++)
        n += what->body[b] ? mpm_body_points(what->s->mpm, b) : 0;
    return n;
}

static int compare_along_line(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static floe_status write_sampled_line(const sim *s, const line *l, const char *path)
{
    context *ctx = s->ctx;
    strbuf out;
    strbuf_init(&out, ctx);
    strbuf_append(&out, "x (%s)", output_unit(s, "m"));
    for (int k = 0; k < l->n_quantities; k++) {
        const char *name = exact_quantity_name(l->quantity[k]);
        const char *unit = output_unit(s, exact_quantity_unit(l->quantity[k]));
        strbuf_append(&out, ",%s (%s),exact_%s (%s)", name, unit, name, unit);
    }
    strbuf_append(&out, "\n");
    for (size_t i = 0; i < l->n; i++) {
        for (size_t k = 0; k < l->width; k++) strbuf_append(&out, "%s%.9g", k > 0 ? "," : "", l->row[l->width * i + k]);
        strbuf_append(&out, "\n");
    }
    const floe_status status = out.status == FLOE_OK ? file_replace_text(ctx, path, strbuf_string(&out)) : out.status;
    strbuf_free(&out);
    return status;
}

floe_status profile_of_line(sim *s, const exact *solution, const char *path)
{
    const subject what = find_subject(s, solution);
    line l = {0};
    choose_quantities(&s->scene->verify, &l);
    if (l.n_quantities == 0) return FLOE_OK;
    TRY(memory_new(s->ctx, &l.row, count_line_samples(&what) * l.width, sizeof *l.row));
    floe_status status = collect_line(&what, &l);
    qsort(l.row, l.n, l.width * sizeof *l.row, compare_along_line);
    if (status == FLOE_OK) status = write_sampled_line(s, &l, path);
    memory_free(s->ctx, &l.row);
    return status;
}
