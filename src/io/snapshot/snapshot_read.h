/* Reading snapshots back (docs/outputs.md): which there are, what each holds, and its arrays as plain numbers. Every
 * file is checked against its SHA-256 before HDF5 reads a byte of it; FLOE_IO says which file is missing, foreign or
 * damaged. HDF5 is not thread-safe: main thread only. */
#ifndef IO_SNAPSHOT_READ_H
#define IO_SNAPSHOT_READ_H

#include "base/context.h"

enum { SNAPSHOT_TEXT = 160 };

/* One snapshot of a run. */
typedef struct snapshot_time {
    long number; /* of its file */
    double time; /* s */
} snapshot_time;

typedef struct snapshot_times {
    snapshot_time *entry; /* n of them, by number; counted memory, owned */
    size_t n;
} snapshot_times;

/* The snapshots of the run folder `dir`. Damaged ones are left out, each with a warning in the log. FLOE_IO when none
 * is left. */
floe_status snapshot_times_read(snapshot_times *out, context *ctx, const char *dir);
/* The last one of them that is not damaged, at less cost. */
floe_status snapshot_last(snapshot_time *out, context *ctx, const char *dir);
void snapshot_times_free(context *ctx, snapshot_times *t);

/* One array of a snapshot. */
typedef struct snapshot_field {
    char name[SNAPSHOT_TEXT];    /* "pressure" */
    char unit[SNAPSHOT_TEXT];    /* udunits2 spelling; "1" if none */
    char meaning[SNAPSHOT_TEXT]; /* in words */
    int components;              /* 1, or 3 for vectors */
} snapshot_field;

/* The cells, or the points of one body. */
typedef struct snapshot_group {
    char name[SNAPSHOT_TEXT]; /* of the body; "cells" */
    char material[SNAPSHOT_TEXT];
    bool fluid;            /* the body is a fluid's */
    size_t n;              /* cells or points */
    snapshot_field *field; /* n_fields of them, by name; counted memory, owned */
    size_t n_fields;
} snapshot_group;

/* What a snapshot holds. */
typedef struct snapshot {
    context *ctx; /* not owned */
    long number;
    double time; /* s */
    char time_unit[SNAPSHOT_TEXT];
    char title[SNAPSHOT_TEXT];    /* of the deck */
    char coupling[SNAPSHOT_TEXT]; /* mpm, ice, ice-mpm */
    int dim;
    bool axisymmetric;
    double lower[3], upper[3], cell[3]; /* m; 0 along unused axes */
    int cells[3];                       /* along each axis; 1 along unused ones */
    char unit[SNAPSHOT_TEXT];           /* of lengths */
    double volume_scale;  /* what volumes and masses were multiplied by: thickness in 2-D, 2 pi if axisymmetric */
    snapshot_group grid;  /* the cells; n is 0 when there are none */
    snapshot_group *body; /* n_bodies of them, by name; counted memory, owned */
    size_t n_bodies;
    char *path;           /* of the file; owned */
    struct hdf_file *hdf; /* owned */
} snapshot;

/* Opens the snapshot of that number in the run folder `dir`. Free it whatever comes back. */
floe_status snapshot_read(snapshot *out, context *ctx, const char *dir, long number);
void snapshot_free(snapshot *s);

/* The field of that name, or NULL. */
const snapshot_field *snapshot_find(const snapshot_group *group, const char *name);
/* Its values, in memory that the caller owns: cells in the order (z, y, x), x fastest, points by their ids; the
 * components of a vector stand together. */
floe_status snapshot_values(const snapshot *s, const snapshot_group *group, const snapshot_field *field, double **out);

#endif
