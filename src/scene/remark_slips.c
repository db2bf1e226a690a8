/* Numbers a thousand times off that can be read and run: of fluids, yield, loads, sizes, speeds, damping and rest. Each is held against
 * what the scene itself says, or against what matter is like. */
#include "scene/remark_internal.h"

#include "geom/bounds.h"

#include <math.h>
#include <string.h>

/* ---- materials ---- */

/* A fluid at the density rho (kg/m3) or, where that is no number, at a pressure and a temperature. */
typedef struct fluid_state {
    double rho, heat, c; /* kg/m3; J/kg/K; m/s */
} fluid_state;

static fluid_state state_of(const eos *law, double p, double T)
{
    fluid_state f = {0};
    double e, warm, own, c2;
    const double warmer = 1.01 * T;
    f.rho = eos_density(law, p, T);
    law->model->energy(law->par, 1, &f.rho, &T, &e);
    law->model->energy(law->par, 1, &f.rho, &warmer, &warm);
    f.heat = (warm - e) / (warmer - T);
    law->model->pressure(law->par, 1, &f.rho, &e, &own, &c2);
    f.c = sqrt(c2);
    return f;
}

/* Per kelvin xenon has 95 J/kg at constant volume, hydrogen 10200; sound in liquids is between that in helium (180 m/s) and in molten metals. */
static void remark_fluid(remark_speaker *w, const scene_material *m)
{
    const bool liquid = eos_is_liquid(&m->eos);
    const fluid_state f = state_of(&m->eos, 1e5, 300.0);
    remark_set_key(w, "materials", m->name, "eos");
    if (f.heat > 0.0 && (f.heat < 40.0 || f.heat > 2e4))
        remark_key(
            w,
            "fluid '%s' takes %.3g J/kg/K: xenon takes 95, hydrogen 10200. Give the specific heat in J/kg/K, not in kJ",
            m->name, f.heat);
    if (liquid && (f.rho < 30.0 || f.rho > 25000.0))
        remark_key(w,
                   "liquid '%s' has %.3g kg/m3 at 1 bar and 300 K: water has 1000. Give its pressures in Pa, and "
                   "specific heats in J/kg/K",
                   m->name, f.rho);
    if (liquid && (f.c < 100.0 || f.c > 1e4))
        remark_key(w,
                   "the speed of sound of liquid '%s' is %.3g m/s at 300 K: water has 1500. Give its moduli and "
                   "pressures in Pa",
                   m->name, f.c);
}

static void remark_membrane(remark_speaker *w, const scene_material *m)
{
    const double c = sqrt(m->membrane->modulus(m->membrane_par, false) / m->density);
    remark_set_key(w, "materials", m->name, "membrane");
    if (c < 1.0 || c > 1e5)
        remark_key(w,
                   "waves run along membrane '%s' at %.3g m/s at %g kg/m3: rubber has 30, steel 5000, and none beyond "
                   "20000. Give the modulus in Pa, or with its unit, and the density in kg/m3",
                   m->name, c, m->density);
    remark_set_key(w, "materials", m->name, "density");
    if (m->density < 5.0 || m->density > 23000.0)
        remark_key(w,
                   "membrane '%s' has %g kg/m3: light foams have 10, osmium 22600. Give it in kg/m3 (1 g/cm3 is 1000)",
                   m->name, m->density);
}

/* A parameter of a law by its key; NAN where the law has none of that name. */
static double parameter_of(const scene_material *m, const char *key)
{
    for (size_t k = 0; k < m->law->n_params; ++k)
        if (strcmp(m->law->params[k].key, key) == 0)
            return *(const double *)((const char *)m->law_par + m->law->params[k].offset);
    return NAN;
}

/* No solid bears more shear than a tenth or so of its modulus; the softest metals flow at some ten-thousandths of it. */
static void remark_yield(remark_speaker *w, const scene_material *m)
{
    if (!m->law->yield_stress || isnan(parameter_of(m, "yield_stress"))) return; /* soils flow without any */
    const double share = m->law->yield_stress(m->law_par) / m->law->shear_modulus(m->law_par);
    remark_set_key(w, "materials", m->name, "law");
    if (share > 0.25 || share < 1e-4)
        remark_key(w,
                   "solid '%s' flows at %.3g of its shear modulus: metals at 0.0005 to 0.05, and none beyond 0.2. Give "
                   "yield_stress in Pa, or with its unit",
                   m->name, share);
}

/* Beyond yield a metal is softer than before. */
static void remark_hardening(remark_speaker *w, const scene_material *m)
{
    const double K = m->law->bulk_modulus(m->law_par), G = m->law->shear_modulus(m->law_par);
    const double E = 9.0 * K * G / (3.0 * K + G), hardening = parameter_of(m, "hardening_modulus");
    remark_set_key(w, "materials", m->name, "law");
    if (hardening > E)
        remark_key(w,
                   "the hardening_modulus of solid '%s' is %.3g times its Young's modulus, %.3g Pa: metals have a "
                   "hundredth or less, and none is stiffer once it flows. Give it in Pa, or with its unit",
                   m->name, hardening / E, E);
}

