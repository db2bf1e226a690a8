#!/usr/bin/env bash
# floe study: timed runs, bars, limits, time limits, bad axes.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

# Time: each case alone, several times; an error that is met, an order that is missed.
bars=('study.require=[{metric: eq13, order: 9, where: {coupling: mpm}}, {metric: eq13, error: 99}]')
short=(--set study=null --set time.end=2e-3 --set output.interval=1e-3)
expect 6 "$FLOE" study "$cylinder" "${short[@]}" --axis domain.cell=0.1,0.075 --couplings mpm,ice-mpm --repeat 2 --set "${bars[0]}" -o bars --jobs 2
has stderr 'order of eq13, mpm'
has stderr 'required: at least 9.00'
has stdout 'MISSED: order of eq13, mpm'
has stdout 'met: error of eq13, domain.cell=0.075, ice-mpm'
has stdout 'the best of 2, alone on one thread'
grep -qE ' choose | are not told apart' stdout || fault 'no word on what to choose'
is_there bars/study.json bars/errors.json bars/timing/0.1-mpm-2/summary.json bars/0.1-mpm/fields.xdmf
[ ! -e bars/timing/0.1-mpm-2/fields ] || fault 'timed runs keep their snapshots'
[ "$(grep -c '"met": true' bars/study.json)" -eq 2 ] || fault 'not two bars met'
[ "$(grep -c '"met": false' bars/study.json)" -eq 1 ] || fault 'not one bar missed'
[ "$(grep -c '"same_results": true' bars/study.json)" -eq 4 ] || fault 'repeated runs gave other results'
# best_of_all FILE: of each case the best time is the least of all of its times, and there are as many as were asked for.
best_of_all() {
    tr -d ' \n' <"$1" | grep -o '"best":[^,]*,"timed":true,"all":\[[^]]*\]' | tr '[]:,' '    ' | awk '
        { least = $6; for (k = 7; k <= NF; k++) if ($k + 0 < least + 0) least = $k
          if ($2 + 0 != least + 0 || NF - 5 < 2) { print "best " $2 " of " $0; wrong = 1 } }
        END { exit wrong || NR != 4 }'
}
# The same of processor time; its scatter is how far the median is above the least, and more where others have disturbed the runs.
least_of_all() {
    tr -d ' \n' <"$1" | grep -o '"cpu":[^,]*,"scatter":[^,]*,"all_cpu":\[[^]]*\]' | tr '[]:,' '    ' | awk '
        { n = NF - 5; for (k = 1; k <= n; k++) t[k] = $(k + 5) + 0
          for (i = 1; i <= n; i++) for (k = 1; k < i; k++) if (t[k] > t[i]) { x = t[k]; t[k] = t[i]; t[i] = x }
          scatter = t[int(n / 2) + 1] / t[1] - 1; off = $4 - scatter
          if (n < 2 || $2 + 0 != t[1] || !(off * off <= 1e-12) && !($4 == 0.3 && scatter < 0.3)) { print "cpu " $0; wrong = 1 } }
        END { exit wrong || NR != 4 }'
}
even_columns bars
[ "$(grep -c '"target":' bars/study.json)" -eq "$(grep -cE '^(for .* (choose|told apart)|no variant reaches )' stdout)" ] || fault 'not all answers are in study.json'
best_of_all bars/study.json || fault 'the best time is not the least of all'
least_of_all bars/study.json || fault 'the processor time is not the least of all, or its scatter not what they say'
find bars -name summary.json -exec stat -c '%n %y' {} + | sort >before
expect 6 "$FLOE" study "$cylinder" "${short[@]}" --axis domain.cell=0.1,0.075 --couplings mpm,ice-mpm --repeat 2 --set "${bars[0]}" -o bars --quiet
find bars -name summary.json -exec stat -c '%n %y' {} + | sort >after
cmp before after || fault 'a timed run was made again'

# Limits of a quantity: three spacings, and the deck's own study.
cat >bar.yaml <<'DECK'
study:
  axes: {domain.cell: [0.05, 0.025, 0.0125]}
  quantities: [kinetic, strain]
