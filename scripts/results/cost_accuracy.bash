# cost_accuracy: error against wall time of every variant beside the linear-basis baseline: A1 in one figure, and rows A2, A3, A4, B5, B10. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# The variants of a row are one axis: the title's values name them, what goes with it makes them. The first one is the baseline.

# gains_plain: a study's CSV without quotes, commas inside them as blanks.
cost_accuracy_plain() {
    awk '{ out = ""; q = 0
        for (i = 1; i <= length($0); i++) { c = substr($0, i, 1); if (c == "\"") q = !q; else out = out (q && c == "," ? " " : c) }
        print out }'
}

# gains_rows METRIC... <FILE: "variant|h|error|seconds" of all cases that came to their end, variants in their order, coarse to fine; the error is the largest of the
# metrics, all of which must be there.
cost_accuracy_rows() {
    gains_plain | awk -F, -v metrics="$*" 'NR == 1 { n = split(metrics, m, " ")
            for (i = 1; i <= NF; i++) { t = $i; sub(/ \(.*/, "", t); if (!(t in at)) at[t] = i } next }
        $at["status"] == "done" || $at["status"] == "at_rest" { e = 0
            for (k = 1; k <= n && e >= 0; k++) { x = $at[m[k]]; if (x !~ /^[0-9]/) e = -1; else if (x + 0 > e) e = x + 0 }
            if (e > 0) printf "%s|%.7g|%.9g|%.6g\n", $at["title"], $at["h"], e, $at["run_seconds"] }' | awk -F'|' '
        { if (!($1 in seen)) { seen[$1] = ++n; name[n] = $1 } line[NR] = $0; of[NR] = seen[$1]; h[NR] = $2 }
        END { for (v = 1; v <= n; v++) { for (;;) { best = 0
            for (i = 1; i <= NR; i++) if (of[i] == v && !done[i] && (!best || h[i] + 0 > h[best] + 0)) best = i
            if (!best) break
            done[best] = 1; print line[best] } } }'
}

# gains_show ROWS SCALE UNIT: the rows as a table, and those that did not come to an end are not there.
cost_accuracy_show() {
    write '' "| variant | h | error$3 | run time, s |" '|---|---|---|---|'
    awk -F'|' -v scale="$2" '{ printf "| %s | %s | %.3g | %.2g |\n", $1, $2, scale * $3, $4 }' <<<"$1" >>"$page"
}

# gains_factors ROWS: "h|seconds|error|variant|its h|its seconds|its error|factor" for each case of the baseline, the first variant: the smallest error that any
# other variant has reached in no more time. No line where none is as fast.
cost_accuracy_factors() {
    awk -F'|' '{ v[NR] = $1; h[NR] = $2; e[NR] = $3; t[NR] = $4 }
        END { for (i = 1; i <= NR && v[i] == v[1]; i++) { best = 0
            for (j = 1; j <= NR; j++) if (v[j] != v[1] && t[j] <= t[i] && (!best || e[j] < e[best])) best = j
            if (best) printf "%s|%s|%s|%s|%s|%s|%s|%.4g\n", h[i], t[i], e[i], v[best], h[best], t[best], e[best], e[i] / e[best] } }' <<<"$1"
}

# gains_row WHAT SCALE UNIT METRIC...: table, factors and bar of the study in $csv. The bar is for the baseline's dearest case that another variant can be compared with.
cost_accuracy_row() {
    local what=$1 scale=$2 unit=$3 rows factors factor
    shift 3
    rows=$(cost_accuracy_rows "$@" <"$csv")
    gains_show "$rows" "$scale" "$unit"
    factors=$(cost_accuracy_factors "$rows")
    write '' 'The smallest error that another variant reaches in no more time than a case of the baseline takes:' '' \
        "| baseline at h | in, s | error$unit | variant | its h | in, s | error$unit | factor |" '|---|---|---|---|---|---|---|---|'
    awk -F'|' -v scale="$scale" 'NF { printf "| %s | %.2g | %.3g | %s | %s | %.2g | %.3g | **%.3g** |\n", $1, $2, scale * $3, $4, $5, $6, scale * $7, $8 }' <<<"$factors" >>"$page"
    factor=$(tail -n 1 <<<"$factors" | cut -d'|' -f8)
    bar "$what: error at equal time, baseline over best" "${factor:-nan}" '>=' 5 %.3g
}

