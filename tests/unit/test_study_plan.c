/* Names of cases, folders and groups of a study, exactly, and what a condition may name; nothing is run. */
#include "check.h"

#include "base/memory.h"
#include "study/study_internal.h"

#include <string.h>

enum { LONG = 88 };

static study *plan_of(context *ctx, study_options *o, const char *const *axis, size_t n_axis, const char *const *set,
                      size_t n_set, floe_status *status)
{
    study *s;
    check_ok(ctx, memory_new(ctx, &s, 1, sizeof *s));
    *o = (study_options){.name = "study",
                         .batch = {.deck = FLOE_SOURCE_DIR "/inputs/sod.yaml", .dir = "unused"},
                         .set = {set, n_set},
                         .axis = axis,
                         .n_axis = n_axis,
                         .repeat = -1};
    s->ctx = ctx;
    s->options = o;
    *status = study_make_plan(s);
    return s;
}

/* Plans the study of these axes alone, and compares the cases' names, the first axis slowest. */
static void check_names(const char *const *axis, size_t n_axis, const char *const (*name)[2], size_t n)
{
    context *ctx = context_create();
    study_options o;
    floe_status status;
    const char *const none[] = {"study=null"};
    study *s = plan_of(ctx, &o, axis, n_axis, none, 1, &status);
    check_ok(ctx, status);
    assert_int_equal(s->n, n);
    for (size_t i = 0; i < n; i++) {
        assert_string_equal(s->run[i].label, name[i][0]);
        assert_string_equal(s->run[i].folder, name[i][1]);
    }
    study_destroy(&s);
    context_destroy(&ctx);
}

/* Numbers say of what, words do not; the folder has '_' once for each run of what file systems may not like, not at its start or end. */
static void cases_are_named_by_their_values(void **state)
{
    (void)state;
    const char *const axis[] = {"title='(x) (y)','.z'", "domain.cell=0.2,1e-1", "coupling=ice,mpm"};
    const char *const name[][2] = {
        {"'(x) (y)', domain.cell=0.2, ice", "x_y_-0.2-ice"},   {"'(x) (y)', domain.cell=0.2, mpm", "x_y_-0.2-mpm"},
        {"'(x) (y)', domain.cell=1e-1, ice", "x_y_-1e-1-ice"}, {"'(x) (y)', domain.cell=1e-1, mpm", "x_y_-1e-1-mpm"},
        {"'.z', domain.cell=0.2, ice", "_z-0.2-ice"},          {"'.z', domain.cell=0.2, mpm", "_z-0.2-mpm"},
        {"'.z', domain.cell=1e-1, ice", "_z-1e-1-ice"},        {"'.z', domain.cell=1e-1, mpm", "_z-1e-1-mpm"},
    };
    check_names(axis, 3, name, 8);
}

/* Folders that would be the same are numbered from 2 on, past names that are taken already. */
static void folders_differ(void **state)
{
    (void)state;
    const char *const axis[] = {"title=a_b_2,a b,a_b,a:b,c d,c_d"};
    const char *const name[][2] = {{"a_b_2", "a_b_2"}, {"a b", "a_b"}, {"a_b", "a_b_3"},
                                   {"a:b", "a_b_4"},   {"c d", "c_d"}, {"c_d", "c_d_2"}};
    check_names(axis, 1, name, 6);
}

/* A label that is full ends where it ends, and leaves the folder beside it alone. */
static void long_labels_are_cut(void **state)
{
    (void)state;
    char title[2 * LONG], cell[2 * LONG], whole[4 * LONG], folder[4 * LONG];
    (void)snprintf(title, sizeof title, "title=%0*d_,x", LONG, 1);
    (void)snprintf(cell, sizeof cell, "domain.cell=0.1%0*d,0.2", LONG - 3, 0);
    (void)snprintf(whole, sizeof whole, "%0*d_, domain.cell=0.1%0*d, ice", LONG, 1, LONG - 3, 0);
    (void)snprintf(folder, sizeof folder, "%0*d_-0.1%0*d-ice", LONG, 1, LONG - 3, 0);
    const char *const axis[] = {title, cell, "coupling=ice,mpm"}, *const none[] = {"study=null"};
    context *ctx = context_create();
    study_options o;
    floe_status status;
    study *s = plan_of(ctx, &o, axis, 3, none, 1, &status);
    check_ok(ctx, status);
    assert_int_equal(strlen(s->run[0].label), sizeof s->run[0].label - 1);
    check_true(strncmp(s->run[0].label, whole, sizeof s->run[0].label - 1) == 0);
    check_true(strncmp(s->run[0].folder, folder, 180) == 0);
    for (size_t i = 0; i < s->n; i++) {
        check_true(memchr(s->run[i].label, '\0', sizeof s->run[i].label) != NULL);
        for (size_t k = 0; k < i; k++) check_true(strcmp(s->run[i].folder, s->run[k].folder) != 0);
    }
    study_destroy(&s);
    context_destroy(&ctx);
}

