#!/usr/bin/env bash
# floe run: the files it leaves, and what stands in them.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

expect 0 "$FLOE" run "${tiny[@]}" -o out
has stdout 'eq13'
is_there out/summary.json out/history.csv out/fields/000000.h5 out/fields.xdmf out/checkpoint.h5 out/deck.yaml \
    out/run.log out/profile.csv
[ "$(json out/summary.json schema)" = 1 ] || fault 'no schema'
[ "$(json out/summary.json coupling)" = mpm ] || fault 'another coupling'
[ "$(json out/summary.json status)" = at_rest ] || fault 'not at rest'
[ "$(json out/summary.json cells)" = 0 ] || fault 'points alone have cells'
[ "$(json out/summary.json ice)" = 0 ] || fault 'points alone hold bytes of cells'
[ "$(json out/summary.json newton_cells)" = 0 ] || fault 'points alone have solved for a pressure'
for key in deck time steps rejected_steps wall_seconds points point_updates peak_rss_bytes mass momentum energy \
    version git compiler flags threads mpm_points_to_nodes; do
    [ -n "$(json out/summary.json "$key")" ] || fault "summary.json has no $key"
done
below "$(json out/summary.json eq13)" 0.2
below "$(json out/summary.json rel_gas_pressure)" 0.005
below "$(json out/summary.json mass)" 1e-12
has out/history.csv 'time (s)'
has out/fields.xdmf '<Xdmf'
has out/run.log 'at_rest'
[ "$(head -n 1 out/history.csv | tr ',' '\n' | wc -l)" -eq "$(tail -n 1 out/history.csv | tr ',' '\n' | wc -l)" ] ||
    fault 'a row of other length than the names'

# The resolved deck gives the same run; a new run takes the place of earlier results.
expect 0 "$FLOE" run out/deck.yaml -o again --quiet --set time.max_steps=10
expect 0 "$FLOE" run out/deck.yaml -o again --quiet
[ ! -s stdout ] || fault 'quiet, and yet it talks'
same_results out again

# One thread and two: the same bits.
for threads in 1 2; do
    expect 0 "$FLOE" run out/deck.yaml -o "threads-$threads" --threads "$threads" --quiet --set time.max_steps=30
    [ "$(json "threads-$threads/summary.json" threads)" = "$threads" ] || fault 'another number of threads'
done
same_results threads-1 threads-2

# The default folder.
expect 0 "$FLOE" run "${tiny[@]}" --quiet --set time.max_steps=3
is_there out/pressurized_cylinder-mpm-domain.cell=0.1-time.max_steps=3/summary.json
[ "$(json out/pressurized_cylinder-mpm-domain.cell=0.1-time.max_steps=3/summary.json steps)" = 3 ] || fault 'not three steps'
[ "$(json out/pressurized_cylinder-mpm-domain.cell=0.1-time.max_steps=3/summary.json status)" = 'done' ] || fault 'not done'

# Two runs into one folder: the second is refused, and the first goes on undisturbed.
"$FLOE" run "$cylinder" --coupling mpm --set domain.cell=0.0125 -o shared --quiet 2>/dev/null &
first=$!
until [ -s shared/history.csv ]; do sleep 0.02; done
expect 4 "$FLOE" run "${tiny[@]}" -o shared --quiet
has stderr "process $first is writing into 'shared'"
kill -TERM "$first"
got=0
wait "$first" || got=$?
[ "$got" -eq 5 ] || fault "the first run ends with status $got instead of 5"
[ "$(json shared/summary.json status)" = interrupted ] || fault 'the summary is not that of the first run'
has shared/summary.json '"message": "stopped at t ='
