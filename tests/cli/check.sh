#!/usr/bin/env bash
# floe check: good decks, and bad ones with every error at its place, status 2 and nothing written.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
decks=$FLOE_SOURCE/tests/cli/decks

for deck in "$FLOE_SOURCE"/inputs/*.yaml; do
    expect 0 "$FLOE" check "$deck"
    has stdout 'deck is valid'
    # A smeared interface is warned of wherever it is taken, and York's weight, a hundred times as heavy as the string that it is made
    # of, is as slow to sound as no metal is.
    if grep -v 'method.interface: smeared' stderr | grep -qv "the speed of sound of solid 'weight' is 9.62 m/s"; then fault "it warns of $deck"; fi
done

expect 2 "$FLOE" check "$decks/many_errors.yaml"
has stderr "many_errors.yaml:4:48: error: unknown key 'cel'"
has stderr "did you mean 'cell'?"
has stderr 'many_errors.yaml:7:'
has stderr 'many_errors.yaml:8:'
has stderr 'many_errors.yaml:10:'
has stderr 'many_errors.yaml:11:'
[ ! -s stdout ] || fault 'errors belong to standard error'

# A decimal comma in a list is two entries: the second one is told what it is.
sed 's/cell: [^}]*/cell: 0,05/' "$FLOE_SOURCE/inputs/lid_cavity.yaml" >comma.yaml
expect 2 "$FLOE" check comma.yaml
has stderr 'write decimals with a point'

# A name that a formula does not know: where names come from; the moduli of a law: how they follow from those of a table of materials.
check_refuses "$FLOE_SOURCE/inputs/sod.yaml" "constants of your own have a section in the deck, 'constants'" 'domain.cell=L / 40'
check_refuses "$FLOE_SOURCE/inputs/two_bars.yaml" 'bulk modulus K = E / (3 (1 - 2 nu))' 'materials.bar.law={linear_elastic: {youngs_modulus: 1, poissons_ratio: 0.3}}'

# A terminal gets lines of 80 columns at most, of the deck too, with the same words; a file gets each message as one line.
cp "$decks/many_errors.yaml" many.yaml
"$FLOE" check many.yaml 2>as-file || true
grep -q '.\{81\}' as-file || fault 'no message of this deck is long'
if script -qc true /dev/null </dev/null >/dev/null 2>&1; then # a sandbox may have no pseudo-terminals
    script -qc "$FLOE check many.yaml" /dev/null </dev/null | tr -d '\r' | sed 's/\x1b\[[0-9;]*m//g' >as-terminal
    if grep '.\{81\}' as-terminal; then fault 'a terminal gets lines of more than 80 columns'; fi
    [ "$(tr -s ' \n' ' ' <as-file)" = "$(tr -s ' \n' ' ' <as-terminal)" ] || fault 'a terminal gets other words'
fi

expect 2 "$FLOE" check "$decks/syntax.yaml"
has stderr 'syntax.yaml:4:'
expect 2 "$FLOE" check "$decks/impossible.yaml"
has stderr 'impossible.yaml:5:'

# What a run would refuse before its first step, check refuses too, with the place of its key.
expect 2 "$FLOE" check "$FLOE_SOURCE/inputs/membrane_sphere.yaml" --set boundaries.z.lower=free
has stderr 'bodies.skin.membrane.encloses: it is not closed'
mv stderr said-by-check
expect 2 "$FLOE" run "$FLOE_SOURCE/inputs/membrane_sphere.yaml" --set boundaries.z.lower=free -o out
cmp -s stderr said-by-check || fault 'run and check say different things'
expect 2 "$FLOE" check "$FLOE_SOURCE/inputs/shock_plate.yaml" --set time.substeps=4 --set method.interface=smeared
has stderr 'error: --set time.substeps=4: the interface is smeared'
expect 2 "$FLOE" check "$FLOE_SOURCE/inputs/sod.yaml" --set output.interval=1e-30
has stderr 'too many for a run to meet their times'
expect 0 "$FLOE" check "$FLOE_SOURCE/inputs/sod.yaml" --set domain.cell=1e-7
has stdout 'not made ready'
has stdout 'it would hold'
# More than this machine holds, and more than surfaces can be traced on: refused as a run refuses it, with the cell to take.
wall=$FLOE_SOURCE/inputs/foam_wall.yaml
check_refuses "$FLOE_SOURCE/tests/mistakes/solid.yaml" 'take a cell of' domain.cell=1e-6
has stderr 'error: --set domain.cell=1e-6: 1e-06: its 1.44e+12 cells need about'
check_refuses "$wall" 'cannot be traced' domain.cell=1e-6
has stderr 'or more'
expect 2 "$FLOE" plan "$wall" --set domain.cell=1e-6
has stderr 'cannot be traced'
check_refuses "$wall" 'not a whole number' method.interface=sharp domain.cell=0.17
has stderr '--set domain.cell=0.17: error: domain.cell: the extent'

