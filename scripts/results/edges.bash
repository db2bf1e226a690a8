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
    write "$(printf '| %s | %.3f | %.3f | %.3f | %d | %.2g |' "$2" "$(calc %g "100*$(edges_value "$1" eq13)")" \
        "$(calc %g "100*$(edges_value "$1" l1_sigma_r)/19.4e6")" "$(calc %g "100*$(edges_value "$1" l1_sigma_theta)/19.4e6")" \
        "$(edges_value "$1" steps)" "$(edges_value "$1" wall_seconds)")"
}

# edges_slope FOLDER...: order in h of eq. 13 over runs at spacings that halve, by least squares.
edges_slope() {
    for f in "$@"; do edges_value "$f" eq13; done |
        awk '{ y[NR] = log($1) } END { for (i = 1; i <= NR; i++) { x = (NR + 1) / 2 - i; s += x * y[i]; t += x * x } printf "%.2f", s / t / log(2) }'
}

edges_table() {
    write '' "| $1 | eq. 13, % | L1 sigma_r, % of P | L1 sigma_theta, % of P | steps | wall time, s |" '|---|---|---|---|---|---|'
}

# edges_static NAME LABEL SETTING...: the cylinder in static balance at every spacing; orders are left in $slope.
edges_static() {
    local name=$1 label=$2 h of=()
    shift 2
    for h in ${edges_cells//,/ }; do
        floe_run "$name-$h" $edges_deck --set time.solver=static --set "domain.cell=$h" "$@"
        edges_row "$name-$h" "$label, h = $h"
        of+=("$name-$h")
    done
    slope=$(edges_slope "${of[@]}")
    slopes+=("* $label: order $slope in h.")
}

result_edges() {
    local g h slope slopes=() worst=0
    begin edges 'Edges of solids: stress beside a surface that cuts the mesh'
    write 'The thick cylinder of [a1](a1.md) under a traction on its bore, so that the error is that of the solid alone, against Lamé; quadratic' \
        'splines, 2 x 2 points a cell, fitted. No point is left out, no stress smoothed. `method.edge_penalty` is gamma.' '' \
        '## In static balance (`time.solver: static`)'
    edges_table 'gamma, spacing (m)'
    for g in 0 0.02 0.05 0.1; do
        edges_static "static-$g" "gamma = $g" --set method.edge_penalty=$g
        [ $g = 0.05 ] && bar 'static: order of eq. 13 in h with gamma = 0.05' "$slope" '>=' 1.7 %.2f
    done
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
    finish
}
