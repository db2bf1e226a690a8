#!/usr/bin/env bash
# What decks say of the heat of solids: refused with place and remedy, warned of, or done; and a run that goes on from a checkpoint to the same bits.
# shellcheck source=tests/cli/lib.bash
source "$(dirname "$0")/lib.bash"

cat >bar.yaml <<'END'
floe: 1
title: warm bar
units: none
coupling: mpm
domain: {dim: 1, lower: 0, upper: 1, cell: 0.1}
boundaries: {x: {no_slip: {temperature: 2}}}
materials:
  solid: {density: 1, specific_heat: 1, conductivity: 0.1, law: {linear_elastic: {bulk_modulus: 1, shear_modulus: 0.5}}}
bodies:
  bar: {material: solid, shape: {box: {lower: 0, upper: 1}}, temperature: 2 + sin(pi * x)}
time: {end: 1}
output: {interval: 0.5, history_interval: 0.1}
END
expect 0 "$FLOE" check bar.yaml

refused() { check_refuses bar.yaml "$@"; }
refused specific_heat 'materials.solid={density: 1, conductivity: 1, law: {linear_elastic: {bulk_modulus: 1, shear_modulus: 0.5}}}'
refused linear method.basis=linear
refused 'explicit steps' time.solver=static
refused 'a number' 'materials.solid.conductivity=0' boundaries=slip
refused 'solid conducts' 'materials.solid.conductivity=0' bodies.bar.temperature=2
refused 'belongs to' 'materials.solid={density: 1, conductivity: 1, membrane: {string: {modulus: 1}}}'

# In a stiff gas: insulated, and said; with heat exchange smeared.
gas=(--set coupling=ice-mpm --set 'domain={dim: 2, lower: [0, 0], upper: [1, 1], cell: 0.1}' --set boundaries=slip
    --set 'materials.air={eos: {ideal: {gamma: 1.4, specific_heat: 1}}}' --set 'ambient={material: air, pressure: 0.01, temperature: 3}'
    --set reference_pressure=0.01 --set 'bodies.bar.shape={box: {lower: [0.3, 0.3], upper: [0.7, 0.7]}}')
expect 0 "$FLOE" check bar.yaml "${gas[@]}"
grep -q 'its surface is insulated' stderr || fault "no word of an insulated solid: $(cat stderr)"
expect 0 "$FLOE" check bar.yaml "${gas[@]}" --set method.heat_exchange=1
grep -q 'smeared, as method.heat_exchange' stderr || fault "no word of the smeared interface: $(cat stderr)"
! grep -q 'its surface is insulated' stderr || fault 'a solid with heat exchange is said to be insulated'

# Bodies in contact exchange no heat, which is said; joined ones do.
two=(--set 'bodies.other={material: solid, shape: {box: {lower: [2], upper: [3]}}}' --set 'domain={dim: 1, lower: [0], upper: [3], cell: 0.1}')
expect 0 "$FLOE" check bar.yaml "${two[@]}" --set 'contact={}'
grep -q "'bar' and 'other' conduct heat, but none passes" stderr || fault "no word of contact without heat: $(cat stderr)"
expect 0 "$FLOE" check bar.yaml "${two[@]}"
! grep -q 'none passes' stderr || fault 'bodies without contact are said to exchange no heat'

# A run that was stopped and resumed has the bits of one that was not.
fine=(bar.yaml --set domain.cell=0.01)
expect 0 "$FLOE" run "${fine[@]}" -o whole --quiet
expect 5 "$FLOE" run "${fine[@]}" -o part --max-wall 0.1
below "$(json part/summary.json steps)" "$(json whole/summary.json steps)"
expect 0 "$FLOE" run "${fine[@]}" -o part --resume --quiet
same_results whole part
