"""Signs of life while a command computes: on a terminal, and nowhere else."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from threading import Event, Thread
from typing import TYPE_CHECKING, TypeVar

from ..terminal import watched

if TYPE_CHECKING:
    from rich.progress import Progress

T = TypeVar("T")
#: Seconds after which a command that is not done yet says what it does.
PATIENCE = 1.0


@contextmanager
def waiting(what: str) -> Iterator[None]:
    """While the context lasts, and once it takes long, say what is done and for how long."""
    if not watched():
        yield
        return
    done = Event()
    thread = Thread(target=_show, args=(what, done), daemon=True)
    thread.start()
    try:
        yield
    finally:
        done.set()
        thread.join()


def each(items: Sequence[T], what: str) -> Iterable[T]:
    """The items one by one, with how many are done."""
    return _counted(items, what) if watched() and len(items) > 1 else items


def _show(what: str, done: Event) -> None:
    if done.wait(PATIENCE):
        return
    with _drawn() as progress:
        progress.add_task(what, total=None)
        done.wait()


def _counted(items: Sequence[T], what: str) -> Iterator[T]:
    with _drawn(counted=True) as progress:
        task = progress.add_task(what, total=len(items))
        for item in items:
            progress.update(task, description=f"{what}: {item}")
            yield item
            progress.advance(task)


def _drawn(counted: bool = False) -> Progress:
    from rich import progress
    from rich.console import Console

    columns: list[progress.ProgressColumn] = [
        progress.SpinnerColumn(),
        progress.TextColumn("{task.description}", markup=False),
    ]
    if counted:
        columns += [progress.BarColumn(), progress.MofNCompleteColumn()]
    columns.append(progress.TimeElapsedColumn())
    return progress.Progress(
        *columns,
        console=Console(stderr=True),
        transient=True,
        redirect_stdout=counted,
        redirect_stderr=False,
    )
