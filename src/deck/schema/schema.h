/* The schema: tables of keys that drive reading, checking, defaults, the echo, the reference page and the JSON schema.
 * Private to src/deck. */
#ifndef DECK_SCHEMA_H
#define DECK_SCHEMA_H

#include "deck/deck_errors.h"
#include "expression/expression.h"

#include <string.h>

typedef enum key_type {
    KEY_NUMBER,  /* double */
    KEY_NUMBERS, /* double[n]: a list of exactly n numbers, n from the size */
    KEY_VECTOR,  /* double[3]: a list of the scene's dimension; one number when that is 1 */
    KEY_SPREAD,  /* double[3]: a vector, or one number for every axis */
    KEY_WHOLE,   /* int or long */
    KEY_WHOLES,  /* int[3]: a list of the scene's dimension, or one whole number for every axis */
    KEY_BOOL,
    KEY_TEXT,     /* char[] */
    KEY_CHOICE,   /* int, enum or bool: one of a list of words */
    KEY_MATERIAL, /* int: index of a named material */
    KEY_BODY,     /* int: index of a named body */
    KEY_MAP,      /* a table of keys in a part of the struct */
    KEY_NAMED,    /* name: item, name: item ... */
    KEY_MODEL,    /* {name: {parameters}} of a registry */
    KEY_MODELS,   /* param_list: a list of them */
    KEY_POINTS,   /* param_list of double[3]: a list of positions */
    KEY_FILE,     /* param_file: the name of a file beside the deck */
    KEY_VARIANT,  /* {kind: {keys}}, each kind with a table of its own */
    KEY_SPECIAL
} key_type;

typedef struct key_spec key_spec;
typedef struct reader reader;
typedef struct writer writer;

typedef struct key_table {
    const key_spec *key;
    size_t n;
} key_table;
#define TABLE(array)                              \
    {                                             \
        (array), sizeof(array) / sizeof(array)[0] \
    }

typedef struct choice {
    const char *name;
    int value;
    const char *doc;
} choice;

/* One kind of a KEY_VARIANT. */
typedef struct variant {
    const char *name;
    int value;              /* handed to variants.choose */
    const key_table *table; /* NULL: the kind takes no keys */
    const char *doc;
} variant;

typedef struct variants {
    const char *noun; /* "load" */
    const variant *list;
    size_t n;
    void (*choose)(void *field, int value); /* sets the kind, and what goes with it */
    int (*chosen)(const void *field);       /* value of the kind that is set */
} variants;

/* A model of a registry, as the reader needs it. */
typedef struct model_entry {
    const char *name, *doc, *cite;
    const param_spec *params;
    size_t n_params, param_size;
    const void *model;
} model_entry;

enum { MODEL_WHY = 512 /* characters of what is wrong with a model */ };

typedef struct model_family {
    const char *noun;                                                         /* "shape" */
    bool (*get)(const deck_catalogue *catalogue, size_t i, model_entry *out); /* false at the end */
    void (*store)(void *field, const model_entry *entry, void *par);
    bool (*fetch)(const void *field, const char **name, const void **par); /* false: none is set */
    /* Refuses impossible parameters: NULL if fine. May be NULL. */
    const char *(*check)(const model_entry *entry, const void *par, int dim);
    /* Why there is no such model in a space of these dimensions, NULL: there is. NULL: all are in all. */
    const char *(*misfit)(const model_entry *entry, int dim);
    /* The entry that is set, where the registry does not hold all of them. NULL: it is found by its name. */
    bool (*chosen)(const void *field, model_entry *out);
    size_t field_size; /* where models are parameters of models */
    /* Checks the parameters, and makes what the model needs of them: `why` says what is wrong, "" if nothing is. In place
     * of `check`. */
    floe_status (*prepare)(scene *s, const model_entry *entry, void *par, int dim, char why[MODEL_WHY]);
} model_family;

