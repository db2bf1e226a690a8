/* The functions and operators of formulas. One row adds one. */
#include "expression/expression_internal.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#define FUNCTION(name, value)                                                  \
    static double value_of_##name(const double *a, const expression_event *at) \
    {                                                                          \
        (void)at;                                                              \
        return (value);                                                        \
    }

FUNCTION(sum, a[0] + a[1])
FUNCTION(difference, a[0] - a[1])
FUNCTION(product, a[0] * a[1])
FUNCTION(quotient, a[0] / a[1])
FUNCTION(power, pow(a[0], a[1]))
FUNCTION(negative, -a[0])
FUNCTION(less, a[0] < a[1])
FUNCTION(at_most, a[0] <= a[1])
FUNCTION(more, a[0] > a[1])
FUNCTION(at_least, a[0] >= a[1])
FUNCTION(equal, a[0] == a[1])
FUNCTION(unequal, a[0] != a[1])
FUNCTION(and, a[0] != 0.0 && a[1] != 0.0)
FUNCTION(or, a[0] != 0.0 || a[1] != 0.0)
FUNCTION(not, a[0] == 0.0)
FUNCTION(sin, sin(a[0]))
FUNCTION(cos, cos(a[0]))
FUNCTION(tan, tan(a[0]))
FUNCTION(asin, asin(a[0]))
FUNCTION(acos, acos(a[0]))
FUNCTION(atan, atan(a[0]))
FUNCTION(atan2, atan2(a[0], a[1]))
FUNCTION(sinh, sinh(a[0]))
FUNCTION(cosh, cosh(a[0]))
FUNCTION(tanh, tanh(a[0]))
FUNCTION(exp, exp(a[0]))
FUNCTION(log, log(a[0]))
FUNCTION(log10, log10(a[0]))
FUNCTION(erf, erf(a[0]))
FUNCTION(sqrt, sqrt(a[0]))
FUNCTION(abs, fabs(a[0]))
FUNCTION(sign, (a[0] > 0.0) - (a[0] < 0.0))
FUNCTION(floor, floor(a[0]))
FUNCTION(mod, a[0] - a[1] * floor(a[0] / a[1]))
FUNCTION(min, fmin(a[0], a[1]))
FUNCTION(max, fmax(a[0], a[1]))
FUNCTION(if, a[0] != 0.0 ? a[1] : a[2])
FUNCTION(ramp, a[0] <= 0.0 ? 0.0 : a[0] >= a[1] ? 1.0 : 0.5 - 0.5 * cos(3.14159265358979323846 * a[0] / a[1]))

/* A number from -1 to 1 of a corner of a lattice, by mixing its bits (splitmix64). */
static double corner_noise(const int64_t corner[3], double seed)
{
    uint64_t mix = (uint64_t)(int64_t)seed;
    for (int a = 0; a < 4; ++a) {
        mix += 0x9E3779B97F4A7C15U + (a < 3 ? (uint64_t)corner[a] : 0U);
        mix = (mix ^ (mix >> 30)) * 0xBF58476D1CE4E5B9U;
        mix = (mix ^ (mix >> 27)) * 0x94D049BB133111EBU;
        mix ^= mix >> 31;
    }
    return (double)(mix >> 11) * 0x1p-52 - 1.0;
}

/* Smooth noise of place: numbers at the corners of a lattice of this spacing, and a cubic blend between them. It is the same
 * for every mesh, for any number of threads and on any machine. */
static double value_of_noise(const double *a, const expression_event *at)
{
    int64_t low[3];
    double share[3], sum = 0.0;
    for (int d = 0; d < 3; ++d) {
        const double place = at->x[d] / a[0], whole = floor(place);
        if (!(fabs(place) < 1e15) || !(fabs(a[1]) < 1e15)) return (double)NAN;
        low[d] = (int64_t)whole;
        share[d] = (place - whole) * (place - whole) * (3.0 - 2.0 * (place - whole));
    }
    for (int corner = 0; corner < 8; ++corner) {
        int64_t index[3];
        double weight = 1.0;
        for (int d = 0; d < 3; ++d) {
            const int upper = corner >> d & 1;
            index[d] = low[d] + upper;
            weight *= upper ? share[d] : 1.0 - share[d];
        }
        if (weight > 0.0) sum += weight * corner_noise(index, a[1]);
    }
    return sum;
}

