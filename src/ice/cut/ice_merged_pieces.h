/* The pieces of boundaries in the cells that they cut, as the step of merged cells sees them. Only this folder includes it. */
#ifndef ICE_MERGED_PIECES_H
#define ICE_MERGED_PIECES_H

#include "ice/cut/ice_merged_cells.h"

/* All pieces of the lines beside the current gas, where the step takes them to pass: each with the member of its cell,
 * the weight of its place, and the sign of its area, outward from the gas. */
typedef struct ice_piece_walk {
    const ice *s;
    const ice_merged_cells *p;
    int number, place, n; /* of the line, of its places, of the piece */
    double weight, outward;
    const ice_embedded_boundary *line;
    const cut_piece *piece;
    const ice_member *member;
} ice_piece_walk;

/* for (ice_piece_walk w = ice_first_piece(s, p); ice_next_piece(&w);) */
ice_piece_walk ice_first_piece(const ice *s, const ice_merged_cells *p);
bool ice_next_piece(ice_piece_walk *w);
/* Component of a vector of the vertices in the middle of a piece. */
double ice_at_middle(const cut_piece *q, int dim, const double *vertex, int a);
/* The same along the piece's area, outward from the current gas. */
double ice_along_area(const ice_piece_walk *w, const double *vertex);

/* What pieces sweep of the cells in which they lie, where they belong to those in front of them, passes the faces between (cut_piece.through): into the
 * faces' velocities, which move volumes of the whole face by now. */
void ice_merged_sweep(const ice *s, const ice_region *g);

ice_merged_cells *ice_merged_cells_of(const ice *s, const ice_region *g);
/* Speed of sound (m/s) of all fluids of a cell together. */
double ice_merged_sound(const ice_view *v, ptrdiff_t at);

/* Writes to s->walls the response of the pressures of merged cells to the motion of the boundaries (theory 7.6). Errors: FLOE_NO_MEMORY. */
floe_status ice_merged_response(ice *s);

#endif
