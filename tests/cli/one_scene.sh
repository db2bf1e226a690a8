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

# The starter: gas of points fills the box as cells do, none of it is lost, and the block goes the same way: 2.10 and 1.01 mm at
# h = 0.05, 1.51 and 1.08 at h/2, 1.26 and 1.14 at h/4.
expect 0 "$FLOE" new 'Block in a blast'
mv stdout block.yaml
for coupling in mpm ice-mpm; do
    expect 0 "$FLOE" run block.yaml --coupling "$coupling" --set domain.cell=0.0125 -o "$coupling"
    [ ! -s stderr ] || fault 'the starter is warned of'
    near "$(value "$coupling" mass_air)" 0.63548780487804873 1e-9
done
[ "$(json mpm/summary.json points_lost)" = 0 ] || fault 'points are lost'
near "$(awk -v a="$(value mpm centre_block_x last)" 'BEGIN { print a - 0.5 }')" \
    "$(awk -v a="$(value ice-mpm centre_block_x last)" 'BEGIN { print a - 0.5 }')" 0.22

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