static const expression_call operators[] = {
    {"+", 2, value_of_sum, RULE_SAME, NULL, NULL, false},
    {"-", 2, value_of_difference, RULE_SAME, NULL, NULL, false},
    {"*", 2, value_of_product, RULE_PRODUCT, NULL, NULL, false},
    {"/", 2, value_of_quotient, RULE_QUOTIENT, NULL, NULL, false},
    {"^", 2, value_of_power, RULE_POWER, NULL, NULL, false},
    {"negative", 1, value_of_negative, RULE_SAME, NULL, NULL, false},
    {"<", 2, value_of_less, RULE_COMPARE, NULL, NULL, false},
    {"<=", 2, value_of_at_most, RULE_COMPARE, NULL, NULL, false},
    {">", 2, value_of_more, RULE_COMPARE, NULL, NULL, false},
    {">=", 2, value_of_at_least, RULE_COMPARE, NULL, NULL, false},
    {"==", 2, value_of_equal, RULE_COMPARE, NULL, NULL, false},
    {"!=", 2, value_of_unequal, RULE_COMPARE, NULL, NULL, false},
    {"and", 2, value_of_and, RULE_ANY, NULL, NULL, false},
    {"or", 2, value_of_or, RULE_ANY, NULL, NULL, false},
    {"not", 1, value_of_not, RULE_ANY, NULL, NULL, false},
};

static const expression_call functions[] = {
    {"sin", 1, value_of_sin, RULE_NUMBERS, "sin(a)", "sine of an angle in radians", false},
    {"cos", 1, value_of_cos, RULE_NUMBERS, "cos(a)", "cosine", false},
    {"tan", 1, value_of_tan, RULE_NUMBERS, "tan(a)", "tangent", false},
    {"asin", 1, value_of_asin, RULE_NUMBERS, "asin(a)", "angle whose sine is a", false},
    {"acos", 1, value_of_acos, RULE_NUMBERS, "acos(a)", "angle whose cosine is a", false},
    {"atan", 1, value_of_atan, RULE_NUMBERS, "atan(a)", "angle whose tangent is a", false},
    {"atan2", 2, value_of_atan2, RULE_COMPARE, "atan2(b, a)", "angle of the direction (a, b)", false},
    {"sinh", 1, value_of_sinh, RULE_NUMBERS, "sinh(a)", "hyperbolic sine", false},
    {"cosh", 1, value_of_cosh, RULE_NUMBERS, "cosh(a)", "hyperbolic cosine", false},
    {"tanh", 1, value_of_tanh, RULE_NUMBERS, "tanh(a)", "hyperbolic tangent", false},
    {"exp", 1, value_of_exp, RULE_NUMBERS, "exp(a)", "e to the power a", false},
    {"log", 1, value_of_log, RULE_NUMBERS, "log(a)", "natural logarithm", false},
    {"log10", 1, value_of_log10, RULE_NUMBERS, "log10(a)", "logarithm to the base 10", false},
    {"erf", 1, value_of_erf, RULE_NUMBERS, "erf(a)", "error function", false},
    {"sqrt", 1, value_of_sqrt, RULE_ROOT, "sqrt(a)", "square root", false},
    {"abs", 1, value_of_abs, RULE_SAME, "abs(a)", "size without sign", false},
    {"sign", 1, value_of_sign, RULE_ANY, "sign(a)", "-1, 0 or 1", false},
    {"floor", 1, value_of_floor, RULE_SAME, "floor(a)", "largest whole number that is not above a", false},
    {"mod", 2, value_of_mod, RULE_SAME, "mod(a, b)", "what a has beyond whole multiples of b, from 0 to b", false},
    {"min", 2, value_of_min, RULE_SAME, "min(a, b)", "the smaller one", false},
    {"max", 2, value_of_max, RULE_SAME, "max(a, b)", "the larger one", false},
    {"if", 3, value_of_if, RULE_CHOICE, "if(c, a, b)", "a where c holds, else b", false},
    {"ramp", 2, value_of_ramp, RULE_COMPARE, "ramp(a, b)",
     "from 0 at a = 0 to 1 at a = b and beyond, along half a cosine", false},
    {"noise", 2, value_of_noise, RULE_ANY, "noise(l, seed)",
     "smooth noise of place from -1 to 1, that changes over a length l; a whole number tells one noise from another",
     true},
};

static const expression_call *find_by_name(const expression_call *list, size_t n, const char *name, size_t length)
{
    for (size_t i = 0; i < n; ++i)
        if (strlen(list[i].name) == length && strncmp(list[i].name, name, length) == 0) return &list[i];
    return NULL;
}

const expression_call *expression_find_call(const char *name, size_t length)
{
    return find_by_name(functions, sizeof functions / sizeof functions[0], name, length);
}

const expression_call *expression_operator(const char *sign)
{
    return find_by_name(operators, sizeof operators / sizeof operators[0], sign, strlen(sign));
}

bool expression_describe(size_t i, const char **form, const char **doc)
{
    if (i >= sizeof functions / sizeof functions[0]) return false;
    *form = functions[i].form;
    *doc = functions[i].doc;
    return true;
}
