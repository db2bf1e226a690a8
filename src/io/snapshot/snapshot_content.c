#include "io/snapshot/snapshot_content.h"

#include "base/memory.h"
#include "io/gather.h"
#include "io/output_field.h"
#include "io/xdmf.h"

#include <math.h>
#include <string.h>

enum { PATH_SIZE = 2 * NAME_SIZE + 16 };

/* The work of writing one snapshot. */
typedef struct writer {
    const sim *s;
    hdf_file *hdf;
    strbuf *page;
    const char *file;
    char group[NAME_SIZE + 16]; /* "/cells" or "/points/<body>" */
    bool on_points;
    const point_list *points; /* of the body that is being written */
    double *data;             /* three numbers for each point or cell; owned */
} writer;

/* What one array is. */
typedef struct array_spec {
    const char *name, *unit, *meaning;
    bool vector, integer;
} array_spec;

static hdf_shape shape_of(const writer *w, bool vector)
{
    const mesh *m = &w->s->mesh;
    hdf_shape extent = {0};
    if (w->on_points) {
        extent.extent[extent.rank++] = w->points->n;
    } else {
        extent.extent[extent.rank++] = (size_t)m->n[2];
        extent.extent[extent.rank++] = (size_t)m->n[1];
        extent.extent[extent.rank++] = (size_t)m->n[0];
    }
    if (vector) extent.extent[extent.rank++] = 3;
    return extent;
}

/* The array of w->data (or of `integers`) as a dataset with its attributes; *out describes it to XDMF, `path` keeps its
 * name. */
static floe_status write_snapshot_array(writer *w, const array_spec *spec, const int64_t *integers,
                                        char path[PATH_SIZE], hdf_shape *extent, xdmf_array *out)
{
    const char *unit = output_unit(w->s, spec->unit);
    (void)snprintf(path, PATH_SIZE, "%s/%s", w->group, spec->name);
    *extent = shape_of(w, spec->vector);
    const void *data = spec->integer ? (const void *)integers : (const void *)w->data;
    TRY(hdf_write(w->hdf, path, spec->integer ? HDF_INT64 : HDF_DOUBLE, *extent, data));
    TRY(hdf_attribute_text(w->hdf, path, "unit", unit));
    TRY(hdf_attribute_text(w->hdf, path, "meaning", spec->meaning));
    *out = (xdmf_array){.file = w->file,
                        .path = path,
                        .name = spec->name,
                        .unit = unit,
                        .meaning = spec->meaning,
                        .on_points = w->on_points,
                        .vector = spec->vector,
                        .integer = spec->integer,
                        .rank = extent->rank,
                        .extent = extent->extent};
    return FLOE_OK;
}

/* Writes w->data and shows it as an attribute of the grid. */
static floe_status add_snapshot_array(writer *w, const array_spec *spec)
{
    char path[PATH_SIZE];
    hdf_shape extent;
    xdmf_array array;
    TRY(write_snapshot_array(w, spec, NULL, path, &extent, &array));
    xdmf_add(w->page, &array);
    return w->page->status;
}

static size_t count_entries(const writer *w)
{
    return w->on_points ? w->points->n : mesh_cells(&w->s->mesh);
}

static void gather_values(const writer *w, field_id id, int instance, int comp, size_t stride, double *to)
{
    if (w->on_points) {
        gather_points(w->s, w->points, id, comp, stride, to);
    } else {
        gather_cells(w->s, id, instance, comp, stride, to);
    }
}

/* A vector in w->data: three numbers an entry, those beyond the scene's dimension 0. */
static void gather_vector(writer *w, field_id id, int instance)
{
    memset(w->data, 0, 3 * count_entries(w) * sizeof *w->data);
    for (int c = 0; c < w->s->mesh.dim; c++) gather_values(w, id, instance, c, 3, w->data + c);
}

/* Beyond a membrane a gas has no pressure: what stands there is lent to it for differences (ice_cut.c). */
static floe_status mask_closed(writer *w, int instance, double *data)
{
    const size_t n = count_entries(w);
    double *open;
    if (!fields_has(w->s->domain->fields[0], C_OPEN, instance)) return FLOE_OK;
    TRY(memory_new(w->s->ctx, &open, n, sizeof *open));
    gather_values(w, C_OPEN, instance, 0, 1, open);
    for (size_t i = 0; i < n; i++) data[i] = open[i] > 0.0 ? data[i] : 0.0;
    memory_free(w->s->ctx, &open);
    return FLOE_OK;
}

