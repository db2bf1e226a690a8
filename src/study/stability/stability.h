/* `floe stability`: up to which value of a key a scene is stable, by bisection; or a map of two keys.
 *
 * Each value is a run of its own, in a folder of its own; one that has ended is not run again. */
#ifndef STUDY_STABILITY_H
#define STUDY_STABILITY_H

#include "batch/batch.h"
#include "study/stability/stability_judge.h"
#include "study/stability/stability_search.h"

enum { STABILITY_UNIT = 32, STABILITY_LABEL = 640 };

typedef struct stability_options {
    /* Deck, folder of the results, program, stop and progress; of each run its threads and max_wall; jobs, on which no
     * limit depends. The rest is the search's. */
    batch_options batch;
    deck_overrides set;
    const char *const *over; /* "KEY", "KEY=FROM:TO", or two of "KEY=V1,V2,..."; n_over 0: the deck's stability.over */
    size_t n_over;
    const char *const *each; /* "KEY=V1,V2,...": the search is made for every combination; n_each 0: the deck's */
    size_t n_each;
    double tolerance, growth, relative_to; /* 0: the deck's */
} stability_options;

/* One run. */
typedef struct stability_probe {
    size_t set;               /* which combination of `each` */
    double x[SCENE_MAX_OVER]; /* NAN for a word */
    double wanted;            /* of a search: the value that it asked for, of which x is what the deck was given */
    char value[SCENE_MAX_OVER][SCENE_VALUE];
    char folder[256]; /* in the search's */
    verdict verdict;
    char cause[BATCH_MESSAGE]; /* in words, "" where it is stable */
    energy_record energy;
    long long steps, rejected;
    double time; /* s, reached */
} stability_probe;

/* One combination of `each`, and what was found for it. */
typedef struct stability_set {
    int value[SCENE_MAX_AXES]; /* index of each axis' value */
    search search;             /* unused by maps */
    bool broken;               /* a run gave no verdict: the search has ended there */
} stability_set;

typedef struct stability {
    context *ctx;       /* not owned */
    char *deck_path;    /* owned */
    char *dir;          /* owned */
    bool dimensionless; /* the deck says `units: none` */
    char title[256];
    scene_axis over[SCENE_MAX_OVER]; /* a search: one, its values are not used; a map: two */
    int n_over;
    scene_axis each[SCENE_MAX_AXES];
    int n_each;
    char unit[STABILITY_UNIT]; /* of the values of a search, " ms" or "" */
    double tolerance, growth;
    double relative_to; /* what values are shown over; NAN: nothing */
    bool by_energy;     /* growth of energy is judged */
    stability_set *set; /* owned */
    size_t n_sets;
    stability_probe *probe; /* owned; in the order in which they were run */
    size_t n_probes;
} stability;

/* Searches, or maps, and writes its results and the figure. Everything that can be refused is before the first run:
 * FLOE_BAD_INPUT. FLOE_INTERRUPTED: what there is was written, and the same command goes on from there. A run that
 * gives no verdict (killed, out of time) ends its search; the status is then that run's. *out (owned by the caller) may
 * be there after a failure. */
floe_status stability_run(stability **out, context *ctx, const stability_options *options);
void stability_destroy(stability **s);

bool stability_is_map(const stability *s);
/* "method.stress=usl, domain.lattice_offset=0"; "" without `each`. */
void stability_set_label(const stability *s, size_t set, char label[STABILITY_LABEL]);
/* The probe of a cell of a map, NULL if it was not run. */
const stability_probe *stability_cell(const stability *s, size_t set, int first, int second);

/* The probes, the limits or the map, and the criterion. */
floe_status stability_print(const stability *s, FILE *file);
/* stability.json, stability.csv (the runs) and, for a search, limits.csv. */
floe_status stability_write(const stability *s);
/* energy.svg (energy over value) or map.svg, with data and script beside it. */
floe_status stability_plot(const stability *s);

#endif