# gains_study FOLDER REPEAT DECK ARGUMENT...: one study.
cost_accuracy_study() {
    local folder=$1 repeat=$2
    shift 2
    floe_command study study.csv "$folder" "$@" --repeat "$repeat"
}

# ---- A1 ----

cost_accuracy_a1_deck=inputs/pressurized_cylinder.yaml

# gains_a1 FOLDER CELLS VARIANT...: VARIANT is "title|coupling|basis|seeding|edge_penalty|interface|solver".
cost_accuracy_a1() {
    local folder=$1 cells=$2 v title coupling basis seeding edge interface solver
    shift 2
    local -a a=() b=() c=() d=() e=() f=() g=()
    for v in "$@"; do
        IFS='|' read -r title coupling basis seeding edge interface solver <<<"$v"
        a+=("$title") b+=("$coupling") c+=("$basis") d+=("$seeding") e+=("$edge") f+=("$interface") g+=("$solver")
    done
    local IFS=,
    gains_study "$folder" 1 $cost_accuracy_a1_deck --set study=null --set output.interval=0.01 \
        --axis "title=${a[*]};coupling=${b[*]};method.basis=${c[*]};bodies.cylinder.seeding=${d[*]};bodies.bore.seeding=${d[*]};method.edge_penalty=${e[*]};method.interface=${f[*]};time.solver=${g[*]}" \
        --axis "domain.cell=$cells" --max-wall 300
}

# gains_least ROWS PREFIX ERROR: the least time in which a variant whose name begins so has come to the error.
cost_accuracy_least() {
    awk -F'|' -v p="$2 " -v e="$3" 'index($1, p) == 1 && $3 <= e && (best == "" || $4 < best) { best = $4 } END { print best == "" ? "nan" : best }' <<<"$1"
}

cost_accuracy_plot() {
    local rows=$1 n=0 list='' coupling v
    awk -F'|' '$1 != last { if (NR > 1) print "\n"; last = $1 } { print $4, 100 * $3 }' <<<"$rows" >"$runs/a1.dat"
    while read -r v; do
        case $v in mpm*) coupling="lc rgb mpm" ;; *) coupling="lc rgb ice" ;; esac
        case $v in *lattice) coupling+=" lw 3 dt 2" ;; *static) coupling+=" lw 2" ;; *) coupling+=" lw 1" ;; esac
        list+="${list:+, }'$runs/a1.dat' index $n using 1:2 with linespoints pt $((n % 15 + 1)) $coupling title '$v'"
        n=$((n + 1))
    done < <(awk -F'|' '$1 != last { print $1; last = $1 }' <<<"$rows")
    plot a1 900,640 <<GNU
set datafile separator whitespace
set logscale xy
set xlabel 'run time on one core (s)'
set ylabel 'error of eq. 13 (%)'
set key outside right top font ',11'
plot $list
GNU
}

