/* floe as a library.
 *
 * A deck run to its end, with its outputs in a folder, as the command line does it:
 *
 *     floe_context *floe = floe_create();
 *     floe_deck *deck;
 *     floe_run *run;
 *     if (floe_init() == FLOE_OK && floe_load(floe, "sod.yaml", NULL, 0, &deck) == FLOE_OK &&
 *         floe_execute(deck, &(floe_options){.directory = "out/sod"}, &run) == FLOE_OK)
 *         printf("L1 of density: %g\n", floe_value(run, "errors.l1_density"));
 *     else
 *         fprintf(stderr, "%s\n", floe_message(floe));
 *
 * The same deck stepped by the program, in memory alone:
 *
 *     floe_simulation *s;
 *     floe_view p;
 *     if (floe_simulation_create(deck, NULL, &s) == FLOE_OK && floe_advance(s, 0.1) == FLOE_OK &&
 *         floe_field(s, "cells/pressure", 0, &p) == FLOE_OK)
 *         printf("p in the first cell: %g %s\n", p.data[0][0], p.unit);
 *
 * Functions that can fail return a floe_status; floe_message then has the reason. Objects are destroyed before what they
 * were made from: runs and simulations, then decks, then the context. Destroying NULL, or a pointer to NULL, does
 * nothing. Objects of one context must not be used by two threads at once; different contexts may. HDF5 is not
 * thread-safe: only one thread of a program may execute runs, save and restore. Numbers are in SI units. */
#ifndef FLOE_FLOE_H
#define FLOE_FLOE_H

#include "floe/law.h"
#include "floe/status.h"

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#if defined(__GNUC__)
#define FLOE_API __attribute__((visibility("default")))
#else
#define FLOE_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef struct floe_context floe_context;       /* messages, memory, laws */
typedef struct floe_deck floe_deck;             /* a deck that was read */
typedef struct floe_run floe_run;               /* a run and its results */
typedef struct floe_simulation floe_simulation; /* a deck that is being stepped */

/* ---- context ---- */

/* Process-wide settings of the libraries behind floe (HDF5, GSL and udunits report to floe instead of printing or
 * aborting). Once for a process is enough, more often is fine. */
FLOE_API floe_status floe_init(void);
/* "0.2.0" */
FLOE_API const char *floe_version(void);

/* A context, which the caller owns; NULL only when memory is out. */
FLOE_API floe_context *floe_create(void);
FLOE_API void floe_destroy(floe_context **floe);
/* What went wrong in the last call that failed; "" if nothing. Of a deck that is refused: a line for each error, with its
 * place, and at the end how many there are. Owned by the context, valid until the next call. */
FLOE_API const char *floe_message(const floe_context *floe);

typedef enum floe_log_level { FLOE_LOG_ERROR, FLOE_LOG_WARNING, FLOE_LOG_INFO, FLOE_LOG_DETAIL } floe_log_level;
/* Takes a line of the log, without its end; it may come from any thread. The line is floe's, valid during the call. */
typedef void floe_log_function(void *user, floe_log_level level, const char *line);
/* Sends the log, up to `most` detail, to a function; NULL: to nobody, as at the start. */
FLOE_API void floe_log(floe_context *floe, floe_log_function *log, void *user, floe_log_level most);

/* Adds a law of solids, or an equation of state, that decks read with this context from now on may name (floe/law.h). The
 * law is copied; texts and functions that it points to must stay until the context is destroyed. FLOE_BAD_INPUT: a
 * function that is needed is missing, the name is taken, or a parameter lies outside its struct. */
FLOE_API floe_status floe_add_solid_law(floe_context *floe, const floe_solid_law *law);
FLOE_API floe_status floe_add_equation_of_state(floe_context *floe, const floe_equation_of_state *eos);

/* ---- decks ---- */

/* Reads the deck at `path`, with n_set replacements "KEY=VALUE" (`set` may be NULL). The caller owns *deck; it is NULL on
 * failure. FLOE_BAD_INPUT: the message holds all errors. FLOE_IO: the file cannot be read. */
FLOE_API floe_status floe_load(floe_context *floe, const char *path, const char *const *set, size_t n_set,
                               floe_deck **deck);
/* The same of a deck in memory, which `name` stands for in messages. */
FLOE_API floe_status floe_load_text(floe_context *floe, const char *name, const char *text, const char *const *set,
                                    size_t n_set, floe_deck **deck);
/* As floe_load, and every value of the deck's axes (compare, study, stability) must make a deck, too: for whoever writes
 * decks. */
