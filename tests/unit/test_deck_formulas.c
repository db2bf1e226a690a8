/* Decks whose numbers are formulas: what they become in cells and points, the echo, and what is refused, with its place. */
#include "check.h"

#include "base/memory.h"
#include "deck/deck.h"
#include "mpm/mpm.h"
#include "run/catalogue.h"
#include "run/setup.h"
#include "scene/formula.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct fixture {
    context *ctx;
    deck_catalogue *catalogue;
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

/* A tube of gas, its state by keys of the body, whose temperature is left to the equation of state. */
static const char tube[] = "floe: 1\n"
                           "coupling: %s\n"
                           "constants: {L: 200 cm, p0: 1 bar, mean: 1.2 kg/m3, share: 20 / 100}\n"
                           "tables: {step: {at: [0, 1 m, 2 m], values: [10 m/s, 30 m/s, 10 m/s]}}\n"
                           "domain: {dim: 1, lower: 0, upper: L, cell: L / 40}\n"
                           "materials: {gas: {eos: {ideal: {gamma: 1.4, specific_heat: 700}}}}\n"
                           "boundaries: periodic\n"
                           "bodies:\n"
                           "  gas:\n"
                           "    material: gas\n"
                           "    shape: {box: {lower: 0, upper: L}}\n"
                           "    %s\n"
                           "time: {end: 1 ms}\n";
static const char wave[] =
    "{pressure: \"p0\", density: \"mean * (1 + share * sin(2 * pi * x / L))\", velocity: \"step(x)\"}";

static floe_status load_tube(fixture *f, const char *coupling, const char *body, const char *const *set, size_t n_set,
                             scene **s, deck_report *report)
{
    char text[2000], keys[800];
    const deck_overrides overrides = {set, n_set};
    /* The keys of the body, each on its line. */
    snprintf(keys, sizeof keys, "%.*s", (int)strlen(body) - 2, body + 1);
    for (char *c = strstr(keys, ", "); c; c = strstr(c + 1, ", "))
        if (strchr("pdvft", c[2])) *c = '\n';
    char spaced[1000] = "";
    for (char *line = strtok(keys, "\n"); line; line = strtok(NULL, "\n"))
        snprintf(spaced + strlen(spaced), sizeof spaced - strlen(spaced), "%s%s\n", spaced[0] ? "    " : "",
                 line + strspn(line, " "));
    snprintf(text, sizeof text, tube, coupling, spaced);
    return deck_load_text(s, f->ctx, "tube.yaml", text, strlen(text), &overrides, f->catalogue, report);
}

static scene *good_tube(fixture *f, const char *coupling, const char *const *set, size_t n_set)
{
    deck_report report;
    scene *s;
    const floe_status status = load_tube(f, coupling, wave, set, n_set, &s, &report);
    if (report.text) print_error("%s", report.text);
    deck_report_free(&report);
    check_ok(f->ctx, status);
    return s;
}

/* Averages of the sine over cells are exact to h^6: 4e-11 here; momentum's have the table's kink on a face. */
static void test_cells_have_averages(void **state)
{
    fixture *f = *state;
    scene *s = good_tube(f, "ice", NULL, 0);
    run_setup setup;
    const double pi = 3.14159265358979323846, L = 2.0, h = L / 40;
    check_ok(f->ctx, setup_begin(&setup, s));
    const domain *d = setup.sim->domain;
    const block *b = &d->mesh->block[0];
    double most = 0.0;
    for (int i = 0; i < 40; ++i) {
        const double lo = i * h, hi = lo + h;
        const double rho = 1.2 * (1.0 + 0.2 * (cos(2 * pi * lo / L) - cos(2 * pi * hi / L)) * L / (2 * pi * h));
        const double got = field_get(d->fields[0], C_RHO, 0, 0)[mesh_index(b, i, 0, 0)];
        const double u = field_get(d->fields[0], C_VEL, 0, 0)[mesh_index(b, i, 0, 0)], at = lo + 0.5 * h;
        check_close_relative(got, rho, 2e-11);
        most = fmax(most, fabs(got - 1.2 * (1.0 + 0.2 * sin(2 * pi * at / L))));
        check_close(u, at < 1.0 ? 10.0 + 20.0 * at : 50.0 - 20.0 * at, 0.02);
    }
    check_true(most > 1e-5); /* the value in the middle of a cell is another */
    setup_end(&setup);
    scene_destroy(&s);
}

static void test_points_have_values(void **state)
{
    fixture *f = *state;
    scene *s = good_tube(f, "mpm", NULL, 0);
    run_setup setup;
    const double pi = 3.14159265358979323846;
    check_ok(f->ctx, setup_begin(&setup, s));
    const fields *of = setup.sim->domain->fields[0];
    const double *x = field_get(of, P_POS, 0, 0), *v = field_get(of, P_VEL, 0, 0), *mass = field_get(of, P_MASS, 0, 0);
    for (size_t k = 0; k < 80; ++k) {
        check_close(v[k], x[k] < 1.0 ? 10.0 + 20.0 * x[k] : 50.0 - 20.0 * x[k], 1e-12);
        check_close_relative(mass[k], 0.025 * 1.2 * (1.0 + 0.2 * sin(pi * x[k])), 1e-12);
    }
    setup_end(&setup);
    scene_destroy(&s);
}

