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

/* Of the viscosity at kinks, per limited gradient. More damps the oscillations of a centred step, and smears the foot of fans. */
#define ICE_KINK_VISCOSITY 0.6
/* q of a shock: coefficients of the square of the velocity's jump over a cell and of the jump times the speed of sound (von Neumann and Richtmyer;
 * Landshoff). Less leaves oscillations, more widens the shock. */
#define ICE_SHOCK_QUADRATIC 0.75
#define ICE_SHOCK_LINEAR 0.3
/* Share of a cell's stiffness by which carried pressure may change the advanced one: any multiple of its own beside a vacuum otherwise. */
#define ICE_CARRIED_PRESSURE 0.25

/* ---- contacts and fans of one fluid (theory 2.5, 2.11): from where on, and how fast they count in full ---- */

/* Jump of density over two cells, of the density. Smaller takes smooth profiles for contacts, larger lets weak contacts spread. */
#define ICE_CONTACT_FOOT 0.05
#define ICE_CONTACT_STEEPNESS 20.0
/* Its inflection (Colella and Woodward 1984, eq. 1.16; there 0.05 and 20): the same trade. */
#define ICE_INFLECTION_FOOT 0.01
#define ICE_INFLECTION_STEEPNESS 60.0
/* So many times the isentrope's change of density explains no contact. */
#define ICE_CONTACT_COMPRESSION 10.0
/* Expansion of a cell, of the speed of sound, at which the mean at a face has more than the linear reconstruction, how fast it rises, and how much more
 * at most, beside other fluids the first. More sharpens fans and lets sound grow. */
#define ICE_FAN_FOOT 0.005
#define ICE_FAN_STEEPNESS 20.0
#define ICE_FAN_BESIDE_OTHERS 1.0
#define ICE_FAN_ALONE 1.5
/* Drop of pressure to the face, of rho c^2, from which a slab is expanded to it; the rise; the largest expansion; and the speeds of sound over which
 * it vanishes, from the foot of 1/2 to 3/4. Earlier or faster would expand fans that the mesh resolves. */
#define ICE_EXPANSION_FOOT 0.3
#define ICE_EXPANSION_STEEPNESS 3.0
#define ICE_MOST_EXPANSION 0.8
#define ICE_EXPANSION_SLOW 1.5
#define ICE_EXPANSION_SLOWING 2.0
/* Share of the range of its neighbours by which the corner of a cell may lie beyond it in velocity, with the implicit pressure: slow flow has no bounds there.
 * Smaller cuts the crests of shear layers, as drag: 6 % of it at 0, 2.4 % at 1/2. The share falls to none at that Mach number, in shocks and fans. */
#define ICE_SLOW_OVERSHOOT 0.5
#define ICE_SLOW_MACH 0.3
/* Bounds of the thickness of a donor slab, over that before its dilatation. */
#define ICE_LEAST_SLAB 0.5
#define ICE_MOST_SLAB 1.5

/* ---- states at faces, traced in characteristic variables (theory 2.17) ---- */

/* Contacts (Colella and Woodward 1984, eqs 1.16 and 3.2, their values): least jump of density over two cells; how much of it pressure may explain; and
 * the inflection from which a contact is steepened, and at which it is in full. */
#define ICE_TRACE_CONTACT 0.01
#define ICE_TRACE_COMPRESSION 0.1
#define ICE_TRACE_BEND_FOOT 0.05
#define ICE_TRACE_BEND_FULL 0.1
/* The first two come in between their bounds and so many times these; and an inflection does as the smaller of the second differences on both sides, of
 * opposite signs, rises to such a share of the jump: none is decided by round-off. Measured: with 2 in place of 1.1 density behind a blast is off by 4 % more. */
#define ICE_TRACE_CONTACT_FULL 1.1
#define ICE_TRACE_INFLECTION 0.02
/* Shocks that are flattened (the same, appendix, their values): jump of pressure, over the lower one; share of the jump over four cells that lies in two,
 * and the rise. */
#define ICE_TRACE_STRONG 0.33
#define ICE_TRACE_STEEP_FOOT 0.75
#define ICE_TRACE_STEEP_RISE 10.0
/* Only shocks that are nearly stationary on the mesh: their speed over that of the fastest wave, and the share of the pressure's jump that momentum
 * does not balance. Measured: flattening at all shocks increases the error of velocity by a quarter; 0.05 to 0.3 and 0.1 to 0.3 do as well. */
#define ICE_TRACE_SLOW_SPEED 0.2
#define ICE_TRACE_SLOW_THRUST 0.3
/* Velocity's rise over two cells, of the speed of sound, from which pressure and velocity are limited in place of waves: towards a vacuum. */
#define ICE_TRACE_TORN 1.5
/* Changes in half a step by what other axes do are at most this share of the state; of which at least this share must be left at a face. */
#define ICE_TRACE_MOST_CHANGE 0.3
#define ICE_TRACE_LEAST_LEFT 0.05
/* Mach number over which the viscous part of P* comes in: 1 over that at which it is full. Less damps vortices far below the speed of sound, more
 * lets them grow: the window is 3 to 4 (measured). */
