/* Decks: from a YAML file to a scene and back, with every error at its place; and what the schema says about itself. */
#ifndef DECK_DECK_H
#define DECK_DECK_H

#include "base/param.h"
#include "scene/batches.h"

/* What the deck needs from modules that it cannot include, filled by the caller (once; nothing is owned by the
 * deck). */
typedef struct deck_exact { /* an exact solution, as far as the deck needs it */
    const char *name, *doc, *cite;
    const param_spec *params;
    size_t n_params, param_size;
    int min_dim, max_dim;
} deck_exact;

typedef struct deck_history_reference { /* a reference of histories */
    const char *name, *doc, *cite;
    const param_spec *params;
    size_t n_params, param_size;
} deck_history_reference;

typedef struct deck_name {
    const char *name, *doc;
} deck_name;

typedef struct deck_catalogue {
    const solid_model *law; /* laws of solids and equations of state beside floe's own: a program's */
    size_t n_law;
    const eos_model *eos;
    size_t n_eos;
    const deck_exact *exact;
    size_t n_exact;
    const deck_history_reference *reference;
    size_t n_reference;
    const deck_name *basis;
    size_t n_basis;
    const deck_name *transfer;
    size_t n_transfer;
    const deck_name *normal; /* kinds of normals of contact */
    size_t n_normal;
    const deck_name *metric; /* "eq13"; "l1_X" stands for one name with each quantity for X */
    size_t n_metric;
    const deck_name *quantity;
    size_t n_quantity;
    /* NULL when the metric can be measured in the scene, "" when there is none of that name, else why it cannot be.
     * NULL function: every name that `metric` gives can be measured. */
    const char *(*check_metric)(const char *name, const scene *s);
    /* FLOE_BAD_INPUT with the context's message when the parameters contradict each other; may be NULL. */
    floe_status (*check_exact)(context *ctx, const char *name, const void *par, int dim);
    floe_status (*check_reference)(context *ctx, const char *name, const void *par);
    /* The i-th quantity of a reference; NULL at the end. NULL function: no quantity is known. */
    const char *(*reference_quantity)(const char *name, size_t i);
} deck_catalogue;

/* `--set K=V` of the command line, in order: later ones win. */
typedef struct deck_overrides {
    const char *const *text; /* "domain.cell=0.0125" */
    size_t n;
} deck_overrides;

/* The errors of a load. Start with {0}; deck_report_free releases it. */
typedef struct deck_report {
    context *ctx; /* set by the load; not owned */
    size_t count; /* errors */
    char *text;   /* all of them, ready to print; NULL when there is none */
} deck_report;

void deck_report_free(deck_report *report);

/* Process-wide settings of the libraries behind decks; floe_init calls it once. */
void deck_init(void);

/* Reads the deck at `path`, applies `set` (may be NULL) and resolves it into a scene, which the caller owns.
 * FLOE_BAD_INPUT: errors are in *report and the context's message counts them. FLOE_IO: the file cannot be read. No
 * state is kept between calls; several threads may call, each with a context of its own (udunits2, which is not
 * thread-safe, is locked). */
floe_status deck_load(scene **out, context *ctx, const char *path, const deck_overrides *set,
                      const deck_catalogue *catalogue, deck_report *report);
/* The same from text in memory (text[length] is 0); `path` names it in messages and in the scene. */
floe_status deck_load_text(scene **out, context *ctx, const char *path, const char *text, size_t length,
                           const deck_overrides *set, const deck_catalogue *catalogue, deck_report *report);

/* The same, and every value of the deck's axes (compare, study, stability) must make a deck, too: for who writes a
 * deck. A single run takes nothing of them, and batches look at each of their cases. */
floe_status deck_check(scene **out, context *ctx, const char *path, const deck_overrides *set,
                       const deck_catalogue *catalogue, deck_report *report);

/* The texts below are counted memory that the caller frees with memory_free. */

/* The resolved deck: every value explicit, SI, 17 digits. It loads again to the same scene. */
floe_status deck_echo(char **text, const scene *s, const deck_catalogue *catalogue);
/* The value of a key in the resolved deck, "" where the key is not there, or holds no single value. */
floe_status deck_value(char value[SCENE_VALUE], const scene *s, const deck_catalogue *catalogue, const char *key);
/* The schema as Markdown: docs/deck.md. */
floe_status deck_reference(char **text, context *ctx, const deck_catalogue *catalogue);
/* The schema as a JSON schema (draft 7), for editors. */
floe_status deck_json_schema(char **text, context *ctx, const deck_catalogue *catalogue);
/* A commented deck to start from. */
floe_status deck_starter(char **text, context *ctx, const char *name);

#endif
