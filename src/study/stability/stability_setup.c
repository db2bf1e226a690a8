/* What is searched, over which range, and for which combinations; all of it is checked before anything runs. */
#include "study/stability/stability_internal.h"

#include "base/memory.h"
#include "run/catalogue.h"
#include "study/judge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The range of a search as text; "" where it is open. */
typedef struct range {
    char from[SCENE_VALUE], to[SCENE_VALUE];
} range;

/* "KEY", "KEY=FROM:TO". */
static floe_status parse_range(context *ctx, const char *text, scene_axis *axis, range *r)
{
    const size_t key = strcspn(text, "="), from = text[key] ? strcspn(text + key + 1, ":") : 0;
    const char *colon = text[key] ? text + key + 1 + from : "";
    *axis = (scene_axis){0};
    *r = (range){0};
    const bool whole = text[key] == '\0' || (*colon == ':' && colon[1] != '\0' && from > 0 && !strchr(colon + 1, ':'));
    if (key == 0 || key >= sizeof axis->key || from >= sizeof r->from || strlen(colon) > sizeof r->to || !whole)
        return fail(ctx, FLOE_BAD_INPUT, "--over takes KEY, KEY=FROM:TO, or, for a map, twice KEY=V1,V2,..., not '%s'",
                    text);
    (void)snprintf(axis->key, sizeof axis->key, "%.*s", (int)key, text);
    if (text[key] == '\0') return FLOE_OK;
    (void)snprintf(r->from, sizeof r->from, "%.*s", (int)from, text + key + 1);
    (void)snprintf(r->to, sizeof r->to, "%s", colon + 1);
    return FLOE_OK;
}

/* A number and what stands behind it, " ms" or "". */
static bool split_number(const char *text, double *x, char unit[STABILITY_UNIT])
{
    char *end;
    *x = strtod(text, &end);
    if (end == text || !isfinite(*x) || strlen(end) >= STABILITY_UNIT) return false;
    (void)snprintf(unit, STABILITY_UNIT, "%s", end);
    return true;
}

static floe_status set_range(stability *s, const range *r, search_spec *spec)
{
    char unit[STABILITY_UNIT] = "";
    spec->to = NAN;
    if (!split_number(r->from, &spec->from, s->unit) || (r->to[0] && !split_number(r->to, &spec->to, unit)))
        return fail(s->ctx, FLOE_BAD_INPUT,
                    "a search of '%s' goes from a number to a number, not from '%s' to '%s'; words are for maps: twice "
                    "--over KEY=V1,V2,...",
                    s->over[0].key, r->from, r->to);
    if (!r->to[0]) {
        if (spec->from > 0.0) return FLOE_OK;
        return fail(s->ctx, FLOE_BAD_INPUT,
                    "a search for '%s' cannot start from its value %g: give a range, --over %s=FROM:TO", s->over[0].key,
                    spec->from, s->over[0].key);
    }
    if (!s->unit[0]) (void)snprintf(s->unit, sizeof s->unit, "%s", unit);
    if (unit[0] && strcmp(s->unit, unit) != 0)
        return fail(s->ctx, FLOE_BAD_INPUT, "the range of '%s' has two units: '%s' and '%s'", s->over[0].key, r->from,
                    r->to);
    if (spec->from == spec->to)
        return fail(s->ctx, FLOE_BAD_INPUT, "the range of '%s' is empty: from %s to %s", s->over[0].key, r->from,
                    r->to);
    return FLOE_OK;
}

/* Where a search starts that has no range: the key's value in the deck. */
static floe_status start_from_deck(stability *s, const scene *sc, range *r)
{
    deck_catalogue *catalogue;
    TRY(catalogue_create(&catalogue, s->ctx));
    const floe_status status = deck_value(r->from, sc, catalogue, s->over[0].key);
    catalogue_destroy(s->ctx, &catalogue);
    TRY(status);
    if (r->from[0]) return FLOE_OK;
    return fail(s->ctx, FLOE_BAD_INPUT,
                "'%s' has no single value in '%s' to start from: give a range, --over %s=FROM:TO", s->over[0].key,
                s->deck_path, s->over[0].key);
}

static void take_deck_range(const scene_stability *deck, range *r)
{
    (void)snprintf(r->from, sizeof r->from, "%s", deck->over[0].value[0]);
    (void)snprintf(r->to, sizeof r->to, "%s", deck->over[0].value[1]);
}

/* One key: a search. */
static floe_status take_search(stability *s, const stability_options *o, const scene *sc, search_spec *spec)
{
    const scene_stability *deck = &sc->batches->stability;
    range r = {0};
    s->n_over = 1;
    if (o->n_over == 0) {
        s->over[0] = deck->over[0];
        take_deck_range(deck, &r);
    } else {
        TRY(parse_range(s->ctx, o->over[0], &s->over[0], &r));
        const bool same = deck->n_over == 1 && strcmp(deck->over[0].key, s->over[0].key) == 0;
        if (!r.from[0] && same) take_deck_range(deck, &r);
        if (!r.from[0]) TRY(start_from_deck(s, sc, &r));
    }
    return set_range(s, &r, spec);
}

/* Two keys: a map. */
static floe_status take_map(stability *s, const stability_options *o, const scene_stability *deck)
{
    s->n_over = 2;
    for (int i = 0; i < 2; i++) {
        if (o->n_over == 0)
            s->over[i] = deck->over[i];
        else
            TRY(axis_from_text(s->ctx, "--over", o->over[i], &s->over[i]));
    }
    if (strcmp(s->over[0].key, s->over[1].key) != 0) return FLOE_OK;
    return fail(s->ctx, FLOE_BAD_INPUT, "a map is over two keys, not twice over '%s'", s->over[0].key);
}

