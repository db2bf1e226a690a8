#include "draw/field_choice.h"

#include "base/memory.h"
#include "base/strbuf.h"

#include <math.h>
#include <string.h>

static bool begins_with(const char *name, const char *with)
{
    return strncmp(name, with, strlen(with)) == 0;
}

/* Names that are no words. */
static void make_label(const char *name, char label[SNAPSHOT_TEXT])
{
    static const char *const known[][2] = {{"von_mises", "von Mises stress"},
                                           {"sigma_r", "radial stress"},
                                           {"sigma_theta", "hoop stress"},
                                           {"velocity", "speed"}};
    (void)snprintf(label, SNAPSHOT_TEXT, "%s", name);
    for (char *c = label; *c; c++) {
        if (*c == '_') *c = ' ';
    }
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (strcmp(name, known[i][0]) == 0) (void)snprintf(label, SNAPSHOT_TEXT, "%s", known[i][1]);
    }
}

static void choose_field(const snapshot_field *field, const char *name, int component, field_choice *out)
{
    out->field = field;
    out->component = component;
    out->is_signed = component >= 0 || begins_with(name, "stress_") || begins_with(name, "sigma_");
    make_label(name, out->label);
}

/* "velocity_x": component 0 of velocity. The axes are x, y, z, or r, z. */
static bool choose_component(const snapshot *s, const snapshot_group *group, const char *name, field_choice *out)
{
    char vector[SNAPSHOT_TEXT];
    const size_t length = strlen(name);
    const char *axes = s->axisymmetric ? "rz" : "xyz";
    if (length < 3 || length >= sizeof vector || name[length - 2] != '_') return false;
    const char *axis = strchr(axes, name[length - 1]);
    (void)snprintf(vector, sizeof vector, "%.*s", (int)length - 2, name);
    const snapshot_field *field = snapshot_find(group, vector);
    if (!axis || axis - axes >= s->dim || !field || field->components != 3) return false;
    choose_field(field, name, (int)(axis - axes), out);
    return true;
}

void field_choose(const snapshot *s, const snapshot_group *group, const char *name, field_choice *out)
{
    *out = (field_choice){0};
    const snapshot_field *field = snapshot_find(group, name);
    if (field) {
        choose_field(field, name, -1, out);
    } else {
        (void)choose_component(s, group, name, out);
    }
}

void field_choose_for_points(const snapshot *s, const snapshot_group *body, field_choice *out)
{
    const char *const solid[] = {s->dim == 1 ? "stress_xx" : "von_mises", "von_mises", "velocity"};
    const char *const fluid[] = {"pressure", "pressure", "velocity"};
    *out = (field_choice){0};
    for (int i = 0; i < 3 && !out->field; i++) field_choose(s, body, body->fluid ? fluid[i] : solid[i], out);
}

void field_choose_for_cells(const snapshot *s, field_choice *out)
{
    field_choose(s, &s->grid, "pressure", out);
    for (size_t i = 0; i < s->grid.n_fields && !out->field; i++) {
        if (begins_with(s->grid.field[i].name, "density")) field_choose(s, &s->grid, s->grid.field[i].name, out);
    }
}

static bool seen_before(const snapshot *s, size_t body, const char *name)
{
    for (size_t b = 0; b < body; b++) {
        if (snapshot_find(&s->body[b], name)) return true;
    }
    return false;
}

static void list_fields(const snapshot *s, bool points, strbuf *text)
{
    const size_t groups = points ? s->n_bodies : 1;
    for (size_t g = 0; g < groups; g++) {
        const snapshot_group *group = points ? &s->body[g] : &s->grid;
        for (size_t i = 0; i < group->n_fields; i++) {
            const char *name = group->field[i].name;
            if (points && seen_before(s, g, name)) continue;
            const char *axes = s->axisymmetric ? " (_r, _z)"
                               : s->dim == 3   ? " (_x, _y, _z)"
                               : s->dim == 2   ? " (_x, _y)"
                                               : " (_x)";
            strbuf_append(text, "%s%s%s", text->length > 0 ? ", " : "", name,
                          group->field[i].components == 3 ? axes : "");
        }
    }
}

floe_status field_unknown(const snapshot *s, bool points, const char *name)
{
    strbuf list;
    strbuf_init(&list, s->ctx);
    list_fields(s, points, &list);
    const char *what = points ? "points" : "cells";
    floe_status status = list.status;
    if (status == FLOE_OK && list.length == 0) {
        status = fail(s->ctx, FLOE_BAD_INPUT, "'%s' holds no %s to colour by '%s'", s->path, what, name);
    } else if (status == FLOE_OK) {
        status = fail(s->ctx, FLOE_BAD_INPUT, "there is no field '%s' of %s in '%s'; there are: %s, none", name, what,
                      s->path, strbuf_string(&list));
    }
    strbuf_free(&list);
    return status;
}

/* Of three numbers each, in place: a component, or the magnitude (-1). */
static void reduce_vectors(double *value, size_t n, int component)
{
    for (size_t i = 0; i < n; i++) {
        const double *v = value + 3 * i;
        value[i] = component >= 0 ? v[component] : sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
}

/* The material whose field this is by its name; NULL if it is shared. */
static const snapshot_field *fraction_of(const snapshot_group *group, const char *name)
{
    static const char prefix[] = "volume_fraction";
    const size_t length = strlen(name);
    for (size_t i = 0; i < group->n_fields; i++) {
        const char *fraction = group->field[i].name;
        if (!begins_with(fraction, prefix) || strcmp(fraction, name) == 0) continue;
        const char *material = fraction + strlen(prefix);
        const size_t tail = strlen(material);
        if (tail > 0 && length > tail && strcmp(name + length - tail, material) == 0) return &group->field[i];
    }
    return NULL;
}

/* A material's field means nothing where there is next to none of it. */
static floe_status blank_absent(const snapshot *s, const snapshot_group *group, const char *name, double *value)
{
    const double least = 1e-3;
    const snapshot_field *field = fraction_of(group, name);
    double *fraction;
    if (!field) return FLOE_OK;
    TRY(snapshot_values(s, group, field, &fraction));
    for (size_t i = 0; i < group->n; i++) {
        if (!(fraction[i] >= least)) value[i] = NAN;
    }
    memory_free(s->ctx, &fraction);
    return FLOE_OK;
}

floe_status field_values(const snapshot *s, const snapshot_group *group, const field_choice *choice, double **out)
{
    TRY(snapshot_values(s, group, choice->field, out));
    if (choice->field->components == 3) reduce_vectors(*out, group->n, choice->component);
    const floe_status status = blank_absent(s, group, choice->field->name, *out);
    if (status != FLOE_OK) memory_free(s->ctx, out);
    return status;
}