/* Items of a KEY_NAMED: the array lies at the key's offset and each item begins with its name. */
typedef struct named_items {
    const char *noun;               /* "material" */
    size_t item_size, count_offset; /* count_offset: of the int that counts, from the same base as the key's offset */
    size_t most;
    const key_table *table; /* one of table, variants, and value */
    const variants *variants;
    const key_spec *value;
    /* Called before and after an item is read; may be NULL. */
    floe_status (*begin)(reader *r, deck_node *node, void *item);
    floe_status (*end)(reader *r, deck_node *node, void *item);
} named_items;

typedef struct special_key {
    floe_status (*read)(reader *r, const key_spec *key, deck_node *node, void *base); /* node NULL: absent */
    void (*write)(writer *w, const key_spec *key, const void *base);
    const char *form; /* what is written, for the reference and for messages */
    const char *json; /* JSON schema of the value */
    /* Of a name out of a registry: what it names, and the registry's names (user: the deck_catalogue; NULL ends them). */
    const char *noun;
    const char *(*candidate)(const void *user, size_t i);
} special_key;

/* What a formula may name that gives a number; 0: it is one number for the whole run. */
enum { VARIES_BY_PLACE = 1, VARIES_BY_TIME = 2 };

struct key_spec {
    const char *key;
    key_type type;
    const char *unit; /* SI, udunits2 spelling; NULL: no dimension */
    param_range range;
    double lo, hi;       /* PARAM_BETWEEN */
    size_t offset, size; /* in the struct that the table describes; size 0: not stored */
    int varies; /* VARIES_BY_PLACE + VARIES_BY_TIME: a formula of these may give it; its field must be in the scene itself */
    bool required;
    const char *fallback;  /* default, written as in a deck; NULL: the value is left alone */
    const char *otherwise; /* with no fallback: what holds when the key is absent, in words */
    const char *doc;
    const choice *choices;      /* KEY_CHOICE, ends with a NULL name */
    const key_table *table;     /* KEY_MAP */
    const named_items *items;   /* KEY_NAMED */
    const variants *variants;   /* KEY_VARIANT */
    const model_family *family; /* KEY_MODEL, KEY_MODELS */
    int dim;                    /* KEY_MODEL, KEY_MODELS: of the space of the models; 0: that of what they stand in */
    int least;                  /* KEY_MODELS, KEY_POINTS: fewest entries */
    const special_key *special; /* KEY_SPECIAL */
    size_t present;             /* 1 + offset of a bool that says whether the key was given; 0: none */
    size_t
        through; /* KEY_MAP: 1 + offset of a pointer to the struct that offset and present are of; 0: the table's own */
    /* Does the key belong to this item? NULL: always. `belongs` says to what, in words. */
    bool (*applies)(const scene *s, const void *base);
    const char *belongs;
    const char *formerly;          /* its name in older decks; NULL: the same */
    const char *renamed_choice[2]; /* a choice that was renamed: its former name and its name now */
};

#define AT(type, member) .offset = offsetof(type, member), .size = sizeof(((type *)0)->member)
#define THROUGH(type, member) .through = 1 + offsetof(type, member)
#define WITHIN(low, high) .range = PARAM_BETWEEN, .lo = (low), .hi = (high)

/* The struct that the offsets of a KEY_MAP are of; NULL where its pointer leads nowhere. */
static inline void *struct_of_map(const key_spec *key, const void *base)
{
    void *of;
    if (key->through == 0) return (void *)base;
    memcpy(&of, (const char *)base + key->through - 1, sizeof of);
    return of;
}

extern const key_table schema_deck; /* of a scene: the whole deck */

/* What a load carries from hand to hand. */
struct reader {
    context *ctx;
    scene *scene;
    const deck_catalogue *catalogue;
    deck_arena *arena;
    error_list *errors;
    deck_node *root;
    int dim; /* of the space that is read about; 0: the scene's */
};

struct writer {
    strbuf out;
    const scene *scene;
    const deck_catalogue *catalogue;
    int indent;
    int dim; /* as the reader's */
};

static inline int reader_dim(const reader *r)
{
    return r->dim > 0 ? r->dim : r->scene->mesh.dim;
}

static inline int writer_dim(const writer *w)
{
    return w->dim > 0 ? w->dim : w->scene->mesh.dim;
}

