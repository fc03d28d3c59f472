"""What a value depends on: every kind of dependency is seen, and nothing else is."""

import shutil
from cProfile import Profile
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from long_tests import long_where

from dualarm_repro.arms.trigonometry import sincos
from dualarm_repro.datafiles import data_path
from dualarm_repro.ledger import closure as found
from dualarm_repro.ledger.closure import carries, closure, keeps_books, module_of
from dualarm_repro.ledger.record import roots
from dualarm_repro.ledger.spot import seed_of_code
from dualarm_repro.ledger.versions import DISTRIBUTIONS, versions
from dualarm_repro.papers import load
from dualarm_repro.papers.pan.studies import fit
from dualarm_repro.papers.xue import demands
from dualarm_repro.papers.xue.studies import planners, search, trials
from dualarm_repro.sources import Graph, graph
from dualarm_repro.tracking import recording

PACKAGE = Path(found.__file__).parents[1]
#: Studies and items of every document, one kind of dependency each.
STUDIES = sorted(load().studies)
#: Numbers that bound what a cell computes; with these it still calls all that it calls.
BRIEF = {
    "pan_fit": [(fit, "DRAWS", 2), (fit, "EVALUATIONS", 3), (fit, "_SMALLEST", 0.2)],
    "xue_planners": [(planners, "CHECKS", 3000)],
    "xue_search": [(search, "ROUNDS", 40), (demands, "SHIFTS", {"window_centre_x": 0.01})],
    "xue_trials": [(trials, "BLOCK", 2)],
}
#: What draws an arrangement at random is imported, so it belongs to the closure with all that it
#: calls, which the cell of `xue_lottery` traces.
BRIEF_CELLS = {"xue_ablation": {"layout": "nominal", "trials": 2}}
#: Column that tells how long a cell takes.
CHEAPEST = {
    "patent_crossings": "draw",
    "xue_paths": "improved_steps",
}
ITEMS = ("xue.fig08", "xue.tab02", "qiu.fig10", "patent.fig02", "pan.claim_optimum")


@pytest.fixture(scope="module")
def clone(tmp_path_factory):
    folder = tmp_path_factory.mktemp("clone") / "dualarm_repro"
    shutil.copytree(PACKAGE, folder, ignore=shutil.ignore_patterns("__pycache__"))
    return folder


def digests(folder, roots_of):
    tree = Graph(folder, folder.parent / "index.json")
    return {name: tree.digest(tree.closure(modules, carries)) for name, modules in roots_of.items()}


def studied():
    return {name: [module_of(study.compute)] for name, study in load().studies.items()}


@cache
def undisturbed(folder):
    """Digests of all studies before anything is edited."""
    return digests(folder, studied())


def edited(folder, change, *modules):
    """The studies whose digest edited files change; the files are as before afterwards."""
    paths = [folder.joinpath(*module.split(".")).with_suffix(".py") for module in modules]
    texts, before = [path.read_text(encoding="utf-8") for path in paths], undisturbed(folder)
    for path, text in zip(paths, texts, strict=True):
        path.write_text(change(text), encoding="utf-8")
    try:
        after = digests(folder, studied())
    finally:
        for path, text in zip(paths, texts, strict=True):
            path.write_text(text, encoding="utf-8")
    return {name for name in before if before[name] != after[name]}


def another_line(text):
    return text + "\nEDITED = 1\n"


@cache
def counting(folder):
    """Every module but those of packages, with the studies in whose closure it is."""
    tree = Graph(folder)
    found = {
        module.removeprefix("dualarm_repro."): set()
        for module, path in tree.files.items()
        if path.name != "__init__.py"
    }
    for name, modules in studied().items():
        for module in tree.closure(modules, carries):
            found.get(module.removeprefix("dualarm_repro."), set()).add(name)
    return found


def test_files_outside_every_closure_count_for_none(clone):
    outside = [module for module, names in counting(clone).items() if not names]
    assert len(outside) > 50
    assert edited(clone, another_line, *outside) == set()


def test_a_file_of_a_closure_counts_for_its_studies_and_no_other(clone):
    """Some files, other ones whenever the code has changed."""
    inside = sorted(module for module, names in counting(clone).items() if names)
    drawn = np.random.default_rng(seed_of_code()).choice(inside, 25, replace=False)
    for module in drawn:
        assert edited(clone, another_line, module) == counting(clone)[module], module


@pytest.mark.long(short="test_a_file_of_a_closure_counts_for_its_studies_and_no_other")
def test_every_file_of_a_closure_counts_and_no_other(clone):
    for module, names in sorted(counting(clone).items()):
        assert edited(clone, another_line, module) == names, module


def test_own_body_kernel_and_setting(clone):
    def body(text):
        assert "def lottery_cell" in text
        return text.replace("def lottery_cell(", "def lottery_cell (", 1)

    lottery = module_of(load().studies["xue_lottery"].compute).removeprefix("dualarm_repro.")
    assert "xue_lottery" in edited(clone, body, lottery)
    kernels = edited(clone, lambda text: text.replace("0.0", "1e-300", 1), "arms.trigonometry")
    assert kernels == set(STUDIES)
    defaults = edited(clone, lambda text: text + "\nX = 2\n", "planning.settings")
    assert {"xue_lottery", "qiu_fit"} <= defaults
    assert not {name for name in defaults if name.startswith("pan")}


def test_docstrings_comments_and_views_do_not_count(clone):
    def comment(text):
        return "# a comment\n" + text.replace('"""', '"""Reworded. ', 1)

    assert edited(clone, comment, "arms.kernels") == set()
    assert edited(clone, lambda text: text.replace("#0072B2", "#0072B3"), "view.style") == set()


