"""Inputs are noted, also where a memo answers."""

import gc
from weakref import ref

from dualarm_repro import load_arm
from dualarm_repro.tracking import kept_with_owner, memo, note, recording, unnoted


def test_recordings_nest():
    with recording() as outer:
        note("a")
        with recording() as inner:
            note("b")
        note("c")
    note("d")
    assert (outer, inner) == ({"a", "b", "c"}, {"b"})


def test_an_answer_from_memory_notes_its_inputs():
    calls = []

    @memo()
    def inner(x):
        calls.append(x)
        note(f"file {x}")
        return x

    @memo(8)
    def outer(x):
        return inner(x) + inner(x + 1)

    for _ in range(2):
        with recording() as found:
            assert outer(1) == 3
        assert found == {"file 1", "file 2"}
    assert calls == [1, 2]
    with recording() as found:
        inner(2)
    assert found == {"file 2"}
    inner.cache_clear()
    inner(2)
    assert calls == [1, 2, 2]


def test_loading_an_arm_notes_its_files():
    with recording() as found:
        load_arm("es165d-slave")
    assert found == {"robots/es165d-slave.yaml", "robots/es165d.yaml"}


def test_a_document_that_is_read_on_the_way_is_noted_by_the_parts_that_are_used():
    from dualarm_repro.ledger import Registry

    with recording() as found:
        Registry().printed("xue.tab01")
    assert found == {"papers/xue.yaml#items.tab01.printed"}
    with recording() as found, unnoted():
        note("a")
    assert found == set()


def test_what_is_kept_with_its_owner_goes_with_it():
    """The owner is not kept alive by the answer, and another one is asked anew."""
    asked = []

    class Owner:
        pass

    @kept_with_owner
    def size(owner):
        asked.append(1)
        return len(asked)

    owner, other = Owner(), Owner()
    assert [size(owner), size(owner), size(other)] == [1, 1, 2]
    seen = ref(owner)
    del owner
    gc.collect()
    assert seen() is None
