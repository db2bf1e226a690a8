/* From a deck and its axes to the cases of a study. */
#include "study/study_internal.h"

#include "base/memory.h"
#include "run/memory_need.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

batch_options study_batch_options(const study *s)
{
    batch_options batch = s->options->batch;
    batch.max_wall = s->plan.max_wall;
    batch.keep_finished = !s->options->again;
    return batch;
}

const char *study_axis_name(const scene_axis *axis)
{
    return strcmp(axis->key, "domain.cell") == 0 ? "h" : axis->key;
}

const char *study_over_label(const study *s)
{
    if (s->over < 0 || strcmp(s->axes.axis[s->over].key, "domain.cell") == 0) return s->dimensionless ? "h" : "h (m)";
    return s->axes.axis[s->over].key;
}

/* ---- axes ---- */

static void add_couplings(study *s, const scene *base, strbuf *errors)
{
    scene_axis axis = {.key = "coupling"};
    for (int i = 0; i < base->n_runs_as; i++)
        (void)snprintf(axis.value[axis.n_values++], SCENE_VALUE, "%s", coupling_name(base->runs_as[i]));
    (void)axis_put(&s->axes, &axis, errors);
}

/* Whether the command line has an axis of that key. */
static bool is_of_command_line(const study *s, const char *key)
{
    scene_axis axis;
    strbuf ignored;
    bool found = false;
    strbuf_init(&ignored, s->ctx);
    for (size_t i = 0; i < s->options->n_axis; i++)
        found = found || (axis_parse(s->options->axis[i], &axis, &ignored) && strcmp(axis.key, key) == 0);
    strbuf_free(&ignored);
    return found;
}

static bool is_set(const study *s, const char *key)
{
    const size_t length = strlen(key);
    const deck_overrides *set = &s->options->set;
    for (size_t i = 0; i < set->n; i++)
        if (strncmp(set->text[i], key, length) == 0 && set->text[i][length] == '=') return true;
    return false;
}

/* Keys that go along with one that is set too have the values that are set. */
static void drop_set_along(study *s)
{
    for (int k = 0; k < s->axes.n; k++) {
        scene_axis *axis = &s->axes.axis[k];
        int kept = 0;
        for (int i = 0; i < axis->n_with; i++) {
            if (is_set(s, axis->key) && is_set(s, axis->with[i].key)) continue;
            if (kept != i) axis->with[kept] = axis->with[i];
            kept++;
        }
        axis->n_with = kept;
    }
}

/* "KEY=VALUE" of --set: in place of all values that the deck's axis of that key has. */
static void take_setting(study *s, const char *text, strbuf *errors)
{
    const char *value = strchr(text, '=');
    const size_t length = value ? (size_t)(value - text) : 0;
    for (int k = 0; value && k < s->axes.n; k++) {
        const scene_axis *axis = &s->axes.axis[k];
        const bool own = strncmp(axis->key, text, length) == 0 && axis->key[length] == '\0';
        const size_t above = strlen(axis->key);
        scene_axis one = {.n_values = 1};
        if (own && strlen(value + 1) < SCENE_VALUE) {
            memcpy(one.key, axis->key, sizeof one.key);
            (void)snprintf(one.value[0], SCENE_VALUE, "%s", value + 1);
            if (!is_of_command_line(s, axis->key))
                (void)axis_put(&s->axes, &one, errors);
            else if (axis->n_values != 1 || !axis_same_value(axis->value[0], one.value[0]))
                strbuf_append(errors, "--set %s: '--axis' varies '%s': leave one of them out\n", text, axis->key);
            return;
        }
        bool along = strncmp(axis->key, text, above) == 0 && text[above] == '.';
        for (int i = 0; i < axis->n_with; i++)
            along = along || (strncmp(axis->with[i].key, text, length) == 0 && axis->with[i].key[length] == '\0');
        if (own || along)
            strbuf_append(errors, "--set %s: the axis '%s' sets that key, too: give '--axis %s=...' instead\n", text,
                          axis->key, axis->key);
    }
}

