#include "solve/grid_vector.h"

#include "base/memory.h"

typedef struct content {
    context *ctx;
    const solve_grid *grid;
    int components;
    bool *lost;             /* not owned: set where a clone finds no memory */
    double *data, *partial; /* owned */
} content;

static content *content_of(N_Vector v)
{
    return v->content;
}

double *grid_vector_data(N_Vector v)
{
    return content_of(v)->data;
}

/* Linear index of the first unknown of one of the rows of all components. */
static ptrdiff_t row_of(const content *c, int row)
{
    const int rows = solve_rows(c->grid);
    return (ptrdiff_t)(row / rows) * (ptrdiff_t)c->grid->size + solve_row(c->grid, row % rows);
}

static int rows_of(const content *c)
{
    return c->components * solve_rows(c->grid);
}

static void linear_sum(realtype a, N_Vector vx, realtype b, N_Vector vy, N_Vector vz)
{
    const content *c = content_of(vz);
    const double *x = content_of(vx)->data, *y = content_of(vy)->data;
    double *z = c->data;
    const int rows = rows_of(c), n = c->grid->n[0];
#pragma omp parallel for schedule(static) if (solve_is_large(c->grid))
    for (int row = 0; row < rows; ++row) {
        const ptrdiff_t base = row_of(c, row);
#pragma omp simd
        for (ptrdiff_t at = base; at < base + n; ++at) z[at] = a * x[at] + b * y[at];
    }
}

static void set_all_values(realtype value, N_Vector vz)
{
    const content *c = content_of(vz);
    const int rows = rows_of(c), n = c->grid->n[0];
    for (int row = 0; row < rows; ++row) {
        const ptrdiff_t base = row_of(c, row);
        for (ptrdiff_t at = base; at < base + n; ++at) c->data[at] = value;
    }
}

static void multiply_vectors(N_Vector vx, N_Vector vy, N_Vector vz)
{
    const content *c = content_of(vz);
    const double *x = content_of(vx)->data, *y = content_of(vy)->data;
    double *z = c->data;
    const int rows = rows_of(c), n = c->grid->n[0];
#pragma omp parallel for schedule(static) if (solve_is_large(c->grid))
    for (int row = 0; row < rows; ++row) {
        const ptrdiff_t base = row_of(c, row);
#pragma omp simd
        for (ptrdiff_t at = base; at < base + n; ++at) z[at] = x[at] * y[at];
    }
}

static void scale_vector(realtype factor, N_Vector vx, N_Vector vz)
{
    linear_sum(factor, vx, 0.0, vx, vz);
}

enum { LANES = 8 }; /* partial sums that are kept apart, so that the loop vectorises without reordering any addition */

static double tile_dot(const solve_grid *g, const double *x, const double *y, const int lo[MESH_MAX_DIM])
{
    double lane[LANES] = {0.0}, sum = 0.0;
    int hi[MESH_MAX_DIM];
    for (int a = 0; a < MESH_MAX_DIM; ++a) hi[a] = lo[a] + g->tile[a] < g->n[a] ? lo[a] + g->tile[a] : g->n[a];
    for (int k = lo[2]; k < hi[2]; ++k)
        for (int j = lo[1]; j < hi[1]; ++j) {
            ptrdiff_t at = solve_index(g, lo[0], j, k);
            int left = hi[0] - lo[0];
            for (; left >= LANES; left -= LANES, at += LANES)
                for (int l = 0; l < LANES; ++l) lane[l] += x[at + l] * y[at + l];
            for (int l = 0; l < left; ++l) lane[l] += x[at + l] * y[at + l];
        }
    for (int l = 0; l < LANES; ++l) sum += lane[l];
    return sum;
}

static int tiles_along(const solve_grid *g, int axis)
{
    return (g->n[axis] + g->tile[axis] - 1) / g->tile[axis];
}

static size_t count_tiles(const solve_grid *g)
{
    return (size_t)tiles_along(g, 0) * (size_t)tiles_along(g, 1) * (size_t)tiles_along(g, 2);
}

static realtype dot_product(N_Vector vx, N_Vector vy)
{
    const content *w = content_of(vx);
    const solve_grid *g = w->grid;
    const int tx = tiles_along(g, 0), ty = tiles_along(g, 1), tiles = (int)count_tiles(g);
    double sum = 0.0;
    for (int c = 0; c < w->components; ++c) {
        const double *x = w->data + (size_t)c * g->size, *y = content_of(vy)->data + (size_t)c * g->size;
#pragma omp parallel for schedule(static) if (solve_is_large(g))
        for (int t = 0; t < tiles; ++t)
            w->partial[t] = tile_dot(
                g, x, y, (const int[]){t % tx * g->tile[0], t / tx % ty * g->tile[1], t / (tx * ty) * g->tile[2]});
        for (int t = 0; t < tiles; ++t) sum += w->partial[t];
    }
    return sum;
}

static sunindextype vector_length(N_Vector v)
{
    const content *c = content_of(v);
    return (sunindextype)c->components * c->grid->n[0] * c->grid->n[1] * c->grid->n[2];
}

static void destroy_vector(N_Vector v)
{
    if (v == NULL) return;
    content *c = content_of(v);
    if (c != NULL) {
        context *ctx = c->ctx;
        memory_free(ctx, &c->data);
        memory_free(ctx, &c->partial);
        memory_free(ctx, &v->content);
    }
    N_VFreeEmpty(v);
}

static floe_status fill_vector(N_Vector v, context *ctx, const solve_grid *g, int components, bool *lost)
{
    TRY(memory_new(ctx, &v->content, 1, sizeof(content)));
    content *c = content_of(v);
    *c = (content){.ctx = ctx, .grid = g, .components = components, .lost = lost};
    TRY(memory_new(ctx, &c->data, (size_t)components * g->size, sizeof(double)));
    return memory_new(ctx, &c->partial, count_tiles(g), sizeof(double));
}

static N_Vector clone_vector(N_Vector v)
{
    const content *c = content_of(v);
    N_Vector out = N_VNewEmpty(v->sunctx);
    if (out == NULL) return NULL;
    N_VCopyOps(v, out);
    if (fill_vector(out, c->ctx, c->grid, c->components, c->lost) != FLOE_OK) *c->lost = true;
    return out;
}

floe_status grid_vector_new(N_Vector *out, context *ctx, SUNContext sun, const solve_grid *g, int components,
                            bool *lost)
{
    *out = N_VNewEmpty(sun);
    if (*out == NULL) return fail(ctx, FLOE_NO_MEMORY, "a vector of the linear solver cannot be made");
    (*out)->ops->nvclone = clone_vector;
    (*out)->ops->nvdestroy = destroy_vector;
    (*out)->ops->nvgetlength = vector_length;
    (*out)->ops->nvlinearsum = linear_sum;
    (*out)->ops->nvconst = set_all_values;
    (*out)->ops->nvprod = multiply_vectors;
    (*out)->ops->nvscale = scale_vector;
    (*out)->ops->nvdotprod = dot_product;
    const floe_status status = fill_vector(*out, ctx, g, components, lost);
    if (status != FLOE_OK) {
        destroy_vector(*out);
        *out = NULL;
    }
    return status;
}
