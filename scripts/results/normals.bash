# normals: normals to unconnected points, static tables beside the papers' and membranes run with them. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# table NAME [BENCH]: a table of bench_surface_normals, or of another, in $runs/NAME.csv.
table() {
    "$build/bench/bench_surface_${2:-normals}" "$1" >"$runs/$1.csv"
}

# cell NAME KEYS COLUMN: of the row that begins with KEYS (commas and all).
cell() {
    awk -F, -v keys="$2," -v c="$3" 'index($0, keys) == 1 { print $c; exit }' "$runs/$1.csv"
}

normals_lines() {
    local row
    table lines
    write '## Lines (S00 tables I and II)' '' 'Points evenly along a line through a cell, linear splines, a hundred points off the surface: the condition of the normal' \
        "equations' matrix, and the worst angle. The paper does not print its points, and its row for -0.5 repeats figures of that for -1." '' \
        '| points | slope | least | most | median | published: least, most, median | worst angle |' '|---|---|---|---|---|---|---|'
    local paper=('3,0.1:3.7e+03, 1.3e+08, 5.0e+03' '3,0.5:7.8e+01, 4.6e+07, 1.7e+02' '3,1:3.5e+01, 4.8e+05, 5.9e+01' '3,2:2.3e+02, 7.3e+16, 3.6e+02'
        '3,10:3.7e+03, 1.1e+06, 5.4e+03' '3,-10:3.6e+03, 5.1e+06, 5.3e+03' '3,-2:2.3e+02, 1.4e+07, 3.3e+02' '3,-1:3.5e+01, 3.6e+07, 6.1e+01'
        '3,-0.5:3.5e+01, 3.6e+07, 1.2e+02' '3,-0.1:3.7e+03, 2.5e+06, 6.0e+03' '4,1:3.2e+01, 3.2e+05, 7.9e+01' '8,1:3.6e+01, 1.7e+09, 6.5e+01'
        '4,2:1.3e+02, 2.9e+06, 1.9e+02' '8,2:1.7e+02, 9.9e+05, 3.4e+02' '4,10:4.1e+03, 5.4e+04, 5.8e+03' '8,10:5.7e+03, 2.2e+05, 7.7e+03')
    for row in "${paper[@]}"; do
        write "| ${row%%,*} | $(cut -d: -f1 <<<"${row#*,}") | $(cell lines "${row%%:*}" 3) | $(cell lines "${row%%:*}" 4) | $(cell lines "${row%%:*}" 5) | ${row#*:} | $(cell lines "${row%%:*}" 6) |"
    done
    bar 'lines of any slope: worst angle over all points off the surface' "$(awk -F, 'NR > 1 && $6 > w { w = $6 } END { print w }' "$runs/lines.csv")" '<=' 1e-9 %.1e ' degrees'
}

normals_elements() {
    local n k published
    table circle
    write '' '## A circle by linear splines (S00 table III)' '' 'Radius 0.8 about the corner of a cell of 1, in radians. The column that the paper heads "rms" is the norm over the number of points; the' \
        'true root mean square stands beside it. Points evenly in angle from 0.1 to pi/2 - 0.1, the point off the circle at (0.18, 0.93): what the paper does not print.' '' \
        '| points | worst | published | norm / N | published | root mean square |' '|---|---|---|---|---|---|'
    published=([3]='0.1211 0.0571' [4]='0.1091 0.0434' [8]='0.1177 0.0231' [16]='0.1261 0.0141' [32]='0.1308 0.0092')
    local off=0
    for n in 3 4 8 16 32; do
        write "| $n | $(cell circle $n 2) | ${published[n]% *} | $(cell circle $n 4) | ${published[n]#* } | $(cell circle $n 3) |"
        off=$(awk -v w="$off" -v a="$(cell circle $n 2)" -v b="${published[n]% *}" 'BEGIN { d = a - b; d = d < 0 ? -d : d; print (d > w ? d : w) }')
    done
    bar 'circle by linear splines: worst angle off table III by at most' "$off" '<=' 1e-4 %.1e ' rad'
    for n in arcs space thesis line degenerate; do table "$n"; done
    write '' '## Arcs, cubics, planes and spheres (S00 figures 4 to 11, Y97 figures 76 to 85)' '' 'Largest angle over the points, in degrees, for a hundred points off the surface: least, median and most; and with the one that floe' \
        'takes of eight, by the evenness of the gradient, with its root mean square. Where quadratic splines are short of equations (sets a and b), their answer hangs on that' \
        'point, and that of the singular normal equations on round-off besides. Places of points are ours: the papers show them in figures.' '' \
        '| set | points | splines | solver | least | median | most | floe | rms | published |' '|---|---|---|---|---|---|---|---|---|---|'
    awk -F, -v q="'" 'FNR == 1 { next }
        { p = "" }
        FILENAME ~ /arcs/ { p = $3 == 1 ? ($1 == "a" ? "6" : "34") : $1 == "a" ? "3 (normal equations)" : $1 == "b" ? ($4 == "QR" ? "under 1" : "19") : "0" }
        FILENAME ~ /space/ { p = $1 == "sphere" && $3 == 1 ? "13, norm / N 3" : "0" }
        FILENAME ~ /thesis/ { p = $1 == "45 degrees" ? "0" : $1 == "80 degrees" ? "0.01 mean" : $1 ~ /^xy/ ? "0 (5 digits)" : $1 == "circle 0.4" ? "several" : "figure" }
        { d = $3 == 1 ? "linear" : $3 == 2 ? "quadratic" : "-"
          printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", $1, $2, d, $4, $5, $6, $7, $8, $9, p }' \
        "$runs"/{arcs,space,thesis}.csv >>"$page"
    write '' 'One point on one axis (S00 figures 1 and 8): with the point off it the gradient has a sign and the normal length one. Of the solutions of least norm' \
        'without it only that in the middle of the cell has no gradient; elsewhere its sign says on which side of the middle the point is.' '' '| place | splines | with | without |' '|---|---|---|---|'
    awk -F, 'NR > 1 { print "| " $1 " | " ($2 == 1 ? "linear" : "quadratic") " | " $3 " | " $4 " |" }' "$runs/line.csv" >>"$page"
    write '' '## Degenerate sets (Y97 figures 80 to 84, S00 section 4)' '' 'Worst angle in degrees of five points (unless said otherwise) in a cell. *Alone*: linear splines on the one element by normal equations, as published. "None": no' \
        'direction follows from one point, and a membrane keeps the normal that it had (`normals_kept`).' '' '| set | alone | isosurface_linear | isosurface | isosurface_quadratic | quadric |' '|---|---|---|---|---|---|'
    awk -F, 'NR > 1 { print "| " $1 " | " $2 " | " $3 " | " $4 " | " $5 " | " $6 " |" }' "$runs/degenerate.csv" >>"$page"
}

# angles NAME FIRST: rows of a table of the cubic, for each c the worst angle and the root mean square of each method.
angles() {
    table "$1" cubic
    write '' "| c | $2 | connectivity | isosurface | isosurface_quadratic | quadric |" '|---|---|---|---|---|---|'
    awk -F, 'NR > 1 { print "| " $1 " | " $2 " | " $3 ", " $4 " | " $5 ", " $6 " | " $7 ", " $8 " | " $9 ", " $10 " |" }' "$runs/$1.csv" >>"$page"
}

normals_cubic() {
    table readings cubic
    write '' '## A cubic (S00 figure 10)' '' 'y = c x^2 (x - 1) + x + 0.5, quadratic splines; the paper has 1 degree at worst with c = 2, 32 degrees with c = 4, where its "rms" is 5: as in table III' \
        'the norm over the number of points, for 5 as a root mean square beside 32 would take forty points and more. It prints neither how many points there are nor where. With eight points, which just determine' \
        'the function, evenly along the curve from x = 0.05 to y = 0.85, all three figures come out, wherever the point off the curve is. Starts from 0 to 0.2, ends from 0.8 to 1, 7 to 20 points' \
        'and both spacings were tried: what counts is the first point, about 0.05 from the side, at which the worst angle is. Each of the other rows differs in what it names; quartiles of the worst angle over a hundred points' \
        'off the curve, and the norm over N of the median.' '' '| reading | splines | solver | evenly in | points | c = 2: quartiles | norm / N | points | c = 4: quartiles | norm / N |' '|---|---|---|---|---|---|---|---|---|---|'
    awk -F, 'NR > 1 { print "| " $1 " | " ($2 == 1 ? "linear" : "quadratic") " | " $3 " | " $4 " | " $5 " | " $6 ", " $7 ", " $8 " | " $9 " | " $10 " | " $11 ", " $12 ", " $13 " | " $14 " |" }' "$runs/readings.csv" >>"$page"
    write '| *published* | quadratic | normal equations | | | 1 | | | 32 | 5 |'
    bar 'cubic (S00 figure 10): worst angles off 1 and 32 degrees by at most' "$(awk -F, '$1 == "nearest" { a = $7 - 1; b = $12 - 32; a = a < 0 ? -a : a; b = b < 0 ? -b : b; print (a > b ? a : b) }' "$runs/readings.csv")" '<=' 0.5 %.2g ' degrees'
    write '' 'What more points on the one cell bring: the polynomial through the nearest points gains two digits where the points are doubled twice; splines on a cell that' \
        'is larger than the radius of curvature stay where they are. Worst angle and root mean square.'
    angles points_cubic 'points'
    write '' 'What smaller cells bring, with eight points to a cell of 1, sixteen to two of a half, and so on:'
    angles cells h
    bar 'cubic, c = 2 and 4: order of the worst angle of quadric from 12 points to 192' "$(awk -F, '$2 == 12 { a[$1] = $9 } $2 == 192 { o = log(a[$1] / $9) / log(16); if (!n++ || o < w) w = o } END { print w }' "$runs/points_cubic.csv")" '>=' 3 %.2g
}

normals_cylinder() {
    table cylinder
    write '' '## A cylinder of radius 1 (Y97 figures 67 to 72)' '' 'Cells of 0.1, 720 points around; angles in degrees, worst and root mean square, with nothing inside and with 4 and 16 points of a fluid a' \
        'cell. As in the thesis: without points inside only the mass-matrix methods (`isosurface*`) are of use; with them the colours come within a few degrees.' '' \
        '| method | vacuum | 4 points a cell | 16 points a cell |' '|---|---|---|---|'
    awk -F, 'NR > 1 { print "| " $1 " | " $2 ", " $3 " | " $4 ", " $5 " | " $6 ", " $7 " |" }' "$runs/cylinder.csv" >>"$page"
}

normals_dogbone() {
    local h worst=0
    table dogbone
    cp "$runs/dogbone.csv" "$results/normals-dogbone.csv"
    write '' '## The contour of the dog-bone' '' 'Lines and exact arcs of `inputs/membrane_dogbone.yaml`, and the circle that it becomes, at the four meshes and numbers of points of Y97 table 5: worst and root mean' \
        'square angle in degrees; last with points of that circle moved across it by up to a twentieth of their spacing.' '' '| h | points | method | contour | circle | noisy circle |' '|---|---|---|---|---|---|'
    awk -F, 'NR > 1 { print "| " $1 " | " $2 " | " $3 " | " $4 ", " $5 " | " $6 ", " $7 " | " $8 ", " $9 " |" }' "$runs/dogbone.csv" >>"$page"
    for h in 0.4 0.2 0.1 0.05; do
        worst=$(awk -F, -v h=$h -v w="$worst" '$1 == h && $3 == "connectivity" { m = $4; r = $5 } $1 == h && $3 == "quadric" { a = $4 / m; b = $5 / r; a = a > b ? a : b; print (a > w ? a : w) }' "$runs/dogbone.csv")
    done
    bar 'dog-bone contour, four meshes: error of quadric over that of connectivity, worst and rms' "$worst" '<=' 1
    bar 'dog-bone circle, four meshes: worst angle of quadric' "$(awk -F, '$3 == "quadric" && $6 > w { w = $6 } END { print w }' "$runs/dogbone.csv")" '<=' 1e-9 %.1e ' degrees'
}

# sweep NAME LABEL: error of each method over one thing.
sweep() {
    table "$1"
    cp "$runs/$1.csv" "$results/normals-$1.csv"
    plot "$1" 820,520 <<END
set logscale xy; set xlabel '$2'; set ylabel 'angle, root mean square (degrees)'; set key outside below maxrows 3; set format y '%g'
plot for [c = 2:11] '$runs/$1.csv' using 1:c with linespoints lw 2 pt 7 ps 0.5 title columnheader(c) noenhanced
END
    write '' "![$2]($name-$1.svg)"
}

normals_sweeps() {
    write '' '## Points a cell, noise, curvature' '' 'A circle of radius 1, mean over eight places of the mesh. By points a cell: h = 0.2, positions off by up to 0.01 of the spacing. By noise: 7 points a cell. By h over' \
        'radius: 7 points a cell, 0.001 of the spacing. What goes by the spacing of the points (`connectivity`, `quadric`) does not see h; what goes by cells does; `spread` smooths noise. The colours have 16 points a cell inside.'
    sweep points 'points a cell'
    sweep noise 'noise over spacing'
    sweep curvature 'h over radius'
}

# history_of FOLDER COLUMN TITLE STYLE: a curve of a plot.
history_of() {
    local file=$runs/$1/history.csv
    printf "'%s' every ::1 using %s:%s with lines %s title '%s' noenhanced" "$file" "$(column "$file" time)" "$(column "$file" "$2")" "$4" "$3"
}

# mean_after FILE COLUMN TIME: mean of a column from a time on.
mean_after() {
    awk -F, -v t="$(column "$1" time)" -v c="$(column "$1" "$2")" -v from="$3" 'NR > 1 && $t >= from { s += $c; n++ } END { printf "%.10g", s / n }' "$1"
}

# swing_after FILE COLUMN TIME: its standard deviation.
swing_after() {
    awk -F, -v t="$(column "$1" time)" -v c="$(column "$1" "$2")" -v from="$3" 'NR > 1 && $t >= from { s += $c; q += $c * $c; n++ }
        END { printf "%.2f", sqrt(q / n - s * s / n / n) }' "$1"
}

# cost FOLDER POINTS: microseconds a membrane point and step of the stage that makes the normals.
cost() {
    awk -F'[:,]' -v n="$2" '/"steps"/ { s = $2 } /"mpm_membrane_normals"/ { t = $2 } END { printf "%.2g", 1e6 * t / s / n }' "$runs/$1/summary.json"
}

# angle_of FOLDER: what the run's metrics say of its normals at the end.
angle_of() {
    awk -F'[:,]' '/"linf_normal"/ { a = $2 } /"l2_normal"/ { b = $2 } END { printf "%.2g, %.2g", a, b }' "$runs/$1/summary.json"
}

# As the papers have it: strain by its rate, and nothing of what is lost becomes heat.
by_rate=(--set bodies.skin.membrane.smoothing=0 --set bodies.skin.membrane.strain=rate --set method.flip=1 --set method.losses=drift)

normals_cost() {
    table cost
    write '' '## Cost' '' 'Microseconds of one core a point, binning and all, of 4000 points on a circle and on a sphere. In a run it is the stage `mpm_membrane_normals` of `seconds_by_stage`; scenes without such' \
        'membranes do not have it, and `connectivity` as a membrane runs it costs nothing beside it.' '' \
        '| method | 2-D: 4 points a cell | 8 | 16 | 3-D: 4 a cell | 8 | 16 |' '|---|---|---|---|---|---|---|'
    awk -F, 'NR > 1 { gsub(/,/, " | "); print "| " $0 " |" }' "$runs/cost.csv" >>"$page"
}

normals_circle() {
    local m p reference
    write '' '## Slack circular membrane (S00 figures 12 and 13)' '' '`inputs/membrane_circle.yaml`: the rest pressure with its damping; the plot without damping, as published (in figures only). Strain by its rate, as in the papers.' '' \
        '| normals | rest pressure | off connectivity | normals off the radius: worst, root mean square (degrees) | microseconds a membrane point and step |' '|---|---|---|---|---|'
    for m in connectivity isosurface quadric; do
        floe_run "circle-free-$m" inputs/membrane_circle.yaml --set "bodies.skin.membrane.normals=$m" "${by_rate[@]}" --set damping=null --set time.end=0.05
        floe_run "circle-$m" inputs/membrane_circle.yaml --set "bodies.skin.membrane.normals=$m" "${by_rate[@]}"
        p=$(mean_after "$csv" pressure_gas 0.059)
        [ $m = connectivity ] && reference=$p
        write "| $m | $(printf %.4f "$p") | $(calc %.5f "100*($p/$reference-1)") % | $(angle_of "circle-$m") | $([ $m = connectivity ] || cost "circle-$m" 91) |"
        [ $m = connectivity ] || bar "circular membrane: rest pressure, $m against connectivity" "$(calc %g "100*sqrt(($p/$reference-1)^2)")" '<=' 0.5 %.2g ' %'
    done
    plot circle 820,420 <<END
set xlabel 't'; set ylabel 'pressure'; set key outside below
plot $(history_of circle-free-connectivity pressure_gas 'connectivity' 'lw 3 lc rgb grey'), \\
     $(history_of circle-free-isosurface pressure_gas 'isosurface' 'lw 1.5 lc rgb mpm'), \\
     $(history_of circle-free-quadric pressure_gas 'quadric' 'lw 1.5 dt 2 lc rgb ice')
END
    write '' '![pressure without damping](normals-circle.svg)'
}

normals_expansion() {
    local m x y t
    write '' '## Expanding cylinder (Y97 figures 73 to 75)' '' 'Radius 1 in a box of 1.5 with cells of 0.1, 180 points on the membrane and 16 a cell in the gas. The thesis prints neither deck nor pressure; here the membrane and the gas are' \
        'those of the circle above, at 1000. Change of the radius, mean of 0 and 90 degrees. As in the thesis the membrane bursts with the colours, and holds with' \
        'the mass-matrix methods.' '' '| normals | largest change to t = 0.05 | at t = 0.05 |' '|---|---|---|'
    for m in connectivity colour colour_quadratic colour_cubic isosurface_linear isosurface quadric; do
        floe_run "expansion-$m" inputs/membrane_circle.yaml --set "bodies.skin.membrane.normals=$m" "${by_rate[@]}" --set 'domain.upper=[1.5, 1.5]' \
            --set bodies.gas.shape.ball.radius=1 --set bodies.skin.membrane.curve.arc.radius=1 --set bodies.skin.membrane.number=180 \
            --set boundaries.x.upper=no_slip --set boundaries.y.upper=no_slip --set damping=null --set time.end=0.05
        x=$(column "$csv" first_skin_x) y=$(column "$csv" last_skin_y) t=$(column "$csv" time)
        write "| $m | $(awk -F, -v x="$x" -v y="$y" 'NR > 1 { d = ($x + $y) / 2 - 1; if (d > m) m = d } END { printf "%.4f | %.4f", m, d }' "$csv") |"
    done
    plot expansion 820,520 <<END
set xlabel 't'; set ylabel 'change of radius'; set key outside below maxrows 3
plot $(for m in connectivity colour colour_quadratic colour_cubic isosurface_linear isosurface quadric; do
        printf "'%s' every ::1 using %s:((\$%s+\$%s)/2-1) with lines lw 2 title '%s' noenhanced, " "$runs/expansion-$m/history.csv" "$t" "$x" "$y" "$m"
    done)
END
    write '' '![radius](normals-expansion.svg)'
}

# lost FILE: energy of motion, strain and heat that is gone at the end, per cent of what there was.
lost() {
    awk -F, -v k="$(column "$1" kinetic)" -v s="$(column "$1" strain)" -v i="$(column "$1" internal)" 'NR == 2 { a = $k + $s + $i }
        NR > 1 { b = $k + $s + $i } END { printf "%.2f", 100 * (1 - b / a) }' "$1"
}

normals_bone() {
    local m p reference folder
    write '' '## Dog-bone on a mesh of 10 x 10 (S00 figures 14 and 15)' '' '`inputs/membrane_dogbone.yaml` with cells of 0.2 in a box of 2, 100 points on the membrane, viscosity 0.2, strain by its rate and MUSL, to t = 4. The gas does not come to rest' \
        'by then: pressure is the mean from t = 1 on, with the standard deviation of its swings, which bounds how much a difference says.' '' \
        '| normals | pressure | off connectivity | energy lost |' '|---|---|---|---|'
    for m in connectivity isosurface quadric '{quadric: {spread: 2}}'; do
        folder=bone-$(tr -cd 'a-z0-9' <<<"$m")
        floe_run "$folder" inputs/membrane_dogbone.yaml --set "bodies.skin.membrane.normals=$m" "${by_rate[@]}" --set 'domain.upper=[2, 2]' --set domain.cell=0.2 \
            --set method.stress=musl --set materials.gas.viscosity.shear=0.2 --set bodies.skin.membrane.number=100 --set time.end=4 --set output.interval=4
        p=$(mean_after "$csv" pressure_gas 1)
        [ "$m" = connectivity ] && reference=$p
        write "| \`$m\` | $(printf %.3f "$p") +- $(swing_after "$csv" pressure_gas 1) | $(calc %.2f "100*($p/$reference-1)") % | $(lost "$csv") % |"
        [ "$m" = quadric ] && bar 'dog-bone, 10 x 10: mean pressure, quadric against connectivity' "$(calc %g "100*sqrt(($p/$reference-1)^2)")" '<=' 0.5 %.2g ' %'
    done
    plot bone 820,420 <<END
set xlabel 't'; set ylabel 'pressure'; set key outside below; set yrange [20:60]
plot $(history_of bone-connectivity pressure_gas 'connectivity' 'lw 3 lc rgb grey'), \\
     $(history_of bone-isosurface pressure_gas 'isosurface' 'lw 1.5 lc rgb mpm'), \\
     $(history_of bone-quadric pressure_gas 'quadric' 'lw 1.5 dt 2 lc rgb ice')
END
    write '' '![pressure](normals-bone.svg)' '' 'As the deck is (strain from places, damping from t = 3), at rest; means from t = 3.6 on. Whose neighbours they are follows from `normals`: without' \
        'connections they are found anew in every step from where the points lie.' '' \
        '| normals | pressure | off connectivity | radius |' '|---|---|---|---|'
    for m in connectivity quadric isosurface; do
        floe_run "rest-$m" inputs/membrane_dogbone.yaml --set "bodies.skin.membrane.normals=$m" --set 'domain.upper=[2, 2]' --set domain.cell=0.2 \
            --set bodies.skin.membrane.number=100
        p=$(mean_after "$csv" pressure_in_skin 3.6)
        [ "$m" = connectivity ] && reference=$p
        write "| \`$m\` | $(printf %.4f "$p") | $(calc %.4f "100*($p/$reference-1)") % | $(printf %.4f "$(mean_after "$csv" first_skin_x 3.6)") |"
    done
}

result_normals() {
    begin normals 'Normals to unconnected points'
    local top=$page
    page=$runs/body.md
    : >"$page"
    normals_lines
    normals_elements
    normals_cubic
    normals_cylinder
    normals_dogbone
    normals_sweeps
    normals_cost
    normals_circle
    normals_expansion
    normals_bone
    page=$top
    write 'What `membrane.normals` can be (`floe list normals`), against the figures of Sulsky and York 2000 (S00) and of chapter 7 of York 1997 (Y97). Static tables are printed by' \
        '`build/release/bench/bench_surface_normals NAME`; angles are in degrees unless said otherwise. Normals of contacts, of two bars and of ball and net, are on the' \
        'page of [contacts](contact.md).' '' '## Bars' ''
    show_bars
    write
    cat "$runs/body.md" >>"$page"
    finish
}
