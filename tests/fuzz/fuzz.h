/* What a fuzzer is here: libFuzzer's function, whose main is libFuzzer's own (preset fuzz) or that of replay.c, which runs the corpus and
 * some thousand random changes of it in any build. */
#ifndef TESTS_FUZZ_FUZZ_H
#define TESTS_FUZZ_FUZZ_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

/* One input. What must not be ends the process. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Ends the process, and with it the fuzzing, if the condition does not hold. */
static inline void fuzz_require(int condition, const char *what)
{
    if (condition) return;
    (void)fprintf(stderr, "fuzz: %s\n", what);
    abort();
}

#endif
