#!/usr/bin/env bash
# The folder of the results goes while a run writes into it: moved, it is followed, and nothing is lost; removed, it is made anew with what is
# to come and a checkpoint; where that cannot be, the run ends with status 4, in words.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
scene=("$cylinder" --coupling mpm --set domain.cell=0.025 --set output.interval=1.25e-4 --set time.end=7.5e-4)

# started FOLDER: a run into it in the background, $pid, once it has two snapshots.
started() {
    "$FLOE" run "${scene[@]}" -o "$1" --quiet 2>stderr &
    pid=$!
    until [ -e "$1/fields/000001.h5" ]; do sleep 0.01; done
}

# ended STATUS
ended() {
    local got=0
    wait "$pid" || got=$?
    [ "$got" -eq "$1" ] || fault "exit status $got instead of $1"
}

# rid FOLDER: removes it, as often as it takes while someone writes there.
rid() {
    until rm -rf "$1" 2>/dev/null; do :; done
}

expect 0 "$FLOE" run "${scene[@]}" -o whole --quiet

# Moved, at one stroke.
started here
mv here there
ended 0
has there/run.log "the run goes on there"
[ ! -e here ] || fault 'the folder was made anew'
[ ! -e there/checkpoint.reserve ] || fault 'the room that was kept is still taken'
same_results whole there
is_there there/checkpoint.h5 there/summary.json there/fields.xdmf

# Moved, and another run writes under its name: neither disturbs the other.
started busy
kill -STOP "$pid" # it must not have seen that the folder has gone before there is another
mv busy first
expect 0 "$FLOE" run "${tiny[@]}" -o busy --quiet
cp -r busy second
kill -CONT "$pid"
ended 0
same_results second busy
cmp second/checkpoint.h5 busy/checkpoint.h5 || fault "the first run has written into the second's folder"
same_results whole first
[ "$(json busy/summary.json status)" = 'done' ] || [ "$(json busy/summary.json status)" = at_rest ] || fault 'the second run is not done'

# Removed: made anew, and a run that is then killed can go on.
started gone
rid gone
until [ -e gone/checkpoint.h5 ] || ! kill -0 "$pid" 2>/dev/null; do sleep 0.01; done
is_there gone/checkpoint.h5
kill -KILL "$pid"
{ wait "$pid"; } 2>/dev/null || true
expect 0 "$FLOE" run "${scene[@]}" -o gone --resume --quiet
last=$(find whole/fields -name '*.h5' | sort | tail -n 1)
cmp <(tail -n 1 whole/history.csv) <(tail -n 1 gone/history.csv) || fault 'another end'
is_there "$last"

# Removed, and left alone: done, and the summary says what is missing.
started alone
rid alone
ended 0
has alone/run.log 'were removed while the run wrote them'
has alone/summary.json 'were removed while the run wrote them'
cmp <(tail -n 1 whole/history.csv) <(tail -n 1 alone/history.csv) || fault 'another end'
is_there alone/checkpoint.h5 alone/deck.yaml alone/fields.xdmf

# Only the rows, or only the snapshots.
started rows
rm rows/history.csv
ended 0
[ "$(find rows/fields -name '*.h5' | wc -l)" -eq "$(find whole/fields -name '*.h5' | wc -l)" ] || fault 'snapshots are missing'
started fields
until rm -rf fields/fields 2>/dev/null; do :; done
ended 0
cmp whole/history.csv fields/history.csv || fault 'other rows'

# Removed, and a file in its place.
started taken
kill -STOP "$pid" # or it makes the folder anew before the file is there
rid taken
: >taken
kill -CONT "$pid"
ended 0
is_there taken-continued/checkpoint.h5

# Removed with what it was in, and a file in place of that.
mkdir above
started above/below
kill -STOP "$pid"
rid above
: >above
kill -CONT "$pid"
ended 4
grep -qE 'cannot be made anew|was removed meanwhile' stderr || fault 'the run does not say that its folder has gone'
has stderr 'there is no checkpoint'
