#!/usr/bin/env bash
# Decks of metals under impact: what is refused, with place and remedy; in the plane, about the axis and in space, as points and beside a gas; and a run that
# goes on from a checkpoint to the same bits.
# shellcheck source=tests/cli/lib.bash
source "$(dirname "$0")/lib.bash"

cat >bar.yaml <<'END'
floe: 1
title: copper cylinder on a wall
coupling: mpm
domain: {dim: 2, geometry: axisymmetric, lower: [0, 0], upper: [9 mm, 27 mm], cell: 0.75 mm}
boundaries: {z: {lower: slip}}
materials:
  copper:
    density: 8960 kg/m^3
    specific_heat: 383 J/kg/K
    law:
      johnson_cook: {bulk_modulus: 129 GPa, shear_modulus: 46 GPa, yield_stress: 90 MPa, hardening_modulus: 292 MPa, hardening_exponent: 0.31, rate_coefficient: 0.025,
        softening_exponent: 1.09, melting_temperature: 1356 K, d1: 0.054, d2: 0.489, d3: -3.03, d4: 0.014, d5: 1.12, shock_slope: 1.489, grueneisen: 1.99}
    artificial_viscosity: {linear: 0.3, quadratic: 1.5}
bodies:
  bar: {material: copper, shape: {box: {lower: [0, 0], upper: [3.75 mm, 24 mm]}}, points: 2, velocity: [0, -190 m/s]}
time: {end: 10 us}
output: {interval: 5 us}
END
law=materials.copper.law.johnson_cook
expect 0 "$FLOE" check bar.yaml

refused() { check_refuses bar.yaml "$@"; }
refused specific_heat materials.copper.specific_heat=null
refused 'rate of strain' time.solver=static
refused 'rate of strain' time.solver=implicit
refused 'time.solver static and implicit keep the temperatures' time.solver=implicit $law.rate_coefficient=0
refused 'expands the solid already' materials.copper.expansion=1.7e-5
refused grueneisen $law.grueneisen=0
refused 'twice its shock_slope' $law.grueneisen=3
refused 'above its reference_temperature' $law.melting_temperature=200
refused 'd1 + d2 exp(1.5 d3) > 0' $law.d1=-1
refused "'d3': 3.03 is out of range" $law.d3=3.03
refused "'hardening_exponent': 0 is out of range" $law.hardening_exponent=0
cold=($law.rate_coefficient=0 $law.melting_temperature=0 $law.d5=0)
for s in "${cold[@]}"; do still+=(--set "$s"); done
expect 0 "$FLOE" check bar.yaml "${still[@]}" --set time.solver=static --set bodies.bar.velocity=null --set boundaries.z.lower=no_slip

# Points that have used up their failure strain have failed; the rest have warmed.
expect 0 "$FLOE" run bar.yaml -o axis --quiet
/usr/bin/python3 - <<'END' || fault 'no point has failed, or none is warm'
import h5py
points = h5py.File("axis/fields/000002.h5")["points/bar"]
damage, failed, T = points["damage"][:], points["failed"][:], points["temperature"][:]
assert 0 < failed.sum() < len(failed) and (damage[failed > 0] >= 1).all() and (damage[failed == 0] < 1.2).all() and T.max() > 320
END

# The same law in the plane, in space and beside a gas.
few=(--set time.max_steps=20)
expect 0 "$FLOE" run bar.yaml --set domain.geometry=cartesian --set 'boundaries={y: {lower: slip}}' -o plane --quiet "${few[@]}"
expect 0 "$FLOE" run bar.yaml --set 'domain={dim: 2, stress_state: plane_stress, lower: [0, 0], upper: [9 mm, 27 mm], cell: 0.75 mm}' --set 'boundaries={y: {lower: slip}}' -o stress --quiet "${few[@]}"
expect 0 "$FLOE" run bar.yaml --set 'domain={dim: 3, lower: [0, 0, 0], upper: [9 mm, 9 mm, 27 mm], cell: 1.5 mm}' -o space --quiet "${few[@]}" \
    --set 'bodies.bar={material: copper, shape: {cylinder: {start: [4.5 mm, 4.5 mm, 0], end: [4.5 mm, 4.5 mm, 24 mm], radius: 3.75 mm}}, velocity: [0, 0, -190 m/s]}'
