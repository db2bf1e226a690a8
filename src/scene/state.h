/* What both solvers ask of a scene's bodies and loads, so that a fluid on points and the same fluid on cells start and
 * are driven alike. */
#ifndef SCENE_STATE_H
#define SCENE_STATE_H

#include "scene/scene.h"

/* State of a fluid from two of pressure (Pa), temperature (K), density (kg/m3); the third is NAN, and is solved for
 * together with the internal energy (J/kg). FLOE_BAD_INPUT where the equation of state has no such state. */
typedef struct fluid_state {
    double density, energy, temperature, pressure;
} fluid_state;
floe_status fluid_state_of(context *ctx, const eos *law, double pressure, double temperature, double density,
                           fluid_state *out);

/* Initial state of a fluid body at x: from the deck, its formulas there, or from the exact solution at t = 0 (with its velocity); a
 * temperature in the deck replaces the exact density. */
floe_status body_fluid_state(const scene *s, int body, const double x[3], fluid_state *out, double velocity[3]);

/* The same of the ambient. */
floe_status ambient_fluid_state(const scene *s, const double x[3], fluid_state *out, double velocity[3]);

/* Whether the velocity that a body starts with is known at x: one from an exact solution is so where the solution is. */
bool body_velocity_known(const scene *s, int body, const double x[3]);

/* Density and velocity, and stress (xx yy zz xy yz zx, Pa), of a solid body at x. */
floe_status body_solid_state(const scene *s, int body, const double x[3], double velocity[3], double stress[6]);

/* How a body is filled with points on a mesh. */
seed_spec body_seed_spec(const scene *s, const mesh *m, const scene_body *b);
/* Its points, with their volumes at rest; ids number them in this order. FLOE_BAD_INPUT says why they cannot be placed. */
floe_status body_points(const scene_body *b, context *ctx, const seed_spec *grid, seed_list *out);
/* Points a cell of a membrane from which on its strain, by rate, hardly creeps (theory 8.1): along a curve, and along each direction of
 * a surface. */
enum { MEMBRANE_CURVE_POINTS = 8, MEMBRANE_SURFACE_POINTS = 4 };
/* Gives a membrane its points a cell, where the deck does not. Other bodies stay as they are. */
void membrane_seed(scene_body *b);
/* Logarithmic strain that a point of a membrane, numbered from 0, must take up before there is tension. */
double membrane_slack(const scene_membrane *m, size_t number);
/* The rows in which the points of a membrane on a surface lie. */
floe_status body_rows(const scene_body *b, context *ctx, const seed_spec *grid, sheet_rows *out);

/* What a scene's masses, forces and energies are multiplied by in outputs: the thickness in 2-D, 2 pi when
 * axisymmetric, else 1. Inside they are for a metre of depth, or a radian. */
double scene_extent(const scene *s);

/* A step, as loads see it: from t to t_end (s), the step-th since the start of the run (0 is the first). */
typedef struct load_step {
    double t, t_end;
    long step;
} load_step;

/* A load as it is where its answer is solved for (time.solver): one without a ramp grows until `end` (s), as else it
 * would come all at once. */
scene_load load_until(const scene_load *load, double end);
/* Fraction of a load's ramp reached at the end of the step: 0 before its start, 1 after the ramp; by steps where
 * ramp_steps is set. */
double load_fraction(const scene_load *load, const load_step *step);
/* The target of a load of the scene at x and t, its vector likewise (the traction on a surface), and the acceleration of a body force at t: numbers, or by their formulas. */
double load_target(const scene *s, const scene_load *load, const double x[3], double t);
void load_vector(const scene *s, const scene_load *load, const double x[3], double t, double out[3]);
void load_acceleration(const scene *s, const scene_load *load, double t, double out[3]);
/* Whether a body force is one acceleration wherever it acts, and acts everywhere: others are force fields. */
bool load_is_uniform(const scene *s, const scene_load *load);
/* Whether a load is a force field that acts on a body of the scene; of -1: on everything, fluids on cells with it. */
bool load_is_field_on(const scene *s, const scene_load *load, int body);
/* Whether there is such a load. */
bool scene_has_field_on(const scene *s, int body);
/* LOAD_HEAT: the time (s) in which the full power gives what the load gives in the step: a power with a ramp grows from nothing. */
double load_heating_time(const scene_load *load, const load_step *step);
/* LOAD_PRESSURISE: the absolute mean pressure (Pa) that the fluid should have at the end of the step; *active tells
 * whether the load acts in it. The ramp runs from the initial pressure of the fluid's first body. It needs no memory,
 * so that a resumed run goes on as it was. */
double load_scheduled_pressure(const scene *s, const scene_load *load, const load_step *step, bool *active);

#endif
