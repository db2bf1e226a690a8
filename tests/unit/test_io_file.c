/* Files: whole or not at all; folders; texts. */
#include "test_io_fixture.h"

#include "io/strbuf.h"
#include "test_io_faults.h"

#include <sys/stat.h>

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

static void full_device_is_reported(void **state)
{
    place *p = *state;
    line_file file;
    check_ok(p->ctx, line_file_open(&file, p->ctx, "/dev/full"));
    check_fails(p->ctx, line_file_append(&file, "x\n", 2), FLOE_IO);
    line_file_close(&file);
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
        cmocka_unit_test_setup_teardown(keeps_earlier_file_on_faults, setup, teardown),
        cmocka_unit_test_setup_teardown(goes_on_after_signals, setup, teardown),
        cmocka_unit_test_setup_teardown(refuses_what_cannot_be, setup, teardown),
        cmocka_unit_test_setup_teardown(makes_folders, setup, teardown),
        cmocka_unit_test_setup_teardown(appends_whole_lines, setup, teardown),
        cmocka_unit_test_setup_teardown(full_device_is_reported, setup, teardown),
        cmocka_unit_test_setup_teardown(texts_grow, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
