#!/usr/bin/env bash
# One gas under several names is one gas: shock tubes against the errors under one name, along each axis, in products and bubbles. (Before, at frozen
# temperatures and with wide interfaces, two names had 20 % of density at a ratio of 1e3, and bubbly water 12 % too little pressure.)
# shellcheck source=tests/cli/lib.bash
source "$(dirname "$0")/lib.bash"
decks=$FLOE_SOURCE/inputs/defaults

# tube NAME DECK SETTING...: the tube of pressure ratio 1e3 at 200 cells.
tube() {
    local name=$1 deck=$2
    shift 2
    expect 0 "$FLOE" run "$decks/$deck.yaml" -o "$name" --quiet --set domain.cell=0.005 --set time.end=0.0122 \
        --set verify.exact.riemann.left_pressure=1000 "$@"
    has "$name/summary.json" '"rejected_steps": 0'
    below "$(json "$name/summary.json" energy)" 1e-13
}
# error NAME METRIC
error() { json "$1/summary.json" "$2"; }
# as_one NAME: errors over those of one name (measured: 0.60 of density, 0.94 to 0.97 of velocity; 0.70 and 0.96 as a strip).
as_one() {
    below "$(error "$1" l1rel_density)" "$(awk -v x="$(error one l1rel_density)" 'BEGIN { print 0.8 * x }')"
    below "$(error "$1" l1rel_velocity_x)" "$(awk -v x="$(error one l1rel_velocity_x)" 'BEGIN { print 1.1 * x }')"
}

# One name by the faces that several fluids have: alone, by its waves, it has half of that error (theory 2.17).
tube one g1_one --set method.limiter=van_leer
tube two g1_two
tube three g1_three
as_one two
as_one three
# The interface is where it is to be, two cells wide; with limiter first_order it is carried as it was.
below "$(error two l1_volume_fraction)" 0.002
tube wide g1_two --set method.limiter=first_order
below 0.01 "$(error wide l1_volume_fraction)"
below "$(json two/summary.json steps)" "$(awk -v n="$(json one/summary.json steps)" 'BEGIN { print 1.1 * n }')"

# A shock that passes from one name to the next: the fluids of the interface share its heat (without that 1.64 and 1.30 times the errors of one name).
tube waves g1_one
tube ahead g1_three --set 'bodies={left: {material: left, shape: {box: {lower: 0, upper: 0.5}}, state: exact}, middle: {material: middle, shape: {box: {lower: 0.5, upper: 0.62}}, state: exact}, right: {material: right, shape: {box: {lower: 0.62, upper: 1}}, state: exact}}'
tube passed g1_two --set 'bodies={left: {material: left, shape: {box: {lower: 0, upper: 0.62}}, state: exact}, right: {material: right, shape: {box: {lower: 0.62, upper: 1}}, state: exact}}'
for run in ahead passed; do # measured: 1.13 and 1.14 of density, 1.18 and 1.19 of velocity
    below "$(error $run l1rel_density)" "$(awk -v x="$(error waves l1rel_density)" 'BEGIN { print 1.25 * x }')"
    below "$(error $run l1rel_velocity_x)" "$(awk -v x="$(error waves l1rel_velocity_x)" 'BEGIN { print 1.25 * x }')"
done

# A strip along y is one along x, with the axes exchanged.
strip='state: exact, material'
tube along g1_two --set 'domain={dim: 2, lower: [0, 0], upper: [1, 0.02], cell: 0.005}' \
    --set "bodies={left: {shape: {box: {lower: [0, 0], upper: [0.5, 0.02]}}, $strip: left}, right: {shape: {box: {lower: [0.5, 0], upper: [1, 0.02]}}, $strip: right}}"
tube across g1_two --set 'domain={dim: 2, lower: [0, 0], upper: [0.02, 1], cell: 0.005}' --set verify.exact.riemann.axis=1 \
    --set 'verify.metrics=[l1rel_density, l1rel_velocity_y]' \
    --set "bodies={left: {shape: {box: {lower: [0, 0], upper: [0.02, 0.5]}}, $strip: left}, right: {shape: {box: {lower: [0, 0.5], upper: [0.02, 1]}}, $strip: right}}"
