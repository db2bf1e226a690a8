#!/usr/bin/env bash
# Rules of the source that no compiler checks: no include that climbs out of its module, no file too long to hold in
# the head, each third-party library only in its modules, and a picture of every deck in the docs.
set -u
cd "${1:?usage: source_rules.sh SOURCE_DIRECTORY}" || exit 2
failed=0

# complain TEXT LINES: prints both if there are lines.
complain() {
    [ -z "$2" ] && return
    printf '%s:\n%s\n' "$1" "$2"
    failed=1
}

# only_in PATTERN ROOMS...: the include may occur in these modules only.
only_in() {
    local pattern=$1 allowed
    shift
    allowed=$(printf '|^src/%s/' "$@")
    complain "#include <$pattern...> belongs to: $*" \
        "$(grep -rnE "#include <$pattern" src | grep -vE "${allowed#|}")"
}

complain 'an include must name its module, not climb ("module/x.h")' "$(grep -rnE '#include "\.\./' src include tests bench)"
complain 'more than 700 lines: split the file' \
    "$(find src include -name '*.[ch]' -exec awk 'END { if (NR > 700) print FILENAME ": " NR }' {} \;)"
complain 'compilers are known to src/base/compiler.h and floe.h, threads to src/base/threads.c: no #if or attribute elsewhere' \
    "$(grep -rnE '#( *)if|__attribute__|__builtin_' src include bench --include='*.[ch]' | grep -vE '#ifndef [A-Z0-9_]+_H$' |
        grep -vE '^(src/base/(compiler\.h|threads\.c)|include/floe/floe\.h):')"
only_in 'gsl/' coupling expression surface verify library
only_in '(sundials|nvector|sunlinsol|sunmatrix|sunnonlinsol|kinsol|cvode|arkode)/' coupling verify
only_in 'hdf5' io
only_in '(libfyaml|udunits)' deck
only_in 'jansson' base deck io batch plot study library cli
only_in 'openssl/' base
only_in 'argp' cli
complain 'decks without a picture in docs/results/gallery.md (GALLERY_KEEP=1 scripts/results.sh gallery)' \
    "$(for deck in inputs/*.yaml; do
        name=$(basename "$deck" .yaml)
        grep -qF "](gallery-$name.png)" docs/results/gallery.md && [ -f "docs/results/gallery-$name.png" ] || echo "$deck"
    done)"
# "theory 2.3" in a comment is a section of docs/theory, and that names files that are there.
complain 'comments that cite notes outside the repository, or sections that docs/theory does not have' \
    "$({
        sed -nE 's/^##? ([0-9]+(\.[0-9]+)?) .*/has \1/p' docs/theory/*.md
        grep -rnoE '(theory|numerics) [0-9]+(\.[0-9]+)?' src include tests bench --include='*.[ch]' | sed -E 's/^/cites /'
    } | awk '$1 == "has" { has[$2] = 1 } $1 == "cites" && ($2 ~ /numerics$/ || !($3 in has)) { print $2, $3 }')"
complain 'files that docs/theory names and that are not there' \
    "$(grep -ohE '`(src|tests|inputs)/[^`]*`' docs/theory/*.md | tr -d '`' | sort -u | while read -r file; do
        compgen -G "$file" >/dev/null || echo "$file"
    done)"
# Headers of a large module that other modules do not see concern some of its files, not most of them.
complain 'headers inside a module that more than 20 of its files see, directly or through others: one a concern' \
    "$(for module in mpm ice; do # all kernels of ice are written in terms of a view, and its constants are one table
        grep -rnoE "#include \"$module/[^\"]*\"" src | awk -v module="$module" '
            { split($0, at, ":"); sub(/^src\//, "", at[1]); sub(/.*#include "/, ""); sub(/"$/, ""); sees[at[1]] = sees[at[1]] " " $0
              if (at[1] !~ "^" module "/") mark($0, shown) }
            function mark(header, seen,    list, n, i) {
                if (header in seen) return
                seen[header] = 1
                n = split(sees[header], list, " ")
                for (i = 1; i <= n; ++i) mark(list[i], seen)
            }
            END {
                for (header in shown) { delete shown[header]; mark(header, public) }
                for (file in sees) if (file ~ "^" module "/.*[.]c$") {
                    split("", seen)
                    n = split(sees[file], list, " ")
                    for (i = 1; i <= n; ++i) mark(list[i], seen)
                    for (header in seen) ++count[header]
                }
                for (header in count) if (count[header] > 20 && !(header in public) && header !~ /ice_(view|constants).h$/) print "src/" header ": " count[header]
            }'
    done)"
complain 'file names that two folders of src have' "$(find src -name '*.[ch]' -printf '%f\n' | sort | uniq -d)"
# Words that floe once had for itself, where the field has its own: neither they nor names with them as a part come back as identifiers.
private_words='room|rooms|believe|believed|lend|lends|kin|hoops|weigh|weighs|weighing|pool|pools|skin|skins|held|gas_hold|outline|outlines|forget|forgets|custom|believes'
short_names='fill|parse|push|pull|settle|take|follow|cell|weights|reserve|prepare|draw|gather|scatter|add|spread|say|tell|look|walk|judge|note|count|rate|measure|refuse|explain'
# code_of FILES: their lines without comments and texts.
code_of() {
    awk '{
        line = $0; code = ""
        while (line != "") {
            at = index(line, inside ? "*/" : "/*")
            if (!inside) code = code (at ? substr(line, 1, at - 1) : line)
            line = at ? substr(line, at + 2) : ""
            if (at) inside = !inside
        }
        gsub(/"([^"\\]|\\.)*"/, "", code)
        print FILENAME ":" FNR ": " code
    }' "$@"
}
complain 'words of our own for what the field has words for (the table is in the test)' \
    "$(find src -name '*.[ch]' | sort | while read -r file; do code_of "$file"; done |
        grep -E "[^A-Za-z0-9_/.]([a-z0-9]+_)*($private_words)(_[a-z0-9]+)*([^A-Za-z0-9_.]|$)" | grep -v '#include')"
complain 'static functions whose names say nothing in a backtrace' \
    "$(grep -rnE "^static [A-Za-z_0-9 ]*[ *]($short_names)\(" src --include='*.[ch]')"
complain 'static functions of one name in two files of a module: a backtrace must tell them apart' \
    "$(for module in mpm ice coupling embedded; do
        grep -rE '^(static|FLOE_ALWAYS_INLINE) [^={};]*\(' "src/$module" --include='*.[ch]' |
            sed -nE 's/^([^:]+):[^(]*[ *]([A-Za-z_0-9]+)\(.*/\2 \1/p' | sort -u | awk '{ if ($1 == last) print $1 ": " file ", " $2; last = $1; file = $2 }'
    done)"
complain 'tables of docs/structure.md that are not true' "$(python3 scripts/structure.py check)"
exit $failed
