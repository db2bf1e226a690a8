#include "io/history_columns.h"

#include "io/names.h"
#include "io/probe.h"
#include "mpm/surface/boundary.h"
#include "sim/tracer.h"

#include <math.h>

/* A line in progress. */
typedef struct line {
    const sim *s;
    strbuf *out;
    bool names;   /* the first line, not a row */
    int columns;  /* so far */
    double whole; /* output_scale: from a metre of depth or a radian to all of it */
} line;

static const char *column_separator(line *l)
{
    return l->columns++ > 0 ? "," : "";
}

static void add_value(line *l, const char *name, const char *unit, double value)
{
    if (l->names) {
        strbuf_append(l->out, "%s%s (%s)", column_separator(l), name, output_unit(l->s, unit));
    } else {
        strbuf_append(l->out, "%s%.17g", column_separator(l),
                      isnan(value) ? (double)NAN : value); /* "nan", never "-nan" */
    }
}

static void add_count(line *l, const char *name, long value)
{
    if (l->names) {
        strbuf_append(l->out, "%s%s", column_separator(l), name);
    } else {
        strbuf_append(l->out, "%s%ld", column_separator(l), value);
    }
}

/* In quotes, without any inside. */
static void add_words(line *l, const char *name, const char *words)
{
    strbuf_append(l->out, "%s%s", column_separator(l), l->names ? name : "\"");
    if (l->names) return;
    for (; words && *words; words++) strbuf_append(l->out, "%c", *words == '"' || *words == '\n' ? '\'' : *words);
    strbuf_append(l->out, "\"");
}

static void add_vector(line *l, const char *name, const char *unit, const double *value)
{
    static const char axis[] = "xyz", axis_rz[] = "rzt";
    const bool rz = l->s->mesh.geometry == MESH_AXISYMMETRIC;
    for (int a = 0; a < l->s->mesh.dim; a++) {
        char full[2 * NAME_SIZE + 2];
        (void)snprintf(full, sizeof full, "%s_%c", name, rz ? axis_rz[a] : axis[a]);
        add_value(l, full, unit, value[a]);
    }
}

/* What a material holds, cells and points together. */
typedef struct holding {
    double mass, kinetic, strain, internal, pressure;
} holding;

static holding holding_of(const sim *s, const sim_totals *t, int material)
{
    holding sum = {0};
    const int bodies = s->mpm ? s->mpm->n_bodies : 0;
    const int materials = s->ice ? s->ice->n_materials : 0;
    for (int b = 0; b < bodies; b++) {
        if (s->mpm->body[b].scene_material != material) continue;
        sum.mass += t->mpm.mass[b];
        sum.kinetic += t->mpm.kinetic[b];
        sum.strain += t->mpm.strain[b];
        sum.internal += t->mpm.internal[b];
    }
    for (int r = 0; r < materials; r++) {
        if (s->ice->material[r].scene_material != material || s->ice->material[r].points) continue;
        sum.mass += t->ice.mass[r];
        sum.kinetic += t->ice.kinetic[r];
        sum.internal += t->ice.internal[r];
    }
    return sum;
}

static void add_named(line *l, const char *quantity, const char *label, const char *unit, double value)
{
    char name[2 * NAME_SIZE];
    (void)snprintf(name, sizeof name, "%s_%s", quantity, label);
    add_value(l, name, unit, value);
}

/* Whether the points of a material carry a temperature. */
static bool material_warms(const sim *s, int material)
{
    for (int b = 0; s->mpm && b < s->mpm->n_bodies; b++)
        if (s->mpm->body[b].scene_material == material && s->mpm->body[b].warms) return true;
    return false;
}

