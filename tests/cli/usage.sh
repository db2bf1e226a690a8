#!/usr/bin/env bash
# Commands, options and their errors; list and new.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

expect 0 "$FLOE" --version
has stdout 'floe '
# Threads that wait sleep, unless the environment wants something else (as GNU's OpenMP tells it: how often they look).
looks() {
    env -u OMP_WAIT_POLICY OMP_DISPLAY_ENV=verbose "$@" "$FLOE" run 2>&1 | sed -n "s/.*GOMP_SPINCOUNT *= *'\(.*\)'.*/\1/p" | tail -n 1
}
[ "$(looks)" = 0 ] || fault "threads that wait look $(looks) times before they sleep"
[ "$(looks GOMP_SPINCOUNT=77)" = 77 ] || fault 'how threads wait cannot be chosen'
expect 0 "$FLOE" --help
for command in check plan run compare study picture list new; do
    has stdout "$command"
    expect 0 "$FLOE" "$command" --help
    expect 2 "$FLOE" "$command" --no-such-option
    expect 0 "$FLOE" --help
done
expect 2 "$FLOE"
expect 2 "$FLOE" chek
has stderr "did you mean 'check'?"
expect 0 "$FLOE" help
has stdout 'stability'
expect 0 "$FLOE" help run
has stdout '--max-wall'
expect 2 "$FLOE" help frobnicate
has stderr 'neither a command nor a key'
expect 0 "$FLOE" help domain.cell
has stdout 'domain.cell'
has stdout 'spacing h of the mesh'
[ "$(grep -c '^[a-z]' stdout)" -eq 1 ] || fault 'domain.cell is one key'
awk 'length > 80 { exit 1 }' stdout || fault 'help of a key is wider than a terminal'
expect 0 "$FLOE" help bodies.block.motion
has stdout 'of a solid that does not deform'
expect 0 "$FLOE" help velocity
[ "$(grep -c '^[a-z]' stdout)" -gt 1 ] || fault 'velocity is a key of several'
expect 2 "$FLOE" run
has stderr 'which deck?'
expect 2 "$FLOE" run "$cylinder" --threads 0
expect 2 "$FLOE" run "$cylinder" --max-wall soon
expect 2 "$FLOE" compare "$cylinder" --axis domain.cell --quiet
has stderr 'KEY=V1,V2'

expect 0 "$FLOE" list
for topic in materials eos laws exchange reactions shapes bases normals exact references metrics boundaries fields; do
    has stdout "$topic"
    "$FLOE" list "$topic" >"list-$topic" || fault "list $topic"
done
has list-laws 'linear_elastic'
has list-laws 'bulk_modulus'
has list-eos 'ideal'
has list-shapes 'annulus'
has list-exchange 'schiller_naumann'
has list-reactions 'arrhenius'
has list-bases 'quadratic'
has list-exact 'lame'
has list-references 'hanging_mass'
has list-metrics 'eq13'
has list-metrics 'hmax_X'
has list-boundaries 'outlet'
has list-fields 'P_STRESS'
expect 2 "$FLOE" list metric
has stderr "did you mean 'metrics'?"

expect 0 "$FLOE" new 'A dam' -o dam.yaml
has dam.yaml 'A dam'
expect 0 "$FLOE" check dam.yaml
expect 2 "$FLOE" new -o dam.yaml
expect 2 "$FLOE" new dam.yaml
has stderr "'dam.yaml' is there already"
expect 0 "$FLOE" new other.yaml
[ ! -s stdout ] || fault 'a deck with a file of its own is written to standard output too'
expect 0 "$FLOE" check other.yaml
expect 0 "$FLOE" new --schema
has stdout 'json-schema.org'
expect 0 "$FLOE" new --reference
has stdout '# The deck'
expect 0 "$FLOE" new --completion bash
bash -n stdout || fault 'the completion is no bash'
expect 2 "$FLOE" new --completion zsh
# A reader that has seen enough is no error.
got=0
{ "$FLOE" new --reference 2>stderr || got=$?; echo "$got" >status; } | head -n 1 >/dev/null
[ "$(cat status)" -eq 0 ] || fault "a closed pipe gives $(cat status) instead of 0"
[ ! -s stderr ] || fault 'a closed pipe is complained about'
if [ -c /dev/full ]; then
    got=0
    "$FLOE" list >/dev/full 2>stderr || got=$?
    [ "$got" -eq 4 ] || fault "a full standard output gives $got instead of 4"
fi
