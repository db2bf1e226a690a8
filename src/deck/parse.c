/* YAML to tree. The only file that sees libfyaml: its event parser is used, because events keep duplicate keys and the
 * place of every token. Anchors, aliases, tags and several documents are refused: a deck reads the same from top to
 * bottom and a text cannot unfold into a larger one. */
#include "deck/tree.h"

#include <libfyaml.h>

#include <stdio.h>
#include <string.h>

typedef struct parser {
    struct fy_parser *fyp;
    struct fy_diag *diag;
    deck_arena *arena;
    int source;
    size_t nodes;
    deck_node *open[TREE_MAX_DEPTH]; /* maps and lists not yet closed */
    int depth;
    const char *key; /* key read, its value awaited */
    deck_location key_at;
    deck_node *root;
    bool past_document; /* the first document has ended */
    parse_error *error;
} parser;

static deck_location place_of_mark(const parser *p, const struct fy_mark *mark)
{
    if (!mark && p->key) return p->key_at; /* an empty value stands nowhere */
    if (!mark) return (deck_location){.source = p->source, .line = 1, .column = 1};
    return (deck_location){.source = p->source, .line = mark->line + 1, .column = mark->column + 1};
}

static floe_status refuse_syntax(parser *p, deck_location at, const char *text, const char *remedy)
{
    p->error->at = at;
    snprintf(p->error->text, sizeof p->error->text, "%s", text);
    snprintf(p->error->remedy, sizeof p->error->remedy, "%s", remedy);
    return FLOE_BAD_INPUT;
}

/* A plain name is what a key must be; the tree has no other use for a map's keys. */
static floe_status parse_key(parser *p, struct fy_event *event, deck_location at)
{
    if (event->type != FYET_SCALAR) {
        return refuse_syntax(p, at, "a key of a map must be a name, not a map or a list",
                             "quote the text that is meant to be the key");
    }
    size_t length = 0;
    const char *text = fy_token_get_text(event->scalar.value, &length);
    if (!text) length = 0;
    TRY(arena_text(p->arena, &p->key, text, length));
    p->key_at = at;
    return FLOE_OK;
}

static floe_status add_node(parser *p, deck_node *node)
{
    if (++p->nodes > TREE_MAX_NODES) return refuse_syntax(p, node->at, "the deck has too many entries", "");
    if (p->depth == 0) {
        p->root = node;
        return FLOE_OK;
    }
    deck_node *parent = p->open[p->depth - 1];
    if (parent->kind == NODE_MAP) {
        node->key = p->key;
        node->key_at = p->key_at;
        p->key = NULL;
    }
    node_append(parent, node);
    return FLOE_OK;
}

static floe_status open_node(parser *p, node_kind kind, deck_location at)
{
    if (p->depth == TREE_MAX_DEPTH) return refuse_syntax(p, at, "maps and lists are nested too deeply", "");
    deck_node *node;
    TRY(node_new(p->arena, &node, kind, at));
    TRY(add_node(p, node));
    p->open[p->depth++] = node;
    return FLOE_OK;
}

static floe_status parse_scalar(parser *p, struct fy_event *event, deck_location at)
{
    deck_node *node;
    size_t length = 0;
    const char *text = fy_token_get_text(event->scalar.value, &length);
    if (!text) length = 0;
    if (text && memchr(text, '\0', length)) return refuse_syntax(p, at, "a zero byte in the text", "");
    TRY(node_new(p->arena, &node, NODE_SCALAR, at));
    TRY(arena_text(p->arena, &node->text, text, length));
    node->quoted = fy_token_scalar_style(event->scalar.value) != FYSS_PLAIN;
    return add_node(p, node);
}

static bool starts_value(const struct fy_event *event)
{
    return event->type == FYET_SCALAR || event->type == FYET_MAPPING_START || event->type == FYET_SEQUENCE_START;
}

/* Anchor or tag of an event that starts a value, NULL if it has none. */
static struct fy_token *anchor_or_tag(const struct fy_event *event)
{
    const struct fy_event_scalar_data *data = &event->scalar; /* the three share their first members */
    if (event->type == FYET_MAPPING_START)
        return event->mapping_start.anchor ? event->mapping_start.anchor : event->mapping_start.tag;
    if (event->type == FYET_SEQUENCE_START) {
        return event->sequence_start.anchor ? event->sequence_start.anchor : event->sequence_start.tag;
    }
    return data->anchor ? data->anchor : data->tag;
}

