# waves: orders on smooth flow and on a vibrating bar. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# order_table FILE COUPLING METRIC...: errors at each spacing, and the fitted order.
order_table() {
    local file=$1 coupling=$2 h m b s head='| h | steps |' rule='|---|---|' row orders='| **order** | |'
    shift 2
    for m in "$@"; do
        head+=" $m |"
        rule+='---|'
    done
    write "$head wall time |" "$rule---|"
    for h in $(cases "$file" "$coupling"); do
        row="| $h | $(value "$file" "$coupling" "$h" steps) |"
        for m in "$@"; do row+=" $(printf %.3e "$(value "$file" "$coupling" "$h" "$m")") |"; done
        write "$row $(printf %.2g "$(value "$file" "$coupling" "$h" wall_seconds)") s |"
    done
    for m in "$@"; do
        read -r b s < <(order "$file" "$coupling" "$m")
        orders+=$(printf ' **%.2f** ± %.2f |' "$b" "$s")
    done
    write "$orders |" ''
}

# order_bar WHAT FILE COUPLING METRIC LIMIT
order_bar() {
    local b s
    read -r b s < <(order "$2" "$3" "$4")
    bar "$1 (± $(printf %.2f "$s"))" "$b" '>=' "$5" %.2f
}

result_waves() {
    begin waves 'Smooth flow and a vibrating bar: orders'
    local basis
    floe_compare pulse inputs/acoustic_pulse.yaml --axis domain.cell=0.02,0.01,0.005,0.0025
    cp "$csv" $results/waves-pulse.csv
    order_bar 'ice: acoustic pulse, order of density' "$csv" ice l1_density 1.9
    floe_compare vortex inputs/isentropic_vortex.yaml
    cp "$csv" $results/waves-vortex.csv
    order_bar 'ice: isentropic vortex, 64 to 256 cells, unlimited, order of density' "$csv" ice l1_density 1.9
    floe_compare vortex-limited inputs/isentropic_vortex.yaml --set method.limiter=default
    cp "$csv" $results/waves-vortex-limited.csv
    order_bar 'ice: isentropic vortex, 64 to 256 cells, default limiter, order of density' "$csv" ice l1_density 1.7
    for basis in quadratic gimp linear; do
        floe_compare bar-$basis inputs/bar_vibration.yaml --set method.basis=$basis
        cp "$csv" $results/waves-bar-$basis.csv
        [ $basis = linear ] && continue
        order_bar "mpm: vibrating bar, $basis, order of velocity" "$csv" mpm l1_velocity_x 1.8
        order_bar "mpm: vibrating bar, $basis, order of stress" "$csv" mpm l1_stress_xx 1.8
    done
    write 'Errors against exact solutions under refinement in space and time together. L1 is the mean of |x - x_exact|, of cell' \
        'averages (ice) or at points (mpm); orders are slopes in log-log, with their standard errors.' '' '## Bars' ''
    show_bars
    write '' '## Acoustic pulse, by ICE' '' 'A pulse of amplitude 1e-6 runs once around a periodic line; unlimited.' ''
    order_table $results/waves-pulse.csv ice l1_density l1_velocity_x l1_pressure
    write '## Isentropic vortex, by ICE' '' 'Carried along the diagonal of a periodic square of 64, 128 and 256 cells a side. Unlimited:' ''
    order_table $results/waves-vortex.csv ice l1_density l1_velocity_x l1_velocity_y l1_pressure
    write 'With the default limiter:' ''
    order_table $results/waves-vortex-limited.csv ice l1_density l1_velocity_x l1_velocity_y l1_pressure
    write '## Clamped bar, by points' '' \
        'The first mode of a bar held at both ends, at a strain of 3e-6, two points a cell. As long as points tile their cells, as they' \
        'do at this strain, the GIMP weights of points at the quarters of a cell are those of the linear basis. Its gradient is' \
        'constant in a cell and so second order at the cell centre only; read off at the points, stress is first order.' ''
    for basis in quadratic gimp linear; do
        write "$basis:" ''
        order_table $results/waves-bar-$basis.csv mpm l1_velocity_x l1_stress_xx
    done
    finish
}
