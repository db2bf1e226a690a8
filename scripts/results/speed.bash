# speed: rates of the solvers. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

result_speed() {
    begin speed 'Speed on one core'
    made_also=(bench)
    local program coupling seconds cells points
    write 'Whole steps, on one core, each rate the best of several repeats: what else a machine does only makes it slower. The bars that the' \
        'programs print are budgets for later work. Rates differ by some ten per cent from' \
        'run to run, and by far more on a machine that is shared: within ten minutes of the 22nd of November one binary made 6 to 17 million cell updates a second of one gas.'
    for program in "$build"/bench/bench_*; do
        [[ -f $program && -x $program ]] || continue
        echo "  ${program##*/}" >&2
        commands+=("build/release/bench/${program##*/}")
        write '' "## ${program##*/}" ''
        "$program" | sed 's/^/    /' >>"$page"
    done
    floe_compare cylinder inputs/pressurized_cylinder.yaml --axis domain.cell=0.025
    cp "$csv" $results/speed-cylinder.csv
    write '' '## Pressurised cylinder, h = 0.025 m' '' '| coupling | steps | wall time | per cell and step | per point and step |' \
        '|---|---|---|---|---|'
    for coupling in mpm ice-mpm; do
        seconds=$(value "$csv" $coupling '' wall_seconds)
        cells=$(value "$csv" $coupling '' cell_updates)
        points=$(value "$csv" $coupling '' point_updates)
        write "$(printf '| %s | %s | %.2f s | %s | %.2f us |' $coupling "$(value "$csv" $coupling '' steps)" "$seconds" \
            "$(awk -v s="$seconds" -v c="$cells" 'BEGIN { if (c > 0) printf "%.2f us", 1e6 * s / c; else printf "-" }')" \
            "$(calc %g "1e6*$seconds/$points")")"
    done
    write '' 'Outputs and checkpoints included. The best-known open code takes 5.8 us a cell and step for this problem; the budget for' \
        "floe's later work is 0.5."
    finish
}
