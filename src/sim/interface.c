#include "sim/interface.h"

#include "base/memory.h"
#include "embedded/cut.h"
#include "geom/bounds.h"
#include "ice/ice.h"
#include "mpm/basis/basis.h"
#include "mpm/surface/boundary.h"
#include "scene/flight.h"
#include "scene/layout.h"
#include "scene/mass_source.h"
#include "scene/scene_reach.h"
#include "scene/side_parts.h"
#include "scene/state.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>

/* ---- the scene ---- */

static bool is_solid(const scene *s, int body)
{
    return s->material[s->body[body].material].kind == MATERIAL_SOLID;
}

static int count_solids(const scene *s)
{
    int n = 0;
    for (int b = 0; b < s->n_bodies; ++b) n += is_solid(s, b);
    return n;
}

static int count_fluids(const scene *s)
{
    bool used[SCENE_MAX_MATERIALS] = {false};
    int n = 0;
    ice_find_used(s, false, used);
    for (int r = 0; r < s->n_materials; ++r) n += used[r];
    return n;
}

/* The key under which a scene is refused: a membrane's, or that of the interface. */
static floe_status no_lines(const scene *s, const char *why, const char *instead)
{
    const int holder = scene_enclosing_body(s);
    if (holder < 0) return fail_key(s->ctx, KEY("method", "interface"), "sharp %s: use smeared", why);
    return fail_key(s->ctx, KEY("bodies", s->body[holder].name, "membrane", "encloses"),
                    "a membrane around gas %s: use %s", why, instead);
}

/* ---- what cut cells of gas need, beside membranes too ---- */

static bool is_periodic(const mesh *m)
{
    return m->periodic[0] || m->periodic[1] || m->periodic[2];
}

static floe_status needs_surfaces(const scene *s, const mesh *m)
{
    if (m->dim > 1 && !is_periodic(m)) return FLOE_OK;
    return no_lines(s, "needs a domain in two or three dimensions without periodic sides", "mpm");
}

static floe_status needs_explicit_pressure(const scene *s, const mesh *m)
{
    (void)m;
    if (s->method.pressure == PRESSURE_EXPLICIT) return FLOE_OK;
    return fail_key(s->ctx, KEY("method", "pressure"),
                    "beside a membrane around gas, or a sharp interface, the pressure is explicit: leave it out");
}

/* Bodies that do not deform have no basis. */
static bool some_solid_deforms(const scene *s)
{
    for (int b = 0; b < s->n_bodies; ++b)
        if (is_solid(s, b) && !motion_is_given(&s->body[b].motion)) return true;
    return false;
}

/* The implicit pressure moves surfaces as their nodes alone tell (theory 7.8), and knows of nothing else that raises the pressure of cut cells. */
static floe_status needs_known_pressure(const scene *s, const mesh *m)
{
    const basis_model *basis = basis_find(s->method.basis);
    if (s->method.pressure != PRESSURE_IMPLICIT) return needs_explicit_pressure(s, m);
    if (some_solid_deforms(s) && basis && (basis->fact.hats || basis->fact.shaped))
        return fail_key(s->ctx, KEY("method", "pressure"),
                        "implicit beside a sharp interface takes solids that deform with basis quadratic or cubic, and "
                        "the basis is %s",
                        basis->name);
    for (int l = 0; l < s->n_loads; ++l)
        if (s->load[l].kind == LOAD_HEAT || s->load[l].kind == LOAD_PRESSURISE)
            return fail_key(s->ctx, KEY("loads", s->load[l].name),
                            "beside a sharp interface it acts on gas with the explicit pressure alone");
    if (s->n_reactions > 0)
        return fail_key(s->ctx, KEY("reactions", s->reaction[0].name),
                        "beside a sharp interface fluids react with the explicit pressure alone");
    return FLOE_OK;
}

