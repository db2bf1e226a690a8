#!/usr/bin/env bash
# python/floe: what it reads of result folders is what floe's own files and sums say; tables; plots, pictures and pages.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
python_is_whole || {
    echo 'skipped: no Python with numpy, h5py, matplotlib and jinja2 (Debian: python3-numpy, python3-h5py, python3-matplotlib, python3-jinja2)'
    exit 77
}

expect 0 "$FLOE" compare "$FLOE_SOURCE/inputs/sod.yaml" --axis domain.cell=0.02,0.01 --repeat 0 -o sod --quiet
expect 0 "$FLOE" run "$cylinder" --coupling ice-mpm --set domain.cell=0.1 --set time.end=1e-4 --set output.interval=5e-5 -o ring --quiet
expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/pressurized_sphere.yaml" --set domain.cell=0.1 --set time.max_steps=4 -o axis --quiet
expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/membrane_sphere.yaml" --set time.max_steps=2 -o space --quiet
export PYTHONPATH=$FLOE_SOURCE/python
expect 0 "$python" "$FLOE_SOURCE/tests/python/test_floe.py" sod ring
cat stdout
expect 0 "$python" "$FLOE_SOURCE/tests/python/test_pictures.py" sod ring axis space
cat stdout
expect 0 "$python" "$FLOE_SOURCE/tests/python/test_verdict.py"
cat stdout
expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/two_bags.yaml" --set time.max_steps=3 -o bags --quiet
expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/cylinder_channel.yaml" --set time.max_steps=3 -o fixed --quiet
expect 0 "$python" "$FLOE_SOURCE/tests/python/test_space.py" space bags fixed
cat stdout
FLOE=$FLOE expect 0 "$python" "$FLOE_SOURCE/tests/python/test_pages.py"
cat stdout
