#!/usr/bin/env bash
# Normals to unconnected points: what the tables of Sulsky and York 2000 must come out as (bench_surface_normals), and a membrane by each method
# that a deck can name.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

tables=$(dirname "$FLOE")/bench/bench_surface_normals
[ -x "$tables" ] || exit 0 # built without benchmarks

# table NAME: its rows, without the head, in ./NAME.
table() {
    "$tables" "$1" >"$1.csv"
    sed 1d "$1.csv" >"$1"
}
# every NAME COLUMN LIMIT: no row is beyond.
every() {
    awk -F, -v c="$2" -v most="$3" '!($c + 0 < most) { bad = 1; print } END { exit bad }' "$1" || fault "$1: above $3"
}

# Tables I and II: exact for every slope, number of points and point off the line; conditions of the published order.
table lines
[ "$(wc -l <lines)" = 30 ] || fault 'other lines'
every lines 6 1e-9
every lines 5 7e3

# Table III, to the last digit that is published, but for the root mean squares, where the paper has the norm over N.
table circle
cut -d, -f1,2,4 circle | diff - <(printf '%s\n' 3,0.1211,0.0571 4,0.1091,0.0434 8,0.1177,0.0231 16,0.1261,0.0141 \
    32,0.1308,0.0092) || fault 'not table III'

# Figures 7, 9 and 11: 6 and 34 degrees by linear splines; with enough points quadratic ones have the circle, the plane and the sphere.
table arcs
awk -F, '$1 == "a" && $3 == 1 { if (!($6 > 5 && $6 < 7)) exit 1 } $1 == "b" && $3 == 1 { if (!($6 > 33 && $6 < 35)) exit 1 }
    $1 == "d" && $4 == "QR" { if (!($7 < 1e-9)) exit 1 }' arcs || fault 'not figures 7 and 9'
table space
awk -F, '($1 == "plane" || $3 == 2) && !($7 < 1e-9) { exit 1 }' space || fault 'not figures 5 and 11'

# Figure 10: the reading that comes nearest, whatever point off the curve is drawn; and what is gained over it where there are points enough.
"${tables%normals}cubic" readings | awk -F, '$1 == "nearest" { n++
    for (c = 6; c <= 8; c++) if (!($c > 0.5 && $c < 1.5) || !($(c + 5) > 31.5 && $(c + 5) < 32.5)) exit 1
    if (!($14 > 4.5 && $14 < 5.5)) exit 1 } END { exit n != 1 }' || fault 'not figure 10'
"${tables%normals}cubic" points_cubic | awk -F, '$2 == 24 { n++; if (!($9 < 0.2)) exit 1 } END { exit n != 2 }' || fault 'quadric errs on the cubic'

# One axis: the normal has length one; without the point off it the solution of least norm has no gradient in the middle of the cell.
table line
grep -c 'normal [-+]1)' line | diff - <(echo 6) || fault 'no unit normals'
awk -F, '$1 == 0.5 && $4 != 0 { exit 1 }' line || fault 'a gradient from one point'

# Sets that break linear splines alone.
table degenerate
awk -F, '/^(on a|one of them 1e-8|two points)/ { for (c = 3; c <= 6; c++) if (!($c < 1e-3)) exit 1 }
    /^one point/ { for (c = 3; c <= 6; c++) if ($c != "none") exit 1 }' degenerate || fault 'degenerate sets'

# The dog-bone's exact contour: the polynomial through the nearest points errs less than the connections, at all four meshes; on the
# exact circle both err by round-off alone.
table dogbone
awk -F, '$3 == "connectivity" { most[$1] = $4; rms[$1] = $5 }
    $3 == "quadric" { n++; if (!($4 <= most[$1] && $5 <= rms[$1] && $6 < 1e-10)) exit 1 } END { exit n != 4 }' dogbone ||
    fault 'the contour of the dog-bone'

# Whoever lists them can run them.
"$FLOE" list normals | sed -n '/membrane.normals/,$s/^  \([a-z_]*\): .*/\1/p' >names
[ "$(wc -l <names)" -ge 8 ] || fault 'few ways to make normals'
while read -r name; do
    "$FLOE" run "$FLOE_SOURCE/inputs/membrane_circle.yaml" --set "bodies.skin.membrane.normals=$name" --set time.max_steps=20 \
        -o "out-$name" --quiet </dev/null || fault "no run with $name"
    if [ "$name" != connectivity ]; then has "out-$name/summary.json" '"mpm_membrane_normals":'; fi
done <names
"$FLOE" plan "$FLOE_SOURCE/inputs/membrane_circle.yaml" --json >plan.json
if grep -q P_NORMAL plan.json; then fault 'connections hold normals'; fi
if grep -q mpm_membrane_normals out-connectivity/summary.json; then fault 'connections pay for normals'; fi
expect 2 "$FLOE" run "$FLOE_SOURCE/inputs/membrane_circle.yaml" --set bodies.skin.membrane.normals=nearest
has stderr "unknown way to make normals 'nearest'"
