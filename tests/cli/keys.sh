#!/usr/bin/env bash
# One deck is one scene: every key of the reference is changed, in a scene where it matters, as mpm, ice and ice-mpm. Where the results stay
# the same to the last digit, the run must have been refused or the key warned of. Parameters of models (laws, shapes, exact
# solutions) are the conformance tests' to ask.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

decks=$FLOE_SOURCE/tests/cli/decks

# Keys of the reference, without the parameters of registries.
"$FLOE" new --reference | awk '
    /^## Shapes/ { exit }
    /^## / { map = $0 ~ /^## Top level/ ? "" : substr($0, 4) "."; kind = ""; next }
    /^### / { kind = substr($0, 5) "."; next }
    /^\| `/ { split($0, cell, "`"); name = map ~ /^(materials|bodies|loads|exchange|reactions|springs|supports)\.$/ ? "NAME." : ""
              print map name kind cell[2] }' |
    grep -vE '^bodies\.NAME\.membrane\.(curve|surface)\.|^(domain|materials|ambient|boundaries|bodies|loads|contact|exchange|reactions|springs|supports|damping|time|stop|method|output|verify|compare|study|stability)$|\.(viscosity|artificial_viscosity|membrane|from|to)$' |
    sort -u >keys

# What no result of a single run depends on, what says which run it is, and what changes with everything else.
cat >exempt <<'END'
floe
title
source
units
coupling
runs_as
threads
domain.dim
domain.blocks
output.checkpoint_interval
compare.axis
study.axes
study.over
study.repeat
study.max_wall
study.quantities
study.require
study.check
study.refuse
study.unchanged
stability.over
stability.each
stability.tolerance
stability.growth
stability.relative_to
END