/* ---- bodies ---- */

/* Paths of molecules between their collisions, about (m): of air. */
static double free_path(double p, double T)
{
    return 2.3e-5 * T / p;
}

static double smallest_cell(const scene *s)
{
    double h = INFINITY;
    for (int a = 0; a < s->mesh.dim; ++a) h = fmin(h, s->mesh.cell[a]);
    return h;
}

static void remark_gas(const remark_speaker *w, const eos *law, double p, double T)
{
    if (!(p > 0.0) || !(T > 0.0) || !law->model || eos_is_liquid(law)) return;
    const double rho = state_of(law, p, T).rho, cell = smallest_cell(w->s);
    if (T > 5e4) remark_key(w, "%g K: the surface of the sun has 5800 K. Give the temperature in K", T);
    if (rho > 500.0 && T < 2000.0)
        remark_key(w,
                   "at %g Pa and %g K the gas has %.3g kg/m3, as a liquid would, and is no gas of this law. Give the "
                   "pressure in Pa, or with its unit",
                   p, T, rho);
    if (free_path(p, T) > cell)
        remark_key(w,
                   "at %g Pa molecules fly about %.2g m between collisions, more than a cell: it is no continuum. Give "
                   "the pressure in Pa, or with its unit",
                   p, free_path(p, T));
}

/* Extent of a body over that of the mesh, along the axis where it is largest. */
static double largest_share(const scene *s, const scene_body *b)
{
    double lo[3] = {0.0}, hi[3] = {0.0}, share = 0.0;
    if (!shape_bounds(&b->shape, s->mesh.dim, lo, hi)) return NAN;
    for (int a = 0; a < s->mesh.dim; ++a) share = fmax(share, (hi[a] - lo[a]) / (s->mesh.upper[a] - s->mesh.lower[a]));
    return share;
}

static double thinnest_in_cells(const scene *s, const scene_body *b)
{
    double lo[3] = {0.0}, hi[3] = {0.0}, cells = INFINITY;
    if (!shape_bounds(&b->shape, s->mesh.dim, lo, hi)) return NAN;
    for (int a = 0; a < s->mesh.dim; ++a) cells = fmin(cells, (hi[a] - lo[a]) / s->mesh.cell[a]);
    return cells;
}

static void remark_size(remark_speaker *w, const scene_body *b)
{
    const double share = largest_share(w->s, b), cells = thinnest_in_cells(w->s, b);
    remark_set_key(w, "bodies", b->name, "shape");
    if (share > 50.0)
        remark_key(w, "body '%s' is %.3g times as long as the mesh: give both in m, or with their units", b->name,
                   share);
    if (w->s->material[b->material].kind == MATERIAL_FLUID && cells < 0.5)
        remark_key(
            w, "body '%s' is %.2g of a cell thin, which the cells spread over one: give it in m, or take smaller cells",
            b->name, cells);
}

static void remark_bodies(remark_speaker *w)
{
    const scene *s = w->s;
    double share = 0.0;
    for (int k = 0; k < s->n_bodies; ++k) {
        const scene_body *b = &s->body[k];
        const double own = largest_share(s, b);
        share = isnan(own) || share > own ? (isnan(own) ? 1.0 : share) : own;
        remark_size(w, b);
        remark_set_key(w, "bodies", b->name, "");
        if (!s->dimensionless) remark_gas(w, &s->material[b->material].eos, b->pressure, b->temperature);
    }
    remark_set_key(w, "domain", "upper", "");
    if (s->n_bodies > 0 && share < 0.01)
        remark_key(w, "no body is longer than %.2g of the mesh along any axis: give both in m, or take a smaller mesh",
                   share);
    remark_set_key(w, "ambient", "pressure", "");
    if (s->has_ambient && !s->dimensionless)
        remark_gas(w, &s->material[s->ambient_material].eos, s->ambient_pressure, s->ambient_temperature);
}

/* Whether anything but its own motion moves or stops a body. */
static bool flies_alone(const scene *s)
{
    return s->coupling == COUPLING_MPM && s->n_bodies == 1 && s->n_loads == 0 && s->n_supports == 0 &&
           s->n_springs == 0;
}

