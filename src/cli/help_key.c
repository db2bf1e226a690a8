/* floe help KEY: what the reference of decks says of a key. */
#include "base/memory.h"
#include "cli/cli.h"
#include "run/catalogue.h"

#include <string.h>

enum { HELP_WIDTH = 80, HELP_KEY = 256 };

/* Words of one cell of a table, `width` to a line; ends at " | ". */
static const char *print_cell(const char *text, const char *indent)
{
    size_t column = 0;
    while (*text != '\0' && *text != '\n' && strncmp(text, " |", 2) != 0) {
        const size_t word = strcspn(text, " \n");
        const size_t space = column > 0 ? 1 : 0;
        const bool fits = column > 0 && strlen(indent) + column + space + word <= HELP_WIDTH;
        if (!fits) (void)printf("%s%s", column > 0 ? "\n" : "", indent);
        (void)printf("%s%.*s", fits ? " " : "", (int)word, text);
        column = fits ? column + space + word : word;
        text += word;
        if (*text == ' ' && text[1] != '|') text++;
    }
    (void)printf("\n");
    return strncmp(text, " | ", 3) == 0 ? text + 3 : text;
}

/* Whether `asked` is the key, whole or its last word; NAME stands for any name. */
static bool is_asked(const char *asked, const char *full)
{
    const char *last = strrchr(full, '.');
    if (last && strcmp(last + 1, asked) == 0) return true;
    while (*asked != '\0' && *full != '\0') {
        const size_t a = strcspn(asked, "."), f = strcspn(full, ".");
        if (!(f == 4 && strncmp(full, "NAME", 4) == 0) && (a != f || strncmp(asked, full, a) != 0)) return false;
        asked += a + (asked[a] == '.' ? 1 : 0);
        full += f + (full[f] == '.' ? 1 : 0);
    }
    return *asked == '\0' && *full == '\0';
}

/* "bodies.motion" of "bodies.block.motion": items of a list have one section for all. */
static const char *without_name(const char *key, char other[HELP_KEY])
{
    const char *name = strchr(key, '.'), *rest = name ? strchr(name + 1, '.') : NULL;
    if (!rest) return key;
    (void)snprintf(other, HELP_KEY, "%.*s%s", (int)(name - key), key, rest);
    return other;
}

/* A row of the reference, "| `key` | what may stand there | default | what it is |", if it is that of the key. */
static bool explain_row(const char *row, const char *section, const char *asked)
{
    char key[HELP_KEY / 4], full[HELP_KEY + sizeof key + 1], other[HELP_KEY];
    if (strncmp(row, "| `", 3) != 0) return false;
    const size_t length = strcspn(row + 3, "`");
    if (length >= sizeof key) return false;
    memcpy(key, row + 3, length);
    key[length] = '\0';
    const bool top = strcmp(section, "Top level") == 0;
    (void)snprintf(full, sizeof full, "%s%s%s", top ? "" : section, top ? "" : ".", key);
    if (!is_asked(asked, full) && !is_asked(without_name(asked, other), full)) return false;
    const char *cell = strstr(row, " | ");
    (void)printf("%s\n", full);
    for (cell = cell ? cell + 3 : NULL; cell && *cell != '\n' && *cell != '\0' && *cell != ' ';)
        cell = print_cell(cell, "    ");
    return true;
}

int cli_help_key(cli *c, const char *key)
{
    deck_catalogue *catalogue;
    char *text, section[HELP_KEY] = "";
    int found = 0;
    floe_status status = catalogue_create(&catalogue, c->ctx);
    if (status != FLOE_OK) return cli_fail(c, status);
    status = deck_reference(&text, c->ctx, catalogue);
    catalogue_destroy(c->ctx, &catalogue);
    if (status != FLOE_OK) return cli_fail(c, status);
    for (const char *line = text; line; line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL) {
        if (strncmp(line, "## ", 3) == 0)
            (void)snprintf(section, sizeof section, "%.*s", (int)strcspn(line + 3, "\n"), line + 3);
        if (explain_row(line, section, key)) found++;
    }
    memory_free(c->ctx, &text);
    if (found > 0) return 0;
    cli_error(c, "neither a command nor a key of decks: '%s'; `floe help` lists commands, `floe new --reference` keys",
              key);
    return status_exit(FLOE_BAD_INPUT);
}