# KEY | settings of the scene, after DECK=... where it is another one | the change
cat >recipes <<'END'
reference_pressure||reference_pressure=2e5
domain.geometry|boundaries=slip|domain.geometry=axisymmetric
domain.stress_state||domain.stress_state=plane_stress
domain.lower||domain.lower=[-0.1,0]
domain.upper||domain.upper=[0.9,0.4]
domain.cell||domain.cell=0.05
domain.lattice_offset|bodies.block.seeding=lattice bodies.other.seeding=lattice bodies.charge.seeding=lattice|domain.lattice_offset=0.25
domain.thickness||domain.thickness=2
materials.NAME.membrane|DECK=keys_membrane|materials.skin.membrane={string: {modulus: 2e6}}
materials.NAME.one_way|DECK=keys_membrane bodies.skin.membrane.slack=0.1|materials.skin.one_way=true
materials.NAME.law|ONLY=mpm,ice-mpm|materials.foam.law={neo_hookean: {bulk_modulus: 5e6, shear_modulus: 1e6}}
materials.NAME.eos||materials.air.eos={ideal: {gamma: 1.3, specific_heat: 717.5}}
materials.NAME.density|ONLY=mpm,ice-mpm|materials.foam.density=400
materials.NAME.specific_heat|method.heat_exchange=1e12 bodies.block.temperature=900|materials.rubber.specific_heat=100
materials.NAME.tension_switch|method.interface=smeared bodies.other.velocity=[300,0]|materials.rubber.tension_switch=2e4 materials.foam.tension_switch=2e4
materials.NAME.conductivity||materials.air.conductivity=10
materials.NAME.viscosity.shear|bodies.charge.velocity=[0,10]|materials.air.viscosity.shear=0.1
materials.NAME.viscosity.bulk||materials.air.viscosity.bulk=1
materials.NAME.artificial_viscosity.linear||materials.foam.artificial_viscosity.linear=1
materials.NAME.artificial_viscosity.quadratic||materials.air.artificial_viscosity.quadratic=2
ambient.material||ambient.material=argon
ambient.pressure||ambient.pressure=1.5e5
ambient.temperature||ambient.temperature=400
ambient.points||ambient.points=3
boundaries.inlet.velocity|boundaries.x.lower={inlet: {velocity: [10,0], pressure: 2e5, temperature: 300, material: air}}|boundaries.x.lower.inlet.velocity=[20,0]
boundaries.inlet.pressure|boundaries.x.lower={inlet: {velocity: [10,0], pressure: 2e5, temperature: 300, material: air}}|boundaries.x.lower.inlet.pressure=3e5
boundaries.inlet.temperature|boundaries.x.lower={inlet: {velocity: [10,0], pressure: 2e5, temperature: 300, material: air}}|boundaries.x.lower.inlet.temperature=350
boundaries.inlet.material|boundaries.x.lower={inlet: {velocity: [10,0], pressure: 2e5, temperature: 300, material: air}}|boundaries.x.lower.inlet.material=argon
boundaries.outlet.pressure|boundaries.x.lower={outlet: {pressure: 1e5, temperature: 300, material: air}}|boundaries.x.lower.outlet.pressure=3e5
boundaries.outlet.temperature|boundaries.x.lower={outlet: {pressure: 3e5, temperature: 300, material: air}}|boundaries.x.lower.outlet.temperature=400
boundaries.outlet.temperature|boundaries.x.lower={outlet: {pressure: 1e5, temperature: 300, material: air}} bodies.charge.velocity=[10,0] bodies.charge.pressure=1e5|boundaries.x.lower.outlet.temperature=400
boundaries.outlet.material|boundaries.x.lower={outlet: {pressure: 3e5, temperature: 300, material: air}}|boundaries.x.lower.outlet.material=argon
boundaries.outlet.material|boundaries.x.lower={outlet: {pressure: 1e5, temperature: 300, material: air}} bodies.charge.velocity=[10,0] bodies.charge.pressure=1e5|boundaries.x.lower.outlet.material=argon
boundaries.velocity.velocity|boundaries.x.lower={velocity: {velocity: [10,0]}}|boundaries.x.lower.velocity.velocity=[20,0]
boundaries.velocity.start|boundaries.x.lower={velocity: {velocity: [10,0]}}|boundaries.x.lower.velocity.start=1e-2
boundaries.velocity.ramp|boundaries.x.lower={velocity: {velocity: [10,0]}}|boundaries.x.lower.velocity.ramp=1e-3
boundaries.velocity.frequency|boundaries.x.lower={velocity: {velocity: [10,0]}}|boundaries.x.lower.velocity.frequency=1000
boundaries.reservoir.pressure|boundaries.x.lower={reservoir: {pressure: 3e5, temperature: 300, material: air}}|boundaries.x.lower.reservoir.pressure=4e5
boundaries.reservoir.temperature|boundaries.x.lower={reservoir: {pressure: 3e5, temperature: 300, material: air}}|boundaries.x.lower.reservoir.temperature=400
boundaries.reservoir.material|boundaries.x.lower={reservoir: {pressure: 3e5, temperature: 300, material: air}}|boundaries.x.lower.reservoir.material=argon
boundaries.non_reflecting.pressure|boundaries.x.lower={non_reflecting: {pressure: 3e5, temperature: 300, material: air}}|boundaries.x.lower.non_reflecting.pressure=4e5
boundaries.non_reflecting.velocity|boundaries.x.lower={non_reflecting: {pressure: 3e5, temperature: 300, material: air}}|boundaries.x.lower.non_reflecting.velocity=[30,0]
boundaries.non_reflecting.temperature|boundaries.x.lower={non_reflecting: {pressure: 3e5, temperature: 300, material: air}}|boundaries.x.lower.non_reflecting.temperature=400
boundaries.non_reflecting.material|boundaries.x.lower={non_reflecting: {pressure: 3e5, temperature: 300, material: air}}|boundaries.x.lower.non_reflecting.material=argon
boundaries.slip.temperature|materials.air.conductivity=10|boundaries.x.lower={slip: {temperature: 500}}
boundaries.slip.temperature||boundaries.x.lower={slip: {temperature: 500}}
boundaries.slip.heat_flux|materials.air.conductivity=10|boundaries.x.lower={slip: {heat_flux: 1e5}}
boundaries.no_slip.velocity|materials.air.viscosity.shear=0.1 boundaries.x.lower=no_slip|boundaries.x.lower={no_slip: {velocity: [0,30]}}
boundaries.no_slip.velocity|bodies.block.shape={box: {lower: [0.3,0.17],upper: [0.43,0.4]}} boundaries.y.upper=no_slip|boundaries.y.upper={no_slip: {velocity: [30,0]}}
boundaries.no_slip.temperature|materials.air.conductivity=10 boundaries.x.lower=no_slip|boundaries.x.lower={no_slip: {temperature: 500}}
boundaries.no_slip.heat_flux|materials.air.conductivity=10 boundaries.x.lower=no_slip|boundaries.x.lower={no_slip: {heat_flux: 1e5}}
bodies.NAME.material||bodies.charge.material=argon
bodies.NAME.shape||bodies.charge.shape={box: {lower: [0,0],upper: [0.1,0.4]}}
bodies.NAME.velocity||bodies.charge.velocity=[0,10]
bodies.NAME.pressure||bodies.charge.pressure=3e5
bodies.NAME.temperature||bodies.charge.temperature=400
bodies.NAME.temperature|method.heat_exchange=1e12|bodies.block.temperature=600
bodies.NAME.density|bodies.charge.temperature=null bodies.charge.density=2|bodies.charge.density=3
bodies.NAME.fraction||bodies.charge.fraction=0.5
bodies.NAME.state|verify.exact={uniform: {velocity: [3,0], pressure: 2e5, density: 1.5}}|bodies.charge.state=exact
bodies.NAME.yields|bodies.extra={material: argon, shape: {box: {lower: [0.1,0.1], upper: [0.28,0.3]}}, pressure: 1e5, temperature: 300}|bodies.charge.yields=true
bodies.NAME.points||bodies.block.points=3
bodies.NAME.points||bodies.charge.points=3
bodies.NAME.seeding||bodies.block.seeding=lattice
bodies.NAME.seeding||bodies.charge.seeding=lattice
bodies.NAME.merge||bodies.block.merge=0.9
bodies.NAME.merge||bodies.charge.merge=0.9
bodies.NAME.membrane.curve|DECK=keys_membrane|bodies.skin.membrane.curve.arc.radius=0.51
bodies.NAME.membrane.surface|DECK=membrane_sphere time.max_steps=1 domain.cell=0.1|bodies.skin.membrane.surface.sphere.radius=0.49
bodies.NAME.membrane.thickness|DECK=keys_membrane|bodies.skin.membrane.thickness=0.2
bodies.NAME.membrane.number|DECK=keys_membrane|bodies.skin.membrane.number=61
bodies.NAME.membrane.length|DECK=spring_mass time.max_steps=3|bodies.spring.membrane.length=0.4
bodies.NAME.membrane.normals|DECK=keys_membrane|bodies.skin.membrane.normals={quadric: {}}
bodies.NAME.membrane.section|DECK=keys_membrane|bodies.skin.membrane.section=volume
bodies.NAME.membrane.strain|DECK=keys_membrane|bodies.skin.membrane.strain=places
bodies.NAME.membrane.smoothing|DECK=keys_membrane bodies.skin.membrane.strain=places|bodies.skin.membrane.smoothing=0.05
bodies.NAME.membrane.slack|DECK=keys_membrane|bodies.skin.membrane.slack=-0.1
bodies.NAME.membrane.slack_from|DECK=keys_membrane bodies.skin.membrane.slack=-0.1|bodies.skin.membrane.slack_from=10
bodies.NAME.membrane.slack_to|DECK=keys_membrane bodies.skin.membrane.slack=-0.1|bodies.skin.membrane.slack_to=10
bodies.NAME.membrane.heavy_point|DECK=keys_membrane bodies.skin.membrane.heavy_point=10 bodies.skin.membrane.heavy_mass=1|bodies.skin.membrane.heavy_point=20
bodies.NAME.membrane.heavy_mass|DECK=keys_membrane bodies.skin.membrane.heavy_point=10 bodies.skin.membrane.heavy_mass=1|bodies.skin.membrane.heavy_mass=2
bodies.NAME.membrane.holds|DECK=membrane_sphere time.max_steps=1 domain.cell=0.1 verify=null|bodies.skin.membrane.holds=null
bodies.NAME.membrane.holds|DECK=keys_membrane bodies.skin.membrane.holds=null|bodies.skin.membrane.holds=gas
loads.NAME.pressurise.material|bodies.extra={material: argon, shape: {box: {lower: [0.6,0.3], upper: [0.8,0.4]}}, pressure: 1e5, temperature: 300} loads={l: {pressurise: {material: air, target: 3e5, ramp: 1e-3}}}|loads.l.pressurise.material=argon
loads.NAME.pressurise.region|loads={l: {pressurise: {material: air, target: 3e5, ramp: 1e-3}}}|loads.l.pressurise.region={box: {lower: [0,0],upper: [0.15,0.4]}}
loads.NAME.pressurise.target|loads={l: {pressurise: {material: air, target: 3e5, ramp: 1e-3}}}|loads.l.pressurise.target=4e5
loads.NAME.pressurise.start|loads={l: {pressurise: {material: air, target: 3e5, ramp: 1e-3}}}|loads.l.pressurise.start=2e-4
loads.NAME.pressurise.ramp|loads={l: {pressurise: {material: air, target: 3e5, ramp: 1e-3}}}|loads.l.pressurise.ramp=2e-3
loads.NAME.pressurise.ramp_steps|loads={l: {pressurise: {material: air, target: 3e5}}}|loads.l.pressurise.ramp_steps=5
loads.NAME.pressurise.hold|loads={l: {pressurise: {material: air, target: 3e5, ramp: 1e-6}}}|loads.l.pressurise.hold=true
loads.NAME.heat.material|bodies.extra={material: argon, shape: {box: {lower: [0.6,0.3], upper: [0.8,0.4]}}, pressure: 1e5, temperature: 300} loads={l: {heat: {material: air, power: 1e9, ramp: 1e-3}}}|loads.l.heat.material=argon
loads.NAME.heat.region|loads={l: {heat: {material: air, power: 1e9, ramp: 1e-3}}}|loads.l.heat.region={ball: {centre: [0.1,0.2], radius: 0.01}}
loads.NAME.heat.power|loads={l: {heat: {material: air, power: 1e9, ramp: 1e-3}}}|loads.l.heat.power=2e9
loads.NAME.heat.start|loads={l: {heat: {material: air, power: 1e9, ramp: 1e-3}}}|loads.l.heat.start=2e-4
loads.NAME.heat.ramp|loads={l: {heat: {material: air, power: 1e9, hold: true}}}|loads.l.heat.ramp=1e-3
loads.NAME.heat.ramp_steps|loads={l: {heat: {material: air, power: 1e9, hold: true}}}|loads.l.heat.ramp_steps=5
loads.NAME.heat.hold|loads={l: {heat: {material: air, power: 1e9, ramp: 1e-6}}}|loads.l.heat.hold=true
loads.NAME.traction.body|loads={l: {traction: {body: block, surface: {box: {lower: [0.3,0], upper: [0.43,0.23]}}, pressure: 2e5}}}|loads.l.traction.body=other loads.l.traction.surface={box: {lower: [0.47,0], upper: [0.6,0.23]}}
loads.NAME.traction.surface|loads={l: {traction: {body: block, surface: {box: {lower: [0.3,0], upper: [0.43,0.23]}}, pressure: 2e5}}}|loads.l.traction.surface={halfspace: {point: [0.3,0], normal: [1,0]}}
loads.NAME.traction.pressure|loads={l: {traction: {body: block, surface: {box: {lower: [0.3,0], upper: [0.43,0.23]}}, pressure: 2e5}}}|loads.l.traction.pressure=4e5
loads.NAME.traction.start|loads={l: {traction: {body: block, surface: {box: {lower: [0.3,0], upper: [0.43,0.23]}}, pressure: 2e5}}}|loads.l.traction.start=2e-4
loads.NAME.traction.ramp|loads={l: {traction: {body: block, surface: {box: {lower: [0.3,0], upper: [0.43,0.23]}}, pressure: 2e5}}}|loads.l.traction.ramp=1e-3
loads.NAME.gravity.acceleration|loads={l: {gravity: {acceleration: [0,-10]}}}|loads.l.gravity.acceleration=[0,-100]
loads.NAME.body_force.body|loads={l: {body_force: {body: block, acceleration: [0,-100]}}}|loads.l.body_force.body=charge
loads.NAME.body_force.acceleration|loads={l: {body_force: {body: charge, acceleration: [0,-100]}}}|loads.l.body_force.acceleration=[0,-200]
contact.between|contact={kind: release}|contact.between=[block,other] bodies.third={material: steel, shape: {box: {lower: [0.6,0], upper: [0.8,0.2]}}} materials.steel={density: 800, law: {neo_hookean: {bulk_modulus: 2e7, shear_modulus: 2e6}}, specific_heat: 400}
contact.kind|contact={kind: release, touch: nodes} bodies.other.velocity=[20,20]|contact.kind=stick
contact.criterion|bodies.third={material: steel, shape: {box: {lower: [0.3,0.25], upper: [0.6,0.4]}}} materials.steel={density: 800, law: {neo_hookean: {bulk_modulus: 2e7, shear_modulus: 2e6}}, specific_heat: 400} contact={kind: release, touch: nodes} bodies.other.velocity=[20,20]|contact.criterion=mean
contact.touch|contact={kind: release} ONLY=mpm,ice|contact.touch=nodes
contact.touch|contact={kind: release} bodies.other.velocity=[20,20] ONLY=ice-mpm|contact.touch=nodes
contact.friction|contact={kind: friction, touch: nodes} bodies.other.velocity=[-20,20] time.max_steps=12|contact.friction=0.5
contact.normals|contact={kind: friction, touch: nodes} bodies.other.velocity=[-20,20] bodies.other.shape={ball: {centre: [0.52,0.1], radius: 0.08}}|contact.normals=mass
exchange.NAME.between|exchange={e: {between: [air,rubber], momentum: free}} ONLY=mpm,ice-mpm|exchange.e.between=[air,foam]
exchange.NAME.momentum|bodies.charge.material=argon exchange={e: {between: [air,argon], momentum: free}}|exchange.e.momentum=locked
exchange.NAME.tangential|bodies.charge.material=argon exchange={e: {between: [air,argon], momentum: locked}} bodies.charge.velocity=[0,10]|exchange.e.tangential=free
exchange.NAME.heat|exchange={e: {between: [air,rubber], momentum: locked}} bodies.block.temperature=900|exchange.e.heat={constant: {coefficient: 1e8}}
reactions.NAME.reactant|reactions={r: {reactant: air, product: argon, rate: {arrhenius: {frequency: 1000, activation: 10}}}} bodies.extra={material: argon, shape: {box: {lower: [0.6,0.3], upper: [0.8,0.4]}}, pressure: 1e5, temperature: 300}|reactions.r.reactant=argon reactions.r.product=air
reactions.NAME.product|reactions={r: {reactant: air, product: argon, rate: {arrhenius: {frequency: 1000, activation: 10}}}} materials.neon={eos: {ideal: {gamma: 1.667, specific_heat: 618}}}|reactions.r.product=neon
reactions.NAME.rate|reactions={r: {reactant: air, product: argon, rate: {arrhenius: {frequency: 1000, activation: 10}}}}|reactions.r.rate={arrhenius: {frequency: 2000, activation: 10}}
reactions.NAME.heat|reactions={r: {reactant: air, product: argon, rate: {arrhenius: {frequency: 1000, activation: 10}}}}|reactions.r.heat=1e6
springs.NAME.stiffness|springs={s: {from: {place: [0.1,0.1]}, to: {body: other, point: 1}, stiffness: 1e7}}|springs.s.stiffness=2e7
springs.NAME.rest_length|springs={s: {from: {place: [0.1,0.1]}, to: {body: other, point: 1}, stiffness: 1e7}}|springs.s.rest_length=0.1
springs.NAME.one_way|springs={s: {from: {place: [0.1,0.1]}, to: {body: other, point: 1}, stiffness: 1e7}}|springs.s.one_way=true
springs.NAME.from.body|springs={s: {from: {body: block, point: 1}, to: {body: other, point: 1}, stiffness: 1e7}}|springs.s.from.body=charge
springs.NAME.from.point|springs={s: {from: {body: block, point: 1}, to: {body: other, point: 1}, stiffness: 1e7}}|springs.s.from.point=2
springs.NAME.from.place|springs={s: {from: {place: [0.1,0.1]}, to: {body: other, point: 1}, stiffness: 1e7}}|springs.s.from.place=[0.1,0.3]
springs.NAME.to.body|springs={s: {from: {body: block, point: 1}, to: {body: other, point: 1}, stiffness: 1e7}}|springs.s.to.body=charge
springs.NAME.to.point|springs={s: {from: {body: block, point: 1}, to: {body: other, point: 1}, stiffness: 1e7}}|springs.s.to.point=2
springs.NAME.to.place|springs={s: {from: {body: other, point: 1}, to: {place: [0.1,0.1]}, stiffness: 1e7}}|springs.s.to.place=[0.1,0.3]
supports.NAME.region|supports={s: {region: {box: {lower: [0.29,-0.1], upper: [0.41,0.21]}}}}|supports.s.region={box: {lower: [0.49,-0.1], upper: [0.61,0.21]}}
supports.NAME.velocity|supports={s: {region: {box: {lower: [0.29,-0.1], upper: [0.41,0.21]}}}}|supports.s.velocity=[1,0]
damping.rate||damping.rate=100
damping.start|damping.rate=100|damping.start=2e-4
damping.end|damping.rate=100|damping.end=2e-4
time.solver|bodies.charge=null ambient=null bodies.other.velocity=[0,0] loads={g: {gravity: {acceleration: [0,-10]}}} time.fixed_step=1e-5|time.solver=implicit
time.increments|bodies.charge=null ambient=null bodies.other.velocity=[0,0] loads={g: {gravity: {acceleration: [0,-10]}}} time.solver=implicit time.max_steps=0 time.end=1e-4 time.increments=2|time.increments=4
time.tolerance|bodies.charge=null ambient=null bodies.other.velocity=[0,0] loads={g: {gravity: {acceleration: [0,-10000]}}} time.solver=implicit time.fixed_step=2e-3|time.tolerance=1e-2
time.end|time.max_steps=0 time.end=1e-4|time.end=2e-4
time.cfl||time.cfl={mpm: 0.2}
time.cfl||time.cfl={ice: 0.2}
time.acoustic_cfl|method.pressure=implicit|time.acoustic_cfl=0.2
time.first_step||time.first_step=1e-6
time.max_step||time.max_step=1e-6
time.growth|time.first_step=1e-6|time.growth=2
time.max_steps||time.max_steps=7
time.fixed_step||time.fixed_step=1e-6
time.substeps|method.interface=sharp bodies.charge=null|time.substeps=2
stop.kinetic_over_strain|DECK=keys_rest ONLY=mpm|stop.kinetic_over_strain=1e-2
stop.kinetic_over_strain|DECK=keys_rest ONLY=ice-mpm materials.air={eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}} ambient={material: air, pressure: 1e5, temperature: 300}|stop.kinetic_over_strain=1e-2
stop.window|DECK=keys_rest ONLY=mpm|stop.window=1e-3
stop.window|DECK=keys_rest ONLY=ice-mpm materials.air={eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}} ambient={material: air, pressure: 1e5, temperature: 300}|stop.window=1e-3
stop.after|DECK=keys_rest ONLY=mpm|stop.after=5e-3
stop.after|DECK=keys_rest ONLY=ice-mpm materials.air={eos: {ideal: {gamma: 1.4, specific_heat: 717.5}}} ambient={material: air, pressure: 1e5, temperature: 300}|stop.after=5e-3
method.basis||method.basis=gimp
method.domain_limit|method.basis=cpdi bodies.other.velocity=[-300,0]|method.domain_limit=0.25
method.preset||method.preset=g03
method.stress||method.stress=musl
method.transfer||method.transfer=pic
method.flip|method.transfer=flip|method.flip=0.5
method.filter_order|method.transfer=xpic|method.filter_order=5
method.point_density||method.point_density=cell
method.losses|method.transfer=flip method.flip=0.9|method.losses=heat
method.edge_penalty||method.edge_penalty=0.2
method.centring||method.centring=full
method.energy||method.energy=internal
method.limiter||method.limiter=first_order
method.exchange|bodies.charge.material=argon bodies.charge.velocity=[10,0]|method.exchange=1e7
method.heat_exchange|bodies.block.temperature=900|method.heat_exchange=1e8
method.volume_relaxation|bodies.charge.material=argon|method.volume_relaxation=0.5
method.interface|method.interface=smeared bodies.charge=null|method.interface=sharp
method.pressure||method.pressure=implicit
method.pressure_tolerance|method.pressure=implicit|method.pressure_tolerance=1e-2
output.interval|time.end=1e-3 time.max_steps=0|output.interval=5e-4
output.history_interval|output.interval=1|output.history_interval=1e-5
output.probes||output.probes.front=[0.1,0.3]
verify.sources|DECK=flow_mms time.max_steps=3|verify.sources=false
verify.exact|verify={exact: {uniform: {pressure: 1e5, density: 1}}, metrics: [l1_pressure], body: charge}|verify.exact={uniform: {pressure: 2e5, density: 1}}
verify.reference|DECK=spring_mass time.max_steps=3|verify.reference.hanging_mass.mass=2
verify.history|DECK=spring_mass time.max_steps=3|verify.history={position: last_spring_x}
verify.metrics|verify={exact: {uniform: {pressure: 1e5, density: 1}}, metrics: [l1_pressure], body: charge}|verify.metrics=[l2_pressure]
verify.body|verify={exact: {uniform: {pressure: 1e5, density: 1}}, metrics: [l1_pressure], body: charge}|verify.body=null verify.material=argon
verify.material|verify={exact: {uniform: {pressure: 1e5, density: 1}}, metrics: [l1_pressure], material: air}|verify.material=argon
verify.region|verify={exact: {uniform: {pressure: 1e5, density: 1}}, metrics: [l1_pressure], body: charge}|verify.region={box: {lower: [0,0],upper: [0.1,0.4]}}
verify.pressure|loads={l: {pressurise: {material: air, target: 3e5, ramp: 1e-3}}} verify.pressure=1e5|verify.pressure=2e5
END

