/* Figures of a study, exactly: what their curves and their front are, and which case's profile a group shows. */
#include "check.h"

#include "base/memory.h"
#include "io/file.h"
#include "study/study_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { GROUPS = 3, SPACINGS = 3, CASES = GROUPS * SPACINGS, PATH = 512, TEXT = 8192 };

typedef struct fixture {
    context *ctx;
    study s;
    study_options options;
    study_case list[CASES];
    batch_case run[CASES];
    char group[GROUPS][STUDY_LABEL];
    char dir[PATH];
} fixture;

static void put_profile(const fixture *f, int k, const char *text)
{
    char path[4 * PATH];
    (void)snprintf(path, sizeof path, "%s/%s", f->dir, f->run[k].folder);
    assert_int_equal(mkdir(path, 0700), 0);
    (void)snprintf(path, sizeof path, "%s/%s/profile.csv", f->dir, f->run[k].folder);
    check_ok(f->ctx, file_replace_text(f->ctx, path, text));
}

/* Errors fall by halves and quarters, times double; of the second group the finest case has diverged, of the third all have. */
static int set_up(void **state)
{
    static fixture f;
    static const char *const name[GROUPS] = {"mpm", "ice-mpm", "ice"};
    f = (fixture){.ctx = context_create(), .options = {.name = "study"}};
    (void)snprintf(f.dir, sizeof f.dir, "figure_XXXXXX");
    if (!f.ctx || !mkdtemp(f.dir)) return -1;
    f.options.batch.dir = f.dir;
    f.s = (study){.ctx = f.ctx,
                  .options = &f.options,
                  .list = f.list,
                  .run = f.run,
                  .n = CASES,
                  .n_groups = GROUPS,
                  .group = f.group,
                  .over = 1,
                  .title = "bar",
                  .exact = "lame",
                  .metric = {"l2rel_density"},
                  .n_metrics = 1};
    f.s.axes.n = 2;
    f.s.axes.axis[0] = (scene_axis){.key = "coupling", .value = {"mpm", "ice-mpm", "ice"}, .n_values = GROUPS};
    f.s.axes.axis[1] = (scene_axis){.key = "domain.cell", .value = {"0.4", "0.2", "0.1"}, .n_values = SPACINGS};
    f.s.plan.n_quantities = 1;
    (void)snprintf(f.s.plan.quantity[0], sizeof f.s.plan.quantity[0], "kinetic");
    for (int k = 0; k < CASES; k++) {
        const int g = k / SPACINGS, i = k % SPACINGS;
        study_case *one = &f.list[k];
        run_summary *r = &f.run[k].summary;
        const double h = 0.4 / (1 << i), error = (g == 0 ? 0.16 : 0.32) / (1 << (g + 1) * i);
        *one = (study_case){.pick = {g, i}, .group = (size_t)g, .h = h, .over = h, .run = &f.run[k]};
        one->timing.least = (g + 1) * (1 << i);
        one->quantity[0] = g == 0 ? 3.0 + h : (double)NAN;
        f.run[k].state = BATCH_ENDED;
        f.run[k].ran = true;
        f.run[k].status = g == 2 || k == 5 ? FLOE_DIVERGED : FLOE_OK;
        r->point_updates = 1000.0 * one->timing.least;
        r->n_errors = 1;
        r->errors[0] = (summary_value){"l2rel_density", error};
        (void)snprintf(f.run[k].folder, sizeof f.run[k].folder, "case-%d", k);
        (void)snprintf(f.group[g], STUDY_LABEL, "%s", name[g]);
    }
    *state = &f;
    return 0;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    char command[PATH + 16];
    (void)snprintf(command, sizeof command, "rm -rf '%s'", f->dir);
    const int status = system(command);
    context_destroy(&f->ctx);
    return status;
}

static void check_file(const fixture *f, const char *name, const char *wanted)
{
    char path[2 * PATH], *text;
    (void)snprintf(path, sizeof path, "%s/%s", f->dir, name);
    check_ok(f->ctx, file_read(f->ctx, path, &text, NULL));
    assert_string_equal(text, wanted);
    memory_free(f->ctx, &text);
}

