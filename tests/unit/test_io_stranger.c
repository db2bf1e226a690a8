/* Checkpoints and snapshots that somebody else has made, with a correct seal: what leads out of the file is refused by
 * name, and so are impossible values in a checkpoint. */
#include "test_io_fixture.h"

#include "io/checkpoint/checkpoint.h"
#include "io/checkpoint/checkpoint_record.h"
#include "io/sealed_file.h"
#include "io/snapshot/snapshot.h"
#include "io/snapshot/snapshot_folder.h"

static const fixture_spec coupled = {.dim = 2, .cells = {24, 20}, .with_points = true, .with_cells = true};

/* One change of a file. */
typedef struct change change;
struct change {
    void (*make)(hid_t file, const change *c);
    const char *path;  /* of what is changed */
    const char *words; /* that the refusal has beside it */
    double value;
    hsize_t at;
};

/* ---- ways out of the file ---- */

static void link_away(hid_t file, const change *c)
{
    (void)H5Ldelete(file, c->path, H5P_DEFAULT);
    assert_true(H5Lcreate_external("/etc/hostname", "/x", file, c->path, H5P_DEFAULT, H5P_DEFAULT) >= 0);
}

static void link_by_name(hid_t file, const change *c)
{
    (void)H5Ldelete(file, c->path, H5P_DEFAULT);
    assert_true(H5Lcreate_soft("/time", file, c->path, H5P_DEFAULT, H5P_DEFAULT) >= 0);
}

typedef enum storage { EXTERNAL, VIRTUAL, FILTERED, CHUNKED } storage;

/* A dataset in the place of another, of the same extent and elsewhere. */
static void store_elsewhere(hid_t file, const change *c)
{
    const hid_t old = H5Dopen2(file, c->path, H5P_DEFAULT), space = H5Dget_space(old);
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    hsize_t extent[4] = {0};
    const int rank = H5Sget_simple_extent_dims(space, extent, NULL);
    (void)H5Dclose(old);
    (void)H5Ldelete(file, c->path, H5P_DEFAULT);
    if (c->at == EXTERNAL) (void)H5Pset_external(creation, "/etc/hostname", 0, H5F_UNLIMITED);
    if (c->at == VIRTUAL) (void)H5Pset_virtual(creation, space, "/etc/hostname", "/x", space);
    if (c->at >= FILTERED) (void)H5Pset_chunk(creation, rank, extent);
    if (c->at == FILTERED) (void)H5Pset_deflate(creation, 6);
    const hid_t set = H5Dcreate2(file, c->path, H5T_IEEE_F64LE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    assert_true(set >= 0);
    (void)H5Dclose(set);
    (void)H5Pclose(creation);
    (void)H5Sclose(space);
}

static void write_nothing(hid_t file, const change *c)
{
    const hid_t old = H5Dopen2(file, c->path, H5P_DEFAULT), space = H5Dget_space(old);
    (void)H5Dclose(old);
    (void)H5Ldelete(file, c->path, H5P_DEFAULT);
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    (void)H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER);
    (void)H5Dclose(H5Dcreate2(file, c->path, H5T_IEEE_F64LE, space, H5P_DEFAULT, creation, H5P_DEFAULT));
    (void)H5Pclose(creation);
    (void)H5Sclose(space);
}

/* ---- what cannot be ---- */

static void set_value(hid_t file, const change *c)
{
    static double x[200000];
    const hid_t set = H5Dopen2(file, c->path, H5P_DEFAULT);
    assert_true(set >= 0 && H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, x) >= 0);
    x[c->at] = c->value;
    assert_true(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, x) >= 0);
    (void)H5Dclose(set);
}

static void drop(hid_t file, const change *c)
{
    assert_true(H5Ldelete(file, c->path, H5P_DEFAULT) >= 0);
}

static void shorten(hid_t file, const change *c)
{
    const hsize_t few = 3;
    const hid_t space = H5Screate_simple(1, &few, NULL);
    const double x[3] = {1.0, 2.0, 3.0};
    (void)H5Ldelete(file, c->path, H5P_DEFAULT);
    const hid_t set = H5Dcreate2(file, c->path, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, x) >= 0);
    (void)H5Dclose(set);
    (void)H5Sclose(space);
}

/* Makes `to` of the sealed file `from`, changed. */
static void forge(context *ctx, const char *from, const char *to, sealed_kind kind, uint32_t format, const change *c)
{
    sealed_file file;
    char *image;
    check_ok(ctx, sealed_read(ctx, from, kind, format, false, &file));
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    assert_true(H5Pset_fapl_core(access, 1 << 20, 0) >= 0);
    assert_true(H5Pset_file_image(access, (void *)(uintptr_t)file.image, file.size) >= 0);
    const hid_t hdf = H5Fopen("/dev/null/forged", H5F_ACC_RDWR, access);
    assert_true(hdf >= 0);
    c->make(hdf, c);
    assert_true(H5Fflush(hdf, H5F_SCOPE_LOCAL) >= 0);
    const ssize_t size = H5Fget_file_image(hdf, NULL, 0);
    check_ok(ctx, memory_new(ctx, &image, (size_t)size, 1));
    assert_int_equal(H5Fget_file_image(hdf, image, (size_t)size), size);
    (void)H5Fclose(hdf);
    (void)H5Pclose(access);
    new_file made;
    check_ok(ctx, new_file_begin(&made, ctx, to));
    new_file_write(&made, SEALED_HEADER, image, (size_t)size);
    check_ok(ctx, sealed_finish(&made, FLOE_OK, kind, format, NULL));
    memory_free(ctx, &image);
    sealed_free(ctx, &file);
}

