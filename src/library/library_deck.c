/* What a deck says, and how its run would begin (floe/floe.h). */
#include "library/library_internal.h"
#include "library/plan.h"

#include "run/ready.h"
#include "scene/deck_location.h"

floe_description floe_describe(const floe_deck *deck)
{
    const scene *s = deck->scene;
    floe_description d = {.title = s->title,
                          .coupling = coupling_name(s->coupling),
                          .dimensionless = s->dimensionless,
                          .dimension = s->mesh.dim,
                          .cells = {1.0, 1.0, 1.0},
                          .materials = s->n_materials,
                          .bodies = s->n_bodies,
                          .compares = s->n_runs_as > 1 || s->batches->compare.n_values > 0,
                          .studies = s->batches->study.n_axes > 0};
    for (int a = 0; a < s->mesh.dim; a++) d.cells[a] = (s->mesh.upper[a] - s->mesh.lower[a]) / s->mesh.cell[a];
    return d;
}

/* Only one of these, simulations and runs at a time. */
static floe_status begin_use(floe_deck *deck)
{
    library_clear_messages(deck->floe);
    if (!deck->in_use) return FLOE_OK;
    return fail(deck->floe->ctx, FLOE_BAD_INPUT, "'%s' has a simulation: destroy it first, or read the deck again",
                deck->scene->path);
}

static void log_warning(void *user, const char *text)
{
    const floe_deck *deck = user;
    char placed[4096];
    remark_with_place(deck->scene, text, placed, sizeof placed);
    context_log(deck->floe->ctx, LOG_WARNING, "%s", placed);
}

floe_status floe_rehearse(floe_deck *deck, floe_start *start)
{
    run_ready ready = {0};
    *start = (floe_start){0};
    TRY(begin_use(deck));
    TRY(run_make_ready(deck->scene, &ready, log_warning, deck));
    *start = (floe_start){ready.done,  ready.cells,  RUN_READY_CELLS, ready.points,   ready.step,
                          ready.steps, ready.reason, ready.bytes,     ready.available};
    return FLOE_OK;
}

static floe_status print_plan(plan *p, bool json, FILE *file)
{
    TRY(sim_plan(p->sim, &p->info));
    disk_need_of(p->scene, p->need.written_bytes, ".", &p->disk);
    return json ? plan_print_json(p, file) : plan_print_text(p, file);
}

static floe_status plan_scene(scene *s, bool json, FILE *file)
{
    run_setup setup;
    plan p = {.scene = s, .ratio = 1.0, .coarser = 1.0};
    floe_status status = setup_begin(&setup, s);
    p.sim = setup.sim;
    if (status == FLOE_OK) memory_need_of(p.sim, &p.need);
    if (status == FLOE_OK) status = print_plan(&p, json, file);
    setup_end(&setup);
    return status;
}

/* A scene of more cells than one would make ready only to look at it: by a coarser one. */
static floe_status plan_large(scene *s, bool json, FILE *file)
{
    coarse_setup coarse;
    plan p = {.scene = s};
    floe_status status = scene_deck_location(s, memory_need_estimate(s, &coarse, &p.need));
    p.sim = coarse.setup.sim;
    p.ratio = coarse.ratio;
    p.coarser = coarse.coarser;
    if (status == FLOE_OK) status = print_plan(&p, json, file);
    coarse_end(&coarse);
    return status;
}

floe_status floe_plan(floe_deck *deck, bool json, FILE *file)
{
    TRY(begin_use(deck));
    return memory_cells(&deck->scene->mesh) > RUN_READY_CELLS ? plan_large(deck->scene, json, file)
                                                              : plan_scene(deck->scene, json, file);
}
