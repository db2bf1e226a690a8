/* A table, exactly: for people, as CSV and as JSON, from one giving of its cells. */
#include "check.h"

#include "base/memory.h"
#include "io/file.h"
#include "study/table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void add_row(table *t, const char *basis, double error, const char *gone)
{
    const scene_axis axis = {.key = "basis", .value = {"linear", "quadratic"}, .n_values = 2};
    const int pick = strcmp(basis, "quadratic") == 0;
    table_row(t);
    table_values(t, (table_column){.in = TABLE_ALL, .object = "set", .quoted = true, .left = true, .names = true},
                 &axis, 1, &pick);
    table_values(t, (table_column){.in = TABLE_ALL, .object = "none"}, NULL, 0, NULL);
    if (gone) table_last(t, gone);
    table_number(t, "error",
                 (table_column){.in = TABLE_ALL, .unit = "Pa", .heading = "e", .format = "%.2f", .digits = 3}, error);
    table_number_as(t, "share", (table_column){.in = TABLE_SHOWN | TABLE_CSV, .width = 8}, 0.5, "50 %");
    table_whole(t, "steps", (table_column){.in = TABLE_JSON | TABLE_SHOWN}, 7);
    table_flag(t, "sure", (table_column){.in = TABLE_CSV | TABLE_JSON}, !gone);
    table_value(t, "all", (table_column){.in = TABLE_JSON}, json_array());
    table_text(t, "note", (table_column){.in = TABLE_SHOWN | TABLE_CSV, .quoted = true, .left = true},
               gone ? "" : "a \"b\", c");
    table_text(t, "nowhere", (table_column){.in = 0}, "x");
}

static void make_table(table *t, context *ctx)
{
    table_init(t, ctx);
    add_row(t, "linear", 1234.5678, NULL);
    add_row(t, "quadratic", NAN, "has failed");
    add_row(t, "quadratic", 0.125, NULL);
}

/* What is printed in lines of so many columns; 0: as long as they are. */
static void check_printed(int width, const char *expected)
{
    context *ctx = context_create();
    char text[1024] = "";
    FILE *file = tmpfile();
    table t;
    make_table(&t, ctx);
    check_ok(ctx, width > 0 ? table_print_at(&t, file, width) : table_print(&t, file));
    rewind(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    (void)fclose(file);
    assert_string_equal(text, expected);
    table_free(&t);
    context_destroy(&ctx);
}

static void people_see_columns(void **state)
{
    (void)state;
    check_printed(0, "basis            e     share  steps  note\n"
                     "linear     1234.57      50 %      7  a \"b\", c\n"
                     "quadratic  has failed\n"
                     "quadratic     0.12      50 %      7  a \"b\", c\n");
}

/* What does not fit beside the names follows below, with the names again. */
static void a_narrow_terminal_gets_sheets(void **state)
{
    (void)state;
    check_printed(30, "basis            e     share\n"
                      "linear     1234.57      50 %\n"
                      "quadratic  has failed\n"
                      "quadratic     0.12      50 %\n"
                      "\n"
                      "basis      steps  note\n"
                      "linear         7  a \"b\", c\n"
                      "quadratic\n"
                      "quadratic      7  a \"b\", c\n");
}

static void csv_has_names_and_units(void **state)
{
    (void)state;
    context *ctx = context_create();
    char *text;
    table t;
    make_table(&t, ctx);
    check_ok(ctx, table_write_csv(&t, ".", "test_table"));
    check_ok(ctx, file_read(ctx, "./test_table.csv", &text, NULL));
    assert_string_equal(text, "basis,error (Pa),share,sure,note\n"
                              "\"linear\",1.23e+03,0.5,yes,\"a \"\"b\"\", c\"\n"
                              "\"quadratic\",nan,0.5,no,\"\"\n"
                              "\"quadratic\",0.125,0.5,yes,\"a \"\"b\"\", c\"\n");
    memory_free(ctx, &text);
    (void)unlink("./test_table.csv");
    table_free(&t);
    context_destroy(&ctx);
}

/* Objects without a member are there; what is no number is null. */
static void json_has_objects(void **state)
{
    (void)state;
    context *ctx = context_create();
    table t;
    make_table(&t, ctx);
    json_t *list = table_json(&t);
    char *text = json_dumps(json_array_get(list, 1), JSON_COMPACT);
    assert_int_equal(json_array_size(list), 3);
    assert_string_equal(
        text, "{\"set\":{\"basis\":\"quadratic\"},\"none\":{},\"error\":null,\"steps\":7,\"sure\":false,\"all\":[]}");
    free(text);
    json_decref(list);
    table_free(&t);
    context_destroy(&ctx);
}

/* None, and any number of rows. */
static void an_empty_table_is_written(void **state)
{
    (void)state;
    context *ctx = context_create();
    table t;
    table_init(&t, ctx);
    json_t *list = table_json(&t);
    assert_int_equal(json_array_size(list), 0);
    check_ok(ctx, table_write_csv(&t, ".", "test_table_empty"));
    json_decref(list);
    table_free(&t);
    for (int rows = 1; rows <= 3; ++rows) { /* a line each, and one of names */
        char *text, wanted[32] = "n\n";
        table_init(&t, ctx);
        for (int k = 0; k < rows; ++k) {
            table_row(&t);
            table_whole(&t, "n", (table_column){.in = TABLE_CSV}, k);
            (void)snprintf(wanted + strlen(wanted), sizeof wanted - strlen(wanted), "%d\n", k);
        }
        check_ok(ctx, table_write_csv(&t, ".", "test_table_empty"));
        check_ok(ctx, file_read(ctx, "./test_table_empty.csv", &text, NULL));
        assert_string_equal(text, wanted);
        memory_free(ctx, &text);
        table_free(&t);
    }
    (void)unlink("./test_table_empty.csv");
    context_destroy(&ctx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(people_see_columns),
                                       cmocka_unit_test(a_narrow_terminal_gets_sheets),
                                       cmocka_unit_test(csv_has_names_and_units), cmocka_unit_test(json_has_objects),
                                       cmocka_unit_test(an_empty_table_is_written)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
