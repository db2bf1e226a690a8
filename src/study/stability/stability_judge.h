/* What a run says about stability: its status, its rejected steps, and the energies of its history. */
#ifndef STUDY_STABILITY_JUDGE_H
#define STUDY_STABILITY_JUDGE_H

#include "io/csv.h"

#include <stdbool.h>

typedef enum verdict {
    VERDICT_STABLE,
    VERDICT_REJECTED,   /* steps were rejected, and the run came to its end */
    VERDICT_GROWS,      /* more energy of motion and strain than there can be */
    VERDICT_NOT_FINITE, /* an energy is no number */
    VERDICT_DIVERGED,
    VERDICT_NONE, /* no verdict: the run failed, or was stopped */
    VERDICT_COUNT
} verdict;

/* "stable", "rejected steps", "energy grows", "not finite", "diverged", "no verdict". */
const char *verdict_name(verdict v);
/* One character for maps: '.', 'r', '^', '!', 'D', '?'. */
char verdict_sign(verdict v);

/* The energies of a history. */
typedef struct energy_record {
    bool judged;      /* false: the history has no energies */
    bool finite;      /* every energy is a number */
    double ratio;     /* the largest of kinetic and strain energy over what there can be; see energy_read */
    double last_time; /* s, of the last row */
    long rows;
} energy_record;

/* Of a history.csv. What kinetic and strain energy can come from is the most, up to each row, of: their
 * sum at the start, plus what the ledger says has come in by boundaries and sources, plus what internal energy has
 * fallen by. The ratio of a stable run stays near one, however much energy gases hold. Round-off of internal energy
 * (1e-9 of it) counts as there. */
energy_record energy_read(const csv_table *history);

/* Says in words what makes a run stable. */
enum { CRITERION_TEXT = 512 };
void criterion_text(double growth, bool by_energy, char text[CRITERION_TEXT]);

#endif
