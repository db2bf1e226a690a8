/* gnuplot's SVG made fit for pages: several may stand in one page, and each follows its light or dark colours. */
#include "base/memory.h"
#include "draw/plot_internal.h"
#include "io/file.h"

#include <stdlib.h>
#include <string.h>

/* Okabe and Ito's colours, the yellow one replaced by what shows on white; second: lighter ones of the same hue, for
 * dark pages. */
static const char *const palette[PLOT_COLOURS][2] = {
    {"#0072b2", "#4aa8e0"}, {"#d55e00", "#ff8a3d"}, {"#009e73", "#2fc79b"}, {"#aa3f8c", "#e08cc8"},
    {"#c08400", "#f0b429"}, {"#3fa0d8", "#8cd0f5"}, {"#6b6b6b", "#b0b0b0"}, {"#7a4fbf", "#b394f0"},
};

const char *plot_colour(int index, bool dark)
{
    return palette[(index < 0 ? 0 : index) % PLOT_COLOURS][dark];
}

/* gnuplot writes a colour in three ways: padded and plain triples, and hexadecimal for the paper. */
static void append_dark(strbuf *out, const char *light, const char *dark)
{
    const unsigned long rgb = strtoul(light + 1, NULL, 16);
    const unsigned red = (unsigned)(rgb >> 16) & 0xFFu, green = (unsigned)(rgb >> 8) & 0xFFu,
                   blue = (unsigned)rgb & 0xFFu;
    static const char *const property[] = {"stroke", "fill", "color"};
    for (size_t i = 0; i < sizeof property / sizeof property[0]; i++) {
        strbuf_append(out, ".floe-plot [%s=\"rgb(%3u, %3u, %3u)\"], .floe-plot [%s=\"rgb(%u,%u,%u)\"] { %s: %s }\n",
                      property[i], red, green, blue, property[i], red, green, blue, property[i], dark);
    }
}

void plot_append_style(strbuf *out)
{
    strbuf_append(out, "<style>\n@media (prefers-color-scheme: dark) {\n");
    strbuf_append(out, ".floe-plot [fill=\"" PLOT_PAPER "\"] { fill: #0d1117 }\n");
    append_dark(out, PLOT_INK, "#e6edf3");
    append_dark(out, PLOT_GRID, "#30363d");
    for (int i = 0; i < PLOT_COLOURS; i++) append_dark(out, plot_colour(i, false), plot_colour(i, true));
    strbuf_append(out, "}\n</style>\n");
}

/* Steps over ` id='...'`; marks keep theirs, with the figure's name before it, all others go, as nothing refers to
 * them. */
static const char *pass_id(strbuf *out, const char *at, const char *stem)
{
    const char *value = at + 5, quote = at[4];
    const char *end = strchr(value, quote);
    if (!end) return at + 1;
    if (strncmp(value, "gp", 2) == 0)
        strbuf_append(out, " id=%c%s-%.*s%c", quote, stem, (int)(end - value), value, quote);
    return end + 1;
}

/* A mark as gnuplot writes it. */
typedef struct mark {
    char shape[16], colour[32];
    double x, y, scale; /* px, px, 1 */
} mark;

/* Reads the mark that begins here; returns what follows its line, or NULL if there is none. */
static const char *read_mark(const char *at, mark *m)
{
    int length = 0;
    const int fields =
        sscanf(at, "<use xlink:href='#gp%15[A-Za-z0-9]' transform='translate(%lf,%lf) scale(%lf)' color='%31[^']'/>%n",
               m->shape, &m->x, &m->y, &m->scale, m->colour, &length);
    if (fields != 5 || length == 0 || !(m->scale > 0.0)) return NULL;
    at += length;
    return at + strspn(at, "\n\t ");
}

static bool is_like(const mark *a, const mark *b)
{
    return strcmp(a->shape, b->shape) == 0 && strcmp(a->colour, b->colour) == 0 && a->scale == b->scale;
}

