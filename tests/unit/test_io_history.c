/* The history: columns with units, every digit kept, and resuming that drops what is later in one stroke. */
#include "test_io_fixture.h"

#include "io/history.h"
#include "test_io_faults.h"

enum { MAX_COLUMNS = 128 };

static const fixture_spec coupled = {.dim = 2, .cells = {24, 20}, .with_points = true, .with_cells = true};

/* A line of CSV cut into its columns, quotes kept. */
typedef struct columns {
    char text[8192];
    char *column[MAX_COLUMNS];
    int n;
} columns;

static const char *cut(const char *line, columns *c)
{
    const size_t length = strcspn(line, "\n");
    bool quoted = false;
    assert_true(length < sizeof c->text && line[length] == '\n');
    memcpy(c->text, line, length);
    c->text[length] = '\0';
    c->n = 0;
    c->column[c->n++] = c->text;
    for (char *at = c->text; *at; at++) {
        if (*at == '"') quoted = !quoted;
        if (*at != ',' || quoted) continue;
        *at = '\0';
        assert_true(c->n < MAX_COLUMNS);
        c->column[c->n++] = at + 1;
    }
    assert_false(quoted);
    return line + length + 1;
}

static const char *value_of(const columns *names, const columns *values, const char *name)
{
    assert_int_equal(names->n, values->n);
    for (int i = 0; i < names->n; i++) {
        if (strcmp(names->column[i], name) == 0) return values->column[i];
    }
    print_error("no column '%s'\n", name);
    assert_true(false);
    return "";
}

static double number_of(const columns *names, const columns *values, const char *name)
{
    char *end;
    const double x = strtod(value_of(names, values, name), &end);
    assert_int_equal(*end, '\0');
    return x;
}

static sim_totals some_totals(double time)
{
    sim_totals t = {
        .time = time, .mass = 1.0 / 3.0, .kinetic = 2.0, .strain = 3.0, .internal = 4.0, .momentum = {5.0, 6.0, 7.0}};
    for (int i = 0; i < 3; i++) {
        t.mpm.mass[i] = 10.0 + i;
        t.mpm.strain[i] = 20.0 + i;
        t.ice.mass[i] = 30.0 + i;
        t.ice.internal[i] = 40.0 + i;
    }
    return t;
}

static void append(fixture *f, history *h, double time)
{
    static double pressure[SCENE_MAX_MATERIALS];
    const sim_totals totals = some_totals(time);
    pressure[2] = 1.0e7 / 3.0;
    const history_row row = {&totals, pressure};
    f->sim.time = time;
    check_ok(f->ctx, history_append(h, &f->sim, &row));
}

static void rows_parse_back(void **state)
{
    (void)state;
    fixture f;
    history *h;
    char folder[FIXTURE_PATH], path[FIXTURE_PATH];
    static columns names, values;
    fixture_folder(folder);
    fixture_path(path, folder, "history.csv");
    fixture_make(&f, &coupled);
    check_ok(f.ctx, history_open(&h, &f.sim, path, -INFINITY));
    append(&f, h, 0.1);
    f.sim.dt_reason = "a \"quoted\", reason";
    append(&f, h, 0.2);
    check_ok(f.ctx, history_sync(h));
    history_close(&h);
    char *text = fixture_read(f.ctx, path, NULL);
    const char *next = cut(cut(text, &names), &values);
    assert_true(number_of(&names, &values, "time (s)") == 0.1);
    assert_true(number_of(&names, &values, "dt (s)") == 1.0 / 3.0);
    assert_true(number_of(&names, &values, "mass (kg)") == 2.0 / 3.0);
    assert_true(number_of(&names, &values, "momentum_y (N s)") == 12.0);
    assert_true(number_of(&names, &values, "mass_steel (kg)") == 20.0);       /* points */
    assert_true(number_of(&names, &values, "strain_soft___wet (J)") == 42.0); /* a name made plain */
    assert_true(number_of(&names, &values, "mass_gas (kg)") == 64.0);         /* cells */
    assert_true(number_of(&names, &values, "internal_gas (J)") == 84.0);
    assert_true(number_of(&names, &values, "pressure_gas (Pa)") == 1.0e7 / 3.0);
    assert_true(number_of(&names, &values, "steps") == 1234.0);
    assert_true(number_of(&names, &values, "ledger_energy_source (J)") ==
                2.0 * (4.0 + 1.0 / 3.0 + 1e-20)); /* 2 m thick */
    check_close(number_of(&names, &values, "drift_mass (1)"), ledger_drift(&f.sim.ledger, LEDGER_MASS), 0.0);
    assert_string_equal(value_of(&names, &values, "dt_limit"), "\"wave speed, in 'steel'\"");
    /* The probe at (0.55, 0.5): global cell (5, 2), as 0.25 is the lower end of y. */
    check_close(number_of(&names, &values, "middle_pressure (Pa)"), fixture_value(C_PRESSURE, 0, 2 * 24 + 5), 0.0);
    next = cut(next, &values);
    assert_string_equal(value_of(&names, &values, "dt_limit"), "\"a 'quoted', reason\"");
    assert_int_equal(*next, '\0');
    memory_free(f.ctx, &text);
    fixture_free(&f);
    fixture_remove_folder(folder);
}

