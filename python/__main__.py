"""`python3 python report ...`: the commands that floe calls (floe/command.py), from the folder that holds the package."""
import sys

MISSING = 69  # a package is missing: floe says what to install


def run():
    try:
        from floe.command import main
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] == "floe":
            raise
        return MISSING
    return main()


sys.exit(run())
