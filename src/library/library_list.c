/* What decks can name, from the registries (floe/floe.h). */
#include "coupling/exchange_law.h"
#include "coupling/reaction.h"
#include "geom/shape.h"
#include "library/library_internal.h"
#include "library/plan.h"
#include "material/membrane.h"
#include "mpm/basis/basis.h"
#include "mpm/normal/normal.h"
#include "mpm/transfer/transfer.h"
#include "verify/history_metric.h"
#include "verify/metric.h"

#include <math.h>
#include <string.h>

/* A default or "required", and the range. */
static void print_param(const param_spec *p, FILE *file)
{
    static const char *const form[] = {[PARAM_POINTS] = "a list of positions",
                                       [PARAM_MODEL] = "one more of these",
                                       [PARAM_MODELS] = "a list of these",
                                       [PARAM_FILE] = "the name of a file, from the deck's folder"};
    if (p->kind != PARAM_NUMBERS) {
        (void)fprintf(file, "      %-22s %s, required: %s\n", p->key ? p->key : "(its value)", form[p->kind], p->doc);
        return;
    }
    char range[128], fallback[48] = "required";
    param_describe_range(p, range, sizeof range);
    if (!isnan(p->fallback)) (void)snprintf(fallback, sizeof fallback, "default %g", p->fallback);
    const bool vector = p->count < 0;
    (void)fprintf(file, "      %-22s %s%s%s, %s%s: %s\n", p->key, strcmp(p->unit, "1") == 0 ? "" : p->unit,
                  strcmp(p->unit, "1") == 0 ? "" : ", ", range, fallback, vector ? ", one for each axis" : "", p->doc);
}

static void print_entry(const char *name, const char *doc, const char *cite, const param_spec *params, size_t n,
                        FILE *file)
{
    (void)fprintf(file, "  %s: %s\n", name, doc ? doc : "");
    if (cite && cite[0]) (void)fprintf(file, "      [%s]\n", cite);
    for (size_t i = 0; i < n; i++) print_param(&params[i], file);
}

static void list_laws(FILE *file)
{
    for (size_t i = 0; i < solid_registry_size; i++) {
        const solid_model *m = solid_registry[i];
        print_entry(m->name, m->doc, m->cite, m->params, m->n_params, file);
    }
}

static void list_membranes(FILE *file)
{
    for (size_t i = 0; i < membrane_registry_size; i++) {
        const membrane_model *m = membrane_registry[i];
        print_entry(m->name, m->doc, m->cite, m->params, m->n_params, file);
    }
}

static void list_eos(FILE *file)
{
    for (size_t i = 0; i < eos_registry_size; i++) {
        const eos_model *m = eos_registry[i];
        print_entry(m->name, m->doc, m->cite, m->params, m->n_params, file);
    }
}

static void list_materials(FILE *file)
{
    (void)fprintf(file,
                  "  A solid has a law, a membrane a law of its own, a fluid an equation of state (eos).\n\nlaws\n");
    list_laws(file);
    (void)fprintf(file, "\nmembranes\n");
    list_membranes(file);
    (void)fprintf(file, "\neos\n");
    list_eos(file);
}

static void list_exchange_role(exchange_role role, FILE *file)
{
    for (size_t i = 0; i < exchange_registry_size; i++) {
        const exchange_model *m = exchange_registry[i];
        const exchange_law *law = &m->law[role];
        if (law->coefficient) print_entry(m->name, m->doc, m->cite, law->params, law->n_params, file);
    }
}

static void list_exchange(FILE *file)
{
    (void)fprintf(file, "\nmomentum, tangential\n");
    list_exchange_role(EXCHANGE_MOMENTUM, file);
    (void)fprintf(file, "\nheat\n");
    list_exchange_role(EXCHANGE_HEAT, file);
}

static void list_reactions(FILE *file)
{
    for (size_t i = 0; i < reaction_registry_size; i++) {
        const reaction_model *m = reaction_registry[i];
        print_entry(m->name, m->doc, m->cite, m->params, m->n_params, file);
    }
}

static void list_shapes(FILE *file)
{
    for (size_t i = 0; i < shape_registry_size; i++) {
        const shape_model *m = shape_registry[i];
        print_entry(m->name, m->doc, NULL, m->params, m->n_params, file);
    }
}

static void list_bases(FILE *file)
{
    for (size_t i = 0; i < basis_registry_size; i++) {
        const basis_model *m = basis_registry[i];
        print_entry(m->name, m->doc, m->cite, NULL, 0, file);
        (void)fprintf(file, "      %d nodes along an axis, %d continuous derivative%s\n", m->support, m->smoothness,
                      m->smoothness == 1 ? "" : "s");
    }
}

static void list_transfers(FILE *file)
{
    for (size_t i = 0; i < transfer_registry_size; i++)
        print_entry(transfer_registry[i]->name, transfer_registry[i]->doc, transfer_registry[i]->cite, NULL, 0, file);
}

static void list_normals(FILE *file)
{
    (void)fprintf(file, "  contact.normals: of bodies on the grid, where they meet\n\n");
    for (size_t i = 0; i < normal_registry_size; i++)
        print_entry(normal_registry[i]->name, normal_registry[i]->doc, normal_registry[i]->cite, NULL, 0, file);
    (void)fprintf(file, "\n  membrane.normals: of membranes, at their points\n\n");
    for (size_t i = 0; i < surface_registry_size; i++) {
        const surface_method *m = surface_registry[i];
        print_entry(m->name, m->doc, m->cite, m->params, m->n_params, file);
    }
}

