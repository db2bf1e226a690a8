#include "scene/remark.h"

#include "scene/remark_internal.h"
#include "scene/scene_reach.h"
#include "scene/unsupported.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { REMARK_SIZE = 512 };

static bool is_gas_of_points(const scene *s, const scene_body *b)
{
    return s->coupling == COUPLING_MPM && s->material[b->material].kind == MATERIAL_FLUID;
}

static bool has_walls(const scene *s)
{
    for (int k = 0; k < s->n_bodies; ++k)
        if (remark_is_solid(&s->material[s->body[k].material])) return true;
    return false;
}

/* Where gas and wall have one velocity in the cells that they share, the gas, by far the stiffer, has its way, and the
 * wall's strain is the gas's: an error of the cells at the surface, first order in h. */
static void remark_soft_walls(const scene *s, remark_sink *say, void *user)
{
    const double soft = 10.0, pressure = scene_gas_pressure(s);
    const bool right = scene_fluids_apart(s) && scene_wall_bases(s), steps = s->time.solver == SOLVER_DYNAMIC;
    for (int k = 0; k < s->n_bodies && steps && !right; ++k) {
        if (!remark_is_solid(&s->material[s->body[k].material])) continue;
        const scene_material *m = &s->material[s->body[k].material];
        const double ratio = m->law->bulk_modulus(m->law_par) / pressure;
        if (!(ratio < soft)) continue;
        char text[REMARK_SIZE];
        (void)snprintf(text, sizeof text,
                       "the bulk modulus of body '%s' is %.3g times the largest pressure of the gas: points of gas in "
                       "the cells that it shares with them stiffen it. With five cells across a wall its stress was 42 "
                       "%% off at a ratio of 1 and 72 %% at 0.01, with ten 23 %% at 1. Take coupling ice-mpm, or "
                       "time.solver static",
                       s->body[k].name, ratio);
        say(user, text);
    }
}

static bool has_odd_points(const scene *s, const scene_body *b)
{
    for (int a = 0; a < s->mesh.dim; ++a)
        if (b->per_cell[a] % 2) return true;
    return false;
}

/* The slope of a quadratic spline has a kink at the middle of each cell. Where a point stands on it, it has one slope
 * for motions to the left and another for those to the right, and short waves feed on the pressure. Cubic splines, with
 * kinks of the curvature, do the same more slowly. Against a reference pressure that is the gas's own there is nothing
 * to feed on; gas that flies apart, or that a membrane holds, has not shown it. */
static void remark_knots(const scene *s, remark_sink *say, void *user)
{
    const double threshold = 0.01; /* gauge pressures below this share of the gas's are no load */
    const bool quadratic = strcmp(s->method.basis, "quadratic") == 0, cubic = strcmp(s->method.basis, "cubic") == 0;
    for (int k = 0; k < s->n_bodies && has_walls(s) && s->mesh.dim > 1 && s->time.solver == SOLVER_DYNAMIC; ++k) {
        const scene_body *b = &s->body[k];
        if (!is_gas_of_points(s, b) || !(cubic || (quadratic && has_odd_points(s, b)))) continue;
        const double pressure = scene_body_pressure(s, b);
        if (!(fabs(pressure - s->reference_pressure) > threshold * pressure)) continue;
        char text[REMARK_SIZE];
        (void)snprintf(
            text, sizeof text,
            "gas of points under pressure, body '%s': with %s splines and %s of points along a cell its sound grows "
            "where nothing damps it, within some tens of crossings. Take quadratic splines with an even number, gimp "
            "or cpdi",
            b->name, cubic ? "cubic" : "quadratic", cubic ? "any number" : "an odd number");
        say(user, text);
    }
}

static bool has_gas_of_points(const scene *s)
{
    for (int k = 0; k < s->n_bodies; ++k)
        if (is_gas_of_points(s, &s->body[k])) return true;
    return false;
}

/* What share of its pressure gas that a shock has pushed on to a wall of steel has in the first cell, and in the mean of four (a shock
 * tube of 1.6 m, 10 bar against 1, cells of 0.01 m). */
static void shares_at_wall(const scene *s, double share[2])
{
    const bool hat = strcmp(s->method.basis, "linear") == 0;
    const bool averaged = strcmp(s->method.basis, "gimp") == 0 || strcmp(s->method.basis, "cpdi") == 0;
    share[0] = averaged ? 0.99 : hat ? 0.98 : 0.25;
    share[1] = averaged ? 0.99 : hat ? 0.94 : 0.84;
}

