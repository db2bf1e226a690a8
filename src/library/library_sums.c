/* Sums and the account (floe/floe.h). */
#include "library/library_internal.h"

floe_status floe_sum(floe_simulation *s, floe_totals *totals)
{
    sim_totals t;
    const double scale = output_scale(s->sim);
    *totals = (floe_totals){0};
    library_clear_messages(s->deck->floe);
    TRY(sim_sum(s->sim, &t));
    *totals = (floe_totals){.mass = scale * t.mass,
                            .kinetic_energy = scale * t.kinetic,
                            .strain_energy = scale * t.strain,
                            .internal_energy = scale * t.internal};
    for (int a = 0; a < s->sim->mesh.dim; a++) totals->momentum[a] = scale * t.momentum[a];
    return FLOE_OK;
}

static double entry_of(const ledger *l, ledger_quantity q, ledger_kind kind)
{
    return l->entry[q][kind].value + l->entry[q][kind].carry;
}

floe_status floe_read_balance(floe_simulation *s, floe_quantity quantity, floe_balance *balance)
{
    static const ledger_quantity quantities[] = {
        [FLOE_MASS] = LEDGER_MASS,
        [FLOE_MOMENTUM_X] = LEDGER_MOMENTUM_X,
        [FLOE_MOMENTUM_Y] = LEDGER_MOMENTUM_Y,
        [FLOE_MOMENTUM_Z] = LEDGER_MOMENTUM_Z,
        [FLOE_ENERGY] = LEDGER_ENERGY,
        [FLOE_MOMENT_X] = LEDGER_MOMENT_X,
        [FLOE_MOMENT_Y] = LEDGER_MOMENT_Y,
        [FLOE_MOMENT_Z] = LEDGER_MOMENT_Z,
    };
    const double scale = output_scale(s->sim);
    const ledger *l = &s->sim->ledger;
    sim_totals t;
    *balance = (floe_balance){0};
    library_clear_messages(s->deck->floe);
    if ((size_t)quantity >= sizeof quantities / sizeof quantities[0])
        return fail(s->ctx, FLOE_BAD_INPUT, "there is no quantity %d in the account", (int)quantity);
    TRY(sim_sum(s->sim, &t));
    sim_sum_moments(s->sim, &t);
    sim_update_ledger_from(s->sim, &t);
    const ledger_quantity q = quantities[quantity];
    *balance = (floe_balance){.conserved = !l->not_conserved[q],
                              .start = scale * l->initial[q],
                              .now = scale * l->total[q],
                              .boundary = scale * entry_of(l, q, LEDGER_BOUNDARY),
                              .source = scale * entry_of(l, q, LEDGER_SOURCE),
                              .damping = scale * entry_of(l, q, LEDGER_DAMPING),
                              .defect = scale * entry_of(l, q, LEDGER_DEFECT),
                              .contact = scale * entry_of(l, q, LEDGER_CONTACT),
                              .drift = ledger_drift(l, q),
                              .largest_drift = ledger_largest_drift(l, q)};
    return FLOE_OK;
}
