/* Keys whose values are names: of what a registry has, of bodies, of metrics. */
#include "deck/deck_internal.h"

#include <stdio.h>
#include <string.h>

/* ---- names out of a registry: method.basis, method.transfer, contact.normals ---- */

static floe_status read_listed(reader *r, const key_spec *key, deck_node *node, void *base)
{
    const special_key *list = key->special;
    char *name = (char *)base + key->offset;
    if (!node) return FLOE_OK; /* scene_create has set the default */
    for (size_t i = 0; node->kind == NODE_SCALAR && list->candidate(r->catalogue, i); i++) {
        if (strcmp(list->candidate(r->catalogue, i), node->text) != 0) continue;
        snprintf(name, key->size, "%s", node->text);
        return FLOE_OK;
    }
    return bad_name(r, node, false, list->noun, list->candidate, r->catalogue);
}

static void write_listed(writer *w, const key_spec *key, const void *base)
{
    if (!((const char *)base + key->offset)[0]) return; /* as the scene asks */
    write_key_name(w, key->key);
    strbuf_append(&w->out, " %s\n", (const char *)base + key->offset);
}

static const char *basis_candidate(const void *user, size_t i)
{
    const deck_catalogue *catalogue = user;
    return catalogue && i < catalogue->n_basis ? catalogue->basis[i].name : NULL;
}

static const char *transfer_candidate(const void *user, size_t i)
{
    const deck_catalogue *catalogue = user;
    return catalogue && i < catalogue->n_transfer ? catalogue->transfer[i].name : NULL;
}

static const char *normal_candidate(const void *user, size_t i)
{
    const deck_catalogue *catalogue = user;
    return catalogue && i < catalogue->n_normal ? catalogue->normal[i].name : NULL;
}

const special_key special_basis = {
    .read = read_listed,
    .write = write_listed,
    .form = "the name of a basis",
    .noun = "basis",
    .candidate = basis_candidate,
};
const special_key special_transfer = {
    .read = read_listed,
    .write = write_listed,
    .form = "the name of a transfer",
    .noun = "transfer",
    .candidate = transfer_candidate,
};
const special_key special_normals = {
    .read = read_listed,
    .write = write_listed,
    .form = "the name of a kind of normals",
    .noun = "kind of normals",
    .candidate = normal_candidate,
};

/* ---- contact.between: all, or [body, body, ...] ---- */

static const char *body_candidate(const void *user, size_t i)
{
    const scene *s = user;
    return i < (size_t)s->n_bodies ? s->body[i].name : NULL;
}

static floe_status read_contact_body(reader *r, deck_node *item, scene_contact *contact)
{
    const int body = item->kind == NODE_SCALAR ? find_body(r->scene, item->text) : -1;
    if (body < 0) return bad_name(r, item, false, "body", body_candidate, r->scene);
    for (int i = 0; i < contact->n_bodies; i++) {
        if (contact->body[i] == body) return bad(r, item, NULL, "body '%s' is listed twice", item->text);
    }
    if (contact->n_bodies == SCENE_MAX_CONTACT)
        return bad(r, item, NULL, "more than %d bodies in contact", SCENE_MAX_CONTACT);
    contact->body[contact->n_bodies++] = body;
    return FLOE_OK;
}

static floe_status read_between(reader *r, const key_spec *key, deck_node *node, void *base)
{
    if (!node || node_is_word(node, "all")) return FLOE_OK;
    if (node->kind != NODE_LIST) return bad_form(r, key, node, special_between.form);
    if (node->n < 2) return bad(r, node, special_between.form, "'%s' is too short", key->key);
    for (deck_node *item = node->first; item; item = item->next) TRY(read_contact_body(r, item, base));
    return FLOE_OK;
}

static void write_between(writer *w, const key_spec *key, const void *base)
{
    const scene_contact *contact = base;
    write_key_name(w, key->key);
    for (int i = 0; i < contact->n_bodies; i++)
        strbuf_append(&w->out, "%s%s", i == 0 ? " [" : ", ", w->scene->body[contact->body[i]].name);
    strbuf_append(&w->out, contact->n_bodies > 0 ? "]\n" : " all\n");
}

const special_key special_between = {
    .read = read_between,
    .write = write_between,
    .form = "all, or a list of two bodies or more",
    .json = "{\"oneOf\": [{\"const\": \"all\"}, {\"type\": \"array\", \"items\": {\"type\": \"string\"}, \"minItems\": "
            "2}]}",
};

/* ---- verify.metrics: [eq13, l1_sigma_r] ---- */

static floe_status read_metric(reader *r, deck_node *item, scene_verify *verify)
{
    if (item->kind != NODE_SCALAR || strlen(item->text) >= SCENE_NAME) {
        return bad(r, item, "the name of a metric", "this is no name of a metric");
    }
    for (int i = 0; i < verify->n_metrics; i++) {
        if (strcmp(verify->metric[i], item->text) == 0)
            return bad(r, item, NULL, "metric '%s' is listed twice", item->text);
    }
    if (verify->n_metrics == SCENE_MAX_METRICS) return bad(r, item, NULL, "more than %d metrics", SCENE_MAX_METRICS);
    snprintf(verify->metric[verify->n_metrics++], SCENE_NAME, "%s", item->text);
    return FLOE_OK;
}

static floe_status read_metrics(reader *r, const key_spec *key, deck_node *node, void *base)
{
    if (!node) return FLOE_OK;
    if (node->kind != NODE_LIST) return bad_form(r, key, node, special_metrics.form);
    for (deck_node *item = node->first; item; item = item->next) TRY(read_metric(r, item, base));
    return FLOE_OK;
}

static void write_metrics(writer *w, const key_spec *key, const void *base)
{
    const scene_verify *verify = base;
    if (verify->n_metrics == 0) return;
    write_key_name(w, key->key);
    for (int i = 0; i < verify->n_metrics; i++) strbuf_append(&w->out, "%s%s", i == 0 ? " [" : ", ", verify->metric[i]);
    strbuf_append(&w->out, "]\n");
}

const special_key special_metrics = {
    .read = read_metrics,
    .write = write_metrics,
    .form = "a list of names: [l1_density, ...]",
    .json = "{\"type\": \"array\", \"items\": {\"type\": \"string\"}}",
};