/* Heat goes to what cells have of one gas, and gravity to all of it; other loads on gas do not support cut cells. */
static floe_status needs_plain_loads(const scene *s, const mesh *m)
{
    (void)m;
    for (int l = 0; l < s->n_loads; ++l) {
        const scene_load *load = &s->load[l];
        const bool heat = load->kind == LOAD_HEAT || load->kind == LOAD_PRESSURISE;
        if (!heat || count_fluids(s) == 1) continue;
        return fail_key(
            s->ctx, KEY("loads", load->name),
            "it acts on gas beside a membrane or a sharp interface, which cut cells do not take; use mpm, or "
            "leave it out");
    }
    return FLOE_OK;
}

static floe_status needs_no_conduction(const scene *s, const mesh *m)
{
    bool used[SCENE_MAX_MATERIALS] = {false};
    (void)m;
    ice_find_used(s, false, used);
    for (int r = 0; r < s->n_materials; ++r)
        if (used[r] && s->material[r].conductivity > 0.0)
            return fail_key(s->ctx, KEY("materials", s->material[r].name, "conductivity"),
                            "gas beside a membrane around it does not conduct heat; leave it out");
    return FLOE_OK;
}

static floe_status needs_no_reaction(const scene *s, const mesh *m)
{
    (void)m;
    return s->n_reactions == 0 ? FLOE_OK
                               : fail_key(s->ctx, KEY("reactions", s->reaction[0].name),
                                          "gas beside a membrane around it does not react; leave it out");
}

static floe_status needs_no_driving(const scene *s, const mesh *m)
{
    (void)m;
    for (int l = 0; l < s->n_loads; ++l)
        if (load_is_field_on(s, &s->load[l], -1))
            return fail_key(
                s->ctx, KEY("loads", s->load[l].name, "body_force"),
                "fluids beside a membrane around gas, or a sharp interface, take no body force that changes "
                "with place: take one acceleration everywhere, name a body on points, or "
                "method.interface smeared");
    return !s->driving
               ? FLOE_OK
               : fail_key(s->ctx, KEY("verify", "sources"),
                          "gas beside a membrane around it, or a sharp interface, has no sources; leave it out");
}

/* On cells only the membranes exist, and no other body: another body may be in the vacuum outside them, not in a
 * gas. */
static floe_status needs_membranes_alone(const scene *s, const mesh *m)
{
    int holder[SCENE_MAX_ENCLOSING];
    (void)m;
    if (count_fluids(s) == scene_enclosing_bodies(s, holder)) return FLOE_OK;
    for (int b = 0; b < s->n_bodies; ++b) {
        if (!is_solid(s, b) || s->body[b].membrane.encloses >= 0) continue;
        return fail_key(s->ctx, KEY("bodies", s->body[b].name),
                        "it stands in the gas beside a membrane around one, where cells do not see it; leave the "
                        "outer gas out, or use mpm");
    }
    return FLOE_OK;
}

/* ---- what surfaces of solids need ---- */

static floe_status needs_no_membrane(const scene *s, const mesh *m)
{
    (void)m;
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->material[s->body[b].material].membrane)
            return fail_key(s->ctx, KEY("method", "interface"),
                            "sharp is for solids, and body '%s' is a membrane: leave it out", s->body[b].name);
    return FLOE_OK;
}

/* Several may be apart from each other (check_regions), for which there are so many lines. */
static floe_status needs_few_fluids(const scene *s, const mesh *m)
{
    const int n = count_fluids(s);
    (void)m;
    if (n <= SCENE_MAX_ENCLOSING || s->fluids_share) return FLOE_OK;
    return fail_key(s->ctx, KEY("method", "interface"), "sharp takes %d fluids, and the scene has %d: use smeared",
                    SCENE_MAX_ENCLOSING, n);
}

/* Surfaces pass pressure and, of a viscous gas, shear: exchange over cells has no effect there. */
static floe_status needs_no_exchange(const scene *s, const mesh *m)
{
    static const char text[] = "a sharp interface has no exchange over cells: leave it out, or use interface smeared";
    (void)m;
    if (!isnan(s->method.exchange)) return fail_key(s->ctx, KEY("method", "exchange"), text);
    if (s->method.heat_exchange > 0.0) return fail_key(s->ctx, KEY("method", "heat_exchange"), text);
    for (int k = 0; k < s->n_exchanges; ++k)
        for (int i = 0; i < 2; ++i)
            if (s->material[s->exchange[k].material[i]].kind == MATERIAL_SOLID)
                return fail_key(s->ctx, KEY("exchange", s->exchange[k].name), text);
    return FLOE_OK;
}

