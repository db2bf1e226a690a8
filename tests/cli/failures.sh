#!/usr/bin/env bash
# What cannot be: folders that cannot be written, a disk that is full, a run that diverges.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

# A folder below a file, which no one may make, root included.
: >file
expect 4 "$FLOE" run "${tiny[@]}" -o file/out
has stderr "'file'"
if [ "$(id -u)" -ne 0 ]; then
    mkdir closed
    chmod a-w closed
    expect 4 "$FLOE" run "${tiny[@]}" -o closed/out
fi

# Folders that no one may write to, root included, and files that are no files.
expect 4 "$FLOE" run "${tiny[@]}" -o /proc/floe
has stderr "'/proc/floe'"
expect 4 "$FLOE" run "${tiny[@]}" -o /dev/null
has stderr "'/dev/null'"
expect 4 "$FLOE" run /nowhere/deck.yaml -o out
has stderr '/nowhere/deck.yaml'
expect 4 "$FLOE" check .
mkdir -p blocked/checkpoint.h5
expect 4 "$FLOE" run "${tiny[@]}" -o blocked --quiet
has stderr 'checkpoint.h5'
expect 4 "$FLOE" run "${tiny[@]}" -o blocked --resume
has stderr 'folder'

# As someone else, if this is root and the program can be run by others: folders and files closed to them.
stranger() {
    setpriv --reuid 65534 --regid 65534 --clear-groups "$@"
}
if [ "$(id -u)" -eq 0 ] && chmod 711 . && stranger "$FLOE" --version >/dev/null 2>&1 && stranger test -r "$cylinder"; then
    mkdir closed && chmod 755 closed
    expect 4 stranger "$FLOE" run "${tiny[@]}" -o closed/out
    has stderr 'no permission'
    expect 4 stranger "$FLOE" run "${tiny[@]}" -o closed
    has stderr 'no permission'
    cp "$cylinder" secret.yaml && chmod 600 secret.yaml
    expect 4 stranger "$FLOE" check secret.yaml
    has stderr 'ermission'
fi

# No file may grow beyond 64 KB, as if the disk were full: what was there stays. The thread sanitizer keeps its own
# memory in a file, and cannot bear that.
if ! "$FLOE" --version | grep -qF fsanitize=thread; then
    expect 0 "$FLOE" run "${tiny[@]}" -o out --quiet --set time.max_steps=5
    cp -r out before
    expect 4 bash -c 'ulimit -f 64; exec "$@"' limited "$FLOE" run "$cylinder" --coupling mpm --set domain.cell=0.025 \
        -o big --quiet
    has stderr 'error'
    [ "$(json big/summary.json status)" = failed ] || fault 'the summary does not say that the run has failed'
    expect 4 bash -c 'ulimit -f 1; exec "$@"' limited "$FLOE" run "${tiny[@]}" -o out --quiet
    same_results out before
    cmp out/checkpoint.h5 before/checkpoint.h5 || fault 'the earlier checkpoint is gone'
fi

# A step far beyond the limit: status 3, place and cause in words, and the last good state.
expect 3 "$FLOE" run "${tiny[@]}" --set time.fixed_step=1e-3 -o wild
has stderr 'rejected'
has stderr 't = '
has stderr 'checkpoint.h5'
is_there wild/checkpoint.h5 wild/summary.json wild/run.log
[ "$(json wild/summary.json status)" = diverged ] || fault 'the summary does not say so'
[ "$(json wild/summary.json rejected_steps)" -ge 10 ] || fault 'no retries'
has wild/run.log 'rejected'