gas=(--set coupling=ice-mpm --set 'materials.air={eos: {ideal: {gamma: 1.4, specific_heat: 717.5 J/kg/K}}}' --set 'ambient={material: air, pressure: 1e5 Pa, temperature: 300 K}'
    --set reference_pressure=1e5 --set boundaries.z.lower=symmetry --set domain.upper='[9 mm, 30 mm]')
expect 0 "$FLOE" run bar.yaml "${gas[@]}" -o sharp --quiet "${few[@]}"
expect 0 "$FLOE" run bar.yaml "${gas[@]}" --set method.heat_exchange=1e6 -o smeared --quiet "${few[@]}"
/usr/bin/python3 - <<'END' || fault 'energy is not kept'
import csv
for run in ("axis", "plane", "stress", "space", "sharp", "smeared"):
    drift = [float(row["drift_energy (1)"]) for row in csv.DictReader(open(run + "/history.csv", encoding="utf-8"))]
    assert max(drift) < 0.01, run
END

# A run that was stopped and resumed has the bits of one that was not.
expect 5 "$FLOE" run bar.yaml -o part --max-wall 0.05
expect 0 "$FLOE" run bar.yaml -o part --resume --quiet
same_results axis part

# A bar that a pressure makes flow, between walls: the load is its stress everywhere, and with e = (P - 2/3 y)/K its end is at exp(-e). Measured:
# 0.103 in the two cells beside the load and 0.0059 at the end (0.80 and 0.033 where the lines of its edge bore a tenth of this).
cat >pressed.yaml <<'EOF'
floe: 1
coupling: mpm
domain: {dim: 1, lower: 0, upper: 1.5, cell: 0.05}
boundaries: {x: {lower: symmetry, upper: free}}
materials:
  metal: {density: 2000, law: {j2: {bulk_modulus: 50 MPa, shear_modulus: 30 MPa, yield_stress: 0.3 MPa}}}
bodies:
  bar: {material: metal, shape: {box: {lower: 0, upper: 1}}}
loads:
  push: {traction: {body: bar, surface: {halfspace: {point: 1, normal: 1}}, pressure: 1 MPa, ramp: 30 ms}}
damping: {rate: 500}
time: {end: 0.1}
output: {interval: 0.1, tracers: {end: {body: bar, position: 1}}}
EOF
expect 0 "$FLOE" run pressed.yaml -o pressed --quiet
/usr/bin/python3 - <<'END' || fault 'a pressed bar that flows'
import csv, math, h5py
points = h5py.File("pressed/fields/000001.h5")["points/bar"]
stress = [s for x, s in sorted(zip(points["position"][:, 0], points["stress_xx"][:]))]
end = float(list(csv.DictReader(open("pressed/history.csv", encoding="utf-8")))[-1]["end_displacement_x (m)"])
worst, off = max(abs(s / -1e6 - 1) for s in stress[-4:]), abs(end / (math.exp(-0.016) - 1) - 1)
print(worst, off)
assert worst < 0.2 and off < 0.012
END
expect 0 "$FLOE" check pressed.yaml
! grep -q 'times the strength' stderr || fault 'a warning of a weak surface'
expect 0 "$FLOE" check pressed.yaml --set materials.metal.law.j2.yield_stress='0.1 MPa'
has stderr "warning: pressed.yaml:$(grep -n '^  push:' pressed.yaml | cut -d: -f1):87: loads.push.traction.pressure: it is more than 8 times the strength"
expect 0 "$FLOE" check pressed.yaml --set materials.metal.law.j2.yield_stress='0.1 MPa' --set method.basis=gimp
! grep -q 'times the strength' stderr || fault 'a warning of a weak surface'
