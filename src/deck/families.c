/* Registries as the reader sees them: shapes, laws of solids, equations of state, exact solutions. */
#include "deck/deck_internal.h"
#include "geom/images.h"

#include <stdio.h>
#include <string.h>

static bool shape_get(const deck_catalogue *catalogue, size_t i, model_entry *out)
{
    (void)catalogue;
    if (i >= shape_registry_size) return false;
    const shape_model *m = shape_registry[i];
    *out = (model_entry){m->name, m->doc, "", m->params, m->n_params, m->param_size, m};
    return true;
}

static void shape_store(void *field, const model_entry *entry, void *par)
{
    shape *s = field;
    s->model = entry->model;
    s->par = par;
}

static bool shape_fetch(const void *field, const char **name, const void **par)
{
    const shape *s = images_whole(field);
    if (!s->model) return false;
    *name = s->model->name;
    *par = s->par;
    return true;
}

static floe_status allocate_for_shape(void *owner, void *out, size_t size)
{
    return scene_allocate(owner, out, size);
}

static floe_status shape_make_ready(scene *s, const model_entry *entry, void *par, int dim, char why[MODEL_WHY])
{
    const shape_model *m = entry->model;
    const shape of = {m, par};
    const shape_memory memory = {s->ctx, allocate_for_shape, s};
    _Static_assert((int)MODEL_WHY == (int)SHAPE_WHY, "what is wrong with a shape is what is wrong with a model");
    return shape_prepare(&of, dim, &memory, why);
}

static const char *shape_misfit(const model_entry *entry, int dim)
{
    const shape_model *m = entry->model;
    if (dim < m->min_dim) return m->instead_below;
    return dim > m->max_dim ? m->instead_above : NULL;
}

const model_family family_shape = {.noun = "shape",
                                   .get = shape_get,
                                   .store = shape_store,
                                   .fetch = shape_fetch,
                                   .field_size = sizeof(shape),
                                   .prepare = shape_make_ready,
                                   .misfit = shape_misfit};

static model_entry law_entry(const solid_model *m)
{
    return (model_entry){m->name, m->doc, m->cite, m->params, m->n_params, m->param_size, m};
}

/* floe's own, then those of the program. */
static bool law_get(const deck_catalogue *catalogue, size_t i, model_entry *out)
{
    const size_t own = solid_registry_size, added = catalogue ? catalogue->n_law : 0;
    if (i >= own + added) return false;
    *out = law_entry(i < own ? solid_registry[i] : &catalogue->law[i - own]);
    return true;
}

static void law_store(void *field, const model_entry *entry, void *par)
{
    scene_material *m = field;
    m->law = entry->model;
    m->law_par = par;
}

static bool law_fetch(const void *field, const char **name, const void **par)
{
    const scene_material *m = field;
    if (!m->law) return false;
    *name = m->law->name;
    *par = m->law_par;
    return true;
}

static bool law_chosen(const void *field, model_entry *out)
{
    const scene_material *m = field;
    if (m->law) *out = law_entry(m->law);
    return m->law;
}

/* What the law itself refuses, and moduli that no stable isotropic solid has: nu outside (-1, 1/2) goes with K <= 0 or G < 0. */
static const char *law_check(const model_entry *entry, const void *par, int dim)
{
    (void)dim;
    const solid_model *m = entry->model;
    const char *wrong = m->check ? m->check(par) : NULL;
    if (wrong || !m->bulk_modulus || !m->shear_modulus) return wrong;
    const double K = m->bulk_modulus(par), G = m->shear_modulus(par);
    if (!(K > 0.0)) return "its bulk modulus is not positive: Poisson's ratio must be below 0.5";
    if (!(G >= 0.0)) return "its shear modulus is negative: Poisson's ratio must be above -1";
    const double nu = (3.0 * K - 2.0 * G) / (2.0 * (3.0 * K + G));
    if (!(nu > -1.0 && nu <= 0.5)) return "Poisson's ratio is outside -1 ... 0.5";
    return NULL;
}

const model_family family_law = {
    .noun = "law", .get = law_get, .store = law_store, .fetch = law_fetch, .check = law_check, .chosen = law_chosen};

static bool membrane_get(const deck_catalogue *catalogue, size_t i, model_entry *out)
{
    (void)catalogue;
    if (i >= membrane_registry_size) return false;
    const membrane_model *m = membrane_registry[i];
    *out = (model_entry){m->name, m->doc, m->cite, m->params, m->n_params, m->param_size, m};
    return true;
}

static void membrane_store(void *field, const model_entry *entry, void *par)
{
    scene_material *m = field;
    m->membrane = entry->model;
    m->membrane_par = par;
}

static bool membrane_fetch(const void *field, const char **name, const void **par)
{
    const scene_material *m = field;
    if (!m->membrane) return false;
    *name = m->membrane->name;
    *par = m->membrane_par;
    return true;
}

