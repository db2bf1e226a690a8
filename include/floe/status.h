/* Status codes of every fallible floe function, in one list (docs/structure.md, A step). */
#ifndef FLOE_STATUS_H
#define FLOE_STATUS_H

/* X(name, exit status of the command line, text)
 * RETRY is the one recoverable code: the step is rolled back and tried again with a smaller step. */
#define FLOE_STATUS_LIST(X)                                                 \
    X(FLOE_OK, 0, "done")                                                   \
    X(FLOE_RETRY, 3, "the step was rejected; a smaller one may succeed")    \
    X(FLOE_BAD_INPUT, 2, "bad usage or deck")                               \
    X(FLOE_DIVERGED, 3, "diverged: the step could not be saved by retries") \
    X(FLOE_IO, 4, "input or output failed")                                 \
    X(FLOE_NO_MEMORY, 4, "out of memory")                                   \
    X(FLOE_INTERRUPTED, 5, "interrupted; a checkpoint was written")         \
    X(FLOE_MISSED_BAR, 6, "a required order or error was not reached")      \
    X(FLOE_INTERNAL, 4, "a floe invariant does not hold: please report it")

typedef enum floe_status {
#define FLOE_STATUS_ENUM(name, exit_status, text) name,
    FLOE_STATUS_LIST(FLOE_STATUS_ENUM)
#undef FLOE_STATUS_ENUM
        FLOE_STATUS_COUNT
} floe_status;

#endif
