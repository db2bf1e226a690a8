#!/usr/bin/env bash
# method.interface: auto takes sharp where it can and else says why not, in check, plan, run and results alike; smeared is warned of; what
# sharp cannot do is refused where a deck asks for it. And what auto gives of E1 and E2 of the defaults' rows: the pressure beside walls.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

tube=$FLOE_SOURCE/inputs/defaults/e1_shock_tube.yaml
box=$FLOE_SOURCE/inputs/defaults/e2_charge_in_box.yaml
coarse=(--set domain.cell=0.02 --set 'domain.upper=[1.62, 0.04]')

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

# ---- what is taken ----

expect 0 "$FLOE" check "$tube"
[ ! -s stderr ] || fault 'a sharp interface is warned of'
expect 0 "$FLOE" plan "$tube" "${coarse[@]}"
has stdout 'interface: auto: sharp'

# not_sharp WHY SETTING...: auto takes smeared and says why; an explicit sharp is refused. SETTING '-' first: it is not.
not_sharp() {
    local why=$1 status=2 set=() setting
    shift
    [ "$1" != - ] || { status=0 && shift; }
    for setting in "$@"; do set+=(--set "$setting"); done
    expect 0 "$FLOE" check "$tube" "${coarse[@]}" "${set[@]}"
    has stderr 'method.interface: smeared, as '
    has stderr "$why"
    expect "$status" "$FLOE" check "$tube" "${coarse[@]}" "${set[@]}" --set method.interface=sharp
    [ "$status" = 0 ] || has stderr "$why"
    expect 0 "$FLOE" check "$tube" "${coarse[@]}" "${set[@]}" --set method.interface=smeared
    has stderr 'method.interface: smeared, as the deck asks'
}
line=('domain={dim: 1, lower: 0, upper: 1.62, cell: 0.02}' 'boundaries={x: symmetry}' 'bodies.driver.shape.box={lower: 0, upper: 0.7}'
    'bodies.driven.shape.box={lower: 0.7, upper: 1.5}' 'bodies.wall.shape.box={lower: 1.5, upper: 1.62}' 'output.probes=null')
column=('domain={dim: 3, lower: [0, 0, 0], upper: [1.62, 0.02, 0.02], cell: 0.02}' 'boundaries.z=slip'
    'bodies.driver.shape.box={lower: [0, 0, 0], upper: [0.7, 0.02, 0.02]}' 'bodies.driven.shape.box={lower: [0.7, 0, 0], upper: [1.5, 0.02, 0.02]}'
    'bodies.wall.shape.box={lower: [1.5, 0, 0], upper: [1.62, 0.02, 0.02]}' 'output.probes=null')
expect 0 "$FLOE" check "$tube" "${coarse[@]}" "${column[@]/#/--set=}"
[ ! -s stderr ] || fault 'a sharp interface in space is warned of'
expect 0 "$FLOE" check "$tube" "${line[@]/#/--set=}"
[ ! -s stderr ] || fault 'a sharp interface on a line is warned of'
not_sharp 'thinner than a cell at 1.503' "${line[@]}" 'bodies.wall.shape={box: {lower: 1.503, upper: 1.512}}'
not_sharp 'thinner than a cell at 1.501' "${line[@]}" 'bodies.wall.shape={box: {lower: 1.501, upper: 1.502}}' # no place where it is looked for is in it
not_sharp 'thinner than a cell at 1.51' "${line[@]}" 'bodies.wall.shape={box: {lower: 1.51, upper: 1.525}}' # in two cells
not_sharp 'no solid has a surface' "${line[@]}" 'bodies.wall.shape={box: {lower: 0, upper: 1.62}}' bodies.driver=null bodies.driven=null
# Several fluids, which nothing keeps apart.
for body in driver driven; do
    expect 0 "$FLOE" check "$tube" --set 'materials.other={eos: {ideal: {gamma: 1.3, specific_heat: 900}}}' --set "bodies.$body.material=other"
    ! grep -q smeared stderr || fault 'two gases beside a wall are smeared'
done
expect 0 "$FLOE" check "$tube" --set bodies.driver.material=other --set materials.air.conductivity=0.03 \
    --set 'materials.other={eos: {ideal: {gamma: 1.3, specific_heat: 900}}, viscosity: {shear: 1e-5}, conductivity: 0.02}'
