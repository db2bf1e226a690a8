#include "library/plan.h"

#include "base/json_value.h"
#include "base/memory.h"
#include "sim/interface.h"

#include <math.h>

static json_t *names_json(const stage_fields *list)
{
    json_t *names = json_array();
    for (int k = 0; k < list->n; k++) {
        if (list->id[k] != STAGE_NONE) json_array_append_new(names, json_string(plan_field_id((field_id)list->id[k])));
    }
    return names;
}

static json_t *stages_json(const stage_list *stages)
{
    json_t *list = json_array();
    for (int i = 0; i < stages->n; i++) {
        const stage_record *r = &stages->record[i];
        json_array_append_new(list, json_pack("{s:s, s:o, s:o}", "name", r->name, "reads", names_json(&r->reads),
                                              "writes", names_json(&r->writes)));
    }
    return list;
}

static json_t *fields_json(const plan *p)
{
    json_t *list = json_array();
    for (int id = 0; id < FIELD_COUNT; id++) {
        const field_info *info = field_describe((field_id)id);
        const int n = plan_field_instances(p, (field_id)id);
        if (n == 0) continue;
        json_array_append_new(list,
                              json_pack("{s:s, s:s, s:s, s:s, s:s, s:i, s:i, s:I}", "id", plan_field_id((field_id)id),
                                        "name", info->name, "on", plan_centring(info->centring), "class",
                                        plan_class(info->class), "unit", info->unit, "instances", n, "arrays",
                                        n * field_component_count(info->components, p->sim->mesh.dim), "bytes",
                                        (json_int_t)plan_field_bytes(p, (field_id)id)));
    }
    return list;
}

static json_int_t json_count(double x)
{
    return (json_int_t)nearbyint(x);
}

static json_t *bytes_json(const plan *p)
{
    const sim_plan_info *i = &p->info;
    const double named = p->ratio * (double)(i->mpm_bytes + i->ice_bytes + i->coupling_bytes);
    return json_pack("{s:I, s:I, s:I, s:I}", "mpm", json_count(p->ratio * (double)i->mpm_bytes), "ice",
                     json_count(p->ratio * (double)i->ice_bytes), "coupling",
                     json_count(p->ratio * (double)i->coupling_bytes), "scratch", json_count(p->need.bytes - named));
}

static json_t *memory_json(const memory_need *n)
{
    return json_pack("{s:f, s:f, s:o, s:b}", "held", n->bytes, "while_writing", n->output_bytes, "available",
                     isinf(n->available) ? json_null() : json_real(n->available), "fits", n->fits);
}

static json_t *disk_json(const disk_need *n)
{
    return json_pack("{s:f, s:f, s:o, s:b}", "snapshots", n->snapshots, "bytes", n->bytes, "available",
                     isinf(n->available) ? json_null() : json_real(n->available), "fits", n->fits);
}

static json_t *mesh_json(const plan *p)
{
    json_t *list = json_array();
    for (int a = 0; a < p->sim->mesh.dim; a++) json_array_append_new(list, json_integer(json_count(plan_cells(p, a))));
    return list;
}

static json_t *plan_json(const plan *p)
{
    const sim_plan_info *i = &p->info;
    const sim *s = p->sim;
    char geometry[64];
    plan_geometry(p, geometry);
    return json_pack(
        "{s:i, s:s, s:s, s:i, s:s, s:o, s:I, s:I, s:s?, s:i, s:o, s:o, s:o, s:o, s:o, s:b, s:f, s:f, s:s, s:s, "
        "s:s, s:s, s:s}",
        "schema", 1, "deck", p->scene->path, "coupling", coupling_name(s->coupling), "dim", s->mesh.dim, "geometry",
        geometry, "mesh", mesh_json(p), "cells", json_count(p->ratio * (double)i->cells), "points",
        json_count(p->ratio * (double)i->points), "basis", s->mpm ? s->mpm->basis->name : NULL, "cell_materials",
        s->ice ? s->ice->n_materials : 0, "stages", stages_json(&s->stages), "fields", fields_json(p), "bytes",
        bytes_json(p), "memory", memory_json(&p->need), "disk", disk_json(&p->disk), "estimated", p->ratio != 1.0, "dt",
        plan_step(p), "steps", plan_steps(p), "dt_limit", i->dt_reason, "solver", s->solver_reason, "pressure",
        s->pressure_reason[0] ? s->pressure_reason
        : !s->ice             ? ""
        : s->ice->implicit    ? "implicit"
                              : "explicit",
        "substeps", s->substeps_reason, "interface", interface_in_words(s));
}

floe_status plan_print_json(const plan *p, FILE *file)
{
    context *ctx = p->sim->ctx;
    char *text;
    TRY(json_to_text(ctx, &text, plan_json(p)));
    const bool fine = fputs(text, file) >= 0;
    memory_free(ctx, &text);
    return fine ? FLOE_OK : fail(ctx, FLOE_IO, "cannot write the plan");
}
