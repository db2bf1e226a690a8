#!/usr/bin/env bash
# floe study with checks: a case is right, refused or wrong, and wrong ones and unexpected refusals give exit status 6.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

tube="$FLOE_SOURCE/inputs/sod.yaml"
study=("$FLOE" study "$tube" --set runs_as=null --axis domain.cell=0.05,0.025 --set time.end=0.02 --set output=null)
loose='study={check: [{of: drift_energy, most: 1e-12}, {of: l1_density, most: 1}, {of: mass, least: 0.5, most: 0.6}]}'

expect 0 "${study[@]}" --set "$loose" -o right
has stdout '2 cases: 2 right, 0 refused, 0 wrong'
has right/study.json '"right": 2'
head -n 1 right/study.csv | grep -q ',verdict,why$' || fault 'study.csv has no verdicts'

# A bound on one case alone, on a column that is not there, and cases that nothing is asked of.
expect 6 "${study[@]}" -o wrong --set 'study={check: [{of: drift_energy, most: 1}, {of: l1_density, most: 1e-9, where: {domain.cell: 0.025}}]}'
has stdout '2 cases: 1 right, 0 refused, 1 wrong'
has stderr 'wrong, domain.cell=0.025: l1_density: '
expect 6 "${study[@]}" -o absent --set 'study={check: [{of: no_such_column, most: 1}]}'
has stderr 'no_such_column: not measured'
expect 6 "${study[@]}" -o unasked --set 'study={check: [{of: drift_energy, most: 1, where: {domain.cell: 0.05}}]}'
has stderr 'wrong, domain.cell=0.025: no check is asked of it'

# A run that diverges is refused; it may be where the deck says why.
diverges=(--set time.fixed_step=0.02 --set time.cfl=1 --set 'boundaries={x: {lower: {velocity: {velocity: [1e7]}}, upper: slip}}')
[ -s right/study.json ] || fault 'no study.json'
expect 6 "${study[@]}" -o refused "${diverges[@]}" --set "$loose"
has stdout '2 cases: 0 right, 2 refused, 0 wrong'
has stderr 'refused, domain.cell=0.05: '
reason='study={check: [{of: drift_energy, most: 1}], refuse: [{why: the step is far beyond the limit}]}'
expect 0 "${study[@]}" -o allowed "${diverges[@]}" --set "$reason"
has stdout 'refused, domain.cell=0.025: the step is far beyond the limit'

# Checks that are none are refused with their place.
expect 2 "${study[@]}" -o none --set 'study={check: [{of: l1_density}]}'
has stderr 'asks for nothing'
expect 2 "${study[@]}" -o none --set 'study={check: [{of: l1_density, most: 1, where: {domain.cell: 0.3}}]}'
has stderr 'is no value of that axis'
expect 2 "${study[@]}" -o none --set 'study={refuse: [{where: {domain.cell: 0.05}}]}'
has stderr 'why'

# Spoiled results: a balance notices none, a bound on the mean notices those that it can, an error all of them.
wave=("$FLOE" study "$FLOE_SOURCE/inputs/extreme/courant_points.yaml" --axis bodies.bar.points=[2] --axis "title=linear usl" --spoil)
expect 6 "${wave[@]}" -o balance --set 'study={axes: {title: [linear usl]}, check: [{of: drift_mass, most: 1e-12}]}'
has stderr 'blind, linear usl, [2]: frozen initial doubled halved mirrored'
has balance/study.json '"judged_by": "blind"'
expect 0 "${wave[@]}" -o balance --set 'study={axes: {title: [linear usl]}, check: [{of: drift_mass, most: 1e-12}], unchanged: [{by: frozen initial doubled halved mirrored, why: mass stays}]}'
