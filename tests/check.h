/* What every test file includes: cmocka, and comparisons in which NaN fails.
 * Include this, not <cmocka.h>: cmocka defines a macro `fail` that would hide floe's function of that name. */
#ifndef TESTS_CHECK_H
#define TESTS_CHECK_H

/* cmocka.h needs these four before it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#undef fail

#include "base/context.h"

/* |a - b| <= tol. Both may be the same infinity. */
#define check_close(a, b, tol) check_close_at((a), (b), (tol), #a, #b, __FILE__, __LINE__)
/* |a - b| <= tol * max(|a|, |b|). */
#define check_close_relative(a, b, tol) check_close_relative_at((a), (b), (tol), #a, #b, __FILE__, __LINE__)
/* The status is FLOE_OK; otherwise the context's message is printed. */
#define check_ok(ctx, status) check_status_at((ctx), (status), FLOE_OK, #status, __FILE__, __LINE__)
/* The status is `expected`, and a failure has left a message. The message is then cleared. */
#define check_fails(ctx, status, expected) check_fails_at((ctx), (status), (expected), #status, __FILE__, __LINE__)
/* A condition with both its text and its place. */
#define check_true(condition) _assert_true((uintmax_t)((condition) ? 1 : 0), #condition, __FILE__, __LINE__)

/* The next of a repeatable sequence of numbers in [lo, hi); the seed is any number, and is advanced (splitmix64). */
double check_random(uint64_t *seed, double lo, double hi);

/* Whether the test is run at length (nightly: FLOE_EVERY is set), with what takes too long for every day: finer meshes, all combinations. */
bool check_at_length(void);

/* Whether a test of a registry asks this entry, by name: all, but for the examples of docs/extending.md, which ask their own (FLOE_MODEL). */
bool check_asks_for(const char *model);

/* Set-up and tear-down of a group of tests whose state is a context. */
int check_make_context(void **state);
int check_drop_context(void **state);

/* The functions behind the macros. */
void check_close_at(double a, double b, double tol, const char *a_text, const char *b_text, const char *file, int line);
void check_close_relative_at(double a, double b, double tol, const char *a_text, const char *b_text, const char *file,
                             int line);
void check_status_at(context *ctx, floe_status status, floe_status expected, const char *text, const char *file,
                     int line);
void check_fails_at(context *ctx, floe_status status, floe_status expected, const char *text, const char *file,
                    int line);

#endif
