/* One deck is one scene: every key is changed, in a scene where it matters (tests/cli/decks/keys.recipes), as mpm, ice and ice-mpm. Where the
 * results stay the same to the last digit, the run must have been refused or the key warned of. With FLOE_VERDICTS=FILE a line for each is
 * written there. All in one process: most of a run this small is its start. */
#include "check.h"

#include "base/memory.h"
#include "base/strbuf.h"
#include "deck/deck.h"
#include "io/file.h"
#include "io/io.h"
#include "run/catalogue.h"
#include "run/run.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PATH = 512, LINE = 4096, MOST_SET = 32, MOST_SCENES = 1024, MOST_KEYS = 512 };

static const char *const coupling[] = {"mpm", "ice", "ice-mpm"};

/* What has come of a run. */
typedef struct outcome {
    floe_status status;
    strbuf said, results;
} outcome;

typedef struct scene_base {
    char *place; /* coupling and settings */
    outcome is;
} scene_base;

typedef struct fixture {
    context *ctx;
    char *recipes, folder[PATH];
    scene_base base[MOST_SCENES];
    int n_bases, missed;
    const char *key[MOST_KEYS]; /* in the order of the recipes */
    bool heeded[MOST_KEYS];
    int n_keys;
    FILE *verdicts; /* NULL: not asked for */
} fixture;

