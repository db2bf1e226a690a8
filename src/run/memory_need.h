/* What memory a large scene needs, found without taking it: the scene is made ready on two coarser meshes, and what it holds
 * there is a straight line over the number of cells. */
#ifndef RUN_MEMORY_NEED_H
#define RUN_MEMORY_NEED_H

#include "run/setup.h"

typedef struct memory_need {
    double cells;         /* of the scene's own mesh */
    double bytes;         /* that a run holds: fields, points, work */
    double output_bytes;  /* more, while an output is written */
    double written_bytes; /* of the state, as a checkpoint has it */
    double fitting_cells; /* of the same scene, that the available memory would hold */
    double available;     /* bytes; INFINITY: unknown */
    bool fits;
} memory_need;

/* Cells of a mesh, any number of them. */
double memory_cells(const mesh_spec *m);

/* A scene on a mesh that is some times coarser, made ready. */
typedef struct coarse_setup {
    run_setup setup;
    double cell[3]; /* of the scene, to be put back */
    double cells;   /* of the coarse mesh */
    double ratio;   /* of the scene's own cells to these */
    double coarser; /* of the lengths of the cells, along the first axis */
} coarse_setup;

/* Puts the scene's own mesh back. */
void coarse_end(coarse_setup *c);

/* What a scene that was made ready holds. */
void memory_need_of(const sim *s, memory_need *out);
/* What a scene of many cells would hold. `c` gets the finer of the two coarse ones (coarse_end in any case). */
floe_status memory_need_estimate(scene *s, coarse_setup *c, memory_need *out);

/* FLOE_BAD_INPUT before a run that does not fit into memory, with what would fit: a scene of more than
 * RUN_READY_CELLS whose need is half as much again as what is available. *out: what it would hold, 0 bytes where that is not known
 * or the scene has fewer cells; NULL: not asked. */
floe_status memory_refuse(scene *s, memory_need *out);

#endif