! grep -q smeared stderr || fault 'fluids that are viscous and conduct are smeared'
two=(--set bodies.driver.material=other --set 'materials.other={eos: {ideal: {gamma: 1.3, specific_heat: 900}}}')
expect 0 "$FLOE" check "$tube" "${two[@]}" --set 'runs_as=[ice-mpm]' --set compare=null --set 'exchange={pair: {between: [other, air], tangential: free}}' \
    --set 'reactions={burn: {reactant: other, product: air, rate: {threshold: {temperature: 900, time: 1e-3}}, heat: 1e5}}'
! grep -q smeared stderr || fault 'fluids that slip and react beside a sharp interface are smeared'
expect 0 "$FLOE" check "$FLOE_SOURCE/inputs/burning_block.yaml"
has stderr 'the surface of a solid that burns does not recede'
expect 0 "$FLOE" check "$tube" --set 'loads={fall: {gravity: {acceleration: [0, -10]}}}'
[ ! -s stderr ] || fault 'gravity beside a sharp interface is warned of'
expect 0 "$FLOE" check "$tube" --set method.pressure=implicit
! grep -q smeared stderr || fault 'the implicit pressure is smeared'
not_sharp 'solids that deform with basis quadratic or cubic' method.pressure=implicit method.basis=linear
not_sharp 'the pressure is' method.pressure=auto
not_sharp 'has no exchange over cells' method.exchange=1e7
not_sharp 'has no exchange over cells' 'exchange={pair: {between: [air, steel], momentum: free}}'
not_sharp 'thinner than a cell' 'bodies.wall.shape={box: {lower: [1.503, 0], upper: [1.512, 0.04]}}'


# A block in water under air: sharp, with the explicit and the implicit pressure. Smeared, as with `auto`, what does not deform is wrong in a liquid: free, it was
# thrown out of the water; held, the water did not rest.
cat > afloat.yaml <<'DECK'
floe: 1
coupling: ice-mpm
domain: {dim: 2, lower: [0, 0], upper: [1.2, 1], cell: 0.05}
boundaries: {x: slip, y: slip}
materials:
  water: {eos: {acoustic: {density: 1000, sound_speed: 1500, pressure: 1e5, specific_heat: 4186}}}
  air: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}
  wood: {density: 300, specific_heat: 1000, law: {linear_elastic: {bulk_modulus: 1e9, shear_modulus: 5e8}}}
ambient: {material: air, pressure: 1e5, temperature: 300}
reference_pressure: 1e5
bodies:
  block: {material: wood, motion: rigid, shape: {box: {lower: [0.41, 0.44], upper: [0.81, 0.64]}}}
  water: {material: water, pressure: 1e5, temperature: 300, shape: {box: {lower: [0, 0], upper: [1.2, 0.5]}}}
loads: {weight: {gravity: {acceleration: [0, -9.81]}}}
time: {end: 1}
DECK
expect 0 "$FLOE" check afloat.yaml
[ ! -s stderr ] || fault 'a block afloat is warned of'
for motion in rigid fixed; do
    expect 0 "$FLOE" check afloat.yaml --set method.pressure=implicit --set bodies.block.motion=$motion
    [ ! -s stderr ] || fault "a block in water under air, $motion, is warned of with the implicit pressure"
done
smeared=(--set method.pressure=auto)
expect 2 "$FLOE" check afloat.yaml "${smeared[@]}"
has stderr 'a liquid swings up about a rigid body'
expect 0 "$FLOE" check afloat.yaml "${smeared[@]}" --set bodies.block.motion=fixed
has stderr 'does not stay at rest under gravity'
expect 0 "$FLOE" check afloat.yaml "${smeared[@]}" --set bodies.block.motion=null
! grep -q 'stay at rest' stderr || fault 'a block that deforms is warned of as one that does not'
expect 0 "$FLOE" check afloat.yaml "${smeared[@]}" --set bodies.water=null --set ambient.temperature=290
! grep -q 'swings up' stderr || fault 'a body in gas is refused as one in a liquid'

# ---- a run, its results, and its end ----

expect 0 "$FLOE" run "$tube" "${coarse[@]}" -o whole --quiet
has whole/deck.yaml 'interface: sharp'
[ "$(json whole/summary.json interface)" = 'auto: sharp' ] || fault 'the summary does not say which was taken'
expect 0 "$FLOE" run whole/deck.yaml -o again --quiet
cmp whole/history.csv again/history.csv || fault 'another history from the resolved deck'
# E1: the pressure behind the shock that came back, in both cells before the wall; 8 cells of 20 mm are behind it at 1.7 ms.
near "$(mean whole/history.csv first_pressure 1.7e-3)" 701247 0.01
near "$(mean whole/history.csv second_pressure 1.7e-3)" 701247 0.01
# One wall at another offset within a cell.
expect 0 "$FLOE" run "$tube" "${coarse[@]}" -o offset --quiet --set 'bodies.wall.shape={box: {lower: [1.507, 0], upper: [1.62, 0.04]}}' \
    --set 'bodies.driven.shape={box: {lower: [0.7, 0], upper: [1.507, 0.04]}}'
