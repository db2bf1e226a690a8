#include "grid/bc.h"

const char *bc_name(bc_kind kind)
{
    static const char *const name[] = {"symmetry", "slip",     "no_slip", "periodic",       "inlet",
                                       "outlet",   "velocity", "free",    "non_reflecting", "reservoir"};
    return name[kind];
}

/* What a ghost cell beyond a side becomes. */
typedef struct ghost_rule {
    bool constant, nearest;
    double sign, value;
} ghost_rule;

/* Local index along the axis of the owned cell that ghost layer g (1, 2) of a side looks at. */
static int image_of(const block *b, int axis, mesh_side side, int layer, bool nearest)
{
    const int depth = nearest ? 0 : layer - 1;
    const int inward = depth < b->n[axis] ? depth : b->n[axis] - 1; /* a block one cell wide has but one image */
    return side == SIDE_LOWER ? inward : b->n[axis] - 1 - inward;
}

void bc_layers(const block *b, int axis, mesh_side side, int from, int to, int lo[], int hi[])
{
    for (int d = 0; d < MESH_MAX_DIM; ++d) {
        lo[d] = d < b->dim ? -MESH_GHOST : 0;
        hi[d] = d < b->dim ? b->n[d] + MESH_GHOST : 1;
    }
    lo[axis] = side == SIDE_LOWER ? -to : b->n[axis] + from - 1;
    hi[axis] = lo[axis] + to - from + 1;
}

static void fill_ghosts_by_rule(const block *b, int axis, mesh_side side, ghost_rule rule, double *a)
{
    int lo[MESH_MAX_DIM], hi[MESH_MAX_DIM];
    for (int layer = 1; layer <= MESH_GHOST; ++layer) {
        const int ghost = side == SIDE_LOWER ? -layer : b->n[axis] + layer - 1;
        const ptrdiff_t offset = (image_of(b, axis, side, layer, rule.nearest) - ghost) * b->stride[axis];
        bc_layers(b, axis, side, layer, layer, lo, hi);
        for (int k = lo[2]; k < hi[2]; ++k)
            for (int j = lo[1]; j < hi[1]; ++j)
                for (int i = lo[0]; i < hi[0]; ++i) {
                    const ptrdiff_t at = mesh_index(b, i, j, k);
                    a[at] = rule.constant ? rule.value : rule.sign * a[at + offset];
                }
    }
}

void bc_reflect(const block *b, int axis, mesh_side side, bc_parity parity, double *a)
{
    fill_ghosts_by_rule(b, axis, side, (ghost_rule){.sign = parity == BC_ODD ? -1.0 : 1.0}, a);
}

void bc_extrapolate(const block *b, int axis, mesh_side side, double *a)
{
    fill_ghosts_by_rule(b, axis, side, (ghost_rule){.nearest = true, .sign = 1.0}, a);
}

void bc_constant(const block *b, int axis, mesh_side side, double value, double *a)
{
    fill_ghosts_by_rule(b, axis, side, (ghost_rule){.constant = true, .value = value}, a);
}
