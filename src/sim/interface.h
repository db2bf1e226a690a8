/* Which interface solids and gas of the cells have (method.interface): what cut cells take, in one table, for refusals
 * and for auto. */
#ifndef SIM_INTERFACE_H
#define SIM_INTERFACE_H

#include "sim/sim.h"

/* Settles what the deck leaves open. Interface `auto`: sharp where the table has nothing against it, else smeared; scene.interface_reason says why. A scene
 * without solids beside gas of the cells gets smeared, which nothing in it reads. Other choices stay.
 * Sub-steps of the points: auto beside a sharp interface, else one. FLOE_NO_MEMORY. */
floe_status interface_settle(scene *s);
/* Whether gas of the cells can be cut as the scene asks, by membranes that hold it or by surfaces of solids.
 * FLOE_BAD_INPUT, with key and remedy. */
floe_status interface_check(const scene *s, const mesh *m);
/* The interface in words, with why where `auto` has settled it; "" where no solid is beside fluids on cells. */
const char *interface_told(const sim *s);

#endif
