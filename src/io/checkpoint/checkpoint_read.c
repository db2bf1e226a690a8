#include "base/memory.h"
#include "floe_build.h"
#include "io/checkpoint/checkpoint.h"
#include "io/checkpoint/checkpoint_record.h"
#include "io/gather.h"
#include "io/sealed_file.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

/* The points of a body in a checkpoint, in the order of their ids. */
typedef struct incoming {
    size_t n;
    unsigned char *block;             /* where each belongs; owned */
    size_t in_block[MESH_MAX_BLOCKS]; /* how many each block gets */
} incoming;

/* The work of reading the fields. */
typedef struct state_reader {
    sim *s;
    hdf_file *hdf;
    const checkpoint_record *record;
    incoming body[SCENE_MAX_BODIES];
    double *data;            /* one number for each point or cell; owned */
    size_t reserved;         /* numbers that data holds */
    double *x[MESH_MAX_DIM]; /* owned; while places are found */
} state_reader;

_Static_assert(MESH_MAX_BLOCKS <= 256, "a block's number must fit into incoming.block");

static void point_path(char path[128], int body, field_id id, int comp)
{
    (void)snprintf(path, 128, "/points/%d/%s_%d", body, field_describe(id)->name, comp);
}

static floe_status reserve_values(state_reader *r, size_t n)
{
    if (r->data && n <= r->reserved) return FLOE_OK;
    TRY(memory_resize(r->s->ctx, &r->data, n, sizeof *r->data));
    r->reserved = n;
    return FLOE_OK;
}

/* How many numbers an array must have. */
static size_t expected_length(const state_reader *r, const state_array *array)
{
    const bool points = field_describe(array->id)->centring == FIELD_POINT;
    return points ? r->body[array->instance].n : mesh_cells(&r->s->mesh);
}

/* What the values of a field must be beside finite. */
static const struct bounds {
    field_id id;
    double least, most;
    bool above; /* more than the least */
    const char *words;
} bounds[] = {{P_MASS, 0.0, INFINITY, true, "> 0"},    {P_VOLUME0, 0.0, INFINITY, true, "> 0"},
              {P_SHARE, 0.0, 1.0, true, "> 0, <= 1"},  {P_J, 0.0, INFINITY, true, "> 0"},
              {P_HALF, 0.0, INFINITY, false, ">= 0"},  {P_BOX, 0.0, INFINITY, false, ">= 0"},
              {C_RHO, 0.0, INFINITY, false, ">= 0"},   {C_VOL, 0.0, INFINITY, false, ">= 0"},
              {C_OPEN, 0.0, 1.0, false, "from 0 to 1"}};

static const struct bounds *bounds_of(field_id id)
{
    static const struct bounds finite = {.least = -INFINITY, .most = INFINITY, .words = "finite"};
    for (size_t i = 0; i < sizeof bounds / sizeof bounds[0]; i++)
        if (bounds[i].id == id) return &bounds[i];
    return &finite;
}

static floe_status check_values(const state_reader *r, const state_array *array, size_t n)
{
    const struct bounds *b = bounds_of(array->id);
    for (size_t i = 0; i < n; i++) {
        const double x = r->data[i];
        if (isfinite(x) && (b->above ? x > b->least : x >= b->least) && x <= b->most) continue;
        return fail(r->s->ctx, FLOE_IO, "'%s': '%s' has %g at place %zu, must be %s", r->hdf->name, array->path, x, i,
                    b->words);
    }
    return FLOE_OK;
}

static floe_status check_array(void *user, const state_array *array)
{
    state_reader *r = user;
    hdf_type type;
    hdf_shape has;
    const size_t n = expected_length(r, array);
    TRY(hdf_describe(r->hdf, array->path, &type, &has));
    if (type == HDF_DOUBLE && has.rank == 1 && has.extent[0] == n) {
        TRY(hdf_read(r->hdf, array->path, HDF_DOUBLE, (hdf_shape){1, {n}}, r->data));
        return check_values(r, array, n);
    }
    return fail(r->s->ctx, FLOE_IO, "'%s': '%s' should have %zu numbers, but has %zu", r->hdf->name, array->path, n,
                hdf_count(has));
}

/* Ids rise strictly: no point is there twice. */
static floe_status check_ids(state_reader *r, int body, size_t n)
{
    char path[128];
    point_path(path, body, P_ID, 0);
    TRY(hdf_read(r->hdf, path, HDF_DOUBLE, (hdf_shape){1, {n}}, r->data));
    double last = -1.0;
    for (size_t i = 0; i < n; i++) {
        const double id = r->data[i];
        if (!(id > last && id < 9007199254740992.0 && id == floor(id))) {
            return fail(r->s->ctx, FLOE_IO, "'%s': point %zu of body %d has the id %.17g, after %.17g", r->hdf->name, i,
                        body, id, last);
        }
        last = id;
    }
    return FLOE_OK;
}

