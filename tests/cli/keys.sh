#!/usr/bin/env bash
# One deck is one scene: every key of the reference has a recipe by which it is changed, in a scene where it matters, as mpm, ice and ice-mpm
# (tests/verification/test_run_keys.c does). Parameters of models (laws, shapes, exact solutions) are the conformance tests' to ask.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

# Keys of the reference, without the parameters of registries.
"$FLOE" new --reference | awk '
    /^## Shapes/ { exit }
    /^## / { map = $0 ~ /^## Top level/ ? "" : substr($0, 4) "."; kind = ""; next }
    /^### / { kind = substr($0, 5) "."; next }
    /^\| `/ { split($0, cell, "`"); name = map ~ /^(tables|boundary_parts|materials|bodies|loads|exchange|reactions|springs|supports|sources|vents)\.$/ ? "NAME." : ""
              print map name kind cell[2] }' |
    grep -vE '^bodies\.NAME\.membrane\.(curve|surface)\.|^(constants|tables|boundary_parts|domain|materials|ambient|boundaries|bodies|loads|contact|exchange|reactions|springs|supports|sources|vents|damping|time|stop|method|output|verify|compare|study|stability)$|\.(viscosity|artificial_viscosity|membrane|from|to|outside)$' |
    sort -u >keys

# What no result of a single run depends on, what says which run it is, and what changes with everything else.
cat >exempt <<'END'
floe
title
source
units
coupling
runs_as
threads
domain.dim
domain.blocks
output.checkpoint_interval
compare.axis
study.axes
study.over
study.repeat
study.max_wall
study.quantities
study.require
study.check
study.refuse
study.unchanged
stability.over
stability.each
stability.tolerance
stability.growth
stability.relative_to
END

# Every key of the reference has a recipe, or stands among the exempt.
grep -v '^#' "$FLOE_SOURCE/tests/cli/decks/keys.recipes" | cut -d'|' -f1 | sort -u >told
comm -23 keys <(sort -u told exempt) >untold
[ ! -s untold ] || fault "keys without a recipe in keys.recipes: $(tr '\n' ' ' <untold)"

# With FLOE_VERDICTS=FILE the verdict on each key goes there (scripts/results/defaults/e9.py).
if [ -n "${FLOE_VERDICTS:-}" ]; then "$(dirname "$FLOE")/tests/verification_run_keys" 2>&1; fi
