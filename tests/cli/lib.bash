# What the command-line tests share. Sourced: FLOE is the program, FLOE_SOURCE the source tree.
set -euo pipefail
# One thread, for tests run side by side; where more are meant, the test says so.
export OMP_NUM_THREADS=1 OMP_WAIT_POLICY=passive
: "${FLOE:?the floe program}" "${FLOE_SOURCE:?the source tree}"
# Python with the packages for pictures, plots and pages. Tests that are not of them draw nothing, and take no time for it:
# those that are set FLOE_PYTHON=$python, and skip what they ask where `python_is_whole` fails.
python=${FLOE_PYTHON:-/usr/bin/python3}
export FLOE_PYTHON=true PYTHONDONTWRITEBYTECODE=1
python_is_whole() {
    "$python" -c 'import numpy, h5py, matplotlib, jinja2' 2>/dev/null
}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

cylinder=$FLOE_SOURCE/inputs/pressurized_cylinder.yaml
# shellcheck disable=SC2034 # for the tests
# The cylinder, coarse and as points: a run of a fraction of a second.
tiny=("$cylinder" --coupling mpm --set domain.cell=0.1)

fault() {
    echo "FAILED: $*" >&2
    [ -f stderr ] && sed 's/^/    stderr: /' stderr >&2
    exit 1
}

# expect STATUS COMMAND...: runs the command with its output in ./stdout and ./stderr.
expect() {
    local wanted=$1 got=0
    shift
    "$@" >stdout 2>stderr || got=$?
    [ "$got" -eq "$wanted" ] || fault "exit status $got instead of $wanted: $*"
}

# has FILE TEXT: the text occurs in the file.
has() {
    grep -qF -- "$2" "$1" || fault "'$2' is not in $1: $(head -c 600 "$1")"
}

# check_refuses DECK TEXT KEY=VALUE...: `check` of the deck with these settings ends with status 2 and says TEXT.
check_refuses() {
    local deck=$1 text=$2 set=() setting
    shift 2
    for setting in "$@"; do set+=(--set "$setting"); done
    expect 2 "$FLOE" check "$deck" "${set[@]}"
    has stderr "$text"
}

# Ends the test as skipped where the program, and so its library, has sanitizers: those are for programs with them.
needs_plain_library() {
    "$FLOE" --version | grep -q -e '-fsanitize' || return 0
    echo 'skipped: a library with sanitizers is for programs with them'
    exit 77
}

# is_there PATH...
is_there() {
    local path
    for path in "$@"; do
        [ -s "$path" ] || fault "$path is not there, or empty"
    done
}

# json FILE KEY: the first value of that key in a JSON file as floe writes it, without quotes and comma.
json() {
    sed -nE "s/^ *\"$2\": //p" "$1" | head -n 1 | sed -E 's/,$//; s/^"//; s/"$//'
}

# below VALUE LIMIT: both are numbers, and VALUE < LIMIT.
below() {
    awk -v a="$1" -v b="$2" 'BEGIN { exit !(a ~ /^[-+0-9.eE]+$/ && a + 0 < b + 0) }' || fault "'$1' is not below $2"
}

# even_columns DIR: every row of every table (CSV) under the folder has as many fields as there are names above it, and no name stands there twice.
even_columns() {
    local file found=0
    while IFS= read -r file; do
        found=1
        awk '{ gsub(/"[^"]*"/, "text"); n = split($0, field, ",") }
             NR == 1 { wanted = n; for (k = 1; k <= n; k++) if (field[k] == "" || seen[field[k]]++) exit 1 }
             n != wanted { exit 1 }' "$file" || fault "a table with uneven columns: $file: $(head -n 2 "$file")"
    done < <(find "$1" -name '*.csv')
    [ "$found" -eq 1 ] || fault "no table under $1"
}

# same_results DIR DIR: the same history and snapshots, bit for bit.
same_results() {
    local file
    cmp "$1/history.csv" "$2/history.csv" || fault "other histories"
    [ "$(ls "$1/fields")" = "$(ls "$2/fields")" ] || fault "other snapshots"
    for file in "$1"/fields/*.h5; do
        cmp "$file" "$2/fields/${file##*/}" || fault "other bits in ${file##*/}"
    done
}

# kill_with_runs PID: kills a program and the runs that it has started, and waits until all have gone. Runs are found first: they
# end by themselves once their parent has gone, but not at once.
kill_with_runs() {
    local pid=$1 run runs
    runs=$(cat "/proc/$pid/task/$pid/children" 2>/dev/null || true)
    # shellcheck disable=SC2086 # none or several
    kill -KILL "$pid" $runs 2>/dev/null || true
    { wait "$pid"; } 2>/dev/null || true
    for run in $runs; do
        while kill -0 "$run" 2>/dev/null && ! grep -qs '^State:[[:space:]]*Z' "/proc/$run/status"; do sleep 0.01; done
    done
}
