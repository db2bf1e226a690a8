#!/usr/bin/env bash
# Runs killed by SIGKILL at random moments, every second time while a checkpoint is being written, go on from what is left and
# end with the bits of a run that was left alone; every third time the newest checkpoint is damaged before. FLOE_KILLS kills of each of FLOE_SCENES (nightly: 50 of all five); FLOE_SEED repeats a
# choice of moments.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
kills=${FLOE_KILLS:-1}
RANDOM=${FLOE_SEED:-$(date +%N | sed 's/^0*//' | cut -c 1-4)}
inputs=$FLOE_SOURCE/inputs

# Points; points in gas on cells; a membrane around gas; a reaction of gases; bodies in contact.
read -ra names <<<"${FLOE_SCENES:-coupled sealed}"
points=("$cylinder" --coupling mpm --set domain.cell=0.1)
coupled=("$cylinder" --coupling ice-mpm --set domain.cell=0.1 --set time.end=0.02)
sealed=("$inputs/membrane_circle.yaml" --coupling ice-mpm --set domain.cell=0.25 --set time.max_steps=300)
reaction=("$inputs/closed_vessel_burn.yaml" --set method.pressure=implicit)
contact=("$inputs/two_bars.yaml" --set domain.cell=0.25 --set time.end=0.6)

# sleep_share SHARE/1000 SECONDS
sleep_share() {
    sleep "$(awk -v share="$1" -v t="$2" 'BEGIN { print share / 1000 * t }')"
}

# Waits for a checkpoint that is half written, as long as the process lives.
await_checkpoint() {
    while [ ! -e "$1/checkpoint.h5.tmp" ] && kill -0 "$2" 2>/dev/null; do :; done
}

# kill_once FOLDER SECONDS NUMBER COMMAND...: starts the command and kills it; counts what it was doing.
kill_once() {
    local folder=$1 seconds=$2 number=$3 pid got=0
    shift 3
    "$@" >stdout 2>stderr &
    pid=$!
    sleep_share $((RANDOM % 1000)) "$seconds"
    [ $((number % 2)) -eq 1 ] && await_checkpoint "$folder" "$pid"
    kill -KILL "$pid" 2>/dev/null || true
    { wait "$pid"; } 2>/dev/null || got=$?
    case $got in
        0) finished=$((finished + 1)) ;;
        137) killed=$((killed + 1)) ;;
        *) fault "status $got of a run that was to be killed" ;;
    esac
    [ -e "$folder/checkpoint.h5.tmp" ] && writing=$((writing + 1))
    return 0
}

# damage FOLDER: a byte of its newest checkpoint, where there is one before it.
damage() {
    [ -e "$1/checkpoint.h5" ] && [ -e "$1/checkpoint-previous.h5" ] || return 0
    # Two names of one file, as a kill may leave them, are two from here on.
    cp "$1/checkpoint-previous.h5" previous && mv previous "$1/checkpoint-previous.h5"
    printf '\252\125' | dd of="$1/checkpoint.h5" bs=1 seek=$((600 + RANDOM % 1000)) conv=notrunc status=none
    damaged=$((damaged + 1))
}

# go_on FOLDER COMMAND...: resumes; where no checkpoint was written yet that is refused, and the run starts anew.
go_on() {
    local folder=$1 got=0
    shift
    if [ ! -e "$folder/checkpoint.h5" ] && [ ! -e "$folder/checkpoint-previous.h5" ]; then
        early=$((early + 1))
        expect 4 "$@" --resume
        has stderr 'checkpoint.h5'
        expect 0 "$@"
        return
    fi
    expect 0 "$@" --resume
}

kill_scene() {
    local name=$1 start seconds n
    local -n scene=$1
    local command=("$FLOE" run "${scene[@]}" --quiet --set output.checkpoint_interval=0.03)
    start=$(date +%s.%N)
    expect 0 "${command[@]}" -o "$name"
    seconds=$(awk -v a="$start" -v b="$(date +%s.%N)" 'BEGIN { print b - a }')
    for ((n = 1; n <= kills; n++)); do
        rm -rf part
        kill_once part "$seconds" "$n" "${command[@]}" -o part
        [ $((n % 3)) -ne 0 ] || damage part
        go_on part "${command[@]}" -o part
        same_results "$name" part
        [ "$(json part/summary.json steps)" = "$(json "$name/summary.json" steps)" ] || fault 'other steps'
        [ ! -e part/checkpoint-previous.h5.tmp ] || fault 'a second name is left'
        [ ! -e part/checkpoint.reserve ] || fault 'the room that was kept is still taken'
        [ ! -e part/checkpoint.h5.tmp ] || fault 'half a checkpoint is left'
    done
}

killed=0 finished=0 writing=0 early=0 damaged=0
for name in "${names[@]}"; do kill_scene "$name"; done
echo "kills: $((kills * ${#names[@]})) of ${#names[@]} scenes: $killed hit a run, $finished came after its end; $writing while a checkpoint" \
    "was being written; $early before the first one; $damaged times the newest one was damaged; all ended with the bits of the undisturbed run" | tee "${FLOE_TOTALS:-/dev/null}"
[ "$killed" -gt 0 ] || [ "$kills" -lt 10 ] || fault 'no kill has hit'