/* The block of a position; false if it lies outside the mesh or is no number. */
static bool find_block(const state_reader *r, size_t i, int *home)
{
    const mesh *m = &r->s->mesh;
    int cell[MESH_MAX_DIM] = {0};
    for (int a = 0; a < m->dim; a++) {
        const double x = r->x[a][i];
        if (!(x >= m->lower[a] && x <= m->upper[a])) return false;
        cell[a] = mesh_cell_of(m, a, x);
        if (cell[a] < 0 || cell[a] >= m->n[a]) return false;
    }
    *home = mesh_block_of(m, cell);
    return true;
}

static floe_status find_places(state_reader *r, int body)
{
    incoming *in = &r->body[body];
    for (size_t i = 0; i < in->n; i++) {
        int home = 0;
        if (!find_block(r, i, &home)) {
            return fail(r->s->ctx, FLOE_IO, "'%s': point %zu of body %d lies outside the mesh, at x = %g", r->hdf->name,
                        i, body, r->x[0][i]);
        }
        in->block[i] = (unsigned char)home;
        in->in_block[home]++;
    }
    return FLOE_OK;
}

static floe_status read_positions(state_reader *r, int body)
{
    const size_t n = r->body[body].n;
    for (int a = 0; a < r->s->mesh.dim; a++) {
        char path[128];
        point_path(path, body, P_POS, a);
        TRY(memory_resize(r->s->ctx, &r->x[a], n, sizeof *r->x[a]));
        TRY(hdf_read(r->hdf, path, HDF_DOUBLE, (hdf_shape){1, {n}}, r->x[a]));
    }
    return find_places(r, body);
}

static floe_status check_body(state_reader *r, int body)
{
    char path[128];
    hdf_type type;
    hdf_shape has;
    point_path(path, body, P_ID, 0);
    TRY(hdf_describe(r->hdf, path, &type, &has));
    if (type != HDF_DOUBLE || has.rank != 1 || has.extent[0] > UINT32_MAX) {
        return fail(r->s->ctx, FLOE_IO, "'%s': '%s' is not a list of ids", r->hdf->name, path);
    }
    const size_t n = has.extent[0];
    r->body[body].n = n;
    TRY(reserve_values(r, n));
    TRY(memory_new(r->s->ctx, &r->body[body].block, n, 1));
    TRY(check_ids(r, body, n));
    return read_positions(r, body);
}

/* Of the points that the scene was made with none is missing but those that the run has counted as lost. */
static floe_status check_points(const state_reader *r)
{
    const size_t seeded = r->s->mpm ? mpm_count(r->s->mpm) : 0;
    const int64_t *count = r->record->ledger_count;
    const int64_t gone = count[COUNT_POINTS_LOST] + count[COUNT_POINTS_BURNT];
    size_t n = 0;
    for (int b = 0; r->s->mpm && b < r->s->mpm->n_bodies; b++) n += r->body[b].n;
    if (seeded == 0 || (gone >= 0 && n <= seeded && seeded - n == (size_t)gone)) return FLOE_OK;
    return fail(r->s->ctx, FLOE_IO,
                "'%s': '/points' has %zu points of the %zu that the scene starts with, where '/ledger/count' knows of "
                "%" PRId64 " that were lost or burnt",
                r->hdf->name, n, seeded, gone);
}

/* All that can be wrong is found here, before the simulation is changed. */
static floe_status check_state(state_reader *r)
{
    const int bodies = r->s->mpm ? r->s->mpm->n_bodies : 0;
    for (int b = 0; b < bodies; b++) TRY(check_body(r, b));
    TRY(check_points(r));
    if (r->s->ice) TRY(reserve_values(r, mesh_cells(&r->s->mesh)));
    return checkpoint_visit_state(r->s, check_array, r);
}

static floe_status reserve_points(state_reader *r)
{
    const sim *s = r->s;
    const int bodies = s->mpm ? s->mpm->n_bodies : 0;
    for (int body = 0; body < bodies; body++) {
        for (int b = 0; b < s->mesh.n_blocks; b++) {
            TRY(fields_reserve_points(s->domain->fields[b], body, r->body[body].in_block[b]));
        }
    }
    return FLOE_OK;
}

static void scatter_points(const state_reader *r, const state_array *array)
{
    const incoming *in = &r->body[array->instance];
    double *to[MESH_MAX_BLOCKS];
    for (int b = 0; b < r->s->mesh.n_blocks; b++) {
        to[b] = field_get(r->s->domain->fields[b], array->id, array->instance, array->comp);
    }
    for (size_t i = 0; i < in->n; i++) *to[in->block[i]]++ = r->data[i];
}

static floe_status read_array(void *user, const state_array *array)
{
    state_reader *r = user;
    TRY(hdf_read(r->hdf, array->path, HDF_DOUBLE, (hdf_shape){1, {expected_length(r, array)}}, r->data));
    if (field_describe(array->id)->centring == FIELD_POINT) {
        scatter_points(r, array);
    } else {
        scatter_cells(r->s, array->id, array->instance, array->comp, r->data);
    }
    return FLOE_OK;
}

