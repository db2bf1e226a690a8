#include "base/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void text_add(char *text, size_t size, const char *format, ...)
{
    const size_t at = strnlen(text, size);
    va_list arguments;
    if (at == size) return;
    va_start(arguments, format);
    (void)vsnprintf(text + at, size - at, format, arguments);
    va_end(arguments);
}

enum { NAME_LIMIT = 64 };

static size_t smaller_of(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Edits (insert, delete, replace, swap of neighbours) that turn a into b; both at most NAME_LIMIT long. */
static size_t edit_distance(const char *a, const char *b)
{
    const size_t n = strlen(a), m = strlen(b);
    if (n > NAME_LIMIT || m > NAME_LIMIT) return NAME_LIMIT;
    size_t row[3][NAME_LIMIT + 1]; /* rows i-2, i-1, i of the table, by i % 3 */
    for (size_t j = 0; j <= m; j++) row[0][j] = j;
    for (size_t i = 1; i <= n; i++) {
        size_t *now = row[i % 3];
        const size_t *last = row[(i + 2) % 3], *before_last = row[(i + 1) % 3];
        now[0] = i;
        for (size_t j = 1; j <= m; j++) {
            now[j] = smaller_of(smaller_of(last[j] + 1, now[j - 1] + 1), last[j - 1] + (a[i - 1] != b[j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                now[j] = smaller_of(now[j], before_last[j - 2] + 1);
            }
        }
    }
    return row[n % 3][m];
}

static char lower_case(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

/* Whether the names differ in their case alone. */
static bool same_but_for_case(const char *a, const char *b)
{
    while (*a && lower_case(*a) == lower_case(*b)) a++, b++;
    return *a == '\0' && *b == '\0';
}

const char *nearest_name(const char *name, const char *(*candidate)(const void *user, size_t i), const void *user)
{
    const char *best = NULL;
    size_t best_distance = strlen(name) / 3 + 1; /* more edits than that: another word */
    for (size_t i = 0;; i++) {
        const char *other = candidate(user, i);
        if (!other) return best;
        if (same_but_for_case(name, other)) return other;
        const size_t distance = edit_distance(name, other);
        if (distance <= best_distance && (!best || distance < best_distance) && distance < strlen(other)) {
            best = other;
            best_distance = distance;
        }
    }
}
