/* What sources of mass and vents do in a step (theory 2.18, 2.19). */
#ifndef SCENE_MASS_SOURCE_H
#define SCENE_MASS_SOURCE_H

#include "scene/scene.h"

/* Mass that comes in, with means by mass. */
typedef struct mass_intake {
    double mass;        /* kg per metre of depth in 2-D, per radian about an axis */
    double temperature; /* K */
    double velocity[3]; /* m/s */
} mass_intake;

/* What a source of the scene lets in between two times (s); its temperature is 0 where that is nothing. */
floe_status mass_source_intake(const scene *s, const scene_mass_source *source, double from, double to,
                               mass_intake *out);
/* A vent's area times its coefficient of discharge (m2, per metre of depth or radian), the mean over the time that it is
 * open between two times; *seconds is that time. */
floe_status vent_opening(const scene *s, const scene_vent *vent, double from, double to, double *area, double *seconds);
/* Whether some fluid comes from a source and from nowhere else, so that it shares cells with what is there. */
bool mass_source_joins(const scene *s);

#endif
