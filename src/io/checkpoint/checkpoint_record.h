/* The numbers of a checkpoint that are no fields, as one struct and one table that writing and reading share; and the
 * manifest, a text that says what the scene and its plan are. */
#ifndef IO_CHECKPOINT_RECORD_H
#define IO_CHECKPOINT_RECORD_H

#include "base/strbuf.h"
#include "io/checkpoint/checkpoint.h"
#include "io/hdf.h"

enum { CHECKPOINT_FORMAT = 3 };

typedef struct checkpoint_record {
    double time, dt, rest_since; /* of the simulation, s */
    double point_updates, cell_updates;
    double wall_seconds;
    int64_t steps, rejected, at_rest, owed;
    double mpm_time, mpm_dt, mpm_dt_previous; /* s; 0 without points */
    double ice_time, ice_dt;                  /* s; 0 without cells */
    int64_t ice_implicit;                     /* the pressure is; 0 without cells */
    double ledger_initial[LEDGER_QUANTITIES], ledger_total[LEDGER_QUANTITIES], ledger_scale[LEDGER_QUANTITIES];
    double ledger_extent[LEDGER_QUANTITIES], ledger_let_in[LEDGER_QUANTITIES][LEDGER_INPUTS];
    double ledger_worst[LEDGER_QUANTITIES], ledger_worst_time[LEDGER_QUANTITIES]; /* 1, s */
    double ledger_elasticity, ledger_motion[7];              /* J; of ledger_motion, in its order */
    double ledger_entry[LEDGER_QUANTITIES][LEDGER_KINDS][2]; /* value, carry */
    double ledger_pending[LEDGER_QUANTITIES][LEDGER_KINDS];
    int64_t ledger_count[LEDGER_COUNTS], ledger_pending_count[LEDGER_COUNTS];
    int64_t n_stages;
    double stage_seconds[STAGE_MAX];
    int64_t stage_calls[STAGE_MAX];
} checkpoint_record;

/* From the simulation to the record and back. */
void checkpoint_record_take(checkpoint_record *record, const sim *s, const checkpoint_run *run);
void checkpoint_record_put(const checkpoint_record *record, sim *s, checkpoint_run *run);

floe_status checkpoint_record_write(hdf_file *hdf, const checkpoint_record *record);
/* Reads and checks the record: finite times, no negative counts. */
floe_status checkpoint_record_read(hdf_file *hdf, checkpoint_record *record);

/* One array of the state: where it is kept and where it belongs. */
typedef struct state_array {
    field_id id;
    int instance, comp;
    char path[128];
} state_array;

/* Calls visit for each array of the state (STATE and FIXED fields, each component) in a fixed order. */
typedef floe_status state_visitor(void *user, const state_array *array);
floe_status checkpoint_visit_state(const sim *s, state_visitor *visit, void *user);

/* Where an extra array is kept in the file. */
void checkpoint_extra_path(char path[128], const checkpoint_extra *extra);

/* Appends the manifest: mesh, coupling, bodies, materials, stages and arrays, one a line. Two simulations with the same
 * manifest can take each other's state. */
floe_status checkpoint_manifest(const sim *s, const checkpoint_run *run, strbuf *out);

/* FLOE_OK if two texts are equal, else FLOE_BAD_INPUT showing the first line that differs; `what` names the texts. */
floe_status checkpoint_compare(context *ctx, const char *path, const char *what, const char *in_file, const char *here);

#endif