static void list_axes(study *s, const scene *base, strbuf *errors)
{
    const study_options *o = s->options;
    scene_axis axis;
    if (o->compare) {
        add_couplings(s, base, errors);
        if (o->n_axis == 0 && base->batches->compare.n_values > 0)
            (void)axis_put(&s->axes, &base->batches->compare, errors);
    } else {
        for (int i = 0; i < base->batches->study.n_axes; i++)
            (void)axis_put(&s->axes, &base->batches->study.axis[i], errors);
    }
    for (size_t i = 0; i < o->n_axis; i++) {
        if (axis_parse(o->axis[i], &axis, errors)) (void)axis_put(&s->axes, &axis, errors);
    }
    drop_set_along(s);
    for (size_t i = 0; i < o->set.n; i++) take_setting(s, o->set.text[i], errors);
    axis_check_keys(&s->axes, errors);
    if (s->axes.n == 0)
        strbuf_append(errors,
                      "nothing to vary: give an axis, --axis domain.cell=0.1,0.05, or `study: {axes: {domain.cell: "
                      "[0.1, 0.05]}}` in the deck\n");
}

static void name_all_axes(const study *s, strbuf *errors)
{
    for (int i = 0; i < s->axes.n; i++) strbuf_append(errors, "%s%s", i ? ", " : "", s->axes.axis[i].key);
}

/* The axis that orders are taken over. */
static void choose_over(study *s, strbuf *errors)
{
    const char *wanted = s->options->over ? s->options->over : s->plan.over;
    s->over = axis_find(&s->axes, wanted[0] ? wanted : "domain.cell");
    if (wanted[0]) {
        if (s->over < 0) {
            strbuf_append(errors, "orders over '%s': that is no axis of this study, which has: ", wanted);
            name_all_axes(s, errors);
            strbuf_append(errors, "\n");
        } else if (!axis_is_numeric(&s->axes.axis[s->over]) && strcmp(wanted, "domain.cell") != 0) {
            strbuf_append(errors, "orders over '%s': its values are not different numbers > 0 in one unit\n", wanted);
        }
        return;
    }
    for (int i = 0; i < s->axes.n && s->over < 0; i++) {
        if (axis_is_numeric(&s->axes.axis[i])) s->over = i;
    }
}

/* Has the deck's own study such a value, which the command line has left out? */
static bool is_axis_left_out(const study *s, const char *key, const char *value)
{
    for (int k = 0; k < s->plan.n_axes; k++) {
        const scene_axis *axis = &s->plan.axis[k];
        for (int i = 0; strcmp(axis->key, key) == 0 && i < axis->n_values; i++) {
            if (axis_same_value(axis->value[i], value)) return true;
        }
    }
    return false;
}

/* Conditions name axes and values of this study; `what` is whose condition it is. Those of what the command line has left out are
 * passed over. */
static void check_where(const study *s, const scene_where *where, const char *what, const char *name, strbuf *errors)
{
    for (int k = 0; k < where->n; k++) {
        const int at = axis_find(&s->axes, where->key[k]);
        bool known = false;
        for (int i = 0; at >= 0 && i < s->axes.axis[at].n_values; i++)
            known = known || axis_same_value(s->axes.axis[at].value[i], where->value[k]);
        if (known || is_axis_left_out(s, where->key[k], where->value[k])) continue;
        strbuf_append(errors, "%s '%.80s': '%s: %s' is no %s of this study, which has: ", what, name, where->key[k],
                      where->value[k], at < 0 ? "axis" : "value of that axis");
        if (at < 0) name_all_axes(s, errors);
        for (int i = 0; at >= 0 && i < s->axes.axis[at].n_values; i++)
            strbuf_append(errors, "%s%s", i ? ", " : "", s->axes.axis[at].value[i]);
        strbuf_append(errors, "\n");
    }
}

static void check_bars(const study *s, strbuf *errors)
{
    const scene_study *p = &s->plan;
    for (int b = 0; b < p->n_bars; b++) check_where(s, &p->bar[b].where, "bar for", p->bar[b].metric, errors);
    for (int b = 0; b < p->n_checks; b++) check_where(s, &p->check[b].where, "check of", p->check[b].of, errors);
    for (int b = 0; b < p->n_refusals; b++) check_where(s, &p->refusal[b].where, "refusal", p->refusal[b].why, errors);
    for (int b = 0; b < p->n_unchanged; b++)
        check_where(s, &p->unchanged[b].where, "reason", p->unchanged[b].why, errors);
    study_check_unchanged(s, errors);
}

/* ---- cases ---- */

