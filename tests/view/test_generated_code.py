"""The generated code of an arm run on symbols is its derived kinematics, and a wrong one is not."""

import pytest

from dualarm_repro import load_arm
from dualarm_repro.arms.codegen.generated import Generated
from dualarm_repro.view.foundations import generated_code


@pytest.mark.parametrize("name", ["irb120", "es165d", "er16", "es165d-slave"])
def test_code_is_derived(name):
    assert generated_code.is_derived(load_arm(name))


def test_another_code_is_not(monkeypatch):
    run = generated_code.symbolic_run

    def wrong(arm):
        pose = run(arm)
        pose[0, 3] = -pose[0, 3]
        return pose

    monkeypatch.setattr(generated_code, "symbolic_run", wrong)
    assert not generated_code.is_derived(load_arm("irb120"))


def test_what_is_compiled_is_compared_with_the_lines(monkeypatch):
    arm = load_arm("irb120")
    assert generated_code.compiled_difference(arm, 100, seed=0) < 1e-14
    rows = Generated.rows
    monkeypatch.setattr(
        Generated, "rows", lambda *given: rows(*given) + 1e-3 * (given[1][:, :1] > 0)
    )
    assert generated_code.compiled_difference(arm, 100, seed=0) == pytest.approx(1e-3)
