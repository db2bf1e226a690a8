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

# No file may grow beyond 64 KB, as if the disk were full: what was there stays.
expect 0 "$FLOE" run "${tiny[@]}" -o out --quiet --set time.max_steps=5
cp -r out before
expect 4 bash -c 'ulimit -f 64; exec "$@"' limited "$FLOE" run "$cylinder" --coupling mpm --set domain.cell=0.025 \
    -o big --quiet
has stderr 'error'
[ "$(json big/summary.json status)" = failed ] || fault 'the summary does not say that the run has failed'
expect 4 bash -c 'ulimit -f 1; exec "$@"' limited "$FLOE" run "${tiny[@]}" -o out --quiet
same_results out before
cmp out/checkpoint.h5 before/checkpoint.h5 || fault 'the earlier checkpoint is gone'

# A step far beyond the limit: status 3, place and cause in words, and the last good state.
expect 3 "$FLOE" run "${tiny[@]}" --set time.fixed_step=1e-3 -o wild
has stderr 'rejected'
has stderr 't = '
has stderr 'checkpoint.h5'
is_there wild/checkpoint.h5 wild/summary.json wild/run.log
[ "$(json wild/summary.json status)" = diverged ] || fault 'the summary does not say so'
[ "$(json wild/summary.json rejected_steps)" -ge 10 ] || fault 'no retries'
has wild/run.log 'rejected'
