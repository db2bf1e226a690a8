# bases: every basis with every transfer on manufactured solutions. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

bases_all=linear,gimp,cpdi,quadratic,cubic

# bases_study NAME TRANSFER DECK ARGUMENT...: the study of all bases with a transfer (flip1: flip 1, without the 1 % of pic that is usual;
# tpic-usf: tpic with stress usf); its rows go into bases-NAME.csv, with the transfer before them.
bases_study() {
    local short=$1 transfer=$2 deck=$3 set=(--set "method.transfer=${2%-*}")
    shift 3
    [ "$transfer" = flip1 ] && set=(--set method.transfer=flip --set method.flip=1)
    [ "$transfer" = "${transfer%-*}" ] || set+=(--set "method.stress=${transfer#*-}")
    local folder=$short-$transfer arguments=("$deck" "--bases=$bases_all" "${set[@]}" "$@" --set output.interval=null)
    note_command study "${arguments[@]}"
    echo "  ${commands[-1]}" >&2
    rm -rf "${runs:?}/$folder"
    "$floe" study "${arguments[@]}" --threads 1 --quiet -o "$runs/$folder" >"$runs/$folder.txt" 2>&1 || [ -f "$runs/$folder/study.csv" ] || {
        cat "$runs/$folder.txt" >&2
        return 1
    }
    awk -v t="$transfer" -v first="$([ -f "$results/bases-$short.csv" ] || echo 1)" 'NR == 1 { if (first) print "transfer," $0; next } { gsub(/"/, ""); print t "," $0 }' \
        "$runs/$folder/study.csv" >>"$results/bases-$short.csv"
}

bases_transfers=(flip1 flip pic xpic apic tpic)

bases_studies() {
    local transfer
    for transfer in "${bases_transfers[@]}"; do bases_study "$1" "$transfer" "${@:2}"; done
}

