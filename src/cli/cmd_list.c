/* floe list [TOPIC]: what decks can name, from the registries. */
#include "cli/cli.h"
#include "cli/plan.h"
#include "coupling/exchange_law.h"
#include "coupling/reaction.h"
#include "deck/deck_errors.h"
#include "geom/shape.h"
#include "material/membrane.h"
#include "mpm/basis/basis.h"
#include "mpm/normal/normal.h"
#include "mpm/transfer/transfer.h"
#include "verify/history_metric.h"
#include "verify/metric.h"

#include <math.h>
#include <string.h>

/* A default or "required", and the range. */
static void print_param(const param_spec *p)
{
    static const char *const form[] = {[PARAM_POINTS] = "a list of positions",
                                       [PARAM_MODEL] = "one more of these",
                                       [PARAM_MODELS] = "a list of these",
                                       [PARAM_FILE] = "the name of a file, from the deck's folder"};
    if (p->kind != PARAM_NUMBERS) {
        printf("      %-22s %s, required: %s\n", p->key ? p->key : "(its value)", form[p->kind], p->doc);
        return;
    }
    char range[128], fallback[48] = "required";
    param_describe_range(p, range, sizeof range);
    if (!isnan(p->fallback)) (void)snprintf(fallback, sizeof fallback, "default %g", p->fallback);
    const bool vector = p->count < 0;
    printf("      %-22s %s%s%s, %s%s: %s\n", p->key, strcmp(p->unit, "1") == 0 ? "" : p->unit,
           strcmp(p->unit, "1") == 0 ? "" : ", ", range, fallback, vector ? ", one for each axis" : "", p->doc);
}

static void print_entry(const char *name, const char *doc, const char *cite, const param_spec *params, size_t n)
{
    printf("  %s: %s\n", name, doc ? doc : "");
    if (cite && cite[0]) printf("      [%s]\n", cite);
    for (size_t i = 0; i < n; i++) print_param(&params[i]);
}

static void list_laws(void)
{
    for (size_t i = 0; i < solid_registry_size; i++) {
        const solid_model *m = solid_registry[i];
        print_entry(m->name, m->doc, m->cite, m->params, m->n_params);
    }
}

static void list_membranes(void)
{
    for (size_t i = 0; i < membrane_registry_size; i++) {
        const membrane_model *m = membrane_registry[i];
        print_entry(m->name, m->doc, m->cite, m->params, m->n_params);
    }
}

static void list_eos(void)
{
    for (size_t i = 0; i < eos_registry_size; i++) {
        const eos_model *m = eos_registry[i];
        print_entry(m->name, m->doc, m->cite, m->params, m->n_params);
    }
}

static void list_materials(void)
{
    printf("  A solid has a law, a membrane a law of its own, a fluid an equation of state (eos).\n\nlaws\n");
    list_laws();
    printf("\nmembranes\n");
    list_membranes();
    printf("\neos\n");
    list_eos();
}

static void list_exchange_role(exchange_role role)
{
    for (size_t i = 0; i < exchange_registry_size; i++) {
        const exchange_model *m = exchange_registry[i];
        const exchange_law *law = &m->law[role];
        if (law->coefficient) print_entry(m->name, m->doc, m->cite, law->params, law->n_params);
    }
}

static void list_exchange(void)
{
    printf("\nmomentum, tangential\n");
    list_exchange_role(EXCHANGE_MOMENTUM);
    printf("\nheat\n");
    list_exchange_role(EXCHANGE_HEAT);
}

static void list_reactions(void)
{
    for (size_t i = 0; i < reaction_registry_size; i++) {
        const reaction_model *m = reaction_registry[i];
        print_entry(m->name, m->doc, m->cite, m->params, m->n_params);
    }
}

static void list_shapes(void)
{
    for (size_t i = 0; i < shape_registry_size; i++) {
        const shape_model *m = shape_registry[i];
        print_entry(m->name, m->doc, NULL, m->params, m->n_params);
    }
}

static void list_bases(void)
{
    for (size_t i = 0; i < basis_registry_size; i++) {
        const basis_model *m = basis_registry[i];
        print_entry(m->name, m->doc, m->cite, NULL, 0);
        printf("      %d nodes along an axis, %d continuous derivative%s\n", m->support, m->smoothness,
               m->smoothness == 1 ? "" : "s");
    }
}

static void list_transfers(void)
{
    for (size_t i = 0; i < transfer_registry_size; i++)
        print_entry(transfer_registry[i]->name, transfer_registry[i]->doc, transfer_registry[i]->cite, NULL, 0);
}

static void list_normals(void)
{
    printf("  contact.normals: of bodies on the grid, where they meet\n\n");
    for (size_t i = 0; i < normal_registry_size; i++)
        print_entry(normal_registry[i]->name, normal_registry[i]->doc, normal_registry[i]->cite, NULL, 0);
    printf("\n  membrane.normals: of membranes, at their points\n\n");
    for (size_t i = 0; i < surface_registry_size; i++) {
        const surface_method *m = surface_registry[i];
        print_entry(m->name, m->doc, m->cite, m->params, m->n_params);
    }
}

