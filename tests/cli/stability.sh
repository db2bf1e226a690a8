#!/usr/bin/env bash
# floe stability: limits of York's line of points against eigenvalues, resumed, by several processes; a map; what is refused.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
line=$FLOE_SOURCE/inputs/stability_line.yaml

# The eigenvalues of tests/verification/test_mpm_stability.c, over h/c: in brackets of 2 %, by one command.
expect 0 "$FLOE" stability "$line" -o b8 --jobs 2 --over time.fixed_step=0.0006:0.0024 --tolerance 0.02 --set time.max_steps=1000 --quiet \
    --each domain.lattice_offset=0,-0.4999 --each method.stress=usl,musl
is_there b8/stability.json b8/stability.csv b8/energy.csv b8/energy.json
# A panel for each value of the first key, a line for each of the others in each, and a point for each run.
for text in '"x_label": "time.fixed_step / 0.001"' '"log_x": true' '"title": "domain.lattice_offset=0"' '"title": "domain.lattice_offset=-0.4999"' \
    '"name": "usl"' '"name": "musl"'; do
    has b8/energy.json "$text"
done
[ "$(wc -l <b8/energy.csv)" -eq "$(wc -l <b8/stability.csv)" ] || fault 'not every run is in the figure'
is_there b8/limits.csv
within() {
    awk -F, -v set="\"$1\",\"$2\"" -v wanted="$3" '$1 "," $2 == set { found = $3 == "found" && $6 < 1.003 * wanted &&
        $7 > 0.997 * wanted && $7 > $6 && $7 < 1.021 * $6 } END { exit !found }' b8/limits.csv ||
        fault "not about $3: $(grep -F -- "\"$1\",\"$2\"" b8/limits.csv)"
}
within 0 usl 0.7619
within 0 musl 2.1029
within -0.4999 usl 1.0513
within -0.4999 musl 1.0516

# The criterion, the bracket and the runs are said. What has been run is not run again, and other --jobs give the same limits.
one=("$line" --each method.stress=musl --set boundaries.x=periodic --set time.max_steps=1000 --tolerance 0.01)
expect 0 "$FLOE" stability "${one[@]}" -o one
has stdout 'no step is rejected'
has stdout 'below 10000 times'
has stdout 'stable up to time.fixed_step = 0.002'
has stdout 'x 0.001)'
has stdout 'energy grows'
cp one/limits.csv limits
sum=$(cd one && sha256sum */summary.json)
expect 0 "$FLOE" stability "${one[@]}" -o one --jobs 4 --quiet
(cd one && sha256sum --check --quiet <<<"$sum") || fault 'runs were run again'
[ "$(cut -d, -f1-6 one/limits.csv)" = "$(cut -d, -f1-6 limits)" ] || fault 'other limits with more processes'

# A range that is looked for, from the deck's own value; no limit within a range.
expect 0 "$FLOE" stability "$line" --each method.stress=usf --over time.fixed_step=1e-4:5e-4 --set boundaries.x=periodic -o none
has stdout 'no limit: stable at every value tried'
expect 0 "$FLOE" stability "$FLOE_SOURCE/inputs/bar_vibration.yaml" --over time.fixed_step --set time.fixed_step='1 ms' --set output.interval=null --set time.end=1 \
    --tolerance 0.05 -o bar
has stdout 'stable up to time.fixed_step = 0.00'

# A map, with a word for an axis.
expect 0 "$FLOE" stability "$line" --each boundaries.x=periodic --over method.stress=usl,musl \
    --over time.fixed_step=0.0007,0.0015,0.0025 -o map --jobs 2
is_there map/stability.json map/map.csv
grep -Eq '^ *usl +\. +[\^rD] +[\^rD]$' stdout || fault 'no row of usl'
grep -Eq '^ *musl +\. +\. +[\^rD]$' stdout || fault 'no row of musl'
[ "$(wc -l <map/stability.csv)" -eq 7 ] || fault 'not six runs'
is_there map/01-0{1,2}-0{1,2,3}/summary.json
has map/map.json '"y_label": "method.stress: 1 usl, 2 musl"'
# By verdict, step and place on the axis of words, the figure has what the table has.
sed -E '1d; s/^"[^"]*","(usl|musl)","([^"]*)",([a-z ]+),.*/\3 \2 \1/; s/ usl$/ 1/; s/ musl$/ 2/' map/stability.csv | sort >table
sed -E '1d; s/"//g' map/map.csv | awk -F, '{ printf "%s %g %s\n", $2, $3, $4 }' | sort >figure
cmp table figure || fault 'the figure of the map is not its table'

# Refused before anything runs.
refused() {
    expect 2 "$FLOE" stability "$line" -o refused "${@:2}"
    has stderr "$1"
    [ ! -e refused ] || fault 'something was written'
}
refused "unknown key 'fixed_stp'" --over time.fixed_stp=1e-3:2e-3
refused 'FROM:TO' --over time.fixed_step=1e-3
refused "is empty" --over time.fixed_step=1e-3:1e-3
refused 'two units' --over 'time.fixed_step=1 ms:2 s'
refused 'a number to a number' --over method.basis=linear:quadratic
refused 'a number to a number' --over "time.fixed_step=1 $(printf '%031d' 0 | tr 0 m):2" # longer than any unit
refused 'not a whole number' --over bodies.left.points=1:8
refused 'out of range' --over method.flip=0.5:2
refused "unknown" --each method.stress=usl,uslf
refused 'twice over' --over time.fixed_step=1e-3,2e-3 --over time.fixed_step=1e-3,2e-3
refused 'twice for a map' --over a=1:2 --over b=1:2 --over c=1:2
refused 'has no single value' --over output.interval
expect 2 "$FLOE" stability "$FLOE_SOURCE/inputs/sod.yaml" -o refused
has stderr 'over what?'

# A run that takes too long gives no verdict: its search ends, and that is no success.
expect 4 "$FLOE" stability "${one[@]}" --set time.max_steps=2000000 --max-wall 0.1 -o slow
has stdout 'no answer: a run gave no verdict; 0 runs'
has stderr 'the limit of wall time was reached'
has slow/limits.csv 'no_verdict,nan,nan'

even_columns .

# Interrupted: what there is was written, and the same command goes on.
"$FLOE" stability "${one[@]}" --set time.max_steps=2000000 -o stopped >stdout 2>stderr &
pid=$!
for _ in $(seq 100); do
    [ -s stopped/01-0.0005/history.csv ] && break
    sleep 0.1
done
kill -TERM $pid
got=0
wait $pid || got=$?
[ "$got" -eq 5 ] || fault "exit status $got instead of 5 after SIGTERM"
has stderr 'the same command goes on from there'
