#!/usr/bin/env bash
# floe compare: cases side by side, one or several at a time; a case that diverges is a result.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
scene=("$cylinder" --set coupling=mpm --set 'runs_as=[mpm]')

expect 0 env FLOE_PYTHON="$python" "$FLOE" compare "${scene[@]}" --axis domain.cell=0.2,0.1 -o out
has stdout 'eq13'
has stdout 'order in h, mpm'
is_there out/compare.json out/compare.csv out/errors.json out/errors.csv out/profile.csv out/mpm-0.2/summary.json out/mpm-0.1/summary.json
[ "$(wc -l <out/compare.csv)" -eq 3 ] || fault 'not two cases'
[ "$(json out/compare.json schema)" = 1 ] || fault 'no schema'
has out/compare.json '"orders"'
has out/compare.json '"stderr"'
tr -d ' \n' <out/compare.json | grep -q '"orders":{"mpm":{"eq13":{"order":' || fault 'no order of the only group'
[ "$(head -n 1 out/compare.csv | cut -d, -f1-4)" = 'coupling,domain.cell,h (m),status' ] || fault 'other columns than those of the axes'
tr -d ' \n' <out/errors.json | grep -q '"slopes":\[1.0,2.0\]' || fault 'no slopes for reference'

# Couplings alone: an empty column in the place of an axis.
expect 0 "$FLOE" compare "$FLOE_SOURCE/inputs/sod.yaml" --set compare=null --set output=null --set domain.cell=0.1 --set time.end=0.01 --repeat 0 -o alone --quiet
[ "$(cut -d, -f1-2 alone/compare.csv | tr '\n' ' ')" = 'coupling,case ice,"" mpm,"" ' ] || fault "other columns: $(cut -d, -f1-2 alone/compare.csv)"

if python_is_whole; then
    is_there out/errors.svg out/profile.svg
    for slope in 1 2; do has out/errors.svg ">slope $slope<"; done
fi

# Two at a time: the same numbers.
expect 0 "$FLOE" compare "${scene[@]}" --axis domain.cell=0.2,0.1 -o jobs --jobs 2 --quiet
for case in mpm-0.2 mpm-0.1; do
    same_results "out/$case" "jobs/$case"
done

# Without Python: said in one line, and no failure; the data are there.
expect 6 env FLOE_PYTHON="$work/none" "$FLOE" compare "${scene[@]}" --axis time.fixed_step=1e-5,1e-4 --set domain.cell=0.1 \
    --set time.end=1e-3 -o steps
[ "$(grep -c 'install python3-numpy' stderr)" -eq 1 ] || fault 'not said once what to install'
is_there steps/errors.json steps/errors.csv
[ ! -e steps/errors.svg ] || fault 'a plot without Python'
has stdout 'diverged'
has steps/compare.csv 'diverged'
tail -n 1 stderr | grep -q 'diverged, mpm, time.fixed_step=1e-4: ' || fault 'the case that diverged is not on the last line'

# What the deck's study foresees, as far as a comparison has its axes.
expect 0 "$FLOE" compare "${scene[@]}" --axis time.fixed_step=1e-5,1e-4 --set domain.cell=0.1 --set time.end=1e-3 -o foreseen --quiet \
    --set 'study={axes: {domain.cell: [0.1]}, refuse: [{why: too long, where: {time.fixed_step: 1e-4}}, {why: too fine, where: {domain.cell: 0.1}}]}'

# Times: each case is alone; one of less than 50 ms of processor time is run until 0.5 s are spent, unless it is told otherwise.
expect 0 "$FLOE" compare "${scene[@]}" --axis domain.cell=0.2,0.4 --set time.end=1e-4 -o short
cp stdout warned
# column NAME: its numbers in short/compare.csv.
column() {
    awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) { t = $i; sub(/ \(.*/, "", t); if (t == name) at = i } next } { print $at }' short/compare.csv
}
paste <(column cpu_seconds) <(column timed_runs) <(column scatter) | awk '$1 < 0.05 && !($2 >= 3 && $2 <= 100 && $3 >= 0) { exit 1 }
    { n++ } END { exit n != 2 }' || fault "short cases are not repeated: $(cat short/compare.csv)"
# Each warning once, with the first case that has it, and that of the coarse mesh alone with the second; of more than six how many there are.
cat short/mpm-*/summary.json | awk '/"warnings": \[/ { inside = 1; next } inside && /^ *\]/ { inside = 0 } inside' | sed 's/,$//' | sort -u >warnings
all=$(wc -l <warnings)
shown=$((all < 6 ? all : 6))
[ "$all" -gt 0 ] || fault 'nothing to warn of'
[ "$(grep -c '^warned, ' warned)" -eq "$shown" ] || fault "not $shown warnings"
[ "$(grep '^warned, ' warned | sort -u | wc -l)" -eq "$shown" ] || fault 'a warning twice'
[ "$all" -eq "$shown" ] || has warned "warned: $((all - shown)) more"

expect 0 "$FLOE" compare "${scene[@]}" --axis domain.cell=0.4 --set time.end=1e-4 --repeat 0 -o untimed --quiet
[ ! -e untimed/timing ] || fault 'timed in spite of --repeat 0'