/* Only where points fill a part of cells. */
static floe_status needs_no_relaxation(const scene *s, const mesh *m)
{
    (void)m;
    if (s->method.volume_relaxation == 0.0) return FLOE_OK;
    return fail_key(
        s->ctx, KEY("method", "volume_relaxation"),
        "beside a sharp interface no cell has volume to be relaxed: leave it out, or use interface smeared");
}

static void name_refused_point(int dim, const double x[3], char *place, size_t size)
{
    if (dim == 1)
        (void)snprintf(place, size, "%g", x[0]);
    else if (dim == 2)
        (void)snprintf(place, size, "(%g, %g)", x[0], x[1]);
    else
        (void)snprintf(place, size, "(%g, %g, %g)", x[0], x[1], x[2]);
}

static void middle_of(const mesh *m, const int cell[3], double x[3])
{
    for (int a = 0; a < 3; ++a) x[a] = a < m->dim ? mesh_centre(m, a, cell[a]) : 0.0;
}

static floe_status refuse_thin_at(const scene *s, const double x[3])
{
    char place[64];
    name_refused_point(s->mesh.dim, x, place, sizeof place);
    return fail_key(
        s->ctx, KEY("method", "interface"),
        "sharp: a solid is thinner than a cell at %s, where the gas of its two sides would share it: refine "
        "domain.cell, or leave it out",
        place);
}

/* A position where the boundaries leave no space between them for gas. */
static floe_status refuse_thin(const scene *s, const cut_surface *line)
{
    double x[3];
    bool thin;
    TRY(cut_find_thin(line, &thin, x));
    return thin ? refuse_thin_at(s, x) : FLOE_OK;
}

/* On a line a body that lies between two places where its surface is looked for has none. */
static floe_status refuse_unseen(const scene *s, const mesh *m, const scene_body *body)
{
    double lo[3], hi[3];
    if (m->dim > 1 || !shape_bounds(&body->shape, 1, lo, hi)) return FLOE_OK;
    return hi[0] > m->lower[0] && lo[0] < m->upper[0] ? refuse_thin_at(s, lo) : FLOE_OK;
}

static floe_status lay_body(const scene *s, const mesh *m, const scene_body *body, int fluid, cut_surface *line)
{
    const int before = line->n_chains + line->n_triangles;
    TRY(mpm_boundary_add(s, m, body, fluid, line));
    return fluid >= 0 || line->n_chains + line->n_triangles > before ? FLOE_OK : refuse_unseen(s, m, body);
}

static floe_status refuse_none(const scene *s)
{
    return fail_key(s->ctx, KEY("method", "interface"),
                    "sharp: no solid has a surface inside the domain; leave it out");
}

static floe_status check_line(const scene *s, cut_surface *line)
{
    if (line->n_vertices == 0) return refuse_none(s);
    if (line->mesh->dim == 1) TRY(refuse_thin(s, line));
    floe_status status = cut_find(line);
    if (status == FLOE_RETRY) status = FLOE_BAD_INPUT; /* the message stands */
    TRY(fail_under(s->ctx, status, KEY("method", "interface")));
    return line->n_pieces > 0 ? refuse_thin(s, line) : refuse_none(s);
}

static floe_status lay_bodies(const scene *s, const mesh *m, int fluid, cut_surface *line)
{
    for (int b = 0; b < s->n_bodies; ++b)
        if (is_solid(s, b)) TRY(lay_body(s, m, &s->body[b], fluid, line));
    return FLOE_OK;
}

/* A cell that another fluid, or none, fills on the side of a fluid. Said where a scene was not settled. */
static floe_status refuse_mixed(const scene *s, const mesh *m, int fluid, const int cell[3])
{
    char place[64];
    double x[3];
    middle_of(m, cell, x);
    name_refused_point(m->dim, x, place, sizeof place);
    return fail_key(s->ctx, KEY("method", "interface"), "sharp: at %s there is another fluid beside %s", place,
                    s->material[fluid].name);
}

