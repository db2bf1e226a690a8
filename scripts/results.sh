#!/usr/bin/env bash
# results.sh [NAME...]: makes the pages of docs/results, or one. `results.sh --help` says more, `results.sh list` which there are.
set -euo pipefail
cd "$(dirname "$0")/.."
export OMP_NUM_THREADS=1 LC_ALL=C.UTF-8 FLOE=${FLOE:-build/release/floe}
case ${1:-} in
    list | stale | index | -*) ;; # of what lies there
    *) [ -x "$FLOE" ] || scripts/build.sh release ;;
esac
exec /usr/bin/python3 scripts/lib/pages.py "$@"
