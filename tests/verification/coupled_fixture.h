/* Solids on points in fluids on cells: scenes made in C or loaded from decks, and their whole state as one run of numbers. */
#ifndef TESTS_VERIFICATION_COUPLED_FIXTURE_H
#define TESTS_VERIFICATION_COUPLED_FIXTURE_H

#include "mpm_fixture.h"

#include "base/memory.h"
#include "deck/deck.h"
#include "io/checkpoint/checkpoint.h"
#include "io/file.h"
#include "io/gather.h"
#include "io/io.h"
#include "run/catalogue.h"
#include "run/initial.h"

#include <unistd.h>

static const double COUPLED_PRESSURE = 1e5, COUPLED_TEMPERATURE = 300.0; /* Pa, K: of the gas about the bodies */

/* A box [0, upper] of cells h, closed by slip walls, filled with air at rest; its pressure is the reference. The solids'
 * eos is the law's own bulk response. */
FIXTURE void coupled_begin(trial *t, int dim, const double upper[3], double h)
{
    trial_begin(t, dim, upper, h);
    scene *s = t->scene;
    for (int a = 0; a < dim; ++a) set_sides(t, a, BC_SLIP, BC_SLIP);
    s->coupling = COUPLING_ICE_MPM;
    s->reference_pressure = COUPLED_PRESSURE;
    s->has_ambient = true;
    s->ambient_material = add_gas(t, 1.4, 717.5);
    s->ambient_pressure = COUPLED_PRESSURE;
    s->ambient_temperature = COUPLED_TEMPERATURE;
    s->time.growth = 1.2;
}

FIXTURE int coupled_solid(trial *t, double bulk, double shear, double density)
{
    const int solid = add_solid(t, "linear_elastic", bulk, shear, density);
    t->scene->material[solid].specific_heat = 460.0;
    t->scene->material[solid].tension_switch = COUPLED_PRESSURE;
    return solid;
}

FIXTURE scene_body *coupled_body(trial *t, int material, shape s, int per_cell)
{
    scene_body *b = add_body(t, material, s, per_cell);
    b->temperature = COUPLED_TEMPERATURE;
    return b;
}

/* A liquid of density 1 whose pressure does not depend on its temperature. */
FIXTURE int coupled_liquid(trial *t, double specific_heat, double conductivity)
{
    const struct {
        const char *key;
        double value;
    } par[] = {{"density", 1.0}, {"sound_speed", 10.0}, {"pressure", 1.0}, {"specific_heat", specific_heat}};
    const int liquid = add_gas(t, 1.4, 1.0);
    scene_material *m = &t->scene->material[liquid];
    m->eos.model = eos_find("acoustic");
    assert_non_null(m->eos.model);
    check_ok(t->ctx, scene_allocate(t->scene, &m->eos.par, m->eos.model->param_size));
    for (size_t k = 0; k < sizeof par / sizeof *par; ++k)
        set_param(m->eos.model->params, m->eos.model->n_params, m->eos.par, par[k].key, 0, par[k].value);
    m->conductivity = conductivity;
    return liquid;
}

FIXTURE void coupled_start(trial *t)
{
    check_ok(t->ctx, sim_create(&t->sim, t->ctx, t->scene, t->scene->coupling));
}

/* The scene of a deck of inputs/, with `set` replaced; refused, there is none. */
FIXTURE floe_status deck_try(trial *t, const char *deck, const char *const *set, size_t n_set)
{
    memset(t, 0, sizeof *t);
    use_threads(1);
    char path[512];
    (void)snprintf(path, sizeof path, "%s/inputs/%s.yaml", FLOE_SOURCE_DIR, deck);
    t->ctx = context_create();
    deck_catalogue *catalogue;
    deck_report report = {0};
    deck_init();
    check_ok(t->ctx, catalogue_create(&catalogue, t->ctx));
    const floe_status status = deck_load(&t->scene, t->ctx, path, &(deck_overrides){set, n_set}, catalogue, &report);
    catalogue_destroy(t->ctx, &catalogue);
    deck_report_free(&report);
    return status;
}

/* The scene of a deck that is fine. */
FIXTURE void deck_begin(trial *t, const char *deck, const char *const *set, size_t n_set)
{
    const floe_status status = deck_try(t, deck, set, n_set);
    check_ok(t->ctx, status);
}

/* A scene of inputs/ as it is to be run. */
typedef struct deck_variant {
    const char *name, *deck;
    scene_coupling coupling;
    int blocks; /* along each axis */
    size_t n_set;
    const char *set[6];
} deck_variant;

/* Loads it, without making the simulation; the exact solution that it may start from lives in *solution. */
FIXTURE void variant_load(trial *t, const deck_variant *v, exact *solution)
{
    deck_begin(t, v->deck, v->set, v->n_set);
    check_ok(t->ctx, initial_exact(t->scene, solution));
    initial_attach(t->scene, solution);
    for (int a = 0; a < t->scene->mesh.dim; ++a) t->scene->mesh.blocks[a] = v->blocks;
    t->scene->coupling = v->coupling;
}

