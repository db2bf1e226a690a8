/* Numbers that can be read and run, and are hardly what was meant: units a thousand times off, temperatures in Celsius,
 * loads and outputs that never come. Magnitudes are looked at where units are SI. */
#include "scene/deck_location.h"
#include "scene/formula.h"
#include "scene/remark_internal.h"
#include "scene/side_parts.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { TEXT_SIZE = 700 };

void remark_key(const remark_speaker *w, const char *format, ...)
{
    char text[TEXT_SIZE], where[TEXT_SIZE], all[2 * TEXT_SIZE];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    scene_key_place(w->s, w->key, where, sizeof where);
    (void)snprintf(all, sizeof all, "%s%s", where, text);
    w->say(w->user, all);
}

void remark_set_key(remark_speaker *w, const char *map, const char *name, const char *rest)
{
    (void)snprintf(w->key, REMARK_KEY, "%s.%s%s%s", map, name, rest[0] ? "." : "", rest);
}

bool remark_has_splines(const scene *s)
{
    return strcmp(s->method.basis, "quadratic") == 0 || strcmp(s->method.basis, "cubic") == 0;
}

bool remark_is_solid(const scene_material *m)
{
    return m->kind == MATERIAL_SOLID && m->law && !m->membrane;
}

double remark_solid_sound(const scene_material *m)
{
    const double modulus = m->law->bulk_modulus(m->law_par) + 4.0 / 3.0 * m->law->shear_modulus(m->law_par);
    return sqrt(modulus / m->density);
}

/* K/G of metals is below 10, and of gels, nearly all water, 2e6 at most; studies of incompressible solids go to 1e6. */
static void remark_moduli(remark_speaker *w, const scene_material *m)
{
    const double K = m->law->bulk_modulus(m->law_par), G = m->law->shear_modulus(m->law_par), most = 1e7;
    if (G > 0.0 && K < 0.05 * G)
        remark_key(
            w,
            "the bulk modulus of solid '%s' is %.3g of its shear modulus, a Poisson's ratio of %.3g: is one of them in "
            "other units?",
            m->name, K / G, (3.0 * K - 2.0 * G) / (6.0 * K + 2.0 * G));
    if (G > 0.0 && K > most * G)
        remark_key(w,
                   "the shear modulus of solid '%s' is %.3g of its bulk modulus, less than that of any gel: is one of "
                   "them in other units?",
                   m->name, G / K);
}

/* The softest gels have 10 m/s or so, rubbers under load 50 to 1500, metals to 6500, diamond 18000; what is heavier than
 * stone is a metal, whose slowest (lead) has 1200. */
static void remark_sound(remark_speaker *w, const scene_material *m)
{
    const double c = remark_solid_sound(m), dense = 4000.0;
    const double least = m->density > dense ? 300.0 : 3.0, most = 1e5;
    remark_set_key(w, "materials", m->name, "law");
    if (c < least || c > most)
        remark_key(
            w,
            "the speed of sound of solid '%s' is %.3g m/s at %g kg/m3: no %s has that. Are the moduli in Pa (give "
            "the unit: 200 GPa) and the density in kg/m3?",
            m->name, c, m->density, m->density > dense ? "metal" : "solid");
    remark_moduli(w, m);
    remark_set_key(w, "materials", m->name, "density");
    if (m->density < 5.0 || m->density > 23000.0)
        remark_key(w, "solid '%s' has %g kg/m3: light foams have 10, osmium 22600. Is it in kg/m3 (1 g/cm3 is 1000)?",
                   m->name, m->density);
}

static void remark_temperature(const remark_speaker *w, double kelvin)
{
    if (kelvin < 60.0)
        remark_key(w, "%g K is %.3g degrees Celsius: is it meant to be %g K?", kelvin, kelvin - 273.15,
                   kelvin + 273.15);
}