static void remark_flight(remark_speaker *w)
{
    const scene *s = w->s;
    double lo[3] = {0.0}, hi[3] = {0.0};
    if (!flies_alone(s) || !shape_bounds(&s->body[0].shape, s->mesh.dim, lo, hi)) return;
    remark_set_key(w, "bodies", s->body[0].name, "velocity");
    for (int a = 0; a < s->mesh.dim; ++a) {
        const double flight = s->body[0].velocity[a] * s->time.end;
        const int side = flight > 0.0 ? 1 : 0;
        const double left = side ? s->mesh.upper[a] - hi[a] : lo[a] - s->mesh.lower[a];
        if (s->bc.side[a][side].kind == BC_FREE && fabs(flight) > left + hi[a] - lo[a])
            remark_key(w,
                       "body '%s' flies %.3g m until the end, and out of the mesh after %.3g m: turn its velocity, or "
                       "end the run before",
                       s->body[0].name, fabs(flight), left);
    }
}

/* ---- loads, damping and rest ---- */

/* What its points leave of a load on the outermost nodes the lines at the edges bear, up to a share of the strength without pressure (theory 4.10). */
static void remark_weak_surface(remark_speaker *w, const scene_load *load, const scene_material *m)
{
    const double weak = 8.0;
    const scene *s = w->s;
    const scene_body *b = &s->body[load->body];
    int fewest = b->per_cell[0];
    for (int a = 1; a < s->mesh.dim; ++a)
        if (b->per_cell[a] < fewest) fewest = b->per_cell[a];
    if (!remark_has_splines(s) || fewest > 3 || !m->law->yield_stress) return;
    const double strength = m->law->yield_stress(m->law_par);
    if (fabs(load->target) > weak * strength)
        remark_key(w,
                   "it is more than %g times the strength of body '%s' without pressure: with splines and fewer than "
                   "four points a cell the stress in the two cells beside it may be off by its own size (sand between "
                   "walls under 1 MPa: 100 %%, its surface 11 %% of its way with 20 cells). Take method.basis gimp "
                   "(0.5 %%), or points: 4 (3 %%)",
                   weak, b->name);
}

static void remark_traction(remark_speaker *w, const scene_load *load)
{
    const scene *s = w->s;
    const scene_material *m = load->body >= 0 ? &s->material[s->body[load->body].material] : NULL;
    if (load->kind != LOAD_TRACTION || !m || !remark_is_solid(m)) return;
    const double share = fabs(load->target) / m->law->bulk_modulus(m->law_par);
    remark_set_key(w, "loads", load->name, "traction.pressure");
    remark_weak_surface(w, load, m);
    if (share > 0.1)
        remark_key(w, "it is %.3g times the bulk modulus of body '%s': give both in Pa, or with their units", share,
                   s->body[load->body].name);
}

/* Of the solids, the smallest bulk modulus (Pa). */
static double softest_solid(const scene *s)
{
    double least = INFINITY;
    for (int k = 0; k < s->n_bodies; ++k) {
        const scene_material *m = &s->material[s->body[k].material];
        if (remark_is_solid(m)) least = fmin(least, m->law->bulk_modulus(m->law_par));
    }
    return least;
}

/* Largest pressure (Pa) that a body of a material, or the ambient of it, is given; 0: none is. */
static double given_pressure(const scene *s, int material)
{
    double most = s->has_ambient && s->ambient_material == material ? fmax(s->ambient_pressure, 0.0) : 0.0;
    for (int k = 0; k < s->n_bodies; ++k)
        if (s->body[k].material == material) most = fmax(most, s->body[k].pressure);
    return most;
}

static void remark_target(remark_speaker *w, const scene_load *load)
{
    const scene *s = w->s;
    double lo[3] = {0.0}, hi[3] = {0.0};
    if (load->kind != LOAD_PRESSURISE) return;
    const double target = s->reference_pressure + load->target, given = given_pressure(s, load->material);
    const char *unit = s->dimensionless ? "" : " Pa";
    remark_set_key(w, "loads", load->name, "pressurise.target");
    if (given > target * (1.0 + 1e-9))
        remark_key(
            w,
            "'%s' starts at %g%s, and its mean is brought to %g%s: where that is less than it has, the load takes "
            "energy out. Take a larger target, or a lower pressure",
            s->material[load->material].name, given, unit, target, unit);
    if (fabs(load->target) > softest_solid(s))
        remark_key(w, "it is %.3g times the smallest bulk modulus of the solids: give both in Pa, or with their units",
                   load->target / softest_solid(s));
    remark_set_key(w, "loads", load->name, "pressurise.region");
    if (!shape_bounds(&load->region, s->mesh.dim, lo, hi)) return;
    for (int a = 0; a < s->mesh.dim; ++a)
        if (hi[a] - lo[a] < 0.5 * s->mesh.cell[a]) {
            remark_key(w, "it is %.2g of a cell thin: give it in m, or with its unit",
                       (hi[a] - lo[a]) / s->mesh.cell[a]);
            return;
        }
}

