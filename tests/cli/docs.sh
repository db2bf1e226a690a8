#!/usr/bin/env bash
# Tutorials and notebooks do what they say: every block and cell is run, what it prints is what stands there; the options of the guide's commands exist.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
python_is_whole || {
    echo 'skipped: no Python with numpy, h5py, matplotlib and jinja2'
    exit 77
}
needs_plain_library
FLOE_LIBRARY=$(dirname "$FLOE")/libfloe.so
export FLOE FLOE_LIBRARY

expect 0 "$python" "$FLOE_SOURCE/scripts/notebooks.py" check "$FLOE_SOURCE"/docs/notebooks/*.ipynb
cat stdout
expect 0 "$python" "$FLOE_SOURCE/scripts/tutorials.py" check "$FLOE_SOURCE"/docs/tutorials/[a-z]*.md "$FLOE_SOURCE/docs/python.md"
cat stdout

# A cell or a block that does something else is found.
mkdir -p docs
cp "$FLOE_SOURCE/docs/notebooks/study.ipynb" docs/other.ipynb
sed -i 's/coupling=ice,mpm/coupling=ice/' docs/other.ipynb
expect 1 "$python" "$FLOE_SOURCE/scripts/notebooks.py" check docs/other.ipynb
has stderr 'cell'

# Each option of a command in the guide and in README is one of that command's.
for page in docs/guide.md README.md; do
    { grep -E '^    floe [a-z]+ ' "$FLOE_SOURCE/$page" || true; } | sed 's/ #.*//' | while read -r _ command words; do
        [ -f "help-$command" ] || "$FLOE" "$command" --help >"help-$command" || fault "$page: floe $command"
        for word in $words; do
            case $word in
            --*) grep -qE -e "(^|[ ,])${word%%=*}([ =,[]|\$)" "help-$command" || fault "$page: floe $command has no $word" ;;
            esac
        done
    done
done
