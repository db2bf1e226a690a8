# implicit: the implicit pressure at acoustic CFL of 10, 100, 1000 beside the explicit step; iterations; the choice by cost. Sourced by
# scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# summary FOLDER KEY: a number or text of that run's summary.json.
summary() {
    sed -nE "s/^ *\"$2\": \"?([^\",]*(, [^\"]*)?)\"?,?\$/\1/p" "$runs/$1/summary.json" | head -n 1
}

# last FOLDER COLUMN: the last value of a column of that run's history.
last() {
    local at
    at=$(column "$runs/$1/history.csv" "$2") || return
    awk -F, -v at="$at" 'END { print $at }' "$runs/$1/history.csv"
}

# implicit_runs DECK: the explicit step, and the implicit one at each acoustic CFL.
implicit_runs() {
    local cfl
    floe_run "$1-explicit" "inputs/$1.yaml" --set method.pressure=explicit
    for cfl in 10 100 1000; do floe_run "$1-$cfl" "inputs/$1.yaml" --set time.acoustic_cfl=$cfl; done
}

# implicit_seconds FOLDER: wall time without outputs.
implicit_seconds() {
    calc %.3g "$(summary "$1" wall_seconds)-$(summary "$1" output_seconds)"
}

# implicit_row DECK CASE CELLS...: a row of a scene's table; CELLS are its errors.
implicit_row() {
    local run=$1-$2 solves faster=1 each=-
    shift 2
    solves=$(summary "$run" pressure_solves)
    [ "$solves" = 0 ] || each=$(calc %.1f "$(summary "$run" cg_iterations)/$solves")
    faster=$(calc %.3g "$(implicit_seconds "${run%-*}-explicit")/$(implicit_seconds "$run")")
    write "$(printf '| %s | %s | %s s | %s | %s | %s | %.1e | %.1e |' "$([ "${run##*-}" = explicit ] && echo explicit || echo "implicit, ${run##*-}")" \
        "$(summary "$run" steps)" "$(implicit_seconds "$run")" "$faster" "$each" "$*" "$(summary "$run" mass)" "$(summary "$run" energy)")"
}

implicit_field_table() { # DECK METRIC DIGITS
    local case
    write '| pressure, acoustic CFL | steps | run time | times faster | CG iterations a step | error | drift of mass | drift of energy |' \
        '|---|---|---|---|---|---|---|---|'
    for case in explicit 10 100 1000; do implicit_row "$1" $case "$(printf "%.$3g" "$(summary "$1-$case" "$2")")"; done
}

implicit_vortex() {
    local e i
    implicit_runs low_mach_vortex
    write '' '## Vortices: `inputs/low_mach_vortex.yaml`' '' 'Taylor-Green vortices at Mach 7e-4, 32 x 32 cells; the error is the L1 norm of the' \
        'velocity along x against the incompressible solution, over that of the solution itself.' ''
    implicit_field_table low_mach_vortex l1rel_velocity_x 4
    e=$(summary low_mach_vortex-explicit l1rel_velocity_x) i=$(summary low_mach_vortex-1000 l1rel_velocity_x)
    bar 'vortices: error at acoustic CFL 1000' "$(calc %g "100*$i")" '<=' 1 %.2f ' %'
    bar 'vortices: error at acoustic CFL 10 over that of the explicit step' "$(calc %g "$(summary low_mach_vortex-10 l1rel_velocity_x)/$e")" '<=' 1.1 %.2f
    bar 'vortices: drift of energy at acoustic CFL 1000' "$(summary low_mach_vortex-1000 energy)" '<=' 1e-12 %.1e
}

implicit_channel() {
    local e i
    implicit_runs low_mach_channel
    write '' '## Channel: `inputs/low_mach_channel.yaml`' '' 'Start-up of the flow between plates under a difference of pressure, Mach 1e-3, 64 x 16 cells; the error is' \
        'that of the velocity along x against the series of the incompressible flow.' ''
    implicit_field_table low_mach_channel l1rel_velocity_x 4
    e=$(summary low_mach_channel-explicit l1rel_velocity_x)
    for i in 10 100; do
        bar "channel: error at acoustic CFL $i over that of the explicit step" "$(calc %g "$(summary low_mach_channel-$i l1rel_velocity_x)/$e")" '<=' 1.5 %.2f
    done
}

