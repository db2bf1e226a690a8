#!/usr/bin/env bash
# One deck is one scene: what fills it does not depend on the coupling.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

# value DIR COLUMN [ROW]: of history.csv; the first row unless told (last: $).
value() {
    awk -F, -v name="$2" -v row="${3:-first}" '
        NR == 1 { for (i = 1; i <= NF; i++) { split($i, part, " "); if (part[1] == name) k = i }; next }
        row == "first" && NR == 2 { print $k }
        { last = $k }
        END { if (row == "last") print last }' "$1/history.csv"
}

# near A B TOLERANCE: |A - B| <= TOLERANCE |B|.
near() {
    awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN { d = a - b; if (d < 0) d = -d; if (b < 0) b = -b; exit !(a != "" && d <= t * b) }' ||
        fault "$1 is not within $3 of $2"
}

# The starter: gas of points fills the box as cells do, none of it is lost, and the block goes the same way: as far on cells of half the size (0.9 % less
# with the coarse ones; with cells of 0.01 m 1.166 mm), 11.9 % less far beside points, measured.
expect 0 "$FLOE" new 'Block in a blast'
mv stdout block.yaml
for coupling in mpm ice-mpm; do
    expect 0 "$FLOE" run block.yaml --coupling "$coupling" --set domain.cell=0.025 -o "$coupling"
    if grep -q 'does not read' stderr; then fault 'a key of the starter is not read'; fi
    near "$(value "$coupling" mass_air)" 0.63548780487804873 2e-8 # a film of a millionth of a cell is beneath the block
done
[ "$(json mpm/summary.json points_lost)" = 0 ] || fault 'points are lost'
near "$(awk -v a="$(value mpm centre_block_x last)" 'BEGIN { print a - 0.5 }')" \
    "$(awk -v a="$(value ice-mpm centre_block_x last)" 'BEGIN { print a - 0.5 }')" 0.13
expect 0 "$FLOE" run block.yaml --coupling ice-mpm --set domain.cell=0.05 -o coarse
near "$(awk -v a="$(value coarse centre_block_x last)" 'BEGIN { print a - 0.5 }')" \
    "$(awk -v a="$(value ice-mpm centre_block_x last)" 'BEGIN { print a - 0.5 }')" 0.015

# Fluids yield to solids and to the fluids before them; exact masses: 0.36 and 0.64 - 0.09 pi of a gas of 1.1614401858 kg/m3.
cat >lap.yaml <<'END'
floe: 1
coupling: ice-mpm
runs_as: [mpm, ice-mpm]
reference_pressure: 1e5
domain: {dim: 2, lower: [0, 0], upper: [1, 1], cell: 0.1}
boundaries: slip
materials:
  steel: {density: 1000, law: {neo_hookean: {bulk_modulus: 2e7, shear_modulus: 2e6}}, specific_heat: 1800}
  air: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}
  gas: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}
ambient: {material: air, pressure: 1e5, temperature: 300}
bodies:
  gas: {material: gas, shape: {box: {lower: [0.1, 0.1], upper: [0.9, 0.9]}}, pressure: 1e5, temperature: 300}
  ball: {material: steel, shape: {ball: {centre: [0.5, 0.5], radius: 0.3}}}
  more: {material: air, shape: {box: {lower: [0, 0], upper: [0.53, 1]}}, pressure: 1e5, temperature: 300}
time: {end: 1, max_steps: 1}
END
for coupling in mpm ice-mpm; do
    expect 0 "$FLOE" run lap.yaml --coupling "$coupling" -o "$coupling"
    near "$(value "$coupling" mass_steel)" 282.74333882308139 1e-6
    [ "$coupling" = mpm ] && bound=2.6e-5 || bound=4e-3
    near "$(value "$coupling" mass_air)" 0.41811846689895470 "$bound"
    near "$(value "$coupling" mass_gas)" 0.41493224 "$bound"
done

