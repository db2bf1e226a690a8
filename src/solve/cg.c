#include "solve/cg.h"

#include "base/memory.h"
#include "solve/grid_vector.h"

#include <string.h>
#include <sunlinsol/sunlinsol_pcg.h>

struct cg {
    context *ctx;
    const solve_grid *grid;
    int components;
    bool lost; /* a vector of SUNDIALS' own found no memory */
    SUNContext sun;
    SUNLinearSolver solver;
    N_Vector b, x, weight;
    cg_operator *matrix, *preconditioner; /* of the solve in progress */
    void *user;
};

static int apply_matrix(void *data, N_Vector v, N_Vector z)
{
    const cg *c = data;
    c->matrix(c->user, grid_vector_data(v), grid_vector_data(z));
    return 0;
}

static int apply_preconditioner(void *data, N_Vector r, N_Vector z, realtype tolerance, int side)
{
    (void)tolerance;
    (void)side;
    const cg *c = data;
    c->preconditioner(c->user, grid_vector_data(r), grid_vector_data(z));
    return 0;
}

static floe_status fill_cg(cg *c, int most_iterations)
{
    if (SUNContext_Create(NULL, &c->sun) != 0)
        return fail(c->ctx, FLOE_NO_MEMORY, "SUNDIALS has no memory for a context");
    TRY(grid_vector_new(&c->b, c->ctx, c->sun, c->grid, c->components, &c->lost));
    TRY(grid_vector_new(&c->x, c->ctx, c->sun, c->grid, c->components, &c->lost));
    TRY(grid_vector_new(&c->weight, c->ctx, c->sun, c->grid, c->components, &c->lost));
    c->solver = SUNLinSol_PCG(c->x, SUN_PREC_LEFT, most_iterations, c->sun);
    if (c->lost) return FLOE_NO_MEMORY;
    if (c->solver == NULL || SUNLinSolSetATimes(c->solver, c, apply_matrix) != SUNLS_SUCCESS ||
        SUNLinSolSetPreconditioner(c->solver, c, NULL, apply_preconditioner) != SUNLS_SUCCESS ||
        SUNLinSolInitialize(c->solver) != SUNLS_SUCCESS)
        return fail(c->ctx, FLOE_NO_MEMORY, "SUNDIALS has no memory for conjugate gradients");
    return FLOE_OK;
}

floe_status cg_create(cg **out, context *ctx, const solve_grid *g, int components, int most_iterations)
{
    TRY(memory_new(ctx, out, 1, sizeof **out));
    **out = (cg){.ctx = ctx, .grid = g, .components = components};
    const floe_status status = fill_cg(*out, most_iterations);
    if (status != FLOE_OK) cg_destroy(out);
    return status;
}

void cg_destroy(cg **c)
{
    if (!c || !*c) return;
    context *ctx = (*c)->ctx;
    if ((*c)->solver) SUNLinSolFree((*c)->solver);
    if ((*c)->weight) N_VDestroy((*c)->weight);
    if ((*c)->x) N_VDestroy((*c)->x);
    if ((*c)->b) N_VDestroy((*c)->b);
    if ((*c)->sun) SUNContext_Free(&(*c)->sun);
    memory_free(ctx, c);
}

cg_result cg_solve(cg *c, cg_operator *matrix, cg_operator *preconditioner, void *user, const double *b,
                   const double *weight, double tolerance, double *x)
{
    const size_t bytes = (size_t)c->components * c->grid->size * sizeof(double);
    c->matrix = matrix;
    c->preconditioner = preconditioner;
    c->user = user;
    memcpy(grid_vector_data(c->b), b, bytes);
    memset(grid_vector_data(c->x), 0, bytes);
    if (weight) memcpy(grid_vector_data(c->weight), weight, bytes);
    SUNLinSolSetScalingVectors(c->solver, weight ? c->weight : NULL, NULL);
    SUNLinSolSetZeroGuess(c->solver, SUNTRUE);
    const int flag = SUNLinSolSolve(c->solver, NULL, c->x, c->b, tolerance);
    memcpy(x, grid_vector_data(c->x), bytes);
    return (cg_result){SUNLinSolNumIters(c->solver), SUNLinSolResNorm(c->solver), flag == SUNLS_SUCCESS};
}