/* A fluid beside no solid, where others are. */
static floe_status refuse_unbounded(const scene *s, int fluid)
{
    return fail_key(s->ctx, KEY("method", "interface"), "sharp: %s shares its region with another fluid",
                    s->material[fluid].name);
}

/* Of several fluids each has regions to itself, between solids and the sides of the domain. */
static floe_status check_regions(const scene *s, const mesh *m, int fluid, const cut_surface *line)
{
    for (int k = 0; k < m->n[2]; ++k)
        for (int j = 0; j < m->n[1]; ++j)
            for (int i = 0; i < m->n[0]; ++i) {
                const int cell[3] = {i, j, k};
                double x[3];
                middle_of(m, cell, x);
                const double open = cut_open(line, cell);
                const bool here = mpm_fluid_at(s, m->dim, x) == fluid;
                if ((open == 1.0 && !here) || (open == 0.0 && here)) return refuse_mixed(s, m, fluid, cell);
            }
    return FLOE_OK;
}

/* A side brings the fluid of the region that it bounds. */
static floe_status check_side(const scene *s, const mesh *m, int axis, int side)
{
    const int e = (axis + 1) % 3, f = (axis + 2) % 3;
    int cell[3] = {0, 0, 0};
    cell[axis] = side == SIDE_UPPER ? m->n[axis] - 1 : 0;
    for (int k = 0; k < m->n[e] * m->n[f]; ++k) {
        double x[3];
        cell[e] = k % m->n[e];
        cell[f] = k / m->n[e];
        middle_of(m, cell, x);
        double face[3] = {x[0], x[1], x[2]};
        face[axis] = side == SIDE_UPPER ? m->upper[axis] : m->lower[axis];
        const bc_side *given = scene_condition_at(s, axis, side, face);
        if (given->kind != BC_INLET && given->kind != BC_RESERVOIR) continue;
        const int found = mpm_fluid_at(s, m->dim, x);
        if (found >= 0 && found != given->material) return refuse_mixed(s, m, given->material, cell);
    }
    return FLOE_OK;
}

/* What divides the domain is seen, and what enters belongs there. */
static floe_status check_several(const scene *s, const mesh *m)
{
    cut_surface all;
    floe_status status = cut_create(&all, s->ctx, m);
    if (status == FLOE_OK) status = lay_bodies(s, m, -1, &all);
    cut_destroy(&all);
    for (int f = 0; f < 2 * m->dim && status == FLOE_OK; ++f) status = check_side(s, m, f / 2, f % 2);
    return status;
}

/* Those beside a fluid; -1: beside any. */
static floe_status check_surfaces(const scene *s, const mesh *m, int fluid)
{
    const bool alone = count_fluids(s) == 1 || fluid < 0;
    cut_surface line;
    floe_status status = cut_create(&line, s->ctx, m);
    line.overlap = BODIES_TOUCH; /* on a plane of the mesh their faces there are closed twice */
    if (status == FLOE_OK) status = lay_bodies(s, m, alone ? -1 : fluid, &line);
    if (status == FLOE_OK && !alone && line.n_chains + line.n_triangles == 0) status = refuse_unbounded(s, fluid);
    if (status == FLOE_OK) status = check_line(s, &line);
    if (status == FLOE_OK && !alone) status = check_regions(s, m, fluid, &line);
    cut_destroy(&line);
    return status;
}

/* Surfaces that cut the cells so that each part has its gas, or several that share cells. */
static floe_status needs_clear_surfaces(const scene *s, const mesh *m)
{
    bool used[SCENE_MAX_MATERIALS] = {false};
    if (s->fluids_share) return check_surfaces(s, m, -1);
    if (count_fluids(s) > 1) TRY(check_several(s, m));
    ice_find_used(s, false, used);
    for (int r = 0; r < s->n_materials; ++r)
        if (used[r]) TRY(check_surfaces(s, m, r));
    return FLOE_OK;
}

/* A surface does not recede from its points. */
static floe_status needs_no_burning(const scene *s, const mesh *m)
{
    (void)m;
    for (int k = 0; k < s->n_reactions; ++k)
        if (s->material[s->reaction[k].reactant].kind == MATERIAL_SOLID)
            return fail_key(s->ctx, KEY("reactions", s->reaction[k].name),
                            "sharp: the surface of a solid that burns does not recede: use smeared");
    return FLOE_OK;
}