as_one along
awk -v a="$(error along l1rel_density)" -v b="$(error across l1rel_density)" 'BEGIN { d = a / b - 1; exit !(d * d < 1e-12) }' ||
    fault 'a strip along y is not one along x'

# The pressure that bubbly water has behind its shock, 24.87 MPa by the Hugoniot curves of water and air; air under one name and two.
# pressure NAME: at the probe at the end.
pressure() {
    awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^behind_pressure/) column = i } END { print $column }' "$1/history.csv"
}
expect 0 "$FLOE" run "$decks/g2_bubbly.yaml" -o bubbly --quiet --set domain.cell=0.01 --set 'output.probes={behind: 0.305}' --set output.history_interval=1e-4
expect 0 "$FLOE" run "$decks/g2_bubbly.yaml" -o bubbles --quiet --set domain.cell=0.01 --set 'output.probes={behind: 0.305}' --set output.history_interval=1e-4 \
    --set 'materials.other={eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}' --set bodies.air.fraction=0.5 \
    --set 'bodies.other={material: other, shape: {box: {lower: 0, upper: 1}}, pressure: 1 bar, temperature: 300 K, velocity: [-50]}'
for run in bubbly bubbles; do
    awk -v p="$(pressure $run)" 'BEGIN { d = p / 24.87e6 - 1; exit !(d * d < 0.02 * 0.02) }' || fault "$run: $(pressure $run) Pa behind the shock"
done

# A bubble that a shock crosses: nothing is lost, and no step rejected.
expect 0 "$FLOE" run "$decks/g1_bubble.yaml" -o bubble --quiet --set domain.cell=0.05
has bubble/summary.json '"rejected_steps": 0'
for what in mass momentum energy; do below "$(json bubble/summary.json $what)" 1e-13; done

# What is not right is warned of.
expect 0 "$FLOE" check "$decks/g1_products.yaml" --set materials.air.eos.ideal.gamma=1.09 --set bodies.air.pressure=1e5 --set bodies.air.state=null \
    --set bodies.air.density=1.2 --set bodies.products.pressure=1e10 --set bodies.products.state=null --set bodies.products.density=1630
cat stdout stderr >said
has said 'ratio of specific heats of 1.09'
cat >beside.yaml <<'END'
floe: 1
coupling: ice-mpm
domain: {dim: 2, lower: [0, 0], upper: [1, 0.1], cell: 0.02}
boundaries: {x: symmetry, y: slip}
materials:
  products: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}
  air: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}
  steel: {density: 7850, specific_heat: 460, law: {linear_elastic: {bulk_modulus: 160 GPa, shear_modulus: 80 GPa}}}
ambient: {material: air, pressure: 1 bar, temperature: 300}
bodies:
  products: {material: products, shape: {box: {lower: [0, 0], upper: [0.4, 0.1]}}, pressure: 100 bar, temperature: 300}
  air: {material: air, shape: {box: {lower: [0.4, 0], upper: [0.8, 0.1]}}, pressure: 1 bar, temperature: 300}
  wall: {material: steel, shape: {box: {lower: [0.8, 0], upper: [1, 0.1]}}}
time: {end: 1e-5}
END
# (Where solids are smeared: no solid keeps sharp surfaces from a scene.)
expect 0 "$FLOE" check beside.yaml
cat stdout stderr >said
! grep -q 'times its pressure beside' said || fault 'fluids beside a sharp wall are warned of'
expect 0 "$FLOE" check beside.yaml --set method.interface=smeared
cat stdout stderr >said
has said "body 'products' drives the fluid of body 'air' with 100 times its pressure beside smeared solids"

