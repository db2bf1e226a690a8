/* Membranes whose strain comes from the positions of their points.
 *
 * The stretch of a point is the distance of its neighbours over that at rest: unlike the integral of a rate, it cannot
 * drift from the shape. Within a cell the mesh moves the points together, so that no force evens out differences of strain
 * between points of one cell: of a membrane that has snapped taut a third of the points then carries the load, and two
 * thirds are slack (docs/deviations.md). `smoothing` replaces such a force: in every step the points lose a share of the
 * fourth difference of their positions. Segments shorter than a cell straighten and even out; a wave m points long
 * loses (2 pi/m)^4 of the share in a step, so that waves which the mesh resolves do not change. */
#include "base/memory.h"
#include "grid/tile_box.h"
#include "mpm/fluid/fluid.h"
#include "mpm/membrane/membrane_curve.h"

#include <math.h>
#include <string.h>

typedef double *field_getter(const fields *f, field_id id, int instance, int comp);

static const scene_membrane *membrane_of(const mpm *s, int body)
{
    return &s->scene->body[s->body[body].scene_body].membrane;
}

/* A point field into a table by number. */
static void read_table(const mpm *s, int body, field_id id, bool next, double *table)
{
    field_getter *get = next ? field_next : field_get;
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        const double *a = get(s->domain->fields[b], id, body, 0);
        for (size_t k = 0; k < s->points[b][body].n; ++k) table[point_number(s, b, body, k)] = a[k];
    }
}

floe_status membrane_curve_measure(mpm *s, int body)
{
    membrane_curve *curve = &s->curve[body];
    const bool around = s->mesh->geometry == MESH_AXISYMMETRIC;
    TRY(memory_new(s->ctx, &curve->rest, 13 * curve->n, sizeof *curve->rest));
    curve->volume = curve->rest + curve->n;
    curve->along = curve->volume + curve->n;
    curve->across = curve->along + curve->n;
    curve->before = curve->across + curve->n;
    curve->pace = curve->before + curve->n;
    curve->lost = curve->pace + curve->n;
    curve->bend = curve->lost + curve->n;
    curve->shift = curve->bend + 3 * curve->n;
    membrane_curve_update(s, body, false);
    read_table(s, body, P_VOLUME0, false, curve->volume);
    read_table(s, body, P_STRAIN, false, curve->along); /* less its slack */
    const scene_membrane *m = membrane_of(s, body);
    for (size_t q = 0; q < curve->n; ++q) {
        /* Volumes at rest: those at the start where the volume stays; about an axis the radius at rest is another, too. */
        const double section = m->thickness * (around ? curve->x[3 * q] : 1.0), less = m->section != SECTION_THICKNESS
                                                                                           ? curve->along[q]
                                                                                       : around ? -curve->along[q]
                                                                                                : 0.0;
        curve->rest[q] = section > 0.0 ? curve->volume[q] / section * exp(-less) : 0.0;
    }
    return FLOE_OK;
}

void membrane_curve_strains_at(const mpm *s, int body)
{
    membrane_curve *curve = &s->curve[body];
    for (size_t q = 0; q < curve->n; ++q) {
        double chord[3], rest;
        const double length = membrane_curve_chord(s, body, q, chord, &rest);
        curve->along[q] = length > 0.0 && rest > 0.0 ? log(length / rest) : 0.0;
    }
}

void membrane_curve_strain(const mpm *s, int body, bool next)
{
    const membrane_curve *curve = &s->curve[body];
    membrane_curve_strains_at(s, body);
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        double *strain = (next ? field_next : field_get)(s->domain->fields[b], P_STRAIN, body, 0);
        for (size_t k = 0; k < s->points[b][body].n; ++k) strain[k] = curve->along[point_number(s, b, body, k)];
    }
}

/* Adds the energies of the points, with a sign, to what is lost. */
static void add_energies(const mpm *s, int body, double sign)
{
    membrane_curve *curve = &s->curve[body];
    membrane_curve_strains_at(s, body);
    for (size_t q = 0; q < curve->n; ++q)
        curve->lost[q] +=
            sign * curve->volume[q] * membrane_energy(&s->body[body].membrane, curve->along[q], curve->across[q]);
}

