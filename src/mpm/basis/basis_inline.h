/* Every basis inlined into the point kernels: where the number of a basis is a literal, so is all of its descriptor
 * (theory 4.3). */
#ifndef MPM_BASIS_INLINE_H
#define MPM_BASIS_INLINE_H

#include "basis_list.h" /* generated: includes basis_<name>.h, numbers them, and lists them in FOR_BASES */

/* The descriptor of a basis by its number, the index in basis_registry. */
FLOE_ALWAYS_INLINE const basis_model *basis_of(const int basis)
{
    switch (basis) {
#define CASE(name) \
    case BASIS_NUMBER_##name: return &basis_##name;
        FOR_BASES(CASE)
#undef CASE
    default: return basis_registry[basis];
    }
}

/* Its weights along an axis. */
FLOE_ALWAYS_INLINE int basis_weights(const int basis, double xi, double half, double inv_h, double *w, double *dw)
{
    switch (basis) {
#define CASE(name) \
    case BASIS_NUMBER_##name: return basis_##name##_weights(xi, half, inv_h, w, dw);
        FOR_BASES(CASE)
#undef CASE
    default: return 0;
    }
}

/* Whether the weights of a point are a sum of hats at the corners of its domain. */
FLOE_ALWAYS_INLINE bool basis_has_corners(const int basis)
{
    return basis_of(basis)->fact.shaped;
}
/* Whether they are hats themselves, whose slopes jump. */
FLOE_ALWAYS_INLINE bool basis_has_kinks(const int basis)
{
    return basis_of(basis)->smoothness == 0;
}
/* Whether they depend on the width of a point's own box. */
FLOE_ALWAYS_INLINE bool basis_has_boxes(const int basis)
{
    return basis_of(basis)->fact.sized && !basis_of(basis)->fact.shaped;
}
/* Nodes along an axis that a point, or a corner of its domain, reaches. */
FLOE_ALWAYS_INLINE int basis_support(const int basis)
{
    return basis_has_corners(basis) ? 2 : basis_of(basis)->support;
}
/* Stencils of which the weights of a point are the sum: one, or one a corner of its domain. */
FLOE_ALWAYS_INLINE int basis_pieces(const int basis, const int dim)
{
    return basis_has_corners(basis) ? 1 << dim : 1;
}
/* Nodes that a point may reach beyond its own cell on either side. */
FLOE_ALWAYS_INLINE int basis_reach(const int basis)
{
    return basis_of(basis)->reach;
}

#endif
