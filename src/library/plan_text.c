#include "library/plan.h"

#include "base/context.h"
#include "base/text.h"
#include "base/wrapped.h"
#include "sim/interface.h"

#include <math.h>
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
    return (uint64_t)((double)bytes * p->ratio);
}

/* Steps that are not fixed become shorter with the cells. */
double plan_step(const plan *p)
{
    return isnan(p->scene->time.fixed_step) ? p->info.predicted_dt / p->coarser : p->info.predicted_dt;
}

double plan_steps(const plan *p)
{
    return p->info.predicted_steps * (p->info.predicted_dt / plan_step(p));
}

double plan_cells(const plan *p, int axis)
{
    const mesh *m = &p->sim->mesh;
    return p->ratio == 1.0 ? m->n[axis] : nearbyint((m->upper[axis] - m->lower[axis]) / (m->h[axis] / p->coarser));
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
    char cells[64] = "";
    for (int a = 0; a < m->dim; a++) text_add(cells, sizeof cells, "%s%.0f", a ? " x " : "", plan_cells(p, a));
    wrapped_printf(file, "%s as %s: %s, mesh of %s cells of %g m, %.9g points, %.9g cells with fields\n",
                   p->scene->path, coupling_name(p->sim->coupling), geometry, cells, m->h[0] / p->coarser,
                   nearbyint(p->ratio * (double)p->info.points), nearbyint(p->ratio * (double)p->info.cells));
    if (p->ratio != 1.0)
        wrapped_printf(file, "described from the same scene on %zu cells; numbers and bytes are estimates\n",
                       mesh_cells(m));
    if (p->sim->mpm) {
        wrapped_printf(file, "solver: %s\n", p->sim->solver_reason);
        if (interface_in_words(p->sim)[0]) wrapped_printf(file, "interface: %s\n", interface_in_words(p->sim));
        if (p->sim->substeps_reason[0]) wrapped_printf(file, "sub-steps: %s\n", p->sim->substeps_reason);
        wrapped_printf(file, "kernels of the points: %s basis, %s; %s\n", p->sim->mpm->basis->name, geometry,
                       p->scene->method.stress == STRESS_USF   ? "stress first"
                       : p->scene->method.stress == STRESS_USL ? "stress last"
                                                               : "stress last, velocities mapped again");
    }
    if (p->sim->mpm && mpm_edge_penalty(p->sim->mpm) > 0.0)
        (void)fprintf(file, "edges of solids: ghost penalty %g\n", mpm_edge_penalty(p->sim->mpm));
    if (p->sim->ice) {
        (void)fprintf(file, "kernels of the cells: %s, %d material%s\n", geometry, p->sim->ice->n_materials,
                      p->sim->ice->n_materials == 1 ? "" : "s");
        if (p->sim->pressure_reason[0]) wrapped_printf(file, "pressure: %s\n", p->sim->pressure_reason);
    }
}

static void print_list(const char *what, const stage_fields *list, FILE *file)
{
    char text[4096] = "";
    for (int k = 0; k < list->n; k++) {
        if (list->id[k] == STAGE_NONE) continue;
        text_add(text, sizeof text, "%s%s", text[0] ? " " : what, plan_field_id((field_id)list->id[k]));
    }
    if (text[0]) wrapped_printf(file, "%s\n", text);
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

/* 80 columns. */
#define FIELD_LINE "%-19s %-26s %-6s %-7s %-7s %2s %7s\n"

/* "9288", "158.7M": in seven columns. */
static void short_bytes(double bytes, char text[16])
{
    if (bytes < 1e7)
        (void)snprintf(text, 16, "%.0f", bytes);
    else if (bytes < 1e10)
        (void)snprintf(text, 16, "%.4gM", bytes / 1e6);
    else
        (void)snprintf(text, 16, "%.6gG", nearbyint(bytes / 1e8) / 10.0);
}

static void print_planned_fields(const plan *p, FILE *file)
{
    (void)fprintf(file, "\n" FIELD_LINE, "field", "name", "on", "class", "unit", "of", "bytes");
    for (int id = 0; id < FIELD_COUNT; id++) {
        const field_info *info = field_describe((field_id)id);
        const int n = plan_field_instances(p, (field_id)id);
        if (n == 0) continue;
        char count[16], bytes[16];
        (void)snprintf(count, sizeof count, "%d", n * field_component_count(info->components, p->sim->mesh.dim));
        short_bytes((double)plan_field_bytes(p, (field_id)id), bytes);
        (void)fprintf(file, FIELD_LINE, plan_field_id((field_id)id), info->name, plan_centring(info->centring),
                      plan_class(info->class), info->unit, count, bytes);
    }
}

static void print_memory(const plan *p, FILE *file)
{
    const memory_need *n = &p->need;
    const double gigabyte = 1e9;
    char machine[64] = "what this machine has is not known";
    if (!isinf(n->available))
        (void)snprintf(machine, sizeof machine, "this machine has %.3g GB available: %s", n->available / gigabyte,
                       n->fits ? "it fits" : "it does not fit");
    wrapped_printf(file, "memory: %.3g GB, and %.3g GB more while an output is written; %s\n", n->bytes / gigabyte,
                   n->output_bytes / gigabyte, machine);
    if (!n->fits)
        (void)fprintf(file, "        %.3g cells would fit: domain.cell %.2g or more\n", n->fitting_cells,
                      p->sim->mesh.h[0] / p->coarser *
                          pow(n->cells / fmax(1.0, n->fitting_cells), 1.0 / p->scene->mesh.dim));
}

static void print_disk(const disk_need *n, FILE *file)
{
    const double gigabyte = 1e9;
    char here[64] = "what is free here is not known";
    if (!isinf(n->available))
        (void)snprintf(here, sizeof here, "%.3g GB are free here: %s", n->available / gigabyte,
                       n->fits ? "they fit" : "they do not fit");
    wrapped_printf(file, "disk: about %.3g GB, of %.0f snapshots and three checkpoints; %s\n", n->bytes / gigabyte,
                   n->snapshots, here);
}

floe_status plan_print_text(const plan *p, FILE *file)
{
    const sim_plan_info *i = &p->info;
    const char *unit = scene_time_unit(p->scene);
    print_head(p, file);
    print_stages(&p->sim->stages, file);
    print_planned_fields(p, file);
    wrapped_printf(
        file, "\nbytes: points %.0f, cells %.0f, coupling %.0f, scratch %.0f, together %.3g MB\n",
        p->ratio * (double)i->mpm_bytes, p->ratio * (double)i->ice_bytes, p->ratio * (double)i->coupling_bytes,
        p->need.bytes - p->ratio * (double)(i->mpm_bytes + i->ice_bytes + i->coupling_bytes), p->need.bytes / 1e6);
    print_memory(p, file);
    print_disk(&p->disk, file);
    wrapped_printf(file, "first step: %.4g%s, limited by %s; about %.0f steps to t = %g%s\n", plan_step(p), unit,
                   i->dt_reason, plan_steps(p), p->scene->time.end, unit);
    return FLOE_OK;
}
