"""How long two functions take, run in turn: what else runs on the machine disturbs both alike."""

import statistics

import numpy as np


def in_turn(run, reference, clock, runs: int, longest: float, least: int = 1):
    """The time that a function takes, and its ratio to that of another, of runs in turn.

    Parameters
    ----------
    run, reference : callable
        Without arguments; `reference` may be None.
    clock : callable
        Returns seconds, as `time.process_time` does.
    runs, longest : int, float
        It is run until one of these, in seconds, is reached.
    least : int
        How often it is run at least.

    Returns
    -------
    seconds, ratio : float
        Medians; the ratio is NaN without a reference.
    """
    seconds, ratios, start = [], [], clock()
    while len(seconds) < least or (len(seconds) < runs and clock() - start < longest):
        against = seconds_of(clock, reference) if reference else np.nan
        seconds.append(seconds_of(clock, run))
        ratios.append(seconds[-1] / against)
    return statistics.median(seconds), statistics.median(ratios)


def seconds_of(clock, run, *arguments):
    """The time that run(*arguments) takes by a clock."""
    start = clock()
    run(*arguments)
    return clock() - start
