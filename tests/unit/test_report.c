/* What reports are made of: tables of CSV, and numbers as people write them. */
#include "check.h"

#include "io/csv.h"
#include "io/file.h"
#include "report/html.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct place {
    context *ctx;
    char path[64];
} place;

static int set_up(void **state)
{
    static place p;
    p = (place){.ctx = context_create(), .path = "table_XXXXXX"};
    const int descriptor = mkstemp(p.path);
    *state = &p;
    return p.ctx && descriptor >= 0 && close(descriptor) == 0 ? 0 : -1;
}

static int tear_down(void **state)
{
    place *p = *state;
    const int status = unlink(p->path);
    context_destroy(&p->ctx);
    return status;
}

static void read_text(place *p, const char *text, csv_table *t)
{
    check_ok(p->ctx, file_replace_text(p->ctx, p->path, text));
    check_ok(p->ctx, csv_read(t, p->ctx, p->path));
}

static void tables_are_read(void **state)
{
    place *p = *state;
    csv_table t;
    read_text(p,
              "time (s),drift (1),\"a (b) name, quoted\",dt_limit\n"
              "0,nan,3,\"with, \"\"quotes\"\"\"\n"
              "1e-3,-2.5e-16,inf\n" /* a short row */
              "2,3,4,5,6\n"         /* a long one */
              "7,8",                /* and half of one */
              &t);
    assert_int_equal(t.n_columns, 4);
    assert_int_equal(t.n_rows, 3);
    assert_string_equal(t.column[0].unit, "s");
    assert_string_equal(t.column[1].unit, "");
    assert_string_equal(t.column[2].name, "a (b) name, quoted");
    const csv_column *limit = csv_find(&t, "dt_limit"), *drift = csv_find(&t, "drift");
    assert_non_null(limit);
    assert_non_null(drift);
    assert_null(csv_find(&t, "dt"));
    assert_string_equal(limit->text[0], "with, \"quotes\"");
    assert_string_equal(limit->text[1], "");
    assert_true(isnan(limit->value[0]) && isnan(limit->value[1]));
    assert_true(limit->value[2] == 5.0);
    assert_true(isnan(drift->value[0]));
    assert_true(drift->value[1] == -2.5e-16);
    assert_true(t.column[0].value[2] == 2.0);
    assert_true(csv_names("time (s),\"a, mass\",mass_steel (kg),dt\n1", "dt") && !csv_names("a,b\n", "c"));
    assert_false(csv_names("time (s),\"a, mass\",mass_steel (kg)\n", "mass"));
    csv_free(&t);
}

static void tables_may_be_empty(void **state)
{
    static const char *const texts[] = {"", "time (s)", "\n", "time (s)\n"};
    csv_table t;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        read_text(*state, texts[i], &t);
        assert_int_equal(t.n_rows, 0);
        csv_free(&t);
    }
    place *p = *state;
    check_fails(p->ctx, csv_read(&t, p->ctx, "no_such_table.csv"), FLOE_IO);
    csv_free(&t);
}

static void numbers_are_written_for_people(void **state)
{
    static const struct {
        double value;
        int digits;
        const char *text;
    } number[] = {
        {0.0, 3, "0"},
        {-1.5, 3, "−1.5"},
        {1.3e-5, 3, "1.3×10<sup>−5</sup>"},
        {123456, 6, "123456"},
        {-2e7, 3, "−2×10<sup>7</sup>"},
        {NAN, 3, "–"},
        {INFINITY, 3, "∞"},
    };
    static const struct {
        double seconds;
        const char *text;
    } time[] = {{0.0312, "0.0312 s"}, {99.0, "99 s"}, {125.4, "2 min 05 s"}, {7260.0, "2 h 01 min"}, {NAN, "–"}};
    place *p = *state;
    strbuf out;
    strbuf_init(&out, p->ctx);
    for (size_t i = 0; i < sizeof number / sizeof number[0]; i++) {
        html_number(&out, number[i].value, number[i].digits);
        assert_string_equal(strbuf_string(&out), number[i].text);
        strbuf_free(&out);
    }
    for (size_t i = 0; i < sizeof time / sizeof time[0]; i++) {
        html_seconds(&out, time[i].seconds);
        assert_string_equal(strbuf_string(&out), time[i].text);
        strbuf_free(&out);
    }
    html_count(&out, 1234567.0);
    assert_string_equal(strbuf_string(&out), "1\u202f234\u202f567");
    strbuf_free(&out);
    html_error(&out, "eq13", 0.0123456, true);
    assert_string_equal(strbuf_string(&out), "1.235 %");
    strbuf_free(&out);
    html_error(&out, "l1_pressure", 2.5, false);
    assert_string_equal(strbuf_string(&out), "2.5 Pa");
    strbuf_free(&out);
    html_error(&out, "l1_pressure", 2.5, true);
    assert_string_equal(strbuf_string(&out), "2.5");
    strbuf_free(&out);
}

/* Nothing that stands in a deck or a log can become markup. */
static void text_stays_text(void **state)
{
    place *p = *state;
    strbuf out;
    strbuf_init(&out, p->ctx);
    html_cell(&out, "<script>");
    html_status(&out, "\"><b>");
    html_fact_text(&out, "<dt>", "&");
    html_verbatim(&out, "</pre>\n<b>");
    html_table_begin(&out, "<i>|#<u>");
    html_download(&out, "<a>", "\"", "text/csv", "x", 1);
    html_fold_begin(&out, "</summary>");
    assert_null(strstr(strbuf_string(&out), "<script>"));
    assert_null(strstr(strbuf_string(&out), "<b>"));
    assert_null(strstr(strbuf_string(&out), "<i>"));
    assert_null(strstr(strbuf_string(&out), "<u>"));
    assert_null(strstr(strbuf_string(&out), "<a>"));
    assert_non_null(strstr(strbuf_string(&out), "&lt;/pre&gt;\n&lt;b&gt;"));
    assert_non_null(strstr(strbuf_string(&out), "<dt>&lt;dt&gt;</dt><dd>&amp;</dd>"));
    assert_non_null(
        strstr(strbuf_string(&out), "<a download=\"&quot;\" href=\"data:text/csv;base64,eA==\">&lt;a&gt;</a>"));
    assert_non_null(strstr(strbuf_string(&out), "<summary>&lt;/summary&gt;</summary>"));
    strbuf_free(&out);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(tables_are_read, set_up, tear_down),
        cmocka_unit_test_setup_teardown(tables_may_be_empty, set_up, tear_down),
        cmocka_unit_test_setup_teardown(numbers_are_written_for_people, set_up, tear_down),
        cmocka_unit_test_setup_teardown(text_stays_text, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
