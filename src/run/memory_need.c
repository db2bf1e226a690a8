#include "run/memory_need.h"

#include "base/machine.h"
#include "base/memory.h"

#include <math.h>

/* Cells of the finer coarse mesh. */
static const double enough_cells = 2e4;

double memory_cells(const mesh_spec *m)
{
    double cells = 1.0;
    for (int a = 0; a < m->dim; a++) cells *= nearbyint((m->upper[a] - m->lower[a]) / m->cell[a]);
    return cells;
}

/* Sets the scene up on a mesh of about `cells` cells; it has that mesh until coarse_end, which is called in any case. */
static floe_status coarse_begin(coarse_setup *c, scene *s, double cells)
{
    mesh_spec *m = &s->mesh;
    const double own = memory_cells(m), coarser = pow(own / cells, 1.0 / m->dim);
    *c = (coarse_setup){.setup.scene = s};
    for (int a = 0; a < 3; a++) c->cell[a] = m->cell[a];
    for (int a = 0; a < m->dim; a++) {
        const double length = m->upper[a] - m->lower[a];
        m->cell[a] = length / fmax(4.0, nearbyint(length / (coarser * m->cell[a])));
    }
    c->cells = memory_cells(m);
    c->ratio = own / c->cells;
    c->coarser = m->cell[0] / c->cell[0];
    return setup_begin(&c->setup, s);
}

void coarse_end(coarse_setup *c)
{
    scene *s = c->setup.scene;
    if (!s) return;
    setup_end(&c->setup);
    for (int a = 0; a < 3; a++) s->mesh.cell[a] = c->cell[a];
    *c = (coarse_setup){0};
}

/* Bytes for each point or cell of what an output gathers before it writes it (io/gather): a point's place in the list of its body,
 * a number, and in a snapshot a vector with a number beside it. */
enum { LISTED = 16, NUMBER = 8, VECTOR = 24 };

/* Bytes beside the fields while an output is written: of a snapshot, which takes one body at a time, or of a checkpoint, which
 * lists all of them. */
static double output_bytes_of(const sim *s)
{
    double all = 0.0, largest = 0.0;
    const double cells = s->ice ? (double)mesh_cells(&s->mesh) : 0.0;
    for (int body = 0; s->mpm && body < s->mpm->n_bodies; ++body) {
        const double points = (double)mpm_body_points(s->mpm, body);
        all += points;
        largest = fmax(largest, points);
    }
    const double snapshot = fmax((VECTOR + NUMBER) * cells, (LISTED + VECTOR + NUMBER) * largest);
    return fmax(snapshot, LISTED * all + NUMBER * fmax(largest, cells));
}

/* Bytes of the state and of what is fixed. */
static double written_bytes_of(const sim *s)
{
    double bytes = 0.0;
    for (int id = 0; id < FIELD_COUNT; id++) {
        const field_class kind = field_describe((field_id)id)->class;
        const double copies = kind == FIELD_STATE ? 2.0 : 1.0;
        if (kind != FIELD_STATE && kind != FIELD_FIXED) continue;
        for (int b = 0; b < s->mesh.n_blocks; b++)
            bytes += (double)fields_bytes(s->domain->fields[b], (field_id)id, (field_id)id) / copies;
    }
    return bytes;
}

static void compare_with_machine(memory_need *out)
{
    out->available = machine_memory_available();
    out->fits = out->bytes + out->output_bytes <= out->available;
}

void memory_need_of(const sim *s, memory_need *out)
{
    *out = (memory_need){.cells = (double)mesh_cells(&s->mesh)};
    out->bytes = (double)(memory_read_account(s->ctx).live_bytes - s->bytes_before);
    out->written_bytes = written_bytes_of(s);
    out->output_bytes = output_bytes_of(s);
    compare_with_machine(out);
    out->fitting_cells = out->cells * out->available / (out->bytes + out->output_bytes);
}

/* One of the two coarse scenes, and what it holds. */
static floe_status measure_coarse_scene(coarse_setup *c, scene *s, double cells, memory_need *out)
{
    TRY(coarse_begin(c, s, cells));
    memory_need_of(c->setup.sim, out);
    return FLOE_OK;
}

floe_status memory_need_estimate(scene *s, coarse_setup *c, memory_need *out)
{
    coarse_setup half;
    memory_need less = {0}, more;
    const double own = memory_cells(&s->mesh);
    const floe_status coarsest = measure_coarse_scene(&half, s, enough_cells / pow(2.0, s->mesh.dim), &less);
    coarse_end(&half);
    *c = (coarse_setup){0};
    if (coarsest != FLOE_OK) {
        less = (memory_need){0}; /* all of it goes with the cells, then */
        context_clear(s->ctx);
    }
    TRY(measure_coarse_scene(c, s, enough_cells, &more));
    const double slope = (more.bytes - less.bytes) / (more.cells - less.cells);
    const double constant = more.bytes - slope * more.cells;
    *out = (memory_need){.cells = own, .bytes = constant + slope * own};
    out->written_bytes = more.written_bytes * (own / more.cells);
    out->output_bytes = more.output_bytes * (own / more.cells);
    compare_with_machine(out);
    out->fitting_cells = fmax(0.0, (out->available - constant) / (slope + more.output_bytes / more.cells));
    return FLOE_OK;
}

static floe_status refuse_for_memory(const scene *s, const memory_need *need)
{
    const double gigabyte = 1e9, cell = s->mesh.cell[0], fitting = fmax(1.0, need->fitting_cells);
    return fail_key(
        s->ctx, KEY("domain", "cell"),
        "%g: its %.3g cells need about %.3g GB and %.3g GB more while an output is written, and this machine has "
        "%.3g GB available: take a cell of %.2g or more, or a machine with that memory (`floe plan` tells what it "
        "is needed for)",
        cell, need->cells, need->bytes / gigabyte, need->output_bytes / gigabyte, need->available / gigabyte,
        cell * pow(need->cells / fitting, 1.0 / s->mesh.dim));
}

floe_status memory_refuse(scene *s, memory_need *out)
{
    static const double plainly = 1.5;
    coarse_setup c = {0};
    memory_need need = {0};
    if (out) *out = need;
    if (!(memory_cells(&s->mesh) > RUN_READY_CELLS)) return FLOE_OK;
    const floe_status status = memory_need_estimate(s, &c, &need);
    coarse_end(&c);
    if (status != FLOE_OK) {
        context_clear(s->ctx); /* what is wrong with the coarse scene may be right with the fine one */
        return FLOE_OK;
    }
    if (out) *out = need;
    return need.bytes > plainly * need.available ? refuse_for_memory(s, &need) : FLOE_OK;
}
