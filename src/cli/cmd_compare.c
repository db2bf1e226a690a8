#include "cli/cli.h"
int cmd_compare(cli *c, int argc, char **argv)
{
    (void)c;
    (void)argc;
    (void)argv;
    return 2;
}
