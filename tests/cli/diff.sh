#!/usr/bin/env bash
# floe diff: two runs of one deck have nothing apart; another step, mesh or deck is told with the quantity, its size and its time.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
python_is_whole || {
    echo 'skipped: no Python with numpy, h5py, matplotlib and jinja2'
    exit 77
}
export FLOE_PYTHON=$python

short=(--quiet --set time.end=2e-5 --set output.interval=1e-5)
expect 0 "$FLOE" run "${tiny[@]}" "${short[@]}" -o first
expect 0 "$FLOE" run "${tiny[@]}" "${short[@]}" --set domain.blocks='[2, 1]' -o again
expect 0 "$FLOE" run "${tiny[@]}" "${short[@]}" --set time.cfl=0.3 -o slower
expect 0 "$FLOE" run "${tiny[@]}" "${short[@]}" --set bodies.cylinder.points=3 -o denser

# The same bits, whatever the blocks and the order of the points.
expect 0 "$FLOE" diff first again --exact
has stdout 'snapshots at the same times'
has stdout ' 0 of them differ'

# What differs stands with its share; --tolerance judges by the largest.
expect 0 "$FLOE" diff first slower --all
has stdout 'points/cylinder/stress_xx'
expect 6 "$FLOE" diff first slower --exact
expect 6 "$FLOE" diff first slower --tolerance 1e-12
expect 0 "$FLOE" diff first slower --tolerance 10
[ "$("$FLOE" diff first slower | awk '{ if (length > most) most = length } END { print most }')" -le 100 ] || fault 'a line is too long'

# Columns that one run alone has, and fields of other sizes.
sed '1s/^time (s),/time (s),mine (J),/; 2,$s/^\([^,]*\),/\1,1,/' first/history.csv >history.csv
mkdir column && cp -r first/fields column && cp history.csv column/history.csv
expect 0 "$FLOE" diff column first
has stdout 'only in column: mine'
expect 0 "$FLOE" diff first denser
has stderr "the runs have other points of 'cylinder'"

# A number that is none differs from one that is.
awk -F, -v OFS=, 'NR == 2 { $6 = "nan" } { print }' first/history.csv >column/history.csv
expect 6 "$FLOE" diff column first --tolerance 1e9
has stdout 'inf'

expect 2 "$FLOE" diff first
expect 2 "$FLOE" diff first again slower
expect 2 "$FLOE" diff first again --tolerance -1
expect 4 "$FLOE" diff first nowhere
has stderr "'nowhere' holds no history.csv and no snapshots"
