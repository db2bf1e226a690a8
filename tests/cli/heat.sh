#!/usr/bin/env bash
# A fluid heated at a given power gains that power times volume and time, as points and on cells alike.
# shellcheck source=tests/cli/lib.bash
source "$(dirname "$0")/lib.bash"

# column NAME: the last value of a history column.
column() {
    awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) at = i } END { print $at }' "$2/history.csv"
}

for coupling in ice mpm; do
    expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/closed_box.yaml" --coupling "$coupling" -o "$coupling" --quiet \
        --set time.end=2e-4 --set 'loads={heater: {heat: {material: air, power: 1e8, region: {box: {lower: [0, 0.5], upper: [1, 1]}}}}}'
    # 1e8 W/m3 over half a square metre for 0.2 ms; what moves across the region's edge in that time is small.
    awk -v got="$(column 'ledger_energy_source (J)' "$coupling")" \
        'BEGIN { exit !(got > 0.98e4 && got < 1.02e4) }' || fault "$coupling: $(column 'ledger_energy_source (J)' "$coupling") J instead of 1e4"
done