# Cases that cannot start, and of which the deck does not say so, are warned of; null among the values takes the key away.
two=$FLOE_SOURCE/inputs/two_bars.yaml
expect 0 "$FLOE" check "$two" --set 'study={axes: {time.solver: {values: [null, dynamic, static]}}}' --set 'contact={kind: friction, friction: 0.3}'
has stderr 'warning: case static of `floe study` cannot start: --set time.solver=static: contact.friction other than 0'
has stdout 'study: 3 cases'
for more in '' ', 0.6' ', 0.6, 0.7'; do # five of them one by one
    expect 0 "$FLOE" check "$two" --set "study={axes: {time.solver: [dynamic, static], contact.friction: [0.1, 0.2, 0.3, 0.4, 0.5$more]}}" \
        --set 'contact={kind: friction, friction: 0.3}'
    [ "$(grep -c 'cannot start' stderr)" -eq 5 ] || fault "other than five cases are warned of one by one: $more"
    case $more in '') wanted='' ;; *7) wanted=2 ;; *) wanted=1 ;; esac
    [ "$(sed -nE 's/.*and ([0-9]+) more cases.*/\1/p' stderr)" = "$wanted" ] || fault "not '$wanted' more cases: $more"
done
expect 2 "$FLOE" check "$two" --set 'study.quantities=[nothing]' --set 'study.axes={domain.cell: [0.1]}'

# The same errors stop a run before anything is written.
expect 2 "$FLOE" run "$decks/many_errors.yaml" -o out
expect 2 "$FLOE" compare "$decks/many_errors.yaml" -o out
expect 2 "$FLOE" plan "$decks/many_errors.yaml"
[ ! -e out ] || fault 'a bad deck has left a folder'

expect 2 "$FLOE" check "$cylinder" --set domain.cel=0.1
has stderr "did you mean 'cell'?"
expect 2 "$FLOE" check "$cylinder" --set domain.cell
has stderr 'KEY=VALUE'
expect 2 "$FLOE" run "$cylinder" --coupling none
expect 4 "$FLOE" check nowhere.yaml
has stderr 'nowhere.yaml'

# Walls: what contradicts itself or would have no effect.
couette=$FLOE_SOURCE/inputs/couette.yaml
expect 2 "$FLOE" check "$couette" --set 'boundaries.y.lower={no_slip: {temperature: 1, heat_flux: 2}}'
has stderr 'not both'
expect 2 "$FLOE" check "$couette" --set materials.gas.conductivity=0
has stderr "give a fluid a 'conductivity'"
expect 2 "$FLOE" check "$couette" --set materials.gas.viscosity.shear=0
has stderr "give a fluid a 'viscosity'"
expect 2 "$FLOE" check "$couette" --set 'boundaries.y.lower={no_slip: {velocity: [0, 1]}}'
has stderr 'cannot move across itself'

# Open sides.
pulse=$FLOE_SOURCE/inputs/pulse_leaves.yaml
expect 2 "$FLOE" check "$pulse" --set method.pressure=implicit
has stderr 'does not resolve'
expect 2 "$FLOE" check "$pulse" --set 'boundaries.x.lower={reservoir: {pressure: -1, temperature: 1}}'
has stderr "does not exist at -1 Pa"
# Check and run refuse the same decks: an outlet too, though nothing enters by it, without an ambient that names the fluid.
cat >outlet.yaml <<'END'
floe: 1
coupling: ice
domain: {dim: 1, lower: [0], upper: [1], cell: 0.05}
boundaries:
  x: {lower: slip, upper: {outlet: {pressure: 1e5}}}
materials:
  air: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}
  water: {eos: {stiffened: {gamma: 4.4, p_inf: 6e8, specific_heat: 4186}}}
