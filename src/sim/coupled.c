/* The coupled step (theory 5.1; Guilkey et al. 2003, section 2.4): stages of points and cells, interleaved on one
 * mesh. */
#include "sim/coupled.h"

#include "base/memory.h"
#include "coupling/node_cell_transfer.h"

#include <string.h>

/* Temperature of the cells of a solid whose points carry none (K): that of its first body. */
static double temperature_of(const scene *s, int material)
{
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].material == material) return s->body[b].temperature;
    return s->ambient_temperature;
}

static transfer_pair pair_of(const sim *s, const mpm_body *b, int material)
{
    return (transfer_pair){.group = b->group,
                           .material = material,
                           .temperature = temperature_of(s->scene, b->scene_material),
                           .specific_heat = b->specific_heat,
                           .warms = b->warms,
                           .exchanges = b->warms && s->ice->heats_points,
                           .reaction = ice_burning_of(s->ice, material)};
}

/* One pair for every solid: its velocity group at the nodes, its material in the cells. */
static floe_status make_pairs(transfer *t, const sim *s)
{
    for (int r = 0; r < s->ice->n_materials; ++r) {
        if (!s->ice->material[r].points) continue;
        for (int b = 0; b < s->mpm->n_bodies; ++b) {
            if (s->mpm->body[b].scene_material != s->ice->material[r].scene_material) continue;
            if (t->n_pairs == TRANSFER_MAX_PAIRS)
                return fail_key(s->ctx, KEY("materials"), "more than %d solid materials cannot be coupled",
                                TRANSFER_MAX_PAIRS);
            t->pair[t->n_pairs++] = pair_of(s, &s->mpm->body[b], r);
            break;
        }
    }
    return FLOE_OK;
}

floe_status transfer_create(transfer **out, sim *s)
{
    TRY(memory_new(s->ctx, out, 1, sizeof **out));
    transfer *t = *out;
    t->ctx = s->ctx;
    t->mesh = &s->mesh;
    t->stages = &s->stages;
    t->reference_pressure = s->scene->reference_pressure;
    memcpy(t->gravity, s->ice->gravity, sizeof t->gravity);
    return make_pairs(t, s);
}

void transfer_destroy(transfer **t)
{
    if (t && *t) memory_free((*t)->ctx, t);
}

floe_status coupled_refresh(sim *s)
{
    TRY(mpm_points_to_nodes(s->mpm));
    if (s->mpm->carries[P_TEMP]) TRY(mpm_heat_to_nodes(s->mpm)); /* beside cells all heat is on the nodes */
    return transfer_nodes_to_cells(s->transfer);
}

floe_status coupled_step(sim *s)
{
    mpm *p = s->mpm;
    transfer *t = s->transfer;
    TRY(mpm_begin_step(p));
    t->dt = s->ice->dt;
    memcpy(t->gravity, s->ice->gravity, sizeof t->gravity);
    TRY(mpm_mass_stages(p));
    STAGE(t, ALWAYS, transfer_nodes_to_cells, READS(N_MASS, N_MOMENTUM, WHEN(p->carries[P_TEMP], N_HEAT)),
          WRITES(C_RHO, C_VEL, C_TEMP));
    TRY(mpm_conduction_stages(p));
    TRY(ice_state_stages(s->ice));
    STAGE(t, p->carries[P_SHARE], transfer_share_to_nodes, READS(C_REACTED, C_RHO), WRITES(C_REACTED, N_BURNT_SHARE));
    TRY(mpm_burn_stages(p));
    STAGE(t, p->carries[P_SHARE], transfer_burnt_to_cells, READS(C_REACTED, N_BURNT, N_BURNT_MOMENTUM, N_BURNT_ENERGY),
          WRITES(C_REACTED, C_BURNT_MOMENTUM, C_BURNT_ENERGY));
    TRY(ice_pressure_stages(s->ice));
    STAGE(t, ALWAYS, transfer_pressure_to_nodes, READS(C_PRESSURE_ADVANCED), WRITES(C_PRESSURE_ADVANCED, N_PRESSURE));
    STAGE(p, ALWAYS, mpm_grid_pressure, READS(N_PRESSURE, P_POS), WRITES(N_PRESSURE, P_GRID_PRESSURE));
    TRY(mpm_force_stages(p));
    STAGE(t, ALWAYS, transfer_momentum_to_cells, READS(N_MASS, N_VEL_L), WRITES(C_MOMENTUM_L));
    TRY(ice_exchange_stages(s->ice));
    STAGE(t, ALWAYS, transfer_change_to_nodes, READS(C_VELOCITY_CHANGE, N_MASS, N_VEL_L),
          WRITES(C_VELOCITY_CHANGE, N_VEL_L)); /* ghosts of the cells are filled */
    STAGE(t, s->ice->heats_points, transfer_temperature_to_nodes, READS(C_TEMP_CHANGE, N_CAPACITY, N_TEMP_CHANGE),
          WRITES(C_TEMP_CHANGE, N_TEMP_CHANGE)); /* likewise */
    STAGE(t, ALWAYS, transfer_momentum_before, READS(N_MASS, N_VEL_L), WRITES(C_STRESS_ACCEL));
    TRY(mpm_node_stages(p));
    STAGE(t, ALWAYS, transfer_stress_to_cells, READS(N_MASS, N_VEL_L, C_MOMENTUM_L, C_RHO, C_VEL, C_STRESS_ACCEL),
          WRITES(C_VELOCITY_CHANGE, C_STRESS_ACCEL));
    TRY(mpm_point_stages(p));
    TRY(ice_advection_stages(s->ice));
    return FLOE_OK;
}

/* Volume fractions that the solids take of the cells at the start, in each block. */
static floe_status taken_volume(sim *s, double *taken[MESH_MAX_BLOCKS])
{
    for (int b = 0; b < s->mesh.n_blocks; ++b) {
        const block *bl = &s->mesh.block[b];
        TRY(memory_new(s->ctx, &taken[b], bl->size, sizeof(double)));
        for (int pair = 0; pair < s->transfer->n_pairs; ++pair) {
            const int r = s->transfer->pair[pair].material;
            const double *rho = field_get(s->domain->fields[b], C_RHO, r, 0);
            const double density = s->scene->material[s->ice->material[r].scene_material].density;
            for (size_t k = 0; k < bl->size; ++k) taken[b][k] += rho[k] / density;
        }
    }
    return FLOE_OK;
}

floe_status coupled_initialise(sim *s)
{
    double *taken[MESH_MAX_BLOCKS] = {0};
    s->transfer->domain = s->domain;
    TRY(coupled_refresh(s));
    floe_status status = taken_volume(s, taken);
    if (status == FLOE_OK) status = ice_initialise(s->ice, taken);
    for (int b = 0; b < MESH_MAX_BLOCKS; ++b) memory_free(s->ctx, &taken[b]);
    return status;
}
