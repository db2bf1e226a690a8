/* Formulas of a scene that is rotated, mirrored or shifted (map_fixture.h): each is asked at the place where the new scene's place was, and
 * goes with its number, whose side or component may be another one. */
#ifndef TESTS_VERIFICATION_MAP_FORMULA_FIXTURE_H
#define TESTS_VERIFICATION_MAP_FORMULA_FIXTURE_H

#include "scene_map_fixture.h"

#include "deck/units.h"
#include "scene/formula.h"

#include <ctype.h>
#include <stddef.h>

/* What formulas call a coordinate. */
FIXTURE const char *coordinate(const scene *s, int axis)
{
    static const char *const plane[] = {"x", "y", "z"}, *const about_axis[] = {"r", "z", "theta"};
    return (s->mesh.geometry == MESH_AXISYMMETRIC ? about_axis : plane)[axis];
}

FIXTURE int map_axis(const scene_map *m, int old)
{
    for (int a = 0; a < m->dim; ++a)
        if (m->from[a] == old) return a;
    return old;
}

/* Bytes from the start of a part of the scene to a number in it, if it is there. */
FIXTURE bool is_in(const scene *s, const void *part, size_t size, size_t number, size_t *at)
{
    const size_t from = (size_t)((const char *)part - (const char *)s);
    *at = number - from;
    return number >= from && number < from + size;
}

/* The number's place in a vector that `at` is in, by the new axes, and its sign. */
FIXTURE size_t map_component(const scene_map *m, size_t vector, size_t at, double *sign)
{
    const int c = map_axis(m, (int)((at - vector) / sizeof(double)));
    *sign = m->sign[c];
    return vector + (size_t)c * sizeof(double);
}

FIXTURE size_t map_in_condition(const scene_map *m, size_t at, double *sign)
{
    const size_t vector = offsetof(bc_side, velocity);
    return at >= vector && at < vector + 3 * sizeof(double) ? map_component(m, vector, at, sign) : at;
}

/* Where a number of the old scene is in the new one, in bytes from its start; its sign there. */
FIXTURE size_t map_number(const scene *s, const scene_map *m, size_t number, double *sign)
{
    size_t at;
    *sign = 1.0;
    for (int k = 0; k < 2 * m->dim; ++k) {
        const int axis = map_axis(m, k / 2), side = m->sign[axis] < 0.0 ? 1 - k % 2 : k % 2;
        if (is_in(s, &s->bc.side[k / 2][k % 2], sizeof(bc_side), number, &at))
            return (size_t)((const char *)&s->bc.side[axis][side] - (const char *)s) + map_in_condition(m, at, sign);
    }
    for (int k = 0; k < s->n_parts; ++k)
        if (is_in(s, &s->part[k].condition, sizeof(bc_side), number, &at))
            return number - at + map_in_condition(m, at, sign);
    if (is_in(s, s->ambient_velocity, sizeof s->ambient_velocity, number, &at))
        return number - at + map_component(m, 0, at, sign);
    for (int b = 0; b < s->n_bodies; ++b)
        if (is_in(s, s->body[b].velocity, sizeof s->body[b].velocity, number, &at))
            return number - at + map_component(m, 0, at, sign);
    return number;
}

/* Adds to a text, which has room for `most`. */
FIXTURE void append(char *text, size_t most, const char *more, size_t length)
{
    const size_t n = strlen(text);
    assert_in_range(n + length, 0, most - 1);
    memcpy(text + n, more, length);
    text[n + length] = '\0';
}

/* The text of a formula in which each coordinate is told by those of the new scene. */
FIXTURE void map_text(const scene *s, const scene_map *m, const char *old, double sign, char *text, size_t most)
{
    char one[160];
    (void)snprintf(text, most, sign < 0.0 ? "-(" : "(");
    while (*old) {
        size_t n = 1;
        if (isdigit((unsigned char)*old) || *old == '.') /* "1e-3" has no name in it */
            n = strspn(old, "0123456789.eE");
        else if (isalpha((unsigned char)*old) || *old == '_')
            while (isalnum((unsigned char)old[n]) || old[n] == '_') ++n;
        int axis = -1;
        for (int a = 0; a < m->dim; ++a) {
            const char *name = coordinate(s, a);
            if (n == strlen(name) && strncmp(old, name, n) == 0) axis = a;
        }
        if (axis >= 0) {
            const int to = map_axis(m, axis);
            n = strlen(coordinate(s, axis));
            const int length = snprintf(one, sizeof one, "(%g * (%s - (%.17g%s)))", m->sign[to], coordinate(s, to),
                                        m->shift[to], s->dimensionless ? "" : " m");
            append(text, most, one, (size_t)length);
        } else {
            append(text, most, old, n);
        }
        old += n;
    }
    append(text, most, ")", 1);
}

/* All formulas of the scene; its numbers may be where they were, or mapped already. */
FIXTURE void map_formulas(scene *s, const scene_map *m)
{
    expression *gone[SCENE_MAX_FORMULAS];
    int n_gone = 0;
    expression_function table[SCENE_MAX_TABLES] = {0};
    expression_scope scope = {.constant = s->constant,
                              .n_constants = (size_t)s->n_constants,
                              .function = table,
                              .n_functions = (size_t)s->n_tables,
                              .unit = s->dimensionless ? NULL : units_to_si};
    for (int a = 0; a < s->mesh.dim; ++a) scope.axis[a] = coordinate(s, a);
    for (int i = 0; i < s->n_tables; ++i) {
        (void)snprintf(table[i].name, sizeof table[i].name, "%s", s->table[i].name);
        table[i].curve = s->table[i].curve;
    }
    for (int i = 0; i < s->n_formulas; ++i) {
        scene_formula *f = &s->formula[i];
        char text[2000], why[EXPRESSION_WHY];
        double sign;
        expression_dimension dimension;
        f->number = map_number(s, m, f->number, &sign);
        map_text(s, m, expression_text(f->formula), sign, text, sizeof text);
        if (f->owned) gone[n_gone++] = f->formula;
        check_ok(s->ctx, expression_create(s->ctx, text, &scope, &f->formula, &dimension, why));
        f->owned = true;
    }
    for (int i = 0; i < n_gone; ++i) expression_destroy(s->ctx, &gone[i]);
}

#endif
