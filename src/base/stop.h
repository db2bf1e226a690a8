/* The signals by which terminals, batch systems and `kill` ask a program to end. */
#ifndef BASE_STOP_H
#define BASE_STOP_H

#include <stdbool.h>
#include <stddef.h>

typedef struct stop_request {
    int number;
    const char *name, *meaning; /* "SIGHUP", "the terminal has gone" */
} stop_request;

/* The i-th of them; NULL after the last. */
const stop_request *stop_request_at(size_t i);
/* " by SIGHUP (the terminal has gone)"; "" for 0 and what is none of them. */
void stop_request_text(int number, char text[64]);
bool stop_request_is(int number);

#endif
