# stability: the largest stable steps of a line of points, and other limits. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# limit FILE KEY1,KEY2,... COLUMN: that column of the combination in a limits.csv.
limit() {
    awk -F, -v keys="$2" -v name="$3" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) at = i; next }
        { t = $0; gsub(/"/, "", t); if (index(t, keys ",") == 1) print $at }' "$1"
}

# further WORST X REFERENCE: the larger of WORST and |X / REFERENCE - 1|.
further() {
    awk -v w="$1" -v x="$2" -v r="$3" 'BEGIN { d = x / r - 1; d = d < 0 ? -d : d; print (d > w ? d : w) }'
}

# The other transfers, on the same bar.
stability_transfers() {
    local transfer basis scheme text
    floe_stability transfers inputs/bar_vibration.yaml --set output.interval=null --set output.history_interval=0.01 --set time.end=100 \
        --set time.max_steps=2000 --set method.flip=null --over time.fixed_step=0.0005:0.012 --each method.transfer=pic,xpic,apic,tpic \
        --each method.basis=linear,gimp,quadratic,cubic,cpdi --each method.stress=usl,usf,musl --relative-to 0.00197642354 --tolerance 0.01
    cp "$csv" $results/stability-transfers.csv
    write '## Transfers' '' 'The same bar, 2000 steps. Largest stable step over h/c for USL; in brackets for MUSL and USF, which are alike here:' '' \
        '| basis | pic | xpic (2) | apic | tpic |' '|---|---|---|---|---|'
    for basis in linear gimp quadratic cubic cpdi; do
        text="| $basis |"
        for transfer in pic xpic apic tpic; do
            text+=" $(printf %.2f "$(limit "$csv" $transfer,$basis,usl stable_over_reference)") ($(printf %.2f "$(limit "$csv" $transfer,$basis,musl stable_over_reference)")) |"
            for scheme in usl usf musl; do
                smallest=$(awk -v a="$smallest" -v b="$(limit "$csv" $transfer,$basis,$scheme stable_over_reference)" 'BEGIN { print (b < a ? b : a) }')
            done
        done
        write "$text"
    done
    write ''
}

# The same of a bar in gas on cells, by every basis, transfer and time of the stress update.
stability_coupled() {
    local transfer basis text
    floe_stability coupled inputs/extreme/tension.yaml --set verify.exact.standing_bar.amplitude=1e-6 --set output.interval=null \
        --set output.history_interval=0.1 --set time.end=1000 --set time.max_steps=1000 --set method.flip=null --over time.fixed_step=0.01:0.2 \
        --each method.transfer=flip,pic,xpic,apic,tpic --each method.basis=linear,gimp,quadratic,cubic,cpdi --each method.stress=usl,usf,musl \
        --relative-to 0.0625 --tolerance 0.02
    cp "$csv" $results/stability-coupled.csv
    write '## A bar in gas' '' 'A bar that vibrates in gas on cells (`inputs/extreme/tension.yaml`), four points a cell, 1000 steps. Largest stable step over h/c of the bar for USL; in brackets for' \
        'MUSL (USF has the same or the next value of the search, 1.2 % apart). The gas, whose sound is 1.18 times as fast, would be stable up to 0.85: no limit is below the smaller of both by more than 0.5 %.' '' \
        '| basis | flip (0.99) | pic | xpic (2) | apic | tpic |' '|---|---|---|---|---|---|'
    for basis in linear gimp quadratic cubic cpdi; do
        text="| $basis |"
        for transfer in flip pic xpic apic tpic; do
            text+=" $(printf %.2f "$(limit "$csv" $transfer,$basis,usl stable_over_reference)") ($(printf %.2f "$(limit "$csv" $transfer,$basis,musl stable_over_reference)")) |"
        done
        write "$text"
    done
    write ''
}

# Both time centrings of the pressure of cells against linear acoustics: the search, and its page.
find_centring() {
    local centring theory stable unstable worst=0
    floe_stability centring inputs/acoustic_pulse.yaml --set output.interval=null --set output.history_interval=0.05 --set time.end=1e9 \
        --set time.max_steps=4000 --set stability.growth=1 --over time.fixed_step=0.008:0.03 --each method.centring=half,full \
        --relative-to 0.02 --tolerance 0.002
    for centring in half full; do
        case $centring in half) theory=1 ;; full) theory=0.70710678 ;; esac
        stable=$(limit "$csv" $centring stable_over_reference) unstable=$(limit "$csv" $centring unstable_over_reference)
        centrings+=("$(printf '| %s | %.4f | **%.4f** to %.4f | %+.2f %% |' $centring $theory "$stable" "$unstable" "$(calc %g "100*($stable/$theory-1)")")")
        worst=$(further "$worst" "$stable" $theory)
    done
    bar 'ICE, both centrings: largest stable step off linear acoustics by at most' "$(calc %g "100*$worst")" '<=' 2 %.2f ' %'
}