near "$(mean offset/history.csv first_pressure 1.75e-3)" 701247 0.01

# The same on a line, the wall on a node and within a cell.
for wall in 1.5 1.507; do
    expect 0 "$FLOE" run "$tube" "${line[@]/#/--set=}" -o line --quiet --set "bodies.wall.shape.box.lower=$wall" \
        --set "bodies.driven.shape.box.upper=$wall" --set 'output.probes={first: 1.49, second: 1.47}'
    [ "$(json line/summary.json interface)" = 'auto: sharp' ] || fault 'a line is not sharp'
    near "$(mean line/history.csv first_pressure 1.75e-3)" 701247 0.01
    near "$(mean line/history.csv second_pressure 1.75e-3)" 701247 0.01
done

# E2: what the charge brings is in the box, and beside its walls: (E0 - kinetic - work) (gamma - 1)/V.
expect 0 "$FLOE" run "$box" -o box --quiet
[ "$(json box/summary.json interface)" = 'auto: sharp' ] || fault 'a box of points is not sharp'
room=$(awk -v k="$(mean box/history.csv kinetic_air 5e-3)" -v w="$(mean box/history.csv kinetic_steel 5e-3)" \
    -v s="$(mean box/history.csv strain_steel 5e-3)" \
    'BEGIN { c = 3.14159265358979 * 0.15 ^ 2; print 0.4 * ((50e5 * c + 1e5 * (0.64 - c)) / 0.4 - k - w - s) / 0.64 }')
near "$(mean box/history.csv pressure_air 5e-3)" "$room" 0.005
near "$(mean box/history.csv middle_pressure 5e-3)" "$room" 0.02
# (Waves that still run keep the corner 4.3 % above the mean, at 0.0125 m.)
near "$(mean box/history.csv corner_pressure 5e-3)" "$(awk -v p="$room" 'BEGIN { print 1.03 * p }')" 0.02
below "$(json box/summary.json energy)" 1e-3

# Bodies that touch along oblique lines: slivers that open between them hold no gas, and end no run (41 steps measured).
expect 0 "$FLOE" run "$FLOE_SOURCE/tests/cli/decks/pocket.yaml" -o pocket --quiet
[ "$(json pocket/summary.json interface)" = 'auto: sharp' ] || fault 'bodies that touch are not sharp'

# A flag that yields to the cylinder that holds it, both of one material: the shapes are asked for as they are filled.
sed -e 's/^  body:$/  flag:/' -e '/^supports:/d' -e '/^  cylinder: {region/d' -e 's/body: body,/body: flag,/' \
    -e 's/^bodies:$/bodies:\n  cylinder: {material: rubber, motion: fixed, shape: {ball: {centre: [0.2, 0.2], radius: 0.05}}}/' \
    -e 's/^    shape: {union.*$/    yields: true\n    shape: {box: {lower: [0.2, 0.19], upper: [0.6, 0.21]}}/' \
    "$FLOE_SOURCE/inputs/turek_hron_fsi.yaml" >flag.yaml
expect 0 "$FLOE" plan flag.yaml
has stdout 'interface: auto: sharp'
below "$(json pocket/summary.json steps)" 80
below "$(json pocket/summary.json mass)" 1e-12
below "$(json pocket/summary.json energy)" 4e-6

# A stream of Mach 3 stops at the foot of a step of points: Rayleigh's 12.06 of its pressure; measured 11.57 in the first cell, whose mean has some
# velocity left, steady from t = 2.
expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/defaults/forward_step.yaml" -o step --quiet --set time.end=3 --set output.interval=3
near "$(mean step/history.csv foot_pressure 2)" 12.061 0.06
near "$(mean step/history.csv foot_pressure 2.5)" "$(mean step/history.csv foot_pressure 2)" 0.005
below "$(json step/summary.json energy)" 1e-6

# A body that leaves its side has gas beneath it and goes on; the vacuum there would have stopped it after 13 ms.
expect 0 "$FLOE" run "$FLOE_SOURCE/tests/cli/decks/lift.yaml" -o lift --quiet --set time.end=0.06
near "$(mean lift/history.csv velocity_block_y 0.03)" 1 0.002

