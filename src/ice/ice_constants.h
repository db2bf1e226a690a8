/* Constants of the schemes for fluids: what each is, where it comes from, and which error it trades for which. Weights of stencils and of
 * quadratures, which follow from their order, stand where they are used. Those without a source are of our own choice; "measured" where runs
 * have chosen. */
#ifndef ICE_ICE_CONSTANTS_H
#define ICE_ICE_CONSTANTS_H

/* ---- shocks and kinks (theory 2.5): smaller spreads smooth flow, larger lets the step ring ---- */

/* Compression over a cell, of the speed of sound, from which the shock sensor rises: smooth flow falls below it as it is refined. */
#define ICE_SHOCK_FOOT 0.005
/* Its rise above: it is 1 from a foot + 1/steepness of the speed of sound a cell on. */
#define ICE_SHOCK_STEEPNESS 20.0
/* Third differences over what differences there are, from which velocities have a kink, and the rise above (Christensen's limited viscosity): waves
 * of more than 20 cells have none. */
#define ICE_KINK_FOOT 0.15
#define ICE_KINK_STEEPNESS 4.0
/* 1 over the velocity's change, in speeds of sound over two cells, at which a kink is taken in full, and at which it is no longer: below it sound and
 * slow flow stay as they are, above it strong fans do. */
#define ICE_KINK_ONSET 400.0
#define ICE_KINK_END 12.0
/* Its viscosity is the sum of these in expansion, their difference in compression, where shocks have q. More damps ringing and spreads fans. */
#define ICE_KINK_MEAN 0.7
#define ICE_KINK_SIGNED 0.3

/* ---- interfaces of several fluids (theory 2.15) ---- */

/* Less than this share of a cell is no other fluid: round-off. */
#define ICE_INTERFACE_PURE 1e-12
/* Range of theta within two cells at an interface. Smaller would sharpen bubbly mixtures, larger lets interfaces spread. */
#define ICE_INTERFACE_RANGE 0.5
/* beta: three quarters of the rise within a cell (Xiao, Ii, Chen 2011). Steeper is thinner, and lets them wrinkle along the mesh. */
#define ICE_INTERFACE_STEEPNESS 2.3
/* Least beta along an axis that lies in the interface (the same). */
#define ICE_INTERFACE_LEAST_STEEPNESS 0.01
/* So little of a fluid lies at its own side of the cell, and of it so much may leave through one face in a step. Measured: more empties cells at
 * once, less leaves traces behind. */
#define ICE_INTERFACE_FOOT 0.02
#define ICE_INTERFACE_FOOT_SHARE 0.4
/* Neighbours that differ by less are the same; thinner slabs have the cell's mean: round-off. */
#define ICE_INTERFACE_TIE 1e-9
#define ICE_INTERFACE_LEAST_REACH 1e-9
/* A fluid whose own pressure differs from that of the cell by less than this share is not expanded to it. Measured:
 * larger leaves out work, smaller lets heat that has changed hands do some. */
#define ICE_NEAR_ONE_PRESSURE 0.02
/* Change of volume from which the gain by dP is that of the isentrope and no longer linear: larger is cheaper and heats traces of gas. */
#define ICE_LINEAR_SQUEEZE 0.05

/* ---- fluids beside solids that points carry (theory 2.10, 5.5) ---- */

/* Fluids with a smaller volume fraction beside a solid do not determine the pressure of their cell; it is extrapolated
 * from neighbours. Larger moves the wall outwards, smaller lets traces with almost no mass determine the pressure. */
#define ICE_LEAST_FLUID_FRACTION 1e-2
/* Below this fraction they are heated in proportion to it: else a trace would gain heat without bound (e of 1e11 J/kg
 * on the pressurised cylinder, measured). */
#define ICE_FULL_HEAT 1e-2
/* Volume fraction below which a specific volume changes at most by a factor, and that factor: traces keep a physical
 * state in spite of round-off. */
#define ICE_BOUND_FRACTION 1e-4
#define ICE_MOST_VOLUME_CHANGE 10.0

/* ---- guards (theory 2.8, 2.11): traces are changed so that their state stays valid ---- */

/* Where heat would leave less thermal energy than this share of the kinetic, it is not conserved: larger makes energy, smaller negative heat. */
#define ICE_THERMAL_SHARE 1e-3
/* What is left of a material below this share of a cell's volume, or of its mass, is dropped: round-off's size. */
#define ICE_LEAST_FRACTION 1e-13
#define ICE_LEAST_SHARE 1e-18
/* Below this share of a cell a material's velocity and energy may be quotients of round-off: its outflow and energy bind no step, */
#define ICE_TRACE_FRACTION 1e-6
/* and squares of velocities and energies are taken back where they are larger than this times those before. */
#define ICE_MOST_GAIN 1e4
/* Energy made by guards, of a cell's, that is counted; mass that a reaction leaves, of its reactant, that is taken too: round-off. */
#define ICE_COUNTED_DEFECT 1e-12
#define ICE_LAST_OF_REACTANT 1e-12
/* Keeps 0/0 of absent material at 0 without a branch; far below any density, speed squared or compressibility. */
#define ICE_TINY 1e-200

#endif
