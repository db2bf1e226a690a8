#!/usr/bin/env bash
# Two hundred plausible mistakes in ten classes: half of them written down (tests/mistakes/list.txt), half made from the
# schema by a seed (FLOE_SEED). Each is refused or warned of with its place and what is wrong; none is silent, and no
# signal ends floe.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
seed=${FLOE_SEED:-17}
echo "seed $seed (FLOE_SEED)"
failed=0 total=0

# mistake CLASS DECK SETTINGS WORDS: `check` says the words, by status 2, or by a warning.
mistake() {
    local class=$1 deck=$FLOE_SOURCE/tests/mistakes/$2.yaml words=$4 status=0 arguments=() one
    local IFS=';'
    for one in $3; do arguments+=(--set "$one"); done
    total=$((total + 1))
    "$FLOE" check "$deck" "${arguments[@]}" >stdout 2>stderr || status=$?
    if [ "$status" -ne 2 ] && { [ "$status" -ne 0 ] || ! grep -q 'warning:' stderr; }; then
        echo "$class: $2, $3: status $status without a word"
    elif ! grep -qiF -- "$words" stderr; then
        echo "$class: $2, $3: '$words' is not said: $(head -c 300 stderr)"
    elif ! grep -qE -- '--set |\.yaml:[0-9]+:[0-9]+' stderr; then
        echo "$class: $2, $3: no place: $(head -c 300 stderr)"
    else
        return 0
    fi
    failed=$((failed + 1))
}

# The decks themselves are without a fault.
for deck in solid gas; do
    expect 0 "$FLOE" check "$FLOE_SOURCE/tests/mistakes/$deck.yaml"
    if grep -q 'warning:' stderr; then fault "a warning without a cause: $(cat stderr)"; fi
done

while IFS='|' read -r class deck settings words; do
    case $class in '#'* | '') continue ;; esac
    trim() { sed -E 's/^ +//; s/ +$//' <<<"$1"; }
    mistake "$(trim "$class")" "$(trim "$deck")" "$(trim "$settings")" "$(trim "$words")"
done <"$FLOE_SOURCE/tests/mistakes/list.txt"

# Made from the schema: its keys with a letter lost, in the map of a class; and values of another kind.
"$FLOE" new --schema >schema.json
sed -nE 's/^ *"([a-z_]{5,})": \{.*/\1/p' schema.json | sort -u >names
[ "$(wc -l <names)" -gt 60 ] || fault 'the schema has hardly any names'
awk -v seed="$seed" '
    BEGIN {
        srand(seed)
        n = split("units solid materials.steel|geometry solid bodies.ring.shape.annulus|sides gas boundaries.x.lower|" \
                  "materials gas materials.air|keys solid bodies.ring|coupling solid loads.bore|time solid time|" \
                  "output solid output|method gas method|range gas ambient", class, "|")
        split("materials.steel.density bodies.ring.shape.annulus.outer_radius boundaries.x materials.air.eos.ideal.gamma " \
              "bodies.ring.points loads.bore.traction.pressure time.end output.interval method.flip ambient.temperature",
              key, " ")
        split("[1, 2, 3, 4, 5]|{mistaken: 1}|none at all|-1e300 m|1 kelvin second", value, "|")
    }
    { name[NR] = $1 }
    END {
        for (c = 1; c <= n; c++) {
            split(class[c], part, " ")
            for (k = 1; k <= 5; k++) {
                do {
                    word = name[1 + int(rand() * NR)]
                    cut = 2 + int(rand() * (length(word) - 2))
                    wrong = substr(word, 1, cut - 1) substr(word, cut + 1)
                    known = 0
                    for (i = 1; i <= NR; i++) known = known || name[i] == wrong
                } while (known)
                print part[1] "|" part[2] "|" part[3] "." wrong "=1"
                print part[1] "|" part[2] "|" key[c] "=" value[k]
            }
        }
    }' names >made
while IFS='|' read -r class deck settings; do mistake "$class" "$deck" "$settings" 'error:'; done <made

echo "$total mistakes, $failed without their word"
[ "$total" -eq 200 ] || fault 'not two hundred'
[ "$failed" -eq 0 ] || fault "$failed of $total"
