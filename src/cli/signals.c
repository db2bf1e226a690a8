#include "cli/signals.h"

#include "base/stop.h"
#include "cli/cli.h"

#include <sys/time.h>
#include <time.h>
#include <unistd.h>

/* Set by the handlers alone; the runs look at it between steps. */
static volatile sig_atomic_t stop_signal = 0;

/* When each of those that end the program at the second time came first, in s; 0: not yet. Of the handler alone, during which
 * all signals wait. */
typedef struct first_time {
    int number;
    double at;
} first_time;
static first_time insistent[] = {{SIGINT, 0.0}, {SIGQUIT, 0.0}, {SIGTERM, 0.0}};

/* `timeout` sends its signal to the process and to its group, and a terminal and a shell may both tell of one Ctrl-C: what
 * comes twice within this time (s) has come once. */
static const double SAME = 0.5;

static double seconds_now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void on_signal(int number)
{
    const double at = seconds_now();
    if (stop_signal == 0) stop_signal = number;
    for (size_t i = 0; i < sizeof insistent / sizeof insistent[0]; i++) {
        first_time *f = &insistent[i];
        if (f->number != number) continue;
        if (f->at == 0.0) f->at = at;
        if (at - f->at < SAME) continue;
        (void)signal(number, SIG_DFL);
        (void)raise(number); /* once the handler has returned */
    }
}

void cli_ignore_signals(void)
{
    (void)signal(SIGPIPE, SIG_IGN);
    (void)signal(SIGXFSZ, SIG_IGN);
}

/* `nohup` says that the terminal may go. */
static bool is_ignored_hangup(int number)
{
    struct sigaction before;
    return number == SIGHUP && sigaction(number, NULL, &before) == 0 && before.sa_handler == SIG_IGN;
}

void cli_catch_signals(void)
{
    struct sigaction action = {.sa_handler = on_signal};
    sigfillset(&action.sa_mask);
    for (size_t i = 0; stop_request_at(i); i++) {
        const int number = stop_request_at(i)->number;
        if (!is_ignored_hangup(number)) (void)sigaction(number, &action, NULL);
    }
}

const volatile sig_atomic_t *cli_stop_signal(void)
{
    return &stop_signal;
}

static volatile sig_atomic_t parent_process = 0;

static void on_alarm(int number)
{
    if (getppid() != (pid_t)parent_process && stop_signal == 0) stop_signal = number;
}

/* A parent that is killed cannot stop the runs that it has started: they look for it, every half second. */
void cli_end_with_parent(int parent)
{
    const struct itimerval each = {{0, 500000}, {0, 500000}};
    struct sigaction action = {.sa_handler = on_alarm, .sa_flags = SA_RESTART};
    parent_process = parent;
    sigemptyset(&action.sa_mask);
    sigaction(SIGALRM, &action, NULL);
    (void)setitimer(ITIMER_REAL, &each, NULL);
}
