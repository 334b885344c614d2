"""Work shared among threads: each item once, in place, and errors that end it."""

import sys
import threading
import time

import pytest

from curvlib.parallel import for_each, watched


@pytest.mark.parametrize("threads", [1, 2, 3, 8])
@pytest.mark.parametrize("count", [0, 1, 5, 1000])
def test_each_item_once_and_results_in_place(threads, count):
    seen = []
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        squares = for_each(lambda x: seen.append(x) or x * x, range(count), threads)
    finally:
        sys.setswitchinterval(interval)
    assert squares == [x * x for x in range(count)]
    assert sorted(seen) == list(range(count))


def test_items_that_others_have_not_begun_are_taken_from_them():
    """One item takes as long as all others: they are done by the other thread."""
    done = threading.Event()
    seen = []

    def work(item):
        if item == 0:
            assert done.wait(10)
        else:
            seen.append(item)
            if len(seen) == 9:
                done.set()

    for_each(work, range(10), 2)
    assert sorted(seen) == list(range(1, 10))


@pytest.mark.parametrize("error", [ValueError, IndexError, StopIteration, KeyboardInterrupt])
def test_an_error_of_any_kind_ends_it(error):
    begun = []

    def work(item):
        begun.append(item)
        if item == 3:
            raise error
        time.sleep(0.001)

    with pytest.raises(error):
        for_each(work, range(1000), 2)
    assert len(begun) < 100


@pytest.mark.parametrize("threads", [1, 3])
def test_a_watch_is_told_of_each_item(threads):
    told = []
    with watched(lambda done, count: told.append((done, count))):
        assert for_each(abs, [-1, -2, -3, -4], threads) == [1, 2, 3, 4]
        assert for_each(abs, [], threads) == []
    for_each(abs, [-1, -2], threads)
    assert {count for _, count in told} == {4}
    assert len(told) == 4
    assert max(told) == (4, 4)