static void set_counts(state_reader *r)
{
    mpm *points = r->s->mpm;
    const int bodies = points ? points->n_bodies : 0;
    for (int body = 0; body < bodies; body++) {
        for (int b = 0; b < r->s->mesh.n_blocks; b++) points->points[b][body].n = r->body[body].in_block[b];
    }
}

static floe_status read_state(state_reader *r)
{
    TRY(check_state(r));
    TRY(reserve_points(r));
    TRY(checkpoint_visit_state(r->s, read_array, r));
    set_counts(r);
    return FLOE_OK;
}

static void free_reader(state_reader *r)
{
    context *ctx = r->s->ctx;
    for (int a = 0; a < MESH_MAX_DIM; a++) memory_free(ctx, &r->x[a]);
    for (int b = 0; b < SCENE_MAX_BODIES; b++) memory_free(ctx, &r->body[b].block);
    memory_free(ctx, &r->data);
}

/* Compares a text of the file with ours. */
static floe_status compare_text(hdf_file *hdf, const char *dataset, const char *what, const char *here)
{
    char *text;
    TRY(hdf_read_text(hdf, dataset, &text));
    const floe_status status = checkpoint_compare(hdf->ctx, hdf->name, what, text, here);
    memory_free(hdf->ctx, &text);
    return status;
}

static floe_status compare_manifest(const sim *s, hdf_file *hdf, const checkpoint_run *run)
{
    strbuf manifest;
    strbuf_init(&manifest, s->ctx);
    floe_status status = checkpoint_manifest(s, run, &manifest);
    if (status == FLOE_OK) status = compare_text(hdf, "/manifest", "scene", strbuf_string(&manifest));
    strbuf_free(&manifest);
    return status;
}

/* Another build of the same version may round differently; that is the user's to judge. */
static floe_status compare_build(hdf_file *hdf)
{
    char *git;
    TRY(hdf_read_text(hdf, "/floe_git", &git));
    if (strcmp(git, FLOE_GIT) != 0) {
        context_log(hdf->ctx, LOG_WARNING, "'%s' was written by build %s, this is %s: the last bits may differ",
                    hdf->name, git, FLOE_GIT);
    }
    memory_free(hdf->ctx, &git);
    return FLOE_OK;
}

static floe_status read_reason(hdf_file *hdf, char reason[CHECKPOINT_REASON])
{
    char *text;
    TRY(hdf_read_text(hdf, "/sim/dt_reason", &text));
    (void)snprintf(reason, CHECKPOINT_REASON, "%s", text);
    memory_free(hdf->ctx, &text);
    return FLOE_OK;
}

/* Reads an extra array; its extent was compared with the manifest. */
static floe_status read_extra(hdf_file *hdf, const checkpoint_extra *extra)
{
    char path[128];
    double *data;
    TRY(memory_new(hdf->ctx, &data, extra->n * extra->components, sizeof *data));
    checkpoint_extra_path(path, extra);
    floe_status status = hdf_read(hdf, path, HDF_DOUBLE, (hdf_shape){2, {extra->n, extra->components}}, data);
    for (size_t i = 0; i < extra->n && status == FLOE_OK; i++) {
        for (size_t c = 0; c < extra->components; c++) {
            const double x = data[i * extra->components + c];
            if (!isfinite(x)) {
                status =
                    fail(hdf->ctx, FLOE_IO, "'%s': '%s' has %g at place %zu, must be finite", hdf->name, path, x, i);
                break;
            }
            extra->data[i * extra->stride + c] = x;
        }
    }
    memory_free(hdf->ctx, &data);
    return status;
}

static floe_status read_checkpoint_state(sim *s, hdf_file *hdf, checkpoint_run *run)
{
    checkpoint_record record = {0};
    state_reader reader = {.s = s, .hdf = hdf, .record = &record};
    TRY(compare_build(hdf));
    TRY(compare_text(hdf, "/deck/identity", "deck", run->identity));
    TRY(compare_manifest(s, hdf, run));
    TRY(checkpoint_record_read(hdf, &record));
    TRY(read_reason(hdf, run->dt_reason));
    const floe_status status = read_state(&reader);
    free_reader(&reader);
    TRY(status);
    for (int i = 0; i < run->n_extra; i++) TRY(read_extra(hdf, &run->extra[i]));
    checkpoint_record_put(&record, s, run);
    s->dt_reason = run->dt_reason;
    return s->mpm ? mpm_resort(s->mpm) : FLOE_OK;
}

floe_status checkpoint_decode(sim *s, const char *name, const void *image, size_t size, checkpoint_run *run)
{
    hdf_file hdf;
    floe_status status = hdf_open(&hdf, s->ctx, name, image, size);
    if (status == FLOE_OK) status = read_checkpoint_state(s, &hdf, run);
    hdf_close(&hdf);
    return status;
}

floe_status checkpoint_read(sim *s, const char *path, checkpoint_run *run)
{
    sealed_file file;
    TRY(sealed_read(s->ctx, path, SEALED_CHECKPOINT, CHECKPOINT_FORMAT, true, &file));
    const floe_status status = checkpoint_decode(s, path, file.image, file.size, run);
    sealed_free(s->ctx, &file);
    return status;
}
