/* What `floe check` says of the cases of a deck. */
#include "cli/cli.h"
#include "study/study.h"

#include <sys/stat.h>

/* The cases of `floe study`, or of `floe compare`. */
static floe_status rehearse_cases(const cli *c, const cli_deck *d, bool compare)
{
    study_rehearsal result;
    const study_options wanted = {.name = compare ? "compare" : "study",
                                  .compare = compare,
                                  .batch = {.deck = d->path, .dir = "", .stop = c->stop, .progress = stderr},
                                  .set = {d->set, d->n_set},
                                  .repeat = -1};
    TRY(study_rehearse(c->ctx, &wanted, &result));
    printf("%s: %zu cases", wanted.name, result.cases);
    if (result.foreseen > 0) printf(", %zu refused, as the deck foresees", result.foreseen);
    const size_t tried = result.set_up + result.foreseen + result.refused;
    if (tried < result.cases) printf(", %zu of them made ready", tried);
    printf("\n");
    return FLOE_OK;
}

floe_status cli_check_batches(const cli *c, const cli_deck *d, const floe_description *of)
{
    struct stat about;
    if ((of->compares || of->studies) && stat(d->path, &about) == 0 && !S_ISREG(about.st_mode)) {
        printf("cases: not made ready, as each reads the deck anew and '%s' can be read once: give a file\n", d->path);
        return FLOE_OK;
    }
    if (of->compares) TRY(rehearse_cases(c, d, true));
    return of->studies ? rehearse_cases(c, d, false) : FLOE_OK;
}
