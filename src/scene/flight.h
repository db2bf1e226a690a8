/* Free flight of bodies. */
#ifndef SCENE_FLIGHT_H
#define SCENE_FLIGHT_H

#include "scene/scene.h"

typedef struct scene_flight {
    int body; /* -1: none does */
    int axis, side;
    double time; /* s */
} scene_flight;

/* The first solid that at its velocity of the start comes to a side through which points leave before the end of the run. */
scene_flight scene_flight_out(const scene *s);
/* "x.upper" or "r.upper". */
void scene_side_name(const scene *s, int axis, int side, char text[16]);

#endif
