/* The plan of a scene as text and as JSON. */
#ifndef CLI_PLAN_H
#define CLI_PLAN_H

#include "sim/sim.h"

#include <stdio.h>

typedef struct plan {
    const scene *scene; /* not owned */
    sim *sim;           /* ready for its first step */
    sim_plan_info info;
} plan;

floe_status plan_print_text(const plan *p, FILE *file);
floe_status plan_print_json(const plan *p, FILE *file);

/* "P_MASS": the name of a field that is the only one of its kind. */
const char *plan_field_id(field_id id);
/* "points", "nodes", "cells" or "faces". */
const char *plan_centring(field_centring centring);
const char *plan_class(field_class kind);
/* Bytes of a field over all blocks and instances; the number of its instances. */
uint64_t plan_field_bytes(const plan *p, field_id id);
int plan_field_instances(const plan *p, field_id id);
/* "2-D axisymmetric" */
void plan_geometry(const plan *p, char text[64]);

#endif
