# substeps: several steps of the points in one of the cells, beside a sharp interface. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# substeps_value FOLDER NAME: a number of the summary.
substeps_value() {
    sed -nE "s/^ *\"$2\": ([^,]*),?\$/\1/p" "$runs/$1/summary.json" | head -n 1
}

# substeps_of_points FOLDER: s in the stages of points; of cells and lines.
substeps_of_points() {
    awk -F'[:,]' '/"(mpm)_[a-z_]*":/ { s += $2 } END { printf "%.3g", s }' "$runs/$1/summary.json"
}
substeps_of_cells() {
    awk -F'[:,]' '/"(ice|sealed)_[a-z_]*":/ { s += $2 } END { printf "%.3g", s }' "$runs/$1/summary.json"
}

# substeps_mean FOLDER: sub-steps in a step, in the mean.
substeps_mean() {
    calc %.1f "$(substeps_value "$1" point_updates) / $(substeps_value "$1" steps) / $(substeps_value "$1" points)"
}

# substeps_last NAME: the last value of a column of $csv.
substeps_last() {
    awk -F, -v at="$(column "$csv" "$1")" 'END { print $at }' "$csv"
}

substeps_drift() {
    calc %.1e "$(substeps_last "drift_$1")"
}

substeps_ring() {
    local n h
    write '## A stiff ring in air' '' '`inputs/stiff_cylinder.yaml`: the cylinder of [a1](a1.md), a hundred times as stiff, under 0.2 MPa of air, to rest. Equation 13 has the error of the solid by itself; what counts is that it is the same.' '' \
        '| h | sub-steps | in the mean | eq. 13 | L1 of sigma_theta, Pa | steps of the cells | stages of the points, s | of cells and lines, s | drift of energy |' '|---|---|---|---|---|---|---|---|---|'
    for h in 0.1 0.05; do
        for n in 1 4 16 auto; do
            floe_run "ring-$h-$n" inputs/stiff_cylinder.yaml --set "domain.cell=$h" --set "time.substeps=$n"
            write "| $h | $n | $(substeps_mean "ring-$h-$n") | $(calc %.6f "100 * $(substeps_value "ring-$h-$n" eq13)") % | $(calc %.1f "$(substeps_value "ring-$h-$n" l1_sigma_theta)") | $(substeps_value "ring-$h-$n" steps) | $(substeps_of_points "ring-$h-$n") | $(substeps_of_cells "ring-$h-$n") | $(substeps_drift energy) |"
        done
        bar "stiff ring, h = $h: equation 13, auto beside 1, share" "$(calc %.3g "sqrt(($(substeps_value "ring-$h-auto" eq13) / $(substeps_value "ring-$h-1" eq13) - 1)^2)")" '<=' 1e-4 %.1e
        bar "stiff ring, h = $h: steps of the cells, auto over 1" "$(calc %.3g "$(substeps_value "ring-$h-auto" steps) / $(substeps_value "ring-$h-1" steps)")" '<=' 0.025 %.3f
    done
}

# A free plate of steel (Z = 4.576e7 Pa s/m), hit by the shock of shock_plate: p - p1 = 274992.6 Pa from 0.641884 ms on.
substeps_plate() {
    local n h impulse motion pressure=274992.644 arrives=6.41884e-4 height=0.02
    local steel=(--set 'materials.plate={density: 7850, law: {linear_elastic: {bulk_modulus: 160e9, shear_modulus: 80e9}}, specific_heat: 460}'
        --set 'domain.upper=[2.1, 0.02]' --set boundaries.x=free --set 'bodies.plate.shape={box: {lower: [0.6037, 0], upper: [0.9037, 0.02]}}' --set time.end=1.2e-3)
    write '' '## A shock on a plate of steel' '' '`inputs/shock_plate.yaml`, the plate 0.3 m of steel, free at its back and with the gas behind it: its impulse at 1.2 ms against (p - p1) A t by Rankine and Hugoniot, its energy' \
        'against that of a rigid plate with this impulse (ten waves have crossed it by then).' '' \
        '| h | sub-steps | in the mean | impulse, error | energy, error | momentum of the whole: drift | energy | steps of the cells | stages of the points, s | of cells and lines, s |' '|---|---|---|---|---|---|---|---|---|---|'
    for h in 0.01 0.005; do
        for n in 1 2 4 auto; do
            floe_run "plate-$h-$n" inputs/shock_plate.yaml "${steel[@]}" --set "domain.cell=[$h, 0.01]" --set "time.substeps=$n"
            impulse=$(calc %.8g "$(substeps_last mass_plate) * $(substeps_last velocity_plate_x) / ($pressure * $height * (1.2e-3 - $arrives)) - 1")
            motion=$(calc %.8g "($(substeps_last kinetic_plate) + $(substeps_last strain_plate)) * 2 * $(substeps_last mass_plate) / ($pressure * $height * (1.2e-3 - $arrives))^2 - 1")
            write "| $h | $n | $(substeps_mean "plate-$h-$n") | $(calc %+.3f "100 * $impulse") % | $(calc %+.3f "100 * $motion") % | $(substeps_drift momentum_x) | $(substeps_drift energy) | $(substeps_value "plate-$h-$n" steps) | $(substeps_of_points "plate-$h-$n") | $(substeps_of_cells "plate-$h-$n") |"
            if [ $n = auto ]; then
                bar "steel plate, h = $h, auto: impulse" "$(calc %g "100 * sqrt(($impulse)^2)")" '<=' 0.5 %.2g ' %'
                bar "steel plate, h = $h, auto: momentum of the whole" "$(substeps_drift momentum_x)" '<=' 1e-13 %.1e
            fi
        done
    done
}

