#!/usr/bin/env bash
# A disk that fills up while a run writes to it: status 4, a checkpoint of the very step in the room that was kept for it, a last line that
# names its time, nothing half written under a good name; and once there is room again, the bits of a run that was left alone.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

# In a name space of its own, where a small disk in memory can be mounted.
if [ -z "${FLOE_SMALL_DISK:-}" ]; then
    unshare --user --map-root-user --mount sh -c "mount -t tmpfs -o size=1m none '$work'" 2>/dev/null || {
        echo 'no small disk can be mounted here: left out'
        exit 0
    }
    cd / && rm -rf "$work"
    FLOE_SMALL_DISK=1 exec unshare --user --map-root-user --mount bash "$FLOE_SOURCE/tests/cli/full_disk.sh"
fi
mkdir disk elsewhere
scene=("$cylinder" --coupling mpm --set domain.cell=0.05 --set output.interval=1e-4)

# fill: not a byte is left on the disk. The run is stopped meanwhile: what its reserve gives back is not taken too.
fill() {
    kill -STOP "$pid"
    dd if=/dev/zero of=disk/fill bs=1k status=none 2>/dev/null || true
    dd if=/dev/zero bs=1 count=4096 status=none >>disk/fill 2>/dev/null || true
    kill -CONT "$pid"
}

expect 0 "$FLOE" run "${scene[@]}" -o elsewhere/whole --quiet
for rule in auto off; do
    mount -t tmpfs -o size=16m none disk
    scene_of=("${scene[@]}" --set output.checkpoint_interval=$rule)
    expect 0 "$FLOE" run "${scene_of[@]}" -o elsewhere/$rule --quiet
    "$FLOE" run "${scene_of[@]}" -o disk/out --quiet 2>stderr &
    pid=$!
    until [ -e disk/out/fields/000002.h5 ]; do sleep 0.01; done
    [ "$rule" = off ] || is_there disk/out/checkpoint.reserve
    fill
    got=0
    wait "$pid" || got=$?
    [ "$got" -eq 4 ] || fault "status $got instead of 4 on a full disk"
    tail -n 1 stderr >last
    if [ "$rule" = auto ]; then
        reached=$(sed -n 's/.*a checkpoint of t = \([^ ]*\) s was written.*--resume.*/\1/p' last)
        [ -n "$reached" ] || fault 'the last line does not say what time was saved'
        has last 'the disk is full'
        below 2e-4 "$reached"
        [ -z "$(find disk/out -name '*.tmp')" ] || fault 'half a file is left'
        [ ! -e disk/out/checkpoint.reserve ] || fault 'the room that was kept is still taken'
        [ "$(json disk/out/summary.json status)" = failed ] || fault 'the summary does not say that the run has failed'
        rm disk/fill
        expect 0 "$FLOE" run "${scene_of[@]}" -o disk/out --resume --quiet
        has disk/out/run.log "from t = $reached s"
        same_results elsewhere/$rule disk/out
    else
        # Nothing was kept, as the deck wants none: said, and what there is is whole.
        has last 'the disk is full'
        [ -z "$(find disk/out -name '*.tmp')" ] || fault 'half a file is left'
    fi
    umount disk
done

# There is less than a checkpoint takes from the start: said before the first step, and the run goes on.
mount -t tmpfs -o size=300k none disk
got=0
"$FLOE" run "${scene[@]}" --set time.max_steps=5 -o disk/out >stdout 2>stderr || got=$?
has stderr 'there is no disk space for a checkpoint should an output fail'
umount disk
