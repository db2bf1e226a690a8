/* The nearest points of a point. Private to the surface module. */
#ifndef SURFACE_NEIGHBOURS_H
#define SURFACE_NEIGHBOURS_H

#include "surface/surface.h"

typedef struct surface_neighbour {
    double d[3];   /* m: from the point to it */
    double square; /* m2: its squared length */
    uint32_t number, image;
} surface_neighbour;

enum { SURFACE_BLOCK = (2 * SURFACE_RINGS + 1) * (2 * SURFACE_RINGS + 1) * (2 * SURFACE_RINGS + 1) };

/* The occupied cells up to `ring` away from one, in order. */
typedef struct surface_block {
    int ring, n;
    const surface_cell *cell[SURFACE_BLOCK];
} surface_block;

/* ring: up to SURFACE_RINGS. */
void surface_block_about(const surface_set *s, const int at[3], int ring, surface_block *out);
/* No entry outside the block about its cell is nearer to `of` than this (m). */
double surface_block_covers(const surface_set *s, const surface_entry *of, int ring);
/* Distance (m) to the count-th nearest, or the farthest where there are fewer: *found is how many. 0 where there is
 * none. */
double surface_distance_in(const surface_set *s, const surface_block *b, const surface_entry *of, int count,
                           int *found);
/* The nearest entries of `of` in a block that lie closer than `reach` (m), itself left out, nearest first, out[most];
 * how many there are. Of equally near ones that of the lower cell, then number, comes first. */
int surface_within_in(const surface_set *s, const surface_block *b, const surface_entry *of, double reach, int most,
                      surface_neighbour *out);
/* The same without a bound, in as many rings as it takes, up to SURFACE_RINGS. */
int surface_nearest(const surface_set *s, const surface_entry *of, int most, surface_neighbour *out);

#endif
