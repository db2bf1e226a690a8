/* Laws of a program's own (floe/law.h). */
#include "library/library_internal.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

/* What both kinds of laws say of themselves. */
typedef struct law_head {
    const char *kind, *name; /* "law" or "equation of state" */
    size_t parameter_size;
    const floe_parameter *parameters;
    size_t n_parameters;
} law_head;

static bool is_word(const char *text)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
    return text && text[0] && strlen(text) < SCENE_NAME && strspn(text, letters) == strlen(text);
}

static floe_status check_parameter(context *ctx, const law_head *h, const floe_parameter *p)
{
    if (!is_word(p->key))
        return fail(ctx, FLOE_BAD_INPUT, "%s '%s': the key of a parameter is letters, digits and '_', not '%.60s'",
                    h->kind, h->name, p->key ? p->key : "");
    const size_t bytes = p->count > 0 ? (size_t)p->count * sizeof(double) : 0;
    if (bytes == 0 || p->offset > h->parameter_size || bytes > h->parameter_size - p->offset)
        return fail(ctx, FLOE_BAD_INPUT,
                    "%s '%s': parameter '%s' lies outside its struct: offset %zu, count %d, size of the struct %zu",
                    h->kind, h->name, p->key, p->offset, p->count, h->parameter_size);
    if (p->offset % sizeof(double) != 0)
        return fail(ctx, FLOE_BAD_INPUT, "%s '%s': parameter '%s' is no double at offset %zu", h->kind, h->name, p->key,
                    p->offset);
    if (p->range < FLOE_ANY || p->range > FLOE_BETWEEN || (p->range == FLOE_BETWEEN && !(p->lo <= p->hi)))
        return fail(ctx, FLOE_BAD_INPUT, "%s '%s': parameter '%s' has no range", h->kind, h->name, p->key);
    for (const floe_parameter *other = h->parameters; other < p; other++)
        if (strcmp(other->key, p->key) == 0)
            return fail(ctx, FLOE_BAD_INPUT, "%s '%s': two parameters are named '%s'", h->kind, h->name, p->key);
    return FLOE_OK;
}

static floe_status check_head(context *ctx, const law_head *h)
{
    if (!is_word(h->name))
        return fail(ctx, FLOE_BAD_INPUT, "the name of a %s is letters, digits and '_', not '%.60s'", h->kind,
                    h->name ? h->name : "");
    for (size_t i = 0; i < h->n_parameters; i++) TRY(check_parameter(ctx, h, &h->parameters[i]));
    return FLOE_OK;
}

static floe_status refuse_name(context *ctx, const law_head *h)
{
    return fail(ctx, FLOE_BAD_INPUT, "there is a %s '%s' already: give yours another name", h->kind, h->name);
}

/* As the deck reads them; the caller owns the table. */
static floe_status copy_parameters(context *ctx, const law_head *h, const param_spec **out)
{
    static const param_range range[] = {[FLOE_ANY] = PARAM_ANY,
                                        [FLOE_POSITIVE] = PARAM_POSITIVE,
                                        [FLOE_NONNEGATIVE] = PARAM_NONNEGATIVE,
                                        [FLOE_BETWEEN] = PARAM_BETWEEN};
    param_spec *spec;
    TRY(memory_new(ctx, &spec, h->n_parameters, sizeof *spec));
    for (size_t i = 0; i < h->n_parameters; i++) {
        const floe_parameter *p = &h->parameters[i];
        spec[i] = (param_spec){.key = p->key,
                               .unit = p->unit ? p->unit : "1",
                               .range = range[p->range],
                               .lo = p->lo,
                               .hi = p->hi,
                               .fallback = p->fallback,
                               .offset = p->offset,
                               .count = p->count,
                               .doc = p->doc ? p->doc : ""};
    }
    *out = spec;
    return FLOE_OK;
}

static floe_status check_size(context *ctx, const char *kind, size_t size, size_t ours)
{
    if (size == ours) return FLOE_OK;
    return fail(ctx, FLOE_BAD_INPUT,
                "the %s has %zu bytes and not %zu: set `size`, and build with the header of this library", kind, size,
                ours);
}

static floe_status check_history(context *ctx, const floe_solid_law *law)
{
    if (law->n_history < 0 || law->n_history > FLOE_LAW_HISTORY || (law->n_history > 0 && !law->history))
        return fail(ctx, FLOE_BAD_INPUT, "law '%s': 0 to %d history variables, not %d", law->name, FLOE_LAW_HISTORY,
                    law->n_history);
    for (int i = 0; i < law->n_history; i++)
        if (!is_word(law->history[i].name) || !law->history[i].unit || !law->history[i].doc)
            return fail(ctx, FLOE_BAD_INPUT, "law '%s': history variable %d needs a name, a unit and a line of doc",
                        law->name, i);
    return FLOE_OK;
}

