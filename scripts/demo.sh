#!/usr/bin/env bash
# From a fresh clone to a result: installs what is missing, builds, and runs the pressurised cylinder both ways.
set -euo pipefail
cd "$(dirname "$0")/.."

deck=inputs/pressurized_cylinder.yaml
results=out/pressurized_cylinder-compare

scripts/setup.sh
scripts/build.sh release floe
build/release/floe compare "$deck" -o "$results"

cat <<END

The numbers above, and all others, are in $results:
    compare.csv, compare.json    errors, orders and run times of each coupling
    errors.svg                   errors against spacing and against run time
    profile.svg, profile.csv     radial and hoop stress along the x axis, beside the exact solution
    */history.csv                energies, momentum and mass over time
    */fields.xdmf                the fields: in ParaView, File > Open, choose "XDMF Reader", press Apply,
                                 and colour the points by stress and the cells by pressure
A page of all of it, to read and to hand on:
    build/release/floe report $results

The deck is $deck; change it, or set any key on the command line:
    build/release/floe compare $deck --set domain.cell=0.0125
END
