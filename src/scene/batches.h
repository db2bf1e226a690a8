/* What a deck says of batches of runs: the axes of compare, study and stability, and what their cases must reach. The
 * scene leads here by a pointer; only the deck and the batches look. */
#ifndef SCENE_BATCHES_H
#define SCENE_BATCHES_H

#include "scene/scene.h"

enum {
    SCENE_MAX_AXIS = 32, /* values of an axis */
    SCENE_MAX_AXES = 6,
    SCENE_MAX_WITH = 12, /* keys that change along with that of an axis */
    SCENE_MAX_OVER = 2,
    SCENE_MAX_BARS = 64, /* and of checks, and of refusals */
    SCENE_WHY = 256
};

/* Sizes of a deck key, of its value as YAML text, and of both as "KEY=VALUE". */
enum { SCENE_KEY = 128, SCENE_VALUE = 96, SCENE_SETTING = SCENE_KEY + SCENE_VALUE };

typedef struct scene_values { /* a key that changes along with that of an axis */
    char key[SCENE_KEY];
    char value[SCENE_MAX_AXIS][SCENE_VALUE]; /* one for each value of the axis */
} scene_values;

typedef struct scene_axis { /* one axis of `compare`, `study` or `stability` */
    char key[SCENE_KEY];    /* deck key */
    char value[SCENE_MAX_AXIS][SCENE_VALUE];
    int n_values;
    scene_values with[SCENE_MAX_WITH];
    int n_with;
} scene_axis;

typedef struct scene_where { /* cases of a study: those in which these axes have these values; n = 0: all */
    char key[SCENE_MAX_AXES][SCENE_KEY], value[SCENE_MAX_AXES][SCENE_VALUE];
    int n;
} scene_where;

typedef struct scene_bar { /* what a study must reach */
    char metric[SCENE_NAME];
    double order; /* at least; NAN: no bar */
    double error; /* at most, in the metric's unit; NAN: no bar */
    scene_where where;
} scene_bar;

typedef struct scene_check { /* a condition that every case must satisfy */
    /* An error, drift_mass, drift_momentum, drift_energy, or a column of history.csv in all its rows. */
    char of[SCENE_NAME];
    double at;          /* of a column: at this share of the run's time, not in all rows; NAN: in all rows */
    bool change;        /* of a column: less its value in the first row */
    double least, most; /* NAN: no bound */
    scene_where where;
} scene_check;

typedef struct scene_refusal { /* cases that may be refused */
    char why[SCENE_WHY];
    scene_where where;
} scene_refusal;

typedef struct scene_unchanged { /* spoilers (run/spoil.h) that leave the right answer as it is */
    char by[SCENE_NAME];         /* their names, blanks between them */
    char why[SCENE_WHY];
    scene_where where;
} scene_unchanged;

typedef struct scene_study {
    bool given;                      /* the deck says something of it */
    scene_axis axis[SCENE_MAX_AXES]; /* crossed; the first varies slowest */
    int n_axes;
    char over[SCENE_KEY]; /* axis that orders are taken over; "": domain.cell, else the first axis of numbers */
    int repeat;           /* timed runs of each case, alone on one thread; the best counts; 0: none */
    double max_wall;      /* s of each case; 0: no limit */
    char quantity[SCENE_MAX_METRICS][SCENE_NAME]; /* columns of history.csv whose last values are extrapolated */
    int n_quantities;
    scene_bar bar[SCENE_MAX_BARS];
    int n_bars;
    scene_check check[SCENE_MAX_BARS];
    int n_checks;
    scene_refusal refusal[SCENE_MAX_BARS];
    int n_refusals;
    scene_unchanged unchanged[SCENE_MAX_BARS];
    int n_unchanged;
} scene_study;

typedef struct scene_stability {
    bool given; /* the deck says something of it */
    /* One: a search, its values from and to; two: a map; none: the command line says. */
    scene_axis over[SCENE_MAX_OVER];
    int n_over;
    scene_axis each[SCENE_MAX_AXES]; /* crossed; the search is made for every combination */
    int n_each;
    double tolerance;   /* of the limit, relative */
    double growth;      /* of energy over what there can be */
    double relative_to; /* what limits are shown over; NAN: nothing */
} scene_stability;

typedef struct scene_batches {
    scene_axis compare;        /* axis of `floe compare` */
    scene_study study;         /* of `floe study` */
    scene_stability stability; /* of `floe stability` */
} scene_batches;

/* How many keys an axis sets: its own, and those that change along with it. */
int scene_axis_settings(const scene_axis *axis);
/* "KEY=VALUE" of the k-th of them, its own first, at the axis' value number `pick`. */
void scene_axis_setting(const scene_axis *axis, int k, int pick, char text[SCENE_SETTING]);

#endif