FIXTURE void variant_end(trial *t, exact *solution)
{
    exact_destroy(t->ctx, solution);
    trial_end(t);
}

/* Everything that a run goes on from: STATE and FIXED fields in global order, clocks, ledger. */
typedef struct state {
    double *value; /* malloc */
    size_t n, reserved;
    struct {
        const char *name; /* of a field, the ledger, clocks */
        size_t start;
    } part[256];
    int n_parts;
} state;

FIXTURE void state_part(state *s, const char *name)
{
    assert_in_range(s->n_parts, 0, 255);
    s->part[s->n_parts].name = name;
    s->part[s->n_parts++].start = s->n;
}

FIXTURE double *state_reserve(state *s, size_t n)
{
    if (s->n + n > s->reserved) {
        s->reserved = 2 * (s->n + n);
        s->value = realloc(s->value, s->reserved * sizeof *s->value);
        assert_non_null(s->value);
    }
    s->n += n;
    return s->value + s->n - n;
}

typedef struct state_job {
    const sim *sim;
    state *out;
} state_job;

FIXTURE floe_status state_add_field(void *user, field_id id, int instance)
{
    const state_job *job = user;
    const field_info *info = field_describe(id);
    const int components = field_component_count(info->components, job->sim->mesh.dim);
    if (info->class != FIELD_STATE && info->class != FIELD_FIXED) return FLOE_OK;
    state_part(job->out, info->name);
    if (info->centring == FIELD_CELL) {
        const size_t n = mesh_cells(&job->sim->mesh);
        for (int c = 0; c < components; ++c) gather_cells(job->sim, id, instance, c, 1, state_reserve(job->out, n));
        return FLOE_OK;
    }
    assert_int_equal(info->centring, FIELD_POINT);
    point_list list;
    TRY(point_list_make(&list, job->sim, instance));
    for (int c = 0; c < components; ++c) gather_points(job->sim, &list, id, c, 1, state_reserve(job->out, list.n));
    point_list_free(job->sim->ctx, &list);
    return FLOE_OK;
}

FIXTURE state state_of(const sim *s)
{
    state out = {0};
    state_job job = {s, &out};
    check_ok(s->ctx, fields_visit(s->domain->fields[0], state_add_field, &job));
    state_part(&out, "clocks");
    const double clocks[] = {s->time, s->dt, (double)s->steps, s->mpm ? s->mpm->dt_previous : 0.0};
    memcpy(state_reserve(&out, 4), clocks, sizeof clocks);
    return out;
}

FIXTURE void state_add_ledger(state *out, const sim *s)
{
    const size_t n = sizeof s->ledger.entry / sizeof(double);
    state_part(out, "ledger");
    memcpy(state_reserve(out, n), s->ledger.entry, sizeof s->ledger.entry);
    for (int c = 0; c < LEDGER_COUNTS; ++c) *state_reserve(out, 1) = (double)s->ledger.count[c];
}

FIXTURE void state_free(state *s)
{
    free(s->value);
    memset(s, 0, sizeof *s);
}

/* The same bits; says where they are not. */
FIXTURE void same_state(const state *a, const state *b)
{
    assert_int_equal(a->n, b->n);
    size_t different = 0;
    for (int p = 0; p < a->n_parts; ++p) {
        const size_t end = p + 1 < a->n_parts ? a->part[p + 1].start : a->n;
        for (size_t k = a->part[p].start, shown = 0; k < end; ++k) {
            if (memcmp(&a->value[k], &b->value[k], sizeof(double)) == 0) continue;
            different++;
            if (shown++ < 3)
                print_error("%s, number %zu of %zu: %.17g and %.17g\n", a->part[p].name, k - a->part[p].start,
                            end - a->part[p].start, a->value[k], b->value[k]);
        }
    }
    assert_int_equal(different, 0);
}

/* Ends a trial with its whole state, ledger included; the caller's, for state_free. */
FIXTURE state trial_finish(trial *t)
{
    check_ok(t->ctx, sim_update_ledger(t->sim));
    state s = state_of(t->sim);
    state_add_ledger(&s, t->sim);
    trial_end(t);
    return s;
}

/* A name for a checkpoint in a folder of its own, which goes with the checkpoint. */
typedef struct checkpoint_place {
    char folder[32], path[64];
} checkpoint_place;

FIXTURE checkpoint_place checkpoint_place_make(void)
{
    checkpoint_place place = {.folder = "/tmp/floe-test-XXXXXX"};
    assert_non_null(mkdtemp(place.folder));
    (void)snprintf(place.path, sizeof place.path, "%s/checkpoint.h5", place.folder);
    return place;
}

FIXTURE void checkpoint_place_remove(const checkpoint_place *place)
{
    assert_int_equal(unlink(place->path), 0);
    assert_int_equal(rmdir(place->folder), 0);
}

/* Starts a trial in the way that `how`, of a type of the test's own, says. */
typedef void begin_trial(trial *t, const void *how);