static floe_status check_solid_law(floe_context *floe, const floe_solid_law *law, const law_head *h)
{
    context *ctx = floe->ctx;
    TRY(check_size(ctx, "law", law->size, sizeof *law));
    TRY(check_head(ctx, h));
    TRY(check_history(ctx, law));
    if (!law->stress || !law->wave_speed || !law->bulk_modulus || !law->shear_modulus)
        return fail(ctx, FLOE_BAD_INPUT, "law '%s' needs stress, wave_speed, bulk_modulus and shear_modulus",
                    law->name);
    if (law->needs & ~(unsigned)(FLOE_NEEDS_F | FLOE_HAS_ENERGY | FLOE_NEEDS_TEMPERATURE | FLOE_NEEDS_TIME))
        return fail(ctx, FLOE_BAD_INPUT, "law '%s' needs what floe does not know: %u", law->name, law->needs);
    for (size_t i = 0; i < floe->n_law; i++)
        if (strcmp(floe->law[i].name, law->name) == 0) return refuse_name(ctx, h);
    return solid_find(law->name) ? refuse_name(ctx, h) : FLOE_OK;
}

floe_status floe_add_solid_law(floe_context *floe, const floe_solid_law *law)
{
    const law_head h = {"law", law->name, law->parameter_size, law->parameters, law->n_parameters};
    library_clear_messages(floe);
    TRY(check_solid_law(floe, law, &h));
    if (floe->n_law == LIBRARY_MAX_LAWS)
        return fail(floe->ctx, FLOE_BAD_INPUT, "a context takes %d laws", LIBRARY_MAX_LAWS);
    if (!floe->law) TRY(memory_new(floe->ctx, &floe->law, LIBRARY_MAX_LAWS, sizeof *floe->law));
    solid_model m = {.name = law->name,
                     .doc = law->doc ? law->doc : "",
                     .cite = "",
                     .param_size = law->parameter_size,
                     .n_params = law->n_parameters,
                     .needs = law->needs,
                     .history = law->history,
                     .n_history = law->n_history,
                     .stress = law->stress,
                     .wave_speed = law->wave_speed,
                     .strain_energy = law->strain_energy,
                     .bulk_modulus = law->bulk_modulus,
                     .shear_modulus = law->shear_modulus,
                     .yield_stress = law->yield_stress};
    TRY(copy_parameters(floe->ctx, &h, &m.params));
    floe->law[floe->n_law++] = m;
    return FLOE_OK;
}

static floe_status check_eos(floe_context *floe, const floe_equation_of_state *e, const law_head *h)
{
    context *ctx = floe->ctx;
    TRY(check_size(ctx, "equation of state", e->size, sizeof *e));
    TRY(check_head(ctx, h));
    if (!e->pressure || !e->temperature || !e->energy || !e->volume || !e->dpde || !e->heat || !e->pressure_floor ||
        !e->energy_floor)
        return fail(
            ctx, FLOE_BAD_INPUT,
            "equation of state '%s' needs pressure, temperature, energy, volume, dpde, heat, pressure_floor and "
            "energy_floor",
            e->name);
    for (size_t i = 0; i < floe->n_eos; i++)
        if (strcmp(floe->eos[i].name, e->name) == 0) return refuse_name(ctx, h);
    return eos_find(e->name) ? refuse_name(ctx, h) : FLOE_OK;
}

floe_status floe_add_equation_of_state(floe_context *floe, const floe_equation_of_state *e)
{
    const law_head h = {"equation of state", e->name, e->parameter_size, e->parameters, e->n_parameters};
    library_clear_messages(floe);
    TRY(check_eos(floe, e, &h));
    if (floe->n_eos == LIBRARY_MAX_LAWS)
        return fail(floe->ctx, FLOE_BAD_INPUT, "a context takes %d equations of state", LIBRARY_MAX_LAWS);
    if (!floe->eos) TRY(memory_new(floe->ctx, &floe->eos, LIBRARY_MAX_LAWS, sizeof *floe->eos));
    eos_model m = {.name = e->name,
                   .doc = e->doc ? e->doc : "",
                   .cite = "",
                   .param_size = e->parameter_size,
                   .n_params = e->n_parameters,
                   .pressure = e->pressure,
                   .temperature = e->temperature,
                   .energy = e->energy,
                   .volume = e->volume,
                   .dpde = e->dpde,
                   .heat = e->heat,
                   .pressure_floor = e->pressure_floor,
                   .energy_floor = e->energy_floor,
                   .density_limit = e->density_limit,
                   .check = e->check};
    TRY(copy_parameters(floe->ctx, &h, &m.params));
    floe->eos[floe->n_eos++] = m;
    return FLOE_OK;
}
