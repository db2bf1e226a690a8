/* Decks that load: values, defaults, units, overrides, and the echo that loads to the same scene. */
#include "check.h"

#include "base/memory.h"
#include "deck/deck.h"
#include "run/catalogue.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct fixture {
    context *ctx;
    deck_catalogue *catalogue; /* the program's own: the inputs name all kinds of things */
} fixture;

static int set_up(void **state)
{
    static fixture f;
    deck_init();
    f.ctx = context_create();
    *state = &f;
    return f.ctx && catalogue_create(&f.catalogue, f.ctx) == FLOE_OK ? 0 : -1;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    catalogue_destroy(f->ctx, &f->catalogue);
    assert_int_equal(memory_read_account(f->ctx).live_bytes, 0);
    context_destroy(&f->ctx);
    return 0;
}

/* Loads a file of inputs/ with overrides; the report is printed when it fails. */
static scene *load_input(fixture *f, const char *name, const char *const *set, size_t n)
{
    char path[512];
    deck_report report;
    scene *s;
    const deck_overrides overrides = {set, n};
    snprintf(path, sizeof path, "%s/inputs/%s", FLOE_SOURCE_DIR, name);
    const floe_status status = deck_load(&s, f->ctx, path, &overrides, f->catalogue, &report);
    if (report.text) print_error("%s", report.text);
    deck_report_free(&report);
    check_ok(f->ctx, status);
    return s;
}

static scene *load_text(fixture *f, const char *text)
{
    deck_report report;
    scene *s;
    const floe_status status = deck_load_text(&s, f->ctx, "deck.yaml", text, strlen(text), NULL, f->catalogue, &report);
    if (report.text) print_error("%s", report.text);
    deck_report_free(&report);
    check_ok(f->ctx, status);
    return s;
}

static char *echo(fixture *f, const scene *s)
{
    char *text;
    check_ok(f->ctx, deck_echo(&text, s, f->catalogue));
    return text;
}

/* ---- values ---- */

static void cylinder_has_its_values(void **state)
{
    fixture *f = *state;
    scene *s = load_input(f, "pressurized_cylinder.yaml", NULL, 0);
    assert_string_equal(s->title, "Pressurised thick cylinder");
    assert_int_equal(s->coupling, COUPLING_ICE_MPM);
    assert_int_equal(s->n_runs_as, 2);
    assert_int_equal(s->runs_as[0], COUPLING_MPM);
    assert_int_equal(s->mesh.dim, 2);
    check_close(s->mesh.upper[1], 1.2, 0.0);
    check_close(s->mesh.cell[1], 0.025, 0.0);
    assert_int_equal(s->mesh.blocks[0], 1);
    assert_int_equal(s->bc.side[0][SIDE_LOWER].kind, BC_SYMMETRY);
    assert_int_equal(s->bc.side[1][SIDE_UPPER].kind, BC_OUTLET);
    check_close(s->bc.side[1][SIDE_UPPER].pressure, 101325.0, 0.0);

    assert_int_equal(s->n_materials, 2);
    assert_int_equal(s->material[0].kind, MATERIAL_SOLID);
    assert_string_equal(s->material[0].law->name, "linear_elastic");
    check_close_relative(s->material[0].law->bulk_modulus(s->material[0].law_par), 117e9, 1e-15);
    check_close_relative(s->material[0].law->shear_modulus(s->material[0].law_par), 43.8e9, 1e-15);
    check_close(s->material[0].density, 8900.0, 0.0);
    assert_int_equal(s->material[1].kind, MATERIAL_FLUID);
    assert_string_equal(s->material[1].eos.model->name, "ideal");

    check_true(s->has_ambient);
    assert_int_equal(s->ambient_material, 1);
    assert_int_equal(s->n_bodies, 2);
    assert_string_equal(s->body[0].shape.model->name, "annulus");
    assert_int_equal(s->body[0].per_cell[1], 2);
    assert_int_equal(s->body[0].per_cell[2], 1);
    check_close(s->body[0].temperature, 300.0, 0.0);
    check_true(isnan(s->body[1].density));

    assert_int_equal(s->n_loads, 1);
    assert_int_equal(s->load[0].kind, LOAD_PRESSURISE);
    check_close_relative(s->load[0].target, 19.4e6, 1e-15);
    check_close_relative(s->load[0].ramp, 1.4e-3, 1e-15);
    check_true(s->load[0].hold);
    check_close(s->damping.rate, 1.2e4, 0.0);
    check_true(isinf(s->damping.end));
    check_true(s->rest.enabled);
    check_close_relative(s->time.end, 0.01, 1e-15);
    assert_string_equal(s->verify.exact, "lame");
    assert_int_equal(s->verify.n_metrics, 3);
    assert_int_equal(s->verify.body, 0);
    assert_string_equal(s->batches->compare.key, "domain.cell");
    assert_int_equal(s->batches->compare.n_values, 3);
    scene_destroy(&s);
}

