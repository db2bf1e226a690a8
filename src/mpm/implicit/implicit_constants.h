/* Constants of statics and implicit dynamics, as in mpm_constants.h. */
#ifndef MPM_IMPLICIT_CONSTANTS_H
#define MPM_IMPLICIT_CONSTANTS_H

/* Iterations of Newton's method, of contact conditions in one of them, halvings of an increment, and of conjugate gradients. */
enum { MPM_MOST_NEWTON = 30, MPM_MOST_CONTACT_ITERATIONS = 60, MPM_MOST_HALVINGS = 6, MPM_MOST_KRYLOV = 1000 };
/* Relative residual at which conjugate gradients stop in an iteration of Newton's method: smaller costs time, larger iterations. */
#define MPM_NEWTON_FORCING 1e-4
/* An iteration that reduces the residual less than to this share gets a new matrix. */
#define MPM_NEWTON_SLOW 1e-2
/* Relative round-off of differences of velocities. */
#define MPM_NEWTON_ROUND_OFF 1e-6
/* An iteration that increases the residual by this factor has diverged, unless it is the first, in which parts with little stiffness
 * may rotate. */
#define MPM_NEWTON_DIVERGED 1e4
/* Of its stiffness, what a line of edges that yields (edge/edge.h) keeps in the matrix along its force, which does not change: less leaves light nodes without
 * any, more costs iterations of Newton's method. */
#define MPM_FLOWING_LINE 1e-3
/* Difference of grad u for the tangents of a law, and of strains for those of a membrane: an error of as much of the tangent, far
 * above round-off. */
#define MPM_TANGENT_DIFFERENCE 1e-7
/* Of displacements, this share of the largest is nothing; of the length of a contact condition, what others make up to it. */
#define MPM_CONTACT_NOTHING 1e-7
#define MPM_CONTACT_DEPENDENT 1e-6
/* A rigid motion of which the matrix makes less than this share of what its diagonal would is free. */
#define MPM_RIGID_STIFFNESS 1e-9
/* Below this share of a gas, a region only touches it. */
#define MPM_ENCLOSED_SHARE 1e-6
/* Of a node that reaches two gases one must have less than this share, or their pressure be the same. */
#define MPM_TWO_GASES_SHARE 0.03

/* Of bodies that share changes of volume: bulk modulus of a point over its shear modulus in the preconditioner, and the stiffness of patches over
 * that modulus. Measured on cylinders: with 1 to 3 as many iterations, with 10 a half more. */
#define MPM_VOLUME_BULK 2.0
#define MPM_VOLUME_SHEAR 3.0
/* Margin of the largest eigenvalues in the multigrid, by which it grows where the cycle proves indefinite, and its end. Conjugate gradients get over
 * an indefinite cycle, minimal residuals do not. Measured: with 1.1 a cylinder that opens by half ends at three quarters of its load. */
#define MPM_VOLUME_MARGIN 1.6
#define MPM_VOLUME_WIDER 1.5
#define MPM_VOLUME_MOST_MARGIN 10.0
/* Largest bulk over shear modulus: beyond it round-off of volumes is more than a thousandth of a stress that strains by 1e-6. */
#define MPM_MOST_BULK 1e6
/* Share of dt^2 K in the inertia of walls of an implicit pressure (implicit_walls.h). From a quarter on steps of any length are stable if K is exact; motions that
 * points do not return go twice as far, which asks for a half. A period of 20 steps is 1.7 % too long with it. */
#define MPM_WALL_STIFFNESS 0.5
/* Multiplications for the factors of their matrix in a step, at most. */
#define MPM_WALL_WORK 3e8
/* Smallest relative residual for minimal residuals. */
#define MPM_VOLUME_ROUND_OFF 1e-13

#endif
