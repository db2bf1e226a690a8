# statics: loads that are solved for instead of stepped to, and implicit steps of points. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# statics_number RUN KEY [FACTOR]: a number of a run's summary; whole ones as they are.
statics_number() {
    awk -F: -v key="\"$2\"" -v f="${3:-1}" 'index($1, key) { printf f * $2 == int(f * $2) ? "%d" : "%.3g", f * $2; exit }' "$runs/$1/summary.json"
}

# statics_row NAME H: a row of the table of errors; time without that of outputs.
statics_row() {
    local seconds
    seconds=$(calc %.2g "$(statics_number "$1" wall_seconds)-$(statics_number "$1" output_seconds)")
    write "| $2 | $3 | $(statics_number "$1" eq13 100) | $(statics_number "$1" l1_sigma_r 1e-3) | $(statics_number "$1" l1_sigma_theta 1e-3) | $(statics_number "$1" steps) | $(statics_number "$1" balance_iterations), $(statics_number "$1" balance_cg_iterations) | $seconds |"
}

statics_cylinder() {
    local h
    write '' '## The pressurised cylinder (A1)' '' \
        '`inputs/pressurized_cylinder.yaml --coupling mpm`, heated and damped to rest by explicit steps, and the same deck with `--set time.solver=auto`, which finds' \
        'the state of rest static: its gas, enclosed by the ring, is one pressure. Eq. 13 in per cent, L1 of the stresses in kPa; time on one' \
        'core of a busy machine, without outputs.' '' '| h (m) | solver | eq. 13 | sigma_r | sigma_theta | steps | Newton, CG | s |' '|---|---|---|---|---|---|---|---|'
    for h in 0.1 0.05 0.025 0.0125; do
        floe_run "dynamic-$h" inputs/pressurized_cylinder.yaml --coupling mpm --set method.edge_penalty=0 --set "domain.cell=$h" --set output.interval=null
        statics_row "dynamic-$h" "$h" dynamic
    done
    for h in 0.1 0.05 0.025 0.0125 0.00625 0.003125; do
        floe_run "static-$h" inputs/pressurized_cylinder.yaml --coupling mpm --set method.edge_penalty=0 --set "domain.cell=$h" --set time.solver=auto --set output.interval=null
        statics_row "static-$h" "$h" static
    done
    for h in 0.1 0.05 0.025 0.0125 0.00625; do
        floe_run "edges-$h" inputs/pressurized_cylinder.yaml --coupling mpm --set "domain.cell=$h" --set time.solver=auto --set output.interval=null
        statics_row "edges-$h" "$h" 'static, edges held (edge_penalty: 0.05)'
    done
    bar 'A1 static with edges held, h = 0.025: eq. 13' "$(statics_number edges-0.025 eq13 100)" '<=' 0.6 %.2g ' %'
    bar 'A1 static with edges held, h = 0.0125: eq. 13' "$(statics_number edges-0.0125 eq13 100)" '<=' 0.1 %.2g ' %'
    bar 'A1 static, h = 0.0125: eq. 13' "$(statics_number static-0.0125 eq13 100)" '<=' 1 %.2g ' %'
    bar 'A1 static, h = 0.003125: iterations of conjugate gradients' "$(statics_number static-0.003125 balance_cg_iterations)" '<=' 20 %d
}

