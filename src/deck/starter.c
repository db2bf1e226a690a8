/* The deck that `floe new` writes. */
#include "base/strbuf.h"
#include "deck/deck.h"

#include <string.h>

static const char head[] =
    "# A deck for floe. `floe check` finds its errors, `floe run` runs it, `floe list` shows what else there is.\n"
    "# Numbers are SI, or carry a unit after a space: 117 GPa, 1.4 ms. What is commented out shows the default.\n"
    "floe: 1\n";

static const char body[] =
    "source: where the scene comes from\n"
    "\n"
    "coupling: ice-mpm            # fluids in cells, solids as points; mpm: all as points; ice: fluids only\n"
    "runs_as: [mpm, ice-mpm]      # what `floe compare` runs\n"
    "reference_pressure: 1 atm\n"
    "\n"
    "domain:\n"
    "  dim: 2                     # 1, 2 or 3\n"
    "  # geometry: cartesian      # axisymmetric: (r, z)\n"
    "  # stress_state: plane_strain\n"
    "  lower: [0, 0]\n"
    "  upper: [1, 0.5]\n"
    "  cell: 0.05 m               # h; the extent must be a whole multiple of it\n"
    "\n"
    "boundaries:                  # symmetry, slip, no_slip, periodic, inlet, reservoir, outlet, non_reflecting, "
    "velocity, free\n"
    "  x: {lower: symmetry, upper: slip}\n"
    "  y: slip                    # both sides\n"
    "\n"
    "materials:\n"
    "  rubber:                    # a solid has a law\n"
    "    density: 1100 kg/m^3\n"
    "    law: {neo_hookean: {bulk_modulus: 20 MPa, shear_modulus: 2 MPa}}\n"
    "    specific_heat: 1800 J/kg/K\n"
    "  air:                       # a fluid has an eos\n"
    "    eos: {ideal: {gamma: 1.4, specific_heat: 717.5 J/kg/K}}\n"
    "    # viscosity: {shear: 1.8e-5 Pa s, bulk: 0}\n"
    "\n"
    "ambient: {material: air, pressure: 1 atm, temperature: 300 K}   # what fills the rest, in every coupling\n"
    "\n"
    "bodies:\n"
    "  block:\n"
    "    material: rubber\n"
    "    shape: {box: {lower: [0.4, 0], upper: [0.6, 0.3]}}\n"
    "    # velocity: [0, 0]\n"
    "    points: 2                # material points along each axis of a cell\n"
    "  charge:                    # a fluid body has two of pressure, temperature, density\n"
    "    material: air\n"
    "    shape: {box: {lower: [0, 0], upper: [0.2, 0.5]}}\n"
    "    pressure: 2 atm\n"
    "    temperature: 300 K\n"
    "\n"
    "# loads:\n"
    "#   weight: {gravity: {acceleration: [0, -9.81 m/s^2]}}\n"
    "#   heating: {pressurise: {material: air, region: {ball: {radius: 0.1}}, target: 1 MPa, ramp: 1 ms}}\n"
    "\n"
    "# damping: {rate: 0 1/s}\n"
    "\n"
    "time: {end: 5 ms, cfl: 0.5}\n"
    "\n"
    "# method: {basis: quadratic, stress: usl, flip: 0.99}\n"
    "\n"
    "output:\n"
    "  interval: 0.5 ms           # field snapshots\n"
    "  probes: {front: [0.35, 0.1]}\n"
    "\n"
    "# compare: {axis: {domain.cell: [0.05, 0.025]}}\n"
    "# study: {axes: {domain.cell: [0.05, 0.025], method.basis: [linear, quadratic]}, repeat: 3}\n";

floe_status deck_starter(char **text, context *ctx, const char *name)
{
    strbuf out = {.ctx = ctx};
    const char *title = name && name[0] ? name : "a new scene";
    strbuf_append(&out, "%stitle: \"", head);
    for (const char *c = title; *c; c++) {
        const bool plain = (unsigned char)*c >= 0x20 && *c != '"' && *c != '\\' && *c != 0x7F;
        strbuf_append_bytes(&out, plain ? c : "_", 1);
    }
    strbuf_append(&out, "\"\n%s", body);
    return strbuf_take(&out, text);
}
