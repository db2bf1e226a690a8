/* A scene in other units: every number of it by its dimension, as the tables of the deck say. */
#ifndef TESTS_VERIFICATION_SCALE_FIXTURE_H
#define TESTS_VERIFICATION_SCALE_FIXTURE_H

#include "mpm_fixture.h"

#include "deck/deck_internal.h"
#include "geom/images.h"

#include <ctype.h>

/* Powers of two by which lengths, masses, times and temperatures grow. */
typedef struct scaling {
    int length, mass, time, temperature;
} scaling;

/* The power of two of a unit as the tables write it: "kg m-3 s-1", "W/m/K", "m^3/kg". */
FIXTURE int scale_power(const scaling *by, const char *unit)
{
    static const struct {
        const char *name;
        int length, mass, time, temperature;
    } base[] = {
        {"1", 0, 0, 0, 0},   {"m", 1, 0, 0, 0},   {"kg", 0, 1, 0, 0},   {"s", 0, 0, 1, 0},
        {"K", 0, 0, 0, 1},   {"N", 1, 1, -2, 0},  {"J", 2, 1, -2, 0},   {"W", 2, 1, -3, 0},
        {"Hz", 0, 0, -1, 0}, {"rad", 0, 0, 0, 0}, {"Pa", -1, 1, -2, 0},
    };
    int power = 0;
    for (const char *at = unit ? unit : "1"; *at;) {
        int sign = 1;
        if (*at == '/' || *at == ' ') sign = *at++ == '/' ? -1 : 1;
        char name[8] = "";
        size_t n = 0;
        if (*at == '1') name[n++] = *at++;
        while (isalpha((unsigned char)*at) && n + 1 < sizeof name) name[n++] = *at++;
        if (*at == '^') at++;
        char *end = NULL;
        long exponent = strtol(at, &end, 10);
        if (end == at) exponent = 1;
        at = end;
        bool known = false;
        for (size_t k = 0; k < sizeof base / sizeof *base; ++k)
            if (strcmp(base[k].name, name) == 0) {
                known = true;
                power += sign * (int)exponent *
                         (base[k].length * by->length + base[k].mass * by->mass + base[k].time * by->time +
                          base[k].temperature * by->temperature);
            }
        if (!known) print_error("unit '%s': no '%s'\n", unit, name);
        assert_true(known);
    }
    return power;
}

FIXTURE void scale_numbers(double *x, size_t n, int power)
{
    for (size_t k = 0; k < n; ++k) x[k] = ldexp(x[k], power);
}

FIXTURE void scale_params(const scaling *by, const param_spec *params, size_t n, void *par)
{
    for (size_t k = 0; k < n; ++k) {
        double *x = (double *)(void *)((char *)par + params[k].offset);
        if (params[k].kind == PARAM_POINTS) {
            const param_list *list = (const param_list *)(const void *)x;
            scale_numbers(list->item, 3 * list->n, scale_power(by, params[k].unit));
        }
        if (params[k].kind != PARAM_NUMBERS) continue;
        scale_numbers(x, params[k].count > 0 ? (size_t)params[k].count : 3, scale_power(by, params[k].unit));
    }
}

/* Where the images of a shape are. */
FIXTURE void scale_images(const scaling *by, const shape *s)
{
    if (images_whole(s) == s) return;
    images *all = s->par;
    for (size_t k = 0; k < all->all.n; ++k) scale_numbers(all->image[k].shift, 3, by->length);
    scale_numbers(all->lower, 3, by->length);
    scale_numbers(all->upper, 3, by->length);
    scale_numbers(&all->all.extent, 1, by->length);
}

FIXTURE void scale_model(const scaling *by, const key_spec *key, void *field)
{
    const char *name;
    const void *par;
    model_entry entry;
    if (key->family == &family_reference || !key->family->fetch(field, &name, &par)) return;
    if (key->family == &family_exact) {
        const exact_model *m = exact_find(name);
        double *energy = param_find(m->params, m->n_params, (void *)(uintptr_t)par, "energy");
        const double *geometry = param_find(m->params, m->n_params, (void *)(uintptr_t)par, "geometry");
        scale_params(by, m->params, m->n_params, (void *)(uintptr_t)par);
        /* Of a blast: per square metre of the plane, per metre of the line. */
        if (energy && geometry) scale_numbers(energy, 1, -(2 - (int)*geometry) * by->length);
        return;
    }
    for (size_t i = 0; key->family->get(NULL, i, &entry); ++i)
        if (strcmp(entry.name, name) == 0) scale_params(by, entry.params, entry.n_params, (void *)(uintptr_t)par);
    if (key->family == &family_shape) scale_images(by, field);
}