statics_cells() {
    local h i e
    write '' '## With the gas on cells (A1 as ice-mpm)' '' \
        'The deck as it is, `ice-mpm`, with `--set time.solver=auto`: gas at rest, one pressure a region; smeared and sharp interface.' '' \
        '| h (m) | solver | eq. 13 | sigma_r | sigma_theta | steps | Newton, CG | s |' '|---|---|---|---|---|---|---|---|'
    for i in smeared sharp; do
        for e in 0 0.05; do
            for h in 0.1 0.05 0.025 0.0125; do
                floe_run "cells-$i-$e-$h" inputs/pressurized_cylinder.yaml --set time.solver=auto --set "method.interface=$i" --set "method.edge_penalty=$e" --set "domain.cell=$h" \
                    --set output.interval=null
                statics_row "cells-$i-$e-$h" "$h" "$i$([ "$e" = 0 ] || echo ', edges held')"
            done
        done
    done
    write '' 'As a thick sphere, about its axis (`inputs/pressurized_sphere.yaml`, edges held), against Lamé.' '' \
        '| h (m) | interface | u_r | u_z | sigma_r | sigma_theta |' '|---|---|---|---|---|---|'
    for i in smeared sharp; do
        for h in 0.1 0.05 0.025; do
            e=cells-sphere-$i-$h
            floe_run "$e" inputs/pressurized_sphere.yaml --set time.solver=auto --set "method.interface=$i" --set method.edge_penalty=0.05 --set "domain.cell=$h" --set output.interval=null
            write "| $h | $i | $(statics_number "$e" l1rel_displacement_x 100) % | $(statics_number "$e" l1rel_displacement_y 100) % | $(statics_number "$e" l1rel_sigma_r 100) % | $(statics_number "$e" l1rel_sigma_theta 100) % |"
        done
    done
    e=cells-smeared-0.05
    bar 'A1 as ice-mpm, static, h = 0.05: eq. 13' "$(statics_number "$e-0.05" eq13 100)" '<=' 1 %.2g ' %'
    bar 'A1 as ice-mpm, static, h = 0.05: time' "$(calc %.2g "$(statics_number "$e-0.05" wall_seconds)-$(statics_number "$e-0.05" output_seconds)")" '<=' 1 %.2g ' s'
    bar 'A1 as ice-mpm, static, h = 0.0125: eq. 13' "$(statics_number "$e-0.0125" eq13 100)" '<=' 0.1 %.2g ' %'
    bar 'A1 as ice-mpm, static, h = 0.0125: time' "$(calc %.2g "$(statics_number "$e-0.0125" wall_seconds)-$(statics_number "$e-0.0125" output_seconds)")" '<=' 20 %.2g ' s'
}

# statics_line NAME DECK TITLE POINTS [SETTINGS...]: a membrane around gas.
statics_line() {
    local name=$1 deck=$2 title=$3 points=$4
    shift 4
    floe_run "$name" "inputs/$deck.yaml" --set time.solver=static --set "bodies.skin.membrane.number=$points" --set output.interval=null "$@"
    write "| $title | $points | $(statics_number "$name" hlate_radius) | $(statics_number "$name" hlate_pressure) | $(statics_number "$name" hlate_hoop_stress) | $(statics_number "$name" balance_iterations) | $(calc %.2g "$(statics_number "$name" wall_seconds)-$(statics_number "$name" output_seconds)") |"
}

statics_lines() {
    local n
    write '' '## Membranes around gas' '' 'Errors of the rest, of what is exact for the length and the gas that are there (stepped: [membrane-rest](membrane-rest.md)).' '' \
        '| deck | points | radius | pressure | hoop stress | Newton | s |' '|---|---|---|---|---|---|---|'
    statics_line line-circle membrane_circle 'circle (A3)' 91
    for n in 56 100 200 600; do statics_line "line-bone-$n" membrane_dogbone 'dog-bone (A4)' "$n" --set domain.cell=0.1; done
    statics_line line-bone-cells membrane_dogbone 'dog-bone, gas on cells (some 3e-4 of it more)' 600 --coupling ice-mpm
    for n in 30 60 120; do statics_line "line-balloon-$n" membrane_balloon 'balloon about its axis' "$n" --coupling mpm --set bodies.skin.membrane.strain=places; done
    bar 'dog-bone at rest: pressure' "$(statics_number line-bone-600 hlate_pressure 100)" '<=' 0.01 %.2g ' %'
    bar 'dog-bone at rest: radius' "$(statics_number line-bone-600 hlate_radius 100)" '<=' 0.01 %.2g ' %'
    bar 'dog-bone at rest: order of the pressure, 56 to 200 points' "$(calc %.2f "log($(statics_number line-bone-56 hlate_pressure)/$(statics_number line-bone-200 hlate_pressure))/log(200/56)")" '>=' 1.8 %.2f
}

