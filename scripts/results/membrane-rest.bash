# membrane-rest: membranes that gas blows up to a circle, against their exact rest. Sourced by scripts/results.sh. Runs that lie
# finished in out/results/membrane-rest are taken as they are; the dog-bone with cells of 0.1 and 0.05 takes minutes and an hour, and is left out unless
# its runs are there or FINEST is set; dogbone-0.05-16, with 16 gas points a cell instead of 64, stands in for dogbone-0.05.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# rest_error FOLDER QUANTITY: the error (%) over the last tenth of the time.
rest_error() {
    awk -F: -v n="\"hlate_$2\"" 'index($1, n) { printf "%.3g", 100 * $2 }' "$runs/$1/summary.json"
}

# late NAME: mean of a column of $csv over the last tenth of the time.
late() {
    awk -F, -v c="$(column "$csv" "$1")" 'NR > 1 { t[++n] = $1; y[n] = $c } END { for (i = n; t[i] >= 0.9 * t[n]; i--) { s += y[i]; k++ } printf "%.5g", s / k }' "$csv"
}

# energy: "change of the energy (%), largest drift (%)".
energy() {
    awk -F, -v k="$(column "$csv" kinetic)" -v s="$(column "$csv" strain)" -v i="$(column "$csv" internal)" -v d="$(column "$csv" drift_energy)" '
        NR == 2 { first = $k + $s + $i } NR > 1 { last = $k + $s + $i; if ($d > w) w = $d } END { printf "%.3f %.3f\n", 100 * (last / first - 1), 100 * w }' "$csv"
}

# rest_row FOLDER H PUBLISHED: a row; errors are left in $worst (the largest of r, p, stress), $figures.
rest_row() {
    local change drift round
    read -r change drift < <(energy)
    round=$(calc %.3f "100*sqrt((($(late first_skin_x))/($(late last_skin_y))-1)^2)")
    figures=("$(rest_error "$1" radius)" "$(rest_error "$1" radius_last)" "$(rest_error "$1" pressure)" "$(rest_error "$1" hoop_stress)" "$round" "$drift" "$(late outside_skin)" "$(rest_error "$1" area)")
    worst=$(printf '%s\n' "${figures[@]:0:4}" | sort -g | tail -n 1)
    write "| $2 | $(late first_skin_x), $(late last_skin_y) | ${figures[0]}, ${figures[1]} | ${figures[7]} | $round | $(late pressure_in_skin) | ${figures[2]} | $(late stress_skin) | ${figures[3]} | ${figures[6]} | $change | $drift | $3 |"
}

rest_table() {
    write '' '| h | r at 0, 90 degrees | error, % | area, % | roundness, % | p | error, % | hoop stress | error, % | gas outside | energy, % | drift, % | published: r, p, stress |' \
        '|---|---|---|---|---|---|---|---|---|---|---|---|---|'
}

rest_plot() {
    local h from=() colour=([1]=grey [2]=ice [3]=mpm [4]=black) k=0
    for h in "$@"; do
        csv=$runs/dogbone-$h/history.csv
        k=$((k + 1))
        from+=("'$csv' every ::1 using 1:$(column "$csv" "$quantity") with lines lw 1.5 lc $([ $k = 4 ] && echo "rgb 'black'" || echo "rgb ${colour[k]}") title 'h = $h'")
    done
    plot "$quantity" 820,420 <<END
set xlabel 't'; set ylabel '$label'; set key right opaque
plot $(IFS=,; echo "${from[*]}")
END
}

result_membrane-rest() {
    begin membrane-rest 'Membranes that gas blows up: the exact rest'
    local h worst figures fewer falls=0 before='' quantity label sizes=(0.4 0.2)
    for h in 0.1 0.05; do
        if [ -n "${FINEST:-}" ] || [ -f "out/results/membrane-rest/dogbone-$h/summary.json" ]; then
            sizes+=("$h")
        elif [ -f "out/results/membrane-rest/dogbone-$h-16/summary.json" ]; then
            sizes+=("$h-16")
        fi
    done
    local number=([1]=56 [2]=100 [3]=200 [4]=600) k=0 published=('1.08, 1.13; 33.4; 394' '1.335, 1.334; 24.9; 372' '1.388, 1.387; 27.0; 417' '1.394, 1.396; 29.0; 447')
    write 'Total energy is conserved, so that the rest is exact: p r = E'"'"' eps t and p A/(gamma - 1) + strain energy = p0 A0/(gamma - 1) (`membrane_rest`,' \
        'for the length and the gas that are there). Errors are those of means over the last tenth of the time. Pressure: what all gas points hold, over the area inside.' \
        '*Roundness*: r at 0 degrees over that at 90. *Energy*: its change from start to end.' '' '## Dog-bone (Y97 6.2, box 9; Y00 4.3)' '' \
        '`inputs/membrane_dogbone.yaml`, which says what is printed and what chosen; 64 gas points a cell, 56, 100, 200 and 600 points on the membrane.'
    rest_table
    for h in "${sizes[@]}"; do
        k=$((k + 1))
        fewer=()
        [ "$h" = "${h%-16}" ] || fewer=(--set bodies.gas.points=4 --set bodies.knob.points=4)
        floe_run_kept "dogbone-$h" inputs/membrane_dogbone.yaml --set "domain.cell=${h%-16}" --set "bodies.skin.membrane.number=${number[k]}" "${fewer[@]}"
        rest_row "dogbone-$h" "${h/-16/, 16 gas points a cell}" "${published[k - 1]}"
        [ -n "$before" ] && [ "$(calc %d "$worst<$before")" = 1 ] && falls=$((falls + 1))
        before=$worst
    done
    h=${h%-16}
    bar "dog-bone at $h: r at 0 degrees" "${figures[0]}" '<=' 0.3 %.2g ' %'
    bar "dog-bone at $h: r at 90 degrees" "${figures[1]}" '<=' 0.3 %.2g ' %'
    bar "dog-bone at $h: pressure" "${figures[2]}" '<=' 1 %.2g ' %'
    bar "dog-bone at $h: hoop stress" "${figures[3]}" '<=' 1.5 %.2g ' %'
    bar "dog-bone at $h: roundness" "${figures[4]}" '<=' 0.2 %.2g ' %'
    bar "dog-bone at $h: drift of energy" "${figures[5]}" '<=' 0.1 %.2g ' %'
    bar "dog-bone at $h: gas outside, share of its mass" "$(calc %g "${figures[6]}/0.4746")" '<=' 0 %.2g
    bar 'dog-bone: halvings of h at which the largest of these errors of r, p and stress falls' $falls '>=' $((${#sizes[@]} - 1)) %d
    write '' '## Slack circle (S00 section 8)' '' '`inputs/membrane_circle.yaml`, radius 0.5, p0 = 1000; the paper has figures only. What damping takes the gas gets as heat.'
    rest_table
    for h in 0.1 0.05; do
        floe_run_kept "circle-$h" inputs/membrane_circle.yaml --set domain.cell=$h
        rest_row "circle-$h" $h -
        bar "circle at $h: largest error of r, p and hoop stress" "$worst" '<=' 0.5 %.2g ' %'
    done
    write '' '## Bars' ''
    show_bars
    quantity=pressure_in_skin label=pressure
    rest_plot "${sizes[@]}"
    quantity=first_skin_x label='r at 0 degrees'
    rest_plot "${sizes[@]}"
    write '' '## Against time' '' '![pressure of the dog-bone](membrane-rest-pressure_in_skin.svg)' '' '![radius of the dog-bone](membrane-rest-first_skin_x.svg)'
    finish
}
