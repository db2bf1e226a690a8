/* Fewer points of a curve, for pages: what is left out would not be seen. */
#include "base/memory.h"
#include "draw/plot_internal.h"

#include <math.h>

typedef struct place {
    double x, y;
} place;

/* Where a point stands in the drawing, but for a factor of each axis, which changes no comparison of triangles. */
static place drawing_position(const plot_panel *panel, const plot_series *s, size_t i)
{
    return (place){panel->log_x ? log10(s->x[i]) : s->x[i], panel->log_y ? log10(s->y[i]) : s->y[i]};
}

static double triangle_size(place a, place b, place c)
{
    return fabs((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y));
}

/* The first of n points that belongs to bucket k of `most`: the first and the last bucket hold one point each. */
static size_t bucket_start(size_t n, size_t most, size_t k)
{
    return k == 0 ? 0 : 1 + (size_t)((double)(k - 1) * (double)(n - 2) / (double)(most - 2));
}

static place bucket_mean(const plot_panel *panel, const plot_series *s, const size_t *index, size_t from, size_t to)
{
    place sum = {0.0, 0.0};
    for (size_t i = from; i < to; i++) {
        const place p = drawing_position(panel, s, index[i]);
        sum.x += p.x / (double)(to - from);
        sum.y += p.y / (double)(to - from);
    }
    return sum;
}

/* Lines: of each bucket the point that makes the largest triangle with the one kept before it and the middle of the
 * next bucket (Steinarsson 2013, "largest triangle three buckets"): corners, steep parts and peaks stay. */
static void thin_line(const plot_panel *panel, const plot_series *s, size_t *index, size_t n, size_t most)
{
    for (size_t k = 1; k + 1 < most; k++) {
        const size_t from = bucket_start(n, most, k), to = bucket_start(n, most, k + 1);
        const place before = drawing_position(panel, s, index[k - 1]);
        const place after = bucket_mean(panel, s, index, to, k + 2 < most ? bucket_start(n, most, k + 2) : n);
        size_t best = from;
        double largest = -1.0;
        for (size_t i = from; i < to; i++) {
            const double area = triangle_size(before, drawing_position(panel, s, index[i]), after);
            if (!(area > largest)) continue;
            largest = area;
            best = i;
        }
        index[k] = index[best]; /* k <= from: what is overwritten was looked at before */
    }
    index[most - 1] = index[n - 1];
}

/* Clouds: one of each bucket, from another part of it each time, as a fixed stride would beat with points that lie
 * regularly. */
static void thin_cloud(size_t *index, size_t n, size_t most)
{
    const double golden = 0.6180339887498949;
    for (size_t k = 1; k + 1 < most; k++) {
        const size_t from = bucket_start(n, most, k), to = bucket_start(n, most, k + 1);
        const double part = golden * (double)k;
        index[k] = index[from + (size_t)((part - floor(part)) * (double)(to - from))];
    }
    index[most - 1] = index[n - 1];
}

/* One curve: the points that stay in x and y. Between two of them that had more gaps than points, one gap stays. */
static void thin_series(const plot_panel *panel, plot_series *s, size_t most, size_t *index, double *x)
{
    size_t n = 0, kept = 0;
    double *y = x + 2 * most;
    for (size_t i = 0; i < s->n; i++) {
        if (plot_drawable(panel->log_x, s->x[i]) && plot_drawable(panel->log_y, s->y[i])) index[n++] = i;
    }
    if (n <= most) return;
    const double share = (double)n / (double)most; /* drawable points that one stands for */
    if (s->style == PLOT_POINTS) {
        thin_cloud(index, n, most);
    } else {
        thin_line(panel, s, index, n, most);
    }
    for (size_t k = 0; k < most; k++) {
        if (k > 0 && (double)(index[k] - index[k - 1]) > 4.0 * share) {
            x[kept] = (double)NAN;
            y[kept++] = (double)NAN;
        }
        x[kept] = s->x[index[k]];
        y[kept++] = s->y[index[k]];
    }
    s->x = x;
    s->y = y;
    s->n = kept;
}

/* A curve with texts beside its points keeps them all. */
static bool is_thinned(const plot_figure *f, const plot_series *s)
{
    return f->most > 0 && s->n > f->most && !s->label;
}

bool plot_is_thinned(const plot_figure *f)
{
    for (size_t p = 0; p < f->n_panels; p++) {
        for (size_t k = 0; k < f->panel[p].n_series; k++) {
            if (is_thinned(f, &f->panel[p].series[k])) return true;
        }
    }
    return false;
}

static floe_status thin_all(context *ctx, plot_thin *t)
{
    plot_figure *f = &t->figure;
    size_t *index;
    size_t longest = 0, series = 0, thinned = 0;
    for (size_t p = 0; p < f->n_panels; p++) {
        for (size_t k = 0; k < f->panel[p].n_series; k++, series++) {
            thinned += is_thinned(f, &f->panel[p].series[k]);
            if (f->panel[p].series[k].n > longest) longest = f->panel[p].series[k].n;
        }
    }
    TRY(memory_new(ctx, &t->panel, f->n_panels, sizeof *t->panel));
    TRY(memory_new(ctx, &t->series, series, sizeof *t->series));
    TRY(memory_new(ctx, &t->value, 4 * f->most * thinned,
                   sizeof *t->value)); /* x and y, each point with a gap before it */
    TRY(memory_new(ctx, &index, longest, sizeof *index));
    plot_series *next = t->series;
    double *scratch = t->value;
    for (size_t p = 0; p < f->n_panels; p++) {
        t->panel[p] = f->panel[p];
        t->panel[p].series = next;
        for (size_t k = 0; k < f->panel[p].n_series; k++, next++) {
            *next = f->panel[p].series[k];
            if (!is_thinned(f, next)) continue;
            thin_series(&f->panel[p], next, f->most, index, scratch);
            scratch += 4 * f->most;
        }
    }
    memory_free(ctx, &index);
    f->panel = t->panel;
    return FLOE_OK;
}

floe_status plot_thin_make(plot_thin *t, context *ctx, const plot_figure *figure)
{
    *t = (plot_thin){.figure = *figure};
    if (!plot_is_thinned(figure)) return FLOE_OK;
    if (figure->most < 3) return fail(ctx, FLOE_INTERNAL, "a curve thinned to %zu points: it needs 3", figure->most);
    return thin_all(ctx, t);
}

void plot_thin_free(plot_thin *t, context *ctx)
{
    memory_free(ctx, &t->panel);
    memory_free(ctx, &t->series);
    memory_free(ctx, &t->value);
}
