#!/usr/bin/env bash
# The bits do not depend on which instructions the kernels have: the program as it chooses for this machine, against programs whose
# kernels are compiled for one generation of processors (tests/CMakeLists.txt). FLOE_WIDTHS: "generation=program ...", empty where
# the build has no choice.
# shellcheck source=tests/cli/lib.bash
source "$(dirname "$0")/lib.bash"
read -ra widths <<<"${FLOE_WIDTHS:-}"
[ ${#widths[@]} -gt 0 ] || exit 0

# Two gases pass through each other in a closed box of odd numbers of cells, fast and slow, so that every branch is met and
# vectors end in the middle of a row.
cat >mixing.yaml <<'DECK'
floe: 1
units: none
coupling: ice
domain: {dim: 3, lower: [0, 0, 0], upper: [1.9, 1.1, 0.7], cell: 0.1}
boundaries: {x: {lower: slip, upper: {outlet: {pressure: 1, material: thin}}}, y: slip, z: symmetry}
materials:
  thin: {eos: {ideal: {gamma: 1.4, specific_heat: 1}}}
  heavy: {eos: {ideal: {gamma: 1.7, specific_heat: 2}}}
ambient: {material: thin, pressure: 1, temperature: 1}
bodies:
  jet:
    material: heavy
    shape: {ball: {centre: [0.8, 0.5, 0.2], radius: 0.37}}
    pressure: 4
    temperature: 1.3
    velocity: [1.7, -0.6, 0.2]
loads: {weight: {gravity: {acceleration: [0, -0.5, 0]}}}
time: {end: 0.3}
DECK
sed -e '/^  heavy/d' -e 's/material: heavy/material: thin/' mixing.yaml >one.yaml

# same NAME DECK...: a run of the deck with each program.
same() {
    local name=$1 pair
    shift
    expect 0 "$FLOE" run "$@" -o "$name" --quiet
    below 10 "$(json "$name/summary.json" steps)"
    for pair in "${widths[@]}"; do
        # What this machine cannot run it did not choose.
        [ "${pair%%=*}" = x86-64-v3 ] && ! grep -qw avx2 /proc/cpuinfo && continue
        expect 0 "${pair#*=}" run "$@" -o "$name-${pair%%=*}" --quiet
        same_results "$name" "$name-${pair%%=*}"
    done
}
same two mixing.yaml
same one one.yaml
same row "$FLOE_SOURCE/inputs/sod.yaml"
same plane "$FLOE_SOURCE/inputs/isentropic_vortex.yaml" --set domain.cell=0.3125 --set time.end=0.6
same axis one.yaml --set domain.dim=2 --set domain.geometry=axisymmetric --set 'domain.lower=[0, 0]' \
    --set 'domain.upper=[1.9, 1.1]' --set 'boundaries={r: {upper: {outlet: {pressure: 1}}}, z: slip}' \
    --set 'bodies.jet.shape.ball.centre=[0, 0.5]' --set 'bodies.jet.velocity=[0, 0.6]' --set 'loads={}'
same points "$FLOE_SOURCE/inputs/shock_plate.yaml" --set time.max_steps=30