/* ---- what surfaces support, though smeared is the better choice for the scene ---- */

static floe_status suits_no_sources(const scene *s, const mesh *m)
{
    (void)m;
    return s->verify.sources ? fail_key(s->ctx, KEY("verify", "sources"), "gas beside a sharp interface has no sources")
                             : FLOE_OK;
}

/* Each step lets only a share of the gas between a surface and an approaching side escape, so that the steps would go to zero. */
static floe_status suits_no_flight_out(const scene *s, const mesh *m)
{
    char side[16];
    const scene_flight f = scene_flight_out(s);
    (void)m;
    if (f.body < 0) return FLOE_OK;
    scene_side_name(s, f.axis, f.side, side);
    return fail_key(s->ctx, KEY("bodies", s->body[f.body].name, "velocity"),
                    "body '%s' comes to boundaries.%s at t = %.3g%s, where the gas before it ends a sharp run",
                    s->body[f.body].name, side, f.time, scene_time_unit(s));
}

/* ---- the table ---- */

typedef enum requirement_of { OF_MEMBRANES = 1, OF_SURFACES = 2, OF_AUTO = 4 } requirement_of;

typedef struct requirement {
    floe_status (*check)(const scene *s, const mesh *m);
    unsigned of; /* of what it is asked: requirement_of */
} requirement;

/* Cheap ones first: the last traces the surfaces. */
static const requirement requirements[] = {
    {needs_surfaces, OF_MEMBRANES},
    {needs_no_membrane, OF_SURFACES | OF_AUTO},
    {needs_few_fluids, OF_SURFACES | OF_AUTO},
    {needs_membranes_alone, OF_MEMBRANES},
    {needs_plain_loads, OF_MEMBRANES | OF_SURFACES | OF_AUTO},
    {needs_explicit_pressure, OF_MEMBRANES},
    {needs_known_pressure, OF_SURFACES | OF_AUTO},
    {needs_no_conduction, OF_MEMBRANES},
    {needs_no_reaction, OF_MEMBRANES},
    {needs_no_burning, OF_SURFACES | OF_AUTO},
    {needs_no_driving, OF_MEMBRANES | OF_SURFACES | OF_AUTO},
    {needs_no_exchange, OF_SURFACES | OF_AUTO},
    {needs_no_relaxation, OF_SURFACES | OF_AUTO},
    {suits_no_sources, OF_AUTO},
    {suits_no_flight_out, OF_AUTO},
    {needs_clear_surfaces, OF_SURFACES | OF_AUTO},
};

static floe_status check_all(const scene *s, const mesh *m, requirement_of of)
{
    for (size_t k = 0; k < sizeof requirements / sizeof *requirements; ++k)
        if (requirements[k].of & (unsigned)of) TRY(requirements[k].check(s, m));
    return FLOE_OK;
}

floe_status interface_check(const scene *s, const mesh *m)
{
    return check_all(s, m, s->method.interface == INTERFACE_SHARP ? OF_SURFACES : OF_MEMBRANES);
}

/* Whether solids do not keep the fluids apart. */
static floe_status find_sharing(scene *s, const mesh *m)
{
    bool used[SCENE_MAX_MATERIALS] = {false};
    s->fluids_share = false;
    if (count_fluids(s) < 2) return FLOE_OK;
    s->fluids_share = s->n_reactions > 0 || mass_source_joins(s); /* a product comes to be where its reactant is */
    if (s->fluids_share) return FLOE_OK;
    ice_find_used(s, false, used);
    floe_status status = needs_few_fluids(s, m);
    if (status == FLOE_OK) status = check_several(s, m);
    for (int r = 0; r < s->n_materials && status == FLOE_OK; ++r)
        if (used[r]) status = check_surfaces(s, m, r);
    if (status != FLOE_BAD_INPUT) return status;
    context_clear(s->ctx);
    s->fluids_share = true;
    return FLOE_OK;
}

