/* A study as JSON: study.json, compare.json. What depends on the machine stands in objects named `timing`, and in a
 * summary's wall_seconds, output_seconds, seconds_by_stage and peak_rss_bytes. */
#include "io/json.h"
#include "study/study_internal.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

/* The summary of each case, with its place in the study and what the study makes of it; of a case that never came to
 * a summary the rest alone. */
static json_t *runs_json(const study *s)
{
    table t;
    study_case_table(s, &t);
    json_t *rows = table_json(&t), *list = json_array();
    table_free(&t);
    for (size_t i = 0; i < json_array_size(rows); i++) {
        json_t *one = s->run[i].ran ? summary_json(&s->run[i].summary)
                                    : json_pack("{s:s}", "coupling", coupling_name(s->list[i].coupling));
        (void)json_object_update(one, json_array_get(rows, i));
        json_array_append_new(list, one);
    }
    if (json_array_size(list) != s->n) {
        json_decref(list);
        list = NULL;
    }
    json_decref(rows);
    return list;
}

static json_t *order_json(const study_order *o)
{
    return json_pack("{s:o, s:o, s:o, s:o, s:o}", "order", json_number(o->order), "stderr",
                     json_number(o->standard_error), "values", json_numbers(o->value, o->n), "h",
                     json_numbers(o->h, o->n), "pairs", json_numbers(o->pair, o->n > 0 ? o->n - 1 : 0));
}

static json_t *orders_json(const study *s)
{
    json_t *object = json_object();
    for (size_t g = 0; g < s->n_groups; g++) {
        json_t *one = json_object();
        for (int m = 0; m < s->n_metrics; m++) {
            const study_order order = study_order_of(s, g, s->metric[m]);
            json_put(one, s->metric[m], order_json(&order));
        }
        json_put(object, s->group[g], one);
    }
    return object;
}

static json_t *fit_json(const richardson_fit *f)
{
    if (f->n == 0) return json_null();
    return json_pack("{s:s, s:o, s:o, s:o, s:o, s:o}", "kind", richardson_name(f->kind), "order", json_number(f->order),
                     "stderr", json_number(f->order_error), "value", json_number(f->value), "value_stderr",
                     json_number(f->value_error), "uncertainty", json_number(f->uncertainty));
}

static json_t *limit_json(const study_limit *l)
{
    const double finest = l->values.value[l->values.n - 1];
    return json_pack("{s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "kind", richardson_name(l->limit.kind),
                     "order", json_number(l->limit.order), "value", json_number(l->limit.value), "gci",
                     json_number(l->limit.gci_fine), "gci_relative", json_number(l->limit.gci_fine / fabs(finest)),
                     "gci_medium", json_number(l->limit.gci_medium), "asymptotic_ratio",
                     json_number(l->limit.asymptotic_ratio), "fit", fit_json(&l->fit), "values",
                     json_numbers(l->values.value, l->values.n), "h", json_numbers(l->values.h, l->values.n));
}

static json_t *limits_json(const study *s)
{
    json_t *object = json_object();
    for (size_t g = 0; g < s->n_groups && s->plan.n_quantities > 0; g++) {
        json_t *one = json_object();
        for (int q = 0; q < s->plan.n_quantities; q++) {
            study_limit limit;
            const bool found = study_limit_of(s, g, q, &limit);
            json_put(one, s->plan.quantity[q], found ? limit_json(&limit) : json_null());
        }
        json_put(object, s->group[g], one);
    }
    return object;
}

/* {metric: [folder, ...]}: from which no other case is cheaper and better. */
static json_t *front_json(const study *s, study_cost cost)
{
    json_t *object = json_object();
    for (int m = 0; m < s->n_metrics; m++) {
        json_t *list = json_array();
        for (size_t i = 0; i < s->n; i++) {
            if (study_is_on_front(s, i, s->metric[m], cost)) json_array_append_new(list, json_string(s->run[i].folder));
        }
        json_put(object, s->metric[m], list);
    }
    return object;
}

static json_t *group_name(const study *s, size_t group)
{
    return group < s->n_groups ? json_plain_text(s->group[group]) : json_null();
}

