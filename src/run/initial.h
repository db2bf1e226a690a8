/* The exact solution of a scene, and initial states taken from it. */
#ifndef RUN_INITIAL_H
#define RUN_INITIAL_H

#include "scene/scene.h"
#include "verify/exact.h"

/* Prepares the exact solution that the scene names; *out stays empty (model NULL) when there is none. The scene must
 * outlive it. */
floe_status initial_exact(const scene *s, exact *out);
/* Lets bodies with `state: exact` start from the solution at t = 0. The solution must outlive the use of the scene;
 * initial_detach takes it away again. */
void initial_attach(scene *s, exact *solution);
void initial_detach(scene *s);

#endif
