/* From text to steps in postfix order, by recursive descent: a level of the grammar a function, the weakest binding first. */
#include "expression/expression_words.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_STEPS = 2000, MOST_BRACKETS = 40 };

typedef struct formula_reader {
    expression_words words;
    expression_step step[MOST_STEPS];
    size_t n;
    expression_dimension dimension[EXPRESSION_STACK]; /* of what is on the stack */
    int depth, brackets;
    bool has_place, has_time;
} formula_reader;

static bool read_formula(formula_reader *r);
static bool read_factor(formula_reader *r);

static bool add_step(formula_reader *r, const expression_step *step, const expression_dimension *dimension)
{
    if (r->n == MOST_STEPS || r->depth == EXPRESSION_STACK)
        return words_refuse(&r->words, r->words.at, "the formula is too long");
    r->step[r->n++] = *step;
    r->dimension[r->depth++] = *dimension;
    return true;
}

static bool add_number(formula_reader *r, double number, const expression_dimension *dimension)
{
    return add_step(r, &(expression_step){.kind = STEP_NUMBER, .number = number}, dimension);
}

/* Whether the last `count` steps are numbers. */
static bool ends_in_numbers(const formula_reader *r, int count)
{
    for (int i = 1; i <= count; ++i)
        if (r->step[r->n - (size_t)i].kind != STEP_NUMBER) return false;
    return true;
}

/* A call of what lies on the stack; of numbers it is a number. */
static bool add_call(formula_reader *r, const expression_call *call, const char *place)
{
    const int count = call->arguments;
    const bool numbers = !call->of_place && ends_in_numbers(r, count);
    expression_dimension out;
    char why[EXPRESSION_WHY];
    const double last = ends_in_numbers(r, 1) ? r->step[r->n - 1].number : (double)NAN;
    if (!expression_combine(call, &r->dimension[r->depth - count], last, &out, why) && r->words.has_unit)
        return words_refuse(&r->words, place, "%s", why);
    r->depth -= count;
    r->has_place = r->has_place || call->of_place;
    if (!numbers) return add_step(r, &(expression_step){.kind = STEP_CALL, .call = call}, &out);
    double argument[EXPRESSION_ARGUMENTS];
    for (int i = 0; i < count; ++i) argument[i] = r->step[r->n - (size_t)(count - i)].number;
    r->n -= (size_t)count;
    return add_number(r, call->value(argument, NULL), &out);
}

/* The arguments of a function, brackets included. */
static bool read_arguments(formula_reader *r, const char *name, size_t length, int count)
{
    if (!words_take(&r->words, "(")) return words_refuse(&r->words, name, "'%.*s' is a function: (", (int)length, name);
    for (int i = 0; i < count; ++i) {
        if (i > 0 && !words_take(&r->words, ","))
            return words_refuse(&r->words, r->words.at, "'%.*s' takes %d numbers", (int)length, name, count);
        if (!read_formula(r)) return false;
    }
    if (words_take(&r->words, ")")) return true;
    return words_refuse(&r->words, r->words.at, "'%.*s' takes %d number%s, then )", (int)length, name, count,
                        count == 1 ? "" : "s");
}

static bool refuse_name(formula_reader *r, const char *name, size_t length)
{
    const expression_scope *scope = r->words.scope;
    const bool named = scope->n_constants + scope->n_functions > 0;
    char known[80] = "";
    for (int a = 0; a < 3 && scope->axis[a]; ++a)
        snprintf(known + strlen(known), sizeof known - strlen(known), "%s, ", scope->axis[a]);
    return words_refuse(&r->words, name, "'%.*s' is not known; there are %st, pi, %sfunctions%s", (int)length, name,
                        known, named ? "the deck's constants and tables, and " : "and ",
                        named ? "" : "; constants of your own have a section in the deck, 'constants'");
}

static bool read_name(formula_reader *r, size_t length)
{
    static const expression_dimension metre = {true, {1}}, second = {true, {0, 0, 1}}, unknown = {.known = false};
    const expression_scope *scope = r->words.scope;
    const char *name = r->words.at;
    const int axis = words_coordinate(scope, name, length);
    const expression_constant *constant = words_constant(scope, name, length);
    const expression_function *table = words_function(scope, name, length);
    const expression_call *call = expression_find_call(name, length);
    r->words.at += length;
    if (axis >= 0) {
        r->has_place = true;
        return add_step(r, &(expression_step){.kind = STEP_COORDINATE, .coordinate = axis}, &metre);
    }
    if (length == 1 && *name == 't') {
        r->has_time = true;
        return add_step(r, &(expression_step){.kind = STEP_TIME}, &second);
    }
    if (length == 2 && strncmp(name, "pi", 2) == 0) return add_number(r, 3.14159265358979323846, &unknown);
    if (constant) {
        r->words.has_unit = r->words.has_unit || constant->dimension.known;
        return add_number(r, constant->value, &constant->dimension);
    }
    if (table) {
        if (!read_arguments(r, name, length, 1)) return false;
        r->depth--;
        return add_step(r, &(expression_step){.kind = STEP_TABLE, .curve = table->curve}, &unknown);
    }
    if (call) return read_arguments(r, name, length, call->arguments) && add_call(r, call, name);
    return refuse_name(r, name, length);
}