static void print_provided(const exact_model *m, FILE *file)
{
    (void)fprintf(file, "      gives:");
    for (int q = 0; q < EXACT_QUANTITY_COUNT; q++) {
        if (m->provides & EXACT_BIT(q)) (void)fprintf(file, " %s", exact_quantity_name((exact_quantity)q));
    }
    (void)fprintf(file, "\n      %d to %d dimensions; %s\n", m->min_dim, m->max_dim, m->validity);
}

static void list_exact(FILE *file)
{
    for (size_t i = 0; i < exact_registry_size; i++) {
        const exact_model *m = exact_registry[i];
        print_entry(m->name, m->doc, m->cite, m->params, m->n_params, file);
        print_provided(m, file);
    }
}

static void list_references(FILE *file)
{
    for (size_t i = 0; i < reference_registry_size; i++) {
        const reference_model *m = reference_registry[i];
        print_entry(m->name, m->doc, m->cite, m->params, m->n_params, file);
        (void)fprintf(file, "      gives:\n");
        for (size_t q = 0; q < m->n_quantities; q++) {
            const reference_quantity *quantity = &m->quantities[q];
            (void)fprintf(file, "        %-20s %-4s %s\n", quantity->name, quantity->unit, quantity->doc);
        }
        (void)fprintf(file, "      %s\n", m->validity);
    }
}

static void print_metrics(FILE *file)
{
    for (int k = 0; k < METRIC_COUNT; k++) {
        const metric_description d = metric_describe((metric_kind)k);
        (void)fprintf(file, "  %s: %s\n", d.name, d.doc);
    }
    (void)fprintf(
        file, "  rel_gas_pressure: |p - p_ref - P| / P of the fluid that a load pressurises, P verify.pressure; always "
              "there\n");
    for (int k = 0; k < HISTORY_METRIC_COUNT; k++) {
        const history_metric_kind kind = (history_metric_kind)k;
        (void)fprintf(file, "  %s: %s\n", history_metric_pattern(kind), history_metric_doc(kind));
    }
    (void)fprintf(file, "  The X of hmax_X and its like is a quantity of verify.reference (floe list references).\n");
    (void)fprintf(
        file,
        "  No point or cell is excluded, nothing is smoothed; cells are compared with exact cell averages.\n  X:\n");
    for (int q = 0; q < EXACT_QUANTITY_COUNT; q++) {
        (void)fprintf(file, "      %-18s %-6s %s\n", exact_quantity_name((exact_quantity)q),
                      exact_quantity_unit((exact_quantity)q), exact_quantity_doc((exact_quantity)q));
    }
}

static void list_boundaries(FILE *file)
{
    static const char *const doc[] = {
        [BC_SYMMETRY] = "mirror: normal velocity odd, everything else even; it never lets go",
        [BC_SLIP] = "impermeable, free tangential velocity; solids leave it as they come",
        [BC_NO_SLIP] = "impermeable, tangential velocity of the wall",
        [BC_PERIODIC] = "both sides of an axis are one",
        [BC_INLET] = "fluids: state and velocity given; points: prescribed velocity",
        [BC_OUTLET] = "fluids: zero gradient, pressure given",
        [BC_VELOCITY] = "points: prescribed velocity; fluids: the same at the side's place",
        [BC_FREE] = "points: nothing is imposed; fluids: zero gradient",
        [BC_NON_REFLECTING] = "fluids: waves leave, state far outside given; points: nothing is imposed",
        [BC_RESERVOIR] = "fluids: enter from rest at total pressure and temperature; points: nothing is imposed",
    };
    for (size_t k = 0; k < sizeof doc / sizeof doc[0]; k++)
        (void)fprintf(file, "  %-10s %s\n", bc_name((bc_kind)k), doc[k]);
}

static void print_known_fields(FILE *file)
{
    for (int id = 0; id < FIELD_COUNT; id++) {
        const field_info *f = field_describe((field_id)id);
        (void)fprintf(file, "  %-20s %-7s %-10s %-10s %s: %s\n", plan_field_id((field_id)id),
                      plan_centring(f->centring), plan_class(f->class), f->unit, f->name, f->meaning);
    }
}

static const struct {
    const char *name, *doc;
    void (*print)(FILE *file);
} lists[] = {
    {"materials", "what things can be made of", list_materials},
    {"eos", "equations of state of fluids", list_eos},
    {"laws", "laws of solids", list_laws},
    {"membranes", "laws of membranes and strings", list_membranes},
    {"exchange", "momentum and heat exchange between materials", list_exchange},
    {"reactions", "laws of reactions between fluids", list_reactions},
    {"shapes", "shapes of bodies and regions", list_shapes},
    {"bases", "basis functions of material points", list_bases},
    {"transfers", "what becomes of the velocities of points in a step", list_transfers},
    {"normals", "normals of bodies in contact, and of membranes", list_normals},
    {"exact", "exact solutions", list_exact},
    {"references", "what histories are compared with", list_references},
    {"metrics", "errors that can be measured", print_metrics},
    {"boundaries", "conditions on the sides of the domain", list_boundaries},
    {"fields", "fields that a scene may hold", print_known_fields},
};
enum { LISTS = sizeof lists / sizeof lists[0] };

const char *floe_list_name(int i, const char **doc)
{
    if (i < 0 || i >= LISTS) return NULL;
    if (doc) *doc = lists[i].doc;
    return lists[i].name;
}

floe_status floe_list(floe_context *floe, const char *name, FILE *file)
{
    library_clear_messages(floe);
    for (int k = 0; k < LISTS; k++) {
        if (strcmp(lists[k].name, name) != 0) continue;
        lists[k].print(file);
        return FLOE_OK;
    }
    return fail(floe->ctx, FLOE_BAD_INPUT, "there is no list of '%s'", name);
}