static void add_material_columns(line *l, int material, const history_row *row)
{
    const scene_material *m = &l->s->scene->material[material];
    const bool fluid = m->kind == MATERIAL_FLUID;
    char label[NAME_SIZE];
    holding sum = {0};
    material_label(l->s, material, label);
    if (row) sum = holding_of(l->s, row->totals, material);
    const double whole = l->whole;
    if (row && fluid) sum.pressure = row->mean_pressure ? row->mean_pressure[material] : (double)NAN;
    add_named(l, "mass", label, "kg", whole * sum.mass);
    add_named(l, "kinetic", label, "J", whole * sum.kinetic);
    if (!fluid) add_named(l, "strain", label, "J", whole * sum.strain);
    if (fluid || (m->law && m->law->needs & SOLID_HAS_ENERGY) || material_warms(l->s, material))
        add_named(l, "internal", label, "J", whole * sum.internal);
    if (fluid) add_named(l, "pressure", label, "Pa", sum.pressure);
}

static const char *unit_of(int quantity)
{
    if (quantity == LEDGER_MASS) return "kg";
    if (quantity == LEDGER_ENERGY) return "J";
    return quantity >= LEDGER_MOMENT_X ? "N m s" : "N s";
}

/* Momenta along axes that the scene does not have, that along r, and moments that nothing keeps are left out. */
static bool is_used(const sim *s, int quantity)
{
    return !s->ledger.not_conserved[quantity];
}

static void add_ledger(line *l)
{
    static const char *const kinds[LEDGER_KINDS] = {"boundary", "source", "damping", "defect", "contact"};
    const ledger *account = &l->s->ledger;
    for (int q = 0; q < LEDGER_QUANTITIES; q++) {
        const char *name = ledger_quantity_name((ledger_quantity)q);
        if (is_used(l->s, q))
            add_named(l, "drift", name, "1", l->names ? 0.0 : ledger_drift(account, (ledger_quantity)q));
    }
    for (int q = 0; q < LEDGER_QUANTITIES; q++) {
        const char *name = ledger_quantity_name((ledger_quantity)q);
        if (is_used(l->s, q))
            add_named(l, "largest_drift", name, "1",
                      l->names ? 0.0 : fabs(ledger_largest_drift(account, (ledger_quantity)q)));
    }
    for (int q = 0; q < LEDGER_QUANTITIES; q++) {
        for (int k = 0; k < LEDGER_KINDS && is_used(l->s, q); k++) {
            if (k == LEDGER_CONTACT && !(l->s->scene->contact.enabled && q == LEDGER_ENERGY)) continue;
            const ledger_sum *sum = &account->entry[q][k];
            char quantity[NAME_SIZE];
            (void)snprintf(quantity, sizeof quantity, "ledger_%s", ledger_quantity_name((ledger_quantity)q));
            add_named(l, quantity, kinds[k], unit_of(q), l->whole * (sum->value + sum->carry));
        }
    }
}

static void add_probe(line *l, int n)
{
    const scene_probe *probe = &l->s->scene->probe[n];
    const probe_value value = l->names ? (probe_value){0} : probe_read(l->s, probe->position);
    char label[NAME_SIZE], velocity[NAME_SIZE + 16];
    probe_label(l->s, n, label);
    (void)snprintf(velocity, sizeof velocity, "%s_velocity", label);
    add_named(l, label, "pressure", "Pa", value.pressure);
    add_vector(l, velocity, "m/s", value.velocity);
}

/* A tracer's displacement, velocity and, where its body has one, stress. */
static void add_tracer(line *l, int n, const tracer_value *value)
{
    char label[NAME_SIZE], name[NAME_SIZE + 16];
    if (!tracer_is_of_points(l->s, n)) return;
    tracer_label(l->s, n, label);
    (void)snprintf(name, sizeof name, "%s_displacement", label);
    add_vector(l, name, "m", value->displacement);
    (void)snprintf(name, sizeof name, "%s_velocity", label);
    add_vector(l, name, "m/s", value->velocity);
    const field_components components = field_describe(P_STRESS)->components;
    for (int c = 0; c < field_component_count(components, l->s->mesh.dim) && tracer_has_stress(l->s, n); c++) {
        char stress[sizeof label + 16];
        (void)snprintf(stress, sizeof stress, "%s_stress", label);
        add_named(l, stress, component_name(l->s, components, c), "Pa", value->stress[c]);
    }
}