/* A velocity that fluid and solid share is no-slip, and stops the fluid as far as the basis carries the solid's mass. A load that rises
 * and is damped to rest is borne by the points that are there, and is right. */
static void remark_one_velocity(const scene *s, remark_sink *say, void *user)
{
    if (!has_gas_of_points(s) || !has_walls(s) || s->time.solver != SOLVER_DYNAMIC || s->damping.rate > 0.0) return;
    for (int k = 0; k < s->n_bodies; ++k)
        if (s->material[s->body[k].material].membrane) return; /* which holds the fluid off */
    if (scene_fluids_apart(s)) {
        say(user,
            "in 'mpm' what sums over points leave out adds up: with quadratic splines a charge of 50 bar in a closed "
            "box of steel, 16 cells wide, had 3 % too little pressure in the mean, and up to 20 % more or less at "
            "single places; gas behind a shock that a wall sent back had its pressure within 2.4 %; gas that turned "
            "in a round vessel without friction lost 0.88 of its energy in 1.6 turns. Take coupling ice-mpm where that "
            "is too much");
        return;
    }
    double share[2];
    shares_at_wall(s, share);
    char text[REMARK_SIZE];
    (void)snprintf(
        text, sizeof text,
        "in 'mpm' fluid and solid bodies share one velocity: fluids stick to solids whatever their "
        "viscosity, and behind a shock on steel the first cell had %.2g of the pressure, four had %.2g, with "
        "basis %s. A stream 16 cells deep lost a sixth to a quarter of its energy in 20 cells. Take coupling "
        "ice-mpm%s",
        share[0], share[1], s->method.basis, share[0] < 0.9 ? "; or method.basis gimp for shocks" : "");
    say(user, text);
}

/* FLIP's share of PIC smooths a shear at each step, and lines across a wall (theory 4.14) make a round one rough. */
static void remark_viscous_walls(const scene *s, remark_sink *say, void *user)
{
    if (s->mesh.dim == 1 || s->coupling != COUPLING_MPM || !scene_fluids_apart(s)) return;
    for (int k = 0; k < s->n_materials; ++k) {
        const scene_material *m = &s->material[k];
        if (m->kind != MATERIAL_FLUID || !(m->shear_viscosity > 0.0)) continue;
        const bool flip = strcmp(scene_transfer(s), "flip") == 0;
        char text[REMARK_SIZE];
        (void)snprintf(text, sizeof text,
                       "materials.%s.viscosity: in 'mpm' walls drag fluid by more than its viscosity. Plates with ten "
                       "and 20 cells between them took %s, cylinders of which one turns, with four and eight cells "
                       "between them, 13 and 2 times their torque. Take coupling ice-mpm%s",
                       m->name, flip ? "20 and 9 % too much (Reynolds number of 10)" : "up to 2 % too much",
                       flip ? "; between plane walls along the mesh method.transfer apic" : "");
        say(user, text);
    }
}

/* What keeps a slip side from letting a solid go: steps that are solved for have no active set at the sides, and a velocity that a
 * fluid shares is mirrored. NULL: nothing. */
static const char *holder_at_sides(const scene *s, int body)
{
    if (s->time.solver == SOLVER_STATIC || s->time.solver == SOLVER_IMPLICIT) return "in steps that are solved for";
    if (has_gas_of_points(s) && !scene_in_contact(s, body) && !scene_fluids_apart(s))
        return "as 'mpm', where it shares its velocity with a fluid";
    return NULL;
}

static void remark_constrained_sides(const scene *s, remark_sink *say, void *user)
{
    for (int k = 0; k < s->n_bodies; ++k)
        for (int axis = 0; axis < s->mesh.dim && remark_is_solid(&s->material[s->body[k].material]); ++axis)
            for (int side = 0; side < 2; ++side) {
                const char *holder = holder_at_sides(s, k);
                if (!holder || s->bc.side[axis][side].kind != BC_SLIP || !body_reaches_side(s, &s->body[k], axis, side))
                    continue;
                char text[REMARK_SIZE];
                (void)snprintf(text, sizeof text,
                               "boundaries.%c.%s: %s, a slip side constrains body '%s' as a mirror does, also in "
                               "tension. Say symmetry "
                               "where it is meant to stay; else take %s",
                               axis_letter(s, axis), side ? "upper" : "lower", holder, s->body[k].name,
                               s->time.solver == SOLVER_DYNAMIC
                                   ? "coupling ice-mpm"
                                   : "time.solver dynamic, or a body of its own as the support, with contact");
                say(user, text);
            }
}

