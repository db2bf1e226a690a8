/* Keys whose form is their own. */
#include "deck/deck_internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const choice coupling_choices[] = {
    {"mpm", COUPLING_MPM, "fluids are material points, as solids are"},
    {"ice", COUPLING_ICE, "fluids live in cells; no solids"},
    {"ice-mpm", COUPLING_ICE_MPM, "fluids live in cells, solids are material points"},
    {0},
};

static const char *choice_candidate(const void *user, size_t i)
{
    return ((const choice *)user)[i].name;
}

static const choice *find_choice(const choice *choices, const char *name)
{
    for (; choices->name; choices++) {
        if (strcmp(choices->name, name) == 0) return choices;
    }
    return NULL;
}

/* ---- floe: 1 ---- */

static floe_status read_version(reader *r, const key_spec *key, deck_node *node, void *base)
{
    (void)base;
    if (!node) return FLOE_OK;
    if (node_is_word(node, "1")) return FLOE_OK;
    char found[80];
    node_describe(node, found, sizeof found);
    return bad(r, node, special_version.form, "'%s' is %s: this floe reads version 1 of the deck format", key->key,
               found);
}

static void write_version(writer *w, const key_spec *key, const void *base)
{
    (void)base;
    write_key_name(w, key->key);
    strbuf_append(&w->out, " 1\n");
}

const special_key special_version = {
    .read = read_version,
    .write = write_version,
    .form = "1",
    .json = "{\"const\": 1}",
};

/* ---- runs_as: [mpm, ice-mpm] ---- */

static floe_status read_runs_as(reader *r, const key_spec *key, deck_node *node, void *base)
{
    scene *s = base;
    s->n_runs_as = 1;
    s->runs_as[0] = s->coupling;
    if (!node) return FLOE_OK;
    if (node->kind != NODE_LIST || node->n == 0) return bad_form(r, key, node, special_runs_as.form);
    s->n_runs_as = 0;
    for (deck_node *item = node->first; item; item = item->next) {
        const choice *c = item->kind == NODE_SCALAR ? find_choice(coupling_choices, item->text) : NULL;
        bool twice = false;
        for (int i = 0; c && i < s->n_runs_as; i++) twice = twice || (int)s->runs_as[i] == c->value;
        if (!c) {
            TRY(bad_name(r, item, false, "coupling", choice_candidate, coupling_choices));
        } else if (twice) {
            TRY(bad(r, item, NULL, "coupling '%s' is listed twice", c->name));
        } else {
            s->runs_as[s->n_runs_as++] = (scene_coupling)c->value;
        }
    }
    return FLOE_OK;
}

static void write_runs_as(writer *w, const key_spec *key, const void *base)
{
    const scene *s = base;
    write_key_name(w, key->key);
    for (int i = 0; i < s->n_runs_as; i++) {
        strbuf_append(&w->out, "%s%s", i == 0 ? " [" : ", ", coupling_name(s->runs_as[i]));
    }
    strbuf_append(&w->out, "]\n");
}

const special_key special_runs_as = {
    .read = read_runs_as,
    .write = write_runs_as,
    .form = "a list of mpm, ice, ice-mpm",
    .json = "{\"type\": \"array\", \"items\": {\"enum\": [\"mpm\", \"ice\", \"ice-mpm\"]}}",
};

/* ---- domain.stress_state ---- */

enum { ANY_STATE = 0, UNIAXIAL_STRAIN, UNIAXIAL_STRESS, PLANE_STRAIN, PLANE_STRESS };

static const choice state_choices[] = {
    {"full", ANY_STATE, NULL},
    {"uniaxial_strain", UNIAXIAL_STRAIN, NULL},
    {"uniaxial_stress", UNIAXIAL_STRESS, NULL},
    {"plane_strain", PLANE_STRAIN, NULL},
    {"plane_stress", PLANE_STRESS, NULL},
    {0},
};

