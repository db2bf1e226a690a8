#include "cli/cli.h"
int cmd_list(cli *c, int argc, char **argv)
{
    (void)c;
    (void)argc;
    (void)argv;
    return 2;
}
