"""Ctrl-C within a block that is to be finished."""

import signal
from threading import Thread

import pytest

from dualarm_repro.interruption import uninterrupted


def test_an_interruption_waits_for_the_end_of_the_block():
    steps = []

    def block():
        with uninterrupted():
            signal.raise_signal(signal.SIGINT)
            steps.append("after it")

    with pytest.raises(KeyboardInterrupt):
        block()
    assert steps == ["after it"]
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)


def test_a_block_within_a_block_leaves_it_to_the_outer_one():
    steps = []

    def blocks():
        with uninterrupted():
            with uninterrupted():
                signal.raise_signal(signal.SIGINT)
            steps.append("after the inner one")

    with pytest.raises(KeyboardInterrupt):
        blocks()
    assert steps == ["after the inner one"]


def test_without_an_interruption_nothing_happens_and_faults_pass():
    before = signal.getsignal(signal.SIGINT)
    with uninterrupted():
        pass
    with pytest.raises(ZeroDivisionError), uninterrupted():
        raise ZeroDivisionError
    assert signal.getsignal(signal.SIGINT) is before


def test_who_is_deaf_stays_so():
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with uninterrupted():
            signal.raise_signal(signal.SIGINT)
        assert signal.getsignal(signal.SIGINT) == signal.SIG_IGN
    finally:
        signal.signal(signal.SIGINT, before)


def test_a_thread_that_hears_nothing_runs_its_block():
    done = []

    def block():
        with uninterrupted():
            done.append(True)

    thread = Thread(target=block)
    thread.start()
    thread.join()
    assert done == [True]
