#!/usr/bin/env bash
# Membranes whose points are listed in no order: normals, and the neighbours from whose places strain comes, are found from where the points
# lie; what would not be heeded is refused.
# shellcheck source=tests/cli/lib.bash
source "$(dirname "$0")/lib.bash"
circle=$FLOE_SOURCE/inputs/membrane_circle.yaml

# list STEP: 91 points of the quarter of the circle, each STEP-th in turn.
list() {
    awk -v step="$1" 'BEGIN { printf "{points: {at: ["
        for (k = 0; k < 91; k++) { a = ((k * step) % 91 + 0.5) / 91 * 1.5707963267948966; printf "%s[%.17g, %.17g]", k ? ", " : "", 0.5 * cos(a), 0.5 * sin(a) }
        printf "]}}" }'
}
# of DIR COLUMN: its last value.
of() {
    awk -F, -v name="$2" 'NR == 1 { for (i = 1; i <= NF; i++) { t = $i; sub(/ .*/, "", t); if (t == name) c = i } } END { print $c }' "$1/history.csv"
}
# close VALUE VALUE SHARE
close() {
    awk -v a="$1" -v b="$2" -v e="$3" 'BEGIN { d = a - b; exit !(b != 0 && d * d <= e * e * b * b) }' || fault "$1 is not $2"
}
runs=(--set runs_as=null --set time.max_steps=60 --set time.end=0.01 --set verify=null --set bodies.skin.membrane.number=null --set bodies.skin.membrane.length=0.78539816339744831)

# In order and connected; in any order and free: the same strains, and what they store. By rate and by places.
for strain in 'positions' 'rate'; do
    smoothing=0.05
    [ $strain = positions ] || smoothing=0
    how=(--set "bodies.skin.membrane.strain=$strain" --set "bodies.skin.membrane.smoothing=$smoothing" --set method.losses=drift)
    expect 0 "$FLOE" run "$circle" "${runs[@]}" "${how[@]}" --set bodies.skin.membrane.curve="$(list 1)" -o order --quiet
    expect 0 "$FLOE" run "$circle" "${runs[@]}" "${how[@]}" --set bodies.skin.membrane.curve="$(list 34)" --set bodies.skin.membrane.encloses=null \
        --set bodies.skin.membrane.normals=quadric -o free --quiet
    close "$(of free strain_skin)" "$(of order strain_skin)" 1e-6
    close "$(of free kinetic)" "$(of order kinetic)" 1e-6
    [ "$(of free strain_skin)" != "$(of order strain_skin)" ] || fault 'the order of the points was not another'
    if grep -q area_skin free/history.csv; then fault 'an area by the numbers of points in no order'; fi
    has order/history.csv area_skin
    rm -r order free
done

# The same bits after a stop, with threads, in blocks.
free=("$circle" "${runs[@]}" --set bodies.skin.membrane.curve="$(list 34)" --set bodies.skin.membrane.encloses=null --set bodies.skin.membrane.normals=quadric)
expect 0 "$FLOE" run "${free[@]}" -o whole --quiet
OMP_NUM_THREADS=2 expect 0 "$FLOE" run "${free[@]}" --threads 2 -o threads --quiet
cmp whole/history.csv threads/history.csv || fault 'other bits with two threads'
expect 0 "$FLOE" run "${free[@]}" --set 'domain.upper=[1.6, 1.6]' -o wide --quiet
expect 0 "$FLOE" run "${free[@]}" --set 'domain.upper=[1.6, 1.6]' --set domain.blocks=2 -o blocks --quiet
cmp wide/history.csv blocks/history.csv || fault 'other bits in blocks'
expect 5 "$FLOE" run "${free[@]}" -o part --max-wall 0.02
below "$(json part/summary.json steps)" "$(json whole/summary.json steps)"
expect 0 "$FLOE" run "${free[@]}" -o part --resume --quiet
same_results whole part

# Connected points must follow each other; without a length their order tells it.
expect 2 "$FLOE" check "$circle" "${runs[@]}" --set bodies.skin.membrane.curve="$(list 34)"
has stderr 'the membrane would be torn'
expect 2 "$FLOE" check "${free[@]}" --set bodies.skin.membrane.length=null
has stderr 'the membrane would be torn'
expect 2 "$FLOE" check "${free[@]}" --set bodies.skin.membrane.encloses=gas
has stderr 'the membrane would be torn'

# On one axis there are no normals to find.
cat >line.yaml <<'DECK'
floe: 1
title: Stretched bar of a membrane
units: none
coupling: mpm
domain: {dim: 1, lower: [0], upper: [1], cell: 0.1}
materials: {skin: {membrane: {string: {modulus: 1}}, density: 1}}
bodies: {skin: {material: skin, membrane: {curve: {segment: {from: [0.2], to: [0.8]}}, thickness: 0.1}, points: 2}}
time: {end: 0.01}
DECK
expect 0 "$FLOE" check line.yaml
expect 2 "$FLOE" check line.yaml --set bodies.skin.membrane.normals=isosurface
has stderr 'a line of one dimension has none to find'

# A surface by a list of its points, in a file beside the deck: those of the plane patch, in another order and with other columns about, bring the
# figures of the patch; the resolved deck finds the file from elsewhere.
mkdir deck
cp "$FLOE_SOURCE/inputs/membrane_patch.yaml" deck/patch.yaml
awk 'BEGIN { print "# a patch"; print "number, z, \"x (m)\", y (m)"; for (i = 0; i < 90; i++) { k = i * 7 % 90
    printf "%d, 0.14, %.17g, %.17g\n\n", i, 0.1 + ((k % 15) + 0.5) / 15 * 0.5, 0 + (int(k / 15) + 0.5) / 6 * 0.2 } }' >deck/patch.csv
