/* What a search and a map write, exactly: tables, the table for people, and data and scripts of their figures. */
#include "check.h"

#include "base/memory.h"
#include "io/file.h"
#include "study/stability/stability.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SETS = 4, PROBES = 9, PATH = 512, TEXT = 8192 };

typedef struct fixture {
    context *ctx;
    stability s;
    stability_set set[SETS];
    stability_probe probe[PROBES];
    char dir[PATH];
} fixture;

static void put_probe(fixture *f, size_t set, double x, const char *value, verdict found, double ratio)
{
    const size_t n = f->s.n_probes++;
    stability_probe *p = &f->probe[n];
    *p = (stability_probe){.set = set,
                           .x = {x},
                           .verdict = found,
                           .steps = 10 * (long long)(n + 1),
                           .rejected = (long long)n,
                           .time = 0.5};
    p->energy = (energy_record){.judged = true, .finite = true, .ratio = ratio};
    (void)snprintf(p->value[0], SCENE_VALUE, "%s", value);
    (void)snprintf(p->folder, sizeof p->folder, "%02zu-%s", set + 1, value);
    if (found != VERDICT_STABLE) (void)snprintf(p->cause, sizeof p->cause, "why, %zu", n);
    if (f->s.n_over == 1)
        search_tell(&f->set[set].search, x, found == VERDICT_STABLE ? SEARCH_STABLE : SEARCH_UNSTABLE);
}

/* Two keys of two values each, the last key fastest, and the values 0.25, 0.5 and 1 ms. */
static int set_up(void **state)
{
    static fixture f;
    const search_spec spec = {.from = 0.25, .to = 1.0, .tolerance = 0.6, .most = 8};
    f = (fixture){.ctx = context_create()};
    (void)snprintf(f.dir, sizeof f.dir, "stability_XXXXXX");
    if (!f.ctx || !mkdtemp(f.dir)) return -1;
    f.s = (stability){.ctx = f.ctx,
                      .deck_path = f.dir,
                      .dir = f.dir,
                      .title = "line",
                      .n_over = 1,
                      .n_each = 2,
                      .unit = " ms",
                      .tolerance = 0.6,
                      .growth = 100.0,
                      .relative_to = 0.5,
                      .by_energy = true,
                      .set = f.set,
                      .n_sets = SETS,
                      .probe = f.probe};
    f.s.over[0] = (scene_axis){.key = "time.step"};
    f.s.each[0] = (scene_axis){.key = "stress", .value = {"usl", "musl"}, .n_values = 2};
    f.s.each[1] = (scene_axis){.key = "offset", .value = {"0", "0.5"}, .n_values = 2};
    for (int k = 0; k < SETS; k++) {
        f.set[k] = (stability_set){.value = {k / 2, k % 2}};
        search_begin(&f.set[k].search, &spec);
    }
    put_probe(&f, 0, 1.0, "1 ms", VERDICT_GROWS, 400.0);
    put_probe(&f, 0, 0.25, "0.25 ms", VERDICT_STABLE, 1.0);
    put_probe(&f, 0, 0.5, "0.5 ms", VERDICT_STABLE, 1.5);
    put_probe(&f, 1, 0.25, "0.25 ms", VERDICT_REJECTED, 2.0);
    put_probe(&f, 1, 1.0, "1 ms", VERDICT_DIVERGED, 0.0);
    put_probe(&f, 2, 0.25, "0.25 ms", VERDICT_STABLE, 1.0);
    put_probe(&f, 2, 1.0, "1 ms", VERDICT_STABLE, 1.25);
    put_probe(&f, 3, 0.25, "0.25 ms", VERDICT_STABLE, 1.0);
    f.set[3].broken = true;
    *state = &f;
    return 0;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    char command[PATH + 16];
    (void)snprintf(command, sizeof command, "/bin/rm -rf '%s'", f->dir);
    const int status = system(command);
    context_destroy(&f->ctx);
    return status;
}

static void read_file(const fixture *f, const char *name, char out[2 * TEXT])
{
    char path[2 * PATH], *text;
    (void)snprintf(path, sizeof path, "%s/%s", f->dir, name);
    check_ok(f->ctx, file_read(f->ctx, path, &text, NULL));
    (void)snprintf(out, 2 * TEXT, "%s", text);
    memory_free(f->ctx, &text);
}

static void check_file(const fixture *f, const char *name, const char *wanted)
{
    char text[2 * TEXT];
    read_file(f, name, text);
    assert_string_equal(text, wanted);
}

