/* Which point kernels a scene takes. */
#include "mpm/kernels.h"

static kernel_space space_of(int dim, mesh_geometry geometry)
{
    if (dim == 1) return KERNELS_LINE;
    if (dim == 3) return KERNELS_SOLID;
    return geometry == MESH_AXISYMMETRIC ? KERNELS_AXISYMMETRIC : KERNELS_PLANE;
}

kernel_set kernels_pairs(int dim, mesh_geometry geometry, basis_kind kind)
{
    return *kernels_table_pairs[space_of(dim, geometry)][kind];
}

kernel_set kernels_quads(int dim, mesh_geometry geometry, basis_kind kind)
{
    return *kernels_table_quads[space_of(dim, geometry)][kind];
}

kernel_set kernels_of(int dim, mesh_geometry geometry, basis_kind kind)
{
    return floe_has_quads() ? kernels_quads(dim, geometry, kind) : kernels_pairs(dim, geometry, kind);
}
