"""Hooks, workflows, container and forms name only what is there."""

import json
import re

import pytest
import yaml
from installs.rows import PYTHONS, project_table, rows

WORKFLOWS = ("test", "book", "wheel")


@pytest.fixture(scope="module")
def targets(root):
    """Targets of the Makefile."""
    text = (root / "Makefile").read_text(encoding="utf-8")
    return set(re.findall(r"^([a-z-]+):", text, re.MULTILINE))


def workflow(root, name):
    return yaml.safe_load((root / ".github/workflows" / f"{name}.yml").read_text(encoding="utf-8"))


def steps(root, name):
    return [step for job in workflow(root, name)["jobs"].values() for step in job["steps"]]


@pytest.mark.parametrize("name", WORKFLOWS)
def test_workflows_run_what_is_there(root, targets, name):
    commands = " && ".join(step["run"] for step in steps(root, name) if "run" in step)
    assert set(re.findall(r"\bmake ([a-z-]+)", commands)) <= targets
    for script in re.findall(r"tools/\w+\.py", commands):
        assert (root / script).is_file(), script
    assert workflow(root, name)["permissions"] == {"contents": "read"}


@pytest.mark.parametrize("name", WORKFLOWS)
def test_caches_are_keyed_by_the_lock(root, name):
    caches = [s["with"] for s in steps(root, name) if s.get("uses", "").startswith("actions/cache")]
    assert caches
    for cache in caches:
        files = re.findall(r"'([^']+)'", cache["key"])
        assert "requirements.lock" in files
        assert all((root / file).is_file() for file in files)
        if ".venv" in cache["path"]:
            assert "restore-keys" not in cache, "an environment of another lock is never taken"


def test_the_wheel_is_tried_on_two_pythons(root):
    include = workflow(root, "wheel")["jobs"]["wheel"]["strategy"]["matrix"]["include"]
    names = {row.name for row in rows(list(project_table(root)["optional-dependencies"]))}
    assert len({entry["python"] for entry in include}) == 2
    for entry in include:
        assert entry["python"] in PYTHONS
        assert set(entry["rows"].split()) <= names
        assert all(row.startswith(entry["python"]) for row in entry["rows"].split())


def test_hooks_are_local_and_locked(root):
    """Nothing is fetched: each hook is a tool of the lock or a script of the clone."""
    settings = yaml.safe_load((root / ".pre-commit-config.yaml").read_text(encoding="utf-8"))
    assert [repo["repo"] for repo in settings["repos"]] == ["local"]
    dev = " ".join(project_table(root)["optional-dependencies"]["dev"])
    hooks = settings["repos"][0]["hooks"]
    assert {"ruff", "ruff-format", "mypy", "codespell", "changelog", "leaks"} <= {
        hook["id"] for hook in hooks
    }
    for hook in hooks:
        assert hook["language"] == "system"
        command = hook["entry"].split()
        program = command[0].removeprefix(".venv/bin/")
        assert (root / command[1]).is_file() if program == "python" else program in dev


def test_the_form_for_an_erratum_asks_what_the_ledger_needs(root):
    form = yaml.safe_load((root / ".github/ISSUE_TEMPLATE/erratum.yml").read_text("utf-8"))
    fields = {entry["id"]: entry for entry in form["body"]}
    papers = {path.stem for path in (root / "data/papers").glob("*.yaml")}
    assert set(fields["document"]["attributes"]["options"]) == papers
    required = {k for k, f in fields.items() if f.get("validations", {}).get("required")}
    assert {"document", "item", "place", "problem", "proof"} <= required


def test_the_container_is_built_from_the_lock(root):
    text = (root / "Dockerfile").read_text(encoding="utf-8")
    assert "--require-hashes -r requirements.lock" in text
    lines = re.findall(r"^COPY (?:--\S+ )*(\S+) ", text, re.MULTILINE)
    assert all((root / source).exists() for source in lines)
    stages = re.findall(r"^FROM \S+ AS (\w+)", text, re.MULTILINE)
    container = json.loads((root / ".devcontainer/devcontainer.json").read_text(encoding="utf-8"))
    assert container["build"]["target"] in stages
    assert container["postCreateCommand"] == "make env"
    ignored = (root / ".dockerignore").read_text(encoding="utf-8").split()
    assert {".venv", ".git"} <= set(ignored)


def test_the_policy_names_files_and_variables_that_exist(root):
    text = (root / "SECURITY.md").read_text(encoding="utf-8")
    for name in re.findall(r"`((?:data|tools)/[\w./]+)`", text):
        assert (root / name).is_file(), name
    library = "\n".join(
        path.read_text(encoding="utf-8") for path in (root / "dualarm_repro").glob("*.py")
    )
    for variable in re.findall(r"`([A-Z]+_[A-Z_]+)`", text):
        assert variable in library, variable
