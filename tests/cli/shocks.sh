#!/usr/bin/env bash
# Shock tubes, streams with interfaces, and blasts against their exact solutions, at coarse meshes; with the overrides that the decks name.
# Bars: measured errors and about an eighth.
# shellcheck source=tests/cli/lib.bash
source "$(dirname "$0")/lib.bash"

# variant DECK N: the N-th group of "#    --set ..." lines of the deck's head, as the array `overrides`.
variant() {
    local text
    text=$(awk -v want="$2" '/^#    --set/ { if (!on) n++; on = 1; sub(/^# */, ""); if (n == want) printf "%s ", $0; next } { on = 0 }' \
        "$FLOE_SOURCE/inputs/$1.yaml")
    [ "$2" -eq 0 ] || [ -n "$text" ] || fault "$1.yaml names no variant $2"
    eval "overrides=($text)"
}

# shock DECK VARIANT H METRIC BAR [METRIC BAR]...
shock() {
    local deck=$1 number=$2 h=$3 overrides
    shift 3
    variant "$deck" "$number"
    expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/$deck.yaml" -o "$deck-$number" --quiet "${overrides[@]}" --set domain.cell="$h"
    has "$deck-$number/summary.json" '"rejected_steps": 0'
    while [ $# -gt 0 ]; do
        below "$(json "$deck-$number/summary.json" "$1")" "$2"
        shift 2
    done
}

# Toro's problems 1 to 5, the right blast and Lax's, at 100 cells (measured: 0.0077, 0.0122, 0.069, 0.38, 0.061, 0.068, 0.0153).
shock riemann 0 0.01 l1_density 0.0087 l1_pressure 0.0082
shock riemann 1 0.01 l1_density 0.0138 l1_pressure 0.0048
shock riemann 2 0.01 l1_density 0.078 l1_velocity_x 0.29
shock riemann 3 0.01 l1_density 0.44 l1_velocity_x 0.23
shock riemann 4 0.01 l1_density 0.070 l1_velocity_x 0.50
shock riemann 5 0.01 l1_density 0.077 l1_velocity_x 0.12
shock riemann 6 0.01 l1_density 0.0173 l1_pressure 0.028

# Water and air, two gases (measured in per cent: 1.08 and 0.78 of density, 3.1 and 0.77 of pressure).
shock fluid_tube 0 0.01 l1rel_density 0.0122 l1rel_pressure 0.036 l1_volume_fraction 0.012
shock fluid_tube 1 0.01 l1rel_density 0.0088 l1rel_pressure 0.0087 l1_volume_fraction 0.0115

# Three fluids and two in one stream, limited (measured: 3e-12 and 3e-9 of the pressure, 1e-10 m/s of 100).
shock fluid_stream 0 0.02 linfrel_pressure 1e-7 linf_velocity_x 1e-8
shock fluid_stream 1 0.02 linfrel_pressure 1e-7 linf_velocity_x 1e-8

# Noh against a wall and, in the plane, a line; Sedov from a plane, and from a line about the axis (measured: 0.113, 2.56, 0.074, 0.120).
shock noh 0 0.01 l1_density 0.128 l1_pressure 0.029
shock noh 1 0.02 l1_density 2.9 l1_velocity_x 0.12
shock sedov 0 0.02 l1_density 0.084 l1_pressure 0.0018
shock sedov 1 0.03 l1_density 0.135 l1_pressure 0.0037
