#!/usr/bin/env bash
# floe study and compare: a case that was killed on its way goes on from its checkpoint, to the bits of one that was not.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
scene=("$cylinder" --set study=null --set coupling=mpm --set 'runs_as=[mpm]' --set output.interval=2e-4 --set time.end=4e-3)
study=("$FLOE" study "${scene[@]}" --axis domain.cell=0.1,0.05 --repeat 0)
case=0.05

# start_of DIR: from which time the last leg of the case went on.
start_of() {
    sed -nE 's/.* (start|resume) .* from t = ([-+.0-9e]+) s$/\1 \2/p' "$1/$case/run.log" | tail -n 1
}

# kill_on_its_way DIR COMMAND...: the command and the run of its second case are killed once that has a checkpoint of some time.
kill_on_its_way() {
    local dir=$1 pid
    shift
    rm -rf "$dir"
    "$@" -o "$dir" >stdout 2>stderr &
    pid=$!
    until [ -e "$dir/$case/fields/000003.h5" ] && [ -s "$dir/$case/checkpoint.h5" ]; do sleep 0.01; done
    kill_with_runs "$pid"
}

# killed DIR COMMAND...: the same, again where the case was faster than the kill.
killed() {
    local try
    for try in 1 2 3 4 5 6 7 8 9 10; do
        kill_on_its_way "$@"
        [ -s "$1/$case/begun.json" ] && [ ! -e "$1/$case/case.json" ] && break
        [ "$try" -lt 10 ] || fault 'the case was over before it was killed'
    done
    is_there "$1/$case/checkpoint.h5"
}

expect 0 "${study[@]}" -o whole
[ ! -e "whole/$case/begun.json" ] || fault 'a case that has ended still says that it was begun'
[ "$(start_of whole)" = 'start 0' ] || fault "the case began as '$(start_of whole)'"

# It goes on: fewer steps are taken, all else is the same.
killed part "${study[@]}"
for copy in damaged other anew; do cp -r part $copy; done
expect 0 "${study[@]}" -o part
read -r how from < <(start_of part)
[ "$how" = resume ] || fault "a case that was cut short is run by '$how'"
below 1e-4 "$from"
same_results "whole/$case" "part/$case"
for key in steps rejected_steps eq13 l1_sigma_r point_updates; do
    [ "$(json "whole/$case/summary.json" $key)" = "$(json "part/$case/summary.json" $key)" ] || fault "another $key"
done
grep -q '"resumed": true' "part/$case/case.json" || fault 'case.json does not say that it is of two legs'
[ ! -e "part/$case/begun.json" ] || fault 'a case that has ended still says that it was begun'
# Nobody takes the time of its last leg for its own.
row=$(grep '"0.05"' part/study.csv)
awk -F, -v row="$row" 'NR == 1 { for (i = 1; i <= NF; i++) { sub(/ \(.*/, "", $i); at[$i] = i }; split(row, f, ","); exit !(f[at["cpu_seconds"]] !~ /^[0-9]/ && f[at["run_seconds"]] !~ /^[0-9]/) }' \
    part/study.csv || fault "times of a case of two legs: $row"

# What has no whole checkpoint, what is another deck's, and what --again asks for, is begun anew.
for file in damaged/$case/checkpoint*.h5; do printf x >"$file"; done
expect 0 "${study[@]}" -o damaged
has stderr 'is begun anew'
[ "$(start_of damaged)" = 'start 0' ] || fault 'a damaged checkpoint was gone on with'
same_results "whole/$case" "damaged/$case"
expect 0 "${study[@]}" --set output.interval=4e-4 -o other
[ "$(start_of other)" = 'start 0' ] || fault 'a case of another deck was gone on with'
[ "$(find other/$case/fields -name '*.h5' | wc -l)" -lt "$(find whole/$case/fields -name '*.h5' | wc -l)" ] || fault 'snapshots of another deck'
expect 0 "${study[@]}" --again -o anew
[ "$(start_of anew)" = 'start 0' ] || fault '--again went on with a case'

# A comparison goes on as well; its times are those of a run by itself.
comparison=("$FLOE" compare "${scene[@]}" --axis domain.cell=0.1,0.05)
case=mpm-0.05
killed compared "${comparison[@]}"
expect 0 "${comparison[@]}" -o compared
read -r how from < <(start_of compared)
[ "$how" = resume ] || fault "a case of a comparison that was cut short is run by '$how'"
same_results whole/0.05 "compared/$case"
row=$(grep '"0.05"' compared/compare.csv)
awk -F, -v row="$row" 'NR == 1 { for (i = 1; i <= NF; i++) { sub(/ \(.*/, "", $i); at[$i] = i }; split(row, f, ","); exit !(f[at["cpu_seconds"]] > 0) }' \
    compared/compare.csv || fault "no time of a case of two legs: $row"
