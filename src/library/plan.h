/* The plan of a scene as text and as JSON. */
#ifndef LIBRARY_PLAN_H
#define LIBRARY_PLAN_H

#include "run/disk_need.h"

#include <stdio.h>

typedef struct plan {
    const scene *scene; /* not owned */
    sim *sim;           /* ready for its first step; of a scene of many cells on a coarser mesh */
    sim_plan_info info; /* of the sim */
    double ratio;       /* of the scene's cells to the sim's; 1: they are the same */
    double coarser;     /* of the lengths of the sim's cells to the scene's */
    memory_need need;   /* of the scene */
    disk_need disk;
} plan;

floe_status plan_print_text(const plan *p, FILE *file);
floe_status plan_print_json(const plan *p, FILE *file);

/* "P_MASS": the name of a field that is the only one of its kind. */
const char *plan_field_id(field_id id);
/* "points", "nodes", "cells" or "faces". */
const char *plan_centring(field_centring centring);
const char *plan_class(field_class kind);
/* Steps and their length as those of the scene: with its own cells. */
double plan_step(const plan *p);
double plan_steps(const plan *p);
/* Cells of the scene along an axis. */
double plan_cells(const plan *p, int axis);
/* Bytes of a field over all blocks and instances, of the scene; the number of its instances. */
uint64_t plan_field_bytes(const plan *p, field_id id);
int plan_field_instances(const plan *p, field_id id);
/* "2-D axisymmetric" */
void plan_geometry(const plan *p, char text[64]);

#endif
