# cpdi: domains that deform with their points, beside the other bases. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

cpdi_bases=(linear gimp cpdi quadratic)

# percent X: as a percentage.
percent() {
    calc '%.2f %%' "100*($1)"
}

# The clamped bar: orders of every basis.
cpdi_bar() {
    local basis metric row b s
    for basis in "${cpdi_bases[@]}"; do
        floe_compare bar-$basis inputs/bar_vibration.yaml --set method.basis=$basis
        row="| $basis |"
        for metric in l1_velocity_x l1_stress_xx; do
            read -r b s < <(order "$csv" mpm $metric)
            row+=" $(printf '%.2e to %.2e | %.2f' "$(value "$csv" mpm 0.0625 $metric)" "$(value "$csv" mpm 0.015625 $metric)" "$b") |"
            [ $basis-$metric = cpdi-l1_velocity_x ] && bar 'vibrating bar, cpdi: order of velocity' "$b" '>=' 1.8 %.2f
        done
        orders+=("$row")
    done
}

# The pressurised cylinder, both couplings.
cpdi_cylinder() {
    local basis coupling h
    for basis in "${cpdi_bases[@]}"; do
        floe_compare cylinder-$basis inputs/pressurized_cylinder.yaml --set method.basis=$basis --set method.edge_penalty=0
        cp "$csv" $results/cpdi-cylinder-$basis.csv
    done
    for coupling in mpm ice-mpm; do
        for h in 0.1 0.05 0.025; do
            for basis in "${cpdi_bases[@]}"; do
                csv=$results/cpdi-cylinder-$basis.csv
                cylinder+=("| $coupling | $h | $basis | $(percent "$(value "$csv" $coupling $h eq13)") | $(calc %.3f "$(value "$csv" $coupling $h l1_sigma_r)/1e6") | \
$(calc %.3f "$(value "$csv" $coupling $h l1_sigma_theta)/1e6") | $(value "$csv" $coupling $h status | tr _ ' ') | $(value "$csv" $coupling $h steps) | \
$(printf %.2g "$(value "$csv" $coupling $h wall_seconds)") s |")
            done
        done
    done
}

# The finest gas of points: does it come to rest?
cpdi_fine() {
    local basis
    for basis in cpdi gimp; do
        if floe_run fine-$basis inputs/pressurized_cylinder.yaml --set coupling=mpm --set method.basis=$basis \
            --set method.edge_penalty=0 --set domain.cell=0.0125; then
            fine+=("$basis: eq. 13 is $(sed -n 's/.*"eq13": \([0-9.e-]*\).*/\1/p' "$runs/fine-$basis/summary.json" | awk '{ printf "%.2f %%", 100 * $1 }') \
($(sed -n 's/^ *"status": "\([a-z_]*\)".*/\1/p' "$runs/fine-$basis/summary.json" | tr _ ' ')).")
        else
            fine+=("$basis: it diverges ($(sed -n 's/^ *"message": "\(.*\)",*$/\1/p' "$runs/fine-$basis/summary.json")).")
        fi
    done
}

