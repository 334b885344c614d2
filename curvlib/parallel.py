"""A parallel map over threads, for functions that release Python's lock."""

from collections import deque
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from itertools import pairwise

_watch = ContextVar("watch", default=None)


@contextmanager
def watched(function):
    """Within it, each `for_each` calls function(done, count) as its items are done, from any of its
    threads."""
    token = _watch.set(function)
    try:
        yield
    finally:
        _watch.reset(token)


def for_each(function, items, threads: int = 1) -> list:
    """[function(item) for item in items], each item once; after an error no item is begun."""
    count, watch = len(items), _watch.get()
    threads = min(threads, count)
    if watch:
        function = _told(function, watch, count)
    if threads <= 1:
        return [function(item) for item in items]
    results = [None] * count
    ends = [k * count // threads for k in range(threads + 1)]
    shares = [deque(range(*share)) for share in pairwise(ends)]

    def work(k):
        try:
            # A thread works on adjacent items first, then steals from the other shares.
            for item in _taken(shares[k:] + shares[:k]):
                results[item] = function(items[item])
        except BaseException:
            for share in shares:
                share.clear()
            raise

    with ThreadPoolExecutor(threads - 1) as pool:
        others = [pool.submit(work, k) for k in range(1, threads)]
        work(0)
        for other in others:
            other.result()
    return results


def _taken(shares):
    """Yield the remaining items of the shares. No two threads take the same item: popleft is atomic
    with and without Python's lock; next() of a shared iterator is not."""
    for share in shares:
        with suppress(IndexError):  # the share is empty
            while True:
                yield share.popleft()


def _told(function, watch, count):
    done = []

    def told(item):
        result = function(item)
        done.append(None)
        watch(len(done), count)
        return result

    return told
