#include "expression/expression_internal.h"

#include "base/memory.h"

#include <math.h>

void expression_destroy(context *ctx, expression **e)
{
    if (!*e) return;
    memory_free(ctx, &(*e)->text);
    memory_free(ctx, &(*e)->step);
    memory_free(ctx, e);
}

double expression_value(const expression *e, const double x[3], double t)
{
    const expression_event at = {x, t};
    double stack[EXPRESSION_STACK];
    int top = 0; /* numbers on the stack */
    for (size_t i = 0; i < e->n; ++i) {
        const expression_step *s = &e->step[i];
        switch (s->kind) {
        case STEP_NUMBER: stack[top++] = s->number; break;
        case STEP_COORDINATE: stack[top++] = x[s->coordinate]; break;
        case STEP_TIME: stack[top++] = t; break;
        case STEP_TABLE: stack[top - 1] = s->curve ? value_table_at(s->curve, stack[top - 1]) : (double)NAN; break;
        case STEP_CALL:
            top -= s->call->arguments;
            stack[top] = s->call->value(stack + top, &at);
            top++;
            break;
        }
    }
    return stack[0];
}

bool expression_has_place(const expression *e)
{
    return e->has_place;
}

bool expression_has_time(const expression *e)
{
    return e->has_time;
}

const char *expression_text(const expression *e)
{
    return e->text;
}
