"""A run beside its exact solution along a line."""
from floe.results import number, read_csv, split_title

import numpy


def profile(folder):
    """Columns of a run's profile.csv by name, without units, each of shape (places,)."""
    titles, rows = read_csv(folder / "profile.csv")
    return {split_title(title)[0]: numpy.array([number(row[k]) for row in rows]) for k, title in enumerate(titles)}