static void add_tracers(line *l)
{
    tracer_value value[SCENE_MAX_TRACERS] = {0};
    if (!l->s->tracers) return;
    if (!l->names) tracers_read(l->s, value);
    for (int n = 0; n < l->s->scene->n_tracers; n++) add_tracer(l, n, &value[n]);
}

/* What a membrane encloses. */
static void add_enclosed_gas_columns(line *l, int body, const char *label, const history_row *row)
{
    const int holds = l->s->scene->body[l->s->mpm->body[body].scene_body].membrane.encloses;
    const bool radial = l->s->mesh.geometry == MESH_AXISYMMETRIC, space = l->s->mesh.dim == 3;
    membrane_enclosure enclosure = {0};
    if (row) mpm_membrane_enclosure(l->s->mpm, body, &enclosure);
    if (row && l->s->embedded && holds >= 0) { /* the gas is on the cells */
        enclosure.pressure = row->mean_pressure ? row->mean_pressure[holds] : (double)NAN;
        enclosure.outside = ice_mass_beyond(l->s->ice, ice_material_of(l->s->ice, holds));
    }
    if (radial || space)
        add_named(l, "volume", label, "m3", l->whole * enclosure.size);
    else
        add_named(l, "area", label, "m2", enclosure.size);
    add_named(l, "pressure_in", label, "Pa", enclosure.pressure);
    add_named(l, "outside", label, "kg", l->whole * enclosure.outside);
    add_named(l, "stress", label, "Pa", enclosure.stress);
    if (radial) add_named(l, "hoop_stress", label, "Pa", enclosure.hoop);
}

/* Moment of momentum about the origin, where there is one. */
static void add_spin(line *l, int body, const char *label, const history_row *row)
{
    const mesh *m = &l->s->mesh;
    double spin[MESH_MAX_DIM] = {0};
    char name[2 * NAME_SIZE];
    if (m->dim < 2 || m->geometry == MESH_AXISYMMETRIC) return;
    for (int a = 0; row && a < MESH_MAX_DIM; a++)
        spin[a] = row->totals->turns ? l->whole * row->totals->spin[body][a] : (double)NAN;
    (void)snprintf(name, sizeof name, "angular_momentum_%s", label);
    if (m->dim == 3)
        add_vector(l, name, "N m s", spin);
    else
        add_value(l, name, "N m s", spin[2]);
}

/* What others do to a body that does not deform; of one that does, what the fluids do beyond a sharp surface. */
static void add_force_columns(line *l, int body, const char *label)
{
    const mesh *m = &l->s->mesh;
    double force[3], moment[3];
    char name[2 * NAME_SIZE];
    if (!mpm_motion_force(l->s->mpm, body, force, moment)) {
        if (!mpm_boundary_sum_force(l->s->mpm, body, force)) return;
        for (int a = 0; a < 3; a++) force[a] *= l->whole;
        (void)snprintf(name, sizeof name, "force_%s", label);
        add_vector(l, name, "N", force);
        return;
    }
    for (int a = 0; a < 3; a++) {
        force[a] *= l->whole;
        moment[a] *= l->whole;
    }
    (void)snprintf(name, sizeof name, "force_%s", label);
    add_vector(l, name, "N", force);
    (void)snprintf(name, sizeof name, "moment_%s", label);
    if (m->dim == 3)
        add_vector(l, name, "N m", moment);
    else if (m->dim == 2 && m->geometry != MESH_AXISYMMETRIC)
        add_value(l, name, "N m", moment[2]);
}

