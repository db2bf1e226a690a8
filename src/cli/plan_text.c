#include "cli/plan.h"

#include "base/context.h"
#include "sim/interface.h"

#include <string.h>

const char *plan_field_id(field_id id)
{
    static const char *const name[FIELD_COUNT] = {
#define ID_NAME(id, name, centring, components, unit, class, meaning) #id,
        FIELD_LIST(ID_NAME)
#undef ID_NAME
    };
    return id < FIELD_COUNT ? name[id] : "";
}

const char *plan_centring(field_centring centring)
{
    static const char *const name[] = {"points", "nodes", "cells", "faces"};
    return name[centring];
}

const char *plan_class(field_class kind)
{
    static const char *const name[] = {"state", "fixed", "scratch", "diagnostic"};
    return name[kind];
}

uint64_t plan_field_bytes(const plan *p, field_id id)
{
    uint64_t bytes = 0;
    for (int b = 0; b < p->sim->mesh.n_blocks; b++) bytes += fields_bytes(p->sim->domain->fields[b], id, id);
    return bytes;
}

int plan_field_instances(const plan *p, field_id id)
{
    int n = 0;
    for (int i = 0; i < FIELD_MAX_INSTANCES; i++) n += fields_has(p->sim->domain->fields[0], id, i);
    return n;
}

void plan_geometry(const plan *p, char text[64])
{
    const mesh *m = &p->sim->mesh;
    const char *kind = m->geometry == MESH_AXISYMMETRIC ? " axisymmetric" : "";
    if (m->dim == 2 && !kind[0]) kind = p->scene->stress_state == STRESS_PLANE ? " plane stress" : " plane strain";
    (void)snprintf(text, 64, "%d-D%s", m->dim, kind);
}

static void print_head(const plan *p, FILE *file)
{
    const mesh *m = &p->sim->mesh;
    char geometry[64];
    plan_geometry(p, geometry);
    (void)fprintf(file, "%s as %s: %s, mesh of ", p->scene->path, coupling_name(p->sim->coupling), geometry);
    for (int a = 0; a < m->dim; a++) (void)fprintf(file, "%s%d", a ? " x " : "", m->n[a]);
    (void)fprintf(file, " cells of %g m, %zu points, %zu cells with fields\n", m->h[0], p->info.points, p->info.cells);
    if (p->sim->mpm) {
        (void)fprintf(file, "solver: %s\n", p->sim->solver_reason);
        if (interface_told(p->sim)[0]) (void)fprintf(file, "interface: %s\n", interface_told(p->sim));
        if (p->sim->substeps_reason[0]) (void)fprintf(file, "sub-steps: %s\n", p->sim->substeps_reason);
        (void)fprintf(file, "kernels of the points: %s basis, %s; %s\n", p->sim->mpm->basis->name, geometry,
                      p->scene->method.stress == STRESS_USF   ? "stress first"
                      : p->scene->method.stress == STRESS_USL ? "stress last"
                                                              : "stress last, velocities mapped again");
    }
    if (p->sim->mpm && mpm_edge_penalty(p->sim->mpm) > 0.0)
        (void)fprintf(file, "edges of solids: held, penalty %g\n", mpm_edge_penalty(p->sim->mpm));
    if (p->sim->ice) {
        (void)fprintf(file, "kernels of the cells: %s, %d material%s\n", geometry, p->sim->ice->n_materials,
                      p->sim->ice->n_materials == 1 ? "" : "s");
        if (p->sim->pressure_reason[0]) (void)fprintf(file, "pressure: %s\n", p->sim->pressure_reason);
    }
}

static void print_list(const char *what, const stage_fields *list, FILE *file)
{
    int n = 0;
    for (int k = 0; k < list->n; k++) {
        if (list->id[k] == STAGE_NONE) continue;
        (void)fprintf(file, "%s%s", n++ ? " " : what, plan_field_id((field_id)list->id[k]));
    }
    if (n > 0) (void)fprintf(file, "\n");
}

static void print_stages(const stage_list *stages, FILE *file)
{
    (void)fprintf(file, "\nstages of a step:\n");
    for (int i = 0; i < stages->n; i++) {
        (void)fprintf(file, "  %s\n", stages->record[i].name);
        print_list("      reads  ", &stages->record[i].reads, file);
        print_list("      writes ", &stages->record[i].writes, file);
    }
}

static void print_fields(const plan *p, FILE *file)
{
    (void)fprintf(file, "\n%-22s %-28s %-7s %-10s %-8s %5s %12s\n", "field", "name", "on", "class", "unit", "count",
                  "bytes");
    for (int id = 0; id < FIELD_COUNT; id++) {
        const field_info *info = field_describe((field_id)id);
        const int n = plan_field_instances(p, (field_id)id);
        if (n == 0) continue;
        (void)fprintf(file, "%-22s %-28s %-7s %-10s %-8s %5d %12llu\n", plan_field_id((field_id)id), info->name,
                      plan_centring(info->centring), plan_class(info->class), info->unit,
                      n * field_component_count(info->components, p->sim->mesh.dim),
                      (unsigned long long)plan_field_bytes(p, (field_id)id));
    }
}

floe_status plan_print_text(const plan *p, FILE *file)
{
    const sim_plan_info *i = &p->info;
    const char *unit = scene_time_unit(p->scene);
    print_head(p, file);
    print_stages(&p->sim->stages, file);
    print_fields(p, file);
    (void)fprintf(file, "\nbytes: points %llu, cells %llu, coupling %llu, scratch %llu, together %.3g MB\n",
                  (unsigned long long)i->mpm_bytes, (unsigned long long)i->ice_bytes,
                  (unsigned long long)i->coupling_bytes, (unsigned long long)i->scratch_bytes,
                  (double)(i->mpm_bytes + i->ice_bytes + i->coupling_bytes + i->scratch_bytes) / 1e6);
    (void)fprintf(file, "first step: %.4g%s, limited by %s; about %.0f steps to t = %g%s\n", i->predicted_dt, unit,
                  i->dt_reason, i->predicted_steps, p->scene->time.end, unit);
    return FLOE_OK;
}
