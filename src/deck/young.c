/* Young's modulus and Poisson's ratio in place of the bulk and shear moduli, in all models that take these two. */
#include "deck/schema/schema.h"

#include <string.h>

typedef struct young {
    double modulus, ratio; /* Pa; 1 */
} young;

static const key_spec young_keys[] = {
    {.key = "young_modulus",
     .type = KEY_NUMBER,
     .unit = "Pa",
     .range = PARAM_POSITIVE,
     .offset = offsetof(young, modulus),
     .size = sizeof(double),
     .required = true,
     .doc = "Young's modulus E, at rest: with poisson_ratio in place of the two moduli"},
    {.key = "poisson_ratio",
     .type = KEY_NUMBER,
     .unit = "1",
     .range = PARAM_BETWEEN,
     .lo = -0.9999,
     .hi = 0.49999,
     .offset = offsetof(young, ratio),
     .size = sizeof(double),
     .required = true,
     .doc = "Poisson's ratio nu, at rest"},
};
enum { YOUNG_KEYS = sizeof young_keys / sizeof *young_keys };

static const char *const moduli[] = {"bulk_modulus", "shear_modulus"};

static const param_spec *find_param(const model_entry *entry, const char *name)
{
    for (size_t i = 0; i < entry->n_params; i++)
        if (entry->params[i].key && strcmp(entry->params[i].key, name) == 0) return &entry->params[i];
    return NULL;
}

const key_spec *young_key(const model_entry *entry, size_t i)
{
    return i < YOUNG_KEYS && find_param(entry, moduli[0]) && find_param(entry, moduli[1]) ? &young_keys[i] : NULL;
}

bool is_young_key(const model_entry *entry, const char *name)
{
    const key_spec *key;
    for (size_t i = 0; (key = young_key(entry, i)); i++)
        if (strcmp(key->key, name) == 0) return true;
    return false;
}

bool gives_young(const model_entry *entry, deck_node *map)
{
    const key_spec *key;
    for (size_t i = 0; map && (key = young_key(entry, i)); i++)
        if (node_find(map, key->key)) return true;
    return false;
}

bool is_modulus(const char *name)
{
    return strcmp(name, moduli[0]) == 0 || strcmp(name, moduli[1]) == 0;
}

floe_status read_young(reader *r, const model_entry *entry, deck_node *map, void *par)
{
    young given = {0.0, 0.0};
    const size_t errors = r->errors->count;
    for (size_t i = 0; i < YOUNG_KEYS; i++) {
        deck_node *child = node_find(map, young_keys[i].key), *other = node_find(map, moduli[i]);
        if (other)
            TRY(bad_key(r, other, NULL, "give bulk_modulus and shear_modulus, or young_modulus and poisson_ratio",
                        "'%s' beside Young's modulus or Poisson's ratio", moduli[i]));
        else if (!child)
            TRY(bad_key(r, map, young_keys[i].key,
                        "give young_modulus and poisson_ratio, or bulk_modulus and shear_modulus",
                        "missing key '%s' in '%.60s'", young_keys[i].key, map->key));
        else
            TRY(read_key(r, &young_keys[i], child, &given));
    }
    if (errors != r->errors->count) return FLOE_OK;
    const double E = given.modulus, nu = given.ratio, value[] = {E / (3.0 * (1.0 - 2.0 * nu)), E / (2.0 * (1.0 + nu))};
    for (size_t i = 0; i < 2; i++) *(double *)(void *)((char *)par + find_param(entry, moduli[i])->offset) = value[i];
    return FLOE_OK;
}
