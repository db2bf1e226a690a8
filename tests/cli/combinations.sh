#!/usr/bin/env bash
# Decks of inputs/ with one to three keys set at random, two steps of each: a deck that runs, or a refusal with its place, or a run that
# fails in words; never a crash or a hang. FLOE_COMBINATIONS of them (nightly: 1000); FLOE_SEED makes other choices.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
count=${FLOE_COMBINATIONS:-12}
RANDOM=${FLOE_SEED:-1}
decks=("$FLOE_SOURCE"/inputs/*.yaml)

settings=(
    coupling={mpm,ice,ice-mpm} domain.geometry={cartesian,axisymmetric} domain.dim={1,2,3} domain.cell={-1,1e9} 'domain.blocks='{'[2]','[2, 2]','[2, 2, 2]'}
    domain.stress_state={uniaxial_strain,uniaxial_stress,plane_strain,plane_stress,full}
    contact.kind={release,stick,friction} contact.criterion={pair,mean,both} contact.touch={points,nodes}
    time.solver={static,implicit,auto} time.increments=3 time.cfl=0.9 time.end={0,-1,1e300} time.fixed_step=1e30
    method.stress={usl,usf,musl} method.basis={linear,gimp,quadratic,cubic,cpdi} method.transfer={pic,flip,apic,tpic,xpic,afmpm} method.flip=0.9
    method.filter_order=2 method.point_density={continuity,cell,quadratic} method.losses={drift,heat} method.edge_penalty={0,0.05}
    method.centring={half,full} method.energy={internal,conserving} method.limiter={none,first_order} method.interface={smeared,sharp}
    method.pressure={explicit,implicit,auto} method.volume_relaxation=0.1
    reference_pressure={0,1e5} damping={null,'{rate: 10}'} 'boundaries='{null,'{x: periodic}','{x: periodic, y: periodic, z: periodic}','{x: non_reflecting}'}
    {springs,supports,loads,ambient,exchange,verify,bodies,materials,method,output}'=null' 'exchange={momentum: 1e5}' stop={null,'{window: 1 ms}'}
    threads=2
)

ran=0 refused=0 failed=0
for ((n = 0; n < count; n++)); do
    deck=${decks[RANDOM % ${#decks[@]}]} sets=() got=0
    for ((k = RANDOM % 3; k >= 0; k--)); do sets+=(--set "${settings[RANDOM % ${#settings[@]}]}"); done
    rm -rf out
    timeout -s KILL 300 "$FLOE" run "$deck" --quiet --max-wall=2 --set time.max_steps=2 "${sets[@]}" -o out >stdout 2>stderr || got=$?
    case $got in
        0 | 5) ran=$((ran + 1)) ;;
        2)
            refused=$((refused + 1))
            grep -qE '(\.yaml:[0-9]+:[0-9]+|--set [a-z_.]+=.*): ' stderr || fault "no place: $deck ${sets[*]}"
            ;;
        3 | 4)
            failed=$((failed + 1))
            grep -qE '^floe: error: .{20}' stderr || fault "no words: $deck ${sets[*]}"
            ;;
        *) fault "status $got: $deck ${sets[*]}" ;;
    esac
done
echo "combinations: $count of ${#settings[@]} settings in ${#decks[@]} decks: $ran ran, $refused refused with the place, $failed failed in words" |
    tee "${FLOE_TOTALS:-/dev/null}"