static void check_printed(const fixture *f, const char *wanted)
{
    char text[TEXT] = "";
    FILE *file = tmpfile();
    assert_non_null(file);
    check_ok(f->ctx, stability_print(&f->s, file));
    rewind(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    (void)fclose(file);
    const char *table = strstr(text, "\n\n");
    assert_non_null(table);
    assert_string_equal(table + 2, wanted);
}

static void a_search_is_written(void **state)
{
    const fixture *f = *state;
    check_ok(f->ctx, stability_write(&f->s));
    check_file(f, "stability.csv",
               "stress,offset,time.step,verdict,energy_ratio,steps,rejected_steps,time (s),cause,directory\n"
               "\"usl\",\"0\",\"1 ms\",energy grows,400,10,0,0.5,\"why, 0\",01-1 ms\n"
               "\"usl\",\"0\",\"0.25 ms\",stable,1,20,1,0.5,\"\",01-0.25 ms\n"
               "\"usl\",\"0\",\"0.5 ms\",stable,1.5,30,2,0.5,\"\",01-0.5 ms\n"
               "\"usl\",\"0.5\",\"0.25 ms\",rejected steps,2,40,3,0.5,\"why, 3\",02-0.25 ms\n"
               "\"usl\",\"0.5\",\"1 ms\",diverged,0,50,4,0.5,\"why, 4\",02-1 ms\n"
               "\"musl\",\"0\",\"0.25 ms\",stable,1,60,5,0.5,\"\",03-0.25 ms\n"
               "\"musl\",\"0\",\"1 ms\",stable,1.25,70,6,0.5,\"\",03-1 ms\n"
               "\"musl\",\"0.5\",\"0.25 ms\",stable,1,80,7,0.5,\"\",04-0.25 ms\n");
    check_file(f, "limits.csv",
               "stress,offset,outcome,stable (ms),unstable (ms),stable_over_reference,unstable_over_reference,runs\n"
               "\"usl\",\"0\",found,0.5,1,1,2,3\n"
               "\"usl\",\"0.5\",all_unstable,nan,1,nan,2,2\n"
               "\"musl\",\"0\",all_stable,1,nan,2,nan,2\n"
               "\"musl\",\"0.5\",no_verdict,0.25,nan,0.5,nan,1\n");
}

static size_t count(const char *text, const char *what)
{
    size_t n = 0;
    for (const char *at = strstr(text, what); at; at = strstr(at + 1, what)) n++;
    return n;
}

/* Each limit and each run with its combination, and nothing without a name. */
static void the_json_has_all(void **state)
{
    const fixture *f = *state;
    char text[2 * TEXT];
    check_ok(f->ctx, stability_write(&f->s));
    read_file(f, "stability.json", text);
    check_true(strstr(text, "\"\":") == NULL);
    assert_int_equal(count(text, "\"outcome\":"), SETS);
    assert_int_equal(count(text, "\"verdict\":"), PROBES - 1);
    assert_int_equal(count(text, "\"offset\": \"0.5\""), 2 + 3);
    assert_int_equal(count(text, "\"stress\": \"musl\""), 2 + 3);
    assert_int_equal(count(text, "\"time.step\": \"0.25 ms\""), SETS);
    assert_int_equal(count(text, "\"unit\": \"ms\""), 1);
    assert_int_equal(count(text, "\"schema\": 1,"), 1);
    assert_int_equal(count(text, "\"relative_to\": 0.5,"), 1);
}

static void a_search_is_printed(void **state)
{
    check_printed(
        *state,
        "      stress        offset     time.step  over 0.5    verdict             energy     steps  rejected  cause\n"
        "         usl             0          1 ms      2.0000  energy grows           400        10         0  why, 0\n"
        "         usl             0       0.25 ms      0.5000  stable                   1        20         1\n"
        "         usl             0        0.5 ms      1.0000  stable                 1.5        30         2\n"
        "         usl           0.5       0.25 ms      0.5000  rejected steps           2        40         3  why, 3\n"
        "         usl           0.5          1 ms      2.0000  diverged                 0        50         4  why, 4\n"
        "        musl             0       0.25 ms      0.5000  stable                   1        60         5\n"
        "        musl             0          1 ms      2.0000  stable                1.25        70         6\n"
        "        musl           0.5       0.25 ms      0.5000  stable                   1        80         7\n"
        "\n"
        "limits of time.step ms\n"
        "      stress        offset     stable at   unstable at       both   over 0.5  runs\n"
        "         usl             0           0.5             1     1.0000     2.0000     3\n"
        "         usl           0.5           nan             1        nan     2.0000     2  no limit: unstable at "
        "every value tried, the last of them 1 ms\n"
        "        musl             0             1           nan     2.0000        nan     2  no limit: stable at every "
        "value tried, the last of them 1 ms\n"
        "        musl           0.5          0.25           nan     0.5000        nan     1  no answer: a run gave no "
        "verdict\n");
}

/* A panel for each value of the first key, a line for each of the second, its points in the order of x and over the reference. */
static void a_search_is_drawn(void **state)
{
    fixture *f = *state;
    check_ok(f->ctx, stability_plot(&f->s));
    check_file(f, "energy.csv",
               "panel,series,x,y,label\n"
               "\"stress=usl\",\"0\",0.5,1,\n"
               "\"stress=usl\",\"0\",1,1.5,\n"
               "\"stress=usl\",\"0\",2,400,\n"
               "\"stress=usl\",\"0.5\",0.5,2,\n"
               "\"stress=musl\",\"0\",0.5,1,\n"
               "\"stress=musl\",\"0\",2,1.25,\n"
               "\"stress=musl\",\"0.5\",0.5,1,\n");
    char text[2 * TEXT];
    read_file(f, "energy.json", text);
    check_true(strstr(text, "\"log_x\": true") && strstr(text, "\"log_y\": true"));
    f->probe[0].x[0] = 0.0; /* no place on a logarithmic axis */
    check_ok(f->ctx, stability_plot(&f->s));
    read_file(f, "energy.json", text);
    check_true(!strstr(text, "\"log_x\": true") && strstr(text, "\"log_y\": true"));
    /* One key names the lines; one panel has no title. */
    f->probe[0].x[0] = 1.0;
    f->s.n_each = 1;
    f->s.n_sets = 2;
    f->set[1].value[0] = 1;
    check_ok(f->ctx, stability_plot(&f->s));
    check_file(f, "energy.csv",
               "panel,series,x,y,label\n"
               "\"\",\"usl\",0.5,1,\n"
               "\"\",\"usl\",1,1.5,\n"
               "\"\",\"usl\",2,400,\n"
               "\"\",\"musl\",0.5,2,\n");
}

/* A word stands at its place in the list, a number at itself; verdicts are the series. */
static void a_map_is_drawn(void **state)
{
    fixture *f = *state;
    f->s.n_over = 2;
    f->s.n_each = 1;
    f->s.n_sets = 2;
    f->set[1].value[0] = 1;
    f->s.relative_to = NAN;
    f->s.n_probes = 0;
    f->s.over[0] = (scene_axis){.key = "basis", .value = {"linear", "2 or so"}, .n_values = 2};
    f->s.over[1] = (scene_axis){.key = "step", .value = {"0.5", "6"}, .n_values = 2};
    put_probe(f, 0, NAN, "linear", VERDICT_STABLE, 1.0);
    put_probe(f, 0, NAN, "linear", VERDICT_REJECTED, 1.0);
    put_probe(f, 1, NAN, "2 or so", VERDICT_STABLE, 1.0);
    for (int k = 0; k < 3; k++) (void)snprintf(f->probe[k].value[1], SCENE_VALUE, "%s", k == 1 ? "6" : "0.5");
    check_ok(f->ctx, stability_plot(&f->s));
    check_file(f, "map.csv",
               "panel,series,x,y,label\n"
               "\"stress=usl\",\"stable\",0.5,1,\n"
               "\"stress=usl\",\"rejected steps\",6,1,\n"
               "\"stress=musl\",\"stable\",0.5,2,\n");
    check_printed(f,
                  "      stress         basis          step  verdict             energy     steps  rejected  cause\n"
                  "         usl        linear           0.5  stable                   1        10         0\n"
                  "         usl        linear             6  rejected steps           1        20         1  why, 1\n"
                  "        musl       2 or so           0.5  stable                   1        30         2\n"
                  "\n"
                  "stress=usl\n"
                  "       basis  step\n"
                  "                   0.5         6\n"
                  "      linear         .         r\n"
                  "     2 or so\n"
                  "stress=musl\n"
                  "       basis  step\n"
                  "                   0.5         6\n"
                  "      linear\n"
                  "     2 or so         .\n"
                  ". stable, r rejected steps, ^ energy grows, ! not finite, D diverged, ? no verdict\n");
    char text[2 * TEXT];
    read_file(f, "map.json", text);
    check_true(strstr(text, "\"log_x\": true") &&
               !strstr(text, "\"log_y\": true")); /* 6/0.5 > 10; words have no ratio */
    check_true(strstr(text, "basis: 1 linear, 2 2 or so") != NULL);
    (void)snprintf(f->s.over[1].value[1], SCENE_VALUE, "5"); /* a decade is no more than one */
    check_ok(f->ctx, stability_plot(&f->s));
    read_file(f, "map.json", text);
    check_true(!strstr(text, "\"log_x\": true"));
}

int main(void)
{

    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_search_is_written, set_up, tear_down),
        cmocka_unit_test_setup_teardown(the_json_has_all, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_search_is_printed, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_search_is_drawn, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_map_is_drawn, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