/* Without cells, a probe sees the points of its cell. */
static void probes_see_points(void **state)
{
    (void)state;
    fixture f;
    history *h;
    char folder[FIXTURE_PATH], path[FIXTURE_PATH];
    static columns names, values;
    const fixture_spec spec = {.dim = 2, .cells = {8, 8}, .blocks = {1, 1}, .with_points = true};
    fixture_folder(folder);
    fixture_path(path, folder, "history.csv");
    fixture_make(&f, &spec);
    f.scene->probe[1] = (scene_probe){.name = "outside", .position = {-1.0, 0.0, 0.0}};
    f.scene->n_probes = 2;
    double volume = 0.0, sum = 0.0, mass = 0.0, momentum = 0.0;
    const fields *in = f.sim.domain->fields[0];
    for (int b = 0; b < FIXTURE_BODIES; b++) {
        for (size_t i = 0; i < f.mpm.points[0][b].n; i++) {
            const double x = field_get(in, P_POS, b, 0)[i], y = field_get(in, P_POS, b, 1)[i];
            if (mesh_cell_of(&f.sim.mesh, 0, x) != mesh_cell_of(&f.sim.mesh, 0, 0.55)) continue;
            if (mesh_cell_of(&f.sim.mesh, 1, y) != mesh_cell_of(&f.sim.mesh, 1, 0.5)) continue;
            const double v = field_get(in, P_VOLUME0, b, 0)[i] * field_get(in, P_J, b, 0)[i];
            double trace = 0.0;
            for (int c = 0; c < 3; c++) trace += field_get(in, P_STRESS, b, c)[i];
            volume += v;
            sum += v * (1e5 - trace / 3.0);
            mass += field_get(in, P_MASS, b, 0)[i];
            momentum += field_get(in, P_MASS, b, 0)[i] * field_get(in, P_VEL, b, 1)[i];
        }
    }
    assert_true(volume > 0.0);
    check_ok(f.ctx, history_open(&h, &f.sim, path, -INFINITY));
    append(&f, h, 0.0);
    history_close(&h);
    char *text = fixture_read(f.ctx, path, NULL);
    (void)cut(cut(text, &names), &values);
    check_close_relative(number_of(&names, &values, "middle_pressure (Pa)"), sum / volume, 1e-14);
    check_close_relative(number_of(&names, &values, "middle_velocity_y (m/s)"), momentum / mass, 1e-14);
    assert_true(isnan(number_of(&names, &values, "outside_pressure (Pa)")));
    memory_free(f.ctx, &text);
    fixture_free(&f);
    fixture_remove_folder(folder);
}

static void resuming_drops_what_is_later(void **state)
{
    (void)state;
    fixture f;
    history *h;
    char folder[FIXTURE_PATH], path[FIXTURE_PATH], whole[FIXTURE_PATH];
    fixture_folder(folder);
    fixture_path(path, folder, "history.csv");
    fixture_path(whole, folder, "whole.csv");
    fixture_make(&f, &coupled);
    check_ok(f.ctx, history_open(&h, &f.sim, whole, -INFINITY));
    for (int i = 0; i < 6; i++) append(&f, h, 0.1 * i);
    history_close(&h);
    /* The same, but killed within a row after 0.4, and resumed from 0.2. */
    check_ok(f.ctx, history_open(&h, &f.sim, path, -INFINITY));
    for (int i = 0; i < 5; i++) append(&f, h, 0.1 * i);
    history_close(&h);
    line_file half;
    check_ok(f.ctx, line_file_open(&half, f.ctx, path));
    check_ok(f.ctx, line_file_append(&half, "0.1,12", 6));
    line_file_close(&half);
    check_ok(f.ctx, history_open(&h, &f.sim, path, 0.1 * 2));
    check_close(history_last_time(h), 0.2, 0.0);
    for (int i = 3; i < 6; i++) append(&f, h, 0.1 * i);
    history_close(&h);
    fixture_same_files(f.ctx, whole, path);
    check_ok(f.ctx, history_open(&h, &f.sim, path, INFINITY)); /* resumed at the end: nothing is lost */
    history_close(&h);
    fixture_same_files(f.ctx, whole, path);
    f.scene->n_probes = 0;
    check_fails(f.ctx, history_open(&h, &f.sim, path, 0.2), FLOE_BAD_INPUT); /* other columns */
    assert_null(h);
    fixture_same_files(f.ctx, whole, path);
    fixture_free(&f);
    fixture_remove_folder(folder);
}

static void keeps_earlier_when_disk_is_full(void **state)
{
    (void)state;
    fixture f;
    history *h;
    char folder[FIXTURE_PATH], path[FIXTURE_PATH];
    const sim_totals totals = some_totals(9.0);
    const history_row row = {&totals, NULL};
    size_t before, after;
    fixture_folder(folder);
    fixture_path(path, folder, "history.csv");
    fixture_make(&f, &coupled);
    check_ok(f.ctx, history_open(&h, &f.sim, path, -INFINITY));
    append(&f, h, 0.0);
    char *first = fixture_read(f.ctx, path, &before);
    fault_arm(1, ENOSPC, true);
    const floe_status status = history_append(h, &f.sim, &row);
    fault_arm(0, 0, false);
    check_fails(f.ctx, status, FLOE_IO);
    char *second = fixture_read(f.ctx, path, &after);
    assert_int_equal(before, after);
    assert_memory_equal(first, second, before);
    check_close(history_last_time(h), 0.0, 0.0);
    history_close(&h);
    fault_arm(2, EIO, true);
    const floe_status resumed = history_open(&h, &f.sim, path, 0.0);
    fault_arm(0, 0, false);
    check_fails(f.ctx, resumed, FLOE_IO);
    memory_free(f.ctx, &second);
    second = fixture_read(f.ctx, path, &after);
    assert_int_equal(before, after);
    memory_free(f.ctx, &first);
    memory_free(f.ctx, &second);
    fixture_free(&f);
    fixture_remove_folder(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_parse_back),
        cmocka_unit_test(probes_see_points),
        cmocka_unit_test(resuming_drops_what_is_later),
        cmocka_unit_test(keeps_earlier_when_disk_is_full),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