#define ICE_TRACE_SLOW 4.0
/* Changes of velocity over two cells, of the speed of sound, below which fluid is at rest: larger takes slow vortices for sound, smaller round-off for vortices. */
#define ICE_TRACE_AT_REST 1e-7
/* 1 over the change of pressure over two cells, of rho c^2, from which such flow is limited as any other. */
#define ICE_TRACE_UNEVEN 20.0
/* Volume fraction, and share of the compressibility, from which the fluid that a cell holds most of crosses its faces in the state that waves bring, others
 * in the cell's own: at interfaces, and elsewhere, where drops or bubbles would not follow it. Measured: with 0.5 at interfaces tubes of two names of one gas
 * have a tenth less error, and an interface in a stream of a gas and a light liquid is unstable; with 0.5 elsewhere mixtures of halves diverge. */
#define ICE_TRACE_MAJORITY 0.9
#define ICE_TRACE_ALL_BUT_DROPS 0.99
/* And of the mass: a gas with a tenth of water in it moves as the water does. */
#define ICE_TRACE_HALF_OF_MASS 0.5
/* A cell with a neighbour less than 1/330 as dense as another, and in part up to 1/30, is at the interface of a liquid and a gas. */
#define ICE_TRACE_CONTRAST 33.0
#define ICE_TRACE_CONTRAST_ALL 1.1
/* Ratio of impedances of the cells at a face there, from which slow flow keeps its viscosity, and its rise with it: none up to 1/4, all from 3/4 on. Between cells of one
 * impedance it damps the gas beside the interface, between others the liquid. */
#define ICE_TRACE_ALIKE 0.25
#define ICE_TRACE_ALIKE_RISE 2.0
/* Ratio of the densities of a cell's neighbours up to which its mass lies at the sides of either: none above 0.4, all below 0.275. Measured: between liquids of 2:1 it does no good,
 * since what fluids share moves as one. */
#define ICE_LEAN_NONE 0.4
#define ICE_LEAN_RISE 8.0

/* ---- gravity (theory 2.6) ---- */

/* Of a cell that has lost more than so many times the mass that is left, gravity is of first order in time: larger trusts quotients of a cell all but empty. */
#define ICE_MOST_WEIGHT_CHANGE 10.0
/* Step over the time in which a body falls a cell, (h/g)^1/2, where fluids meet and the implicit pressure does not know how their interface moves in the step: larger lets ripples of
 * two cells grow. Measured, water under air at rest: from round-off by none in 30 s with 0.28, by a factor of e in 1.6, 1, 0.6 s with 0.35, 0.42, 0.56. */
#define ICE_RIPPLE_STEP 0.25

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
/* Fluids share the heat of a shock at their interface while the ratio of their densities behind it is above the first of these, and not at all
 * below the second. Measured: with 1/30 and 1/330 the shock that water sends into air starts 0.2 of a cell too far. */
#define ICE_SHARED_ALIKE 0.1
#define ICE_SHARED_UNLIKE 0.01
/* Such a fluid has cells to itself, from which its shock is known, that it fills to more than this. Less counts cells of the interface along it, which the
 * shock has heated as unevenly: with 0.5 a strip of cells has 1.38 times the error of one name, with 0.9 to 0.99 1.21. */
#define ICE_SHARED_FILLED 0.9
/* The pressure between waves is known to this share of it. */
#define ICE_SHARED_PRESSURE 1e-3
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
#define ICE_BOUND_FRACTION 1e-3
#define ICE_MOST_VOLUME_CHANGE 10.0

/* A liquid in a cell of which it has less than this share is dragged by the solid, times so many times the rate at which the pressure across the solid
 * would drive it along an oblique surface (theory 2.9). Less lets it be driven out of the wall, more locks it. */
#define ICE_DRAG_SHARE 0.5
#define ICE_DRAG_STRENGTH 30.0
/* Gradient of a wall's fraction, per cell, from which it has a normal: in a uniform mixture it is round-off's. */
#define ICE_LEAST_WALL_SLOPE 1e-6
/* Cells of which solids leave less than this get no fluid at the start, which would only absorb errors of volume. */
#define ICE_LEAST_FIRST_FRACTION 1e-6
/* K: of solids, whose bulk response does not depend on it. */
#define ICE_ANY_TEMPERATURE 300.0

/* ---- the time step (theory 2.14) ---- */

/* Of the stable step of diffusion. */
#define ICE_DIFFUSION_SHARE 0.9
/* A fluid has the mixture's speed of sound where exchange is so many times faster than sound crosses a cell. Smaller is unstable for loosely
 * tied fluids, larger lets hot traces bind the step. */
#define ICE_TIED 10.0

/* ---- embedded boundaries (theory 7.1) ---- */

