#include "expression/expression_words.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const expression_dimension unknown = {.known = false};

bool words_refuse(expression_words *w, const char *place, const char *format, ...)
{
    char what[140];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    snprintf(w->why, EXPRESSION_WHY, "%s (at '%.24s', character %zu)", what, *place ? place : "the end",
             (size_t)(place - w->text) + 1);
    return false;
}

void words_skip_blanks(expression_words *w)
{
    while (isspace((unsigned char)*w->at)) w->at++;
}

bool words_take(expression_words *w, const char *sign)
{
    words_skip_blanks(w);
    if (strncmp(w->at, sign, strlen(sign)) != 0) return false;
    w->at += strlen(sign);
    return true;
}

static bool is_letter(char c)
{
    return isalpha((unsigned char)c) || c == '_';
}

static bool is_of_name(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

size_t words_name(const expression_words *w)
{
    size_t n = 0;
    if (!is_letter(w->at[0])) return 0;
    while (is_of_name(w->at[n])) n++;
    return n;
}

bool words_take_word(expression_words *w, const char *word)
{
    words_skip_blanks(w);
    if (words_name(w) != strlen(word) || strncmp(w->at, word, strlen(word)) != 0) return false;
    w->at += strlen(word);
    return true;
}

static bool is_name(const char *name, size_t length, const char *other)
{
    return other && strlen(other) == length && strncmp(name, other, length) == 0;
}

int words_coordinate(const expression_scope *scope, const char *name, size_t length)
{
    for (int a = 0; a < 3; ++a)
        if (is_name(name, length, scope->axis[a])) return a;
    return -1;
}

const expression_constant *words_constant(const expression_scope *scope, const char *name, size_t length)
{
    for (size_t i = 0; i < scope->n_constants; ++i)
        if (is_name(name, length, scope->constant[i].name)) return &scope->constant[i];
    return NULL;
}

const expression_function *words_function(const expression_scope *scope, const char *name, size_t length)
{
    for (size_t i = 0; i < scope->n_functions; ++i)
        if (is_name(name, length, scope->function[i].name)) return &scope->function[i];
    return NULL;
}

bool words_known(const expression_scope *scope, const char *name, size_t length)
{
    return words_coordinate(scope, name, length) >= 0 || is_name(name, length, "t") || is_name(name, length, "pi") ||
           words_constant(scope, name, length) || words_function(scope, name, length) ||
           expression_find_call(name, length);
}

/* Letters and what follows a letter in a unit: "m2", "µs", "degC", "J.s". */
static size_t unit_word(const char *text)
{
    size_t n = 0;
    const unsigned char first = (unsigned char)text[0];
    if (!is_letter(text[0]) && first < 0x80 && first != '%') return 0;
    while (is_of_name(text[n]) || (unsigned char)text[n] >= 0x80 || text[n] == '%' ||
           (text[n] == '.' && is_letter(text[n + 1])))
        n++;
    return n;
}

/* Length of the power of a unit: "^2", "^-1". It is of the unit, not of the number before it, as where a number stands alone: 4 m/s^2. */
static size_t unit_power(const char *text)
{
    size_t n = text[0] == '^' ? 1 : 0;
    if (n == 1 && text[n] == '-') n++;
    if (n == 0 || !isdigit((unsigned char)text[n])) return 0;
    while (isdigit((unsigned char)text[n])) n++;
    return n;
}

/* Length of the unit that comes next: words with slashes between, and no blanks; a name of the formula behind a slash is
 * what the number is divided by. */
static size_t unit_length(const expression_words *w)
{
    const bool inverse = strncmp(w->at, "1/", 2) == 0; /* "5 1/s" */
    size_t n = inverse ? 1 : unit_word(w->at);
    if (n > 0) n += unit_power(w->at + n);
    while (n > 0 && w->at[n] == '/') {
        const size_t next = unit_word(w->at + n + 1);
        if (next == 0 || words_known(w->scope, w->at + n + 1, next)) break;
        n += 1 + next;
        n += unit_power(w->at + n);
    }
    return inverse && n == 1 ? 0 : n;
}

static bool is_keyword(const char *text, size_t n)
{
    return is_name(text, n, "and") || is_name(text, n, "or");
}

static bool take_unit(expression_words *w, double *value, expression_dimension *dimension)
{
    char unit[64], why[EXPRESSION_WHY];
    const char *from = w->at;
    words_skip_blanks(w);
    const size_t n = unit_length(w);
    if (n == 0 || is_keyword(w->at, unit_word(w->at))) return true;
    if (w->at == from)
        return words_refuse(w, from, "no blank between a number and its unit, or no sign between two factors");
    if (words_known(w->scope, w->at, unit_word(w->at)))
        return words_refuse(w, w->at, "no sign between two factors: write a *");
    if (n >= sizeof unit) return words_refuse(w, w->at, "the unit is too long");
    if (!w->scope->unit) return words_refuse(w, w->at, "a unit in a deck with 'units: none'");
    snprintf(unit, sizeof unit, "%.*s", (int)n, w->at);
    if (!w->scope->unit(unit, *value, value, dimension, why)) return words_refuse(w, w->at, "%s", why);
    w->at += n;
    w->has_unit = true;
    return true;
}

/* Length of digits [. digits] [e [+-] digits]. */
static size_t number_length(const char *text)
{
    size_t n = 0, digits = 0;
    for (; isdigit((unsigned char)text[n]); ++n) ++digits;
    if (text[n] == '.') ++n;
    for (; isdigit((unsigned char)text[n]); ++n) ++digits;
    if (digits == 0) return 0;
    if (text[n] != 'e' && text[n] != 'E') return n;
    const size_t sign = text[n + 1] == '+' || text[n + 1] == '-';
    if (!isdigit((unsigned char)text[n + 1 + sign])) return n;
    n += 1 + sign;
    while (isdigit((unsigned char)text[n])) ++n;
    return n;
}

bool words_number(expression_words *w, double *value, expression_dimension *dimension)
{
    const size_t n = number_length(w->at);
    *dimension = unknown;
    if (n == 0) return words_refuse(w, w->at, *w->at ? "no number, name or bracket" : "something is missing");
    *value = strtod(w->at, NULL);
    if (!isfinite(*value)) return words_refuse(w, w->at, "a number that is too large for a double");
    w->at += n;
    return take_unit(w, value, dimension);
}