stability_centring() {
    write '## Time centring of the pressure of cells' '' \
        'A pulse of sound of 1e-6 round a ring of 50 cells, unlimited, 4000 steps; unstable as soon as there is more energy than there can be. Largest' \
        'stable step over h/c. Theory: 1 - 4 l^2 s^2 (full, phi = 1) and 1 - 2 l^2 s^4 (half, phi = 1/2) as determinants of the step, l = c dt/h, s the sine of half' \
        'the phase of a cell.' '' '| centring | theory | found | off |' '|---|---|---|---|' "${centrings[@]}" ''
}

# The coupled step over the ratio of densities.
stability_density() {
    local density step gas stable unstable over table=()
    gas=$(calc %.6g '0.1/sqrt(1.4*19.5e6/1.1768)') # h/c of the gas at the end: 19.5 MPa at the density it began with
    for density in 8.9 89 890 8900 89000; do
        step=$(calc %.6g "0.1/sqrt(175.4e9/$density)")
        floe_stability density-$density inputs/pressurized_cylinder.yaml --coupling ice-mpm --set domain.cell=0.1 --set time.end=0.0015 --set time.max_steps=1500 \
            --set materials.steel.density=$density --over time.fixed_step="$(calc %.6g "0.3*$step"):$(calc %.6g "4*$step")" --tolerance 0.03
        stable=$(limit "$csv" found stable) unstable=$(limit "$csv" found unstable)
        : "${stable:?no limit of the step with a density of $density}"
        over=$(awk -v x="$stable" -v a="$step" -v b="$gas" 'BEGIN { print x / (a < b ? a : b) }')
        table+=("$(printf '| %s | %.3g | %.3g | %.3g to %.3g | %.2f |' $density "$(calc %g "$density/1.1768")" "$step" "$stable" "$unstable" "$over")")
        loosest=$(awk -v a="$loosest" -v b="$over" 'BEGIN { print (b < a ? b : a) }')
    done
    write '## Solid in gas: ratio of densities' '' \
        'The pressurised cylinder at h = 0.1 m up to 1.5 ms or 1500 steps, gas on cells, the steel as stiff as ever and as heavy as shown. Largest stable fixed step,' \
        "over the smaller of h/c of the solid and of the gas, which is $gas s when it has been heated. Steps below all limits are bound by whichever is smaller, at any" \
        'ratio; in two dimensions floe takes cfl/sqrt(2) of it.' '' \
        '| density, kg/m3 | over that of the air outside | h/c, s | stable up to, s | over the smaller h/c |' '|---|---|---|---|---|' "${table[@]}" ''
}

# Whether the default CFL numbers follow.
stability_defaults() {
    write '' '## The default CFL numbers' '' \
        "The smallest limit of any basis, transfer and time of the stress update on this page is $(printf %.2f "$smallest") h/c, in one dimension; of the coupled cylinder it is" \
        "$(printf %.2f "$loosest") h/c, or $(calc %.2f "$loosest*sqrt(2)") h/(c sqrt 2), which is what floe's CFL number multiplies in two. The default, \`time.cfl: 0.5\` for both solvers, is" \
        "$(calc %.1f "$smallest/0.5") times below the first and $(calc %.1f "$loosest*sqrt(2)/0.5") times below the second, and half of either limit of the pressure of cells, whose step floe divides by sqrt 2 where" \
        'phi = 1 (theory 2.14). It follows from the table with that margin. More is not taken: points that a lattice does not put at centres have smaller limits (at the' \
        'sides of their cells half of those, above), and points move.' ''
}

