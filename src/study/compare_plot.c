/* A comparison as pictures, by gnuplot: the script and its data stand in the folder whether gnuplot is there or not. */
#include "study/compare.h"

#include "base/memory.h"
#include "draw/gnuplot.h"
#include "io/file.h"
#include "io/strbuf.h"
#include "study/errors.h"

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
        if (one->coupling != coupling || !one->run->ran) continue;
        strbuf_append(out, "%.9g,%.9g", one->h, one->run->summary.wall_seconds);
        for (int k = 0; k < n; k++) {
            const double error = error_of(&one->run->summary, metric[k]);
            if (error > 0.0) {
                strbuf_append(out, ",%.9g", error * (error_is_relative(metric[k]) ? 100.0 : 1.0));
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
        if (error_of(&c->run[i].summary, metric) > 0.0) return true;
    }
    return false;
}

static void append_panel(const comparison *c, const char *metric, int column, int x, strbuf *out)
{
    scene_coupling coupling[COUPLING_COUNT];
    const int n = compare_couplings(c, coupling);
    const char *unit = error_unit(metric);
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

static void profile_path(const comparison *c, const compare_case *one, char path[COMPARE_PATH])
{
    (void)snprintf(path, COMPARE_PATH, "%s/%s/profile.csv", c->dir, one->run->folder);
}

/* The finest case of a coupling that has come to its end with a profile; NULL if none. */
static const compare_case *finest(const comparison *c, scene_coupling coupling)
{
    const compare_case *best = NULL;
    for (size_t i = 0; i < c->n; i++) {
        const compare_case *one = &c->list[i];
        char path[COMPARE_PATH];
        if (one->coupling != coupling || !one->run->ran || one->run->status != FLOE_OK) continue;
        profile_path(c, one, path);
        if (file_exists(path) && (!best || one->h < best->h)) best = one;
    }
    return best;
}

/* The case's profile.csv, counted memory that the caller frees. */
static floe_status read_profile(const comparison *c, const compare_case *one, char **text)
{
    char path[COMPARE_PATH];
    profile_path(c, one, path);
    return file_read(c->ctx, path, text, NULL);
}

/* Adds the rows of a case's profile, with coupling and h before each; the names once. */
static floe_status append_profile(const comparison *c, const compare_case *one, strbuf *out)
{
    char *text;
    TRY(read_profile(c, one, &text));
    const bool first = out->length == 0;
    bool names = true;
    for (const char *line = text, *end = strchr(line, '\n'); end; line = end + 1, end = strchr(line, '\n')) {
        if (names && first) strbuf_append(out, "coupling,h (m),");
        if (!names) strbuf_append(out, "%s,%.9g,", coupling_name(one->coupling), one->h);
        if (!names || first) strbuf_append(out, "%.*s", (int)(end + 1 - line), line);
        names = false;
    }
    memory_free(c->ctx, &text);
    return out->status;
}

enum { MAX_COLUMNS = 64 };

/* "sigma_r (Pa)": columns of the profile are named so. */
typedef struct profile_column {
    char name[64], unit[32];
} profile_column;

/* The first line of a profile as columns, numbered from 1 as gnuplot does; returns how many. */
static int read_columns(const char *text, profile_column column[MAX_COLUMNS + 1])
{
    int n = 0;
    while (*text && *text != '\n' && n < MAX_COLUMNS) {
        const size_t field = strcspn(text, ",\n"), name = strcspn(text, " ,\n");
        profile_column *at = &column[++n];
        *at = (profile_column){{0}, {0}};
        (void)snprintf(at->name, sizeof at->name, "%.*s", (int)name, text);
        if (field > name + 2)
            (void)snprintf(at->unit, sizeof at->unit, "%.*s", (int)(field - name - 3), text + name + 2);
        text += field + (text[field] == ',');
    }
    return n;
}

/* 0 if there is none of that name. */
static int find_column(const profile_column *column, int n, const char *prefix, const char *name)
{
    char wanted[80];
    (void)snprintf(wanted, sizeof wanted, "%s%s", prefix, name);
    for (int k = 1; k <= n; k++) {
        if (strcmp(column[k].name, wanted) == 0) return k;
    }
    return 0;
}

/* One panel: every quantity of that unit, as it is exactly and by each coupling. */
static void append_profile_panel(const comparison *c, const profile_column *column, int n, const char *unit, int x,
                                 strbuf *script)
{
    scene_coupling coupling[COUPLING_COUNT];
    const int couplings = compare_couplings(c, coupling);
    int plots = 0;
    bool stress = true;
    for (int k = 1; k <= n; k++) {
        if (strcmp(column[k].unit, unit) == 0 && find_column(column, n, "exact_", column[k].name))
            stress = stress && strncmp(column[k].name, "sigma_", 6) == 0;
    }
    strbuf_append(script, "set xlabel '%s (m)'\nset ylabel '%s'\nplot ", column[x].name, stress ? "MPa" : unit);
    for (int k = 1; k <= n; k++) {
        const int exact = find_column(column, n, "exact_", column[k].name);
        if (!exact || strcmp(column[k].unit, unit) != 0) continue;
        const char *scale = stress ? "/1e6" : "";
        for (int q = 0; q < couplings; q++) {
            const char *name = coupling_name(coupling[q]);
            if (!finest(c, coupling[q])) continue;
            strbuf_append(script,
                          "%s'profile.csv' every ::1 using (strcol(1) eq '%s' ? $%d : NaN):($%d%s) with points pt %d "
                          "ps 0.6 lc %d title '%s, %s'",
                          plots++ ? ", \\\n     " : "", name, x, k, scale, 6 + 6 * q, q + 1, column[k].name, name);
        }
        strbuf_append(script,
                      "%s'profile.csv' every ::1 using %d:($%d%s) smooth unique with lines lw 1.5 lc rgb 'black' "
                      "title '%s, %s'",
                      plots++ ? ", \\\n     " : "", x, exact, scale, column[k].name, c->exact);
    }
    strbuf_append(script, "\n");
}

/* A panel for every unit, in the order of the profile's columns. */
static void append_profile_plot(const comparison *c, const char *names, strbuf *script)
{
    profile_column column[MAX_COLUMNS + 1];
    const int n = read_columns(names, column);
    int panel[MAX_COLUMNS + 1], panels = 0;
    int x = find_column(column, n, "", "r");
    if (!x) x = find_column(column, n, "", "x");
    for (int k = 1; k <= n; k++) {
        bool known = !find_column(column, n, "exact_", column[k].name);
        for (int i = 0; i < panels; i++) known = known || strcmp(column[panel[i]].unit, column[k].unit) == 0;
        if (!known) panel[panels++] = k;
    }
    if (!x || panels == 0) return;
    const int rows = (panels + 1) / 2, columns = panels > 1 ? 2 : 1;
    strbuf_append(script,
                  "\nset terminal svg size %d,%d background rgb 'white'\nset output 'profile.svg'\n"
                  "set multiplot layout %d,%d\nset grid\nset key noenhanced\nset format y '%%g'\n",
                  columns == 1 ? 800 : 1000, columns == 1 ? 500 : 360 * rows, rows, columns);
    for (int i = 0; i < panels; i++) append_profile_panel(c, column, n, column[panel[i]].unit, x, script);
    strbuf_append(script, "unset multiplot\nunset output\n");
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
        append_profile_plot(c, strbuf_string(&rows), script);
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
    if (status == FLOE_OK) (void)gnuplot_run(c->ctx, c->dir, (const char *const[]){"compare.gp"}, 1);
    return status;
}
