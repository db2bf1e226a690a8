/* deck_load: text, tree, overrides, tables, defaults, checks, report. */
#include "deck/check/check.h"
#include "deck/deck_internal.h"
#include "deck/override.h"
#include "deck/preset.h"

#include "base/memory.h"
#include "base/ordinary.h"
#include "sim/interface.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

typedef struct deck_source {
    context *ctx;
    const char *path, *text;
    size_t length;
    const deck_catalogue *catalogue;
    bool axes; /* their values are looked at, too */
} deck_source;

/* Parses the text and applies the overrides. NULL root: an error has been entered. */
static floe_status make_tree(const deck_source *source, const deck_overrides *set, deck_arena *arena,
                             error_list *errors, deck_node **root)
{
    parse_error error;
    *root = NULL;
    if (source->length > TREE_MAX_BYTES) {
        return error_add(errors, (deck_location){0, 1, 1}, NULL, NULL, "the deck is larger than %d bytes",
                         TREE_MAX_BYTES);
    }
    const floe_status status = parse_yaml(root, arena, 0, source->text, source->length, &error);
    if (status == FLOE_BAD_INPUT) return error_add(errors, error.at, NULL, error.remedy, "%s", error.text);
    TRY(status);
    if (node_is_null(*root)) {
        *root = NULL;
        return error_add(errors, (deck_location){0, 1, 1}, "a map of keys, beginning with 'floe: 1'",
                         "`floe new` writes a deck to start from", "the deck is empty");
    }
    TRY(override_apply(*root, arena, set, errors));
    return preset_expand(*root, arena, errors);
}

/* What `auto` becomes, if the mesh is one on which that can be seen; what is wrong with the mesh itself is said by check_scene. */
static floe_status settle_interface(reader *r)
{
    mesh made;
    const bool sound = mesh_init(&made, r->ctx, &r->scene->mesh) == FLOE_OK;
    if (!sound) context_clear(r->ctx);
    if (!sound && r->scene->method.interface == INTERFACE_SHARP) return FLOE_OK;
    if (sound) TRY(take_refusal(r, interface_check_size(r->scene, &made)));
    return r->errors->count == 0 ? interface_settle(r->scene) : FLOE_OK;
}

/* Text to scene; faults of the deck go into `errors`, and the scene is then not to be used. */
static floe_status resolve_deck(deck_source *source, const deck_overrides *set, scene *s, deck_arena *arena,
                                error_list *errors)
{
    deck_node *root;
    TRY(make_tree(source, set, arena, errors, &root));
    if (!root) return FLOE_OK;
    reader r = {
        .ctx = source->ctx, .scene = s, .catalogue = source->catalogue, .arena = arena, .errors = errors, .root = root};
    snprintf(s->path, sizeof s->path, "%s", source->path);
    TRY(read_table(&r, &schema_deck, root, s));
    if (root->kind != NODE_MAP) return FLOE_OK;
    TRY(note_keys(s, root, set));
    TRY(finish_scene(&r));
    if (errors->count == 0) TRY(settle_interface(&r));
    return check_scene(&r);
}

/* Tries one value of an axis; `first` is the first error that it brings, NULL if none. */
static floe_status try_value(deck_source *source, const deck_overrides *set, const scene_axis *axis, int pick,
                             deck_arena *arena, const char **first)
{
    const size_t n = set ? set->n : 0, own = (size_t)scene_axis_settings(axis);
    const char **text;
    char(*setting)[SCENE_SETTING];
    TRY(arena_new(arena, &text, (n + own) * sizeof *text));
    TRY(arena_new(arena, &setting, own * sizeof *setting));
    for (size_t i = 0; i < n; i++) text[i] = set->text[i];
    for (size_t k = 0; k < own; k++) {
        scene_axis_setting(axis, (int)k, pick, setting[k]);
        text[n + k] = setting[k];
    }
    const deck_overrides all = {text, n + own};
    error_list errors = {.arena = arena, .path = source->path, .text = source->text, .set = &all};
    scene *s;
    TRY(scene_create(&s, source->ctx));
    const floe_status status = resolve_deck(source, &all, s, arena, &errors);
    scene_destroy(&s);
    *first = error_first(&errors);
    return status;
}

/* The place in the deck of a value of an axis under `path`, which ends with the axis' key. */
static floe_status place_of_axis_value(const deck_source *source, const deck_overrides *set, deck_arena *arena,
                                       const char *const *path, int i, deck_location *at)
{
    deck_node *root;
    error_list ignored = {.arena = arena};
    TRY(make_tree(source, set, arena, &ignored, &root));
    const deck_node *list = nearest_path(root, path), *values = node_find(list, "values");
    if (values) list = values;
    const deck_node *item = list->kind == NODE_LIST ? node_at(list, (size_t)i) : NULL;
    *at = item ? item->at : list->at;
    return FLOE_OK;
}

/* Every value of an axis must make a deck, for the batch would find out an hour later. */
static floe_status check_axis(deck_source *source, const deck_overrides *set, const scene_axis *axis,
                              const char *const *path, deck_arena *arena, error_list *errors)
{
    for (int i = 0; i < axis->n_values; i++) {
        const char *first;
        deck_location at;
        TRY(try_value(source, set, axis, i, arena, &first));
        if (!first) continue;
        TRY(place_of_axis_value(source, set, arena, path, i, &at));
        TRY(error_add(errors, at, NULL, NULL, "with %s=%s: %s", axis->key, axis->value[i], first));
    }
    return FLOE_OK;
}

