#include "geom/stl_text.h"

#include "base/memory.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HEAD = 80, COUNT = 4, RECORD = 50, NORMAL = 12 /* bytes of the binary format */, WORD = 32, MOST = 100000000 };

/* ---- binary ---- */

static uint32_t whole_at(const unsigned char *b)
{
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static double number_at(const unsigned char *b)
{
    const uint32_t bits = whole_at(b);
    float x;
    memcpy(&x, &bits, sizeof x);
    return (double)x;
}

static floe_status read_records(double (**corner)[3], int n, context *ctx, const unsigned char *record, char *why)
{
    TRY(memory_new(ctx, corner, 3 * (size_t)n, sizeof **corner));
    for (int i = 0; i < 9 * n; i++) {
        const double x = number_at(record + (size_t)(i / 9) * RECORD + NORMAL + (size_t)(i % 9) * sizeof(float));
        if (!isfinite(x)) (void)snprintf(why, SHAPE_WHY, "triangle %d has a corner that is no number", i / 9 + 1);
        (*corner)[i / 3][i % 3] = x;
    }
    return FLOE_OK;
}

/* ---- words ---- */

typedef struct word_reader {
    const char *at;
    long line;
    char word[WORD]; /* as much as fits */
} word_reader;

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
}

static bool next_word(word_reader *r)
{
    size_t n = 0;
    for (; is_blank(*r->at); r->at++) r->line += *r->at == '\n';
    for (; *r->at && !is_blank(*r->at); r->at++)
        if (n + 1 < WORD) r->word[n++] = *r->at;
    r->word[n] = '\0';
    return n > 0;
}

/* The words that must come next, which a text separates by blanks. */
static bool expect_words(word_reader *r, const char *words, char *why)
{
    while (*words) {
        const size_t n = strcspn(words, " ");
        const bool found = next_word(r);
        if (!found || strlen(r->word) != n || strncmp(r->word, words, n) != 0) {
            (void)snprintf(why, SHAPE_WHY, "line %ld: '%s' where '%.*s' should be", r->line,
                           found ? r->word : "the end", (int)n, words);
            return false;
        }
        words += n + (words[n] == ' ');
    }
    return true;
}

static bool expect_numbers(word_reader *r, double *x, char *why)
{
    for (int k = 0; k < 3; k++) {
        char *end = r->word;
        if (next_word(r)) x[k] = strtod(r->word, &end);
        if (end != r->word && *end == '\0' && isfinite(x[k])) continue;
        (void)snprintf(why, SHAPE_WHY, "line %ld: '%s' is no number", r->line, r->word);
        return false;
    }
    return true;
}

/* The normal of a facet is not asked: it follows from the order of its corners. */
static void skip_normal(word_reader *r)
{
    (void)next_word(r);
    for (int k = 0; k < 3; k++) (void)next_word(r);
}

static void read_facet(word_reader *r, double (*corner)[3], char *why)
{
    skip_normal(r);
    if (!expect_words(r, "outer loop", why)) return;
    for (int k = 0; k < 3; k++)
        if (!expect_words(r, "vertex", why) || !expect_numbers(r, corner[k], why)) return;
    (void)expect_words(r, "endloop endfacet", why);
}

static void skip_line(word_reader *r)
{
    while (*r->at && *r->at != '\n') r->at++;
}

static int count_facets(const char *text)
{
    int n = 0;
    for (const char *at = strstr(text, "endfacet"); at && n < MOST; at = strstr(at + 1, "endfacet")) n++;
    return n;
}

static floe_status read_words(double (**corner)[3], int *n, context *ctx, const char *text, char why[SHAPE_WHY])
{
    const int most = count_facets(text);
    word_reader r = {.at = text, .line = 1};
    TRY(memory_new(ctx, corner, 3 * (size_t)most + 3, sizeof **corner));
    *n = 0;
    while (!why[0] && next_word(&r)) {
        if (strcmp(r.word, "facet") == 0) {
            read_facet(&r, *corner + (ptrdiff_t)3 * *n, why);
            if (!why[0]) (*n)++;
        } else if (strcmp(r.word, "solid") == 0 || strcmp(r.word, "endsolid") == 0) {
            skip_line(&r); /* its name */
        } else {
            (void)snprintf(why, SHAPE_WHY, "line %ld: '%s' where 'facet' should be", r.line, r.word);
        }
    }
    return FLOE_OK;
}

/* ---- either ---- */

floe_status stl_read(double (**corner)[3], int *n, context *ctx, const void *bytes, size_t size, char why[SHAPE_WHY])
{
    const unsigned char *b = bytes;
    const size_t stated = size >= HEAD + COUNT ? whole_at(b + HEAD) : 0;
    why[0] = '\0';
    *corner = NULL;
    if (size >= HEAD + COUNT && stated <= MOST && size == HEAD + COUNT + stated * RECORD) {
        *n = (int)stated;
        return read_records(corner, *n, ctx, b + HEAD + COUNT, why);
    }
    if (size >= 5 && memcmp(b, "solid", 5) == 0 && !memchr(b, '\0', size))
        return read_words(corner, n, ctx, bytes, why);
    (void)snprintf(
        why, SHAPE_WHY,
        "it is no STL: neither does it begin with 'solid', nor has it the %d bytes and %d a triangle of the binary "
        "format",
        HEAD + COUNT, RECORD);
    return FLOE_OK;
}
