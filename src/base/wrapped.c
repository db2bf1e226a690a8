#include "base/wrapped.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { FURTHER_IN = 4, WIDTH_LEAST = 40 };

/* Columns that `length` bytes take: without those that continue a character of UTF-8, and without escapes of colour. */
static int count_columns(const char *text, size_t length)
{
    int columns = 0;
    for (size_t i = 0; i < length; i++) {
        if (text[i] == '\033') {
            while (i < length && text[i] != 'm') i++;
        } else if (((unsigned char)text[i] & 0xC0) != 0x80) {
            columns++;
        }
    }
    return columns;
}

/* Bytes of a word, with the "%" that belongs to a number before it. */
static size_t word_length(const char *text)
{
    const size_t length = strcspn(text, " \n");
    return strncmp(text + length, " %", 2) == 0 ? length + 1 + strcspn(text + length + 1, " \n") : length;
}

static void print_wrapped_line(FILE *file, const char *line, size_t length, int width)
{
    const size_t blanks = strspn(line, " ");
    const int indent = (int)blanks + FURTHER_IN;
    size_t at = blanks < length ? blanks : length;
    int column = (int)at;
    (void)fprintf(file, "%.*s", (int)at, line);
    while (at < length) {
        const size_t gap = strspn(line + at, " ");
        const size_t word = word_length(line + at + gap);
        const int columns = count_columns(line + at + gap, word);
        const bool fits = column + (int)gap + columns <= width || at == blanks;
        if (fits)
            (void)fprintf(file, "%.*s", (int)(gap + word), line + at);
        else
            (void)fprintf(file, "\n%*s%.*s", indent, "", (int)word, line + at + gap);
        column = (fits ? column + (int)gap : indent) + columns;
        at += gap + word;
    }
}

void wrapped_print(FILE *file, const char *text, int width)
{
    while (*text != '\0') {
        const size_t length = strcspn(text, "\n");
        if (width == 0 || count_columns(text, length) <= width)
            (void)fprintf(file, "%.*s", (int)length, text);
        else
            print_wrapped_line(file, text, length, width);
        text += length;
        if (*text == '\n') {
            (void)fputc('\n', file);
            text++;
        }
    }
}

int wrapped_width(FILE *file)
{
    struct winsize window;
    if (!isatty(fileno(file))) return 0;
    if (ioctl(fileno(file), TIOCGWINSZ, &window) != 0 || window.ws_col < WIDTH_LEAST) return WRAPPED_WIDTH;
    return window.ws_col < WRAPPED_WIDTH ? window.ws_col : WRAPPED_WIDTH;
}

void wrapped_printf(FILE *file, const char *format, ...)
{
    va_list arguments;
    const int width = wrapped_width(file);
    va_start(arguments, format);
    const int length = width > 0 ? vsnprintf(NULL, 0, format, arguments) : -1;
    va_end(arguments);
    char *text = length >= 0 ? malloc((size_t)length + 1) : NULL;
    va_start(arguments, format);
    if (text)
        (void)vsnprintf(text, (size_t)length + 1, format, arguments);
    else
        (void)vfprintf(file, format, arguments); /* no terminal, or no memory for what one needs */
    va_end(arguments);
    if (text) wrapped_print(file, text, width);
    free(text);
}
