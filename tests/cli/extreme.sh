#!/usr/bin/env bash
# Extreme scenes that take a moment: none may be wrong. The whole table: scripts/results.sh extreme.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

for deck in "$FLOE_SOURCE"/inputs/extreme/*.yaml; do
    expect 0 "$FLOE" check "$deck"
done
expect 0 "$FLOE" study "$FLOE_SOURCE/inputs/extreme/vacuum.yaml" --couplings ice -o vacuum
has stdout '12 cases: 12 right, 0 refused, 0 wrong'
expect 0 "$FLOE" study "$FLOE_SOURCE/inputs/extreme/impedance.yaml" --axis materials.plate.density=0.014,1.4e-06 --axis method.interface=sharp --axis time.cfl=0.9 -o light
has stdout '4 cases: 2 right, 2 refused, 0 wrong'
expect 2 "$FLOE" run "$FLOE_SOURCE/inputs/extreme/impedance.yaml" --set materials.plate.density=0.0014 -o lighter
has stderr "is 0.001 times as heavy as the fluid beside it (1.4 kg/m3), and no interface bears less than 0.009"
