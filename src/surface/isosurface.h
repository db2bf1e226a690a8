/* A function chi with the surface as an isosurface (Sulsky and York 2000, sections 3 and 5): 1 at its points, 0 at a
 * point off it, in the least squares sense, on one element by splines of degree 1 or 2 (0: of one gradient). Its
 * gradient is normal to the surface. Private to the surface module, but for those who reproduce the paper. */
#ifndef SURFACE_ISOSURFACE_H
#define SURFACE_ISOSURFACE_H

#include "surface/least_squares.h"

enum { ISOSURFACE_KEPT = 32 };

typedef struct isosurface {
    int dim, degree, functions;
    double lower[3], size[3];         /* m: the element */
    least_squares rows;               /* of the points, without the one off the surface */
    double place[ISOSURFACE_KEPT][3]; /* m: of the first of the points */
    int kept;
    double chi[SURFACE_MAX_FUNCTIONS];
    int rank;
    double residual;  /* norm of what chi misses at the points; NAN with normal equations */
    double condition; /* of the rows' matrix, by pivots; NAN before it is solved */
} isosurface;

void isosurface_begin(isosurface *f, surface_solver solver, int dim, int degree, const double lower[3],
                      const double size[3]);
/* Values of all functions at x: the row that a point there adds. */
void isosurface_row(const isosurface *f, const double x[3], double *row);
void isosurface_add(isosurface *f, const double x[3]);
/* With the point off the surface at `away`. False where there is no solution. */
bool isosurface_solve(isosurface *f, const double away[3]);
/* With the best of a few points off the surface, drawn at random but always the same within an element: the first with
 * which the gradient is even over the points (or with which it is most even), for a point that falls near the surface
 * sets up a gradient there alone. False where there is no solution. */
bool isosurface_find(isosurface *f);
/* Length of the gradient (1/m) of chi at a place of the element, and its direction in n; zero where there is none. */
double isosurface_normal(const isosurface *f, const double x[3], double n[3]);
/* The k-th of the points that isosurface_find tries. */
void isosurface_away(const isosurface *f, int k, double away[3]);

/* Estimates of the points of a cell by functions of a degree on it. A cell with fewer than `enough` points is joined
 * with its neighbours, two along each axis, then four, until there are enough. Points on a line or plane have a
 * function of one gradient, with which they are exact, wherever they lie in the mesh; so have those that do not
 * determine linear functions. False where there is no solution, with nothing put down. */
bool isosurface_of_cell(const surface_set *s, const surface_cell *c, int degree, size_t enough, surface_estimate *out);
/* Points with which functions of a degree are determined: all unknowns but the one that the point off the surface
 * settles. */
size_t isosurface_enough(int dim, int degree);

#endif
