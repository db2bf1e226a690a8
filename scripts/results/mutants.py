"""Faults put into the sources one at a time: what scripts/mutants.py has found so far (build/mutants); the page runs none of them itself."""
import os

from mutation import page as mutants_page
from mutation.draw import ROOT, plan
from mutation.tests import State

TITLE = "Mutants: faults that the quick tests see, and those that they do not"
SEED, COUNT = 18, 200


def make(page):
    folder = os.path.join(ROOT, "build", "mutants")
    state = State(folder)
    if not state.data["mutants"]:
        raise RuntimeError("nothing has been run: scripts/mutants.py first")
    names, draw, mutants, _ = plan(SEED, COUNT, folder, state)
    lines, share = mutants_page.lines_of(SEED, draw, mutants, state, names)
    page.also.append("tests")
    page.write(*lines)
    page.bar("share of mutants that are killed", share, ">=", 0.95)
