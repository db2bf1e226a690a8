# sealed: membranes that hold gas of the cells. Sourced by scripts/results.sh, after membrane-rest.bash, whose rows it has. Runs of the
# dog-bone that lie finished in out/results/sealed are taken as they are.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# York's strain and transfer, without what membrane-rest adds to them.
sealed_plain=(--set bodies.skin.membrane.strain=null --set bodies.skin.membrane.smoothing=null --set 'method={basis: quadratic, flip: 1}')
sealed_air='materials.air={eos: {ideal: {gamma: 1.4, specific_heat: 1}}}'

# sealed_largest NAME [OFFSET]: the largest |value - OFFSET| of a column of $csv.
sealed_largest() {
    awk -F, -v c="$(column "$csv" "$1")" -v o="${2:-0}" 'NR > 1 { d = $c - o; if (d * d > w * w) w = d } END { printf "%.2g", w < 0 ? -w : w }' "$csv"
}

sealed_rest() {
    write '' '## At rest, and in a stream' '' '| what | measured |' '|---|---|'
    floe_run rest inputs/membrane_circle.yaml --coupling ice-mpm "${sealed_plain[@]}" --set "$sealed_air" --set damping=null \
        --set 'ambient={material: air, pressure: 1000, temperature: 700}' --set 'boundaries={x: symmetry, y: symmetry}' --set time.end=0.02
    write "| two gases of one pressure (1000) at rest, $(tail -n 1 "$csv" | cut -d, -f2) steps: largest change of either pressure | $(sealed_largest pressure_gas 1000), $(sealed_largest pressure_air 1000) |" \
        "| the same: gas beyond the membrane | $(sealed_largest outside_skin) |"
    bar 'two gases at rest: largest change of pressure, share' "$(calc %g "$(sealed_largest pressure_gas 1000)/1000")" '<=' 1e-12 %.1e
    bar 'two gases at rest: gas beyond the membrane' "$(sealed_largest outside_skin)" '<=' 0 %.2g
    floe_run stream inputs/membrane_circle.yaml --coupling ice-mpm "${sealed_plain[@]}" --set "$sealed_air" --set damping=null \
        --set 'domain={dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [1, 0.3], cell: 0.05}' --set materials.gas.viscosity=null \
        --set 'boundaries={x: {lower: {inlet: {velocity: [10, 0], material: gas, pressure: 1000, temperature: 2500}}, upper: free}, y: slip}' \
        --set 'bodies.gas={material: gas, shape: {box: {lower: [0, 0], upper: [0.313, 0.3]}}, pressure: 1000, density: 1, velocity: [10, 0]}' \
        --set 'bodies.air={material: air, shape: {box: {lower: [0, 0], upper: [1, 0.3]}}, pressure: 1000, temperature: 700, velocity: [10, 0]}' \
        --set 'bodies.skin.velocity=[10, 0]' --set 'bodies.skin.membrane.curve={segment: {from: [0.313, 0], to: [0.313, 0.3]}}' --set time.end=0.05
    write "| a plane membrane carried through ten sides of cells: largest change of either pressure | $(sealed_largest pressure_gas 1000), $(sealed_largest pressure_air 1000) |" \
        "| the same: velocity of the membrane off by | $(sealed_largest velocity_skin_x 10) |"
    bar 'membrane in a stream: largest change of pressure, share' "$(calc %g "$(sealed_largest pressure_air 1000)/1000")" '<=' 1e-12 %.1e
}

sealed_piston() {
    local h error orders=() before=''
    write '' '## Piston (Y97 6.1; Y00 4.2)' '' '`inputs/piston_membrane.yaml`: a sheet of four points on springs, which starts on a side of cells and crosses it twice a' \
        'period; exact 0.0070882 and 0.0223479.' '' '| m | h | period, error | turning points, error | drift of energy |' '|---|---|---|---|---|'
    for h in 4 2 1 0.5; do
        floe_run "piston-$h" inputs/piston_membrane.yaml --set "domain.cell=[$h, 1]"
        error=$(awk -F: '/"hperiod_position"/ { printf "%g", $2 }' "$runs/piston-$h/summary.json")
        [ -n "$before" ] && orders+=("$(calc %.2f "log($before/$error)/log(2)")")
        before=$error
        sealed_piston_row 0.1 "$h" "piston-$h"
    done
    floe_run piston-heavy inputs/piston_membrane.yaml --set materials.sheet.density=100 --set verify.reference.piston.mass=1 --set time.end=0.067
    sealed_piston_row 1 1 piston-heavy
    write '' "Order of the period in h: ${orders[*]}."
    bar 'piston, h = 1: period' "$(awk -F: '/"hperiod_position"/ { printf "%g", 100 * $2 }' "$runs/piston-1/summary.json")" '<=' 1 %.2g ' %'
}

