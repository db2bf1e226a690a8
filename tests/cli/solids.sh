#!/usr/bin/env bash
# Problems of solids whose answers are known, each of which floe once got wrong without a word.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

# run DECK KEY=VALUE...: results in ./out.
run() {
    local deck=$1 set=() setting
    shift
    for setting in "$@"; do set+=(--set "$setting"); done
    rm -rf out
    expect 0 "$FLOE" run "$deck" -o out --quiet "${set[@]}"
}

# A traction on a bore, with CPDI: a node that one corner of a domain reaches bears as much of it as its mass allows (theory 4.13).
run "$FLOE_SOURCE/inputs/defaults/e7_cylinder.yaml" method.basis=cpdi
below "$(json out/summary.json l1rel_sigma_r)" 0.5 # measured 0.25, as GIMP and hat functions; 0.83 where it bore what the basis gives it
below "$(json out/summary.json l1rel_displacement_x)" 0.011 # measured 0.0056, 0.023

# Weak bodies that collide may thicken, and so are crushed: no energy comes from nothing (theory 4.2).
discs=$FLOE_SOURCE/inputs/defaults/e5_discs.yaml
weak='{j2: {bulk_modulus: 833.33, shear_modulus: 384.6, yield_stress: 3}}'
energy() { # at the end, over that at the start
    awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i ~ /^(kinetic|strain|internal) \(/) column[i] = 1 }
             NR > 1 { all = 0; for (i in column) all += $i; if (NR == 2) first = all }
             END { print all / first }' out/history.csv
}
run "$discs" domain.stress_state=plane_stress "materials.rubber.law=$weak"
below "$(energy)" 1 # measured 0.94; 9.2, and with a contact 7.5
below 0.87 "$(energy)"
run "$discs" domain.stress_state=plane_stress "materials.rubber.law=$weak" 'contact={between: [left, right]}'
below "$(energy)" 1 # measured 0.92
below 0.83 "$(energy)"

# A block falls by its weight on another that is supported, both as wide as the mesh: nothing swings up at the default step. Where the step was not less than without a contact,
# the run was ended at 0.17 s by energy from nothing (theory 4.6).
cat >rest.yaml <<'END'
floe: 1
units: none
coupling: mpm
domain: {dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [0.8, 1.2], cell: 0.1}
boundaries: {x: symmetry, y: free}
materials:
  rubber: {density: 1000, law: {linear_elastic: {bulk_modulus: 1e6, shear_modulus: 0.5e6}}}
bodies:
  base: {material: rubber, shape: {box: {lower: [0, 0.1], upper: [0.8, 0.43]}}}
  block: {material: rubber, shape: {box: {lower: [0, 0.43], upper: [0.8, 0.87]}}}
contact: {between: [base, block], kind: friction, friction: 0.3}
supports: {hold: {region: {box: {lower: [-1, -1], upper: [4, 0.21]}}}}
loads: {g: {gravity: {acceleration: [0, -10]}}}
time: {end: 1}
output: {interval: 1, history_interval: 0.05}
END
run rest.yaml
below "$(awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i ~ /^largest_drift_energy/) at = i } END { print $at }' out/history.csv)" 0.02 # J, of 5; measured 0.0100

# The same in space, where block and base are narrower than the mesh, and in the plane with a base of a hundredth of the block's stiffness and density: lines
# at nodes that bodies in contact share swung up whatever the step (theory 4.10), to 1e6 times the energy, and with a light base to 10 times.
drift() { awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i ~ /^largest_drift_energy/) at = i } END { print $at }' out/history.csv; }
cat >rest_in_space.yaml <<'END'
floe: 1
units: none
coupling: mpm
domain: {dim: 3, lower: [0, 0, 0], upper: [0.7, 0.7, 0.4], cell: 0.1}
boundaries: {x: symmetry, y: {lower: symmetry, upper: free}, z: symmetry}
materials:
  rubber: {density: 1000, law: {linear_elastic: {bulk_modulus: 1e6, shear_modulus: 0.5e6}}}
bodies:
  base: {material: rubber, shape: {box: {lower: [0, 0, 0], upper: [0.7, 0.2, 0.4]}}}
  block: {material: rubber, shape: {box: {lower: [0.2, 0.2, 0.125], upper: [0.5, 0.4, 0.275]}}}
