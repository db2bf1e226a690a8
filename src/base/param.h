/* Parameter tables: how materials, equations of state, shapes, bases and exact solutions say what they take.
 * The deck reads, checks, defaults, lists and documents from these tables; nobody parses a parameter by hand. */
#ifndef BASE_PARAM_H
#define BASE_PARAM_H

#include "base/sha256.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

typedef enum param_range {
    PARAM_ANY,         /* any finite number */
    PARAM_POSITIVE,    /* > 0 */
    PARAM_NONNEGATIVE, /* >= 0 */
    PARAM_BETWEEN      /* lo <= x <= hi */
} param_range;

/* What a parameter is, and what it is in the struct. */
typedef enum param_kind {
    PARAM_NUMBERS, /* as many doubles as `count` says */
    PARAM_POINTS,  /* param_list of double[3]: positions, a number for each axis */
    PARAM_MODEL,   /* one more model of the same registry, as its field stores it */
    PARAM_MODELS,  /* param_list of such fields */
    PARAM_FILE     /* param_file */
} param_kind;

typedef struct param_list {
    void *item; /* owned by whom the parameters are owned by */
    size_t n;
} param_list;

/* A file that a parameter names. */
typedef struct param_file {
    const char *path;         /* from the root of the file system */
    const void *bytes;        /* its content, there only until the model is prepared */
    size_t size;              /* bytes */
    char digest[SHA256_TEXT]; /* of the content */
} param_file;

typedef struct param_spec {
    const char *key;  /* name in the deck; NULL: the only parameter, given as the value of the model itself */
    const char *unit; /* SI unit in udunits2 spelling, "1" if none */
    param_range range;
    double lo, hi;   /* used by PARAM_BETWEEN */
    double fallback; /* default; NAN: required */
    size_t offset;   /* of the first double in the parameter struct */
    int count; /* 1: a number; n > 1: a list of exactly n numbers; -3: a vector of the scene's dimension in double[3] */
    const char *doc; /* one line */
    param_kind kind; /* unit, range, fallback and count are of numbers; all else is required */
    int dim;         /* of nested models: the dimension that they are given in; 0: that of the scene */
    int least;       /* of lists: fewest entries */
} param_spec;

/* Entries of a table, one line each. `type` is the parameter struct, `field` its double, which has the name of the
 * key. */
#define PAR_ENTRY(type, field, unit_, range_, lo_, hi_, fallback_, count_, doc_)                    \
    {                                                                                               \
        .key = #field, .unit = unit_, .range = range_, .lo = lo_, .hi = hi_, .fallback = fallback_, \
        .offset = offsetof(type, field), .count = count_, .doc = doc_                               \
    }
#define PAR_ANY(type, field, unit, fallback, doc) PAR_ENTRY(type, field, unit, PARAM_ANY, 0.0, 0.0, fallback, 1, doc)
#define PAR_POSITIVE(type, field, unit, fallback, doc) \
    PAR_ENTRY(type, field, unit, PARAM_POSITIVE, 0.0, 0.0, fallback, 1, doc)
#define PAR_NONNEGATIVE(type, field, unit, fallback, doc) \
    PAR_ENTRY(type, field, unit, PARAM_NONNEGATIVE, 0.0, 0.0, fallback, 1, doc)
#define PAR_BETWEEN(type, field, unit, lo, hi, fallback, doc) \
    PAR_ENTRY(type, field, unit, PARAM_BETWEEN, lo, hi, fallback, 1, doc)
/* A vector of the scene's dimension, in double[3]. */
#define PAR_VECTOR(type, field, unit, range, fallback, doc) \
    PAR_ENTRY(type, field, unit, range, 0.0, 0.0, fallback, -3, doc)

/* Of other kinds; `field` is a member of the type that the kind says. */
#define PAR_OTHER(type, field, kind_, dim_, least_, doc_)                                                           \
    {                                                                                                               \
        .key = #field, .unit = "1", .fallback = NAN, .offset = offsetof(type, field), .kind = kind_, .dim = (dim_), \
        .least = (least_), .doc = doc_                                                                              \
    }
#define PAR_POINTS(type, field, unit_, least_, doc_)                                                          \
    {                                                                                                         \
        .key = #field, .unit = unit_, .fallback = NAN, .offset = offsetof(type, field), .kind = PARAM_POINTS, \
        .least = (least_), .doc = doc_                                                                        \
    }
#define PAR_MODEL(type, field, dim, doc) PAR_OTHER(type, field, PARAM_MODEL, dim, 0, doc)
#define PAR_MODELS(type, field, least, doc) PAR_OTHER(type, field, PARAM_MODELS, 0, least, doc)
#define PAR_FILE(type, field, doc) PAR_OTHER(type, field, PARAM_FILE, 0, 0, doc)
/* A model that is nothing but a list of models: `name: [{...}, {...}]`. */
#define PAR_MODELS_ALONE(type, field, least_, doc_)                                                             \
    {                                                                                                           \
        .unit = "1", .fallback = NAN, .offset = offsetof(type, field), .kind = PARAM_MODELS, .least = (least_), \
        .doc = doc_                                                                                             \
    }

/* true when x is finite and inside the range of the spec. */
bool param_in_range(const param_spec *spec, double x);
/* "a number > 0", "a number from 0 to 0.5": the words of an error message. Writes at most size bytes. */
void param_describe_range(const param_spec *spec, char *text, size_t size);

/* Fills a parameter struct, zeroed by the caller, with the defaults of its numbers: NAN where one is required. */
void param_fill_defaults(const param_spec *specs, size_t n, void *par);
/* The (first) double of the parameter `key` inside `par`; NULL if there are no numbers of that key. */
double *param_find(const param_spec *specs, size_t n, void *par, const char *key);

#endif
