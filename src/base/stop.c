#include "base/stop.h"

#include <signal.h>
#include <stdio.h>

static const stop_request requests[] = {
    {SIGINT, "SIGINT", "Ctrl-C"},
    {SIGTERM, "SIGTERM", "asked to end"},
    {SIGHUP, "SIGHUP", "the terminal has gone"},
    {SIGQUIT, "SIGQUIT", "Ctrl-\\"},
    {SIGXCPU, "SIGXCPU", "the limit of processor time"},
    {SIGUSR1, "SIGUSR1", "of the batch system or a user"},
    {SIGUSR2, "SIGUSR2", "of the batch system or a user"},
};

const stop_request *stop_request_at(size_t i)
{
    return i < sizeof requests / sizeof requests[0] ? &requests[i] : NULL;
}

static const stop_request *find_signal(int number)
{
    for (size_t i = 0; stop_request_at(i); i++)
        if (requests[i].number == number) return &requests[i];
    return NULL;
}

bool stop_request_is(int number)
{
    return find_signal(number) != NULL;
}

void stop_request_text(int number, char text[64])
{
    const stop_request *r = find_signal(number);
    text[0] = '\0';
    if (r) (void)snprintf(text, 64, " by %s (%s)", r->name, r->meaning);
    if (number == SIGALRM) (void)snprintf(text, 64, " as the program that had started it has ended");
}
