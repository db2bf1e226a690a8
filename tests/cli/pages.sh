#!/usr/bin/env bash
# The pages of docs/results say what they were made from: stale ones are listed here (scripts/results.sh stale --strict fails on them); none has
# a stamp that cannot be read or is of other sources than its program's, none lacks a command. And the rules of stamps, on a tree of its own.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
export PYTHONDONTWRITEBYTECODE=1
"$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || {
    echo 'skipped: no Python 3.11 or later'
    exit 77
}

expect 0 "$python" "$FLOE_SOURCE/scripts/lib/stamp.py" stale
cat stdout

# A tree with two pages, one of cells alone, one of cells and points.
tree=$work/tree
mkdir -p "$tree"/{src/{mpm,ice,sim,plot},include,cmake,inputs,scripts/{lib,results},python,docs/results,runs/ice,runs/both}
cd "$tree"
git init -q . && git config user.email a@b && git config user.name a
echo 'int ice(void) { return 1; }' >src/ice/ice.c
echo 'int mpm(void) { return 1; }' >src/mpm/mpm.c
echo 'int sim(void) { return 1; }' >src/sim/sim.c
echo 'int page(void) { return 1; }' >src/plot/page.c
echo 'project(x) # a name' >CMakeLists.txt
echo 'time: {end: 1}' >inputs/a.yaml
printf 'import lib\nlib.used()\n' >scripts/results/one.py
printf 'def used():\n    """Says one."""\n    return 1\n\n\ndef other():\n    return 2\n' >scripts/lib/lib.py
printf 'print(2)\n' >scripts/results/two.py
echo old >scripts/results/unstamped.txt
echo '# Old' >docs/results/old.md
echo '  "coupling": "ice",' >runs/ice/summary.json
echo '  "coupling": "ice-mpm",' >runs/both/summary.json
git add -A && git commit -qm one
# stamp_now NAME RUNS: makes the page again, by a program of the last commit.
stamp_now() {
    printf '#!/bin/sh\necho "floe 0.1 (%s)"\n' "$(git rev-parse --short=12 HEAD)${suffix:-}" >floe
    chmod +x floe
    {
        echo "# Page $1"
        echo
        echo '    floe run inputs/a.yaml' | FLOE=./floe FLOE_SOURCE=$tree "$python" "$FLOE_SOURCE/scripts/lib/stamp.py" line "$1" "runs/$2"
    } >"docs/results/$1.md"
}
# says STATUS TEXT [OPTION]: what `stale` says of the tree's pages.
says() {
    FLOE_SOURCE=$tree expect "$1" "$python" "$FLOE_SOURCE/scripts/lib/stamp.py" stale "${@:3}"
    has stdout "$2"
}
stamp_now one ice
stamp_now two both
has docs/results/one.md 'without mpm plot'
has docs/results/two.md 'without plot'
says 0 '3 pages: 2 fresh, 1 stale, 0 faulty'
says 1 'stale: old: no stamp' --strict

# What cannot change a figure makes nothing stale: comments, blanks, docstrings, definitions that are not reached, modules that are not entered.
printf '/* Returns one. */\nint ice(void)   { // always\n\n    return 1; }\n' >src/ice/ice.c
echo 'int page(void) { return 2; }' >src/plot/page.c
printf '# A deck.\n\ntime: {end: 1} # s\n' >inputs/a.yaml
printf 'import lib\n# Calls it.\nlib.used()\n' >scripts/results/one.py
printf 'def used():\n    """Says 1."""\n    return 1\n\n\ndef other():\n    return 3\n' >scripts/lib/lib.py
printf '# Says it.\n\nprint(  2 )\n' >scripts/results/two.py
says 0 '2 fresh, 1 stale'

# What can, does: each alone.
# changed FILE TEXT PAGE WHY FRESH: with that text in the file the page is stale for that, and so many are fresh.
changed() {
    cp "$1" kept
    printf '%s\n' "$2" >"$1"
    says 1 "stale: $3: other $4" --strict
    has stdout "$5 fresh"
    mv kept "$1"
}
changed src/mpm/mpm.c 'int mpm(void) { return 2; }' two sources 1
changed src/ice/ice.c 'int ice(void) { return 2; }' one sources 0
changed src/sim/sim.c 'const char *sim = "/* 1 */";' two sources 0
changed CMakeLists.txt 'project(y)' one sources 0
changed inputs/a.yaml 'time: {end: 2}' one decks 0
changed scripts/lib/lib.py 'def used(): return 4' one script 1
changed scripts/results/two.py 'print(3)' two script 1
says 0 '2 fresh'

# What no page may be.
git commit -qam two
# faulty PAGE WHY: it is, and then as before.
faulty() {
    says 1 "faulty: $1: $2"
    git checkout -q . 2>/dev/null
}
stamp_now one ice
stamp_now two both
git add -A && git commit -qm three
says 0 '2 fresh, 1 stale, 0 faulty'
sed -i '/^\*Made/d' docs/results/one.md
faulty one 'no stamp'
sed -i 's/decks ....//' docs/results/one.md
faulty one 'no stamp, or none that can be read'
echo '# New' >docs/results/new.md
says 1 'faulty: new: no command makes it'
rm docs/results/new.md
rm scripts/results/two.py
faulty two 'no command makes it'
echo one >>scripts/results/unstamped.txt
faulty one 'has a stamp'
echo none >>scripts/results/unstamped.txt
faulty none 'on scripts/results/unstamped.txt, and there is no such page'
suffix=-modified
echo 'int mpm(void) { return 3; }' >src/mpm/mpm.c
stamp_now two both
has docs/results/two.md '-modified without'
faulty two 'made by a program of other sources than it names'
# A program that was built of other sources than lie there now, without a word of its own.
suffix=
echo 'int mpm(void) { return 3; }' >src/mpm/mpm.c
stamp_now two both
stamp_now one ice
has docs/results/one.md 'without mpm'
faulty two 'made by a program of other sources than it names'