/* A cell of which less than this is open to a gas is merged with a neighbour. Larger merges more cells than the step needs, smaller bounds the step. */
#define ICE_SMALL_CELL 0.5
/* The flow beside a boundary is fitted to values that lie beyond it by less than this, of a cell (theory 7.7): larger would see what is
 * behind a wall of one cell, smaller less of the flow about a bent one. */
#define ICE_WALL_BEYOND 0.5
/* Least distance, of a cell, over which a fluid's own velocity drags a boundary: smaller would bound the step, larger leave more to the fit. */
#define ICE_WALL_DISTANCE 0.25
/* Of the largest step of viscosity, so much is taken in scenes with such boundaries, however small their cells: a cell that is open by half
 * has its wall at a quarter of a cell. At 0.7 a cylinder and its flow are stable, at 1 not. */
#define ICE_WALL_DIFFUSION 0.5
/* The same of conduction where heat passes the boundaries: the half cell, with one neighbour a cell away and the wall, whose temperature follows it, at a quarter,
 * takes nine tenths of the difference at most. At 0.5 gas and a solid of its own heat capacity per volume are unstable. */
#define ICE_WALL_CONDUCTION 0.2
/* The velocities of the members of merged cells differ by no more than this share of the thermal energy allows (theory 7.7): larger could leave less
 * than the floor where a shock passes, smaller would flatten the flow beside walls at high Mach numbers. */
#define ICE_SPREAD_ENERGY 0.1
/* Sampled volume fractions in the open volume of a cell are used if they differ by more than this from those in the
 * whole cell. A smaller value would mistake the error of the samples for a difference. */
#define ICE_SAMPLED_DIFFERENCE 0.1
/* Volume fractions of cells that differ by less are those of one level: round-off. */
#define ICE_SAME_LEVEL 1e-9
/* A gap between bodies in contact, of a cell, and a density, of that at the start, below which it holds no gas: round-off of their surfaces. */
#define ICE_GAP_FRACTION 1e-6
#define ICE_GAP_DENSITY 1e-3
/* Of a cell: a gap between solids that is thinner has the state of the gas at its end. */
#define ICE_THIN_GAP 0.1
/* The same of a pocket between solids in contact that is closed all round; thicker ones are chambers. */
#define ICE_POCKET 0.01
/* Solids in contact may overlap by this share of a cell, and the volume outside several boundaries may be wrong by that: round-off. */
#define ICE_CONTACT_OVERLAP 1e-6
/* Neighbours with which a small cell may be merged are alike up to this share. */
#define ICE_ALIKE 1e-3
/* Mass that advection leaves in cells between solids in contact is round-off up to this share of that of a whole cell. */
#define ICE_GAP_ROUND_OFF 1e-11
#define ICE_OPEN_ROUND_OFF 1e-13

/* ---- gas at rest beside solids in equilibrium (theory 9) ---- */

/* Smeared solids let no gas pass cells of which they leave it less than this: larger closes narrow gaps, smaller lets gas through thin walls. */
#define ICE_PASSING_FRACTION 0.1
/* Gas enters a cell that solids leave from this share on, and stays in it down to the other: the distance between keeps cells from alternating. */
#define ICE_SHARE_TO_ENTER 0.01
#define ICE_SHARE_TO_STAY 1e-6
/* Largest factor on the densities beside solids by which a region has its mass; beyond, all its cells share the difference. */
#define ICE_MOST_DENSITY_FACTOR 4.0

/* ---- sources of mass ---- */

/* Volume fraction of fluids in a cell beside smeared solids below which no source lets anything in (theory 2.18): there a solid that moves could
 * leave no volume for it. More would move sources away from surfaces. */
#define ICE_LEAST_INJECTED 0.1

/* ---- the implicit pressure (theory 3) ---- */

enum { ICE_MOST_OUTER = 20, ICE_MOST_CG = 200, ICE_MOST_CUT_CG = 500 };
/* A residual that has grown this much since the best will not come down. */
#define ICE_HOPELESS_RESIDUAL 100.0
/* Required norm of the linear residual: of the tolerance times the fourth root of the number of cells, between the
 * norm's bound on the largest, which round-off may not let it reach, and the root of its mean square, which says
 * nothing of the largest; and of the largest residual there is, so that every search gets on. */
#define ICE_SHARE_OF_TOLERANCE 0.1
#define ICE_SHARE_OF_RESIDUAL 0.3

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
/* At most so much of a trace leaves its cell in a step. */
#define ICE_MOST_TRACE_OUTFLOW 0.5
/* A donor's gradients are flat where a neighbour has less than this share of its density: that has no state of its own. */
#define ICE_LEAST_NEIGHBOUR 1e-6
/* Of a value, or of a donor's mass: round-off. */
#define ICE_ROUND_OFF 1e-14
/* Energy made by guards, of a cell's, that is counted; mass that a reaction leaves, of its reactant, that is taken too: round-off. */
#define ICE_COUNTED_DEFECT 1e-12
#define ICE_LAST_OF_REACTANT 1e-12
/* Keeps 0/0 of absent material at 0 without a branch; far below any density, speed squared or compressibility. */
#define ICE_TINY 1e-200

#endif