contact: {between: [base, block], kind: friction, friction: 0.3}
loads: {g: {gravity: {acceleration: [0, -1, 0]}}}
time: {end: 0.1}
output: {interval: 0.1, history_interval: 0.005}
END
run rest_in_space.yaml
below "$(drift)" 0.3 # measured 0.154 (0.062 while the lowest points of a body were its surface at nodes a cell aside, too); 4.5e6
cat >rest_on_foam.yaml <<'END'
floe: 1
units: none
coupling: mpm
domain: {dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [0.7, 0.7], cell: 0.1}
boundaries: {x: symmetry, y: {lower: symmetry, upper: free}}
materials:
  rubber: {density: 1000, law: {linear_elastic: {bulk_modulus: 1e6, shear_modulus: 0.5e6}}}
  foam: {density: 10, law: {linear_elastic: {bulk_modulus: 1e4, shear_modulus: 0.5e4}}}
bodies:
  base: {material: foam, shape: {box: {lower: [0, 0], upper: [0.7, 0.225]}}}
  block: {material: rubber, shape: {box: {lower: [0.22, 0.225], upper: [0.52, 0.425]}}}
contact: {between: [base, block]}
loads: {g: {gravity: {acceleration: [0, -1]}}}
time: {end: 2}
method: {transfer: flip}
output: {interval: 2, history_interval: 0.05}
END
run rest_on_foam.yaml
below "$(drift)" 0.32 # measured 0.163; 102

# A bar drawn by a body that does not deform, by 0.002 of its length in uniaxial strain (exact: 0.002 of 103.33): with splines it is stiff to a cell from there, which is said;
# with GIMP it is right.
cat >drawn.yaml <<'END'
floe: 1
units: none
coupling: mpm
domain: {dim: 1, lower: 0, upper: 1.4, cell: 0.1}
boundaries: {x: {lower: symmetry, upper: free}}
materials: {rubber: {density: 1, law: {linear_elastic: {bulk_modulus: 50, shear_modulus: 40}}}}
bodies:
  bar: {material: rubber, shape: {box: {lower: 0, upper: 1}}}
  grip: {material: rubber, shape: {box: {lower: 1, upper: 1.2}}, motion: {times: [0, 0.5, 0.50001, 9], velocities: [[0.004], [0.004], [0], [0]]}}
damping: {rate: 3}
time: {end: 8}
output: {interval: 8, tracers: {middle: {body: bar, position: 0.5}}}
END
# A support constrains a bar among points of water at nodes 0.7 of a cell behind its surface, which is said, with what that does; not where the region ends just beyond nodes.
cat >wet.yaml <<'END'
floe: 1
units: none
coupling: mpm
domain: {dim: 2, lower: [-0.185, -0.2], upper: [1.215, 0.2], cell: 0.05}
boundaries: {x: symmetry, y: {lower: symmetry, upper: free}}
materials:
  rubber: {density: 1000, law: {linear_elastic: {bulk_modulus: 1e6, shear_modulus: 0.5e6}}}
  water: {eos: {acoustic: {density: 1000, sound_speed: 50, pressure: 0, specific_heat: 1000}}}
bodies:
  beam: {material: rubber, shape: {box: {lower: [-0.15, -0.05], upper: [1, 0.05]}}}
  pool: {material: water, shape: {box: {lower: [-0.185, -0.2], upper: [1.215, -0.05]}}, pressure: 0, temperature: 300}
supports: {wall: {region: {box: {lower: [-9, -9], upper: [0, 9]}}}}
method: {transfer: afmpm}
time: {end: 1}
END
expect 0 "$FLOE" check wet.yaml
has stderr "wet.yaml:12:12: supports.wall: body 'beam' has one velocity with fluids on points and is constrained at the nodes inside the region, up to 0.7 of a cell behind its surface, as at (0, -0.1, 0)"
has stderr "a cantilever of 20 cells by 16 % too much"
expect 0 "$FLOE" check wet.yaml --set 'domain.lower=[-0.201, -0.2]' --set 'domain.upper=[1.199, 0.2]' \
    --set 'bodies.pool.shape.box={lower: [-0.201, -0.2], upper: [1.199, -0.05]}'
if grep -q 'constrained at the nodes' stderr; then fault 'a support whose region ends beyond nodes is warned of'; fi
stress() { awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i ~ /^middle_stress_xx/) at = i } END { print $at / 0.2066667 }' out/history.csv; }
expect 0 "$FLOE" check drawn.yaml
has stderr "drawn.yaml:8:3: bodies.bar: body 'bar' sticks to body 'grip', which does not deform"
run drawn.yaml method.basis=gimp
if grep -q 'sticks to' stderr; then fault 'GIMP is said to be stiff beside a rigid body'; fi
below "$(stress)" 1.002 # measured 0.9999
below 0.998 "$(stress)"
# What sticks by contact is drawn as well, and five times as fast: the gap of a millionth of a cell that the pull opened let it go.
run drawn.yaml method.basis=gimp 'contact={kind: stick}' \
    'bodies.grip.motion={times: [0, 0.1, 0.10001, 9], velocities: [[0.02], [0.02], [0], [0]]}'
