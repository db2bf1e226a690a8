/* Files: whole or not at all; folders; texts. */
#include "test_io_fixture.h"

#include "base/strbuf.h"
#include "io/lock.h"
#include "test_io_faults.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

typedef struct place {
    context *ctx;
    char folder[FIXTURE_PATH], path[FIXTURE_PATH], temporary[FIXTURE_PATH];
} place;

static int setup(void **state)
{
    static place p;
    p.ctx = context_create();
    fixture_folder(p.folder);
    fixture_path(p.path, p.folder, "file");
    fixture_path(p.temporary, p.folder, "file.tmp");
    *state = &p;
    return 0;
}

static int teardown(void **state)
{
    place *p = *state;
    const uint64_t live = memory_read_account(p->ctx).live_bytes;
    fixture_remove_folder(p->folder);
    context_destroy(&p->ctx);
    return live != 0;
}

static void holds(place *p, const char *expected)
{
    size_t size;
    char *data = fixture_read(p->ctx, p->path, &size);
    assert_string_equal(data, expected);
    assert_int_equal(size, strlen(expected));
    memory_free(p->ctx, &data);
}

static void replaces_whole_files(void **state)
{
    place *p = *state;
    const file_part part[] = {{"one", 3}, {"", 0}, {" two", 4}};
    check_ok(p->ctx, file_replace(p->ctx, p->path, part, 3));
    holds(p, "one two");
    check_ok(p->ctx, file_replace_text(p->ctx, p->path, ""));
    holds(p, "");
    assert_false(file_exists(p->temporary));
    check_ok(p->ctx, file_remove(p->ctx, p->path));
    check_ok(p->ctx, file_remove(p->ctx, p->path)); /* no more there: fine */
    assert_false(file_exists(p->path));
}

static void holds_at(place *p, const char *path, const char *expected)
{
    char *data = fixture_read(p->ctx, path, NULL);
    assert_string_equal(data, expected);
    memory_free(p->ctx, &data);
}

/* The two latest: the earlier file stays under the other name, and never is there none under either. */
static void keeps_the_one_before(void **state)
{
    place *p = *state;
    char kept[FIXTURE_PATH], of_kept[FIXTURE_PATH];
    const file_part one = {"one", 3}, two = {"two", 3}, three = {"three", 5};
    fixture_path(kept, p->folder, "kept");
    fixture_path(of_kept, p->folder, "kept.tmp");
    check_ok(p->ctx, file_remove(p->ctx, p->path));
    check_ok(p->ctx, file_replace_keeping(p->ctx, p->path, "kept", &one, 1)); /* there is nothing to keep */
    assert_false(file_exists(kept));
    check_ok(p->ctx, file_replace_keeping(p->ctx, p->path, "kept", &two, 1));
    holds(p, "two");
    holds_at(p, kept, "one");
    /* A kill between the two names of one file and the new file leaves them so. */
    assert_int_equal(unlink(kept), 0);
    assert_int_equal(link(p->path, kept), 0);
    assert_int_equal(link(p->path, of_kept), 0);
    check_ok(p->ctx, file_replace_keeping(p->ctx, p->path, "kept", &three, 1));
    holds(p, "three");
    holds_at(p, kept, "two");
    assert_false(file_exists(of_kept));
    /* Write, sync, the two renames, and the sync of the folder. */
    for (int n = 1; n <= 5; n++) {
        fault_arm(n, ENOSPC, true);
        const floe_status status = file_replace_keeping(p->ctx, p->path, "kept", &one, 1);
        fault_arm(0, 0, false);
        check_fails(p->ctx, status, FLOE_IO);
        holds(p, n < 5 ? "three" : "one");
        holds_at(p, kept, n < 4 ? "two" : "three");
        assert_false(file_exists(p->temporary));
        assert_false(file_exists(of_kept));
    }
}