/* The state that holds in a scene when nothing is said; "full" is another name for it. */
static int natural_state(const mesh_spec *spec)
{
    if (spec->dim == 1) return UNIAXIAL_STRAIN;
    return spec->dim == 2 && spec->geometry == MESH_CARTESIAN ? PLANE_STRAIN : ANY_STATE;
}

static bool state_fits(const mesh_spec *spec, int state)
{
    switch (state) {
    case ANY_STATE: return true;
    case UNIAXIAL_STRAIN:
    case UNIAXIAL_STRESS: return spec->dim == 1;
    default: return spec->dim == 2 && spec->geometry == MESH_CARTESIAN;
    }
}

static floe_status read_stress_state(reader *r, const key_spec *key, deck_node *node, void *base)
{
    scene *s = base;
    s->stress_state = STRESS_FULL;
    if (!node) return FLOE_OK;
    const choice *c = node->kind == NODE_SCALAR ? find_choice(state_choices, node->text) : NULL;
    if (!c) return bad_name(r, node, false, key->key, choice_candidate, state_choices);
    if (!state_fits(&s->mesh, c->value)) {
        const char *where = c->value == UNIAXIAL_STRAIN || c->value == UNIAXIAL_STRESS ? "1-D" : "2-D cartesian";
        return bad(r, node, NULL, "'%s' is a state of %s scenes", c->name, where);
    }
    if (c->value == PLANE_STRESS) s->stress_state = STRESS_PLANE;
    if (c->value == UNIAXIAL_STRESS) s->stress_state = STRESS_UNIAXIAL;
    return FLOE_OK;
}

static void write_stress_state(writer *w, const key_spec *key, const void *base)
{
    const scene *s = base;
    int state = natural_state(&s->mesh);
    if (s->stress_state == STRESS_PLANE) state = PLANE_STRESS;
    if (s->stress_state == STRESS_UNIAXIAL) state = UNIAXIAL_STRESS;
    write_key_name(w, key->key);
    strbuf_append(&w->out, " %s\n", state_choices[state].name);
}

const special_key special_stress_state = {
    .read = read_stress_state,
    .write = write_stress_state,
    .form = "uniaxial_strain, uniaxial_stress, plane_strain, plane_stress or full",
    .json = "{\"enum\": [\"uniaxial_strain\", \"uniaxial_stress\", \"plane_strain\", \"plane_stress\", \"full\"]}",
};

/* ---- time.cfl: 0.5, or {mpm: 0.5, ice: 0.4} ---- */

static const key_spec cfl_keys[] = {
    {"mpm", KEY_NUMBER, NULL, WITHIN(1e-6, 1.0), AT(scene_time, cfl_mpm), .fallback = "0.5", .doc = "material points"},
    {"ice", KEY_NUMBER, NULL, WITHIN(1e-6, 1.0), AT(scene_time, cfl_ice), .fallback = "0.5", .doc = "cells"},
};
static const key_table cfl_table = TABLE(cfl_keys);

static floe_status read_cfl(reader *r, const key_spec *key, deck_node *node, void *base)
{
    (void)key;
    scene_time *time = base;
    if (!node || node->kind == NODE_MAP) return read_table(r, &cfl_table, node, base);
    key_spec both = cfl_keys[0];
    both.key = "cfl";
    TRY(read_number(r, &both, node, &time->cfl_mpm));
    time->cfl_ice = time->cfl_mpm;
    return FLOE_OK;
}

static void write_cfl(writer *w, const key_spec *key, const void *base)
{
    write_key_name(w, key->key);
    strbuf_append(&w->out, "\n");
    w->indent++;
    write_table(w, &cfl_table, base);
    w->indent--;
}

const special_key special_cfl = {
    .read = read_cfl,
    .write = write_cfl,
    .form = "a number up to 1 for both solvers, or {mpm: number, ice: number}",
};

/* ---- method.preset: its keys have taken its place before the schema sees it (preset.c) ---- */

static floe_status read_preset(reader *r, const key_spec *key, deck_node *node, void *base)
{
    (void)r, (void)key, (void)node, (void)base;
    return FLOE_OK;
}