# A mass on a spring of points that cross cells: what becomes of its energy.
cpdi_crossing() {
    local basis
    for basis in "${cpdi_bases[@]}"; do
        floe_compare crossing-$basis inputs/cell_crossing.yaml --axis domain.cell=0.1 --set method.basis=$basis
        crossing+=("| $basis | $(sed -n "s/^$basis: .*largest jump //p" "$runs/force.txt") | $(printf %.1e "$(value "$csv" mpm 0.1 drift_energy)") |")
    done
}

# The largest stable steps, and those with the other transfers.
cpdi_steps() {
    local transfer scheme basis
    local -a common=(--set output.interval=null --set output.history_interval=0.01 --set time.end=100 --relative-to 0.00197642354)
    floe_stability bar inputs/bar_vibration.yaml "${common[@]}" --set time.max_steps=4000 --over time.fixed_step=0.0005:0.008 \
        --each method.basis=linear,gimp,cpdi --each method.stress=usl,usf,musl --tolerance 0.005
    for basis in linear gimp cpdi; do
        steps+=("| flip | $basis |$(for scheme in usl usf musl; do printf ' %.2f |' "$(limit "$csv" $basis,$scheme stable_over_reference)"; done)")
    done
    floe_stability transfers inputs/bar_vibration.yaml "${common[@]}" --set time.max_steps=2000 --set method.flip=null --set method.basis=cpdi \
        --over time.fixed_step=0.0005:0.012 --each method.transfer=pic,xpic,apic,tpic --each method.stress=usl,usf,musl --tolerance 0.01
    for transfer in pic xpic apic tpic; do
        steps+=("| $transfer | cpdi |$(for scheme in usl usf musl; do printf ' %.2f |' "$(limit "$csv" $transfer,$scheme stable_over_reference)"; done)")
    done
}

result_cpdi() {
    begin cpdi 'CPDI: domains that deform with their points'
    local orders=() cylinder=() fine=() crossing=() steps=() worst
    "$build/tests/verification_mpm_domains" >"$runs/domains.txt" 2>&1
    "$build/tests/verification_mpm_force" >"$runs/force.txt" 2>&1
    worst=$(sed -n 's/.*: cpdi \([^,]*\), gimp.*/\1/p' "$runs/domains.txt" | sort -g | tail -n 1)
    bar 'uniform stress in deformed blocks: largest force inside, of the stress times a face' "$worst" '<=' 2e-13 %.1e
    cpdi_bar
    cpdi_crossing
    cpdi_steps
    cpdi_cylinder
    bar 'pressurised cylinder as mpm, cpdi: spacings at which the gas of points does not come to rest' \
        "$(awk -F, '$1 == "mpm" && $0 !~ /at_rest/ { n++ } END { print n + 0 }' $results/cpdi-cylinder-cpdi.csv)" '<=' 0 %.0f
    cpdi_fine
    write 'The domain of a point is a parallelogram (in space a parallelepiped) that stretches, shears and turns with it; its corners carry the linear basis' \
        '([theory](../theory/README.md)). Beside it the linear basis, GIMP, whose boxes keep their shape (those of fluids swell), and the default, quadratic splines.' '' '## Bars' ''
    show_bars
    write '' '## Blocks under uniform stress' '' \
        'A block of 4 x 2 (x 2) points a cell is mapped; then every point has the same stress. The largest force on a node inside, over stress times face, should vanish:' '' \
        '| block | cpdi | gimp |' '|---|---|---|'
    sed -n 's/^\(.-D\), \(.*\): cpdi \(.*\), gimp \(.*\)$/| \1, \2 | \3 | \4 |/p' "$runs/domains.txt" >>"$page"
    write '' '## A vibrating bar' '' 'L1 errors from h = 1/16 to 1/64, two points a cell, and orders. Points that tile their cells make of GIMP and CPDI the linear basis.' '' \
        '| basis | velocity (m/s) | order | stress (Pa) | order |' '|---|---|---|---|---|' "${orders[@]}" '' \
        '## Points that cross cells' '' "Jump of the force (N) at York's nodes as a point crosses a face (A.2 of his thesis), and drift of the energy of a mass on a spring of points in 1 s" \
        '(`inputs/cell_crossing.yaml`):' '' '| basis | jump | drift of energy |' '|---|---|---|' "${crossing[@]}" '' \
        '## Steps' '' 'The clamped bar, as on the page [stability](stability.md): largest stable step over h/c.' '' \
        '| transfer | basis | usl | usf | musl |' '|---|---|---|---|---|' "${steps[@]}" '' \
        '## The pressurised cylinder' '' 'Eq. 13, L1 of sigma_r and sigma_theta (MPa); fitted points, 2 x 2 a cell, edges not held; as `mpm` the gas is points too, of the same basis.' '' \
        '| coupling | h (m) | basis | eq. 13 | sigma_r | sigma_theta | end | steps | wall time |' '|---|---|---|---|---|---|---|---|---|' "${cylinder[@]}" '' \
        'As `mpm` with h = 0.0125 m:' '' "${fine[@]/#/* }" '' \
        'Gas rests at every spacing, as GIMP points since their boxes swell with it ([deviations](../deviations.md)). The error of the stress is that of the other' \
        'bases that are linear between nodes: it lies in the edges of the solid and in one stress a cell, which domains do not change; splines are a factor of four better.' '' \
        '## Tried' '' \
        '* Domains of whole sub-cells for the points that fitted seeding cuts at surfaces: eq. 13 of 19.5, 10.0 and 6.15 % (ice-mpm) and 19.3, 10.3 and 6.8 % (mpm)' \
        '  where domains with the volumes of their points have what the table says.' \
        '* Domains that reach over walls, folded as other bases are: corners of leaning domains may give nodes negative weights; they are squeezed to the wall instead. At mirrors' \
        '  they are folded, and half a body moves as the half of a whole one.'
    finish
}
