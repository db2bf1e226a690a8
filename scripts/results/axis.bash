# axis: cells, points and membranes about an axis. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

axis_cells=${AXIS_CELLS:-0.1 0.05 0.025}
axis_slab=(--set domain.geometry=axisymmetric --set domain.stress_state=null --set 'domain.upper=[1.2, 0.2]'
    --set 'boundaries={r: {lower: symmetry, upper: {outlet: {pressure: 101325, temperature: 300}}}, z: symmetry}'
    --set 'bodies.cylinder.shape={box: {lower: [0.5, 0], upper: [1, 0.2]}}' --set 'bodies.bore.shape={box: {lower: [0, 0], upper: [0.5, 0.2]}}'
    --set 'loads.heating.pressurise.region={box: {lower: [0, 0], upper: [0.75, 0.2]}}'
    --set 'verify.metrics=[eq13, l1rel_sigma_r, l1rel_sigma_theta]' --set method.edge_penalty=0)
axis_tube=(--set 'domain.upper=[0.8, 0.2]' --set boundaries.z=symmetry
    --set 'bodies.gas.shape={box: {lower: [0, 0], upper: [0.5, 0.2]}}'
    --set 'bodies.skin.membrane.curve={segment: {from: [0.5, 0], to: [0.5, 0.2]}}'
    --set 'verify.reference={membrane_rest: {share: 0.2, rest_radius: 0.5, thickness: 0.1, modulus: 54945.05494505494, constant_volume: 1, gas_pressure: 1000, gas_volume: 0.15707963267948966}}'
    --set verify.history.radius_last=last_skin_r)
axis_air='materials.air={eos: {ideal: {gamma: 1.4, specific_heat: 1}}}'
axis_stream=(--coupling ice-mpm --set 'method={basis: quadratic, flip: 1}' --set "$axis_air" --set damping=null --set materials.gas.viscosity=null
    --set 'bodies.skin.velocity=[0, 10]' --set verify=null --set time.end=0.05
    --set 'bodies.air={material: air, shape: {box: {lower: [0, 0], upper: [0.5, 1.5]}}, pressure: 1000, temperature: 700, velocity: [0, 10]}')

# axis_lame FOLDER METRIC...: a table of a comparison's errors (%) with orders by least squares.
axis_lame() {
    local file=$runs/$1/compare.csv coupling h metric row orders slope
    shift
    for coupling in ice-mpm mpm; do
        for h in $axis_cells; do
            row="| $coupling | $h |"
            for metric in "$@"; do row+=" $(calc %.2f "100*$(value "$file" $coupling "$h" "$metric")") |"; done
            write "$row"
        done
        orders="| $coupling | order |"
        for metric in "$@"; do
            read -r slope _ < <(order "$file" $coupling "$metric")
            orders+=" $(calc %.2f "$slope") |"
        done
        write "$orders"
    done
}

axis_solids() {
    write '## Solids in gas, against Lamé' '' '`inputs/pressurized_cylinder.yaml` as a slab in (r, z): eq. 13 and L1 of the stresses over their means, per cent.' '' \
        '| coupling | h | eq. 13 | sigma_r | sigma_theta |' '|---|---|---|---|---|'
    floe_compare cylinder inputs/pressurized_cylinder.yaml "${axis_slab[@]}" --axis "domain.cell=${axis_cells// /,}"
    axis_lame cylinder eq13 l1rel_sigma_r l1rel_sigma_theta
    bar 'cylinder in (r, z), ice-mpm, h = 0.05: eq. 13' "$(calc %g "100*$(value "$csv" ice-mpm 0.05 eq13)")" '<=' 10 %.2f ' %'
    read -r slope _ < <(order "$csv" ice-mpm eq13)
    bar 'cylinder in (r, z), ice-mpm: order of eq. 13' "$slope" '>=' 0.89 %.2f
    write '' '`inputs/pressurized_sphere.yaml`, half of a sphere; displacements along r and z.' '' \
        '| coupling | h | sigma_r | sigma_theta | u_r | u_z |' '|---|---|---|---|---|---|'
    floe_compare sphere inputs/pressurized_sphere.yaml --axis "domain.cell=${axis_cells// /,}"
    axis_lame sphere l1rel_sigma_r l1rel_sigma_theta l1rel_displacement_x l1rel_displacement_y
    bar 'sphere, ice-mpm, h = 0.05: L1 of sigma_theta' "$(calc %g "100*$(value "$csv" ice-mpm 0.05 l1rel_sigma_theta)")" '<=' 10 %.2f ' %'
    read -r slope _ < <(order "$csv" ice-mpm l1rel_sigma_theta)
    bar 'sphere, ice-mpm: order of sigma_theta' "$slope" '>=' 0.89 %.2f
}

