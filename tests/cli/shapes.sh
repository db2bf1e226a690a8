#!/usr/bin/env bash
# Shapes of shapes, polygons and surfaces from files as whole runs have them: gas at rest about each keeps still beside a sharp interface; what is the same shape in
# other words has the same result; loads, supports and bodies that yield take them; errors have their place.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

deck=$FLOE_SOURCE/tests/cli/decks/shapes.yaml

# last FILE COLUMN: of a column of history.csv.
last() {
    awk -F, -v name="$2" 'NR == 1 { for (i = 1; i <= NF; i++) { split($i, word, " "); if (word[1] == name) c = i }; next } { v = $c } END { print v }' "$1"
}

# still SHAPE WORDS...: the gas about it has no motion, nor has it.
still() {
    local shape=$1
    shift
    expect 0 "$FLOE" run "$deck" -o still --quiet --set "bodies.body.shape={$shape}" "$@"
    [ "$(json still/summary.json interface)" = 'auto: sharp' ] || fault "$shape is not sharp"
    below "$(last still/history.csv kinetic)" 1e-20
    below "$(json still/summary.json mass)" 1e-13
}

l='polygon: {vertices: [[0.2, 0.2], [0.8, 0.2], [0.8, 0.4], [0.4, 0.4], [0.4, 0.8], [0.2, 0.8]]}'
star="polygon: {vertices: [$(awk 'BEGIN { pi = atan2(0, -1)
    for (k = 0; k < 16; k++) { r = k % 2 ? 0.281 : 0.36; printf "%s[%.6f, %.6f]", k ? ", " : "", 0.503 + r * cos(0.1 + pi * k / 8), 0.507 + r * sin(0.1 + pi * k / 8) } }')]}"
about_axis=(--set domain.geometry=axisymmetric)
for shape in "$l" "$star"; do
    still "$shape"
    still "$shape" "${about_axis[@]}"
done
still 'union: [{box: {lower: [0.2, 0.2], upper: [0.8, 0.4]}}, {box: {lower: [0.2, 0.4], upper: [0.4, 0.8]}}]'
still 'difference: {of: {box: {lower: [0.2, 0.2], upper: [0.8, 0.8]}}, without: [{box: {lower: [0.4, 0.4], upper: [0.8, 0.8]}}]}'
still 'moved: {turned: 0.4, about: [0.5, 0.5], of: {difference: {of: {ellipsoid: {centre: [0.5, 0.5], radii: [0.35, 0.25]}}, without: [{ball: {centre: [0.5, 0.5], radius: 0.12}}]}}}'
still 'union: [{box: {lower: 0.2, upper: 0.32}}, {box: {lower: 0.6, upper: 0.77}}]' --set 'domain={dim: 1, lower: 0, upper: 1, cell: 0.05}'
space=(--set 'domain={dim: 3, lower: [0, 0, 0], upper: [1, 1, 1], cell: 0.125}' --set time.max_steps=4)
still "moved: {by: [0, 0, 0.03], of: {extruded: {from: 0.2, to: 0.8, of: {$l}}}}" "${space[@]}"
still 'revolved: {centre: [0.5, 0.5, 0], of: {polygon: {vertices: [[0, 0.2], [0.37, 0.2], [0.37, 0.51], [0, 0.82]]}}}' "${space[@]}"
still 'difference: {of: {box: {lower: [0.1, 0.1, 0.1], upper: [0.9, 0.9, 0.9]}}, without: [{box: {lower: [0.3, 0.3, 0.3], upper: [0.7, 0.7, 0.9]}}]}' "${space[@]}"

# A ball of triangles, in millimetres, beside the deck; the resolved deck finds it from anywhere.
mkdir deck
cp "$deck" deck/deck.yaml
awk 'function vertex(i, j) { i %= 12; return sprintf("vertex %.6f %.6f %.6f\n", 300 * sin(pi * j / 6) * cos(pi * i / 6) * (j % 6 != 0), 300 * sin(pi * j / 6) * sin(pi * i / 6) * (j % 6 != 0), 300 * cos(pi * j / 6)) }
    function facet(a, b, c) { if (a != b && b != c && c != a) printf "facet normal 0 0 0\nouter loop\n%s%s%sendloop\nendfacet\n", a, b, c }
    BEGIN { pi = atan2(0, -1); print "solid ball"
            for (i = 0; i < 12; i++) for (j = 0; j < 6; j++) { facet(vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1)); facet(vertex(i, j), vertex(i + 1, j + 1), vertex(i + 1, j)) }
            print "endsolid ball" }' >deck/ball.stl
