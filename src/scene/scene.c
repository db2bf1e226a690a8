#include "scene/scene.h"

#include "base/memory.h"
#include "scene/batches.h"
#include "scene/formula.h"

#include <math.h>
#include <string.h>

/* Storage handed out by scene_allocate, freed with the scene. */
typedef struct owned {
    struct owned *next;
    void *data;
} owned;

typedef struct scene_box {
    scene scene; /* first, so that a scene pointer is a box pointer */
    scene_batches batches;
    owned *owned;
} scene_box;

const char *scene_time_unit(const scene *s)
{
    return s->dimensionless ? "" : " s";
}

const char *coupling_name(scene_coupling coupling)
{
    static const char *const name[COUPLING_COUNT] = {"mpm", "ice", "ice-mpm"};
    return name[coupling];
}

int scene_enclosing_bodies(const scene *s, int body[SCENE_MAX_ENCLOSING])
{
    int n = 0;
    for (int b = 0; b < s->n_bodies && n < SCENE_MAX_ENCLOSING; ++b)
        if (s->body[b].membrane.present && s->body[b].membrane.encloses >= 0) body[n++] = b;
    return n;
}

int scene_enclosing_body(const scene *s)
{
    int body[SCENE_MAX_ENCLOSING];
    return scene_enclosing_bodies(s, body) > 0 ? body[0] : -1;
}

bool scene_is_cut(const scene *s)
{
    if (s->method.interface == INTERFACE_SHARP)
        for (int b = 0; b < s->n_bodies; ++b)
            if (s->material[s->body[b].material].kind == MATERIAL_SOLID) return true;
    return scene_enclosing_body(s) >= 0;
}

bool scene_in_contact(const scene *s, int body)
{
    if (!s->contact.enabled) return false;
    if (s->contact.n_bodies == 0) return s->material[s->body[body].material].kind == MATERIAL_SOLID;
    for (int k = 0; k < s->contact.n_bodies; ++k)
        if (s->contact.body[k] == body) return true;
    return false;
}

/* Whether points are solids alone, in steps that are not solved for. Gas and liquids on points, and membranes, keep FLIP (docs/defaults.md). */
static bool points_are_solids(const scene *s)
{
    const bool fluids_on_points = s->coupling == COUPLING_MPM;
    for (int b = 0; b < s->n_bodies; ++b) {
        const scene_material *m = &s->material[s->body[b].material];
        if (m->membrane || (fluids_on_points && m->kind == MATERIAL_FLUID)) return false;
    }
    return s->time.solver == SOLVER_DYNAMIC;
}

/* Whether the scene looks for the rest that damping brings elastic solids to, which the way there has no part in: what a transfer takes
 * of their motion is not missed. */
static bool looks_for_rest(const scene *s)
{
    if (!s->rest.enabled || !(s->damping.rate > 0.0) || s->damping.end < s->time.end || s->contact.enabled)
        return false;
    for (int b = 0; b < s->n_bodies; ++b) {
        const solid_model *law = s->material[s->body[b].material].law;
        if (!law || law->yield_stress || law->n_history > 0) return false;
    }
    return true;
}

bool scene_bends_walls(const scene *s)
{
    bool deforms = false;
    for (int b = 0; b < s->n_bodies; ++b)
        deforms = deforms ||
                  (s->material[s->body[b].material].kind == MATERIAL_SOLID && !motion_is_given(&s->body[b].motion));
    return deforms && s->coupling == COUPLING_ICE_MPM && s->method.pressure == PRESSURE_IMPLICIT &&
           s->method.interface == INTERFACE_SHARP;
}

const char *scene_transfer(const scene *s)
{
    if (s->method.transfer[0]) return s->method.transfer;
    if (!isnan(s->method.flip) || scene_bends_walls(s)) return "flip";
    return points_are_solids(s) && !looks_for_rest(s) ? "afmpm" : "flip";
}

double scene_body_pressure(const scene *s, const scene_body *b)
{
    double most = fmax(scene_largest_pressure(s, b), 0.0); /* fmax: NAN where an exact solution gives it */
    for (int l = 0; l < s->n_loads; ++l)
        if (s->load[l].kind == LOAD_PRESSURISE && s->load[l].material == b->material)
            most = fmax(most, s->reference_pressure + s->load[l].target);
    return most;
}

double scene_gas_pressure(const scene *s)
{
    double most = 0.0;
    for (int b = 0; s->coupling == COUPLING_MPM && b < s->n_bodies; ++b)
        if (s->material[s->body[b].material].kind == MATERIAL_FLUID)
            most = fmax(most, scene_body_pressure(s, &s->body[b]));
    return most;
}

static bool has_soft_wall(const scene *s)
{
    const double soft = 200.0, pressure = scene_gas_pressure(s);
    for (int b = 0; b < s->n_bodies; ++b) {
        const scene_material *m = &s->material[s->body[b].material];
        if (m->kind == MATERIAL_SOLID && m->law->bulk_modulus(m->law_par) < soft * pressure) return true;
    }
    return false;
}

