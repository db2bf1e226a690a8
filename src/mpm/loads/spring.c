/* Springs without mass (York, Sulsky and Schreyer 2000, end of section 4.4: a tether as a force) and dashpots, between places of bodies or a
 * place and a fixed position (theory 4.13). */
#include "mpm/loads/spring_end.h"

#include "base/memory.h"
#include "math/tensor.h"
#include "mpm/motion/motion_springs.h"
#include "mpm/nodes/support_points.h"
#include "mpm/nodes/supports.h"
#include "mpm/transfer/stencil.h"
#include "scene/state.h"

#include <math.h>
#include <string.h>

/* A spring as it is now. */
typedef struct spring_now {
    double x[2][3], unit[3]; /* m; from the first end to the second */
    double stretch;          /* m: beyond its rest length; 0 where it is slack */
    bool taut;
} spring_now;

static bool is_rigid(const mpm *s, const spring_end *end)
{
    return end->body >= 0 && motion_has_body(s, end->body);
}

/* With `ahead` where the force of a step is taken: bodies that do not deform may take it in the middle of the step (theory 4.17). */
static bool look_at_spring(const mpm *s, int n, bool ahead, spring_now *now)
{
    const scene_spring *spring = &s->scene->spring[n];
    struct spring_state *state = &s->springs[n];
    for (int e = 0; e < 2; ++e) {
        spring_end *end = &state->end[e];
        if (end->body >= 0 && !spring_end_find(s, end)) return false;
        spring_end_position(s, &spring->end[e], end, false, now->x[e]);
        if (ahead && is_rigid(s, end)) motion_foresee(s, end->body, now->x[e], now->x[e]);
    }
    for (int a = 0; a < 3; ++a) now->unit[a] = now->x[1][a] - now->x[0][a];
    const double length = vec_norm(now->unit);
    for (int a = 0; a < 3; ++a) now->unit[a] = length > 0.0 ? now->unit[a] / length : 0.0;
    now->stretch = length - state->rest_length;
    now->taut = !spring->one_way || now->stretch > 0.0;
    if (!now->taut) now->stretch = 0.0;
    return true;
}

floe_status start_springs(mpm *s)
{
    for (int n = 0; n < s->scene->n_springs; ++n) {
        const scene_spring *spring = &s->scene->spring[n];
        struct spring_state *state = &s->springs[n];
        spring_now now;
        state->rest_length = 0.0;
        for (int e = 0; e < 2; ++e) {
            memory_free(s->ctx, &state->end[e].point);
            TRY(spring_end_start(s, spring, e, &state->end[e]));
        }
        TRY(look_at_spring(s, n, false, &now) ? FLOE_OK : FLOE_INTERNAL);
        state->rest_length = isnan(spring->rest_length) ? fabs(now.stretch) : spring->rest_length;
    }
    return FLOE_OK;
}

floe_status create_springs(mpm *s)
{
    TRY(memory_new(s->ctx, &s->springs, SCENE_MAX_SPRINGS, sizeof *s->springs));
    for (int n = 0; n < SCENE_MAX_SPRINGS; ++n)
        for (int e = 0; e < 2; ++e) s->springs[n].end[e].body = -1;
    return FLOE_OK;
}

void free_springs(mpm *s)
{
    for (int n = 0; s->springs && n < SCENE_MAX_SPRINGS; ++n)
        for (int e = 0; e < 2; ++e) memory_free(s->ctx, &s->springs[n].end[e].point);
    memory_free(s->ctx, &s->springs);
}

/* Per metre of depth or radian, as all forces inside. */
static double stiffness_of(const mpm *s, const scene_spring *spring)
{
    return spring->stiffness / scene_extent(s->scene);
}

static double damping_of(const mpm *s, const scene_spring *spring)
{
    return spring->damping / scene_extent(s->scene);
}

