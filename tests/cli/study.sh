#!/usr/bin/env bash
# floe study: crossed axes, cases that diverge, going on after a kill and a stop.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
scene=("$cylinder" --set study=null --set coupling=mpm --set 'runs_as=[mpm]' --set time.end=2e-3 --set method.edge_penalty=0 --quiet)

# plain FILE: a study without what depends on the time that it took: objects named timing, and three keys of summaries.
plain() {
    awk '/^ *"(timing|seconds_by_stage)": \{$/ { skip = $0; sub(/".*/, "", skip); next }
        skip != "" { if (index($0, skip "}") == 1) skip = ""; next }
        !/"(wall_seconds|output_seconds|cpu_seconds|peak_rss_bytes)":/' "$1"
}

# named_last WORDS: the last line of what was said names a case that has not come to its end.
named_last() {
    tail -n 1 stderr | grep -qE -- "$1" || fault "no case that is '$1' on the last line"
}

# 12 cases, every third of which diverges: the study comes to its end, and says of which nothing was foreseen.
axes=(--axis 'domain.cell=0.4,0.2' --axis 'time.cfl={mpm: 0.3},0.5' --axis 'time.fixed_step=1e-5,2e-5,5e-4')
expect 6 "$FLOE" study "${scene[@]}" "${axes[@]}" -o whole --jobs 2
has stderr '4 of 12 cases have not come to their end'
named_last 'diverged, .*time.fixed_step=5e-4|and [0-9]+ more: .*time.fixed_step=5e-4'
is_there whole/study.json whole/study.csv whole/errors.csv whole/errors.json
[ "$(wc -l <whole/study.csv)" -eq 13 ] || fault 'not 12 cases'
[ "$(grep -c ',diverged,' whole/study.csv)" -eq 4 ] || fault 'not every third case has diverged'
[ "$(grep -c '"status": "diverged"' whole/study.json)" -eq 4 ] || fault 'study.json knows other cases to have diverged'
has whole/study.csv 'last good state'
grep -q '"message": ".*last good state' whole/0.4-_mpm_0.3-5e-4/case.json || fault 'no cause in case.json'

# Killed half way: no run is left behind, and the same command gives the same study.
"$FLOE" study "${scene[@]}" "${axes[@]}" -o part --jobs 2 2>stderr &
pid=$!
until [ "$(find part -name case.json 2>/dev/null | wc -l)" -ge 4 ]; do sleep 0.02; done
kill -KILL "$pid"
wait "$pid" 2>/dev/null || true
[ ! -e part/study.json ] || fault 'the study was over before it was killed'
find part -name case.json | sort >finished
[ "$(wc -l <finished)" -lt 12 ] || fault 'the study was over before it was killed'
while read -r file; do stat -c '%n %y' "$file" "${file%case.json}summary.json"; done <finished >before
expect 6 "$FLOE" study "${scene[@]}" "${axes[@]}" -o part --jobs 2
while read -r file; do stat -c '%n %y' "$file" "${file%case.json}summary.json"; done <finished >after
cmp before after || fault 'a case that had ended was run again'
plain whole/study.json >whole.json
plain part/study.json >part.json
[ "$(wc -l <whole.json)" -gt 700 ] || fault 'nothing left to compare'
cmp whole.json part.json || fault 'a study that was killed and resumed has other results'
has whole.json '"eq13": 0.'

# Killed between the end of a case that has diverged and the note of it: from the state that was refused it would diverge otherwise.
case=part/0.4-0.5-5e-4
is_there $case/checkpoint.h5
printf '{"schema": 1, "deck_sha256": "%s", "floe_git": "%s"}\n' "$(json $case/case.json deck_sha256)" "$(json $case/summary.json git)" >$case/begun.json
rm $case/case.json
expect 6 "$FLOE" study "${scene[@]}" "${axes[@]}" -o part
plain part/study.json >part.json
cmp whole.json part.json || fault 'a case that had diverged was gone on with'

# What the deck foresees is no failure; a reason for another case does not do.
foreseen=("${scene[@]}" --set domain.cell=0.2 --set 'study={refuse: [{why: far beyond the limit, where: {time.fixed_step: 5e-4}}]}')
expect 0 "$FLOE" study "${foreseen[@]}" --axis time.fixed_step=5e-4,2e-5 -o foreseen
expect 6 "$FLOE" study "${foreseen[@]}" --axis time.fixed_step=5e-4,2e-5,4e-4 -o foreseen
has stderr '1 of 3 cases'
named_last 'diverged, time.fixed_step=4e-4: '

