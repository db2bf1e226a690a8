/* Fluids that start at rest under their own weight (theory 2.4, 4.8). */
#ifndef SCENE_FLUID_COLUMNS_H
#define SCENE_FLUID_COLUMNS_H

#include "scene/scene.h"

/* Whether pressures of the deck are those without weight: no exact solution and no formula gives one. */
bool scene_adds_weight(const scene *s);
/* Whether a fluid along an axis is held up: not along a periodic one, and not between open sides of one pressure. */
bool scene_bears_weight(const scene *s, int axis);
/* Whether every body of a material, and the ambient where it is of it, is given by its density. */
bool scene_is_given_by_density(const scene *s, int material);
/* m/s2: what each body of the scene falls with at the start. */
void scene_find_pulls(const scene *s, double pull[SCENE_MAX_BODIES][3]);
/* The axis along which fluids on points start with their weight, and what each body of the scene falls with along it at the start
 * (m/s2); -1: they start with the pressures of the deck, since nothing pulls yet, or not along one axis alone. */
int scene_point_columns(const scene *s, double pull[SCENE_MAX_BODIES]);

#endif
