"""One function on many items, by several threads: of use where it runs without Python's lock."""

from collections import deque
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from itertools import pairwise


def for_each(function, items, threads: int = 1) -> list:
    """[function(item) for item in items], each item once; an error of any ends it, and no more
    are begun."""
    count = len(items)
    threads = min(threads, count)
    if threads <= 1:
        return [function(item) for item in items]
    results = [None] * count
    ends = [k * count // threads for k in range(threads + 1)]
    shares = [deque(range(*share)) for share in pairwise(ends)]

    def work(k):
        try:
            # Neighbours in memory by one thread; then what is left of the shares of others.
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
    """Yield what the shares still hold. No two threads take the same item, since popleft is atomic
    with Python's lock and without; next() of a shared iterator is not."""
    for share in shares:
        with suppress(IndexError):  # the share is empty
            while True:
                yield share.popleft()
