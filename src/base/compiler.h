/* The only header with compiler-specific code. Everything here has a plain C11 fallback, which FLOE_PLAIN_C selects. */
#ifndef BASE_COMPILER_H
#define BASE_COMPILER_H

#include <stdbool.h>

#if defined(__GNUC__) && !defined(FLOE_PLAIN_C)
#define FLOE_ALWAYS_INLINE static inline __attribute__((always_inline))
#define FLOE_PRINTF(format_index, first) __attribute__((format(printf, format_index, first)))
#define FLOE_UNUSED __attribute__((unused))
#define FLOE_LIKELY(condition) __builtin_expect(!!(condition), 1)
#define FLOE_UNLIKELY(condition) __builtin_expect(!!(condition), 0)

/* Two doubles side by side; each lane is an ordinary double operation, so that results do not depend on the width of the
 * machine's registers. */
typedef double floe_pair __attribute__((vector_size(16)));
FLOE_ALWAYS_INLINE floe_pair floe_pair_of(double a, double b)
{
    return (floe_pair){a, b};
}
/* a + b, and s a. */
FLOE_ALWAYS_INLINE floe_pair floe_pair_sum(floe_pair a, floe_pair b)
{
    return a + b;
}
FLOE_ALWAYS_INLINE floe_pair floe_pair_times(double s, floe_pair a)
{
    return s * a;
}
FLOE_ALWAYS_INLINE double floe_pair_lane(floe_pair a, int lane)
{
    return a[lane];
}
#else
#define FLOE_ALWAYS_INLINE static inline
#define FLOE_PRINTF(format_index, first)
#define FLOE_UNUSED
#define FLOE_LIKELY(condition) (condition)
#define FLOE_UNLIKELY(condition) (condition)

typedef struct floe_pair {
    double lane[2];
} floe_pair;
FLOE_ALWAYS_INLINE floe_pair floe_pair_of(double a, double b)
{
    return (floe_pair){{a, b}};
}
FLOE_ALWAYS_INLINE floe_pair floe_pair_sum(floe_pair a, floe_pair b)
{
    return (floe_pair){{a.lane[0] + b.lane[0], a.lane[1] + b.lane[1]}};
}
FLOE_ALWAYS_INLINE floe_pair floe_pair_times(double s, floe_pair a)
{
    return (floe_pair){{s * a.lane[0], s * a.lane[1]}};
}
FLOE_ALWAYS_INLINE double floe_pair_lane(floe_pair a, int lane)
{
    return a.lane[lane];
}
#endif

/* Of a function: compiled for several generations of processors, one of which is chosen when floe is loaded. What it calls must be inlined
 * to be so too. Lanes are ordinary double operations, nothing is contracted or reordered: the bits are the same in each. The build
 * (FloeFlags.cmake) says whether compiler, linker and loader can. */
#if defined(FLOE_CLONES) && defined(__GNUC__) && !defined(__clang__) && !defined(FLOE_PLAIN_C)
#define FLOE_WIDE __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define FLOE_WIDE
#endif

/* Four: a register where the source is compiled for such ones, or two pairs. */
#if defined(__AVX__) && !defined(FLOE_PLAIN_C)
typedef double floe_quad __attribute__((vector_size(32)));
FLOE_ALWAYS_INLINE floe_quad floe_quad_of(double a, double b, double c, double d)
{
    return (floe_quad){a, b, c, d};
}
FLOE_ALWAYS_INLINE floe_quad floe_quad_sum(floe_quad a, floe_quad b)
{
    return a + b;
}
FLOE_ALWAYS_INLINE floe_quad floe_quad_times(double s, floe_quad a)
{
    return s * a;
}
FLOE_ALWAYS_INLINE double floe_quad_lane(floe_quad a, int lane)
{
    return a[lane];
}
#else
typedef struct floe_quad {
    floe_pair half[2];
} floe_quad;
FLOE_ALWAYS_INLINE floe_quad floe_quad_of(double a, double b, double c, double d)
{
    return (floe_quad){{floe_pair_of(a, b), floe_pair_of(c, d)}};
}
FLOE_ALWAYS_INLINE floe_quad floe_quad_sum(floe_quad a, floe_quad b)
{
    return (floe_quad){{floe_pair_sum(a.half[0], b.half[0]), floe_pair_sum(a.half[1], b.half[1])}};
}
FLOE_ALWAYS_INLINE floe_quad floe_quad_times(double s, floe_quad a)
{
    return (floe_quad){{floe_pair_times(s, a.half[0]), floe_pair_times(s, a.half[1])}};
}
FLOE_ALWAYS_INLINE double floe_quad_lane(floe_quad a, int lane)
{
    return floe_pair_lane(a.half[lane / 2], lane % 2);
}
#endif

/* Whether this machine can run what was compiled for registers of four doubles (FloeFlags.cmake says which sources are). */
FLOE_ALWAYS_INLINE bool floe_has_quads(void)
{
#if defined(FLOE_QUADS) && defined(__GNUC__) && !defined(FLOE_PLAIN_C)
    return __builtin_cpu_supports("avx2") != 0;
#else
    return false;
#endif
}

/* Whether stages are checked and leaks reported: the debug preset (FLOE_DEBUG). */
#if defined(FLOE_DEBUG)
enum { FLOE_CHECKS = 1 };
#else
enum { FLOE_CHECKS = 0 };
#endif

#endif
