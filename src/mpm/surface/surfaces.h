/* Surfaces on which loads and gas act. */
#ifndef MPM_SURFACES_H
#define MPM_SURFACES_H

#include "embedded/cut.h"
#include "geom/sheet_triangles.h"
#include "mpm/mpm.h"

/* Forces of gas on a membrane (membrane_boundary.c), by number of its points. Owned arrays. */
typedef struct membrane_force {
    size_t n;               /* 0: the body encloses no gas of the cells */
    double *x;              /* m, three each: positions of the points at the start of the step */
    double *v;              /* m/s, as many each as the mesh has dimensions: scratch */
    double *force;          /* N, the same */
    sheet_triangles joined; /* of a surface in space: between the points; else none */
} membrane_force;

/* A marker on the surface of a solid. */
typedef struct surface_marker {
    double x[3], v[3]; /* m, m/s */
} surface_marker;

/* Markers on the surfaces of solids, on which gas of the cells exerts its pressure (surface_markers.c). Owned arrays; n
 * = 0: the interface is not sharp. */
typedef struct surface_markers {
    size_t n;
    surface_marker *now, *next;
    size_t of_body[SCENE_MAX_BODIES + 1]; /* the first of each of our bodies, and behind the last */
    int *group;                           /* velocity field of each */
    int *pin;                             /* bit a: it stays on a side of the mesh across axis a */
    double *force;                        /* N, three each: forces of the gas in the step */
    double *heat;                         /* W: that fluids conduct into each in the step */
    double *path;                         /* m, three each: displacement over which these forces do work */
    cut_chain *chain;
    int *beside; /* of each chain: the fluid of the cells that it holds back, by its number in the scene */
    int n_chains;
    cut_triangle *triangle; /* in space, in place of chains */
    int *facing;            /* of each triangle: as `beside` */
    int n_triangles;
} surface_markers;

struct mpm_surfaces {
    /* Massless corners of facets, which the nodes move: m, three each, now and next; N, three each: forces; and their bodies in the scene.
     * Owned, as the facets. */
    double *corner, *corner_next, *corner_force;
    int *corner_body;
    size_t n_corners;
    struct surface_facet *facet;
    size_t n_facets;
    bool pressed;                                    /* some of them are, by loads or enclosed gases */
    membrane_force membrane_force[SCENE_MAX_BODIES]; /* of our bodies */
    surface_markers markers;
    struct wall_response *fluids;   /* response of the gas's pressure to the markers' motion; not owned; NULL: none */
    struct marker_inertia *inertia; /* what moves the markers (inertia.h); owned; NULL: not needed so far */
};
void surfaces_free(mpm *s);

#endif