static floe_status parse_value(parser *p, struct fy_event *event, deck_location at)
{
    if (anchor_or_tag(event))
        return refuse_syntax(p, at, "anchors (&) and tags (!) are not used in decks", "write the value itself");
    if (p->depth > 0 && p->open[p->depth - 1]->kind == NODE_MAP && !p->key) return parse_key(p, event, at);
    switch (event->type) {
    case FYET_MAPPING_START: return open_node(p, NODE_MAP, at);
    case FYET_SEQUENCE_START: return open_node(p, NODE_LIST, at);
    default: return parse_scalar(p, event, at);
    }
}

/* libfyaml marks the text behind a star or an opening quote; the place of the value is the star or the quote. */
static int marks_before_text(const struct fy_event *event)
{
    if (event->type == FYET_ALIAS) return 1;
    if (event->type != FYET_SCALAR || !event->scalar.value) return 0;
    const enum fy_scalar_style style = fy_token_scalar_style(event->scalar.value);
    return style == FYSS_SINGLE_QUOTED || style == FYSS_DOUBLE_QUOTED;
}

static floe_status take_event(parser *p, struct fy_event *event)
{
    deck_location at = place_of_mark(p, fy_event_start_mark(event));
    if (at.column > 1) at.column -= marks_before_text(event);
    if (event->type == FYET_ALIAS)
        return refuse_syntax(p, at, "aliases (*) are not used in decks", "write the value itself");
    if (event->type == FYET_DOCUMENT_START && p->past_document) {
        return refuse_syntax(p, at, "a second document begins here", "a deck is one document: remove the line '---'");
    }
    if (event->type == FYET_DOCUMENT_END) p->past_document = true;
    if (event->type == FYET_MAPPING_END || event->type == FYET_SEQUENCE_END) p->depth--;
    return starts_value(event) ? parse_value(p, event, at) : FLOE_OK;
}

typedef struct syntax_remedy {
    const char *text, *remedy; /* libfyaml's words, and what to do */
} syntax_remedy;

#define FLOW_REMEDY                                                                                           \
    "separate entries by commas, close each { and [, and give a map within a map braces of its own: `upper: " \
    "{outlet: {pressure: 1 atm}}`"
#define INDENT_REMEDY "keys of one map begin in the same column"