cost_accuracy_a1_page() {
    local rows coupling t cells=${GAINS_CELLS:-0.1,0.05,0.025} fine=${GAINS_FINE:-0.0125,0.00625}
    gains_a1 a1 "$cells" \
        'mpm linear lattice|mpm|linear|lattice|0|smeared|dynamic' 'mpm linear|mpm|linear|fitted|0|smeared|dynamic' \
        'mpm gimp|mpm|gimp|fitted|0|smeared|dynamic' 'mpm cpdi|mpm|cpdi|fitted|0|smeared|dynamic' \
        'mpm quadratic|mpm|quadratic|fitted|0|smeared|dynamic' 'mpm cubic|mpm|cubic|fitted|0|smeared|dynamic' \
        'mpm quadratic edge|mpm|quadratic|fitted|0.05|smeared|dynamic' 'mpm quadratic edge static|mpm|quadratic|fitted|0.05|smeared|static' \
        'ice-mpm linear lattice|ice-mpm|linear|lattice|0|smeared|dynamic' 'ice-mpm linear|ice-mpm|linear|fitted|0|smeared|dynamic' \
        'ice-mpm gimp|ice-mpm|gimp|fitted|0|smeared|dynamic' 'ice-mpm cpdi|ice-mpm|cpdi|fitted|0|smeared|dynamic' \
        'ice-mpm quadratic|ice-mpm|quadratic|fitted|0|smeared|dynamic' 'ice-mpm cubic|ice-mpm|cubic|fitted|0|smeared|dynamic' \
        'ice-mpm quadratic edge|ice-mpm|quadratic|fitted|0.05|smeared|dynamic' 'ice-mpm quadratic edge sharp|ice-mpm|quadratic|fitted|0.05|sharp|dynamic' \
        'ice-mpm quadratic edge static|ice-mpm|quadratic|fitted|0.05|smeared|static' 'ice-mpm quadratic edge sharp static|ice-mpm|quadratic|fitted|0.05|sharp|static'
    cp "$csv" "$results/cost_accuracy-a1.csv"
    rows=$(cost_accuracy_rows eq13 <"$csv")
    gains_a1 a1-fine "$fine" 'mpm quadratic edge static|mpm|quadratic|fitted|0.05|smeared|static' \
        'ice-mpm quadratic edge static|ice-mpm|quadratic|fitted|0.05|smeared|static' 'ice-mpm quadratic edge sharp static|ice-mpm|quadratic|fitted|0.05|sharp|static'
    rows=$(cost_accuracy_merge "$rows" "$(cost_accuracy_rows eq13 <"$csv")")
    write '## The pressurised cylinder (A1)' '' '`inputs/pressurized_cylinder.yaml`, both couplings, all variants in one study: eq. 13 against run time. *Lattice* is the baseline, the settings of the paper: linear' \
        'functions, whole sub-cells, a smeared load. Lamé is a solution for small strains: 0.03 to 0.05 % is no error of a run. *Edge*: `edge_penalty: 0.05`; *sharp*: `interface: sharp`; *static*: `solver: static`, here to finer meshes, too.' '' \
        '![error of eq. 13 against run time](cost_accuracy-a1.svg)'
    gains_plot "$rows"
    gains_show "$rows" 100 ', %'
    for coupling in mpm ice-mpm; do
        bar "A1, $coupling: eq. 13 within 1 % after" "$(cost_accuracy_least "$rows" $coupling 0.01)" '<=' 1 %.2g ' s'
        bar "A1, $coupling: eq. 13 within 0.1 % after" "$(cost_accuracy_least "$rows" $coupling 0.001)" '<=' 20 %.2g ' s'
        t=$(grep "^$coupling " <<<"$rows")
        gains_a1_factor "$coupling" "$t"
    done
}

# gains_merge ROWS ROWS: the second's cases behind those of the same variant.
cost_accuracy_merge() {
    local v
    while read -r v; do grep -hF "$v|" <<<"$1"$'\n'"$2" | awk -F'|' -v v="$v" '$1 == v'; done < <(awk -F'|' '$1 != last { print $1; last = $1 }' <<<"$1")
}

# gains_a1_factor COUPLING ROWS: how far below the baseline's dearest case.
cost_accuracy_a1_factor() {
    local h t e v its_h its_t its_e factor
    IFS='|' read -r h t e v its_h its_t its_e factor < <(cost_accuracy_factors "$2" | tail -n 1)
    write '' "By \`$1\`, in the time of the baseline at h = $h ($(printf %.2g "${t:-nan}") s, $(calc %.3g "100*${e:-0}") %): $v, h = $its_h, $(calc %.3g "100*${its_e:-0}") %: **$(printf %.3g "${factor:-nan}")** times less."
}

# ---- the rows ----

