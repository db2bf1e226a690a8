/* Lists of places: in the deck, or in a file of comma-separated values beside it. */
#include "base/sha256.h"
#include "deck/csv_columns.h"
#include "deck/deck_internal.h"

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

static floe_status read_file_places(reader *r, deck_node *node, curve_line *c)
{
    csv_columns columns = {.n = r->scene->mesh.dim, .stride = 3};
    for (int a = 0; a < columns.n; a++) columns.name[a] = axis_name(&r->scene->mesh, a);
    TRY(read_csv_columns(r, node, special_positions.form, &columns));
    if (!columns.value) return FLOE_OK;
    c->vertex = columns.value;
    c->n_vertices = (int)columns.rows;
    c->file = columns.path;
    return FLOE_OK;
}

/* ---- either ---- */

static floe_status read_places(reader *r, const key_spec *key, deck_node *node, void *base)
{
    if (!node) return FLOE_OK; /* required: an error has been entered */
    if (node->kind == NODE_SCALAR && !node_is_null(node) && r->scene->mesh.dim > 0)
        return read_file_places(r, node, base);
    if (node->kind == NODE_LIST && node->n > 0) return read_list(r, node, base);
    return bad_form(r, key, node, special_positions.form);
}

/* In a comment, what the file held: a run that goes on compares resolved decks, and so sees that the list is another
 * one. */
static void write_digest(writer *w, const curve_line *c)
{
    char digest[SHA256_TEXT];
    strbuf_note(&w->out, sha256_of(w->out.ctx, c->vertex, 3 * (size_t)c->n_vertices * sizeof *c->vertex, digest));
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