# settings TEXT: one a line; blanks inside brackets belong to a value.
settings() {
    awk '{ depth = 0; out = ""
           for (i = 1; i <= length($0); i++) {
               c = substr($0, i, 1)
               if (c ~ /[[{]/) depth++
               if (c ~ /[]}]/) depth--
               if (c == " " && depth == 0) { print out; out = "" } else out = out c
           }
           if (out != "") print out }' <<<"$1"
}

# run_with FOLDER COUPLING SCENE CHANGE: status in FOLDER.rc, what it says in FOLDER.said, its results in FOLDER.results.
run_with() {
    local folder=$1 coupling=$2 deck=$decks/keys.yaml line rc=0
    local -a set=(--set "coupling=$coupling" --set "runs_as=[$coupling]" --set study=null --set compare=null --set stability=null)
    case $3 in
    DECK=keys_*) deck=${3%% *} deck=$decks/${deck#DECK=}.yaml ;;
    DECK=*) deck=${3%% *} deck=$FLOE_SOURCE/inputs/${deck#DECK=}.yaml ;;
    *) [ "$coupling" = ice ] && set+=(--set bodies.block=null --set bodies.other=null) ;;
    esac
    while IFS= read -r line; do
        case $line in '' | DECK=* | ONLY=*) ;; *) set+=(--set "$line") ;; esac
    done < <(settings "$3"; settings "$4")
    "$FLOE" run "$deck" -o "$folder" "${set[@]}" >"$folder.said" 2>&1 || rc=$?
    echo "$rc" >"$folder.rc"
    : >"$folder.results"
    [ "$rc" -ne 0 ] || { cat "$folder/history.csv" "$folder"/profile.csv 2>/dev/null || true
        ls "$folder/fields"
        sed -n '/"errors"/,/}/p' "$folder/summary.json"
        grep -E '"(steps|points|time)":' "$folder/summary.json"; } >"$folder.results"
    rm -rf "$folder"
}