bodies:
  gas: {material: air, shape: {box: {lower: [0], upper: [1]}}, pressure: 1e5, temperature: 300}
time: {end: 1e-3, max_steps: 1}
END
for what in check 'run -o outlet'; do
    # shellcheck disable=SC2086 # two words
    expect 2 "$FLOE" $what outlet.yaml --set materials.water=null --set boundaries.x.upper.outlet.pressure=-1e5
    has stderr "'air' does not exist at -100000 Pa: its pressure is above 0 Pa"
    # shellcheck disable=SC2086
    expect 2 "$FLOE" $what outlet.yaml --set 'boundaries.x.upper={outlet: {pressure: -1e5, material: air}}'
    has stderr "'air' does not exist at -100000 Pa"
    # shellcheck disable=SC2086
    expect 2 "$FLOE" $what outlet.yaml --set boundaries.x.upper.outlet.pressure=-6e8
    has stderr "'water' does not exist at -6e+08 Pa"
    # shellcheck disable=SC2086
    expect 2 "$FLOE" $what outlet.yaml --set 'boundaries.x.upper={non_reflecting: {pressure: -1e5, material: air}}'
    has stderr "'air' does not exist at -100000 Pa"
    # shellcheck disable=SC2086
    expect 0 "$FLOE" $what outlet.yaml
done

# Keys that a coupling does not read, and what is left over, are warned of at their places.
cat >unread.yaml <<'END'
floe: 1
coupling: ice
domain: {dim: 1, lower: [0], upper: [1], cell: 0.05}
boundaries: {x: {lower: no_slip, upper: slip}}
materials:
  air: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}
  spare: {eos: {ideal: {gamma: 1.6, specific_heat: 300}}}
bodies:
  gas: {material: air, shape: {box: {lower: [0], upper: [1]}}, pressure: 1e5, temperature: 300, points: 3}
method: {basis: gimp}
time: {end: 1e-3, cfl: {mpm: 0.2}}
END
expect 0 "$FLOE" check unread.yaml
has stderr "unread.yaml:10:17: method.basis: 'ice' does not read this key, as it has no material points"
has stderr "unread.yaml:11:30: time.cfl.mpm: 'ice' does not read"
has stderr "unread.yaml:9:105: bodies.gas.points: 'ice' does not read"
has stderr "unread.yaml:7:3: materials.spare: nothing is made of material 'spare'"
has stderr 'unread.yaml:4:25: boundaries.x.lower: no fluid is viscous'
expect 0 "$FLOE" check unread.yaml --set method.basis=linear --set 'method={flip: 0.5, transfer: flip}'
has stderr '--set method={flip: 0.5, transfer: flip}: method.flip: '

# Solids that burn: what knows nothing of points that lose mass.
block=$FLOE_SOURCE/inputs/burning_block.yaml
expect 2 "$FLOE" check "$block" --set method.interface=sharp
has stderr 'cannot burn where surfaces cut the cells'
expect 2 "$FLOE" check "$block" --set method.edge_penalty=0.05
has stderr 'and its edge with it'
expect 2 "$FLOE" check "$block" --set 'exchange={}'
has stderr 'would be locked in the cells'
expect 2 "$FLOE" check "$block" --set 'reactions.more={reactant: propellant, product: gas, rate: {threshold: {temperature: 300, time: 1}}}'
has stderr "uses up the solid 'propellant' already"
expect 2 "$FLOE" check "$block" --set 'loads={push: {traction: {body: block, surface: {box: {lower: [15 mm, 15 mm], upper: [25 mm, 25 mm]}}, pressure: 1 MPa}}}'
has stderr 'which is loaded, burns away'
expect 2 "$FLOE" check "$block" --set coupling=mpm
has stderr "'mpm' has none"

# What can be run and will not be right: gas of points beside walls that are softer than it, and on the knots of splines.
vessel=("$FLOE_SOURCE/inputs/extreme/vessel.yaml" --coupling mpm --set materials.wall.law.linear_elastic.bulk_modulus=1e5
    --set materials.wall.law.linear_elastic.shear_modulus=4e4 --set materials.wall.density=890 --set loads.heating.pressurise.target=100)
