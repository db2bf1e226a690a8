/* Memory that fails inside CVODE: each of its vectors in turn. Nothing is used that is not there, and all that is there is given back. */
#include "check.h"

#include "coupling/reaction.h"

#include <nvector/nvector_serial.h>

static int calls, fails_at; /* which call of N_VNew_Serial has no memory; -1: none */
static realtype memory[2][REACTION_MAX];

/* In place of the library's: the same vector in the test's own memory, or none. */
N_Vector N_VNew_Serial(sunindextype n, SUNContext sun)
{
    const int call = calls++;
    return call == fails_at || call > 1 ? NULL : N_VMake_Serial(n, memory[call], sun);
}

static void each_vector_fails(void **state)
{
    (void)state;
    static const reaction list[2];
    for (fails_at = -1; fails_at < 2; fails_at++) {
        context *ctx = context_create();
        reaction_solver *solver = NULL;
        calls = 0;
        const floe_status status = reaction_create(&solver, ctx, 2, list);
        assert_int_equal(calls, 2);
        if (fails_at < 0) {
            check_ok(ctx, status);
            reaction_destroy(ctx, &solver);
        } else {
            check_fails(ctx, status, FLOE_NO_MEMORY);
        }
        assert_null(solver);
        context_destroy(&ctx);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_vector_fails)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
