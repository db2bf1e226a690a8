# contact: two bars that collide, with and without a contact; normals. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# two_bars NU H NAME ARGUMENT...: one run of the deck; $csv is its history.
two_bars() {
    local nu=$1 h=$2 name=$3
    shift 3
    local law=materials.bar.law.linear_elastic arguments=(--set "domain.cell=$h")
    [ "$nu" = 0 ] && arguments+=(--set "$law.bulk_modulus=33333.333333333336" --set "$law.shear_modulus=5e4")
    for argument in "$@"; do arguments+=(--set "$argument"); done
    floe_run "$nu-$h-$name" inputs/two_bars.yaml "${arguments[@]}"
}

# after_impact FILE: time of contact, both velocities, restitution, energy lost (%), largest drift of momentum; means from 0.03 to 0.2
# after the right bar has begun to move.
after_impact() {
    local name columns=()
    for name in time kinetic strain velocity_left_x velocity_right_x drift_momentum_x; do columns+=("$(column "$1" $name)"); done
    awk -F, -v c="${columns[*]}" 'BEGIN { split(c, at, " ") }
        NR == 1 { next }
        NR == 2 { E0 = $at[2] + $at[3] }
        { if ($at[6] > drift) drift = $at[6] }
        start == "" && $at[5] > 0.02 { start = $at[1] }
        start != "" && $at[1] >= start + 0.03 && $at[1] <= start + 0.2 { n++; E += $at[2] + $at[3]; l += $at[4]; r += $at[5] }
        END { printf "%.3f %.3f %.3f %.3f %.2f %.1e\n", start, l / n, r / n, (r - l) / n / 2, 100 * (1 - E / n / E0), drift }' "$1"
}

# contact_row NU H WHAT ARGUMENT...
contact_row() {
    local nu=$1 h=$2 what=$3 figures
    shift 3
    two_bars "$nu" "$h" "$(tr -c 'a-z0-9\n' _ <<<"$what")" "$@"
    figures=$(after_impact "$csv")
    read -r -a f <<<"$figures"
    write "| $nu | $h | $what | ${f[0]} | ${f[1]} | ${f[2]} | **${f[3]}** | ${f[4]} % | ${f[5]} |"
    contact_last=$figures
}

# The points at the end (Y97 Figs 93a, 95a).
contact_pictures() {
    local variant
    for variant in stick release__pair__nodes; do
        "$floe" picture "$runs/0.3-0.25-$variant" --points velocity_x --range -1:3 --width 600 -o "$results/contact-points-${variant%%_*}.png"
    done
    write '' '## Points at t = 0.5 (Y97 Figs 93a, 95a), nu = 0.3, h = 0.25' '' '![without release](contact-points-stick.png)' '' \
        '![with release at shared nodes](contact-points-release.png)'
}

contact_velocities() {
    local stick=$runs/0.3-0.25-stick/history.csv nodes=$runs/0.3-0.25-release__pair__nodes/history.csv
    local points=$runs/0.3-0.25-release__pair/history.csv t l r
    t=$(column "$stick" time) l=$(column "$stick" velocity_left_x) r=$(column "$stick" velocity_right_x)
    plot velocities 820,520 <<END
set xlabel 't'; set ylabel 'velocity of the centre of mass'; set key outside below maxrows 3; set yrange [-0.3:2.2]
plot '$stick' every ::1 using $t:$l with lines lw 1 lc rgb grey title 'no release, left', \\
     '$stick' every ::1 using $t:$r with lines lw 1 dt 2 lc rgb grey title 'right', \\
     '$nodes' every ::1 using $t:$l with lines lw 2 lc rgb ice title 'release at nodes, left', \\
     '$nodes' every ::1 using $t:$r with lines lw 2 dt 2 lc rgb ice title 'right', \\
     '$points' every ::1 using $t:$l with lines lw 2 lc rgb mpm title 'release where points have met, left', \\
     '$points' every ::1 using $t:$r with lines lw 2 dt 2 lc rgb mpm title 'right'
END
}

contact_energies() {
    local a=$runs/0-0.25-release__pair__nodes/history.csv b=$runs/0-0.125-release__pair__nodes/history.csv
    local c=$runs/0.3-0.25-release__pair__nodes/history.csv d=$runs/0.3-0.25-friction__0/history.csv t k s
    t=$(column "$a" time) k=$(column "$a" kinetic) s=$(column "$a" strain)
    plot energies 820,420 <<END
set xlabel 't'; set ylabel 'energy of both bars'; set yrange [0:13]; set key outside below maxrows 3
plot '$a' every ::1 using $t:(\$$k+\$$s) with lines lw 2 lc rgb ice title 'release, ν = 0, h = 0.25', \\
     '$b' every ::1 using $t:(\$$k+\$$s) with lines lw 2 dt 2 lc rgb ice title 'ν = 0, h = 0.125', \\
     '$c' every ::1 using $t:(\$$k+\$$s) with lines lw 2 lc rgb mpm title 'ν = 0.3, h = 0.25', \\
     '$d' every ::1 using $t:(\$$k+\$$s) with lines lw 2 lc rgb grey title 'without friction, ν = 0.3, h = 0.25', \\
     '$c' every ::1 using $t:$s with lines lw 1 lc rgb mpm title 'strain energy, ν = 0.3'
END
}

