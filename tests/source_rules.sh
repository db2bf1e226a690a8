#!/usr/bin/env bash
# Rules of the source that no compiler checks: no include that climbs out of its room, no file too long to hold in
# the head, each third-party library only in its rooms, and a picture of every deck in the docs.
set -u
cd "${1:?usage: source_rules.sh SOURCE_DIRECTORY}" || exit 2
failed=0

# complain TEXT LINES: prints both if there are lines.
complain() {
    [ -z "$2" ] && return
    printf '%s:\n%s\n' "$1" "$2"
    failed=1
}

# only_in PATTERN ROOMS...: the include may occur in these rooms only.
only_in() {
    local pattern=$1 allowed
    shift
    allowed=$(printf '|^src/%s/' "$@")
    complain "#include <$pattern...> belongs to: $*" \
        "$(grep -rnE "#include <$pattern" src | grep -vE "${allowed#|}")"
}

complain 'an include must name its room, not climb ("room/x.h")' "$(grep -rnE '#include "\.\./' src include tests bench)"
complain 'more than 700 lines: split the file' \
    "$(find src include -name '*.[ch]' -exec awk 'END { if (NR > 700) print FILENAME ": " NR }' {} \;)"
complain 'compilers are known to src/base/compiler.h and floe.h, threads to src/base/threads.c: no #if or attribute elsewhere' \
    "$(grep -rnE '#( *)if|__attribute__|__builtin_' src include bench --include='*.[ch]' | grep -vE '#ifndef [A-Z0-9_]+_H$' |
        grep -vE '^(src/base/(compiler\.h|threads\.c)|include/floe/floe\.h):')"
only_in 'gsl/' coupling surface verify study
only_in 'sunlinsol/sunlinsol_pcg' solve
only_in '(sundials|nvector|sunlinsol|sunmatrix|sunnonlinsol|kinsol|cvode|arkode)/' coupling verify solve
only_in 'hdf5' io
only_in 'cairo' draw
only_in '(libfyaml|udunits)' deck
only_in 'jansson' io batch study report cli
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
exit $failed
