#!/usr/bin/env bash
# Decks of York's thesis against their references.
# shellcheck source=tests/cli/lib.bash
source "$(dirname "$0")/lib.bash"

# piston NAME MASS END: the piston's period, cells of 1 as printed (asked for: half a per cent; measured: 0.003 % both,
# over a period and a half).
piston() {
    expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/piston_container.yaml" -o "$1" --quiet --set bodies.spring.membrane.heavy_mass="$2" \
        --set verify.reference.piston.mass="$2" --set time.end="$3"
    below "$(json "$1/summary.json" hperiod_position)" 1e-4
}
piston light 0.1 0.0107
piston heavy 1 0.034

# gas_expansion: points, and cells with next to nothing around the gas (measured: 13.7 and 7.2 % in L1 of density at the printed spacing).
for coupling in mpm ice; do
    expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/gas_expansion.yaml" --coupling "$coupling" -o "gas-$coupling" --quiet --set 'verify.metrics=[l1rel_density]'
    below "$(json "gas-$coupling/summary.json" mass)" 1e-14
    below "$(json "gas-$coupling/summary.json" momentum)" 1e-13
done
below "$(json gas-mpm/summary.json l1rel_density)" 0.145
below "$(json gas-ice/summary.json l1rel_density)" 0.08
below "$(json gas-mpm/summary.json energy)" 0.01
below "$(json gas-ice/summary.json energy)" 1e-13

# spring_mass: period and turning points of two and a half swings (asked for: half a per cent; measured: 0.017 and 0.022 %).
expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/spring_mass.yaml" -o spring --quiet --set time.end=0.05
below "$(json spring/summary.json hperiod_position)" 5e-4
below "$(json spring/summary.json hturns_position)" 5e-4

# string_mass: half as long as printed, against the law in a continuum (asked for: half a per cent; measured: 0.19 and 0.24 %); and with points that stay in
# their cells, against the law of these cells, small strain (measured: 0.12 and 0.05 %).
expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/string_mass.yaml" -o string --quiet --set time.end=0.05
below "$(json string/summary.json hperiod_position)" 5e-3
below "$(json string/summary.json hturns_position)" 5e-3
stay='[0.05, 1.99], [0.05, 1.98], [0.05, 1.97], [0.05, 1.89], [0.05, 1.88], [0.05, 1.87], [0.05, 1.79], [0.05, 1.78], [0.05, 1.77], [0.05, 1.69]'
mass=verify.reference.hanging_mass
expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/string_mass.yaml" -o stay --quiet --set time.end=0.05 --set "bodies.string.membrane.curve={points: {at: [$stay]}}" \
    --set $mass.slack=0.02 --set $mass.small_strain=1 --set $mass.constant_volume=0
below "$(json stay/summary.json hperiod_position)" 2.5e-3
below "$(json stay/summary.json hturns_position)" 1e-3

# ball_net: what the supports give is the change of momentum, to round-off, while the net is stretched (a third of the ball's is taken by then).
expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/ball_net.yaml" -o net --quiet --set time.end=1.2
below "$(json net/summary.json momentum)" 1e-13
below "$(json net/summary.json energy)" 0.01
impulse=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^"?ledger_momentum_x_boundary/) c = i } END { print -$c }' net/history.csv)
below 2 "$impulse"

# Membranes and springs that cannot be: refused with the place and the remedy before anything runs.
refuse() { # refuse TEXT ARGUMENT...
    local text=$1
    shift
    expect 2 "$FLOE" check "$FLOE_SOURCE/inputs/spring_mass.yaml" "$@"
    has stderr "$text"
}
refuse "spring_mass.yaml:32:" --set domain.cell=0.025 --set 'domain.upper=[0.1, 2]'
refuse "points 1 and 2, about (0.05, 1.99), are 0.033333 m apart along axis 2, more than a cell of 0.025 m: the membrane would be torn; give it more points" \
    --set domain.cell=0.025 --set 'domain.upper=[0.1, 2]'
refuse "bodies.spring.membrane: point 1 at (0.05, 2.03, 0) lies outside the domain" --set 'bodies.spring.membrane.curve.points.at.0=[0.05, 2.03]'
refuse "point 1 of membrane 'spring' has no mass" --set 'bodies.spring.membrane={curve: {points: {at: [[0.05, 1.9]]}}, thickness: 1}'
refuse "give the curve a length, or the point a heavy_mass" --set 'bodies.spring.membrane={curve: {points: {at: [[0.05, 1.9]]}}, thickness: 1}'
refuse "spring 't' holds on to point 99 of membrane 'spring', which has 10" \
    --set 'springs={t: {stiffness: 1, from: {body: spring, point: 99}, to: {position: [0.05, 1]}}}'
