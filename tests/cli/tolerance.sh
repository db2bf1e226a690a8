#!/usr/bin/env bash
# floe run --tolerance: the cheapest of a study's variants to an error that holds, going on after a kill, and refusals.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
traction=$FLOE_SOURCE/inputs/annulus_traction.yaml
axes='study.axes={time.solver: [dynamic, static], method.edge_penalty: [0, 0.05], domain.cell: [0.2, 0.1, 0.05, 0.025]}'
scene=("$traction" --set "$axes" --set output.interval=0.01)

# Against Lamé: the answer's error is within what was asked for, by the solver that takes one step; its outputs are a run's. What one
# command has run the next one takes, whatever it asks for.
for asked in 0.05 0.01; do
    expect 0 "$FLOE" run "${scene[@]}" --tolerance $asked -o answer
    below "$(json answer/summary.json eq13)" $asked
    [ "$(json answer/summary.json met)" = true ] || fault 'not said to be met'
    [ "$(json answer/summary.json time.solver)" = static ] || fault 'the dear solver was chosen'
    is_there answer/fields.xdmf answer/fields/000001.h5 answer/history.csv answer/deck.yaml answer/cases/study.json
    has stdout chosen
    has stdout 'measured: eq13 against lame'
done
[ ! -e answer/cases/dynamic-0-0.025 ] || fault 'a variant that is dear was gone on with'
same_results answer "answer/cases/$(json answer/summary.json directory)"
find answer/cases -name summary.json -exec stat -c '%n %y' {} + | sort >before
expect 0 "$FLOE" run "${scene[@]}" --tolerance 0.01 -o answer --quiet
expect 0 "$FLOE" run "${scene[@]}" --tolerance 0.04 -o answer
find answer/cases -name summary.json -exec stat -c '%n %y' {} + | sort >after
cmp before after || fault 'a case that had ended was run again'
if python_is_whole; then expect 0 env FLOE_PYTHON="$python" "$FLOE" report answer -o report.html; fi

# Without the exact solution: the energy of the wall is estimated, and the estimate is no less than the true error. Lamé, plane strain:
# energy = P u(a) a pi/4 of the quarter.
energy=$(awk 'BEGIN { K = 117e9; G = 43.8e9; P = 19.4e6; a = 0.5; b = 1; c = P * a * a / (b * b - a * a)
    u = c * a / (2 * (K + G / 3)) + c * b * b / (2 * G * a); printf "%.9g", P * u * a * atan2(1, 1) }')
for asked in 0.05 0.01; do
    expect 0 "$FLOE" run "${scene[@]}" --metric strain --tolerance $asked -o answer
    estimate=$(json answer/summary.json estimate)
    below "$estimate" $asked
    awk -F, -v e="$energy" -v most="$estimate" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "strain (J)") c = i } END { d = $c / e - 1
        exit !(c && (d < 0 ? -d : d) <= most) }' answer/history.csv || fault "the energy is off by more than the estimate of $estimate"
    has stdout 'estimated for strain'
done

# Couplings are variants like any other; --coupling leaves one.
gas=("$cylinder" --set 'study={axes: {coupling: [ice-mpm, mpm], method.edge_penalty: [0, 0.05], domain.cell: [0.2, 0.1]}}' --set output.interval=0.01)
expect 0 "$FLOE" run "${gas[@]}" --tolerance 0.05 -o couplings
below "$(json couplings/summary.json eq13)" 0.05
[ "$(json couplings/summary.json coupling)" = mpm ] || fault 'the dear coupling was chosen'
expect 0 "$FLOE" run "${gas[@]}" --tolerance 0.1 --coupling ice-mpm -o one --quiet
[ "$(json one/summary.json coupling)" = ice-mpm ] || fault '--coupling was passed over'
below "$(json one/summary.json eq13)" 0.1

# Killed on the way: the same command goes on, and keeps what has ended.
"$FLOE" run "${scene[@]}" --tolerance 0.01 -o killed 2>stderr >stdout &
pid=$!
until [ "$(find killed -name case.json 2>/dev/null | wc -l)" -ge 3 ]; do sleep 0.02; done
kill_with_runs "$pid"
find killed -name case.json | sort | sed 's/case.json/summary.json/' >finished
[ ! -e killed/summary.json ] || fault 'it was over before it was killed'
xargs stat -c '%n %y' <finished >before
expect 0 "$FLOE" run "${scene[@]}" --tolerance 0.01 -o killed
xargs stat -c '%n %y' <finished >after
cmp before after || fault 'a case that had ended was run again'
below "$(json killed/summary.json eq13)" 0.01

# What cannot be reached: status 6, how near it came, what it would take; the best case is there.
expect 6 "$FLOE" run "${scene[@]}" --set study.axes.domain.cell='[0.2, 0.1]' --tolerance 1e-3 -o far
has stderr '0.100 % in eq13 is not reached: the best is'
has stderr 'by extrapolation'
has stderr 'add finer values to the axis'
has stdout 'not reached; the best'
[ "$(json far/summary.json met)" = false ] || fault 'said to be met'
is_there far/history.csv
expect 6 "$FLOE" run "${scene[@]}" --tolerance 1e-3 --budget 1e-3 -o short
has stderr '--budget'

# Refused before anything runs.
expect 2 "$FLOE" run "$traction" --set study=null --tolerance 0.01 -o none
has stderr "deck's study, and this deck has none"
expect 2 "$FLOE" run "$traction" --set 'study={axes: {method.basis: [linear, quadratic]}}' --tolerance 0.01 -o none
has stderr 'needs spacings'
expect 2 "$FLOE" run "${scene[@]}" --tolerance 0.01 --metric drift -o none
has stderr 'eq13 l1_sigma_r l1_sigma_theta strain'
expect 2 "$FLOE" run "${scene[@]}" --set verify=null --set study.quantities=null --tolerance 0.01 -o none
has stderr 'nothing to measure an error by'
expect 2 "$FLOE" run "${scene[@]}" --tolerance 0.01 --resume -o none
expect 2 "$FLOE" run "${scene[@]}" --tolerance 0 -o none
expect 2 "$FLOE" run "${scene[@]}" --metric eq13 -o none
has stderr 'belong to --tolerance'
[ ! -e none ] || fault 'something was written'
