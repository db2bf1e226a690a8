/* Snapshots: DIR/fields/NNNNNN.h5, one an output time, and DIR/fields.xdmf, which opens them in viewers
 * (docs/outputs.md). Cells in global order (z, y, x), points in the order of their ids: the same bits for any blocks
 * and threads. */
#ifndef IO_SNAPSHOT_H
#define IO_SNAPSHOT_H

#include "sim/sim.h"

/* The snapshots of one run. */
typedef struct snapshot_series snapshot_series;

/* Takes over DIR (which exists): snapshots later than `keep_until` (s; -INFINITY: all) are removed, the rest are read,
 * and fields.xdmf is made to show just these. `deck` is the resolved deck; its digest goes into every file. */
floe_status snapshot_open(snapshot_series **out, context *ctx, const char *dir, const char *deck, double keep_until);
/* DIR was moved. */
floe_status snapshot_move(snapshot_series *s, const char *dir);
void snapshot_close(snapshot_series **s);

/* Writes the current state of `s` as the next snapshot, then fields.xdmf. On failure the earlier files are
 * untouched. */
floe_status snapshot_write(snapshot_series *series, const sim *s);

/* The time (s) of the last one, -INFINITY if there is none. */
double snapshot_last_time(const snapshot_series *series);

#endif
