/* Which solids have a temperature of their own (theory 12). */
#ifndef SCENE_SOLID_HEAT_H
#define SCENE_SOLID_HEAT_H

#include "scene/scene.h"

/* Whether the deck gives fluids and a solid material a heat exchange: by method.heat_exchange or by a pair of `exchange`. */
bool scene_solid_exchanges_heat(const scene *s, int material);
/* Whether a reaction uses a material up. */
bool scene_material_burns(const scene *s, int material);
/* Whether the points of a material carry a temperature: a solid with a law and a specific heat that something can heat
 * or that responds to its temperature, which is `conductivity`, `expansion`, a given `plastic_heat`, or, in cells that
 * it shares with fluids (`smeared`), heat exchange. A solid that burns has none. */
bool scene_solid_has_temperature(const scene *s, int material, bool smeared);
bool scene_some_solid_conducts(const scene *s);
/* Whether heat passes sharp surfaces of solids: some fluid and some solid with a temperature conduct it (theory 7.10). */
bool scene_heat_passes_walls(const scene *s);
/* The share of plastic work that becomes heat (Taylor and Quinney 1934): the deck's, or 0.9. */
double scene_plastic_heat(const scene_material *m);

#endif