/* Where a body of points is and how it moves, as a whole; of an open membrane also its ends. */
static void add_body_columns(line *l, int body, const history_row *row)
{
    const mpm_body *b = &l->s->mpm->body[body];
    const scene_body *given = &l->s->scene->body[b->scene_body];
    double centre[MESH_MAX_DIM] = {0}, velocity[MESH_MAX_DIM] = {0}, end[MESH_MAX_DIM] = {0};
    char label[NAME_SIZE], name[2 * NAME_SIZE];
    body_label(l->s, b->scene_body, label);
    for (int a = 0; a < MESH_MAX_DIM && row; a++) {
        const double mass = row->totals->mpm.mass[body];
        centre[a] = row->totals->mpm.moment[body][a] / mass;
        velocity[a] = row->totals->mpm.momentum[body][a] / mass;
    }
    (void)snprintf(name, sizeof name, "centre_%s", label);
    add_vector(l, name, "m", centre);
    (void)snprintf(name, sizeof name, "velocity_%s", label);
    add_vector(l, name, "m/s", velocity);
    if (b->warms) {
        const mpm_totals *t = row ? &row->totals->mpm : NULL;
        add_named(l, "temperature", label, "K", t ? t->heat[body] / (t->mass[body] * b->specific_heat) : 0.0);
    }
    add_spin(l, body, label, row);
    add_force_columns(l, body, label);
    const bool ends = given->membrane.present && given->membrane.surface.kind == SHEET_NONE;
    for (int last = 0; last < 2 && ends && !curve_is_closed(&given->membrane.curve); last++) {
        if (row) mpm_membrane_end(l->s->mpm, body, last == 1, end);
        (void)snprintf(name, sizeof name, "%s_%s", last ? "last" : "first", label);
        add_vector(l, name, "m", end);
    }
    if (l->s->mpm->enclosure && given->membrane.encloses >= 0)
        add_named(l, "volume", label, "m3", row ? mpm_enclosed_volume(l->s->mpm, body) : 0.0);
    if (mpm_membrane_encloses(l->s->mpm, body)) add_enclosed_gas_columns(l, body, label, row);
}

/* Of all fluids, in cells that solids fill. */
static double mass_beyond(const sim *s)
{
    double sum = 0.0;
    for (int r = 0; r < s->ice->n_materials; r++) sum += ice_mass_beyond(s->ice, r);
    return sum;
}

static floe_status visit_columns(const sim *s, const history_row *row, strbuf *out)
{
    line l = {.s = s, .out = out, .names = !row, .whole = output_scale(s)};
    double momentum[MESH_MAX_DIM] = {0};
    for (int a = 0; a < MESH_MAX_DIM && row; a++) momentum[a] = l.whole * row->totals->momentum[a];
    add_value(&l, "time", "s", row ? row->totals->time : 0.0);
    add_count(&l, "steps", s->steps);
    add_count(&l, "rejected_steps", s->rejected);
    add_value(&l, "dt", "s", s->dt);
    add_words(&l, "dt_limit", s->dt_reason);
    add_value(&l, "mass", "kg", row ? l.whole * row->totals->mass : 0.0);
    add_vector(&l, "momentum", "N s", momentum);
    add_value(&l, "kinetic", "J", row ? l.whole * row->totals->kinetic : 0.0);
    add_value(&l, "strain", "J", row ? l.whole * row->totals->strain : 0.0);
    add_value(&l, "internal", "J", row ? l.whole * row->totals->internal : 0.0);
    for (int m = 0; m < s->scene->n_materials; m++) add_material_columns(&l, m, row);
    if (s->embedded && s->scene->method.interface == INTERFACE_SHARP)
        add_value(&l, "gas_in_solids", "kg", row ? l.whole * mass_beyond(s) : 0.0);
    if (s->scene->n_springs > 0) add_value(&l, "strain_springs", "J", row ? l.whole * row->totals->mpm.springs : 0.0);
    for (int b = 0; s->mpm && b < s->mpm->n_bodies; b++) add_body_columns(&l, b, row);
    add_ledger(&l);
    for (int p = 0; p < s->scene->n_probes; p++) add_probe(&l, p);
    add_tracers(&l);
    strbuf_append(out, "\n");
    return out->status;
}

floe_status history_names(const sim *s, strbuf *out)
{
    return visit_columns(s, NULL, out);
}

floe_status history_values(const sim *s, const history_row *row, strbuf *out)
{
    return visit_columns(s, row, out);
}
