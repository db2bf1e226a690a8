/* Decks that several threads load at once, each in a context of its own: floe.h says that they may. */
#include "check.h"

#include "base/memory.h"
#include "deck/deck.h"
#include "run/catalogue.h"

#include <pthread.h>
#include <string.h>

enum { THREADS = 4, LOADS = 40 };

/* Units in most of its numbers: udunits2 parses each, with a parser that the whole process shares. */
static const char units_everywhere[] =
    "floe: 1\n"
    "coupling: mpm\n"
    "domain: {dim: 2, lower: [0 mm, 0 cm], upper: [1 km, 1e5 cm], cell: 100 m}\n"
    "materials:\n"
    "  steel: {density: 8.9 g/cm^3, law: {linear_elastic: {bulk_modulus: 117 GPa, shear_modulus: 44e3 N/mm^2}}}\n"
    "bodies:\n"
    "  block: {material: steel, shape: {box: {lower: [0, 0], upper: [0.5 km, 0.5 km]}}, velocity: [3.6 km/h, 2 "
    "mm/ms]}\n"
    "time: {end: 10 ms}\n";

typedef struct loader {
    pthread_t thread;
    context *ctx;
    deck_catalogue *catalogue;
    int sound; /* loads with the right numbers */
} loader;

static bool has_its_numbers(const scene *s)
{
    const double close = 1e-12;
    return fabs(s->mesh.upper[0] - 1000.0) < close * 1000.0 && fabs(s->material[0].density - 8900.0) < close * 8900.0 &&
           fabs(s->body[0].velocity[0] - 1.0) < close && fabs(s->body[0].velocity[1] - 2.0) < close &&
           fabs(s->time.end - 0.01) < close;
}

/* No check of cmocka's: those belong to the thread that runs the test. */
static void *load(void *user)
{
    loader *l = user;
    for (int i = 0; i < LOADS; i++) {
        deck_report report;
        scene *s = NULL;
        const floe_status status = deck_load_text(&s, l->ctx, "deck.yaml", units_everywhere, strlen(units_everywhere),
                                                  NULL, l->catalogue, &report);
        deck_report_free(&report);
        l->sound += status == FLOE_OK && has_its_numbers(s);
        scene_destroy(&s);
    }
    return NULL;
}

static void threads_load_decks_at_once(void **state)
{
    (void)state;
    loader l[THREADS] = {0};
    deck_init();
    for (int i = 0; i < THREADS; i++) {
        l[i].ctx = context_create();
        assert_non_null(l[i].ctx);
        check_ok(l[i].ctx, catalogue_create(&l[i].catalogue, l[i].ctx));
    }
    for (int i = 0; i < THREADS; i++) assert_int_equal(pthread_create(&l[i].thread, NULL, load, &l[i]), 0);
    for (int i = 0; i < THREADS; i++) assert_int_equal(pthread_join(l[i].thread, NULL), 0);
    for (int i = 0; i < THREADS; i++) {
        assert_int_equal(l[i].sound, LOADS);
        catalogue_destroy(l[i].ctx, &l[i].catalogue);
        assert_int_equal(memory_read_account(l[i].ctx).live_bytes, 0);
        context_destroy(&l[i].ctx);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_load_decks_at_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
