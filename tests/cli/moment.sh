#!/usr/bin/env bash
# The account of the moment of momentum: what sides, loads, supports, springs and damping give is entered where it acts, and nothing else
# drifts. A sign or an arm that is wrong shows at once: what comes in here is a third to the whole of what there is.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

# moment DIR: its largest drift, of all there was; "null" where it has no account
moment() { sed -nE 's/^ *"angular_momentum": ([^,]*),?$/\1/p' "$1/summary.json" | head -n 1; }
# keeps LIMIT NAME ARGUMENT...: a run whose moment drifts by less
keeps() {
    local limit=$1 name=$2
    shift 2
    expect 0 "$FLOE" run "$@" -o "$name" --quiet
    below "$(moment "$name")" "$limit"
}

# A spinning disc that is thrown into a corner: mirrors to round-off; sides with friction and those that let go to 2.3e-5 and 4.0e-4 of all
# turning (measured), for points there are moved out of the side.
cat >disc.yaml <<'END'
floe: 1
units: none
coupling: mpm
domain: {dim: 2, stress_state: plane_strain, lower: [-1, -1], upper: [1, 1], cell: 0.0625}
boundaries: symmetry
materials:
  rubber: {density: 3, law: {neo_hookean: {bulk_modulus: 5, shear_modulus: 2}}}
bodies:
  disc: {material: rubber, shape: {ball: {centre: [0, 0], radius: 0.37}}, state: exact}
loads: {pull: {gravity: {acceleration: [0.4, -0.1]}}}
time: {end: 3}
output: {interval: 3, history_interval: 0.2}
verify:
  exact: {spinning_disc: {radius: 0.37, density: 3, bulk_modulus: 5, shear_modulus: 2, spin: 0.5}}
END
keeps 1e-14 mirror disc.yaml
has mirror/history.csv 'largest_drift_angular_momentum_z (1)'
has mirror/history.csv 'ledger_angular_momentum_z_boundary (1)'
keeps 5e-5 stick disc.yaml --set boundaries=no_slip
keeps 8e-4 slide disc.yaml --set boundaries=slip
# FLIP alone carries no motion about points, and says what it loses: 1.8 %.
expect 0 "$FLOE" run disc.yaml -o flip --quiet --set method.transfer=flip
below 0.01 "$(moment flip)"
below "$(moment flip)" 0.03
has flip/summary.json 'moment of momentum about z'

# A block with a load off its centre: to round-off, in the plane and in space, with all that may hold it.
cat >block.yaml <<'END'
floe: 1
units: none
coupling: mpm
domain: {dim: 2, stress_state: plane_strain, lower: [-1, -1], upper: [1, 1], cell: 0.125}
boundaries: slip
materials:
  rubber: {density: 3, law: {neo_hookean: {bulk_modulus: 5, shear_modulus: 2}}}
bodies:
  block: {material: rubber, shape: {box: {lower: [-0.5, -0.25], upper: [0.5, 0.25]}}}
  weight: {material: rubber, shape: {box: {lower: [0.25, 0.25], upper: [0.5, 0.5]}}}
loads:
  push: {body_force: {body: weight, acceleration: [0, -0.2]}}
time: {end: 1}
output: {interval: 1, history_interval: 0.1}
END
support='{s: {region: {box: {lower: [-0.6, -0.3], upper: [-0.4, 0.3]}}}}'
keeps 1e-14 load block.yaml
keeps 1e-14 damped block.yaml --set 'damping={rate: 0.5}'
keeps 1e-14 sprung block.yaml \
    --set 'springs={s: {from: {body: block, point: 30}, to: {position: [0.9, 0.8]}, stiffness: 0.3}}'
keeps 1e-14 rubbed block.yaml --set 'contact={kind: friction, friction: 0.3}'
keeps 1e-14 held block.yaml --set "supports=$support"
sed -e 's/dim: 2, stress_state: plane_strain, lower: \[-1, -1\], upper: \[1, 1\], cell: 0.125/dim: 3, lower: [-1, -1, -1], upper: [1, 1, 1], cell: 0.25/' \
    -e 's/\[-0.5, -0.25\]/[-0.5, -0.25, -0.5]/; s/\[0.5, 0.25\]/[0.5, 0.25, 0.5]/; s/\[0.25, 0.25\]/[0.25, 0.25, 0]/' \
    -e 's/\[0.5, 0.5\]/[0.5, 0.5, 0.5]/; s/\[0, -0.2\]/[0, -0.2, 0.1]/' block.yaml >space.yaml
keeps 1e-14 space space.yaml
for axis in x y z; do has space/history.csv "drift_angular_momentum_$axis (1)"; done

# Gas that bursts off the middle of a box: its pressure turns nothing by itself, its advection does, by 4.5e-4 (measured; half of it with half the cell).
cat >gas.yaml <<'END'
floe: 1
units: none
coupling: ice
domain: {dim: 2, lower: [0, 0], upper: [1, 1], cell: 0.03125}
boundaries: symmetry
materials:
  air: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}
ambient: {material: air, pressure: 1, temperature: 0.01}
bodies:
  charge: {material: air, shape: {box: {lower: [0.2, 0.3], upper: [0.4, 0.45]}}, pressure: 10, temperature: 0.01}
time: {end: 0.5}
output: {interval: 0.5, history_interval: 0.05}
END
keeps 9e-4 gas gas.yaml

# Where an axis is periodic, what leaves comes back elsewhere; about an axis nothing turns: no account, and no column.
expect 0 "$FLOE" run gas.yaml -o round --quiet --set boundaries="{x: periodic, y: symmetry}"
[ "$(moment round)" = null ] || fault 'a moment of momentum across periodic sides'
if grep -q angular_momentum round/history.csv; then fault 'columns of no account'; fi
expect 0 "$FLOE" run gas.yaml -o axis --quiet --set domain.geometry=axisymmetric
[ "$(moment axis)" = null ] || fault 'a moment of momentum about an axis'

# Air that walls of two temperatures drive round a box: the walls and its weight turn it all along, and the error of advection, 1.5 % of what turns
# (0.3 with half the cell), is 0.2 % of that: nothing to be told.
cat >warm.yaml <<'END'
floe: 1
coupling: ice
domain: {dim: 2, lower: [0, 0], upper: [0.1, 0.1], cell: 0.005}
boundaries: {x: {lower: {no_slip: {temperature: 320 K}}, upper: {no_slip: {temperature: 280 K}}}, y: no_slip}
materials:
  air: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}, viscosity: {shear: 1.8e-5}, conductivity: 0.026}
bodies: {all: {material: air, shape: {box: {lower: [0, 0], upper: [0.1, 0.1]}}, pressure: 1 bar, temperature: 300}}
loads: {weight: {gravity: {acceleration: [0, -9.81]}}}
method: {pressure: implicit}
time: {end: 1}
output: {interval: 0.5}
END
keeps 3e-2 warm warm.yaml
if grep -q 'moment of momentum' warm/run.log; then fault 'what walls turn is told as if it came from nothing'; fi
