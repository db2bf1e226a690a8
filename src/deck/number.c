#include "deck/units.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool refuse_number(char *why, const char *text, const char *reason)
{
    snprintf(why, WHY_SIZE, "'%.60s' %s", text, reason);
    return false;
}

static size_t count_digits(const char *text)
{
    size_t n = 0;
    while (isdigit((unsigned char)text[n])) n++;
    return n;
}

/* Length of [+-] digits [. digits] [e [+-] digits], 0 if the text does not start so. */
static size_t number_length(const char *text)
{
    size_t i = text[0] == '+' || text[0] == '-';
    const size_t whole = count_digits(text + i);
    i += whole;
    size_t fraction = 0;
    if (text[i] == '.') {
        fraction = count_digits(text + i + 1);
        if (whole + fraction > 0) i += 1 + fraction;
    }
    if (whole + fraction == 0) return 0;
    if (text[i] != 'e' && text[i] != 'E') return i;
    const size_t sign = text[i + 1] == '+' || text[i + 1] == '-';
    const size_t exponent = count_digits(text + i + 1 + sign);
    return exponent > 0 ? i + 1 + sign + exponent : i;
}

static bool same_word(const char *text, const char *word)
{
    while (*text && tolower((unsigned char)*text) == *word) text++, word++;
    return *text == '\0' && *word == '\0';
}

/* Spellings that other programs take for numbers. */
static bool refuse_strange(const char *text, char *why)
{
    const char *bare = text + (text[0] == '+' || text[0] == '-');
    const char *word = bare + (bare[0] == '.');
    if (same_word(word, "nan")) return refuse_number(why, text, "is not a finite number");
    if (same_word(word, "inf") || same_word(word, "infinity"))
        return refuse_number(why, text, "is not a finite number");
    if (bare[0] == '0' && strchr("xXoObB", bare[1]) && bare[1])
        return refuse_number(why, text, "is not a decimal number");
    if (bare[0] == '0' && isdigit((unsigned char)bare[1])) {
        return refuse_number(why, text, "starts with a zero: octal elsewhere, not taken here");
    }
    return true;
}

bool number_split(const char *text, double *x, const char **unit, char *why)
{
    if (!refuse_strange(text, why)) return false;
    const size_t length = number_length(text);
    if (length == 0) return refuse_number(why, text, "is not a number");
    const char *rest = text + length;
    if (*rest == ',') return refuse_number(why, text, "has a comma: write decimals with a point, 0.05, not 0,05");
    if (*rest && *rest != ' ') {
        const bool letter = isalpha((unsigned char)*rest) && strlen(rest) < 12;
        return refuse_number(why, text, letter ? "has no space between number and unit" : "goes on after the number");
    }
    while (*rest == ' ') rest++;
    if (isdigit((unsigned char)*rest) && strncmp(rest, "1/", 2) != 0)
        return refuse_number(why, text, "goes on after the number");
    errno = 0;
    *x = strtod(text, NULL);
    if (!isfinite(*x)) return refuse_number(why, text, "is too large for a double");
    if (errno == ERANGE && fabs(*x) < 1e-300) return refuse_number(why, text, "is too small for a double");
    *unit = rest;
    return true;
}

bool number_whole(const char *text, long *x, char *why)
{
    if (!refuse_strange(text, why)) return false;
    const size_t sign = text[0] == '+' || text[0] == '-';
    const size_t n = count_digits(text + sign);
    if (n == 0 || text[sign + n] != '\0') return refuse_number(why, text, "is not a whole number");
    errno = 0;
    *x = strtol(text, NULL, 10);
    if (errno == ERANGE) return refuse_number(why, text, "is too large");
    return true;
}
