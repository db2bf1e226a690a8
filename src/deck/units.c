/* The only file that sees udunits2. */
#include "deck/units.h"

#include "deck/deck.h"

#include <udunits2.h>

#include <math.h>
#include <pthread.h>
#include <stdio.h>
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

static bool convert_unit(const ut_unit *from_unit, const ut_unit *to_unit, double *x, const char *from, const char *to,
                         char *why)
{
    if (!ut_are_convertible(from_unit, to_unit)) {
        const bool none = strcmp(to, "1") == 0;
        snprintf(why, WHY_SIZE, "unit '%.40s' does not fit: %s%s", from,
                 none ? "the number has no dimension" : "it does not convert to ", none ? "" : to);
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
