#!/usr/bin/env bash
# A plane deck about an axis: the thick cylinder under a traction, as a slab in (r, z), measured against the same exact solution.
# shellcheck source=tests/cli/lib.bash
source "$(dirname "$0")/lib.bash"

expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/annulus_traction.yaml" -o slab --quiet --set domain.cell=0.05 --set domain.geometry=axisymmetric \
    --set domain.stress_state=null --set 'domain.upper=[1.2, 0.4]' --set 'boundaries={z: slip}' \
    --set 'bodies.cylinder.shape={box: {lower: [0.5, 0], upper: [1, 0.4]}}' \
    --set 'loads.bore.traction.surface={box: {lower: [0, -1], upper: [0.5, 2]}}' \
    --set 'verify.metrics=[eq13, l1rel_sigma_r, l1rel_sigma_theta, l1rel_stress_yy, l1rel_stress_zz, l1rel_displacement_x]'
# Measured: 0.77, 0.95, 0.20, 0.20, 0.62 and 0.11 %; stresses and displacement by the solution's axes, x = r, y across, z = z.
below "$(json slab/summary.json eq13)" 0.01
below "$(json slab/summary.json l1rel_sigma_r)" 0.012
below "$(json slab/summary.json l1rel_sigma_theta)" 0.003
below "$(json slab/summary.json l1rel_stress_yy)" 0.003
below "$(json slab/summary.json l1rel_stress_zz)" 0.008
below "$(json slab/summary.json l1rel_displacement_x)" 0.002
