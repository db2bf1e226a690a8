# conservation: what must stay as it is: free stream, closed box, column at rest. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

result_conservation() {
    begin conservation 'What must stay as it is'
    local stream box column sound
    floe_compare stream inputs/free_stream.yaml
    stream=$csv
    floe_compare box inputs/closed_box.yaml
    box=$csv
    floe_compare column inputs/hydrostatic_column.yaml
    column=$csv
    cp "$stream" $results/conservation-stream.csv
    cp "$box" $results/conservation-box.csv
    cp "$column" $results/conservation-column.csv
    sound=$(calc %g 'sqrt(1.4*101325/1.2)')
    bar 'free stream, ice: largest change of velocity over the speed' \
        "$(calc %g "$(value "$stream" ice '' linf_velocity_x)/sqrt(30*30+20*20)")" '<=' 1e-14 %.1e
    bar 'free stream, ice: largest change of pressure, relative' \
        "$(calc %g "$(value "$stream" ice '' linf_pressure)/101325")" '<=' 1e-14 %.1e
    bar 'closed box, ice: drift of mass' "$(value "$box" ice '' drift_mass)" '<=' 1e-12 %.1e
    bar 'closed box, ice: drift of energy' "$(value "$box" ice '' drift_energy)" '<=' 1e-12 %.1e
    bar 'column at rest, ice: max abs(u) / c after 1000 steps' \
        "$(calc %g "$(value "$column" ice '' linf_velocity_x)/$sound")" '<=' 1e-12 %.1e
    write 'Constants must stay constant, closed boxes closed, and columns at rest. A drift is |Q - Q0 - what the ledger says| over the' \
        'largest sum of |q|.' '' '## Bars' ''
    show_bars
    write '' '## Figures' '' '| scene | coupling | steps | drift of mass | drift of momentum | drift of energy | errors (SI) |' \
        '|---|---|---|---|---|---|---|'
    conservation_rows 'free stream (36 m/s, 0.1 MPa)' "$stream" linf_velocity_x linf_velocity_y linf_density linf_pressure
    conservation_rows 'closed box (3:1 in pressure)' "$box"
    conservation_rows 'column at rest (1000 m of air)' "$column" linf_velocity_x linf_pressure
    write '' 'The column starts from the discrete balance, whose pressure differs from the exact atmosphere by the truncation error shown;' \
        'what counts is that it does not move. Its momentum is round-off of round-off, hence its relative drift. Points keep mass and momentum to round-off; their energy drifts, most where shocks run,' \
        'as in the box, whose deck gives points no artificial viscosity.' '' \
        'Exchange between materials (K up to 1e20), numbers of blocks and threads, and resumed runs are held to round-off or to the' \
        'same bits by the tests (`unit_exchange`, `verification_*_bits`, `cli_resume`).'
    finish
}

conservation_rows() { # SCENE FILE METRIC...
    local scene=$1 file=$2 coupling m errors
    shift 2
    for coupling in $(awk -F, 'NR > 1 { print $1 }' "$file"); do
        errors=
        for m in "$@"; do errors+="$m $(printf %.1e "$(value "$file" "$coupling" '' "$m")"), "; done
        write "$(printf '| %s | %s | %s | %.1e | %.1e | %.1e | %s |' "$scene" "$coupling" "$(value "$file" "$coupling" '' steps)" \
            "$(value "$file" "$coupling" '' drift_mass)" "$(value "$file" "$coupling" '' drift_momentum)" \
            "$(value "$file" "$coupling" '' drift_energy)" "${errors%, }")"
    done
}
