"""Problems that no deck was tuned for, with defaults only: the rows of scripts/results/defaults."""
import os
from typing import TYPE_CHECKING

import rows

if TYPE_CHECKING:  # rows imports them by name; so the page's stamp knows that they make it
    from defaults import e1, e2, e3, e4, e5, e6, e7, e8, e9, e10, e11, e12, g1, g2, h5, rows as _  # noqa: F401

TITLE = "Defaults: what a user gets without turning a key"


def make(page):
    page.write("Each deck of `inputs/defaults` names a scene and no method. Errors are those against exact or published solutions; CPU seconds",
               "are those of one thread. A coupling that is right is held to a bar; one that is not yet shows its figure and the warning that a user gets.", "")
    page.commands.append(["floe", "run", "inputs/defaults/DECK.yaml", "--coupling", "COUPLING"])
    measured = rows.measured(os.environ.get("DEFAULTS_ROWS", "").split())
    page.write(*measured.lines)
    page.bars += [(what, value, wanted, met.strip("*")) for what, value, wanted, met in measured.bars]
    page.gather()
