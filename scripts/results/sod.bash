# sod: Sod's shock tube by cells and by points. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# The place where the density last falls through the mean of the states beside the shock, less the exact shock's, over its travel.
sod_shock_error() { # PROFILE
    awk -F, 'NR > 1 { x[++n] = $1; r[n] = $2 }
        END { g = 1.4; pr = 0.1; rr = 0.125; ps = 0.303130178; t = 0.143
              b = (g - 1) / (g + 1); middle = rr * ((ps / pr + b) / (b * ps / pr + 1) + 1) / 2
              travel = t * sqrt(g * pr / rr) * sqrt((g + 1) / (2 * g) * ps / pr + (g - 1) / (2 * g))
              for (i = n - 1; i >= 1; i--) if (r[i] >= middle && r[i + 1] < middle) break
              at = x[i] + (x[i + 1] - x[i]) * (r[i] - middle) / (r[i] - r[i + 1])
              e = (at - 0.5 - travel) / travel; print (e < 0 ? -e : e) }' "$1"
}

# Density above (over) or below (under) what is there, in per cent of it: from the head of the fan to the shock, without eight cells on either side of
# the contact and three of the shock; above, ahead of the fan's foot, only what exceeds the gas at rest.
sod_extreme() { # over|under PROFILE CELLS
    awk -F, -v which="$1" -v h="$(calc %.9g "1/$3")" 'NR > 1 { x = $1; here = x < 0.489951 ? 1 : x < 0.632626 ? 0.4263194 : 0.2655737
            beside = x > 0.632626 - 8 * h && x < 0.632626 + 8 * h
            if (beside) next
            if (which == "over" && (x < 0.489951 || x > 0.632626) && x < 0.750558 + 4 * h && $2 / here - 1 > e) e = $2 / here - 1
            if (which == "under" && x > 0.489951 && x < 0.750558 - 3 * h && 1 - $2 / here > e) e = 1 - $2 / here }
        END { printf "%.4f", 100 * e }' "$2"
}

result_sod() {
    begin sod "Sod's shock tube: cells, and points"
    local both york inviscid coupling b s m
    floe_compare both inputs/sod.yaml
    both=$csv
    floe_compare york inputs/sod.yaml --set coupling=mpm --set 'runs_as=[mpm]' --set bodies.left.points=3 --set bodies.right.points=3
    york=$csv
    floe_compare inviscid inputs/sod.yaml --set coupling=mpm --set 'runs_as=[mpm]' --set materials.gas.artificial_viscosity.linear=0 \
        --set materials.gas.artificial_viscosity.quadratic=0
    inviscid=$csv
    cp "$both" $results/sod-both.csv
    cp "$york" $results/sod-mpm-3.csv
    cp "$inviscid" $results/sod-mpm-inviscid.csv
    cp "$runs/both/ice-0.005/profile.csv" $results/sod-profile-ice-200.csv
    bar 'ice: L1 of density at 200 cells' "$(value "$both" ice 0.005 l1_density)" '<=' 0.0026 %.5f
    read -r b s < <(order "$both" ice l1_density)
    bar 'ice: density above what it should be, at 200 cells' "$(sod_extreme over "$runs/both/ice-0.005/profile.csv" 200)" '<=' 0.5 %.2f ' %'
    bar 'ice: density below what it should be, at 200 cells' "$(sod_extreme under "$runs/both/ice-0.005/profile.csv" 200)" '<=' 0.5 %.2f ' %'
    bar 'ice: order of density' "$b" '>=' 0.8 %.2f
    bar 'ice: shock at 400 cells off by (of its travel)' \
        "$(calc %g "100*$(sod_shock_error "$runs/both/ice-0.0025/profile.csv")")" '<=' 0.3 %.3f ' %'
    bar 'ice: drift of total energy' \
        "$(for h in $(cases "$both" ice); do value "$both" ice "$h" drift_energy; done | sort -g | tail -n 1)" '<=' 1e-12 %.1e
    write 'A gas at rest, its pressure ten times and its density eight times higher on the left, to t = 0.143 (Sod 1978; York 1997,' \
        'section 4.1). One deck runs with the gas on cells (`ice`) and as points (`mpm`), against the exact solution: averages over' \
        'cells, values at points. Errors are absolute and weighted by volume.' '' '## Bars' ''
    show_bars
    write '' 'Beside them: a second-order Godunov code has 0.00454, 0.00254 and 0.00136 at 100, 200 and 400 cells.' '' \
        "Above and below: from the head of the fan to the shock, without eight cells on either side of the contact and three of the shock. At 400 cells\
 $(sod_extreme over "$runs/both/ice-0.0025/profile.csv" 400) and $(sod_extreme under "$runs/both/ice-0.0025/profile.csv" 400) %." '' \
        '## Cells and points' '' \
        '| coupling | cells | points a cell | artificial viscosity | L1 rho | L1 u | L1 p | L1 e | energy drift | wall time |' \
        '|---|---|---|---|---|---|---|---|---|---|'
    sod_rows "$both" ice - -
    sod_rows "$both" mpm 9 '0.2, 2'
    sod_rows "$york" mpm 3 '0.2, 2'
    sod_rows "$inviscid" mpm 9 none
    write ''
    for coupling in ice mpm; do
        write "* Orders, $coupling (as in the deck): $(for m in l1_density l1_velocity_x l1_pressure l1_internal_energy; do
            read -r b s < <(order "$both" $coupling $m)
            printf '%s %.2f ± %.2f, ' "${m#l1_}" "$b" "$s"
        done | sed 's/, $/./')"
    done
    write '* Points conserve mass and momentum to round-off; their energy drifts as shown.'
    plot density 820,560 <<END
