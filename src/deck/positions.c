/* Lists of places: in the deck, or in a file of comma-separated values beside it. */
#include "base/ordinary.h"
#include "base/sha256.h"
#include "deck/deck_internal.h"
#include "deck/units.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { LINE = 1024, ROWS_MOST = 10000000 };

/* ---- in the deck ---- */

static const key_spec place_key = {.key = "place", .type = KEY_NUMBER, .unit = "m"};

static floe_status read_list(reader *r, deck_node *node, curve_line *c)
{
    TRY(scene_allocate(r->scene, &c->vertex, 3 * node->n * sizeof *c->vertex));
    for (deck_node *item = node->first; item; item = item->next)
        TRY(read_position(r, &place_key, item, c->vertex + 3 * (ptrdiff_t)c->n_vertices++));
    return FLOE_OK;
}

/* ---- in a file ---- */

/* A file that is being read; the column of each axis is counted from 0. */
typedef struct table {
    FILE *file;
    const char *name;
    int column[3], dim;
    long line;
    char text[LINE];
    char fault[WHY_SIZE + 64]; /* what is wrong with it; "" so far */
} table;

/* The next line that says something; false at the end, and where it does not fit. */
static bool next_table_line(table *t)
{
    while (fgets(t->text, sizeof t->text, t->file)) {
        t->line++;
        if (!strchr(t->text, '\n') && !feof(t->file)) {
            snprintf(t->fault, sizeof t->fault, "line %ld has more than %d characters", t->line, LINE - 2);
            return false;
        }
        const size_t blank = strspn(t->text, " \t\r\n");
        if (t->text[blank] != '\0' && t->text[blank] != '#') return true;
    }
    return false;
}

/* Cuts the first cell off a line: without the blanks about it, and of a head without its unit, as in "x (m)". NULL:
 * there is none left. */
static char *next_cell(char **rest, bool head)
{
    char *cell = *rest;
    if (!cell) return NULL;
    char *comma = strchr(cell, ',');
    *rest = comma ? comma + 1 : NULL;
    if (comma) *comma = '\0';
    char *unit = head ? strchr(cell, '(') : NULL;
    if (unit) *unit = '\0';
    cell += strspn(cell, " \t\"");
    size_t n = strlen(cell);
    while (n > 0 && strchr(" \t\r\n\"", cell[n - 1])) cell[--n] = '\0';
    return cell;
}

/* Finds the columns that are named as the axes are. */
static void read_column_heads(table *t, const mesh_spec *axes)
{
    for (int a = 0; a < 3; a++) t->column[a] = -1;
    if (!next_table_line(t)) {
        if (!t->fault[0]) snprintf(t->fault, sizeof t->fault, "it is empty");
        return;
    }
    char *rest = t->text;
    int at = 0;
    for (const char *cell = next_cell(&rest, true); cell; cell = next_cell(&rest, true), at++)
        for (int a = 0; a < t->dim; a++)
            if (strcmp(cell, axis_name(axes, a)) == 0) t->column[a] = at;
    for (int a = 0; a < t->dim && !t->fault[0]; a++)
        if (t->column[a] < 0)
            snprintf(t->fault, sizeof t->fault, "its first line names no column '%s'", axis_name(axes, a));
}

static void read_point_row(table *t, double place[3])
{
    char *rest = t->text;
    int at = 0, found = 0;
    for (const char *cell = next_cell(&rest, false); cell; cell = next_cell(&rest, false), at++)
        for (int a = 0; a < t->dim; a++) {
            const char *unit;
            char why[WHY_SIZE];
            if (t->column[a] != at) continue;
            found++;
            if (number_split(cell, &place[a], &unit, why) && unit[0] == '\0') continue;
            snprintf(t->fault, sizeof t->fault, "line %ld: '%.60s' is no number (m)", t->line, cell);
            return;
        }
    if (found < t->dim) snprintf(t->fault, sizeof t->fault, "line %ld has too few columns", t->line);
}

