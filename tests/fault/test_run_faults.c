/* Whole runs in which something fails: every allocation that a run makes, once each with all after it, and every write, sync and rename.
 * Always the right status with a message, nothing left in memory, every file whole, and a run that goes on to the bits of one that
 * nothing has disturbed. */
#include "verification/coupled_fixture.h"

#include "io/checkpoint/checkpoint.h"
#include "io/file.h"
#include "io/io.h"
#include "io/sealed_file.h"
#include "run/run.h"
#include "unit/test_io_faults.h"

#include <dirent.h>
#include <stdlib.h>

enum { PATH = 256, MOST_FAULTS = 20000 };

/* A run of some steps, its snapshots and checkpoints on the way. */
typedef struct run_variant {
    const char *name, *deck;
    size_t n_set;
    const char *set[8];
} run_variant;

#define OFTEN "output.checkpoint_interval=1e-9", "time.max_steps=6"
static const run_variant variants[] = {
    {"both",
     "pressurized_cylinder",
     6,
     {OFTEN, "coupling=ice-mpm", "domain.cell=0.4", "output.history_interval=1e-9", "method.interface=smeared"}},
    {"reaction", "closed_vessel_burn", 2, {OFTEN}},
    {"membrane that holds gas", "membrane_circle", 4, {OFTEN, "coupling=ice-mpm", "domain.cell=0.25"}},
    {"contact", "two_bars", 3, {OFTEN, "domain.cell=0.25"}},
};
enum { VARIANTS = sizeof variants / sizeof variants[0] };

typedef struct fixture {
    trial t;
    char folder[PATH], whole[2 * PATH], part[2 * PATH];
    const run_variant *v;
    double time; /* s, that the last run has reached */
} fixture;

static void fixture_begin(fixture *f, const run_variant *v)
{
    memset(f, 0, sizeof *f);
    fault.unsynced = true;
    f->v = v;
    deck_begin(&f->t, v->deck, v->set, v->n_set);
    check_ok(f->t.ctx, io_init(f->t.ctx));
    (void)snprintf(f->folder, sizeof f->folder, "/tmp/floe_test_XXXXXX");
    assert_non_null(mkdtemp(f->folder));
    (void)snprintf(f->whole, sizeof f->whole, "%s/whole", f->folder);
    (void)snprintf(f->part, sizeof f->part, "%s/part", f->folder);
}

static void clear(const char *folder)
{
    char command[3 * PATH];
    (void)snprintf(command, sizeof command, "rm -rf '%s'", folder);
    assert_int_equal(system(command), 0);
}

static void fixture_end(fixture *f)
{
    clear(f->folder);
    trial_end(&f->t);
}

static floe_status run_in(fixture *f, const char *dir, bool resume)
{
    run_summary summary;
    const run_options options = {.dir = dir, .resume = resume, .threads = 1};
    const floe_status status = run_scene(f->t.ctx, f->t.scene, &options, &summary);
    f->time = summary.time;
    return status;
}

static void path_in(char path[3 * PATH], const char *dir, const char *name)
{
    (void)snprintf(path, 3 * PATH, "%s/%s", dir, name);
}

static bool is_there(const char *dir, const char *name)
{
    char path[3 * PATH];
    path_in(path, dir, name);
    return file_exists(path);
}

static void same_file(fixture *f, const char *name)
{
    char *a, *b, path[3 * PATH];
    size_t n, m;
    path_in(path, f->whole, name);
    check_ok(f->t.ctx, file_read(f->t.ctx, path, &a, &n));
    path_in(path, f->part, name);
    check_ok(f->t.ctx, file_read(f->t.ctx, path, &b, &m));
    if (n != m || memcmp(a, b, n) != 0) print_error("%s: other bytes\n", name);
    assert_int_equal(n, m);
    assert_memory_equal(a, b, n);
    memory_free(f->t.ctx, &a);
    memory_free(f->t.ctx, &b);
}

/* The history and the snapshots have the same bytes. */
static void same_results(fixture *f)
{
    char folder[3 * PATH];
    path_in(folder, f->whole, "fields");
    DIR *list = opendir(folder);
    assert_non_null(list);
    for (const struct dirent *entry = readdir(list); entry; entry = readdir(list)) {
        char name[300];
        (void)snprintf(name, sizeof name, "fields/%s", entry->d_name);
        if (strstr(entry->d_name, ".h5")) same_file(f, name);
    }
    (void)closedir(list);
    same_file(f, "history.csv");
}

/* The checkpoint, if there is one, is whole. */
static void sound_checkpoint(fixture *f)
{
    char path[3 * PATH];
    sealed_file file;
    path_in(path, f->part, "checkpoint.h5");
    if (!file_exists(path)) return;
    check_ok(f->t.ctx, sealed_read(f->t.ctx, path, SEALED_CHECKPOINT, 3, true, &file));
    sealed_free(f->t.ctx, &file);
}

/* From what is left to the end, and there to the bits of the whole run. */
static void goes_on(fixture *f)
{
    sound_checkpoint(f);
    check_ok(f->t.ctx, run_in(f, f->part, is_there(f->part, "checkpoint.h5")));
    same_results(f);
    assert_false(is_there(f->part, "checkpoint.h5.tmp"));
}

