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

# What a scene of many cells would need is told without taking it, and set beside what the machine has. Sanitizers map more than any limit.
if ! "$FLOE" --version | grep -qF fsanitize; then
    small() { # MEMORY in kilobytes, COMMAND...
        bash -c 'ulimit -v "$0"; exec "$@"' "$@"
    }
    huge=("$FLOE_SOURCE/inputs/sod.yaml" --set study=null --set domain.cell=1e-9)
    expect 0 small 2000000 "$FLOE" plan "${huge[@]}"
    has stdout 'mesh of 1000000000 cells of 1e-09 m'
    has stdout 'numbers and bytes are estimates'
    has stdout 'it does not fit'
    has stdout 'cells would fit: domain.cell'
    expect 0 small 2000000 "$FLOE" plan "${huge[@]}" --json
    below 1e11 "$(json stdout held)"
    [ "$(json stdout fits)" = false ] || fault '1e9 cells fit into 2 GB'
    expect 2 small 2000000 "$FLOE" run "${huge[@]}" -o huge
    has stderr 'domain.cell=1e-9'
    has stderr 'take a cell of'
    [ ! -e huge ] || fault 'a run that has no room has made its folder'

    # In space, with points, a membrane and gas.
    expect 0 small 2000000 "$FLOE" plan "$FLOE_SOURCE/inputs/pressurized_sphere.yaml" --set study=null --set domain.cell=5e-4
    has stdout 'numbers and bytes are estimates'
    has stdout 'it does not fit'
fi

# The estimate of a scene just too large to be measured is that of one just small enough, to 2 %.
held() {
    expect 0 "$FLOE" plan "$FLOE_SOURCE/inputs/sod.yaml" --set study=null --set domain.cell="$1" --json
    json stdout held
}
below "$(awk -v a="$(held 8e-7)" -v b="$(held 1e-6)" 'BEGIN { x = a / 1.25 / b - 1; print x < 0 ? -x : x }')" 0.02
has stdout '"estimated": false'
expect 0 "$FLOE" plan "${tiny[@]}"
has stdout 'available: it fits'

# The table of fields is 80 columns wide at most, with the longest names, units and numbers.
expect 0 "$FLOE" plan "$FLOE_SOURCE/inputs/burning_block.yaml"
has stdout 'specific_volume_lagrangian'
cp stdout fields
expect 0 "$FLOE" plan "$FLOE_SOURCE/inputs/sod.yaml" --set domain.cell=1e-7
cat stdout >>fields
if grep '^[A-Z]_.\{79\}' fields; then fault 'the table of fields is wider than 80 columns'; fi
