/* A snapshot may come from anyone: what it holds is looked at before it is used. FLOE_IO with the name and what is wrong. */
#ifndef IO_SNAPSHOT_CHECK_H
#define IO_SNAPSHOT_CHECK_H

#include "io/hdf_look.h"
#include "io/snapshot/snapshot_read.h"

/* The file says that it is a snapshot, of a schema that this floe reads. */
floe_status snapshot_check_version(const snapshot *s);
floe_status snapshot_check_time(context *ctx, const char *path, double time);
/* Fills cells[axis] from the domain, which must hold a whole number of them. */
floe_status snapshot_count_cells(snapshot *s, int axis);
/* The group of the cells says the same of the mesh as the domain does. */
floe_status snapshot_check_mesh(const snapshot *s);
/* Every number of an array is finite, and of the sign that its kind has. */
floe_status snapshot_check_field(const snapshot *s, const char *path, const snapshot_field *field, size_t numbers);
/* Points lie in the domain, each once, and have a mass. */
floe_status snapshot_check_points(const snapshot *s, const char *path, const snapshot_group *body);

#endif