# What sharp cannot go on with ends the run, and the remedy is named: a body that leaves the corner of two sides, and one that comes to a side.
expect 3 "$FLOE" run "$FLOE_SOURCE/tests/cli/decks/lift.yaml" -o corner --quiet --set 'bodies.block.shape.box={lower: [0, 0], upper: [0.2, 0.3]}'
has stderr 'has left the side of the domain'
has stderr 'leave a tenth of a cell between them'
expect 3 "$FLOE" run "$FLOE_SOURCE/inputs/extreme/leaving.yaml" --coupling ice-mpm -o leaving --quiet --set method.interface=sharp --set 'bodies.block.velocity=[0.6, 0]'
has stderr 'use method.interface: smeared'
leaving=("$FLOE_SOURCE/inputs/extreme/leaving.yaml" --coupling ice-mpm --set study=null)
expect 0 "$FLOE" check "${leaving[@]}" --set method.interface=sharp
has stderr "body 'block' comes to this side at t = 0.417 if nothing stops it"
expect 0 "$FLOE" check "${leaving[@]}" --set method.interface=auto
has stderr "smeared, as bodies.block.velocity: body 'block' comes to boundaries.x.upper"
expect 0 "$FLOE" run "${leaving[@]}" --set method.interface=auto --quiet -o left
expect 0 "$FLOE" plan "${leaving[@]}" --set method.interface=auto --set 'bodies.block.velocity=[-0.3, 0]'
has stdout 'interface: auto: sharp'

# ---- the papers' choices under one name ----

expect 0 "$FLOE" run "$tube" "${coarse[@]}" -o paper --quiet --set method=g03 --set time.max_steps=2
for choice in 'basis: linear' 'stress: usf' 'interface: smeared' 'energy: internal' 'exchange: locked'; do has paper/deck.yaml "$choice"; done
expect 0 "$FLOE" run "$tube" "${coarse[@]}" -o other --quiet --set method=g03 --set method.basis=gimp --set time.max_steps=2
has other/deck.yaml 'basis: gimp'
has other/deck.yaml 'stress: usf'
expect 0 "$FLOE" run paper/deck.yaml -o papers --quiet
cmp paper/history.csv papers/history.csv || fault 'another history from the resolved deck of g03'
cmp paper/deck.yaml papers/deck.yaml || fault 'the resolved deck of g03 resolves to another'
has other/deck.yaml 'exchange: locked'
expect 0 "$FLOE" run "$tube" "${coarse[@]}" -o loose --quiet --set 'method={preset: g03, exchange: 2e7 kg/m^3/s}' --set time.max_steps=1
has loose/deck.yaml 'exchange: 20000000'
# Points are locked: the preset is heeded as mpm, and beside a sharp interface, which the deck may ask for, it says nothing of exchange.
expect 0 "$FLOE" check "$tube" --coupling mpm --set method=g03
expect 2 "$FLOE" check "$tube" --coupling mpm --set method.exchange=1e7
expect 0 "$FLOE" check "$tube" --set 'method={preset: g03, interface: sharp}'
not_sharp 'has no exchange over cells' method.exchange=locked
expect 0 "$FLOE" check "$tube" --set method.exchange=locked
if grep -q 'energy from nowhere' stderr; then fault 'a locked exchange is warned of as a constant'; fi
expect 0 "$FLOE" check "$tube" --set method.exchange=1e5
has stderr 'energy from nowhere'
expect 2 "$FLOE" check "$tube" --set method.exchange=free
has stderr 'a number from 0 to 1e+20, or locked'

# Water that streams along steel keeps its kinetic energy but where it is locked: it loses 0.07 % as it starts beside a smeared wall, and 17 % where it sticks.
stream=$FLOE_SOURCE/tests/cli/decks/stream.yaml
slides() {
    expect 0 "$FLOE" run "$stream" -o stream --quiet --set method.interface=smeared "$@"
    awk -v a="$(mean stream/history.csv kinetic_water 1.9e-4)" 'BEGIN { exit !(a > 0.99 * 2.3565) }'
}
slides || fault 'an inviscid liquid sticks to a wall'
! slides --set method.exchange=locked || fault 'a locked liquid slips'
! slides --set method=g03 || fault 'a liquid slips as the papers have it'
expect 2 "$FLOE" check "$tube" --set method=g04
has stderr "'g04' is no 'preset' of 'method'"

