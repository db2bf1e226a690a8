/* Snapshots: every array of fields.xdmf is where the page says, with the shape, number type and unit that it says; values
 * are those of the fields; resuming drops what is later; faults leave earlier files alone. */
#include "test_io_fixture.h"

#include "io/snapshot/snapshot.h"
#include "test_io_faults.h"
#include "test_io_xml.h"

#include <hdf5.h>

static const fixture_spec coupled = {.dim = 2, .cells = {24, 20}, .with_points = true, .with_cells = true};

/* What a walk over the page has seen. */
typedef struct page {
    const char *folder;
    int arrays, grids, times;
    double last_time;
    size_t entries; /* cells or points of the grid that is open */
    bool saw_velocity, saw_id, saw_history;
} page;

static size_t numbers_of(const char *text, size_t n[8])
{
    size_t count = 0;
    for (char *end; count < 8; count++, text = end) {
        n[count] = strtoul(text, &end, 10);
        if (end == text) break;
    }
    return count;
}

static void check_number_type(hid_t set, const xml_element *item)
{
    const hid_t type = H5Dget_type(set);
    assert_int_equal(H5Tget_class(type), strcmp(xml_get(item, "NumberType"), "Int") == 0 ? H5T_INTEGER : H5T_FLOAT);
    assert_int_equal(H5Tget_size(type), (size_t)strtoul(xml_get(item, "Precision"), NULL, 10));
    (void)H5Tclose(type);
}

static void check_extent(hid_t set, const xml_element *item)
{
    size_t expected[8];
    hsize_t has[H5S_MAX_RANK];
    const size_t rank = numbers_of(xml_get(item, "Dimensions"), expected);
    const hid_t space = H5Dget_space(set);
    assert_int_equal(H5Sget_simple_extent_dims(space, has, NULL), rank);
    for (size_t i = 0; i < rank; i++) assert_int_equal(has[i], expected[i]);
    (void)H5Sclose(space);
}

static void check_unit(hid_t set, const char *unit)
{
    char *text = NULL;
    const hid_t attribute = H5Aopen(set, "unit", H5P_DEFAULT);
    assert_true(attribute >= 0);
    const hid_t type = H5Aget_type(attribute);
    assert_true(H5Aread(attribute, type, &text) >= 0);
    if (unit) assert_string_equal(text, unit);
    assert_true(strlen(text) > 0);
    (void)H5free_memory(text);
    (void)H5Tclose(type);
    (void)H5Aclose(attribute);
}

/* Opens "file.h5:/path" as a viewer does: through HDF5, from the page's folder. */
static void check_item(const page *p, const xml_element *item, const char *unit)
{
    char file[FIXTURE_PATH + XML_TEXT];
    const char *colon = strchr(item->text, ':');
    assert_non_null(colon);
    (void)snprintf(file, sizeof file, "%s/%.*s", p->folder, (int)(colon - item->text), item->text);
    const hid_t id = H5Fopen(file, H5F_ACC_RDONLY, H5P_DEFAULT);
    assert_true(id >= 0);
    const hid_t set = H5Dopen2(id, colon + 1, H5P_DEFAULT);
    assert_true(set >= 0);
    check_number_type(set, item);
    check_extent(set, item);
    check_unit(set, unit);
    (void)H5Dclose(set);
    (void)H5Fclose(id);
}

static void check_topology(page *p, const xml_element *e)
{
    const char *kind = xml_get(e, "TopologyType");
    size_t n[8];
    if (strcmp(kind, "Polyvertex") == 0) {
        p->entries = strtoul(xml_get(e, "NumberOfElements"), NULL, 10);
        return;
    }
    const size_t axes = numbers_of(xml_get(e, "Dimensions"), n);
    assert_string_equal(kind, "3DCoRectMesh"); /* two-dimensional ones are shown in the wrong plane */
    assert_int_equal(axes, 3);
    p->entries = 1;
    for (size_t i = 0; i < axes; i++) p->entries *= n[i] - 1;
}

