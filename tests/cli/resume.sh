#!/usr/bin/env bash
# A run that was stopped and resumed has the bits of one that was not.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
scene=("$cylinder" --coupling mpm --set domain.cell=0.05)

expect 0 "$FLOE" run "${scene[@]}" -o whole --quiet

expect 5 "$FLOE" run "${scene[@]}" -o part --max-wall 0.1
has stderr '--resume'
[ "$(json part/summary.json status)" = interrupted ] || fault 'the summary does not say so'
below "$(json part/summary.json steps)" "$(json whole/summary.json steps)"
# As after a kill: outputs beyond the checkpoint, and half a row.
cp part/fields/000000.h5 part/fields/999999.h5.tmp
printf '1e9,3,0\n0.00' >>part/history.csv
expect 0 "$FLOE" run "${scene[@]}" -o part --resume --quiet
same_results whole part
[ "$(json part/summary.json eq13)" = "$(json whole/summary.json eq13)" ] || fault 'another error'
[ "$(json part/summary.json steps)" = "$(json whole/summary.json steps)" ] || fault 'other steps'

# The same with the gas on the cells.
coupled=("$cylinder" --coupling ice-mpm --set domain.cell=0.1)
expect 0 "$FLOE" run "${coupled[@]}" -o whole-coupled --quiet
expect 5 "$FLOE" run "${coupled[@]}" -o part-coupled --max-wall 0.05
below "$(json part-coupled/summary.json steps)" "$(json whole-coupled/summary.json steps)"
expect 0 "$FLOE" run "${coupled[@]}" -o part-coupled --resume --quiet
same_results whole-coupled part-coupled
[ "$(json part-coupled/summary.json eq13)" = "$(json whole-coupled/summary.json eq13)" ] || fault 'another error'

# The same with bodies in contact.
bars=("$FLOE_SOURCE/inputs/two_bars.yaml" --set domain.cell=0.25 --set time.end=0.15)
expect 0 "$FLOE" run "${bars[@]}" -o whole-bars --quiet
expect 5 "$FLOE" run "${bars[@]}" -o part-bars --max-wall 0.05
below "$(json part-bars/summary.json steps)" "$(json whole-bars/summary.json steps)"
expect 0 "$FLOE" run "${bars[@]}" -o part-bars --resume --quiet
same_results whole-bars part-bars
[ "$(json part-bars/summary.json contact_stick)" = "$(json whole-bars/summary.json contact_stick)" ] || fault 'other contacts'

# The same with a block that rests on a side.
block=("$FLOE_SOURCE/inputs/defaults/e3_block.yaml" --set domain.cell=0.025 --set time.end=0.06 --set 'bodies.block.velocity=[0.5,0]' --set 'loads={weight: {gravity: {acceleration: [0,-10]}}}')
expect 0 "$FLOE" run "${block[@]}" -o whole-block --quiet
expect 5 "$FLOE" run "${block[@]}" -o part-block --max-wall 0.05
below "$(json part-block/summary.json steps)" "$(json whole-block/summary.json steps)"
expect 0 "$FLOE" run "${block[@]}" -o part-block --resume --quiet
same_results whole-block part-block

# A signal stops a run as the wall clock does.
"$FLOE" run "${scene[@]}" -o killed --quiet 2>stderr &
pid=$!
sleep 0.15
kill -TERM "$pid" 2>/dev/null || true
got=0
wait "$pid" || got=$?
if [ "$got" -ne 0 ]; then # the machine may have been faster than the signal
    [ "$got" -eq 5 ] || fault "SIGTERM gives status $got instead of 5"
    expect 0 "$FLOE" run "${scene[@]}" -o killed --resume --quiet
fi
same_results whole killed

# Resume refuses another scene, and says what differs; a new end time is welcome.
expect 2 "$FLOE" run "${scene[@]}" -o part --resume --set damping.rate=1
has stderr 'another deck'
expect 4 "$FLOE" run "${scene[@]}" -o nowhere --resume
[ ! -e nowhere ] || fault 'a resume without a checkpoint has made a folder'
expect 0 "$FLOE" run "${tiny[@]}" -o longer --set time.end=1e-4 --quiet
expect 0 "$FLOE" run "${tiny[@]}" -o longer --set time.end=2e-4 --resume --quiet
[ "$(json longer/summary.json status)" = 'done' ] || fault 'the longer run is not done'
