/* A body whose surface is the triangles of an STL file. */
#include "geom/stl_text.h"
#include "geom/triangles.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct stl_par {
    param_file file;
    double scale, shift[3]; /* m */
    triangle_surface surface;
} stl_par;

static const param_spec stl_params[] = {
    PAR_FILE(stl_par, file, "STL file, in words or binary: a closed surface"),
    PAR_POSITIVE(stl_par, scale, "m", 1.0, "what a unit of the file is: `1 mm` for a file in millimetres"),
    PAR_VECTOR(stl_par, shift, "m", PARAM_ANY, 0.0, "where the origin of the file is"),
};

static double stl_level(const void *par, int dim, const double x[3])
{
    (void)dim;
    return triangles_level(&((const stl_par *)par)->surface, x);
}

static bool stl_bounds(const void *par, int dim, double lo[3], double hi[3])
{
    const triangle_box *all = &((const stl_par *)par)->surface.box[0];
    (void)dim;
    memcpy(lo, all->lo, sizeof all->lo);
    memcpy(hi, all->hi, sizeof all->hi);
    return true;
}

static const char *stl_check(const void *par, int dim)
{
    (void)par;
    (void)dim;
    return NULL;
}

static floe_status stl_prepare(void *par, int dim, const shape_memory *memory, char why[SHAPE_WHY])
{
    stl_par *s = par;
    double(*corner)[3] = NULL;
    int n = 0;
    char wrong[SHAPE_WHY - 128] = "";
    (void)dim;
    TRY(stl_read(&corner, &n, memory->ctx, s->file.bytes, s->file.size, why));
    for (int i = 0; i < 9 * n && !why[0]; i++) corner[i / 3][i % 3] = s->scale * corner[i / 3][i % 3] + s->shift[i % 3];
    floe_status status = FLOE_OK;
    if (!why[0]) status = triangles_make(&s->surface, (const double(*)[3])corner, n, memory, why);
    memory_free(memory->ctx, &corner);
    s->file.bytes = NULL;
    if (!why[0]) return status;
    (void)snprintf(wrong, sizeof wrong, "%s", why);
    (void)snprintf(why, SHAPE_WHY, "'%.100s': %s", s->file.path, wrong);
    return status;
}

const shape_model shape_stl = {
    .name = "stl",
    .doc = "what a closed surface of triangles in a file surrounds (3-D)",
    .param_size = sizeof(stl_par),
    .params = stl_params,
    .n_params = sizeof stl_params / sizeof *stl_params,
    .min_dim = 3,
    .max_dim = 3,
    .instead_below = "it is of scenes in space; in the plane take `polygon`",
    .level = stl_level,
    .bounds = stl_bounds,
    .check = stl_check,
    .prepare = stl_prepare,
};