/* As many numbers as the grid has entries, times three for vectors. */
static void check_attribute_item(page *p, const xml_element *attribute, const xml_element *item)
{
    size_t n[8], product = 1;
    const size_t rank = numbers_of(xml_get(item, "Dimensions"), n);
    for (size_t i = 0; i < rank; i++) product *= n[i];
    assert_int_equal(product, p->entries * (strcmp(xml_get(attribute, "AttributeType"), "Vector") == 0 ? 3 : 1));
    if (strncmp(xml_get(attribute, "Name"), "velocity (m s-1)", 64) == 0) p->saw_velocity = true;
    if (strcmp(xml_get(attribute, "Name"), "id") == 0) p->saw_id = true;
    if (strcmp(xml_get(attribute, "Name"), "plastic_strain") == 0) p->saw_history = true; /* by the law's name for it */
    assert_null(strstr(xml_get(attribute, "Name"), "history"));
    assert_null(strchr(xml_get(attribute, "Name"), '/'));
}

static void visit(void *user, const xml_element *open, int depth)
{
    page *p = user;
    const xml_element *e = &open[depth];
    const xml_element *parent = depth > 0 ? &open[depth - 1] : NULL;
    if (strcmp(e->name, "Topology") == 0) check_topology(p, e);
    if (strcmp(e->name, "Time") == 0) {
        const double time = strtod(xml_get(e, "Value"), NULL);
        assert_true(time > p->last_time);
        p->last_time = time;
        p->times++;
    }
    if (strcmp(e->name, "Grid") == 0 && strcmp(xml_get(e, "GridType"), "Uniform") == 0) p->grids++;
    if (strcmp(e->name, "DataItem") == 0 && strcmp(xml_get(e, "Format"), "HDF") == 0) {
        const bool geometry = strcmp(parent->name, "Geometry") == 0;
        check_item(p, e, geometry ? "m" : strcmp(parent->name, "Topology") == 0 ? "1" : NULL);
        if (strcmp(parent->name, "Attribute") == 0) check_attribute_item(p, parent, e);
        p->arrays++;
    }
}

static page read_page(context *ctx, const char *folder)
{
    page p = {.folder = folder, .last_time = -INFINITY};
    char path[FIXTURE_PATH];
    fixture_path(path, folder, "fields.xdmf");
    char *text = fixture_read(ctx, path, NULL);
    xml_read(text, visit, &p);
    memory_free(ctx, &text);
    return p;
}

static void page_fits_files(void **state)
{
    (void)state;
    const fixture_spec specs[] = {
        coupled,
        {.dim = 1, .cells = {40}, .with_points = true, .with_cells = true},
        {.dim = 3, .cells = {6, 5, 4}, .blocks = {1, 1, 1}, .with_points = true, .with_cells = true},
        {.dim = 2, .cells = {9, 8}, .with_points = true, .geometry = MESH_AXISYMMETRIC},
        {.dim = 2, .cells = {9, 8}, .with_cells = true},
    };
    for (size_t i = 0; i < sizeof specs / sizeof specs[0]; i++) {
        fixture f;
        char folder[FIXTURE_PATH];
        fixture_folder(folder);
        fixture_make(&f, &specs[i]);
        fixture_write_times(&f, folder, 3);
        const page p = read_page(f.ctx, folder);
        assert_int_equal(p.times, 3);
        assert_int_equal(p.grids, 3 * (specs[i].with_cells + (specs[i].with_points ? FIXTURE_BODIES : 0)));
        assert_true(p.arrays > 3 * 10);
        assert_true(p.saw_velocity == specs[i].with_points && p.saw_id == specs[i].with_points);
        assert_true(p.saw_history == specs[i].with_points);
        fixture_free(&f);
        fixture_remove_folder(folder);
    }
}

static double *read_set(hid_t file, const char *path, double *to)
{
    const hid_t set = H5Dopen2(file, path, H5P_DEFAULT);
    assert_true(set >= 0);
    assert_true(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, to) >= 0);
    (void)H5Dclose(set);
    return to;
}

