#include "run/pressure.h"

#include <math.h>

const scene_load *pressurising_load(const scene *s, int material)
{
    for (int l = 0; l < s->n_loads; l++) {
        if (s->load[l].kind == LOAD_PRESSURISE && s->load[l].material == material) return &s->load[l];
    }
    return NULL;
}

static int cell_material(const ice *i, int material)
{
    for (int r = 0; i && r < i->n_materials; r++) {
        if (i->material[r].scene_material == material && !i->material[r].points) return r;
    }
    return -1;
}

double mean_pressure(sim *s, int material)
{
    const scene_load *load = pressurising_load(s->scene, material);
    const shape *region = load ? &load->region : NULL;
    double pressure = NAN;
    floe_status status = FLOE_OK;
    if (s->scene->material[material].kind != MATERIAL_FLUID) return NAN;
    if (cell_material(s->ice, material) >= 0) {
        status = ice_mean_pressure(s->ice, cell_material(s->ice, material), region, &pressure);
    } else if (s->mpm && !s->ice) {
        status = mpm_mean_pressure(s->mpm, material, region, &pressure);
    }
    if (status == FLOE_OK) return pressure;
    context_clear(s->ctx); /* there is none of it, or none there */
    return NAN;
}