FLOE_API floe_status floe_validate(floe_context *floe, const char *path, const char *const *set, size_t n_set,
                                   floe_deck **deck);
FLOE_API void floe_deck_destroy(floe_deck **deck);

/* What a deck says. Texts are the deck's. */
typedef struct floe_description {
    const char *title;    /* "": none */
    const char *coupling; /* "mpm", "ice" or "ice-mpm" */
    bool dimensionless;   /* `units: none` */
    int dimension;        /* 1, 2 or 3 */
    double cells[3];      /* of the mesh along each axis; 1 along unused ones */
    int materials, bodies;
    bool compares, studies; /* whether `floe compare` and `floe study` have cases */
} floe_description;
FLOE_API floe_description floe_describe(const floe_deck *deck);

/* How a run would begin. */
typedef struct floe_start {
    bool ready;        /* false: it has too many cells and was not made ready */
    double cells;      /* of the mesh */
    double most_cells; /* of a mesh that is made ready */
    size_t points;     /* of material */
    double step;       /* s, the first one */
    double steps;      /* about how many of its kind the run would need */
    const char *limit; /* what limits the step, in words that stay; NULL if it is not ready */
    double bytes;      /* that a scene of too many cells would hold; 0: it has fewer, or that is not known */
    double available;  /* bytes of this machine for it; INFINITY: not known */
} floe_start;
/* Does what a run does before its first step, and leaves it at that; warnings about the scene go to the log. FLOE_BAD_INPUT,
 * FLOE_DIVERGED: what a run would end with. */
FLOE_API floe_status floe_rehearse(floe_deck *deck, floe_start *start);

/* What a run would do and hold: stages of a step with what they read and write, fields with their bytes, memory, disk and
 * steps; as text for people, or as JSON. Of more than a million cells it is estimated from coarser meshes. */
FLOE_API floe_status floe_plan(floe_deck *deck, bool json, FILE *file);

/* ---- what decks can name ---- */

/* The i-th list, "materials", "shapes", ..., and what it is of (`doc` may be NULL); NULL past the last. */
FLOE_API const char *floe_list_name(int i, const char **doc);
/* Writes a list with parameters, units, defaults and sources. FLOE_BAD_INPUT: there is none of that name. */
FLOE_API floe_status floe_list(floe_context *floe, const char *name, FILE *file);

/* ---- runs: from start to end, with outputs ---- */

/* Called around steps; anything but FLOE_OK ends the stepping with that status (FLOE_INTERRUPTED: in order). It may read
 * the simulation, and must neither step nor restore nor destroy it. */
typedef floe_status floe_callback(floe_simulation *s, void *user);

typedef struct floe_options {
    const char *directory;      /* of the results; it is made if it is not there. Needed by floe_execute */
    bool resume;                /* go on from its checkpoint */
    double max_wall;            /* s of wall time, then stop with a checkpoint; 0: no limit */
    int threads;                /* 0: as the deck or OpenMP says. No result depends on it */
    floe_callback *before_step; /* before and after each step; NULL: none */
    floe_callback *after_step;
    void *user; /* handed to both */
    /* Of floe_execute alone: becomes non-zero, as in a handler of signals, when the run is to end in order, with
     * FLOE_INTERRUPTED and a checkpoint; NULL: never. */
    const volatile sig_atomic_t *stop;
    FILE *progress; /* likewise: where progress is shown; NULL: nowhere */
} floe_options;

/* Runs the deck to its end. *run, which the caller owns, holds what was reached, whatever the result; NULL only when
 * memory is out or no directory is named. FLOE_DIVERGED and FLOE_INTERRUPTED leave a checkpoint; FLOE_IO: an output
 * failed; FLOE_BAD_INPUT: the scene is refused, or the deck has a simulation. */
FLOE_API floe_status floe_execute(floe_deck *deck, const floe_options *options, floe_run **run);
FLOE_API void floe_run_destroy(floe_run **run);

/* A number of the run's summary: time, steps, rejected_steps, wall_seconds, cells, points, cell_updates, point_updates,
 * peak_rss_bytes, conservation.mass (momentum, angular_momentum, energy), errors.METRIC, counters.NAME,
 * seconds_by_stage.NAME; NAN if there is none. */
FLOE_API double floe_value(const floe_run *run, const char *name);
/* The i-th metric that has an error ("l1_density": floe_value knows it as "errors.l1_density"); NULL past the last. Owned by
 * the run. */
