/* The interface between solids and gas on cells (method.interface): one table of what cut cells support, for refusals
 * and for `auto`. */
#ifndef SIM_INTERFACE_H
#define SIM_INTERFACE_H

#include "sim/sim.h"

/* Resolves what the deck leaves open. Interface `auto`: sharp where the table has no objection, else smeared;
 * scene.interface_reason says why. A scene without solids beside gas on cells gets smeared, which has no effect there.
 * Other choices stay. Substeps of the points: auto beside a sharp interface, else one. FLOE_NO_MEMORY. */
floe_status interface_settle(scene *s);
/* Before it: FLOE_BAD_INPUT where the surfaces of solids would have to be traced on more cells than can be numbered. */
floe_status interface_check_size(const scene *s, const mesh *m);
/* Whether the scene's embedded boundaries, membranes around gas or surfaces of solids, are supported. FLOE_BAD_INPUT,
 * with key and remedy. */
floe_status interface_check(const scene *s, const mesh *m);
/* The interface in words, with the reason where `auto` has chosen it; "" where no solid is beside fluids on cells. */
const char *interface_in_words(const sim *s);

#endif
