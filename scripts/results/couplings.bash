# couplings: the same decks by points, by cells and by both: error against run time, and which coupling wins where. Sourced by
# scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# scene NAME ROW METRIC DECK ARGUMENT...: compares the couplings of a deck; a table of the metric, floe's plot and its sentences.
scene() {
    local short=$1 row=$2 metric=$3 deck=$4 from log
    shift 4
    floe_compare "$short" "$deck" "$@"
    log=$runs/$short.txt
    from=$(column "$csv" "$metric")
    write "## $(grep -m 1 -v '^\[' "$log")" '' "Row $row; \`$deck\`; error: \`$metric\`." '' '| coupling | case | error | run time, s |' '|---|---|---|---|'
    awk -F, -v e="$from" -v s="$(column "$csv" run_seconds)" 'NR > 1 { t = $2; gsub(/"/, "", t); gsub(/domain\.cell=/, "h = ", t); sub(/;.*/, "", t)
        printf "| %s | %s | %.3g | %.3g |\n", $1, t, $e, $s }' "$csv" >>"$page"
    write
    grep -E "^(for|no variant) .*in $metric( |:)" "$log" | sed 's/$/./; s/^f/F/; s/^n/N/; s/^/* /' >>"$page" || true
    write
    if [ -f "$runs/$short/errors.svg" ]; then
        cp "$runs/$short/errors.svg" "$results/couplings-$short.svg"
        write "![error against spacing and run time](couplings-$short.svg)" ''
    fi
    folders+=("$runs/$short")
    winners+=("| $row | $(grep -m 1 -v '^\[' "$log") | \`$metric\` | $(grep -E "^for .*in $metric " "$log" | tail -n 1 | sed -E 's/^for (.*) in [^ ]* choose ([^,]*), ([^;]*)(; (.*))?$/\2 (\1 in \3; \5)/') |")
}

result_couplings() {
    local folders=() winners=()
    begin couplings 'One deck, each coupling: error against run time'
    write 'Fluids as material points (`mpm`), on the cells (`ice`), or on the cells beside solids and membranes of points (`ice-mpm`): the same deck each time, one' \
        'thread. Run times are without those of outputs. Errors are absolute, or shares where they are relative (`l1rel_`, `hlate_`, `eq13`: 0.01 is a per cent). `floe report` makes one page of all of them (last section).' ''
    local bone='domain.cell=0.4,0.2;bodies.skin.membrane.number=56,100'
    scene sod 'B1, D1' l1_density inputs/sod.yaml
    scene expansion B2 l1rel_density inputs/gas_expansion.yaml
    scene cylinder A1 eq13 inputs/pressurized_cylinder.yaml --axis domain.cell=0.1,0.05
    scene circle A4 hlate_radius inputs/membrane_circle.yaml --axis domain.cell=0.1,0.05
    scene dogbone A3 hlate_radius inputs/membrane_dogbone.yaml --axis "$bone"
    write '## Which wins where' '' '| row | scene | error | the fastest to the smallest error asked for |' '|---|---|---|---|' "${winners[@]}" ''
    write "The pistons (A2) are two decks, as the fluid needs a membrane to hold it on cells: \`piston_container\` (mpm) and \`piston_membrane\` (ice-mpm)." ''
    floe_run piston-points inputs/piston_container.yaml
    local points=$runs/piston-points.txt
    floe_run piston-cells inputs/piston_membrane.yaml
    write '| coupling | period, error |' '|---|---|' "| mpm | $(grep -o 'hperiod_position: .*' "$points" || grep -h -o '"hperiod_position": [^,]*' "$runs/piston-points/summary.json") |" \
        "| ice-mpm | $(grep -h -o '"hperiod_position": [^,]*' "$runs/piston-cells/summary.json") |" ''
    "$floe" report "${folders[@]}" -o "$runs/couplings.html" --quiet
    commands+=("floe report ${folders[*]#"$runs"/} -o couplings.html")
    finish
}
