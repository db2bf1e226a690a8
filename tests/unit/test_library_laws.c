/* Laws of a program's own: refused with a reason, read from decks, kept in checkpoints, and to the bits of floe's. */
#include "check.h"

#include "floe/floe.h"
#include "material/eos.h"
#include "material/solid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct gas_par {
    double gamma, specific_heat;
} gas_par;

static const floe_parameter gas_parameters[] = {
    {.key = "gamma",
     .unit = "1",
     .range = FLOE_BETWEEN,
     .lo = 1.001,
     .hi = 20.0,
     .fallback = 1.4,
     .offset = offsetof(gas_par, gamma),
     .count = 1},
    {.key = "specific_heat",
     .unit = "J/kg/K",
     .range = FLOE_POSITIVE,
     .fallback = NAN,
     .offset = offsetof(gas_par, specific_heat),
     .count = 1,
     .doc = "c_v"},
};

/* floe's ideal gas under another name. */
static floe_equation_of_state my_gas(void)
{
    const eos_model *m = eos_find("ideal");
    return (floe_equation_of_state){.size = sizeof(floe_equation_of_state),
                                    .name = "my_gas",
                                    .parameter_size = sizeof(gas_par),
                                    .parameters = gas_parameters,
                                    .n_parameters = 2,
                                    .pressure = m->pressure,
                                    .temperature = m->temperature,
                                    .energy = m->energy,
                                    .volume = m->volume,
                                    .dpde = m->dpde,
                                    .heat = m->heat,
                                    .pressure_floor = m->pressure_floor,
                                    .energy_floor = m->energy_floor};
}

/* floe's J2 plasticity under another name: it has a history. */
static floe_solid_law my_metal(floe_parameter *parameters)
{
    const solid_model *m = solid_find("j2");
    for (size_t i = 0; i < m->n_params; i++)
        parameters[i] = (floe_parameter){.key = m->params[i].key,
                                         .unit = m->params[i].unit,
                                         .range = (floe_range)m->params[i].range,
                                         .lo = m->params[i].lo,
                                         .hi = m->params[i].hi,
                                         .fallback = m->params[i].fallback,
                                         .offset = m->params[i].offset,
                                         .count = m->params[i].count};
    return (floe_solid_law){.size = sizeof(floe_solid_law),
                            .name = "my_metal",
                            .parameter_size = m->param_size,
                            .parameters = parameters,
                            .n_parameters = m->n_params,
                            .needs = m->needs,
                            .history = m->history,
                            .n_history = m->n_history,
                            .stress = m->stress,
                            .wave_speed = m->wave_speed,
                            .strain_energy = m->strain_energy,
                            .bulk_modulus = m->bulk_modulus,
                            .shear_modulus = m->shear_modulus,
                            .yield_stress = m->yield_stress};
}

static void accepted(floe_context *floe, floe_status status)
{
    if (status != FLOE_OK) print_error("%s\n", floe_message(floe));
    assert_int_equal(status, FLOE_OK);
}

static void refused(floe_context *floe, floe_status status, const char *words)
{
    assert_int_equal(status, FLOE_BAD_INPUT);
    if (!strstr(floe_message(floe), words)) print_error("'%s' has no '%s'\n", floe_message(floe), words);
    assert_non_null(strstr(floe_message(floe), words));
}

static void refuses_laws_with_a_reason(void **state)
{
    (void)state;
    floe_context *floe = floe_create();
    floe_parameter odd = gas_parameters[0];
    floe_equation_of_state e = my_gas();
    assert_int_equal(floe_add_equation_of_state(floe, &e), FLOE_OK);
    refused(floe, floe_add_equation_of_state(floe, &e), "already");
    e.name = "ideal";
    refused(floe, floe_add_equation_of_state(floe, &e), "already");
    e.name = "a gas";
    refused(floe, floe_add_equation_of_state(floe, &e), "letters");
    e.name = "other";
    e.size = 8;
    refused(floe, floe_add_equation_of_state(floe, &e), "size");
    e = my_gas();
    e.name = "other";
    e.dpde = NULL;
    refused(floe, floe_add_equation_of_state(floe, &e), "dpde");
    e = my_gas();
    e.name = "other";
    e.parameters = &odd;
    e.n_parameters = 1;
    odd.offset = sizeof(gas_par);
    refused(floe, floe_add_equation_of_state(floe, &e), "outside its struct");
    odd.offset = 0;
    odd.count = 3;
    refused(floe, floe_add_equation_of_state(floe, &e), "outside its struct");
    odd.count = -3;
    refused(floe, floe_add_equation_of_state(floe, &e), "outside its struct");
    odd.count = 1;
    odd.key = "";
    refused(floe, floe_add_equation_of_state(floe, &e), "key");
    odd.key = "gamma";
    assert_int_equal(floe_add_equation_of_state(floe, &e), FLOE_OK);
    floe_parameter parameters[32];
    floe_solid_law law = my_metal(parameters);
    law.wave_speed = NULL;
    refused(floe, floe_add_solid_law(floe, &law), "wave_speed");
    law = my_metal(parameters);
    law.n_history = FLOE_LAW_HISTORY + 1;
    refused(floe, floe_add_solid_law(floe, &law), "history");
    law = my_metal(parameters);
    law.name = "neo_hookean";
    refused(floe, floe_add_solid_law(floe, &law), "already");
    law.name = "my_metal";
    law.needs = 64;
    refused(floe, floe_add_solid_law(floe, &law), "64");
    floe_destroy(&floe);
}

