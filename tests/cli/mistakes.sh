#!/usr/bin/env bash
# Plausible mistakes: those written down (tests/mistakes/list.txt), in ten classes; fifty made from the schema by a seed (FLOE_SEED), and fifty numbers that
# slips of units or sign leave, drawn from tests/mistakes/slips.txt; a hundred of each at length (FLOE_EVERY), which makes more than three hundred. Each
# is refused or warned of with its place, what is wrong and what to do; none is silent, and no signal ends floe. `run` judges those of the list as `check` does.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
seed=${FLOE_SEED:-17} of_each=${FLOE_EVERY:+100}
of_each=${of_each:-50}
echo "seed $seed (FLOE_SEED)"
failed=0 total=0 checked=0
# What to do: to give, take or say something else, what would do, or a question about what was meant.
remedy='[Gg]ive |[Tt]ake |[Ss]ay |[Tt]urn |[Ll]eave |[Nn]ame |[Uu]se |expected:|hint:|or |needs |must |instead|is meant|[Aa]re |\?'

# has_remedy TEXT: a line that is no table says what to do.
has_remedy() {
    local line IFS=$'\n'
    for line in $1; do
        if [[ $line =~ error:|warning:|expected:|hint: && $line =~ $remedy ]]; then return 0; fi
    done
    return 1
}

# mistake CLASS DECK SETTINGS WORDS: `check` says the words, by status 2, or by a warning.
mistake() {
    local class=$1 deck=$FLOE_SOURCE/tests/mistakes/$2.yaml words=${4,,} status=0 arguments=() one said
    local IFS=';'
    for one in $3; do arguments+=(--set "$one"); done
    total=$((total + 1))
    "$FLOE" check "$deck" "${arguments[@]}" >stdout 2>stderr || status=$?
    checked=$status
    IFS= read -r -d '' said <stderr || true # no more processes than floe's own: there are three hundred
    if [ "$status" -ne 2 ] && { [ "$status" -ne 0 ] || [[ $said != *warning:* ]]; }; then
        echo "$class: $2, $3: status $status without a word"
    elif [[ ${said,,} != *"$words"* ]]; then
        echo "$class: $2, $3: '$4' is not said: ${said:0:300}"
    elif ! [[ $said =~ --set\ |\.yaml:[0-9]+:[0-9]+ ]]; then
        echo "$class: $2, $3: no place: ${said:0:300}"
    elif ! has_remedy "$said"; then
        echo "$class: $2, $3: no remedy: ${said:0:300}"
    else
        return 0
    fi
    failed=$((failed + 1))
}

# same_errors FILE FILE: what is said but for warnings.
same_errors() {
    local one=() other=() line
    while IFS= read -r line; do [[ $line == *warning:* ]] || one+=("$line"); done <"$1"
    while IFS= read -r line; do [[ $line == *warning:* ]] || other+=("$line"); done <"$2"
    [ "${one[*]}" = "${other[*]}" ]
}

# run_judges_alike DECK SETTINGS: what `check` has just refused, by `checked` and ./stderr, `run` refuses in the same words, and it refuses nothing else.
run_judges_alike() {
    local ran=0 arguments=() one IFS=';'
    for one in $2; do arguments+=(--set "$one"); done
    "$FLOE" run "$FLOE_SOURCE/tests/mistakes/$1.yaml" "${arguments[@]}" --set time.max_steps=1 --quiet -o ran.out >/dev/null 2>ran || ran=$?
    [ ! -e ran.out ] || rm -rf ran.out
    if [ "$ran" -ne "$checked" ] || { [ "$ran" -ne 0 ] && ! same_errors stderr ran; }; then
        echo "$1, $2: check $checked, run $ran: $(head -c 300 ran)"
        failed=$((failed + 1))
    fi
}

# The decks themselves are without a fault.
for deck in solid gas contact ball static; do
    expect 0 "$FLOE" check "$FLOE_SOURCE/tests/mistakes/$deck.yaml"
    if grep -q 'warning:' stderr; then fault "a warning without a cause: $(cat stderr)"; fi
done

while IFS='|' read -r class deck settings words; do
    case $class in '#'* | '') continue ;; esac
    mistake "$class" "$deck" "$settings" "$words"
    run_judges_alike "$deck" "$settings"
done < <(sed -E 's/^ +//; s/ +$//; s/ *\| */|/g' "$FLOE_SOURCE/tests/mistakes/list.txt")

# Made from the schema: its keys with a letter lost, in the map of a class; and values of another kind.
"$FLOE" new --schema >schema.json
sed -nE 's/^ *"([a-z_]{5,})": \{.*/\1/p' schema.json | grep -vxE 'properties|definitions|items' | sort -u >names
[ "$(wc -l <names)" -gt 60 ] || fault 'the schema has hardly any names'
awk -v seed="$seed" -v of_each="$of_each" '
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
                if (of_each == 100 || k % 2 == c % 2) print part[1] "|" part[2] "|" part[3] "." wrong "=1"
                if (of_each == 100 || k % 2 != c % 2) print part[1] "|" part[2] "|" key[c] "=" value[k]
            }
        }
    }' names >made
while IFS='|' read -r class deck settings; do mistake "$class" "$deck" "$settings" 'error:'; done <made

# Numbers a factor off: a line of the list and one of its factors, drawn by the seed. The product stands where the number stood.
awk -F' *[|] *' -v seed="$seed" -v of_each="$of_each" '
    /^#/ { next }
    {
        n = split($4, factor, " ")
        for (k = 1; k <= n; k++) { all++; deck[all] = $1; key[all] = $2; value[all] = $3; times[all] = factor[k] }
    }
    # Each number of a value, times a factor.
    function product(text, factor, out) {
        while (match(text, /(^|[^A-Za-z0-9_.])[-+]?[0-9.]+(e[-+]?[0-9]+)?/)) {
            word = substr(text, RSTART, RLENGTH)
            first = substr(word, 1, 1) ~ /[-+0-9.]/ ? "" : substr(word, 1, 1)
            out = out substr(text, 1, RSTART - 1) first sprintf("%.9g", substr(word, length(first) + 1) * factor)
            text = substr(text, RSTART + RLENGTH)
        }
        return out text
    }
    END {
        srand(seed)
        for (drawn = 0; drawn < of_each; ) {
            k = 1 + int(rand() * all)
            if (taken[k]++) continue
            drawn++
            print deck[k] "|" key[k] "=" product(value[k], times[k], "")
        }
    }' "$FLOE_SOURCE/tests/mistakes/slips.txt" >slips
while IFS='|' read -r deck settings; do mistake slip "$deck" "$settings" ': '; done <slips

echo "$total mistakes, $failed without their word"
listed=$(grep -vc '^#' "$FLOE_SOURCE/tests/mistakes/list.txt")
[ "$total" -eq $((listed + 2 * of_each)) ] || fault "not $((listed + 2 * of_each))"
[ "$failed" -eq 0 ] || fault "$failed of $total"