# Angle errors as the test of the normals measures them.
contact_normals() {
    write '' '## Normals' '' 'Angle between the normal of a pair of bodies and the exact one, at all nodes that both reach: root mean square / worst, in' \
        'degrees, at h = 0.05, 0.025, 0.0125 (spheres: 0.05), 2 points along each axis of a cell; and for a ball that touches a net of one layer' \
        'of points, on both sides of the net (Y97 Fig. 101). Written by `verification_mpm_normals`. The error is that of the few points about a' \
        'node, and does not fall with h. Largest are those of nodes that a body hardly reaches.' ''
    "$build/tests/verification_mpm_normals" 2>/dev/null | grep -E '^(plane|circle|sphere|net)' | sed 's/^/    /' >>"$page"
}

result_contact() {
    begin contact 'Two bars that collide: release, restitution, energy; normals'
    local nu h criterion worst=0 least=9 contact_last
    write 'Two elastic bars in plane stress, 1.25 x 4.5, the left one at velocity 2 (Y97 appendices A.1, A.4.12; `inputs/two_bars.yaml`). Published:' \
        'without release they stick; with it the left bar keeps 0.3 and the right one leaves with 1.7 (restitution 0.7, nu = 0.3, 11 % of the energy' \
        'lost); with nu = 0 2 % lost at two meshes. In theory the restitution is 1 for nu = 0, by waves along the bars, and about 0.95 for nu = 0.3, where lateral' \
        'vibration keeps the rest. Times: the bars meet at t = 0.25; at shared nodes they do up to a cell before.' '' \
        '| nu | h | contact | bars meet at t | left after | right after | restitution | energy lost | momentum drift |' \
        '|---|---|---|---|---|---|---|---|---|'
    for nu in 0.3 0; do
        for h in 0.25 0.125; do
            contact_row $nu $h 'stick' contact.kind=stick contact.criterion=null contact.touch=nodes
            for criterion in pair mean both; do
                contact_row $nu $h "release, $criterion, nodes" contact.criterion=$criterion contact.touch=nodes
                worst=$(awk -v a="$worst" -v b="${contact_last##* }" 'BEGIN { print (b > a ? b : a) }')
                least=$(awk -v a="$least" -v c="$contact_last" 'BEGIN { split(c, f, " "); print (f[4] < a ? f[4] : a) }')
            done
            contact_row $nu $h 'release, pair'
            contact_row $nu $h 'friction, 0' contact.kind=friction
            contact_row $nu $h 'release, pair, quadratic basis' method.basis=quadratic
        done
    done
    bar 'momentum: largest drift over its size, release at nodes, all criteria, meshes, nu' "$worst" '<=' 1e-12 %.1e
    bar 'least restitution with release at nodes: the bars part' "$least" '>=' 0.7 %.3f
    contact_velocities
    contact_energies
    write '' 'The energy that `friction` loses is that of the impulses at the nodes that stop the approach, and falls with h; `release` hands on the acceleration of the' \
        'common field and loses none. In one dimension, against the waves in the bars (`test_impact` of `verification_mpm_contact`; the reference is `bar_impact`), quadratic splines, bars of' \
        '20, 40 and 80 cells: restitution 0.899, 0.941, 0.965 (release) and 0.914, 0.949, 0.969 (friction) for 1, time of contact 2.13, 2.08, 2.05 for 2.' \
        "York's own step of 0.0007 is 0.93 of h/c; with it and the linear basis energy grows here, and 0.4 h/c is used." \
        '' '`release`, `friction` without `nodes`: contact where points have met, the default. The three criteria of the thesis agree to the last digit shown where a pair' \
        'has one normal, as York found for the first two. With quadratic splines a light node may drop its force into the ledger, which is the drift there.' \
        '' '## Bars' ''
    show_bars
    write '' '## Velocities (Y97 Figs 93, 95), nu = 0.3, h = 0.25' '' '![velocities of the centres of mass](contact-velocities.svg)' '' \
        'Without release the bars are free of each other from t = 0.35 to 0.425, with a cell between them, and then meet again: the thesis names the same two times.' '' \
        '## Energy (Y97 Fig. 96)' '' '![energies](contact-energies.svg)'
    contact_pictures
    contact_normals
    finish
}
