/* Checks that could not have failed: each case that is right is judged again with its result spoiled. */
#include "study/study_internal.h"

#include "base/memory.h"
#include "io/file.h"
#include "run/run_errors.h"
#include "run/spoil.h"

#include <math.h>
#include <string.h>

void study_unnoticed_text(const study_case *one, char text[BATCH_MESSAGE])
{
    size_t at = 0;
    text[0] = '\0';
    for (int k = 0; k < SPOILER_COUNT; k++) {
        if (!(one->unnoticed >> k & 1U)) continue;
        (void)snprintf(text + at, BATCH_MESSAGE - at, "%s%s", at > 0 ? " " : "", spoiler_name((spoiler)k));
        at = strlen(text);
    }
}

const char *study_kind_name(const study_case *one)
{
    if (one->verdict != STUDY_RIGHT) return study_verdict_name(one->verdict);
    if (one->unnoticed != 0) return "blind";
    return one->of_solution ? "solution" : "bound";
}

size_t study_count_unnoticed(const study *s)
{
    size_t n = 0;
    for (size_t i = 0; i < s->n; i++) n += s->list[i].unnoticed != 0;
    return n;
}

void study_check_unchanged(const study *s, strbuf *errors)
{
    for (int k = 0; k < s->plan.n_unchanged; k++) {
        const char *word = s->plan.unchanged[k].by;
        for (word += strspn(word, " "); *word; word += strspn(word, " ")) {
            const size_t length = strcspn(word, " ");
            if (spoiler_find(word, length) == SPOILER_COUNT)
                strbuf_append(errors, "study.unchanged: '%.*s' is none of frozen, initial, doubled, halved, mirrored\n",
                              (int)length, word);
            word += length;
        }
    }
}

static bool names_spoiler(const char *by, spoiler kind)
{
    for (by += strspn(by, " "); *by; by += strspn(by, " ")) {
        const size_t length = strcspn(by, " ");
        if (spoiler_find(by, length) == kind) return true;
        by += length;
    }
    return false;
}

static bool is_excused(const study *s, const study_case *one, spoiler kind)
{
    for (int k = 0; k < s->plan.n_unchanged; k++)
        if (names_spoiler(s->plan.unchanged[k].by, kind) && study_belongs(s, one, &s->plan.unchanged[k].where, true))
            return true;
    return false;
}

/* The spoiled state is as right as the run's own: as near to the solution, or the same but for round-off. */
static bool is_as_right(const scene_check *check, study_range own, study_range spoiled, bool of_solution)
{
    const double size = fmax(fabs(own.least), fabs(own.most));
    if (of_solution) return spoiled.most <= 3.0 * own.most || spoiled.most <= 0.05 * check->most;
    return fabs(spoiled.least - own.least) <= 1e-6 * size && fabs(spoiled.most - own.most) <= 1e-6 * size;
}

typedef struct judged {
    bool passes; /* all checks */
    bool right;  /* and it is as right as the run's own state */
} judged;

static judged judge_spoiled(const study *s, const study_case *one, const run_summary *errors, const csv_table *own,
                            const csv_table *rows)
{
    char why[BATCH_MESSAGE];
    const run_summary *r = &one->run->summary;
    judged result = {true, true};
    for (int k = 0; k < s->plan.n_checks; k++) {
        const scene_check *check = &s->plan.check[k];
        if (!study_belongs(s, one, &check->where, true)) continue;
        const study_range spoiled = study_range_of(check, errors, r, rows);
        result.passes = result.passes && study_keeps_to(check, spoiled, why);
        result.right = result.right &&
                       is_as_right(check, study_range_of(check, r, r, own), spoiled, !isnan(error_of(r, check->of)));
    }
    return result;
}

static floe_status spoil_once(const study *s, study_case *one, spoiled_run *run, spoiler kind, const char *path,
                              const csv_table *own)
{
    run_summary errors = {0};
    csv_table rows;
    floe_status status = csv_read(&rows, s->ctx, path);
    if (status == FLOE_OK) {
        spoil_history(&rows, kind);
        status = spoil_measure(run, kind, &rows, &errors);
    }
    if (status == FLOE_OK) {
        const judged j = judge_spoiled(s, one, &errors, own, &rows);
        const bool excused = j.right && is_excused(s, one, kind);
        if (j.passes) *(excused ? &one->excused : &one->unnoticed) |= 1U << kind;
    }
    csv_free(&rows);
    return status;
}

static floe_status spoil_scenes(const study *s, study_case *one, scene *start, scene *end)
{
    char dir[BATCH_PATH], path[BATCH_PATH + 16];
    spoiled_run run = {0};
    csv_table own;
    (void)snprintf(dir, sizeof dir, "%s/%s", s->options->batch.dir, one->run->folder);
    (void)snprintf(path, sizeof path, "%s/history.csv", dir);
    floe_status status = csv_read(&own, s->ctx, path);
    if (status == FLOE_OK) status = spoil_open(&run, start, end, dir);
    for (int k = 0; k < SPOILER_COUNT && status == FLOE_OK; k++)
        status = spoil_once(s, one, &run, (spoiler)k, path, &own);
    spoil_close(&run);
    csv_free(&own);
    return status;
}

static floe_status spoil_case(const study *s, study_case *one)
{
    const batch_options batch = study_batch_options(s);
    scene *start = NULL, *end = NULL;
    floe_status status = batch_prepare(s->ctx, &batch, one->run, &start);
    if (status == FLOE_OK) status = batch_prepare(s->ctx, &batch, one->run, &end);
    if (status == FLOE_OK) status = spoil_scenes(s, one, start, end);
    scene_destroy(&end);
    scene_destroy(&start);
    return status;
}

floe_status study_spoil(study *s)
{
    for (size_t i = 0; i < s->n; i++)
        if (s->list[i].verdict == STUDY_RIGHT) TRY(spoil_case(s, &s->list[i]));
    return FLOE_OK;
}
