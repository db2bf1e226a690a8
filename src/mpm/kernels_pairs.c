/* The point kernels for any machine. */
#include "mpm/kernels_body.h"

kernel_set kernels_pairs(int dim, mesh_geometry geometry, basis_kind kind)
{
    return kernels_here(dim, geometry, kind);
}

kernel_set kernels_of(int dim, mesh_geometry geometry, basis_kind kind)
{
    return floe_has_quads() ? kernels_quads(dim, geometry, kind) : kernels_here(dim, geometry, kind);
}
