/* Runs a deck and prints what came of it, with the installed library:
 *
 *     cc -std=c11 run_deck.c -o run_deck $(pkg-config --cflags --libs floe)
 *     ./run_deck sod.yaml out/sod domain.cell=0.005 coupling=ice
 */
#include <floe/floe.h>

#include <math.h>
#include <stdio.h>

static void print(const floe_run *run, const char *name)
{
    const double value = floe_value(run, name);
    if (!isnan(value)) printf("%-24s %.6g\n", name, value);
}

static floe_status run_deck(floe_context *floe, const char *path, const char *directory, char **set, int n_set)
{
    floe_deck *deck;
    floe_run *run;
    floe_status status = floe_load(floe, path, (const char *const *)set, (size_t)n_set, &deck);
    if (status != FLOE_OK) return status;
    status = floe_execute(deck, &(floe_options){.directory = directory, .threads = 1}, &run);
    if (run) {
        printf("%-24s %s\n", "status", floe_run_status(run));
        print(run, "time");
        print(run, "steps");
        print(run, "wall_seconds");
        print(run, "cells");
        print(run, "points");
        print(run, "conservation.mass");
        print(run, "errors.eq13");
        print(run, "errors.l1_density");
    }
    floe_run_destroy(&run);
    floe_deck_destroy(&deck);
    return status;
}

int main(int argc, char **argv)
{
    if (argc < 3) {
        fprintf(stderr, "usage: run_deck DECK DIRECTORY [KEY=VALUE...]\n");
        return 2;
    }
    floe_context *floe = floe_create();
    if (!floe) return 4;
    floe_status status = floe_init();
    if (status == FLOE_OK) status = run_deck(floe, argv[1], argv[2], argv + 3, argc - 3);
    if (status != FLOE_OK) fprintf(stderr, "%s\n", floe_message(floe));
    floe_destroy(&floe);
    return status == FLOE_OK ? 0 : 1;
}
