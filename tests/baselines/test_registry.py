"""The list of planners: the documents', the baselines, and those of other packages."""

import importlib
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import pytest
from crossing_pair import BLOCKED, FREE, written

from dualarm_repro.baselines.registry import BASELINES, WHOLE_LINKS, enlist, first_line, found
from dualarm_repro.errors import InputError
from dualarm_repro.planning import METHODS, plan_file, truth
from dualarm_repro.planning.planner import GROUP

TEMPLATE = Path(__file__).parents[2] / "examples" / "planner_package"


@pytest.fixture
def methods():
    """The list, which is as it was afterwards."""
    before = dict(METHODS)
    yield METHODS
    METHODS.clear()
    METHODS.update(before)


def distribution(folder, **planners):
    """Metadata of an installed package that declares these planners."""
    info = folder / "theirs-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: theirs\nVersion: 1.0\n")
    lines = [f"{name} = {target}\n" for name, target in planners.items()]
    (info / "entry_points.txt").write_text(f"[{GROUP}]\n" + "".join(lines))


@pytest.fixture
def template(tmp_path, monkeypatch):
    """The template package as if it were installed: its code and its metadata on the path."""
    distribution(tmp_path, **{"straight-line": "straight_line_planner:plan"})
    monkeypatch.syspath_prepend(str(TEMPLATE))
    monkeypatch.syspath_prepend(str(tmp_path))
    importlib.invalidate_caches()
    yield
    sys.modules.pop("straight_line_planner", None)


def test_every_baseline_is_listed_with_what_it_is(methods):
    listed = enlist()
    assert {*BASELINES, WHOLE_LINKS} <= set(listed)
    for name in BASELINES:
        assert len(listed[name].description) > 20
        assert listed[name].settings.model_json_schema()["properties"]["seed"]
    assert enlist() == listed


def test_listing_imports_no_library_of_a_baseline():
    code = (
        "import sys; from dualarm_repro.baselines import enlist; enlist();"
        "print([n for n in ('ompl', 'pink', 'crocoddyl', 'toppra') if n in sys.modules])"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"


def test_template_names_the_group_and_its_function():
    text = (TEMPLATE / "pyproject.toml").read_text(encoding="utf-8")
    assert f'[project.entry-points."{GROUP}"]' in text
    assert 'straight-line = "straight_line_planner:plan"' in text


def test_template_is_found_planned_with_and_judged(template, methods, tmp_path):
    """It does the free task, and says no to the one whose straight line is blocked."""
    assert list(found()) == ["straight-line"]
    assert enlist()["straight-line"].description.startswith("Straight line of all joints")
    free = plan_file(written(tmp_path, FREE), "straight-line")
    assert all(one.reached for one in free.plans.values())
    judged = truth(free.scene, free.paths)
    assert judged.collision_free
    assert free.master.evaluations == 36  # 40 degrees in steps of 0.02 rad
    blocked = plan_file(written(tmp_path, BLOCKED, "blocked.yaml"), "straight-line")
    assert not any(one.reached for one in blocked.plans.values())
    assert blocked.master.reason == "the straight line is blocked"


@pytest.mark.parametrize(
    ("target", "told"),
    [
        ("no_such_package:plan", "ModuleNotFoundError"),
        ("os:no_such_name", "AttributeError"),
        ("os:sep", "str"),
        ("ends_the_process:plan", "SystemExit: 7"),
    ],
)
def test_package_that_cannot_be_loaded_stays_on_the_list_and_says_why(
    target, told, methods, tmp_path, monkeypatch
):
    distribution(tmp_path, broken=target)
    (tmp_path / "ends_the_process.py").write_text("import sys\nsys.exit(7)\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    listed = enlist()
    assert told in listed["broken"].description
    with pytest.raises(InputError, match=told) as caught:
        plan_file(written(tmp_path, FREE), "broken")
    assert "broken" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_package_cannot_take_the_name_of_a_known_method(methods, tmp_path, monkeypatch):
    distribution(tmp_path, **{"apf-improved": "no_such_package:plan"})
    monkeypatch.syspath_prepend(str(tmp_path))
    before = METHODS["apf-improved"]
    assert enlist()["apf-improved"] is before


def test_no_other_planner_is_found_without_a_package():
    names = {one.name for one in metadata.entry_points(group=GROUP)}
    assert not names & {*BASELINES, *METHODS}


def test_first_line():
    assert first_line(lambda problem: None) == "Says nothing of itself"
