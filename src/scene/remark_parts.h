/* Remarks with files of their own. Private to remark.c. */
#ifndef SCENE_REMARK_PARTS_H
#define SCENE_REMARK_PARTS_H

#include "scene/remark.h"

/* Of solids smeared over cells of fluid. */
void remark_shapes(const scene *s, remark_sink *say, void *user);
void remark_smeared(const scene *s, remark_sink *say, void *user);
/* Of solids that fly out of the domain with a sharp interface. */
void remark_flight_out(const scene *s, remark_sink *say, void *user);

/* Of magnitudes and times that are hardly what was meant. */
void remark_range(const scene *s, remark_sink *say, void *user);

#endif
