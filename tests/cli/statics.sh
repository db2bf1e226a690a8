#!/usr/bin/env bash
# Loads that are solved for instead of stepped to: what a run says, resuming between increments, refusals.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
ring=("$FLOE_SOURCE/inputs/annulus_traction.yaml" --set domain.cell=0.1 --set time.solver=static)

expect 0 "$FLOE" run "${ring[@]}" -o one
[ "$(json one/summary.json status)" = at_rest ] || fault 'the state of rest is not called one'
[ "$(json one/summary.json steps)" = 1 ] || fault 'more than one increment'
below "$(json one/summary.json eq13)" 0.045
has stdout 'solver static; 1 steps, 3 iterations'

expect 0 "$FLOE" run "${ring[@]}" --set time.increments=3 -o whole --quiet
expect 0 "$FLOE" run "${ring[@]}" --set time.increments=3 -o part --set time.max_steps=1 --quiet
[ "$(json part/summary.json steps)" = 1 ] || fault 'the run did not stop after an increment'
expect 0 "$FLOE" run "${ring[@]}" --set time.increments=3 -o part --resume --quiet
cmp whole/history.csv part/history.csv || fault 'other histories' # the first snapshots hold other decks
last=$(find whole/fields -name '*.h5' | sort | tail -n 1)
cmp "$last" "part/fields/${last##*/}" || fault 'other bits at the end'

# The cylinder beside gas on cells, either interface: there is no step whose stress the cells could have.
for interface in smeared sharp; do
    expect 0 "$FLOE" run "$cylinder" --set domain.cell=0.05 --set time.solver=auto --set method.interface=$interface -o $interface --quiet
    below "$(json $interface/summary.json eq13)" 0.007
done

# auto says what it does and why; who is free to move is refused, and so is what moves.
expect 0 "$FLOE" run "${ring[@]}" --set time.solver=auto -o auto
has stdout 'solver static: the deck asks for the state of rest'
expect 3 "$FLOE" run "${ring[@]}" --set 'boundaries={x: free, y: free}' -o loose
has stderr 'free to move as a rigid one'
expect 2 "$FLOE" run "$FLOE_SOURCE/inputs/bar_vibration.yaml" --set time.solver=implicit -o bar
has stderr 'give increments, fixed_step or max_step'
expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/bar_vibration.yaml" --set time.solver=implicit --set 'time.max_step=5 ms' -o bar
[ "$(json bar/summary.json steps)" = 14 ] || fault 'steps of 5 ms are not 14'
expect 2 "$FLOE" run "$FLOE_SOURCE/inputs/two_bars.yaml" --set time.solver=static --set 'contact={kind: friction, friction: 0.3}' -o bars
has stderr 'error: --set time.solver=static: contact.friction other than 0'
expect 3 "$FLOE" run "$FLOE_SOURCE/inputs/two_bars.yaml" --set time.solver=static --set 'loads={push: {body_force: {body: left, acceleration: [1, 0]}}}' -o bars
has stderr 'free to move as a rigid one'

# A membrane around gas.
expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/membrane_dogbone.yaml" --set time.solver=static --set domain.cell=0.2 --set bodies.skin.membrane.number=100 -o bone --quiet
below "$(json bone/summary.json hlate_pressure)" 1e-4
below "$(json bone/summary.json hlate_radius_last)" 1e-4

# Gas on cells at rest beside a solid: resumed between increments to the same bits.
gas=("$FLOE_SOURCE/inputs/pressurized_cylinder.yaml" --set domain.cell=0.1 --set time.solver=auto --set time.increments=3)
expect 0 "$FLOE" run "${gas[@]}" -o gas
has stdout 'solver static: the deck asks for the state of rest'
expect 0 "$FLOE" run "${gas[@]}" -o gas-part --set time.max_steps=1 --quiet
expect 0 "$FLOE" run "${gas[@]}" -o gas-part --resume --quiet
cmp gas/history.csv gas-part/history.csv || fault 'other histories of the gas'
last=$(find gas/fields -name '*.h5' | sort | tail -n 1)
cmp "$last" "gas-part/fields/${last##*/}" || fault 'other bits of the gas at the end'

# Bodies in contact: the stress of Hertz; resumed between increments, with the surfaces that gaps are measured between.
press=("$FLOE_SOURCE/inputs/pressed_cylinder.yaml" --set domain.cell=0.025 --set output.interval=0.3)
expect 0 "$FLOE" run "${press[@]}" -o press
below "$(json press/summary.json l1rel_stress_yy)" 0.06 # measured 0.042, by points alone 0.4
expect 0 "$FLOE" run "${press[@]}" --set time.increments=3 -o press-whole --quiet
expect 0 "$FLOE" run "${press[@]}" --set time.increments=3 -o press-part --set time.max_steps=1 --quiet
expect 0 "$FLOE" run "${press[@]}" --set time.increments=3 -o press-part --resume --quiet
cmp press-whole/history.csv press-part/history.csv || fault 'other histories of the contact'
last=$(find press-whole/fields -name '*.h5' | sort | tail -n 1)
cmp "$last" "press-part/fields/${last##*/}" || fault 'other bits of the contact at the end'
# What round-off would make a stress of is said, not solved for.
expect 2 "$FLOE" run "$FLOE_SOURCE/inputs/extreme/load_at_once.yaml" --set materials.rubber.law.linear_elastic.shear_modulus=2e-7 -o stiff
has stderr "the bulk modulus of body 'cylinder' is 5e+06 times its shear modulus: round-off of volumes would be a stress"
# And of implicit steps that the pressure swings.
expect 0 "$FLOE" check "$FLOE_SOURCE/inputs/defaults/e7_cylinder.yaml" --set time.solver=implicit --set time.max_step=0.2 --set materials.rubber.law.linear_elastic.bulk_modulus=187.5
has stderr "in implicit steps the pressure that a sudden load makes there swings"
