# extreme: every deck of inputs/extreme as a study with verdicts. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# verdicts CSV right|refused|wrong: how many cases of a study have it.
verdicts() {
    awk -F, -v wanted="$2" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "verdict") from = NF - i; next }
        { n += $0 ~ ("," wanted ",\"[^\"]*\"$") } END { print n + 0 }' "$1"
}

result_extreme() {
    begin extreme 'Extreme scenes: right, refused or wrong'
    local deck stem title right refused wrong cases all=0 all_right=0 all_refused=0 all_wrong=0 table=() failures=() refusals=()
    for deck in inputs/extreme/*.yaml; do
        stem=$(basename "$deck" .yaml)
        rm -rf "$runs/$stem"
        "$floe" study "$deck" -o "$runs/$stem" --quiet 2>"$runs/$stem.log" || [ $? -eq 6 ]
        commands+=("floe study $deck -o $stem")
        title=$(sed -n '1s/^# //p' "$deck")
        right=$(verdicts "$runs/$stem/study.csv" right)
        refused=$(verdicts "$runs/$stem/study.csv" refused)
        wrong=$(verdicts "$runs/$stem/study.csv" wrong)
        cases=$(($(wc -l <"$runs/$stem/study.csv") - 1))
        table+=("| [$stem](../../$deck) | $title | $cases | $right | $refused | $wrong |")
        [ "$refused" -eq 0 ] || refusals+=("* $stem: $(sed -n '/^  refuse:/,$s/.*why: \(.*\)}$/\1/p' "$deck" | sort -u | paste -sd ';' | sed 's/;/; /g').")
        all=$((all + cases)) all_right=$((all_right + right)) all_refused=$((all_refused + refused)) all_wrong=$((all_wrong + wrong))
        while IFS= read -r line; do failures+=("* $stem: $line"); done < <(sed -n 's/^    \(wrong\|refused\), /\1, /p' "$runs/$stem.log")
    done
    bar 'cases' "$all" '>=' 150 %d
    bar 'right, share of all' "$(calc %g "100 * $all_right / $all")" '>=' 90 %.1f ' %'
    bar 'wrong' "$all_wrong" '<=' 0 %d
    bar 'neither right, refused nor wrong' "$((all - all_right - all_refused - all_wrong))" '<=' 0 %d
    write 'Each deck is a study whose axes are crossed, and says in its head what is checked of each case, and by what: an exact solution, a bound, or a balance.' \
        'A case is *right* if it comes to its end and keeps to all checks, *refused* if floe ends it with the reason, else *wrong*.' '' '## Bars' ''
    show_bars
    write '' '## Decks' '' '| deck | scene | cases | right | refused | wrong |' '|---|---|---|---|---|---|' "${table[@]}" \
        "| all | | $all | $all_right | $all_refused | $all_wrong |" ''
    [ ${#refusals[@]} -eq 0 ] || write '## Refused' '' 'As the decks say, floe ends these before they start, with the reason:' '' "${refusals[@]}" ''
    [ ${#failures[@]} -eq 0 ] || write '## Not right' '' "${failures[@]}" ''
    finish
}
