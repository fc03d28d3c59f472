"""Errors say four things on one line and survive the way back from a worker process."""

import pickle

import pytest

from dualarm_repro import errors


@pytest.mark.parametrize(
    "kind",
    [
        errors.InputError,
        errors.DataFileError,
        errors.UnknownNameError,
        errors.ConfigurationError,
        errors.OutputError,
    ],
)
def test_message_and_pickle(kind):
    error = kind("file.yaml", "joints.0.a", "x" * 500, "a number")
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is kind
    assert str(again) == str(error)
    assert str(error).startswith("file.yaml: joints.0.a = 'xxx")
    assert str(error).endswith("expected a number")
    assert len(str(error)) < 200
    assert isinstance(error, errors.DualArmError)
