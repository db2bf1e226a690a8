# extreme: every deck of inputs/extreme as a study with verdicts. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# lines TABLE KEY: what table.py says under a key.
lines() {
    sed -n "s/^$2\t//p" "$1"
}

# With EXTREME_KEEP=1 in the environment a deck whose study is there is not run again; the table has the commits that ran.
result_extreme() {
    begin extreme 'Extreme scenes: right, refused or wrong'
    local deck stem seconds table="$runs/table.txt" refusals=() reasons=()
    for deck in inputs/extreme/*.yaml; do
        stem=$(basename "$deck" .yaml)
        if [ -n "${EXTREME_KEEP:-}" ] && [ -f "$runs/$stem/study.json" ]; then
            kept=1
        else
            rm -rf "${runs:?}/$stem"
            "$floe" study "$deck" --spoil -o "$runs/$stem" --quiet 2>"$runs/$stem.log" || [ $? -eq 6 ]
        fi
        commands+=("floe study $deck --spoil -o $stem")
        while IFS= read -r line; do refusals+=("* $stem: $line."); done < <(sed -n '/^  refuse:/,/^  unchanged:/s/.*why: \(.*\)}$/\1/p' "$deck" | sort -u)
        while IFS= read -r line; do reasons+=("* $stem: $line."); done < <(sed -n '/^  unchanged:/,$s/.*by: \([a-z ]*\), why: \([^{]*\), where.*/\1: \2/p; /^  unchanged:/,$s/.*by: \([a-z ]*\), why: \([^{]*\)}$/\1: \2/p' "$deck" | sort -u)
    done
    /usr/bin/python3 scripts/results/extreme/table.py "$runs" inputs/extreme/*.yaml >"$table"
    bar 'cases' "$(lines "$table" cases)" '>=' 150 %d
    bar 'right, share of all' "$(calc %g "100 * ($(lines "$table" solution) + $(lines "$table" bound) + $(lines "$table" blind)) / $(lines "$table" cases)")" '>=' 90 %.1f ' %'
    bar 'wrong' "$(lines "$table" wrong)" '<=' 0 %d
    bar 'checked blindly' "$(lines "$table" blind)" '<=' 0 %d
    bar 'ended without a reason in the deck' "$(lines "$table" unforeseen)" '<=' 0 %d
    bar 'tolerances above twice the measured error' "$(lines "$table" loose_checks)" '<=' 0 %d
    write 'Each deck is a study whose axes are crossed, and says in its head what is checked of each case, and by what: an exact or published solution, that of an independent solver' \
        '(`scripts/results/extreme`), or a bound. A case is *right* if it comes to its end and keeps to all checks, *refused* if floe ends it with the reason, else *wrong*.' '' \
        'Of those that are right, a *solution* is compared in norms or over histories, or values in a *bound*, unless they are *blind*: each is judged again as if it had been frozen, not begun,' \
        'doubled, halved or mirrored (`floe study --spoil`, [guide](../guide.md)), and one that all of its checks let pass with any of the five, but where that is the right answer, is blind. The last column has the commits of the programs that the runs are of.' '' '## Bars' ''
    show_bars
    write '' '## Decks' '' '| deck | scene | couplings | cases | solution | bound | blind | refused | wrong | runs of |' '|---|---|---|---|---|---|---|---|---|---|' "$(lines "$table" row)" ''
    [ -z "$(lines "$table" failure)" ] || write '## Not right' '' "$(lines "$table" failure)" ''
    [ -z "$(lines "$table" blind_case)" ] || write '## Blind' '' "$(lines "$table" blind_case)" ''
    [ -z "$(lines "$table" loose)" ] || write '## Tolerances above twice the measured error' '' "$(lines "$table" loose)" ''
    [ ${#refusals[@]} -eq 0 ] || write '## Refused' '' 'floe ends these with a reason, before they start or on the way; the decks say which, and why:' '' "${refusals[@]}" ''
    [ ${#reasons[@]} -eq 0 ] || write '## Unchanged' '' 'What leaves the right answer as it is, by the decks; that it does is checked too:' '' "${reasons[@]}" ''
    finish
}
