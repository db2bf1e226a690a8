/* A map of the axes: of places and of vectors. */
#ifndef TESTS_VERIFICATION_SCENE_MAP_FIXTURE_H
#define TESTS_VERIFICATION_SCENE_MAP_FIXTURE_H

#include "mpm_fixture.h"

/* Axis a of the new scene is axis from[a] of the old one: x_a' = sign[a] x_from[a] + shift[a]. Beyond the old scene's axes nothing changes
 * along an axis. */
typedef struct scene_map {
    int dim; /* of the old scene */
    int from[3];
    double sign[3], shift[3]; /* shift: m */
} scene_map;

FIXTURE scene_map map_none(int dim)
{
    return (scene_map){.dim = dim, .from = {0, 1, 2}, .sign = {1.0, 1.0, 1.0}};
}

FIXTURE void map_back(const scene_map *m, const double x[3], double old[3])
{
    for (int a = 0; a < 3; ++a) old[a] = 0.0;
    for (int a = 0; a < m->dim; ++a) old[m->from[a]] = m->sign[a] * (x[a] - m->shift[a]);
}

FIXTURE void map_place(const scene_map *m, double x[3])
{
    const double old[3] = {x[0], x[1], x[2]};
    for (int a = 0; a < m->dim; ++a) x[a] = m->sign[a] * old[m->from[a]] + m->shift[a];
}

FIXTURE void map_vector(const scene_map *m, double v[3])
{
    const double old[3] = {v[0], v[1], v[2]};
    for (int a = 0; a < m->dim; ++a) v[a] = m->sign[a] * old[m->from[a]];
}

#endif