def test_drawings_depend_on_the_view_and_values_do_not():
    compute = load().checkers["xue.fig08"].compute
    values, drawn = closure([compute]), closure([compute], drawn=True)
    assert not any(".view." in name for name in values.modules)
    assert "dualarm_repro.view.style" in drawn.modules


@pytest.mark.parametrize("name", STUDIES)
def test_stored_studies_are_up_to_date(name):
    assert load().studies[name].status() == "up to date"


#: Studies whose cells compute what brief ones do, and take a second or more.
LONG = ("pan_fit", "xue_planners", "xue_search", "xue_paths", "pan_evolution", "pan_consistency")


@pytest.mark.parametrize("name", long_where(LONG.__contains__, STUDIES))
def test_a_cell_runs_no_code_and_opens_no_file_outside_its_closure(name, monkeypatch):
    study = load().studies[name]
    for module, constant, value in BRIEF.get(name, ()):
        monkeypatch.setattr(module, constant, value)
    index = cheapest(study)
    stays_within(study, index, {**study.cells()[index], **BRIEF_CELLS.get(name, {})})


@pytest.mark.long(short="test_a_cell_runs_no_code_and_opens_no_file_outside_its_closure")
@pytest.mark.parametrize("name", sorted({*BRIEF, *BRIEF_CELLS, *CHEAPEST}))
def test_a_whole_cell_runs_no_code_and_opens_no_file_outside_its_closure(name):
    study = load().studies[name]
    cells = study.cells()
    stays_within(study, len(cells) - 1, cells[-1])


def cheapest(study):
    """A cell that takes little, by what is stored of it; the last one where all take the same."""
    if study.name not in CHEAPEST:
        return len(study.cells()) - 1
    stored = pd.read_parquet(study.table_path)[CHEAPEST[study.name]]
    return int(stored[stored >= 0].idxmin())


def stays_within(study, index, cell):
    with recording() as opened:
        called = modules_called(lambda: study.cell(index, cell))
    assert module_of(study.compute) in called
    outside = {one for one in called if not carries(one)} - set(study.code["modules"])
    assert {one for one in outside if not one.endswith("__init__")} <= _packages()
    assert opened <= study.meta()["inputs"].keys()


def modules_called(call):
    """Modules of the package of which a function runs; the profiler sees compiled ones too."""
    profiler = Profile()
    profiler.runcall(call)
    names = {str(path): module for module, path in graph().files.items()}
    files = {getattr(entry.code, "co_filename", None) for entry in profiler.getstats()}
    return {names[file] for file in files & names.keys()}


def test_a_compiled_function_is_seen_where_it_is_called():
    assert "dualarm_repro.arms.trigonometry" in modules_called(lambda: sincos(0.1))
    assert modules_called(lambda: 0.1) == set()


def _packages():
    """Packages whose ``__init__`` runs when one of their modules is imported."""
    return {name for name, path in graph().files.items() if path.name == "__init__.py"}


@pytest.mark.parametrize("item_id", ITEMS)
def test_an_item_runs_no_code_outside_its_closure(item_id):
    from dualarm_repro.ledger import evaluate

    modules = closure([load().checkers[item_id].compute], roots(load(), item_id)).modules
    called = modules_called(lambda: evaluate(load(), item_id))
    assert {one for one in called if not carries(one)} - set(modules) <= _packages()


def test_robot_and_scene_files_are_inputs():
    registry = load()
    assert "robots/er16.yaml" in registry.studies["pan_evolution"].meta()["inputs"]
    assert "robots/panda.yaml" in registry.studies["patent_tasks"].meta()["inputs"]
    with recording() as opened:
        registry.checkers["patent.fig01"]
        from dualarm_repro.ledger import evaluate

        evaluate(registry, "patent.eq_integration")
    assert any(name.startswith("scenes/patent_") for name in opened)


def test_an_edited_robot_makes_every_study_of_it_stale(monkeypatch, tmp_path):
    registry = load()
    data = tmp_path / "data"
    shutil.copytree(data_path(), data)
    robot = data / "robots" / "er16.yaml"
    robot.write_text(
        robot.read_text(encoding="utf-8").replace("0.6733", "0.9733"), encoding="utf-8"
    )
    monkeypatch.setattr(found, "data_path", lambda *parts: data.joinpath(*parts))
    stale = {name for name, study in registry.studies.items() if study.status() != "up to date"}
    assert stale == {name for name in STUDIES if name.startswith("pan_")}
    assert "robots/er16.yaml changed" in registry.studies["pan_evolution"].status()


def test_versions_reach_solvers_and_robots():
    every = versions(graph().external(graph().files))
    for name in ("numpy", "pin", "coal", "llvmlite", "daqp", "proxsuite", "piqp", "clarabel",
                 "pymoo", "cma", "example-robot-data-loaders"):  # fmt: skip
        assert every.get(name, "absent") != "absent", name
    assert "matplotlib" not in closure([load().checkers["xue.eq02"].compute]).versions


def test_every_imported_name_has_its_distribution():
    from importlib.metadata import packages_distributions

    known = packages_distributions()
    for name in graph().external(graph().files):
        behind = DISTRIBUTIONS.get(name, (name.replace("_", "-"),))
        installed = {one.lower().replace("_", "-") for one in known.get(name, behind)}
        assert set(behind) & installed, name


def test_what_is_left_out_reaches_nothing_that_computes():
    names = [name for name in graph().files if keeps_books(name)]
    assert len(names) == 6
    assert set(graph().closure(names)) == set(names)
