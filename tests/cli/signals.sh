#!/usr/bin/env bash
# Every signal of terminals and batch systems ends a run with a checkpoint, status 5 and a last line that names it.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
# Steps of a moment, and half a minute of them: none of these runs ends by itself before its signal comes, however late.
long=("$cylinder" --coupling mpm --set domain.cell=0.1 --set time.end=0.5 --set stop=null --set output.checkpoint_interval=off)

# started FOLDER COMMAND...: the command in the background, $pid, once it has begun its steps.
started() {
    local folder=$1
    shift
    "$@" -o "$folder" >stdout 2>stderr &
    pid=$!
    until [ "$(wc -l 2>/dev/null <"$folder/history.csv" || echo 0)" -gt 2 ] || ! kill -0 "$pid" 2>/dev/null; do sleep 0.01; done
}

# ended STATUS: the command of `started` ends so.
ended() {
    local got=0
    wait "$pid" || got=$?
    [ "$got" -eq "$1" ] || fault "exit status $got instead of $1"
}

# stopped_by SIGNAL FOLDER: as the run says in its last line, its log and its summary.
stopped_by() {
    tail -n 1 stderr >last
    has last "stopped at t ="
    has last " by $1 ("
    has last '--resume'
    has "$2/run.log" " by $1 ("
    [ "$(json "$2/summary.json" status)" = interrupted ] || fault 'the summary does not say so'
    is_there "$2/checkpoint.h5"
}

for signal in HUP INT QUIT TERM XCPU USR1 USR2; do
    # A shell has its background processes ignore Ctrl-C: floe listens all the same.
    started "out-$signal" "$FLOE" run "${long[@]}" --quiet
    kill "-$signal" "$pid"
    ended 5
    stopped_by "SIG$signal" "out-$signal"
    expect 5 "$FLOE" run "${long[@]}" -o "out-$signal" --resume --max-wall 0.01
done

# What comes twice at a time has come once: `timeout` sends its signal to the process and to its group.
for signal in TERM HUP XCPU; do
    started "twice-$signal" "$FLOE" run "${long[@]}" --quiet
    kill "-$signal" "$pid"
    kill "-$signal" "$pid" 2>/dev/null || true
    ended 5
    stopped_by "SIG$signal" "twice-$signal"
done

# Under `nohup` the terminal may go.
started nohup nohup "$FLOE" run "${long[@]}" --quiet
kill -HUP "$pid"
sleep 0.2
kill -0 "$pid" || fault 'a hang-up has ended a run under nohup'
kill -TERM "$pid"
ended 5

# The limit of processor time. The sanitizers have handlers of their own for it.
if ! "$FLOE" --version | grep -qF fsanitize; then
    expect 5 bash -c 'ulimit -S -t 1; exec "$@"' limited "$FLOE" run "${long[@]}" -o cpu --quiet
    stopped_by SIGXCPU cpu
fi

# The signal of a study, to it alone: its cases are stopped with their checkpoints, and it says why.
for signal in HUP USR1; do
    "$FLOE" study "$cylinder" --set study=null --set coupling=mpm --set 'runs_as=[mpm]' --axis domain.cell=0.0125,0.4 \
        -o "study-$signal" >stdout 2>stderr &
    pid=$!
    until [ "$(wc -l 2>/dev/null <"study-$signal/0.0125/history.csv" || echo 0)" -gt 2 ]; do sleep 0.01; done
    kill "-$signal" "$pid"
    ended 5
    tail -n 1 stderr >last
    has last "stopped by SIG$signal ("
    is_there "study-$signal/0.0125/checkpoint.h5"
    [ "$(json "study-$signal/0.0125/summary.json" status)" = interrupted ] || fault 'the case was not stopped in order'
done

# A case of which the study was killed says that.
"$FLOE" study "$cylinder" --set study=null --set coupling=mpm --set 'runs_as=[mpm]' --axis domain.cell=0.0125 \
    -o orphan >stdout 2>stderr &
pid=$!
until [ "$(wc -l 2>/dev/null <orphan/0.0125/history.csv || echo 0)" -gt 2 ]; do sleep 0.01; done
kill -KILL "$pid"
{ wait "$pid"; } 2>/dev/null || true
for ((k = 0; k < 500; k++)); do grep -q interrupted orphan/0.0125/summary.json && break || sleep 0.02; done
has orphan/0.0125/summary.json 'as the program that had started it has ended'