implicit_vessel() {
    local case rise=2500 p # Pa: 0.4 * 1e5 W/m3 * 1 s / 16
    implicit_runs heated_vessel
    write '' '## Vessel: `inputs/heated_vessel.yaml`' '' "Air in a closed box, heated in the middle for a second: its pressure rises by (gamma - 1) q t V_heated/V = $rise Pa. The" \
        'errors are that of the mean pressure, and what the middle, where the air is hot, is above a corner, both over that rise.' '' \
        '| pressure, acoustic CFL | steps | run time | times faster | CG iterations a step | rise of the mean, unevenness | drift of mass | drift of energy |' \
        '|---|---|---|---|---|---|---|---|'
    for case in explicit 10 100 1000; do
        implicit_row heated_vessel $case "$(printf '%.1e, %.1e' "$(calc %g "($(last heated_vessel-$case pressure_air)-1e5)/$rise-1")" \
            "$(calc %g "($(last heated_vessel-$case middle_pressure)-$(last heated_vessel-$case corner_pressure))/$rise")")"
    done
    write '' 'Probes show the pressure at the start of the last step: in a step of a sixteenth of a second that is another one than the mean at its end.'
    p=$(last heated_vessel-1000 pressure_air)
    bar 'vessel: rise of pressure at acoustic CFL 1000, off by' "$(calc %g "100*sqrt((($p-1e5)/$rise-1)^2)")" '<=' 0.1 %.1e ' %'
    bar 'vessel: unevenness at acoustic CFL 1000' "$(calc %g "sqrt((($(last heated_vessel-1000 middle_pressure)-$(last heated_vessel-1000 corner_pressure))/$rise)^2)")" '<=' 0.01 %.1e
    bar 'vessel: drift of energy at acoustic CFL 1000' "$(summary heated_vessel-1000 energy)" '<=' 1e-12 %.1e
}

# implicit_iterations WHAT ARGUMENT...: three steps at acoustic CFL 100 on two meshes; 32 and 512 cells along each axis.
implicit_iterations() {
    local what=$1 n h cg=() outer=()
    shift
    for n in 32 512; do
        h="[$(calc %.10g "$width/$n"),$(calc %.10g "1/$n")]"
        floe_run "box-${what%% *}-$n" inputs/closed_box.yaml --set method.pressure=implicit --set time.acoustic_cfl=100 --set time.first_step=1 \
            --set time.max_steps=3 --set "domain.upper=[$width,1]" --set "bodies.right.shape.box.upper=[$width,1]" --set 'bodies.charge.pressure=101.4 kPa' --set "domain.cell=$h" "$@"
        cg+=("$(calc %.1f "$(summary "box-${what%% *}-$n" cg_iterations)/3")")
        outer+=("$(calc %.1f "$(summary "box-${what%% *}-$n" outer_iterations)/3")")
    done
    write "| $what | ${cg[0]} | ${cg[1]} | ${outer[0]} | ${outer[1]} |"
    bar "iterations, $what: 512 x 512 less 32 x 32" "$(calc %g "${cg[1]}-${cg[0]}")" '<=' 2 %.1f
}

implicit_auto() { # DECK ARGUMENT...
    local deck=$1
    shift
    floe_run "auto-$deck" "inputs/$deck.yaml" --set method.pressure=auto "$@"
    write "| \`$deck\` | $(summary "auto-$deck" pressure) | $(summary "auto-$deck" steps) |"
}

result_implicit() {
    local width=1
    begin implicit 'Implicit pressure: steps bound by the flow, not by sound'
    implicit_vortex
    implicit_channel
    implicit_vessel
    write '' '## Iterations' '' 'Iterations of conjugate gradients a step, and searches of the pressure, at an acoustic CFL of 100: air in a box with' \
        'a corner at a pressure 0.07 % higher (`inputs/closed_box.yaml`), three steps.' '' \
        '| scene | CG, 32 x 32 | CG, 512 x 512 | searches, 32 x 32 | searches, 512 x 512 |' '|---|---|---|---|---|'
    implicit_iterations 'uniform'
    implicit_iterations 'jump of 1e4 in density' --set bodies.charge.temperature=0.03
    width=4
    implicit_iterations 'stretched cells, 4 : 1'
    write '' '## The choice by cost' '' '`method.pressure: auto` predicts the steps that the rest of the run would take either way, and takes what costs less.' '' \
        '| deck | pressure | steps taken |' '|---|---|---|'
    implicit_auto low_mach_vortex
    implicit_auto heated_vessel
    implicit_auto isentropic_vortex
    implicit_auto sod --coupling ice
    write '' '## Bars' '' 'The bars on iterations were set first; the others after first trials.' ''
    show_bars
    finish
}