/* Reading. A fault of the deck is entered in the errors and FLOE_OK returned; other failures are returned. */
floe_status read_table(reader *r, const key_table *table, deck_node *map, void *base);
floe_status read_key(reader *r, const key_spec *key, deck_node *node, void *base);
/* Whether its values are in units; "1" is none. */
bool key_has_unit(const key_spec *key);
floe_status read_scalar(reader *r, const key_spec *key, deck_node *node, void *base);
floe_status read_model(reader *r, const key_spec *key, deck_node *node, void *base);
floe_status read_models(reader *r, const key_spec *key, deck_node *node, void *base);
floe_status read_points(reader *r, const key_spec *key, deck_node *node, void *base);
floe_status read_file_key(reader *r, const key_spec *key, deck_node *node, void *base);
floe_status read_variant(reader *r, const variants *kinds, deck_node *node, void *field);
floe_status read_named(reader *r, const key_spec *key, deck_node *node, void *base);
floe_status read_number(reader *r, const key_spec *key, deck_node *node, double *out);
/* A number that is no plain one: a formula (formula_key.c), if the text can be meant as one, which *meant tells. Of place or
 * time it becomes a formula of the scene, where the key varies. *why: what is wrong; "": nothing is, and *out is the number. */
floe_status read_formula(reader *r, const key_spec *key, const deck_node *node, double *out, bool *meant,
                         char why[EXPRESSION_WHY]);
/* One parameter of a model as a key. A parameter without a name of its own has the model's. */
key_spec key_of_param(const model_entry *entry, size_t i, const model_family *family);

/* Young's modulus and Poisson's ratio, which models that take a bulk and a shear modulus take in their place (young.c): the i-th key, NULL at the end and of
 * other models. */
const key_spec *young_key(const model_entry *entry, size_t i);
bool is_young_key(const model_entry *entry, const char *name);
/* Whether a name is one of the two moduli. */
bool is_modulus(const char *name);
/* Whether a map gives some of them (map: may be NULL), and reads them into the moduli of the parameters. */
bool gives_young(const model_entry *entry, deck_node *map);
floe_status read_young(reader *r, const model_entry *entry, deck_node *map, void *par);
/* Whether the model is written as the value of its only parameter. */
bool stands_alone(const model_entry *entry);
/* A position as a list of numbers. */
floe_status read_position(reader *r, const key_spec *key, deck_node *item, double position[3]);
/* Where a file that the deck names is: beside the deck, told from the root, so that the resolved deck finds it from
 * anywhere. An error has been entered where *path is NULL. It lives as long as the scene. */
floe_status resolve_path(reader *r, deck_node *node, const char **path);

/* Enters an error at a node, and marks it bad. */
floe_status bad(reader *r, deck_node *node, const char *expected, const char *format, ...) FLOE_PRINTF(4, 5);
/* What stands at a node is of no form that its key takes. */
floe_status bad_form(reader *r, const key_spec *key, deck_node *node, const char *form);
/* At the node's key, with a hint. */
floe_status bad_key(reader *r, deck_node *node, const char *expected, const char *hint, const char *format, ...)
    FLOE_PRINTF(5, 6);
/* "a number > 0 in Pa": what a key takes. */
void describe_expected(const key_spec *key, int dim, char *text, size_t size);
/* An unknown name at a node, with the nearest known one and all of them as what was expected. */
floe_status bad_name(reader *r, deck_node *node, bool at_key, const char *noun,
                     const char *(*candidate)(const void *user, size_t i), const void *user);
/* An unknown key, with a hint where the slip shows: a decimal comma, a colon without a space, or a key of another place. */
floe_status bad_unknown_key(reader *r, deck_node *node, const char *(*candidate)(const void *user, size_t i),
                            const void *user);
/* Index of a named material or body, -1 if there is none. */
int find_material(const scene *s, const char *name);
int find_body(const scene *s, const char *name);

/* Writing. */
void write_table(writer *w, const key_table *table, const void *base);
void write_key_name(writer *w, const char *key);
void write_number(strbuf *out, double x);
void write_position(writer *w, const double position[3]);
void write_variant(writer *w, const variants *kinds, const void *field);
void write_quoted(strbuf *out, const char *text);

#endif
