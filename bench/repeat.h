/* A case measured several times over: what else the machine does only makes it slower, so that the best tells the most,
 * and how far the median is from it how quiet the machine was. */
#ifndef BENCH_REPEAT_H
#define BENCH_REPEAT_H

#include <stdio.h>
#include <stdlib.h>

enum { BENCH_REPEATS = 7 };

static inline int bench_compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Prints the best of BENCH_REPEATS rates, millions a second, and their median; sorts them. */
static inline void bench_print(double *rate, const char *unit)
{
    qsort(rate, BENCH_REPEATS, sizeof *rate, bench_compare);
    printf("%8.2f M%s/s, best of %d (median %.2f)", rate[BENCH_REPEATS - 1], unit, BENCH_REPEATS,
           rate[BENCH_REPEATS / 2]);
}

#endif
