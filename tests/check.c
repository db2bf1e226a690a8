#include "check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Written as !(error <= bound) so that a NaN on any side fails; equal infinities have no finite difference. */
static void check_error(double a, double b, double bound, const char *a_text, const char *b_text, const char *file,
                        int line)
{
    const double error = fabs(a - b);
    if ((isinf(a) && a == b) || error <= bound) return;
    print_error("%s = %.17g\n%s = %.17g\ndiffer by %.3g, allowed %.3g\n", a_text, a, b_text, b, error, bound);
    _fail(file, line);
}

void check_close_at(double a, double b, double tol, const char *a_text, const char *b_text, const char *file, int line)
{
    check_error(a, b, tol, a_text, b_text, file, line);
}

void check_close_relative_at(double a, double b, double tol, const char *a_text, const char *b_text, const char *file,
                             int line)
{
    check_error(a, b, tol * fmax(fabs(a), fabs(b)), a_text, b_text, file, line);
}

void check_status_at(context *ctx, floe_status status, floe_status expected, const char *text, const char *file,
                     int line)
{
    if (status == expected) return;
    print_error("%s gave %s, expected %s: %s\n", text, status_name(status), status_name(expected),
                context_message(ctx));
    _fail(file, line);
}

void check_fails_at(context *ctx, floe_status status, floe_status expected, const char *text, const char *file,
                    int line)
{
    check_status_at(ctx, status, expected, text, file, line);
    if (context_message(ctx)[0] == '\0') {
        print_error("%s failed as expected, but left no message\n", text);
        _fail(file, line);
    }
    context_clear(ctx);
}

double check_random(uint64_t *seed, double lo, double hi)
{
    uint64_t z = *seed += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    z ^= z >> 31;
    return lo + (hi - lo) * ((double)(z >> 11) * 0x1.0p-53);
}

bool check_at_length(void)
{
    return getenv("FLOE_EVERY") != NULL;
}

bool check_asks_for(const char *model)
{
    const char *wanted = getenv("FLOE_MODEL");
    return !wanted || strcmp(wanted, model) == 0;
}

int check_make_context(void **state)
{
    *state = context_create();
    return *state == NULL;
}

int check_drop_context(void **state)
{
    context *ctx = *state;
    context_destroy(&ctx);
    return 0;
}
