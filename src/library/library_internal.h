/* What stands behind the pointers of floe/floe.h. Private to src/library. */
#ifndef LIBRARY_INTERNAL_H
#define LIBRARY_INTERNAL_H

#include "deck/deck.h"
#include "floe/floe.h"
#include "io/names.h"
#include "run/output.h"
#include "run/run.h"
#include "run/setup.h"
#include "run/truth.h"

enum { LIBRARY_MAX_LAWS = 64 }; /* of a context, so that their addresses stay */

struct floe_context {
    context *ctx;       /* owned */
    deck_report report; /* of the last deck; owned */
    solid_model *law;   /* the program's, with their parameters; owned */
    size_t n_law;
    eos_model *eos; /* likewise */
    size_t n_eos;
    floe_log_function *log; /* of the program; NULL: none */
    void *log_user;
    log_level detail;
};

struct floe_deck {
    floe_context *floe; /* not owned */
    scene *scene;       /* owned */
    bool in_use;        /* by a simulation */
};

/* A field by its name: where its arrays are. */
typedef struct named_field {
    char *name; /* "cells/pressure"; owned */
    char *meaning;
    char unit[NAME_SIZE];
    floe_centring centring;
    int body; /* of points */
    field_id id;
    int instance, comp, components;
    double scale;
} named_field;

struct floe_simulation {
    floe_deck *deck;    /* not owned */
    context *ctx;       /* of the deck's; not owned */
    run_setup *setup;   /* owned; NULL in the callbacks of floe_execute */
    sim *sim;           /* of the setup, or the run */
    run_truth truth;    /* what was said of the account */
    run_output files;   /* for checkpoints; owned */
    run_summary result; /* its warnings and errors alone */
    named_field *field; /* by name; owned */
    size_t n_fields;
    floe_options options;
    long refreshed; /* the step for which derived fields are up to date; -1: none */
    bool busy;      /* a callback is called, or a run goes on: it must not be stepped */
};

/* Forgets what earlier calls had to say. */
void library_clear_messages(floe_context *floe);
/* A log_sink that hands lines to the program; `user`: the floe_context. */
void library_log(void *user, log_level level, const char *line);
/* Calls a callback of the program, if there is one. */
floe_status library_call_back(floe_simulation *s, floe_callback *call);
/* Lists the fields of the simulation; field_list_free takes them back. */
floe_status field_list_make(floe_simulation *s);
void field_list_free(floe_simulation *s);

#endif
