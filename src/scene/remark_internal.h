/* Remarks with files of their own. Private to remark.c. */
#ifndef SCENE_REMARK_INTERNAL_H
#define SCENE_REMARK_INTERNAL_H

#include "scene/remark.h"

enum { REMARK_KEY = 256 };

typedef struct remark_speaker {
    const scene *s;
    remark_sink *say;
    void *user;
    char key[REMARK_KEY];
} remark_speaker;

/* A remark on the key in `w->key`, with its place in the deck. */
void remark_key(const remark_speaker *w, const char *format, ...) FLOE_PRINTF(2, 3);
void remark_set_key(remark_speaker *w, const char *map, const char *name, const char *rest);

/* A solid with a law of its own: no membrane. */
bool remark_is_solid(const scene_material *m);
/* Whether the points' basis is one of splines. */
bool remark_has_splines(const scene *s);
/* Speed of waves of compression in such a solid, m/s. */
double remark_solid_sound(const scene_material *m);

/* Of solids smeared over cells of fluid. */
void remark_shapes(const scene *s, remark_sink *say, void *user);
void remark_smeared(const scene *s, remark_sink *say, void *user);
/* Of solids that fly out of the domain with a sharp interface. */
void remark_flight_out(const scene *s, remark_sink *say, void *user);

/* Of solids that swing in a fluid at rest, in steps that no flow bounds. */
void remark_free_swing(const scene *s, remark_sink *say, void *user);

/* Of fluids on points that start without their weight. */
void remark_columns(const scene *s, remark_sink *say, void *user);

/* Of sources of mass and vents. */
void remark_sources(const scene *s, remark_sink *say, void *user);

/* Of heat that solids neither get nor give. */
void remark_heat(const scene *s, remark_sink *say, void *user);

/* Whether a body shares one velocity with fluids on points. */
bool remark_is_among_fluids(const scene *s, int body);
/* Of what supports constrain at nodes behind their surface. */
void remark_supports(const scene *s, remark_sink *say, void *user);

/* Of solids that stick to bodies which do not deform. */
void remark_joints(const scene *s, remark_sink *say, void *user);

/* Of surfaces of solids that fluids on points push over their cells. */
void remark_moved(const scene *s, remark_sink *say, void *user);

/* Of magnitudes and times that are hardly what was meant. */
void remark_range(const scene *s, remark_sink *say, void *user);
/* Of gases beside other gases, of what is behind sides, and of ramps. */
void remark_contrasts(const scene *s, remark_sink *say, void *user);
/* Of those that a slip of units explains: fluids, loads, places and speeds. */
void remark_slips(const scene *s, remark_sink *say, void *user);

#endif
