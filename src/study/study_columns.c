/* Whether the quantities of a study are columns of its cases' histories, before anything runs. */
#include "study/study_internal.h"

#include "io/history_columns.h"
#include "run/setup.h"

#include <string.h>

/* The line of names of a scene's history. */
static floe_status append_names(scene *of, strbuf *names)
{
    run_setup setup;
    floe_status status = setup_begin(&setup, of);
    if (status == FLOE_OK) status = history_names(setup.sim, names);
    setup_end(&setup);
    return status;
}

/* The cheapest case of a coupling; s->n: none. */
static size_t cheapest_case(const study *s, scene_coupling coupling)
{
    size_t best = s->n;
    for (size_t i = 0; i < s->n; i++) {
        if (s->list[i].coupling != coupling) continue;
        if (best == s->n || s->run[i].weight < s->run[best].weight) best = i;
    }
    return best;
}

/* The names of that case are added, a line. A case that cannot even start is a result of the study, and has none. */
static floe_status add_case_columns(const study *s, size_t i, strbuf *names, bool *all)
{
    const batch_options batch = study_batch_options(s);
    scene *of;
    TRY(batch_prepare(s->ctx, &batch, &s->run[i], &of));
    const floe_status status = append_names(of, names);
    scene_destroy(&of);
    if (status == FLOE_OK || status == FLOE_NO_MEMORY) return status;
    context_clear(s->ctx);
    *all = false;
    return FLOE_OK;
}

/* Is it a column of any of the lines? */
static bool is_column(const char *lines, const char *name)
{
    for (const char *line = lines; line && *line; line = strchr(line, '\n')) {
        if (*line == '\n') line++;
        if (csv_names(line, name)) return true;
    }
    return false;
}

floe_status study_check_columns(const study *s, strbuf *errors)
{
    strbuf names;
    bool all = true;
    floe_status status = FLOE_OK;
    if (s->plan.n_quantities == 0) return FLOE_OK;
    strbuf_init(&names, s->ctx);
    for (int c = 0; c < COUPLING_COUNT && status == FLOE_OK; c++) {
        const size_t i = cheapest_case(s, (scene_coupling)c);
        if (i < s->n) status = add_case_columns(s, i, &names, &all);
    }
    if (status == FLOE_OK) status = names.status;
    for (int q = 0; q < s->plan.n_quantities && all && status == FLOE_OK; q++) {
        if (!is_column(strbuf_string(&names), s->plan.quantity[q]))
            strbuf_append(errors, "study.quantities: no case's history.csv has a column '%s'; they have\n%s",
                          s->plan.quantity[q], strbuf_string(&names));
    }
    strbuf_free(&names);
    return status;
}
