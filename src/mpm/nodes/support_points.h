/* Points that belong to supports, and their seeding (theory 4.13). */
#ifndef MPM_SUPPORT_POINTS_H
#define MPM_SUPPORT_POINTS_H

#include "mpm/mpm.h"

/* Whether points of a body may belong to supports: those in the regions move along and have no stress. */
bool supports_take_points(const mpm *s, int body);
/* The first support whose region has the place x (m); -1: none. */
int support_with(const mpm *s, const double x[MESH_MAX_DIM]);
/* Whether supports lead nodes, and a body may be what passes their surfaces. */
bool supports_lead(const mpm *s, int body);
/* Whether the surface of a support passes a cell at the start. */
bool supports_cut(const mpm *s, const int cell[MESH_MAX_DIM]);

#endif
