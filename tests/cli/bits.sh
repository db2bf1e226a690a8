#!/usr/bin/env bash
# A page of other sources than those that lie here is fresh where its decks give the same bits under both, by records (scripts/same_bits.py record): on a
# tree of its own, whose program answers by what its sources say.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
export PYTHONDONTWRITEBYTECODE=1
"$python" -c 'import sys, h5py; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || {
    echo 'skipped: no Python 3.11 or later with h5py'
    exit 77
}

from=$FLOE_SOURCE
tree=$work/tree
export FLOE=$tree/floe FLOE_SOURCE=$tree
mkdir -p "$tree"/{src/{mpm,ice,sim},include,cmake,inputs,scripts/{lib,results},python,docs/results,runs/both}
cd "$tree"
git init -q . && git config user.email a@b && git config user.name a
echo 'ice gives 1' >src/ice/ice.c
echo 'mpm gives 1' >src/mpm/mpm.c
echo 'sim gives 1' >src/sim/sim.c
echo 'project(x)' >CMakeLists.txt
printf 'runs_as: [ice]\ntime: {end: 1}\n' >inputs/tube.yaml
printf 'runs_as: [mpm, ice-mpm]\nmethod: {basis: cubic}\n' >inputs/bar_mms.yaml
printf 'runs_as: [mpm]\n' >inputs/long.yaml
mkdir -p tests/verification
echo 'int x;' >tests/verification/test_x.c
printf '#!/bin/sh\ncat "%s/src/mpm/x.h" 2>/dev/null\necho 1\n' "$tree" >tests/verification_x
chmod +x tests/verification_x
echo 'print(1)' >scripts/results/tube.py
cp scripts/results/tube.py scripts/results/test.py
cp scripts/results/tube.py scripts/results/bar.py
cp scripts/results/tube.py scripts/results/bases.py
cp scripts/results/tube.py scripts/results/cases.py
cp scripts/results/tube.py scripts/results/odd.py
cp scripts/results/tube.py scripts/results/long.py
echo '# none' >scripts/results/unstamped.txt
echo '  "coupling": "ice-mpm",' >runs/both/summary.json
# The program: what it gives is what its sources say, of the coupling and of the basis; a run of long.yaml makes no step. It is asked hundreds of
# times, and starts no other programs but for its folder.
cat >floe <<END
#!/usr/bin/env bash
tree=$tree
END
cat >>floe <<'END'
case $1 in
--version)
    compiler=12
    [ ! -f "$tree/compiler" ] || read -r compiler <"$tree/compiler"
    printf 'floe 0.1 (%s)\nGNU %s\n' "$(git -C "$tree" rev-parse --short=12 HEAD)" "$compiler"
    exit
    ;;