static floe_status check_axes(deck_source *source, const deck_overrides *set, const scene *s, deck_arena *arena,
                              error_list *errors)
{
    const scene_batches *b = s->batches;
    TRY(check_axis(source, set, &b->compare, KEY("compare", "axis", b->compare.key), arena, errors));
    for (int i = 0; i < b->study.n_axes; i++) {
        const scene_axis *axis = &b->study.axis[i];
        TRY(check_axis(source, set, axis, KEY("study", "axes", axis->key), arena, errors));
    }
    for (int i = 0; i < b->stability.n_over; i++) {
        const scene_axis *axis = &b->stability.over[i];
        TRY(check_axis(source, set, axis, KEY("stability", "over", axis->key), arena, errors));
    }
    for (int i = 0; i < b->stability.n_each; i++) {
        const scene_axis *axis = &b->stability.each[i];
        TRY(check_axis(source, set, axis, KEY("stability", "each", axis->key), arena, errors));
    }
    return FLOE_OK;
}

static floe_status write_report(const deck_source *source, const error_list *errors, deck_report *report)
{
    strbuf out = {.ctx = source->ctx};
    errors_print(errors, &out);
    TRY(strbuf_take(&out, &report->text));
    report->count = errors->count;
    return fail(source->ctx, FLOE_BAD_INPUT, "%s: %zu error%s", source->path, errors->count,
                errors->count == 1 ? "" : "s");
}

static floe_status load_deck(scene *s, deck_source *source, const deck_overrides *set, deck_arena *arena,
                             deck_report *report)
{
    error_list errors = {.arena = arena, .path = source->path, .text = source->text, .set = set};
    TRY(resolve_deck(source, set, s, arena, &errors));
    if (errors.count == 0 && source->axes) TRY(check_axes(source, set, s, arena, &errors));
    return errors.count == 0 ? FLOE_OK : write_report(source, &errors, report);
}

static floe_status load_text(scene **out, deck_source *source, const deck_overrides *set, deck_report *report)
{
    *out = NULL;
    *report = (deck_report){.ctx = source->ctx};
    deck_arena arena = {.ctx = source->ctx};
    scene *s;
    TRY(scene_create(&s, source->ctx));
    const floe_status status = load_deck(s, source, set, &arena, report);
    arena_free(&arena);
    if (status != FLOE_OK) {
        scene_destroy(&s);
        return status;
    }
    *out = s;
    return FLOE_OK;
}

floe_status deck_load_text(scene **out, context *ctx, const char *path, const char *text, size_t length,
                           const deck_overrides *set, const deck_catalogue *catalogue, deck_report *report)
{
    deck_source source = {.ctx = ctx, .path = path, .text = text, .length = length, .catalogue = catalogue};
    return load_text(out, &source, set, report);
}

static floe_status refuse_unreadable(context *ctx, const char *path, const char *special)
{
    if (special)
        return fail(ctx, FLOE_IO, "cannot read deck '%s': it is %s, not an ordinary file%s", path, special,
                    strcmp(special, "a folder") == 0 ? " (name a deck in it)" : "");
    return fail(ctx, FLOE_IO, "cannot open deck '%s': %s%s", path, strerror(errno),
                errno == ENOENT ? " (`floe new > deck.yaml` writes one to start from)" : "");
}

/* One byte more than a deck may have tells that there are too many. */
static floe_status read_whole_file(context *ctx, const char *path, int descriptor, char **text, size_t *length)
{
    TRY(memory_new(ctx, text, TREE_MAX_BYTES + 2, 1));
    *length = 0;
    while (*length <= TREE_MAX_BYTES) {
        const ssize_t got = read(descriptor, *text + *length, TREE_MAX_BYTES + 1 - *length);
        if (got == 0) break;
        if (got > 0) *length += (size_t)got;
        if (got > 0 || errno == EINTR) continue;
        memory_free(ctx, text);
        return fail(ctx, FLOE_IO, "cannot read deck '%s': %s", path, strerror(errno));
    }
    return FLOE_OK;
}

static floe_status read_file(context *ctx, const char *path, char **text, size_t *length)
{
    const char *special;
    const int descriptor = input_open(path, &special);
    if (descriptor < 0) return refuse_unreadable(ctx, path, special);
    const floe_status status = read_whole_file(ctx, path, descriptor, text, length);
    (void)close(descriptor);
    return status;
}

static floe_status load_file(scene **out, deck_source *source, const deck_overrides *set, deck_report *report)
{
    char *text = NULL;
    *out = NULL;
    *report = (deck_report){.ctx = source->ctx};
    TRY(read_file(source->ctx, source->path, &text, &source->length));
    source->text = text;
    const floe_status status = load_text(out, source, set, report);
    memory_free(source->ctx, &text);
    return status;
}

floe_status deck_load(scene **out, context *ctx, const char *path, const deck_overrides *set,
                      const deck_catalogue *catalogue, deck_report *report)
{
    deck_source source = {.ctx = ctx, .path = path, .catalogue = catalogue};
    return load_file(out, &source, set, report);
}

floe_status deck_check(scene **out, context *ctx, const char *path, const deck_overrides *set,
                       const deck_catalogue *catalogue, deck_report *report)
{
    deck_source source = {.ctx = ctx, .path = path, .catalogue = catalogue, .axes = true};
    return load_file(out, &source, set, report);
}

void deck_report_free(deck_report *report)
{
    if (report->ctx) memory_free(report->ctx, &report->text);
    *report = (deck_report){0};
}
