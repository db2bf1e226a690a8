# transport: viscosity, conduction and sides of the cells. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# centre_lines SNAPSHOT CELLS FILE: u over y on x = 1/2 and v over x on y = 1/2, a line each: name, place, value; walls and lid included.
centre_lines() {
    h5dump -d /cells/velocity_liquid -w 0 -y "$1" | awk -v n="$2" -v OFS=, '/^ +[-0-9]/ { gsub(/[ ,]+/, " "); for (i = 1; i <= NF; i++) x[m++] = $i }
        function at(i, j, c) { return x[3 * (j * n + i) + c] }
        END { print "u", 0, 0; print "v", 0, 0; k = n / 2
            for (j = 0; j < n; j++) { y = (j + 0.5) / n
                print "u", y, (at(k - 1, j, 0) + at(k, j, 0)) / 2; print "v", y, (at(j, k - 1, 1) + at(j, k, 1)) / 2 }
            print "u", 1, 1; print "v", 1, 0 }' >"$3"
}

# beside_ghia LINES COLUMN: Ghia's points beside a run interpolated to them: line, place, Ghia, floe.
beside_ghia() {
    awk -F, -v OFS=, -v c="$2" 'NR == FNR { n[$1]++; s[$1, n[$1]] = $2; w[$1, n[$1]] = $3; next }
        FNR > 1 { for (i = 1; i < n[$1] && s[$1, i + 1] < $2; i++);
            f = ($2 - s[$1, i]) / (s[$1, i + 1] - s[$1, i]); print $1, $2, $c, w[$1, i] + f * (w[$1, i + 1] - w[$1, i]) }' \
        "$1" scripts/results/ghia_1982.csv
}

# largest_deviation FILE LINE: of floe from Ghia, inside.
largest_deviation() {
    awk -F, -v l="$2" '$1 == l && $2 > 0 && $2 < 1 { d = $4 - $3; if (d < 0) d = -d; if (d > m) m = d } END { print m }' "$1"
}

# cavity NAME RE COLUMN CELLS ARGUMENT...: a run, its lines and its deviations.
cavity() {
    local label=$1 column=$2 cells=$3
    shift 3
    floe_run "$label" inputs/lid_cavity.yaml --set domain.cell="$(calc %.10g "1/$cells")" "$@"
    centre_lines "$(find "$runs/$label/fields" -name '*.h5' | sort | tail -n 1)" "$cells" "$runs/$label.csv"
    beside_ghia "$runs/$label.csv" "$column" >"$results/transport-$label.csv"
    cavity_rows+=("$(printf '| %s | %s x %s | %.4f | %.4f |' "${label%-*}" "$cells" "$cells" \
        "$(largest_deviation "$results/transport-$label.csv" u)" "$(largest_deviation "$results/transport-$label.csv" v)")")
}

cavity_plot() { # NAME TITLE COLUMN FINEST
    plot "$1" 760,520 <<EOF
set title '$2'
set xlabel 'place on the centre line'
set ylabel 'velocity over that of the lid'
set key bottom right
plot '< grep ^u $runs/$4.csv' using 2:3 with lines lw 2 lc rgb '#2060a0' title 'u over y, floe', \\
    '< grep ^v $runs/$4.csv' using 2:3 with lines lw 2 lc rgb '#c05020' title 'v over x, floe', \\
    '< grep ^u scripts/results/ghia_1982.csv' using 2:$3 with points pt 6 lc rgb '#2060a0' title 'u, Ghia et al.', \\
    '< grep ^v scripts/results/ghia_1982.csv' using 2:$3 with points pt 4 lc rgb '#c05020' title 'v, Ghia et al.'
EOF
}

# side_row WHAT FOLDER ARGUMENT...: what comes back of the pulse, by three spacings, over its amplitude in pressure.
side_row() {
    local what=$1 amplitude=$2 h row
    shift 2
    floe_compare "$@"
    row="| $what |"
    for h in $(cases "$csv" ice); do row+=" $(calc %.3g "100*$(value "$csv" ice "$h" linf_pressure)/(1.4*$amplitude)") % |"; done
    write "$row"
}

