"""What the history of a run says of one of its columns."""
import numpy


def column(run, name):
    return run.result.history[name].values


def first(run, name):
    return float(column(run, name)[0])


def last(run, name):
    return float(column(run, name)[-1])


def largest(run, name, offset=0.0):
    """The largest |value - offset|."""
    return float(numpy.abs(column(run, name) - offset).max())