FLOE_API const char *floe_error_name(const floe_run *run, int i);
/* "done", "at_rest", "diverged", "interrupted" or "failed". Owned by the run. */
FLOE_API const char *floe_run_status(const floe_run *run);
/* A text of the run's summary: coupling, interface, message, notes, pressure, solver, status, substeps; "" where there is
 * nothing to say, NULL if there is none of that name. Owned by the run. */
FLOE_API const char *floe_text(const floe_run *run, const char *name);

/* ---- simulations: stepped by the program ---- */

/* Makes the deck ready for its first step; no file is written. Of `options`, which may be NULL, threads and the callbacks
 * are read. A deck has one simulation at a time. The caller owns *s; it is NULL on failure. FLOE_BAD_INPUT: the scene is
 * refused, with its place in the deck. */
FLOE_API floe_status floe_simulation_create(floe_deck *deck, const floe_options *options, floe_simulation **s);
FLOE_API void floe_simulation_destroy(floe_simulation **s);

/* The i-th warning about the scene, what will not be right and why; NULL past the last. Owned by the simulation. */
FLOE_API const char *floe_warning(const floe_simulation *s, int i);

/* One step, which does not pass the time `until` (s); of a static scene, a load increment, whatever `until` says. A
 * rejected step is repeated with half its length, ten times at most. FLOE_DIVERGED: in vain, or energy has come from
 * nothing; the state is that of the last good step. FLOE_BAD_INPUT: `until` is not after floe_time, or beyond (round-off apart) the deck's
 * time.end; or the call comes from a callback. */
FLOE_API floe_status floe_step(floe_simulation *s, double until);
/* Steps to the time `until` (s), which is reached exactly (of a static scene, to the first increment at or after it),
 * unless floe_is_finished comes first. As floe_step in all else. */
FLOE_API floe_status floe_advance(floe_simulation *s, double until);

/* s, since the start. */
FLOE_API double floe_time(const floe_simulation *s);
/* s: the deck's time.end. */
FLOE_API double floe_end_time(const floe_simulation *s);
/* s: what the next step would be, were nothing in its way; 0 before the first. */
FLOE_API double floe_time_step(const floe_simulation *s);
/* Steps made, of earlier legs too. */
FLOE_API long floe_step_count(const floe_simulation *s);
/* Whether time.end, time.max_steps or rest (stop) is reached. */
FLOE_API bool floe_is_finished(const floe_simulation *s);

/* Writes the state to a checkpoint at `path`, in the place of what is there; the file is whole or not there. */
FLOE_API floe_status floe_save(floe_simulation *s, const char *path);
/* Sets the state to that of a checkpoint of the same deck: what follows has the same bits as if the run had never stopped.
 * FLOE_IO: no file, damaged, or none of floe's; FLOE_BAD_INPUT: of another deck. The state is then as before. */
FLOE_API floe_status floe_restore(floe_simulation *s, const char *path);

/* ---- fields ---- */

enum { FLOE_MAX_COMPONENTS = 3 };

typedef enum floe_centring { FLOE_CELLS, FLOE_NODES, FLOE_POINTS } floe_centring;

/* A field where it lies, without a copy: entry (i, j, k) of component c is
 *
 *     data[c][i * stride[0] + j * stride[1] + k * stride[2]]      0 <= i < shape[0], and so on
 *
 * Of cells and nodes, i runs along x (r), j along y (z), k along z, and unused axes have shape 1 and stride 0; ghosts lie
 * outside. Of points, i counts the points of a body in the order in which they lie, which changes as they move
 * ("points/BODY/id" tells them apart). The arrays are the simulation's: valid, and the values of this time, until it is
 * stepped, restored or destroyed; not to be written to. */
typedef struct floe_view {
    const double *data[FLOE_MAX_COMPONENTS]; /* NULL beyond `components` */
    int components;                          /* 1, or of a vector the scene's dimension */
    size_t shape[3];                         /* entries along each axis */
    ptrdiff_t stride[3];                     /* in doubles */
    size_t first[3]; /* number of entry (0, 0, 0) in the whole mesh: 0 unless the deck asks for several blocks */
    floe_centring centring;
    double scale;     /* times this, a value is that of the outputs: masses and volumes of points are stored per metre
                          * of depth (2-D) or per radian (axisymmetric); 1 for all else */
    const char *unit; /* of the values, as udunits2 spells it; "1" where there is none. Owned by the simulation */
    const char *meaning; /* one line. Owned by the simulation */
} floe_view;

