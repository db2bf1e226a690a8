/* Numbers of a scene that formulas of place and time give (theory 1.5). Such a number keeps, in its field, its value in the
 * middle of the domain at the start, for what needs but its size. */
#ifndef SCENE_FORMULA_H
#define SCENE_FORMULA_H

#include "scene/scene.h"

/* The formula of a number, which is a field of the scene; NULL: it is constant. */
const expression *scene_formula_of(const scene *s, const double *number);
/* Whether a formula gives any number of a part of the scene, `size` bytes of it. */
bool scene_varies(const scene *s, const void *part, size_t size);
/* The same, in time. */
bool scene_varies_in_time(const scene *s, const void *part, size_t size);
/* Its value at x and t. FLOE_BAD_INPUT, with its key, where it has none, or one that the key does not take. */
floe_status scene_number(const scene *s, const double *number, const double x[3], double t, double *out);
/* Gives a number of the scene a formula, which the scene then owns, also where it fails; `rule` says what it may be, `path` is its
 * key, ended by NULL, and lives as long as the scene. */
floe_status scene_add_formula(scene *s, double *number, expression *formula, const param_spec *rule,
                              const char *const *path);
/* `to`, a number of the scene, has the formula that `from` has. */
floe_status scene_share_formula(scene *s, double *to, const double *from);
/* x of one of `each`^dim places, spread evenly over the box from lo to hi. */
void scene_sample_place(const scene *s, const double lo[3], const double hi[3], int each, int number, double x[3]);
/* The largest pressure (Pa) that a body of a fluid begins with, as samples have it; NAN: it is not known. */
double scene_largest_pressure(const scene *s, const scene_body *b);
/* Whether the first state of every fluid body, and of the ambient, is one of its fluid, as samples have it: else FLOE_BAD_INPUT
 * with the key. */
floe_status scene_check_first_states(const scene *s);
/* Whether every formula of time alone has a value that its key takes throughout the run, as samples have it. */
floe_status scene_check_formulas_in_time(const scene *s);
/* Takes formulas and tables away. */
void scene_free_formulas(scene *s);

#endif
