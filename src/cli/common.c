/* What the commands share. */
#include "base/wrapped.h"
#include "cli/cli.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { CLI_MESSAGE = 16384, DECK_MARGIN = 7 };

static const char *red_escape(const cli *c)
{
    return c->colour ? "\033[1;31m" : "";
}

static const char *plain_escape(const cli *c)
{
    return c->colour ? "\033[0m" : "";
}

void cli_error(const cli *c, const char *format, ...)
{
    char text[CLI_MESSAGE];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    wrapped_printf(stderr, "floe: %serror:%s %s\n", red_escape(c), plain_escape(c), text);
}

static int fail_with(const cli *c, floe_status status, const char *message)
{
    if (status == FLOE_INTERRUPTED) {
        wrapped_printf(stderr, "floe: %s\n", message);
    } else {
        cli_error(c, "%s", message[0] ? message : status_text(status));
    }
    return status_exit(status);
}

int cli_fail(const cli *c, floe_status status)
{
    return fail_with(c, status, context_message(c->ctx));
}

int cli_end(const cli *c, floe_status status)
{
    return status == FLOE_OK ? 0 : fail_with(c, status, floe_message(c->floe));
}

static void print_line(const cli *c, bool is_error, bool is_warning, const char *line)
{
    if (is_error) {
        cli_error(c, "%s", line);
    } else if (is_warning && !c->quiet) {
        wrapped_printf(stderr, "floe: warning: %s\n", line);
    }
}

void cli_sink(void *user, log_level level, const char *line)
{
    print_line(user, level == LOG_ERROR, level == LOG_WARNING, line);
}

void cli_log(void *user, floe_log_level level, const char *line)
{
    print_line(user, level == FLOE_LOG_ERROR, level == FLOE_LOG_WARNING, line);
}

floe_status cli_load(const cli *c, const cli_deck *d, bool axes, floe_deck **out)
{
    return axes ? floe_validate(c->floe, d->path, d->set, d->n_set, out)
                : floe_load(c->floe, d->path, d->set, d->n_set, out);
}

/* A line of what is wrong with a deck, the word "error:" in colour on a terminal. Lines of the deck stay whole. */
static void print_refusal_line(const cli *c, const char *line, int length)
{
    static const char word[] = "error:";
    const char *at = strstr(line, word);
    if (length > DECK_MARGIN && line[DECK_MARGIN] == '|') {
        (void)fprintf(stderr, "%.*s\n", length, line);
    } else if (at && at < line + length) {
        const int before = (int)(at - line), after = length - before - (int)strlen(word);
        wrapped_printf(stderr, "%.*s%s%s%s%.*s\n", before, line, red_escape(c), word, plain_escape(c), after,
                       at + strlen(word));
    } else {
        wrapped_printf(stderr, "%.*s\n", length, line);
    }
}

/* The errors of a deck, the word "error:" in colour on a terminal; the last line says how many there are. */
int cli_refused(const cli *c, floe_status status)
{
    const char *text = floe_message(c->floe), *last = strrchr(text, '\n');
    if (!last) return cli_end(c, status);
    for (const char *end; text < last; text = end + 1) {
        end = strchr(text, '\n');
        print_refusal_line(c, text, (int)(end - text));
    }
    return fail_with(c, status, last + 1);
}

error_t cli_deck_option(cli_deck *d, int key, char *arg, struct argp_state *state)
{
    switch (key) {
    case 's':
        if (!strchr(arg, '=')) argp_error(state, "--set takes KEY=VALUE, not '%s'", arg);
        if (d->n_set == CLI_MAX_SET) argp_error(state, "more than %d --set", CLI_MAX_SET);
        d->set[d->n_set++] = arg;
        return 0;
    case 'c':
        if (d->n_set == CLI_MAX_SET) argp_error(state, "more than %d --set", CLI_MAX_SET);
        (void)snprintf(d->coupling, sizeof d->coupling, "coupling=%.80s", arg);
        d->set[d->n_set++] = d->coupling;
        return 0;
    case ARGP_KEY_ARG:
        if (d->path) argp_error(state, "one deck at a time: '%s' is too much", arg);
        d->path = arg;
        return 0;
    case ARGP_KEY_END:
        if (!d->path) argp_error(state, "which deck? (a YAML file; `floe new` writes one to start from)");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

double cli_number(struct argp_state *state, const char *option, const char *arg)
{
    char *end;
    errno = 0;
    const double value = strtod(arg, &end);
    if (end == arg || *end != '\0' || errno != 0 || !isfinite(value) || !(value > 0.0))
        argp_error(state, "--%s takes a number > 0, not '%s'", option, arg);
    return value;
}

int cli_whole(struct argp_state *state, const char *option, const char *arg)
{
    char *end;
    errno = 0;
    const long value = strtol(arg, &end, 10);
    if (end == arg || *end != '\0' || errno != 0 || value < 1 || value > 1024)
        argp_error(state, "--%s takes a whole number from 1 to 1024, not '%s'", option, arg);
    return (int)value;
}

void cli_stem(const char *path, char stem[CLI_PATH])
{
    const char *slash = strrchr(path, '/');
    (void)snprintf(stem, CLI_PATH, "%s", slash ? slash + 1 : path);
    char *dot = strrchr(stem, '.');
    if (dot && dot != stem) *dot = '\0';
}

/* Longer names than this are cut short, and told apart by a hash. */
enum { SUFFIX_MOST = 120 };

/* FNV-1a. */
static unsigned long hash_of(const cli_deck *d)
{
    unsigned long hash = 2166136261UL;
    for (size_t k = 0; k < d->n_set; k++)
        for (const char *c = d->set[k]; *c; c++) hash = ((hash ^ (unsigned char)*c) * 16777619UL) & 0xffffffffUL;
    return hash;
}

/* "KEY=VALUE", with one '_' for what a file system may not like. */
static size_t append_setting(char *text, size_t at, size_t size, const char *setting)
{
    if (at + 1 < size) text[at++] = '-';
    for (const char *c = setting; *c && at + 1 < size; c++) {
        const bool plain = isalnum((unsigned char)*c) || strchr("._-+=", *c);
        if (plain || text[at - 1] != '_') text[at++] = plain ? *c : '_';
    }
    text[at] = '\0';
    return at;
}

void cli_default_folder(const cli_deck *d, const char *kind, char *dir, size_t size)
{
    char stem[CLI_PATH], suffix[4096] = "";
    size_t length = 0;
    cli_stem(d->path, stem);
    for (size_t k = 0; k < d->n_set; k++)
        if (d->set[k] != d->coupling) length = append_setting(suffix, length, sizeof suffix, d->set[k]);
    if (length > SUFFIX_MOST) (void)snprintf(suffix + SUFFIX_MOST, 32, "~%08lx", hash_of(d));
    (void)snprintf(dir, size, "out/%s-%s%s", stem, kind, suffix);
}
