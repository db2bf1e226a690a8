/* The one header that knows compilers. Everything here has a plain C11 fallback. */
#ifndef BASE_COMPILER_H
#define BASE_COMPILER_H

#if defined(__GNUC__)
#define FLOE_ALWAYS_INLINE static inline __attribute__((always_inline))
#define FLOE_PRINTF(format_index, first) __attribute__((format(printf, format_index, first)))
#define FLOE_UNUSED __attribute__((unused))
#define FLOE_LIKELY(condition) __builtin_expect(!!(condition), 1)
#define FLOE_UNLIKELY(condition) __builtin_expect(!!(condition), 0)
#else
#define FLOE_ALWAYS_INLINE static inline
#define FLOE_PRINTF(format_index, first)
#define FLOE_UNUSED
#define FLOE_LIKELY(condition) (condition)
#define FLOE_UNLIKELY(condition) (condition)
#endif

#endif