/* How far from one fault to the next: 1 with FLOE_EVERY set (nightly), else `some`. */
static int stride(int some)
{
    return getenv("FLOE_EVERY") ? 1 : some;
}

/* Fails the n-th allocation and all that follow. Now and then a run goes on from what is left. */
static void sweep_memory(fixture *f)
{
    const uint64_t before = memory_read_account(f->t.ctx).live_bytes;
    uint64_t n = 1, tries = 0;
    for (floe_status status = FLOE_NO_MEMORY; status != FLOE_OK; n += (uint64_t)stride(29), tries++) {
        memory_inject_failure(f->t.ctx, n);
        status = run_in(f, f->part, false);
        memory_inject_failure(f->t.ctx, 0);
        if (status != FLOE_OK) check_fails(f->t.ctx, status, FLOE_NO_MEMORY);
        assert_int_equal(memory_read_account(f->t.ctx).live_bytes, before);
        if (status != FLOE_OK && tries % 16 == 15) goes_on(f);
        assert_in_range(n, 1, MOST_FAULTS);
    }
    same_results(f);
    print_message("%s: %llu faults up to allocation %llu\n", f->v->name, (unsigned long long)(tries - 1),
                  (unsigned long long)n);
    check_true(n > 100);
}

static void every_allocation_may_fail(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < VARIANTS; k++) {
        fixture f;
        fixture_begin(&f, &variants[k]);
        check_ok(f.t.ctx, run_in(&f, f.whole, false));
        sweep_memory(&f);
        fixture_end(&f);
    }
}

/* A full disk from the n-th write, sync or rename on, or for that one alone. */
static int sweep_disk(fixture *f, int error, bool lasting, const char *words)
{
    int n = 1, tries = 0;
    for (bool fired = true; fired; n += stride(11), tries++) {
        clear(f->part);
        fault_arm(n, error, lasting);
        const floe_status status = run_in(f, f->part, false);
        fired = fault.fired;
        fault_arm(0, 0, false);
        assert_in_range(n, 1, MOST_FAULTS);
        if (!fired) {
            check_ok(f->t.ctx, status);
            break;
        }
        if (!lasting && status == FLOE_OK) {
            print_message("call %d: one fault does no harm\n", n);
            continue;
        }
        /* The last line of the log alone comes after everything else is on the disk. */
        if (status == FLOE_OK) {
            same_results(f);
            fault_arm(n + 1, error, lasting);
            check_ok(f->t.ctx, run_in(f, f->part, false));
            assert_false(fault.fired);
            fault_arm(0, 0, false);
            continue;
        }
        if (!strstr(context_message(f->t.ctx), words)) print_error("call %d: %s\n", n, context_message(f->t.ctx));
        assert_non_null(strstr(context_message(f->t.ctx), words));
        check_fails(f->t.ctx, status, FLOE_IO);
        goes_on(f);
    }
    same_results(f);
    return tries;
}

/* The time that a run says that it has reached and saved. */
static bool has_saved(fixture *f)
{
    char words[64];
    (void)snprintf(words, sizeof words, "a checkpoint of t = %.6g", f->time);
    return strstr(context_message(f->t.ctx), words) != NULL;
}

/* A disk that is full from the n-th call on, but for the room that was kept: no step is lost. */
static int sweep_full_disk(fixture *f)
{
    int n = 1, saved = 0;
    for (bool fired = true; fired; n += stride(7)) {
        clear(f->part);
        fault.relents = true;
        fault_arm(n, ENOSPC, true);
        const floe_status status = run_in(f, f->part, false);
        fired = fault.fired;
        fault.relents = false;
        fault_arm(0, 0, false);
        assert_in_range(n, 1, MOST_FAULTS);
        if (status == FLOE_OK) continue; /* only a checkpoint has failed */
        /* Before its first row a run has nothing to lose, and with its summary it has ended. */
        const bool ended = strstr(context_message(f->t.ctx), "summary.json") != NULL;
        const bool began = !ended && is_there(f->part, "run.log") && is_there(f->part, "summary.json");
        if (began && !has_saved(f)) print_error("call %d: %s\n", n, context_message(f->t.ctx));
        check_true(!began || has_saved(f));
        saved += began;
        check_fails(f->t.ctx, status, FLOE_IO);
        check_true(!is_there(f->part, "checkpoint.reserve"));
        goes_on(f);
    }
    same_results(f);
    return saved;
}

static void full_disks_lose_no_step(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < VARIANTS; k++) {
        fixture f;
        fixture_begin(&f, &variants[k]);
        check_ok(f.t.ctx, run_in(&f, f.whole, false));
        const int saved = sweep_full_disk(&f);
        print_message("%s: %d times saved from a full disk\n", f.v->name, saved);
        check_true(saved > 4);
        fixture_end(&f);
    }
}

static void every_write_may_fail(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < VARIANTS; k++) {
        fixture f;
        fixture_begin(&f, &variants[k]);
        check_ok(f.t.ctx, run_in(&f, f.whole, false));
        const int full = sweep_disk(&f, ENOSPC, true, "the disk is full");
        const int broken = k == 0 ? sweep_disk(&f, EIO, false, "the device reports an error") : 0;
        print_message("%s: %d faults of calls that write, for good, and %d once\n", f.v->name, full, broken);
        check_true(full > 5);
        fixture_end(&f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(every_write_may_fail),
        cmocka_unit_test(full_disks_lose_no_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
