/* Sod's shock tube, stepped by the program: the density of the cells, read where it lies, against the exact solution.
 *
 *     cc -std=c11 sod_steps.c -o sod_steps $(pkg-config --cflags --libs floe) -lm
 *     ./sod_steps
 */
#include <floe/floe.h>

#include <math.h>
#include <stdio.h>

static const char deck_text[] =
    "floe: 1\n"
    "title: Sod's shock tube\n"
    "units: none\n"
    "coupling: ice\n"
    "domain: {dim: 1, lower: 0, upper: 1, cell: 0.005}\n"
    "boundaries: {x: slip}\n"
    "materials: {gas: {eos: {ideal: {gamma: 1.4, specific_heat: 1}}}}\n"
    "bodies:\n"
    "  left: {material: gas, shape: {box: {lower: 0, upper: 0.5}}, density: 1, pressure: 1}\n"
    "  right: {material: gas, shape: {box: {lower: 0.5, upper: 1}}, density: 0.125, pressure: 0.1}\n"
    "time: {end: 0.2}\n";

static const double g = 1.4, p_left = 1.0, rho_left = 1.0, p_right = 0.1, rho_right = 0.125;

/* The velocity behind a rarefaction into the left gas less that behind a shock into the right one, at the pressure p. */
static double velocity_gap(double p)
{
    const double c = sqrt(g * p_left / rho_left);
    const double fan = 2.0 * c / (g - 1.0) * (1.0 - pow(p / p_left, (g - 1.0) / (2.0 * g)));
    const double shock = (p - p_right) * sqrt(2.0 / (rho_right * ((g + 1.0) * p + (g - 1.0) * p_right)));
    return fan - shock;
}

/* Density of the exact solution at x / t = s (Toro 2009, section 4.5). */
static double exact_density(double s)
{
    double low = p_right, high = p_left;
    for (int i = 0; i < 200; i++) {
        const double middle = 0.5 * (low + high);
        *(velocity_gap(middle) > 0.0 ? &low : &high) = middle;
    }
    const double p = low, c = sqrt(g * p_left / rho_left);
    const double u = 2.0 * c / (g - 1.0) * (1.0 - pow(p / p_left, (g - 1.0) / (2.0 * g)));
    const double behind_fan = rho_left * pow(p / p_left, 1.0 / g), c_behind = sqrt(g * p / behind_fan);
    const double ratio = p / p_right, k = (g - 1.0) / (g + 1.0);
    const double shock = sqrt(g * p_right / rho_right) * sqrt((g + 1.0) / (2.0 * g) * ratio + (g - 1.0) / (2.0 * g));
    if (s < -c) return rho_left;
    if (s < u - c_behind) return rho_left * pow(2.0 / (g + 1.0) - k * s / c, 2.0 / (g - 1.0));
    if (s < u) return behind_fan;
    return s < shock ? rho_right * (ratio + k) / (k * ratio + 1.0) : rho_right;
}

/* The mean of |rho - exact| over the cells. */
static double density_error(const floe_view *rho, const floe_mesh *m, double time)
{
    double sum = 0.0;
    for (size_t i = 0; i < rho->shape[0]; i++) {
        const double x = m->lower[0] + m->spacing[0] * ((double)i + 0.5);
        sum += fabs(rho->data[0][(ptrdiff_t)i * rho->stride[0]] - exact_density((x - 0.5) / time));
    }
    return sum / (double)rho->shape[0];
}

static floe_status step_to_end(floe_simulation *s, double *error)
{
    const floe_mesh m = floe_get_mesh(s);
    for (int k = 1; k <= 4; k++) {
        floe_view rho;
        floe_balance mass;
        floe_status status = floe_advance(s, 0.25 * k * floe_end_time(s));
        if (status == FLOE_OK) status = floe_field(s, "cells/density_gas", 0, &rho);
        if (status == FLOE_OK) status = floe_read_balance(s, FLOE_MASS, &mass);
        if (status != FLOE_OK) return status;
        *error = density_error(&rho, &m, floe_time(s));
        printf("t = %.3f, %3ld steps: L1 of density %.5f, drift of mass %.1e\n", floe_time(s), floe_step_count(s),
               *error, mass.drift);
    }
    return FLOE_OK;
}

int main(void)
{
    floe_context *floe = floe_create();
    floe_deck *deck = NULL;
    floe_simulation *s = NULL;
    double error = INFINITY;
    if (!floe) return 4;
    floe_status status = floe_init();
    if (status == FLOE_OK) status = floe_load_text(floe, "sod", deck_text, NULL, 0, &deck);
    if (status == FLOE_OK) status = floe_simulation_create(deck, NULL, &s);
    if (status == FLOE_OK) status = step_to_end(s, &error);
    if (status != FLOE_OK) fprintf(stderr, "%s\n", floe_message(floe));
    floe_simulation_destroy(&s);
    floe_deck_destroy(&deck);
    floe_destroy(&floe);
    return status == FLOE_OK && error < 0.005 ? 0 : 1;
}
