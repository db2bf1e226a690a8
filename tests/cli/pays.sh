#!/usr/bin/env bash
# A scene pays only for what it uses: fields, stages, bytes and pressure solves of four scenes, planned and run.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

cat >head.yaml <<'END'
floe: 1
domain: {dim: 2, lower: [0, 0], upper: [1, 1], cell: 0.125}
time: {end: 1e-3, max_steps: 3}
boundaries: {x: slip, y: slip}
END
gas='{eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}}'
heavy='{eos: {ideal: {gamma: 1.67, specific_heat: 312}}}'
rubber='{density: 1000, specific_heat: 1800, tension_switch: 1e5,
            law: {neo_hookean: {bulk_modulus: 20 MPa, shear_modulus: 2 MPa}}}'
all='{box: {lower: [0, 0], upper: [1, 1]}}'
left='{box: {lower: [0, 0], upper: [0.5, 1]}}'
right='{box: {lower: [0.5, 0], upper: [1, 1]}}'
state='pressure: 1e5, temperature: 300'

# deck NAME COUPLING MATERIALS BODIES
deck() {
    { cat head.yaml && printf 'coupling: %s\n%s\n%s\n' "$2" "$3" "$4"; } >"$1.yaml"
    expect 0 "$FLOE" plan "$1.yaml" --json
    mv stdout "$1.json"
    expect 0 "$FLOE" run "$1.yaml" -o "$1" --quiet
}
# fields and stages of a plan
fields() { sed -nE 's/.*"id": "([^"]*)".*/\1/p' "$1.json" | sort | tr '\n' ' '; }
stages() { sed -nE '/"fields"/,$d; s/.*"name": "([^"]*)".*/\1/p' "$1.json"; }
lacks() {
    local name=$1 field
    shift
    for field in "$@"; do
        [[ " $(fields "$name")" != *" $field "* ]] || fault "$name holds $field"
    done
}
holds() {
    local name=$1 field
    shift
    for field in "$@"; do
        [[ " $(fields "$name")" == *" $field "* ]] || fault "$name does not hold $field"
    done
}
# The stages that were timed are those of the plan, and the bytes are those of the plan.
same_as_planned() {
    local stage
    for stage in $(stages "$1"); do has "$1/summary.json" "\"$stage\":"; done
    [ "$(json "$1.json" ice)" = "$(json "$1/summary.json" ice)" ] || fault "$1: other bytes of cells than planned"
}

deck solid mpm "materials: {rubber: $rubber}
method: {edge_penalty: 0}" "bodies: {block: {material: rubber, shape: $left}}"
holds solid P_STRESS N_MOMENTUM
lacks solid C_RHO C_PRESSURE F_VEL P_ENERGY N_PRESSURE P_GRID_PRESSURE P_TANGENT P_NORMAL P_STRAIN P_SURFACE_1
if stages solid | grep -q membranes; then fault 'a solid turns membranes'; fi
[ "$(json solid.json ice)" = 0 ] || fault 'a solid pays for cells'
[ "$(json solid/summary.json cells)" = 0 ] || fault 'a solid has cells'
same_as_planned solid
lacks solid N_COLOUR N_NORMAL N_REACH N_TOUCH
if stages solid | grep -q contact; then fault 'a solid alone has a contact'; fi
lacks solid N_FILL
if stages solid | grep -q edge; then fault 'a solid pays for edges that are not held'; fi

deck held mpm "materials: {rubber: $rubber}" "bodies: {block: {material: rubber, shape: $left}}"
holds held N_FILL
same_as_planned held

deck touching mpm "materials: {rubber: $rubber}
contact: {kind: friction, friction: 0.2}" \
    "bodies: {left: {material: rubber, shape: $left, velocity: [1, 1]}, right: {material: rubber, shape: $right}}"
holds touching N_COLOUR N_NORMAL N_REACH N_TOUCH
[ "$(stages touching | grep -c contact)" = 3 ] || fault 'a contact has other stages than normals, reach and velocities'
below 0 "$(json touching/summary.json contact_slip)"
same_as_planned touching

deck one ice "materials: {gas: $gas}" "bodies: {all: {material: gas, shape: $all, $state}}"
holds one C_RHO C_VEL C_ENERGY C_PRESSURE
lacks one P_POS N_MASS C_THETA C_VOL C_MIXED C_SOURCE C_VELOCITY_CHANGE C_INTERFACE
[ "$(json one.json mpm)" = 0 ] || fault 'a gas pays for points'
[ "$(json one/summary.json newton_cells)" = 0 ] || fault 'one gas has solved for a pressure'
if stages one | grep -q exchange; then fault 'one gas exchanges with itself'; fi
if stages one | grep -q implicit; then fault 'a gas pays for an implicit pressure'; fi
lacks one F_MOBILITY C_PRESSURE_STEP
[ "$(json one/summary.json pressure_solves)" = 0 ] || fault 'a gas has solved for its pressure'
same_as_planned one

deck implicit ice "materials: {gas: $gas}
method: {pressure: implicit}" "bodies: {all: {material: gas, shape: $all, $state}}"
holds implicit F_MOBILITY C_PRESSURE_STEP
lacks implicit P_POS N_MASS C_THETA C_VOL C_MIXED C_SOURCE C_VELOCITY_CHANGE
if stages implicit | grep -q ice_pressure_increment; then fault 'an implicit pressure is also explicit'; fi
[ "$(json implicit/summary.json pressure_solves)" = 3 ] || fault 'no implicit pressure was solved for'
same_as_planned implicit

deck two ice "materials: {gas: $gas, heavy: $heavy}" \
    "bodies: {a: {material: gas, shape: $left, $state}, b: {material: heavy, shape: $right, $state}}"
holds two C_RHO C_VOL C_THETA C_INTERFACE
lacks two P_POS N_MASS C_VELOCITY_CHANGE
[ "$(json two.json mpm)" = 0 ] || fault 'two gases pay for points'
stages two | grep -q exchange || fault 'two gases do not exchange'
same_as_planned two

deck both ice-mpm "materials: {rubber: $rubber, gas: $gas}
ambient: {material: gas, $state}
reference_pressure: 1e5
method: {interface: smeared}" "bodies: {block: {material: rubber, shape: $left}}"
holds both P_STRESS N_MASS C_RHO C_VOL C_VELOCITY_CHANGE P_GRID_PRESSURE
lacks both C_INTERFACE C_ENERGY_FOUND
below 0 "$(json both.json mpm)"
below 0 "$(json both.json ice)"
same_as_planned both

deck cut ice-mpm "materials: {rubber: $rubber, gas: $gas}
ambient: {material: gas, $state}
reference_pressure: 1e5" "bodies: {block: {material: rubber, shape: $left}}"
holds cut P_STRESS N_MASS C_RHO C_OPEN
lacks cut C_VOL C_THETA C_MIXED C_VELOCITY_CHANGE P_GRID_PRESSURE
if stages cut | grep -q exchange; then fault 'a gas beside a sharp interface exchanges'; fi
same_as_planned cut