static void remark_materials(remark_speaker *w)
{
    for (int m = 0; m < w->s->n_materials && !w->s->dimensionless; ++m) {
        const scene_material *a = &w->s->material[m];
        if (remark_is_solid(a)) remark_sound(w, a);
        remark_set_key(w, "materials", a->name, "specific_heat");
        if (remark_is_solid(a) && a->specific_heat > 0.0 && (a->specific_heat < 50.0 || a->specific_heat > 2e4))
            remark_key(w, "solid '%s' has %g J/kg/K: lead has 130, water 4200. Is it in J/kg/K, and not in kJ?",
                       a->name, a->specific_heat);
    }
}

static double speed_of(const scene_body *b)
{
    return sqrt(b->velocity[0] * b->velocity[0] + b->velocity[1] * b->velocity[1] + b->velocity[2] * b->velocity[2]);
}

static void remark_bodies(remark_speaker *w)
{
    const scene *s = w->s;
    remark_set_key(w, "ambient", "temperature", "");
    if (s->has_ambient && !s->dimensionless) remark_temperature(w, s->ambient_temperature);
    for (int k = 0; k < s->n_bodies; ++k) {
        const scene_body *b = &s->body[k];
        const scene_material *m = &s->material[b->material];
        remark_set_key(w, "bodies", b->name, "temperature");
        if (!s->dimensionless) remark_temperature(w, b->temperature);
        remark_set_key(w, "bodies", b->name, "velocity");
        if (remark_is_solid(m) && speed_of(b) > 3.0 * remark_solid_sound(m))
            remark_key(w, "body '%s' moves with %.3g times the speed of sound of its material, %.3g: is that meant?",
                       b->name, speed_of(b) / remark_solid_sound(m), remark_solid_sound(m));
    }
}

static void remark_load(remark_speaker *w, const scene_load *load)
{
    const scene *s = w->s;
    const char *unit = scene_time_unit(s);
    const double full = load->start + (load->ramp_steps > 0 ? 0.0 : load->ramp);
    remark_set_key(w, "loads", load->name, "");
    if (load->start >= s->time.end)
        remark_key(w, "it starts at t = %g%s, and the run ends at %g%s: it never acts. Take an earlier start",
                   load->start, unit, s->time.end, unit);
    else if (full > s->time.end * (1.0 + 1e-9))
        remark_key(w,
                   "its ramp ends at t = %g%s, and the run at %g%s: %.3g of the load is reached. Take a shorter ramp, "
                   "or end later",
                   full, unit, s->time.end, unit, (s->time.end - load->start) / load->ramp);
    const double size =
        sqrt(load->vector[0] * load->vector[0] + load->vector[1] * load->vector[1] + load->vector[2] * load->vector[2]);
    if (load->kind == LOAD_BODY_FORCE && !s->dimensionless && size > 1e6)
        remark_key(w, "%.3g m/s2 are %.3g times the Earth's gravity. Give the acceleration in m/s2", size, size / 9.81);
}

static void remark_times(remark_speaker *w)
{
    const scene *s = w->s;
    const char *unit = scene_time_unit(s);
    const double end = s->time.end;
    for (int l = 0; l < s->n_loads; ++l) remark_load(w, &s->load[l]);
    remark_set_key(w, "output", "interval", "");
    if (isfinite(s->output.interval) && s->output.interval > end * (1.0 + 1e-9))
        remark_key(w,
                   "it is longer than the run (%g%s): there are the first and the last snapshot alone. Take a shorter "
                   "one for more",
                   end, unit);
    remark_set_key(w, "output", "history_interval", "");
    if (s->output.history_interval > end * (1.0 + 1e-9))
        remark_key(
            w,
            "it is longer than the run (%g%s): there are the first and the last row alone. Take a shorter one for more",
            end, unit);
    remark_set_key(w, "damping", "start", "");
    if (s->damping.rate > 0.0 && s->damping.start >= end)
        remark_key(w, "the run ends at %g%s, before there is any damping. Take an earlier start", end, unit);
    remark_set_key(w, "stop", "after", "");
    if (s->rest.enabled && s->rest.after >= end)
        remark_key(w, "the run ends at %g%s, before it is looked for rest. Take an earlier time", end, unit);
    remark_set_key(w, "stop", "window", "");
    if (s->rest.enabled && s->rest.window >= end)
        remark_key(w, "it is as long as the run (%g%s), which so never ends at rest. Take a shorter one", end, unit);
    remark_set_key(w, "time", "first_step", "");
    if (s->time.first_step > end) remark_key(w, "it is longer than the run (%g%s). Take a shorter one", end, unit);
    remark_set_key(w, "time", "fixed_step", "");
    if (s->time.fixed_step >= end)
        remark_key(w, "it is as long as the run (%g%s): there is one step. Take a shorter one", end, unit);
}

