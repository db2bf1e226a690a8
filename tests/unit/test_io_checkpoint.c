/* Checkpoints: bitwise round trips over any blocks, and refusal of everything that is not just right. */
#include "test_io_fixture.h"

#include "base/sha256.h"
#include "io/checkpoint/checkpoint.h"
#include "io/sealed_file.h"
#include "test_io_faults.h"

#include <sys/stat.h>

static const fixture_spec coupled = {.dim = 2, .cells = {24, 20}, .with_points = true, .with_cells = true};

static fixture_spec empty_one(int blocks_x, int blocks_y)
{
    fixture_spec spec = coupled;
    spec.empty = true;
    spec.blocks[0] = blocks_x;
    spec.blocks[1] = blocks_y;
    return spec;
}

static double extra_numbers[4][7];
static const checkpoint_extra extra = {"surface", &extra_numbers[0][0], 4, 3, 7};

static checkpoint_run a_run(void)
{
    for (int i = 0; i < 4; i++) {
        for (int c = 0; c < 7; c++) extra_numbers[i][c] = 10.0 * i + c;
    }
    return (checkpoint_run){.deck = "floe: 1\ntime: {end: 1}\n",
                            .identity = "floe: 1\ncell: 0.1\n",
                            .wall_seconds = 12.5,
                            .extra = &extra,
                            .n_extra = 1};
}

