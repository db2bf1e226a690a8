/* Cases of crossed axes, as study, compare, stability and runs to a tolerance all have them: combinations, the settings
 * that make a case of the deck, and how both are told in JSON, CSV and tables. */
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

/* A field of CSV with the comma behind it. */
void csv_append_field(strbuf *out, const char *text);
/* DIR/STEM.csv of the rows, which are freed whatever comes back. */
floe_status csv_write_rows(strbuf *rows, const char *dir, const char *stem);

/* The larger of a width and a text's length; the width of a column of an axis under the heading `name`. */
int width_at_least(int width, const char *text);
int axis_width(const scene_axis *axis, const char *name, int least);

#endif
