#include "io/checkpoint/checkpoint.h"

#include "base/memory.h"
#include "floe_build.h"
#include "io/checkpoint/checkpoint_record.h"
#include "io/gather.h"
#include "io/sealed_file.h"

#include <string.h>

/* The work of writing the fields. */
typedef struct state_writer {
    const sim *s;
    hdf_file *hdf;
    point_list list[SCENE_MAX_BODIES]; /* owned */
    double *data;                      /* one number for each point or cell; owned */
} state_writer;

static floe_status write_checkpoint_array(void *user, const state_array *array)
{
    state_writer *w = user;
    if (field_describe(array->id)->centring == FIELD_POINT) {
        const point_list *list = &w->list[array->instance];
        gather_points(w->s, list, array->id, array->comp, 1, w->data);
        return hdf_write(w->hdf, array->path, HDF_DOUBLE, (hdf_shape){1, {list->n}}, w->data);
    }
    gather_cells(w->s, array->id, array->instance, array->comp, 1, w->data);
    return hdf_write(w->hdf, array->path, HDF_DOUBLE, (hdf_shape){1, {mesh_cells(&w->s->mesh)}}, w->data);
}

/* Lists the points of all bodies, and makes space for the largest array. */
static floe_status prepare_writer(state_writer *w)
{
    size_t largest = w->s->ice ? mesh_cells(&w->s->mesh) : 0;
    const int bodies = w->s->mpm ? w->s->mpm->n_bodies : 0;
    for (int b = 0; b < bodies; b++) {
        TRY(point_list_make(&w->list[b], w->s, b));
        if (w->list[b].n > largest) largest = w->list[b].n;
    }
    return memory_new(w->s->ctx, &w->data, largest, sizeof *w->data);
}

static floe_status write_state(const sim *s, hdf_file *hdf)
{
    state_writer w = {.s = s, .hdf = hdf};
    floe_status status = prepare_writer(&w);
    if (status == FLOE_OK) status = checkpoint_visit_state(s, write_checkpoint_array, &w);
    memory_free(s->ctx, &w.data);
    for (int b = 0; b < SCENE_MAX_BODIES; b++) point_list_free(s->ctx, &w.list[b]);
    return status;
}

static floe_status write_extra(const sim *s, hdf_file *hdf, const checkpoint_extra *extra)
{
    char path[128];
    double *data;
    TRY(memory_new(s->ctx, &data, extra->n * extra->components, sizeof *data));
    for (size_t i = 0; i < extra->n; i++) {
        for (size_t c = 0; c < extra->components; c++)
            data[i * extra->components + c] = extra->data[i * extra->stride + c];
    }
    checkpoint_extra_path(path, extra);
    const floe_status status = hdf_write(hdf, path, HDF_DOUBLE, (hdf_shape){2, {extra->n, extra->components}}, data);
    memory_free(s->ctx, &data);
    return status;
}

static floe_status write_manifest(const sim *s, hdf_file *hdf, const checkpoint_run *run)
{
    strbuf manifest;
    strbuf_init(&manifest, s->ctx);
    floe_status status = checkpoint_manifest(s, run, &manifest);
    if (status == FLOE_OK) status = hdf_write_text(hdf, "/manifest", strbuf_string(&manifest));
    strbuf_free(&manifest);
    return status;
}

static floe_status write_content(const sim *s, hdf_file *hdf, const checkpoint_run *run)
{
    checkpoint_record record;
    checkpoint_record_take(&record, s, run);
    TRY(hdf_attribute_text(hdf, "/", "content", "floe checkpoint"));
    TRY(hdf_attribute_text(hdf, "/", "floe_version", FLOE_VERSION));
    TRY(hdf_attribute_text(hdf, "/", "floe_git", FLOE_GIT));
    TRY(hdf_write_text(hdf, "/floe_git", FLOE_GIT));
    TRY(hdf_write_text(hdf, "/deck/resolved", run->deck));
    TRY(hdf_write_text(hdf, "/deck/identity", run->identity));
    TRY(hdf_write_text(hdf, "/sim/dt_reason", s->dt_reason ? s->dt_reason : ""));
    TRY(write_manifest(s, hdf, run));
    TRY(checkpoint_record_write(hdf, &record));
    for (int i = 0; i < run->n_extra; i++) TRY(write_extra(s, hdf, &run->extra[i]));
    return write_state(s, hdf);
}

static floe_status fill_checkpoint(const sim *s, new_file *file, const checkpoint_run *run)
{
    hdf_file hdf;
    TRY(hdf_create(&hdf, file, SEALED_HEADER));
    return hdf_finish(&hdf, write_content(s, &hdf, run));
}

floe_status checkpoint_write(const sim *s, const char *path, const checkpoint_run *run)
{
    new_file file;
    floe_status status = new_file_begin(&file, s->ctx, path);
    if (status == FLOE_OK) status = fill_checkpoint(s, &file, run);
    return sealed_finish(&file, status, SEALED_CHECKPOINT, CHECKPOINT_FORMAT, run->kept);
}

/* What HDF5 adds to each array, and to the file. */
enum { BYTES_BESIDE_ARRAY = 2048, BYTES_BESIDE_ALL = 256 * 1024 };

typedef struct size_sum {
    const sim *s;
    size_t bytes;
} size_sum;

static floe_status add_checkpoint_array(void *user, const state_array *array)
{
    size_sum *sum = user;
    const bool points = field_describe(array->id)->centring == FIELD_POINT;
    const size_t n = points ? mpm_body_points(sum->s->mpm, array->instance) : mesh_cells(&sum->s->mesh);
    sum->bytes += n * sizeof(double) + BYTES_BESIDE_ARRAY;
    return FLOE_OK;
}

size_t checkpoint_most_bytes(const sim *s, const checkpoint_run *run)
{
    size_sum sum = {s, BYTES_BESIDE_ALL};
    (void)checkpoint_visit_state(s, add_checkpoint_array, &sum);
    for (int i = 0; i < run->n_extra; i++)
        sum.bytes += run->extra[i].n * run->extra[i].components * sizeof(double) + BYTES_BESIDE_ARRAY;
    return sum.bytes + 4 * (strlen(run->deck) + strlen(run->identity));
}
