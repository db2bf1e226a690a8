/* Stages: a step is a list of them, straight down one page, each with what it reads and writes.
 *
 * The same list serves three ends. Planned (stages->planning), it only records names and fields, and from that record
 * the fields are registered and `floe plan` is printed; run, it calls the functions and times them; in debug builds it
 * also fills what a stage will write with NaN, checks it afterwards, and checks that nothing else has changed.
 *
 *     STAGE(s, ALWAYS, points_to_nodes, READS(P_MASS, P_VEL, P_POS), WRITES(N_MASS, N_MOMENTUM));
 *     STAGE(s, s->multi, equilibrium_pressure, READS(C_RHO, C_TEMP), WRITES(C_PRESSURE, C_VOL));
 *
 * `s` is any object with a member `stage_list *stages`; the function is `floe_status function(type *s)`. */
#ifndef GRID_STAGE_H
#define GRID_STAGE_H

#include "grid/domain.h"

enum { STAGE_MAX = 64, STAGE_MAX_FIELDS = 64, STAGE_NONE = -1 };

typedef struct stage_fields {
    int id[STAGE_MAX_FIELDS]; /* field_id, or STAGE_NONE which is passed over */
    int n;
} stage_fields;

typedef struct stage_record {
    const char *name;
    stage_fields reads, writes;
    double seconds; /* wall time so far */
    long calls;
} stage_record;

typedef struct stage_list {
    context *ctx;   /* not owned */
    domain *domain; /* not owned; NULL while planning */
    bool planning;  /* record, do not run */
    bool checking;  /* poison and check (debug builds) */
    stage_record record[STAGE_MAX];
    int n;
    bool uses[FIELD_COUNT]; /* some planned stage reads or writes it */
    double started;         /* wall clock at stage_begin */
    int running;            /* index of the running stage */
    int fail_at; /* for tests: the n-th stage from now (1 = the next) asks for a smaller step when done; 0: none */
    uint64_t *checksum; /* of fields, while checking; owned */
} stage_list;

/* What bounds the time step: the largest stable one (s), and a few words on what it is. */
typedef struct step_limit {
    double dt;
    const char *reason;
} step_limit;

#define ALWAYS true
#define STAGE_FIELDS(...) ((stage_fields){.id = {__VA_ARGS__}, .n = (int)(sizeof((int[]){__VA_ARGS__}) / sizeof(int))})
#define READS(...) STAGE_FIELDS(__VA_ARGS__)
#define WRITES(...) STAGE_FIELDS(__VA_ARGS__)
#define NOTHING STAGE_NONE
/* A field that a stage touches only in some scenes. */
#define WHEN(condition, id) ((condition) ? (int)(id) : STAGE_NONE)

#define STAGE(s, when, function, reads, writes)                                                                     \
    do {                                                                                                            \
        if ((when) && stage_begin((s)->stages, #function, reads, writes)) TRY(stage_end((s)->stages, function(s))); \
    } while (0)

void stage_list_init(stage_list *list, context *ctx);
void stage_list_destroy(stage_list *list);
/* True when the stage is to be run now. */
bool stage_begin(stage_list *list, const char *name, stage_fields reads, stage_fields writes);
/* Stops the timer; passes the status on. A violation found by checking is FLOE_INTERNAL naming stage and field. */
floe_status stage_end(stage_list *list, floe_status status);

#endif
