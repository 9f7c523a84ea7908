"""The number of threads of C++."""

from . import _jostle
from ._arrays import whole_number


def set_thread_count(count):
    """Sets the number of threads of all later calls, whichever Python thread makes them.

    Results do not depend on it. count : int, 1 to 4096. InputError where the system does not start so many, and in a
    process that was forked from one which had started threads: there, one thread does all the work.

    >>> set_thread_count(0)
    Traceback (most recent call last):
    jostle.InputError: set_thread_count = 0: is no number of threads (allowed: 1 to 4096)
    """
    _jostle.set_thread_count(whole_number("set_thread_count", count, -2**63))


def thread_count():
    """The number of threads that later calls use at most. InputError where OMP_NUM_THREADS is no such number.

    >>> thread_count() >= 1
    True
    """
    return _jostle.thread_count()