failed=0
missed() {
    echo "$*" >&2
    failed=1
}

# Every key of the reference has a recipe, or stands among the exempt.
cut -d'|' -f1 recipes | sort -u >told
comm -23 keys <(sort -u told exempt) >untold
[ ! -s untold ] || missed "keys without a recipe in $0: $(tr '\n' ' ' <untold)"

declare -A base
number=0
while IFS='|' read -r key scene change; do
    for coupling in mpm ice ice-mpm; do
        case $scene in *ONLY=*) only=${scene##*ONLY=} only=,${only%% *},; [[ $only == *,$coupling,* ]] || continue ;; esac
        place="$coupling $scene"
        if [ -z "${base[$place]:-}" ]; then
            base[$place]=base$((number += 1))
            run_with "${base[$place]}" "$coupling" "$scene" ''
        fi
        before=${base[$place]}
        # The scene itself is refused: the key cannot matter. It must not crash, nor diverge.
        case $(cat "$before.rc") in 0 | 2) ;; *) missed "$key as $coupling: the scene ends with status $(cat "$before.rc"): $(head -c 300 "$before.said")" ;; esac
        [ "$(cat "$before.rc")" -eq 0 ] || { echo "$key $coupling refused-scene: $(grep -m1 'error' "$before.said" | cut -c1-150)" >>verdicts; continue; }
        run_with changed "$coupling" "$scene" "$change"
        if [ "$(cat changed.rc)" -eq 2 ]; then
            echo "$key $coupling refused: $(grep -m1 'error' changed.said | cut -c1-150)" >>verdicts
        elif [ "$(cat changed.rc)" -ne 0 ]; then
            missed "$key as $coupling: exit status $(cat changed.rc): $(head -c 300 changed.said)"
        elif ! cmp -s "$before.results" changed.results; then
            echo "$key $coupling heeded" >>verdicts
        elif grep 'warning' changed.said | grep -qE "${change%%=*}|${change%.*}" ; then
            echo "$key $coupling warned" >>verdicts
        else
            missed "$key as $coupling: nothing changes with '$change', and nothing is said"
        fi
    done
    # Somewhere it must matter.
done <recipes
cut -d' ' -f1,3 verdicts | grep -E ' heeded$' | cut -d' ' -f1 | sort -u >heeded
comm -23 <(cut -d'|' -f1 recipes | sort -u) heeded >nowhere
[ ! -s nowhere ] || missed "keys that matter in no coupling: $(tr '\n' ' ' <nowhere)"
if [ -n "${FLOE_VERDICTS:-}" ]; then cp verdicts "$FLOE_VERDICTS"; fi
[ "$failed" -eq 0 ] || { echo "FAILED" >&2; exit 1; }
