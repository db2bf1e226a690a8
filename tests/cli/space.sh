#!/usr/bin/env bash
# Sharp surfaces in space: gases at rest stay so about any body, and apart; a charge in a hollow ball has its pressure in the first cell beside the wall; a
# strip gives what a line does; Lame's sphere under the gas in it. Bits do not hang on threads, blocks or a restart.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

shell=$FLOE_SOURCE/tests/cli/decks/space.yaml

# last FILE COLUMN: of a column of history.csv.
last() {
    awk -F, -v name="$2" 'NR == 1 { for (i = 1; i <= NF; i++) { split($i, word, " "); if (word[1] == name) c = i }; next } { v = $c } END { print v }' "$1"
}
# mean FILE COLUMN FROM: of a column of history.csv from a time on.
mean() {
    awk -F, -v name="$2" -v from="$3" 'NR == 1 { for (i = 1; i <= NF; i++) { split($i, word, " "); if (word[1] == name) c = i }; next }
        $1 >= from { sum += $c; n++ } END { if (n > 0) printf "%.9g", sum / n }' "$1"
}
# near VALUE EXPECTED SHARE: within a share of it.
near() {
    awk -v a="$1" -v b="$2" -v e="$3" 'BEGIN { d = a / b - 1; exit !(a ~ /^[-+0-9.eE]+$/ && d <= e && d >= -e) }' ||
        fault "'$1' is not within $3 of $2"
}

# At rest: a tenth of a joule would be 1e-3 of the speed of sound. One rod lies at an angle, one post stands on a side under another gas's end.
expect 0 "$FLOE" run "$shell" -o rest --quiet --set time.end=4e-4 --set output.interval=4e-4
[ "$(json rest/summary.json interface)" = 'auto: sharp' ] || fault 'a hollow ball is not sharp'
below "$(last rest/history.csv kinetic)" 1e-20
below "$(json rest/summary.json mass)" 1e-13
for body in 'cylinder: {start: [0.3, 0.35, 0.25], end: [0.7, 0.62, 0.72], radius: 0.18}' 'cylinder: {start: [0.52, 0.43, -0.2], end: [0.52, 0.43, 0.53], radius: 0.27}' \
    'box: {lower: [0.3, 0.2, 0.4], upper: [0.6, 0.8, 0.7]}' 'box: {lower: [0.313, -1, 0.42], upper: [0.55, 2, 0.731]}'; do
    expect 0 "$FLOE" run "$shell" -o still --quiet --set time.max_steps=6 --set domain.cell=0.125 --set bodies.inside=null --set materials.argon=null --set "bodies.shell.shape={$body}"
    [ "$(json still/summary.json interface)" = 'auto: sharp' ] || fault "$body is not sharp"
    below "$(last still/history.csv kinetic)" 1e-20
done

# A charge: 1 bar and 4 more in (15/27)^3 of the ball. Gas outside hears nothing of it.
charge=(--set materials.argon=null --set time.end=2.5e-3 --set output.interval=2.5e-3
    --set 'bodies.inside={material: air, shape: {ball: {centre: [0.5, 0.5, 0.5], radius: 0.15}}, pressure: 5 bar, temperature: 300 K}')
expect 0 "$FLOE" run "$shell" -o charge --quiet "${charge[@]}"
# Over a wave to and fro: 1.1 % less and 2.4 % more, measured.
near "$(mean charge/history.csv wall_pressure 1e-3)" 168587 0.02
near "$(mean charge/history.csv middle_pressure 1e-3)" 168587 0.045
below "$(json charge/summary.json mass)" 1e-13
below "$(json charge/summary.json energy)" 1e-7

# Bits.
expect 0 "$FLOE" run "$shell" -o blocks --quiet "${charge[@]}" --threads=2 --set time.end=4e-4 --set output.interval=4e-4 --set 'domain.blocks=[2, 1, 2]'
expect 0 "$FLOE" run "$shell" -o whole --quiet "${charge[@]}" --threads=1 --set time.end=4e-4 --set output.interval=4e-4
cmp blocks/history.csv whole/history.csv || fault 'bits hang on blocks or threads'

# A strip is a line: one step for both, and substeps of the solid that are as many.
strip() {
    cat <<END
floe: 1
title: Shock on a wall
source: line
coupling: ice-mpm
runs_as: [ice-mpm]
reference_pressure: 1 bar
domain: {dim: $1, lower: $2, upper: $3, cell: 0.1 m}
boundaries: slip
materials:
  air: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5 J/kg/K}}}
  steel: {density: 7850 kg/m^3, specific_heat: 460 J/kg/K, law: {linear_elastic: {bulk_modulus: 16 GPa, shear_modulus: 8 GPa}}}
ambient: {material: air, pressure: 1 bar, temperature: 300 K}
bodies:
  wall: {material: steel, shape: {box: {lower: $4, upper: $3}}}
  driver: {material: air, shape: {box: {lower: $2, upper: $5}}, pressure: 10 bar, temperature: 300 K}
time: {end: 2 ms, fixed_step: 2e-5 s, substeps: 4}
output: {interval: 2 ms, probes: {wall: $6, middle: $7}}
END
}
strip 1 0 1.6 1.23 0.5 1.15 0.75 >line.yaml
strip 3 '[0, 0, 0]' '[1.6, 0.3, 0.3]' '[1.23, 0, 0]' '[0.5, 0.3, 0.3]' '[1.15, 0.15, 0.15]' '[0.75, 0.15, 0.15]' >strip.yaml
for deck in line strip; do expect 0 "$FLOE" run $deck.yaml -o $deck --quiet; done
near "$(last strip/history.csv wall_pressure)" "$(last line/history.csv wall_pressure)" 5e-5
near "$(last strip/history.csv middle_pressure)" "$(last line/history.csv middle_pressure)" 2e-6

