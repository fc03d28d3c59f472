"""Run independent tasks in this process, in worker processes, or on a Dask cluster; in order."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import Any
from warnings import filterwarnings

from ..errors import InputError, LedgerError


@contextmanager
def deaf() -> Iterator[None]:
    """Processes that are begun within never hear of an interruption: who began them does, and ends
    them. Else each would tell of it in a traceback of its own."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    from multiprocessing import resource_tracker

    from joblib.externals.loky.backend import resource_tracker as of_joblib

    # Their own processes are deaf, and starting one of them gives this process its hearing back.
    resource_tracker.ensure_running()
    of_joblib.ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def results(
    tasks: Iterable[tuple[Callable[..., Any], Any, Any]],
    count: int,
    title: str,
    jobs: int = 1,
    progress: bool = False,
    scheduler: str | None = None,
) -> Iterator[Any]:
    """The results of ``function(a, b)`` for every task, in the order of the tasks.

    A worker of this machine gets its next task when it has done the one before: joblib would put
    short ones into batches of up to 2 s, and at the end one worker would wait for another.

    Parameters
    ----------
    jobs
        Worker processes on this machine.
    scheduler
        Address of a Dask scheduler (``tcp://host:8786``) whose workers compute instead.

    Raises
    ------
    LedgerError
        The extra ``cluster`` is not installed.
    InputError
        Nothing answers at that address.
    """
    from joblib import Parallel, delayed, parallel_config
    from tqdm import tqdm

    calls = (delayed(function)(a, b) for function, a, b in tasks)
    if scheduler is None:
        # joblib renews a worker whose memory has grown; no task is lost, so the user need not know.
        filterwarnings("ignore", "A worker stopped while some jobs", UserWarning)
        with deaf():
            done = Parallel(n_jobs=jobs, return_as="generator", batch_size=1)(calls)
        yield from tqdm(done, total=count, desc=title, disable=not progress)
        return
    try:
        from dask.distributed import Client
    except ImportError:
        raise LedgerError("a Dask scheduler needs the extra `cluster`") from None
    try:
        client = Client(scheduler, timeout="10s")
    except (OSError, ValueError) as error:
        reason = str(error) or type(error).__name__
        raise InputError("study", "--scheduler", scheduler, f"a scheduler ({reason})") from None
    with client, parallel_config("dask", client=client):
        yield from tqdm(Parallel()(calls), total=count, desc=title, disable=not progress)