below "$(stress)" 1.002 # measured 0.9993; 0.0002
below 0.998 "$(stress)"

# In space a block in contact with a base on which it lies, in gas: it is not thrown up, wherever their surface lies in its cell, in its plane too. Let go under a weight
# of 1 m/s2 a bar fixed at its foot moves with at most g L/c; here L = 0.51 m, c = 31.6 m/s at least. Before, a pocket of gas threw it up with 0.058 m/s, and the plane had a smeared interface.
cat >rest_in_gas.yaml <<'END'
floe: 1
units: none
coupling: ice-mpm
domain: {dim: 3, lower: [0, 0, 0], upper: [0.6, 0.6, 0.6], cell: 0.1}
boundaries: symmetry
materials:
  rubber: {density: 1000, specific_heat: 1000, law: {linear_elastic: {bulk_modulus: 0.67e6, shear_modulus: 0.4e6}}}
  other: {density: 1000, specific_heat: 1000, law: {linear_elastic: {bulk_modulus: 0.67e6, shear_modulus: 0.4e6}}}
  air: {eos: {ideal: {gamma: 1.4, specific_heat: 700}}}
ambient: {material: air, pressure: 1e5, temperature: 300}
reference_pressure: 1e5
bodies:
  base: {material: rubber, shape: {box: {lower: [0, 0, 0], upper: [0.6, 0.6, 0.31]}}}
  block: {material: other, shape: {box: {lower: [0.2, 0.25, 0.31], upper: [0.4, 0.45, 0.51]}}}
contact: {kind: friction}
loads: {g: {gravity: {acceleration: [0, 0, -1]}}}
method: {interface: sharp}
time: {end: 0.004}
output: {interval: 0.004, history_interval: 0.0002}
END
speed() { awk -F, -v of="$1" 'NR == 1 { for (i = 1; i <= NF; ++i) if (index($i, of) == 1) at = i } NR > 1 { v = $at < 0 ? -$at : $at; if (v > most) most = v } END { print most }' out/history.csv; }
run rest_in_gas.yaml
below "$(speed velocity_block_z)" 0.0161
run rest_in_gas.yaml bodies.base.shape.box.upper='[0.6, 0.6, 0.3]' bodies.block.shape.box.lower='[0.2, 0.25, 0.3]' bodies.block.shape.box.upper='[0.4, 0.45, 0.5]'
below "$(speed velocity_block_z)" 0.0161

# Two halves of a plug in a tube, in contact, pushed by 1 bar: the joint leads to no gas and pockets there stay empty. After 1 ms the wave in the plug, which has come back from its free end, leaves
# 0.423 and 0.577 m/s. Before, the run ended at 0.02 ms for a pocket with 1e-20 kg.
cat >plug_of_two.yaml <<'END'
floe: 1
units: none
coupling: ice-mpm
domain: {dim: 3, lower: [0, 0, 0], upper: [1.2, 0.2, 0.2], cell: 0.05}
boundaries: symmetry
materials:
  rubber: {density: 1000, specific_heat: 1000, law: {linear_elastic: {bulk_modulus: 0.667e8, shear_modulus: 0.4e8}}}
  other: {density: 1000, specific_heat: 1000, law: {linear_elastic: {bulk_modulus: 0.667e8, shear_modulus: 0.4e8}}}
  air: {eos: {ideal: {gamma: 1.4, specific_heat: 700}}}
ambient: {material: air, pressure: 1e5, temperature: 300}
reference_pressure: 1e5
bodies:
  left: {material: air, shape: {box: {lower: [0, 0, 0], upper: [0.435, 0.2, 0.2]}}, pressure: 2e5, temperature: 300}
  base: {material: rubber, shape: {box: {lower: [0.435, 0, 0], upper: [0.535, 0.2, 0.2]}}}
  block: {material: other, shape: {box: {lower: [0.535, 0, 0], upper: [0.635, 0.2, 0.2]}}}
