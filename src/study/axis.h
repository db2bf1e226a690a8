/* Axes of a batch: deck keys and their values, as the command line gives them. */
#ifndef STUDY_AXIS_H
#define STUDY_AXIS_H

#include "base/strbuf.h"
#include "scene/batches.h"

typedef struct axis_list {
    scene_axis axis[SCENE_MAX_AXES];
    int n;
} axis_list;

/* Reads "KEY=V1,V2,...", and behind it ";KEY=V1,V2,..." for keys that change along with the first; commas and
 * semicolons inside brackets, braces and quotes are part of a value. False: what is wrong, with the axis, the value and
 * the remedy, was appended to `errors` as a line. */
bool axis_parse(const char *text, scene_axis *axis, strbuf *errors);
/* The same for an axis whose key alone changes; FLOE_BAD_INPUT with the option's name, "--each". */
floe_status axis_from_text(context *ctx, const char *option, const char *text, scene_axis *axis);
/* Puts the axis in the place of the one with its key, or behind the others. If that one has keys that change along, and
 * this one names none, its values take what goes with them; one that is not among them has nothing that does. False as
 * above. */
bool axis_put(axis_list *list, const scene_axis *axis, strbuf *errors);
/* Adds a line to `errors` for each key that two axes set. */
void axis_check_keys(const axis_list *list, strbuf *errors);
/* Index of the axis of that key, -1 if there is none. */
int axis_find(const axis_list *list, const char *key);

/* Reads a value that is a number, alone or with a unit; *unit is the rest. */
bool axis_number(const char *value, double *number, const char **unit);
/* Are all values different numbers > 0 in the same unit? Then orders can be taken over them. */
bool axis_is_numeric(const scene_axis *axis);
/* The same text, or the same number in the same unit. */
bool axis_same_value(const char *a, const char *b);

#endif