result_stability() {
    begin stability 'Up to which step, exchange, ... a scene is stable'
    local smallest=99 loosest=99 # of all limits found, over h/c: of points, of the coupled step
    local ends lattice place scheme text eigen published papers stable file worst_eigen=0 worst_papers=0
    floe_stability line inputs/stability_line.yaml
    cp "$csv" $results/stability-line.csv
    file=$results/stability-line.csv
    "$build/tests/verification_mpm_stability" >"$runs/eigenvalues.txt" 2>&1
    local table=()
    for ends in symmetry periodic; do
        for lattice in 0 -0.4999; do
            for scheme in usl usf musl; do
                case $lattice in 0) place=centres published=2.0 ;; *) place=sides published=1.1 ;; esac
                case $place-$scheme in centres-usl) papers=0.76 ;; centres-*) papers=2.10 ;; *) papers=1.05 ;; esac
                case $ends in symmetry) text=held ;; *) text=ring ;; esac
                eigen=$(awk -v e=$text -v p=$place -v s=$scheme '{ sub(/:/, " ") } $1 == e && $2 == p && $3 == s { sub(/.*limit /, ""); print $1 }' "$runs/eigenvalues.txt")
                : "${eigen:?no eigenvalue for $text $place $scheme in $runs/eigenvalues.txt}"
                [ $scheme = usl ] && published=-
                stable=$(limit "$file" $ends,$lattice,$scheme stable_over_reference)
                table+=("$(printf '| %s | %s | %s | %s | %s | %s | **%.4f** to %.4f | %+.2f %% | %+.1f %% |' $text $place $scheme $published $papers "$eigen" "$stable" \
                    "$(limit "$file" $ends,$lattice,$scheme unstable_over_reference)" "$(calc %g "100*($stable/$eigen-1)")" "$(calc %g "100*($stable/$papers-1)")")")
                worst_eigen=$(further "$worst_eigen" "$stable" "$eigen")
                worst_papers=$(further "$worst_papers" "$stable" "$papers")
            done
        done
    done
    bar 'line of points: largest stable step off the eigenvalue of the step by at most' "$(calc %g "100*$worst_eigen")" '<=' 2 %.2f ' %'
    bar 'line of points: largest stable step off the limits by hand by at most' "$(calc %g "100*$worst_papers")" '<=' 2 %.2f ' %'
    local centrings=()
    find_centring
    write 'Found by bisection with `floe stability`: each value is a run of its own, unstable if it diverges, has rejected steps, an energy that' \
        'is no number, or more energy of motion and strain than there can be. A limit lies between the two values shown.' '' '## Bars' ''
    show_bars
    write '' "## York's line of points" '' \
        "Five points in cells of 1, the middle one kicked (York 1997, chapter 8). All steps over h/c. *Published*: the first unstable step that York saw, straining with velocities that" \
        'points bring to the nodes, as MUSL and USF do. *By hand*: 2/sin(2 pi/5) from centres, half of that from sides, and 0.76 for USL from centres, the largest step of five cells. *Eigenvalue*: that of' \
        "floe's own step, computed apart from it by \`tests/verification/test_mpm_stability.c\`." '' \
        '| ends | points at | stress | published | by hand | eigenvalue | found | off the eigenvalue | off the figure by hand |' \
        '|---|---|---|---|---|---|---|---|---|' "${table[@]}" '' \
        'The line with held ends and the ring have the same limits, for the shortest wave that five cells hold is the same. York saw the first unstable step at 2.0 and 1.1, in steps of a tenth.' \
        'York puts points 0.0001 beside the sides. Round the ring the eigenvalue moves by less than 0.1 % for any distance up to that, on either side.' ''
    if [ -f "$runs/line/energy.svg" ]; then
        cp "$runs/line/energy.svg" $results/stability-line.svg
        write 'The largest energy of each run over what there can be:' '' '![energy over the step](stability-line.svg)' ''
    fi
    floe_stability bar inputs/bar_vibration.yaml --set output.interval=null --set output.history_interval=0.01 \
        --set time.end=100 --set time.max_steps=4000 --over time.fixed_step=0.0005:0.008 --each method.basis=linear,gimp,quadratic,cubic,cpdi \
        --each method.stress=usl,usf,musl --relative-to 0.00197642354 --tolerance 0.005
    cp "$csv" $results/stability-bar.csv
    write '## Bases' '' 'The clamped bar of 16 cells with two points a cell, 4000 steps. Largest stable step over h/c:' '' \
        '| basis | usl | usf | musl |' '|---|---|---|---|'
    for place in linear gimp quadratic cubic cpdi; do
        text="| $place |"
        for scheme in usl usf musl; do
            text+=" $(printf %.2f "$(limit "$csv" $place,$scheme stable_over_reference)") |"
            smallest=$(awk -v a="$smallest" -v b="$(limit "$csv" $place,$scheme stable_over_reference)" 'BEGIN { print (b < a ? b : a) }')
        done
        write "$text"
    done
    write '' 'For two points a cell of an infinite line von Neumann analysis gives 0.77 for USL and 1.66 to 1.73 for MUSL and USF with the linear basis.' ''
    stability_transfers
    stability_coupled
    stability_centring
    stability_density
    floe_stability exchange inputs/pressurized_cylinder.yaml --coupling ice-mpm --set domain.cell=0.1 --set time.end=0.0015 \
        --over method.exchange=1:1e10 --tolerance 0.2
    write '## Exchange between gas and solid' '' \
        "The same cylinder. The solid and the gas that is in its cells are tied by K: it is stable from" \
        "K = $(limit "$csv" found stable | awk '{ printf "%.2g", $1 }') kg/(m3 s) on, and diverges at $(limit "$csv" found unstable | awk '{ printf "%.2g", $1 }'); floe's default is 1e15."
    stability_defaults
    finish
}
