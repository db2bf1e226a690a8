#!/usr/bin/env bash
# One gas against exact solutions, held to the errors of another code at the same cells: Athena++ (2026, HLLC, PPM with third-order Runge and Kutta's, CFL 0.4), L1 of
# density, velocity and pressure. Measured, as shares of those: Sod 0.62, 0.86, 0.82; Lax 0.35, 0.56, 0.62; two fans 0.47, 0.69, 0.52; a slow shock 0.73, 0.46, 0.36; a
# moving contact 0.35, and velocity and pressure to round-off.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"

# tube NAME CELLS END STATES: a tube with free sides.
tube() {
    expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/riemann.yaml" -o "$1" --quiet --set "domain.cell=$(awk -v n="$2" 'BEGIN { printf "%.12g", 1 / n }')" \
        --set "time.end=$3" --set "verify.exact={riemann: {$4}}" --set boundaries='{x: free}' --set 'verify.metrics=[l1_density, l1_velocity_x, l1_pressure]'
    below "$(json "$1/summary.json" energy)" 1e-13
}
# within NAME DENSITY VELOCITY PRESSURE
within() {
    below "$(json "$1/summary.json" l1_density)" "$2"
    below "$(json "$1/summary.json" l1_velocity_x)" "$3"
    below "$(json "$1/summary.json" l1_pressure)" "$4"
}

tube sod 200 0.2 'left_density: 1, left_pressure: 1, right_density: 0.125, right_pressure: 0.1, position: 0.5'
within sod 1.81e-3 2.94e-3 1.31e-3
tube lax 200 0.13 'left_density: 0.445, left_velocity: 0.698, left_pressure: 3.528, right_density: 0.5, right_pressure: 0.571, position: 0.5'
within lax 3.0e-3 4.61e-3 6.15e-3
tube fans 200 0.15 'left_density: 1, left_velocity: -2, left_pressure: 0.4, right_density: 1, right_velocity: 2, right_pressure: 0.4, position: 0.5'
within fans 4.6e-3 1.65e-2 1.89e-3
tube slow 100 4 'left_density: 3.857143, left_velocity: -0.810631, left_pressure: 10.33333, right_density: 1, right_velocity: -3.44, right_pressure: 1, position: 0.3'
within slow 2.99e-2 8e-3 5.5e-2
tube contact 100 2 'left_density: 1.4, left_velocity: 0.1, left_pressure: 1, right_density: 1, right_velocity: 0.1, right_pressure: 1, position: 0.5'
within contact 2.2e-3 1e-13 1e-13

# Vortices at a tenth of the speed of sound and at a hundredth keep as much (measured: 0.0084 and 0.0080 of the velocity off).
for pressure in 71.43 7143; do
    expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/low_mach_vortex.yaml" -o "vortex-$pressure" --quiet --set method.limiter=default --set method.pressure=explicit --set time.end=0.2 \
        --set "verify.exact.taylor_green.pressure=$pressure" --set verify.exact.taylor_green.viscosity=1e-4 --set materials.gas.viscosity.shear=1e-4
    below "$(json "vortex-$pressure/summary.json" l1rel_velocity_x)" 0.007
done

# With the implicit pressure slow flow keeps the crests of its velocities (theory 3; 0.0080, and 0.0089 with crests cut at their neighbours').
expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/low_mach_vortex.yaml" -o vortex-implicit --quiet --set method.limiter=default
below "$(json vortex-implicit/summary.json l1rel_velocity_x)" 0.0083