contact: {kind: friction}
method: {interface: sharp}
time: {end: 0.001}
output: {interval: 0.001, history_interval: 0.001}
END
run plug_of_two.yaml
below "$(speed velocity_block_x)" 0.609 # measured 0.593
below 0.561 "$(speed velocity_block_x)"
below "$(speed velocity_base_x)" 0.442 # measured 0.404
below 0.385 "$(speed velocity_base_x)"

# Static balance beyond yield: the matrix knows that lines of edges yield (theory 9.1). Half of a cylinder is plastic, K/G = 8; Hill's solution, outer radius
# 4.4839e-4 larger. Before, the eight increments were cut until they ended at 1e-8 by bits of 4e-3.
run "$FLOE_SOURCE/inputs/defaults/e7_cylinder.yaml" time.solver=static damping=null 'time.end=1' time.increments=8 verify=null \
    'materials.rubber.law={j2: {bulk_modulus: 3000, shear_modulus: 375, yield_stress: 1}}' loads.bore.traction.pressure=0.7 \
    'output={interval: 1, tracers: {side: {body: cylinder, position: [0, 1]}}}'
[ "$(json out/summary.json steps)" = 8 ] || fault 'the increments do not converge'
grown=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i ~ /^side_displacement_y/) at = i } END { print $at }' out/history.csv)
below "$grown" 4.63e-4 # measured 4.556e-4
below 4.34e-4 "$grown"

# A block slides down a plane of 30 degrees from rest, on whole cells: at its corner the normal is that of the plane, not one between both (theory 4.12). Exact:
# 4.905 - 8.4957 mu; with common normals it went at 0.62 of that without friction, and stuck with 0.3. And on an oblique plane the ledger does not end the run.
cat >incline.yaml <<'END'
floe: 1
units: none
coupling: mpm
domain: {dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [2.2, 0.9], cell: 0.1}
boundaries: {x: free, y: {lower: symmetry, upper: free}}
materials:
  rubber: {density: 1000, law: {linear_elastic: {bulk_modulus: 1e6, shear_modulus: 0.5e6}}}
bodies:
  base: {material: rubber, shape: {box: {lower: [0, 0], upper: [2.2, 0.3]}}}
  block: {material: rubber, shape: {box: {lower: [0.3, 0.3], upper: [0.9, 0.7]}}}
supports: {hold: {region: {box: {lower: [-1, -1], upper: [4, 0.11]}}}}
contact: {between: [base, block], kind: friction, friction: 0}
loads: {g: {gravity: {acceleration: [4.905, -8.4957]}}}
time: {end: 0.4}
output: {interval: 0.4}
END
way() { # of the block, over the exact one
    awk -F, -v wanted="$1" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i ~ /^centre_block_x/) at = i }
        END { print ($at - 0.6) / (0.08 * wanted) }' out/history.csv
}
run incline.yaml
below 0.996 "$(way 4.905)" # measured 0.9982
below "$(way 4.905)" 1.004
run incline.yaml contact.friction=0.3
below 0.92 "$(way 2.3563)" # measured 1.040
below "$(way 2.3563)" 1.08
slope='turned: -0.5235987756'
run incline.yaml domain.cell=0.05 contact.friction=0.3 'domain.lower=[-0.5, -1.5]' 'domain.upper=[2.2, 0.9]' boundaries=free 'loads.g.gravity.acceleration=[0, -9.81]' time.end=0.22 \
    "bodies.base.shape={moved: {of: {box: {lower: [0, 0], upper: [2.2, 0.3]}}, $slope}}" "bodies.block.shape={moved: {of: {box: {lower: [0.3, 0.3], upper: [0.9, 0.7]}}, $slope}}" \
    "supports.hold.region={moved: {of: {box: {lower: [-1, -1], upper: [4, 0.11]}}, $slope}}"
# Down the plane it goes as on whole cells, whose block is 1.076 of the rigid one's way behind it: the elastic one hops at the start.
turned_way=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) { if ($i ~ /^centre_block_x/) x = i; if ($i ~ /^centre_block_y/) y = i } }
    NR == 2 { from = 0.8660254 * $x - 0.5 * $y } END { print (0.8660254 * $x - 0.5 * $y - from) / (0.0242 * 2.3563) }' out/history.csv)
below 1.05 "$turned_way" # measured 1.063; 0.90 with normals of the colour function
below "$turned_way" 1.08
drift=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i ~ /^largest_drift_energy/) at = i } END { print $at }' out/history.csv)
below "$drift" 0.02 # J, of 22; measured 0.010. With the kinetic energy of light nodes in the ledger 5, and the run was ended

