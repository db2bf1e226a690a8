#!/usr/bin/env bash
# A block in free fall, of 1 kg, as a mass on a string that never becomes taut: its momentum and kinetic energy are those of
# the reference, in a whole run and in a resumed one; what cannot be compared is refused before the run.
# shellcheck source=tests/cli/lib.bash
source "$(dirname "$0")/lib.bash"

cat >fall.yaml <<'DECK'
floe: 1
coupling: mpm
domain: {dim: 1, lower: [0], upper: [2], cell: 0.1}
materials:
  rock: {density: 10, law: {linear_elastic: {bulk_modulus: 1 kPa, shear_modulus: 0.5 kPa}}}
bodies:
  block: {material: rock, shape: {box: {lower: [1.55], upper: [1.65]}}}
loads:
  weight: {gravity: {acceleration: [-10]}}
time: {end: 0.4}
method: {flip: 1}
output: {history_interval: 0.02}
verify:
  reference:
    hanging_mass: {mass: 1, modulus: 1 GPa, area: 1, length: 10, gravity: 10, slack: 5, one_way: 1}
  history: {velocity: momentum_x, kinetic: kinetic}
  metrics: [hmax_velocity, hend_velocity, hrms_kinetic]
DECK
expect 0 "$FLOE" check fall.yaml
expect 0 "$FLOE" run fall.yaml -o whole --quiet
# Velocities of points belong to half a step earlier: hardly 1 % over so few steps.
for metric in hmax_velocity hend_velocity hrms_kinetic; do
    below "$(json whole/summary.json $metric)" 0.05
    below 1e-12 "$(json whole/summary.json $metric)"
done
expect 0 "$FLOE" run whole/deck.yaml -o again --quiet
[ "$(json whole/summary.json hrms_kinetic)" = "$(json again/summary.json hrms_kinetic)" ] || fault 'the resolved deck differs'
expect 0 "$FLOE" run fall.yaml -o part --quiet --set time.end=0.2
expect 0 "$FLOE" run fall.yaml -o part --quiet --resume
[ "$(json whole/summary.json hmax_velocity)" = "$(json part/summary.json hmax_velocity)" ] || fault 'another error after a resume'

# A wrong end: the block starts at rest, the reference does not say so.
expect 0 "$FLOE" run fall.yaml -o other --quiet --set verify.reference.hanging_mass.gravity=11
below 0.05 "$(json other/summary.json hmax_velocity)"

expect 2 "$FLOE" run fall.yaml -o bad --quiet --set verify.history.velocity=momentum_y
has stderr "no column 'momentum_y'"
expect 2 "$FLOE" check fall.yaml --set verify.history='{speed: momentum_x}'
has stderr "unknown quantity of the reference 'speed'"
expect 2 "$FLOE" check fall.yaml --set verify.metrics='[hmax_tension]'
has stderr 'verify.history names no column'
expect 2 "$FLOE" check fall.yaml --set verify.metrics='[l1_density]'
has stderr 'needs verify.exact'
expect 2 "$FLOE" check fall.yaml --set verify.reference.hanging_mass.one_way=0
has stderr 'verify.reference.hanging_mass.slack: 5 m: a spring has none'
