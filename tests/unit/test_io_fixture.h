/* A simulation made by hand for the tests of the io module: two solids and a gas as points, and three materials in
 * cells, with values that depend on the place and the point alone, never on the blocks. */
#ifndef TESTS_UNIT_TEST_IO_FIXTURE_H
#define TESTS_UNIT_TEST_IO_FIXTURE_H

#include "check.h"

#include "base/memory.h"
#include "io/file.h"
#include "io/gather.h"
#include "io/io.h"
#include "io/snapshot/snapshot.h"
#include "sim/sim.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { FIXTURE_BODIES = 2, FIXTURE_MATERIALS = 3, FIXTURE_PATH = 256 };

typedef struct fixture_spec {
    int dim;
    int cells[3];  /* along each used axis */
    int blocks[3]; /* 0: 1 */
    bool with_points, with_cells;
    bool empty; /* no points, all values 0: to be read into */
    mesh_geometry geometry;
} fixture_spec;

typedef struct fixture {
    context *ctx;
    scene *scene;
    sim sim;
    mpm mpm;
    ice ice;
} fixture;

/* A number in [0, 1) that is a function of its arguments only. */
static inline double fixture_value(uint64_t a, uint64_t b, uint64_t c)
{
    uint64_t x =
        a * 0x9e3779b97f4a7c15u ^ (b + 0x632be59bd9b4e019u) * 0xbf58476d1ce4e5b9u ^ (c + 7) * 0x94d049bb133111ebu;
    for (int i = 0; i < 3; i++) x = (x ^ (x >> 29)) * 0xbf58476d1ce4e5b9u;
    return (double)(x >> 11) / 9007199254740992.0;
}

static inline void fixture_scene(fixture *f)
{
    static const char *const material[FIXTURE_MATERIALS] = {"steel", "soft & wet", "gas"};
    static const char *const body[FIXTURE_BODIES] = {"annulus", "plug <1>"};
    check_ok(f->ctx, scene_create(&f->scene, f->ctx));
    (void)snprintf(f->scene->title, sizeof f->scene->title, "a test of \"io\" & <more>");
    f->scene->n_materials = FIXTURE_MATERIALS;
    f->scene->n_bodies = FIXTURE_BODIES;
    for (int m = 0; m < FIXTURE_MATERIALS; m++) {
        (void)snprintf(f->scene->material[m].name, SCENE_NAME, "%s", material[m]);
        f->scene->material[m].kind = m == 2 ? MATERIAL_FLUID : MATERIAL_SOLID;
    }
    for (int b = 0; b < FIXTURE_BODIES; b++) {
        (void)snprintf(f->scene->body[b].name, SCENE_NAME, "%s", body[b]);
        f->scene->body[b].material = b;
    }
    (void)snprintf(f->scene->verify.exact, SCENE_NAME, "lame");
    f->scene->thickness = 2.0;
    f->scene->reference_pressure = 1e5;
    f->scene->n_probes = 1;
    f->scene->probe[0] = (scene_probe){.name = "middle", .position = {0.55, 0.5, 0.5}};
}

static inline void fixture_add(fixture *f, field_id id, int instance)
{
    check_ok(f->ctx, domain_add(f->sim.domain, id, instance));
}

static inline void fixture_fields(fixture *f, const fixture_spec *spec)
{
    static const field_id of_points[] = {P_ID,        P_MASS,      P_VOLUME0,   P_HALF,         P_POS,
                                         P_VEL,       P_F,         P_J,         P_STRESS,       P_ENERGY,
                                         P_HISTORY_1, P_HISTORY_2, P_HISTORY_3, P_GRID_PRESSURE};
    static const field_id of_cells[] = {C_RHO, C_VEL, C_ENERGY, C_VOL, C_TEMP, C_THETA, C_SOUND};
    for (int b = 0; b < FIXTURE_BODIES && spec->with_points; b++) {
        for (size_t i = 0; i < sizeof of_points / sizeof of_points[0]; i++) fixture_add(f, of_points[i], b);
    }
    for (int r = 0; r < FIXTURE_MATERIALS && spec->with_cells; r++) {
        for (size_t i = 0; i < sizeof of_cells / sizeof of_cells[0]; i++) fixture_add(f, of_cells[i], r);
    }
    if (spec->with_cells) fixture_add(f, C_PRESSURE, 0);
}

static inline void fixture_fill_cells(fixture *f, field_id id, int instance, int comp)
{
    const mesh *m = &f->sim.mesh;
    for (int n = 0; n < m->n_blocks; n++) {
        const block *b = &m->block[n];
        double *a = field_get(f->sim.domain->fields[n], id, instance, comp);
        for (int k = 0; k < b->n[2]; k++) {
            for (int j = 0; j < b->n[1]; j++) {
                for (int i = 0; i < b->n[0]; i++) {
                    const int at = ((k + b->lo[2]) * m->n[1] + j + b->lo[1]) * m->n[0] + i + b->lo[0];
                    a[mesh_index(b, i, j, k)] =
                        fixture_value((uint64_t)id, (uint64_t)(instance * 16 + comp), (uint64_t)at);
                }
            }
        }
    }
}

