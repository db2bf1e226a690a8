/* Point updates a second of whole steps of material points, on the threads of the environment: a line a case, the
 * best of several repeats and their median, with the design's bar for one core. A block of elastic points that moves,
 * so that points cross cells. With an argument: only the cases whose name holds it. STAGES=1 prints where the time
 * goes. */
#include "repeat.h"

#include "base/timer.h"
#include "sim/sim.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct bench_case {
    const char *name, *basis;
    int dim, cells, per_cell;
    double bar; /* million updates a second on one core, NAN: none */
} bench_case;

static const bench_case cases[] = {
    {"2-D linear, 4 points a cell", "linear", 2, 200, 2, 15.0},
    {"2-D quadratic, 4 points a cell", "quadratic", 2, 200, 2, NAN},
    {"2-D gimp, 4 points a cell", "gimp", 2, 200, 2, NAN},
    {"3-D linear, 8 points a cell", "linear", 3, 32, 2, NAN},
    {"3-D quadratic, 8 points a cell", "quadratic", 3, 32, 2, 5.0},
    {"3-D gimp, 8 points a cell", "gimp", 3, 32, 2, 5.0},
};

typedef struct elastic {
    double bulk, shear;
} elastic;

typedef struct box {
    double lower[3], upper[3];
} box;

static void make_scene(const bench_case *c, scene *s, elastic *law, box *b)
{
    s->mesh.dim = c->dim;
    for (int a = 0; a < c->dim; ++a) {
        s->mesh.upper[a] = 1.0;
        s->mesh.cell[a] = 1.0 / c->cells;
        s->bc.side[a][0].kind = s->bc.side[a][1].kind = BC_FREE;
        b->lower[a] = 0.1;
        b->upper[a] = 0.9;
    }
    s->n_materials = s->n_bodies = 1;
    s->material[0] = (scene_material){.name = "elastic",
                                      .kind = MATERIAL_SOLID,
                                      .density = 1000.0,
                                      .law = solid_find("linear_elastic"),
                                      .law_par = law};
    scene_body *body = &s->body[0];
    body->shape = (shape){shape_find("box"), b};
    snprintf(body->name, sizeof body->name, "block");
    for (int a = 0; a < 3; ++a) body->per_cell[a] = c->per_cell;
    body->velocity[0] = 1.0;
    body->velocity[1] = 0.5;
    snprintf(s->method.basis, sizeof s->method.basis, "%s", c->basis);
    s->time.end = 1.0;
}

static void print_stages(const sim *run)
{
    for (int k = 0; k < run->stages.n; ++k)
        printf("    %-28s %6.1f ns a point\n", run->stages.record[k].name,
               1e9 * run->stages.record[k].seconds / run->point_updates);
}

/* Millions of point updates a second over a quarter of a second. */
static floe_status take_steps(sim *run, double *rate)
{
    const double updates = run->point_updates, start = wall_seconds();
    while (wall_seconds() - start < 0.25) TRY(sim_step(run, INFINITY));
    *rate = 1e-6 * (run->point_updates - updates) / (wall_seconds() - start);
    return FLOE_OK;
}

static floe_status measure(context *ctx, const bench_case *c, scene *s)
{
    elastic law = {1e6, 5e5};
    box b;
    sim *run;
    make_scene(c, s, &law, &b);
    TRY(sim_create(&run, ctx, s, COUPLING_MPM));
    floe_status status = FLOE_OK;
    for (int k = 0; k < 3 && status == FLOE_OK; ++k) status = sim_step(run, INFINITY);
    double rate[BENCH_REPEATS] = {0.0};
    for (int k = 0; k < BENCH_REPEATS && status == FLOE_OK; ++k) status = take_steps(run, &rate[k]);
    printf("%-32s %8zu points ", c->name, mpm_count(run->mpm));
    bench_print(rate, "");
    if (!isnan(c->bar)) printf("   bar %.0f", c->bar);
    printf("\n");
    if (getenv("STAGES")) print_stages(run);
    sim_destroy(&run);
    return status;
}

int main(int argc, char **argv)
{
    context *ctx = context_create();
    if (!ctx) return status_exit(FLOE_NO_MEMORY);
    floe_status status = FLOE_OK;
    for (size_t k = 0; status == FLOE_OK && k < sizeof cases / sizeof *cases; ++k) {
        if (argc > 1 && !strstr(cases[k].name, argv[1])) continue;
        scene *s = NULL;
        status = scene_create(&s, ctx);
        if (status == FLOE_OK) status = measure(ctx, &cases[k], s);
        scene_destroy(&s);
    }
    if (status != FLOE_OK) fprintf(stderr, "%s\n", context_message(ctx));
    context_destroy(&ctx);
    return status_exit(status);
}
