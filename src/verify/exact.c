#include "verify/exact.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

typedef struct quantity_entry {
    const char *name, *unit, *doc;
} quantity_entry;

static const quantity_entry quantity_table[] = {
#define EXACT_QUANTITY_ENTRY(enumerator, name_, unit_, doc_) [enumerator] = {name_, unit_, doc_},
    EXACT_QUANTITY_LIST(EXACT_QUANTITY_ENTRY)
#undef EXACT_QUANTITY_ENTRY
};

static const quantity_entry no_quantity = {"", "", ""};

static const quantity_entry *quantity_at(exact_quantity quantity)
{
    return (size_t)quantity < EXACT_QUANTITY_COUNT ? &quantity_table[quantity] : &no_quantity;
}

const char *exact_quantity_name(exact_quantity quantity)
{
    return quantity_at(quantity)->name;
}

const char *exact_quantity_unit(exact_quantity quantity)
{
    return quantity_at(quantity)->unit;
}

const char *exact_quantity_doc(exact_quantity quantity)
{
    return quantity_at(quantity)->doc;
}

exact_quantity exact_quantity_find(const char *name)
{
    size_t i = 0;
    while (i < EXACT_QUANTITY_COUNT && strcmp(quantity_table[i].name, name) != 0) i++;
    return (exact_quantity)i;
}

const exact_model *exact_find(const char *name)
{
    for (size_t i = 0; i < exact_registry_size; i++) {
        if (strcmp(exact_registry[i]->name, name) == 0) return exact_registry[i];
    }
    return NULL;
}

double *exact_param(const exact_model *model, void *par, const char *key)
{
    return param_find(model->params, model->n_params, par, key);
}

floe_status exact_create(context *ctx, const exact_model *model, const void *par, int dim, exact *out)
{
    *out = (exact){.dim = 0};
    if (dim < model->min_dim || dim > model->max_dim) {
        return fail_key(ctx, KEY("verify", "exact"),
                        "the exact solution '%s' has %d to %d dimensions, the scene has %d", model->name,
                        model->min_dim, model->max_dim, dim);
    }
    void *prepared = NULL;
    TRY(memory_new(ctx, &prepared, 1, model->prepared_size));
    if (model->prepare != NULL) {
        const floe_status status = model->prepare(ctx, par, dim, prepared);
        if (status != FLOE_OK) {
            memory_free(ctx, &prepared);
            return fail_under(ctx, status, KEY("verify", "exact", model->name));
        }
    }
    *out = (exact){model, dim, par, prepared};
    return FLOE_OK;
}

void exact_destroy(context *ctx, exact *solution)
{
    if (solution == NULL) return;
    memory_free(ctx, &solution->prepared);
    *solution = (exact){.dim = 0};
}

bool exact_is_solid(const exact *solution)
{
    const exact_equations e = solution->model->equations;
    return e == EXACT_SOLID || e == EXACT_LARGE_SOLID;
}

bool exact_is_fluid(const exact *solution)
{
    const exact_equations e = solution->model->equations;
    return !solution->model->of_solids_too &&
           (e == EXACT_EULER || e == EXACT_NAVIER_STOKES || e == EXACT_LINEAR_ACOUSTICS || e == EXACT_INCOMPRESSIBLE);
}

bool exact_provides(const exact *solution, exact_quantity quantity)
{
    return (size_t)quantity < EXACT_QUANTITY_COUNT && (solution->model->provides & EXACT_BIT(quantity)) != 0;
}

double exact_value(const exact *solution, exact_quantity quantity, const double x[3], double t)
{
    if (!exact_provides(solution, quantity)) return NAN;
    if (quantity == EXACT_NORMAL) return 0.0;
    return solution->model->value(solution->par, solution->prepared, quantity, solution->dim, x, t);
}

void exact_body_force(const exact *solution, const double x[3], double t, double force[3])
{
    for (int i = 0; i < 3; i++) force[i] = 0.0;
    if (solution->model->body_force == NULL) return;
    solution->model->body_force(solution->par, solution->prepared, solution->dim, x, t, force);
}

double exact_heat_source(const exact *solution, const double x[3], double t)
{
    if (solution->model->heat_source == NULL) return 0.0;
    return solution->model->heat_source(solution->par, solution->prepared, solution->dim, x, t);
}

exact_breaks exact_find_breaks(const exact *solution, double t)
{
    exact_breaks out = {.count = 0};
    if (solution->model->breaks != NULL) solution->model->breaks(solution->par, solution->prepared, t, &out);
    return out;
}

double exact_accuracy(const exact *solution)
{
    const exact_model *m = solution->model;
    return m && m->accuracy ? m->accuracy(solution->par, solution->prepared) : 0.0;
}
