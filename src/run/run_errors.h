/* The errors of a summary: finding them, and showing them to people. */
#ifndef RUN_RUN_ERRORS_H
#define RUN_RUN_ERRORS_H

#include "io/summary.h"

enum { ERROR_TEXT = 64 };

/* The error of that name; NAN if there is none. */
double error_of(const run_summary *r, const char *name);
/* True for an error that is a ratio, which is shown in per cent. */
bool error_is_relative(const char *name);
/* What the exact solution may itself be off in a relative error against it; 0: nothing that is known. */
double error_floor(const run_summary *r, const char *name);
/* Unit of an error for people: "%", "" or that of its quantity; a dimensionless scene's have none but "%". */
const char *error_unit(const char *name, bool dimensionless);
/* "0.123 %", "4.5 Pa", "-" for NAN. */
void error_text(const char *name, double error, bool dimensionless, char text[ERROR_TEXT]);
/* The same without the unit, for columns whose heading has it. */
void error_number(const char *name, double error, char text[ERROR_TEXT]);

#endif
