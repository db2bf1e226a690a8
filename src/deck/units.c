/* The only file that sees udunits2. */
#include "deck/units.h"

#include "base/text.h"
#include "deck/deck.h"

#include <udunits2.h>

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The parsers of udunits2, of its database and of units, are the whole process's, and so are the units that it knows, once read: whoever is
 * in them holds the lock. Reading takes 5 ms, as long as half of a deck's loading, and they never change. */
static struct unit_book {
    pthread_mutex_t lock;
    ut_system *system; /* NULL until a number carries a unit; then for the rest of the process */
} book = {.lock = PTHREAD_MUTEX_INITIALIZER};

void deck_init(void)
{
    ut_set_error_message_handler(ut_ignore);
}

static bool open_book(char *why)
{
    if (!book.system) book.system = ut_read_xml(NULL);
    if (!book.system) {
        snprintf(why, WHY_SIZE,
                 "the unit database of udunits2 cannot be read (package libudunits2-data; UDUNITS2_XML_PATH)");
    }
    return book.system != NULL;
}

typedef struct mistaken_unit {
    const char *written, *meant;
} mistaken_unit;

/* " (did you mean 'MPa'?)": names that are another unit, or none. */
static void add_meant_unit(const char *written, char *why)
{
    static const mistaken_unit known[] = {
        {"C", "degC"},  {"F", "degF"},  {"Celsius", "degC"}, {"Kelvin", "K"}, {"k", "K"},     {"mpa", "MPa"},
        {"Mpa", "MPa"}, {"MPA", "MPa"}, {"kpa", "kPa"},      {"Kpa", "kPa"},  {"KPa", "kPa"}, {"KPA", "kPa"},
        {"gpa", "GPa"}, {"Gpa", "GPa"}, {"GPA", "GPa"},      {"pa", "Pa"},    {"PA", "Pa"},   {"Bar", "bar"},
        {"BAR", "bar"}, {"MM", "mm"},   {"Mm", "mm"},        {"S", "s"},      {"mS", "ms"},   {"MS", "ms"},
        {"Ms", "ms"},   {"M", "m"},     {"l/s", "litre/s"},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (strcmp(known[i].written, written) == 0) text_add(why, WHY_SIZE, " (did you mean '%s'?)", known[i].meant);
}

static bool convert_unit(const ut_unit *from_unit, const ut_unit *to_unit, double *x, const char *from, const char *to,
                         char *why)
{
    if (!ut_are_convertible(from_unit, to_unit)) {
        const bool none = strcmp(to, "1") == 0;
        snprintf(why, WHY_SIZE, "unit '%.40s' does not fit: %s%s", from,
                 none ? "the number has no dimension" : "it does not convert to ", none ? "" : to);
        add_meant_unit(from, why);
        return false;
    }
    cv_converter *converter = ut_get_converter((ut_unit *)from_unit, (ut_unit *)to_unit);
    if (!converter) {
        snprintf(why, WHY_SIZE, "unit '%.40s' cannot be converted to %s", from, to);
        return false;
    }
    const double given = *x;
    *x = cv_convert_double(converter, given);
    cv_free(converter);
    if (isfinite(*x) && (*x != 0.0 || given == 0.0 || strstr(from, "deg"))) return true;
    snprintf(why, WHY_SIZE, "the number is too large or too small once it is in %s", to);
    return false;
}

static bool convert_named(double *x, const char *from, const char *to, char *why)
{
    if (!open_book(why)) return false;
    ut_unit *from_unit = ut_parse(book.system, from, UT_UTF8);
    ut_unit *to_unit = ut_parse(book.system, to, UT_UTF8);
    bool ok = false;
    if (!from_unit) {
        snprintf(why, WHY_SIZE, "unit '%.40s' is not known", from);
        add_meant_unit(from, why);
    } else if (!to_unit) {
        snprintf(why, WHY_SIZE, "floe's own unit '%.40s' is not known: please report it", to);
    } else {
        ok = convert_unit(from_unit, to_unit, x, from, to, why);
    }
    ut_free(from_unit);
    ut_free(to_unit);
    return ok;
}

bool units_convert(double *x, const char *from, const char *to, char *why)
{
    (void)pthread_mutex_lock(&book.lock);
    const bool ok = convert_named(x, from, to, why);
    (void)pthread_mutex_unlock(&book.lock);
    return ok;
}

/* Exponents of the base units that a definition of udunits2 names, "m-1.kg.s-2" behind a factor. */
static void read_base_units(const char *text, expression_dimension *dimension)
{
    static const char *const base[] = {"m", "kg", "s", "K", "mol", "A", "cd"};
    *dimension = (expression_dimension){.known = true};
    for (const char *at = text; *at;) {
        const size_t letters = strspn(at, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
        if (letters == 0) {
            at++;
            continue;
        }
        char *end;
        const long power = strtol(at + letters, &end, 10);
        const signed char exponent = (signed char)(end == at + letters ? 1 : power);
        for (size_t i = 0; i < sizeof base / sizeof base[0]; i++)
            if (strlen(base[i]) == letters && strncmp(at, base[i], letters) == 0)
                dimension->power[i] = (signed char)(dimension->power[i] + exponent);
        at = end;
    }
}

/* Converts to the base units alone: those of the definition, without its factor and origin. */
static bool convert_to_base(const ut_unit *unit, const char *name, double *value, expression_dimension *dimension,
                            char *why)
{
    char definition[200], base[200] = "";
    const int n = ut_format(unit, definition, sizeof definition, UT_ASCII | UT_DEFINITION);
    if (n < 0 || (size_t)n >= sizeof definition) {
        snprintf(why, WHY_SIZE, "unit '%.40s' is not known", name);
        return false;
    }
    read_base_units(definition, dimension);
    static const char *const si[] = {"m", "kg", "s", "K", "mol", "A", "cd"};
    for (size_t i = 0; i < sizeof si / sizeof si[0]; i++)
        if (dimension->power[i] != 0)
            text_add(base, sizeof base, "%s%s%d", base[0] ? "." : "", si[i], dimension->power[i]);
    ut_unit *to = ut_parse(book.system, base[0] ? base : "1", UT_ASCII);
    const bool ok = to && convert_unit(unit, to, value, name, base[0] ? base : "1", why);
    if (!to) snprintf(why, WHY_SIZE, "unit '%.40s' is not known", name);
    ut_free(to);
    return ok;
}

static bool convert_given(const char *name, double *value, expression_dimension *dimension, char *why)
{
    if (!open_book(why)) return false;
    ut_unit *unit = ut_parse(book.system, name, UT_UTF8);
    if (!unit) {
        snprintf(why, WHY_SIZE, "unit '%.40s' is not known", name);
        return false;
    }
    const bool ok = convert_to_base(unit, name, value, dimension, why);
    ut_free(unit);
    return ok;
}

bool units_to_si(const char *unit, double given, double *value, expression_dimension *dimension, char *why)
{
    *value = given;
    (void)pthread_mutex_lock(&book.lock);
    const bool ok = convert_given(unit, value, dimension, why);
    (void)pthread_mutex_unlock(&book.lock);
    return ok;
}