# ---- periodic sides ----

# A blast beside a ball that is held, moved by whole cells until the ball is a tenth of a cell from the side, around both sides: the same to round-off. A plate
# that reaches around goes as one between symmetries does.
cat >around.yaml <<'EOF'
floe: 1
title: Blast beside a ball between periodic sides
coupling: ice-mpm
units: none
reference_pressure: 1
constants: {s: 0}
domain: {dim: 2, lower: [0, 0], upper: [1, 1], cell: 0.025}
boundaries: {x: periodic, y: periodic}
materials:
  air: {eos: {ideal: {gamma: 1.4, specific_heat: 2.5}}, viscosity: {shear: 0.002}}
  steel: {density: 10, specific_heat: 1, law: {linear_elastic: {bulk_modulus: 1000, shear_modulus: 500}}}
ambient: {material: air, pressure: 1, temperature: 1}
bodies:
  charge: {material: air, shape: {ball: {centre: [0.26 + s, 0.3], radius: 0.1}}, pressure: 5, temperature: 2}
  ball: {material: steel, motion: fixed, shape: {ball: {centre: [0.5 + s, 0.45], radius: 0.13}}}
time: {end: 0.2}
output: {interval: 0.2}
EOF
for pressure in explicit implicit; do
    expect 0 "$FLOE" run around.yaml -o here --quiet --set method.pressure=$pressure
    expect 0 "$FLOE" run around.yaml -o there --quiet --set method.pressure=$pressure --set constants.s='14 * 0.025'
    has here/summary.json '"interface": "auto: sharp"'
    for column in kinetic_air internal_air pressure_air force_ball_y; do
        near "$(mean there/history.csv $column 0.1)" "$(mean here/history.csv $column 0.1)" 1e-9
    done
done
# A box whose last cells are open by a twentieth: they are merged with those beyond the side, and its corners shade those.
box=(--set 'bodies.ball.shape={box: {lower: [0.361 + s, 0.338], upper: [0.6237 + s, 0.5613]}}')
expect 0 "$FLOE" run around.yaml -o here --quiet "${box[@]}"
expect 0 "$FLOE" run around.yaml -o there --quiet "${box[@]}" --set constants.s='15 * 0.025'
for column in kinetic_air internal_air pressure_air force_ball_y; do
    near "$(mean there/history.csv $column 0.1)" "$(mean here/history.csv $column 0.1)" 1e-9
done
# A block that ends on one of the sides, and what is left of a shape by whose name another body goes on: the surface lies on the side, or ends on it.
expect 0 "$FLOE" run around.yaml -o beside --quiet --set 'bodies.ball.shape={box: {lower: [0, 0.338], upper: [0.25, 0.561]}}' --set bodies.charge.shape.ball.centre='[0.6, 0.3]'
expect 0 "$FLOE" run around.yaml -o apart --quiet --set 'bodies.ball.shape={box: {lower: [0.2, 0.338], upper: [0.45, 0.561]}}' --set bodies.charge.shape.ball.centre='[0.8, 0.3]'
near "$(mean beside/history.csv force_ball_x 0.1)" "$(mean apart/history.csv force_ball_x 0.1)" 1e-2
# Bodies that move go around as well, whole or in part at the start, and so does the charge: one that is pushed, in viscous gas, an elastic one (whose
# motion magnifies round-off), and an elastic cylinder across the whole of a third axis.
moves() # NAME SHIFT ARG...: a run with the bodies moved by so many cells
{
    expect 0 "$FLOE" run "$deck" -o "$1" --quiet --set constants.s="$2" "${@:3}"
    has "$1/summary.json" '"interface": "auto: sharp"'
}
deck=around.yaml
pushed=(--set 'bodies.ball.motion={velocity: [0.513, 0.0971]}' --set 'bodies.ball.shape.ball.centre=[0.5041 + s, 0.4537]' --set time.end=0.6 --set output.interval=0.6)
moves here 0 "${pushed[@]}"
for cells in 14 20; do
    moves there "$cells * 0.025" "${pushed[@]}"
    for column in kinetic_air internal_air pressure_air force_ball_x force_ball_y; do
        near "$(mean there/history.csv $column 0.3)" "$(mean here/history.csv $column 0.3)" 1e-9
    done