/* The waves of the solids: a run too short for any to cross a cell, damping that stops all before one has crossed a
 * body. */
static void remark_waves(remark_speaker *w)
{
    const scene *s = w->s;
    double fastest = 0.0, cell = INFINITY;
    for (int k = 0; k < s->n_bodies; ++k)
        if (remark_is_solid(&s->material[s->body[k].material]))
            fastest = fmax(fastest, remark_solid_sound(&s->material[s->body[k].material]));
    for (int a = 0; a < s->mesh.dim; ++a) cell = fmin(cell, s->mesh.cell[a]);
    if (fastest == 0.0 || s->time.solver != SOLVER_DYNAMIC) return;
    remark_set_key(w, "time", "end", "");
    if (s->time.end * fastest < cell && s->n_loads > 0)
        remark_key(w, "sound of %.3g%s crosses %.2g of a cell by then: nothing can have come to the solids", fastest,
                   s->dimensionless ? "" : " m/s", s->time.end * fastest / cell);
    remark_set_key(w, "damping", "rate", "");
    if (s->damping.rate * cell > 2.0 * fastest)
        remark_key(
            w, "waves are damped out within half a cell: what is to come to rest freezes. The slowest vibration, of "
               "angular frequency w, comes to rest soonest at a rate of 2 w: take a smaller rate");
}

/* Pressures behind outlets at which the fluid does not exist. */
static void remark_outlets(remark_speaker *w)
{
    const scene *s = w->s;
    if (!s->has_ambient || !s->material[s->ambient_material].eos.model) return;
    const eos *law = &s->material[s->ambient_material].eos;
    const double least = law->model->pressure_floor(law->par);
    for (int a = 0; a < s->mesh.dim; ++a)
        for (int side = 0; side < 2; ++side) {
            if (s->bc.side[a][side].kind != BC_OUTLET || !(s->bc.side[a][side].pressure <= least)) continue;
            remark_set_key(w, "boundaries",
                           s->mesh.geometry == MESH_AXISYMMETRIC ? (a ? "z" : "r") : (a ? (a > 1 ? "z" : "y") : "x"),
                           side ? "upper" : "lower");
            remark_key(w, "'%s' does not exist at %g Pa: its pressure is above %g Pa. Give the absolute one",
                       s->material[s->ambient_material].name, s->bc.side[a][side].pressure, least);
        }
}

/* Fluid that comes back through an outlet of which the deck does not say what is outside. */
static void remark_unknown_outside(remark_speaker *w)
{
    const scene *s = w->s;
    scene_condition at;
    if (s->method.pressure != PRESSURE_EXPLICIT)
        return; /* slow flow: its motion has too little energy to feed itself */
    for (int i = 0; scene_next_condition(s, &i, &at);) {
        const bc_side *side = at.side;
        if (side->kind != BC_OUTLET || side->temperature > 0.0 || scene_formula_of(s, &side->temperature)) continue;
        remark_set_key(w, "boundaries", mesh_axis_name(s->mesh.geometry, at.axis), at.end ? "upper" : "lower");
        remark_key(w, "what is outside the outlet is not known: should fluid come back, it is what is inside, at the "
                      "temperature there. Give the outlet's temperature and material, those of fluid at rest outside");
        return;
    }
}

void remark_range(const scene *s, remark_sink *say, void *user)
{
    remark_speaker w = {.s = s, .say = say, .user = user};
    remark_materials(&w);
    remark_bodies(&w);
    remark_times(&w);
    remark_waves(&w);
    remark_outlets(&w);
    if (s->coupling != COUPLING_MPM) remark_unknown_outside(&w);
}