# Solids do not overlap, unless one is said to yield: then none counts twice.
second='bodies.second={material: steel, shape: {box: {lower: [0.5, 0.5], upper: [0.93, 0.97]}}}'
for coupling in mpm ice-mpm; do
    expect 2 "$FLOE" check lap.yaml --set coupling="$coupling" --set "$second"
    has stderr "solid 'second' overlaps solid 'ball' in 0.0707 m2 (35 % of the smaller of them)"
    expect 0 "$FLOE" run lap.yaml --coupling "$coupling" --set "$second" --set bodies.second.yields=true -o "$coupling"
    near "$(value "$coupling" mass_steel)" 414.15749 1e-4 # 282.7433 + 1000 (0.43 0.47 - 0.09 pi / 4)
    expect 0 "$FLOE" run lap.yaml --coupling "$coupling" --set "$second" --set bodies.ball.yields=true -o "$coupling"
    near "$(value "$coupling" mass_steel)" 414.15749 1e-4
done
# In touch is not one in the other.
expect 0 "$FLOE" check lap.yaml --set 'bodies.second={material: steel, shape: {annulus: {centre: [0.5, 0.5], inner_radius: 0.3, outer_radius: 0.37}}}'

# An ambient that cannot be of points is refused, with what to do.
expect 2 "$FLOE" run lap.yaml --coupling mpm --set 'boundaries={x: slip, y: {lower: slip, upper: free}}' -o no
has stderr "boundaries.y.upper: mpm: the ambient is of points, which leave through 'free' and do not come back"
expect 2 "$FLOE" run lap.yaml --coupling mpm --set ambient.points=0 --set ambient.pressure=2e5 -o no
has stderr 'ambient.points=0: mpm: without points'
expect 0 "$FLOE" run lap.yaml --coupling mpm --set ambient.points=0 -o without
[ "$(json without/summary.json points)" -lt "$(json mpm/summary.json points)" ] || fault 'the ambient has points'

# Loads act on the part of a cell, or of a point, that lies in their region: a power of 1e6 W/m3 in a disc far smaller than a cell for 1 ms, and
# half of that along a ramp; 1e3 pi 0.01^2 J exactly.
cat >heat.yaml <<'END'
floe: 1
coupling: ice
runs_as: [mpm, ice]
reference_pressure: 1e5
domain: {dim: 2, lower: [0, 0], upper: [0.4, 0.4], cell: 0.05}
boundaries: slip
materials: {air: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}}
bodies: {air: {material: air, shape: {box: {lower: [0, 0], upper: [0.4, 0.4]}}, pressure: 1e5, temperature: 300}}
loads: {heater: {heat: {material: air, power: 1e6, region: {ball: {centre: [0.16, 0.19], radius: 0.01}}}}}
time: {end: 1 ms}
END
for coupling in mpm ice; do
    expect 0 "$FLOE" run heat.yaml --coupling "$coupling" -o heated
    near "$(value heated ledger_energy_source last)" 0.31415926535897931 0.02
    expect 0 "$FLOE" run heat.yaml --coupling "$coupling" --set loads.heater.heat.ramp=1e-3 -o heated
    near "$(value heated ledger_energy_source last)" 0.15707963267948966 0.02
done

# A static gas of points outside the region is left as it is: two rooms of one gas, one of them pressurised.
cat >rooms.yaml <<'END'
floe: 1
coupling: mpm
reference_pressure: 1e5
domain: {dim: 1, lower: 0, upper: 1, cell: 0.02}
boundaries: slip
materials:
  rubber: {density: 1000, law: {neo_hookean: {bulk_modulus: 2e7, shear_modulus: 1e7}}}
  air: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}
bodies:
  left: {material: air, shape: {box: {lower: 0, upper: 0.4}}, pressure: 1e5, temperature: 300}
  wall: {material: rubber, shape: {box: {lower: 0.4, upper: 0.6}}}
  right: {material: air, shape: {box: {lower: 0.6, upper: 1}}, pressure: 1e5, temperature: 300}
loads: {l: {pressurise: {material: air, region: {box: {lower: 0, upper: 0.5}}, target: 1e4, ramp: 1}}}
supports: {middle: {region: {box: {lower: 0.49, upper: 0.51}}}}
time: {end: 1, solver: static}
output: {probes: {a: 0.19, b: 0.81}}
END
expect 0 "$FLOE" run rooms.yaml -o rooms
near "$(value rooms a_pressure last)" 1.1e5 1e-3
below "$(value rooms b_pressure last)" 1.08e5

