/* Constants of the schemes for material points: what each is, where it comes from, and which error it trades for which. Facts of a basis
 * are members of its descriptor (basis/basis.h). Weights of stencils and quadratures, which follow from their order, stand where they are
 * used, and so do the three constants of the point kernels (transfer/locate.h, transfer/kernels_gather.h), which are compiled apart; those of the implicit solver have a
 * table of their own (implicit/implicit_constants.h). Those
 * without a source are of our own choice; "measured" where runs have chosen. */
#ifndef MPM_MPM_CONSTANTS_H
#define MPM_MPM_CONSTANTS_H

/* ---- transfer and steps (theory 4.1, 4.2) ---- */

/* Share of PIC in a step for each cell that the fastest point crosses, and at most, where fluids are on points and the deck gives
 * no share of FLIP. Measured: larger damps vortices, smaller leaves noise in gas. */
#define MPM_PIC_PER_CELL 0.6
#define MPM_PIC_MOST 0.01
/* Share of FLIP in a step elsewhere, where neither transfer nor deck gives one. The usual choice: smaller is steadier and more viscous. */
#define MPM_FLIP_SHARE 0.99
/* Least volume of a lump of points, over that before the step, of which the rates of a step are taken. Measured: bars of one point a cell
 * that met at two fifths of their speed of sound gained energy with 0.1; larger leaves out compressions that are real. */
#define MPM_LEAST_LUMP_VOLUME 0.8
/* Density over that at rest from which on points of a body that may thicken fold over each other (transfer/carry.c). Measured on weak discs that collide in
 * plane stress: with 2 some gain half of their energy, with 1.5 6 %, with 1.2 1.8 %; smaller leaves out compressions that are elastic. */
#define MPM_CROWD 1.2
/* Stable steps in several dimensions over those along a line (theory 4.6). Measured. */
#define MPM_STEP_IN_SPACE 1.25
/* A point with less than this share of its mass is consumed entirely by its reaction: smaller keeps light, unsteady points. */
#define MPM_BURNT_OUT 1e-3

/* ---- supports (theory 4.13), in cells ---- */

/* Nodes closer to the surface of a support than this are led, and lead none: their cell holds too little of the solid. */
#define MPM_SUPPORT_CLEAR 0.6
/* How well the surface is found, and how far beyond it a solid is looked for. */
#define MPM_SUPPORT_SURFACE 1e-9
#define MPM_SUPPORT_BESIDE 1e-3
/* Halves of how far beside a line of nodes points reach them, and bear on a master: farther off it would have next to no mass. */
#define MPM_SUPPORT_REACHED 0.75
#define MPM_SUPPORT_BEARING 0.625

/* ---- nearly incompressible bodies (theory 4.16) ---- */

/* Bulk over shear modulus above which the points of a patch of cells share a change of volume (a Poisson's ratio of 0.41). Measured
 * on the thick cylinder: below it that changes the stress by less than a tenth of its error. */
#define MPM_STIFF_BULK 5.0
/* Shares of a patch that a body has to fill for changes of volume to be linear there, and for one mean; with less each cell has its own. And
 * the least variance of its points' places along an axis, in squares of a cell (a patch full of points has a third). Measured on thick cylinders and thin ones
 * (theory 4.16): linear from 0.5 on the hoop stress has a fifth more error, from 0.75 on stresses that vary have a half more; without means of
 * cells a wall of half a cell is held by a fifth too little, and with them up to 0.5 the hoop stress has a tenth more. */
#define MPM_PATCH_LINEAR 0.6
#define MPM_PATCH_WHOLE 0.4
#define MPM_PATCH_LEAST_VARIANCE 0.02

/* ---- fluids on points (theory 4.9) ---- */

/* Relative decay of the excess volume at nodes over the motion by one cell; the largest relative change of a volume in a step; the
 * empty share of a node at a free surface. Measured: faster disturbs sound, slower lets gas points overfill the volume. */
#define MPM_VOLUME_PACE 0.5
#define MPM_VOLUME_CHANGE 0.1
#define MPM_SURFACE_EMPTY 0.5
/* A line of nodes whose areas sum to less than this share of a cell's face is no wall with fluid along it; there nodes that solids fill less
 * are not merged. */
#define MPM_WALL_AREA 0.3
#define MPM_WALL_FILL 0.1
/* Nodes with less than this share of the fluid of the line's heaviest node, or of their own fluid's mass in solid, have one velocity: forces on
 * almost no mass of one of the two would accelerate the points that see the node's gradient. Nodes that are merged tie fluid and solid along the wall, in
 * every step: with a hundredth a cylinder that sinks in water (twice as heavy, four cells in radius) goes 0.053 m where it should go 0.0997,
 * with this 0.0941; with a hundredth of this it goes 0.0948, and ends in some scenes. */
