#!/usr/bin/env bash
# Extreme scenes that take a moment: none may be wrong. The whole table: scripts/results.sh extreme.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

for deck in "$FLOE_SOURCE"/inputs/extreme/*.yaml; do
    expect 0 "$FLOE" check "$deck"
done
expect 0 "$FLOE" study "$FLOE_SOURCE/inputs/extreme/vacuum.yaml" --couplings ice -o vacuum
has stdout '12 cases: 12 right, 0 refused, 0 wrong'
