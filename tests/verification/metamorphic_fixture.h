/* Every deck of inputs/, coarse and for a few steps, as it is and changed in a way that theory knows the answer to. A new deck is covered
 * unasked. */
#ifndef TESTS_VERIFICATION_METAMORPHIC_FIXTURE_H
#define TESTS_VERIFICATION_METAMORPHIC_FIXTURE_H

#include "coupled_fixture.h"

#include <dirent.h>

enum { DECKS_MOST = 256, DECK_NAME = 96 };

/* Decks by name, without .yaml, in the order of the alphabet. */
typedef struct deck_names {
    char name[DECKS_MOST][DECK_NAME];
    size_t n;
} deck_names;

FIXTURE int compare_names(const void *a, const void *b)
{
    return strcmp(a, b);
}

/* Adds those of a folder of inputs/ ("" or "extreme/"). */
FIXTURE void list_decks(deck_names *list, const char *folder)
{
    char path[512];
    (void)snprintf(path, sizeof path, "%s/inputs/%s", FLOE_SOURCE_DIR, folder);
    DIR *dir = opendir(path);
    assert_non_null(dir);
    for (const struct dirent *entry = readdir(dir); entry; entry = readdir(dir)) {
        const char *end = strstr(entry->d_name, ".yaml");
        if (!end) continue;
        assert_in_range(list->n, 0, DECKS_MOST - 1);
        const int length =
            snprintf(list->name[list->n++], DECK_NAME, "%s%.*s", folder, (int)(end - entry->d_name), entry->d_name);
        assert_in_range(length, 1, DECK_NAME - 1);
    }
    closedir(dir);
    qsort(list->name, list->n, sizeof list->name[0], compare_names);
}

/* A deck that is run: which, how, and what its exact solution is made of. */
typedef struct subject {
    const char *deck, *set; /* set: a key that is changed; NULL: none */
    scene_coupling coupling;
    int coarser; /* times that its cells are doubled */
    trial t;
    exact solution;
} subject;

/* Doubles the cells, where that leaves a whole number of them and enough to be the same scene. */
FIXTURE bool coarsen(mesh_spec *m)
{
    static const long enough[] = {64, 400, 1000};
    long cells = 1;
    for (int a = 0; a < m->dim; ++a) {
        const long n = lround((m->upper[a] - m->lower[a]) / m->cell[a]);
        if (n % 2 != 0 || n < 8) return false;
        cells *= n;
    }
    if (cells <= enough[m->dim - 1]) return false;
    for (int a = 0; a < m->dim; ++a) m->cell[a] *= 2.0;
    return true;
}

/* The scene, not yet a simulation; false where the deck refuses what is set. */
FIXTURE bool subject_load(subject *s)
{
    memset(&s->solution, 0, sizeof s->solution);
    if (deck_try(&s->t, s->deck, &s->set, s->set ? 1 : 0) != FLOE_OK) return false;
    s->t.scene->coupling = s->coupling;
    for (int k = 0; k < s->coarser; ++k) (void)coarsen(&s->t.scene->mesh);
    return true;
}

/* The exact solution that it may start from; false where it is refused. */
FIXTURE bool subject_attach(subject *s)
{
    if (initial_exact(s->t.scene, &s->solution) != FLOE_OK) return false;
    initial_attach(s->t.scene, &s->solution);
    return true;
}

/* The simulation of it; false where it is refused. */
FIXTURE bool subject_start(subject *s)
{
    return subject_attach(s) && sim_create(&s->t.sim, s->t.ctx, s->t.scene, s->coupling) == FLOE_OK;
}

FIXTURE void subject_end(subject *s)
{
    exact_destroy(s->t.ctx, &s->solution);
    trial_end(&s->t);
}

/* Steps on, as far as the deck goes; false where a step was refused. */
FIXTURE bool subject_steps(subject *s, long steps)
{
    floe_status status = FLOE_OK;
    for (long k = 0; k < steps && status == FLOE_OK && s->t.sim->time < s->t.scene->time.end; ++k)
        status = sim_step(s->t.sim, s->t.scene->time.end);
    return status == FLOE_OK;
}

/* Finds the coarsest mesh that the bodies bear; false where the deck cannot be had in this way at all. */
FIXTURE bool subject_find(subject *s)
{
    s->coarser = 0;
    if (!subject_load(s)) {
        subject_end(s);
        return false;
    }
    while (coarsen(&s->t.scene->mesh)) ++s->coarser;
    subject_end(s);
    for (;; --s->coarser) {
        assert_true(subject_load(s));
        const bool fine = subject_start(s) && subject_steps(s, 2);
        subject_end(s);
        if (fine || s->coarser == 0) return fine;
    }
}