/* From coarse to fine; errors of ratios in per cent; what did not come to its end is on no curve and no front. */
static void curves_go_from_coarse_to_fine(void **state)
{
    const fixture *f = *state;
    check_ok(f->ctx, study_write_figures(&f->s));
    check_file(f, "errors.csv",
               "panel,series,x,y,label\n"
               "\"\",\"mpm\",0.40000000000000002,16,\n"
               "\"\",\"mpm\",0.20000000000000001,8,\n"
               "\"\",\"mpm\",0.10000000000000001,4,\n"
               "\"\",\"ice-mpm\",0.40000000000000002,32,\n"
               "\"\",\"ice-mpm\",0.20000000000000001,8,\n"
               "\"\",\"mpm\",1000,16,\n"
               "\"\",\"mpm\",2000,8,\n"
               "\"\",\"mpm\",4000,4,\n"
               "\"\",\"ice-mpm\",2000,32,\n"
               "\"\",\"ice-mpm\",4000,8,\n"
               "\"\",\"Pareto front\",1000,16,\n"
               "\"\",\"Pareto front\",2000,8,\n"
               "\"\",\"Pareto front\",4000,4,\n"
               "\"\",\"mpm\",1,16,\n"
               "\"\",\"mpm\",2,8,\n"
               "\"\",\"mpm\",4,4,\n"
               "\"\",\"ice-mpm\",2,32,\n"
               "\"\",\"ice-mpm\",4,8,\n"
               "\"\",\"Pareto front\",1,16,\n"
               "\"\",\"Pareto front\",2,8,\n"
               "\"\",\"Pareto front\",4,4,\n");
    check_file(f, "quantities.csv",
               "panel,series,x,y,label\n"
               "\"\",\"mpm\",0.40000000000000002,3.3999999999999999,\n"
               "\"\",\"mpm\",0.20000000000000001,3.2000000000000002,\n"
               "\"\",\"mpm\",0.10000000000000001,3.1000000000000001,\n");
}

/* Of each group the finest case that has come to its end, with the columns that it has; the exact curve at the
 * positions of the one with most rows. */
static void profiles_are_of_the_finest_cases(void **state)
{
    const fixture *f = *state;
    put_profile(f, 1, "r (m),sigma (Pa),exact_sigma (Pa)\n9,9,9\n9,9,9\n9,9,9\n");
    put_profile(f, 2, "r (m),sigma (Pa),exact_sigma (Pa),u (m/s),exact_u (m/s)\n1,4e6,4.5e6,7,8\n2,2e6,2.25e6,,1\n");
    put_profile(f, 4, "r (m),u (m/s),exact_u (m/s)\n1.5,0.5,0.75\n");
    put_profile(f, 5, "r (m),u (m/s),exact_u (m/s)\n8,8,8\n8,8,8\n8,8,8\n");
    put_profile(f, 8, "r (m),u (m/s),exact_u (m/s)\n8,8,8\n8,8,8\n8,8,8\n");
    check_ok(f->ctx, study_write_figures(&f->s));
    check_file(f, "profile.csv",
               "panel,series,x,y,label\n"
               "\"\",\"lame\",1,4.5,\n"
               "\"\",\"lame\",2,2.25,\n"
               "\"\",\"mpm\",1,4,\n"
               "\"\",\"mpm\",2,2,\n"
               "\"\",\"lame\",1,8,\n"
               "\"\",\"lame\",2,1,\n"
               "\"\",\"mpm\",1,7,\n"
               "\"\",\"mpm\",2,nan,\n"
               "\"\",\"ice-mpm\",1.5,0.5,\n");
}

/* All rows of the profiles that are shown, each with its group and spacing; the names once. */
static void profiles_are_one_table(void **state)
{
    const fixture *f = *state;
    put_profile(f, 2, "r (m),u (m/s),exact_u (m/s)\n1,2,3\n4,,6\n");
    put_profile(f, 4, "r (m),u (m/s),exact_u (m/s)\n7,8,9\n");
    check_ok(f->ctx, study_write_figures(&f->s));
    check_file(f, "profiles.csv",
               "group,h (m),r (m),u (m/s),exact_u (m/s)\n\"mpm\",0.1,1,2,3\n\"mpm\",0.1,4,,6\n\"ice-mpm\",0.2,7,8,9\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(curves_go_from_coarse_to_fine, set_up, tear_down),
        cmocka_unit_test_setup_teardown(profiles_are_of_the_finest_cases, set_up, tear_down),
        cmocka_unit_test_setup_teardown(profiles_are_one_table, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
