/* Sources of the Lagrangian step: pressure, viscosity, conduction, loads (theory 2.6 to 2.8). */
#ifndef ICE_SOURCE_H
#define ICE_SOURCE_H

#include "ice/ice_view.h"

bool ice_conducts(const ice *s);
/* Some fluid is viscous or conducts, or an exact solution's sources drive it; the second, where no embedded boundary cuts cells: there its
 * rates at the start of the step are known, and it is of second order in time. */
bool ice_has_diffusion(const ice *s);
bool ice_diffuses(const ice *s);
/* Whether viscosity moves the faces: where ice_diffuses, and beside embedded boundaries with the implicit pressure. */
bool ice_diffusion_moves_faces(const ice *s);
/* Temperatures of a region's fluids at t^n into C_DIFFUSION_T, ghosts included. */
void ice_find_temperatures(const ice *s, const ice_region *g);
/* Force of viscosity (N/m3) on each whole cell of a region beside embedded boundaries, at t^n. */
void ice_cut_diffusion_rates(const ice *s, const ice_region *g);

/* Half a step's force on the face velocities, and half a step's heat on the advanced pressure (the array P); a whole step's of
 * both where the implicit pressure is at its end. */
void ice_diffusion_face_velocity(const ice *s, const ice_view *v, int r, int axis);
void ice_diffusion_pressure(const ice *s, const ice_view *v, int r, double *P);
floe_status ice_diffusion_rates_of(ice *s, const ice_region *g);
/* What stresses and hoop stresses of a fluid beside embedded boundaries do, of the state at t^n: on the lower face of `axis` at R, of
 * local cell i along axis 0, and to a cell. */
typedef struct ice_face_diffusion {
    double t[3], power; /* traction along the axes; power that crosses downwards, by stress and heat */
} ice_face_diffusion;
ice_face_diffusion ice_cut_stress(const ice_view *v, int r, int axis, ptrdiff_t R, ptrdiff_t i);
/* What unlike fluids of the next cell do besides to a fluid of the cell of which the face is the lower or the upper one. */
ice_face_diffusion ice_stress_between(const ice *s, const ice_view *v, int r, int axis, ptrdiff_t R, ptrdiff_t i,
                                      mesh_side side);
/* Radial force per volume of the hoop stress on a cell; 0 in the plane. */
double ice_cut_hoop(const ice_view *v, int r, ptrdiff_t at, ptrdiff_t i);

/* P dP of a cell (theory 2.7), and what a fluid among several gains by it per mass (2.8 i). */
double ice_compression_work(const ice_view *v, ptrdiff_t at);
double ice_reversible_gain(const ice_view *v, int r, ptrdiff_t at, double work);

/* Lagrangian values of a region's fluids. Its parts: those of whole cells; what sides and loads do, and the tiles into the ledger. */
floe_status ice_sources_of(ice *s, const ice_region *g);
void ice_find_sources(ice *s, const ice_region *g);
floe_status ice_finish_sources(ice *s, const ice_region *g);

/* A change of velocity and a gain of total energy per mass onto a fluid's Lagrangian values: heat is what motion does not take. */
FLOE_ALWAYS_INLINE void ice_add_change(const ice_fluid *m, ptrdiff_t at, const int dim, const double du[3],
                                       double energy)
{
    double kinetic = 0.0;
    for (int a = 0; a < dim; ++a) {
        const double old = m->ul[a][at];
        m->ul[a][at] = old + du[a];
        kinetic += du[a] * (old + 0.5 * du[a]);
    }
    m->el[at] += energy - kinetic;
}

/* Cells of the loads that heat fluids; none without such loads. Some load adds energy to a fluid. */
floe_status ice_heated_create(ice *s);
void ice_heated_destroy(context *ctx, struct ice_heated **w);
bool ice_some_load_heats(const ice *s);
/* What heating at a given power does to the pressure over the step, at the volumes there are, onto the array of dP: for the
 * implicit pressure, in whose one step the flow relieves it. */
floe_status ice_load_pressure(ice *s, const ice_region *g);

#endif