/* A number, a name, or a formula in brackets. */
static bool read_primary(formula_reader *r)
{
    words_skip_blanks(&r->words);
    const size_t length = words_name(&r->words);
    if (length > 0) return read_name(r, length);
    if (words_take(&r->words, "(")) {
        const char *open = r->words.at - 1;
        if (!read_formula(r)) return false;
        return words_take(&r->words, ")") || words_refuse(&r->words, open, "this bracket is not closed");
    }
    double number;
    expression_dimension dimension;
    return words_number(&r->words, &number, &dimension) && add_number(r, number, &dimension);
}

static bool read_power(formula_reader *r)
{
    if (!read_primary(r)) return false;
    const char *place = r->words.at;
    if (!words_take(&r->words, "**") && !words_take(&r->words, "^")) return true;
    return read_factor(r) && add_call(r, expression_operator("^"), place);
}

static bool read_factor(formula_reader *r)
{
    if (++r->brackets > MOST_BRACKETS)
        return words_refuse(&r->words, r->words.at, "too many brackets or signs in each other");
    words_skip_blanks(&r->words);
    const char *place = r->words.at;
    const bool negative = words_take(&r->words, "-"),
               good = negative || words_take(&r->words, "+") ? read_factor(r) : read_power(r);
    --r->brackets;
    return good && (!negative || add_call(r, expression_operator("negative"), place));
}

/* Operands of one level with the operators between them, from left to right; `most`: operators that it may have. */
static bool read_chain(formula_reader *r, bool (*operand)(formula_reader *r), const char *const *signs, int most)
{
    if (!operand(r)) return false;
    for (int n = 0; n < most; ++n) {
        const char *const *sign = signs;
        words_skip_blanks(&r->words);
        const char *place = r->words.at;
        const bool letters = words_name(&r->words) > 0;
        while (*sign && !(letters ? words_take_word(&r->words, *sign) : words_take(&r->words, *sign))) ++sign;
        if (!*sign) return true;
        if (!operand(r) || !add_call(r, expression_operator(*sign), place)) return false;
    }
    return true;
}

static bool read_product(formula_reader *r)
{
    static const char *const signs[] = {"*", "/", NULL};
    return read_chain(r, read_factor, signs, MOST_STEPS);
}

static bool read_sum(formula_reader *r)
{
    static const char *const signs[] = {"+", "-", NULL};
    return read_chain(r, read_product, signs, MOST_STEPS);
}

static bool read_comparison(formula_reader *r)
{
    static const char *const signs[] = {"<=", ">=", "==", "!=", "<", ">", NULL};
    const char *place = r->words.at;
    if (!words_take_word(&r->words, "not")) return read_chain(r, read_sum, signs, 1);
    if (++r->brackets > MOST_BRACKETS)
        return words_refuse(&r->words, place, "too many brackets or signs in each other");
    const bool good = read_comparison(r) && add_call(r, expression_operator("not"), place);
    --r->brackets;
    return good;
}

static bool read_and(formula_reader *r)
{
    static const char *const signs[] = {"and", NULL};
    return read_chain(r, read_comparison, signs, MOST_STEPS);
}

static bool read_formula(formula_reader *r)
{
    static const char *const signs[] = {"or", NULL};
    return read_chain(r, read_and, signs, MOST_STEPS);
}

static bool read_whole(formula_reader *r)
{
    if (!read_formula(r)) return false;
    words_skip_blanks(&r->words);
    return *r->words.at == '\0' || words_refuse(&r->words, r->words.at, "the formula is over before its end");
}

static floe_status keep_formula(context *ctx, const formula_reader *r, expression *e)
{
    e->n = r->n;
    e->has_place = r->has_place;
    e->has_time = r->has_time;
    TRY(memory_new(ctx, &e->step, r->n, sizeof *e->step));
    memcpy(e->step, r->step, r->n * sizeof *e->step);
    return memory_string(ctx, &e->text, r->words.text);
}

static floe_status create_from(context *ctx, const formula_reader *r, expression **out)
{
    TRY(memory_new(ctx, out, 1, sizeof **out));
    const floe_status status = keep_formula(ctx, r, *out);
    if (status != FLOE_OK) expression_destroy(ctx, out);
    return status;
}

floe_status expression_create(context *ctx, const char *text, const expression_scope *scope, expression **out,
                              expression_dimension *dimension, char why[EXPRESSION_WHY])
{
    formula_reader *r;
    *out = NULL;
    TRY(memory_new(ctx, &r, 1, sizeof *r));
    r->words = (expression_words){.text = text, .at = text, .scope = scope, .why = why};
    floe_status status = read_whole(r) ? create_from(ctx, r, out) : FLOE_BAD_INPUT;
    if (dimension) *dimension = r->words.has_unit ? r->dimension[0] : (expression_dimension){.known = false};
    memory_free(ctx, &r);
    return status;
}
