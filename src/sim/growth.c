/* Spurious energy. Explicit steps beyond their limit, and methods that amplify short waves, let energy grow until
 * the result is useless, while numbers may stay finite for long. */
#include "sim/sim.h"

#include "base/text.h"

#include <math.h>
#include <string.h>

/* Velocities and positions are half a step apart: close below the limit of a step, the energy of the shortest waves looks
 * many times too large at some looks, and too small at others. Growth is there at all of them. */
static const double looks_in_a_row = 8.0;

bool sim_has_grown(const sim *s)
{
    return s->ledger.motion.beyond >= looks_in_a_row;
}

/* What moves fastest. */
typedef struct fastest {
    double square; /* (m/s)^2 */
    double x[3];   /* m */
    const char *kind, *name;
} fastest;

static void look_at_points(const sim *s, int blk, int body, fastest *f)
{
    const fields *all = s->domain->fields[blk];
    for (size_t k = 0; k < s->mpm->points[blk][body].n; ++k) {
        double square = 0.0;
        for (int a = 0; a < s->mesh.dim; ++a) square += pow(field_get(all, P_VEL, body, a)[k], 2.0);
        if (!(square > f->square)) continue;
        f->square = square;
        f->kind = "body";
        f->name = s->scene->body[s->mpm->body[body].scene_body].name;
        for (int a = 0; a < s->mesh.dim; ++a) f->x[a] = field_get(all, P_POS, body, a)[k];
    }
}

static void look_at_row(const sim *s, int blk, int material, const int at[3], fastest *f)
{
    const block *b = &s->mesh.block[blk];
    const fields *all = s->domain->fields[blk];
    const ptrdiff_t start = mesh_index(b, 0, at[1], at[2]);
    for (int i = 0; i < b->n[0]; ++i) {
        double square = 0.0;
        const int cell[3] = {i, at[1], at[2]};
        for (int a = 0; a < s->mesh.dim; ++a) square += pow(field_get(all, C_VEL, material, a)[start + i], 2.0);
        if (!(square > f->square)) continue;
        f->square = square;
        f->kind = "material";
        f->name = s->scene->material[s->ice->material[material].scene_material].name;
        for (int a = 0; a < s->mesh.dim; ++a) f->x[a] = mesh_centre(&s->mesh, a, b->lo[a] + cell[a]);
    }
}

static void look_at_cells(const sim *s, int blk, int material, fastest *f)
{
    const block *b = &s->mesh.block[blk];
    for (int k = 0; k < b->n[2]; ++k)
        for (int j = 0; j < b->n[1]; ++j) look_at_row(s, blk, material, (const int[]){0, j, k}, f);
}

static fastest find_fastest(const sim *s)
{
    fastest f = {.square = -1.0, .kind = "body", .name = ""};
    for (int blk = 0; blk < s->mesh.n_blocks; ++blk) {
        for (int body = 0; s->mpm && body < s->mpm->n_bodies; ++body) look_at_points(s, blk, body, &f);
        for (int r = 0; s->ice && r < s->ice->n_materials; ++r)
            if (!s->ice->material[r].points) look_at_cells(s, blk, r, &f);
    }
    return f;
}

static void name_fastest_point(const sim *s, const fastest *f, char text[128])
{
    text[0] = '\0';
    for (int a = 0; a < s->mesh.dim; ++a) text_add(text, 128, "%s%.4g", a ? ", " : "", f->x[a]);
}

static void name_remedy(const sim *s, char text[160])
{
    const scene_time *t = &s->scene->time;
    if (!isnan(t->fixed_step))
        (void)snprintf(text, 160, "take a smaller time.fixed_step than %g, or leave it out", t->fixed_step);
    else if (sim_solves(s))
        (void)snprintf(text, 160, "take more time.increments");
    else
        (void)snprintf(text, 160, "take a smaller time.cfl (it is %g), or another %s", s->mpm ? t->cfl_mpm : t->cfl_ice,
                       s->mpm ? "method.stress, method.transfer or method.basis" : "method.pressure");
}

void sim_describe_growth(const sim *s, char text[SIM_GROWTH_TEXT])
{
    const ledger *l = &s->ledger;
    const fastest f = find_fastest(s);
    char place[128] = "", remedy[160];
    name_fastest_point(s, &f, place);
    name_remedy(s, remedy);
    (void)snprintf(text, SIM_GROWTH_TEXT,
                   "energy grows without a source: by t = %.6g%s %.3g times what was there at the start and came in is "
                   "from nothing; %s '%s' moves fastest, with %.3g%s at (%s); %s",
                   l->motion.last_look, scene_time_unit(s->scene),
                   ledger_excess(l, LEDGER_ENERGY) / l->scale[LEDGER_ENERGY], f.kind, f.name, sqrt(f.square),
                   s->scene->dimensionless ? "" : " m/s", place, remedy);
}