own_deck=$deck
deck=deck/deck.yaml
still 'stl: {file: ball.stl, scale: 1 mm, shift: [0.5, 0.51, 0.49]}' "${space[@]}"
deck=$own_deck
expect 0 "$FLOE" run still/deck.yaml -o anew --quiet
cmp still/history.csv anew/history.csv || fault 'the resolved deck has another ball'
sed '0,/endfacet/d' deck/ball.stl | sed '1i solid ball' >deck/open.stl
expect 2 "$FLOE" check deck/deck.yaml "${space[@]}" --set 'bodies.body.shape={stl: {file: open.stl}}'
has stderr "open.stl': it is open at the side from ("
expect 2 "$FLOE" check deck/deck.yaml "${space[@]}" --set 'bodies.body.shape={stl: {file: none.stl}}'
has stderr "deck/none.stl': No such file or directory"

# The same square in other words: a manufactured vibration along both axes has the same errors.
square() {
    expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/bar_mms.yaml" -o square --quiet --set domain='{dim: 2, lower: [0, 0], upper: [1, 1], cell: 0.125}' --set boundaries=symmetry \
        --set verify.exact.bar_mms.axis=3 --set "bodies.bar.shape={$1}"
    sed -n '/"errors"/,/}/p' square/summary.json
}
square 'box: {lower: [0, 0], upper: [1, 1]}' >box
is_there box
for shape in 'polygon: {vertices: [[1, 0], [1, 1], [0, 1], [0, 0]]}' 'union: [{box: {lower: [0, 0], upper: [0.4, 1]}}, {box: {lower: [0.4, 0], upper: [1, 1]}}]' \
    'intersection: [{box: {lower: [0, -1], upper: [1, 1]}}, {halfspace: {point: [0, 0], normal: [0, -1]}}]' 'moved: {by: [1, 0], turned: 90 degree, of: {box: {lower: [0, 0], upper: [1, 1]}}}'; do
    square "$shape" >other
    cmp box other || fault "$shape has other errors than the box"
done

# A ring without its hole is a ring: Lame's cylinder, and its bore filled with what is left of a square.
ring=("$cylinder" --quiet --coupling mpm --set domain.cell=0.1 --set time.max_steps=50)
expect 0 "$FLOE" run "${ring[@]}" -o ring
expect 0 "$FLOE" run "${ring[@]}" -o without --set 'bodies.cylinder.shape={difference: {of: {ball: {radius: 1}}, without: [{ball: {radius: 0.5}}]}}'
cmp ring/history.csv without/history.csv || fault 'a ball without another is no annulus'

# Regions of loads and of supports, and bodies that yield.
cat >plate.yaml <<'END'
floe: 1
coupling: mpm
domain: {dim: 2, lower: [0, 0], upper: [1, 1], cell: 0.05}
boundaries: free
materials:
  rubber: {density: 1000, law: {neo_hookean: {bulk_modulus: 1 MPa, shear_modulus: 0.4 MPa}}}
bodies:
  plate: {material: rubber, shape: {box: {lower: [0.1, 0.1], upper: [0.9, 0.6]}}, yields: true}
  core: {material: rubber, shape: {ball: {centre: [0.5, 0.35], radius: 0.1}}}
loads:
  push: {traction: {body: plate, surface: {box: {lower: [0.1, 0.55], upper: [0.9, 0.65]}}, pressure: 1 kPa}}
supports:
  foot: {region: {box: {lower: [0, 0], upper: [1, 0.2]}}}
time: {end: 1, max_steps: 40}
output: {interval: 1, history_interval: 1e-3}
END
expect 0 "$FLOE" run plate.yaml -o plate --quiet
expect 0 "$FLOE" run plate.yaml -o words --quiet \
    --set 'loads.push.traction.surface={union: [{box: {lower: [0.1, 0.55], upper: [0.5, 0.65]}}, {box: {lower: [0.5, 0.55], upper: [0.9, 0.65]}}]}' \
    --set 'supports.foot.region={polygon: {vertices: [[0, 0], [1, 0], [1, 0.2], [0, 0.2]]}}' --set 'bodies.core.shape={intersection: [{ball: {centre: [0.5, 0.35], radius: 0.1}}]}'

cmp plate/history.csv words/history.csv || fault 'regions in other words have another result'
is_there plate/history.csv

# The resolved deck runs again to the same bits, and is looked at.
expect 0 "$FLOE" run words/deck.yaml -o again --quiet
cmp words/history.csv again/history.csv || fault 'the resolved deck is another'
if python_is_whole; then
    expect 0 env FLOE_PYTHON="$python" "$FLOE" picture words -o words.png
    is_there words.png
fi

# Places of errors.
expect 2 "$FLOE" check "$deck" --set 'bodies.body.shape={polygon: {vertices: [[0, 0], [1, 1], [1, 0], [0, 1]]}}'
has stderr 'meets side 3, from (1, 0) to (0, 1), at (0.5, 0.5)'
expect 0 "$FLOE" check "$deck" --set 'bodies.body.shape={polygon: {vertices: [[0.2, 0.2], [0.8, 0.2], [0.5, 0.8]]}}'
has stderr 'thinner than a cell'
