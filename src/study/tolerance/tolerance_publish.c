/* The folder of a run to a tolerance: outputs of the chosen case, and a summary that says how it was chosen. */
#include "study/tolerance/tolerance_parts.h"

#include "io/file.h"
#include "io/file_copy.h"
#include "io/json.h"

#include <math.h>
#include <string.h>

static json_t *variants_json(const tolerance *t)
{
    json_t *list = json_array();
    for (size_t i = 0; i < t->study->n_groups; i++) {
        const choose_curve *c = &t->curve[i];
        char why[TOLERANCE_TEXT];
        tolerance_why_left(t, i, why);
        json_array_append_new(list, json_pack("{s:o, s:o, s:o, s:o, s:o}", "name", json_plain_text(t->study->group[i]),
                                              "order", json_number(c->order), "exponent", json_number(c->exponent),
                                              "predicted_seconds", json_number(c->reach_seconds), "why",
                                              json_plain_text(why)));
    }
    return list;
}

static json_t *choice_json(const tolerance *t)
{
    char how[TOLERANCE_TEXT], reason[TOLERANCE_TEXT];
    const study_case *one = tolerance_case(t, t->step.curve, t->step.at);
    const choose_case *c = &t->curve[t->step.curve].list[t->step.at];
    tolerance_how(t, how);
    tolerance_reason(t, reason);
    return json_pack("{s:o, s:s, s:b, s:o, s:b, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "asked",
                     json_number(t->options->tolerance), "metric", t->metric, "met", t->met, "estimate",
                     json_number(c->error), "sure", c->sure, "how", json_plain_text(how), "choice",
                     crossed_json(t->study->axes.axis, t->study->axes.n, one->pick), "directory",
                     json_plain_text(one->run->folder), "reason", json_plain_text(reason), "seconds",
                     json_number(tolerance_seconds(t)), "budget",
                     json_number(t->options->budget > 0.0 ? t->options->budget : (double)NAN), "variants",
                     variants_json(t), "cases", tolerance_cases_json(t));
}

static floe_status write_summary(const tolerance *t, const study_case *one, const char *path)
{
    json_t *object = summary_json(&one->run->summary);
    if (!json_put(object, "tolerance", choice_json(t))) {
        json_decref(object);
        object = NULL;
    }
    return json_write(t->ctx, path, object);
}

/* What of the case's folder is the batch's, not the run's; the summary is written anew. */
static bool is_file_left_out(const char *name)
{
    return strcmp(name, "case.json") == 0 || strcmp(name, "stderr.txt") == 0 || strcmp(name, "summary.json") == 0 ||
           strcmp(name, ".lock") == 0;
}

floe_status tolerance_publish(tolerance *t)
{
    const study_case *one = tolerance_case(t, t->step.curve, t->step.at);
    char from[BATCH_PATH], to[BATCH_PATH], path[BATCH_PATH];
    (void)snprintf(path, sizeof path, "%s/summary.json", t->options->dir);
    TRY(file_remove(t->ctx, path));
    (void)snprintf(to, sizeof to, "%s/fields", t->options->dir);
    TRY(folder_remove(t->ctx, to));
    (void)snprintf(from, sizeof from, "%.2000s/%s/fields", t->cases, one->run->folder);
    if (file_exists(from)) TRY(folder_copy(t->ctx, from, to, NULL));
    *strrchr(from, '/') = '\0';
    TRY(folder_copy(t->ctx, from, t->options->dir, is_file_left_out));
    TRY(write_summary(t, one, path));
    t->published = true;
    return FLOE_OK;
}
