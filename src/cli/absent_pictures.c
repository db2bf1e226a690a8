/* In the place of pictures and pages where floe is built without them (FLOE_PICTURES). */
#include "cli/cli.h"

static int refuse_pictures(const cli *c, const char *command)
{
    cli_error(c,
              "this floe was built without pictures: `floe %s` needs one that was configured with -DFLOE_PICTURES=ON",
              command);
    return status_exit(FLOE_BAD_INPUT);
}

int cmd_picture(cli *c, int argc, char **argv)
{
    (void)argc;
    (void)argv;
    return refuse_pictures(c, "picture");
}

int cmd_report(cli *c, int argc, char **argv)
{
    (void)argc;
    (void)argv;
    return refuse_pictures(c, "report");
}