/* What the weight of a solid is over the body's length along it, against its bulk modulus. */
static void remark_weight(remark_speaker *w, const scene_load *load)
{
    const scene *s = w->s;
    if (load->kind != LOAD_BODY_FORCE) return;
    remark_set_key(w, "loads", load->name, "");
    for (int k = 0; k < s->n_bodies; ++k) {
        double lo[3] = {0.0}, hi[3] = {0.0}, most = 0.0;
        const scene_material *m = &s->material[s->body[k].material];
        if ((load->body >= 0 && load->body != k) || !remark_is_solid(m) ||
            !shape_bounds(&s->body[k].shape, s->mesh.dim, lo, hi))
            continue;
        for (int a = 0; a < s->mesh.dim; ++a) most = fmax(most, fabs(load->vector[a]) * (hi[a] - lo[a]));
        const double share = m->density * most / m->law->bulk_modulus(m->law_par);
        if (share > 1.0)
            remark_key(w,
                       "the weight of body '%s' over its length is %.3g of its bulk modulus: give the acceleration in "
                       "m/s2, and the modulus in Pa",
                       s->body[k].name, share);
    }
}

static double longest_body(const scene *s)
{
    double most = 0.0;
    for (int k = 0; k < s->n_bodies; ++k) {
        double lo[3] = {0.0}, hi[3] = {0.0};
        if (!remark_is_solid(&s->material[s->body[k].material]) ||
            !shape_bounds(&s->body[k].shape, s->mesh.dim, lo, hi))
            continue;
        for (int a = 0; a < s->mesh.dim; ++a)
            most = fmax(most, fmin(hi[a], s->mesh.upper[a]) - fmax(lo[a], s->mesh.lower[a]));
    }
    return most;
}

static void remark_rest(remark_speaker *w)
{
    const scene *s = w->s;
    double slowest = INFINITY;
    for (int k = 0; k < s->n_bodies; ++k)
        if (remark_is_solid(&s->material[s->body[k].material]))
            slowest = fmin(slowest, remark_solid_sound(&s->material[s->body[k].material]));
    if (!s->rest.enabled || !isfinite(slowest) || s->time.solver != SOLVER_DYNAMIC) return;
    remark_set_key(w, "stop", "kinetic_over_strain", "");
    if (s->rest.ratio >= 1e-3)
        remark_key(w, "%g ends the run while bodies swing by about %.2g of what they are strained: take 1e-6",
                   s->rest.ratio, sqrt(s->rest.ratio));
    remark_set_key(w, "stop", "window", "");
    if (s->rest.window * slowest < 0.5 * longest_body(s))
        remark_key(w,
                   "sound crosses %.2g of the longest body in that time, and a swing stands still at its ends: leave "
                   "the key out, or give a longer one",
                   s->rest.window * slowest / longest_body(s));
    const double damped = s->damping.rate * (fmin(s->damping.end, s->time.end) - s->damping.start);
    remark_set_key(w, "damping", "rate", "");
    if (s->damping.rate > 0.0 && damped < 1.0)
        remark_key(
            w, "until the end motion falls to %.2g of itself, and not to rest: take a larger rate (1/s), or end later",
            exp(-0.5 * damped));
}

static void remark_output(remark_speaker *w)
{
    const scene *s = w->s;
    remark_set_key(w, "output", "interval", "");
    if (isfinite(s->output.interval) && s->time.end / s->output.interval > 2e4)
        remark_key(w, "these are %.3g snapshots: give the interval in s, or take a longer one",
                   s->time.end / s->output.interval);
    remark_set_key(w, "time", "cfl", "");
    const double cfl = s->coupling == COUPLING_ICE ? s->time.cfl_ice : s->time.cfl_mpm;
    if (cfl < 0.01 && s->time.solver == SOLVER_DYNAMIC)
        remark_key(w, "steps of %g of the limit are %.3g times as many as by default, and smooth as often: take 0.5",
                   cfl, 0.5 / cfl);
}

void remark_slips(const scene *s, remark_sink *say, void *user)
{
    remark_speaker w = {.s = s, .say = say, .user = user};
    for (int m = 0; m < s->n_materials && !s->dimensionless; ++m) {
        const scene_material *a = &s->material[m];
        if (a->kind == MATERIAL_FLUID && a->eos.model) remark_fluid(&w, a);
        if (a->membrane) remark_membrane(&w, a);
        if (remark_is_solid(a)) remark_yield(&w, a);
        if (remark_is_solid(a)) remark_hardening(&w, a);
    }
    remark_bodies(&w);
    if (!s->dimensionless) remark_flight(&w);
    for (int l = 0; l < s->n_loads; ++l) {
        remark_traction(&w, &s->load[l]);
        remark_target(&w, &s->load[l]);
        remark_weight(&w, &s->load[l]);
    }
    remark_rest(&w);
    remark_output(&w);
}
