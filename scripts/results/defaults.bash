# defaults: problems that no deck was tuned for, with defaults only: rows of scripts/results/defaults. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

result_defaults() {
    begin defaults 'Defaults: what a user gets without turning a key'
    write 'Each deck of `inputs/defaults` names a scene and no method. Errors are those against exact or published solutions; CPU seconds' \
        'are those of one thread. A coupling that is right is held to a bar; one that is not yet shows its figure and the warning that a user gets.' ''
    FLOE=$floe FLOE_OUT=$runs FLOE_BARS=$bars /usr/bin/python3 scripts/results/defaults/rows.py ${DEFAULTS_ROWS:-} >>"$page"
    commands=('run inputs/defaults/DECK.yaml --coupling COUPLING')
    commands=("${commands[@]/#/floe }")
    finish
}