static const char sod[] = FLOE_SOURCE_DIR "/inputs/sod.yaml";

/* A field at the end of a deck; the caller frees. */
static double *field_at_end(floe_context *floe, const char *path, const char *const *set, size_t n_set,
                            const char *name, size_t *n)
{
    floe_deck *deck;
    floe_simulation *s;
    accepted(floe, floe_load(floe, path, set, n_set, &deck));
    accepted(floe, floe_simulation_create(deck, NULL, &s));
    accepted(floe, floe_advance(s, floe_end_time(s)));
    accepted(floe, floe_copy_field(s, name, NULL, 0, n));
    double *to = malloc(*n * sizeof *to);
    assert_int_equal(floe_copy_field(s, name, to, *n, NULL), FLOE_OK);
    floe_simulation_destroy(&s);
    floe_deck_destroy(&deck);
    return to;
}

static void compare_fields(floe_context *floe, const char *path, const char *const *set, size_t n_set, const char *name)
{
    size_t n, again;
    double *own = field_at_end(floe, path, set, n_set, name, &n);
    double *floes = field_at_end(floe, path, set + 1, n_set - 1, name, &again);
    assert_int_equal(n, again);
    assert_memory_equal(own, floes, n * sizeof *own);
    free(own);
    free(floes);
}

static void gives_the_bits_of_the_same_law(void **state)
{
    (void)state;
    static const char *const as_ice[] = {"materials.gas.eos={my_gas: {specific_heat: 1}}", "domain.cell=0.02",
                                         "coupling=ice", "verify=null"};
    static const char *const as_mpm[] = {"materials.gas.eos={my_gas: {specific_heat: 1}}", "domain.cell=0.05",
                                         "coupling=mpm", "verify=null"};
    floe_context *floe = floe_create();
    const floe_equation_of_state e = my_gas();
    assert_int_equal(floe_init(), FLOE_OK);
    assert_int_equal(floe_add_equation_of_state(floe, &e), FLOE_OK);
    compare_fields(floe, sod, as_ice, 4, "cells/density_gas");
    compare_fields(floe, sod, as_mpm, 4, "points/left/stress_xx");
    floe_destroy(&floe);
}

static void reads_parameters_like_any_other(void **state)
{
    (void)state;
    static const char *const missing[] = {"materials.gas.eos={my_gas: {gamma: 1.3}}"},
                             *const range[] = {"materials.gas.eos={my_gas: {gamma: 0.9, specific_heat: 1}}"},
                             *const unknown[] = {"materials.gas.eos={my_gass: {}}"};
    floe_context *floe = floe_create();
    floe_deck *deck;
    const floe_equation_of_state e = my_gas();
    assert_int_equal(floe_init(), FLOE_OK);
    assert_int_equal(floe_load(floe, sod, missing, 1, &deck), FLOE_BAD_INPUT);
    assert_int_equal(floe_add_equation_of_state(floe, &e), FLOE_OK);
    refused(floe, floe_load(floe, sod, missing, 1, &deck), "specific_heat");
    refused(floe, floe_load(floe, sod, range, 1, &deck), "1.001");
    refused(floe, floe_load(floe, sod, unknown, 1, &deck), "my_gas");
    floe_destroy(&floe);
}

static const char bar[] = "floe: 1\n"
                          "coupling: mpm\n"
                          "domain: {dim: 1, stress_state: uniaxial_strain, lower: 0 m, upper: 1 m, cell: 0.05 m}\n"
                          "boundaries: {x: free}\n"
                          "materials: {metal: {density: 8000 kg/m^3, law: {%s: {bulk_modulus: 140 GPa, "
                          "shear_modulus: 80 GPa, yield_stress: 0.2 GPa}}}}\n"
                          "bodies:\n"
                          "  left: {material: metal, shape: {box: {lower: 0.2 m, upper: 0.5 m}}, velocity: 60 m/s}\n"
                          "  right: {material: metal, shape: {box: {lower: 0.5 m, upper: 0.8 m}}}\n"
                          "time: {end: 60 us}\n";

