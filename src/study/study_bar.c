/* Required orders and errors, and whether they were reached. */
#include "study/study_internal.h"

#include "base/memory.h"
#include "run/run_errors.h"

#include <math.h>
#include <string.h>

bool study_belongs(const study *s, const study_case *one, const scene_where *where, bool all)
{
    for (int k = 0; k < where->n; k++) {
        const int at = axis_find(&s->axes, where->key[k]);
        if (at == s->over && !all) continue;
        if (at < 0 || !axis_same_value(s->axes.axis[at].value[one->pick[at]], where->value[k])) return false;
    }
    return true;
}

static bool names_over(const study *s, const scene_bar *bar)
{
    for (int k = 0; k < bar->where.n; k++) {
        if (axis_find(&s->axes, bar->where.key[k]) == s->over) return true;
    }
    return false;
}

static int quantity_of(const study *s, const char *name)
{
    for (int q = 0; q < s->plan.n_quantities; q++) {
        if (strcmp(s->plan.quantity[q], name) == 0) return q;
    }
    return -1;
}

static double order_of(const study *s, size_t group, const char *metric)
{
    study_limit limit;
    const int quantity = quantity_of(s, metric);
    if (quantity < 0) return study_order_of(s, group, metric).order;
    return study_limit_of(s, group, quantity, &limit) ? limit.limit.order : (double)NAN;
}

/* Of a quantity: the index of the finest value, relative to it. */
static double error_at(const study *s, const study_case *one, const char *metric)
{
    study_limit limit;
    const int quantity = quantity_of(s, metric);
    if (quantity < 0) return study_error(one, metric);
    if (!study_limit_of(s, one->group, quantity, &limit)) return NAN;
    return limit.limit.gci_fine / fabs(limit.values.value[limit.values.n - 1]);
}

/* The finest case of a group, finished or not: `over` is as the axis has it. */
static size_t finest_case(const study *s, size_t group)
{
    size_t best = s->n;
    for (size_t i = 0; i < s->n; i++) {
        if (s->list[i].group == group && (best == s->n || s->list[i].over < s->list[best].over)) best = i;
    }
    return best;
}

typedef struct bar_list {
    study_bar_result *list;
    size_t n;
} bar_list;

static void add_order(const study *s, const scene_bar *bar, size_t group, bar_list *out)
{
    study_bar_result *r = &out->list[out->n++];
    *r = (study_bar_result){.bar = bar, .of_order = true, .limit = bar->order};
    r->value = order_of(s, group, bar->metric);
    r->met = r->value >= r->limit;
    (void)snprintf(r->where, sizeof r->where, "%s", s->group[group]);
}

static void add_error(const study *s, const scene_bar *bar, size_t i, bar_list *out)
{
    study_bar_result *r = &out->list[out->n++];
    *r = (study_bar_result){.bar = bar, .limit = bar->error};
    r->value = error_at(s, &s->list[i], bar->metric);
    r->met = r->value <= r->limit;
    (void)snprintf(r->where, sizeof r->where, "%s", s->run[i].label);
}

/* An order is asked of groups; an error of the finest case of each group, or of those that `where` names. */
static void judge_bar(const study *s, const scene_bar *bar, bar_list *out)
{
    const bool by_case = names_over(s, bar) || s->over < 0;
    for (size_t i = 0; i < s->n; i++) {
        const study_case *one = &s->list[i];
        const bool last = finest_case(s, one->group) == i;
        if (!isnan(bar->order) && last && study_belongs(s, one, &bar->where, false)) add_order(s, bar, one->group, out);
        if (!isnan(bar->error) && (last || by_case) && study_belongs(s, one, &bar->where, by_case))
            add_error(s, bar, i, out);
    }
}

floe_status study_bars(const study *s, study_bar_result **out, size_t *n)
{
    bar_list all = {.n = 0};
    TRY(memory_new(s->ctx, &all.list, 2 * s->n * (size_t)s->plan.n_bars, sizeof *all.list));
    for (int b = 0; b < s->plan.n_bars; b++) judge_bar(s, &s->plan.bar[b], &all);
    *out = all.list;
    *n = all.n;
    return FLOE_OK;
}

void study_bar_text(const study *s, const study_bar_result *r, char *text, size_t size)
{
    char value[ERROR_TEXT], limit[ERROR_TEXT];
    if (r->of_order) {
        (void)snprintf(value, sizeof value, "%.2f", r->value);
        (void)snprintf(limit, sizeof limit, "%.2f", r->limit);
    } else {
        error_text(r->bar->metric, r->value, s->dimensionless, value);
        error_text(r->bar->metric, r->limit, s->dimensionless, limit);
    }
    (void)snprintf(text, size, "%s of %s, %s: %s, required: %s %s", r->of_order ? "order" : "error", r->bar->metric,
                   r->where, isfinite(r->value) ? value : "not measured", r->of_order ? "at least" : "at most", limit);
}
