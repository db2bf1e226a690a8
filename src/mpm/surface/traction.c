/* Loads on surfaces: massless points that the nodes move, each with an area (theory 4.13). */
#include "mpm/surface/traction.h"

#include "mpm/loads/point_loads.h"
#include "mpm/surface/surfaces.h"
#include "scene/state.h"

void scatter_gas_pressure(mpm *s, int enclosed)
{
    for (size_t k = 0; k < s->surfaces->n_loaded; ++k)
        if (s->surfaces->loaded[k].enclosed == enclosed)
            add_surface_force(s, 0, s->surfaces->loaded[k].x, s->surfaces->loaded[k].area);
}

/* One surface point after the other, so that every block adds up a node in the same order. */
void scatter_surfaces(mpm *s, int group)
{
    double moment[3] = {0.0};
    for (size_t k = 0; k < s->surfaces->n_loaded; ++k) {
        const surface_point *p = &s->surfaces->loaded[k];
        if (p->load < 0) continue;
        const scene_load *load = &s->scene->load[p->load];
        if (s->body_group[load->body] != group) continue;
        const double pressure = load_target(s->scene, load, p->x, load_time(s)) * load_now(s, load);
        const double force[3] = {pressure * p->area[0], pressure * p->area[1], pressure * p->area[2]};
        add_surface_force(s, group, p->x, force);
        for (int a = 0; a < s->mesh->dim; ++a) {
            ledger_add(s->ledger, (ledger_quantity)(LEDGER_MOMENTUM_X + a), LEDGER_SOURCE, force[a] * s->kick);
            add_moment(moment, p->x, a, force[a]);
        }
    }
    ledger_turn(s->ledger, LEDGER_SOURCE, moment, s->kick);
}

void move_surfaces(mpm *s, int group)
{
    for (size_t k = 0; k < s->surfaces->n_loaded; ++k) {
        const surface_point *p = &s->surfaces->loaded[k];
        const scene_load *load = &s->scene->load[p->load];
        if (s->body_group[load->body] != group) continue;
        const surface_motion m = surface_motion_at(s, group, p->x);
        const double pressure = load->target * load_now(s, load);
        double power = 0.0;
        for (int a = 0; a < 3; ++a) {
            s->surfaces->loaded_next[k].x[a] = p->x[a] + s->dt * m.velocity[a];
            s->surfaces->loaded_next[k].area[a] = p->area[a];
            power += pressure * p->area[a] * m.velocity[a];
        }
        s->surfaces->loaded_next[k].load = p->load;
        s->surfaces->loaded_next[k].enclosed = p->enclosed;
        s->surfaces->loaded_next[k].body = p->body;
        ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_SOURCE, power * s->dt);
    }
}

void displace_surfaces(mpm *s, node_displacement *displacement)
{
    for (size_t k = 0; k < s->surfaces->n_loaded; ++k) {
        const surface_point *p = &s->surfaces->loaded[k];
        const int body = p->load < 0 ? p->body : s->scene->load[p->load].body;
        const int group = body < 0 ? 0 : s->body_group[body];
        surface_point *next = &s->surfaces->loaded_next[k];
        *next = *p;
        displace_position(s, group, p->x, displacement, next->x);
    }
}

double *mpm_surface(mpm *s, size_t *n, size_t *stride)
{
    *n = s->surfaces->n_loaded;
    *stride = sizeof(surface_point) / sizeof(double);
    return *n ? s->surfaces->loaded[0].x : NULL;
}