expect 0 "$FLOE" check "${vessel[@]}"
if grep -q 'the largest pressure of the gas' stderr; then fault 'gas has a velocity of its own beside a soft wall'; fi
expect 0 "$FLOE" check "${vessel[@]}" --set method.stress=musl
has stderr "the bulk modulus of body 'wall' is 0.999 times the largest pressure of the gas"
expect 0 "$FLOE" check "${vessel[@]}" --set time.solver=static
if grep -q 'the largest pressure of the gas' stderr; then fault 'statics have no such error'; fi
expect 0 "$FLOE" check "${vessel[@]}" --coupling ice-mpm
if grep -q 'the largest pressure of the gas' stderr; then fault 'cells have no such error'; fi
expect 0 "$FLOE" check "${tiny[@]}" --set bodies.bore.points=3
has stderr 'quadratic splines and an odd number of points'
expect 0 "$FLOE" check "${tiny[@]}" --set method.basis=cubic
has stderr 'cubic splines and any number of points'
expect 0 "$FLOE" run "${tiny[@]}" --set method.basis=cubic --set time.max_steps=1 -o warned
has warned/run.log 'cubic splines and any number of points'

# Slip sides that hold a solid all the same, and fluids that stick to it.
expect 0 "$FLOE" check "$FLOE_SOURCE/inputs/pressed_cylinder.yaml" --set boundaries.y.lower=slip
has stderr "--set boundaries.y.lower=slip: in steps that are solved for, a slip side constrains body 'block'"
lift=("$FLOE_SOURCE/tests/cli/decks/lift.yaml")
expect 0 "$FLOE" check "${lift[@]}"
if grep -q 'a slip side' stderr; then fault 'gas comes beneath it'; fi
expect 0 "$FLOE" check "${lift[@]}" --set method.interface=smeared
has stderr "boundaries.y.lower: body 'block' lies within a cell of a slip side"
expect 0 "$FLOE" check "${lift[@]}" --set 'bodies.block.shape.box={lower: [0, 0], upper: [0.2, 0.3]}'
has stderr "boundaries.x.lower: body 'block' stands on a slip side"
expect 0 "$FLOE" check "${lift[@]}" --set method.pressure=implicit
has stderr "boundaries.y.lower: body 'block' stands on a slip side"
expect 0 "$FLOE" check "${lift[@]}" --set 'boundaries.y={lower: symmetry, upper: slip}'
if grep -q 'a slip side' stderr; then fault 'a mirror is meant to hold'; fi
expect 0 "$FLOE" check "${lift[@]}" --set 'bodies.block.shape.box={lower: [0.4, 0.05], upper: [0.6, 0.35]}'
if grep -q 'a slip side' stderr; then fault 'a cell is open'; fi
tube=("$FLOE_SOURCE/inputs/extreme/vessel.yaml" --coupling mpm --set damping=null --set stop=null)
expect 0 "$FLOE" check "${tube[@]}"
has stderr 'had 3 % too little pressure'
# Of a gas that is all ambient, and so a body of points only once the scene is laid out, as well.
expect 0 "$FLOE" check "$FLOE_SOURCE/inputs/extreme/foam.yaml" --set coupling=mpm --set study=null
has stderr 'had 3 % too little pressure'
if grep -q "bulk modulus of body 'foam'" stderr; then fault 'gas and a soft wall have velocities of their own'; fi
expect 0 "$FLOE" check "$FLOE_SOURCE/inputs/extreme/foam.yaml" --set coupling=mpm --set study=null --set method.stress=musl
has stderr "the bulk modulus of body 'foam' is 5 times the largest pressure of the gas"
expect 0 "$FLOE" check "${tube[@]}" --set method.stress=musl
has stderr 'fluid and solid bodies share one velocity'

# A liquid at a side that holds no pressure, beside a solid.
wet=("$FLOE_SOURCE/inputs/shock_plate.yaml" --set 'materials.air.eos={stiffened: {gamma: 4.4, p_inf: 5e8, specific_heat: 1816}}')
expect 2 "$FLOE" check "${wet[@]}"
has stderr 'a free side holds no pressure against a liquid'
has stderr 'take outlet or non_reflecting'
expect 0 "$FLOE" check "${wet[@]}" --set 'boundaries.x={lower: {outlet: {pressure: 1e5}}, upper: slip}' --set reference_pressure=1e5

