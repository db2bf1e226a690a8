#!/usr/bin/env bash
# A deck that says nothing of checkpoints has them: after SIGKILL a run goes on to the bits of one that was left alone; the two
# latest are kept, and where the newest is damaged, cut or gone, the one before it serves.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
# In memory, where there is such a folder: on a disk that is slow to sync, a run of a second has no time for checkpoints.
if [ -w /dev/shm ]; then
    rm -rf "$work"
    work=$(mktemp -d -p /dev/shm)
    cd "$work"
fi
scene=("$cylinder" --coupling mpm --set domain.cell=0.025 --set output.interval=2e-4 --set time.end=2e-3)

# await FILE PID: until the file is there, or the process is not.
await() {
    while [ ! -e "$1" ] && kill -0 "$2" 2>/dev/null; do sleep 0.01; done
}

# killed_at FOLDER FILE COMMAND...: the command, killed once FILE is there.
killed_at() {
    local folder=$1 file=$2 pid got=0
    shift 2
    "$@" -o "$folder" >stdout 2>stderr &
    pid=$!
    await "$folder/$file" "$pid"
    kill -KILL "$pid" 2>/dev/null || true
    { wait "$pid"; } 2>/dev/null || got=$?
    [ "$got" -eq 137 ] || fault "status $got of a run that was to be killed"
}

expect 0 "$FLOE" run "${scene[@]}" -o whole --quiet
[ "$(find whole/fields -name '*.h5' | wc -l)" -eq 11 ] || fault 'not eleven snapshots'
has whole/run.log 'checkpoints on the way: '

# A checkpoint on the way, and SIGKILL.
killed_at part checkpoint.h5 "$FLOE" run "${scene[@]}" --quiet
is_there part/checkpoint.h5
expect 0 "$FLOE" run "${scene[@]}" -o part --resume --quiet
same_results whole part
has part/run.log 'resume'

# Checkpoints often enough for two to be there; then the newest is cut, changed in the middle, and gone.
often=("${scene[@]}" --set domain.cell=0.05 --set output.interval=4e-4 --set time.end=4e-3 --set output.checkpoint_interval=0.015)
expect 0 "$FLOE" run "${often[@]}" -o whole-often --quiet
killed_at two fields/000005.h5 "$FLOE" run "${often[@]}" --quiet
is_there two/checkpoint.h5 two/checkpoint-previous.h5
for harm in cut changed gone; do
    rm -rf harmed
    cp -r two harmed
    case $harm in
        cut) truncate -s -1000 harmed/checkpoint.h5 ;;
        changed) printf '\377\376' | dd of=harmed/checkpoint.h5 bs=1 seek=5000 conv=notrunc status=none ;;
        gone) rm harmed/checkpoint.h5 ;;
    esac
    expect 0 "$FLOE" run "${often[@]}" -o harmed --resume
    has stderr 'the one before it'
    has harmed/run.log 'checkpoint-previous.h5'
    same_results whole-often harmed
done

# Both harmed: refused, with both reasons, and nothing is touched.
rm -rf harmed
cp -r two harmed
truncate -s -1000 harmed/checkpoint.h5
truncate -s 100 harmed/checkpoint-previous.h5
expect 4 "$FLOE" run "${often[@]}" -o harmed --resume
has stderr 'checkpoint.h5'
has stderr 'checkpoint-previous.h5'
cmp harmed/history.csv two/history.csv

# The damaged one does not take the place of the one before it when the next is written.
rm -rf harmed
cp -r two harmed
truncate -s -1000 harmed/checkpoint.h5
cp harmed/checkpoint-previous.h5 good.h5
expect 5 "$FLOE" run "${often[@]}" -o harmed --resume --max-wall 0.001
cmp harmed/checkpoint-previous.h5 good.h5 || fault 'the good checkpoint is gone'
expect 0 "$FLOE" run "${often[@]}" -o harmed --resume --quiet
same_results whole-often harmed

# Another deck is refused as such, whatever stands beside.
expect 2 "$FLOE" run "${often[@]}" --set damping.rate=1 -o two --resume
has stderr 'another deck'

# Far more snapshots than there is time for checkpoints: spaced out, and so said.
expect 0 "$FLOE" run "${scene[@]}" --set output.interval=2e-5 --set time.end=4e-3 -o many --quiet # some seconds: time for one, at least
has many/run.log 'checkpoints are spaced out'
below "$(sed -n 's/.*checkpoints on the way: \([0-9]*\),.*/\1/p' many/run.log)" 50

# None on the way, where the deck says so; the one of the end is there.
expect 0 "$FLOE" run "${often[@]}" --set output.checkpoint_interval=off -o none --quiet
has none/run.log 'checkpoints on the way: 0,'
is_there none/checkpoint.h5
[ ! -e none/checkpoint-previous.h5 ] || fault 'a checkpoint that no one wanted'
cmp whole-often/history.csv none/history.csv || fault 'other histories'
has none/deck.yaml 'checkpoint_interval: off'
expect 2 "$FLOE" check "$cylinder" --set output.checkpoint_interval=never
has stderr 'a number > 0, auto, or off'

# A run of a moment writes one: that of its end.
expect 0 "$FLOE" run "${tiny[@]}" --set time.max_steps=5 -o moment --quiet
[ ! -e moment/checkpoint-previous.h5 ] || fault 'a run of five steps has written two checkpoints'