cost_accuracy_piston() {
    local m end
    write '' '## Piston on a container of fluid (A2)' '' '`inputs/piston_container.yaml`, error of the period; two masses. Baseline: linear functions, one fluid point a cell, as printed. *Gimp* and *quadratic* have the same points;' \
        '*sharp* is `inputs/piston_membrane.yaml`, fluid on cells up to a sheet that cuts them, in steps of `cfl: 0.5`. The light piston'"'"'s errors are near those of reading crossings of zero off the history' \
        '(1e-5 of the period); with the smooth bases they change their sign near h = 1, while those of *sharp* fall with the square of h.'
    for m in 0.1 1; do
        end=$([ $m = 1 ] && echo 0.067 || echo 0.0213)
        gains_study "a2-$m" 1 inputs/piston_container.yaml --set bodies.spring.membrane.heavy_mass=$m --set verify.reference.piston.mass=$m --set time.end="$end" --set output.interval="$end" \
            --axis 'title=linear,gimp,quadratic;method.basis=linear,gimp,quadratic' \
            --axis 'domain.cell=4,2,1,0.5,0.25;bodies.spring.membrane.number=5,10,20,40,80;bodies.spring.membrane.heavy_point=5,10,20,40,80;verify.reference.piston.origin=22,21,20.5,20.25,20.125'
        cp "$csv" "$runs/a2.csv"
        gains_study "a2-sharp-$m" 1 inputs/piston_membrane.yaml --set materials.sheet.density="$(calc %g "100*$m")" --set verify.reference.piston.mass=$m --set time.end="$end" --set output.interval="$end" \
            --set time.cfl=0.5 --axis title=sharp --axis 'domain.cell=[4.0,1],[2,1],[1,1],[0.5,1]'
        gains_join "$runs/a2.csv" "$csv" hperiod_position >"$runs/a2-both.csv"
        csv=$runs/a2-both.csv
        write '' "m = $m:"
        gains_row "A2, m = $m: period" 100 ', %' hperiod_position
    done
}

# gains_join FILE FILE METRIC: what gains_rows needs of both, as one CSV.
cost_accuracy_join() {
    local f
    echo "title,h,status,$3,run_seconds"
    for f in "$1" "$2"; do gains_rows "$3" <"$f" | awk -F'|' '{ printf "%s,%s,done,%s,%s\n", $1, $2, $3, $4 }'; done
}

cost_accuracy_dogbone() {
    write '' '## Dog-bone that becomes a cylinder (A3)' '' '`inputs/membrane_dogbone.yaml` against its exact rest: the largest error of radii, pressure and hoop stress. Baseline: as printed (linear, stress updated last from velocities mapped' \
        'again, strain by its rate, no heat). *Places*: strain by places, smoothed, losses as heat: the deck. *Cells*: gas on cells, held by the membrane. *Static*: the state of rest solved for (`solver: static`) without steps.'
    gains_study a3 1 inputs/membrane_dogbone.yaml --set output.interval=4 --max-wall 200 \
        --axis 'title=linear as printed,quadratic places,quadratic places cells,static,static cells;coupling=mpm,mpm,ice-mpm,mpm,ice-mpm;method.basis=linear,quadratic,quadratic,quadratic,quadratic;bodies.skin.membrane.strain=rate,positions,positions,positions,positions;bodies.skin.membrane.smoothing=0,0.05,0.05,0.05,0.05;method.flip=1,0.999,0.999,0.999,0.999;method.losses=drift,heat,heat,heat,heat;method.stress=musl,usl,usl,usl,usl;time.solver=dynamic,dynamic,dynamic,static,static' \
        --axis "domain.cell=${GAINS_DOGBONE:-0.4,0.2};bodies.skin.membrane.number=${GAINS_DOGBONE_POINTS:-56,100}"
    gains_row 'A3: radii, pressure and hoop stress' 100 ', %' hlate_radius hlate_radius_last hlate_pressure hlate_hoop_stress
}

cost_accuracy_circle() {
    write '' '## Slack circle (A4)' '' '`inputs/membrane_circle.yaml`, as above. Baseline: linear, strain by its rate, no heat.'
    gains_study a4 2 inputs/membrane_circle.yaml --set output.interval=0.06 \
        --axis 'title=linear as printed,quadratic places,quadratic places cells,static,static cells;coupling=mpm,mpm,ice-mpm,mpm,ice-mpm;method.basis=linear,quadratic,quadratic,quadratic,quadratic;bodies.skin.membrane.strain=rate,positions,positions,positions,positions;bodies.skin.membrane.smoothing=0,0.05,0.05,0.05,0.05;method.flip=1,0.999,0.999,0.999,0.999;method.losses=drift,heat,heat,heat,heat;time.solver=dynamic,dynamic,dynamic,static,static' \
        --axis 'domain.cell=0.2,0.1,0.05;bodies.skin.membrane.number=46,91,181'
    gains_row 'A4: radii, pressure and hoop stress' 100 ', %' hlate_radius hlate_radius_last hlate_pressure hlate_hoop_stress
}