# axis_still NAME: largest change of the gases' pressures of 1000, and the gas beyond the membrane, of $csv.
axis_still() {
    write "| $1 | $(sealed_largest pressure_gas 1000), $(sealed_largest pressure_air 1000) | $(sealed_largest velocity_skin_z "$2") | $(sealed_largest outside_skin) |"
}

axis_still_membranes() {
    write '' '## Two gases and a membrane' '' '`inputs/membrane_balloon.yaml` as `ice-mpm`, gases of one pressure, 1000: at rest on both sides of the ball; a disc across a pipe' \
        'in a stream at 10, and a ball in such a stream. Areas are means over places in the step, which a curved line closes nearly ([theory](../theory/README.md)).' '' \
        '| what | largest change of either pressure | of the velocity of the membrane | gas beyond it |' '|---|---|---|---|'
    floe_run rest inputs/membrane_balloon.yaml --coupling ice-mpm --set 'method={basis: quadratic, flip: 1}' --set "$axis_air" --set damping=null \
        --set 'ambient={material: air, pressure: 1000, temperature: 700}' --set 'boundaries={r: symmetry, z: symmetry}' --set verify=null --set time.end=0.1
    axis_still "at rest, $(tail -n 1 "$csv" | cut -d, -f2) steps" 0
    bar 'two gases at rest about an axis: largest change of pressure, share' "$(calc %g "$(sealed_largest pressure_gas 1000)/1000")" '<=' 1e-12 %.1e
    bar 'two gases at rest about an axis: gas beyond the membrane' "$(sealed_largest outside_skin)" '<=' 0 %.2g
    floe_run disc inputs/membrane_balloon.yaml "${axis_stream[@]}" --set 'domain={dim: 2, geometry: axisymmetric, lower: [0, 0], upper: [0.3, 1], cell: 0.05}' \
        --set 'boundaries={r: {lower: symmetry, upper: slip}, z: {lower: {inlet: {velocity: [0, 10], material: gas, pressure: 1000, temperature: 2500}}, upper: free}}' \
        --set 'bodies.gas={material: gas, shape: {box: {lower: [0, 0], upper: [0.3, 0.313]}}, pressure: 1000, density: 1, velocity: [0, 10]}' \
        --set 'bodies.skin.membrane.curve={segment: {from: [0.3, 0.313], to: [0, 0.313]}}'
    axis_still 'a disc in a stream, ten sides of cells' 10
    bar 'disc in a stream about an axis: largest change of pressure, share' "$(calc %g "$(sealed_largest pressure_gas 1000)/1000")" '<=' 1e-12 %.1e
    local h
    for h in 0.05 0.025; do
        floe_run "carried-$h" inputs/membrane_balloon.yaml "${axis_stream[@]}" --set "domain={dim: 2, geometry: axisymmetric, lower: [0, 0], upper: [0.5, 1.5], cell: $h}" \
            --set 'boundaries={r: {lower: symmetry, upper: slip}, z: {lower: {inlet: {velocity: [0, 10], material: air, pressure: 1000, temperature: 700}}, upper: free}}' \
            --set 'bodies.gas={material: gas, shape: {ball: {centre: [0, 0.5], radius: 0.26}}, pressure: 1000, density: 1, velocity: [0, 10]}' \
            --set 'bodies.skin.membrane={curve: {arc: {centre: [0, 0.5], radius: 0.25, from: -1.5707963267948966, to: 1.5707963267948966}}, thickness: 0.1, number: 150, encloses: gas}'
        axis_still "a ball in a stream, cells of $h" 10
    done
}