/* A law with a history: in fields by its name, and through a checkpoint to the same bits. */
static void keeps_histories(void **state)
{
    (void)state;
    floe_context *floe = floe_create();
    floe_parameter parameters[32];
    const floe_solid_law law = my_metal(parameters);
    char text[2048], path[64] = "/tmp/floe-test-XXXXXX", file[96], name[96];
    double *end[2];
    size_t n[2];
    assert_int_equal(floe_init(), FLOE_OK);
    assert_non_null(mkdtemp(path));
    (void)snprintf(file, sizeof file, "%s/state.h5", path);
    assert_int_equal(floe_add_solid_law(floe, &law), FLOE_OK);
    check_true(law.n_history > 0);
    (void)snprintf(name, sizeof name, "points/left/%s", law.history[0].name);
    for (int own = 0; own < 2; own++) {
        floe_deck *deck;
        floe_simulation *s;
        (void)snprintf(text, sizeof text, bar, own ? "my_metal" : "j2");
        accepted(floe, floe_load_text(floe, "bar", text, NULL, 0, &deck));
        assert_int_equal(floe_simulation_create(deck, NULL, &s), FLOE_OK);
        if (own) {
            assert_int_equal(floe_advance(s, 30e-6), FLOE_OK);
            assert_int_equal(floe_save(s, file), FLOE_OK);
            floe_simulation_destroy(&s);
            assert_int_equal(floe_simulation_create(deck, NULL, &s), FLOE_OK);
            accepted(floe, floe_restore(s, file));
        } else {
            assert_int_equal(floe_advance(s, 30e-6), FLOE_OK);
            assert_int_equal(floe_restore(s, "/dev/null"), FLOE_IO);
        }
        accepted(floe, floe_advance(s, 60e-6)); /* 60 us is another double */
        assert_int_equal(floe_copy_field(s, name, NULL, 0, &n[own]), FLOE_OK);
        end[own] = malloc(n[own] * sizeof(double));
        assert_int_equal(floe_copy_field(s, name, end[own], n[own], NULL), FLOE_OK);
        floe_simulation_destroy(&s);
        floe_deck_destroy(&deck);
    }
    double most = 0.0;
    for (size_t i = 0; i < n[0]; i++) most = fmax(most, end[0][i]);
    check_true(most > 1e-4);
    assert_int_equal(n[0], n[1]);
    assert_memory_equal(end[0], end[1], n[0] * sizeof(double));
    free(end[0]);
    free(end[1]);
    floe_destroy(&floe);
}

/* Stress is none; the history has the temperature and the heat that the law is given. */
static size_t see_temperature(const void *par, double p_ref, floe_solid_batch *b)
{
    (void)par;
    (void)p_ref;
    for (size_t i = 0; i < b->n; i++) {
        b->history[0][i] = b->temperature[i];
        b->history[1][i] = b->heat[i];
    }
    return 0;
}

/* A law that asks for the temperature of its points gets it, and with it the material's specific heat is needed. */
static void knows_the_temperature(void **state)
{
    (void)state;
    static const floe_history seen[] = {{"seen", "K", "temperature"}, {"heat", "J/kg", "heat"}};
    static const char *const cold[] = {"materials.metal.specific_heat=null"},
                             *const hot[] = {"bodies.left.temperature=400",
                                             "materials.metal.stress_free_temperature=300"};
    floe_context *floe = floe_create();
    floe_parameter parameters[32];
    floe_solid_law law = my_metal(parameters);
    law.name = "my_warm_metal";
    law.needs = FLOE_NEEDS_TEMPERATURE;
    law.stress = see_temperature;
    law.strain_energy = NULL;
    law.history = seen;
    law.n_history = 2;
    floe_deck *deck;
    floe_simulation *s;
    char text[2048];
    double *T = NULL;
    size_t n = 0;
    assert_int_equal(floe_init(), FLOE_OK);
    assert_int_equal(floe_add_solid_law(floe, &law), FLOE_OK);
    (void)snprintf(text, sizeof text, bar, "my_warm_metal");
    accepted(floe, floe_load_text(floe, "bar", text, cold, 1, &deck));
    refused(floe, floe_simulation_create(deck, NULL, &s), "specific_heat");
    floe_deck_destroy(&deck);
    char *at = strstr(text, "density:");
    memmove(at + strlen("specific_heat: 500 J/kg/K, "), at, strlen(at) + 1);
    memcpy(at, "specific_heat: 500 J/kg/K, ", strlen("specific_heat: 500 J/kg/K, "));
    accepted(floe, floe_load_text(floe, "bar", text, hot, 2, &deck));
    accepted(floe, floe_simulation_create(deck, NULL, &s));
    accepted(floe, floe_advance(s, 1e-6));
    for (int k = 0; k < 2; k++) {
        assert_int_equal(floe_copy_field(s, k == 0 ? "points/left/seen" : "points/left/heat", NULL, 0, &n), FLOE_OK);
        T = malloc(n * sizeof *T);
        assert_int_equal(floe_copy_field(s, k == 0 ? "points/left/seen" : "points/left/heat", T, n, NULL), FLOE_OK);
        for (size_t i = 0; i < n; i++) assert_true(fabs(T[i] - (k == 0 ? 400.0 : 500.0 * 100.0)) < 1e-9);
        free(T);
    }
    floe_simulation_destroy(&s);
    floe_deck_destroy(&deck);
    floe_destroy(&floe);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refuses_laws_with_a_reason),      cmocka_unit_test(gives_the_bits_of_the_same_law),
        cmocka_unit_test(reads_parameters_like_any_other), cmocka_unit_test(keeps_histories),
        cmocka_unit_test(knows_the_temperature),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