/* Two ways to run a scene come to the same bits. */
FIXTURE void same_steps(begin_trial *begin, const void *one, const void *other, int steps)
{
    trial t;
    begin(&t, one);
    trial_steps(&t, steps);
    state expected = trial_finish(&t);
    begin(&t, other);
    trial_steps(&t, steps);
    state found = trial_finish(&t);
    same_state(&expected, &found);
    state_free(&expected);
    state_free(&found);
}

enum { FIXTURE_EXTRAS = 4 };

/* What is written of a run, and read into one: what no field holds is in the extra arrays. */
FIXTURE checkpoint_run checkpoint_of(const trial *t, checkpoint_extra extra[FIXTURE_EXTRAS])
{
    checkpoint_extra surface = {.name = "surface", .components = 3}, skin = {.name = "skin", .components = 6},
                     edges = {.name = "edges", .components = 1, .stride = 1},
                     overlaps = {.name = "overlaps", .components = 1, .stride = 1};
    checkpoint_run run = {.deck = "floe: 1\n", .identity = "floe: 1\n", .extra = extra};
    if (!t->sim->mpm) return run;
    surface.data = mpm_surface(t->sim->mpm, &surface.n, &surface.stride);
    skin.data = mpm_surface_markers(t->sim->mpm, &skin.n, &skin.stride);
    edges.data = mpm_edges_state(t->sim->mpm, &edges.n);
    overlaps.data = mpm_overlaps_state(t->sim->mpm, &overlaps.n);
    if (surface.data) extra[run.n_extra++] = surface;
    if (skin.data) extra[run.n_extra++] = skin;
    if (edges.data) extra[run.n_extra++] = edges;
    if (overlaps.data) extra[run.n_extra++] = overlaps;
    return run;
}

FIXTURE void write_checkpoint(const trial *t, const char *path)
{
    checkpoint_extra extra[FIXTURE_EXTRAS];
    const checkpoint_run run = checkpoint_of(t, extra);
    size_t size;
    char *data;
    check_ok(t->ctx, checkpoint_write(t->sim, path, &run));
    check_ok(t->ctx, file_read(t->ctx, path, &data, &size));
    memory_free(t->ctx, &data);
    assert_in_range(size, 1, checkpoint_most_bytes(t->sim, &run));
}

FIXTURE void read_checkpoint(const trial *t, const char *path)
{
    checkpoint_extra extra[FIXTURE_EXTRAS];
    checkpoint_run run = checkpoint_of(t, extra);
    check_ok(t->ctx, checkpoint_read(t->sim, path, &run));
}

/* A run that goes on comes to the bits of one that is read from its checkpoint, in another way. */
FIXTURE void same_after_resuming(begin_trial *begin, const void *one, const void *other, int before, int after)
{
    const checkpoint_place place = checkpoint_place_make();
    trial t;
    begin(&t, one);
    check_ok(t.ctx, io_init(t.ctx));
    trial_steps(&t, before);
    write_checkpoint(&t, place.path);
    trial_steps(&t, after);
    state expected = trial_finish(&t);
    begin(&t, other);
    read_checkpoint(&t, place.path);
    trial_steps(&t, after);
    state found = trial_finish(&t);
    same_state(&expected, &found);
    state_free(&expected);
    state_free(&found);
    checkpoint_place_remove(&place);
}

/* A scene on that many blocks along each axis, without its simulation. */
typedef void begin_blocks(trial *t, int blocks);

/* Twice `steps` steps; with a path the first half writes a checkpoint there, from which a run on one block goes on. */
FIXTURE state run_in_halves(begin_blocks *begin, int steps, int blocks, int threads, const char *path)
{
    trial t;
    begin(&t, blocks);
    use_threads(threads);
    check_ok(t.ctx, sim_create(&t.sim, t.ctx, t.scene, COUPLING_ICE_MPM));
    trial_steps(&t, steps);
    if (path) {
        check_ok(t.ctx, io_init(t.ctx));
        write_checkpoint(&t, path);
        trial_end(&t);
        begin(&t, 1);
        check_ok(t.ctx, sim_create(&t.sim, t.ctx, t.scene, COUPLING_ICE_MPM));
        read_checkpoint(&t, path);
    }
    trial_steps(&t, steps);
    return trial_finish(&t);
}

/* Runs a scene on that many blocks along each axis and threads; with a path, through a checkpoint there on the way. */
typedef state bits_run(int blocks, int threads, const char *path);

/* Any blocks and threads, and a run resumed on other blocks, come to the same bits. */
FIXTURE void same_bits_however_run(bits_run *run)
{
    const checkpoint_place place = checkpoint_place_make();
    state expected = run(1, 1, NULL);
    static const int other[][2] = {{2, 2}, {2, 1}, {1, 2}};
    for (int k = 0; k < 3; ++k) {
        state found = run(other[k][0], other[k][1], k == 0 ? place.path : NULL);
        same_state(&expected, &found);
        state_free(&found);
    }
    state_free(&expected);
    checkpoint_place_remove(&place);
}

#endif
