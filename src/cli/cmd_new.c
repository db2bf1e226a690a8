/* floe new: decks to start from, and what the schema says about itself. */
#include "base/memory.h"
#include "cli/cli.h"
#include "io/file.h"
#include "run/catalogue.h"

#include <string.h>

typedef enum product { PRODUCT_DECK, PRODUCT_SCHEMA, PRODUCT_REFERENCE, PRODUCT_COMPLETION } product;

typedef struct arguments {
    const char *scene, *file;
    product product;
} arguments;

enum { KEY_SCHEMA = 1000, KEY_REFERENCE, KEY_COMPLETION };

/* "dam.yaml" in the place of a title is the file. */
static void name_file(arguments *a)
{
    const char *end = a->scene ? strrchr(a->scene, '.') : NULL;
    if (!end || a->file || (strcmp(end, ".yaml") != 0 && strcmp(end, ".yml") != 0)) return;
    a->file = a->scene;
    a->scene = NULL;
}

static error_t parse_new_option(int key, char *arg, struct argp_state *state)
{
    arguments *a = state->input;
    switch (key) {
    case 'o': a->file = arg; return 0;
    case KEY_SCHEMA: a->product = PRODUCT_SCHEMA; return 0;
    case KEY_REFERENCE: a->product = PRODUCT_REFERENCE; return 0;
    case KEY_COMPLETION:
        if (strcmp(arg, "bash") != 0) argp_error(state, "there is completion for bash, not for '%s'", arg);
        a->product = PRODUCT_COMPLETION;
        return 0;
    case ARGP_KEY_ARG:
        if (a->scene) argp_error(state, "one scene at a time: '%s' is too much", arg);
        a->scene = arg;
        return 0;
    case ARGP_KEY_END: name_file(a); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options[] = {
    {"output", 'o', "FILE", 0, "Write to a new file (default: standard output)", 0},
    {"schema", KEY_SCHEMA, NULL, 0, "The JSON schema of decks, for editors", 0},
    {"reference", KEY_REFERENCE, NULL, 0, "The reference of decks in Markdown, docs/deck.md", 0},
    {"completion", KEY_COMPLETION, "SHELL", 0, "Completion of commands and options for a shell: bash", 0},
    {0},
};
static const struct argp argp = {
    .options = options,
    .parser = parse_new_option,
    .args_doc = "[SCENE|FILE.yaml]",
    .doc = "Write a commented deck to start from: SCENE is its title, FILE.yaml the new file that it is written to.",
};

/* Options of the commands, for completion. */
static const char completion[] =
    "# Completion of floe for bash: source this file, or put it into /etc/bash_completion.d.\n"
    "_floe() {\n"
    "    local current=${COMP_WORDS[COMP_CWORD]} words files=''\n"
    "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
    "        words='check plan run compare study stability picture report diff list new --help --version'\n"
    "    else\n"
    "        case ${COMP_WORDS[1]} in\n"
    "        check) words='--set --coupling --help' files=yes ;;\n"
    "        plan) words='--set --coupling --json --help' files=yes ;;\n"
    "        run) words='--output --coupling --set --threads --resume --max-wall --tolerance --metric --budget --quiet "
    "--help' files=yes ;;\n"
    "        compare) words='--axis --output --set --threads --jobs --repeat --max-wall --again --quiet --help' "
    "files=yes ;;\n"
    "        study) words='--axis --couplings --bases --over --output --set --threads --jobs --repeat --max-wall "
    "--again "
    "--quiet --help' files=yes ;;\n"
    "        stability) words='--over --each --tolerance --growth --relative-to --coupling --set --jobs --threads '\n"
    "            words+='--max-wall --output --quiet --help' files=yes ;;\n"
    "        picture) words='--time --all --points --cells --range --plane --view --mirror --dark --width --output "
    "--help' "
    "files=yes ;;\n"
    "        report) words='--output --times --title --quiet --help' files=yes ;;\n"
    "        diff) words='--tolerance --exact --all --help' files=yes ;;\n"
    "        list) words='materials eos laws membranes shapes bases normals exact metrics boundaries fields' ;;\n"
    "        new) words='--output --schema --reference --completion --help' ;;\n"
    "        esac\n"
    "        case ${COMP_WORDS[COMP_CWORD - 1]} in\n"
    "        -c | --coupling) words='mpm ice ice-mpm' files='' ;;\n"
    "        --completion) words='bash' ;;\n"
    "        -o | --output) words='' files=yes ;;\n"
    "        esac\n"
    "    fi\n"
    "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\"\n"
    "        [ -n \"$files\" ] && compgen -f -- \"$current\")\n"
    "}\n"
    "complete -o filenames -F _floe floe\n";

static floe_status make_text(cli *c, const arguments *a, char **text)
{
    deck_catalogue *catalogue;
    if (a->product == PRODUCT_COMPLETION) return memory_string(c->ctx, text, completion);
    if (a->product == PRODUCT_DECK) return deck_starter(text, c->ctx, a->scene);
    TRY(catalogue_create(&catalogue, c->ctx));
    const floe_status status = a->product == PRODUCT_SCHEMA ? deck_json_schema(text, c->ctx, catalogue)
                                                            : deck_reference(text, c->ctx, catalogue);
    catalogue_destroy(c->ctx, &catalogue);
    return status;
}

static floe_status write_deck_text(cli *c, const arguments *a, const char *text)
{
    if (!a->file) {
        (void)fputs(text, stdout);
        return FLOE_OK;
    }
    if (file_exists(a->file)) return fail(c->ctx, FLOE_BAD_INPUT, "'%s' is there already; it is not replaced", a->file);
    return file_replace_text(c->ctx, a->file, text);
}

int cmd_new(cli *c, int argc, char **argv)
{
    arguments a = {0};
    char *text;
    argp_parse(&argp, argc, argv, 0, NULL, &a);
    floe_status status = make_text(c, &a, &text);
    if (status == FLOE_OK) {
        status = write_deck_text(c, &a, text);
        memory_free(c->ctx, &text);
    }
    return status == FLOE_OK ? 0 : cli_fail(c, status);
}
