"""Machine code is taken for the types it was compiled for, whoever else writes to the folder."""

import pytest

from dualarm_repro.machine_code import _Sealed


class TooLate(_Sealed):
    """A process that read the index before another wrote it, and whose own index is replaced."""

    def _load_index(self):
        return {}

    def _save_index(self, overloads):
        pass


@pytest.fixture
def opened(tmp_path):
    return lambda kind=_Sealed: kind(str(tmp_path), "function", "stamp")


def test_each_key_has_its_own(opened):
    opened().save("integers", 1)
    opened().save("numbers", 2.0)
    assert opened().load("integers") == 1
    assert opened().load("numbers") == 2.0
    assert opened().load("strings") is None


def test_what_another_process_wrote_for_other_types_is_compiled_again(opened):
    opened().save("integers", 1)
    opened(TooLate).save("numbers", 2.0)
    assert opened().load("integers") is None
    opened().save("integers", 3)
    assert opened().load("integers") == 3


def test_what_is_damaged_is_compiled_again(opened, tmp_path):
    opened().save("integers", 1)
    [written] = tmp_path.glob("*.nbc")
    written.write_bytes(written.read_bytes()[:-1])
    assert opened().load("integers") is None