/* Masses and volumes are kept per metre of depth or per radian, and written whole. */
static floe_status add_field(void *user, const output_field *field)
{
    writer *w = user;
    const bool vector = field_describe(field->id)->components == FIELD_VECTOR;
    if (field->id == P_ID || field->id == P_POS) return FLOE_OK; /* written apart */
    if (vector)
        gather_vector(w, field->id, field->instance);
    else
        gather_values(w, field->id, field->instance, field->comp, 1, w->data);
    if (field->id == C_PRESSURE) TRY(mask_closed(w, field->instance, w->data));
    const size_t numbers = (vector ? 3 : 1) * count_entries(w);
    for (size_t i = 0; i < numbers && field->scale != 1.0; i++) w->data[i] *= field->scale;
    return add_snapshot_array(
        w, &(array_spec){.name = field->name, .unit = field->unit, .meaning = field->meaning, .vector = vector});
}

static floe_status write_cells(writer *w)
{
    const mesh *m = &w->s->mesh;
    const int64_t cells[] = {m->n[0], m->n[1], m->n[2]};
    (void)snprintf(w->group, sizeof w->group, "/cells");
    w->on_points = false;
    xdmf_begin_cells(w->page, m);
    TRY(output_fields_of_cells(w->s, add_field, w));
    xdmf_end(w->page);
    if (!hdf_has(w->hdf, "/cells")) return FLOE_OK;
    TRY(hdf_attribute(w->hdf, "/cells", "lower", HDF_DOUBLE, m->dim, m->lower));
    TRY(hdf_attribute(w->hdf, "/cells", "spacing", HDF_DOUBLE, m->dim, m->h));
    TRY(hdf_attribute(w->hdf, "/cells", "cells", HDF_INT64, m->dim, cells));
    TRY(hdf_attribute_text(w->hdf, "/cells", "unit", output_unit(w->s, "m")));
    return hdf_attribute_text(w->hdf, "/cells", "geometry",
                              m->geometry == MESH_AXISYMMETRIC ? "axisymmetric" : "cartesian");
}

/* What follows from stress and position, for the viewer's sake: from stress xx yy zz xy yz zx and place of a point. */
typedef double derived_value(const sim *s, const double stress[6], const double x[3]);

/* Absolute pressure: stress is kept gauge to the reference pressure. */
static double pressure_of(const sim *s, const double t[6], const double x[3])
{
    (void)x;
    return s->scene->reference_pressure - (t[0] + t[1] + t[2]) / 3.0;
}

static double von_mises_of(const sim *s, const double t[6], const double x[3])
{
    (void)s, (void)x;
    const double a = t[0] - t[1], b = t[1] - t[2], c = t[2] - t[0];
    return sqrt(0.5 * (a * a + b * b + c * c) + 3.0 * (t[3] * t[3] + t[4] * t[4] + t[5] * t[5]));
}

/* sigma_r (or sigma_theta) about the origin of the plane. */
static double polar_of(const double t[6], const double x[3], bool hoop)
{
    const double r = hypot(x[0], x[1]);
    const double c = r > 0.0 ? x[0] / r : 1.0;
    const double n = r > 0.0 ? x[1] / r : 0.0;
    const double cross = 2.0 * c * n * t[3];
    return hoop ? n * n * t[0] + c * c * t[1] - cross : c * c * t[0] + n * n * t[1] + cross;
}

static double radial_of(const sim *s, const double t[6], const double x[3])
{
    (void)s;
    return polar_of(t, x, false);
}

static double hoop_of(const sim *s, const double t[6], const double x[3])
{
    (void)s;
    return polar_of(t, x, true);
}

/* The stress of a point, components that the scene does not have 0, and its place. */
static void read_point(const writer *w, point_place place, double stress[6], double x[3])
{
    const fields *f = w->s->domain->fields[place.block];
    const int dim = w->s->mesh.dim, components = field_component_count(FIELD_STRESS, dim);
    for (int c = 0; c < 6; c++)
        stress[c] = c < components ? field_get(f, P_STRESS, w->points->body, c)[place.index] : 0.0;
    for (int c = 0; c < 3; c++) x[c] = c < dim ? field_get(f, P_POS, w->points->body, c)[place.index] : 0.0;
}

static floe_status add_derived_array(writer *w, const array_spec *spec, derived_value *value)
{
    for (size_t i = 0; i < w->points->n; i++) {
        double stress[6], x[3];
        read_point(w, w->points->place[i], stress, x);
        w->data[i] = value(w->s, stress, x);
    }
    return add_snapshot_array(w, spec);
}

static bool wants_polar(const sim *s)
{
    return s->mesh.dim == 2 && s->mesh.geometry == MESH_CARTESIAN && strcmp(s->scene->verify.exact, "lame") == 0;
}

