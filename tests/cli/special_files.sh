#!/usr/bin/env bash
# What is no ordinary file is neither written through, nor replaced, nor waited for; links are not followed.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

# within SECONDS STATUS COMMAND...: as `expect`; a command that waits is ended, which is another status.
within() {
    local seconds=$1 wanted=$2
    shift 2
    expect "$wanted" timeout "$seconds" "$@"
}

python_is_whole && export FLOE_PYTHON=$python
expect 0 "$FLOE" run "${tiny[@]}" -o out --quiet --set time.max_steps=3

# Outputs: the page, the picture, the tables, the log.
mkfifo pipe
mkdir folder
ln -s /dev/null device
echo mine >victim
ln -s victim link
for place in pipe folder device link; do
    before=$(stat -c %F "$place")
    if python_is_whole && [ "$place" != device ] && [ "$place" != folder ]; then # python/floe/files.py writes both
        command=picture
        [ "$place" = link ] && command=report
        within 60 4 "$FLOE" $command out -o "$place"
        has stderr 'not an ordinary file'
    fi
    within 60 2 "$FLOE" new -o "$place"
    [ "$(stat -c %F "$place")" = "$before" ] || fault "$place was replaced"
done
[ "$(cat victim)" = mine ] || fault 'a link was written through'
for name in history.csv summary.json deck.yaml run.log fields.xdmf checkpoint.h5 .lock; do
    rm -rf blocked
    mkdir blocked
    mkfifo "blocked/$name"
    within 60 4 "$FLOE" run "${tiny[@]}" -o blocked --quiet --set time.max_steps=3
    [ -p "blocked/$name" ] || fault "$name was replaced"
    rm -r blocked
    mkdir blocked
    ln -s ../victim "blocked/$name"
    within 60 4 "$FLOE" run "${tiny[@]}" -o blocked --quiet --set time.max_steps=3
    [ "$(cat victim)" = mine ] || fault "a link was written through as $name"
    [ -L "blocked/$name" ] || fault "the link $name was replaced"
done

# Names that floe makes for a moment: a link of that name is not followed, and the run goes on.
rm -r blocked
mkdir -p blocked/fields
for name in history.csv summary.json deck.yaml run.log fields.xdmf checkpoint.h5 fields/000000.h5; do
    ln -s "$work/victim" "blocked/$name.tmp"
done
within 60 0 "$FLOE" run "${tiny[@]}" -o blocked --quiet --set time.max_steps=3
[ "$(cat victim)" = mine ] || fault 'a link of a passing name was written through'
same_results blocked out
ln -s "$work/victim" out/report.html.tmp
if python_is_whole; then
    within 60 0 "$FLOE" report out
    [ "$(cat victim)" = mine ] || fault 'the page was written through a link'
    is_there out/report.html
fi

# What a case of a study says goes to a new file.
study=(env FLOE_PYTHON=true "$FLOE" study "${tiny[@]}" --set study=null --axis "time.max_steps=1,2" --quiet -o cases)
"${study[@]}" >stdout 2>stderr || true
for case in cases/mpm-1 cases/mpm-2; do ln -sf "$work/victim" "$case/stderr.txt"; done
within 60 4 "${study[@]}" --again
has stderr 'a symbolic link'
[ "$(cat victim)" = mine ] || fault 'the messages of a case were written through a link'

# Inputs: decks, tables beside them, folders of runs.
for command in check run plan; do
    within 20 4 "$FLOE" "$command" pipe
    has stderr "'pipe'"
    has stderr 'a named pipe'
    within 20 4 "$FLOE" "$command" /dev/zero
    has stderr 'a device'
done
within 20 2 "$FLOE" check "$FLOE_SOURCE/inputs/membrane_dogbone.yaml" --set "bodies.skin.membrane.curve.polyline.vertices=$work/pipe"
has stderr 'a named pipe'
for name in summary.json checkpoint.h5 fields/000000.h5; do
    rm -rf copy
    cp -r out copy
    rm "copy/$name"
    mkfifo "copy/$name"
    commands=() # neither reads checkpoints
    [ "$name" = summary.json ] && commands=("report copy -o page.html")
    [ "$name" = fields/000000.h5 ] && commands=("picture copy --time 0 -o picture.png")
    for command in "${commands[@]}" "run ${tiny[*]} -o copy --resume --quiet"; do
        got=0
        # shellcheck disable=SC2086 # words
        timeout 60 "$FLOE" $command >stdout 2>stderr || got=$?
        [ "$got" -eq 0 ] || [ "$got" -eq 4 ] || fault "$command with a pipe as $name: status $got"
        [ -p "copy/$name" ] || fault "$command has replaced $name"
    done
done

# What the caller has opened is read whatever it is.
solid=$FLOE_SOURCE/tests/mistakes/solid.yaml
# shellcheck disable=SC2016
{
    expect 0 bash -c '"$0" check /dev/stdin <"$1"' "$FLOE" "$solid"
    expect 0 bash -c 'cat "$1" | "$0" plan /dev/stdin' "$FLOE" "$solid"
    expect 0 bash -c '"$0" check <(cat "$1")' "$FLOE" "$solid"
    expect 0 bash -c 'cat "$1" | "$0" run /dev/stdin --set time.max_steps=1 -o piped --quiet' "$FLOE" "$solid"
}
