#include "deck/deck_errors.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Characters of a source line that are shown: with the number of the line and "..." on both sides 80 columns. */
enum { LINE_SHOWN = 65 };

struct deck_error {
    deck_error *next;
    deck_location at;
    const char *message, *expected, *hint;
};

static bool place_is_before(deck_location a, deck_location b)
{
    if (a.source != b.source) return a.source < b.source;
    if (a.line != b.line) return a.line < b.line;
    return a.column < b.column;
}

static floe_status keep_text(error_list *list, const char **out, const char *text)
{
    if (!text) text = "";
    return arena_text(list->arena, out, text, strlen(text));
}

floe_status error_add(error_list *list, deck_location at, const char *expected, const char *hint, const char *format,
                      ...)
{
    char message[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);

    deck_error *error;
    TRY(arena_new(list->arena, &error, sizeof *error));
    error->at = at;
    TRY(keep_text(list, &error->message, message));
    TRY(keep_text(list, &error->expected, expected));
    TRY(keep_text(list, &error->hint, hint));
    deck_error **link = &list->first;
    while (*link && !place_is_before(at, (*link)->at)) link = &(*link)->next;
    error->next = *link;
    *link = error;
    list->count++;
    return FLOE_OK;
}

const char *error_first(const error_list *list)
{
    return list->first ? list->first->message : NULL;
}

/* The start of a line of the source and its length; length 0 beyond the end. */
static const char *find_line(const char *text, int line, size_t *length)
{
    for (int i = 1; i < line && text; i++) {
        text = strchr(text, '\n');
        if (text) text++;
    }
    *length = text ? strcspn(text, "\r\n") : 0;
    return text;
}

static bool continues_character(char byte)
{
    return ((unsigned char)byte & 0xC0) == 0x80; /* UTF-8 */
}

/* Byte offset of a column (from 1, in characters), at most `length`. */
static size_t offset_of_column(const char *line, size_t length, int column)
{
    size_t i = 0;
    for (int at = 1; at < column && i < length; at++) {
        i++;
        while (i < length && continues_character(line[i])) i++;
    }
    return i;
}

/* Control characters would move a terminal's cursor: they are shown as spaces. */
static void print_clean(strbuf *out, const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        const bool control = (unsigned char)text[i] < 0x20 || text[i] == 0x7F;
        strbuf_append_bytes(out, control ? " " : &text[i], 1);
    }
}

/* The line and a caret under the column; of a long line the part about the caret. */
static void print_excerpt(strbuf *out, const char *text, deck_location at)
{
    size_t length;
    const char *line = find_line(text, at.line, &length);
    if (!line) return;
    const size_t caret = offset_of_column(line, length, at.column);
    size_t from = caret > LINE_SHOWN * 3 / 4 ? caret - LINE_SHOWN * 3 / 4 : 0;
    while (from > 0 && continues_character(line[from])) from--;
    size_t to = length - from > LINE_SHOWN ? from + LINE_SHOWN : length;
    while (to < length && continues_character(line[to])) to++;

    strbuf_append(out, "%6d | %s", at.line, from > 0 ? "..." : "");
    print_clean(out, line + from, to - from);
    strbuf_append(out, "%s\n       | %s", to < length ? "..." : "", from > 0 ? "   " : "");
    for (size_t i = from; i < caret; i++) {
        if (!continues_character(line[i])) strbuf_append_bytes(out, " ", 1);
    }
    strbuf_append(out, "^\n");
}

static void print_error(const error_list *list, const deck_error *error, strbuf *out)
{
    if (error->at.source > 0 && list->set) {
        strbuf_append(out, "--set %s: error: %s\n", list->set->text[error->at.source - 1], error->message);
    } else {
        strbuf_append(out, "%s:%d:%d: error: %s\n", list->path, error->at.line, error->at.column, error->message);
        print_excerpt(out, list->text, error->at);
    }
    if (error->expected[0]) strbuf_append(out, "         expected: %s\n", error->expected);
    if (error->hint[0]) strbuf_append(out, "         hint: %s\n", error->hint);
}

void errors_print(const error_list *list, strbuf *out)
{
    size_t shown = 0;
    for (const deck_error *error = list->first; error && shown < ERRORS_SHOWN; error = error->next, shown++) {
        print_error(list, error, out);
    }
    if (shown < list->count) strbuf_append(out, "%s: and %zu more errors\n", list->path, list->count - shown);
}