cost_accuracy_pendulum() {
    write '' '## Pendulum on a string (B5)' '' '`inputs/pendulum.yaml` against a chain of bars: the largest error of the place over the amplitude, and the error of the period. Baseline: linear, stress updated last, strain by its rate, as printed. *Places*:' \
        '`strain: positions`, `smoothing: 0.05`. Points of a string that swings cross cells, and the gradient of velocity at a point jumps; what it has integrated is then not what its neighbours'"'"' places say, and the' \
        'difference flutters. Places have no such memory.'
    gains_study b5 1 inputs/pendulum.yaml --set output.interval=1.75 --set method.flip=1 --axis domain.cell=0.2,0.1,0.05 --max-wall 200 \
        --axis 'title=linear as printed,linear musl,gimp musl,linear musl places;method.basis=linear,linear,gimp,linear;method.stress=usl,musl,musl,musl;bodies.string.membrane.strain=rate,rate,rate,positions;bodies.string.membrane.smoothing=0,0,0,0.05'
    gains_row 'B5: place' 100 ', %' hmax_x
    write '' 'Period:'
    gains_row 'B5: period' 100 ', %' hperiod_x
}

cost_accuracy_bar() {
    write '' '## Vibrating bar (B10)' '' '`inputs/bar_vibration.yaml`: L1 of stress (of a largest stress of 3.1 Pa), then of velocity (of 1e-4 m/s). Baseline: linear, FLIP, `cfl: 0.4` as in the deck (with 0.8 it is unstable); the others take' \
        '`cfl: 0.95`. No one of them is the best in both: splines have stress of second order, where it is read off at the points; hat functions (those of GIMP are the same here), whose stress is of first order, have the smaller dispersion with APIC or TPIC.'
    gains_study b10 2 inputs/bar_vibration.yaml --set output.interval=0.07 \
        --axis 'title=linear,linear cfl 0.6,quadratic,quadratic apic,cubic tpic,linear apic,gimp tpic;method.basis=linear,linear,quadratic,quadratic,cubic,linear,gimp;method.transfer=flip,flip,flip,apic,tpic,apic,tpic;method.flip=1,1,1,null,null,null,null;time.cfl=0.4,0.6,0.6,0.95,0.95,0.95,0.95' \
        --axis domain.cell=0.015625,0.0078125,0.00390625,0.001953125
    gains_row 'B10: stress' 1 ', Pa' l1_stress_xx
    write '' 'Velocity:'
    gains_row 'B10: velocity' 1 ', m/s' l1_velocity_x
}

result_cost_accuracy() {
    begin cost_accuracy 'Error per second: every variant beside the linear basis'
    write 'Run times are those of one thread, outputs left out. What is compared is what was run: no curve is interpolated or continued. A factor is the baseline'"'"'s error over the smallest that another variant has' \
        'reached in no more time; the bar is for the dearest case of the baseline.' '' '## Bars' '' '@bars@' ''
    gains_a1_page
    gains_piston
    gains_dogbone
    gains_circle
    gains_pendulum
    gains_bar
    gains_put_bars
    write '' "Other programs used the machine during $(cost_accuracy_disturbed) of these runs."
    finish
}

# gains_disturbed: "N of M", the runs during which others used more than a tenth of a core.
cost_accuracy_disturbed() {
    local f
    for f in "$runs"/*/study.csv; do gains_plain <"$f"; done | awk -F, '/^coupling,|^title,|^domain.cell,/ { for (i = 1; i <= NF; i++) if ($i == "disturbed") at = i; next }
        { n++; d += $at == "yes" } END { printf "%d of %d", d, n }'
}

# The bars are known at the end, and stand at the start.
cost_accuracy_put_bars() {
    local whole=$page
    page=$runs/bars.md
    : >"$page"
    show_bars
    sed -i -e "/^@bars@\$/{r $runs/bars.md" -e 'd}' "$whole"
    page=$whole
}
