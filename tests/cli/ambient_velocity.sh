#!/usr/bin/env bash
# A uniform stream: the ambient and what lies in it move alike, and go on so, in every coupling; without points there is nothing to move.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

cat >stream.yaml <<'END'
floe: 1
coupling: ice
reference_pressure: 1e5
domain: {dim: 2, lower: [0, 0], upper: [1, 0.5], cell: 0.0625}
boundaries: {x: periodic, y: periodic}
materials:
  air: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}
ambient: {material: air, pressure: 1e5, temperature: 300, velocity: [30, 20]}
bodies:
  part: {material: air, shape: {ball: {centre: [0.5, 0.25], radius: 0.15}}, pressure: 1e5, temperature: 300, velocity: [30, 20]}
time: {end: 2e-3}
output: {interval: 2e-3}
END
rubber=(--set 'materials={air: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}, rubber: {density: 1000, specific_heat: 1000,
    law: {neo_hookean: {bulk_modulus: 20e6, shear_modulus: 5e6}}}}'
    --set 'bodies={part: {material: rubber, shape: {ball: {centre: [0.5, 0.25], radius: 0.15}}, velocity: [30, 20]}}')

# moves_on LIMIT NAME ARGUMENT...: momentum over mass is (30, 20) at the end, and kinetic energy that of it, to LIMIT (30, 20: 650 J/kg)
moves_on() {
    local limit=$1 name=$2
    shift 2
    expect 0 "$FLOE" run stream.yaml -o "$name" --quiet "$@"
    awk -F, -v limit="$limit" '
        NR == 1 { for (k = 1; k <= NF; k++) { sub(/ .*/, "", $k); at[$k] = k } next }
        { u = $at["momentum_x"] / $at["mass"]; v = $at["momentum_y"] / $at["mass"]; e = $at["kinetic"] / $at["mass"] }
        function off(a, b) { return a > b ? a / b - 1 : 1 - a / b }
        END { exit !(NR > 2 && off(u, 30) <= limit && off(v, 20) <= limit && off(e, 650) <= limit) }' "$name/history.csv" ||
        fault "$name: $(tail -n 1 "$name/history.csv" | cut -c1-200)"
}
moves_on 1e-13 cells
moves_on 1e-13 alone --set bodies=null # the ambient fills the scene
moves_on 1e-13 points --coupling mpm
moves_on 6e-7 both --coupling ice-mpm "${rubber[@]}" # 2.3e-7: the body gains what pressure of its smeared edge gives
has cells/deck.yaml 'velocity: [30, 20]'

expect 2 "$FLOE" check stream.yaml --coupling mpm --set ambient.points=0
has stderr 'ambient.velocity'
has stderr 'give it points, or leave its velocity out'