/* Cases that differ along the axis of orders alone are a group, named by the last part of its keys. */
static void groups_are_named(void **state)
{
    (void)state;
    const char *const axis[] = {"coupling=ice,mpm", "domain.cell=0.2,0.1", "time.cfl=0.5,0.25"};
    const char *const none[] = {"study=null"};
    const char *const name[] = {"ice, cfl=0.5", "ice, cfl=0.25", "mpm, cfl=0.5", "mpm, cfl=0.25"};
    context *ctx = context_create();
    study_options o;
    floe_status status;
    study *s = plan_of(ctx, &o, axis, 3, none, 1, &status);
    check_ok(ctx, status);
    assert_int_equal(s->n_groups, 4);
    for (size_t g = 0; g < 4; g++) assert_string_equal(s->group[g], name[g]);
    for (size_t i = 0; i < s->n; i++) {
        assert_int_equal(s->list[i].group, 2 * (i / 4) + i % 2);
        check_close(s->list[i].h, i / 2 % 2 ? 0.1 : 0.2, 0.0);
        check_close(s->list[i].cells, i / 2 % 2 ? 10.0 : 5.0, 1e-12);
    }
    study_destroy(&s);
    context_destroy(&ctx);
}

/* A condition names a value of this study, or of the deck's own study; nothing at all is neither, and a full list ends at its end. */
static void conditions_name_values(void **state)
{
    (void)state;
    static const struct {
        const char *cell;
        bool good;
    } trial[] = {{"0.2", true}, {"2e-1", true}, {"0.05", true}, {"0.3", false}, {"''", false}, {"31", true}};
    char all[512] = "study.axes.domain.cell=[0.05";
    for (int i = 1; i < SCENE_MAX_AXIS; i++) (void)snprintf(all + strlen(all), sizeof all - strlen(all), ", %d", i);
    (void)snprintf(all + strlen(all), sizeof all - strlen(all), "]");
    for (size_t k = 0; k < sizeof trial / sizeof *trial; k++) {
        char bar[128];
        const char *own = trial[k].good ? all : "study.axes.domain.cell=[0.05]";
        (void)snprintf(bar, sizeof bar, "study.require=[{metric: l1_density, error: 1, where: {domain.cell: %s}}]",
                       trial[k].cell);
        const char *const axis[] = {"domain.cell=0.2,0.1"}, *const set[] = {own, bar};
        context *ctx = context_create();
        study_options o;
        floe_status status;
        study *s = plan_of(ctx, &o, axis, 1, set, 2, &status);
        if (trial[k].good)
            check_ok(ctx, status);
        else
            assert_non_null(
                strstr(context_message(ctx), "is no value of that axis of this study, which has: 0.2, 0.1"));
        if (!trial[k].good) check_fails(ctx, status, FLOE_BAD_INPUT);
        study_destroy(&s);
        context_destroy(&ctx);
    }
}

/* The plan of one axis, with a setting beside it and orders over some key: what it is refused for, or NULL. */
static void check_refused(const char *axis, const char *set, const char *over, const char *why)
{
    const char *const axes[] = {axis, "coupling=ice,mpm"}, *const sets[] = {"study=null", set};
    context *ctx = context_create();
    study_options o = {.name = "study",
                       .batch = {.deck = FLOE_SOURCE_DIR "/inputs/sod.yaml", .dir = "unused"},
                       .set = {sets, set ? 2 : 1},
                       .axis = axes,
                       .n_axis = 2,
                       .over = over,
                       .repeat = -1};
    study *s;
    check_ok(ctx, memory_new(ctx, &s, 1, sizeof *s));
    s->ctx = ctx;
    s->options = &o;
    const floe_status status = study_make_plan(s);
    if (why) {
        if (!strstr(context_message(ctx), why)) print_error("%s\n", context_message(ctx));
        assert_non_null(strstr(context_message(ctx), why));
        check_fails(ctx, status, FLOE_BAD_INPUT);
    } else {
        check_ok(ctx, status);
        assert_int_equal(s->over, 0);
        assert_int_equal(s->n, 4);
    }
    study_destroy(&s);
    context_destroy(&ctx);
}

/* A setting of a key that an axis sets is refused, of one whose name only begins like it not; orders are over numbers, or over the mesh. */
static void settings_and_orders(void **state)
{
    (void)state;
    const char *const along = "domain.cell=0.2,0.1;time.cfl=0.5,0.4", *const cells = "domain.cell=0.2,0.1";
    check_refused(along, NULL, NULL, NULL);
    check_refused(along, "time.cfl=0.3", NULL, "the axis 'domain.cell' sets that key, too");
    check_refused("domain.cell=0.2,0.1;time.max_steps=10,20", "time.max_step=0.3", NULL, NULL);
    check_refused(along, "time.end=0.1", NULL, NULL);
    check_refused(along, "domain.cell=0.05", NULL, "varies 'domain.cell'");
    check_refused(cells, "time.cfl=0.3", "domain.cell", NULL);
    check_refused(cells, NULL, "coupling", "its values are not different numbers > 0 in one unit");
    check_refused(cells, NULL, "time.cfl", "no axis of this study, which has: domain.cell, coupling");
    check_refused("domain.cell=[0.2],[0.1]", NULL, "domain.cell", NULL);
    check_refused("time.cfl=0.4,-0.3", NULL, "time.cfl", "its values are not different numbers > 0 in one unit");
    check_refused("time.cfl=0.4,0.3", NULL, NULL, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(settings_and_orders), cmocka_unit_test(cases_are_named_by_their_values),
        cmocka_unit_test(folders_differ),      cmocka_unit_test(long_labels_are_cut),
        cmocka_unit_test(groups_are_named),    cmocka_unit_test(conditions_name_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
