/* Bodies that do not deform: fixed, prescribed, or free rigid ones (theory 4.17).
 *
 * Such a body has a velocity group of its own, after those of all others. Its nodes have the velocities of a rigid motion, its points are moved by that
 * motion exactly, and their stress stays zero. The actions of others on the body (gas on its surface, contact, cells) are summed to one impulse and one
 * moment. They accelerate a free body; for a prescribed body their difference from the change of momentum is entered in the ledger, as for a support. */
#ifndef MPM_MOTION_H
#define MPM_MOTION_H

#include "mpm/mpm.h"
#include "scene/scene_motion.h"

/* A rigid field of velocities: v + w x (x - c). */
typedef struct rigid_field {
    double c[3], v[3], w[3];
} rigid_field;

/* Mass, momentum, moment of momentum and inertia about the centre of mass, of a body's points. */
typedef struct rigid_sums {
    double mass, centre[3], momentum[3], spin[3];
    double inertia[6]; /* xx yy zz xy yz zx */
    double kinetic;    /* J */
} rigid_sums;

typedef struct body_motion {
    const scene_motion *given;
    int body;                                   /* of ours */
    bool slides[3], turns[3];                   /* what a free body can do: not across mirrors that cut it */
    rigid_sums sums;                            /* at the start of the step */
    rigid_field now;                            /* at the start of the step */
    rigid_field next;                           /* what nodes have in the step, about the same point */
    rigid_field end;                            /* at its end, about where that point is then */
    double turn[9];                             /* rotation over the step */
    double coast[9];                            /* that of a free one that nobody pushes */
    double working[2][3];                       /* m/s, 1/s: velocity and spin with which others do work in the step */
    double impulse[3], moment[3];               /* N s, N m s about now.c: of others in the step */
    double loads[3], load_moment[3], load_work; /* of loads on its surface; again at each scatter */
    double work;                                /* J: of others on a prescribed one */
    double contact[3], contact_moment[3], contact_work; /* of these, by contact */
    double force[3], torque[3];                         /* N, N m: means over the last step, without body forces */
    double acceleration[3];                             /* m/s2: body forces on a free one */
    double field_force[3], field_moment[3]; /* N, N m about the origin: of body forces that change with place */
} body_motion;

struct mpm_motions {
    int n;
    body_motion body[MPM_MAX_GROUPS];
};

/* Resolves the bodies after those that deform. */
floe_status motions_create(mpm *s);
void motions_free(mpm *s);
/* Which directions mirrors leave to free bodies; after the points are seeded. */
void motions_start(mpm *s);
/* Takes the bodies' accelerations from their points. */
void motions_take_body_forces(mpm *s);
/* Takes force (N) and moment about the origin (N m) of body forces that change with place; after the accelerations. */
void motion_take_field(mpm *s, int body, const double force[3], const double moment[3]);
/* Largest rate (1/s) at which points of a body cross cells, as far as it is known. */
double motion_rate(const mpm *s, int body);

/* The motion of a velocity group; NULL: nodes move it. */
static inline body_motion *motion_of_group(const mpm *s, int group)
{
    return group < s->n_deforming_groups ? NULL : &s->motions->body[group - s->n_deforming_groups];
}

/* Whether nothing that others do changes the motion of a group. */
static inline bool motion_prescribes_group(const mpm *s, int group)
{
    return group >= s->n_deforming_groups && motion_is_prescribed(motion_of_group(s, group)->given);
}

/* Degrees of freedom of a free body: velocities along x, y, z, spins about them. */
enum { MOTION_DOFS = 6 };

static inline bool motion_is_free(const body_motion *m, int dof)
{
    return dof < 3 ? m->slides[dof] : m->turns[dof - 3];
}

/* The velocity at r from the centre by a unit of a degree of freedom. */
void motion_unit(int dof, const double r[3], double v[3]);
/* kg, kg m2: of the body, between two degrees of freedom. */
double motion_inertia(const body_motion *m, int d, int e);

void rigid_velocity(const rigid_field *f, const double x[3], double out[3]);
/* The rotation in dt (s) of a free body with a constant moment of momentum, from its inertia (xx yy zz xy yz zx) at the start. */
void rigid_free_turn(const double inertia[6], const double spin_momentum[3], const bool turns[3], double dt,
                     double turn[9]);
/* w with I w = L, of the components that may turn; others are 0. */
void rigid_spin(const double inertia[6], const bool turns[3], const double momentum[3], double w[3]);
/* exp of a rotation by `angle` (rad) about a unit vector. */
void rigid_rotation(const double axis[3], double angle, double turn[9]);
void rigid_turn_inertia(const double turn[9], const double inertia[6], double out[6]);
/* Sums over the points of a body. */
void rigid_sum_points(mpm *s, int body, rigid_sums *out);

/* Forces on surfaces of a group begin anew: they are scattered again. */
void motion_clear_loads(mpm *s, int group);
/* A force (N) on the body's surface, over a kick. */
void motion_load(const mpm *s, body_motion *m, const double x[3], const double force[3]);
/* Where the body takes a place of its surface in the step, how fast that is at the end, and the displacement over which forces
 * there do work. */
void motion_of_place(const mpm *s, const body_motion *m, const double x[3], double next[3], double velocity[3],
                     double path[3]);

/* Velocity (m/s) with which a place of the surface sweeps volume over the step, linear in what others give the body: the way
 * of a body that nobody pushes is exact, turned or not, and the rest is a rigid field. */
void motion_sweep(const mpm *s, const body_motion *m, const double x[3], double velocity[3]);

/* Adds the moment about the body's centre of an impulse at x. */
void rigid_add_moment(const body_motion *m, const double x[3], const double impulse[3], double moment[3]);

/* From whom the body gets an impulse: that of contact is work between bodies, too. */
typedef enum motion_giver { MOTION_BY_FLUID, MOTION_BY_CONTACT } motion_giver;
/* Impulse, moment about the body's centre, and work at the velocity of its nodes. */
void motion_give(mpm *s, body_motion *m, const double impulse[3], const double moment[3], double work,
                 motion_giver giver);

/* Sets a node field of every group with a motion: the rigid velocity at the start of the step (`now`), or in it; of
 * N_MOMENTUM times the mass. */
void motions_impose(mpm *s, field_id velocity, bool now);
/* How they move by what surfaces and body forces give them. */
void motions_solve(mpm *s);
/* The velocity of their nodes by that. */
void motions_predict(mpm *s);
/* Change of the rigid field at the end of the step (v and w of `out`) by an impulse (N s) and a moment about the body's centre. */
void motion_change(const body_motion *m, const double impulse[3], const double moment[3], rigid_field *out);
/* The same as motions_impose, also of what sticks to them. No one gets an impulse. */
void motions_impose_tied(mpm *s, field_id velocity, bool now);
/* Nothing of a change of velocities for their nodes. */
void motions_still(mpm *s, field_id change);
/* After contact: nothing of a change for what sticks to them; they get `share` of the impulses. */
void motions_constrain(mpm *s, field_id change, double share);
/* Velocities of a body's points and markers by a rigid field. */
void rigid_set_points(mpm *s, int body, const rigid_field *f);
/* Moves the points of a body; FLOE_RETRY where one would cross more than a cell. */
floe_status rigid_move_points(mpm *s, const body_motion *m);
/* Moves the points of every body with a motion; enters the prescribed ones' share into the ledger. */
floe_status motions_move(mpm *s);
/* Makes the rest of their state the next one. */
void motions_keep(mpm *s);

#endif