static floe_status take_over(stability *s, const stability_options *o, const scene *sc, search_spec *spec)
{
    const size_t n = o->n_over > 0 ? o->n_over : (size_t)sc->batches->stability.n_over;
    if (n == 1) return take_search(s, o, sc, spec);
    if (n == 2) return take_map(s, o, &sc->batches->stability);
    if (n > 2)
        return fail(s->ctx, FLOE_BAD_INPUT, "--over is given once for a search, twice for a map, not %zu times", n);
    return fail(s->ctx, FLOE_BAD_INPUT,
                "over what? --over KEY=FROM:TO, or a section 'stability: {over: {KEY: [FROM, TO]}}' in '%s'",
                o->batch.deck);
}

static floe_status take_each(stability *s, const stability_options *o, const scene_stability *deck)
{
    if (o->n_each > SCENE_MAX_AXES) return fail(s->ctx, FLOE_BAD_INPUT, "more than %d --each", SCENE_MAX_AXES);
    s->n_each = o->n_each > 0 ? (int)o->n_each : deck->n_each;
    for (int i = 0; i < s->n_each; i++) {
        if (o->n_each == 0)
            s->each[i] = deck->each[i];
        else
            TRY(axis_from_text(s->ctx, "--each", o->each[i], &s->each[i]));
    }
    return FLOE_OK;
}

/* All combinations of `each`, the first key slowest. */
static floe_status make_sets(stability *s, const search_spec *spec)
{
    s->n_sets = crossed_count(s->each, s->n_each);
    TRY(memory_new(s->ctx, &s->set, s->n_sets, sizeof *s->set));
    for (size_t k = 0; k < s->n_sets; k++) {
        crossed_pick(s->each, s->n_each, k, s->set[k].value);
        search_begin(&s->set[k].search, spec);
    }
    return FLOE_OK;
}

/* Every value that is known beforehand must make a deck: for searches the ends of the range and what comes between
 * them. */
static floe_status check_probes(stability *s, const stability_options *o, const stability_probe *probe, size_t n)
{
    const batch_options batch = stability_batch(s, o);
    stability_cases cases;
    floe_status status = stability_cases_make(&cases, s, o, probe, n);
    for (size_t i = 0; status == FLOE_OK && i < n; i++) status = batch_prepare(s->ctx, &batch, &cases.list[i], NULL);
    stability_cases_free(s->ctx, &cases);
    return status;
}

static floe_status check_search(stability *s, const stability_options *o, size_t set)
{
    const search_spec *spec = &s->set[set].search.spec;
    const double a = spec->from, b = isnan(spec->to) ? a : spec->to;
    const stability_probe probe[] = {stability_probe_at(s, set, a), stability_probe_at(s, set, b),
                                     stability_probe_at(s, set, a + 0.382 * (b - a))};
    return check_probes(s, o, probe, a == b ? 1 : 3);
}

static floe_status check_map(stability *s, const stability_options *o, size_t set)
{
    for (size_t i = 0; i < crossed_count(s->over, 2); i++) {
        const stability_probe probe = stability_probe_of_map(s, set, i);
        TRY(check_probes(s, o, &probe, 1));
    }
    return FLOE_OK;
}

/* The work of a force on points is in no ledger, so that nothing tells it from growth. */
static bool energy_is_told(const scene *sc)
{
    for (int i = 0; i < sc->n_loads; i++) {
        if (sc->load[i].kind == LOAD_BODY_FORCE && sc->coupling != COUPLING_ICE) return false;
    }
    return true;
}

static floe_status take_scene(stability *s, const stability_options *o, const scene *sc)
{
    const scene_stability *deck = &sc->batches->stability;
    search_spec spec = {.from = NAN, .to = NAN, .most = SEARCH_MOST};
    s->dimensionless = sc->dimensionless;
    (void)snprintf(s->title, sizeof s->title, "%s", sc->title);
    s->tolerance = spec.tolerance = o->tolerance > 0.0 ? o->tolerance : deck->tolerance;
    s->growth = o->growth > 0.0 ? o->growth : deck->growth;
    s->by_energy = energy_is_told(sc);
    TRY(take_over(s, o, sc, &spec));
    TRY(take_each(s, o, deck));
    /* The deck's reference belongs to the deck's key. */
    const bool same = deck->n_over == 1 && strcmp(deck->over[0].key, s->over[0].key) == 0;
    s->relative_to = o->relative_to > 0.0 ? o->relative_to : same ? deck->relative_to : (double)NAN;
    TRY(make_sets(s, &spec));
    for (size_t k = 0; k < s->n_sets; k++) TRY(stability_is_map(s) ? check_map(s, o, k) : check_search(s, o, k));
    return FLOE_OK;
}

floe_status stability_setup(stability *s, const stability_options *o)
{
    scene *sc;
    TRY(memory_string(s->ctx, &s->deck_path, o->batch.deck));
    TRY(memory_string(s->ctx, &s->dir, o->batch.dir));
    TRY(judge_base_scene(s->ctx, &o->batch, &o->set, &sc));
    const floe_status status = take_scene(s, o, sc);
    scene_destroy(&sc);
    return status;
}