# Lame's sphere, five cells of wall, at rest under the gas in it: 1.40 % and 0.50 % (1.58 and 0.62 under exact tractions on the same points).
cat >lame.yaml <<'END'
floe: 1
title: Thick sphere under gas
source: Lame 1852
coupling: ice-mpm
runs_as: [ice-mpm]
reference_pressure: 101325 Pa
domain: {dim: 3, lower: [0, 0, 0], upper: [1.2, 1.2, 1.2], cell: 0.1 m}
boundaries:
  x: {lower: symmetry, upper: {outlet: {pressure: 101325 Pa, temperature: 300 K}}}
  y: {lower: symmetry, upper: {outlet: {pressure: 101325 Pa, temperature: 300 K}}}
  z: {lower: symmetry, upper: {outlet: {pressure: 101325 Pa, temperature: 300 K}}}
materials:
  steel: {density: 8900 kg/m^3, specific_heat: 460 J/kg/K, law: {linear_elastic: {bulk_modulus: 117 GPa, shear_modulus: 43.8 GPa}}}
  gas: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5 J/kg/K}}}
ambient: {material: gas, pressure: 101325 Pa, temperature: 300 K}
bodies:
  shell: {material: steel, shape: {annulus: {centre: [0, 0, 0], inner_radius: 0.5, outer_radius: 1.0}}}
  bore: {material: gas, shape: {ball: {centre: [0, 0, 0], radius: 0.5}}, pressure: 101325 Pa, temperature: 300 K}
loads:
  heating: {pressurise: {material: gas, region: {ball: {radius: 0.75}}, target: 19.4 MPa, ramp: 1.4 ms, hold: true}}
time: {end: 10 ms, solver: static}
output: {interval: 10 ms}
verify:
  exact:
    lame_sphere: {inner_radius: 0.5, outer_radius: 1.0, inner_pressure: 19.4 MPa, bulk_modulus: 117 GPa, shear_modulus: 43.8 GPa}
  body: shell
  pressure: 19.4 MPa
  metrics: [l1rel_sigma_r, l1rel_sigma_theta]
END
expect 0 "$FLOE" run lame.yaml -o lame --quiet
[ "$(json lame/summary.json interface)" = 'auto: sharp' ] || fault 'a sphere between mirrors is not sharp'
below "$(json lame/summary.json l1rel_sigma_r)" 2.1e-2
below "$(json lame/summary.json l1rel_sigma_theta)" 7.5e-3

# A box of six plates that touch is one surface, which leaves the exact room to the gas, whether its planes are those of the mesh or not: 1 bar and 300 K.
# Gas that presses from within stays in, its energy to 9e-7 in the first eight steps.
cat >plates.yaml <<'END'
floe: 1
coupling: ice-mpm
reference_pressure: 1 bar
domain: {dim: 3, lower: [0, 0, 0], upper: [1, 1, 1], cell: 0.1}
boundaries: {x: symmetry, y: symmetry, z: symmetry}
parameters: {a: 0.1, b: 0.9}
materials:
  steel: {density: 7850, specific_heat: 460, law: {linear_elastic: {bulk_modulus: 160 GPa, shear_modulus: 80 GPa}}}
  air: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}
ambient: {material: air, pressure: 1 bar, temperature: 300 K}
bodies:
  left: {material: steel, shape: {box: {lower: [0, 0, 0], upper: [$a, 1, 1]}}}
  right: {material: steel, shape: {box: {lower: [$b, 0, 0], upper: [1, 1, 1]}}}
  bottom: {material: steel, shape: {box: {lower: [$a, 0, 0], upper: [$b, $a, 1]}}}
  top: {material: steel, shape: {box: {lower: [$a, $b, 0], upper: [$b, 1, 1]}}}
  back: {material: steel, shape: {box: {lower: [$a, $a, 0], upper: [$b, $b, $a]}}}
  front: {material: steel, shape: {box: {lower: [$a, $a, $b], upper: [$b, $b, 1]}}}
time: {end: 1 ms, max_steps: 8}
output: {interval: 1 ms, history_interval: 1 ms}
END
for place in '0.1 0.9' '0.134 0.871'; do
    sed -e "s/\$a/${place% *}/g; s/\$b/${place#* }/g" -e '/^parameters/d' plates.yaml >six.yaml
    expect 0 "$FLOE" run six.yaml -o six --quiet
    [ "$(json six/summary.json interface)" = 'auto: sharp' ] || fault "six plates at $place are not sharp"
    near "$(last six/history.csv mass_air)" "$(awk -v a="${place% *}" -v b="${place#* }" 'BEGIN { printf "%.12g", 1e5 / (287 * 300) * (b - a)^3 }')" 1e-8
    head -1 six/history.csv | grep -q 'force_' && fault 'the force on six plates is shown as that on one'
    rm -r six
done
expect 0 "$FLOE" run six.yaml -o charge_in_six --quiet --set 'ambient.pressure=20 bar'
below "$(json charge_in_six/summary.json mass)" 1e-13
below "$(json charge_in_six/summary.json energy)" 1.9e-6

# A plate within a cell is told of, with its place.
expect 0 "$FLOE" check "$shell" --set bodies.inside=null --set materials.argon=null --set 'bodies.shell.shape={box: {lower: [0.313, 0.2, 0.2], upper: [0.371, 0.8, 0.8]}}'
has stderr 'thinner than a cell'