/* Puts point `ordinal` of a body into the block of its cell. */
static inline void fixture_point(fixture *f, int body, int ordinal)
{
    const mesh *m = &f->sim.mesh;
    const uint64_t id = (uint64_t)body << 40 | (uint64_t)ordinal;
    double x[3] = {0};
    int cell[3] = {0};
    for (int a = 0; a < m->dim; a++) {
        x[a] = m->lower[a] + fixture_value(P_POS, (uint64_t)a, id) * (m->upper[a] - m->lower[a]);
        if (ordinal == 3) x[a] = m->upper[a]; /* the upper wall belongs to the last cell */
        cell[a] = mesh_cell_of(m, a, x[a]);
    }
    const int n = mesh_block_of(m, cell);
    fields *to = f->sim.domain->fields[n];
    const size_t i = f->mpm.points[n][body].n++;
    check_ok(f->ctx, fields_reserve_points(to, body, i + 1));
    for (int id_of = P_ID; id_of <= P_GRID_PRESSURE; id_of++) {
        if (!fields_has(to, (field_id)id_of, body)) continue;
        const int components = field_component_count(field_describe((field_id)id_of)->components, m->dim);
        for (int c = 0; c < components; c++) {
            field_get(to, (field_id)id_of, body, c)[i] = fixture_value((uint64_t)id_of, (uint64_t)c, id);
        }
    }
    field_get(to, P_ID, body, 0)[i] = (double)id;
    for (int a = 0; a < m->dim; a++) field_get(to, P_POS, body, a)[i] = x[a];
}

static inline void fixture_points(fixture *f, const fixture_spec *spec)
{
    for (int n = 0; n < f->sim.mesh.n_blocks; n++) {
        for (int b = 0; b < FIXTURE_BODIES; b++) {
            const size_t tiles = (size_t)f->sim.mesh.block[n].n_tiles + 1;
            check_ok(f->ctx, memory_new(f->ctx, &f->mpm.points[n][b].tile_start, tiles, sizeof(size_t)));
            check_ok(f->ctx, fields_reserve_points(f->sim.domain->fields[n], b, 1));
        }
    }
    /* From the last to the first, so that the order is not already that of the ids; some ordinals are missing. */
    for (int b = 0; b < FIXTURE_BODIES && !spec->empty; b++) {
        for (int i = 200 + 100 * b; i >= 0; i--) {
            if (i % 7 != 5) fixture_point(f, b, i);
        }
    }
    check_ok(f->ctx, mpm_resort(&f->mpm));
}

static inline void fixture_clocks(fixture *f)
{
    sim *s = &f->sim;
    s->time = 0.1;
    s->dt = 1.0 / 3.0;
    s->dt_reason = "wave speed, in 'steel'";
    s->steps = 1234;
    s->rejected = 5;
    s->point_updates = 1e18 / 3.0;
    s->cell_updates = 17.0;
    s->rest_since = INFINITY;
    s->at_rest = true;
    f->mpm.time = 0.1;
    f->mpm.dt = 0.2;
    f->mpm.dt_previous = 0.7;
    f->ice.time = 0.3;
    f->ice.dt = 0.4;
    for (int q = 0; q < LEDGER_QUANTITIES; q++) {
        s->ledger.initial[q] = q + 0.1;
        s->ledger.total[q] = q + 0.2;
        s->ledger.scale[q] = q + 1.0;
        s->ledger.extent[q] = q + 2.0;
        s->ledger.let_in[q][LEDGER_SOURCE] = q + 3.0;
        s->ledger.worst[q] = -0.01 * (q + 1);
        s->ledger.worst_time[q] = q + 4.0;
        for (int k = 0; k < LEDGER_KINDS; k++) s->ledger.entry[q][k] = (ledger_sum){q + k / 3.0, 1e-20 * k};
    }
    for (int c = 0; c < LEDGER_COUNTS; c++) s->ledger.count[c] = 100 + c;
    s->ledger.count[COUNT_POINTS_LOST] = s->ledger.count[COUNT_POINTS_BURNT] = 0; /* none is missing */
}

