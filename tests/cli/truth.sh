#!/usr/bin/env bash
# What a run says of its own truth: drifts against what there was and came in, unstable runs that end with their cause,
# rest that waits for the load, and counts on the last line.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

cat >disc.yaml <<'END'
floe: 1
units: none
coupling: mpm
domain: {dim: 2, lower: [0, 0], upper: [1, 1], cell: 0.05}
boundaries: free
materials:
  rubber: {density: 1, law: {neo_hookean: {bulk_modulus: 1, shear_modulus: 0.5}}}
bodies:
  disc: {material: rubber, shape: {ball: {centre: [0.5, 0.5], radius: 0.2}}, velocity: [0.1, 0]}
method: {basis: gimp, transfer: flip, stress: usl, flip: 1}
time: {end: 3, fixed_step: 0.02}
output: {interval: 3}
END

# A disc that flies freely keeps all.
expect 0 "$FLOE" run disc.yaml -o free
below "$(json free/summary.json energy)" 1e-12
below "$(json free/summary.json momentum)" 1e-12
[ -z "$(json free/summary.json notes)" ] || fault 'notes without a cause'
if grep -q note: stdout; then fault 'a note of a run that keeps all'; fi
has free/history.csv 'largest_drift_energy (1)'

# Steps beyond the limit: energy comes from nothing, and the run ends with what, where and what to do.
expect 3 "$FLOE" run disc.yaml -o wild --set time.fixed_step=0.05
has stderr 'rejected'
has stderr 'before, energy grows without a source'
has stderr 'take a smaller time.fixed_step than 0.05'
# Waves of small amplitude grow without any step that is rejected.
cat >bar.yaml <<'END'
floe: 1
units: none
coupling: mpm
domain: {dim: 1, lower: [0], upper: [1], cell: 0.05}
boundaries: no_slip
materials:
  rubber: {density: 1, law: {linear_elastic: {bulk_modulus: 1, shear_modulus: 0.5}}}
bodies:
  bar: {material: rubber, shape: {box: {lower: [0], upper: [1]}}, velocity: [1e-3]}
method: {basis: gimp, transfer: flip, stress: usl, flip: 1}
time: {end: 50, fixed_step: 0.04}
output: {interval: 50}
END
expect 3 "$FLOE" run bar.yaml -o slow
has stderr 'error: energy grows without a source'
has stderr "body 'bar' moves fastest"
has stderr 'take a smaller time.fixed_step than 0.04'
has stderr 'the state as it is now is in checkpoint.h5'
[ "$(json slow/summary.json rejected_steps)" = 0 ] || fault 'steps were rejected'
[ "$(json wild/summary.json status)" = diverged ] || fault 'not diverged'
has wild/summary.json 'from nothing'
has wild/run.log 'diverged at t'

# At rest nothing drifts, whatever round-off does.
expect 0 "$FLOE" run disc.yaml -o still --set bodies.disc.velocity='[0, 0]'
[ -z "$(json still/summary.json notes)" ] || fault 'a body at rest drifts'

# PIC takes the energy of a thrown block that turns: more than a tenth is warned of, on the last line and when quiet.
cat >spin.yaml <<'END'
floe: 1
units: none
coupling: mpm
domain: {dim: 2, lower: [0, 0], upper: [1, 1], cell: 0.05}
boundaries: {x: free, y: no_slip}
materials:
  rubber: {density: 1, law: {neo_hookean: {bulk_modulus: 1, shear_modulus: 0.5}}}
bodies:
  block: {material: rubber, shape: {box: {lower: [0.2, 0.55], upper: [0.4, 0.95]}}, velocity: [0, 0.2]}
method: {transfer: flip, flip: 0}
time: {end: 1}
output: {interval: 1}
study: {axes: {method.flip: [0, 1]}}
END
expect 0 "$FLOE" run spin.yaml -o lossy
has stderr 'what was there at the start and came in is lost by'
[ "$(tail -n 1 stdout | cut -c 1-14)" = 'note: WARNING:' ] || fault "the last line does not say so: $(tail -n 1 stdout)"
[ "$(tail -n 1 lossy/run.log | grep -c 'WARNING:.*of the energy lost')" = 1 ] || fault 'the log does not say so'
has lossy/summary.json '"energy: '
expect 0 "$FLOE" run spin.yaml -o quiet -q
[ ! -s stdout ] || fault 'a quiet run speaks on standard output'
has stderr 'of the energy lost'
expect 0 "$FLOE" study spin.yaml -o study
has stdout '  warned'
has stdout 'warned, method.flip=0: energy'
has study/study.csv ',warnings,'

# The largest drift is kept over an interruption.
expect 5 "$FLOE" run spin.yaml -o resumed --max-wall 1e-9
expect 0 "$FLOE" run spin.yaml -o resumed --resume -q
[ "$(sed -n '/"conservation"/,/notes/p' lossy/summary.json)" = "$(sed -n '/"conservation"/,/notes/p' resumed/summary.json)" ] ||
    fault 'a resumed run has other drifts'

# Points that leave are counted on the last line.
expect 0 "$FLOE" run disc.yaml -o gone --set bodies.disc.velocity='[0.5, 0]'
[ "$(tail -n 1 stdout | grep -c 'points lost')" = 1 ] || fault "no lost points on the last line: $(tail -n 1 stdout)"

# Rest with its defaults waits for the load, its ramp and the waves in the ring.
cat >ring.yaml <<'END'
floe: 1
coupling: mpm
domain: {dim: 2, lower: [0, 0], upper: [1.2, 1.2], cell: 0.1}
boundaries: {x: {lower: symmetry, upper: free}, y: {lower: symmetry, upper: free}}
materials:
  steel: {density: 8900, law: {linear_elastic: {bulk_modulus: 117 GPa, shear_modulus: 43.8 GPa}}}
bodies:
  ring: {material: steel, shape: {annulus: {centre: [0, 0], inner_radius: 0.5, outer_radius: 1.0}}}
loads:
  bore:
    traction: {body: ring, surface: {ball: {centre: [0, 0], radius: 0.5}}, pressure: 19.4 MPa, start: 0.2 ms, ramp: 1 ms}
damping: {rate: 1.2e4 1/s}
time: {end: 10 ms}
stop: {}
END
expect 0 "$FLOE" run ring.yaml -o ring
[ "$(json ring/summary.json status)" = at_rest ] || fault 'the ring does not come to rest'
# Half of what the pressure does on the bore of Lame's ring, p u(r_i) r_i pi/2, is 1218 J; 1224 J on this mesh.
below "$(json ring/summary.json time)" 6e-3
below 0.0022 "$(json ring/summary.json time)" # start, ramp and five crossings of a metre at 4439 m/s
strain=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "strain (J)") c = i } END { print $c }' ring/history.csv)
below 1206 "$strain"
below "$strain" 1230

# A fixed step beyond what is stable is warned of by the run itself, and its summary keeps it: what comes out has no meaning, though it ends as done.
expect 0 "$FLOE" run "$FLOE_SOURCE/tests/mistakes/gas.yaml" --set time.fixed_step=5e-5 --set time.max_steps=3 -o fixed --quiet
has fixed/run.log 'times the largest step that is stable at the start'
has fixed/summary.json 'times the largest step that is stable at the start'