#define MPM_WALL_LEAST_NODE 1e-4
/* A solid lighter than this share of the fluid has the fluid's velocity along the whole line. Areas share the closing as suits the fluid, and give
 * nodes with little of a light solid any velocity: sound that meets a bar of 1e-3, 0.01, 0.03, 0.1 of its density gives it a velocity that is
 * 103, 12, 6, 4 % wrong, with this 1.4, 1.1, 0.8, 4 %. Shares by reduced masses mend these too, but a cylinder that sinks in water then falls
 * a third short. */
#define MPM_WALL_LIGHT 0.05
/* Of the mass at a node, so little fluid has no part in its heat: round-off. */
#define MPM_DRY_NODE 1e-9

/* ---- sides and contact (theory 4.7, 4.8) ---- */

/* w over c/h of the contact springs at unilateral sides. At 1 half a cell's mass on such a spring is damped just critically by the waves
 * that it sends into its body (impedance rho c); stiffer, it oscillates by itself, at a frequency that the mesh does not carry and transfers
 * take away. Measured: a bar of 8, 16 and 32 cells that meets a side keeps 0.986, 0.995, 0.996 of its energy; with 0.7 it keeps 0.994,
 * 0.997, 0.998, and is pressed for longer; with 1.2 it keeps 0.952, 0.985, 0.996. */
#define MPM_SIDE_STIFFNESS 0.85
/* Cells of overlap where the force is twice that of the first slope; and the slope at which hardening ends, over the first. Larger
 * overlaps, or a spring that is not stable. */
#define MPM_SIDE_HARDENING 0.5
#define MPM_SIDE_MOST_SLOPE 8.0
/* Overlap over spacing at which bodies without a yield stress yield. */
#define MPM_SIDE_YIELD 1e-3
/* Share of the mass of the group's heaviest point below which points feel the kicks of a node in proportion to it. Such a node may be kicked to 1e6 times the velocity of its
 * points: its kinetic energy would be all of the contact's work in the ledger (a run of a sliding block was ended by it). */
#define MPM_FELT_NODE 1e-3
/* Cells by which points must be farther apart along the normal of one body than along the common normal for it to be that of the contact. */
#define MPM_TILTED_NORMAL 0.02
/* Largest step over h/c where splines restore the velocities of bodies in contact. Measured: a block on another, both as wide as the plane mesh, is calm at 0.30 and swings up
 * at 0.34 (0.24 along the line in which they press). */
#define MPM_CONTACT_STEP 0.2
#define MPM_CONTACT_STEP_IN_SPACE 0.28
/* Cells outside a body with a motion of its own up to which nodes of another are in contact with it: on whole cells those of its surface alone. */
#define MPM_HELD_NODE 0.5
/* Gaps of less than this share of a cell are closed: round-off. */
#define MPM_CLOSED_GAP 1e-6
/* The same for bodies that stick: the gap of their points opens as they are pulled. A bar drawn at 1.4e-3 of its speed of sound by what it stuck to was let go. */
#define MPM_TIED_GAP 0.25

/* ---- edges of solids (theory 4.10) ---- */

/* Cells that nodes may move before the penalised lines are searched again, though the same nodes take forces; a body at rest is not
 * searched again. Measured: up to 0.1 a soft cylinder that opens by a cell has the same error to 1 %. A node that points newly reach is
 * searched at once: until then its few points strain freely, and its lines would store that (GIMP on the thick cylinder at h = 0.05, where
 * lines needed more mass than forces do: 16 % for 9). */
#define MPM_EDGE_TRAVEL 0.05
/* A node that solids fill to less than this is partly filled; points that are not on a lattice leave some of an inner node empty. */
#define MPM_FULL_NODE 0.95
/* A node with less than this share of what is filled on both sides of it is outside a body that lies on both. */
#define MPM_HOLLOW_NODE 0.5
/* Of the yield stress of a solid, what lines at its edges bear at most over their area. */
#define MPM_EDGE_STRENGTH 0.05

/* Bodies of the plane that meet in contact have lines at the nodes that they share, unless their stiffnesses are farther apart than this. Measured: a heavy block that
 * lies on one of 0.1 of its stiffness and density is calm, on 0.03 it swings up. */
#define MPM_EDGE_CONTRAST 8.0
/* Conjugate gradients of the accelerations end at this residual over the right-hand side, in the norm of the inverse diagonal, or after
 * so many iterations: smaller costs time and changes no error. */
#define MPM_EDGE_TOLERANCE 1e-2
enum { MPM_EDGE_ITERATIONS = 500 };
/* A motion of a body that others make up to this share is left out: round-off. */
#define MPM_EDGE_INDEPENDENT 1e-10

#endif