/* Where the mesh is. */
typedef struct floe_mesh {
    int dimension;               /* 1, 2 or 3 */
    bool axisymmetric;           /* axes r, z */
    double lower[3], spacing[3]; /* m: corner of the domain, edges of a cell; 0 and 1 along unused axes */
    size_t cells[3];             /* along each axis; 1 along unused ones. There is a node more along each used axis */
    int blocks;                  /* the mesh is stored in this many pieces, each with views of its own */
} floe_mesh;
FLOE_API floe_mesh floe_get_mesh(const floe_simulation *s);

/* The i-th field's name; NULL past the last. "cells/NAME" and "points/BODY/NAME" are named as in snapshots, "nodes/NAME" are
 * what the last step left there. Owned by the simulation; the names stay the same for its life. */
FLOE_API const char *floe_field_name(const floe_simulation *s, int i);
/* A view of a field in block `block` (0 unless the deck asks for several). FLOE_BAD_INPUT: there is no such field; the
 * message names those that there are. */
FLOE_API floe_status floe_field(floe_simulation *s, const char *name, int block, floe_view *view);
/* Copies a field whole, times its scale, in the order of snapshots, blocks or not: cells and nodes with x fastest, points by
 * their ids; the components of a vector stand together. to[n]: n must be what *needed becomes (`to` may be NULL to ask;
 * `needed` may be NULL). */
FLOE_API floe_status floe_copy_field(floe_simulation *s, const char *name, double *to, size_t n, size_t *needed);

/* What is at a place. */
typedef struct floe_probe {
    double pressure;    /* Pa, absolute; NAN where nothing is */
    double velocity[3]; /* m/s, of all materials there together; NAN where nothing is, and along unused axes */
} floe_probe;
/* The state of the cell that holds x (m; x[3], unused axes are not read): of the cells' fields if the scene has cells, else
 * the mean of the points there. All NAN outside the mesh. */
FLOE_API floe_probe floe_probe_at(const floe_simulation *s, const double *x);
/* The value of a field of cells in the cell that holds x, all components: value[FLOE_MAX_COMPONENTS], NAN beyond them.
 * FLOE_BAD_INPUT: no such field, one that is not of cells, or x is outside the mesh. */
FLOE_API floe_status floe_field_at(floe_simulation *s, const char *name, const double *x, double *value);

/* ---- sums and account ---- */

/* Sums over the scene: in 2-D over its thickness, in 1-D per m2, axisymmetric over the whole turn. */
typedef struct floe_totals {
    double mass;            /* kg */
    double kinetic_energy;  /* J */
    double strain_energy;   /* J, of the solids */
    double internal_energy; /* J */
    double momentum[3];     /* N s; 0 along unused axes */
} floe_totals;
FLOE_API floe_status floe_sum(floe_simulation *s, floe_totals *totals);

typedef enum floe_quantity {
    FLOE_MASS,       /* kg */
    FLOE_MOMENTUM_X, /* N s */
    FLOE_MOMENTUM_Y,
    FLOE_MOMENTUM_Z,
    FLOE_ENERGY,   /* J */
    FLOE_MOMENT_X, /* N m s, of momentum about the origin; in the plane that about z alone */
    FLOE_MOMENT_Y,
    FLOE_MOMENT_Z
} floe_quantity;

/* The account of a conserved quantity since the start: nothing comes or goes unentered. In the quantity's unit, scaled as
 * floe_totals. */
typedef struct floe_balance {
    bool conserved;       /* whether it is a balance in this scene; if not, the drifts are 0 */
    double start, now;    /* what was there, and is there */
    double boundary;      /* what has come through the sides of the domain */
    double source;        /* from loads, body forces, prescribed motion */
    double damping;       /* from damping, negative where it takes */
    double defect;        /* from floors, guards and deleted points: errors that are known */
    double contact;       /* from forces between bodies in contact */
    double drift;         /* 1: what is there and is not accounted for, over what was there and came in */
    double largest_drift; /* 1: the largest of the run so far, with its sign */
} floe_balance;
/* Brings the account up to date and reads it. */
FLOE_API floe_status floe_read_balance(floe_simulation *s, floe_quantity quantity, floe_balance *balance);

/* The error now of a metric of the deck's verify.metrics that compares with an exact solution ("l1_density"): the unit is
 * that of the quantity, or 1 of a relative one. FLOE_BAD_INPUT: the deck does not name it. */
FLOE_API floe_status floe_error(floe_simulation *s, const char *metric, double *error);

#ifdef __cplusplus
}
#endif

#endif