/* Counts the rows, then takes them. */
static floe_status read_point_rows(reader *r, table *t, curve_line *c)
{
    size_t n = 0;
    const long head = t->line, start = ftell(t->file);
    while (next_table_line(t)) n++;
    if (n == 0 && !t->fault[0]) snprintf(t->fault, sizeof t->fault, "it has no row below its head");
    if (n > ROWS_MOST) snprintf(t->fault, sizeof t->fault, "it has more than %d rows", ROWS_MOST);
    if (t->fault[0]) return FLOE_OK;
    TRY(scene_allocate(r->scene, &c->vertex, 3 * n * sizeof *c->vertex));
    t->line = head;
    if (fseek(t->file, start, SEEK_SET) != 0)
        return fail(r->ctx, FLOE_IO, "cannot read '%s': %s", t->name, strerror(errno));
    while ((size_t)c->n_vertices < n && next_table_line(t) && !t->fault[0])
        read_point_row(t, c->vertex + 3 * (ptrdiff_t)c->n_vertices++);
    return FLOE_OK;
}

static floe_status refuse_unreadable(reader *r, deck_node *node, const char *path, const char *special)
{
    if (!special) return bad(r, node, special_positions.form, "cannot open '%s': %s", path, strerror(errno));
    return bad(r, node, special_positions.form, "cannot open '%s': it is %s, not an ordinary file", path, special);
}

static floe_status read_table_file(reader *r, deck_node *node, curve_line *c)
{
    const char *path;
    TRY(resolve_path(r, node, &path));
    if (!path) return FLOE_OK;
    const char *special;
    const int descriptor = ordinary_open(path, O_RDONLY, &special);
    if (descriptor < 0) return refuse_unreadable(r, node, path, special);
    table t = {.file = fdopen(descriptor, "r"), .name = path, .dim = r->scene->mesh.dim};
    if (!t.file) {
        (void)close(descriptor);
        return fail(r->ctx, FLOE_NO_MEMORY, "no memory for '%s'", path);
    }
    read_column_heads(&t, &r->scene->mesh);
    const floe_status status = t.fault[0] ? FLOE_OK : read_point_rows(r, &t, c);
    fclose(t.file);
    TRY(status);
    if (t.fault[0]) return bad(r, node, NULL, "'%s': %s", path, t.fault);
    c->file = path;
    return FLOE_OK;
}

/* ---- either ---- */

static floe_status read_places(reader *r, const key_spec *key, deck_node *node, void *base)
{
    if (!node) return FLOE_OK; /* required: an error has been entered */
    if (node->kind == NODE_SCALAR && !node_is_null(node) && r->scene->mesh.dim > 0)
        return read_table_file(r, node, base);
    if (node->kind == NODE_LIST && node->n > 0) return read_list(r, node, base);
    return bad_form(r, key, node, special_positions.form);
}

/* In a comment, what the file held: a run that goes on compares resolved decks, and so sees that the list is another
 * one. */
static void write_digest(writer *w, const curve_line *c)
{
    char digest[SHA256_TEXT];
    sha256_of(c->vertex, 3 * (size_t)c->n_vertices * sizeof *c->vertex, digest);
    strbuf_append(&w->out, " # %d places, sha256 %s\n", c->n_vertices, digest);
}

static void write_places(writer *w, const key_spec *key, const void *base)
{
    const curve_line *c = base;
    write_key_name(w, key->key);
    if (c->file) {
        strbuf_append(&w->out, " ");
        write_quoted(&w->out, c->file);
        write_digest(w, c);
        return;
    }
    for (int i = 0; i < c->n_vertices; i++) {
        strbuf_append(&w->out, "%s", i == 0 ? " [" : ", ");
        write_position(w, c->vertex + (ptrdiff_t)3 * i);
    }
    strbuf_append(&w->out, "]\n");
}

static floe_status read_sheet_places(reader *r, const key_spec *key, deck_node *node, void *base)
{
    return read_places(r, key, node, &((sheet_surface *)base)->curve);
}

static void write_sheet_places(writer *w, const key_spec *key, const void *base)
{
    write_places(w, key, &((const sheet_surface *)base)->curve);
}

#define PLACES_FORM                                                                                                   \
    "a list of places, [[x, y], [x, y], ...], or the name of a CSV file beside the deck with a column for each axis " \
    "(m)"
#define PLACES_JSON "{\"anyOf\": [{\"type\": \"array\", \"minItems\": 1}, {\"type\": \"string\"}]}"

const special_key special_positions = {
    .read = read_places, .write = write_places, .form = PLACES_FORM, .json = PLACES_JSON};
const special_key special_sheet_positions = {
    .read = read_sheet_places, .write = write_sheet_places, .form = PLACES_FORM, .json = PLACES_JSON};