/* The share of the fourth difference of positions that smoothing removes. */
static void find_shifts(const mpm *s, int body)
{
    const membrane_curve *curve = &s->curve[body];
    const double share = membrane_of(s, body)->smoothing;
    double *second = curve->bend;
    for (size_t q = 0; q < curve->n; ++q)
        if (!membrane_curve_second_difference(s, body, q, second + 3 * q))
            memset(second + 3 * q, 0, 3 * sizeof *second);
    for (size_t q = 0; q < curve->n; ++q) {
        const curve_neighbour side[2] = {membrane_curve_neighbour(curve, q, -1), membrane_curve_neighbour(curve, q, 1)};
        for (int a = 0; a < 3; ++a) {
            double sum = -2.0 * second[3 * q + (size_t)a];
            for (int k = 0; k < 2; ++k)
                if (side[k].of >= 0)
                    sum += (side[k].mirror && side[k].mirror->axis == a ? -1.0 : 1.0) * second[3 * side[k].of + a];
            curve->shift[3 * q + (size_t)a] = side[0].of < 0 || side[1].of < 0 ? 0.0 : share * sum;
        }
    }
}

/* Gives the points their new places, and notes the tiles in which one has changed cell. */
static void put_places(const mpm *s, int body)
{
    const membrane_curve *curve = &s->curve[body];
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int t = 0; t < s->mesh->block[b].n_tiles; ++t) {
            const size_t *at = s->points[b][body].tile_start;
            uint32_t *moved = &s->moved[tile_box_of(s->mesh, &s->mesh->block[b], t).number];
            for (int a = 0; a < s->mesh->dim; ++a) {
                double *x = field_next(s->domain->fields[b], P_POS, body, a);
                const double *from = field_get(s->domain->fields[b], P_POS, body, a);
                for (size_t k = at[t]; k < at[t + 1]; ++k) {
                    x[k] = curve->x[3 * point_number(s, b, body, k) + (size_t)a];
                    if (mesh_cell_of(s->mesh, a, x[k]) != mesh_cell_of(s->mesh, a, from[k]))
                        *moved |= UINT32_C(1) << body;
                }
            }
        }
}

/* Nominal stresses (Pa) along the curve at strains `along`. */
static double nominal_stress(const mpm *s, int body, double along, double across)
{
    const membrane_response *r = &s->body[body].membrane;
    double stress, none;
    membrane_stress(r, 1, &along, &across, &stress, &none);
    return stress * membrane_volume_ratio(r->section, along, across);
}

/* Nodes work on the rate at a point, and its neighbours' places tell its strain: the difference is lost, or won. USL
 * alone strains by the velocities that move the points, so that it is known. */
static void lose_difference(const mpm *s, int body)
{
    membrane_curve *curve = &s->curve[body];
    if (s->scene->method.stress != STRESS_USL) return;
    read_table(s, body, P_STRAIN, false, curve->before);
    membrane_curve_strains_at(s, body);
    for (size_t q = 0; q < curve->n; ++q) {
        const double mean = 0.5 * (nominal_stress(s, body, curve->before[q], curve->across[q]) +
                                   nominal_stress(s, body, curve->along[q], curve->across[q]));
        curve->lost[q] += curve->volume[q] * mean * (curve->pace[q] - (curve->along[q] - curve->before[q]));
    }
}

/* The energy lost is a loss of the method, as that of PIC: heat of a gas where losses are heat, else drift. Flutter
 * that the difference of rates and places has fed is no damping. */
static void smooth_flutter(mpm *s, int body)
{
    membrane_curve *curve = &s->curve[body];
    const bool heats = losses_are_heat(s);
    if (heats) add_energies(s, body, 1.0);
    find_shifts(s, body);
    for (size_t i = 0; i < 3 * curve->n; ++i) curve->x[i] -= curve->shift[i];
    put_places(s, body);
    if (heats) add_energies(s, body, -1.0);
}

void membrane_curve_hoop_strains(mpm *s, int body)
{
    read_table(s, body, P_STRAIN_HOOP, false, s->curve[body].across);
}

void membrane_curve_settle(mpm *s, int body)
{
    const membrane_curve *curve = &s->curve[body];
    memset(curve->lost, 0, curve->n * sizeof *curve->lost);
    if (s->carries[P_STRAIN_HOOP]) read_table(s, body, P_STRAIN_HOOP, true, curve->across);
    if (losses_are_heat(s)) lose_difference(s, body);
    if (membrane_of(s, body)->smoothing > 0.0) smooth_flutter(s, body);
}
