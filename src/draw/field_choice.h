/* Which field of a snapshot is to be drawn, and how it is called. */
#ifndef DRAW_FIELD_CHOICE_H
#define DRAW_FIELD_CHOICE_H

#include "io/snapshot/snapshot_read.h"

/* A scalar: a field, or what is taken of a vector. */
typedef struct field_choice {
    const snapshot_field *field; /* NULL: none */
    int component;               /* of a vector; -1: its magnitude */
    bool is_signed;              /* its zero has a meaning, and both signs occur */
    char label[SNAPSHOT_TEXT];   /* for people: "von Mises stress" */
} field_choice;

/* The field `name` of a group ("velocity_x": a component); out->field is NULL if there is none. */
void field_choose(const snapshot *s, const snapshot_group *group, const char *name, field_choice *out);
/* What suits the points of a body, and the cells, where nothing is asked for. */
void field_choose_for_points(const snapshot *s, const snapshot_group *body, field_choice *out);
void field_choose_for_cells(const snapshot *s, field_choice *out);

/* FLOE_BAD_INPUT: no points (no cells) hold such a field; lists the fields that are there. */
floe_status field_unknown(const snapshot *s, bool points, const char *name);

/* The values of a choice, one an entry of the group; counted memory, owned by the caller. */
floe_status field_values(const snapshot *s, const snapshot_group *group, const field_choice *choice, double **out);

#endif
