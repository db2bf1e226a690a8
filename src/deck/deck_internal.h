/* Tables and custom keys that make up the schema, by file. Private to src/deck. */
#ifndef DECK_INTERNAL_H
#define DECK_INTERNAL_H

#include "deck/schema/schema.h"

/* schema_items.c */
extern const named_items items_materials, items_bodies, items_loads, items_probes, items_tracers;
/* schema_membranes.c */
extern const key_table membrane_table;
/* positions.c */
extern const special_key special_positions, special_sheet_positions;
/* schema_springs.c */
extern const named_items items_springs, items_supports;
/* schema_sources.c */
extern const named_items items_sources, items_vents;
/* schema_exchange.c */
extern const named_items items_exchanges;
extern const model_family family_momentum, family_heat;
extern const special_key special_pair;
/* schema_reactions.c */
extern const named_items items_reactions;
extern const model_family family_reaction;
/* formula_key.c */
extern const named_items items_constants;
/* A number of any dimension, or a formula of numbers and constants. *why: what is wrong; "": nothing is. */
floe_status read_any_number(reader *r, const deck_node *node, double *out, expression_dimension *dimension,
                            char why[EXPRESSION_WHY]);
/* Refuses what cannot be the name of a constant or of a table. */
floe_status check_formula_name(reader *r, deck_node *node, const char *name);
/* tables.c */
extern const named_items items_tables;
/* families.c */
extern const model_family family_shape, family_law, family_membrane, family_normals, family_eos, family_exact,
    family_reference;
/* boundaries.c */
extern const special_key special_boundaries;
extern const named_items items_parts;
extern const variants boundary_kinds;
/* special_keys.c */
extern const special_key special_version, special_runs_as, special_stress_state, special_cfl, special_substeps,
    special_exchange, special_checkpoint_interval, special_preset;
extern const choice coupling_choices[];
/* special_names.c */
extern const special_key special_metrics, special_basis, special_transfer, special_normals, special_between;
/* motion_key.c */
extern const special_key special_motion;
/* columns.c */
extern const special_key special_columns;
/* deck_study.c */
extern const special_key special_axis, special_axes, special_over, special_each, special_quantities;
/* The value at a node, as --set takes it. */
floe_status read_setting(reader *r, deck_node *node, char value[SCENE_VALUE]);
/* bars.c */
extern const special_key special_require, special_check, special_refuse, special_unchanged;

/* true for an axis key of a boundary: "x", "r" ... */
const char *axis_name(const mesh_spec *spec, int axis);
/* The body is given along a curve, or its material can be nothing else. */
bool body_is_membrane(const scene *s, const void *body);
/* What the membrane of a body misses: after its keys are read. */
floe_status end_membrane(reader *r, deck_node *node, scene_body *body);

/* Fills what depends on more than one key: finish.c, after the tables and before the checks. */
floe_status finish_scene(reader *r);

/* keys.c: notes in the scene where its keys stand, in the deck or in `set`, for what is refused later
 * (scene/deck_location.h). */
floe_status note_keys(scene *s, const deck_node *root, const deck_overrides *set);

#endif
