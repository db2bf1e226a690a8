/* Files that a deck names. */
#include "base/ordinary.h"
#include "base/sha256.h"
#include "deck/schema/schema.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { PATH_MOST = 4096, FILE_MOST = 1 << 29 /* bytes */ };

floe_status resolve_path(reader *r, deck_node *node, const char **path)
{
    const char *deck = r->scene->path, *slash = strrchr(deck, '/');
    const int folder = slash ? (int)(slash - deck) + 1 : 0;
    char here[PATH_MOST] = "", text[PATH_MOST], *kept;
    const bool rooted = node->text[0] == '/';
    *path = NULL;
    if (!rooted && deck[0] != '/' && !getcwd(here, sizeof here))
        return fail(r->ctx, FLOE_IO, "cannot tell the working directory: %s", strerror(errno));
    const int n =
        snprintf(text, PATH_MOST, "%s%s%.*s%s", here, here[0] ? "/" : "", rooted ? 0 : folder, deck, node->text);
    if (n >= PATH_MOST) return bad(r, node, NULL, "the path is too long");
    TRY(scene_allocate(r->scene, &kept, (size_t)n + 1));
    memcpy(kept, text, (size_t)n + 1);
    *path = kept;
    return FLOE_OK;
}

static const char file_form[] = "the name of a file, from the deck's folder";

/* The content lives as long as the tree of the deck. */
static floe_status read_content(reader *r, deck_node *node, int descriptor, param_file *file)
{
    const off_t size = lseek(descriptor, 0, SEEK_END);
    char *bytes;
    if (size < 0 || lseek(descriptor, 0, SEEK_SET) != 0)
        return bad(r, node, file_form, "cannot read '%s': %s", file->path, strerror(errno));
    if (size > FILE_MOST) return bad(r, node, NULL, "'%s' has more than %d bytes", file->path, FILE_MOST);
    TRY(arena_new(r->arena, &bytes, (size_t)size + 1));
    while (file->size < (size_t)size) {
        const ssize_t got = read(descriptor, bytes + file->size, (size_t)size - file->size);
        if (got == 0) break;
        if (got > 0) file->size += (size_t)got;
        if (got < 0 && errno != EINTR)
            return bad(r, node, file_form, "cannot read '%s': %s", file->path, strerror(errno));
    }
    file->bytes = bytes;
    return sha256_of(r->ctx, bytes, file->size, file->digest);
}

floe_status read_file_key(reader *r, const key_spec *key, deck_node *node, void *base)
{
    param_file *file = (param_file *)(void *)((char *)base + key->offset);
    const char *special;
    if (node->kind != NODE_SCALAR) return bad_form(r, key, node, file_form);
    TRY(resolve_path(r, node, &file->path));
    if (!file->path) return FLOE_OK;
    const int descriptor = ordinary_open(file->path, O_RDONLY, &special);
    if (descriptor < 0 && special)
        return bad(r, node, file_form, "cannot open '%s': it is %s, not an ordinary file", file->path, special);
    if (descriptor < 0) return bad(r, node, file_form, "cannot open '%s': %s", file->path, strerror(errno));
    const floe_status status = read_content(r, node, descriptor, file);
    (void)close(descriptor);
    return status;
}
