# edges: edges of solids held by a penalty, on the thick cylinder under a traction and on that with gas. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

edges_deck=inputs/annulus_traction.yaml
edges_cells=${EDGES_AXIS:-0.1,0.05,0.025,0.0125}

# edges_value FOLDER NAME: a number of the summary.
edges_value() {
    sed -nE "s/^ *\"$2\": ([^,]*),?\$/\1/p" "$runs/$1/summary.json" | head -n 1
}

# edges_row FOLDER LABEL: eq. 13, L1 of both stresses in per cent of the pressure, steps, time.
edges_row() {
    local error pressure=19.4e6
    case $1 in small-*) pressure=19.4e4 ;; esac
    error=$(edges_value "$1" eq13)
    write "$(printf '| %s | %s | %.3f | %.3f | %d | %.2g |' "$2" "$([ -n "$error" ] && calc %.3f "100*$error" || echo -)" \
        "$(calc %g "100*$(edges_value "$1" l1_sigma_r)/$pressure")" "$(calc %g "100*$(edges_value "$1" l1_sigma_theta)/$pressure")" \
        "$(edges_value "$1" steps)" "$(edges_value "$1" wall_seconds)")"
}

# edges_slope METRIC FOLDER...: order in h over runs at spacings that halve, by least squares.
edges_slope() {
    local metric=$1 f
    shift
    for f in "$@"; do edges_value "$f" "$metric"; done |
        awk '{ y[NR] = log($1) } END { for (i = 1; i <= NR; i++) { x = (NR + 1) / 2 - i; s += x * y[i]; t += x * x } printf "%.2f", s / t / log(2) }'
}

edges_table() {
    write '' "| $1 | eq. 13, % | L1 sigma_r, % of P | L1 sigma_theta, % of P | steps | wall time, s |" '|---|---|---|---|---|---|'
}