sealed_piston_row() {
    local p t
    p=$(awk -F: '/"hperiod_position"/ { printf "%.2g", 100 * $2 }' "$runs/$3/summary.json")
    t=$(awk -F: '/"hturns_position"/ { printf "%.2g", 100 * $2 }' "$runs/$3/summary.json")
    write "| $1 | $2 | $p % | $t % | $(sealed_largest drift_energy) |"
}

sealed_bone() {
    local h k=0 number=([1]=56 [2]=100 [3]=200)
    write '' '## Dog-bone (A3)' '' '`inputs/membrane_dogbone.yaml --coupling ice-mpm`: 56, 100, 200 and 600 points on the membrane, cells of h.'
    rest_table
    for h in ${SEALED_BONES:-0.4 0.2 0.1}; do
        k=$((k + 1))
        if [ "$h" = 0.05 ]; then
            floe_run_kept "dogbone-$h" inputs/membrane_dogbone.yaml --coupling ice-mpm
        else
            floe_run_kept "dogbone-$h" inputs/membrane_dogbone.yaml --coupling ice-mpm --set "domain.cell=$h" --set "bodies.skin.membrane.number=${number[k]}"
        fi
        rest_row "dogbone-$h" "$h" -
        bar "dog-bone at $h: largest error of r and p" "$(printf '%s\n' "${figures[@]:0:3}" | sort -g | tail -n 1)" '<=' 1 %.2g ' %'
        bar "dog-bone at $h: gas beyond the membrane" "${figures[6]}" '<=' 0 %.2g
    done
}

sealed_unconnected() {
    write '' '## Dog-bone with normals to unconnected points (A5)' '' 'The same on a mesh of 10 x 10 with `normals: isosurface`, 100 points: tangents of the stress come from the points as they lie; the line that cuts the cells goes' \
        'through them in their order. With gas as points: [normals](normals.md).'
    rest_table
    floe_run_kept unconnected inputs/membrane_dogbone.yaml --coupling ice-mpm --set bodies.skin.membrane.normals=isosurface --set 'domain.upper=[2, 2]' \
        --set domain.cell=0.2 --set bodies.skin.membrane.number=100
    rest_row unconnected 0.2 -
    bar 'dog-bone, unconnected normals: largest error of r and p' "$(printf '%s\n' "${figures[@]:0:3}" | sort -g | tail -n 1)" '<=' 1 %.2g ' %'
    bar 'dog-bone, unconnected normals: gas beyond the membrane' "${figures[6]}" '<=' 0 %.2g
}

sealed_ways() {
    write '' '## Other ways that were tried' '' 'The circle at h = 0.1 with a thin outer gas (pressure 1), to t = 0.06, by programs that are not kept:' '' \
        '| way | pressure (exact 989) | gas of the inside in cells wholly outside | more than a cell outside |' '|---|---|---|---|' \
        '| one mixture pressure a cell, the membrane a solid of the mixture | 619 | 1.3 % | 0.015 % |' \
        '| the same, and faces pass each gas only through what is open to it | 838 | 0 | 0 |' '| each gas by itself in cut cells (kept) | 988 | 0 | 0 |' '' \
        'A mixture has one pressure in a cut cell, so that the jump across the membrane is spread over cells that the inner gas shares with the outer:' \
        'the inner gas expands into them, and against a membrane that takes a part of the cell by its thickness (15 % of the gas is displaced at the start).' \
        'Limiting the fluxes stops the leak, not the loss of pressure.'
}

result_sealed() {
    begin sealed 'Membranes thinner than a cell that hold gas of the cells'
    local figures worst h
    write 'Gas on cells inside a membrane of points ([theory](../theory/README.md)). Errors of the rest are those of means over the last tenth of the time, as in' \
        '[membrane-rest](membrane-rest.md). About an axis, a balloon and a tube: [axis](axis.md); bags that are hit: [airbag](airbag.md).'
    sealed_rest
    sealed_piston
    write '' '## Slack circle (A4)' '' '`inputs/membrane_circle.yaml --coupling ice-mpm --set time.end=0.2`, the other side a vacuum.'
    rest_table
    for h in 0.1 0.05; do
        floe_run "circle-$h" inputs/membrane_circle.yaml --coupling ice-mpm --set domain.cell=$h --set time.end=0.2
        rest_row "circle-$h" $h -
        bar "circle at $h: r" "$(printf '%s\n' "${figures[@]:0:2}" | sort -g | tail -n 1)" '<=' 0.01 %.2g ' %'
        bar "circle at $h: pressure" "${figures[2]}" '<=' 0.2 %.2g ' %'
        bar "circle at $h: hoop stress" "${figures[3]}" '<=' 0.2 %.2g ' %'
    done
    sealed_bone
    sealed_unconnected
    sealed_ways
    write '' '## Bars' ''
    show_bars
    finish
}
