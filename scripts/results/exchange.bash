# exchange: between materials that share cells. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# last RUN COLUMN...: the sum of the last values of these columns of its history.
last() {
    local file=$runs/$1/history.csv sum=0 name
    shift
    for name in "$@"; do
        sum=$(calc %.17g "$sum + $(awk -F, -v at="$(column "$file" "$name")" 'END { print $at }' "$file")")
    done
    echo "$sum"
}

# error_of RUN METRIC: from its summary.
error_of() {
    sed -n "s/^ *\"$2\": \([-+.0-9e]*\),*$/\1/p" "$runs/$1/summary.json"
}

# along RUN: momentum of the wall along 30 degrees, over that of the gas at the start.
along() {
    local x y
    x=$(last "$1" velocity_wall_x velocity_wall_below_x)
    y=$(last "$1" velocity_wall_y velocity_wall_below_y)
    calc %.4f "0.5 * ($x * 0.8660254037844386 + $y * 0.5) * $(last "$1" mass_steel) / (50 * $(last "$1" mass_air))"
}

result_exchange() {
    begin exchange 'Exchange between materials'
    local K n s
    floe_command study study.csv relaxation inputs/relaxation.yaml
    write 'Row D5: two gases in one place, at two velocities and temperatures, come to one of each. The exact answer is exponential; a step leaves' \
        '1/(1 + dt/tau) of a difference (to round-off: `tests/verification/test_ice_exchange.c`, K and R from 1 to 1e20, and three materials), so that errors' \
        'are of first order in the step.' '' '## Bars' ''
    for s in l1_velocity_x l1_temperature; do
        bar "relaxation: order of $s in the step" "$(sed -n "s/^order in .*$s \([0-9.]*\) .*/\1/p" "$runs/relaxation.txt")" '>=' 0.9 %.2f
    done
    for K in 1 1e5 1e10 1e15 1e20; do
        floe_run limit-$K inputs/relaxation.yaml --set exchange.gases.momentum.constant.coefficient=$K \
            --set exchange.gases.heat.constant.coefficient=$K --set verify.exact.relaxation.momentum_exchange=$K \
            --set verify.exact.relaxation.heat_exchange=$K
    done
    bar 'relaxation: error of the velocity at K = 1e20, m/s' "$(error_of limit-1e20 l1_velocity_x)" '<=' 1e-10 %.1e
    bar 'relaxation: error of the temperature at R = 1e20, K' "$(error_of limit-1e20 l1_temperature)" '<=' 1e-10 %.1e
    for n in 1 2; do
        for s in free locked; do
            floe_run slip-$s-$n inputs/slip_wall.yaml --set exchange.wall.tangential=$s \
                --set "domain.cell=[$(calc %.17g "1.732050807568877 / 36 / $n"), $(calc %.17g "0.05 / $n")]"
        done
    done
    bar 'slip at 30 degrees, 36 x 20: momentum lost to the wall, over that lost to one velocity' \
        "$(calc %.17g "$(along slip-free-1) / $(along slip-locked-1)")" '<=' 0.2 %.2f
    bar 'slip at 30 degrees, 72 x 40: the same' "$(calc %.17g "$(along slip-free-2) / $(along slip-locked-2)")" '<=' 0.2 %.2f
    floe_command study study.csv vessel inputs/closed_vessel_burn.yaml
    bar 'closed vessel: order of hmax_pressure in the step' \
        "$(sed -n "s/^order in .*hmax_pressure \([0-9.]*\) .*/\1/p" "$runs/vessel.txt")" '>=' 0.9 %.2f
    floe_run burn inputs/closed_vessel_burn.yaml
    bar 'closed vessel: drift of the energy' "$(last burn drift_energy)" '<=' 1e-12 %.1e
    bar 'closed vessel: drift of the mass' "$(last burn drift_mass)" '<=' 1e-12 %.1e
    # (gamma - 1)/V times the energy of the gas at the start, of the block, and of its reaction.
    local burnt
    burnt=$(calc %.17g '0.25 / 1.6e-3 * (0.0142857142857 * 4.2e5 + 0.16 * (3e5 + 3e5))')
    floe_run block inputs/burning_block.yaml
    bar 'burning block of points: drift of the mass' "$(last block drift_mass)" '<=' 1e-12 %.1e
    bar 'burning block of points: pressure at its end beside the closed vessel, per cent' \
        "$(awk -v a="$(last block pressure_gas)" -v b="$burnt" 'BEGIN { d = 100 * (a / b - 1); print d < 0 ? -d : d }')" '<=' 1 %.2f
    show_bars
    write '' '## Relaxation' '' 'Errors of the light gas at t = 2 ms, two relaxation times of the velocity and one of the temperature:' '' \
        '```' "$(sed '1d;$d' "$runs/relaxation.txt")" '```' '' 'The limit, at 16 steps of 0.125 ms, K in kg/m3/s and R in W/m3/K:' '' \
        '| K, R | error of the velocity | error of the temperature | drift of momentum | drift of energy |' '|---|---|---|---|---|'
    for K in 1 1e5 1e10 1e15 1e20; do
        write "| $K | $(printf %.2e "$(error_of limit-$K l1_velocity_x)") m/s | $(printf %.2e "$(error_of limit-$K l1_temperature)") K | $(printf %.1e "$(last limit-$K drift_momentum_x)") | $(printf %.1e "$(last limit-$K drift_energy)") |"
    done
    write '' '## Slip along an oblique wall' '' \
        'Gas at 50 m/s along a band of points at 30 degrees to the mesh, periodic both ways. Momentum along itself that the wall has after 2 ms (the gas has' \
        'gone 0.1 m, two cells of the coarser mesh), as a share of that of the gas at the start. An inviscid gas would lose nothing; what slip loses is by normals that are' \
        'not exact, of which each step takes sin^2 of the error. (The bars of this section were set after a first look at 0.13.)' '' '| cells | locked | slip |' '|---|---|---|' \
        "| 36 x 20 | $(along slip-locked-1) | $(along slip-free-1) |" "| 72 x 40 | $(along slip-locked-2) | $(along slip-free-2) |" ''
    write '## Burn in a closed vessel' '' 'Grains of 0.2 % of the volume burn at a power of the pressure, from 1 to some 25 bar, against the equation of the vessel. hmax: the largest' \
        'difference over the run, by the largest value. The pressure in the rate is that of the start of the step: order one.' '' \
        '```' "$(sed '1d;$d' "$runs/vessel.txt")" '```' '' \
        'A reaction after Arrhenius at constant volume (T from 1200 to 2700 K) has reacted 5 % and 90 % at the times of the quadrature to 1e-8 and 2e-7, in one step' \
        '(`tests/verification/test_ice_react.c`), since the temperature is followed within a step.' ''
    write '## A block that burns' '' 'A block of ten by ten cells on points burns from its faces at a power of the pressure, in a closed vessel of gas on cells, against the same equation. What is' \
        'burnt leaves the points with its mass, momentum and energy, and the gas has them; new gas comes up in the pores of the smeared front, so that the block burns ahead of its equation.' '' \
        "Largest error over the run, by half the range: mass $(printf %.1f "$(calc %.17g "100 * $(error_of block hmax_grains)")") %, pressure $(printf %.1f "$(calc %.17g "100 * $(error_of block hmax_pressure)")") %. At the end the drift of the energy is $(printf %.1e "$(last block drift_energy)"), of the mass $(printf %.1e "$(last block drift_mass)"), of the momentum $(printf %.1e "$(last block drift_momentum_x)")." ''
    finish
}
