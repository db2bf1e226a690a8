#include "report/html.h"

#include "run/run_errors.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

void html_text(strbuf *out, const char *format, ...)
{
    char text[4096];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    strbuf_append_xml(out, text);
}

void html_number(strbuf *out, double value, int digits)
{
    char text[64];
    if (isnan(value)) {
        strbuf_append(out, "–");
        return;
    }
    if (isinf(value)) {
        strbuf_append(out, value > 0.0 ? "∞" : "−∞");
        return;
    }
    (void)snprintf(text, sizeof text, "%.*g", digits, value);
    char *power = strchr(text, 'e');
    const int exponent = power ? (int)strtol(power + 1, NULL, 10) : 0;
    if (power) *power = '\0';
    strbuf_append(out, "%s%s", text[0] == '-' ? "−" : "", text + (text[0] == '-'));
    if (power) strbuf_append(out, "×10<sup>%s%d</sup>", exponent < 0 ? "−" : "", exponent < 0 ? -exponent : exponent);
}

void html_count(strbuf *out, double value)
{
    char text[64];
    if (!isfinite(value) || fabs(value) >= 1e15) {
        html_number(out, value, 4);
        return;
    }
    const int length = snprintf(text, sizeof text, "%.0f", fabs(value));
    if (value < 0.0) strbuf_append(out, "−");
    for (int i = 0; i < length; i++) {
        /* A narrow space that does not break. */
        strbuf_append(out, "%s%c", i > 0 && (length - i) % 3 == 0 ? "\u202f" : "", text[i]);
    }
}

void html_seconds(strbuf *out, double seconds)
{
    const long whole = isfinite(seconds) ? (long)(seconds + 0.5) : 0;
    if (!isfinite(seconds)) {
        strbuf_append(out, "–");
    } else if (seconds < 100.0) {
        html_number(out, seconds, 3);
        strbuf_append(out, " s");
    } else if (whole < 3600) {
        strbuf_append(out, "%ld min %02ld s", whole / 60, whole % 60);
    } else {
        strbuf_append(out, "%ld h %02ld min", whole / 3600, whole % 3600 / 60);
    }
}

void html_bytes(strbuf *out, double bytes)
{
    static const char *const unit[] = {"B", "kB", "MB", "GB", "TB"};
    size_t k = 0;
    while (k + 1 < sizeof unit / sizeof unit[0] && bytes >= 1000.0) {
        bytes /= 1000.0;
        k++;
    }
    strbuf_append(out, "%.3g %s", bytes, unit[k]);
}

void html_error(strbuf *out, const char *metric, double error, bool dimensionless)
{
    const char *unit = error_unit(metric, dimensionless);
    html_number(out, error * (error_is_relative(metric) ? 100.0 : 1.0), 4);
    if (unit[0] && isfinite(error)) html_text(out, " %s", unit);
}

/* What becomes of a run, and whether that is good. */
void html_status(strbuf *out, const char *status)
{
    static const char *const good[] = {"done", "at_rest", "passed", "stable", "met", "found"};
    static const char *const bad[] = {"diverged",  "failed",         "missed",       "unstable",
                                      "timed_out", "rejected steps", "energy grows", "not finite"};
    const char *kind = "neutral";
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        if (strcmp(status, good[i]) == 0) kind = "good";
    }
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        if (strcmp(status, bad[i]) == 0) kind = "bad";
    }
    strbuf_append(out, "<span class=\"status %s\">", kind);
    for (; *status; status++) html_text(out, "%c", *status == '_' ? ' ' : *status);
    strbuf_append(out, "</span>");
}

void html_facts_begin(strbuf *out)
{
    strbuf_append(out, "<dl class=\"facts\">\n");
}

void html_fact(strbuf *out, const char *name)
{
    strbuf_append(out, "<div><dt>");
    html_text(out, "%s", name);
    strbuf_append(out, "</dt><dd>");
}

void html_fact_end(strbuf *out)
{
    strbuf_append(out, "</dd></div>\n");
}

void html_fact_text(strbuf *out, const char *name, const char *text)
{
    if (!text[0]) return;
    strbuf_append(out, strlen(text) > 24 ? "<div class=\"wide\"><dt>" : "<div><dt>");
    strbuf_append_xml(out, name);
    strbuf_append(out, "</dt><dd>");
    strbuf_append_xml(out, text);
    html_fact_end(out);
}

void html_facts_end(strbuf *out)
{
    strbuf_append(out, "</dl>\n");
}

void html_table_begin(strbuf *out, const char *names)
{
    strbuf_append(out, "<div class=\"scroll\"><table>\n<thead><tr>");
    while (*names) {
        const size_t length = strcspn(names, "|");
        const bool number = *names == '#';
        strbuf_append(out, "<th%s>", number ? " class=\"number\"" : "");
        html_text(out, "%.*s", (int)length - number, names + number);
        strbuf_append(out, "</th>");
        names += length + (names[length] == '|');
    }
    strbuf_append(out, "</tr></thead>\n<tbody>\n");
}

void html_table_end(strbuf *out)
{
    strbuf_append(out, "</tbody></table></div>\n");
}

void html_row_begin(strbuf *out)
{
    strbuf_append(out, "<tr>");
}

void html_row_end(strbuf *out)
{
    strbuf_append(out, "</tr>\n");
}

void html_cell(strbuf *out, const char *text)
{
    strbuf_append(out, "<td>");
    strbuf_append_xml(out, text);
    strbuf_append(out, "</td>");
}

void html_number_cell(strbuf *out)
{
    strbuf_append(out, "<td class=\"number\">");
}

void html_cell_end(strbuf *out)
{
    strbuf_append(out, "</td>");
}

void html_cell_number(strbuf *out, double value, int digits)
{
    html_number_cell(out);
    html_number(out, value, digits);
    html_cell_end(out);
}

void html_cell_count(strbuf *out, double value)
{
    html_number_cell(out);
    html_count(out, value);
    html_cell_end(out);
}

void html_cell_error(strbuf *out, const char *metric, double error, bool dimensionless)
{
    html_number_cell(out);
    html_error(out, metric, error, dimensionless);
    html_cell_end(out);
}

void html_cell_status(strbuf *out, const char *status)
{
    strbuf_append(out, "<td>");
    html_status(out, status);
    html_cell_end(out);
}

void html_download(strbuf *out, const char *words, const char *name, const char *type, const char *data, size_t size)
{
    strbuf_append(out, "<a download=\"");
    strbuf_append_xml(out, name);
    strbuf_append(out, "\" href=\"data:%s;base64,", type);
    strbuf_append_base64(out, data, size);
    strbuf_append(out, "\">");
    strbuf_append_xml(out, words);
    strbuf_append(out, "</a>");
}

void html_fold_begin(strbuf *out, const char *title)
{
    strbuf_append(out, "<details><summary>");
    strbuf_append_xml(out, title);
    strbuf_append(out, "</summary>\n");
}

void html_fold_end(strbuf *out)
{
    strbuf_append(out, "</details>\n");
}

/* Line breaks are kept, which html_text would take for control characters. */
void html_verbatim(strbuf *out, const char *text)
{
    strbuf_append(out, "<pre class=\"scroll\">");
    while (*text) {
        const size_t line = strcspn(text, "\n");
        char piece[512];
        const int length = line < sizeof piece - 1 ? (int)line : (int)sizeof piece - 1;
        (void)snprintf(piece, sizeof piece, "%.*s", length, text);
        strbuf_append_xml(out, piece);
        text += length;
        if (*text == '\n') {
            strbuf_append(out, "\n");
            text++;
        }
    }
    strbuf_append(out, "</pre>\n");
}
