#!/usr/bin/env bash
# floe plan: a scene pays only for what it uses.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

# Points alone: no cell array, no stage of the cells.
expect 0 "$FLOE" plan "$FLOE_SOURCE/inputs/annulus_traction.yaml" --json
[ "$(json stdout ice)" = 0 ] || fault 'a scene of solids holds bytes of cells'
[ "$(json stdout coupling)" = mpm ] || fault 'another coupling'
if grep -qE '"on": "(cells|faces)"|"name": "ice_' stdout; then fault 'a scene of solids has cells'; fi
has stdout '"id": "P_STRESS"'
has stdout 'mpm_points_to_nodes'
below 0 "$(json stdout points)"
below 0 "$(json stdout dt)"

# One gas in cells: no points, no volume fractions, no pressure solve, no exchange.
expect 0 "$FLOE" plan "$FLOE_SOURCE/inputs/sod.yaml" --coupling ice --json
[ "$(json stdout mpm)" = 0 ] || fault 'a scene of one gas holds bytes of points'
if grep -qE '"on": "(points|nodes)"|"name": "mpm_' stdout; then fault 'a scene of one gas has points'; fi
if grep -qE '"id": "(C_THETA|C_VOL|C_SOURCE)"|"name": "ice_exchange"' stdout; then fault 'one gas pays for two'; fi
has stdout '"id": "C_RHO"'

# As text, and without a trace on the disk.
expect 0 "$FLOE" plan "${tiny[@]}"
has stdout 'stages of a step'
has stdout 'reads'
has stdout 'first step'
has stdout 'bytes'
[ "$(ls)" = "$(printf 'stderr\nstdout')" ] || fault "the plan has left files: $(ls)"
