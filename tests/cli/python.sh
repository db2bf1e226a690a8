#!/usr/bin/env bash
# python/floe: what it reads of result folders is what floe's own files and sums say; tables; plots, which are the same bytes twice.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

python=
for candidate in "${FLOE_PYTHON:-/usr/bin/python3}" python3; do
    if "$candidate" -c 'import numpy, h5py, matplotlib' 2>/dev/null; then
        python=$candidate
        break
    fi
done
if [ -z "$python" ]; then
    echo 'skipped: no Python with numpy, h5py and matplotlib (Debian: python3-numpy, python3-h5py, python3-matplotlib)'
    exit 77
fi

expect 0 "$FLOE" compare "$FLOE_SOURCE/inputs/sod.yaml" --axis domain.cell=0.02,0.01 --repeat 0 -o sod --quiet
expect 0 "$FLOE" run "$cylinder" --coupling ice-mpm --set domain.cell=0.1 --set time.end=1e-4 --set output.interval=5e-5 -o ring --quiet
PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$FLOE_SOURCE/python expect 0 "$python" "$FLOE_SOURCE/tests/python/test_floe.py" sod ring
cat stdout
PYTHONDONTWRITEBYTECODE=1 expect 0 "$python" "$FLOE_SOURCE/tests/python/test_verdict.py"
cat stdout
FLOE=$FLOE PYTHONDONTWRITEBYTECODE=1 expect 0 "$python" "$FLOE_SOURCE/tests/python/test_pages.py"
cat stdout