static inline void fixture_make(fixture *f, const fixture_spec *spec)
{
    *f = (fixture){.ctx = context_create()};
    check_ok(f->ctx, io_init(f->ctx));
    fixture_scene(f);
    mesh_spec m = {.dim = spec->dim, .geometry = spec->geometry};
    for (int a = 0; a < spec->dim; a++) {
        m.lower[a] = 0.25 * a;
        m.cell[a] = 0.1;
        m.upper[a] = m.lower[a] + 0.1 * spec->cells[a];
        m.blocks[a] = spec->blocks[a];
    }
    f->scene->mesh = m;
    sim *s = &f->sim;
    s->ctx = f->ctx;
    s->scene = f->scene;
    s->coupling = spec->with_cells ? (spec->with_points ? COUPLING_ICE_MPM : COUPLING_ICE) : COUPLING_MPM;
    check_ok(f->ctx, mesh_init(&s->mesh, f->ctx, &m));
    check_ok(f->ctx, domain_create(&s->domain, f->ctx, &s->mesh));
    f->mpm = (mpm){.ctx = f->ctx, .scene = f->scene, .mesh = &s->mesh, .domain = s->domain, .n_bodies = FIXTURE_BODIES};
    f->ice = (ice){
        .ctx = f->ctx, .scene = f->scene, .mesh = &s->mesh, .domain = s->domain, .n_materials = FIXTURE_MATERIALS};
    for (int b = 0; b < FIXTURE_BODIES; b++) {
        f->mpm.body[b].scene_body = b;
        f->mpm.body[b].scene_material = b;
        f->mpm.body[b].law = solid_find("j2");
    }
    for (int r = 0; r < FIXTURE_MATERIALS; r++) {
        f->ice.material[r].scene_material = r;
        f->ice.material[r].points = r < 2;
    }
    s->mpm = spec->with_points ? &f->mpm : NULL;
    s->ice = spec->with_cells ? &f->ice : NULL;
    fixture_fields(f, spec);
    if (spec->with_points) fixture_points(f, spec);
    for (int id = C_RHO; id <= C_PRESSURE && spec->with_cells && !spec->empty; id++) {
        for (int r = 0; r < FIXTURE_MATERIALS; r++) {
            if (!fields_has(s->domain->fields[0], (field_id)id, r)) continue;
            const int components = field_component_count(field_describe((field_id)id)->components, spec->dim);
            for (int c = 0; c < components; c++) fixture_fill_cells(f, (field_id)id, r, c);
        }
    }
    stage_list_init(&s->stages, f->ctx);
    s->stages.n = 2;
    s->stages.record[0] = (stage_record){.name = "points_to_nodes", .seconds = 1.5, .calls = 7};
    s->stages.record[1] = (stage_record){.name = "advect", .seconds = 0.25, .calls = 8};
    if (!spec->empty) fixture_clocks(f);
}

/* Frees everything and checks that nothing is left. */
static inline void fixture_free(fixture *f)
{
    for (int n = 0; n < f->sim.mesh.n_blocks; n++) {
        for (int b = 0; b < FIXTURE_BODIES; b++) memory_free(f->ctx, &f->mpm.points[n][b].tile_start);
    }
    stage_list_destroy(&f->sim.stages);
    domain_destroy(&f->sim.domain);
    scene_destroy(&f->scene);
    assert_int_equal(memory_read_account(f->ctx).live_bytes, 0);
    context_destroy(&f->ctx);
}

/* A folder of the test's own, made new; removed by fixture_remove_folder. */
static inline void fixture_folder(char folder[FIXTURE_PATH])
{
    const char *base = getenv("TMPDIR");
    (void)snprintf(folder, FIXTURE_PATH, "%s/floe_test_XXXXXX", base ? base : "/tmp");
    assert_non_null(mkdtemp(folder));
}

static inline void fixture_remove_folder(const char *folder)
{
    char command[4 * FIXTURE_PATH];
    (void)snprintf(command, sizeof command, "rm -rf '%s'", folder);
    assert_int_equal(system(command), 0);
}

static inline void fixture_path(char path[FIXTURE_PATH], const char *folder, const char *name)
{
    const int length = snprintf(path, FIXTURE_PATH, "%s/%s", folder, name);
    assert_true(length > 0 && length < FIXTURE_PATH);
}

/* The bytes of a file; counted memory. */
static inline char *fixture_read(context *ctx, const char *path, size_t *size)
{
    char *data;
    check_ok(ctx, file_read(ctx, path, &data, size));
    return data;
}

static inline void fixture_same_files(context *ctx, const char *a, const char *b)
{
    size_t n, m;
    char *x = fixture_read(ctx, a, &n);
    char *y = fixture_read(ctx, b, &m);
    assert_int_equal(n, m);
    assert_memory_equal(x, y, n);
    memory_free(ctx, &x);
    memory_free(ctx, &y);
}

/* A series of n snapshots, 0.1 apart. */
static inline void fixture_write_times(fixture *f, const char *folder, int n)
{
    snapshot_series *series;
    check_ok(f->ctx, snapshot_open(&series, f->ctx, folder, "floe: 1\n", -INFINITY));
    for (int i = 0; i < n; i++) {
        f->sim.time = 0.1 * i;
        check_ok(f->ctx, snapshot_write(series, &f->sim));
    }
    check_close(snapshot_last_time(series), 0.1 * (n - 1), 0.0);
    snapshot_close(&series);
    snapshot_close(&series);
}

#endif
