#include "run/advance.h"

#include "base/threads.h"
#include "run/schedule.h"

#include <stdlib.h>

enum {
    CHECKS_PER_WINDOW = 64,
    STEPS_PER_LOOK = 32,
    WORK_PER_THREAD = 20000 /* points and cells */
};

/* Threads that wait for each other cost more than they bring in a small scene: unless someone has named a number, it is
 * what the scene can use. The results do not depend on it. */
int advance_choose_threads(const sim *s, int named)
{
    const int wanted = named > 0 ? named : s->scene->threads, most = threads_use(wanted);
    const size_t work = (s->mpm ? mpm_count(s->mpm) : 0) + (s->ice ? mesh_cells(&s->mesh) : 0);
    if (wanted > 0 || getenv("OMP_NUM_THREADS") || work / WORK_PER_THREAD + 1 >= (size_t)most) return most;
    return threads_use((int)(work / WORK_PER_THREAD) + 1);
}

bool advance_is_finished(const sim *s)
{
    const scene_time *t = &s->scene->time;
    return s->at_rest || !(s->time < t->end) || (t->max_steps > 0 && s->steps >= t->max_steps);
}

/* Rest is looked for often enough, yet not at every step: it costs a pass over the points. */
floe_status advance_check_rest(sim *s, double before)
{
    sim_totals totals;
    if (!s->scene->rest.enabled) return FLOE_OK;
    if (!schedule_is_passed(before, s->time, sim_rest_window(s) / CHECKS_PER_WINDOW)) return FLOE_OK;
    TRY(sim_sum(s, &totals));
    return sim_check_rest(s, &totals);
}

/* The account is looked at with every row, and often enough between them for its largest drift to be found; by the number
 * of steps, so that a run that goes on looks when one that was not stopped does. */
floe_status advance_check_ledger(sim *s, run_truth *truth)
{
    if (s->steps % STEPS_PER_LOOK == 0 || advance_is_finished(s)) TRY(sim_update_ledger(s));
    truth_log(truth, s);
    if (!sim_has_grown(s)) return FLOE_OK;
    char text[SIM_GROWTH_TEXT];
    sim_describe_growth(s, text);
    return fail(s->ctx, FLOE_DIVERGED, "%s", text);
}
