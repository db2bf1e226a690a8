# picture: the pictures of the README. Sourced by scripts/results.sh.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# Hoop stress of the steel and pressure of the gas at rest, the gas as points and on cells; exact stresses are 12.9 to 32.3 MPa.
result_picture() {
    local runs=out/results/picture coupling
    for coupling in mpm ice-mpm; do
        rm -rf "${runs:?}/$coupling"
        "$floe" run inputs/pressurized_cylinder.yaml --coupling $coupling --threads 1 --quiet -o $runs/$coupling
        "$floe" picture $runs/$coupling --points sigma_theta --cells pressure --range 10e6:35e6 --range 0:20e6 \
            -o $results/cylinder-$coupling.png
    done
}
