#!/usr/bin/env bash
# A gas that burns within some cells behind its shock runs at Chapman and Jouguet's speed. (Before, runs ended where burning made the first product of a
# cell: the gradients of its mass had the limits of the masses before, and a neighbour without any gave some of it.)
# shellcheck source=tests/cli/lib.bash
source "$(dirname "$0")/lib.bash"

cat >detonation.yaml <<'END'
floe: 1
coupling: ice
domain: {dim: 1, lower: 0, upper: 0.19, cell: 5e-4}
boundaries: {x: slip}
materials:
  fresh: {eos: {ideal: {gamma: 1.3, specific_heat: 800}}}
  burnt: {eos: {ideal: {gamma: 1.3, specific_heat: 800}}}
bodies:
  hot: {material: burnt, shape: {box: {lower: 0, upper: 0.1}}, pressure: 2.52 MPa, density: 2}
  gas: {material: fresh, shape: {box: {lower: 0.1, upper: 0.19}}, pressure: 1e5, density: 1.3}
reactions:
  burns: {reactant: fresh, product: burnt, heat: 2.5 MJ/kg, rate: {threshold: {temperature: 800, time: 2e-6}}}
time: {end: 4.8e-5}
output: {interval: 4.8e-5, history_interval: 5e-8, probes: {first: 0.14025, second: 0.18025}}
END
expect 0 "$FLOE" run detonation.yaml -o detonation --quiet
below "$(json detonation/summary.json mass)" 1e-13
below "$(json detonation/summary.json energy)" 1e-13
# D = c (sqrt(H + 1) + sqrt(H)), H = (g^2 - 1) q/(2 g p/rho): 1909.8 m/s. Measured: 1884, as it starts.
speed=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) { if ($i ~ /^first_pressure/) a = i; if ($i ~ /^second_pressure/) b = i } next }
    !t && $a > 6e5 { t = $1 } !u && $b > 6e5 { u = $1 } END { print 0.04 / (u - t) }' detonation/history.csv)
awk -v d="$speed" 'BEGIN { x = d / 1909.8 - 1; exit !(x * x < 0.025 * 0.025) }' || fault "the detonation runs at $speed m/s"
