#include "io/names.h"

#include "scene/state.h"

#include <string.h>

double output_scale(const sim *s)
{
    return scene_extent(s->scene);
}

const char *output_unit(const sim *s, const char *unit)
{
    return s->scene->dimensionless ? "1" : unit;
}

/* Not isalnum: the result must not depend on the locale. */
static bool is_plain(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || (c && strchr("_-.", c));
}

static void make_plain(const char *name, char *label)
{
    size_t i = 0;
    for (; name[i] && i < SCENE_NAME - 1; i++) label[i] = is_plain(name[i]) ? name[i] : '_';
    label[i] = '\0';
}

/* `name_of` gives the name with a number in the scene. */
typedef const char *namer(const scene *s, int n);

static const char *name_of_body(const scene *s, int n)
{
    return s->body[n].name;
}
static const char *name_of_material(const scene *s, int n)
{
    return s->material[n].name;
}
static const char *name_of_probe(const scene *s, int n)
{
    return s->probe[n].name;
}

static const char *name_of_tracer(const scene *s, int n)
{
    return s->tracer[n].name;
}

static void make_label(const scene *s, namer *name_of, int n, char label[NAME_SIZE])
{
    char other[SCENE_NAME];
    make_plain(name_of(s, n), label);
    bool taken = label[0] == '\0' || strcmp(label, ".") == 0 || strcmp(label, "..") == 0;
    for (int i = 0; i < n; i++) {
        make_plain(name_of(s, i), other);
        if (strcmp(label, other) == 0) taken = true;
    }
    const size_t length = strlen(label);
    if (taken) (void)snprintf(label + length, NAME_SIZE - length, "_%d", n);
}

void body_label(const sim *s, int body, char label[NAME_SIZE])
{
    make_label(s->scene, name_of_body, body, label);
}

void material_label(const sim *s, int material, char label[NAME_SIZE])
{
    make_label(s->scene, name_of_material, material, label);
}

void probe_label(const sim *s, int probe, char label[NAME_SIZE])
{
    make_label(s->scene, name_of_probe, probe, label);
}

void tracer_label(const sim *s, int tracer, char label[NAME_SIZE])
{
    make_label(s->scene, name_of_tracer, tracer, label);
}

const char *component_name(const sim *s, field_components components, int comp)
{
    static const char *const stress[] = {"xx", "yy", "zz", "xy", "yz", "zx"};
    static const char *const stress_rz[] = {"rr", "zz", "tt", "rz"};
    static const char *const tensor_1[] = {"xx", "yy", "zz"};
    static const char *const tensor_2[] = {"xx", "xy", "yx", "yy", "zz"};
    static const char *const tensor_rz[] = {"rr", "rz", "zr", "zz", "tt"};
    static const char *const tensor_3[] = {"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"};
    const bool rz = s->mesh.geometry == MESH_AXISYMMETRIC;
    if (components == FIELD_STRESS) return rz ? stress_rz[comp] : stress[comp];
    if (s->mesh.dim == 1) return tensor_1[comp];
    if (s->mesh.dim == 2) return rz ? tensor_rz[comp] : tensor_2[comp];
    return tensor_3[comp];
}

/* Appends one character, as far as there is space. */
static void append_character(char plain[NAME_SIZE], size_t *at, char c)
{
    if (*at + 1 < NAME_SIZE) plain[(*at)++] = c;
}

/* One factor such as "m3"; its exponent changes sign where it stands below the line. Returns what follows it. */
static const char *put_factor(char plain[NAME_SIZE], size_t *at, const char *unit, bool below)
{
    if (*at > 0) append_character(plain, at, ' ');
    while (*unit && !strchr(" /0123456789", *unit)) append_character(plain, at, *unit++);
    if (below) append_character(plain, at, '-');
    if (below && (*unit < '0' || *unit > '9')) append_character(plain, at, '1');
    while (*unit >= '0' && *unit <= '9') append_character(plain, at, *unit++);
    return unit;
}

void unit_without_slash(const char *unit, char plain[NAME_SIZE])
{
    size_t at = 0;
    bool below = false;
    if (strncmp(unit, "1/", 2) == 0) unit += 1;
    while (*unit) {
        if (*unit == '/') below = true;
        if (*unit == '/' || *unit == ' ') {
            unit++;
        } else {
            unit = put_factor(plain, &at, unit, below);
        }
    }
    plain[at] = '\0';
}