# A case that was cut short is run again, and one whose deck has changed; the others are not.
rm part/0.2-_mpm_0.3-1e-5/case.json
stat -c '%y' part/0.2-0.5-1e-5/summary.json part/0.2-_mpm_0.3-1e-5/summary.json >before
expect 6 "$FLOE" study "${scene[@]}" "${axes[@]}" -o part
stat -c '%y' part/0.2-0.5-1e-5/summary.json part/0.2-_mpm_0.3-1e-5/summary.json >after
[ "$(head -n 1 before)" = "$(head -n 1 after)" ] || fault 'a case that had ended was run again'
[ "$(tail -n 1 before)" != "$(tail -n 1 after)" ] || fault 'a case that was cut short was not run again'
expect 0 "$FLOE" study "${scene[@]}" --axis domain.cell=0.4,0.2 -o changed
stat -c '%y' changed/0.4/summary.json changed/0.2/summary.json >before
expect 0 "$FLOE" study "${scene[@]}" --axis domain.cell=0.4,0.2 --set time.end=1e-3 -o changed
[ "$(stat -c '%y' changed/0.4/summary.json)" != "$(head -n 1 before)" ] || fault 'results of another deck were kept'
[ "$(json changed/0.4/summary.json time | cut -c 1-5)" = 0.001 ] || fault 'results of another deck were kept'

# Stopped by a signal: status 5, and the runs are stopped too.
"$FLOE" study "$cylinder" --set study=null --set coupling=mpm --set 'runs_as=[mpm]' --set stop=null --set time.end=0.5 --axis domain.cell=0.1,0.08 -o stopped --jobs 2 >stdout 2>stderr &
pid=$!
until [ -s stopped/0.08/history.csv ] && [ -s stopped/0.1/history.csv ]; do sleep 0.02; done
"$FLOE" study "${scene[@]}" --axis domain.cell=0.4,0.2 -o stopped 2>refused && fault 'two studies in one folder'
has refused "process $pid is writing into 'stopped'"
kill -TERM "$pid"
got=0
wait "$pid" || got=$?
[ "$got" -eq 5 ] || fault "a stopped study gives $got instead of 5"
has stderr 'the same command goes on'
[ "$(json stopped/0.08/summary.json status)" = interrupted ] || fault 'the runs were not stopped'
[ ! -e stopped/0.08/case.json ] || fault 'a run that was stopped counts as ended'

# A run that is killed is a result with its cause, and the rest go on; it is not final.
"$FLOE" study "$cylinder" --set study=null --set coupling=mpm --set 'runs_as=[mpm]' --axis domain.cell=0.0125,0.4 -o killed >stdout 2>stderr &
pid=$!
until [ -s killed/0.0125/history.csv ]; do sleep 0.02; done
"$FLOE" run "${tiny[@]}" -o killed/0.0125 2>refused && fault 'two runs in one folder'
kill -KILL "$(sed -E 's/.*process ([0-9]+) is writing.*/\1/' refused)"
got=0
wait "$pid" || got=$?
[ "$got" -eq 6 ] || fault "status $got of a study with a case that was killed"
named_last 'failed, domain.cell=0.0125: killed by signal 9'
has stdout 'failed'
grep -q '^mpm,"0.0125",.*,failed,' killed/study.csv || fault 'not recorded as failed'
grep -q '^mpm,"0.4",.*,done,\|^mpm,"0.4",.*,at_rest,' killed/study.csv || fault 'the other case was not run'
[ ! -e killed/0.0125/case.json ] || fault 'a case that was killed counts as ended'

# A dimensionless scene has no units but per cent and wall time; in the table what stands in a column ends where its name does.
for units in none si; do
    expect 0 "$FLOE" study "$FLOE_SOURCE/inputs/sod.yaml" --set study=null --set units=$units --axis coupling=ice,mpm --axis domain.cell=0.05,0.02 --repeat 0 -o "units_$units"
    cp stdout "table_$units"
    [ "$(json "units_$units/ice-0.02/summary.json" units)" = "$units" ] || fault 'the summary does not say the units'
    awk '/^coupling/ { n = split($0, c, /l1_density( \(kg\/m3\))?/); end = length($0) - length(c[2]); next }
         /^(ice|mpm) / && (substr($0, end, 1) !~ /[0-9]/ || substr($0, end + 1, 1) != " ") { exit 1 }' "table_$units" || fault 'a table that is not aligned'
done
! grep -nE 'kg/m3|J/kg|m/s|\(m\)|\(Pa\)|[0-9] Pa' units_none/*.csv units_none/errors.json units_none/profile.json units_none/study.json table_none units_none/*/profile.csv >&2 || fault 'units of a dimensionless scene'
has table_si 'l1_density (kg/m3)'
has units_si/study.csv 'l1_density (kg/m3)'
has units_si/ice-0.02/profile.csv 'density (kg/m3)'

even_columns .

# A quantity that no history will have is refused before anything runs.
expect 2 "$FLOE" study "${scene[@]}" --axis domain.cell=0.4,0.2 --set 'study.quantities=[strian]' -o misspelt
has stderr "no case's history.csv has a column 'strian'; they have"
has stderr 'strain (J)'
[ ! -e misspelt ] || fault 'something was written'
