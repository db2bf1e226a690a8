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

result_stability() {
    begin stability 'Up to which step, exchange, ... a scene is stable'
    local ends lattice place scheme text eigen published papers stable file worst_eigen=0 worst_papers=0
    floe_stability line inputs/stability_line.yaml
    cp "$csv" $results/stability-line.csv
    file=$results/stability-line.csv
    "$build/tests/verification_mpm_stability" >"$runs/eigenvalues.txt" 2>&1
    local table=()
    for ends in slip periodic; do
        for lattice in 0 -0.4999; do
            for scheme in usl usf musl; do
                case $lattice in 0) place=centres published=2.0 ;; *) place=sides published=1.1 ;; esac
                case $place-$scheme in centres-usl) papers=0.76 ;; centres-*) papers=2.10 ;; *) papers=1.05 ;; esac
                case $ends in slip) text=held ;; *) text=ring ;; esac
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
        --set time.end=100 --set time.max_steps=4000 --over time.fixed_step=0.0005:0.008 --each method.basis=linear,gimp,quadratic \
        --each method.stress=usl,usf,musl --relative-to 0.00197642354 --tolerance 0.005
    cp "$csv" $results/stability-bar.csv
    write '## Bases' '' 'The clamped bar of 16 cells with two points a cell, 4000 steps. Largest stable step over h/c:' '' \
        '| basis | usl | usf | musl |' '|---|---|---|---|'
    for place in linear gimp quadratic; do
        text="| $place |"
        for scheme in usl usf musl; do text+=" $(printf %.2f "$(limit "$csv" $place,$scheme stable_over_reference)") |"; done
        write "$text"
    done
    write '' 'For two points a cell of an infinite line von Neumann analysis gives 0.77 for USL and 1.66 to 1.73 for MUSL and USF with the linear basis.' ''
    floe_stability exchange $a1_deck --coupling ice-mpm --set domain.cell=0.1 --set time.end=0.0015 \
        --over method.exchange=1:1e10 --tolerance 0.2
    write '## Exchange between gas and solid' '' \
        "The pressurised cylinder at h = 0.1 m up to 1.5 ms, gas on cells. The solid and the gas that is in its cells are tied by K: it is stable from" \
        "K = $(limit "$csv" found stable | awk '{ printf "%.2g", $1 }') kg/(m3 s) on, and diverges at $(limit "$csv" found unstable | awk '{ printf "%.2g", $1 }'); floe's default is 1e15."
    finish
}