# Solids' metrics go to solids; an exact solution of solids does not measure a fluid; points there must be; gas that a membrane holds, too.
cylinder_errors() { "$FLOE" run "$cylinder" --coupling mpm --set domain.cell=0.1 -o errors "$@" >/dev/null 2>stderr; json errors/summary.json eq13; }
[ "$(cylinder_errors)" = "$(cylinder_errors --set verify.body=null)" ] || fault 'another body is measured where none is named'
expect 2 "$FLOE" check "$cylinder" --set verify.body=bore
has stderr 'is of a solid'
riemann='{riemann: {position: 0.1, left_density: 1, left_pressure: 1, right_density: 0.125, right_pressure: 0.1}}'
for what in check 'run -o phase'; do
    # shellcheck disable=SC2086 # two words
    expect 2 "$FLOE" $what "$cylinder" --coupling mpm --set "verify={exact: $riemann, metrics: [l1_density], body: cylinder}"
    has stderr "verify.body: the exact solution 'riemann' is of a fluid, and 'steel' is a solid: name a body of a fluid"
    # shellcheck disable=SC2086
    expect 2 "$FLOE" $what "$FLOE_SOURCE/inputs/bar_vibration.yaml" --set "verify={exact: $riemann, metrics: [l1_density]}"
    has stderr "the exact solution 'riemann' is of a fluid, and the scene has none"
done
expect 0 "$FLOE" check "$FLOE_SOURCE/inputs/bar_vibration.yaml" --set 'verify={exact: {uniform: {pressure: 0, density: 1}}, metrics: [l1_density]}'
expect 2 "$FLOE" check lap.yaml --coupling mpm --set 'bodies.dot={material: steel, seeding: lattice, shape: {ball: {centre: [0.051, 0.051], radius: 0.004}}}'
has stderr 'bodies.dot.shape: no point lies in it'
expect 2 "$FLOE" check "$FLOE_SOURCE/tests/cli/decks/keys_membrane.yaml" --coupling ice-mpm --set bodies.gas=null
has stderr "bodies.skin.membrane.encloses: there is no 'gas' to enclose"

# What the mesh cannot carry is warned of, with figures.
expect 0 "$FLOE" check lap.yaml --set 'bodies.ball.shape={box: {lower: [0.43, 0.2], upper: [0.48, 0.8]}}' --set method.interface=smeared
has stderr "body 'ball' is thinner than its cells: it fills 50 % of one at most"
expect 0 "$FLOE" check lap.yaml --set 'bodies.ball.shape={ball: {centre: [1.25, 0.5], radius: 0.3}}' --set 'boundaries={x: free, y: slip}' --set method.interface=smeared
has stderr "% of body 'ball' lies in the domain"
expect 0 "$FLOE" check lap.yaml --set 'output={probes: {p: [0.5, 0.83]}}' --set method.interface=smeared
has stderr "probe 'p' is 0.3 cells outside the surface of body 'ball'"

# What --set sets takes the place of an axis of the deck, and gives the results a folder of their own.
expect 0 "$FLOE" compare lap.yaml --set 'compare={axis: {domain.cell: [0.1, 0.05]}}' --set domain.cell=0.2 --repeat 0
is_there out/lap-compare-*domain.cell=0.2/compare.csv
[ "$(find out/lap-compare-*domain.cell=0.2 -name history.csv | wc -l)" = 2 ] || fault 'the axis is varied all the same'
expect 2 "$FLOE" compare lap.yaml --axis domain.cell=0.1,0.05 --set domain.cell=0.2
has stderr "--set domain.cell=0.2: '--axis' varies 'domain.cell'"
expect 0 "$FLOE" run lap.yaml --coupling mpm --set domain.cell=0.2
expect 0 "$FLOE" run lap.yaml --coupling mpm --set domain.cell=0.1
is_there out/lap-mpm-domain.cell=0.2/summary.json out/lap-mpm-domain.cell=0.1/summary.json
