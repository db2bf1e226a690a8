/* A comparison as pictures, by gnuplot: the script and its data stand in the folder whether gnuplot is there or not. */
#include "base/memory.h"
#include "io/file.h"
#include "io/strbuf.h"
#include "study/cases.h"
#include "study/gnuplot.h"

#include <math.h>
#include <string.h>

/* A coupling's name as the name of a data block. */
static const char *block_name(scene_coupling coupling)
{
    static const char *const name[COUPLING_COUNT] = {"$mpm", "$ice", "$ice_mpm"};
    return name[coupling];
}

/* h, wall time and the errors of each case of a coupling; "NaN" where there is none. */
static void append_data(const comparison *c, scene_coupling coupling, const char *const *metric, int n, strbuf *out)
{
    strbuf_append(out, "%s << EOD\n", block_name(coupling));
    for (size_t i = 0; i < c->n; i++) {
        const compare_case *one = &c->list[i];
        if (one->coupling != coupling || !one->ran) continue;
        strbuf_append(out, "%.9g,%.9g", one->h, one->summary.wall_seconds);
        for (int k = 0; k < n; k++) {
            const double error = compare_error(one, metric[k]);
            if (error > 0.0) {
                strbuf_append(out, ",%.9g", error * (compare_is_relative(metric[k]) ? 100.0 : 1.0));
            } else {
                strbuf_append(out, ",NaN");
            }
        }
        strbuf_append(out, "\n");
    }
    strbuf_append(out, "EOD\n");
}

static bool has_data(const comparison *c, const char *metric)
{
    for (size_t i = 0; i < c->n; i++) {
        if (compare_error(&c->list[i], metric) > 0.0) return true;
    }
    return false;
}

static void append_panel(const comparison *c, const char *metric, int column, int x, strbuf *out)
{
    scene_coupling coupling[COUPLING_COUNT];
    const int n = compare_couplings(c, coupling);
    const char *unit = compare_unit(metric);
    strbuf_append(out, "set xlabel '%s'\n", x == 1 ? "h (m)" : "wall time (s)");
    strbuf_append(out, "set ylabel '%s%s%s%s' noenhanced\nplot ", metric, unit[0] ? " (" : "", unit,
                  unit[0] ? ")" : "");
    for (int k = 0; k < n; k++) {
        strbuf_append(out, "%s%s using %d:%d with linespoints lw 2 pt %d title '%s'", k ? ", \\\n     " : "",
                      block_name(coupling[k]), x, column, 5 + 2 * k, coupling_name(coupling[k]));
    }
    strbuf_append(out, "\n");
}

static void append_errors(const comparison *c, const char *const *metric, int n, strbuf *out)
{
    int rows = 0;
    for (int k = 0; k < n; k++) rows += has_data(c, metric[k]);
    if (rows == 0) return;
    strbuf_append(out, "\nset terminal svg size 900,%d background rgb 'white'\nset output 'errors.svg'\n", 300 * rows);
    strbuf_append(out, "set multiplot layout %d,2\nset logscale xy\nset grid\nset format y '%%g'\n", rows);
    for (int k = 0; k < n; k++) {
        if (!has_data(c, metric[k])) continue;
        append_panel(c, metric[k], 3 + k, 1, out);
        append_panel(c, metric[k], 3 + k, 2, out);
    }
    strbuf_append(out, "unset multiplot\nunset logscale\nunset output\n");
}

/* The finest case of a coupling that has come to its end with a profile; NULL if none. */
static const compare_case *finest(const comparison *c, scene_coupling coupling)
{
    const compare_case *best = NULL;
    for (size_t i = 0; i < c->n; i++) {
        const compare_case *one = &c->list[i];
        char folder[COMPARE_PATH], path[COMPARE_PATH + 32];
        if (one->coupling != coupling || !one->ran || one->status != FLOE_OK) continue;
        case_path(c, one, folder);
        (void)snprintf(path, sizeof path, "%s/profile.csv", folder);
        if (file_exists(path) && (!best || one->h < best->h)) best = one;
    }
    return best;
}