static const char small[] = "floe: 1\n"
                            "coupling: mpm\n"
                            "domain: {dim: 1, lower: 0, upper: 1, cell: 0.1}\n"
                            "materials: {m: {density: 1, law: {linear_elastic: {bulk_modulus: 1, shear_modulus: 1}}}}\n"
                            "bodies: {b: {material: m, shape: {box: {lower: 0, upper: 1}}}}\n"
                            "time: {end: 1}\n";

static void moduli_by_young(void **state)
{
    fixture *f = *state;
    char text[sizeof small + 40];
    const char *at = strstr(small, "bulk_modulus");
    (void)snprintf(text, sizeof text, "%.*syoung_modulus: 210 GPa, poisson_ratio: 0.3%s", (int)(at - small), small,
                   strchr(at, '}'));
    scene *s = load_text(f, text);
    check_close_relative(s->material[0].law->bulk_modulus(s->material[0].law_par), 175e9, 1e-14);
    check_close_relative(s->material[0].law->shear_modulus(s->material[0].law_par), 210e9 / 2.6, 1e-14);
    scene_destroy(&s);
}

/* The schema's defaults are those of scene_create: a program that fills a scene by hand gets the same. */
static void defaults_agree_with_scene_create(void **state)
{
    fixture *f = *state;
    scene *s = load_text(f, small), *made;
    check_ok(f->ctx, scene_create(&made, f->ctx));
    check_close(s->thickness, made->thickness, 0.0);
    check_close(s->reference_pressure, made->reference_pressure, 0.0);
    assert_string_equal(s->method.basis, made->method.basis);
    assert_int_equal(s->method.stress, made->method.stress);
    check_true(isnan(s->method.flip) && isnan(made->method.flip));
    assert_string_equal(scene_transfer(s), scene_transfer(made));
    assert_int_equal(s->method.centring, made->method.centring);
    assert_int_equal(s->method.conserve_energy, made->method.conserve_energy);
    assert_int_equal(s->method.limiter, made->method.limiter);
    check_true(isnan(s->method.exchange) && isnan(made->method.exchange));
    check_close(s->method.heat_exchange, made->method.heat_exchange, 0.0);
    check_close(s->method.volume_relaxation, made->method.volume_relaxation, 0.0);
    check_close(s->time.cfl_mpm, made->time.cfl_mpm, 0.0);
    check_close(s->time.cfl_ice, made->time.cfl_ice, 0.0);
    check_close(s->time.growth, made->time.growth, 0.0);
    assert_int_equal(s->time.max_steps, made->time.max_steps);
    check_true(isnan(s->time.first_step) && isnan(s->time.max_step) && isnan(s->time.fixed_step));
    check_close(s->damping.rate, made->damping.rate, 0.0);
    check_true(!s->rest.enabled && !s->has_ambient);
    check_true(isinf(s->output.interval) && isnan(s->output.history_interval));
    assert_int_equal(s->verify.body, made->verify.body);
    assert_int_equal(s->verify.material, made->verify.material);
    assert_int_equal(s->threads, made->threads);
    assert_int_equal(s->n_runs_as, 1);
    assert_int_equal(s->bc.side[0][0].kind, BC_FREE);
    scene_destroy(&made);
    scene_destroy(&s);
}

typedef struct number_case {
    const char *assignment;
    double si;
} number_case;