esac
said='' folder=''
gives() { # FILE...: what stands behind `gives` in each
    local line file
    for file in "$@"; do
        while read -r line; do [[ $line != *' gives '* ]] || said+="${line#* gives } "; done <"$file"
    done
}
gives "$tree"/src/sim/*.c
words=("$@")
for ((i = 0; i < $#; i++)); do
    case ${words[i]} in
    -o) folder=${words[i + 1]} ;;
    ice) gives "$tree"/src/ice/*.c ;;
    mpm) gives "$tree"/src/mpm/*.c ;;
    ice-mpm) gives "$tree"/src/{ice,mpm}/*.c ;;
    method.basis=linear) [ ! -f "$tree/src/mpm/linear.h" ] || said+=$(<"$tree/src/mpm/linear.h") ;;
    esac
done
mkdir -p "$folder"
orders=''
[ ! -f "$tree/src/sim/orders.h" ] || read -r orders <"$tree/src/sim/orders.h"
[ "$1" = run ] || { printf 'h,errors,cpu_seconds (s)\n1,%s,%s\n' "$orders" $RANDOM >"$folder/$1.csv"; exit; }
steps=3
case $* in *long.yaml*) steps=0 ;; esac
printf 'time (s),mass\n0,%s\n' "$said" >"$folder/history.csv"
printf '{"coupling": "x", "steps": %s, "wall_seconds": %s, "errors": {}}\n' $steps $RANDOM >"$folder/summary.json"
END
chmod +x floe
git add -A && git commit -qm one
# page NAME COMMAND: makes a page by the program of the last commit.
page() {
    {
        printf '# Page\n\n## How\n\n    floe %s\n\n' "$2"
        echo "    floe $2" | "$python" "$from/scripts/lib/stamp.py" line "$1" runs/both "${@:3}"
    } >"docs/results/$1.md"
}
record() {
    expect 0 "$python" "$from/scripts/same_bits.py" record
}
says() {
    expect 0 "$python" "$from/scripts/lib/stamp.py" stale
    has stdout "$1"
}
page tube 'run inputs/tube.yaml --set time.end=2'
page bar 'run inputs/bar_mms.yaml'
page bases 'run inputs/bar_mms.yaml --set method.basis=linear'
page cases 'study inputs/bar_mms.yaml'
page odd 'run inputs/bar_mms.yaml --set method.odd=1'
page test 'run inputs/tube.yaml' tests/verification/test_x.c
page long 'run inputs/long.yaml'
record
has stdout 'long.yaml mpm: not run: no steps'
git add -A && git commit -qm two
says '7 pages: 7 fresh, 0 stale, 0 faulty'

# Code that moves changes no bit: pages of runs that are recorded are fresh once those that lie here are, but for what the record cannot show.
git mv src/sim/sim.c src/sim/step.c
git commit -qm moved
says 'stale: bar: other sources, no record of bits of those that lie here'
record
has stdout '2 records'
says 'stale: long: other sources: inputs/long.yaml mpm was not run'
has stdout 'stale: odd: other sources: no recorded run sets odd'
has stdout '7 pages: 5 fresh, 2 stale, 0 faulty'
[ "$(git status --porcelain -uall docs/results/bits | sed 's/^...//' | xargs cat | wc -c)" -lt 2000 ] || fault 'a record that differs in nothing is long'
git add -A && git commit -qm recorded

# now_gives FILE TEXT FRESH WHY...: with that in a source, recorded, so many pages are fresh, the others for these reasons.
now_gives() {
    local file=$1 fresh=$3
    echo "$2" >"$file"
    git add -A && git commit -qm change
    record
    says "$fresh fresh"
    for why in "${@:4}"; do has stdout "$why"; done
    git reset -q --hard HEAD~1
    git clean -qfd
}
now_gives src/ice/ice.c 'ice gives 2' 0 'stale: tube: other sources: other bits of inputs/tube.yaml ice' 'stale: bar: other sources: other bits of inputs/bar_mms.yaml ice-mpm'
now_gives src/mpm/mpm.c 'mpm gives 2' 2 'stale: bar: other sources: other bits of inputs/bar_mms.yaml ice-mpm; other bits of inputs/bar_mms.yaml mpm'
now_gives src/mpm/linear.h 'of another shape' 4 'stale: bases: other sources: other bits of inputs/bar_mms.yaml mpm method.basis=linear'
now_gives src/sim/orders.h '7' 4 'stale: cases: other sources: other bits of study inputs/bar_mms.yaml'
now_gives src/mpm/x.h 2 4 'stale: test: other sources: other bits of test tests/verification/test_x.c'
git mv src/sim/step.c src/sim/steps.c
echo 13 >compiler
git add -A && git commit -qm compiler
record
has stdout '2 records'
says '5 fresh'

# now by another compiler that gives other bits
echo 'mpm gives 2' >src/mpm/mpm.c
git add -A && git commit -qm 'another compiler, other bits'
record
says 'stale: bar: other sources: recorded by another compiler, on another machine or in other steps; other bits of inputs/bar_mms.yaml ice-mpm'
git reset -q --hard HEAD~2
git clean -qfd

# A deck that changes makes its pages stale whatever is recorded of it.
printf 'runs_as: [ice]\ntime: {end: 2}\n' >inputs/tube.yaml
record
says 'stale: tube: other sources: inputs/tube.yaml ice is not recorded for both, decks'