# substeps_disc RATIO SPEEDS N STEPS: a disc of steel in a box of gas whose density is RATIO of its own and whose sound is SPEEDS times slower, set going by half as much pressure again at one side.
substeps_disc() {
    local ratio=$1 speeds=$2 n=$3 steps=$4 rho c p T dt folder=disc-$1-$2-$3
    rho=$(calc %.8g "7850 * $ratio") c=$(calc %.8g "sqrt(266.6666667e9 / 7850) / $speeds")
    p=$(calc %.8g "$rho * $c^2 / 1.4") dt=$(calc %.8g "0.5 * 0.08 / 2 / $c")
    T=$(calc %.8g "$p / $rho / 0.4 / 717.5")
    floe_run "$folder" inputs/shock_plate.yaml --set 'domain={dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [0.96, 0.96], cell: 0.08}' --set boundaries.x=slip --set boundaries.y=slip \
        --set 'materials.plate={density: 7850, law: {linear_elastic: {bulk_modulus: 160e9, shear_modulus: 80e9}}, specific_heat: 460}' \
        --set 'bodies.plate.shape={ball: {centre: [0.47, 0.49], radius: 0.27}}' \
        --set "reference_pressure=$p" --set "ambient={material: air, pressure: $p, temperature: $T}" \
        --set "bodies.behind={material: air, shape: {box: {lower: [0, 0], upper: [0.16, 0.96]}}, pressure: $(calc %.8g "1.5 * $p"), temperature: $T}" \
        --set "time.end=$(calc %.8g "$steps * $dt")" --set "output.interval=$(calc %.8g "$steps * $dt")" --set "output.history_interval=$(calc %.8g "$steps * $dt / 100")" --set "time.substeps=$n"
    awk -F, -v k="$(column "$csv" kinetic_plate)" -v s="$(column "$csv" strain_plate)" 'NR > 2 { e = $k + $s; if (NR <= 22 && e > early) early = e; if (NR > 82 && e > late) late = e }
        END { printf "%.3f", late / early }' "$csv"
}

substeps_sweep() {
    local ratio speeds first last worst=0
    write '' '## How stiff, how heavy' '' 'A disc of steel (radius 0.27 m, h = 0.08 m) in a closed box of gas of a given share of its density, whose sound is so many times slower; no damping of any kind, no viscosity. Half as much pressure again at one side' \
        'sets all of it going. *Energy of the disc*: the largest of the last fifth of 1000 steps of the cells, over the largest of the first; a force that feeds vibrations would let it grow.' '' \
        '| density of the gas, share | sound of the solid over the gas'"'"'s | kappa = gamma p/(rho c^2) | sub-steps in the mean | energy of the disc, auto | with one | drift of energy, auto | rejected steps |' '|---|---|---|---|---|---|---|---|'
    for ratio in 0.001 0.1 0.5 3; do
        for speeds in 4 16; do
            first=$(substeps_disc $ratio $speeds 1 1000)
            last=$(substeps_disc $ratio $speeds auto 1000)
            csv=$runs/disc-$ratio-$speeds-auto/history.csv
            write "| $ratio | $speeds | $(calc %.1e "$ratio / $speeds^2") | $(substeps_mean "disc-$ratio-$speeds-auto") | $last | $first | $(substeps_drift energy) | $(substeps_value "disc-$ratio-$speeds-auto" rejected_steps) |"
            worst=$(calc %.3f "($last > $worst ? $last : $worst)")
        done
    done
    write '' 'Where the gas is denser than a solid the points take no sub-steps. Without that rule, and sixteen times slower sound, the disc kept ringing in gas of twice its density, and at three times its energy grew four-hundredfold in 750' \
        'steps (2.3 times at ten, and at four and eight times slower sound not at all): the vibration grows of which a step of the gas takes half a period. With the velocity of the last sub-step in place of that of the whole way' \
        'three times were stable at sixteen, and ten were not at eight. At the same density 68 sub-steps a step were stable, and water (0.13, 0.37 and 0.67 of the density of what stood in it, 3, 3 and 12 sub-steps) over 1500 steps.'
    bar 'disc in gas: energy late over early, the largest' "$worst" '<=' 1 %.2f
}

result_substeps() {
    begin substeps 'Sub-steps of the points'
    write 'With `time.substeps` the points take several steps in one of the cells, under a traction of the gas that stays as it is ([theory](../theory/README.md), Sub-steps of the points). `auto` takes as many as their stable' \
        'steps ask for; *in the mean* is what came of it.' ''
    substeps_ring
    write '' 'The points cost what they cost without; what is saved is the cells'"'"' part of the time (here half). Other work on the machine shows in the times.'
    substeps_plate
    substeps_sweep
    write '' '## Bars' ''
    show_bars
    finish
}