/* Speed (m/s) with which a spring becomes longer. */
static double lengthening(const mpm *s, int n, const double unit[3])
{
    double v[2][3];
    for (int e = 0; e < 2; ++e) spring_end_velocity(s, &s->springs[n].end[e], v[e]);
    return (v[1][0] - v[0][0]) * unit[0] + (v[1][1] - v[0][1]) * unit[1] + (v[1][2] - v[0][2]) * unit[2];
}

/* The support that a point at x belongs to; -1: none. */
static int support_of_place(const mpm *s, int body, const double x[3])
{
    return supports_take_points(s, body) ? support_with(s, x) : -1;
}

/* Gives a force (N) to a point; one that belongs to a support hands it on. */
static void push_point(mpm *s, int body, const double x[3], const double force[3])
{
    const int support = support_of_place(s, body, x);
    if (support < 0) push_nodes(s, s->body[body].group, x, force);
    for (int a = 0; support >= 0 && a < s->mesh->dim; ++a) push_support(s, support, x, a, -s->kick * force[a]);
}

/* Gives a force (N) at x to the points of an end. */
static void push_end(mpm *s, const spring_end *end, const double x[3], const double force[3])
{
    if (is_rigid(s, end)) {
        motion_push(s, end->body, x, force);
        return;
    }
    for (int k = 0; k < end->n; ++k) {
        const spring_point *p = &end->point[k];
        double at[3] = {0.0}, share[3];
        for (int a = 0; a < s->mesh->dim; ++a)
            at[a] = field_get(s->domain->fields[p->block], P_POS, end->body, a)[p->index];
        for (int a = 0; a < 3; ++a) share[a] = p->weight * force[a];
        push_point(s, end->body, at, share);
    }
}

void scatter_springs(mpm *s, int group)
{
    for (int n = 0; n < s->scene->n_springs; ++n) {
        const scene_spring *spring = &s->scene->spring[n];
        struct spring_state *state = &s->springs[n];
        spring_now now;
        if (!look_at_spring(s, n, true, &now)) continue;
        state->pull = now.taut && spring->damping > 0.0 ? damping_of(s, spring) * lengthening(s, n, now.unit) : 0.0;
        const double tension = stiffness_of(s, spring) * now.stretch + state->pull;
        for (int e = 0; e < 2; ++e) {
            double force[3];
            const spring_end *end = &state->end[e];
            for (int a = 0; a < 3; ++a) force[a] = (e == 0 ? tension : -tension) * now.unit[a];
            if (end->body >= 0 && s->body[end->body].group == group) push_end(s, end, now.x[e], force);
            /* a fixed place gives the momentum that the other end takes; entered once */
            for (int a = 0; end->body < 0 && group == 0 && a < s->mesh->dim; ++a)
                ledger_push(s->ledger, LEDGER_SOURCE, a, -force[a] * s->kick, now.x[e]);
        }
    }
}

void enter_dashpots(mpm *s)
{
    for (int n = 0; n < s->scene->n_springs; ++n) {
        const scene_spring *spring = &s->scene->spring[n];
        struct spring_state *state = &s->springs[n];
        spring_now now;
        double way = 0.0;
        if (!(spring->damping > 0.0) || !look_at_spring(s, n, true, &now)) continue;
        for (int e = 0; e < 2; ++e) {
            double first[3], last[3];
            spring_end_position(s, &spring->end[e], &state->end[e], false, first);
            spring_end_position(s, &spring->end[e], &state->end[e], true, last);
            for (int a = 0; a < 3; ++a) way += (e == 0 ? -1.0 : 1.0) * (last[a] - first[a]) * now.unit[a];
        }
        ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_DAMPING, -state->pull * way);
    }
}

int spring_find(mpm *s, int n)
{
    struct spring_state *state = &s->springs[n];
    for (int e = 0; e < 2; ++e)
        if (state->end[e].body >= 0 && !spring_end_find(s, &state->end[e])) return 0;
    return state->end[0].n + state->end[1].n;
}

