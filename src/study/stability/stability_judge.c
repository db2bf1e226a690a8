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

enum { TIME, KINETIC, STRAIN, INTERNAL, BOUNDARY, SOURCE, COLUMNS };

/* What motion and strain can have, by a row. */
static double available_energy(const double first[COLUMNS], const double row[COLUMNS])
{
    const double came = row[BOUNDARY] + row[SOURCE], given = first[INTERNAL] - row[INTERNAL];
    return first[KINETIC] + first[STRAIN] + fmax(came, 0.0) + fmax(given, 0.0);
}

energy_record energy_read(const csv_table *history)
{
    static const char *const name[COLUMNS] = {
        "time", "kinetic", "strain", "internal", "ledger_energy_boundary", "ledger_energy_source"};
    const csv_column *column[COLUMNS];
    double first[COLUMNS] = {0}, most = 0.0;
    energy_record e = {.judged = true, .finite = true};
    for (int c = 0; c < COLUMNS; c++) {
        column[c] = csv_find(history, name[c]);
        e.judged = e.judged && column[c];
    }
    for (size_t i = 0; e.judged && i < history->n_rows; i++) {
        double row[COLUMNS];
        for (int c = 0; c < COLUMNS; c++) {
            row[c] = column[c]->value[i];
            e.finite = e.finite && isfinite(row[c]);
        }
        if (e.rows++ == 0) memcpy(first, row, sizeof first);
        e.last_time = row[TIME];
        most = fmax(most, fmax(available_energy(first, row), round_off * fabs(first[INTERNAL])));
        const double now = row[KINETIC] + row[STRAIN];
        if (now > 0.0) e.ratio = fmax(e.ratio, now / most);
    }
    return e;
}
