/* Springs without mass between points, or from a point to a fixed place (York, Sulsky and Schreyer 2000, end of section
 * 4.4: a tether as a force): each end's force goes to the nodes with the weights of its point. */
#include "mpm/loads/spring.h"
#include "mpm/transfer/stencil.h"
#include "scene/state.h"

#include <math.h>

/* Finds a point of a body by its number; where it was last is looked at first. False: it is lost. */
static bool find_point(const mpm *s, int body, int number, spring_end *end)
{
    const double id = (double)(((unsigned long long)body << 40) | (unsigned long long)(number - 1));
    const fields *f = s->domain->fields[end->block];
    if (end->index < s->points[end->block][body].n && field_get(f, P_ID, body, 0)[end->index] == id) return true;
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        const double *ids = field_get(s->domain->fields[b], P_ID, body, 0);
        for (size_t k = 0; k < s->points[b][body].n; ++k) {
            if (ids[k] != id) continue;
            end->block = b;
            end->index = k;
            return true;
        }
    }
    return false;
}

static int body_of(const mpm *s, int named)
{
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].scene_body == named) return b;
    return -1;
}

/* The place of an end; false where its point is lost, and the spring is broken. */
static bool find_end(const mpm *s, const scene_spring *spring, int e, spring_state *state, double x[3])
{
    for (int a = 0; a < 3; ++a) x[a] = spring->end[e].place[a];
    if (spring->end[e].body < 0) return true;
    const int body = body_of(s, spring->end[e].body);
    spring_end *end = &state->end[e];
    if (body < 0 || !find_point(s, body, spring->end[e].point, end)) return false;
    for (int a = 0; a < 3; ++a)
        x[a] = a < s->mesh->dim ? field_get(s->domain->fields[end->block], P_POS, body, a)[end->index] : 0.0;
    return true;
}

/* A spring as it is now. */
typedef struct spring_now {
    double x[2][3], unit[3]; /* m; from the first end to the second */
    double stretch;          /* m: beyond its rest length; 0 where it is slack */
} spring_now;

static bool look_at_spring(const mpm *s, int n, spring_now *now)
{
    const scene_spring *spring = &s->scene->spring[n];
    spring_state *state = &s->springs[n];
    double square = 0.0;
    for (int e = 0; e < 2; ++e)
        if (!find_end(s, spring, e, state, now->x[e])) return false;
    for (int a = 0; a < 3; ++a) {
        now->unit[a] = now->x[1][a] - now->x[0][a];
        square += now->unit[a] * now->unit[a];
    }
    const double length = sqrt(square);
    for (int a = 0; a < 3; ++a) now->unit[a] = length > 0.0 ? now->unit[a] / length : 0.0;
    now->stretch = length - state->rest_length;
    if (spring->one_way && now->stretch < 0.0) now->stretch = 0.0;
    return true;
}

floe_status start_springs(mpm *s)
{
    for (int n = 0; n < s->scene->n_springs; ++n) {
        const scene_spring *spring = &s->scene->spring[n];
        spring_now now;
        s->springs[n] = (spring_state){.rest_length = 0.0};
        for (int e = 0; e < 2; ++e) {
            double x[3];
            if (find_end(s, spring, e, &s->springs[n], x)) continue;
            const size_t points = mpm_body_points(s, body_of(s, spring->end[e].body));
            return fail_key(s->ctx, KEY("springs", spring->name, e == 0 ? "from" : "to", "point"),
                            "%d: body '%s' has only %zu point%s", spring->end[e].point,
                            s->scene->body[spring->end[e].body].name, points, points == 1 ? "" : "s");
        }
        TRY(look_at_spring(s, n, &now) ? FLOE_OK : FLOE_INTERNAL);
        s->springs[n].rest_length = isnan(spring->rest_length) ? fabs(now.stretch) : spring->rest_length;
    }
    return FLOE_OK;
}

/* Per metre of depth or radian, as all forces inside. */
static double stiffness_of(const mpm *s, const scene_spring *spring)
{
    return spring->stiffness / scene_extent(s->scene);
}

void scatter_springs(mpm *s, int group)
{
    for (int n = 0; n < s->scene->n_springs; ++n) {
        const scene_spring *spring = &s->scene->spring[n];
        spring_now now;
        if (!look_at_spring(s, n, &now)) continue;
        const double tension = stiffness_of(s, spring) * now.stretch;
        for (int e = 0; e < 2; ++e) {
            double force[3];
            for (int a = 0; a < 3; ++a) force[a] = (e == 0 ? tension : -tension) * now.unit[a];
            if (spring->end[e].body >= 0 && s->body_group[spring->end[e].body] == group)
                push_nodes(s, group, now.x[e], force);
            /* a fixed place gives the momentum that the other end takes; entered once */
            for (int a = 0; spring->end[e].body < 0 && group == 0 && a < s->mesh->dim; ++a)
                ledger_push(s->ledger, LEDGER_SOURCE, a, -force[a] * s->kick, now.x[e]);
        }
    }
}

double spring_energy(const mpm *s)
{
    double sum = 0.0;
    for (int n = 0; n < s->scene->n_springs; ++n) {
        spring_now now;
        if (look_at_spring(s, n, &now)) sum += 0.5 * stiffness_of(s, &s->scene->spring[n]) * now.stretch * now.stretch;
    }
    return sum;
}

/* Largest angular frequency (1/s) with which a spring's ends can oscillate against each other. */
double spring_rate(const mpm *s, const char **name)
{
    double worst = 0.0;
    for (int n = 0; n < s->scene->n_springs; ++n) {
        const scene_spring *spring = &s->scene->spring[n];
        double inverse = 0.0;
        for (int e = 0; e < 2; ++e) {
            if (spring->end[e].body < 0) continue;
            const int body = body_of(s, spring->end[e].body);
            spring_end *end = &s->springs[n].end[e];
            if (find_point(s, body, spring->end[e].point, end))
                inverse += 1.0 / field_get(s->domain->fields[end->block], P_MASS, body, 0)[end->index];
        }
        const double rate = sqrt(stiffness_of(s, spring) * inverse);
        if (rate <= worst) continue;
        worst = rate;
        *name = spring->name;
    }
    return worst;
}
