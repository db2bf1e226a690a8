/* XDMF: the file that describes the content of the snapshots to ParaView and VisIt. Each snapshot carries its own part
 * of it as text; fields.xdmf is these parts in a row. */
#ifndef IO_XDMF_H
#define IO_XDMF_H

#include "base/strbuf.h"
#include "grid/mesh.h"

/* One array of a snapshot, as an attribute of the grid that is open. */
typedef struct xdmf_array {
    const char *file; /* relative to the page */
    const char *path; /* in the file */
    const char *name;
    const char *unit; /* udunits2 spelling; "1" if none */
    const char *meaning;
    bool on_points; /* else on cells */
    bool vector;    /* 3 components, last axis of the array */
    bool integer;   /* 64 bit, else double */
    int rank;
    const size_t *extent;
} xdmf_array;

/* A time: a collection that holds the grids that follow, up to xdmf_end. */
void xdmf_begin_time(strbuf *page, long number, double time);
/* The grid of the cells: uniform; axes that the mesh does not have are one cell thick. */
void xdmf_begin_cells(strbuf *page, const mesh *m);
/* The grid of a body's n points; `index` holds 0 to n - 1, which some readers ask for, `position` the coordinates (n x
 * 3). */
void xdmf_begin_points(strbuf *page, const char *body, const xdmf_array *index, const xdmf_array *position);
void xdmf_add(strbuf *page, const xdmf_array *array);
/* Ends the innermost grid or collection. */
void xdmf_end(strbuf *page);

/* Replaces the page by one that holds these times. */
floe_status xdmf_write(context *ctx, const char *path, const char *title, const char *times);

#endif