result_transport() {
    begin transport 'Viscosity, conduction and sides, on the cells'
    local cavity_rows=() row
    floe_compare couette inputs/couette.yaml --axis domain.cell=0.125,0.0625,0.03125
    cp "$csv" $results/transport-couette.csv
    order_bar 'Couette between hot and cold plates, Mach 0.6: order of temperature' "$csv" ice l1_temperature 1.9
    floe_compare poiseuille inputs/poiseuille.yaml --axis domain.cell=0.125,0.0625,0.03125
    cp "$csv" $results/transport-poiseuille.csv
    order_bar 'Poiseuille: order of velocity' "$csv" ice l1_velocity_x 1.9
    local about_axis=(--set domain.geometry=axisymmetric)
    floe_compare pipe inputs/poiseuille.yaml "${about_axis[@]}" --set 'domain.upper=[1, 0.5]' --set 'boundaries={r: {upper: no_slip}, z: periodic}' \
        --set 'bodies.liquid.shape={box: {lower: [0, 0], upper: [1, 0.5]}}' --set 'loads.drive.gravity.acceleration=[0, 0.4]' \
        --set 'verify.exact={pipe_flow: {radius: 1, force: 0.4, density: 1, viscosity: 0.1, pressure: 1}}' \
        --set 'verify.metrics=[l1_velocity_y, linf_velocity_y]' --axis domain.cell=0.125,0.0625,0.03125
    cp "$csv" $results/transport-pipe.csv
    order_bar 'Pipe, about its axis: order of velocity' "$csv" ice l1_velocity_y 1.9
    floe_compare annulus inputs/couette.yaml "${about_axis[@]}" --set 'domain.lower=[0.5, 0]' --set 'domain.upper=[1.5, 0.5]' \
        --set 'boundaries={r: {lower: {no_slip: {velocity: [0, 0.8], temperature: 1.2}}, upper: {no_slip: {temperature: 1}}}, z: periodic}' \
        --set 'bodies.gas.shape={box: {lower: [0.5, 0], upper: [1.5, 0.5]}}' \
        --set 'verify.exact={annulus_hot: {inner_radius: 0.5, outer_radius: 1.5, speed: 0.8, pressure: 1, heat_capacity: 2.5, viscosity: 0.16, conductivity: 0.6, inner_temperature: 1.2, outer_temperature: 1}}' \
        --set 'verify.metrics=[l1_velocity_y, l1_temperature, l1_density, l1_pressure]' --axis domain.cell=0.125,0.0625,0.03125
    cp "$csv" $results/transport-annulus.csv
    order_bar 'Annulus, hot core that slides, Mach 0.6: order of temperature' "$csv" ice l1_temperature 1.9
    order_bar 'Annulus, hot core that slides, Mach 0.6: order of velocity' "$csv" ice l1_velocity_y 1.9
    local midpoint=(--set method.pressure=implicit --set method.centring=half)
    floe_compare green inputs/taylor_green.yaml "${midpoint[@]}" --set materials.liquid.eos.acoustic.sound_speed=320 \
        --axis domain.cell=0.03125,0.015625,0.0078125
    cp "$csv" $results/transport-green.csv
    order_bar 'Taylor-Green, Mach 1/320, 32 to 128 cells: order of velocity' "$csv" ice l1_velocity_x 1.9
    floe_compare heat inputs/heat_wave.yaml
    cp "$csv" $results/transport-heat.csv
    order_bar 'heat that diffuses in a gas: order of temperature' "$csv" ice l1_temperature 1.9
    floe_compare sound inputs/heat_wave.yaml --set verify.exact.damped_wave.thermal=0
    cp "$csv" $results/transport-sound.csv
    order_bar 'damped sound: order of velocity' "$csv" ice l1_velocity_x 1.9
    floe_compare mms inputs/flow_mms.yaml
    cp "$csv" $results/transport-mms.csv
    order_bar 'manufactured flow, Mach 0.5: order of velocity' "$csv" ice l1_velocity_x 1.9
    order_bar 'manufactured flow, Mach 0.5: order of temperature' "$csv" ice l1_temperature 1.9
    floe_compare piston inputs/piston_wave.yaml
    cp "$csv" $results/transport-piston.csv
    order_bar 'side that draws at 0.3 c: order of density' "$csv" ice l1_density 1.8
    floe_compare pulse inputs/pulse_leaves.yaml
    bar 'pulse of sound out of a tube, eight cells a standard deviation: share sent back' \
        "$(calc %.3g "100*$(value "$csv" ice 0.01 linf_pressure)/0.0014")" '<=' 1 %.2g ' %'
    cavity re_100-32 3 32
    cavity re_100-64 3 64
    bar 'cavity, Reynolds number 100, 64 x 64: largest deviation of u from Ghia et al.' \
        "$(largest_deviation $results/transport-re_100-64.csv u)" '<=' 0.01 %.4f
    local thousand=(--set materials.liquid.viscosity.shear=0.001 --set time.end=100)
    cavity re_1000-32 4 32 "${thousand[@]}"
    cavity re_1000-64 4 64 "${thousand[@]}"
    bar 'cavity, Reynolds number 1000, 64 x 64: largest deviation of u from Ghia et al.' \
        "$(largest_deviation $results/transport-re_1000-64.csv u)" '<=' 0.03 %.4f
    write 'Errors against exact solutions of the equations that are solved, under refinement in space and time together; L1 of cell averages.' '' \
        '## Bars' ''
    show_bars
    write '' '## Couette flow between a cold plate and a hot one that moves' '' \
        'Ideal gas at Mach 0.6, heated by its own shear, from the exact flow to the discrete one.' ''
    order_table $results/transport-couette.csv ice l1_velocity_x l1_temperature l1_density l1_pressure
    write '## Poiseuille flow' '' 'Off by a constant, h^2/4 of the curvature at the walls.' ''
    order_table $results/transport-poiseuille.csv ice l1_velocity_x linf_velocity_x
    write '## About an axis' '' 'Along a pipe of radius 1:' ''
    order_table $results/transport-pipe.csv ice l1_velocity_y linf_velocity_y
    write 'An ideal gas between a hot core of radius 0.5 that slides and a cold tube of radius 1.5:' ''
    order_table $results/transport-annulus.csv ice l1_velocity_y l1_temperature l1_density l1_pressure
    write '## Taylor-Green vortices' '' 'At Mach 1/320, by the implicit pressure at the midpoint of the step. The exact solution is that of incompressible flow.' ''
    order_table $results/transport-green.csv ice l1_velocity_x l1_velocity_y
    floe_compare green-sound inputs/taylor_green.yaml --set materials.liquid.eos.acoustic.sound_speed=80
    write 'Explicit, at Mach 1/80:' ''
    order_table "$csv" ice l1_velocity_x
    floe_compare green-slow inputs/taylor_green.yaml --set materials.liquid.eos.acoustic.sound_speed=8 --set verify.exact.taylor_green.speed=0.1
    write 'A tenth of the speed at the same Mach number, where viscosity is all there is:' ''
    order_table "$csv" ice l1_velocity_x
    write 'The order of the coarse meshes is not the one of the step, nor of a limiter (there is none): slow vortices have order 2, and at' \
        'full speed the damping of advection, of third order and of the other sign, hides part of the error of viscosity while cells' \
        'are large. At Mach 1/80 the difference of compressible and incompressible flow, 2e-6, then hides part of the fall on fine meshes.' ''
    floe_compare green-mach inputs/taylor_green.yaml --axis materials.liquid.eos.acoustic.sound_speed=10,20,40
    write 'On 32 x 32 cells, by the sound speed over the greatest speed: what is left falls with the square of the Mach number to the error of the mesh.' '' \
        '| sound speed | l1_velocity_x |' '|---|---|'
    for row in 10 20 40; do write "| $row | $(printf %.3e "$(value "$csv" ice $row l1_velocity_x)") |"; done
    write ''
    write '## Heat that diffuses in a gas, and sound that it damps' '' 'Small plane waves, roots of the dispersion relation. Heat:' ''
    order_table $results/transport-heat.csv ice l1_temperature l1_density l1_velocity_x l1_pressure
    write 'Sound:' ''
    order_table $results/transport-sound.csv ice l1_temperature l1_density l1_velocity_x l1_pressure
    write '## Manufactured flow' '' 'Viscous, heat-conducting, unsteady, compressible, held by a force and a heat source.' ''
    order_table $results/transport-mms.csv ice l1_density l1_velocity_x l1_velocity_y l1_pressure l1_temperature
    write '## Lid-driven cavity' '' 'Largest deviation from the velocities of Ghia, Ghia and Shin (1982) on the centre lines, over that of the lid:' '' \
        '| | cells | u over y | v over x |' '|---|---|---|---|'
    for row in "${cavity_rows[@]}"; do write "$row"; done
    cavity_plot re_100 'Reynolds number 100, 64 x 64 cells' 3 re_100-64
    cavity_plot re_1000 'Reynolds number 1000, 64 x 64 cells' 4 re_1000-64
    write '' '![Reynolds number 100](transport-re_100.svg)' '' '![Reynolds number 1000](transport-re_1000.svg)' '' '## Sides' '' \
        'What comes back of a pulse that leaves a tube, in per cent of it, with 4, 8 and 16 cells a standard deviation:' '' \
        '| side | h = 0.02 | 0.01 | 0.005 |' '|---|---|---|---|'
    side_row '`non_reflecting`, pulse of 0.001 c' 0.001 pulse-weak inputs/pulse_leaves.yaml
    side_row '`non_reflecting`, pulse of 0.05 c' 0.05 pulse-strong inputs/pulse_leaves.yaml --set verify.exact.simple_wave.amplitude=0.05
    side_row '`free`' 0.001 pulse-free inputs/pulse_leaves.yaml --set boundaries.x.upper=free
    side_row '`outlet`' 0.001 pulse-outlet inputs/pulse_leaves.yaml --set 'boundaries.x.upper={outlet: {pressure: 1}}'
    write '' 'A round wave that leaves a square sends back up to 15 % of what meets the sides near the corners, at 45 degrees' \
        '(`verification_ice_sides`): the condition is one-dimensional, and (1 - cos a)/(1 + cos a) is 17 % there.' '' \
        'A side whose velocity follows time, drawing at 0.3 c, against the simple wave:' ''
    order_table $results/transport-piston.csv ice l1_density l1_velocity_x l1_pressure
    finish
}