/* --set reaches constants; the echo loads to the same scene, formulas and tables and all. */
static void test_constants_can_be_set_and_echo_is_whole(void **state)
{
    fixture *f = *state;
    const char *set[] = {"constants.share=0.5", "constants.L=4 m"};
    deck_report report;
    char *text, *again;
    scene *s = good_tube(f, "ice", set, 2), *copy;
    double value;
    check_close(s->mesh.upper[0], 4.0, 0.0);
    check_close(s->mesh.cell[0], 0.1, 1e-17);
    check_ok(f->ctx, scene_number(s, &s->body[0].density, (const double[3]){1.0, 0.0, 0.0}, 0.0, &value));
    check_close_relative(value, 1.8, 1e-15);
    check_ok(f->ctx, deck_echo(&text, s, f->catalogue));
    check_ok(f->ctx, deck_load_text(&copy, f->ctx, "echo.yaml", text, strlen(text), NULL, f->catalogue, &report));
    check_ok(f->ctx, deck_echo(&again, copy, f->catalogue));
    assert_string_equal(text, again);
    check_ok(f->ctx, scene_number(copy, &copy->body[0].velocity[0], (const double[3]){0.5, 0.0, 0.0}, 0.0, &value));
    check_close_relative(value, 20.0, 1e-15);
    memory_free(f->ctx, &text);
    memory_free(f->ctx, &again);
    deck_report_free(&report);
    scene_destroy(&copy);
    scene_destroy(&s);
}

/* Wrong formulas: where they stand, and what is wrong. */
static void test_wrong_ones_are_refused(void **state)
{
    fixture *f = *state;
    const struct {
        const char *body, *says;
    } row[] = {
        {"{pressure: p0 + 5 m, density: mean}", "'+' of m-1 kg s-2 and m"},
        {"{pressure: p0 * (1 + x, density: mean}", "not closed"},
        {"{pressure: p0 + y, density: mean}", "'y' is not known"},
        {"{pressure: p0 + t, density: mean}", "'+' of m-1 kg s-2 and s"},
        {"{pressure: 1e5 * (1 + t), density: mean}", "changes with time"},
        {"{pressure: p0 * x / x * mean, density: mean}", "does not give Pa"},
        {"{pressure: p0, density: mean / (0 * mean)}", "out of range"},
        {"{pressure: p0, density: mean, fraction: x}", NULL},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; ++i) {
        deck_report report;
        scene *s;
        const floe_status status = load_tube(f, "ice", row[i].body, NULL, 0, &s, &report);
        if (!row[i].says) {
            check_ok(f->ctx, status);
            scene_destroy(&s);
            continue;
        }
        check_fails(f->ctx, status, FLOE_BAD_INPUT);
        if (!strstr(report.text, row[i].says)) print_error("%s", report.text);
        check_true(strstr(report.text, row[i].says));
        check_true(strstr(report.text, "tube.yaml:1"));
        deck_report_free(&report);
    }
}

/* A formula that gives no state of the gas somewhere is refused before the run, with its key and place. */
static void test_no_state_somewhere(void **state)
{
    fixture *f = *state;
    deck_report report;
    run_setup setup;
    scene *s;
    check_ok(f->ctx, load_tube(f, "ice", "{pressure: p0, density: mean - 1 * x}", NULL, 0, &s, &report));
    assert_int_equal(setup_begin(&setup, s), FLOE_BAD_INPUT);
    check_true(strstr(context_message(f->ctx), "bodies.gas.density"));
    check_true(strstr(context_message(f->ctx), "the formula gives -"));
    check_true(strstr(context_message(f->ctx), "tube.yaml:1"));
    context_clear(f->ctx);
    setup_end(&setup);
    scene_destroy(&s);
}

/* A table in a file: by the names of its columns, and with what is wrong with it. */
static void test_table_files(void **state)
{
    fixture *f = *state;
    char name[] = "/tmp/floe-test-XXXXXX", set[200];
    const int descriptor = mkstemp(name);
    FILE *file = fdopen(descriptor, "w");
    fputs("time (s), other, value\n0, 7, 1\n# between\n0.5, 7, 2\n1, 7, 5\n", file);
    fclose(file);
    const char *const all[] = {set};
    double value;
    snprintf(set, sizeof set, "tables.step={file: \"%s\", from: time, to: value}", name);
    scene *s = good_tube(f, "ice", all, 1);
    check_ok(f->ctx, scene_number(s, &s->body[0].velocity[0], (const double[3]){0.75, 0.0, 0.0}, 0.0, &value));
    check_close(value, 3.5, 1e-15);
    scene_destroy(&s);
    const struct {
        const char *table, *says;
    } wrong[] = {
        {"tables.step={file: \"%s\", from: when, to: value}", "names no column 'when'"},
        {"tables.step={file: \"%s\", from: other, to: value}", "is not beyond the one before it"},
        {"tables.step={file: \"%s\", at: [0, 1]}", "entries and a file"},
        {"tables.step={at: [0, 1], values: [1, 2, 3]}", "3 values at 2 places"},
        {"tables.step={at: [1, 0], values: [1, 2]}", "is not beyond the one before it"},
        {"tables.step={file: no.csv}", "cannot open"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        deck_report report;
        snprintf(set, sizeof set, wrong[i].table, name);
        check_fails(f->ctx, load_tube(f, "ice", wave, all, 1, &s, &report), FLOE_BAD_INPUT);
        if (!strstr(report.text, wrong[i].says)) print_error("%s", report.text);
        check_true(strstr(report.text, wrong[i].says));
        deck_report_free(&report);
    }
    (void)unlink(name);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cells_have_averages),    cmocka_unit_test(test_points_have_values),
        cmocka_unit_test(test_wrong_ones_are_refused), cmocka_unit_test(test_constants_can_be_set_and_echo_is_whole),
        cmocka_unit_test(test_no_state_somewhere),     cmocka_unit_test(test_table_files),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
