#!/usr/bin/env bash
# Extreme scenes that take a moment: none may be wrong. The whole table: scripts/results.sh extreme.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

for deck in "$FLOE_SOURCE"/inputs/extreme/*.yaml; do
    expect 0 "$FLOE" check "$deck"
done
expect 0 "$FLOE" study "$FLOE_SOURCE/inputs/extreme/vacuum.yaml" --couplings ice -o vacuum
has stdout '12 cases: 12 right, 0 refused, 0 wrong'
expect 0 "$FLOE" study "$FLOE_SOURCE/inputs/extreme/impedance.yaml" --couplings ice-mpm --axis materials.plate.density=0.00014,1.4e-06 --axis method.interface=sharp --axis time.cfl=0.9 \
    --axis materials.fluid.eos.stiffened.gamma=4.4 -o light
has stdout '2 cases: 1 right, 1 refused, 0 wrong'
expect 2 "$FLOE" run "$FLOE_SOURCE/inputs/extreme/impedance.yaml" --set materials.plate.density=0.0014 --set method.interface=smeared -o lighter
has stderr "is 0.001 times as heavy as the fluid beside it (1.4 kg/m3), and the smeared interface bears no less than 0.009: use method.interface: sharp with basis: quadratic,"
expect 2 "$FLOE" run "$FLOE_SOURCE/inputs/extreme/impedance.yaml" --set materials.plate.density=0.0014 --set method.basis=gimp -o lighter
has stderr "and a surface with this basis bears no less than 0.009"
expect 2 "$FLOE" run "$FLOE_SOURCE/inputs/extreme/impedance.yaml" --set materials.plate.density=1.4e-06 -o lighter
has stderr "is 1e-06 times as heavy as the fluid beside it (1.4 kg/m3), and a surface bears no less than 9e-05: make it heavier"

# A liquid at next to no pressure slips along a wall a million times as heavy: its viscosity there is that of the liquid alone.
expect 0 "$FLOE" study "$FLOE_SOURCE/inputs/extreme/impedance.yaml" --couplings ice-mpm --axis materials.plate.density=1400000 --axis method.interface=smeared -o heavy
has stdout '4 cases: 4 right, 0 refused, 0 wrong'

# Decks of each kind whose checks notice whatever is done to the result; those of a scene at rest are excused, and are checked to be. Seven
# every day, eleven at length (FLOE_EVERY).
spoil() { # DECK OPTION...
    expect 0 "$FLOE" study "$FLOE_SOURCE/inputs/extreme/$1.yaml" "${@:2}" --spoil -o "spoiled-$1"
    has stdout ' 0 wrong'
    has stdout 'checked blindly: 0'
}
spoil impact --axis materials.right.density=1
spoil unfolded --axis method.transfer=apic --axis method.basis=cubic --axis bodies.string.membrane.strain=rate
spoil pressure_ratio --axis 'title="p 1e1, rho 1e4","p 1e10, rho 1e4"'
spoil crumpled_points --axis method.transfer=apic --axis method.basis=quadratic --axis materials.skin.one_way=true --axis bodies.skin.membrane.strain=rate
spoil torn --axis method.basis=gimp
spoil places --axis method.basis=cubic --axis 'domain.lattice_offset=[0, 0]'
spoil tension --couplings ice-mpm,mpm --axis verify.exact.standing_bar.amplitude=1e-6
[ -n "${FLOE_EVERY:-}" ] || exit 0
spoil vessel --couplings mpm --axis time.solver=dynamic --axis method.interface=smeared --axis materials.wall.law.linear_elastic.bulk_modulus=1e5
spoil foam --couplings mpm --axis materials.foam.density=1.4e-3 --axis 'bodies.lid.velocity=[0.1, 0]'
spoil sliver_stream --axis 'bodies.block.shape.box.lower=[0.402, 0]'
spoil exchange --axis exchange.gases.momentum.constant.coefficient=0,1e+20
