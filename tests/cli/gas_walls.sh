#!/usr/bin/env bash
# Gas of points along walls of points: pressure behind a shock that a wall sends back (exact), and what is in a closed box.
# shellcheck source=tests/cli/lib.bash
source "$(dirname "$0")/lib.bash"

# mean HISTORY FROM TO NAME...: mean of the named columns over the rows from one time to another.
mean() {
    awk -F, -v from="$2" -v to="$3" -v names="${*:4}" '
        NR == 1 { n = split(names, want, " "); for (i = 1; i <= NF; i++) for (k = 1; k <= n; k++) if (index($i, want[k] " ") == 1) at[i] = 1; next }
        $1 >= from && $1 <= to { for (i in at) { sum += $i; count++ } }
        END { printf "%.9g\n", sum / count }' "$1"
}

# off VALUE EXACT: the relative error.
off() {
    awk -v a="$1" -v b="$2" 'BEGIN { e = a / b - 1; printf "%.6g\n", e < 0 ? -e : e }'
}

tube=("$FLOE_SOURCE/inputs/defaults/e1_shock_tube.yaml" --coupling mpm --quiet --set 'domain={dim: 1, lower: 0, upper: 1.62, cell: 0.01}'
    --set 'boundaries={x: symmetry}' --set 'bodies.driver.shape={box: {lower: 0, upper: 0.7}}')
probes='output.probes={first: 1.495, second: 1.485, third: 1.475, fourth: 1.465}'
cells=(first_pressure second_pressure third_pressure fourth_pressure)

# reflected NAME SURFACE BAR_OF_FOUR BAR_OF_FIRST DRIFT SETTING...: 701.25 kPa behind the shock that comes back.
reflected() {
    local name=$1 wall=$2 four=$3 first=$4 drift=$5
    shift 5
    expect 0 "$FLOE" run "${tube[@]}" -o "$name" --set "bodies.driven.shape={box: {lower: 0.7, upper: $wall}}" --set "$probes" "$@"
    below "$(off "$(mean "$name/history.csv" 1.7e-3 2.4e-3 "${cells[@]}")" 701250)" "$four"
    below "$(off "$(mean "$name/history.csv" 1.7e-3 2.4e-3 first_pressure)" 701250)" "$first"
    below "$(json "$name/summary.json" energy)" "$drift"
}

# A wall of points, on a face and at three places within a cell, and a rigid side. Measured, four cells and the first: 0.0011 and 0.014, 0.0036 and 0.009,
# 0.0092 and 0.029, 0.0075 and 0.028, 0.0011 and 0.003; 0.0075 and 0.013; drift 1.6e-4, 3.6e-4. With one velocity for gas and wall: 0.16 and 0.75,
# with volumes by the divergence alone 0.085 at the rigid side, and without the losses as heat 0.022 of drift there.
wall=(--set 'bodies.wall.shape={box: {lower: 1.5, upper: 1.62}}')
reflected face 1.5 0.002 0.025 3e-4 "${wall[@]}"
for place in 1.5013 1.5037 1.5062 1.5088; do
    reflected "at-$place" "$place" 0.017 0.05 3e-4 --set "bodies.wall.shape={box: {lower: $place, upper: 1.62}}"
done
reflected rigid 1.5 0.013 0.025 6e-4 --set bodies.wall=null --set 'domain={dim: 1, lower: 0, upper: 1.5, cell: 0.01}'

# Affine transfers along a line (moments of momentum were looked for there, and ended the run).
expect 0 "$FLOE" run "${tube[@]}" -o affine --set bodies.driven.shape='{box: {lower: 0.7, upper: 1.5}}' --set output.probes=null \
    --set bodies.wall=null --set method.transfer=apic --set 'time.end=0.05 ms'

# A charge in a closed box: (gamma - 1) E/V is 641.2 kPa, of which 2 are motion still. Measured: 0.044, drift 0.029 (0.39 and 0.34 before).
box=("$FLOE_SOURCE/inputs/defaults/e2_charge_in_box.yaml" --coupling mpm --quiet)
expect 0 "$FLOE" run "${box[@]}" -o box
below "$(off "$(mean box/history.csv 5e-3 1e-2 pressure_air)" 641200)" 0.06
below "$(json box/summary.json energy)" 0.045

