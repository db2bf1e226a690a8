/* Constants of the exchange and of the equilibrium: what each is, where it comes from, and which error it trades for which. Weights of quadratures and
 * coefficients of published laws stand where they are used; those without a source are of our own choice. */
#ifndef COUPLING_CONSTANTS_H
#define COUPLING_CONSTANTS_H

#include <float.h>

/* Beyond this many times the largest mass a coupling adds nothing but cancellation (theory 2.2). */
#define EXCHANGE_RIGID 1e12
/* Share of a cell, of volume or mass, below which a third material takes no part in what others exchange, and from which it takes all: larger lets
 * bubbles slip that should not, smaller lets traces lock what slips. */
#define TRACE_NONE 1e-4
#define TRACE_ALL 1e-2
/* The carrier's fraction by which a dispersed law is divided is no smaller: where it is, nothing is exchanged. */
#define DISPERSED_LEAST_CARRIER 1e-6
/* The equilibrium pressure has been found at this excess of volume, of the cell's, or in a bracket this narrow: round-off. */
#define EQUILIBRIUM_RESIDUAL 1e-13
#define EQUILIBRIUM_INTERVAL (4.0 * DBL_EPSILON)
/* hi/lo of a bracket that Brent's method takes; wider ones are halved in the logarithm. */
#define EQUILIBRIUM_NARROW 32.0
enum { EQUILIBRIUM_MOST_ITERATIONS = 200, EQUILIBRIUM_STARTING_STEPS = 1 };
/* Error of the masses that react, of themselves and of the reactant: smaller costs evaluations of the rates. */
#define REACTION_RELATIVE 1e-9
#define REACTION_ABSOLUTE 1e-13
/* What a reaction leaves of the reactant, of the cell's mass, goes too: round-off. */
#define REACTION_LAST 1e-12
/* At most this share of the points in a cell is consumed by a reaction in a step. */
#define TRANSFER_MOST_SHARE 0.5

#endif