# Nothing locks (incompressible.sh), and nothing is said, but of implicit steps, in which pressures swing.
annulus=$FLOE_SOURCE/inputs/annulus_traction.yaml
rubber=(--set domain.cell=0.1 --set materials.steel.law.linear_elastic.shear_modulus=1e8)
expect 0 "$FLOE" check "$annulus" "${rubber[@]}" --set study=null
[ ! -s stderr ] || fault 'explicit steps with quadratic splines are warned of'
expect 0 "$FLOE" check "$annulus" "${rubber[@]}" --set method.basis=cubic
! grep -q 'times its shear modulus' stderr || fault 'explicit steps with cubic splines are warned of'
expect 0 "$FLOE" check "$annulus" "${rubber[@]}" --set time.solver=implicit --set time.increments=10 --set stop=null --set study=null
has stderr "the bulk modulus of body 'cylinder' is 1.17e+03 times its shear modulus: in implicit steps the pressure"
expect 0 "$FLOE" check "$annulus" --set domain.cell=0.1 --set method.basis=cubic --set materials.steel.law.linear_elastic.shear_modulus=1e10
[ ! -s stderr ] || fault 'cubic splines bear a ratio of 11.7'

# Keys and choices under their former names.
expect 2 "$FLOE" check "$decks/keys_membrane.yaml" --set bodies.skin.membrane.holds=gas
has stderr "'holds' is now called 'encloses'"
has stderr 'expected: encloses'
expect 2 "$FLOE" check "$decks/keys_membrane.yaml" --set bodies.skin.membrane.strain=places
has stderr "'places' is now called 'positions'"
expect 2 "$FLOE" check "$decks/keys_membrane.yaml" --set 'springs={s: {from: {place: [0.1, 0.1]}, to: {body: skin, point: 1}, stiffness: 1e7}}'
has stderr "'place' is now called 'position'"

# A deck through a pipe is read once, and says so of its cases.
"$FLOE" check /dev/stdin <"$FLOE_SOURCE/inputs/acoustic_pulse.yaml" >/dev/null
cat "$FLOE_SOURCE/inputs/acoustic_pulse.yaml" | expect 0 "$FLOE" check /dev/stdin
has stdout 'can be read once: give a file'

# What a run writes: named by the plan, and warned of where the disk does not hold it.
many=("$FLOE_SOURCE/inputs/lid_cavity.yaml" --set output.interval=2e-5 --set domain.cell=0.01)
expect 0 "$FLOE" plan "${many[@]}" --json
[ "$(json stdout snapshots)" = 1000002.0 ] || fault "$(json stdout snapshots) snapshots"
free=$(sed -n '/"disk"/,/}/s/^ *"available": \([^,]*\),/\1/p' stdout)
need=$(sed -n '/"disk"/,/}/s/^ *"bytes": \([^,]*\),/\1/p' stdout)
fits=$(sed -n '/"disk"/,/}/s/^ *"fits": \([a-z]*\).*/\1/p' stdout)
awk -v need="$need" 'BEGIN { exit !(need > 1e11) }' || fault "$need bytes"
expect 0 "$FLOE" check "${many[@]}"
if [ "$fits" = false ]; then
    has stderr 'output.interval'
    has stderr 'take a longer interval, or another disk'
elif grep -q 'another disk' stderr; then fault "$need of $free bytes are warned of"; fi

# Fluid points on a floor start with the weight above them; where gravity is oblique they do not, and are warned of. A pressure that has the weight, a column
# of air and a drop are not.
cat >column.yaml <<'DECK'
floe: 1
coupling: mpm
domain: {dim: 2, lower: [0, 0], upper: [1, 1.5], cell: 0.05}
boundaries: {x: slip, y: {lower: slip, upper: free}}
materials:
  water: {eos: {tait: {density: 1000, bulk_modulus: 2.2 GPa, pressure: 1e5}}}
  air: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}
reference_pressure: 1e5
bodies: {column: {material: water, shape: {box: {lower: [0, 0], upper: [1, 1]}}, pressure: 1e5, temperature: 300}}
loads: {weight: {gravity: {acceleration: [0, -9.81]}}}
time: {end: 1e-4}
DECK
expect 0 "$FLOE" check column.yaml
if grep -q 'weight above' stderr; then fault 'a column with its weight is warned of'; fi
lean='loads.weight.gravity.acceleration=[1, -9.81]'
expect 0 "$FLOE" check column.yaml --set "$lean"
has stderr 'column.yaml:9:92: bodies.column.pressure: points of fluid start without the weight above them, 9.81e+03 Pa'
for change in 'bodies.column.pressure=1e5 + 9810 * (1 - y)' bodies.column.material=air 'bodies.column.shape.box={lower: [0.2, 0.5], upper: [0.8, 1]}'; do
    expect 0 "$FLOE" check column.yaml --set "$lean" --set "$change"
    if grep -q 'weight above' stderr; then fault "$change is warned of"; fi
