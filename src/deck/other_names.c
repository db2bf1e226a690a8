#include "deck/other_names.h"

#include "base/text.h"

#include <stdio.h>
#include <string.h>

typedef struct foreign_name {
    const char *theirs, *ours;
    const char *remedy; /* where the name alone is not enough */
} foreign_name;

#define FROM_GAS_CONSTANT "the specific heat at constant volume is R / (gamma - 1)"

/* Several of ours for one of theirs: the first that can stand there is meant. */
static const foreign_name foreign[] = {
    /* shapes */
    {"circle", "ball", NULL},
    {"disc", "ball", NULL},
    {"disk", "ball", NULL},
    {"sphere", "ball", NULL},
    {"block", "box", NULL},
    {"brick", "box", NULL},
    {"cube", "box", NULL},
    {"cuboid", "box", NULL},
    {"rectangle", "box", NULL},
    {"ring", "annulus", NULL},
    {"shell", "annulus", NULL},
    {"ellipse", "ellipsoid", NULL},
    {"plane", "halfspace", NULL},
    {"prism", "extruded", NULL},
    {"triangle", "polygon", NULL},
    {"tube", "cylinder", NULL},
    {"pipe", "cylinder", NULL},
    /* boundaries and their sides */
    {"wall", "slip", NULL},
    {"clamped", "no_slip", NULL},
    {"fixed", "no_slip", NULL},
    {"sticky", "no_slip", NULL},
    {"mirror", "symmetry", NULL},
    {"reflecting", "symmetry", NULL},
    {"reflective", "symmetry", NULL},
    {"absorbing", "non_reflecting", NULL},
    {"farfield", "non_reflecting", NULL},
    {"open", "free", NULL},
    {"bottom", "lower", NULL},
    {"left", "lower", NULL},
    {"max", "upper", NULL},
    {"min", "lower", NULL},
    {"right", "upper", NULL},
    {"top", "upper", NULL},
    /* loads */
    {"force", "body_force", NULL},
    {"pressure", "traction", NULL},
    /* laws of solids and equations of state */
    {"elastic", "linear_elastic", NULL},
    {"hookean", "linear_elastic", NULL},
    {"hyperelastic", "neo_hookean", NULL},
    {"mohr_coulomb", "drucker_prager", NULL},
    {"plastic", "j2", NULL},
    {"von_mises", "j2", NULL},
    {"ideal_gas", "ideal", NULL},
    {"perfect_gas", "ideal", NULL},
    {"stiff_gas", "stiffened", NULL},
    /* keys of these */
    {"E", "young_modulus", NULL},
    {"nu", "poisson_ratio", NULL},
    {"poisson", "poisson_ratio", NULL},
    {"poissons_ratio", "poisson_ratio", NULL},
    {"youngs_modulus", "young_modulus", NULL},
    {"K", "bulk_modulus", NULL},
    {"G", "shear_modulus", NULL},
    {"mu", "shear_modulus", NULL},
    {"mu", "shear", NULL},
    {"R", "specific_heat", FROM_GAS_CONSTANT},
    {"gas_constant", "specific_heat", FROM_GAS_CONSTANT},
    {"cp", "specific_heat", "of a gas it is that at constant volume, cp / gamma"},
    {"cv", "specific_heat", NULL},
    {"rho", "density", NULL},
    {"center", "centre", NULL},
    {"origin", "centre", NULL},
    {"diameter", "radius", "half of the diameter"},
    {"r", "radius", NULL},
    {"inner", "inner_radius", NULL},
    {"outer", "outer_radius", NULL},
    /* other keys */
    {"T", "temperature", NULL},
    {"p", "pressure", NULL},
    {"v", "velocity", NULL},
    {"ppc", "points", NULL},
    {"particles", "points", NULL},
    {"bc", "boundaries", NULL},
    {"body", "bodies", NULL},
    {"load", "loads", NULL},
    {"mesh", "domain", NULL},
    {"grid", "domain", NULL},
    {"name", "title", NULL},
    {"material", "materials", NULL},
    {"gravity", "loads", "`loads: {weight: {gravity: {acceleration: [0, -9.81 m/s^2]}}}`"},
    {"dx", "cell", NULL},
    {"h", "cell", NULL},
    {"resolution", "cell", NULL},
    {"spacing", "cell", NULL},
    {"dims", "dim", NULL},
    {"dimension", "dim", NULL},
    {"courant", "cfl", NULL},
    {"dt", "fixed_step", "without it steps are as large as is stable"},
    {"time_step", "fixed_step", "without it steps are as large as is stable"},
    {"timestep", "fixed_step", "without it steps are as large as is stable"},
    {"duration", "end", NULL},
    {"final_time", "end", NULL},
    {"t_end", "end", NULL},
    {"every", "interval", NULL},
};

const char *other_name(const char *name, const char *(*candidate)(const void *user, size_t i), const void *user,
                       const char **remedy)
{
    for (size_t k = 0; k < sizeof foreign / sizeof foreign[0]; k++) {
        if (strcmp(foreign[k].theirs, name) != 0) continue;
        for (size_t i = 0; candidate(user, i); i++) {
            if (strcmp(candidate(user, i), foreign[k].ours) != 0) continue;
            *remedy = foreign[k].remedy;
            return foreign[k].ours;
        }
    }
    return NULL;
}

enum { PLACES_SHOWN = 3 };

typedef struct key_search {
    const char *name;
    char *text;
    size_t size;
    int found;
} key_search;

static void note_place(key_search *f, const char *place)
{
    f->found++;
    if (f->found == 1)
        (void)snprintf(f->text, f->size, "'%.60s' is a key of %s", f->name, place);
    else
        text_add(f->text, f->size, ", %s", place);
}

static void search_table(key_search *f, const key_table *table, const char *place);

static void search_variants(key_search *f, const variants *kinds, const char *place)
{
    char path[160];
    for (size_t i = 0; i < kinds->n; i++) {
        if (strcmp(kinds->list[i].name, f->name) == 0) note_place(f, place);
        (void)snprintf(path, sizeof path, "%.80s.%s", place, kinds->list[i].name);
        if (kinds->list[i].table) search_table(f, kinds->list[i].table, path);
    }
}

static void search_key(key_search *f, const key_spec *key, const char *place)
{
    char path[160];
    (void)snprintf(path, sizeof path, "%.80s%s%s", place, place[0] ? "." : "", key->key);
    if (key->type == KEY_MAP) search_table(f, key->table, path);
    if (key->type != KEY_NAMED) return;
    text_add(path, sizeof path, ".NAME");
    if (key->items->table) search_table(f, key->items->table, path);
    if (key->items->variants) search_variants(f, key->items->variants, path);
}

static void search_table(key_search *f, const key_table *table, const char *place)
{
    for (size_t i = 0; i < table->n; i++) {
        if (strcmp(table->key[i].key, f->name) == 0) note_place(f, place[0] ? place : "the deck itself");
        search_key(f, &table->key[i], place);
    }
}

void place_of_key(const char *name, char *text, size_t size)
{
    key_search f = {name, text, size, 0};
    text[0] = '\0';
    search_table(&f, &schema_deck, "");
    if (f.found > PLACES_SHOWN) text[0] = '\0';
}