/* How decks are run: as they are, and with each of these keys changed, where a deck bears it. */
FIXTURE const char *setting(size_t i)
{
    static const char *const key[] = {
        NULL,
        "method.basis=linear",
        "method.basis=gimp",
        "method.basis=cubic",
        "method.basis=cpdi",
        "method.stress=usf",
        "method.stress=musl",
        "method.transfer=apic",
        "method.transfer=tpic",
        "method.transfer=xpic",
        "method.transfer=afmpm",
        "method.point_density=cell",
        "method.point_density=quadratic",
        "method.losses=heat",
        "method.edge_penalty=0.05",
        "method.interface=sharp",
        "method.limiter=first_order",
        "method.energy=internal",
        "method.centring=full",
        "method.volume_relaxation=0.1",
        "method.exchange=1000",
        "method.heat_exchange=1e6",
        "method.pressure=implicit",
        "time.solver=static",
        "time.solver=implicit",
        "contact={kind: friction, friction: 0.3}",
        "contact={kind: release, criterion: both}",
        "damping.rate=100",
    };
    return i < sizeof key / sizeof *key ? key[i] : "";
}

/* What a check has come to. */
typedef struct tally {
    long runs, same, known; /* known: differ for a reason that is named */
    long refused;           /* the deck does not bear what is set */
    long wrong;
} tally;

typedef void subject_check(subject *s, void *user, tally *count);

/* Checks a deck in each of the couplings that it names; with `every` in every way in which decks are run. */
FIXTURE void check_deck(const char *deck, bool every, subject_check *check, void *user, tally *count)
{
    scene runs;
    trial t;
    deck_begin(&t, deck, NULL, 0);
    runs = *t.scene;
    trial_end(&t);
    for (int c = 0; c < runs.n_runs_as; ++c)
        for (size_t i = 0; i == 0 || (every && setting(i)[0]); ++i) {
            subject s = {.deck = deck, .set = setting(i), .coupling = runs.runs_as[c]};
            if (!subject_find(&s)) {
                assert_non_null(s.set);
                count->refused++;
                continue;
            }
            check(&s, user, count);
        }
}

/* Decks that take longer than all others together: nightly. */
FIXTURE bool deck_is_long(const char *deck)
{
    static const char *const takes_long[] = {"foam_wall", "gas_expansion", "stiff_cylinder", "turek_hron_cfd",
                                             "turek_hron_fsi"};
    for (size_t k = 0; k < sizeof takes_long / sizeof *takes_long; ++k)
        if (strcmp(deck, takes_long[k]) == 0) return true;
    return false;
}

/* Short ones, of points, fluids, bodies that touch, and both, which bear most of the keys that are changed. */
FIXTURE bool deck_is_changed(const char *deck)
{
    static const char *const changed[] = {"cell_crossing", "fluid_stream", "moving_walls", "relaxation", "two_bars"};
    for (size_t k = 0; k < sizeof changed / sizeof *changed; ++k)
        if (strcmp(deck, changed[k]) == 0) return true;
    return false;
}

/* Every deck, or those whose name begins as FLOE_DECK says; with `every` a few of them in every way, and nightly all. */
FIXTURE void check_decks(bool every, subject_check *check, void *user, tally *count)
{
    static deck_names decks;
    const char *only = getenv("FLOE_DECK");
    decks.n = 0;
    list_decks(&decks, "");
    list_decks(&decks, "extreme/");
    assert_in_range(decks.n, 60, DECKS_MOST);
    for (size_t k = 0; k < decks.n; ++k)
        if ((!only || strncmp(decks.name[k], only, strlen(only)) == 0) &&
            (check_at_length() || !deck_is_long(decks.name[k])))
            check_deck(decks.name[k], every && (check_at_length() || deck_is_changed(decks.name[k])), check, user,
                       count);
}

/* What is run, for messages. */
FIXTURE const char *subject_name(const subject *s)
{
    static char text[256];
    (void)snprintf(text, sizeof text, "%s as %s%s%s", s->deck, coupling_name(s->coupling), s->set ? ", " : "",
                   s->set ? s->set : "");
    return text;
}

FIXTURE void print_tally(const char *what, const tally *count)
{
    print_message("%s: %ld runs, %ld the same, %ld as named, %ld wrong; %ld refused\n", what, count->runs, count->same,
                  count->known, count->wrong, count->refused);
}

#endif