static bool runs_coupled(const scene *s)
{
    for (int k = 0; k < s->n_runs_as; ++k)
        if (s->runs_as[k] == COUPLING_ICE_MPM) return true;
    return s->coupling == COUPLING_ICE_MPM;
}

static void choose_interface(scene *s, solid_interface which, const char *why)
{
    s->method.interface = which;
    (void)snprintf(s->interface_reason, sizeof s->interface_reason, "auto: %s%s",
                   which == INTERFACE_SHARP ? "sharp" : "smeared", why);
}

/* Whether `auto` and `sharp` look for surfaces in it. */
static bool is_traced(const scene *s)
{
    return s->method.interface != INTERFACE_SMEARED && runs_coupled(s) && count_solids(s) > 0 &&
           scene_enclosing_body(s) < 0;
}

floe_status interface_check_size(const scene *s, const mesh *m)
{
    double nodes = 1.0;
    for (int a = 0; a < m->dim; ++a) nodes *= m->n[a] + 1.0;
    if (nodes < INT_MAX || !is_traced(s)) return FLOE_OK; /* cut cells are numbered by int */
    return fail_key(s->ctx, KEY("domain", "cell"),
                    "%g: in %.3g cells the surfaces of solids cannot be traced, in %.2g at most: take a cell of %.2g "
                    "or more",
                    s->mesh.cell[0], nodes, (double)INT_MAX, s->mesh.cell[0] * pow(nodes / INT_MAX, 1.0 / m->dim));
}

/* Asks of the bodies' shapes as they are filled, which `yields` has parts taken out of; where bodies overlap, of those of the deck: that is refused elsewhere. */
static floe_status look_at_layout(scene *s, const mesh *m, bool check)
{
    scene_layout *made = NULL;
    floe_status status = scene_lay_out(&made, s, COUPLING_ICE_MPM, m);
    if (status == FLOE_BAD_INPUT) {
        context_clear(s->ctx);
        status = FLOE_OK;
    }
    scene *as_filled = made ? &made->scene : s;
    if (status == FLOE_OK) status = find_sharing(as_filled, m);
    s->fluids_share = as_filled->fluids_share;
    if (status == FLOE_OK && check) status = check_all(as_filled, m, OF_AUTO);
    memory_free(s->ctx, &made);
    return status;
}

static floe_status settle_auto(scene *s)
{
    mesh m;
    char why[sizeof s->interface_reason - 16];
    const bool traced = is_traced(s) && count_fluids(s) > 0;
    s->method.interface = INTERFACE_SMEARED;
    if (!traced) return FLOE_OK;
    floe_status status = mesh_init(&m, s->ctx, &s->mesh);
    if (status == FLOE_OK) status = look_at_layout(s, &m, true);
    if (status == FLOE_OK) choose_interface(s, INTERFACE_SHARP, "");
    if (status != FLOE_BAD_INPUT) return status;
    (void)snprintf(why, sizeof why, ", as %s", context_message(s->ctx));
    context_clear(s->ctx);
    choose_interface(s, INTERFACE_SMEARED, why);
    return FLOE_OK;
}

/* What an explicit `sharp` needs to know; what it does not support is said when the solver is made. */
static floe_status settle_sharp(scene *s)
{
    mesh m;
    if (!is_traced(s)) return FLOE_OK;
    TRY(mesh_init(&m, s->ctx, &s->mesh));
    return look_at_layout(s, &m, false);
}

floe_status interface_settle(scene *s)
{
    if (s->method.interface == INTERFACE_AUTO)
        TRY(settle_auto(s));
    else if (s->method.interface == INTERFACE_SHARP)
        TRY(settle_sharp(s));
    if (s->time.substeps == SCENE_SUBSTEPS_OPEN) s->time.substeps = s->method.interface == INTERFACE_SHARP ? 0 : 1;
    return FLOE_OK;
}

const char *interface_in_words(const sim *s)
{
    if (!s->mpm || !s->ice || scene_enclosing_body(s->scene) >= 0) return "";
    if (s->scene->interface_reason[0]) return s->scene->interface_reason;
    return s->scene->method.interface == INTERFACE_SHARP ? "sharp" : "smeared";
}