static void write_preset(writer *w, const key_spec *key, const void *base)
{
    (void)w, (void)key, (void)base;
}

const special_key special_preset = {
    .read = read_preset, .write = write_preset, .form = "g03", .json = "{\"const\": \"g03\"}"};

/* ---- time.substeps: 4, or auto ---- */

static floe_status read_substeps(reader *r, const key_spec *key, deck_node *node, void *base)
{
    scene_time *time = base;
    key_spec number = *key;
    if (!node) return FLOE_OK; /* scene_create has set the default */
    if (node_is_word(node, "auto")) {
        time->substeps = 0;
        return FLOE_OK;
    }
    number.type = KEY_WHOLE;
    return read_scalar(r, &number, node, base);
}

static void write_substeps(writer *w, const key_spec *key, const void *base)
{
    const scene_time *time = base;
    write_key_name(w, key->key);
    if (time->substeps == 0)
        strbuf_append(&w->out, " auto\n");
    else
        strbuf_append(&w->out, " %ld\n", time->substeps);
}

const special_key special_substeps = {
    .read = read_substeps,
    .write = write_substeps,
    .form = "a whole number from 1 to 128, or auto",
    .json = "{\"anyOf\": [{\"type\": \"integer\", \"minimum\": 1, \"maximum\": 128}, {\"const\": \"auto\"}]}",
};

/* A number, or the word that stands for it; NULL: none does. */
static void write_number_or(writer *w, const key_spec *key, double value, const char *word)
{
    write_key_name(w, key->key);
    strbuf_append(&w->out, " %s", word ? word : "");
    if (!word) write_number(&w->out, value);
    strbuf_append(&w->out, "\n");
}

/* ---- method.exchange: 1e7, or locked ---- */

static floe_status read_exchange(reader *r, const key_spec *key, deck_node *node, void *base)
{
    scene_method *method = base;
    if (!node) return FLOE_OK; /* scene_create has set the default */
    if (node_is_word(node, "locked")) {
        method->exchange = INFINITY;
        return FLOE_OK;
    }
    return read_number(r, key, node, &method->exchange);
}

static void write_exchange(writer *w, const key_spec *key, const void *base)
{
    const double exchange = ((const scene_method *)base)->exchange;
    if (isnan(exchange)) return; /* not given */
    write_number_or(w, key, exchange, isinf(exchange) ? "locked" : NULL);
}

const special_key special_exchange = {
    .read = read_exchange,
    .write = write_exchange,
    .form = "a number from 0 to 1e+20, or locked",
    .json = "{\"anyOf\": [{\"type\": [\"number\", \"string\"]}, {\"const\": \"locked\"}]}",
};

/* ---- output.checkpoint_interval: 600 s, auto, or off ---- */

static floe_status read_checkpoint_interval(reader *r, const key_spec *key, deck_node *node, void *base)
{
    scene_output *output = &((scene *)base)->output;
    if (!node) return FLOE_OK; /* scene_create has set the default */
    if (node_is_word(node, "auto")) {
        output->checkpoint_interval = NAN;
        return FLOE_OK;
    }
    if (node_is_word(node, "off")) {
        output->checkpoint_interval = INFINITY;
        return FLOE_OK;
    }
    return read_number(r, key, node, &output->checkpoint_interval);
}

static void write_checkpoint_interval(writer *w, const key_spec *key, const void *base)
{
    const double interval = ((const scene *)base)->output.checkpoint_interval;
    write_number_or(w, key, interval, isnan(interval) ? "auto" : isinf(interval) ? "off" : NULL);
}

const special_key special_checkpoint_interval = {
    .read = read_checkpoint_interval,
    .write = write_checkpoint_interval,
    .form = "a number > 0, auto, or off",
    .json = "{\"anyOf\": [{\"type\": [\"number\", \"string\"]}, {\"enum\": [\"auto\", \"off\"]}]}",
};