static void print_provided(const exact_model *m)
{
    printf("      gives:");
    for (int q = 0; q < EXACT_QUANTITY_COUNT; q++) {
        if (m->provides & EXACT_BIT(q)) printf(" %s", exact_quantity_name((exact_quantity)q));
    }
    printf("\n      %d to %d dimensions; %s\n", m->min_dim, m->max_dim, m->validity);
}

static void list_exact(void)
{
    for (size_t i = 0; i < exact_registry_size; i++) {
        const exact_model *m = exact_registry[i];
        print_entry(m->name, m->doc, m->cite, m->params, m->n_params);
        print_provided(m);
    }
}

static void list_references(void)
{
    for (size_t i = 0; i < reference_registry_size; i++) {
        const reference_model *m = reference_registry[i];
        print_entry(m->name, m->doc, m->cite, m->params, m->n_params);
        printf("      gives:\n");
        for (size_t q = 0; q < m->n_quantities; q++) {
            const reference_quantity *quantity = &m->quantities[q];
            printf("        %-20s %-4s %s\n", quantity->name, quantity->unit, quantity->doc);
        }
        printf("      %s\n", m->validity);
    }
}

static void print_metrics(void)
{
    for (int k = 0; k < METRIC_COUNT; k++) {
        const metric_description d = metric_describe((metric_kind)k);
        printf("  %s: %s\n", d.name, d.doc);
    }
    printf("  rel_gas_pressure: |p - p_ref - P| / P of the fluid that a load pressurises, P verify.pressure; always "
           "there\n");
    for (int k = 0; k < HISTORY_METRIC_COUNT; k++) {
        const history_metric_kind kind = (history_metric_kind)k;
        printf("  %s: %s\n", history_metric_pattern(kind), history_metric_doc(kind));
    }
    printf("  The X of hmax_X and its like is a quantity of verify.reference (floe list references).\n");
    printf("  No point or cell is excluded, nothing is smoothed; cells are compared with exact cell averages.\n  X:\n");
    for (int q = 0; q < EXACT_QUANTITY_COUNT; q++) {
        printf("      %-18s %-6s %s\n", exact_quantity_name((exact_quantity)q), exact_quantity_unit((exact_quantity)q),
               exact_quantity_doc((exact_quantity)q));
    }
}

static void list_boundaries(void)
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
    for (size_t k = 0; k < sizeof doc / sizeof doc[0]; k++) printf("  %-10s %s\n", bc_name((bc_kind)k), doc[k]);
}

static void print_fields(void)
{
    for (int id = 0; id < FIELD_COUNT; id++) {
        const field_info *f = field_describe((field_id)id);
        printf("  %-20s %-7s %-10s %-10s %s: %s\n", plan_field_id((field_id)id), plan_centring(f->centring),
               plan_class(f->class), f->unit, f->name, f->meaning);
    }
}

static const struct {
    const char *name, *doc;
    void (*print)(void);
} topics[] = {
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
    {"fields", "fields that a scene may hold", print_fields},
};
enum { TOPICS = sizeof topics / sizeof topics[0] };

static const char *topic_name(const void *user, size_t i)
{
    (void)user;
    return i < TOPICS ? topics[i].name : NULL;
}

static error_t parse_list_option(int key, char *arg, struct argp_state *state)
{
    int *chosen = state->input;
    if (key != ARGP_KEY_ARG) return ARGP_ERR_UNKNOWN;
    for (int k = 0; k < TOPICS; k++) {
        if (strcmp(topics[k].name, arg) == 0) {
            *chosen = k;
            return 0;
        }
    }
    const char *near = nearest_name(arg, topic_name, NULL);
    argp_error(state, "there is no list of '%s'%s%s%s; `floe list` names them all", arg, near ? " (did you mean '" : "",
               near ? near : "", near ? "'?)" : "");
    return 0;
}

static const struct argp argp = {
    .parser = parse_list_option,
    .args_doc = "[TOPIC]",
    .doc = "List what decks can name, with parameters, units, defaults and sources. TOPIC is one of materials, eos, "
           "laws, membranes, exchange, reactions, shapes, bases, normals, exact, references, metrics, boundaries, "
           "fields; without one the topics are listed.",
};

int cmd_list(cli *c, int argc, char **argv)
{
    int chosen = -1;
    (void)c;
    argp_parse(&argp, argc, argv, 0, NULL, &chosen);
    if (chosen >= 0) {
        printf("%s\n", topics[chosen].name);
        topics[chosen].print();
        return 0;
    }
    for (int k = 0; k < TOPICS; k++) printf("  %-10s  %s\n", topics[k].name, topics[k].doc);
    return 0;
}