spring_share spring_share_of(const mpm *s, int n, int k)
{
    const struct spring_state *state = &s->springs[n];
    const int e = k < state->end[0].n ? 0 : 1;
    const spring_end *end = &state->end[e];
    const spring_point *p = &end->point[k - (e == 0 ? 0 : state->end[0].n)];
    spring_share out = {.body = end->body, .support = -1, .weight = e == 0 ? -p->weight : p->weight};
    for (int a = 0; a < s->mesh->dim; ++a)
        out.x[a] = field_get(s->domain->fields[p->block], P_POS, end->body, a)[p->index];
    out.support = support_of_place(s, end->body, out.x);
    return out;
}

void spring_pull_at(const mpm *s, int n, const double moved[3], spring_pull *out)
{
    const scene_spring *spring = &s->scene->spring[n];
    const double k = stiffness_of(s, spring);
    spring_now now;
    double line[3];
    memset(out, 0, sizeof *out);
    if (!look_at_spring(s, n, false, &now)) return;
    for (int a = 0; a < 3; ++a) line[a] = now.x[1][a] - now.x[0][a] + moved[a];
    const double length = vec_norm(line), stretch = length - s->springs[n].rest_length;
    if (!(length > 0.0) || (spring->one_way && stretch < 0.0)) return;
    const double across = fmax(k * stretch / length, 0.0);
    out->energy = 0.5 * k * stretch * stretch;
    for (int a = 0; a < 3; ++a) {
        out->force[a] = -k * stretch * line[a] / length;
        for (int b = 0; b < 3; ++b)
            out->stiffness[3 * a + b] = (k - across) * line[a] * line[b] / (length * length) + (a == b ? across : 0.0);
    }
}

double spring_energy(const mpm *s)
{
    double sum = 0.0;
    for (int n = 0; n < s->scene->n_springs; ++n) {
        spring_now now;
        if (look_at_spring(s, n, false, &now))
            sum += 0.5 * stiffness_of(s, &s->scene->spring[n]) * now.stretch * now.stretch;
    }
    return sum;
}

/* A body that does not deform swings as a whole, which is to be followed, where nothing else may bound the step: some 400 steps a period at the
 * default cfl. Of the few points of a body that deforms only stability is asked. */
static const double swing_steps = 20.0;

/* Whether the force of one end moves another. */
static bool is_felt(const mpm *s, const spring_end *a, const spring_end *b)
{
    return a->body >= 0 && a->body == b->body && (is_rigid(s, a) || spring_ends_share(a, b));
}

/* How fast the ends of a spring go by a unit of stiffness, or damping, times stretch, or its rate, of all others and of itself: a row of
 * M^-1 K by its largest sum. */
static double row_of_ends(const mpm *s, int n, bool damping)
{
    double sum = 0.0;
    for (int other = 0; other < s->scene->n_springs; ++other) {
        const scene_spring *by = &s->scene->spring[other];
        const double size = damping ? damping_of(s, by) : stiffness_of(s, by);
        for (int e = 0; e < 2; ++e)
            for (int f = 0; f < 2; ++f) {
                const spring_end *a = &s->springs[n].end[e], *b = &s->springs[other].end[f];
                if (!is_felt(s, a, b)) continue;
                const double steps = is_rigid(s, a) ? swing_steps : 1.0;
                sum += (damping ? steps : steps * steps) * size * sqrt(a->compliance * b->compliance);
            }
    }
    return sum;
}

/* From the largest angular frequency with which the ends oscillate and the largest rate with which dashpots stop them. */
double spring_rate(mpm *s, const char **name)
{
    double worst = 0.0;
    for (int n = 0; n < s->scene->n_springs; ++n) {
        spring_now now;
        const bool whole = look_at_spring(s, n, false, &now);
        for (int e = 0; e < 2; ++e) {
            s->springs[n].end[e].compliance = 0.0;
            if (whole) spring_end_comply(s, &s->springs[n].end[e], now.unit);
        }
    }
    for (int n = 0; n < s->scene->n_springs; ++n) {
        const double slowing = row_of_ends(s, n, true),
                     rate = slowing + sqrt(row_of_ends(s, n, false) + slowing * slowing);
        if (rate <= worst) continue;
        worst = rate;
        *name = s->scene->spring[n].name;
    }
    return worst;
}
