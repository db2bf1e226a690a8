#include "io/output_field.h"

/* One walk over the registered fields. */
typedef struct field_walk {
    const sim *s;
    field_centring centring;
    int body; /* of points */
    output_field_visitor *visit;
    void *user;
} field_walk;

/* State, what is fixed at seeding, and the two fields of the cells that users ask for. */
static bool is_written(field_id id)
{
    const field_info *info = field_describe(id);
    return info->class == FIELD_STATE || info->class == FIELD_FIXED || info->class == FIELD_DIAGNOSTIC ||
           id == C_THETA || id == C_TEMP;
}

/* Of all materials alike; of each gas where a membrane keeps them apart. */
static bool is_shared_by_materials(const fields *f, field_id id)
{
    return id >= C_PRESSURE && !fields_has(f, id, 1);
}

/* A vector is one field; of a tensor each component is. */
static floe_status visit_components(const field_walk *w, field_id id, int instance, const char *name)
{
    const field_info *info = field_describe(id);
    const bool extensive = id == P_MASS || id == P_VOLUME0;
    output_field field = {.name = name,
                          .unit = info->unit,
                          .meaning = info->meaning,
                          .id = id,
                          .instance = instance,
                          .components = info->components == FIELD_VECTOR ? w->s->mesh.dim : 1,
                          .scale = extensive ? output_scale(w->s) : 1.0};
    if (info->components == FIELD_SCALAR || info->components == FIELD_VECTOR) return w->visit(w->user, &field);
    const int components = field_component_count(info->components, w->s->mesh.dim);
    for (int c = 0; c < components; c++) {
        char full[2 * NAME_SIZE];
        (void)snprintf(full, sizeof full, "%s_%s", name, component_name(w->s, info->components, c));
        field.name = full;
        field.comp = c;
        TRY(w->visit(w->user, &field));
    }
    return FLOE_OK;
}

static floe_status visit_cell_field(const field_walk *w, field_id id, int instance)
{
    char name[2 * NAME_SIZE], material[NAME_SIZE];
    const char *plain = field_describe(id)->name;
    if (is_shared_by_materials(w->s->domain->fields[0], id)) return visit_components(w, id, instance, plain);
    if (instance >= w->s->ice->n_materials) return FLOE_OK;
    material_label(w->s, w->s->ice->material[instance].scene_material, material);
    (void)snprintf(name, sizeof name, "%s_%s", plain, material);
    return visit_components(w, id, instance, name);
}

/* A number that the body's law remembers has the law's name for it. */
static floe_status visit_history(const field_walk *w, field_id id)
{
    const solid_history *h = &w->s->mpm->body[w->body].law->history[id - P_HISTORY_1];
    return w->visit(w->user, &(output_field){.name = h->name,
                                             .unit = h->unit,
                                             .meaning = h->doc,
                                             .id = id,
                                             .instance = w->body,
                                             .components = 1,
                                             .scale = 1.0});
}

static floe_status visit_node_field(const field_walk *w, field_id id, int instance)
{
    char name[NAME_SIZE];
    if (instance == 0) return visit_components(w, id, 0, field_describe(id)->name);
    (void)snprintf(name, sizeof name, "%s_%d", field_describe(id)->name, instance);
    return visit_components(w, id, instance, name);
}

static floe_status visit_registered(void *user, field_id id, int instance)
{
    const field_walk *w = user;
    if (field_describe(id)->centring != w->centring) return FLOE_OK;
    if (w->centring == FIELD_NODE) return visit_node_field(w, id, instance);
    if (!is_written(id)) return FLOE_OK;
    if (w->centring == FIELD_CELL) return visit_cell_field(w, id, instance);
    if (instance != w->body) return FLOE_OK;
    if (id >= P_HISTORY_1 && id <= P_HISTORY_24) return visit_history(w, id);
    return visit_components(w, id, instance, field_describe(id)->name);
}

static floe_status walk_fields(field_walk w)
{
    return fields_visit(w.s->domain->fields[0], visit_registered, &w);
}

floe_status output_fields_of_cells(const sim *s, output_field_visitor *visit, void *user)
{
    if (!s->ice) return FLOE_OK;
    return walk_fields((field_walk){.s = s, .centring = FIELD_CELL, .visit = visit, .user = user});
}

floe_status output_fields_of_points(const sim *s, int body, output_field_visitor *visit, void *user)
{
    return walk_fields((field_walk){.s = s, .centring = FIELD_POINT, .body = body, .visit = visit, .user = user});
}

floe_status output_fields_of_nodes(const sim *s, output_field_visitor *visit, void *user)
{
    return walk_fields((field_walk){.s = s, .centring = FIELD_NODE, .visit = visit, .user = user});
}
