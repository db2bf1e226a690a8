#include "study/study_internal.h"

#include "base/memory.h"
#include "floe_build.h"

#include <string.h>

/* Results of other builds are kept, but not in silence. */
static void say_other_builds(const study *s)
{
    size_t n = 0;
    for (size_t i = 0; i < s->n; i++) n += s->run[i].kept && strcmp(s->run[i].summary.git, FLOE_GIT) != 0;
    if (n > 0)
        context_log(s->ctx, LOG_WARNING,
                    "%zu of the cases that were kept are of another build of floe: --again runs "
                    "them anew",
                    n);
}

floe_status study_write(const study *s)
{
    TRY(study_write_json(s));
    TRY(study_write_csv(s));
    return study_write_figures(s);
}

/* A study as a judge: the cases are the first round, the timed runs the second one. */
typedef struct studying {
    study *s;
    int rounds;
    study_timed timed; /* owned */
} studying;

static floe_status want_next_of_study(void *of, case_round *round)
{
    studying *r = of;
    study *s = r->s;
    round->batch = study_batch_options(s);
    if (r->rounds == 0) {
        round->batch.go_on = !s->options->again;
        round->list = s->run;
        round->n = s->n;
    } else if (r->rounds == 1) {
        TRY(study_list_timed(s, &r->timed, round));
    }
    r->rounds++;
    return FLOE_OK;
}

static floe_status take_cases(void *of, const case_round *round)
{
    const studying *r = of;
    study *s = r->s;
    if (round->list != s->run) {
        study_take_timed(s, &r->timed);
        return FLOE_OK;
    }
    say_other_builds(s);
    study_take_values(s);
    study_judge(s);
    if (s->options->spoil) TRY(study_spoil(s));
    study_take_times(s);
    return FLOE_OK;
}

static floe_status write_study_results(void *of)
{
    return study_write(((const studying *)of)->s);
}

static floe_status check_results(void *of)
{
    return study_check_results(((const studying *)of)->s);
}

static floe_status run_study(study *s)
{
    static const case_judge judge = {want_next_of_study, take_cases, write_study_results, check_results};
    studying r = {.s = s};
    TRY(study_make_plan(s));
    const floe_status status = judge_cases(s->ctx, &judge, &r);
    memory_free(s->ctx, &r.timed.list);
    memory_free(s->ctx, &r.timed.index);
    return status;
}

floe_status study_run(study **out, context *ctx, const study_options *options)
{
    TRY(memory_new(ctx, out, 1, sizeof **out));
    (*out)->ctx = ctx;
    (*out)->options = options;
    return run_study(*out);
}

void study_destroy(study **s)
{
    if (!s || !*s) return;
    context *ctx = (*s)->ctx;
    for (size_t i = 0; (*s)->list && i < (*s)->n; i++) case_settings_free(&(*s)->list[i].settings, ctx);
    memory_free(ctx, &(*s)->list);
    memory_free(ctx, &(*s)->run);
    memory_free(ctx, &(*s)->group);
    memory_free(ctx, s);
}