static void refused(context *ctx, floe_status status, const change *c)
{
    const char *message = context_message(ctx);
    const char *name = strrchr(c->path, '/') ? strrchr(c->path, '/') + 1 : c->path;
    if (status != FLOE_IO || !strstr(message, c->words) || !strstr(message, name))
        print_error("%s, %g: got %s: %s\n", c->path, c->value, status_name(status), message);
    assert_int_equal(status, FLOE_IO);
    assert_non_null(strstr(message, c->words));
    assert_non_null(strstr(message, name));
    context_clear(ctx);
}

#define WAYS_OUT(path)                                                           \
    {link_away, path, "is a link into another file", 0.0, 0},                    \
        {link_away, "/more", "is a link into another file", 0.0, 0},             \
        {link_by_name, path, "is a link by name", 0.0, 0},                       \
        {store_elsewhere, path, "has its data in other files", 0.0, EXTERNAL},   \
        {store_elsewhere, path, "has its data in other datasets", 0.0, VIRTUAL}, \
        {store_elsewhere, path, "goes through filters", 0.0, FILTERED},          \
        {store_elsewhere, path, "is not stored in one piece", 0.0, CHUNKED},     \
    {                                                                            \
        write_nothing, path, "has not all of its numbers in the file", 0.0, 0    \
    }

static const change checkpoints[] = {
    WAYS_OUT("/points/0/mass_0"),
    WAYS_OUT("/cells/0/density_0"),
    {link_away, "/points", "is a link into another file", 0.0, 0},
    {set_value, "/points/0/mass_0", "must be > 0", -1.0, 3},
    {set_value, "/points/0/mass_0", "must be > 0", 0.0, 4},
    {set_value, "/points/1/mass_0", "must be > 0", NAN, 5},
    {set_value, "/points/0/initial_volume_0", "must be > 0", -1e-300, 6},
    {set_value, "/points/0/velocity_1", "must be finite", INFINITY, 7},
    {set_value, "/points/1/position_1", "outside the mesh", 1e6, 8},
    {set_value, "/cells/2/density_0", "must be >= 0", -1e-9, 9},
    {set_value, "/cells/0/internal_energy_0", "must be finite", NAN, 10},
    {set_value, "/sim/time", "impossible time", -1.0, 0},
    {set_value, "/sim/wall_seconds", "impossible time", NAN, 0},
    {shorten, "/points/0/mass_0", "numbers, but has 3", 0.0, 0},
    {shorten, "/cells/0/density_0", "numbers, but has 3", 0.0, 0},
    {drop, "/points/0/velocity_0", "holds no", 0.0, 0},
};

static const char *words_of_time(const change *c)
{
    return strncmp(c->path, "/sim/", 5) == 0 || strncmp(c->path, "/points/1/pos", 13) == 0 ? "" : c->path;
}

static void refuses_checkpoints(void **state)
{
    (void)state;
    fixture from, to;
    char folder[FIXTURE_PATH], path[FIXTURE_PATH], forged[FIXTURE_PATH];
    fixture_spec into = coupled;
    into.empty = true;
    checkpoint_run run = {.deck = "floe: 1\n", .identity = "floe: 1\n"};
    fixture_folder(folder);
    fixture_path(path, folder, "checkpoint.h5");
    fixture_path(forged, folder, "forged.h5");
    fixture_make(&from, &coupled);
    fixture_make(&to, &into);
    check_ok(from.ctx, checkpoint_write(&from.sim, path, &run));
    for (size_t i = 0; i < sizeof checkpoints / sizeof checkpoints[0]; i++) {
        change c = checkpoints[i];
        forge(to.ctx, path, forged, SEALED_CHECKPOINT, CHECKPOINT_FORMAT, &c);
        const floe_status status = checkpoint_read(&to.sim, forged, &run);
        c.path = words_of_time(&c); /* these are named by their values */
        refused(to.ctx, status, &c);
        assert_int_equal(to.mpm.points[0][0].n, 0); /* and nothing was changed */
    }
    check_ok(to.ctx, checkpoint_read(&to.sim, path, &run));
    fixture_free(&to);
    fixture_free(&from);
    fixture_remove_folder(folder);
}

#define BODY "/points/annulus"

static const change snapshots[] = {
    WAYS_OUT(BODY "/mass"),
    WAYS_OUT("/cells/density_gas"),
    {link_away, "/cells", "is a link into another file", 0.0, 0},
};

static void refuses_snapshots(void **state)
{
    (void)state;
    fixture f;
    snapshot_series *series;
    hdf_file hdf;
    char folder[FIXTURE_PATH], path[FIXTURE_PATH], forged[FIXTURE_PATH];
    fixture_folder(folder);
    fixture_path(path, folder, "fields/000000.h5");
    fixture_path(forged, folder, "fields/000001.h5");
    fixture_make(&f, &coupled);
    check_ok(f.ctx, snapshot_open(&series, f.ctx, folder, "floe: 1\n", (double)-INFINITY));
    check_ok(f.ctx, snapshot_write(series, &f.sim));
    snapshot_close(&series);
    for (size_t i = 0; i < sizeof snapshots / sizeof snapshots[0]; i++) {
        change c = snapshots[i];
        forge(f.ctx, path, forged, SEALED_SNAPSHOT, SNAPSHOT_FORMAT, &c);
        refused(f.ctx, snapshot_file_open(f.ctx, forged, &hdf), &c);
        hdf_close(&hdf);
    }
    check_ok(f.ctx, snapshot_file_open(f.ctx, path, &hdf));
    hdf_close(&hdf);
    fixture_free(&f);
    fixture_remove_folder(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(refuses_checkpoints), cmocka_unit_test(refuses_snapshots)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