static json_t *answers_json(const study *s)
{
    json_t *list = json_array();
    for (int m = 0; m < s->n_metrics; m++) {
        study_answer a[STUDY_MAX_TARGETS];
        const int n = study_answers(s, s->metric[m], a);
        for (int k = 0; k < n; k++) {
            char text[512];
            study_answer_text(s, &a[k], text, sizeof text);
            json_array_append_new(list, json_pack("{s:s, s:f, s:o, s:o, s:o, s:o, s:b, s:o}", "metric", a[k].metric,
                                                  "target", a[k].target, "best", group_name(s, a[k].best), "seconds",
                                                  json_number(a[k].seconds), "next", group_name(s, a[k].next),
                                                  "next_seconds", json_number(a[k].next_seconds), "told_apart",
                                                  a[k].next == s->n_groups || !study_answer_is_close(&a[k]), "text",
                                                  json_plain_text(text)));
        }
    }
    return list;
}

static json_t *axis_json(const scene_axis *axis)
{
    json_t *object = json_pack("{s:s, s:o}", "key", axis->key, "values", axis_values_json(axis->value, axis->n_values));
    if (axis->n_with == 0) return object;
    json_t *with = json_object();
    for (int i = 0; i < axis->n_with; i++)
        json_put(with, axis->with[i].key, axis_values_json(axis->with[i].value, axis->n_values));
    json_put(object, "with", with);
    return object;
}

static json_t *study_axes_json(const study *s)
{
    json_t *list = json_array();
    for (int k = 0; k < s->axes.n; k++) json_array_append_new(list, axis_json(&s->axes.axis[k]));
    return list;
}

static json_t *bars_json(const study *s)
{
    study_bar_result *result;
    size_t n;
    json_t *list = json_array();
    if (study_bars(s, &result, &n) != FLOE_OK) return list;
    for (size_t i = 0; i < n; i++) {
        const study_bar_result *r = &result[i];
        json_array_append_new(list,
                              json_pack("{s:s, s:s, s:o, s:o, s:o, s:b}", "metric", r->bar->metric, "of",
                                        r->of_order ? "order" : "error", "where", json_plain_text(r->where), "value",
                                        json_number(r->value), "required", json_number(r->limit), "met", r->met));
    }
    memory_free(s->ctx, &result);
    return list;
}

/* What each check was asked of, and the range of what was found there in cases that are right. */
static json_t *checks_json(const study *s)
{
    json_t *list = json_array();
    for (int k = 0; k < s->plan.n_checks; k++) {
        const scene_check *check = &s->plan.check[k];
        json_t *where = json_object();
        for (int i = 0; i < check->where.n; i++)
            json_object_set_new(where, check->where.key[i], json_plain_text(check->where.value[i]));
        json_array_append_new(list, json_pack("{s:s, s:o, s:b, s:o, s:o, s:o, s:o, s:o}", "of", check->of, "at",
                                              json_number(check->at), "change", check->change, "least",
                                              json_number(check->least), "most", json_number(check->most), "where",
                                              where, "smallest", json_number(s->found[k].least), "largest",
                                              json_number(s->found[k].most)));
    }
    return list;
}

static json_t *verdicts_json(const study *s)
{
    if (!study_has_verdicts(s)) return json_null();
    return json_pack("{s:I, s:I, s:I, s:I, s:o}", "right", (json_int_t)study_count(s, STUDY_RIGHT), "refused",
                     (json_int_t)study_count(s, STUDY_REFUSED), "wrong", (json_int_t)study_count(s, STUDY_WRONG),
                     "unnoticed", (json_int_t)study_count_unnoticed(s), "checks", checks_json(s));
}

floe_status study_write_json(const study *s)
{
    char path[BATCH_PATH];
    (void)snprintf(path, sizeof path, "%s/%s.json", s->options->batch.dir, s->options->name);
    json_t *over = s->over < 0 ? json_null() : axis_json(&s->axes.axis[s->over]);
    json_t *timing =
        json_pack("{s:i, s:s, s:b, s:o, s:o}", "repeat", s->plan.repeat, "seconds", "cpu_seconds", "disturbed",
                  study_is_disturbed(s), "pareto", front_json(s, STUDY_SECONDS), "answers", answers_json(s));
    return json_write(s->ctx, path,
                      json_pack("{s:i, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "schema", 1, "deck",
                                json_plain_text(s->options->batch.deck), "title", json_plain_text(s->title), "axis",
                                over, "axes", study_axes_json(s), "runs", runs_json(s), "orders", orders_json(s),
                                "limits", limits_json(s), "pareto", front_json(s, STUDY_UPDATES), "bars", bars_json(s),
                                "verdicts", verdicts_json(s), "timing", timing));
}
