/* The point kernels for machines with registers of four doubles, compiled for those (CMakeLists.txt): the same operations on each lane, and
 * so the same bits. */
#include "mpm/kernels_body.h"

kernel_set kernels_quads(int dim, mesh_geometry geometry, basis_kind kind)
{
    return kernels_here(dim, geometry, kind);
}