/* Marks of one kind, which gnuplot writes at length each, as one group; NULL where no mark begins. */
static const char *group_marks(strbuf *out, const char *at, const char *stem)
{
    mark first, next;
    if (!read_mark(at, &first)) return NULL;
    strbuf_append(out, "<g color='%s' transform='scale(%g)'>\n", first.colour, first.scale);
    for (const char *behind = read_mark(at, &next); behind && is_like(&first, &next); behind = read_mark(at, &next)) {
        strbuf_append(out, "<use xlink:href='#%s-gp%s' x='%.5g' y='%.5g'/>\n", stem, next.shape, next.x / next.scale,
                      next.y / next.scale);
        at = behind;
    }
    strbuf_append(out, "</g>\n");
    return at;
}

/* Steps over what draws nothing: SVG's own defaults, and a group without content; NULL if neither begins here. */
static const char *pass_idle(const char *at)
{
    static const char begin[] = "<g ", end[] = ">\n</g>\n";
    static const char defaults[] = " stroke-linecap=\"butt\" stroke-linejoin=\"miter\"";
    if (strncmp(at, defaults, strlen(defaults)) == 0) return at + strlen(defaults);
    if (strncmp(at, begin, strlen(begin)) != 0) return NULL;
    at += strcspn(at, ">");
    return strncmp(at, end, strlen(end)) == 0 ? at + strlen(end) : NULL;
}

/* The text as gnuplot left it, from its <svg> on, with names and style put in. */
static void rewrite_svg(strbuf *out, const char *at, const char *stem, const char *title)
{
    static const char head[] = "<svg", reference[] = "'#gp", canvas[] = "<defs>", name[] = "<title>";
    bool named = false;
    while (*at) {
        const size_t plain = strcspn(at + 1, " <'") + 1;
        const char *behind = pass_idle(at);
        if (!behind) behind = group_marks(out, at, stem);
        if (behind) {
            at = behind;
        } else if (strncmp(at, " id='", 5) == 0 || strncmp(at, " id=\"", 5) == 0) {
            at = pass_id(out, at, stem);
        } else if (strncmp(at, reference, strlen(reference)) == 0) {
            strbuf_append(out, "'#%s-gp", stem);
            at += strlen(reference);
        } else if (strncmp(at, head, strlen(head)) == 0) {
            strbuf_append(out, "<svg class=\"floe-plot\" role=\"img\"");
            at += strlen(head);
        } else if (strncmp(at, canvas, strlen(canvas)) == 0) {
            plot_append_style(out);
            strbuf_append(out, "%s", canvas);
            at += strlen(canvas);
        } else if (!named && strncmp(at, name, strlen(name)) == 0 && strstr(at, "</title>")) {
            strbuf_append(out, "%s", name);
            strbuf_append_xml(out, title);
            at = strstr(at, "</title>");
            named = true;
        } else {
            strbuf_append(out, "%.*s", (int)plain, at);
            at += plain;
        }
    }
}

/* gnuplot closes the picture last: without that it has failed on the way. */
static bool is_whole(const char *text)
{
    return strstr(text, "</svg>") != NULL;
}

static floe_status finish_svg(context *ctx, const char *path, const char *stem, const char *title)
{
    char *text;
    strbuf out;
    if (!file_exists(path)) return FLOE_OK;
    TRY(file_read(ctx, path, &text, NULL));
    strbuf_init(&out, ctx);
    if (is_whole(text)) rewrite_svg(&out, text, stem, title && title[0] ? title : stem);
    floe_status status = out.status;
    if (status == FLOE_OK)
        status = out.length > 0 ? file_replace_text(ctx, path, strbuf_string(&out)) : file_remove(ctx, path);
    strbuf_free(&out);
    memory_free(ctx, &text);
    return status;
}

floe_status plot_finish_svg(context *ctx, const char *dir, const char *stem, const char *title)
{
    strbuf path;
    strbuf_init(&path, ctx);
    strbuf_append(&path, "%s/%s.svg", dir, stem);
    const floe_status status =
        path.status == FLOE_OK ? finish_svg(ctx, strbuf_string(&path), stem, title) : path.status;
    strbuf_free(&path);
    return status;
}
