/* Cases of crossed axes, as study, compare, stability and runs to a tolerance all have them: combinations, and the
 * settings that make a case of the deck. */
#ifndef STUDY_CROSSED_H
#define STUDY_CROSSED_H

#include "deck/deck.h"
#include "io/json.h"
#include "study/axis.h"

/* Combinations of n axes, the first varying slowest: how many, and the indices of the i-th one's values. */
size_t crossed_count(const scene_axis *axis, int n);
void crossed_pick(const scene_axis *axis, int n, size_t i, int *pick);

/* Texts "KEY=VALUE" that make a case of the deck, in order: later ones win. */
typedef struct case_settings {
    const char **set; /* n of them; owned */
    size_t n;
    char (*text)[SCENE_SETTING]; /* those that were made here; owned */
    size_t n_text;
} case_settings;

/* Begins with those of the user, with space for `more` others. */
floe_status case_settings_make(case_settings *c, context *ctx, const deck_overrides *user, size_t more);
void case_settings_free(case_settings *c, context *ctx);
/* A text that stays where it is. */
void case_settings_add(case_settings *c, const char *text);
void case_settings_put(case_settings *c, const char *key, const char *value);
/* The value of an axis, and those of the keys that change along with it. */
void case_settings_pick(case_settings *c, const scene_axis *axis, int pick);

/* {key: value} of a combination; [value, ...]. */
json_t *crossed_json(const scene_axis *axis, int n, const int *pick);
json_t *axis_values_json(const char (*value)[SCENE_VALUE], int n);

#endif
