/* A study of nine cases, three ways at three spacings, as it is after its runs. */
#ifndef TESTS_UNIT_STUDY_CASES_FIXTURE_H
#define TESTS_UNIT_STUDY_CASES_FIXTURE_H

#include "check.h"

#include "base/memory.h"
#include "io/file.h"
#include "study/study_internal.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Not every test uses all of it. */
#define FIXTURE __attribute__((unused)) static

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

FIXTURE void put_profile(const fixture *f, int k, const char *text)
{
    char path[4 * PATH];
    (void)snprintf(path, sizeof path, "%s/%s", f->dir, f->run[k].folder);
    assert_int_equal(mkdir(path, 0700), 0);
    (void)snprintf(path, sizeof path, "%s/%s/profile.csv", f->dir, f->run[k].folder);
    check_ok(f->ctx, file_replace_text(f->ctx, path, text));
}

/* Errors fall by halves and quarters, times double; of the second group the finest case has diverged, of the third all have. */
FIXTURE int set_up(void **state)
{
    static fixture f;
    static const char *const name[GROUPS] = {"mpm", "ice-mpm", "ice"};
    f = (fixture){.ctx = context_create(), .options = {.name = "study"}};
    (void)snprintf(f.dir, sizeof f.dir, "figure_XXXXXX");
    if (!f.ctx || !mkdtemp(f.dir)) return -1;
    f.options.batch.dir = f.dir;
    f.options.batch.deck = "bar.yaml";
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

FIXTURE int tear_down(void **state)
{
    fixture *f = *state;
    char command[PATH + 16];
    (void)snprintf(command, sizeof command, "rm -rf '%s'", f->dir);
    const int status = system(command);
    context_destroy(&f->ctx);
    return status;
}

#endif