/* A solid that is not held where it is. */
static bool may_leave(const scene *s, const scene_body *b)
{
    return remark_is_solid(&s->material[b->material]) && b->motion.kind != MOTION_FIXED;
}

/* Why no fluid comes between a solid and a slip side of an axis as it leaves: with a smeared interface before a whole cell is open, until when
 * it is drawn back, as by a vacuum; with a sharp one where its surface ends on the side. NULL: one comes, or the solid also reaches the side
 * across, and slides along both. */
static const char *what_no_fluid_comes_between(const scene *s, const scene_body *b, int axis, int *side)
{
    const bool at[2] = {body_reaches_side(s, b, axis, 0), body_reaches_side(s, b, axis, 1)};
    *side = at[0] ? 0 : 1;
    if (at[0] == at[1] || s->bc.side[axis][*side].kind != BC_SLIP) return NULL;
    if (s->method.interface == INTERFACE_SMEARED)
        return "lies within a cell of a slip side, and a smeared interface lets no fluid between them before a whole "
               "cell is open: where it leaves, it is drawn back as by a vacuum (a block at 1 m/s in air of 1 bar came "
               "back after 16 mm). Say symmetry where it is meant to stay; else leave a whole cell between them, or "
               "take coupling mpm without the fluid";
    if (!body_stands_on_side(s, b, axis, *side) || scene_can_leave_side(s, b, axis, *side)) return NULL;
    return "stands on a slip side, and beside a liquid, with the implicit pressure, in a corner of two such sides and "
           "right across the domain a sharp surface ends on the side: where the body leaves it, no fluid comes between "
           "them, and the run ends. "
           "Say symmetry where it is meant to stay; else leave a tenth of a cell between them";
}

static void remark_leaving_sides(const scene *s, remark_sink *say, void *user)
{
    if (s->coupling != COUPLING_ICE_MPM || s->time.solver != SOLVER_DYNAMIC) return;
    for (int k = 0; k < s->n_bodies; ++k)
        for (int axis = 0; axis < s->mesh.dim && may_leave(s, &s->body[k]); ++axis) {
            int side;
            const char *what = what_no_fluid_comes_between(s, &s->body[k], axis, &side);
            char text[REMARK_SIZE];
            if (!what) continue;
            (void)snprintf(text, sizeof text, "boundaries.%c.%s: body '%s' %s", axis_letter(s, axis),
                           side ? "upper" : "lower", s->body[k].name, what);
            say(user, text);
        }
}

static bool is_fluid_of_cells(const scene *s, const scene_body *b)
{
    return s->coupling != COUPLING_MPM && s->material[b->material].kind == MATERIAL_FLUID;
}

/* rho c^2/p of a gas at a pressure and the body's temperature (300 K where it has none); infinite of liquids. */
static double stiffness_over_pressure(const eos *law, double p, double temperature)
{
    const double T = temperature > 0.0 ? temperature : 300.0;
    double e, rho, own, c2;
    if (eos_is_liquid(law)) return INFINITY;
    rho = eos_density(law, p, T);
    law->model->energy(law->par, 1, &rho, &T, &e);
    law->model->pressure(law->par, 1, &rho, &e, &own, &c2);
    return rho * c2 / own;
}

/* Behind a strong shock the density of a gas of gamma near one is (gamma + 1)/(gamma - 1) times as large, in as many fewer cells, and what is wrong
 * where the shock begins at another fluid stays in it. */