# A bar that gas points press by half a cell (exact: 5 MPa less what the gas loses): with splines the stress of its last points may be anything, which is said; GIMP has it.
cat >pressed_bar.yaml <<'END'
floe: 1
coupling: mpm
reference_pressure: 1 bar
domain: {dim: 1, lower: 0, upper: 2, cell: 0.05}
boundaries: {x: symmetry}
materials:
  rubber: {density: 1000, law: {linear_elastic: {bulk_modulus: 100 MPa, shear_modulus: 60 MPa}}}
  air: {eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}
bodies:
  bar: {material: rubber, shape: {box: {lower: 0, upper: 0.998}}, points: 4}
  gas: {material: air, shape: {box: {lower: 0.998, upper: 2}}, pressure: 51 bar, temperature: 300}
damping: {rate: 200}
time: {end: 0.1}
output: {tracers: {tip: {body: bar, position: 0.9979}, middle: {body: bar, position: 0.5}}}
END
# Stress of the tip, over that of the middle.
tip() { awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) { if ($i ~ /^tip_stress_xx/) a = i; if ($i ~ /^middle_stress_xx/) b = i } } END { print $a / $b }' out/history.csv; }
expect 0 "$FLOE" check pressed_bar.yaml
has stderr "pressed_bar.yaml:10:3: bodies.bar: the fluid's points may move the surface of body 'bar'"
expect 0 "$FLOE" check pressed_bar.yaml --set bodies.gas.pressure='11 bar' # a tenth of a cell
if grep -q 'may move the surface' stderr; then fault 'a tenth of a cell is said to be far'; fi
run pressed_bar.yaml method.basis=gimp
if grep -q 'may move the surface' stderr; then fault 'GIMP is said to be wrong beside gas points'; fi
below 0.97 "$(tip)" # measured 1.015; quadratic splines -0.001
below "$(tip)" 1.03

# What rolls: a disc of five cells' radius down a plane of 0.3 rad from rest, at 2/3 g sin, and a ball of 3.3 cells on a level. Where a point a cell aside of a node was the
# surface there, and a fixed floor constrained nodes above it, the disc had 0.61 of its way, and the ball 0.42 of its speed after 0.4 s (theory 4.12).
cat >rolling_disc.yaml <<'END'
floe: 1
units: none
coupling: mpm
domain: {dim: 2, lower: [-0.6, -0.2], upper: [1.6, 1.2], cell: 0.1}
boundaries: free
materials:
  rubber: {density: 1000, law: {neo_hookean: {bulk_modulus: 1e6, shear_modulus: 4e5}}}
bodies:
  floor: {material: rubber, shape: {box: {lower: [-0.6, -0.2], upper: [1.6, 0]}}, motion: fixed}
  disc: {material: rubber, shape: {ball: {centre: [0, 0.5], radius: 0.5}}}
contact: {between: [floor, disc], kind: friction, friction: 0.5}
loads: {g: {gravity: {acceleration: [2.9552, -9.5534]}}}
time: {end: 0.8}
output: {interval: 0.8}
END
run rolling_disc.yaml
rolled=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i ~ /^centre_disc_x/) at = i } END { print $at / (2.9552 / 3 * 0.64) }' out/history.csv)
below 0.89 "$rolled" # measured 0.940
below "$rolled" 1.02
cat >rolling_ball.yaml <<'END'
floe: 1
units: none
coupling: mpm
domain: {dim: 3, lower: [-0.6, -0.3, 0], upper: [1.05, 1.2, 0.6], cell: 0.15}
boundaries: {x: free, y: free, z: {lower: symmetry, upper: free}}
materials:
  rubber: {density: 1000, law: {neo_hookean: {bulk_modulus: 5e5, shear_modulus: 2e5}}}
bodies:
  floor: {material: rubber, shape: {box: {lower: [-0.6, -0.3, 0], upper: [1.05, 0, 0.6]}}, motion: fixed}
  ball: {material: rubber, shape: {ball: {centre: [0, 0.5, 0], radius: 0.5}}, velocity: ["1 + 2*(y - 0.5)", "-2*x", "0"]}
contact: {between: [floor, ball], kind: friction, friction: 0.5}
loads: {g: {gravity: {acceleration: [0, -10, 0]}}}
time: {end: 0.4}
output: {interval: 0.4}
END
run rolling_ball.yaml
rolled=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i ~ /^velocity_ball_x/) at = i } END { print $at }' out/history.csv)
below 0.97 "$rolled" # measured 0.987, exact 1
below "$rolled" 1.02