static void keeps_earlier_file_on_faults(void **state)
{
    place *p = *state;
    const int errors[] = {ENOSPC, EDQUOT, EIO, EROFS};
    check_ok(p->ctx, file_replace_text(p->ctx, p->path, "earlier"));
    for (int n = 1; n <= 3; n++) {
        for (size_t e = 0; e < sizeof errors / sizeof errors[0]; e++) {
            fault_arm(n, errors[e], true);
            const floe_status status = file_replace_text(p->ctx, p->path, "later");
            fault_arm(0, 0, false);
            assert_non_null(strstr(context_message(p->ctx), p->path));
            assert_non_null(strstr(context_message(p->ctx), strerror(errors[e])));
            assert_non_null(strchr(context_message(p->ctx), '(')); /* a remedy */
            check_fails(p->ctx, status, FLOE_IO);
            holds(p, "earlier");
            assert_false(file_exists(p->temporary));
        }
    }
}

/* A write that a signal interrupts is taken up again. */
static void goes_on_after_signals(void **state)
{
    place *p = *state;
    fault_arm(1, EINTR, false);
    check_ok(p->ctx, file_replace_text(p->ctx, p->path, "x"));
    assert_true(fault.fired);
    holds(p, "x");
}

static void refuses_what_cannot_be(void **state)
{
    place *p = *state;
    char *data;
    check_fails(p->ctx, file_read(p->ctx, p->path, &data, NULL), FLOE_IO);
    assert_null(data);
    check_fails(p->ctx, file_read(p->ctx, p->folder, &data, NULL), FLOE_IO);
    check_fails(p->ctx, file_replace_text(p->ctx, "/dev/null/x/y", "text"), FLOE_IO);
    check_fails(p->ctx, file_replace_text(p->ctx, p->folder, "text"), FLOE_IO);
    check_fails(p->ctx, folder_make(p->ctx, ""), FLOE_BAD_INPUT);
    check_fails(p->ctx, folder_make(p->ctx, "/dev/null/x"), FLOE_IO);
    check_fails(p->ctx, folder_make(p->ctx, "/proc/floe"), FLOE_IO);
    assert_int_equal(mkfifo(p->path, 0600), 0);
    check_fails(p->ctx, file_read(p->ctx, p->path, &data, NULL), FLOE_IO); /* and does not wait for a writer */
}

static void makes_folders(void **state)
{
    place *p = *state;
    char deep[FIXTURE_PATH], file[FIXTURE_PATH + 8];
    fixture_path(deep, p->folder, "a/b//c/");
    check_ok(p->ctx, folder_make(p->ctx, deep));
    check_ok(p->ctx, folder_make(p->ctx, deep));
    (void)snprintf(file, sizeof file, "%sx", deep);
    check_ok(p->ctx, file_replace_text(p->ctx, file, "x"));
    check_fails(p->ctx, folder_make(p->ctx, file), FLOE_IO); /* a file stands there */
    if (geteuid() == 0) return;                              /* root may write anywhere */
    assert_int_equal(chmod(deep, 0500), 0);
    check_fails(p->ctx, folder_make(p->ctx, deep), FLOE_IO);
    assert_int_equal(chmod(deep, 0700), 0);
}

static void appends_whole_lines(void **state)
{
    place *p = *state;
    line_file file;
    check_fails(p->ctx, line_file_open(&file, p->ctx, p->path), FLOE_IO);
    check_ok(p->ctx, file_replace_text(p->ctx, p->path, "head\n"));
    check_ok(p->ctx, line_file_open(&file, p->ctx, p->path));
    check_ok(p->ctx, line_file_append(&file, "row one\n", 8));
    fault_arm(1, ENOSPC, true);
    const floe_status status = line_file_append(&file, "row two\n", 8);
    fault_arm(0, 0, false);
    check_fails(p->ctx, status, FLOE_IO);
    holds(p, "head\nrow one\n"); /* no half of a row */
    check_ok(p->ctx, line_file_append(&file, "row three\n", 10));
    check_ok(p->ctx, line_file_sync(&file));
    line_file_close(&file);
    line_file_close(&file);
    holds(p, "head\nrow one\nrow three\n");
}

