#!/usr/bin/env bash
# floe picture: PNG of any snapshot, by default and as asked for; errors that name what there is.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
python_is_whole || {
    echo 'skipped: no Python with numpy, h5py, matplotlib and jinja2'
    exit 77
}
export FLOE_PYTHON=$python

# png FILE [WIDTH]: it is one, of that width (bytes 16 to 19), whole to its last chunk.
png() {
    is_there "$1"
    [ "$(head -c 8 "$1" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] || fault "$1 is no PNG"
    [ "$(tail -c 8 "$1" | od -An -tx1 | tr -d ' \n')" = 49454e44ae426082 ] || fault "$1 has no end"
    [ "$(od -An -tu1 -j16 -N4 "$1" | awk '{ print (($1 * 256 + $2) * 256 + $3) * 256 + $4 }')" = "${2:-720}" ] ||
        fault "$1 is not ${2:-720} pixels wide"
}

short=(--quiet --set time.max_steps=40 --set 'output.interval=20 us')
expect 0 "$FLOE" run "${tiny[@]}" "${short[@]}" -o mpm
expect 0 "$FLOE" run "${tiny[@]}" "${short[@]}" --coupling ice-mpm -o ice-mpm
expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/sod.yaml" --quiet --coupling ice --set time.max_steps=5 -o sod

last=$(basename "$(find mpm/fields -name '*.h5' | sort | tail -n 1)" .h5)
expect 0 "$FLOE" picture mpm
has stdout "mpm/pictures/$last.png"
png "mpm/pictures/$last.png"

# What is asked for is in the name; --all gives one a snapshot.
expect 0 "$FLOE" picture mpm --time 0 --points sigma_theta --range -1e6:1e6 --dark --width 400
png mpm/pictures/000000-sigma_theta-dark.png 400
expect 0 "$FLOE" picture ice-mpm --points none --all
[ "$(wc -l <stdout)" = "$(find ice-mpm/fields -name '*.h5' | wc -l)" ] || fault 'not one picture a snapshot'
while read -r file; do png "$file"; done <stdout

# A time beyond the run is told.
expect 0 "$FLOE" picture mpm --time 5 -o beyond.png
has stderr 'and none at 5: the nearest is shown'

# Errors: what there is instead.
expect 2 "$FLOE" picture mpm --points stress
has stderr "there is no field 'stress' of points"
has stderr 'sigma_r, sigma_theta, stress_xx'
expect 2 "$FLOE" picture
expect 2 "$FLOE" picture mpm --range 3
expect 2 "$FLOE" picture mpm --range 3:2
expect 2 "$FLOE" picture mpm --time soon
expect 2 "$FLOE" picture mpm --all --time 1
expect 2 "$FLOE" picture mpm --all -o one.png
expect 2 "$FLOE" picture mpm --width 20
expect 2 "$FLOE" picture mpm --plane 0.5
expect 2 "$FLOE" picture mpm --mirror z
for view in 30 30, ,20 30,100 a,b 30,20,1; do expect 2 "$FLOE" picture mpm --view "$view"; done
expect 2 "$FLOE" picture mpm --view 30,20
has stderr '--view is for scenes in 3-D'
expect 4 "$FLOE" picture nowhere
has stderr 'nowhere'

# A damaged snapshot is passed over; nothing is drawn of it.
printf 'x' | dd of=mpm/fields/000000.h5 bs=1 seek=4000 conv=notrunc status=none
expect 0 "$FLOE" picture mpm --time 0 -o next.png
has stderr 'damaged'
for file in mpm/fields/*.h5; do printf 'x' | dd of="$file" bs=1 seek=4000 conv=notrunc status=none; done
expect 4 "$FLOE" picture mpm

# Without Python: one line that says what to install.
expect 4 env FLOE_PYTHON="$work/none" "$FLOE" picture sod
[ "$(wc -l <stderr)" -eq 1 ] || fault 'not one line'
has stderr 'install python3-numpy, python3-h5py, python3-matplotlib and python3-jinja2'
mkdir empty
echo 'raise ModuleNotFoundError("No module named x", name="numpy")' >empty/numpy.py
expect 4 env PYTHONPATH="$work/empty" "$FLOE" picture sod
has stderr 'lacks a package'
