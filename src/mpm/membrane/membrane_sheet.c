/* Membranes as surfaces in space: points without order, with tangent planes normal to the normals that the points themselves determine. The velocity gradient
 * of the step stretches the two material vectors of a point; when the normals at the new positions are known, the vectors are rotated into the new tangent
 * plane, and the plane stress is transformed to the axes of the scene (material/sheet.h). */
#include "mpm/membrane/membrane_sheet.h"

#include "mpm/membrane/membrane_curve.h"
#include "mpm/membrane/membrane_points.h"
#include "mpm/state/stress.h"

#include <math.h>

static const field_id vector_field[2] = {P_SURFACE_1, P_SURFACE_2};

bool is_sheet(const mpm *s, int body)
{
    return s->scene->body[s->body[body].scene_body].membrane.surface.kind != SHEET_NONE;
}

static void load_point(const fields *f, int body, size_t k, bool next, sheet_point *p)
{
    for (int v = 0; v < 2; ++v)
        for (int a = 0; a < 3; ++a) p->a[v][a] = (next ? field_next : field_get)(f, vector_field[v], body, a)[k];
}

static void store_point(const fields *f, int body, size_t k, bool next, const sheet_point *p)
{
    for (int v = 0; v < 2; ++v)
        for (int a = 0; a < 3; ++a) (next ? field_next : field_get)(f, vector_field[v], body, a)[k] = p->a[v][a];
}

floe_status strain_sheet(mpm *s, int blk, int body, size_t start, size_t end, const solid_batch *rate)
{
    const fields *f = s->domain->fields[blk];
    for (size_t k = start; k < end; ++k) {
        double L[9];
        sheet_point p;
        for (int c = 0; c < 9; ++c) L[c] = rate->L[c][k - start];
        load_point(f, body, k, false, &p);
        if (!sheet_stretch(L, strain_step(s), &p)) return membrane_torn(s, blk, body, k);
        store_point(f, body, k, true, &p);
    }
    return FLOE_OK;
}

static void put_point_stress(const mpm *s, const fields *f, int body, size_t k, bool next, const sheet_point *p)
{
    double stress[6], J;
    sheet_stress(&s->body[body].membrane, p, stress, &J);
    for (int c = 0; c < 6; ++c) (next ? field_next : field_get)(f, P_STRESS, body, c)[k] = stress[c];
    (next ? field_next : field_get)(f, P_J, body, 0)[k] = J;
}

static void normal_at(const fields *f, int body, size_t k, bool next, double normal[3])
{
    for (int a = 0; a < 3; ++a) normal[a] = (next ? field_next : field_get)(f, P_NORMAL, body, a)[k];
}

void turn_sheet(mpm *s, int body)
{
    for (int blk = 0; blk < s->mesh->n_blocks; ++blk) {
        const fields *f = s->domain->fields[blk];
        const size_t n = s->points[blk][body].n;
#pragma omp parallel for schedule(static)
        for (size_t k = 0; k < n; ++k) {
            double normal[3];
            sheet_point p;
            load_point(f, body, k, true, &p);
            normal_at(f, body, k, true, normal);
            sheet_turn(normal, &p);
            store_point(f, body, k, true, &p);
            put_point_stress(s, f, body, k, true, &p);
        }
    }
}

static floe_status no_direction(const mpm *s, const fields *f, int body, size_t k)
{
    double x[3];
    for (int a = 0; a < 3; ++a) x[a] = field_get(f, P_POS, body, a)[k];
    return fail_key(s->ctx, KEY("bodies", s->scene->body[s->body[body].scene_body].name, "membrane"),
                    "its points about (%g, %g, %g) make no surface: they are too few, or on one line", x[0], x[1],
                    x[2]);
}

floe_status start_sheet(mpm *s, int body)
{
    for (int blk = 0; blk < s->mesh->n_blocks; ++blk) {
        const fields *f = s->domain->fields[blk];
        for (size_t k = 0; k < s->points[blk][body].n; ++k) {
            double normal[3];
            sheet_point p;
            normal_at(f, body, k, false, normal);
            if (normal[0] == 0.0 && normal[1] == 0.0 && normal[2] == 0.0) return no_direction(s, f, body, k);
            sheet_start(normal, exp(-slack_of(s, body, point_number(s, blk, body, k))), &p);
            store_point(f, body, k, false, &p);
            put_point_stress(s, f, body, k, false, &p);
        }
    }
    return FLOE_OK;
}

void sheet_energies(const mpm *s, int blk, int body, size_t start, size_t end, double *psi)
{
    for (size_t k = start; k < end; ++k) {
        sheet_point p;
        load_point(s->domain->fields[blk], body, k, false, &p);
        psi[k - start] = sheet_energy(&s->body[body].membrane, &p);
    }
}