static const char *syntax_remedy_of(const char *text)
{
    static const syntax_remedy known[] = {
        {"tab character may not be used as indentation", "indent with spaces"},
        {"cannot use tab for indentation of block entry", "indent with spaces"},
        {"invalid multiline plain key",
         "write `key: value`, with a colon and a space behind the key; keys of one map begin in the same column"},
        {"missing comma in flow mapping", FLOW_REMEDY},
        {"missing comma in flow sequence", FLOW_REMEDY},
        {"flow mapping without a closing bracket", FLOW_REMEDY},
        {"flow sequence without a closing bracket", FLOW_REMEDY},
        {"invalid extra closing", "remove it, or open it before"},
        {"mismatched flow mapping end", "a [ before this } is not closed"},
        {"mismatched flow sequence end", "a { before this ] is not closed"},
        {"invalid indentation in mapping", INDENT_REMEDY},
        {"wrongly indented flow mapping", INDENT_REMEDY},
        {"did not find expected key", INDENT_REMEDY},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (strstr(text, known[i].text)) return known[i].remedy;
    return "";
}

/* libfyaml's words for what is wrong, at its place; the first error is the cause, later ones follow from it. */
static floe_status take_syntax_error(parser *p)
{
    void *iterator = NULL;
    const struct fy_diag_error *found = fy_diag_errors_iterate(p->diag, &iterator);
    deck_location at = {.source = p->source, .line = 1, .column = 1};
    if (!found) return refuse_syntax(p, at, "the text is not YAML", "");
    if (found->line > 0) at.line = found->line;
    if (found->column > 0) at.column = found->column;
    const char *text = found->msg ? found->msg : "the text is not YAML";
    return refuse_syntax(p, at, text, syntax_remedy_of(text));
}

static floe_status take_events(parser *p)
{
    for (bool done = false; !done;) {
        struct fy_event *event = fy_parser_parse(p->fyp);
        if (!event) break;
        done = event->type == FYET_STREAM_END;
        const floe_status status = take_event(p, event);
        fy_parser_event_free(p->fyp, event);
        if (status != FLOE_OK) return status;
    }
    return fy_parser_get_stream_error(p->fyp) || fy_diag_got_error(p->diag) ? take_syntax_error(p) : FLOE_OK;
}

/* How many bytes the character has that begins here; 0: it is none of UTF-8 (RFC 3629). */
static size_t character_length(const unsigned char *c, size_t left)
{
    const size_t length = c[0] < 0x80 ? 1 : c[0] < 0xc2 ? 0 : c[0] < 0xe0 ? 2 : c[0] < 0xf0 ? 3 : c[0] < 0xf5 ? 4 : 0;
    if (length > left) return 0;
    for (size_t k = 1; k < length; k++)
        if ((c[k] & 0xc0) != 0x80) return 0;
    const bool overlong = (c[0] == 0xe0 && c[1] < 0xa0) || (c[0] == 0xf0 && c[1] < 0x90);
    const bool no_character = (c[0] == 0xed && c[1] > 0x9f) || (c[0] == 0xf4 && c[1] > 0x8f);
    return overlong || no_character ? 0 : length;
}

/* libfyaml 0.7.12 does not come back from some texts that are not UTF-8 (a directive with a byte 0xff in it). */
static floe_status check_text(parser *p, const char *text, size_t length)
{
    deck_location at = {.source = p->source, .line = 1, .column = 1};
    for (size_t i = 0; i < length;) {
        const unsigned char *c = (const unsigned char *)text + i;
        const size_t n = character_length(c, length - i);
        const bool control = c[0] < 0x20 && c[0] != '\t' && c[0] != '\n' && c[0] != '\r';
        if (n == 0 || control || c[0] == 0x7f) {
            char words[64];
            (void)snprintf(words, sizeof words, "the byte 0x%02x stands where a character should", c[0]);
            return refuse_syntax(p, at, words, "a deck is text in UTF-8");
        }
        at.column = c[0] == '\n' ? 1 : at.column + 1;
        at.line += c[0] == '\n';
        i += n;
    }
    return FLOE_OK;
}

static struct fy_diag *create_diag(void)
{
    struct fy_diag_cfg config;
    fy_diag_cfg_default(&config);
    config.fp = NULL;
    config.colorize = false;
    struct fy_diag *diag = fy_diag_create(&config);
    if (diag) fy_diag_set_collect_errors(diag, true);
    return diag;
}

floe_status parse_yaml(deck_node **root, deck_arena *arena, int source, const char *text, size_t length,
                       parse_error *error)
{
    parser p = {.arena = arena, .source = source, .error = error};
    *root = NULL;
    TRY(check_text(&p, text, length));
    p.diag = create_diag();
    const struct fy_parse_cfg config = {.search_path = "",
                                        .flags = FYPCF_QUIET | FYPCF_ALLOW_DUPLICATE_KEYS | FYPCF_DEFAULT_VERSION_1_2 |
                                                 FYPCF_JSON_NONE,
                                        .diag = p.diag};
    p.fyp = p.diag ? fy_parser_create(&config) : NULL;
    floe_status status = FLOE_OK;
    if (!p.fyp || fy_parser_set_string(p.fyp, text, length) != 0) {
        status = fail(arena->ctx, FLOE_NO_MEMORY, "the YAML parser could not be started: memory is out");
    } else {
        status = take_events(&p);
    }
    if (p.diag) fy_diag_reset_error(p.diag);
    if (p.fyp) fy_parser_destroy(p.fyp);
    if (p.diag) fy_diag_unref(p.diag);
    if (status != FLOE_OK) return status;
    if (!p.root) TRY(node_new(arena, &p.root, NODE_SCALAR, (deck_location){source, 1, 1}));
    *root = p.root;
    return FLOE_OK;
}