static int set_up(void **state)
{
    static fixture f;
    f = (fixture){.ctx = context_create()};
    /* In memory, where there is such a folder: most of the wait is for a disk. */
    (void)snprintf(f.folder, sizeof f.folder, "%s/floe_keys_XXXXXX",
                   access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp");
    if (!f.ctx || !mkdtemp(f.folder)) return -1;
    deck_init();
    if (getenv("FLOE_VERDICTS")) f.verdicts = fopen(getenv("FLOE_VERDICTS"), "w");
    *state = &f;
    return file_read(f.ctx, FLOE_SOURCE_DIR "/tests/cli/decks/keys.recipes", &f.recipes, NULL) == FLOE_OK ? 0 : -1;
}

static void outcome_free(outcome *o)
{
    strbuf_free(&o->said);
    strbuf_free(&o->results);
}

static int tear_down(void **state)
{
    fixture *f = *state;
    char command[PATH + 16];
    (void)snprintf(command, sizeof command, "rm -rf '%s'", f->folder);
    const int status = system(command);
    for (int k = 0; k < f->n_bases; k++) {
        memory_free(f->ctx, &f->base[k].place);
        outcome_free(&f->base[k].is);
    }
    if (f->verdicts) (void)fclose(f->verdicts);
    memory_free(f->ctx, &f->recipes);
    context_destroy(&f->ctx);
    return status;
}

/* Settings of a run, cut out of their text at blanks outside brackets; what names the deck and the couplings is none. */
typedef struct settings {
    char text[2 * LINE];
    const char *set[MOST_SET];
    size_t n, used;
} settings;

static void add_setting(settings *s, const char *text, size_t length)
{
    if (length == 0 || strncmp(text, "DECK=", 5) == 0 || strncmp(text, "ONLY=", 5) == 0) return;
    check_true(s->n < MOST_SET && s->used + length < sizeof s->text);
    char *own = s->text + s->used;
    memcpy(own, text, length);
    own[length] = '\0';
    s->used += length + 1;
    s->set[s->n++] = own;
}

static void add_settings(settings *s, const char *text)
{
    const char *start = text;
    for (int depth = 0; *text; text++) {
        depth += (*text == '[' || *text == '{') - (*text == ']' || *text == '}');
        if (*text != ' ' || depth > 0) continue;
        add_setting(s, start, (size_t)(text - start));
        start = text + 1;
    }
    add_setting(s, start, (size_t)(text - start));
}

/* The word after NAME= in the settings of a scene, "" without. */
static void word_of(const char *with, const char *name, char word[PATH])
{
    const char *at = strstr(with, name);
    word[0] = '\0';
    if (at) (void)snprintf(word, PATH, "%.*s", (int)strcspn(at + strlen(name), " "), at + strlen(name));
}

static bool takes(const char *with, const char *name)
{
    char only[PATH], list[PATH + 2], wanted[PATH + 2];
    word_of(with, "ONLY=", only);
    (void)snprintf(list, sizeof list, ",%s,", only);
    (void)snprintf(wanted, sizeof wanted, ",%s,", name);
    return !only[0] || strstr(list, wanted);
}

/* Removes the files of a folder: a run leaves what is there of others. */
static void clear_folder(const char *dir, const char *below)
{
    char path[PATH + 300];
    (void)snprintf(path, sizeof path, "%s%s", dir, below);
    DIR *folder = opendir(path);
    for (const struct dirent *e = folder ? readdir(folder) : NULL; e; e = readdir(folder)) {
        (void)snprintf(path, sizeof path, "%s%s/%s", dir, below, e->d_name);
        (void)unlink(path);
    }
    if (folder) (void)closedir(folder);
}

static void append_line(void *user, log_level level, const char *line)
{
    (void)level;
    strbuf_append(user, "%s\n", line);
}

/* A file of the run, if it is there. */
static void append_file(context *ctx, const char *dir, const char *name, strbuf *out)
{
    char path[2 * PATH], *text;
    (void)snprintf(path, sizeof path, "%s/%s", dir, name);
    if (!file_exists(path)) return;
    check_ok(ctx, file_read(ctx, path, &text, NULL));
    strbuf_append(out, "%s", text);
    memory_free(ctx, &text);
}

static int count_files(const char *dir)
{
    char path[2 * PATH];
    int n = 0;
    (void)snprintf(path, sizeof path, "%s/fields", dir);
    DIR *folder = opendir(path);
    assert_non_null(folder);
    while (readdir(folder)) n++;
    (void)closedir(folder);
    return n;
}

static void append_results(context *ctx, const char *dir, const run_summary *r, strbuf *out)
{
    append_file(ctx, dir, "history.csv", out);
    append_file(ctx, dir, "profile.csv", out);
    strbuf_append(out, "%d files, %lld steps, %lld points, %.17g s\n", count_files(dir), r->steps, r->points, r->time);
    for (int k = 0; k < r->n_errors; k++) strbuf_append(out, "%s %.17g\n", r->errors[k].name, r->errors[k].value);
}

/* Runs the deck; what it says and what comes out are appended. */
static floe_status run_deck(context *ctx, const char *deck, const settings *s, const char *dir, strbuf *said,
                            strbuf *results)
{
    deck_catalogue *catalogue;
    deck_report report = {0};
    run_summary summary;
    scene *of;
    check_ok(ctx, io_init(ctx));
    check_ok(ctx, catalogue_create(&catalogue, ctx));
    floe_status status = deck_load(&of, ctx, deck, &(deck_overrides){s->set, s->n}, catalogue, &report);
    if (report.text) strbuf_append(said, "%s", report.text);
    deck_report_free(&report);
    catalogue_destroy(ctx, &catalogue);
    if (status != FLOE_OK) return status;
    const run_options options = {
        .dir = dir, .threads = 1, .sink = append_line, .sink_user = said, .sink_detail = LOG_WARNING};
    status = run_scene(ctx, of, &options, &summary);
    scene_destroy(&of);
    if (status == FLOE_OK) append_results(ctx, dir, &summary, results);
    return status;
}

static outcome run_with(fixture *f, const char *as, const char *with, const char *change)
{
    static const char *const alone[] = {"study=null", "compare=null", "stability=null"};
    char deck[2 * PATH], name[PATH], first[PATH];
    settings s = {.n = 0};
    outcome o;
    context *ctx = context_create();
    strbuf_init(&o.said, f->ctx);
    strbuf_init(&o.results, f->ctx);
    word_of(with, "DECK=", name);
    (void)snprintf(deck, sizeof deck, "%s/%s/%s.yaml", FLOE_SOURCE_DIR,
                   !name[0] || strncmp(name, "keys_", 5) == 0 ? "tests/cli/decks" : "inputs", name[0] ? name : "keys");
    (void)snprintf(first, sizeof first, "coupling=%s runs_as=[%s]", as, as);
    add_settings(&s, first);
    for (int k = 0; k < 3; k++) add_settings(&s, alone[k]);
    if (!name[0] && strcmp(as, "ice") == 0) add_settings(&s, "bodies.block=null bodies.other=null");
    add_settings(&s, with);
    add_settings(&s, change);
    clear_folder(f->folder, "/fields");
    clear_folder(f->folder, "");
    o.status = run_deck(ctx, deck, &s, f->folder, &o.said, &o.results);
    if (o.status != FLOE_OK) strbuf_append(&o.said, "%s\n", context_message(ctx));
    context_clear(ctx);
    context_destroy(&ctx);
    return o;
}

/* The scene without the change, run once. */
static const outcome *base_of(fixture *f, const char *as, const char *with)
{
    char place[LINE];
    (void)snprintf(place, sizeof place, "%s %s", as, with);
    for (int k = 0; k < f->n_bases; k++)
        if (strcmp(f->base[k].place, place) == 0) return &f->base[k].is;
    assert_true(f->n_bases < MOST_SCENES);
    scene_base *base = &f->base[f->n_bases++];
    check_ok(f->ctx, memory_new(f->ctx, &base->place, strlen(place) + 1, 1));
    memcpy(base->place, place, strlen(place) + 1);
    base->is = run_with(f, as, with, "");
    return &base->is;
}

/* A warning names the key of the change, or what holds it. */
static bool is_warned_of(const char *said, const char *change)
{
    char key[LINE], above[LINE];
    const char *dot = strrchr(change, '.');
    (void)snprintf(key, sizeof key, "%.*s", (int)strcspn(change, "="), change);
    (void)snprintf(above, sizeof above, "%.*s", dot ? (int)(dot - change) : (int)strlen(change), change);
    return strstr(said, key) || strstr(said, above);
}

static void miss(fixture *f, const char *key, const char *as, const char *what, const char *said)
{
    print_error("%s as %s: %s: %.300s\n", key, as, what, said);
    f->missed++;
}

static void tell(const fixture *f, const char *key, const char *as, const char *verdict)
{
    if (f->verdicts) (void)fprintf(f->verdicts, "%s %s %s\n", key, as, verdict);
}

static bool try_key(fixture *f, const char *key, const char *as, const char *with, const char *change)
{
    const outcome *before = base_of(f, as, with);
    if (before->status != FLOE_OK && before->status != FLOE_BAD_INPUT)
        miss(f, key, as, "the scene does not end well", strbuf_string(&before->said));
    if (before->status != FLOE_OK) {
        tell(f, key, as, "refused-scene");
        return false;
    }
    outcome after = run_with(f, as, with, change);
    const bool heeded =
        after.status == FLOE_OK && strcmp(strbuf_string(&before->results), strbuf_string(&after.results)) != 0;
    if (heeded)
        tell(f, key, as, "heeded");
    else if (after.status == FLOE_BAD_INPUT)
        tell(f, key, as, "refused");
    else if (after.status == FLOE_OK && is_warned_of(strbuf_string(&after.said), change))
        tell(f, key, as, "warned");
    else
        miss(f, key, as, after.status == FLOE_OK ? "nothing changes, and nothing is said" : strbuf_string(&after.said),
             change);
    outcome_free(&after);
    return heeded;
}

static int number_of(fixture *f, const char *key)
{
    for (int k = 0; k < f->n_keys; k++)
        if (strcmp(f->key[k], key) == 0) return k;
    assert_true(f->n_keys < MOST_KEYS);
    f->key[f->n_keys] = key;
    return f->n_keys++;
}

/* Cuts the next field of a line off; the line goes on behind it. */
static char *field_of(char **line, char end)
{
    char *field = *line, *stop = strchr(field, end);
    assert_non_null(stop);
    *stop = '\0';
    *line = stop + 1;
    return field;
}

static void every_key_is_heeded_refused_or_warned_of(void **state)
{
    fixture *f = *state;
    for (char *line = f->recipes; *line;) {
        char *rest = field_of(&line, '\n');
        if (rest[0] == '#') continue;
        const char *key = field_of(&rest, '|'), *with = field_of(&rest, '|');
        const int n = number_of(f, key);
        for (size_t c = 0; c < sizeof coupling / sizeof *coupling; c++)
            if (takes(with, coupling[c]) && try_key(f, key, coupling[c], with, rest)) f->heeded[n] = true;
    }
    for (int k = 0; k < f->n_keys; k++) /* somewhere it must matter */
        if (!f->heeded[k]) miss(f, f->key[k], "all couplings", "it matters nowhere", "");
    check_true(f->n_keys > 100);
    assert_int_equal(f->missed, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_key_is_heeded_refused_or_warned_of, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
