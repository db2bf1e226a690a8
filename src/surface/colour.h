/* Normals by the gradient of a colour (York 1997, sections 7.1 to 7.3): every point, of the surface and of what it
 * holds, has the same colour, which is spread over nodes. Private to the surface module. */
#ifndef SURFACE_COLOUR_H
#define SURFACE_COLOUR_H

#include "surface/spline.h"
#include "surface/surface.h"

typedef struct colour_rule {
    spline_values (*spread)(double xi); /* of a point's colour over the nodes */
    int first, n; /* nodes that a cell's points read, along each axis: from the cell's own + first on */
    /* Nodes have normals, sums of gradients, which points read linearly; else colours, of which points take the
     * gradient. */
    bool of_nodes;
} colour_rule;

/* Estimates of the points of a cell. */
void colour_of_cell(const surface_set *s, const colour_rule *rule, const surface_cell *c, surface_estimate *out);

#endif
