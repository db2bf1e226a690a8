/* How the program takes signals. */
#ifndef CLI_SIGNALS_H
#define CLI_SIGNALS_H

#include <signal.h>

/* A closed pipe and a file beyond the size limit become errors to report, instead of ends. */
void cli_ignore_signals(void);
/* The signals of terminals and batch systems ask for an orderly end from here on. Ctrl-C, Ctrl-\ or SIGTERM once more, half a second
 * later or more, end the program at once; the others may come as often as they like. */
void cli_catch_signals(void);
/* The one that has come, 0: none. After cli_end_with_parent SIGALRM stands for the end of the parent. */
const volatile sig_atomic_t *cli_stop_signal(void);

#endif