static bool same_bits(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

static void same_points(const fixture *a, const fixture *b, field_id id, int body)
{
    static double x[1000], y[1000];
    point_list p, q;
    check_ok(a->ctx, point_list_make(&p, &a->sim, body));
    check_ok(b->ctx, point_list_make(&q, &b->sim, body));
    assert_int_equal(p.n, q.n);
    assert_true(p.n > 100 && p.n < 1000);
    const int components = field_component_count(field_describe(id)->components, a->sim.mesh.dim);
    for (int c = 0; c < components; c++) {
        gather_points(&a->sim, &p, id, c, 1, x);
        gather_points(&b->sim, &q, id, c, 1, y);
        assert_memory_equal(x, y, p.n * sizeof *x);
    }
    point_list_free(a->ctx, &p);
    point_list_free(b->ctx, &q);
}

static void same_cells(const fixture *a, const fixture *b, field_id id, int instance)
{
    static double x[1000], y[1000];
    const size_t n = mesh_cells(&a->sim.mesh);
    assert_true(n < 1000);
    const int components = field_component_count(field_describe(id)->components, a->sim.mesh.dim);
    for (int c = 0; c < components; c++) {
        gather_cells(&a->sim, id, instance, c, 1, x);
        gather_cells(&b->sim, id, instance, c, 1, y);
        assert_memory_equal(x, y, n * sizeof *x);
    }
}

static void same_clocks(const sim *a, const sim *b)
{
    assert_true(same_bits(a->time, b->time) && same_bits(a->dt, b->dt) && same_bits(a->rest_since, b->rest_since));
    assert_true(same_bits(a->point_updates, b->point_updates) && same_bits(a->cell_updates, b->cell_updates));
    assert_true(a->steps == b->steps && a->rejected == b->rejected && a->at_rest == b->at_rest);
    assert_true(same_bits(a->mpm->dt_previous, b->mpm->dt_previous) && same_bits(a->mpm->time, b->mpm->time));
    assert_true(same_bits(a->ice->dt, b->ice->dt) && same_bits(a->ice->time, b->ice->time));
    assert_string_equal(a->dt_reason, b->dt_reason);
    assert_memory_equal(&a->ledger, &b->ledger, sizeof a->ledger);
    for (int i = 0; i < a->stages.n; i++) {
        assert_true(same_bits(a->stages.record[i].seconds, b->stages.record[i].seconds));
        assert_true(a->stages.record[i].calls == b->stages.record[i].calls);
    }
}

static void same_state(const fixture *a, const fixture *b)
{
    static const field_id points[] = {P_ID, P_MASS, P_VOLUME0, P_HALF, P_POS, P_VEL, P_F, P_J, P_STRESS, P_ENERGY};
    static const field_id cells[] = {C_RHO, C_VEL, C_ENERGY, C_VOL};
    for (int body = 0; body < FIXTURE_BODIES; body++) {
        for (size_t i = 0; i < sizeof points / sizeof points[0]; i++) same_points(a, b, points[i], body);
    }
    for (int r = 0; r < FIXTURE_MATERIALS; r++) {
        for (size_t i = 0; i < sizeof cells / sizeof cells[0]; i++) same_cells(a, b, cells[i], r);
    }
    same_cells(a, b, C_PRESSURE, 0);
    same_clocks(&a->sim, &b->sim);
}

/* What is kept for it on the disk is enough, and not much more. */
static void fits_reserved_size(const fixture *f, const char *path, const checkpoint_run *run)
{
    struct stat about;
    const size_t most = checkpoint_most_bytes(&f->sim, run);
    assert_int_equal(stat(path, &about), 0);
    assert_in_range(about.st_size, 1, most);
    check_true((double)most < 1.1 * (double)about.st_size + 512.0 * 1024.0);
}

static void round_trips_over_blocks(void **state)
{
    (void)state;
    fixture a, b;
    char folder[FIXTURE_PATH], first[FIXTURE_PATH], second[FIXTURE_PATH];
    const fixture_spec into = empty_one(2, 2);
    checkpoint_run run = a_run();
    fixture_folder(folder);
    fixture_path(first, folder, "first.h5");
    fixture_path(second, folder, "second.h5");
    fixture_make(&a, &coupled);
    fixture_make(&b, &into);
    extra_numbers[2][1] = (double)NAN;
    check_ok(a.ctx, checkpoint_write(&a.sim, first, &run));
    check_fails(b.ctx, checkpoint_read(&b.sim, first, &run), FLOE_IO);
    extra_numbers[2][1] = 21.0;
    check_ok(a.ctx, checkpoint_write(&a.sim, first, &run));
    memset(extra_numbers, 0, sizeof extra_numbers);
    run.wall_seconds = 0.0;
    check_ok(b.ctx, checkpoint_read(&b.sim, first, &run));
    assert_true(same_bits(run.wall_seconds, 12.5));
    assert_true(same_bits(extra_numbers[3][2], 32.0) && same_bits(extra_numbers[3][3], 0.0));
    same_state(&a, &b);
    assert_true(b.mpm.points[3][1].n > 10); /* the points are spread over the blocks, and sorted there */
    assert_int_equal(b.mpm.points[3][1].tile_start[b.sim.mesh.block[3].n_tiles], b.mpm.points[3][1].n);
    check_ok(b.ctx, checkpoint_write(&b.sim, second, &run));
    fixture_same_files(a.ctx, first, second);
    fits_reserved_size(&b, second, &run);
    fixture_free(&b);
    fixture_free(&a);
    fixture_remove_folder(folder);
}

/* A 3-D gas alone, and an axisymmetric solid alone. */
static void round_trips_one_solver(void **state)
{
    (void)state;
    const fixture_spec gas = {.dim = 3, .cells = {6, 5, 4}, .with_cells = true};
    const fixture_spec solid = {.dim = 2, .cells = {9, 8}, .with_points = true, .geometry = MESH_AXISYMMETRIC};
    const fixture_spec *const specs[] = {&gas, &solid};
    for (int i = 0; i < 2; i++) {
        fixture a, b;
        char folder[FIXTURE_PATH], path[FIXTURE_PATH], again[FIXTURE_PATH];
        fixture_spec into = *specs[i];
        checkpoint_run run = a_run();
        into.empty = true;
        fixture_folder(folder);
        fixture_path(path, folder, "checkpoint.h5");
        fixture_path(again, folder, "again.h5");
        fixture_make(&a, specs[i]);
        fixture_make(&b, &into);
        check_ok(a.ctx, checkpoint_write(&a.sim, path, &run));
        check_ok(b.ctx, checkpoint_read(&b.sim, path, &run));
        check_ok(b.ctx, checkpoint_write(&b.sim, again, &run));
        fixture_same_files(a.ctx, path, again);
        fixture_free(&b);
        fixture_free(&a);
        fixture_remove_folder(folder);
    }
}

/* A written checkpoint with its bytes, and a simulation to read into. */
typedef struct written {
    fixture from, to;
    checkpoint_run run;
    char folder[FIXTURE_PATH], path[FIXTURE_PATH], damaged[FIXTURE_PATH];
    char *data;
    size_t size;
} written;

static void written_make(written *w, int blocks_x, int blocks_y)
{
    const fixture_spec into = empty_one(blocks_x, blocks_y);
    w->run = a_run();
    fixture_folder(w->folder);
    fixture_path(w->path, w->folder, "checkpoint.h5");
    fixture_path(w->damaged, w->folder, "damaged.h5");
    fixture_make(&w->from, &coupled);
    fixture_make(&w->to, &into);
    check_ok(w->from.ctx, checkpoint_write(&w->from.sim, w->path, &w->run));
    w->data = fixture_read(w->from.ctx, w->path, &w->size);
}

static void written_free(written *w)
{
    memory_free(w->from.ctx, &w->data);
    fixture_free(&w->to);
    fixture_free(&w->from);
    fixture_remove_folder(w->folder);
}

static void write_plain(const char *path, const void *data, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

/* Reading refuses the file with this status and these words, and leaves the simulation alone. */
static void refuses(written *w, const char *path, floe_status expected, const char *words)
{
    const floe_status status = checkpoint_read(&w->to.sim, path, &w->run);
    const char *message = context_message(w->to.ctx);
    if (status != expected || !strstr(message, words) || !strstr(message, path)) {
        print_error("expected %s with \"%s\", got %s: %s\n", status_name(expected), words, status_name(status),
                    message);
    }
    assert_int_equal(status, expected);
    assert_non_null(strstr(message, words));
    assert_non_null(strstr(message, path)); /* names the file */
    assert_int_equal(w->to.sim.steps, 0);
    assert_int_equal(w->to.mpm.points[0][0].n, 0);
    context_clear(w->to.ctx);
}

static void refuses_damaged_bytes(void **state)
{
    (void)state;
    written w;
    written_make(&w, 1, 1);
    const size_t bytes = check_at_length() ? 1000 : 200;
    for (size_t i = 0; i < SEALED_HEADER + bytes; i++) { /* each of the header, then some all over the body */
        const size_t span = w.size - SEALED_HEADER;
        const size_t at = i < SEALED_HEADER ? i : SEALED_HEADER + (size_t)(fixture_value(1, 2, i) * (double)span);
        const char flip = (char)(1 + (int)(fixture_value(3, 4, i) * 255.0));
        w.data[at] = (char)(w.data[at] ^ flip);
        write_plain(w.damaged, w.data, w.size);
        refuses(&w, w.damaged, FLOE_IO, "");
        w.data[at] = (char)(w.data[at] ^ flip);
    }
    check_ok(w.to.ctx, checkpoint_read(&w.to.sim, w.path, &w.run));
    written_free(&w);
}

static void refuses_other_files(void **state)
{
    (void)state;
    written w;
    char missing[FIXTURE_PATH], text[] = "time,steps\n0,0\n";
    written_make(&w, 1, 1);
    fixture_path(missing, w.folder, "missing.h5");
    refuses(&w, missing, FLOE_IO, "No such file");
    refuses(&w, w.folder, FLOE_IO, "folder");
    refuses(&w, "/dev/null", FLOE_IO, "not an ordinary file");
    write_plain(w.damaged, text, strlen(text));
    refuses(&w, w.damaged, FLOE_IO, "not a file of floe's");
    write_plain(w.damaged, "", 0);
    refuses(&w, w.damaged, FLOE_IO, "not a file of floe's");
    write_plain(w.damaged, w.data + SEALED_HEADER, w.size - SEALED_HEADER); /* plain HDF5 */
    refuses(&w, w.damaged, FLOE_IO, "not a file of floe's");
    write_plain(w.damaged, w.data, 300);
    refuses(&w, w.damaged, FLOE_IO, "within its header");
    for (size_t cut = SEALED_HEADER; cut < w.size; cut += w.size / 9) {
        write_plain(w.damaged, w.data, cut);
        refuses(&w, w.damaged, FLOE_IO, "cut short");
    }
    write_plain(w.damaged, w.data, w.size + 1); /* the NUL that file_read adds */
    refuses(&w, w.damaged, FLOE_IO, "too long");
    written_free(&w);
}

/* Makes the seal fit changed bytes. */
static void reseal(written *w)
{
    const sha256_part part[] = {{w->data, SEALED_HEADER - SHA256_SIZE},
                                {w->data + SEALED_HEADER, w->size - SEALED_HEADER}};
    check_ok(w->from.ctx,
             sha256_of_parts(w->from.ctx, part, 2, (unsigned char *)w->data + SEALED_HEADER - SHA256_SIZE));
    write_plain(w->damaged, w->data, w->size);
}

static void refuses_other_kinds(void **state)
{
    (void)state;
    written w;
    written_make(&w, 1, 1);
    w.data[8] = SEALED_SNAPSHOT;
    reseal(&w);
    refuses(&w, w.damaged, FLOE_IO, "is a floe snapshot, not a checkpoint");
    w.data[8] = SEALED_CHECKPOINT;
    w.data[12] = 99;
    reseal(&w);
    refuses(&w, w.damaged, FLOE_IO, "of format 99");
    w.data[12] = 3;
    memcpy(w.data + 24, "0.0.1\0\0\0\0", 9);
    reseal(&w);
    refuses(&w, w.damaged, FLOE_IO, "was written by floe 0.0.1");
    written_free(&w);
}

static void refuses_other_scenes(void **state)
{
    (void)state;
    written w;
    written_make(&w, 1, 1);
    w.run.identity = "floe: 1\ncell: 0.05\n";
    refuses(&w, w.path, FLOE_BAD_INPUT, "another deck: it has \"cell: 0.1\" where this run has \"cell: 0.05\"");
    w.run = a_run();
    w.to.sim.coupling = COUPLING_MPM;
    refuses(&w, w.path, FLOE_BAD_INPUT, "it has \"coupling ice-mpm\" where this run has \"coupling mpm\"");
    w.to.sim.coupling = COUPLING_ICE_MPM;
    w.to.sim.mesh.h[1] = nextafter(w.to.sim.mesh.h[1], 1.0);
    refuses(&w, w.path, FLOE_BAD_INPUT, "axis 1");
    w.to.sim.mesh.h[1] = w.from.sim.mesh.h[1];
    (void)snprintf(w.to.scene->body[1].name, SCENE_NAME, "plug");
    refuses(&w, w.path, FLOE_BAD_INPUT, "body 'plug'");
    (void)snprintf(w.to.scene->body[1].name, SCENE_NAME, "%s", w.from.scene->body[1].name);
    check_ok(w.to.ctx, domain_add(w.to.sim.domain, P_VISCOUS_PRESSURE, 0));
    refuses(&w, w.path, FLOE_BAD_INPUT, "artificial_pressure");
    written_free(&w);
}

/* What a fault of floe's own would write is refused too: points twice, points nowhere. */
static void refuses_impossible_points(void **state)
{
    (void)state;
    written w;
    written_make(&w, 1, 1);
    fields *f = w.from.sim.domain->fields[0];
    double *id = field_get(f, P_ID, 0, 0);
    double *x = field_get(f, P_POS, 1, 1);
    const double kept_id = id[7], kept_x = x[9];
    id[7] = id[8];
    check_ok(w.from.ctx, checkpoint_write(&w.from.sim, w.path, &w.run));
    refuses(&w, w.path, FLOE_IO, "has the id");
    id[7] = kept_id;
    x[9] = NAN;
    check_ok(w.from.ctx, checkpoint_write(&w.from.sim, w.path, &w.run));
    refuses(&w, w.path, FLOE_IO, "outside the mesh");
    x[9] = w.from.sim.mesh.upper[1] * 1.01;
    check_ok(w.from.ctx, checkpoint_write(&w.from.sim, w.path, &w.run));
    refuses(&w, w.path, FLOE_IO, "outside the mesh");
    x[9] = kept_x;
    w.from.sim.dt = NAN;
    check_ok(w.from.ctx, checkpoint_write(&w.from.sim, w.path, &w.run));
    refuses(&w, w.path, FLOE_IO, "impossible time");
    written_free(&w);
}

/* Past the seal: any bytes end in a status, never in a crash. */
static void survives_fuzzed_images(void **state)
{
    (void)state;
    written w;
    written_make(&w, 2, 1);
    int refused = 0;
    for (uint64_t i = 0; i < (check_at_length() ? 300 : 120); i++) {
        const size_t span = i % 2 ? 4096 : w.size - SEALED_HEADER; /* half of the time at HDF5's own structures */
        const size_t at = SEALED_HEADER + (size_t)(fixture_value(11, 12, i) * (double)span);
        const char flip = (char)(1 + (int)(fixture_value(13, 14, i) * 255.0));
        w.data[at] = (char)(w.data[at] ^ flip);
        const floe_status status =
            checkpoint_decode(&w.to.sim, "fuzzed", w.data + SEALED_HEADER, w.size - SEALED_HEADER, &w.run);
        if (status != FLOE_OK) {
            refused++;
            check_fails(w.to.ctx, status, status);
        }
        w.data[at] = (char)(w.data[at] ^ flip);
    }
    assert_true(refused > (check_at_length() ? 30 : 12));
    check_ok(w.to.ctx, checkpoint_read(&w.to.sim, w.path, &w.run));
    same_state(&w.from, &w.to);
    written_free(&w);
}

/* Writes, syncs and renames of one checkpoint. */
static int count_calls(written *w, const char *path)
{
    enum { MANY = 1 << 20 };
    fault_arm(MANY, ENOSPC, false);
    check_ok(w->from.ctx, checkpoint_write(&w->from.sim, path, &w->run));
    const int calls = MANY - fault.countdown;
    fault_arm(0, 0, false);
    return calls;
}

/* A full disk at each write, sync and rename: status 4, and the earlier checkpoint is still there, bit for bit. */
static void keeps_earlier_when_disk_is_full(void **state)
{
    (void)state;
    written w;
    char temporary[FIXTURE_PATH];
    written_make(&w, 1, 1);
    fixture_path(temporary, w.folder, "checkpoint.h5.tmp");
    w.from.sim.steps++;
    const int calls = count_calls(&w, w.damaged);
    assert_true(calls > 5); /* some writes, a sync, a rename, the folder's sync */
    write_plain(w.damaged, w.data, w.size);
    for (int n = 1; n <= calls; n++) {
        fault_arm(n, ENOSPC, n % 2 == 0);
        const floe_status status = checkpoint_write(&w.from.sim, w.path, &w.run);
        assert_true(fault.fired);
        fault_arm(0, 0, false);
        assert_non_null(strstr(context_message(w.from.ctx), "disk is full"));
        check_fails(w.from.ctx, status, FLOE_IO);
        assert_false(file_exists(temporary));
        /* The last fault is that of the folder's sync, after the rename: then the new file stands there, whole. */
        if (n < calls) fixture_same_files(w.from.ctx, w.damaged, w.path);
    }
    check_ok(w.to.ctx, checkpoint_read(&w.to.sim, w.path, &w.run));
    assert_int_equal(w.to.sim.steps, 1235);
    written_free(&w);
}

/* Each allocation in turn fails: no memory is lost, the file stays, the simulation can be read into again. */
static void survives_lack_of_memory(void **state)
{
    (void)state;
    written w;
    written_make(&w, 2, 2);
    const uint64_t before_from = memory_read_account(w.from.ctx).live_bytes;
    floe_status status = FLOE_NO_MEMORY;
    for (uint64_t n = 1; status != FLOE_OK; n++) {
        memory_inject_failure(w.from.ctx, n);
        status = checkpoint_write(&w.from.sim, w.damaged, &w.run);
        memory_inject_failure(w.from.ctx, 0);
        if (status != FLOE_OK) check_fails(w.from.ctx, status, FLOE_NO_MEMORY);
        assert_int_equal(memory_read_account(w.from.ctx).live_bytes, before_from);
    }
    fixture_same_files(w.from.ctx, w.path, w.damaged);
    status = FLOE_NO_MEMORY;
    for (uint64_t n = 1; status != FLOE_OK; n++) {
        memory_inject_failure(w.to.ctx, n);
        status = checkpoint_read(&w.to.sim, w.path, &w.run);
        memory_inject_failure(w.to.ctx, 0);
        if (status != FLOE_OK) check_fails(w.to.ctx, status, FLOE_NO_MEMORY);
    }
    same_state(&w.from, &w.to);
    written_free(&w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(round_trips_over_blocks),
        cmocka_unit_test(round_trips_one_solver),
        cmocka_unit_test(refuses_damaged_bytes),
        cmocka_unit_test(refuses_other_files),
        cmocka_unit_test(refuses_other_kinds),
        cmocka_unit_test(refuses_other_scenes),
        cmocka_unit_test(refuses_impossible_points),
        cmocka_unit_test(survives_fuzzed_images),
        cmocka_unit_test(keeps_earlier_when_disk_is_full),
        cmocka_unit_test(survives_lack_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