# edges_static NAME LABEL SETTING...: the cylinder in static balance at every spacing; the orders are left in $orders.
edges_static() {
    local name=$1 label=$2 h m of=()
    shift 2
    for h in ${edges_cells//,/ }; do
        floe_run "$name-$h" $edges_deck --set time.solver=static --set "domain.cell=$h" "$@"
        edges_row "$name-$h" "$label, h = $h"
        of+=("$name-$h")
    done
    orders=()
    for m in eq13 l1_sigma_r l1_sigma_theta; do
        grep -q "\"$m\"" "$runs/${of[0]}/summary.json" && orders+=("$(edges_slope $m "${of[@]}")")
    done
    slopes+=("* $label: orders $(IFS=' '; echo "${orders[*]}") in h.")
}

result_edges() {
    local g h penalty slopes=() orders=()
    begin edges 'Edges of solids: stress beside a surface that cuts the mesh'
    write 'The thick cylinder of [a1](a1.md) under a traction on its bore, so that the error is that of the solid alone, against Lamé; quadratic' \
        'splines, 2 x 2 points a cell, fitted. No point is left out, no stress smoothed. `method.edge_penalty` is gamma.' '' \
        '## In static balance (`time.solver: static`)' '' 'Orders in h are those of eq. 13 and of both L1, by least squares. Lamé is a solution for small strains: some 0.03 to 0.05 % of' \
        'eq. 13 is no error of the run, and nothing with a hundredth of the pressure (last rows).'
    edges_table 'gamma, spacing (m)'
    for g in 0 0.02 0.05 0.1; do
        edges_static "static-$g" "gamma = $g" --set method.edge_penalty=$g
        [ $g = 0.1 ] || continue
        bar 'static: order of eq. 13 in h with gamma = 0.1' "${orders[0]}" '>=' 1.7 %.2f
        bar 'static: order of L1 of sigma_r with gamma = 0.1' "${orders[1]}" '>=' 1.7 %.2f
        bar 'static: order of L1 of sigma_theta with gamma = 0.1' "${orders[2]}" '>=' 1.7 %.2f
    done
    edges_static small 'P/100, gamma = 0.05' --set method.edge_penalty=0.05 --set loads.bore.traction.pressure=19.4e4 \
        --set verify.exact.lame.inner_pressure=19.4e4 --set verify.pressure=19.4e4
    bar 'static, P/100: order of L1 of sigma_theta with gamma = 0.05' "${orders[2]}" '>=' 1.7 %.2f
    write '' "${slopes[@]}" '' '## Other bases, gamma = 0.05'
    slopes=()
    edges_table 'basis, spacing (m)'
    for g in linear gimp cubic; do
        edges_static "basis-$g-0" "$g, gamma = 0" --set method.basis=$g
        edges_static "basis-$g" "$g" --set method.basis=$g --set method.edge_penalty=0.05
    done
    write '' "${slopes[@]}" '' '## Other walls'
    slopes=()
    edges_table 'outer radius (m), spacing (m)'
    for g in 0.6 2.0; do
        for penalty in 0 0.05; do
            edges_static "wall-$g-$penalty" "$g, gamma = $penalty" --set method.edge_penalty=$penalty \
                --set bodies.cylinder.shape.annulus.outer_radius=$g --set verify.exact.lame.outer_radius=$g \
                --set "domain.upper=[$(calc %.1f "$g+0.2"), $(calc %.1f "$g+0.2")]"
        done
    done
    write '' "${slopes[@]}" '' '## A soft wall' '' \
        'Neo-Hookean, K = 50 P, G = 0.375 K, the pressure a force per area at rest: the bore opens by 4 %. Against the radial solution at large strain' \
        '(`soft_cylinder`); orders of both stresses. Here points cross cells, and lines of nodes come and go with what they remember.'
    slopes=()
    edges_table 'gamma, spacing (m)'
    for g in 0 0.05; do
        edges_static "soft-$g" "gamma = $g" --set method.edge_penalty=$g --set 'verify.metrics=[l1_sigma_r, l1_sigma_theta]' \
            --set 'materials.steel.law={neo_hookean: {bulk_modulus: 970 MPa, shear_modulus: 363.75 MPa}}' --set time.increments=4 \
            --set 'verify.exact={soft_cylinder: {inner_radius: 0.5, outer_radius: 1.0, inner_pressure: 19.4 MPa, bulk_modulus: 970 MPa, shear_modulus: 363.75 MPa}}'
    done
    write '' "${slopes[@]}" '' '## Stepped to rest, and with gas' '' \
        'Explicit, damped steps: the traction; then the gas of [a1](a1.md) as points (`mpm`) and on cells (`ice-mpm`).'
    edges_table 'load, gamma, spacing (m)'
    for h in ${EDGES_STEPPED:-0.1 0.05 0.025}; do
        for g in 0 0.05; do
            floe_run "stepped-$g-$h" $edges_deck --set "domain.cell=$h" --set method.edge_penalty=$g
            edges_row "stepped-$g-$h" "traction, gamma = $g, h = $h"
            for coupling in mpm ice-mpm; do
                floe_run "$coupling-$g-$h" inputs/pressurized_cylinder.yaml --coupling $coupling --set "domain.cell=$h" --set method.edge_penalty=$g
                edges_row "$coupling-$g-$h" "$coupling, gamma = $g, h = $h"
            done
        done
    done
    for g in stepped mpm ice-mpm; do
        bar "$g: eq. 13 at h = 0.025 with gamma = 0.05" "$(calc %g "100*$(edges_value "$g-0.05-0.025" eq13)")" '<=' 0.6 %.3f ' %'
    done
    write '' '## Bars' ''
    show_bars
    commands=('run inputs/annulus_traction.yaml --set time.solver=static --set domain.cell=H --set method.edge_penalty=GAMMA --set method.basis=BASIS'
        'run inputs/pressurized_cylinder.yaml --coupling COUPLING --set domain.cell=H --set method.edge_penalty=GAMMA')
    commands=("${commands[@]/#/floe }")
    finish
}
