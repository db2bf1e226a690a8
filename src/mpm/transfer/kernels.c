/* Selects the point kernels of a scene. */
#include "mpm/transfer/kernels.h"

static kernel_space space_of(int dim, mesh_geometry geometry)
{
    if (dim == 1) return KERNELS_LINE;
    if (dim == 3) return KERNELS_SOLID;
    return geometry == MESH_AXISYMMETRIC ? KERNELS_AXISYMMETRIC : KERNELS_PLANE;
}

static size_t row_of(int dim, mesh_geometry geometry, const basis_model *basis)
{
    return (size_t)space_of(dim, geometry) * basis_registry_size + (size_t)basis_number(basis);
}

const kernel_set *kernels_pairs(int dim, mesh_geometry geometry, const basis_model *basis)
{
    return kernels_table_pairs[row_of(dim, geometry, basis)];
}

const kernel_set *kernels_quads(int dim, mesh_geometry geometry, const basis_model *basis)
{
    return kernels_table_quads[row_of(dim, geometry, basis)];
}

const kernel_set *kernels_of(int dim, mesh_geometry geometry, const basis_model *basis)
{
    return floe_has_quads() ? kernels_quads(dim, geometry, basis) : kernels_pairs(dim, geometry, basis);
}
