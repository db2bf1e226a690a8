/* Normals to surfaces that are marked by points without connections (Sulsky and York 2000; York 1997, chapter 7).
 *
 * Points are binned by cell; a method makes, cell by cell, the estimates of the points in it from those in the cell and
 * about it. Behind mirrors and around periodic sides stand images of the points. All sums go in the order of cells and
 * numbers, so that neither blocks nor threads nor the order of the points in memory can change a bit.
 *
 * One file adds one method: surface_<name>.c ends in a const descriptor `surface_<name>`. Decks name it (`normals:
 * name`). */
#ifndef SURFACE_SURFACE_H
#define SURFACE_SURFACE_H

#include "base/param.h"
#include "grid/mesh.h"

#include <stdint.h>

enum {
    SURFACE_HALO = 3,       /* cells behind a side in which images stand */
    SURFACE_RINGS = 2,      /* cells on every side of a point's own in which its neighbours are sought */
    SURFACE_MOST_NEAR = 64, /* neighbours of a point, at most */
    SURFACE_MAX_FUNCTIONS = 27
};

/* What an estimate rests on. */
typedef enum surface_basis {
    SURFACE_NONE,   /* nothing: no direction follows from the points (one alone; in 3-D: on a line) */
    SURFACE_METHOD, /* the method as asked for */
    SURFACE_JOINED, /* the method, on cells joined because a single one has too few points */
    SURFACE_PLAIN,  /* the line or plane through the nearest points: the method found none, or a wild one */
    SURFACE_BASES
} surface_basis;

/* Of one point. */
typedef struct surface_estimate {
    double normal[3]; /* unit; zero for SURFACE_NONE. Sides are given by surface_orient */
    double condition; /* 1: of the matrix of the least squares problem (ratio of pivots); NAN: none was solved */
    /* 1/m: sum of the principal ones, > 0 where the surface bends away from the normal; NAN: not given. */
    double curvature;
    double area;         /* m in 2-D, m2 in 3-D: share of the surface; NAN: not given */
    surface_basis basis; /* what it rests on */
} surface_estimate;

/* A point, or an image of one. */
typedef struct surface_entry {
    double x[3];     /* m; 0 along unused axes */
    int cell[3];     /* global, negative and beyond the mesh for images */
    uint32_t number; /* of the point */
    uint32_t image;  /* 0: the point itself; else which image */
} surface_entry;

/* An occupied cell: entries [first, first + n). */
typedef struct surface_cell {
    int at[3];
    size_t first, n;
    bool own; /* holds a point that is no image */
} surface_cell;

/* Entries in the order of cells (last axis slowest), numbers, images. */
typedef struct surface_bins {
    surface_entry *entry;
    size_t n, reserved;
    surface_cell *cell;
    size_t n_cells;
} surface_bins;

typedef struct surface_set {
    context *ctx;        /* not owned */
    const mesh *mesh;    /* not owned */
    bool mirror[3][2];   /* [axis][side]: where surfaces are reflected; set by the owner, none at first */
    bool closed;         /* methods that follow the numbers: the last point is followed by the first */
    bool measures;       /* curvature and area are asked for, where the method gives them; true at first */
    const double *place; /* m, 3 a point, NAN for a point that is lost; not owned, valid while normals are made */
    size_t n_points;
    surface_bins points;
    surface_bins inside; /* points of what the surface holds, for methods that need them */
} surface_set;

typedef struct surface_method {
    const char *name, *doc, *cite;
    int min_dim;    /* 2; 1 where a line of one axis has normals, too */
    bool connected; /* follows the numbers of the points */
    bool exact;     /* straight lines and planes have their normals to round-off */
    bool
        checked; /* a direction over 45 degrees off the line or plane through the nearest points is replaced by its normal */
    bool needs_inside; /* takes points of what the surface holds, where there are any */
    size_t param_size;
    const param_spec *params;
    size_t n_params;
    /* Estimates of the points of one cell, by number; what has no direction is left as it comes, SURFACE_NONE. Any
     * thread. */
    void (*cell)(const surface_set *s, const void *par, const surface_cell *c, surface_estimate *out);
} surface_method;

extern const surface_method *const surface_registry[];
extern const size_t surface_registry_size;
/* NULL if there is none of that name. */
const surface_method *surface_find(const char *name);

/* An empty set on a mesh, which must outlive it. surface_set_free frees what it holds. */
void surface_set_init(surface_set *s, context *ctx, const mesh *m);
void surface_set_free(surface_set *s);
/* Takes in n points (m, 3 a point). `place` must stay until normals have been made. */
floe_status surface_set_points(surface_set *s, size_t n, const double *place);
/* Takes in the points of what the surface holds (the same form; their numbers are their own), for methods with
 * `needs_inside`. */
floe_status surface_set_inside(surface_set *s, size_t n, const double *place);
/* The occupied cell at a place of the mesh; NULL where it is empty. */
const surface_cell *surface_cell_at(const surface_bins *l, const int at[3]);

/* Fills out[n_points]: by the method, and where it finds nothing (or, if that is checked, a wild direction), by the
 * line or plane through the nearest points. */
void surface_normals(const surface_set *s, const surface_method *method, const void *par, surface_estimate *out);

/* Gives all normals (and curvatures) the same side. A point with a reference (3 numbers a point, of any length; zero:
 * none) takes its side. The others take that of their neighbours, nearest first: a chord's end has the normal of its
 * start, mirrored (which is exact on circles). Where nothing is known the point farthest from the middle of all (images
 * included) points away from it. `reference` may be NULL. */
floe_status surface_orient(const surface_set *s, const double *reference, surface_estimate *out);

/* The next point of a line in a plane, on one side of a point. */
typedef struct surface_link {
    ptrdiff_t of; /* number of the point; -1: there is none within SURFACE_RINGS cells */
    int axis;     /* it is the image behind a mirror across this axis; -1: the point itself, or a periodic image */
    int side;     /* SIDE_LOWER or SIDE_UPPER: where that mirror stands */
} surface_link;

/* Fills out[2 n_points] with the points before and after each along (-n_y, n_x), from where they lie: on either side
 * the nearest less than 60 degrees off that direction. A point without a normal has no links. Two dimensions. */
void surface_links(const surface_set *s, const surface_estimate *normals, surface_link *out);

#endif