/* A real refusal of the system in the midst of a line; a device is not written to. */
static void full_file_is_reported(void **state)
{
    place *p = *state;
    line_file file;
    struct rlimit before;
    check_fails(p->ctx, line_file_open(&file, p->ctx, "/dev/full"), FLOE_IO);
    check_ok(p->ctx, file_replace_text(p->ctx, p->path, "head\n"));
    check_ok(p->ctx, line_file_open(&file, p->ctx, p->path));
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &(struct rlimit){7, before.rlim_max}), 0);
    void (*const handler)(int) = signal(SIGXFSZ, SIG_IGN);
    const floe_status status = line_file_append(&file, "row one\n", 8);
    (void)signal(SIGXFSZ, handler);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    check_fails(p->ctx, status, FLOE_IO);
    line_file_close(&file);
    holds(p, "head\n"); /* no half of a row */
}

/* Makes what is no ordinary file under a name. */
typedef void maker(const char *path);

static void make_pipe(const char *path)
{
    assert_int_equal(mkfifo(path, 0600), 0);
}
static void make_folder(const char *path)
{
    assert_int_equal(mkdir(path, 0700), 0);
}
static void make_link(const char *path)
{
    assert_int_equal(symlink("victim", path), 0);
}
static void make_broken_link(const char *path)
{
    assert_int_equal(symlink("nowhere", path), 0);
}
static void make_socket(const char *path)
{
    struct sockaddr_un name = {.sun_family = AF_UNIX};
    const int end = socket(AF_UNIX, SOCK_STREAM, 0);
    assert_true(end >= 0 && strlen(path) < sizeof name.sun_path);
    (void)snprintf(name.sun_path, sizeof name.sun_path, "%s", path);
    assert_int_equal(bind(end, (struct sockaddr *)&name, sizeof name), 0);
    (void)close(end);
}

static const struct {
    maker *make;
    mode_t kind;
    const char *words;
} special[] = {{make_pipe, S_IFIFO, "a named pipe"},
               {make_folder, S_IFDIR, "a folder"},
               {make_link, S_IFLNK, "a symbolic link"},
               {make_broken_link, S_IFLNK, "a symbolic link"},
               {make_socket, S_IFSOCK, "a socket"}};

static void refused_for(place *p, floe_status status, const char *words)
{
    assert_non_null(strstr(context_message(p->ctx), words));
    check_fails(p->ctx, status, FLOE_IO);
}

static void check_kind(const char *path, mode_t kind)
{
    struct stat about;
    assert_int_equal(lstat(path, &about), 0);
    assert_int_equal(about.st_mode & S_IFMT, kind);
}

/* What is no ordinary file is not replaced, not removed, not appended to, and not waited for. */
static void keeps_what_is_no_file(void **state)
{
    place *p = *state;
    char victim[FIXTURE_PATH];
    line_file file;
    fixture_path(victim, p->folder, "victim");
    check_ok(p->ctx, file_replace_text(p->ctx, victim, "mine"));
    for (size_t k = 0; k < sizeof special / sizeof special[0]; k++) {
        special[k].make(p->path);
        refused_for(p, file_replace_text(p->ctx, p->path, "x"), special[k].words);
        refused_for(p, file_remove(p->ctx, p->path), special[k].words);
        refused_for(p, line_file_open(&file, p->ctx, p->path), special[k].words);
        check_kind(p->path, special[k].kind);
        assert_false(file_exists(p->temporary));
        assert_int_equal(remove(p->path), 0);
    }
    (void)snprintf(p->path, sizeof p->path, "%s", victim);
    holds(p, "mine");
}

/* What stands where a new file is made (NAME.tmp) is not written through. */
static void makes_files_anew(void **state)
{
    place *p = *state;
    char victim[FIXTURE_PATH];
    fixture_path(victim, p->folder, "victim");
    check_ok(p->ctx, file_replace_text(p->ctx, victim, "mine"));
    for (int hard = 0; hard < 2; hard++) {
        assert_int_equal(hard ? link(victim, p->temporary) : symlink("victim", p->temporary), 0);
        check_ok(p->ctx, file_replace_text(p->ctx, p->path, "text"));
        holds(p, "text");
        assert_false(file_exists(p->temporary));
    }
    assert_int_equal(mkdir(p->temporary, 0700), 0);
    check_fails(p->ctx, file_replace_text(p->ctx, p->path, "later"), FLOE_IO);
    holds(p, "text");
    assert_int_equal(rmdir(p->temporary), 0);
    (void)snprintf(p->path, sizeof p->path, "%s", victim);
    holds(p, "mine");
}