# axis_rest FOLDER COUPLING H ARGUMENT...: a row of errors against an exact rest.
axis_rest() {
    local folder=$1 coupling=$2 h=$3 quantity row
    shift 3
    floe_run "$folder-$coupling-$h" inputs/membrane_balloon.yaml --coupling "$coupling" --set "domain.cell=$h" --set "bodies.skin.membrane.number=$(calc %.0f "$number/$h")" "$@"
    row="| $coupling | $h |"
    for quantity in radius radius_last area pressure hoop_stress gas_energy; do row+=" $(rest_error "$folder-$coupling-$h" $quantity) |"; done
    write "$row $(calc %.3f "100*$(sealed_largest drift_energy)") | $(sealed_largest outside_skin) |"
}

axis_rests() {
    local number=$1 folder=$2 coupling h coarse fine quantity orders
    shift 2
    write '' '| coupling | h | r, first end | r, last end | volume | pressure | hoop stress | energy of the gas | drift of energy | gas beyond |' '|---|---|---|---|---|---|---|---|---|---|'
    for coupling in ice-mpm mpm; do
        for h in $axis_cells; do axis_rest "$folder" $coupling "$h" "$@"; done
    done
    coarse=$folder-ice-mpm-${axis_cells%% *} fine=$folder-ice-mpm-${axis_cells##* } orders=()
    for quantity in radius_last pressure hoop_stress; do
        orders+=("$(calc %.2f "log($(rest_error "$coarse" $quantity)/$(rest_error "$fine" $quantity))/log(${axis_cells%% *}/${axis_cells##* })")")
    done
    write '' "Order from the coarsest to the finest cells, \`ice-mpm\`: last end ${orders[0]}, pressure ${orders[1]}, hoop stress ${orders[2]}."
    for h in 0.1 0.05; do
        bar "$folder, ice-mpm, h = $h: pressure" "$(rest_error "$folder-ice-mpm-$h" pressure)" '<=' 0.2 %.2g ' %'
        bar "$folder, ice-mpm, h = $h: r" "$(rest_error "$folder-ice-mpm-$h" radius_last)" '<=' 0.1 %.2g ' %'
    done
}

axis_blasts() {
    write '' '## Blasts' '' 'A ball, and a cylinder, of radius 0.4 and pressure and density 1 bursts into 0.1 and 0.125 (Toro, 3rd ed., section 17.1), t = 0.25: cells in (r, z) against' \
        'a reference along the radius by another method on 2000 cells (`verification_ice_blast`). Against the exact solution of Sedov: [shocks](shocks.md).' ''
    commands+=("build/release/tests/verification_ice_blast")
    made_also+=(tests/verification/test_ice_blast.c)
    "$build/tests/verification_ice_blast" 2>/dev/null | grep -E 'L1|order' | sed 's/^/    /' >>"$page"
}

result_axis() {
    local slope
    begin axis 'About an axis: solids, membranes and blasts in gas'
    axis_solids
    axis_still_membranes
    write '' '## Balloon' '' '`inputs/membrane_balloon.yaml` against its exact rest (reference `membrane_rest`): errors in per cent, of means over the last tenth of the time. The first end is on the mirror' \
        'z = 0, the last one at the axis.'
    axis_rests 6 balloon
    write '' '## Tube' '' 'The same membrane as a cylinder between two mirrors, 0.2 long.'
    axis_rests 0.8 tube "${axis_tube[@]}"
    write '' 'Airbags hit by cylinders are in [airbag](airbag.md).'
    axis_blasts
    write '' '## Bars' ''
    show_bars
    finish
}