done
elastic=("${pushed[@]}" --set materials.steel.density=2 --set 'bodies.ball={material: steel, velocity: [0.513, 0.0971], shape: {ball: {centre: [0.5041 + s, 0.4537], radius: 0.13}}}')
moves here 0 "${elastic[@]}"
moves there '20 * 0.025' "${elastic[@]}"
for column in kinetic_air kinetic_steel velocity_ball_x velocity_ball_y; do
    near "$(mean there/history.csv $column 0.3)" "$(mean here/history.csv $column 0.3)" 1e-5
done
sed -e 's/dim: 2, lower: \[0, 0\], upper: \[1, 1\], cell: 0.025/dim: 3, lower: [0, 0, 0], upper: [1, 0.4, 0.6], cell: 0.1/' -e 's/y: periodic}/y: periodic, z: slip}/' \
    -e 's/centre: \[0.26 + s, 0.3\]/centre: [0.26 + s, 0.2, 0.3]/' -e 's/\(ball: {material: steel, \).*/\1velocity: [2, 1.5, 0.1], shape: {cylinder: {start: [0.5041 + s, 0, 0.312], end: [0.5041 + s, 0.4, 0.312], radius: 0.13}}}/' \
    around.yaml >around_3d.yaml
deck=around_3d.yaml
moves here 0 --set materials.steel.density=2
moves there '3 * 0.1' --set materials.steel.density=2
for column in kinetic_air kinetic_steel velocity_ball_x velocity_ball_y; do
    near "$(mean there/history.csv $column 0.1)" "$(mean here/history.csv $column 0.1)" 1e-5
done
wall=(--set 'bodies.ball={material: steel, shape: {box: {lower: [0.513, 0], upper: [0.613, 1]}}}' --set 'boundaries.x=slip'
    --set 'bodies.charge.shape={box: {lower: [0, 0], upper: [0.2, 1]}}')
expect 0 "$FLOE" run around.yaml -o around --quiet "${wall[@]}"
has around/summary.json '"interface": "auto: sharp"'
expect 0 "$FLOE" run around.yaml -o between --quiet "${wall[@]}" --set boundaries.y=symmetry
near "$(mean around/history.csv velocity_ball_x 0.1)" "$(mean between/history.csv velocity_ball_x 0.1)" 1e-3
# Two fluids around: a block that is fixed in the surface of water, across the side and away from it (shares of cells where surfaces cross are sampled).
cat >pool.yaml <<'E'
floe: 1
title: A block in the surface of water between periodic sides
coupling: ice-mpm
units: none
reference_pressure: 1
constants: {s: 0}
domain: {dim: 2, lower: [0, 0], upper: [1, 1], cell: 0.05}
boundaries: {x: periodic, y: slip}
materials:
  air: {eos: {ideal: {gamma: 1.4, specific_heat: 2.5}}}
  water: {eos: {stiffened: {gamma: 4.4, p_inf: 100, specific_heat: 1.4852}}}
  steel: {density: 10, specific_heat: 1, law: {linear_elastic: {bulk_modulus: 1000, shear_modulus: 500}}}
ambient: {material: air, pressure: 1, temperature: 1}
loads: {g: {gravity: {acceleration: [0, -0.1]}}}
bodies:
  pool: {material: water, shape: {box: {lower: [-1, 0], upper: [2, 0.43]}}, pressure: 1, temperature: 1}
  charge: {material: air, shape: {ball: {centre: [0.26 + s, 0.75], radius: 0.1}}, pressure: 3, temperature: 2}
  block: {material: steel, motion: fixed, shape: {box: {lower: [0.463 + s, 0.33], upper: [0.737 + s, 0.52]}}}
time: {end: 0.5}
output: {interval: 0.5}
E
deck=pool.yaml
moves here 0
moves there '9 * 0.05'
near "$(mean there/history.csv force_block_y 0.1)" "$(mean here/history.csv force_block_y 0.1)" 1e-2
near "$(mean there/history.csv kinetic_air 0.1)" "$(mean here/history.csv kinetic_air 0.1)" 1e-3
# The block drifts in the surface, through the side: corners of bodies that draw fluid through faces leave no face to give more of a trace of air than its
# cell has (steps of a hundred-thousandth of the usual one, for ever, at t = 0.85).
moves drift '4 * 0.05' --set 'bodies.block={material: steel, velocity: [0.1, 0], shape: {box: {lower: [0.463 + s, 0.33], upper: [0.737 + s, 0.52]}}}' \
    --set bodies.charge.pressure=1 --set bodies.charge.temperature=1 --set time.end=1.2
steps=$(tail -1 drift/history.csv | cut -d, -f2)
[ "$steps" -lt 1000 ] || fault "a block drifts in the surface of water in $steps steps"
