/* Cases in processes of their own: `floe run` for each, some at a time. */
#include "base/memory.h"
#include "study/cases.h"

#include <errno.h>
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>

extern char **environ; /* POSIX: handed on to the processes as it is */

typedef struct job {
    pid_t pid; /* 0: none */
    size_t index;
} job;

static floe_status spawn(context *ctx, const char *program, const char *const *argument, pid_t *pid)
{
    /* posix_spawn does not change its arguments. */
    const int error = posix_spawn(pid, program, NULL, NULL, (char *const *)argument, environ);
    if (error == 0) return FLOE_OK;
    return fail(ctx, FLOE_IO, "cannot start '%s': %s", program, strerror(error));
}

static floe_status start(comparison *c, const compare_options *o, size_t i, job *j)
{
    compare_case *one = &c->list[i];
    const char **argument;
    char path[COMPARE_PATH], threads[16];
    case_set set;
    size_t n = 0;
    TRY(case_set_make(&set, c, o, one));
    floe_status status = memory_new(c->ctx, &argument, 2 * set.n + 10, sizeof *argument);
    if (status == FLOE_OK) {
        case_path(c, one, path);
        (void)snprintf(threads, sizeof threads, "%d", o->threads > 0 ? o->threads : 1);
        const char *const head[] = {o->program, "run", "--quiet", "--threads", threads, "-o", path};
        for (size_t k = 0; k < sizeof head / sizeof head[0]; k++) argument[n++] = head[k];
        for (size_t k = 0; k < set.n; k++) {
            argument[n++] = "--set";
            argument[n++] = set.text[k];
        }
        argument[n++] = "--";
        argument[n++] = o->deck;
        status = spawn(c->ctx, o->program, argument, &j->pid);
        j->index = i;
        memory_free(c->ctx, &argument);
    }
    case_set_free(c->ctx, &set);
    return status;
}

/* The status that belongs to an exit status of `floe run`. */
static floe_status status_of(int wait_status)
{
    static const floe_status of_exit[] = {FLOE_OK, FLOE_INTERNAL,    FLOE_BAD_INPUT, FLOE_DIVERGED,
                                          FLOE_IO, FLOE_INTERRUPTED, FLOE_MISSED_BAR};
    if (!WIFEXITED(wait_status)) return FLOE_INTERNAL;
    const size_t code = (size_t)WEXITSTATUS(wait_status);
    return code < sizeof of_exit / sizeof of_exit[0] ? of_exit[code] : FLOE_INTERNAL;
}

static floe_status collect(comparison *c, const compare_options *o, job *j, int wait_status)
{
    compare_case *one = &c->list[j->index];
    char folder[COMPARE_PATH], path[COMPARE_PATH + 32];
    j->pid = 0;
    one->status = status_of(wait_status);
    case_path(c, one, folder);
    (void)snprintf(path, sizeof path, "%s/summary.json", folder);
    if (one->status != FLOE_OK && one->status != FLOE_DIVERGED && one->status != FLOE_INTERRUPTED)
        return fail(c->ctx, one->status, "the case in '%s' has failed: %s", folder, status_text(one->status));
    TRY(summary_read(c->ctx, path, &one->summary));
    one->ran = true;
    if (one->status != FLOE_OK) (void)snprintf(one->message, sizeof one->message, "see %.400s/run.log", one->folder);
    case_report(c, o, j->index);
    return one->status == FLOE_INTERRUPTED ? FLOE_INTERRUPTED : FLOE_OK;
}

/* Takes note of the jobs that have ended; *running counts the rest. */
static floe_status collect_ended(comparison *c, const compare_options *o, job *list, int *running)
{
    floe_status first = FLOE_OK;
    for (int k = 0; k < o->jobs; k++) {
        int wait_status;
        if (list[k].pid == 0 || waitpid(list[k].pid, &wait_status, WNOHANG) != list[k].pid) continue;
        --*running;
        const floe_status status = collect(c, o, &list[k], wait_status);
        if (first == FLOE_OK) first = status;
    }
    return first;
}

static void stop_all(const job *list, int n)
{
    for (int k = 0; k < n; k++) {
        if (list[k].pid != 0) kill(list[k].pid, SIGTERM);
    }
}

static job *free_slot(job *list, int n)
{
    for (int k = 0; k < n; k++) {
        if (list[k].pid == 0) return &list[k];
    }
    return NULL;
}

static floe_status work(comparison *c, const compare_options *o, job *list)
{
    const struct timespec pause = {0, 20 * 1000 * 1000}; /* ns */
    floe_status first = FLOE_OK;
    size_t next = 0;
    int running = 0;
    bool stopping = false;
    while (running > 0 || (next < c->n && first == FLOE_OK)) {
        while (running < o->jobs && next < c->n && first == FLOE_OK) {
            first = start(c, o, next++, free_slot(list, o->jobs));
            if (first == FLOE_OK) running++;
        }
        const floe_status status = collect_ended(c, o, list, &running);
        if (first == FLOE_OK) first = status;
        if (o->stop && *o->stop && first == FLOE_OK) first = FLOE_INTERRUPTED;
        if (first != FLOE_OK && !stopping) {
            stop_all(list, o->jobs);
            stopping = true;
        }
        if (running > 0) nanosleep(&pause, NULL);
    }
    return first;
}

floe_status cases_run_as_jobs(comparison *c, const compare_options *o)
{
    job *list;
    TRY(memory_new(c->ctx, &list, (size_t)o->jobs, sizeof *list));
    const floe_status status = work(c, o, list);
    memory_free(c->ctx, &list);
    return status;
}