static void remark_dense_shocks(const scene *s, remark_sink *say, void *user)
{
    const double strong = 1e3, soft = 1.15;
    for (int k = 0; k < s->n_bodies; ++k)
        for (int d = 0; d < s->n_bodies; ++d) {
            const scene_body *driven = &s->body[k], *driver = &s->body[d];
            if (!is_fluid_of_cells(s, driven) || !is_fluid_of_cells(s, driver) || driven->material == driver->material)
                continue;
            if (!(driven->pressure > 0.0 && driver->pressure >= strong * driven->pressure)) continue;
            const double gamma =
                stiffness_over_pressure(&s->material[driven->material].eos, driven->pressure, driven->temperature);
            if (!(gamma < soft)) continue;
            char text[REMARK_SIZE];
            (void)snprintf(
                text, sizeof text,
                "body '%s' drives the gas of body '%s' with %.3g times its pressure, and the gas has a ratio of "
                "specific heats of %.3g: behind its shock the density was 33 %% off with 200 cells and 12 %% with "
                "800 (at 1.09 and 1e5), the velocity 7 and 2 %%. Take finer cells",
                driver->name, driven->name, driver->pressure / driven->pressure, gamma);
            say(user, text);
        }
}

/* Beside points that cells share fluids are closed at frozen temperatures and have no sharp interfaces (theory 2.15). Sharp surfaces keep points out of cells. */
static void remark_beside_points(const scene *s, remark_sink *say, void *user)
{
    const double shock = 10.0;
    const bool smeared = s->coupling == COUPLING_ICE_MPM && s->method.interface != INTERFACE_SHARP && has_walls(s);
    for (int k = 0; k < s->n_bodies && smeared; ++k)
        for (int d = 0; d < s->n_bodies; ++d) {
            const scene_body *driven = &s->body[k], *driver = &s->body[d];
            if (!is_fluid_of_cells(s, driven) || !is_fluid_of_cells(s, driver) || driven->material == driver->material)
                continue;
            if (!(driven->pressure > 0.0 && driver->pressure >= shock * driven->pressure)) continue;
            char text[REMARK_SIZE];
            (void)snprintf(
                text, sizeof text,
                "body '%s' drives the fluid of body '%s' with %.3g times its pressure beside smeared solids: there "
                "shocks between fluids have 3 to 27 %% too much or too little density (pressure ratios of 10 to 1e5), "
                "those within one fluid 1 %%. Take `method.interface: sharp`, or give both one material, if they may "
                "be one",
                driver->name, driven->name, driver->pressure / driven->pressure);
            say(user, text);
        }
}

/* Implicit steps are without damping of their own: what a sudden load excites of sounds that a step does not follow swings from step to step for good.
 * Where a body is all but incompressible that is its pressure. */
static void remark_swinging_pressure(const scene *s, remark_sink *say, void *user)
{
    const double stiff = 100.0;
    if (s->mesh.dim == 1 || s->stress_state != STRESS_FULL || s->time.solver != SOLVER_IMPLICIT) return;
    for (int k = 0; k < s->n_bodies; ++k) {
        if (!remark_is_solid(&s->material[s->body[k].material])) continue;
        const scene_material *m = &s->material[s->body[k].material];
        const double ratio = m->law->bulk_modulus(m->law_par) / m->law->shear_modulus(m->law_par);
        if (!(ratio > stiff)) continue;
        char text[REMARK_SIZE];
        (void)snprintf(
            text, sizeof text,
            "the bulk modulus of body '%s' is %.3g times its shear modulus: in implicit steps the pressure that a "
            "sudden load makes there swings from step to step. The radial stress of a thick cylinder was 26 %% off "
            "at 500 times and 62 %% at 5000, and 1.7 %% where the load rose over 25 steps. Give loads a ramp, "
            "or take shorter steps or time.solver static",
            s->body[k].name, ratio);
        say(user, text);
    }
}

void scene_remarks(const scene *s, remark_sink *say, void *user)
{
    remark_swinging_pressure(s, say, user);
    remark_soft_walls(s, say, user);
    remark_moved(s, say, user);
    remark_knots(s, say, user);
    scene_remark_unused(s, say, user);
    remark_shapes(s, say, user);
    remark_smeared(s, say, user);
    remark_flight_out(s, say, user);
    remark_free_swing(s, say, user);
    remark_heat(s, say, user);
    remark_joints(s, say, user);
    remark_supports(s, say, user);
    remark_columns(s, say, user);
    remark_sources(s, say, user);
    remark_one_velocity(s, say, user);
    remark_viscous_walls(s, say, user);
    remark_constrained_sides(s, say, user);
    remark_leaving_sides(s, say, user);
    remark_dense_shocks(s, say, user);
    remark_beside_points(s, say, user);
    remark_range(s, say, user);
    remark_slips(s, say, user);
    remark_contrasts(s, say, user);
}
