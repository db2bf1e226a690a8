/* Speed of the ICE step on one core (docs/results/speed.md): one gas in 2-D, second order, 10 M cell updates/s; two gases with
 * every cell mixed at theta = 0.5, 3 M. The flow moves, so that every branch of the limiter is met. Prints the best
 * rate of several repeats with their median, and where the time of the best went. */
#include "repeat.h"

#include "base/memory.h"
#include "base/timer.h"
#include "ice/ice.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void set(const param_spec *params, size_t n, void *par, const char *key, double value)
{
    for (size_t k = 0; k < n; ++k)
        if (strcmp(params[k].key, key) == 0) *(double *)(void *)((char *)par + params[k].offset) = value;
}

static floe_status add_gas(scene *s, double gamma)
{
    scene_material *m = &s->material[s->n_materials++];
    m->kind = MATERIAL_FLUID;
    m->eos.model = eos_find("ideal");
    TRY(scene_allocate(s, &m->eos.par, m->eos.model->param_size));
    set(m->eos.model->params, m->eos.model->n_params, m->eos.par, "gamma", gamma);
    set(m->eos.model->params, m->eos.model->n_params, m->eos.par, "specific_heat", 717.5);
    scene_body *b = &s->body[s->n_bodies++];
    b->material = s->n_materials - 1;
    b->shape.model = shape_find("halfspace");
    TRY(scene_allocate(s, &b->shape.par, b->shape.model->param_size));
    double *par = b->shape.par;
    par[0] = 1e6; /* point */
    par[3] = 1.0; /* normal */
    b->pressure = 1e5;
    b->temperature = 300.0;
    b->density = (double)NAN;
    return FLOE_OK;
}

/* A swirl of Mach 0.3 with a hot spot, in every cell the same fractions. */
static void stir(ice *s, const domain *d, const mesh *m)
{
    const block *b = &m->block[0];
    for (int j = 0; j < b->n[1]; ++j)
        for (int i = 0; i < b->n[0]; ++i) {
            const ptrdiff_t at = mesh_index(b, i, j, 0);
            const double x = 6.283185307 * (i + 0.5) / b->n[0], y = 6.283185307 * (j + 0.5) / b->n[1];
            for (int r = 0; r < s->n_materials; ++r) {
                const double share = 1.0 / s->n_materials, T = 300.0 + 60.0 * sin(x) * sin(2.0 * y), p = 1e5;
                double v, dvdp, rho, e;
                const eos *law = &s->material[r].eos;
                law->model->volume(law->par, 1, &p, &T, &v, &dvdp);
                rho = 1.0 / v;
                law->model->energy(law->par, 1, &rho, &T, &e);
                field_get(d->fields[0], C_RHO, r, 0)[at] = share * rho;
                field_get(d->fields[0], C_ENERGY, r, 0)[at] = e;
                field_get(d->fields[0], C_VEL, r, 0)[at] = 100.0 * sin(x) * cos(y);
                field_get(d->fields[0], C_VEL, r, 1)[at] = -100.0 * cos(x) * sin(y);
                if (ice_is_mixture(s)) field_get(d->fields[0], C_VOL, r, 0)[at] = v;
                field_get(d->fields[0], C_PRESSURE, 0, 0)[at] = p;
            }
        }
}

typedef struct bench_run {
    ice *solver;
    domain *domain;
    stage_list *stages;
    ledger *ledger;
    double dt; /* s */
    int steps; /* a repeat */
} bench_run;

/* Seconds of wall time of a number of steps; the stages' are counted from zero. */
static floe_status take_steps(const bench_run *r, double *seconds)
{
    for (int q = 0; q < r->stages->n; ++q) r->stages->record[q].seconds = 0.0;
    const double start = wall_seconds();
    for (int k = 0; k < r->steps; ++k) {
        r->solver->dt = r->dt;
        TRY(ice_step(r->solver));
        fields_commit(r->domain->fields[0]);
        ledger_commit(r->ledger);
    }
    *seconds = wall_seconds() - start;
    return FLOE_OK;
}

/* Rates of all repeats, and the stages' seconds in the best; the first, in which caches and memory warm up, is not
 * counted. */
static floe_status repeat_steps(const bench_run *r, double cells, double *rate, double *stage)
{
    double best = 0.0, seconds;
    TRY(take_steps(r, &seconds));
    for (int n = 0; n < BENCH_REPEATS; ++n) {
        TRY(take_steps(r, &seconds));
        rate[n] = 1e-6 * cells * r->steps / seconds;
        if (rate[n] <= best) continue;
        best = rate[n];
        for (int q = 0; q < r->stages->n; ++q) stage[q] = r->stages->record[q].seconds;
    }
    return FLOE_OK;
}

static floe_status bench(context *ctx, int n, int materials, int steps, double bar)
{
    scene *s;
    mesh m;
    stage_list stages;
    ledger l = {0};
    ice *solver;
    domain *d;
    TRY(scene_create(&s, ctx));
    s->mesh.dim = 2;
    for (int a = 0; a < 2; ++a) {
        s->mesh.upper[a] = 1.0;
        s->mesh.cell[a] = 1.0 / n;
        s->mesh.periodic[a] = true;
        s->bc.side[a][0].kind = s->bc.side[a][1].kind = BC_PERIODIC;
    }
    for (int r = 0; r < materials; ++r) TRY(add_gas(s, 1.4 + 0.2 * r));
    s->method.exchange = 1e4;
    TRY(mesh_init(&m, ctx, &s->mesh));
    stage_list_init(&stages, ctx);
    TRY(ice_create(&solver, ctx, s, &m, &stages, &l, false));
    stages.planning = true;
    TRY(ice_step(solver));
    stages.planning = false;
    TRY(domain_create(&d, ctx, &m));
    stages.domain = d;
    TRY(ice_register(solver, d));
    stir(solver, d, &m);
    step_limit limit;
    TRY(ice_time_step(solver, &limit));
    const bench_run run = {solver, d, &stages, &l, limit.dt, steps};
    const double cells = (double)n * n;
    double rate[BENCH_REPEATS], stage[STAGE_MAX];
    TRY(repeat_steps(&run, cells, rate, stage));
    printf("%d gas(es), %d x %d: ", materials, n, n);
    bench_print(rate, " cell updates");
    printf(", bar %.0f; %.0f ns a cell\n", bar, 1e3 / rate[BENCH_REPEATS - 1]);
    for (int q = 0; q < stages.n; ++q)
        printf("    %-28s %6.1f ns\n", stages.record[q].name, 1e9 * stage[q] / (cells * steps));
    ice_destroy(&solver);
    domain_destroy(&d);
    stage_list_destroy(&stages);
    scene_destroy(&s);
    return FLOE_OK;
}

int main(void)
{
    context *ctx = context_create();
    floe_status status = bench(ctx, 256, 1, 20, 10.0);
    if (status == FLOE_OK) status = bench(ctx, 512, 1, 6, 10.0);
    if (status == FLOE_OK) status = bench(ctx, 256, 2, 8, 3.0);
    if (status != FLOE_OK) printf("%s\n", context_message(ctx));
    context_destroy(&ctx);
    return status != FLOE_OK;
}