# Sound that meets a bar of a thousandth of its density: twice the velocity behind it. Measured: 0.0136 (1.03 where areas shared the closing).
light=("$FLOE_SOURCE/inputs/extreme/impedance.yaml" --coupling mpm --quiet --set materials.plate.density=1.4e-3 --set verify.reference.bar_impact.right_density=1.4e-3
    --set verify.reference.bar_impact.right_modulus=1.4e-3 --set 'materials.plate.law.linear_elastic={bulk_modulus: 8.4e-4, shear_modulus: 4.2e-4}')
expect 0 "$FLOE" run "${light[@]}" -o light
below "$(json light/summary.json hend_right_velocity)" 0.027

# Viscous fluid between plates of which one moves, their faces within cells, at a Reynolds number of 10: mu U/d on each, 4 N. Measured: 0.0048 and
# 0.0049 at 0.23, 0.016 and 0.0072 at 0.27 (with velocities in proportion to areas 0.06 at 0.23, and 12 where sound has 60 m/s: fluid that swung up).
cat >plates.yaml <<'EOF'
floe: 1
coupling: mpm
constants: {base: 0.23}
reference_pressure: 1 bar
domain: {dim: 2, lower: [0, 0], upper: [0.4, 1.4], cell: 0.1}
boundaries: {x: periodic, y: symmetry}
materials:
  oil: {eos: {acoustic: {density: 100, sound_speed: 20, pressure: 1 bar}}, viscosity: {shear: 10}}
  low: {density: 7800, law: {linear_elastic: {bulk_modulus: 160 GPa, shear_modulus: 80 GPa}}}
  top: {density: 7800, law: {linear_elastic: {bulk_modulus: 160 GPa, shear_modulus: 80 GPa}}}
ambient: {material: oil, pressure: 1 bar, temperature: 300}
bodies:
  low: {material: low, shape: {box: {lower: [0, 0], upper: [0.4, base]}}, motion: fixed}
  top: {material: top, shape: {box: {lower: [0, 1 + base], upper: [0.4, 1.4]}}, motion: {velocity: [1, 0]}}
time: {end: 6}
method: {transfer: apic}
output: {interval: 6, history_interval: 0.02}
EOF
for base in 0.23 0.27; do
    expect 0 "$FLOE" run plates.yaml -o plates --quiet --set constants.base=$base
    below "$(off "$(mean plates/history.csv 5 6 force_top_x)" -4)" 0.03
    below "$(off "$(mean plates/history.csv 5 6 force_low_x)" 4)" 0.015
    rm -r plates
done
expect 0 "$FLOE" check plates.yaml
has stderr "warning: plates.yaml:$(grep -n '^  oil:' plates.yaml | cut -d: -f1):76: materials.oil.viscosity: in 'mpm' walls drag fluid by more"

# Gas and solid that do not meet.
expect 0 "$FLOE" run "${tube[@]}" -o apart --set bodies.driven.shape='{box: {lower: 0.7, upper: 1.4}}' --set output.probes=null \
    --set bodies.wall.shape='{box: {lower: 1.55, upper: 1.62}}' --set 'ambient.points=0' --set 'time.end=0.05 ms'

# The same bits for any threads and blocks, and from a checkpoint on.
short=("${box[@]}" --set 'time.end=1 ms' --set 'output.interval=1 ms')
expect 0 "$FLOE" run "${short[@]}" -o one --threads 1
expect 0 "$FLOE" run "${short[@]}" -o many --threads 3
same_results one many
expect 0 "$FLOE" run "${short[@]}" -o blocks --set domain.blocks=2
cmp one/history.csv blocks/history.csv || fault 'other bits in blocks'
expect 5 "$FLOE" run "${short[@]}" -o part --max-wall 0.05
expect 0 "$FLOE" run "${short[@]}" -o part --resume
same_results one part