/* A folder that is a link is not emptied. */
static void follows_no_link_to_a_folder(void **state)
{
    place *p = *state;
    char folder[FIXTURE_PATH], link[FIXTURE_PATH];
    fixture_path(folder, p->folder, "elsewhere");
    fixture_path(link, p->folder, "link");
    fixture_path(p->path, p->folder, "elsewhere/file");
    check_ok(p->ctx, folder_make(p->ctx, folder));
    check_ok(p->ctx, file_replace_text(p->ctx, p->path, "mine"));
    assert_int_equal(symlink("elsewhere", link), 0);
    check_fails(p->ctx, folder_remove(p->ctx, link), FLOE_IO);
    holds(p, "mine");
}

/* A lock that is a link makes nothing elsewhere. */
static void locks_ordinary_files(void **state)
{
    place *p = *state;
    char lock[FIXTURE_PATH];
    folder_lock taken;
    fixture_path(lock, p->folder, ".lock");
    fixture_path(p->path, p->folder, "nowhere");
    assert_int_equal(symlink("nowhere", lock), 0);
    refused_for(p, folder_lock_take(&taken, p->ctx, p->folder), "a symbolic link");
    assert_false(file_exists(p->path));
    assert_int_equal(remove(lock), 0);
    make_pipe(lock);
    assert_int_equal(folder_lock_holder(p->folder), 0); /* and does not wait */
    refused_for(p, folder_lock_take(&taken, p->ctx, p->folder), "a named pipe");
    assert_int_equal(remove(lock), 0);
    check_ok(p->ctx, folder_lock_take(&taken, p->ctx, p->folder));
    folder_lock_release(&taken);
}

static void texts_grow(void **state)
{
    place *p = *state;
    strbuf t;
    strbuf_init(&t, p->ctx);
    assert_string_equal(strbuf_string(&t), "");
    for (int i = 0; i < 1000; i++) strbuf_append(&t, "%d,", i % 10);
    assert_int_equal(t.length, 2000);
    strbuf_free(&t);
    strbuf_append_xml(&t, "<a & \"b'\n>");
    assert_string_equal(strbuf_string(&t), "&lt;a &amp; &quot;b&apos; &gt;");
    strbuf_free(&t);
    memory_inject_failure(p->ctx, 1);
    strbuf_append(&t, "lost");
    memory_inject_failure(p->ctx, 0);
    strbuf_append(&t, "too late");
    check_fails(p->ctx, t.status, FLOE_NO_MEMORY);
    assert_string_equal(strbuf_string(&t), "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(replaces_whole_files, setup, teardown),
        cmocka_unit_test_setup_teardown(keeps_the_one_before, setup, teardown),
        cmocka_unit_test_setup_teardown(keeps_earlier_file_on_faults, setup, teardown),
        cmocka_unit_test_setup_teardown(goes_on_after_signals, setup, teardown),
        cmocka_unit_test_setup_teardown(refuses_what_cannot_be, setup, teardown),
        cmocka_unit_test_setup_teardown(makes_folders, setup, teardown),
        cmocka_unit_test_setup_teardown(appends_whole_lines, setup, teardown),
        cmocka_unit_test_setup_teardown(full_file_is_reported, setup, teardown),
        cmocka_unit_test_setup_teardown(keeps_what_is_no_file, setup, teardown),
        cmocka_unit_test_setup_teardown(makes_files_anew, setup, teardown),
        cmocka_unit_test_setup_teardown(follows_no_link_to_a_folder, setup, teardown),
        cmocka_unit_test_setup_teardown(locks_ordinary_files, setup, teardown),
        cmocka_unit_test_setup_teardown(texts_grow, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
