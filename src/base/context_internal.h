/* The inside of a context. Only src/base includes this. */
#ifndef BASE_CONTEXT_INTERNAL_H
#define BASE_CONTEXT_INTERNAL_H

#include "base/context.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdint.h>

struct context {
    /* Message: written under message_lock; `failed` says that one is held. Of a refusal: "KEY: CAUSE". */
    pthread_mutex_t message_lock;
    bool failed;
    char message[CONTEXT_MESSAGE_SIZE];
    char key[CONTEXT_KEY_SIZE];
    size_t cause; /* where in the message it begins */

    /* Log: the sink is called under its own lock, so that a sink may itself report a failure. */
    pthread_mutex_t log_lock;
    log_sink *sink;
    void *sink_user;
    log_level most_detail;

    const volatile sig_atomic_t *stop; /* asks work to end; not owned; NULL: nobody does */

    /* Memory account. `attempts` counts failed allocations too; fail_from is the attempt that fails first, 0: none. */
    atomic_uint_fast64_t attempts;
    atomic_uint_fast64_t allocations;
    atomic_uint_fast64_t live_bytes;
    atomic_uint_fast64_t peak_bytes;
    atomic_uint_fast64_t fail_from;
};

#endif