/* Settings of a case: the user's, then the axes'. The deck's own study is of no use to a single run. */
static floe_status set_case(const study *s, const scene *base, study_case *one)
{
    size_t own = 0;
    for (int k = 0; k < s->axes.n; k++) own += (size_t)scene_axis_settings(&s->axes.axis[k]);
    TRY(case_settings_make(&one->settings, s->ctx, &s->options->set, own + 2));
    if (base->batches->study.given) case_settings_add(&one->settings, "study=null");
    if (base->batches->compare.n_values > 0) case_settings_add(&one->settings, "compare=null");
    for (int k = 0; k < s->axes.n; k++) case_settings_pick(&one->settings, &s->axes.axis[k], one->pick[k]);
    one->run->set = one->settings.set;
    one->run->n_set = one->settings.n;
    return FLOE_OK;
}

/* A value as a part of a name: that of a number says of what. */
static void append_value(const study *s, const study_case *one, int k, bool short_key, char *text, size_t size)
{
    const scene_axis *axis = &s->axes.axis[k];
    const char *value = axis->value[one->pick[k]], *unit, *dot = strrchr(axis->key, '.');
    const size_t at = strlen(text);
    double x;
    if (axis_number(value, &x, &unit) && !short_key) {
        (void)snprintf(text + at, size - at, "%s%s=%s", at ? ", " : "", axis->key, value);
    } else if (axis_number(value, &x, &unit)) {
        (void)snprintf(text + at, size - at, "%s%s=%s", at ? ", " : "", dot ? dot + 1 : axis->key, value);
    } else {
        (void)snprintf(text + at, size - at, "%s%s", at ? ", " : "", value);
    }
}

/* A folder's name: the values, and '_' for what a file system may not like. */
static void name_folder(const study *s, const study_case *one, char *folder, size_t size)
{
    size_t at = 0;
    for (int k = 0; k < s->axes.n; k++) {
        const char *value = s->axes.axis[k].value[one->pick[k]];
        if (k > 0 && at + 1 < size) folder[at++] = '-';
        for (; *value && at + 1 < size && at < 180; value++) {
            const bool plain = isalnum((unsigned char)*value) || strchr("._-+", *value);
            if (plain || (at > 0 && folder[at - 1] != '_' && value[1] != '\0')) folder[at++] = plain ? *value : '_';
        }
    }
    folder[at] = '\0';
    if (folder[0] == '.') folder[0] = '_';
}

/* Names that have become the same are numbered. */
static void make_unique(const study *s, size_t i)
{
    char *folder = s->run[i].folder;
    const size_t length = strlen(folder);
    for (size_t k = 0, n = 2; k < i; k++) {
        if (strcmp(s->run[k].folder, folder) != 0) continue;
        (void)snprintf(folder + length, sizeof s->run[i].folder - length, "_%zu", n++);
        k = (size_t)-1; /* from the first one again */
    }
}

/* Groups are numbered as they come: a case belongs to the first one that differs from it in `over` alone. */
static void join_group(study *s, size_t i)
{
    study_case *one = &s->list[i];
    for (size_t j = 0; j < i; j++) {
        bool same = s->over >= 0;
        for (int k = 0; k < s->axes.n && same; k++) same = k == s->over || s->list[j].pick[k] == one->pick[k];
        if (!same) continue;
        one->group = s->list[j].group;
        return;
    }
    one->group = s->n_groups++;
}

static void name_group(study *s, const study_case *one)
{
    char *name = s->group[one->group];
    if (name[0]) return;
    for (int k = 0; k < s->axes.n; k++) {
        if (k != s->over) append_value(s, one, k, true, name, STUDY_LABEL);
    }
    if (!name[0]) (void)snprintf(name, STUDY_LABEL, "%s", coupling_name(one->coupling));
}

static floe_status make_cases(study *s, const scene *base)
{
    s->n = crossed_count(s->axes.axis, s->axes.n);
    TRY(memory_new(s->ctx, &s->list, s->n, sizeof *s->list));
    TRY(memory_new(s->ctx, &s->run, s->n, sizeof *s->run));
    TRY(memory_new(s->ctx, &s->group, s->n, sizeof *s->group));
    for (size_t i = 0; i < s->n; i++) {
        study_case *one = &s->list[i];
        one->run = &s->run[i];
        crossed_pick(s->axes.axis, s->axes.n, i, one->pick);
        TRY(set_case(s, base, one));
        name_folder(s, one, one->run->folder, sizeof one->run->folder);
        make_unique(s, i);
        for (int k = 0; k < s->axes.n; k++) append_value(s, one, k, false, one->run->label, sizeof one->run->label);
        join_group(s, i);
    }
    return FLOE_OK;
}

