/* Shapes that a test makes, and what they are made of until it ends. */
#ifndef TESTS_SHAPE_FIXTURE_H
#define TESTS_SHAPE_FIXTURE_H

#include "check.h"

#include "base/memory.h"
#include "geom/shape.h"

#include <string.h>

typedef struct maker {
    context *ctx;
    void *made[4096];
    int n;
    char why[SHAPE_WHY]; /* why a shape was refused; "": it was not */
} maker;

/* A shape_memory's allocator. */
static inline floe_status allocate(void *owner, void *out, size_t size)
{
    maker *m = owner;
    check_true(m->n < (int)(sizeof m->made / sizeof *m->made));
    TRY(memory_new(m->ctx, &m->made[m->n], 1, size));
    memcpy(out, &m->made[m->n++], sizeof(void *));
    return FLOE_OK;
}

static inline void free_made(maker *m)
{
    while (m->n > 0) memory_free(m->ctx, &m->made[--m->n]);
}

static inline void maker_begin(maker *m)
{
    memset(m, 0, sizeof *m);
    m->ctx = context_create();
    check_true(m->ctx != NULL);
}

/* Nothing may be left. */
static inline void maker_end(maker *m)
{
    free_made(m);
    assert_int_equal(memory_read_account(m->ctx).live_bytes, 0);
    context_destroy(&m->ctx);
}

#endif
