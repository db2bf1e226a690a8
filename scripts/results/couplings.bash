# couplings: the same decks by points, by cells and by both: error against run time, and which coupling wins where. Sourced by
# scripts/results.sh, with airbag.bash and shocks.bash, whose figures and variants of decks it takes.
# COUPLINGS_AIRBAG: meshes of the airbags, 0.02,0.01 unless it says otherwise (0.006666666666666667 takes eight minutes more).
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# A row's variant: its coupling, or the values of a study's axes in front of the mesh. %: metrics that are shares.
couplings_awk='function variant(   i, v, name) {
        for (i = 2; i < cell; i++) { name = head[i]; sub(/.*\./, "", name); v = v (v == "" ? "" : ", ") (name == "title" ? "" : name "=") $i }
        return v == "" ? $1 : v }
    function is_share(m) { return m ~ /^(l1rel_|hlate_|hperiod_|hturns_|eq13$|energy$)/ }
    function figure(e, m) { return e == "" ? "-" : is_share(m) ? sprintf("%.3g %%", 100 * e) : sprintf("%.3g", e) }
    function columns(   i, t) { for (i = 1; i <= NF; i++) { t = $i; sub(/ \(.*/, "", t); head[i] = t; at[t] = i }
        cell = "domain.cell" in at ? at["domain.cell"] : 2 }'

# couplings_load: how busy the machine is: its load over the last minute.
couplings_load() {
    cut -d' ' -f1 /proc/loadavg 2>/dev/null || echo unknown
}

# couplings_flat FILE: a CSV without quotes, and without the commas in them.
couplings_flat() {
    awk -F'"' -v OFS='' '{ for (i = 2; i <= NF; i += 2) gsub(/,/, "", $i); $1 = $1; print }' "$1"
}

# couplings_table METRIC,...: the cases of $csv.
couplings_table() {
    couplings_flat "$csv" | awk -F, -v metrics="$1" "$couplings_awk"'
        BEGIN { n = split(metrics, m, ",") }
        NR == 1 { columns(); line = "| coupling | h |"; rule = "|---|---|"
            for (i = 1; i <= n; i++) { line = line " `" m[i] "` |"; rule = rule "---|" }
            print line " run time, s |"; print rule "---|"; next }
        { line = "| " variant() " | " sprintf("%g", $at["h"]) " |"
          for (i = 1; i <= n; i++) line = line " " figure($at[m[i]], m[i]) " |"
          printf "%s %.3g |\n", line, $at["run_seconds"] }' >>"$page"
    write
}

# couplings_smallest METRIC: the smallest error of each variant of $csv, with its mesh and time.
couplings_smallest() {
    couplings_flat "$csv" | awk -F, -v m="$1" "$couplings_awk"'
        NR == 1 { columns(); next }
        $at[m] != "" { v = variant(); if (!(v in least)) { order[++n] = v; least[v] = $at[m] + 1 }
            if ($at[m] < least[v]) { least[v] = $at[m]; said[v] = v " " figure($at[m], m) " (h = " sprintf("%g, %.3g s)", $at["h"], $at["run_seconds"]) } }
        END { for (i = 1; i <= n; i++) printf "%s%s", (i > 1 ? "; " : ""), said[order[i]] }'
}

# couplings_soonest METRIC: "for ERROR in METRIC choose ...", as floe says it, of cases that floe does not put side by side: for what every variant
# reaches, and for what only the best does.
couplings_soonest() {
    couplings_flat "$csv" | awk -F, -v m="$1" "$couplings_awk"'
        function above(e,   p) { p = 10 ^ int(log(e) / log(10) - 1)
            while (1) { if (p >= e) return p; if (2 * p >= e) return 2 * p; if (5 * p >= e) return 5 * p; p *= 10 } }
        function say(goal,   i, v, best, next_best, t) { for (i = 1; i <= n; i++) { v = order[i]; t[v] = -1 }
            for (i = 1; i <= rows; i++) if (error[i] <= goal && (t[name[i]] < 0 || time[i] < t[name[i]])) t[name[i]] = time[i]
            best = next_best = ""
            for (i = 1; i <= n; i++) { v = order[i]; if (t[v] < 0) continue
                if (best == "" || t[v] < t[best]) { next_best = best; best = v } else if (next_best == "" || t[v] < t[next_best]) next_best = v }
            printf "for %s in %s choose %s, %.3g s; %s\n", figure(goal, m), m, best, t[best],
                next_best == "" ? "no other variant reaches it" : sprintf("the next best, %s, needs %.3g s", next_best, t[next_best]) }
        NR == 1 { columns(); next }
        $at[m] != "" { v = variant(); if (!(v in least)) { order[++n] = v; least[v] = $at[m] }
            if ($at[m] < least[v]) least[v] = $at[m]
            rows++; name[rows] = v; error[rows] = $at[m]; time[rows] = $at["run_seconds"] }
        END { if (!n) exit
              low = high = least[order[1]]
              for (i = 2; i <= n; i++) { if (least[order[i]] < low) low = least[order[i]]; if (least[order[i]] > high) high = least[order[i]] }
              if (above(high) > above(low)) say(above(high))
              say(above(low)) }'
}

# couplings_sentences ROW HEADING METRIC SENTENCES: them as a list; the last is the verdict of the last section.
couplings_sentences() {
    local verdict
    sed 's/$/./; s/^f/F/; s/^n/N/; s/^/* /' <<<"$4" >>"$page"
    verdict=$(grep '^for' <<<"$4" | tail -n 1 | sed -E 's/^for (.*) in [^ ]* choose ([^;]*), ([^,;]*); (.*)$/**\2** (\1 in \3; \4)/')
    winners+=("| $1 | $2 | \`$3\` | $(couplings_smallest "$3") | $verdict |")
}

# couplings_scene SHORT ROW HEADING METRIC,... DECK ARGUMENT...: compares the couplings of a deck, or studies it where an argument says "title=":
# a table, floe's plot and its sentences.
couplings_scene() {
    local short=$1 row=$2 heading=$3 metrics=$4 deck=$5 metric said
    shift 5
    if [[ $* == *title=* ]]; then floe_command study study.csv "$short" "$deck" "$@"; else floe_compare "$short" "$deck" "$@"; fi
    write "## $heading" '' "Row $row; \`$deck\`." ''
    couplings_table "$metrics"
    for metric in ${metrics//,/ }; do
        said=$(grep -E "^(for|no variant) .*in $metric( |:)" "$runs/$short.txt" || couplings_soonest "$metric")
        couplings_sentences "$row" "$heading" "$metric" "$said"
    done
    write
    if [ -f "$runs/$short/errors.svg" ] && [[ $plots == *" $short "* ]]; then
        cp "$runs/$short/errors.svg" "$results/couplings-$short.svg"
        write "![error against spacing and run time](couplings-$short.svg)" ''
    fi
    folders+=("$runs/$short")
}

# couplings_riemann SHORT ROW HEADING N: the N-th variant of inputs/riemann.yaml, as points too.
couplings_riemann() {
    local overrides
    shocks_variant riemann "$4"
    [ "$1" = fans ] || overrides+=(--set 'boundaries={x: slip}')
    couplings_scene "$1" "$2" "$3" l1_density inputs/riemann.yaml "${overrides[@]}" --set 'runs_as=[ice, mpm]' --set bodies.tube.points=9 \
        --set 'materials.gas.artificial_viscosity={linear: 0.2, quadratic: 2}' --axis domain.cell=0.01,0.005,0.0025 --repeat 3
}

couplings_tubes() {
    couplings_scene sod 'B1, D1' "Sod's shock tube" l1_density inputs/sod.yaml --repeat 3
    couplings_riemann fans D1 '"123": two fans, nearly a vacuum between them' 1
    couplings_riemann left-blast D1 'The left blast, pressures 1e5 apart' 2
    couplings_riemann right-blast D1 'The right blast, pressures 1e4 apart' 5
    write 'Row D1 has two more for cells alone, Lax'"'"'s problem and two shocks that collide ([shocks](shocks.md)): gas flows in through a side there, which points do not do.' ''
}

# couplings_period MASS: the exact period of York's piston, from m w^2 = K + rho w c A cot(w L/c) (Y00, 4.2).
couplings_period() {
    awk -v m="$1" 'BEGIN { K = 100; rho = 1e-4; c = sqrt(1.58e6 / rho); L = 20; pi = atan2(0, -1); lo = 1e-6; hi = pi * c / L * (1 - 1e-9)
        for (i = 0; i < 200; i++) { w = (lo + hi) / 2; x = w * L / c; if (m * w * w - K - rho * w * c * cos(x) / sin(x) < 0) lo = w; else hi = w }
        printf "%.7f", 2 * pi / w }'
}

# The pistons are two decks, as the fluid needs a membrane to hold it on cells.
couplings_pistons() {
    local m kind all
    local -a heavy_points=(--set bodies.spring.membrane.heavy_mass=1 --set verify.reference.piston.mass=1 --set time.end=0.067)
    local -a heavy_cells=(--set materials.sheet.density=100 --set verify.reference.piston.mass=1 --set time.end=0.067)
    write '## Piston on a container of fluid' '' "Row A2; \`inputs/piston_container.yaml\` (mpm) and \`inputs/piston_membrane.yaml\` (ice-mpm), as the fluid needs a membrane to hold it on" \
        "cells. Exact periods: $(couplings_period 0.1) s with a mass of 0.1, $(couplings_period 1) s with 1, on a spring without mass; that of the points weighs 1e-6, and their errors are against the period with it." ''
    for m in 0.1 1; do
        local -a points=() cells=()
        [ $m = 1 ] && points=("${heavy_points[@]}") cells=("${heavy_cells[@]}")
        floe_compare "piston-points-$m" inputs/piston_container.yaml "${points[@]}" --axis domain.cell=4,2,1 --repeat 1
        folders+=("$runs/piston-points-$m")
        floe_compare "piston-cells-$m" inputs/piston_membrane.yaml "${cells[@]}" --axis 'domain.cell=[4, 1],[2, 1],[1, 1]'
        folders+=("$runs/piston-cells-$m")
        all=$runs/piston-$m.csv
        for kind in points cells; do
            couplings_flat "$runs/piston-$kind-$m/compare.csv" | awk -v first=$kind 'NR > 1 || first == "points"'
        done >"$all"
        csv=$all
        write "Mass $m:" ''
        couplings_table hperiod_position,hturns_position
        for kind in hperiod_position hturns_position; do couplings_sentences A2 "Piston, mass $m" $kind "$(couplings_soonest $kind)"; done
        write
    done
}

# couplings_probe FILE: of a history: when the probe turns, and when it is back where it began, ms; the most gas beyond the bag, as a share.
couplings_probe() {
    local name columns=()
    for name in time centre_probe_z velocity_probe_z outside_bag mass_gas; do columns+=("$(column "$1" $name)"); done
    awk -F, -v c="${columns[*]}" 'BEGIN { split(c, at, " ") }
        NR == 1 { next }
        { t = 1000 * $at[1]; z = $at[2]; v = $at[3]; if ($at[5] > 0 && $at[4] / $at[5] > out) out = $at[4] / $at[5] }
        NR == 2 { z0 = z }
        NR > 2 && turn == "" && v >= 0 { turn = sprintf("%.2f", last_t + (t - last_t) * last_v / (last_v - v)) }
        turn != "" && back == "" && z >= z0 { back = sprintf("%.1f", last_t + (t - last_t) * (z0 - last_z) / (z - last_z)) }
        { last_t = t; last_z = z; last_v = v }
        END { printf "%s %s %.1e\n", turn == "" ? "-" : turn, back == "" ? "-" : back, out }' "$1"
}

# couplings_airbag PROBE END: a bag that is hit, which no exact solution knows: what one can measure of it, each coupling beside the other.
couplings_airbag() {
    local probe=$1 coupling h seconds folder out f g
    floe_compare "airbag-$probe" "inputs/airbag_$probe.yaml" --set time.end="$2" --axis domain.cell="${COUPLINGS_AIRBAG:-0.02,0.01}"
    folders+=("$runs/airbag-$probe")
    out=$runs/airbag-$probe.csv
    echo 'coupling,domain.cell,h,depth,turn,back,energy,leak,run_seconds' >"$out"
    while IFS=, read -r coupling h seconds folder; do
        folder=$runs/airbag-$probe/$folder
        read -r -a f <<<"$(airbag_figures "$folder/history.csv")"
        read -r -a g <<<"$(couplings_probe "$folder/history.csv")"
        write "| $probe mm | $coupling | $(calc %.2f "1000*$h") | $(calc %.3g "$seconds") | **${f[0]}** | ${g[0]} | ${g[1]} | ${f[5]} J, $(calc %.2g "${f[4]}") % | ${g[2]} |"
        echo "$coupling,$h,$h,${f[0]},${g[0]},${g[1]},$(calc %.6g "${f[4]#-} / 100"),${g[2]},$seconds" >>"$out"
    done < <(couplings_flat "$csv" | awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) { t = $i; sub(/ \(.*/, "", t); at[t] = i } next }
        { printf "%s,%s,%s,%s\n", $1, $at["domain.cell"], $at["run_seconds"], $at["directory"] }')
}

# couplings_airbag_says PROBE: what the finest meshes say of each other.
couplings_airbag_says() {
    awk -F, -v probe="$1" 'NR > 1 { if (!($1 in last)) order[++n] = $1; before[$1] = last[$1]; last[$1] = $4; h[$1] = 1000 * $3; when[$1] = $5; back[$1] = $6; time[$1] = $9 }
        function size(x) { return x < 0 ? -x : x }
        END { a = order[1]; b = order[2]; d = last[b] - last[a]; fast = time[b] < time[a] ? b : a; slow = fast == a ? b : a
              printf "* %s mm: at h = %.3g mm the depths are %.1f mm (%s) and %.1f mm (%s), %.1f %% apart, and the times of rebound %.1f ms apart; from the mesh before they have changed by %.1f and %.1f mm. %s is done in %.2g of the time of %s.\n",
                  probe, h[a], last[a], a, last[b], b, 100 * size(d) / last[a], size(when[b] - when[a]), last[a] - before[a], last[b] - before[b],
                  fast, time[fast] / time[slow], slow }' \
        "$runs/airbag-$1.csv" >>"$page"
}

couplings_airbags() {
    local probe
    write '## Airbag hit by a cylinder' '' 'Row A6; `inputs/airbag_200.yaml`, `inputs/airbag_500.yaml`, as printed, until the probe is about back where it began (120 and 100 ms; -: not yet). There is no exact solution: the errors are' \
        'what the budget of energy misses, at most (`energy`, a share of all of it), and what of the gas is beyond the bag, at most. More of them: [airbag](airbag.md).' '' \
        '| probe | coupling | h, mm | run time, s | greatest depth, mm | rebound begins at, ms | back at, ms | energy that the budget misses | gas beyond the bag, share |' \
        '|---|---|---|---|---|---|---|---|---|'
    couplings_airbag 200 0.12
    couplings_airbag 500 0.1
    write
    for probe in 200 500; do
        csv=$runs/airbag-$probe.csv
        couplings_airbag_says $probe
        couplings_sentences A6 "Airbag hit by a cylinder of $probe mm" energy "$(couplings_soonest energy)"
    done
    write
}

result_couplings() {
    local folders=() winners=() normals=bodies.skin.membrane.normals plots=' sod expansion cylinder dogbone circle isosurface ' busy
    busy=$(couplings_load)
    begin couplings 'One deck, each coupling: error against run time'
    write 'Fluids as material points (`mpm`), on the cells (`ice`), or on the cells beside solids and membranes of points (`ice-mpm`): the same deck each time, one' \
        'thread. Run times are without those of outputs. Errors are those of the decks'"'"' metrics. `floe report` makes one page of all of them (last section), with pictures and budgets.' \
        'Which wins where is the last section but one.' ''
    couplings_tubes
    couplings_scene expansion B2 'Cylinder of gas expanding into a vacuum' l1rel_density inputs/gas_expansion.yaml --set 'verify.metrics=[l1rel_density]'
    couplings_scene cylinder A1 'Pressurised thick cylinder' eq13,l1_sigma_theta inputs/pressurized_cylinder.yaml --set study=null \
        --axis 'title=mpm,ice-mpm,ice-mpm sharp;coupling=mpm,ice-mpm,ice-mpm;method.interface=smeared,smeared,sharp' \
        --axis method.edge_penalty=0,0.05 --axis domain.cell=0.1,0.05,0.025
    couplings_pistons
    local bone='domain.cell=0.4,0.2;bodies.skin.membrane.number=56,100'
    couplings_scene dogbone A3 'Dog-bone membrane filled with gas' hlate_radius,hlate_pressure inputs/membrane_dogbone.yaml --axis "$bone"
    couplings_scene circle A4 'Slack circular membrane filled with gas' hlate_radius,hlate_pressure inputs/membrane_circle.yaml --axis domain.cell=0.1,0.05
    couplings_scene isosurface A5 'Dog-bone with normals to unconnected points: isosurface' hlate_radius,hlate_pressure inputs/membrane_dogbone.yaml \
        --set $normals=isosurface --set 'domain.upper=[2, 2]' --axis "$bone"
    couplings_scene quadric A5 'Dog-bone with normals to unconnected points: quadric' hlate_radius,hlate_pressure inputs/membrane_dogbone.yaml \
        --set $normals=quadric --set 'domain.upper=[2, 2]' --axis "domain.cell=0.4;bodies.skin.membrane.number=56"
    couplings_airbags
    write '## Which wins where' '' 'The choice is the fastest to the smallest error asked for.' '' '| row | scene | error | smallest of each | choose |' '|---|---|---|---|---|' "${winners[@]}" ''
    "$floe" report "${folders[@]}" --title 'One deck, each coupling' -o "$runs/couplings.html" --quiet
    commands+=("floe report ${folders[*]#"$runs"/} -o couplings.html")
    finish
    write '' "The load of the machine was $busy before the first run and $(couplings_load) after the last; where that is more than its cores, run times are too long."
    write '' 'All of them on one page, with pictures, profiles and budgets: `out/results/couplings/couplings.html`, which the last command makes.'
}