/* Adds the rows of a case's profile, with coupling and h before each; the names once. */
static floe_status append_profile(const comparison *c, const compare_case *one, strbuf *out)
{
    char folder[COMPARE_PATH], path[COMPARE_PATH + 32];
    char *text;
    case_path(c, one, folder);
    (void)snprintf(path, sizeof path, "%s/profile.csv", folder);
    TRY(file_read(c->ctx, path, &text, NULL));
    bool names = true;
    for (const char *line = text, *end = strchr(line, '\n'); end; line = end + 1, end = strchr(line, '\n')) {
        if (!names) strbuf_append(out, "%s,%.9g,", coupling_name(one->coupling), one->h);
        if (names && out->length == 0) strbuf_append(out, "coupling,h (m),");
        if (!names || strncmp(strbuf_string(out), "coupling,h (m),x", 16) != 0)
            strbuf_append(out, "%.*s", (int)(end + 1 - line), line);
        names = false;
    }
    memory_free(c->ctx, &text);
    return out->status;
}

static void append_profile_plot(const comparison *c, strbuf *script)
{
    static const struct {
        const char *name;
        int column, exact;
    } stress[] = {{"sigma_r", 6, 8}, {"sigma_theta", 7, 9}};
    scene_coupling coupling[COUPLING_COUNT];
    const int n = compare_couplings(c, coupling);
    int plots = 0;
    strbuf_append(script, "\nset terminal svg size 800,500 background rgb 'white'\nset output 'profile.svg'\n"
                          "set xlabel 'r (m)'\nset ylabel 'stress along the x axis (MPa)'\nset grid\n"
                          "set key noenhanced\nset format y '%%g'\nplot ");
    for (int q = 0; q < 2; q++) {
        strbuf_append(script,
                      "%s'profile.csv' every ::1 using 5:($%d/1e6) smooth unique with lines lw 2 lc %d title '%s, %s'",
                      plots++ ? ", \\\n     " : "", stress[q].exact, q + 1, stress[q].name, c->exact);
        for (int k = 0; k < n; k++) {
            const char *name = coupling_name(coupling[k]);
            if (!finest(c, coupling[k])) continue;
            strbuf_append(script,
                          ", \\\n     'profile.csv' every ::1 using (strcol(1) eq '%s' ? $5 : NaN):($%d/1e6) with "
                          "points pt %d lc %d title '%s, %s'",
                          name, stress[q].column, 5 + 2 * k, q + 1, stress[q].name, name);
        }
    }
    strbuf_append(script, "\nunset output\n");
}

static floe_status add_profiles(const comparison *c, strbuf *script)
{
    scene_coupling coupling[COUPLING_COUNT];
    const int n = compare_couplings(c, coupling);
    char path[COMPARE_PATH];
    strbuf rows;
    floe_status status = FLOE_OK;
    strbuf_init(&rows, c->ctx);
    for (int k = 0; k < n && status == FLOE_OK; k++) {
        const compare_case *one = finest(c, coupling[k]);
        if (one) status = append_profile(c, one, &rows);
    }
    (void)snprintf(path, sizeof path, "%s/profile.csv", c->dir);
    if (status == FLOE_OK && rows.length > 0) {
        status = file_replace_text(c->ctx, path, strbuf_string(&rows));
        append_profile_plot(c, script);
    }
    strbuf_free(&rows);
    return status;
}

static floe_status fill(const comparison *c, strbuf *script)
{
    const char *metric[COMPARE_MAX_METRICS];
    const int n = compare_metrics(c, metric);
    scene_coupling coupling[COUPLING_COUNT];
    const int couplings = compare_couplings(c, coupling);
    strbuf_append(script, "# %s\n# In this folder: gnuplot compare.gp\nset datafile separator ','\n", c->title);
    for (int k = 0; k < couplings; k++) append_data(c, coupling[k], metric, n, script);
    append_errors(c, metric, n, script);
    TRY(add_profiles(c, script));
    return script->status;
}

floe_status compare_plot(const comparison *c)
{
    char path[COMPARE_PATH];
    strbuf script;
    strbuf_init(&script, c->ctx);
    (void)snprintf(path, sizeof path, "%s/compare.gp", c->dir);
    floe_status status = fill(c, &script);
    if (status == FLOE_OK) status = file_replace_text(c->ctx, path, strbuf_string(&script));
    strbuf_free(&script);
    if (status == FLOE_OK) gnuplot_run(c->ctx, c->dir, "compare.gp");
    return status;
}