/* Cells: row-major, last axis fastest. Points: by id, with masses times the thickness and stresses made absolute. */
static void values_are_those_of_fields(void **state)
{
    (void)state;
    fixture f;
    char folder[FIXTURE_PATH], path[FIXTURE_PATH];
    static double a[3000], b[3000], c[3000], d[3000];
    point_list list;
    fixture_folder(folder);
    fixture_path(path, folder, "fields/000000.h5");
    fixture_make(&f, &coupled);
    fixture_write_times(&f, folder, 1);
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    assert_true(file >= 0);
    read_set(file, "/cells/density_soft___wet", a);
    read_set(file, "/cells/velocity_gas", b);
    for (int at = 0; at < 24 * 20; at++) {
        assert_true(a[at] == fixture_value(C_RHO, 16, (uint64_t)at));
        assert_true(b[3 * at + 1] == fixture_value(C_VEL, 33, (uint64_t)at) && b[3 * at + 2] == 0.0);
    }
    check_ok(f.ctx, point_list_make(&list, &f.sim, 1));
    read_set(file, "/points/plug__1_/mass", a);
    read_set(file, "/points/plug__1_/pressure", b);
    read_set(file, "/points/plug__1_/position", c);
    read_set(file, "/points/plug__1_/sigma_r", d);
    for (size_t i = 0; i < list.n; i++) {
        const uint64_t id = list.place[i].id;
        double s[4];
        for (uint64_t k = 0; k < 4; k++) s[k] = fixture_value(P_STRESS, k, id);
        const double x = c[3 * i], y = c[3 * i + 1], rr = x * x + y * y;
        assert_true(a[i] == 2.0 * fixture_value(P_MASS, 0, id));
        check_close(b[i], 1e5 - (s[0] + s[1] + s[2]) / 3.0, 1e-9);
        check_close(d[i], (x * x * s[0] + y * y * s[1] + 2.0 * x * y * s[3]) / rr, 1e-12);
    }
    point_list_free(f.ctx, &list);
    (void)H5Fclose(file);
    fixture_free(&f);
    fixture_remove_folder(folder);
}

static void blocks_do_not_show(void **state)
{
    (void)state;
    char folder[2][FIXTURE_PATH], path[2][FIXTURE_PATH];
    fixture f[2];
    for (int i = 0; i < 2; i++) {
        fixture_spec spec = coupled;
        spec.blocks[0] = spec.blocks[1] = 1 + i;
        fixture_folder(folder[i]);
        fixture_path(path[i], folder[i], "fields/000001.h5");
        fixture_make(&f[i], &spec);
        fixture_write_times(&f[i], folder[i], 2);
        if (i == 0) (void)sleep(1); /* the hour of writing must not show either */
    }
    fixture_same_files(f[0].ctx, path[0], path[1]);
    for (int i = 0; i < 2; i++) {
        fixture_free(&f[i]);
        fixture_remove_folder(folder[i]);
    }
}

/* Times 0, 0.1, ... 0.4; resumed at 0.2, then 0.25 is written: no trace of 0.3 and 0.4 is left. */
static void resuming_drops_what_is_later(void **state)
{
    (void)state;
    fixture f;
    snapshot_series *series;
    char folder[FIXTURE_PATH], path[FIXTURE_PATH], remnant[FIXTURE_PATH], other[FIXTURE_PATH];
    fixture_folder(folder);
    fixture_path(path, folder, "fields/000004.h5");
    fixture_path(remnant, folder, "fields/000005.h5.tmp");
    fixture_path(other, folder, "fields/notes.txt");
    fixture_make(&f, &coupled);
    fixture_write_times(&f, folder, 5);
    check_ok(f.ctx, file_replace_text(f.ctx, remnant, "half"));
    check_ok(f.ctx, file_replace_text(f.ctx, other, "mine"));
    check_ok(f.ctx, snapshot_open(&series, f.ctx, folder, "floe: 1\n", 0.2));
    assert_false(file_exists(path));
    assert_false(file_exists(remnant));
    assert_true(file_exists(other));
    assert_int_equal(read_page(f.ctx, folder).times, 3);
    f.sim.time = 0.25;
    check_ok(f.ctx, snapshot_write(series, &f.sim));
    snapshot_close(&series);
    const page p = read_page(f.ctx, folder);
    assert_int_equal(p.times, 4);
    check_close(p.last_time, 0.25, 0.0);
    check_ok(f.ctx, snapshot_open(&series, f.ctx, folder, "floe: 1\n", -INFINITY)); /* a fresh run: all go */
    snapshot_close(&series);
    assert_int_equal(read_page(f.ctx, folder).times, 0);
    fixture_free(&f);
    fixture_remove_folder(folder);
}

