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

static floe_status write_all(const study *s)
{
    TRY(study_write_json(s));
    TRY(study_write_csv(s));
    return study_write_figures(s);
}

/* The cases, then the timed runs; when stopped on the way, what there is. */
static floe_status run_all(study *s)
{
    batch_options batch = study_batch_options(s);
    batch.go_on = !s->options->again;
    floe_status status = batch_run(s->ctx, &batch, s->run, s->n);
    if (status != FLOE_OK && status != FLOE_INTERRUPTED) return status;
    say_other_builds(s);
    study_take_values(s);
    study_judge(s);
    if (s->options->spoil) TRY(study_spoil(s));
    study_take_times(s);
    return status == FLOE_OK ? study_time(s) : status;
}

static floe_status run_study(study *s)
{
    TRY(study_make_plan(s));
    const floe_status status = run_all(s);
    if (status != FLOE_OK && status != FLOE_INTERRUPTED) return status;
    const floe_status written = write_all(s);
    if (status != FLOE_OK) return status;
    TRY(written);
    return study_check_results(s);
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