# A solid with a sharp surface in a corner, which the waves do not reach: the tube of two gases is as without it, to round-off (faces from waves, theory
# 2.17; with centred faces everywhere errors were twice as large). By steps of one length, as with it they are shorter.
cat >corner.yaml <<'END'
floe: 1
title: Two gases in a tube with a block in its corner
source: Riemann problem, Toro 2009, chapter 4
coupling: ice-mpm
runs_as: [ice-mpm]
reference_pressure: 1e4
domain: {dim: 2, lower: [0, 0], upper: [1.2, 0.08], cell: 0.01}
boundaries: {x: symmetry, y: slip}
materials:
  left: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}
  right: {eos: {ideal: {gamma: 1.6, specific_heat: 717.5}}}
  steel: {density: 7850, specific_heat: 460, law: {linear_elastic: {bulk_modulus: 160 GPa, shear_modulus: 80 GPa}}}
ambient: {material: right, pressure: 1e4, temperature: 185.8304297}
bodies:
  left: {material: left, shape: {box: {lower: [0, 0], upper: [0.5, 0.08]}}, pressure: 1e5, temperature: 348.4320557}
  right: {material: right, shape: {box: {lower: [0.5, 0], upper: [1.2, 0.08]}}, pressure: 1e4, temperature: 185.8304297}
  block: {material: steel, shape: {box: {lower: [1.087, 0], upper: [1.2, 0.033]}}, motion: fixed}
time: {end: 5e-4, max_step: 3e-6}
verify:
  exact:
    riemann: {left_density: 1, left_pressure: 1e5, right_density: 0.125, right_pressure: 1e4, right_gamma: 1.6, position: 0.5}
  region: {box: {lower: [0.1, 0], upper: [1, 0.08]}}
  metrics: [l1rel_density, l1rel_velocity_x, l1rel_pressure]
END
expect 0 "$FLOE" run corner.yaml -o corner --quiet
expect 0 "$FLOE" run corner.yaml -o free --quiet --coupling ice --set "runs_as=[ice]" --set bodies.block=null --set materials.steel=null
for what in mass momentum energy; do below "$(json corner/summary.json $what)" 1e-13; done
for what in density velocity_x pressure; do
    awk -v a="$(error corner l1rel_$what)" -v b="$(error free l1rel_$what)" 'BEGIN { d = a / b - 1; exit !(a > 0 && b > 0 && d * d < 1e-16) }' ||
        fault "$what: $(error corner l1rel_$what) beside a block, $(error free l1rel_$what) without it"
done
below "$(error corner l1rel_density)" 0.0065 # measured: 0.0043 (centred faces: 0.0083)

# A burst of air of 100 bar in water beside a fixed wall within a cell: behind the shock that comes back from it the water has 19.5225 MPa (Riemann problem of
# both, then the shock at which water stands; measured 1.2e-5 off, with centred faces 0.43 %).
cat >burst.yaml <<'END'
floe: 1
coupling: ice-mpm
reference_pressure: 1 bar
domain: {dim: 1, lower: 0, upper: 1, cell: 0.01}
boundaries: {x: symmetry}
materials:
  air: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}
  water: {eos: {stiffened: {gamma: 4.4, p_inf: 6e8, specific_heat: 1816}}}
  steel: {density: 7850, specific_heat: 460, law: {linear_elastic: {bulk_modulus: 160 GPa, shear_modulus: 80 GPa}}}
ambient: {material: air, pressure: 1 bar, temperature: 300}
bodies:
  gas: {material: air, shape: {box: {lower: 0, upper: 0.3}}, pressure: 100 bar, temperature: 300}
  water: {material: water, shape: {box: {lower: 0.3, upper: 0.9037}}, pressure: 1 bar, density: 1000}
  wall: {material: steel, shape: {box: {lower: 0.9037, upper: 1}}, motion: fixed}
time: {end: 5.5e-4}
output: {history_interval: 1e-4, probes: {behind: 0.875}}
END
expect 0 "$FLOE" run burst.yaml -o burst --quiet
awk -v p="$(pressure burst)" 'BEGIN { d = p / 19522486 - 1; exit !(d * d < 2.4e-5 * 2.4e-5) }' || fault "$(pressure burst) Pa behind the shock from a wall"
for what in mass momentum energy; do below "$(json burst/summary.json $what)" 1e-13; done