static void units_are_converted(void **state)
{
    fixture *f = *state;
    static const number_case cases[] = {
        {"bodies.bore.temperature=20 degC", 293.15}, {"bodies.bore.temperature=300", 300.0},
        {"bodies.bore.temperature=+3.5e2 K", 350.0}, {"bodies.bore.temperature='540 degR'", 300.0},
        {"bodies.bore.temperature=.3 kK", 300.0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        scene *s = load_input(f, "pressurized_cylinder.yaml", &cases[i].assignment, 1);
        check_close_relative(s->body[1].temperature, cases[i].si, 1e-14);
        scene_destroy(&s);
    }
}

static void density_and_temperature_give_the_pressure(void **state)
{
    fixture *f = *state;
    const char *set[] = {"bodies.bore={material: gas, shape: {ball: {radius: 0.5}}, density: 1.2, temperature: 300}"};
    scene *s = load_input(f, "pressurized_cylinder.yaml", set, 1);
    check_close_relative(s->body[1].pressure, 0.4 * 1.2 * 717.5 * 300.0, 1e-14);
    check_close(s->body[1].density, 1.2, 0.0);
    check_true(isnan(s->body[1].temperature));
    scene_destroy(&s);
}

static void axes_are_r_and_z_when_axisymmetric(void **state)
{
    fixture *f = *state;
    scene *s = load_text(f, "floe: 1\ncoupling: ice\n"
                            "domain: {geometry: axisymmetric, lower: [0, 0], upper: [1, 2], cell: 0.5}\n"
                            "materials: {g: {eos: {ideal: {specific_heat: 700}}, viscosity: {shear: 1e-3}}}\n"
                            "boundaries: {z: periodic, r: {upper: {no_slip: {velocity: [0, 2]}}}}\n"
                            "bodies: {b: {material: g, shape: {ball: {radius: 5}}, pressure: 1e5, temperature: 300}}\n"
                            "time: {end: 1, cfl: {ice: 0.3}}\n");
    assert_int_equal(s->mesh.geometry, MESH_AXISYMMETRIC);
    assert_int_equal(s->bc.side[0][SIDE_LOWER].kind, BC_SYMMETRY);
    assert_int_equal(s->bc.side[0][SIDE_UPPER].kind, BC_NO_SLIP);
    check_close(s->bc.side[0][SIDE_UPPER].velocity[1], 2.0, 0.0);
    check_true(s->mesh.periodic[1] && !s->mesh.periodic[0]);
    check_close(s->time.cfl_ice, 0.3, 0.0);
    check_close(s->time.cfl_mpm, 0.5, 0.0);
    scene_destroy(&s);
}

/* ---- overrides ---- */

static void overrides_reach_any_key(void **state)
{
    fixture *f = *state;
    const char *set[] = {"domain.cell=0.05",
                         "materials.steel.law.linear_elastic.bulk_modulus=120 GPa",
                         "bodies.cylinder.points=[3, 4]",
                         "domain.upper.1=1.5",
                         "loads.heating.pressurise.hold=false",
                         "damping.end=2 ms",
                         "output.probes.centre=[0.1, 0.1]",
                         "compare.axis.domain.cell=[0.1]",
                         "domain.cell=0.1",
                         "coupling=mpm"};
    scene *s = load_input(f, "pressurized_cylinder.yaml", set, sizeof set / sizeof set[0]);
    check_close(s->mesh.cell[0], 0.1, 0.0);
    check_close(s->mesh.upper[1], 1.5, 0.0);
    check_close_relative(s->material[0].law->bulk_modulus(s->material[0].law_par), 120e9, 1e-15);
    assert_int_equal(s->body[0].per_cell[1], 4);
    check_true(!s->load[0].hold);
    check_close_relative(s->damping.end, 2e-3, 1e-15);
    assert_int_equal(s->n_probes, 1);
    assert_string_equal(s->probe[0].name, "centre");
    assert_int_equal(s->batches->compare.n_values, 1);
    assert_int_equal(s->coupling, COUPLING_MPM);
    scene_destroy(&s);
}

static void null_takes_a_key_away(void **state)
{
    fixture *f = *state;
    const char *set[] = {"loads.heating.pressurise.ramp=null", "loads.heating.pressurise.ramp_steps=500",
                         "output.interval=~"};
    scene *s = load_input(f, "pressurized_cylinder.yaml", set, sizeof set / sizeof set[0]);
    assert_int_equal(s->load[0].ramp_steps, 500);
    check_close(s->load[0].ramp, 0.0, 0.0);
    check_true(isinf(s->output.interval));
    scene_destroy(&s);
}

/* What is not there may be taken away, as --set and an axis of a study do one after the other; then it may be given anew. */
static void null_of_what_is_not_there_changes_nothing(void **state)
{
    fixture *f = *state;
    const char *set[] = {"stop=null",        "stop=null",        "stop.window=null",        "verify.reference=null",
                         "bodies.bore=null", "bodies.bore=null", "bodies.bore.points=null", "method=null",
                         "method.basis=null"};
    scene *s = load_input(f, "pressurized_cylinder.yaml", set, sizeof set / sizeof set[0]);
    assert_int_equal(s->n_bodies, 1);
    assert_false(s->rest.enabled);
    scene_destroy(&s);
    const char *anew[] = {"bodies.bore=null",
                          "bodies.bore={material: gas, shape: {ball: {radius: 0.5}}, pressure: 2e5, temperature: 300}"};
    s = load_input(f, "pressurized_cylinder.yaml", anew, 2);
    assert_int_equal(s->n_bodies, 2);
    scene_destroy(&s);
}

/* ---- echo ---- */

static void check_same_shape(const shape *a, const shape *b)
{
    check_true(a->model == b->model);
    for (size_t k = 0; a->model && k < a->model->n_params; k++) {
        const param_spec *spec = &a->model->params[k];
        const char *p = (const char *)a->par + spec->offset, *q = (const char *)b->par + spec->offset;
        const param_list *list = (const param_list *)(const void *)p, *other = (const param_list *)(const void *)q;
        const size_t count = (size_t)(spec->count < 0 ? -spec->count : spec->count);
        switch (spec->kind) {
        case PARAM_NUMBERS: assert_memory_equal(p, q, count * sizeof(double)); break;
        case PARAM_MODEL: check_same_shape((const shape *)(const void *)p, (const shape *)(const void *)q); break;
        case PARAM_POINTS:
        case PARAM_MODELS:
            assert_int_equal(list->n, other->n);
            for (size_t i = 0; i < list->n && spec->kind == PARAM_MODELS; i++)
                check_same_shape((const shape *)list->item + i, (const shape *)other->item + i);
            if (spec->kind == PARAM_POINTS) assert_memory_equal(list->item, other->item, list->n * 3 * sizeof(double));
            break;
        case PARAM_FILE:
            assert_string_equal(((const param_file *)(const void *)p)->digest,
                                ((const param_file *)(const void *)q)->digest);
            break;
        }
    }
}

static void check_round_trip(fixture *f, const scene *s)
{
    char *first = echo(f, s);
    scene *again = load_text(f, first);
    char *second = echo(f, again);
    assert_string_equal(first, second);
    /* What a table cannot show is plain data: it must have the same bytes. */
    assert_memory_equal(&s->mesh, &again->mesh, sizeof s->mesh);
    assert_memory_equal(&s->bc, &again->bc, sizeof s->bc);
    assert_memory_equal(&s->method.exchange, &again->method.exchange, 3 * sizeof(double));
    assert_memory_equal(&s->time, &again->time, sizeof s->time);
    assert_memory_equal(&s->rest, &again->rest, sizeof s->rest);
    assert_memory_equal(&s->output, &again->output, sizeof s->output);
    for (int i = 0; i < s->n_bodies; i++) {
        check_same_shape(&s->body[i].shape, &again->body[i].shape);
        assert_memory_equal(&s->body[i].membrane.thickness, &again->body[i].membrane.thickness, sizeof(double));
        assert_memory_equal(s->body[i].velocity, again->body[i].velocity, 6 * sizeof(double));
    }
    memory_free(f->ctx, &first);
    memory_free(f->ctx, &second);
    scene_destroy(&again);
}

/* Shapes of shapes, down to any depth, in their own dimensions and units. */
static void shapes_of_shapes(void **state)
{
    fixture *f = *state;
    static const char text[] =
        "floe: 1\n"
        "coupling: mpm\n"
        "domain: {dim: 3, lower: [0, 0, 0], upper: [1, 1, 1], cell: 0.1}\n"
        "materials: {s: {density: 1, law: {neo_hookean: {bulk_modulus: 1, shear_modulus: 1}}}}\n"
        "bodies:\n"
        "  b:\n"
        "    material: s\n"
        "    shape:\n"
        "      union:\n"
        "        - extruded: {of: {polygon: {vertices: [[0, 0], [40 cm, 0], [0, 0.3]]}}, from: 0, to: 1}\n"
        "        - difference:\n"
        "            of: {moved: {of: {box: {lower: [0.5, 0, 0], upper: [1, 1, 1]}}, turned: 30 degree, axis: [0, 1, "
        "1]}}\n"
        "            without:\n"
        "              - intersection: [{ball: {radius: 0.2}}, {revolved: {of: {ball: {centre: [0.1, 0], radius: "
        "1}}}}]\n"
        "              - union: [{union: [{union: [{union: [{union: [{union: [{ball: {radius: 0.1}}]}]}]}]}]}]\n"
        "time: {end: 1}\n";
    scene *s = load_text(f, text);
    const shape_model *whole = s->body[0].shape.model;
    assert_string_equal(whole->name, "union");
    const param_list *list = s->body[0].shape.par;
    const shape *part = list->item;
    assert_int_equal(list->n, 2);
    assert_string_equal(part[0].model->name, "extruded");
    const shape *moved = part[1].par; /* `of` comes first */
    check_close(*param_find(moved->model->params, moved->model->n_params, moved->par, "turned"), acos(-1.0) / 6.0,
                1e-15);
    check_true(shape_inside(&s->body[0].shape, 3, (const double[]){0.1, 0.1, 0.5}));
    check_true(!shape_inside(&s->body[0].shape, 3, (const double[]){0.35, 0.1, 0.5}));
    check_round_trip(f, s);
    scene_destroy(&s);
}

static void every_input_loads_and_echoes(void **state)
{
    fixture *f = *state;
    DIR *directory = opendir(FLOE_SOURCE_DIR "/inputs");
    int found = 0;
    assert_non_null(directory);
    for (struct dirent *entry = readdir(directory); entry; entry = readdir(directory)) {
        if (!strstr(entry->d_name, ".yaml")) continue;
        scene *s = load_input(f, entry->d_name, NULL, 0);
        check_round_trip(f, s);
        scene_destroy(&s);
        found++;
    }
    closedir(directory);
    check_true(found >= 9);
}

static const char full[] =
    "floe: 1\n"
    "title: \"quotes \\\" and \\\\ and \\t\"\n"
    "coupling: ice-mpm\n"
    "domain: {dim: 2, stress_state: plane_stress, lower: [-0.1, 0], upper: [0.2, 0.3], cell: [0.1, 0.05], thickness: "
    "0.3}\n"
    "materials:\n"
    "  s: {density: 1, law: {neo_hookean: {bulk_modulus: 3, shear_modulus: 1}}, specific_heat: 1.1}\n"
    "  g: {eos: {stiffened: {gamma: 4.4, p_inf: 6e8, specific_heat: 1000}}, viscosity: {shear: 1e-3 Pa s}}\n"
    "ambient: {material: g, pressure: 0.1 MPa, temperature: 281 K}\n"
    "boundaries:\n"
    "  x: {lower: {inlet: {velocity: [1, 0], pressure: 1 bar, temperature: 290}}, upper: {outlet: {pressure: 1 bar}}}\n"
    "  y: {lower: {velocity: {velocity: [0, 0.1]}}, upper: no_slip}\n"
    "bodies: {b: {material: s, shape: {ball: {radius: 0.1}}, velocity: [0.1, 0.2], seeding: lattice, points: [1, 3]}}\n"
    "loads:\n"
    "  a: {gravity: {acceleration: [0, -9.81]}}\n"
    "  b: {body_force: {body: b, acceleration: [0.3, 0]}}\n"
    "  c: {traction: {body: b, surface: {ball: {radius: 0.1}}, pressure: 3 kPa, start: 1 ms, ramp: 2 ms}}\n"
    "  d: {heat: {material: g, power: 1 MW/m3, ramp_steps: 500, hold: true}}\n"
    "damping: {rate: 0.1, start: 0.2, end: 0.3}\n"
    "time: {end: 1 h, cfl: {mpm: 0.4, ice: 0.3}, first_step: 1 us, max_step: 1 ms, growth: 1.2, max_steps: 7}\n"
    "stop: {}\n"
    "method: {basis: gimp, stress: musl, flip: 0.9, centring: half, energy: internal, limiter: none, exchange: 1e-1}\n"
    "output: {interval: 0.1, probes: {p: [0.1, 0.1], q: [0.2, 0.3]}}\n"
    "study:\n"
    "  axes: {domain.thickness: {values: [0.3, 0.4 m], with: {method.flip: [0.8, null], bodies.b.points: [[1, 3], [2, "
    "2]]}},\n"
    "         coupling: [ice-mpm], bodies.b.velocity: [[0, 0], [0.1, 0]],\n"
    "         method: [{basis: linear}]}\n"
    "  over: domain.thickness\n"
    "  repeat: 3\n"
    "  max_wall: 1 min\n"
    "  quantities: [kinetic, strain]\n"
    "  require: [{metric: kinetic, order: 1.5, where: {bodies.b.velocity: [0.1, 0], coupling: ice-mpm}},\n"
    "            {metric: strain, error: 2 %}]\n"
    "stability: {over: {time.max_step: [1 us, 2 ms]}, each: {method.stress: [usl, musl], domain.thickness: [0.1, "
    "0.2]},\n"
    "            tolerance: 1e-3, relative_to: 0.1}\n"
    "threads: 3\n";

static void check_study(const scene_study *study)
{
    assert_int_equal(study->n_axes, 4);
    assert_string_equal(study->axis[0].key, "domain.thickness");
    assert_string_equal(study->axis[0].value[1], "0.4 m");
    assert_int_equal(study->axis[0].n_with, 2);
    assert_string_equal(study->axis[0].with[1].key, "bodies.b.points");
    assert_string_equal(study->axis[0].with[1].value[1], "[2, 2]");
    assert_int_equal(study->axis[1].n_with, 0);
    assert_string_equal(study->axis[2].value[1], "[0.1, 0]");
    assert_string_equal(study->axis[3].value[0], "{basis: linear}");
    assert_int_equal(study->repeat, 3);
    check_close(study->max_wall, 60.0, 0.0);
    assert_int_equal(study->n_quantities, 2);
    assert_int_equal(study->n_bars, 2);
    check_close(study->bar[0].order, 1.5, 0.0);
    check_true(isnan(study->bar[0].error) && isnan(study->bar[1].order));
    check_close_relative(study->bar[1].error, 0.02, 1e-15);
    assert_int_equal(study->bar[0].where.n, 2);
    assert_string_equal(study->bar[0].where.value[0], "[0.1, 0]");
}

static void check_stability(const scene_stability *stability)
{
    check_true(stability->given);
    assert_int_equal(stability->n_over, 1);
    assert_string_equal(stability->over[0].key, "time.max_step");
    assert_string_equal(stability->over[0].value[1], "2 ms");
    assert_int_equal(stability->n_each, 2);
    assert_string_equal(stability->each[0].value[1], "musl");
    assert_int_equal(stability->each[1].n_values, 2);
    check_close(stability->tolerance, 1e-3, 0.0);
    check_close(stability->growth, 100.0, 0.0);
    check_close(stability->relative_to, 0.1, 0.0);
}

static void echo_keeps_every_key(void **state)
{
    fixture *f = *state;
    scene *s = load_text(f, full);
    assert_string_equal(s->title, "quotes \" and \\ and \t");
    assert_int_equal(s->stress_state, STRESS_PLANE);
    assert_int_equal(s->bc.side[0][0].material, 1);
    check_close(s->material[0].tension_switch, 1e5, 1e-9);
    check_close(s->body[0].temperature, 281.0, 0.0);
    check_true(!s->method.conserve_energy && s->rest.enabled);
    assert_int_equal(s->load[0].body, -1);
    assert_int_equal(s->load[1].body, 0);
    assert_int_equal(s->load[3].ramp_steps, 500);
    check_study(&s->batches->study);
    check_stability(&s->batches->stability);
    check_round_trip(f, s);
    scene_destroy(&s);
}

/* Keys by their paths, defaults included; what holds no single value has none. */
static void values_are_found_by_key(void **state)
{
    static const char *const found[][2] = {
        {"method.flip", "0.9"},
        {"domain.thickness", "0.3"},
        {"domain.cell.1", "0.05"},
        {"method.heat_exchange", "0"},
        {"bodies.b.points.1", "3"},
        {"method.basis", "gimp"},
        {"loads.d.heat.power", "1000000"},
        {"time.end", "3600"},
        {"stability.over.time.max_step.1", "2 ms"},
        {"domain.cell", ""},
        {"domain.cell.2", ""},
        {"domain.cell.x", ""},
        {"method.flop", ""},
        {"method.flip.0", ""},
        {"time", ""},
    };
    fixture *f = *state;
    scene *s = load_text(f, full);
    for (size_t i = 0; i < sizeof found / sizeof found[0]; i++) {
        char value[SCENE_VALUE], *end;
        check_ok(f->ctx, deck_value(value, s, f->catalogue, found[i][0]));
        const double wanted = strtod(found[i][1], &end);
        if (end == found[i][1] || *end)
            assert_string_equal(value, found[i][1]);
        else
            check_close(strtod(value, NULL), wanted, 0.0);
    }
    scene_destroy(&s);
}

/* ---- texts ---- */

static void starter_loads(void **state)
{
    fixture *f = *state;
    char *text;
    check_ok(f->ctx, deck_starter(&text, f->ctx, "my \"scene\""));
    scene *s = load_text(f, text);
    assert_string_equal(s->title, "my _scene_");
    memory_free(f->ctx, &text);
    scene_destroy(&s);
}

static void reference_and_schema_name_every_key(void **state)
{
    fixture *f = *state;
    char *page, *json;
    check_ok(f->ctx, deck_reference(&page, f->ctx, f->catalogue));
    check_ok(f->ctx, deck_json_schema(&json, f->ctx, f->catalogue));
    static const char *const words[] = {"volume_relaxation", "linear_elastic", "annulus", "lame",
                                        "no_slip",           "traction"};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        assert_non_null(strstr(page, words[i]));
        assert_non_null(strstr(json, words[i]));
    }
    memory_free(f->ctx, &page);
    memory_free(f->ctx, &json);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(cylinder_has_its_values, set_up, tear_down),
        cmocka_unit_test_setup_teardown(moduli_by_young, set_up, tear_down),
        cmocka_unit_test_setup_teardown(defaults_agree_with_scene_create, set_up, tear_down),
        cmocka_unit_test_setup_teardown(units_are_converted, set_up, tear_down),
        cmocka_unit_test_setup_teardown(density_and_temperature_give_the_pressure, set_up, tear_down),
        cmocka_unit_test_setup_teardown(axes_are_r_and_z_when_axisymmetric, set_up, tear_down),
        cmocka_unit_test_setup_teardown(overrides_reach_any_key, set_up, tear_down),
        cmocka_unit_test_setup_teardown(null_takes_a_key_away, set_up, tear_down),
        cmocka_unit_test_setup_teardown(null_of_what_is_not_there_changes_nothing, set_up, tear_down),
        cmocka_unit_test_setup_teardown(shapes_of_shapes, set_up, tear_down),
        cmocka_unit_test_setup_teardown(every_input_loads_and_echoes, set_up, tear_down),
        cmocka_unit_test_setup_teardown(echo_keeps_every_key, set_up, tear_down),
        cmocka_unit_test_setup_teardown(values_are_found_by_key, set_up, tear_down),
        cmocka_unit_test_setup_teardown(starter_loads, set_up, tear_down),
        cmocka_unit_test_setup_teardown(reference_and_schema_name_every_key, set_up, tear_down),
    };
    return cmocka_run_group_tests_name("deck_load", tests, NULL, NULL);
}
