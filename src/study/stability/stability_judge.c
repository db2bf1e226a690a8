#include "study/stability/stability_judge.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double round_off = 1e-9; /* of the internal energy, in what motion takes from it and gives back */

const char *verdict_name(verdict v)
{
    static const char *const name[VERDICT_COUNT] = {
        [VERDICT_STABLE] = "stable",         [VERDICT_REJECTED] = "rejected steps", [VERDICT_GROWS] = "energy grows",
        [VERDICT_NOT_FINITE] = "not finite", [VERDICT_DIVERGED] = "diverged",       [VERDICT_NONE] = "no verdict",
    };
    return name[v];
}

char verdict_sign(verdict v)
{
    static const char sign[VERDICT_COUNT] = {
        [VERDICT_STABLE] = '.',     [VERDICT_REJECTED] = 'r', [VERDICT_GROWS] = '^',
        [VERDICT_NOT_FINITE] = '!', [VERDICT_DIVERGED] = 'D', [VERDICT_NONE] = '?',
    };
    return sign[v];
}

void criterion_text(double growth, bool by_energy, char text[CRITERION_TEXT])
{
    char energy[256];
    (void)snprintf(
        energy, sizeof energy,
        "kinetic and strain energy stay below %g times what they had at the start, what came in by boundaries and "
        "sources, and what internal energy gave",
        growth);
    (void)snprintf(
        text, CRITERION_TEXT, "stable: the run comes to its end, no step is rejected, every energy is finite%s%s",
        by_energy ? ", and " : "",
        by_energy ? energy : "; growth of energy is not judged, for the work of forces on bodies is in no ledger");
}

typedef enum column { TIME, KINETIC, STRAIN, INTERNAL, BOUNDARY, SOURCE, COLUMNS } column;

/* The end of a field: a comma or the end of the line, none in quotes. */
static const char *field_end(const char *at)
{
    for (bool quoted = false; *at && *at != '\n' && (quoted || *at != ','); at++) quoted = quoted != (*at == '"');
    return at;
}

/* Which of the columns a name with its unit is, "kinetic (J)"; COLUMNS: none. */
static column column_of(const char *name, size_t length)
{
    static const char *const known[COLUMNS] = {
        "time", "kinetic", "strain", "internal", "ledger_energy_boundary", "ledger_energy_source"};
    for (int c = 0; c < COLUMNS; c++) {
        const size_t n = strlen(known[c]);
        if (length > n && strncmp(name, known[c], n) == 0 && strncmp(name + n, " (", 2) == 0) return (column)c;
    }
    return COLUMNS;
}

/* Reads the names; place[c] is the index of column c, -1 if it is missing. Returns the start of the first row. */
static const char *read_names(const char *at, int place[COLUMNS])
{
    for (int c = 0; c < COLUMNS; c++) place[c] = -1;
    for (int i = 0; *at && *at != '\n'; i++) {
        const char *end = field_end(at);
        const column c = column_of(at, (size_t)(end - at));
        if (c != COLUMNS) place[c] = i;
        at = *end == ',' ? end + 1 : end;
    }
    return *at ? at + 1 : at;
}

static const char *read_row(const char *at, const int place[COLUMNS], double value[COLUMNS])
{
    for (int i = 0; *at && *at != '\n'; i++) {
        for (int c = 0; c < COLUMNS; c++) {
            if (place[c] == i) value[c] = strtod(at, NULL);
        }
        const char *end = field_end(at);
        at = *end == ',' ? end + 1 : end;
    }
    return *at ? at + 1 : at;
}

/* What motion and strain can have, by a row. */
static double available(const double first[COLUMNS], const double row[COLUMNS])
{
    const double came = row[BOUNDARY] + row[SOURCE], given = first[INTERNAL] - row[INTERNAL];
    return first[KINETIC] + first[STRAIN] + fmax(came, 0.0) + fmax(given, 0.0);
}

energy_record energy_read(const char *text)
{
    int place[COLUMNS];
    double first[COLUMNS] = {0}, most = 0.0;
    energy_record e = {.judged = true, .finite = true};
    const char *at = read_names(text, place);
    for (int c = 0; c < COLUMNS; c++) e.judged = e.judged && place[c] >= 0;
    while (e.judged && *at) {
        double row[COLUMNS] = {0};
        at = read_row(at, place, row);
        for (int c = 0; c < COLUMNS; c++) e.finite = e.finite && isfinite(row[c]);
        if (e.rows++ == 0) memcpy(first, row, sizeof first);
        e.last_time = row[TIME];
        most = fmax(most, fmax(available(first, row), round_off * fabs(first[INTERNAL])));
        const double now = row[KINETIC] + row[STRAIN];
        if (now > 0.0) e.ratio = fmax(e.ratio, now / most);
    }
    return e;
}
