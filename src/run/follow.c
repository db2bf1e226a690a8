#include "run/follow.h"

#include "io/file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

static bool is_same(const struct stat *a, const struct stat *b)
{
    return a->st_dev == b->st_dev && a->st_ino == b->st_ino;
}

/* The path of an open folder; false where the system does not tell. */
static bool path_of(int folder, char path[OUTPUT_PATH])
{
    char link[64];
    (void)snprintf(link, sizeof link, "/proc/self/fd/%d", folder);
    const ssize_t length = readlink(link, path, OUTPUT_PATH - 1);
    if (length <= 0 || length >= OUTPUT_PATH - 1) return false;
    path[length] = '\0';
    return true;
}

/* Where the open folder is now; false where it is nowhere, too. */
static bool find_folder_path(int folder, char place[OUTPUT_PATH])
{
    struct stat there, ours;
    return path_of(folder, place) && stat(place, &there) == 0 && fstat(folder, &ours) == 0 && is_same(&there, &ours);
}

/* Another folder stands under its name, or none. One that cannot be looked at is for what is written there to fail of. */
static bool has_left(const run_output *o)
{
    struct stat there, ours;
    if (fstat(o->folder, &ours) != 0) return false;
    if (stat(o->dir, &there) != 0) return errno == ENOENT || errno == ENOTDIR || errno == ESTALE;
    return !is_same(&there, &ours);
}

/* Some file systems number a folder anew from time to time: its path tells. */
static bool is_where_it_was(const run_output *o, const char *place)
{
    char path[OUTPUT_PATH];
    const int folder = open(o->dir, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return false;
    const bool same = path_of(folder, path) && strcmp(path, place) == 0;
    (void)close(folder);
    return same;
}

/* The place is free, or only the files are gone from it. */
static bool is_free(const run_output *o, const char *place)
{
    struct stat there, ours;
    if (lstat(place, &there) != 0) return true;
    return fstat(o->folder, &ours) == 0 && is_same(&there, &ours);
}

/* What removes the folder may still be at it, and take away what is made there: it is looked at again a little later. */
enum { TRIES = 10 };

static void wait_a_little(void)
{
    (void)nanosleep(&(struct timespec){0, 50 * 1000 * 1000}, NULL);
}

/* Opens the outputs again in a new folder of the same name, or NAME-continued if something else has that name, which may happen between two tries. */
static floe_status reopen_outputs(run_output *o, const sim *s)
{
    char wanted[OUTPUT_PATH], place[OUTPUT_PATH];
    (void)snprintf(wanted, sizeof wanted, "%.4000s", o->dir);
    floe_status status = FLOE_IO;
    for (int i = 0; i < TRIES && status == FLOE_IO; i++) {
        if (i > 0) {
            context_clear(o->ctx);
            wait_a_little();
        }
        (void)snprintf(place, sizeof place, "%.4000s%s", wanted, is_free(o, wanted) ? "" : "-continued");
        status = output_reopen(o, s, place);
    }
    return status;
}

static floe_status make_anew(run_output *o, const sim *s)
{
    const floe_status status = reopen_outputs(o, s);
    if (status != FLOE_IO) return status;
    char cause[CONTEXT_MESSAGE_SIZE];
    (void)snprintf(cause, sizeof cause, "%.1200s", context_message(o->ctx));
    context_clear(o->ctx);
    return fail(o->ctx, FLOE_IO, "the folder '%s' was removed while the run wrote into it, and cannot be made anew: %s",
                o->dir, cause);
}

floe_status output_follow(run_output *o, const sim *s, follow_state *state)
{
    char place[OUTPUT_PATH];
    *state = FOLLOW_HERE;
    if (o->folder < 0) return FLOE_OK;
    if (!history_is_removed(o->history)) {
        if (!has_left(o)) return FLOE_OK;
        const bool found = find_folder_path(o->folder, place);
        if (found && is_where_it_was(o, place)) return FLOE_OK;
        if (found) *state = FOLLOW_MOVED;
        if (found) return output_move(o, place);
    }
    *state = FOLLOW_ANEW;
    return make_anew(o, s);
}

floe_status output_follow_failure(run_output *o, const sim *s, const char *cause, follow_state *state)
{
    TRY(output_follow(o, s, state));
    if (!strstr(cause, strerror(ENOENT))) return FLOE_OK;
    for (int i = 0; i < TRIES && *state == FOLLOW_HERE; i++) {
        wait_a_little();
        TRY(output_follow(o, s, state));
    }
    if (*state != FOLLOW_HERE || (output_exists(o, "deck.yaml") && output_exists(o, "fields.xdmf"))) return FLOE_OK;
    *state = FOLLOW_ANEW;
    return make_anew(o, s);
}
