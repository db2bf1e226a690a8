/* The only file that sees udunits2. */
#include "deck/units.h"

#include "deck/deck.h"

#include <udunits2.h>

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

/* The parsers of udunits2, of its database and of units, are the whole process's: whoever is in them holds this. */
static pthread_mutex_t udunits = PTHREAD_MUTEX_INITIALIZER;

void deck_init(void)
{
    ut_set_error_message_handler(ut_ignore);
}

static bool open_book(unit_book *book, char *why)
{
    if (!book->system) book->system = ut_read_xml(NULL);
    if (!book->system) {
        snprintf(why, WHY_SIZE,
                 "the unit database of udunits2 cannot be read (package libudunits2-data; UDUNITS2_XML_PATH)");
    }
    return book->system != NULL;
}

static bool convert(const ut_unit *from_unit, const ut_unit *to_unit, double *x, const char *from, const char *to,
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

static bool convert_named(unit_book *book, double *x, const char *from, const char *to, char *why)
{
    if (!open_book(book, why)) return false;
    ut_unit *from_unit = ut_parse(book->system, from, UT_UTF8);
    ut_unit *to_unit = ut_parse(book->system, to, UT_UTF8);
    bool ok = false;
    if (!from_unit) {
        snprintf(why, WHY_SIZE, "unit '%.40s' is not known", from);
    } else if (!to_unit) {
        snprintf(why, WHY_SIZE, "floe's own unit '%.40s' is not known: please report it", to);
    } else {
        ok = convert(from_unit, to_unit, x, from, to, why);
    }
    ut_free(from_unit);
    ut_free(to_unit);
    return ok;
}

bool units_convert(unit_book *book, double *x, const char *from, const char *to, char *why)
{
    (void)pthread_mutex_lock(&udunits);
    const bool ok = convert_named(book, x, from, to, why);
    (void)pthread_mutex_unlock(&udunits);
    return ok;
}

void units_close(unit_book *book)
{
    if (!book->system) return;
    (void)pthread_mutex_lock(&udunits);
    ut_free_system(book->system);
    (void)pthread_mutex_unlock(&udunits);
    book->system = NULL;
}
