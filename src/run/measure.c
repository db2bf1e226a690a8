#include "run/measure.h"

#include "base/memory.h"
#include "run/pressure.h"
#include "run/samples.h"
#include "run/subject.h"
#include "verify/history_metric.h"
#include "verify/metric.h"

#include <math.h>
#include <stdlib.h>

static int first_fluid(const scene *s)
{
    for (int m = 0; m < s->n_materials; m++) {
        if (s->material[m].kind == MATERIAL_FLUID) return m;
    }
    return -1;
}

/* The cells of a material that is no points, -1 if there are none. */
static int cells_of(const sim *s, int material)
{
    for (int r = 0; s->ice && r < s->ice->n_materials; r++) {
        if (s->ice->material[r].scene_material == material && !s->ice->material[r].points) return r;
    }
    return -1;
}

/* Several fluids, and no points among them. */
static bool is_mixture(const sim *s)
{
    return s->ice && s->ice->n_materials > 1 && !s->ice->with_points;
}

subject find_subject(sim *s, const exact *solution)
{
    const scene_verify *v = &s->scene->verify;
    const int bodies = s->mpm ? s->mpm->n_bodies : 0;
    int material = v->material >= 0 ? v->material : first_fluid(s->scene);
    subject what = {.s = s, .solution = solution, .cells = -1};
    if (v->body < 0 && v->material < 0 && solution->model && exact_is_solid(solution)) {
        for (int b = 0; b < bodies; b++) what.body[b] = !s->mpm->body[b].fluid;
        return what;
    }
    if (v->body >= 0) {
        for (int b = 0; b < bodies; b++) what.body[b] = s->mpm->body[b].scene_body == v->body;
        for (int b = 0; b < bodies; b++) {
            if (what.body[b]) return what;
        }
        material = s->scene->body[v->body].material;
    }
    what.cells = material >= 0 ? cells_of(s, material) : -1;
    if (v->material < 0 && v->body < 0 && is_mixture(s)) what.cells = CELLS_OF_ALL;
    for (int b = 0; b < bodies && what.cells < 0; b++)
        what.body[b] = material < 0 || s->mpm->body[b].scene_material == material;
    return what;
}

static floe_status add_point_errors(const subject *what, int body, exact_quantity quantity, norm *sum)
{
    const shape *region = &what->s->scene->verify.region;
    point_samples p;
    TRY(point_samples_take(&p, what->s, what->solution, body));
    for (size_t i = 0; i < p.list.n; i++) {
        if (point_inside(&p, region, i))
            norm_add(sum, point_value(&p, quantity, i), point_exact(&p, quantity, i), p.volume[i]);
    }
    point_samples_free(&p);
    return FLOE_OK;
}

static floe_status add_cell_errors(const subject *what, exact_quantity quantity, norm *sum)
{
    const shape *region = &what->s->scene->verify.region;
    cell_samples c;
    TRY(cell_samples_take(&c, what->s, what->solution, what->cells));
    for (size_t i = 0; i < c.n; i++) {
        const double weight = cell_weight(&c, i);
        /* A cell without the material has no value of it. */
        if (weight == 0.0 || !cell_inside(&c, region, i)) continue;
        norm_add(sum, cell_value(&c, quantity, i), cell_exact(&c, quantity, i), weight);
    }
    cell_samples_free(&c);
    return FLOE_OK;
}

static floe_status measure_norm(const subject *what, const metric *m, double *out)
{
    const int bodies = what->s->mpm ? what->s->mpm->n_bodies : 0;
    norm sum = {0};
    if (what->cells >= 0) TRY(add_cell_errors(what, m->quantity, &sum));
    for (int b = 0; b < bodies; b++) {
        if (what->body[b]) TRY(add_point_errors(what, b, m->quantity, &sum));
    }
    const norm_result result = norm_finish(&sum);
    *out = metric_pick(m->kind, &result);
    return FLOE_OK;
}

static double exact_parameter(const exact *solution, const char *key)
{
    const double *value = exact_param(solution->model, (void *)solution->par, key);
    return value ? *value : (double)NAN;
}

static size_t count_points(const subject *what)
{
    const int bodies = what->s->mpm ? what->s->mpm->n_bodies : 0;
    size_t n = 0;
    for (int b = 0; b < bodies; b++) n += what->body[b] ? mpm_body_points(what->s->mpm, b) : 0;
    return n;
}

static floe_status fill_sums(const subject *what, double *sum, size_t *n)
{
    const shape *region = &what->s->scene->verify.region;
    for (int b = 0; what->s->mpm && b < what->s->mpm->n_bodies; b++) {
        point_samples p;
        if (!what->body[b]) continue;
        TRY(point_samples_take(&p, what->s, what->solution, b));
        for (size_t i = 0; i < p.list.n; i++) {
            if (point_inside(&p, region, i))
                sum[(*n)++] = point_value(&p, EXACT_SIGMA_R, i) + point_value(&p, EXACT_SIGMA_THETA, i);
        }
        point_samples_free(&p);
    }
    return FLOE_OK;
}

static floe_status measure_eq13(const subject *what, double *out)
{
    double *sum;
    size_t n = 0;
    TRY(memory_new(what->s->ctx, &sum, count_points(what), sizeof *sum));
    const floe_status status = fill_sums(what, sum, &n);
    *out = guilkey_eq13(n, sum, what->s->scene->verify.probe_pressure, exact_parameter(what->solution, "inner_radius"),
                        exact_parameter(what->solution, "outer_radius"));
    memory_free(what->s->ctx, &sum);
    return status;
}

/* |p - p_ref - P| / P of the fluid that a load pressurises. */
static floe_status measure_gas(sim *s, run_summary *r)
{
    const double P = s->scene->verify.probe_pressure;
    for (int m = 0; m < s->scene->n_materials && !isnan(P); m++) {
        if (!pressurising_load(s->scene, m)) continue;
        const double p = mean_pressure(s, m);
        return summary_add_error(r, s->ctx, "rel_gas_pressure", fabs(p - s->scene->reference_pressure - P) / P);
    }
    return FLOE_OK;
}

floe_status measure_errors(sim *s, const exact *solution, run_summary *r)
{
    const scene_verify *v = &s->scene->verify;
    if (solution->model) r->reference_accuracy = exact_accuracy(solution);
    for (int i = 0; i < v->n_metrics && solution->model; i++) {
        const subject what = find_subject(s, solution);
        metric m;
        double value = (double)NAN;
        const char *of_history;
        if (history_metric_parse(v->metric[i], &of_history) != HISTORY_METRIC_COUNT) continue;
        TRY(metric_parse(s->ctx, v->metric[i], &m));
        TRY(m.kind == METRIC_EQ13 ? measure_eq13(&what, &value) : measure_norm(&what, &m, &value));
        TRY(summary_add_error(r, s->ctx, v->metric[i], value));
    }
    return measure_gas(s, r);
}
