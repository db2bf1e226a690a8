/* Dimensions of formulas: only what is certain is refused, for a plain number may stand for anything. */
#include "expression/expression_internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const expression_dimension unknown = {.known = false}, number = {.known = true};

static bool same_powers(const expression_dimension *a, const expression_dimension *b)
{
    return memcmp(a->power, b->power, sizeof a->power) == 0;
}

static void describe_dimension(const expression_dimension *d, char *text, size_t size)
{
    static const char *const base[EXPRESSION_BASES] = {"m", "kg", "s", "K", "mol", "A", "cd", "?"};
    size_t n = 0;
    text[0] = '\0';
    for (int i = 0; i < EXPRESSION_BASES; ++i) {
        if (d->power[i] == 0 || n >= size) continue;
        n += (size_t)snprintf(text + n, size - n, "%s%s", n > 0 ? " " : "", base[i]);
        if (d->power[i] != 1 && n < size) n += (size_t)snprintf(text + n, size - n, "%d", d->power[i]);
    }
    if (n == 0) snprintf(text, size, "no dimension");
}

/* All known ones of arguments first to last are the same, which *out is. */
static bool check_alike(const expression_call *call, const expression_dimension *argument, int first, int last,
                        expression_dimension *out, char *why)
{
    *out = unknown;
    for (int i = first; i < last; ++i) {
        char one[40], other[40];
        if (!argument[i].known) continue;
        if (!out->known) *out = argument[i];
        if (same_powers(out, &argument[i])) continue;
        describe_dimension(out, one, sizeof one);
        describe_dimension(&argument[i], other, sizeof other);
        snprintf(why, EXPRESSION_WHY, "'%s' of %s and %s", call->name, one, other);
        return false;
    }
    return true;
}

static bool check_plain(const expression_call *call, const expression_dimension *argument, char *why)
{
    for (int i = 0; i < call->arguments; ++i) {
        char has[40];
        if (!argument[i].known || same_powers(&argument[i], &number)) continue;
        describe_dimension(&argument[i], has, sizeof has);
        snprintf(why, EXPRESSION_WHY, "'%s' takes a number without a unit, and this is in %s", call->name, has);
        return false;
    }
    return true;
}

/* a + times b of the exponents; unknown where one is, or where they leave the range. */
static expression_dimension add_powers(const expression_dimension *a, const expression_dimension *b, int times)
{
    expression_dimension sum = *a;
    if (!a->known || !b->known) return unknown;
    for (int i = 0; i < EXPRESSION_BASES; ++i) {
        const int power = a->power[i] + times * b->power[i];
        if (power < -100 || power > 100) return unknown;
        sum.power[i] = (signed char)power;
    }
    return sum;
}

static expression_dimension raise_powers(const expression_dimension *a, double exponent)
{
    expression_dimension out = *a;
    if (!a->known || same_powers(a, &number)) return *a;
    if (isnan(exponent)) return unknown;
    for (int i = 0; i < EXPRESSION_BASES; ++i) {
        const double power = a->power[i] * exponent;
        if (power != rint(power) || fabs(power) > 100.0) return unknown;
        out.power[i] = (signed char)power;
    }
    return out;
}

bool expression_combine(const expression_call *call, const expression_dimension *argument, double exponent,
                        expression_dimension *out, char *why)
{
    expression_dimension ignored;
    switch (call->rule) {
    case RULE_SAME: return check_alike(call, argument, 0, call->arguments, out, why);
    case RULE_NUMBERS: *out = number; return check_plain(call, argument, why);
    case RULE_COMPARE: *out = number; return check_alike(call, argument, 0, call->arguments, &ignored, why);
    case RULE_ANY: *out = number; return true;
    case RULE_PRODUCT: *out = add_powers(&argument[0], &argument[1], 1); return true;
    case RULE_QUOTIENT: *out = add_powers(&argument[0], &argument[1], -1); return true;
    case RULE_POWER: *out = raise_powers(&argument[0], exponent); return true;
    case RULE_ROOT: *out = raise_powers(&argument[0], 0.5); return true;
    case RULE_CHOICE: return check_alike(call, argument, 1, call->arguments, out, why);
    }
    return false;
}
