# membrane-3d: membranes as surfaces in space. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# surface_value RUN KEY: a number of that run's summary.
surface_value() {
    sed -n "s/^ *\"$2\": \([-+.0-9e]*\),*$/\1/p" "$runs/$1/summary.json" | head -n 1
}

# surface_row DECK H METRIC...: a run and its row, errors in per cent; $pressure is that of the pressure.
surface_row() {
    local deck=$1 h=$2 metric row
    shift 2
    floe_run "$deck-$h" "inputs/membrane_$deck.yaml" --set "domain.cell=$h"
    pressure=$(calc %.4f "100 * $(surface_value "$deck-$h" hlate_pressure)")
    row="| $h | $(calc '%.0f' "1 / $h")"
    for metric in "$@"; do row+=" | $(calc '%.3f' "100 * $(surface_value "$deck-$h" "$metric")")"; done
    write "$row |"
}

# surface_last FILE NAME: the last value of a column.
surface_last() {
    awk -F, -v at="$(column "$1" "$2")" 'END { print $at }' "$1"
}

# surface_list RUN: the places of the points in that run's first snapshot, as a list for a deck, in $runs/points.csv.
surface_list() {
    { echo 'x (m),y (m),z (m)' && h5dump -d /points/skin/position -m '%.17g' -w 0 -y "$runs/$1/fields/000000.h5" | sed -nE '/^ +[-0-9]/ { s/ //g; s/,$//; p }'; } >"$runs/points.csv"
}

# The same balloon from a list of its points, and a flat sheet between supports.
surface_checks() {
    local own listed key rate
    surface_list sphere-0.1
    floe_run listed inputs/membrane_sphere.yaml --set "bodies.skin.membrane.surface={points: {at: $PWD/$runs/points.csv, area: 0.39269908169872414}}"
    write '' '### From a list of points' '' 'The points that `surface: {sphere: ...}` makes, read from a file (`surface: {points: {at: points.csv, area: ...}}`), at cells of 0.1: errors in per cent, normals in degrees at the end.' '' \
        '| | pressure | energy of the gas | strain energy | normals: worst | root mean square |' '|---|---|---|---|---|---|'
    for key in sphere-0.1 listed; do
        write "| $key | $(calc %.6f "100 * $(surface_value $key hlate_pressure)") | $(calc %.6f "100 * $(surface_value $key hlate_gas_energy)") | $(calc %.6f "100 * $(surface_value $key hlate_strain_energy)") | $(calc %.3g "$(surface_value $key linf_normal)") | $(calc %.3g "$(surface_value $key l2_normal)") |"
    done
    own=$(surface_value sphere-0.1 hlate_pressure) listed=$(surface_value listed hlate_pressure)
    bar "balloon from a list of its points: error of the pressure off that of the sphere's own, of the exact pressure" "$(calc %g "sqrt(($own - $listed)^2)")" '<=' 1e-3 %.1e
    write '' '## Sheet between supports' '' '`inputs/membrane_patch.yaml`: a taut sheet, drawn out by 2 % between two supports, against exact plane stress (`stretched_sheet`); the speed is that of the deck, and a tenth and a hundredth of it: what is left' \
        'goes with inertia and the half step between places and velocities. Relative errors; normals in degrees.' '' '| rate | stress along, worst | stress across, root mean square | displacement, root mean square | shear stress, worst, over E | normals, worst |' '|---|---|---|---|---|---|'
    for rate in 0.02 0.002 0.0002; do
        floe_run "patch-$rate" inputs/membrane_patch.yaml --set verify.exact.stretched_sheet.rate=$rate --set "supports.right.velocity=[$(calc %g "0.5 * $rate"), 0, 0]" --set "time.end=$(calc %g "0.02 / $rate")"
        write "| $rate | $(calc %.1e "$(surface_value "patch-$rate" linfrel_stress_xx)") | $(calc %.1e "$(surface_value "patch-$rate" l2rel_stress_yy)") | $(calc %.1e "$(surface_value "patch-$rate" l2rel_displacement_x)") | $(calc %.1e "$(surface_value "patch-$rate" linf_stress_xy)") | $(calc %.1e "$(surface_value "patch-$rate" linf_normal)") |"
    done
    bar 'sheet between supports: worst stress off plane stress, at the slowest' "$(surface_value patch-0.0002 linfrel_stress_xx)" '<=' 1e-5 %.1e
}

result_membrane-3d() {
    local h order
    begin membrane-3d 'Membranes in space: points on a surface, in no order'
    write 'Plane stress in the tangent plane of each point, with wrinkles; normals by the `quadric` fit to the points as they lie; all of pure MPM. Errors are' \
        'means over the last tenth of the time, against exact rest states (reference `membrane_rest`).' '' \
        '## Balloon' '' '`inputs/membrane_sphere.yaml`, an eighth of a sphere between three mirrors: p = 2 sigma t/r and the total energy give the rest; errors in per cent of the exact value.' \
        'Breathing that is left when the run ends is in the figures.' '' \
        '| cell | cells across | pressure | energy of the gas | strain energy | drift of energy |' '|---|---|---|---|---|---|'
    for h in 0.1 0.075 0.05; do
        surface_row sphere $h hlate_pressure hlate_gas_energy hlate_strain_energy energy
    done
    order=$(calc %.2f "log($(surface_value sphere-0.1 hlate_strain_energy) / $(surface_value sphere-0.05 hlate_strain_energy)) / log(2)")
    bar 'balloon, 10 to 20 cells across: order of the strain energy' "$order" '>=' 1 %.2f
    write '' "The strain energy falls with order $order from 10 to 20 cells across. The pressure's error does not fall with the" \
        'cell; whether that is what still breathes, or noise of the points of the gas, has not been isolated.'
    bar 'balloon, 20 cells across: pressure off the exact rest, per cent' "$pressure" '<=' 1 %.3f
    surface_checks
    write '' '## Tube' '' '`inputs/membrane_tube.yaml`, the shell of a cylinder between mirrors, its length held.' '' \
        '| cell | cells across | pressure | drift of energy |' '|---|---|---|---|'
    for h in 0.1 0.066666666666666667; do surface_row tube $h hlate_pressure energy; done
    bar 'tube, 15 cells across: pressure off the exact rest, per cent' "$pressure" '<=' 1 %.3f
    floe_run revolved inputs/membrane_revolved.yaml
    write '' '## Dog-bone of revolution' '' \
        "\`inputs/membrane_revolved.yaml\`: from a slack contour with corners to rest. At the end the kinetic energy is $(calc %.4f "100 * $(surface_last "$csv" kinetic) / $(surface_last "$csv" internal)") % of" \
        "the gas's, the pressure $(calc %.1f "$(surface_last "$csv" pressure_gas)") of 1000, the drift of energy $(calc %.3f "100 * $(surface_value revolved energy)") %. It has no rest in closed form: a surface bent in two directions" \
        'cannot become a sphere without stretching and shearing in its plane.' '' '## Bars' ''
    show_bars
    finish
}