bool scene_wall_bases(const scene *s)
{
    return strcmp(s->method.basis, "quadratic") == 0 || strcmp(s->method.basis, "linear") == 0;
}

/* Damping brings fluid and wall to rest together, and one velocity is steadier then: of the pressurised cylinder, 40 cells, eq. 13 is 0.1 % off
 * with one velocity and 6 to 12 % with two. Gas in the cells of a soft wall would stiffen it (72 % at a hundredth of its pressure). */
static bool rests_with_fluid(const scene *s)
{
    return s->damping.rate > 0.0 && !(has_soft_wall(s) && scene_wall_bases(s));
}

bool scene_drives_beside_implicit(const scene *s)
{
    bool moves = false;
    for (int k = 0; k < s->n_supports; ++k)
        for (int a = 0; a < 3; ++a) moves = moves || s->support[k].velocity[a] != 0.0;
    return moves && s->coupling == COUPLING_ICE_MPM && s->method.pressure == PRESSURE_IMPLICIT;
}

/* Steps that are solved for, contact and membranes have their own rules, other times of the stress and filtered velocities another order of
 * the step. With CPDI points at a wall reach corner by corner to nodes of next to no fluid, which
 * throw them (4 of 28 random scenes of gas, blocks and balls). */
bool scene_fluids_apart(const scene *s)
{
    const char *transfer = scene_transfer(s);
    const bool plain = strcmp(transfer, "afmpm") != 0 && strcmp(transfer, "xpic") != 0,
               corners = strcmp(s->method.basis, "cpdi") == 0;
    bool fluids = false, solids = false;
    for (int b = 0; b < s->n_bodies; ++b) {
        const scene_material *m = &s->material[s->body[b].material];
        if (m->membrane) return false;
        fluids = fluids || m->kind == MATERIAL_FLUID;
        solids = solids || m->kind == MATERIAL_SOLID;
    }
    return s->coupling == COUPLING_MPM && s->time.solver == SOLVER_DYNAMIC && s->method.stress == STRESS_USL && plain &&
           !corners && !s->contact.enabled && fluids && solids && !rests_with_fluid(s);
}

static void set_defaults(scene *s)
{
    s->mesh.dim = 2;
    s->thickness = 1.0;
    s->coupling = COUPLING_MPM;
    s->ambient_material = -1;
    s->ambient_points = 2;
    strcpy(s->method.basis, "quadratic");
    strcpy(s->contact.normals, "cubic_spline");
    s->method.flip = NAN;
    s->method.domain_limit = 1.0;
    s->method.conserve_energy = true;
    s->method.exchange = NAN;
    s->method.edge_penalty = NAN;
    s->method.volume_relaxation = 0.0;
    s->method.pressure_tolerance = 1e-10;
    s->time = (scene_time){.end = NAN,
                           .increments = 1,
                           .tolerance = 1e-8,
                           .cfl_mpm = 0.5,
                           .cfl_ice = 0.5,
                           .acoustic_cfl = 1000.0,
                           .first_step = NAN,
                           .max_step = NAN,
                           .growth = 1.1,
                           .fixed_step = NAN,
                           .substeps = SCENE_SUBSTEPS_OPEN};
    s->batches->stability = (scene_stability){.tolerance = 0.01, .growth = 100.0, .relative_to = NAN};
    s->damping.end = INFINITY;
    s->rest = (scene_rest){.ratio = 1e-6, .window = NAN};
    s->output = (scene_output){.interval = INFINITY, .history_interval = NAN, .checkpoint_interval = NAN};
    s->verify.body = -1;
    s->verify.material = -1;
    s->verify.probe_pressure = NAN;
}

floe_status scene_create(scene **out, context *ctx)
{
    scene_box *box;
    TRY(memory_new(ctx, &box, 1, sizeof *box));
    box->scene.ctx = ctx;
    box->scene.batches = &box->batches;
    set_defaults(&box->scene);
    *out = &box->scene;
    return FLOE_OK;
}

void scene_destroy(scene **s)
{
    if (!s || !*s) return;
    scene_box *box = (scene_box *)*s;
    context *ctx = box->scene.ctx;
    scene_free_formulas(&box->scene);
    while (box->owned) {
        owned *next = box->owned->next;
        memory_free(ctx, &box->owned->data);
        memory_free(ctx, &box->owned);
        box->owned = next;
    }
    memory_free(ctx, &box);
    *s = NULL;
}

floe_status scene_allocate(scene *s, void *out, size_t size)
{
    scene_box *box = (scene_box *)s;
    owned *entry;
    TRY(memory_new(s->ctx, &entry, 1, sizeof *entry));
    const floe_status status = memory_new(s->ctx, &entry->data, 1, size);
    if (status != FLOE_OK) {
        memory_free(s->ctx, &entry);
        return status;
    }
    entry->next = box->owned;
    box->owned = entry;
    memcpy(out, &entry->data, sizeof entry->data);
    return FLOE_OK;
}

void scene_keep_run(scene *s)
{
    s->title[0] = '\0';
    s->threads = 0;
    s->batches = NULL;
    s->runs_as[0] = s->coupling;
    s->n_runs_as = 1;
}