statics_contact() {
    local h
    write '' '## Bodies in contact' '' \
        '`inputs/pressed_cylinder.yaml`: a cylinder on a block, which only their contact holds, against Hertz, within 2 a of the middle: relative L1 of the stress across the' \
        'contact. Gaps at the edge of the strip (half-width a = 0.05) are 0.05 cells at h = 0.025, and grow as 1/h.' '' \
        '| h | a/h | stress across | steps (rejected) | Newton, CG | s |' '|---|---|---|---|---|---|'
    for h in 0.025 0.0125; do
        floe_run "contact-$h" inputs/pressed_cylinder.yaml --set "domain.cell=$h" --set output.interval=null
        write "| $h | $(calc %g "0.05/$h") | $(statics_number "contact-$h" l1rel_stress_yy 100) % | $(statics_number "contact-$h" steps) ($(statics_number "contact-$h" rejected_steps)) | $(statics_number "contact-$h" balance_iterations), $(statics_number "contact-$h" balance_cg_iterations) | $(calc %.2g "$(statics_number "contact-$h" wall_seconds)-$(statics_number "contact-$h" output_seconds)") |"
    done
    write '' 'Bars across a gap of 1e-4 of their length, the force growing past what closes it, and back (`verification_mpm_statics_contact`): the pressure is within' \
        '1.2e-4 of the exact one in one increment and 7e-4 in five (strains are 2e-4), and nothing is left of it once they part (linear and quadratic 2e-5; gimp 1 % of the largest stress, in one point).'
    bar 'cylinder on a block, h = a/4: stress across the contact' "$(statics_number contact-0.0125 l1rel_stress_yy 100)" '<=' 5 %.2g ' %'
}

statics_ring() {
    local h basis
    write '' '## Iterations' '' '`inputs/annulus_traction.yaml --set time.solver=static`: iterations of conjugate gradients in all steps of Newton'"'"'s method, to' \
        '1e-8 of the forces.' '' '| h (m) | linear | gimp | quadratic | cubic |' '|---|---|---|---|---|'
    for h in 0.1 0.05 0.025 0.0125; do
        local row="| $h |"
        for basis in linear gimp quadratic cubic; do
            floe_run "ring-$basis-$h" inputs/annulus_traction.yaml --set "domain.cell=$h" --set "method.basis=$basis" --set time.solver=static --set output.interval=null
            row+=" $(statics_number "ring-$basis-$h" balance_cg_iterations) |"
        done
        write "$row"
    done
    write '' 'Rest, at h = 0.05: eq. 13 as damped steps come closer to it, and static.' '' '| stop: kinetic_over_strain | eq. 13 | steps |' '|---|---|---|'
    for h in 1e-6 1e-10 1e-14; do
        floe_run "rest-$h" inputs/annulus_traction.yaml --set domain.cell=0.05 --set "stop.kinetic_over_strain=$h" --set 'time.end=0.1' --set output.interval=null
        write "| $h | $(statics_number "rest-$h" eq13 100) % | $(statics_number "rest-$h" steps) |"
    done
    for h in 1 4; do
        floe_run "rest-static-$h" inputs/annulus_traction.yaml --set domain.cell=0.05 --set time.solver=static --set "time.increments=$h" --set output.interval=null
        write "| static, in $h | $(statics_number "rest-static-$h" eq13 100) % | $(statics_number "rest-static-$h" steps) |"
    done
}