done

# Its points sink between each other with the default transfer (measured in docs/limits.md); with apic they do not.
for transfer in flip apic; do
    expect 0 "$FLOE" check column.yaml --set method.transfer=$transfer
    if [ $transfer = flip ]; then
        has stderr "method.transfer=flip: with 'flip' the points of liquid 'column' sink between each other"
    elif grep -q 'sink between' stderr; then fault 'apic is warned of'; fi
done

# A target of pressure below what is there takes energy out.
expect 0 "$FLOE" check "$FLOE_SOURCE/inputs/pressurized_cylinder.yaml"
if grep -q 'takes energy out' stderr; then fault 'a cylinder that is pressurised is warned of'; fi
expect 0 "$FLOE" check "$FLOE_SOURCE/inputs/pressurized_cylinder.yaml" --set bodies.bore.pressure=25e6
has stderr 'starts at 2.5e+07 Pa, and its mean is brought to'

# What is fixed leaves no side: there is nothing to warn of.
block='bodies={wall: {material: steel, shape: {box: {lower: 0, upper: 0.5}}MOTION}}'
for motion in '' ', motion: fixed'; do
    expect 0 "$FLOE" check "$FLOE_SOURCE/inputs/defaults/f3_piston.yaml" --set "${block/MOTION/$motion}" --set output.probes=null
    if [ -z "$motion" ]; then
        has stderr 'on a slip side'
    elif grep -q 'on a slip side' stderr; then fault 'a fixed body is warned of'; fi
done

# Tables in files: units of the first line count, and what spreadsheets write instead of commas and points is refused, not read as something else.
solid=$FLOE_SOURCE/tests/mistakes/solid.yaml
table() { # table NAME TEXT CHECK...: the file as the pressure in the bore
    printf "$2" >"$work/$1.csv"
    "$FLOE" "${@:3}" "$solid" --set "tables={push: {file: $work/$1.csv, from: t}}" --set loads.bore.traction.pressure='push(t)' --set loads.bore.traction.ramp=0
}
entries() { sed -nE 's/.* # ([0-9]+ entries, .*)/\1/p' "$1/deck.yaml"; }
expect 0 table plain 't,p\n0,1e7\n0.002,3e7\n' run --quiet --set time.max_steps=1 -o plain
expect 0 table units '\xef\xbb\xbft (ms),p (MPa)\r\n0,10\r\n2,30\r\n' run --quiet --set time.max_steps=1 -o units
[ -n "$(entries plain)" ] && [ "$(entries plain)" = "$(entries units)" ] || fault "other entries with units: $(entries plain), $(entries units)"
refused_table() { # refused_table WORDS TEXT
    expect 2 table wrong "$2" check
    has stderr "$1"
}
refused_table "unit 'foo' is not known" 't,p (foo)\n0,1\n1,2\n'
refused_table 'stand between semicolons' 't;p\n0;1\n1;2\n'
refused_table 'names of columns belong' '0,1\n1,2\n2,3\n'
refused_table 'more columns than the first line names' 't,p\n0,1,5\n1,2,5\n'
refused_table 'more columns than the first line names' 't,p\n0,"1,5"\n1,2\n'
refused_table 'is no number' 't,p\n0,1 bar\n1,2\n'

# Warnings have the place of what they are about, as errors have: of the key with which they begin, else of the body that they name.
sed 's/lower: no_slip/lower: slip/' "$FLOE_SOURCE/inputs/foam_wall.yaml" >sides.yaml
expect 0 "$FLOE" check sides.yaml --set method.interface=smeared
has stderr "warning: sides.yaml:$(grep -n '^  z:' sides.yaml | cut -d: -f1):14: boundaries.z.lower: body 'wall' lies within"
expect 0 "$FLOE" check sides.yaml --set domain.cell=0.2
has stderr "warning: sides.yaml:$(grep -n '^  wall:' sides.yaml | cut -d: -f1):3: bodies.wall: "
