/* The words of a formula as it is read. Private to src/expression. */
#ifndef EXPRESSION_WORDS_H
#define EXPRESSION_WORDS_H

#include "expression/expression_internal.h"

typedef struct expression_words {
    const char *text, *at; /* all of it, and what is still to be read */
    const expression_scope *scope;
    bool has_unit; /* a number carried one */
    char *why;     /* EXPRESSION_WHY */
} expression_words;

/* Says what is wrong at the place that is read, or at `place`; false. */
bool words_refuse(expression_words *w, const char *place, const char *format, ...) FLOE_PRINTF(3, 4);
void words_skip_blanks(expression_words *w);
/* Reads the sign if it comes next. */
bool words_take(expression_words *w, const char *sign);
/* Reads the word if it comes next, and no longer one. */
bool words_take_word(expression_words *w, const char *word);
/* Length of the name that comes next; 0: something else does. */
size_t words_name(const expression_words *w);
/* A decimal number with its unit, if it has one. */
bool words_number(expression_words *w, double *value, expression_dimension *dimension);
/* Whether a name is that of a coordinate, of time, of a constant, or of a table. */
bool words_known(const expression_scope *scope, const char *name, size_t length);
/* The constant or table of this name; NULL: there is none. */
const expression_constant *words_constant(const expression_scope *scope, const char *name, size_t length);
const expression_function *words_function(const expression_scope *scope, const char *name, size_t length);
/* Its number, from 0; -1: it is none. */
int words_coordinate(const expression_scope *scope, const char *name, size_t length);

#endif