static floe_status add_derived(writer *w)
{
    static const array_spec spec[] = {
        {.name = "pressure", .unit = "Pa", .meaning = "absolute: p_ref less the mean stress"},
        {.name = "von_mises", .unit = "Pa", .meaning = "von Mises stress"},
        {.name = "sigma_r", .unit = "Pa", .meaning = "radial stress about the origin"},
        {.name = "sigma_theta", .unit = "Pa", .meaning = "hoop stress about the origin"}};
    static derived_value *const value[] = {pressure_of, von_mises_of, radial_of, hoop_of};
    if (!fields_has(w->s->domain->fields[0], P_STRESS, w->points->body)) return FLOE_OK;
    for (int i = 0; i < (wants_polar(w->s) ? 4 : 2); i++) TRY(add_derived_array(w, &spec[i], value[i]));
    return FLOE_OK;
}

/* One array in the file, with what its description points at. */
typedef struct written {
    char path[PATH_SIZE];
    hdf_shape extent;
    xdmf_array array;
} written;

/* Whole numbers: the points' ids, or their positions in the list. */
static floe_status write_numbers(writer *w, const array_spec *spec, bool ids, written *out)
{
    int64_t *number;
    TRY(memory_new(w->s->ctx, &number, w->points->n, sizeof *number));
    for (size_t i = 0; i < w->points->n; i++) number[i] = ids ? (int64_t)w->points->place[i].id : (int64_t)i;
    const floe_status status = write_snapshot_array(w, spec, number, out->path, &out->extent, &out->array);
    memory_free(w->s->ctx, &number);
    return status;
}

/* Index and position first: they are the topology and the geometry of the grid. */
static floe_status begin_points(writer *w, const char *label)
{
    static const array_spec of_index = {
        .name = "index", .unit = "1", .meaning = "place in the arrays of this file, for viewers", .integer = true};
    static const array_spec of_position = {.name = "position", .unit = "m", .meaning = "x_p", .vector = true};
    written index, position;
    TRY(write_numbers(w, &of_index, false, &index));
    gather_vector(w, P_POS, w->points->body);
    TRY(write_snapshot_array(w, &of_position, NULL, position.path, &position.extent, &position.array));
    xdmf_begin_points(w->page, label, &index.array, &position.array);
    return w->page->status;
}

static floe_status add_id(writer *w)
{
    static const array_spec spec = {
        .name = "id", .unit = "1", .meaning = "the point's number, for life", .integer = true};
    written id;
    TRY(write_numbers(w, &spec, true, &id));
    xdmf_add(w->page, &id.array);
    return w->page->status;
}

/* What the body is made of, on its group. */
static floe_status describe_body(writer *w)
{
    const scene_body *body = &w->s->scene->body[w->s->mpm->body[w->points->body].scene_body];
    char material[NAME_SIZE];
    material_label(w->s, body->material, material);
    TRY(hdf_attribute_text(w->hdf, w->group, "material", material));
    return hdf_attribute_text(w->hdf, w->group, "phase",
                              w->s->scene->material[body->material].kind == MATERIAL_FLUID ? "fluid" : "solid");
}

/* A body that has lost all its points has no grid: viewers stumble over empty ones. */
static floe_status write_body(writer *w)
{
    char label[NAME_SIZE];
    body_label(w->s, w->s->mpm->body[w->points->body].scene_body, label);
    (void)snprintf(w->group, sizeof w->group, "/points/%s", label);
    w->on_points = true;
    if (w->points->n == 0) return FLOE_OK;
    TRY(begin_points(w, label));
    TRY(add_id(w));
    TRY(output_fields_of_points(w->s, w->points->body, add_field, w));
    TRY(add_derived(w));
    TRY(describe_body(w));
    xdmf_end(w->page);
    return w->page->status;
}

static floe_status with_buffer(writer *w, size_t n, floe_status write(writer *))
{
    TRY(memory_new(w->s->ctx, &w->data, 3 * n, sizeof *w->data));
    const floe_status status = write(w);
    memory_free(w->s->ctx, &w->data);
    return status;
}

static floe_status write_points(writer *w, int body)
{
    point_list list = {0};
    floe_status status = point_list_make(&list, w->s, body);
    w->points = &list;
    if (status == FLOE_OK) status = with_buffer(w, list.n, write_body);
    point_list_free(w->s->ctx, &list);
    w->points = NULL;
    return status;
}

floe_status snapshot_content(const sim *s, hdf_file *hdf, strbuf *page, const char *file)
{
    writer w = {.s = s, .hdf = hdf, .page = page, .file = file};
    if (s->ice) TRY(with_buffer(&w, mesh_cells(&s->mesh), write_cells));
    const int bodies = s->mpm ? s->mpm->n_bodies : 0;
    for (int body = 0; body < bodies; body++) TRY(write_points(&w, body));
    return page->status;
}
