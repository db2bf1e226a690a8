# shocks: Riemann problems, interfaces and blasts against their exact solutions. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# shocks_variant DECK N: the N-th group of "#    --set ..." lines of the deck's head, as the array `overrides`; none for 0.
shocks_variant() {
    eval "overrides=($(awk -v want="$2" '/^#    --set/ { if (!on) n++; on = 1; sub(/^# */, ""); if (n == want) printf "%s ", $0; next }
        { on = 0 }' "inputs/$1.yaml"))"
}

# shocks_table FOLDER DECK VARIANT SPACINGS METRIC...: errors and orders of one problem; $csv is its comparison.
shocks_table() {
    local folder=$1 deck=$2 variant=$3 spacings=$4 h m b s head='| h | steps | rejected |' rule='|---|---|---|' row overrides
    shift 4
    shocks_variant "$deck" "$variant"
    floe_compare "$folder" "inputs/$deck.yaml" "${overrides[@]}" --axis domain.cell="$spacings"
    cp "$csv" "$results/shocks-$folder.csv"
    for m in "$@"; do
        head+=" $m |"
        rule+='---|'
    done
    write "$head energy drift |" "$rule---|"
    for h in $(cases "$csv" ice); do
        row="| $h | $(value "$csv" ice "$h" steps) | $(value "$csv" ice "$h" rejected_steps) |"
        for m in "$@"; do row+=" $(printf %.3e "$(value "$csv" ice "$h" "$m")") |"; done
        write "$row $(printf %.1e "$(value "$csv" ice "$h" drift_energy)") |"
    done
    row='| **order** | | |'
    for m in "$@"; do
        read -r b s < <(order "$csv" ice "$m")
        row+=$(printf ' **%.2f**%s |' "$b" "$([[ $s == *nan* ]] || printf ' ± %.2f' "$s")")
    done
    write "$row |" ''
}

# shocks_bar WHAT METRIC LIMIT: the least order of the last table.
shocks_bar() {
    local b s
    read -r b s < <(order "$csv" ice "$2")
    bar "$1, order of ${2#l1*_}" "$b" '>=' "$3" %.2f
}

# shocks_plot NAME FOLDER/CASE COLUMN LABEL: a profile beside the exact one.
shocks_plot() {
    plot "$1" 620,360 <<END
set xlabel 'x'; set ylabel '$4'; set key right top
plot '$runs/$2/profile.csv' every ::1 using 1:$3 with points pt 7 ps 0.4 lc rgb ice title 'ice', \\
     '$runs/$2/profile.csv' every ::1 using 1:($3 + 1) with lines lw 1 lc rgb 'black' title 'exact (averages over cells)'
END
    write "![$1](shocks-$1.svg)" ''
}

shocks_riemann() {
    local i=0 label
    local -a folders=(toro-1 toro-2 toro-3 toro-4 toro-5 right-blast lax)
    local -a said=("Toro 1: Sod's tube with a stream" 'Toro 2: two fans, nearly a vacuum' 'Toro 3: the left blast, pressures 1e5 apart'
        'Toro 4: two shocks' 'Toro 5: the left blast, its contact all but at rest' 'The right blast, pressures 1e4 apart' "Lax's problem")
    write '## Riemann problems of one gas' '' '`inputs/riemann.yaml`, at the default CFL number. The exact solver gives the star states of Toro 2009, table 4.2,' \
        'to half their last figure (`tests/unit/test_verify_riemann.c`).' ''
    for label in "${folders[@]}"; do
        write "### ${said[i]}" ''
        shocks_table "$label" riemann "$i" 0.01,0.005,0.0025,0.00125 l1_density l1_velocity_x l1_pressure l1_internal_energy
        shocks_bar "${said[i]}" l1_density 0.6
        bar "${said[i]}: steps rejected" "$(for h in $(cases "$csv" ice); do value "$csv" ice "$h" rejected_steps; done | sort -g | tail -n 1)" '<=' 0 %.0f
        shocks_plot "$label" "$label/ice-0.005" 2 density
        i=$((i + 1))
    done
}

# The largest departure of p from p* between two places, over a scale.
shocks_interface() { # PROFILE FROM TO STAR SCALE
    awk -F, -v a="$2" -v b="$3" -v star="$4" -v scale="$5" 'NR > 1 && $1 > a && $1 < b { d = $6 - star; if (d < 0) d = -d; if (d > most) most = d }
        END { print most / scale }' "$1"
}

# How far the pressure falls below the exact one left of x = 0.69, in per cent of 1 GPa.
shocks_foot() { # PROFILE
    awk -F, 'NR > 1 && $1 < 0.69 && $7 - $6 > most { most = $7 - $6 } END { printf "%.1f", most / 1e7 }' "$1"
}