static void read_case_scene(study *s, study_case *one, const scene *of)
{
    const char *unit;
    one->coupling = of->coupling;
    one->h = one->over = of->mesh.cell[0];
    one->cells = memory_cells(&of->mesh);
    one->run->weight = pow(one->cells, 1.0 + 1.0 / of->mesh.dim); /* times steps, up to a factor */
    if (s->over < 0 || strcmp(s->axes.axis[s->over].key, "domain.cell") == 0) return;
    if (!axis_number(s->axes.axis[s->over].value[one->pick[s->over]], &one->over, &unit)) one->over = NAN;
}

/* Every case must make a scene before the first one runs. One bad value spoils many cases: what is said of it is said once. */
static floe_status check_cases(study *s, strbuf *errors)
{
    const batch_options batch = study_batch_options(s);
    for (size_t i = 0; i < s->n; i++) {
        scene *of;
        const floe_status status = batch_prepare(s->ctx, &batch, &s->run[i], &of);
        if (status == FLOE_OK) {
            read_case_scene(s, &s->list[i], of);
            scene_destroy(&of);
        } else if (status == FLOE_BAD_INPUT) {
            if (!strstr(strbuf_string(errors), context_message(s->ctx)))
                strbuf_append(errors, "case %s:\n%s", s->run[i].label, context_message(s->ctx));
            context_clear(s->ctx);
        } else {
            return status;
        }
    }
    return errors->status;
}

static floe_status fail_with(context *ctx, const strbuf *errors)
{
    TRY(errors->status);
    if (errors->length == 0) return FLOE_OK;
    return fail(ctx, FLOE_BAD_INPUT, "%.*s", (int)errors->length - 1, strbuf_string(errors));
}

/* A comparison has no bars, but what the deck's study says may be refused may be here, as far as its axes can tell. */
static void take_refusals(study *s, const scene *base)
{
    for (int k = 0; k < base->batches->study.n_refusals; k++) {
        const scene_where *where = &base->batches->study.refusal[k].where;
        bool known = true;
        for (int i = 0; i < where->n; i++) known = known && axis_find(&s->axes, where->key[i]) >= 0;
        if (known) s->plan.refusal[s->plan.n_refusals++] = base->batches->study.refusal[k];
    }
}

static floe_status plan_cases(study *s, const scene *base, strbuf *errors)
{
    const study_options *o = s->options;
    (void)snprintf(s->title, sizeof s->title, "%s", base->title);
    s->dimensionless = base->dimensionless;
    (void)snprintf(s->exact, sizeof s->exact, "%s", base->verify.exact);
    if (!o->compare) s->plan = base->batches->study;
    /* What is compared is error against time: a comparison's runs are alone anyhow, unless it is told otherwise. */
    if (o->compare && o->batch.jobs <= 1 && o->batch.threads <= 1) s->plan.repeat = 1;
    if (o->repeat >= 0) s->plan.repeat = o->repeat;
    if (o->batch.max_wall > 0.0) s->plan.max_wall = o->batch.max_wall;
    list_axes(s, base, errors);
    choose_over(s, errors);
    check_bars(s, errors);
    if (o->compare) take_refusals(s, base);
    TRY(fail_with(s->ctx, errors));
    TRY(make_cases(s, base));
    TRY(check_cases(s, errors));
    TRY(fail_with(s->ctx, errors));
    TRY(study_check_columns(s, errors));
    TRY(fail_with(s->ctx, errors));
    for (size_t i = 0; i < s->n; i++) name_group(s, &s->list[i]);
    return FLOE_OK;
}

floe_status study_make_plan(study *s)
{
    const batch_options batch = study_batch_options(s);
    scene *base;
    strbuf errors;
    TRY(judge_base_scene(s->ctx, &batch, &s->options->set, &base));
    strbuf_init(&errors, s->ctx);
    const floe_status status = plan_cases(s, base, &errors);
    strbuf_free(&errors);
    scene_destroy(&base);
    return status;
}