FIXTURE void scale_table(const scene *s, const scaling *by, const key_table *table, void *base);

FIXTURE void scale_variant(const scene *s, const scaling *by, const variants *kinds, void *field)
{
    for (size_t i = 0; i < kinds->n; ++i)
        if (kinds->list[i].value == kinds->chosen(field) && kinds->list[i].table)
            scale_table(s, by, kinds->list[i].table, field);
}

FIXTURE void scale_custom(const scene *s, const scaling *by, const key_spec *key, void *base)
{
    if (key->special == &special_boundaries)
        for (int k = 0; k < 2 * MESH_MAX_DIM; ++k)
            scale_variant(s, by, &boundary_kinds, &((scene *)base)->bc.side[k / 2][k % 2]);
    if (key->special == &special_exchange) /* a number, or a word */
        scale_numbers((double *)(void *)((char *)base + key->offset), 1, scale_power(by, key->unit));
    const curve_line *c = key->special == &special_positions         ? base
                          : key->special == &special_sheet_positions ? &((sheet_surface *)base)->curve
                                                                     : NULL;
    if (c) scale_numbers(c->vertex, 3 * (size_t)c->n_vertices, scale_power(by, "m"));
}

FIXTURE void scale_items(const scene *s, const scaling *by, const key_spec *key, void *base)
{
    const named_items *items = key->items;
    int count;
    memcpy(&count, (char *)base + items->count_offset, sizeof count);
    for (int i = 0; i < count; ++i) {
        char *item = (char *)base + key->offset + (size_t)i * items->item_size;
        if (items->table) scale_table(s, by, items->table, item);
        if (items->variants) scale_variant(s, by, items->variants, item);
        if (items->value) {
            const key_table one = {items->value, 1};
            scale_table(s, by, &one, item);
        }
    }
}

/* What of the whole scene is per square metre in one dimension (masses of points, springs), and what a thickness is there. */
FIXTURE const char *unit_of(const scene *s, const key_spec *key)
{
    const bool thickness = key->offset == offsetof(scene_membrane, thickness) && strcmp(key->key, "thickness") == 0 &&
                           strstr(key->doc, "share of the section");
    if (thickness && s->mesh.dim == 1) return "1";
    if (s->mesh.dim == 1 && strcmp(key->key, "heavy_mass") == 0) return "kg/m2";
    if (s->mesh.dim == 1 && strcmp(key->key, "stiffness") == 0) return "N/m3";
    return key->unit;
}

FIXTURE void scale_table(const scene *s, const scaling *by, const key_table *table, void *base)
{
    for (size_t i = 0; i < table->n; ++i) {
        const key_spec *key = &table->key[i];
        char *field = (char *)base + key->offset;
        const size_t n = key->type == KEY_NUMBER ? 1 : key->size / sizeof(double);
        switch (key->type) {
        case KEY_NUMBER:
        case KEY_NUMBERS:
        case KEY_VECTOR:
        case KEY_SPREAD: scale_numbers((double *)(void *)field, n, scale_power(by, unit_of(s, key))); break;
        case KEY_MAP: scale_table(s, by, key->table, field); break;
        case KEY_NAMED: scale_items(s, by, key, base); break;
        case KEY_MODEL: scale_model(by, key, field); break;
        case KEY_VARIANT: scale_variant(s, by, key->variants, field); break;
        case KEY_SPECIAL: scale_custom(s, by, key, base); break;
        default: break;
        }
    }
}

/* The whole scene. */
FIXTURE void scale_scene(scene *s, const scaling *by)
{
    scale_table(s, by, &schema_deck, s);
}

/* The power of two of what a simulation holds of a unit: masses and volumes are per metre of depth in 2-D, per square metre in 1-D. */
FIXTURE int scale_held(const mesh *m, const scaling *by, const char *unit)
{
    const int missing = m->geometry == MESH_AXISYMMETRIC ? 0 : 3 - m->dim;
    const bool whole = strncmp(unit, "kg", 2) == 0 ? unit[2] != '/' : strcmp(unit, "m3") == 0 || strcmp(unit, "J") == 0;
    return scale_power(by, unit) - (whole ? missing * by->length : 0);
}

#endif
