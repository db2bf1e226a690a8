/* The only door from one block to another (docs/structure.md, Tiles): ghosts, tile partials, point migration, ordered reductions.
 * domain_local.c serves several blocks in one process; a message-passing domain can take its place behind the same
 * door. */
#ifndef GRID_DOMAIN_H
#define GRID_DOMAIN_H

#include "grid/field.h"
#include "grid/mesh.h"

typedef struct domain {
    context *ctx;                    /* not owned */
    const mesh *mesh;                /* not owned */
    fields *fields[MESH_MAX_BLOCKS]; /* owned; one set per block */
    double *partials;                /* owned; see domain_tile */
    size_t partial_size;             /* doubles of one tile */
} domain;

floe_status domain_create(domain **out, context *ctx, const mesh *m);
void domain_destroy(domain **d);

/* Registers a field in every block. */
floe_status domain_add(domain *d, field_id id, int instance);

typedef enum fill_which { FILL_CURRENT, FILL_NEXT } fill_which;

/* Copies owned values of cell or face fields into the ghost layers of neighbouring blocks, and around periodic axes;
 * edges and corners included. Ghosts beyond a non-periodic side are left to grid/bc. */
void domain_fill(domain *d, field_id id, int instance, fill_which which);

/* Space for `size` doubles of node partials in every global tile: the private sums of a tile's points, which the blocks
 * that see its nodes add up in global tile order. */
floe_status domain_reserve_partials(domain *d, size_t size);
/* The partials of a global tile. In another process's domain, tiles next to a block are valid after
 * domain_share_partials. */
double *domain_tile(const domain *d, int tile);
void domain_share_partials(domain *d);

/* Adds up the two images of every node near a periodic end (node 0 and n, -1 and n-1, 1 and n+1), low image first, and
 * gives both the sum. One ghost layer of nodes is used. */
void domain_fold_periodic(domain *d, field_id id, int instance);
/* The same with the larger of the two instead of the sum. */
void domain_fold_periodic_largest(domain *d, field_id id, int instance);

/* sum[count] over tiles, in the order of global tile number, whatever the blocks: `partial` has one row of `count`
 * values per global tile (row-major). */
void domain_sum_tiles(const mesh *m, const double *partial, int count, double *sum);

#endif