set xlabel 'x'; set ylabel 'density'; set key right top
plot '$runs/both/mpm-0.005/profile.csv' every 3::1 using 1:2 with points pt 6 ps 0.5 lc rgb mpm title 'mpm, 200 cells of 9 points, every third', \\
     '$results/sod-profile-ice-200.csv' every ::1 using 1:2 with points pt 7 ps 0.5 lc rgb ice title 'ice, 200 cells', \\
     '$results/sod-profile-ice-200.csv' every ::1 using 1:3 with lines lw 1 lc rgb 'black' title 'exact (averages over cells)'
END
    write '' '![density at 200 cells](sod-density.svg)'
    sod_york
    finish
}

# Every variant of York 1997, section 4.1: two decks, with and without artificial viscosity, density of points by each method; with the
# thesis's linear basis and with floe's.
sod_york() {
    local basis cells points q file d m row
    write '' '## York 1997, section 4.1: every variant' '' \
        'The thesis prints curves only, and says that density by cell is noisy, and that by quadratic interpolation and by continuity' \
        'much alike (at most 0.005 apart).' '' \
        '| basis | cells | points a cell | artificial viscosity | density by | L1 rho | L1 u | L1 p | L1 e |' '|---|---|---|---|---|---|---|---|---|'
    for basis in linear quadratic; do
        for cells in '0.01 9' '0.005 3'; do
            points=${cells#* }
            for q in '0.2 2' '0 0'; do
                file=york-$basis-${cells% *}-$([ "$q" = '0 0' ] && echo inviscid || echo viscous)
                floe_compare "$file" inputs/sod.yaml --set coupling=mpm --set 'runs_as=[mpm]' --set method.basis=$basis --set domain.cell="${cells% *}" \
                    --set bodies.left.points="$points" --set bodies.right.points="$points" \
                    --set materials.gas.artificial_viscosity.linear="${q% *}" --set materials.gas.artificial_viscosity.quadratic="${q#* }" \
                    --set 'compare.axis={method.point_density: [cell, quadratic, continuity]}'
                for d in cell quadratic continuity; do
                    row="| $basis | $(calc %.0f "1/${cells% *}") | $points | $([ "$q" = '0 0' ] && echo none || echo "${q/ /, }") | $d |"
                    for m in density velocity_x pressure internal_energy; do row+=$(printf ' %.5f |' "$(value "$csv" mpm $d l1_$m)"); done
                    write "$row"
                done
            done
        done
    done
}

sod_rows() { # FILE COUPLING POINTS VISCOSITY
    local h m row
    for h in $(cases "$1" "$2"); do
        row="| $2 | $(calc %.0f "1/$h") | $3 | $4 |"
        for m in density velocity_x pressure internal_energy; do row+=$(printf ' %.5f |' "$(value "$1" "$2" "$h" l1_$m)"); done
        write "$row$(printf ' %.1e | %.2g s |' "$(value "$1" "$2" "$h" drift_energy)" "$(value "$1" "$2" "$h" wall_seconds)")"
    done
}