# bases_table FILE METRICS: a row a pair: the errors at each spacing, the fitted order with all of them, the largest drift of energy and the time of
# the finest.
bases_table() {
    local file=$results/$1
    awk -F, -v metrics="$2" '
        function number(v) { return v == "" || v ~ /nan|null/ ? "failed" : sprintf("%.1e", v) }
        function fitted(k, m,   i, X, Y, xx, xy, c) {
            c = count[k]; X = Y = xx = xy = 0
            for (i = 1; i <= c; i++) { if (!(error[k, m, i] > 0)) return "-"; X += log(h[k, i]) / c; Y += log(error[k, m, i]) / c }
            for (i = 1; i <= c; i++) { xx += (log(h[k, i]) - X) ^ 2; xy += (log(h[k, i]) - X) * (log(error[k, m, i]) - Y) }
            return xx > 0 ? sprintf("%.2f", xy / xx) : "-"
        }
        NR == 1 { for (i = 1; i <= NF; i++) { t = $i; sub(/ \(.*/, "", t); at[t] = i }
                  n = split(metrics, want, " ")
                  head = "| basis | transfer |"; rule = "|---|---|"
                  for (m = 1; m <= n; m++) { head = head " " want[m] " | order |"; rule = rule "---|---|" }
                  print head " energy | time |"; print rule "---|---|"; next }
        { k = $at["method.basis"] " | " $1; if (!(k in count)) order[++pairs] = k
          c = ++count[k]; h[k, c] = $at["h"]; time[k] = $at["run_seconds"]; energy[k] = $at["drift_energy"]; status[k] = $at["status"]
          for (m = 1; m <= n; m++) error[k, m, c] = $at["status"] == "done" ? $at[want[m]] : "" }
        END { for (p = 1; p <= pairs; p++) { k = order[p]; row = "| " k " |"
                for (m = 1; m <= n; m++) { for (c = 1; c <= count[k]; c++) row = row " " number(error[k, m, c]); row = row " | " fitted(k, m) " |" }
                print row " " number(energy[k]) " | " (status[k] == "done" ? sprintf("%.2g s", time[k]) : status[k]) " |" } }' "$file" |
        { IFS= read -r head; IFS= read -r rule; printf '%s\n%s\n' "$head" "$rule"; sort -s -t'|' -k2,2; } >>"$page"
    write ''
}

# bases_plot NAME METRIC LABEL: error against run time, a line a basis and transfer.
bases_plot() {
    local short=$1 file=$results/bases-$1.csv basis transfer error time colour=0 point
    error=$(column "$file" "$2") time=$(column "$file" run_seconds)
    {
        echo "set logscale xy; set format '%.0e'; set xlabel 'wall time (s)'; set ylabel '$3'; set key outside right"
        printf 'plot '
        for basis in ${bases_all//,/ }; do
            colour=$((colour + 1)) point=3
            for transfer in "${bases_transfers[@]}"; do
                point=$((point + 1))
                printf "'< grep \"^%s,.*,%s,\" %s' using %s:%s with linespoints lc %s pt %s title '%s %s', " "$transfer" "$basis" "$file" "$time" "$error" \
                    $colour $point "$basis" "$transfer"
            done
        done
        echo
    } | plot "$short" 980,620
    write "![error against run time](bases-$short.svg)" ''
}

# bases_finest FILE BASIS TRANSFER METRIC: the error of the finest mesh.
bases_finest() {
    local at
    at=$(column "$results/$1" "$4") || return
    awk -F, -v t="$3" -v at="$at" -v b="$2" '$1 == t && index($0, "," b ",") { e = $at } END { print e == "" ? "nan" : e }' "$results/$1"
}

# bases_spin: moment of momentum that a free, stiff disc loses over a tenth of a turn, as tests/verification/test_mpm_transfer.c measures it.
bases_spin() {
    write '## Moment of momentum' '' 'The share that a free, stiff disc loses over a tenth of a turn, by `tests/verification_mpm_transfer` (flip: 1, C_p counted).' '' \
        '| transfer | basis | lost |' '|---|---|---|'
    "$build/tests/verification_mpm_transfer" 2>/dev/null | awk '$3 == "loses" { printf "| %s | %s | %s |\n", $1, $2, $4 }' >>"$page"
    write ''
}

# bases_words: what the tables say.
bases_words() {
    write '## What it says' '' \
        '* **At small strain, points in their cells**, every basis but the linear one, which stalls, is second order in displacement and velocity, but under `pic` and `flip` (1.4 to 1.5 with' \
        '  GIMP and CPDI under `apic` and `tpic`, from errors a tenth of the others'"'"'). Stress is second order with splines, first with linear, GIMP and CPDI: their gradient' \
        '  is even in a cell, right to second order in its middle only, and is read at the points. That is space, not time; GIMP with points at quarters of a cell is the linear basis.' \
        '* **At large strain with 2 points a cell** neither GIMP nor splines converge. It is quadrature, in space: points that have spread over the mesh sum a node'"'"'s force with an error' \
        '  that goes with points a cell, not with h. A quarter of the step leaves two thirds of the quadratic splines'"'"' error; 4 points a cell leave a thirteenth, and cubic splines, smoother by' \
        '  a derivative and at a twentieth from the start, are then second order. GIMP gains little: its domains keep their width while the points part, and' \
        '  leave gaps. CPDI, the same with domains that follow, is second order with 2 points already (1.8 in stress).' \
        '* **pic** diffuses by about h^2 in each step, so that the error is first order in h, and larger with smaller steps. **flip** with its usual 1 % of that has 1.7 to 1.8 here.' \
        '* **apic and tpic** are best with every basis that converges: 2 to 27 times as exact as flip. Both keep what turns; APIC with splines to round-off. `pic` and `xpic` (of order 2) lose all' \
        '  turning of a disc of 6 cells within a tenth of a turn.' \
        '* **The ring** is 5 cells across on the coarsest mesh. CPDI with apic or tpic has the least error of displacement, quadratic splines with apic that of stress; the orders of stress there,' \
        '  1.1 to 1.4, start from small errors; faces that cut cells have their part.' \
        '* **The ring that turns by 5.6 radians, stretched to 3.1** at the height of it: CPDI with `apic` or `tpic` is best in velocity and stress and second order in place; GIMP with them has' \
        '  its places as exact there, not its velocities; splines are a factor of two behind, GIMP with flip and the linear basis do not converge or grow. `pic` keeps nothing of the motion, and `xpic` of order 2' \
        '  five times the error of `tpic`: take `filter_order: 4` or more where things turn (CPDI, h = 0.1: 0.16, 0.051 and 0.043 in place with 2, 4 and 8).' \
        '* **usl, musl** agree; **usf** has about the same displacement, and as stress that of the step'"'"'s start: first order when read at its end.' \
        '* **What would be first order in time otherwise**: solids take the gradient of velocity at the middle of the step ([theory](../theory/README.md)); before, cubic splines with 4 points had 7e-5 m' \
        '  at h = 1/128 and halved with h, for 5e-6 m now.' \
        '* **The drift of energy** is first order in the step: velocities live half a step behind places, and the work of the force is counted between.' '' \
        'So: `method: {basis: cpdi, transfer: tpic}` where solids strain or turn much; quadratic splines with `tpic` or `apic` at small strain. floe'"'"'s default stays quadratic splines with' \
        '`flip` (0.99), since gas as points, contact and membranes were measured with it; it is not the best of these tables.' ''
}

result_bases() {
    begin bases 'Bases and transfers on manufactured solutions'
    local scheme small='l1_displacement_x l1_velocity_x l1_stress_xx' cells=domain.cell=0.0625,0.03125,0.015625
    bases_studies small inputs/bar_mms.yaml --axis $cells --set verify.exact.bar_mms.amplitude=0.001
    bases_studies large inputs/bar_mms.yaml --axis $cells
    bases_studies many inputs/bar_mms.yaml --axis $cells --set bodies.bar.points=4
    for scheme in usf musl; do bases_study many tpic-$scheme inputs/bar_mms.yaml --axis $cells --set bodies.bar.points=4; done
    bases_study steps tpic inputs/bar_mms.yaml --axis time.cfl=0.4,0.2,0.1 --set domain.cell=0.015625
    bases_studies ring inputs/ring_mms.yaml --axis domain.cell=0.1,0.05,0.025
    bases_studies turns inputs/ring_mms.yaml --axis domain.cell=0.1,0.06 --set verify.exact.ring_mms.spin=4 --set verify.exact.ring_mms.amplitude=0.4 \
        --set verify.exact.ring_mms.frequency=0.5 --set time.end=1.4
    write 'Each basis with each transfer, under a force that holds points to a motion that is known exactly: L1, by volume, of displacement, velocity and' \
        'stress at three spacings, coarse first, and the order fitted to the three. *energy* is its drift in the ledger on the finest mesh, *time* that of its steps, in one run beside whatever else the machine did. `flip1` is' \
        'FLIP alone, `flip` the default with one per cent of PIC. A dash: a run of the three did not come to its end.' ''
    bar 'bar, strain 0.3 %, 2 points a cell, h = 1/64: quadratic tpic, L1 of stress (Pa, of 2000)' "$(bases_finest bases-small.csv quadratic tpic l1_stress_xx)" '<=' 1 %.2g
    bar 'bar, strain 31 %, 2 points a cell, h = 1/64: cpdi tpic, L1 of displacement (m)' "$(bases_finest bases-large.csv cpdi tpic l1_displacement_x)" '<=' 1e-5 %.2g
    bar 'bar, strain 31 %, 4 points a cell, h = 1/64: cubic tpic, L1 of displacement (m)' "$(bases_finest bases-many.csv cubic tpic l1_displacement_x)" '<=' 2e-5 %.2g
    bar 'ring, h = 1/40: cubic tpic, L1 of displacement' "$(bases_finest bases-ring.csv cubic tpic l1_displacement_x)" '<=' 1e-3 %.2g
    write '## Bars' ''
    show_bars
    write ''
    bases_words
    write '## A bar at a strain of 0.3 %, 2 points a cell' '' 'h = 1/16, 1/32, 1/64. No point leaves its cell, so that the order is that of the basis.' ''
    bases_table bases-small.csv "$small"
    write '## The bar at a strain of 31 %, 2 points a cell' '' 'Points cross 1.6 cells of the coarsest mesh and 6.4 of the finest.' ''
    bases_table bases-large.csv "$small"
    bases_plot large l1_displacement_x 'L1 of displacement (m)'
    write '## The same with 4 points a cell' ''
    bases_table bases-many.csv "$small"
    write '## Steps, 2 points a cell, h = 1/64' '' 'A CFL number of 0.4, 0.2 and 0.1.' ''
    bases_table bases-steps.csv "$small"
    write '## The ring, a shear of 1.4, 3 x 3 points a cell' '' 'h = 1/10, 1/20, 1/40.' ''
    bases_table bases-ring.csv "$small"
    bases_plot ring l1_displacement_x 'L1 of displacement'
    write '## The ring turned by 5.6 radians, a shear of 2.8' '' 'All of it spins at 4 radians a second while its layers turn by up to 0.4 radians more: principal stretches of 3.1 and 0.32 at t = 1, errors at t = 1.4.' \
        'h = 0.1 and 0.06, with 3 x 3 points a cell.' ''
    bases_table bases-turns.csv "$small"
    bases_spin
    finish
}
