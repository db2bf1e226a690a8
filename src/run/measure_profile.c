/* Stresses along the x axis beside the exact ones. */
#include "base/memory.h"
#include "base/strbuf.h"
#include "io/file.h"
#include "io/names.h"
#include "run/measure.h"
#include "run/subject.h"

#include <math.h>
#include <stdlib.h>

typedef struct profile_row {
    double x[3], r, value[2], exact[2];
} profile_row;

static int compare_by_place(const void *a, const void *b)
{
    const double x = ((const profile_row *)a)->r, y = ((const profile_row *)b)->r;
    return (x > y) - (x < y);
}

/* Whether a point belongs to the first row of sub-cells on either side of the axis. */
static bool is_near_axis(const point_samples *p, const scene_body *b, const double centre[3], size_t i)
{
    for (int a = 1; a < MESH_MAX_DIM; a++) {
        const double row = p->s->mesh.h[a] / b->per_cell[a];
        if (a < p->s->mesh.dim && !(fabs(p->start[a][i] - centre[a]) < row * (1.0 - 1e-9))) return false;
    }
    return p->start[0][i] > centre[0];
}

static void fill_row(const point_samples *p, const double centre[3], size_t i, profile_row *row)
{
    double square = 0.0;
    for (int a = 0; a < MESH_MAX_DIM; a++) {
        if (a >= p->s->mesh.dim) break;
        row->x[a] = p->start[a][i];
        square += (row->x[a] - centre[a]) * (row->x[a] - centre[a]);
    }
    row->r = sqrt(square);
    for (int k = 0; k < 2; k++) {
        const exact_quantity quantity = k == 0 ? EXACT_SIGMA_R : EXACT_SIGMA_THETA;
        row->value[k] = point_value(p, quantity, i);
        row->exact[k] = point_exact(p, quantity, i);
    }
}

static floe_status write_rows(const sim *s, const char *path, profile_row *row, size_t n)
{
    context *ctx = s->ctx;
    const char *m = output_unit(s, "m"), *pa = output_unit(s, "Pa");
    strbuf out;
    strbuf_init(&out, ctx);
    strbuf_append(&out,
                  "x (%s),y (%s),r (%s),sigma_r (%s),sigma_theta (%s),exact_sigma_r (%s),exact_sigma_theta (%s)\n", m,
                  m, m, pa, pa, pa, pa);
    qsort(row, n, sizeof *row, compare_by_place);
    for (size_t i = 0; i < n; i++) {
        strbuf_append(&out, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", row[i].x[0], row[i].x[1], row[i].r, row[i].value[0],
                      row[i].value[1], row[i].exact[0], row[i].exact[1]);
    }
    const floe_status status = out.status == FLOE_OK ? file_replace_text(ctx, path, strbuf_string(&out)) : out.status;
    strbuf_free(&out);
    return status;
}

static floe_status write_point_profile(const point_samples *p, const char *path)
{
    const scene_body *b = &p->s->scene->body[p->s->mpm->body[p->body].scene_body];
    const double *given = exact_param(p->solution->model, (void *)p->solution->par, "centre");
    const double origin[3] = {0.0, 0.0, 0.0}, *centre = given ? given : origin;
    profile_row *row;
    size_t n = 0;
    TRY(memory_new(p->s->ctx, &row, p->list.n, sizeof *row));
    for (size_t i = 0; i < p->list.n; i++) {
        if (is_near_axis(p, b, centre, i)) fill_row(p, centre, i, &row[n++]);
    }
    const floe_status status = write_rows(p->s, path, row, n);
    memory_free(p->s->ctx, &row);
    return status;
}

/* The body that is measured, as an instance of the point fields; -1 if it has no points. */
static int find_body(const sim *s)
{
    for (int b = 0; s->mpm && b < s->mpm->n_bodies; b++) {
        const int wanted = s->scene->verify.body;
        if (wanted >= 0 ? s->mpm->body[b].scene_body == wanted : !s->mpm->body[b].fluid) return b;
    }
    return -1;
}

floe_status measure_profile(sim *s, const exact *solution, const char *path)
{
    point_samples p;
    if (!solution->model) return FLOE_OK;
    if (s->mesh.dim < 2) return profile_of_line(s, solution, path);
    const int body = find_body(s);
    if (body < 0) return FLOE_OK;
    if (!exact_provides(solution, EXACT_SIGMA_R) || !exact_is_solid(solution)) return FLOE_OK;
    TRY(point_samples_take(&p, s, solution, body));
    const floe_status status = write_point_profile(&p, path);
    point_samples_free(&p);
    return status;
}
