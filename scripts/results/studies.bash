# studies: the studies that stand in the decks: every coupling and basis, error against run time. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# study_section NAME DECK TEXT...: runs the study of a deck, and shows what floe says of it and draws.
study_section() {
    local short=$1 deck=$2 log=$runs/$1.txt status=0
    shift 2
    commands+=("floe study $deck -o $short" "floe report $short -o $short.html")
    echo "  floe study $deck" >&2
    rm -rf "${runs:?}/$short"
    "$floe" study "$deck" -o "$runs/$short" >"$log" 2>"$log.err" || status=$?
    [ $status -eq 0 ] || [ $status -eq 6 ] || {
        echo "results.sh: failed: floe study $deck; see $log.err" >&2
        return 1
    }
    "$floe" report "$runs/$short" -o "$runs/$short.html" --quiet
    cp "$runs/$short/study.csv" "$results/studies-$short.csv"
    write "## $(head -n 1 "$log")" '' "$@" '' "    floe study $deck" '' '```'
    # The first line is the title, the last names the folder.
    sed '1d;$d' "$log" >>"$page"
    write '```' ''
    if [ -f "$runs/$short/errors.svg" ]; then
        cp "$runs/$short/errors.svg" "$results/studies-$short.svg"
        write "![error against spacing, run time and updates](studies-$short.svg)" ''
    fi
    bar "$deck: required orders and errors that were missed" "$(grep -c '^MISSED' "$log")" '<=' 0 %.0f
    bar "$deck: cases that did not come to their end" \
        "$(awk -F, -v at="$(column "$csv_of" status)" 'NR > 1 && $at != "done" && $at != "at_rest" { n++ } END { print n + 0 }' "$csv_of")" '<=' 0 %.0f
}

result_studies() {
    begin studies 'Studies: error against run time'
    local csv_of
    write 'What `floe study` says of the studies that stand in the decks. Each case is a process; timed runs are alone on one thread, and the best counts.' \
        '`floe report` makes a page of each, with the pictures, ledgers and times by stage of every case. The table and the plots are those of the page.' ''
    csv_of=$runs/cylinder/study.csv
    study_section cylinder inputs/pressurized_cylinder.yaml \
        'Both couplings, three bases, four spacings: eq. 13 and stresses against Lamé (row A1 of Guilkey et al. 2003).'
    csv_of=$runs/sod/study.csv
    study_section sod inputs/sod.yaml \
        'The gas on cells, and as points, nine a cell (row B1; York has 100 cells and linear functions, `--set method.basis=linear`).'
    csv_of=$runs/vortex/study.csv
    study_section vortex inputs/isentropic_vortex.yaml 'Smooth flow in two dimensions: what the limiter costs.'
    csv_of=$runs/pulse/study.csv
    study_section pulse inputs/acoustic_pulse.yaml 'Smooth flow in one dimension: both time centrings.'
    write "Up to which time step York's line of points is stable, in each placement and scheme, is on the page [stability](stability.md)." '' '## Bars' ''
    show_bars
    finish
}
