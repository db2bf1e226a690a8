/* The processes of a batch: starting and stopping `floe run`. */
#include "batch/batch_internal.h"

#include "base/memory.h"
#include "base/timer.h"
#include "io/file.h"
#include "io/lock.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

extern char **environ; /* POSIX: handed on to the processes as it is */

/* What a process says goes to FOLDER/stderr.txt: a run that ends before it has a summary leaves its reason there. */
static int redirect_messages(posix_spawn_file_actions_t *action, const char *messages)
{
    int error = posix_spawn_file_actions_addopen(action, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    if (error == 0) error = posix_spawn_file_actions_addopen(action, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    if (error == 0)
        error = posix_spawn_file_actions_addopen(action, STDERR_FILENO, messages,
                                                 O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, 0666);
    return error;
}

static floe_status spawn_process(context *ctx, const char *const *argument, const char *messages, pid_t *pid)
{
    posix_spawn_file_actions_t action;
    int error = posix_spawn_file_actions_init(&action);
    if (error == 0) {
        error = redirect_messages(&action, messages);
        /* posix_spawn does not change its arguments. */
        if (error == 0) error = posix_spawn(pid, argument[0], &action, NULL, (char *const *)argument, environ);
        (void)posix_spawn_file_actions_destroy(&action);
    }
    if (error == 0) return FLOE_OK;
    return fail(ctx, FLOE_IO, "cannot start '%s': %s", argument[0], strerror(error));
}

/* A batch that was killed leaves processes that end by themselves within a second or so: their folders are not touched
 * before. */
static floe_status wait_for_earlier(batch *b, const char *folder)
{
    enum { PATIENCE = 60 }; /* s */
    const struct timespec pause = {0, 100 * 1000 * 1000};
    const double begin = wall_seconds();
    for (long holder = folder_lock_holder(folder); holder != 0; holder = folder_lock_holder(folder)) {
        if (b->o->stop && *b->o->stop) return FLOE_OK;
        if (wall_seconds() - begin > PATIENCE) {
            return fail(b->ctx, FLOE_IO, "process %ld is still writing into '%s': end it, then go on", holder, folder);
        }
        nanosleep(&pause, NULL);
    }
    return FLOE_OK;
}

static void fill_arguments(const batch *b, const batch_case *one, const char *folder, char (*number)[32],
                           const char **argument)
{
    const batch_options *o = b->o;
    (void)snprintf(number[0], sizeof *number, "%d", o->threads > 0 ? o->threads : 1);
    (void)snprintf(number[1], sizeof *number, "%ld", (long)getpid());
    (void)snprintf(number[2], sizeof *number, "%.17g", o->max_wall);
    const char *const head[] = {o->program, "run",     "--quiet", "--threads", number[0],
                                "--parent", number[1], "-o",      folder};
    size_t n = 0;
    for (; n < sizeof head / sizeof head[0]; n++) argument[n] = head[n];
    if (o->max_wall > 0.0) {
        argument[n++] = "--max-wall";
        argument[n++] = number[2];
    }
    if (one->resumed) argument[n++] = "--resume";
    for (size_t k = 0; k < one->n_set; k++) {
        argument[n++] = "--set";
        argument[n++] = one->set[k];
    }
    argument[n++] = "--";
    argument[n] = o->deck;
}

static floe_status start_case(batch *b, batch_case *one, pid_t *pid)
{
    enum { OTHERS = 16 }; /* arguments, and the NULL after them */
    char folder[BATCH_PATH], messages[BATCH_PATH], number[3][32];
    const char **argument;
    (void)snprintf(folder, sizeof folder, "%s/%s", b->o->dir, one->folder);
    batch_path(b->o, one, "stderr.txt", messages);
    TRY(folder_make(b->ctx, folder));
    TRY(wait_for_earlier(b, folder));
    one->resumed = batch_case_goes_on(b, one);
    TRY(batch_case_discard(b, one));
    if (!one->resumed) TRY(batch_case_begin(b, one));
    TRY(file_remove(b->ctx, messages));
    TRY(memory_new(b->ctx, &argument, 2 * one->n_set + OTHERS, sizeof *argument));
    fill_arguments(b, one, folder, number, argument);
    const floe_status status = spawn_process(b->ctx, argument, messages, pid);
    memory_free(b->ctx, &argument);
    return status;
}

floe_status batch_process_start(batch *b, size_t i)
{
    batch_job *j = b->job;
    while (j->pid != 0) j++;
    *j = (batch_job){.index = i, .started = wall_seconds(), .before = machine_load_now()};
    TRY(start_case(b, &b->list[i], &j->pid));
    b->list[i].state = BATCH_RUNNING;
    b->running++;
    return FLOE_OK;
}

void batch_process_stop(batch_job *j)
{
    j->asked = true;
    (void)kill(j->pid, SIGTERM);
}

void batch_process_kill(batch_job *j)
{
    j->killed = true;
    (void)kill(j->pid, SIGKILL);
}
