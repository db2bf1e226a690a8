#include "study/judge.h"

/* `stopped` gets what the batch says of that, and the context is clear for the judge. */
static floe_status run_rounds(context *ctx, const case_judge *judge, void *of, char stopped[CONTEXT_MESSAGE_SIZE])
{
    for (;;) {
        case_round round = {.n = 0};
        TRY(judge->next(of, &round));
        if (round.n == 0) return FLOE_OK;
        const floe_status status = batch_run(ctx, &round.batch, round.list, round.n);
        if (status != FLOE_OK && status != FLOE_INTERRUPTED) return status;
        (void)snprintf(stopped, CONTEXT_MESSAGE_SIZE, "%s", context_message(ctx));
        context_clear(ctx);
        TRY(judge->take(of, &round));
        TRY(status);
    }
}

floe_status judge_cases(context *ctx, const case_judge *judge, void *of)
{
    char stopped[CONTEXT_MESSAGE_SIZE];
    const floe_status status = run_rounds(ctx, judge, of, stopped);
    if (status != FLOE_OK && status != FLOE_INTERRUPTED) return status;
    TRY(judge->write(of));
    return status == FLOE_OK ? judge->conclude(of) : fail(ctx, status, "%s", stopped);
}

floe_status judge_base_scene(context *ctx, const batch_options *batch, const deck_overrides *set, scene **out)
{
    batch_case whole = {.set = set->text, .n_set = set->n};
    return batch_prepare(ctx, batch, &whole, out);
}