static void count_warning(void *user, log_level level, const char *line)
{
    int *warnings = user;
    if (level == LOG_WARNING && strstr(line, "damaged")) (*warnings)++;
}

/* A damaged snapshot is left out of the page, with a warning; the run goes on. */
static void passes_over_damaged_snapshots(void **state)
{
    (void)state;
    fixture f;
    snapshot_series *series;
    int warnings = 0;
    size_t size;
    char folder[FIXTURE_PATH], path[FIXTURE_PATH];
    fixture_folder(folder);
    fixture_path(path, folder, "fields/000001.h5");
    fixture_make(&f, &coupled);
    fixture_write_times(&f, folder, 3);
    char *data = fixture_read(f.ctx, path, &size);
    data[size / 2] ^= 1;
    const file_part part = {data, size};
    check_ok(f.ctx, file_replace(f.ctx, path, &part, 1));
    memory_free(f.ctx, &data);
    context_set_sink(f.ctx, count_warning, &warnings, LOG_INFO);
    check_ok(f.ctx, snapshot_open(&series, f.ctx, folder, "floe: 1\n", 1.0));
    assert_int_equal(warnings, 1);
    assert_int_equal(read_page(f.ctx, folder).times, 2);
    snapshot_close(&series);
    fixture_free(&f);
    fixture_remove_folder(folder);
}

static void keeps_earlier_when_disk_is_full(void **state)
{
    (void)state;
    fixture f;
    snapshot_series *series;
    char folder[FIXTURE_PATH];
    fixture_folder(folder);
    fixture_make(&f, &coupled);
    check_ok(f.ctx, snapshot_open(&series, f.ctx, folder, "floe: 1\n", -INFINITY));
    check_ok(f.ctx, snapshot_write(series, &f.sim));
    for (int n = 1; n <= 4; n++) {
        f.sim.time += 1.0;
        fault_arm(n, ENOSPC, true);
        const floe_status status = snapshot_write(series, &f.sim);
        fault_arm(0, 0, false);
        check_fails(f.ctx, status, FLOE_IO);
        assert_int_equal(read_page(f.ctx, folder).times, 1); /* and what it names can be read */
    }
    check_ok(f.ctx, snapshot_write(series, &f.sim));
    assert_int_equal(read_page(f.ctx, folder).times, 2);
    const uint64_t before = memory_read_account(f.ctx).live_bytes;
    for (uint64_t n = 1; n <= 30; n++) {
        memory_inject_failure(f.ctx, n);
        const floe_status status = snapshot_write(series, &f.sim);
        memory_inject_failure(f.ctx, 0);
        if (status != FLOE_OK) check_fails(f.ctx, status, FLOE_NO_MEMORY);
        assert_true(memory_read_account(f.ctx).live_bytes < before + 200000); /* the page alone may grow */
    }
    snapshot_close(&series);
    fixture_free(&f);
    fixture_remove_folder(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(page_fits_files),
        cmocka_unit_test(values_are_those_of_fields),
        cmocka_unit_test(blocks_do_not_show),
        cmocka_unit_test(resuming_drops_what_is_later),
        cmocka_unit_test(passes_over_damaged_snapshots),
        cmocka_unit_test(keeps_earlier_when_disk_is_full),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
