#!/usr/bin/env bash
# What `check` refuses `run` refuses in the same words, and the other way about: decks of inputs/ under every coupling, and what was found
# apart; of the mistakes mistakes.sh tells. FLOE_EVERY: all decks, the mistakes too, and each run goes on from its checkpoint; FLOE_STEPS: of each run (1);
# FLOE_TOTALS: a file for the totals. So `scripts/nightly.sh decks` takes programs with sanitizers through every deck.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
apart=0 total=0 went=0 findings=0
steps=${FLOE_STEPS:-1}

# What sanitizers say of a program.
look_for_findings() { # FILE WHAT
    if grep -qE 'runtime error:|Sanitizer:' "$1"; then
        findings=$((findings + 1))
        echo "$2: $(grep -E 'runtime error:|Sanitizer:' "$1" | head -n 1)"
    fi
}

# verdicts DECK SETTING...: status and words of both; a run takes a step.
verdicts() {
    local deck=$1 setting arguments=() checked=0 ran=0
    shift
    for setting in "$@"; do arguments+=(--set "$setting"); done
    total=$((total + 1))
    "$FLOE" check "$deck" "${arguments[@]}" >/dev/null 2>checked || checked=$?
    rm -rf ran.out
    "$FLOE" run "$deck" "${arguments[@]}" --set "time.max_steps=$steps" --quiet -o ran.out >/dev/null 2>ran || ran=$?
    look_for_findings checked "check $deck $*"
    look_for_findings ran "run $deck $*"
    [ "$ran" -ne 0 ] || went=$((went + 1))
    sed -i '/warning:/d' checked ran
    if [ "$checked" -ne "$ran" ] || { [ "$ran" -ne 0 ] && ! cmp -s checked ran; }; then
        apart=$((apart + 1))
        echo "$deck $*: check $checked, run $ran"
        sed 's/^/    check: /' checked | head -3
        sed 's/^/    run: /' ran | head -3
    elif [ "$ran" -ne 0 ] && [ "$ran" -ne 2 ]; then
        apart=$((apart + 1))
        echo "$deck $*: status $ran of both, which is no refusal: $(head -c 300 ran)"
    elif [ "$ran" -eq 0 ] && [ -n "${FLOE_EVERY:-}" ]; then
        "$FLOE" run "$deck" "${arguments[@]}" --set "time.max_steps=$((2 * steps))" --quiet -o ran.out --resume >/dev/null 2>resumed || {
            apart=$((apart + 1))
            echo "$deck $*: does not go on from its checkpoint: $(head -c 300 resumed)"
        }
        look_for_findings resumed "resume $deck $*"
    fi
}

# At length only: every day mistakes.sh does so.
while IFS='|' read -r class deck settings _; do
    case $class in '#'* | '') continue ;; esac
    [ -n "${FLOE_EVERY:-}" ] || break
    read -r deck <<<"$deck"
    IFS=';' read -ra list <<<"$(sed -E 's/^ +//; s/ +$//' <<<"$settings")"
    verdicts "$FLOE_SOURCE/tests/mistakes/$deck.yaml" "${list[@]}"
done <"$FLOE_SOURCE/tests/mistakes/list.txt"

# References without their pressure, fluids that cannot be, at the start, on sides and in reservoirs.
noh=$FLOE_SOURCE/inputs/noh.yaml sedov=$FLOE_SOURCE/inputs/sedov.yaml
for setting in verify.exact.noh.pressure=0 'verify.exact.noh={gamma: 1.6666666666666667, geometry: 0}' verify.exact.noh.pressure=-1 \
    bodies.gas.temperature=-1 'boundaries.x.upper={reservoir: {pressure: -1, temperature: 300}}'; do
    verdicts "$noh" study=null "$setting"
    grep -q 'error' ran || { echo "$setting is not refused"; apart=$((apart + 1)); }
done
verdicts "$sedov" study=null verify.exact.sedov.pressure=null
grep -q 'sedov.pressure' ran || { echo 'no remedy for a blast into nothing'; apart=$((apart + 1)); }

# Every seventh deck; all of them at length.
every=${FLOE_EVERY:+1}
k=0
for deck in "$FLOE_SOURCE"/inputs/*.yaml "$FLOE_SOURCE"/inputs/*/*.yaml; do
    k=$((k + 1))
    [ $((k % ${every:-7})) -eq 0 ] || continue
    for coupling in mpm ice ice-mpm; do verdicts "$deck" study=null compare=null coupling=$coupling; done
done

said="$total scenes, $went of them ran $steps steps${FLOE_EVERY:+ and as many more from a checkpoint}; $apart judged apart by check and run; $findings findings"
echo "$said"
[ -z "${FLOE_TOTALS:-}" ] || echo "$said" >>"$FLOE_TOTALS"
[ $((apart + findings)) -eq 0 ] || fault "$apart of $total, $findings findings"