shocks_fluids() {
    write '## Shock tubes of two fluids' '' '`inputs/fluid_tube.yaml`: density, velocity and energy of the mixture by mass; its pressure.' '' \
        '### Water of 1 GPa and air' ''
    local -a metrics=(l1rel_density l1rel_velocity_x l1rel_pressure l1rel_internal_energy l1_volume_fraction)
    shocks_table water-air fluid_tube 0 0.01,0.005,0.0025,0.00125 "${metrics[@]}"
    shocks_bar 'water and air' l1rel_density 0.7
    shocks_bar 'water and air' l1rel_pressure 0.7
    shocks_plot water-air water-air/ice-0.005 2 density
    write "Behind the fan the pressure should be 14.19 MPa up to the shock at 0.834. About the interface, from 0.69 to 0.828, it is off by at most\
 $(calc %.2f "100*$(shocks_interface "$runs/water-air/ice-0.00125/profile.csv" 0.69 0.828 14190477.2 14190477.2)") % of that at 800 cells. At the foot of the fan it falls\
 too low, by $(shocks_foot "$runs/water-air/ice-0.01/profile.csv") % of the water's 1 GPa at 100 cells and\
 $(shocks_foot "$runs/water-air/ice-0.00125/profile.csv") % at 800: centred in time, the foot of a strong fan rings." ''
    write '### Two gases, gamma 1.4 and 1.6' ''
    shocks_table two-gases fluid_tube 1 0.01,0.005,0.0025,0.00125 "${metrics[@]}"
    shocks_bar 'two gases' l1rel_density 0.8
    shocks_plot two-gases two-gases/ice-0.005 2 density
}

shocks_streams() {
    local limiter variant overrides h
    write '## Interfaces in a stream' '' '`inputs/fluid_stream.yaml`: air, water and helium, or air and water, at 1 bar and 100 m/s, carried once around.' '' \
        '| fluids | limiter | h | steps | linf of u, m/s | linf of p, over p |' '|---|---|---|---|---|---|'
    for variant in 1 0; do
        for limiter in first_order default; do
            shocks_variant fluid_stream $variant
            floe_compare "stream-$variant-$limiter" inputs/fluid_stream.yaml "${overrides[@]}" --set method.limiter=$limiter --axis domain.cell=0.02,0.01
            for h in $(cases "$csv" ice); do
                write "| $((3 - variant)) | $limiter | $h | $(value "$csv" ice "$h" steps) | $(value "$csv" ice "$h" linf_velocity_x) |\
 $(value "$csv" ice "$h" linfrel_pressure) |"
            done
            bar "stream of $((3 - variant)) fluids, $limiter: p off by at most" "$(value "$csv" ice 0.01 linfrel_pressure)" '<=' 1e-7 %.1e
        done
    done
    write ''
}

shocks_blasts() {
    write '## Blasts and implosions' '' '### Noh, against a wall' ''
    shocks_table noh-plane noh 0 0.01,0.005,0.0025,0.00125 l1_density l1_velocity_x l1_pressure l1_internal_energy
    shocks_bar 'Noh, plane' l1_density 0.8
    shocks_plot noh-plane noh-plane/ice-0.005 2 density
    write '### Noh, against a line, in the plane' ''
    shocks_table noh-line noh 1 0.04,0.02,0.01 l1_density l1_velocity_x l1_pressure
    shocks_bar 'Noh, line' l1_density 0.6
    write '### Sedov, from a plane' ''
    shocks_table sedov-plane sedov 0 0.02,0.01,0.005 l1_density l1_velocity_x l1_pressure
    shocks_bar 'Sedov, plane' l1_density 0.7
    shocks_plot sedov-plane sedov-plane/ice-0.005 2 density
    write '### Sedov, from a line, about the axis' ''
    shocks_table sedov-line sedov 1 0.03,0.015,0.0075 l1_density l1_velocity_x l1_pressure
    shocks_bar 'Sedov, line' l1_velocity_x 0.6
    write 'The order of density is a half here, 0.8 of the plane: the peak behind the shock is a few cells thin at these spacings.' '' '### Sedov, from a point, about the axis' ''
    shocks_table sedov-point sedov 2 0.04,0.02 l1_density l1_velocity_x l1_pressure
    write 'Two spacings only, and no more than a look: the axisymmetric blast is coarse here.' ''
}

result_shocks() {
    begin shocks 'Shocks, interfaces and blasts on cells, against exact solutions'
    write 'Validation rows D1, D2 and D7. Errors are means over the cells, of averages over cells (`l1rel`: over that of the exact solution); orders' \
        'are slopes in log-log with their standard errors.' ''
    shocks_riemann
    shocks_fluids
    shocks_streams
    shocks_blasts
    write '## Bars' ''
    show_bars
    finish
}