listed=(deck/patch.yaml --set bodies.skin.membrane.surface='{points: {at: patch.csv, area: 0.1}}')
expect 0 "$FLOE" run deck/patch.yaml -o plane --quiet
expect 0 "$FLOE" run "${listed[@]}" -o listed --quiet
for column in strain_skin kinetic; do close "$(of listed $column)" "$(of plane $column)" 1e-9; done
close "$(json listed/summary.json l2rel_stress_xx)" "$(json plane/summary.json l2rel_stress_xx)" 1e-6
below "$(json listed/summary.json linf_normal)" 1e-9
(cd plane && expect 0 "$FLOE" run "$(ls ../listed/*.yaml)" -o again --quiet && same_results ../listed again)

# A run goes on with the list that it began with, and with no other.
expect 5 "$FLOE" run "${listed[@]}" -o stopped --max-wall 1e-6
cp deck/patch.csv patch.csv
awk 'NR == 5 { sub(/0.14/, "0.1400001") } { print }' patch.csv >deck/patch.csv
expect 2 "$FLOE" run "${listed[@]}" -o stopped --resume
has stderr 'sha256'
cp patch.csv deck/patch.csv
expect 0 "$FLOE" run "${listed[@]}" -o stopped --resume --quiet
same_results listed stopped

refused() {
    expect 2 "$FLOE" check "${listed[@]}" "${@:2}"
    has stderr "$1"
}
refused 'more than a cell of 0.01 m: the membrane would be torn' --set domain.cell=0.01
refused 'lists its points and gives their number' --set bodies.skin.membrane.number=90
refused "cannot open '$PWD/deck/other.csv'" --set bodies.skin.membrane.surface.points.at=other.csv
sed 's/z/w/' deck/patch.csv >deck/other.csv
refused "its first line names no column 'z'" --set bodies.skin.membrane.surface.points.at=other.csv
sed '5s/0.14/here/' deck/patch.csv >deck/other.csv
refused "line 5: 'here' is no number" --set bodies.skin.membrane.surface.points.at=other.csv
sed '5s/,[^,]*$//' deck/patch.csv >deck/other.csv
refused 'line 5 has too few columns' --set bodies.skin.membrane.surface.points.at=other.csv
sed -n 1,2p deck/patch.csv >deck/other.csv
refused 'it has no row below its head' --set bodies.skin.membrane.surface.points.at=other.csv
: >deck/other.csv
refused 'it is empty' --set bodies.skin.membrane.surface.points.at=other.csv
printf 'x,y,z\n0.3,0.1,0.1%02000d\n' 0 >deck/other.csv
refused 'line 2 has more than' --set bodies.skin.membrane.surface.points.at=other.csv

# Points of which no direction follows: one alone, and several on one spot, keep what they have, counted; nothing becomes a NaN. On a surface
# they are refused, as are those on a line.
for at in '[[0.3, 0.3]]' '[[0.3, 0.3], [0.3, 0.3], [0.3, 0.3]]' '[[0.25, 0.3], [0.27, 0.3], [0.29, 0.3]]'; do
    for normals in colour isosurface isosurface_linear isosurface_quadratic quadric; do
        expect 0 "$FLOE" run "$circle" --set runs_as=null --set time.max_steps=3 --set verify=null --set bodies.skin.membrane="{curve: {points: {at: $at}}, length: 0.1, thickness: 0.1, normals: $normals}" \
            -o few --quiet
        if grep -qi nan few/history.csv; then fault "a NaN of $at with $normals"; fi
        [ $normals = colour ] || [ "$at" = '[[0.25, 0.3], [0.27, 0.3], [0.29, 0.3]]' ] || below 0 "$(json few/summary.json normals_kept)"
        rm -r few
    done
done
for at in '[[0.3, 0.1, 0.14]]' '[[0.3, 0.1, 0.14], [0.3, 0.1, 0.14], [0.3, 0.1, 0.14]]' '[[0.3, 0.05, 0.14], [0.3, 0.1, 0.14], [0.3, 0.15, 0.14]]'; do
    expect 2 "$FLOE" run deck/patch.yaml --set bodies.skin.membrane.surface="{points: {at: $at, area: 0.001}}" -o few --quiet
    has stderr 'make no surface: they are too few, or on one line'
done

# Few points of a membrane that is taut from the start let its strain creep, and are warned of; where the deck does not say there are enough.
taut=(--set bodies.skin.membrane.strain=rate --set bodies.skin.membrane.smoothing=0 --set bodies.skin.membrane.slack=-0.1)
expect 0 "$FLOE" check "$circle" --coupling ice-mpm "${taut[@]}" --set bodies.skin.membrane.number=30
has stderr "membrane 'skin' is taut at the start and has 3.8 points a cell"
for enough in bodies.skin.membrane.number=null bodies.skin.membrane.slack=0; do
    expect 0 "$FLOE" check "$circle" --coupling ice-mpm "${taut[@]}" --set bodies.skin.membrane.number=30 --set "$enough"
    ! grep -q 'is taut at the start' stderr || fault "it warns of a membrane that does not creep: $enough"
done