DECK
cat "$FLOE_SOURCE/inputs/bar_vibration.yaml" bar.yaml | sed '/^compare:/,/^ .*axis/d' >bar_study.yaml
expect 0 "$FLOE" study bar_study.yaml -o limits
has stdout 'limit of strain'
has limits/study.json '"gci"'
is_there limits/quantities.csv
even_columns limits

# A time limit is a result; more time is a reason to run the case again.
expect 0 "$FLOE" study "$cylinder" --set study=null --set coupling=mpm --set 'runs_as=[mpm]' --axis domain.cell=0.4,0.0125 --max-wall 0.3 -o short
has short/study.csv ',timed_out,'
has stdout 'timed_out'

# Bad axes are refused before anything is made, all of them at once.
refuse() { # refuse TEXT ARGUMENT...
    local text=$1
    shift
    expect 2 "$FLOE" study "$cylinder" --set study=null -o refused "$@"
    has stderr "$text"
    [ ! -e refused ] || fault "a study with bad axes has made its folder: $*"
}
refuse 'nothing to vary'
refuse "unknown key 'cel' (did you mean 'cell'?)" --axis domain.cel=0.1,0.2
refuse "its list of values is empty" --axis domain.cell=
refuse "its value 2 is empty" --axis domain.cell=0.1,,0.2
refuse "the value '0.10' is given twice" --axis domain.cell=0.1,0.10
refuse "domain.cell=wide" --axis domain.cell=0.1,wide
refuse "method.basis=cubi" --axis domain.cell=0.1,wide --axis method.basis=cubi
refuse "domain.cell=wide" --axis domain.cell=0.1,wide --axis method.basis=cubi
refuse 'it has no key with values' --axis domain.cell
refuse "that is no axis of this study, which has: domain.cell" --axis domain.cell=0.1,0.2 --over method.flip
refuse "is no value of that axis of this study, which has: 0.2, 0.1" --axis domain.cell=0.2,0.1 \
    --set 'study.require=[{metric: eq13, error: 1, where: {domain.cell: 0.3}}]'
refuse "'bodies.cylinder.points' has 1 values for 2 of 'domain.cell'" --axis 'domain.cell=0.4,0.2;bodies.cylinder.points=[2, 2]'
refuse "the axes 'domain.cell' and 'method.flip' both set 'method.flip'" --axis 'domain.cell=0.4,0.2;method.flip=1,0.9' --axis method.flip=0.8,1

# Keys that change along with that of an axis, in the deck and on the command line.
cat >along.yaml <<'DECK'
study:
  axes: {domain.cell: {values: [0.05, 0.025], with: {bodies.bar.points: [[3], [2]]}}}
DECK
cat "$FLOE_SOURCE/inputs/bar_vibration.yaml" along.yaml | sed '/^compare:/,/^ .*axis/d' >bar_along.yaml
expect 0 "$FLOE" study bar_along.yaml -o along --set time.end=1e-4
has stdout 'order'
has along/study.json '"bodies.bar.points"'
grep -q 'points: \[3' along/0.05/deck.yaml || fault 'the first case has not its own points'
grep -q 'points: \[2' along/0.025/deck.yaml || fault 'the second case has not its own points'
expect 0 "$FLOE" study bar_along.yaml -o some --set time.end=1e-4 --axis domain.cell=0.025
cmp along/0.025/deck.yaml some/0.025/deck.yaml || fault 'a value of the command line takes not what goes along with it'
expect 2 "$FLOE" study bar_along.yaml -o refused --axis domain.cell=0.1
has stderr "the deck does not say what goes along with 0.1"
sed 's/\[3\], \[2\]/[3]/' bar_along.yaml >bar_short.yaml
expect 2 "$FLOE" check bar_short.yaml
has stderr 'bar_short.yaml:'
has stderr "'bodies.bar.points' is no list of 2 values, one for each of 'domain.cell'"
sed 's/with: /without: /' bar_along.yaml >bar_wrong.yaml
expect 2 "$FLOE" check bar_wrong.yaml
has stderr "'without' is no key of an axis"