const model_family family_membrane = {
    .noun = "membrane law", .get = membrane_get, .store = membrane_store, .fetch = membrane_fetch};

static bool normals_get(const deck_catalogue *catalogue, size_t i, model_entry *out)
{
    (void)catalogue;
    if (i >= surface_registry_size) return false;
    const surface_method *m = surface_registry[i];
    *out = (model_entry){m->name, m->doc, m->cite, m->params, m->n_params, m->param_size, m};
    return true;
}

static void normals_store(void *field, const model_entry *entry, void *par)
{
    scene_membrane *m = field;
    m->normals = entry->model;
    m->normals_par = par;
}

static bool normals_fetch(const void *field, const char **name, const void **par)
{
    const scene_membrane *m = field;
    if (!m->normals) return false;
    *name = m->normals->name;
    *par = m->normals_par;
    return true;
}

/* A line of one axis has nothing to find. */
static const char *normals_check(const model_entry *entry, const void *par, int dim)
{
    (void)par;
    const surface_method *m = entry->model;
    return dim > 1 || m->connected ? NULL : "a line of one dimension has none to find";
}

const model_family family_normals = {.noun = "way to make normals",
                                     .get = normals_get,
                                     .store = normals_store,
                                     .fetch = normals_fetch,
                                     .check = normals_check};

static model_entry eos_entry(const eos_model *m)
{
    return (model_entry){m->name, m->doc, m->cite, m->params, m->n_params, m->param_size, m};
}

static bool eos_get(const deck_catalogue *catalogue, size_t i, model_entry *out)
{
    const size_t own = eos_registry_size, added = catalogue ? catalogue->n_eos : 0;
    if (i >= own + added) return false;
    *out = eos_entry(i < own ? eos_registry[i] : &catalogue->eos[i - own]);
    return true;
}

static bool eos_chosen(const void *field, model_entry *out)
{
    const eos *e = field;
    if (e->model) *out = eos_entry(e->model);
    return e->model;
}

static void eos_store(void *field, const model_entry *entry, void *par)
{
    eos *e = field;
    e->model = entry->model;
    e->par = par;
}

static bool eos_fetch(const void *field, const char **name, const void **par)
{
    const eos *e = field;
    if (!e->model) return false;
    *name = e->model->name;
    *par = e->par;
    return true;
}

static const char *eos_check(const model_entry *entry, const void *par, int dim)
{
    (void)dim;
    const eos_model *m = entry->model;
    return m->check ? m->check(par) : NULL;
}

const model_family family_eos = {.noun = "equation of state",
                                 .get = eos_get,
                                 .store = eos_store,
                                 .fetch = eos_fetch,
                                 .check = eos_check,
                                 .chosen = eos_chosen};

static bool exact_get(const deck_catalogue *catalogue, size_t i, model_entry *out)
{
    if (!catalogue || i >= catalogue->n_exact) return false;
    const deck_exact *m = &catalogue->exact[i];
    *out = (model_entry){m->name, m->doc, m->cite, m->params, m->n_params, m->param_size, m};
    return true;
}

static void exact_store(void *field, const model_entry *entry, void *par)
{
    scene_verify *v = field;
    snprintf(v->exact, sizeof v->exact, "%s", entry->name);
    v->exact_par = par;
}

static bool exact_fetch(const void *field, const char **name, const void **par)
{
    const scene_verify *v = field;
    if (!v->exact[0]) return false;
    *name = v->exact;
    *par = v->exact_par;
    return true;
}

static const char *exact_check(const model_entry *entry, const void *par, int dim)
{
    (void)par;
    const deck_exact *m = entry->model;
    if (m->min_dim > 0 && dim < m->min_dim) return "does not hold in a scene of so few dimensions";
    if (m->max_dim > 0 && dim > m->max_dim) return "does not hold in a scene of so many dimensions";
    return NULL;
}

const model_family family_exact = {
    .noun = "exact solution", .get = exact_get, .store = exact_store, .fetch = exact_fetch, .check = exact_check};

static bool reference_get(const deck_catalogue *catalogue, size_t i, model_entry *out)
{
    if (!catalogue || i >= catalogue->n_reference) return false;
    const deck_history_reference *m = &catalogue->reference[i];
    *out = (model_entry){m->name, m->doc, m->cite, m->params, m->n_params, m->param_size, m};
    return true;
}

static void reference_store(void *field, const model_entry *entry, void *par)
{
    scene_verify *v = field;
    snprintf(v->reference, sizeof v->reference, "%s", entry->name);
    v->reference_par = par;
}

static bool reference_fetch(const void *field, const char **name, const void **par)
{
    const scene_verify *v = field;
    if (!v->reference[0]) return false;
    *name = v->reference;
    *par = v->reference_par;
    return true;
}

const model_family family_reference = {
    .noun = "reference", .get = reference_get, .store = reference_store, .fetch = reference_fetch};