statics_sphere() {
    local h
    write '' '## In space' '' 'The ring'"'"'s deck as an eighth of a thick sphere, edges held, against Lamé: relative L1 of the stresses.' '' \
        '| h (m) | points | sigma_r | sigma_theta | Newton, CG |' '|---|---|---|---|---|'
    for h in 0.2 0.1 0.05; do
        floe_run "sphere-$h" inputs/annulus_traction.yaml --set time.solver=static --set method.edge_penalty=0.05 \
            --set "domain={dim: 3, lower: [0, 0, 0], upper: [1.2, 1.2, 1.2], cell: $h}" \
            --set 'boundaries={x: {lower: symmetry, upper: free}, y: {lower: symmetry, upper: free}, z: {lower: symmetry, upper: free}}' \
            --set 'bodies.cylinder.shape.annulus.centre=[0, 0, 0]' --set 'loads.bore.traction.surface.ball.centre=[0, 0, 0]' --set verify.pressure=null \
            --set 'verify.exact={lame_sphere: {inner_radius: 0.5, outer_radius: 1.0, inner_pressure: 19.4 MPa, bulk_modulus: 117 GPa, shear_modulus: 43.8 GPa}}' \
            --set 'verify.metrics=[l1rel_sigma_r, l1rel_sigma_theta]' --set output.interval=null
        write "| $h | $(statics_number "sphere-$h" points) | $(statics_number "sphere-$h" l1rel_sigma_r 100) % | $(statics_number "sphere-$h" l1rel_sigma_theta 100) % | $(statics_number "sphere-$h" balance_iterations), $(statics_number "sphere-$h" balance_cg_iterations) |"
    done
    write '' 'Without `edge_penalty` conjugate gradients took 22, 7 and 224 iterations: in space, slivers of slivers are left that patches of one cell do not cure.'
}

statics_bar() {
    local n
    write '' '## Implicit steps' '' '`inputs/bar_vibration.yaml --set domain.cell=0.015625` (L1 of the stress in Pa, of 3.1) by explicit steps, and with' \
        '`time: {solver: implicit, increments: N}`.' '' '| steps | L1 of the stress (Pa) | drift of energy |' '|---|---|---|'
    floe_run bar-explicit inputs/bar_vibration.yaml --set domain.cell=0.015625 --set output.interval=null
    write "| $(statics_number bar-explicit steps), explicit | $(statics_number bar-explicit l1_stress_xx) | $(statics_number bar-explicit energy) |"
    for n in 7 14 28 56 112; do
        floe_run "bar-$n" inputs/bar_vibration.yaml --set domain.cell=0.015625 --set time.solver=implicit --set "time.increments=$n" --set output.interval=null
        write "| $n | $(statics_number "bar-$n" l1_stress_xx) | $(statics_number "bar-$n" energy) |"
    done
    bar 'implicit steps, order from 14 to 28 steps' "$(calc %.2f "log($(statics_number bar-14 l1_stress_xx)/$(statics_number bar-28 l1_stress_xx))/log(2)")" '>=' 1.8 %.2f
}

result_statics() {
    begin statics 'Loads that are solved for, and implicit steps'
    statics_cylinder
    statics_cells
    statics_lines
    statics_contact
    statics_ring
    statics_sphere
    statics_bar
    write '' '## What was left' '' \
        '* Without `edge_penalty`, nodes with a sliver of a support are solved for exactly, but their answer is that of the points there: a surface load on them' \
        '  has the largest errors, and a body whose tip moves through several cells can meet a node that it hardly reaches, with a load that nothing there bears: the' \
        '  increments are then cut until the run ends with status 3. Explicit steps hide this in inertia.' \
        '* Areas of loaded surfaces stay what they were, as in explicit steps; gas points of a room stay where they are.' \
        '* KINSOL was measured and left out: figures in [deviations](../deviations.md). Sub-steps of points beside gas: [substeps](substeps.md).' \
        '* Between bodies in contact conjugate gradients are not yet independent of h: 28, 25 and 214 iterations in the seven, six and seven of Newton of the first increment of the cylinder on a' \
        '  block at h = 0.025, 0.0125 and 0.00625, where the first increment of the last takes minutes and the run is not made here. An increment in which a point would go more than a quarter of a cell is cut only when it has been solved.' \
        '* Coulomb friction of bodies in contact, whose matrix is not symmetric. Membranes without `strain: places`, surfaces in space, springs and strings are stepped.'
    write '' '## Bars' '' 'Set after first trials.' ''
    show_bars
    finish
}
