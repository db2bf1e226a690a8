/* floe plan DECK: what a scene would do and hold. */
#include "cli/cli.h"
#include "cli/plan.h"
#include "scene/deck_location.h"

typedef struct arguments {
    cli_deck deck;
    bool json;
} arguments;

enum { KEY_JSON = 1000 };

static error_t parse_plan_option(int key, char *arg, struct argp_state *state)
{
    arguments *a = state->input;
    if (key == KEY_JSON) {
        a->json = true;
        return 0;
    }
    return cli_deck_option(&a->deck, key, arg, state);
}

static const struct argp_option options[] = {
    CLI_OPTION_COUPLING, CLI_OPTION_SET, {"json", KEY_JSON, NULL, 0, "Write JSON", 0}, {0}};
static const struct argp argp = {
    .options = options,
    .parser = parse_plan_option,
    .args_doc = "DECK",
    .doc =
        "Show the stages of a step with what each reads and writes, the fields with their bytes, and the steps that "
        "the run would need, and whether the memory of this machine holds it. A scene of more than a million cells is "
        "described from coarser ones, and takes no memory itself. Nothing is run or written.",
};

static floe_status print_plan(plan *p, bool json)
{
    TRY(sim_plan(p->sim, &p->info));
    disk_need_of(p->scene, p->need.written_bytes, ".", &p->disk);
    return json ? plan_print_json(p, stdout) : plan_print_text(p, stdout);
}

static floe_status plan_scene(scene *s, bool json)
{
    run_setup setup;
    plan p = {.scene = s, .ratio = 1.0, .coarser = 1.0};
    floe_status status = setup_begin(&setup, s);
    p.sim = setup.sim;
    if (status == FLOE_OK) memory_need_of(p.sim, &p.need);
    if (status == FLOE_OK) status = print_plan(&p, json);
    setup_end(&setup);
    return status;
}

/* A scene of more cells than one would make ready only to look at it: by a coarser one. */
static floe_status plan_large(scene *s, bool json)
{
    coarse_setup coarse;
    plan p = {.scene = s};
    floe_status status = scene_deck_location(s, memory_need_estimate(s, &coarse, &p.need));
    p.sim = coarse.setup.sim;
    p.ratio = coarse.ratio;
    p.coarser = coarse.coarser;
    if (status == FLOE_OK) status = print_plan(&p, json);
    coarse_end(&coarse);
    return status;
}

int cmd_plan(cli *c, int argc, char **argv)
{
    arguments a = {0};
    scene *s;
    argp_parse(&argp, argc, argv, 0, NULL, &a);
    floe_status status = cli_load(c, &a.deck, &s);
    if (status != FLOE_OK) return cli_fail(c, status);
    status = memory_cells(&s->mesh) > MEMORY_NEED_CELLS ? plan_large(s, a.json) : plan_scene(s, a.json);
    scene_destroy(&s);
    return status == FLOE_OK ? 0 : cli_fail(c, status);
}
