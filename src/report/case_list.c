#include "report/case_list.h"

#include "base/memory.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static int find_text(const char *const *list, int n, const char *text)
{
    for (int k = 0; k < n; k++) {
        if (strcmp(list[k], text) == 0) return k;
    }
    return -1;
}

/* Takes note of a text that is new; returns its number, or the last one when the list is full. */
static int list_text_once(const char **list, int *n, int reserved, const char *text)
{
    const int known = find_text(list, *n, text);
    if (known >= 0) return known;
    if (*n < reserved) list[(*n)++] = text;
    return *n - 1;
}

static double sum_of_counts(const json_t *run)
{
    const double points = json_number_of(run, "point_updates"), cells = json_number_of(run, "cell_updates");
    return (points > 0.0 ? points : 0.0) + (cells > 0.0 ? cells : 0.0);
}

/* The value of what is varied along a curve: {"domain.cell": "0.05"}. */
static void read_axis_value(case_list *c, case_entry *e)
{
    json_t *axis = json_object_get(e->run, "axis"), *value;
    const char *key;
    e->value = "";
    json_object_foreach(axis, key, value)
    {
        if (json_is_string(value)) e->value = json_string_value(value);
        c->axis = key;
    }
}

/* Takes note of the names of an object's members. */
static void note_names(json_t *object, const char **list, int *n, int reserved)
{
    const char *name;
    json_t *value;
    json_object_foreach(object, name, value)
    {
        (void)value;
        (void)list_text_once(list, n, reserved, name);
    }
}

static double time_of(const json_t *run)
{
    const double best = json_number_of(json_object_get(run, "timing"), "best");
    const double output = json_number_of(run, "output_seconds"), wall = json_number_of(run, "wall_seconds");
    return isfinite(best) ? best : isfinite(output) ? wall - output : wall;
}

static void read_case(case_list *c, const json_t *run)
{
    case_entry *e = &c->list[c->n++];
    *e = (case_entry){.run = run,
                      .status = json_text_of(run, "status"),
                      .directory = json_text_of(run, "directory"),
                      .variant = json_text_of(run, "group"),
                      .h = json_number_of(run, "h"),
                      .wall = time_of(run),
                      .updates = sum_of_counts(run),
                      .disturbed = json_is_true(json_object_get(json_object_get(run, "timing"), "disturbed"))};
    c->dimensionless = c->dimensionless || strcmp(json_text_of(run, "units"), "none") == 0;
    if (!e->variant[0]) e->variant = json_text_of(run, "coupling");
    read_axis_value(c, e);
    e->colour = list_text_once(c->variant, &c->n_variants, CASE_MAX_VARIANTS, e->variant);
    note_names(json_object_get(run, "errors"), c->metric, &c->n_metrics, CASE_MAX_METRICS);
    note_names(json_object_get(run, "quantities"), c->quantity, &c->n_quantities, CASE_MAX_METRICS);
}

/* The keys that are varied; older comparisons only had the coupling and one key. */
static void read_axis_keys(case_list *c, const json_t *object)
{
    const json_t *axes = json_object_get(object, "axes");
    for (size_t i = 0; i < json_array_size(axes); i++)
        (void)list_text_once(c->axes, &c->n_axes, CASE_MAX_AXES, json_text_of(json_array_get(axes, i), "key"));
    if (c->n_axes > 0) return;
    (void)list_text_once(c->axes, &c->n_axes, CASE_MAX_AXES, "coupling");
    if (c->axis[0]) (void)list_text_once(c->axes, &c->n_axes, CASE_MAX_AXES, c->axis);
}

/* What the cases are spread along: the spacing where it differs, else the axis if its values are numbers. */
static void find_direction(case_list *c)
{
    bool numbers = c->n > 0 && c->axis[0];
    for (size_t i = 0; i < c->n; i++) {
        char *end;
        c->along_h = c->along_h || c->list[i].h != c->list[0].h;
        (void)strtod(c->list[i].value, &end);
        numbers = numbers && end != c->list[i].value && *end == '\0';
    }
    c->along_value = numbers && !c->along_h;
}

floe_status case_list_read(case_list *c, context *ctx, const json_t *object)
{
    const json_t *runs = json_object_get(object, "runs");
    *c = (case_list){.ctx = ctx, .axis = ""};
    TRY(memory_new(ctx, &c->list, json_array_size(runs) + 1, sizeof *c->list));
    for (size_t i = 0; i < json_array_size(runs); i++) read_case(c, json_array_get(runs, i));
    read_axis_keys(c, object);
    find_direction(c);
    return FLOE_OK;
}

void case_list_free(case_list *c)
{
    memory_free(c->ctx, &c->list);
}

double case_place(const case_list *c, const case_entry *e)
{
    if (c->along_h) return e->h;
    return c->along_value ? strtod(e->value, NULL) : (double)NAN;
}

bool case_is_done(const case_entry *e)
{
    return strcmp(e->status, "done") == 0 || strcmp(e->status, "at_rest") == 0;
}

const char *case_setting(const case_entry *e, const char *key)
{
    const char *text = json_text_of(json_object_get(e->run, "settings"), key);
    if (!text[0]) text = json_text_of(json_object_get(e->run, "axis"), key);
    return text[0] ? text : json_text_of(e->run, key);
}

double case_error(const case_entry *e, const char *metric)
{
    if (!case_is_done(e)) return NAN;
    return json_number_of(json_object_get(e->run, "errors"), metric);
}

void case_title(const case_list *c, const case_entry *e, char title[PAGE_TEXT])
{
    (void)snprintf(title, PAGE_TEXT, "%s%s%s%s%s", e->variant, e->value[0] ? ", " : "", e->value[0] ? c->axis : "",
                   e->value[0] ? " = " : "", e->value);
}

static bool is_better(const case_entry *a, const case_entry *b, const char *metric)
{
    const double ea = case_error(a, metric), eb = case_error(b, metric);
    return ea <= eb && a->wall <= b->wall && (ea < eb || a->wall < b->wall);
}

size_t case_front(const case_list *c, const char *metric, size_t *front)
{
    size_t n = 0;
    for (size_t i = 0; i < c->n; i++) {
        const case_entry *e = &c->list[i];
        bool beaten = !isfinite(case_error(e, metric)) || !isfinite(e->wall);
        for (size_t k = 0; k < c->n && !beaten; k++) beaten = is_better(&c->list[k], e, metric);
        if (beaten) continue;
        size_t at = n++;
        for (; at > 0 && c->list[front[at - 1]].wall > e->wall; at--) front[at] = front[at - 1];
        front[at] = i;
    }
    return n;
}
