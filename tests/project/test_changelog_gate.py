"""A change of the library without a line in the changelog fails, in a repository of its own."""

import subprocess

import changelog_gate
import pytest

BEFORE = "# Changelog\n\n## [Unreleased]\n\n### Added\n\n- Old line.\n\n## [0.1]\n\n- Older.\n"
AFTER = BEFORE.replace("- Old line.", "- Old line.\n- New line.")


def test_only_a_new_line_of_the_top_section_counts():
    changed = ["dualarm_repro/arms/x.py", "tests/x.py"]
    assert changelog_gate.verdict(changed, BEFORE, AFTER, "") is None
    for text in (
        BEFORE,
        BEFORE.replace("- Older.", "- Older.\n- Late."),
        BEFORE.replace("### Added", "### Added\n\n### Fixed"),
        BEFORE.replace("- Old line.\n", ""),
    ):
        assert "dualarm_repro/arms/x.py" in changelog_gate.verdict(changed, BEFORE, text, "")


def test_other_files_need_no_line_and_a_reason_replaces_one():
    assert changelog_gate.verdict(["tests/x.py", "README.md"], BEFORE, BEFORE, "") is None
    changed = ["dualarm_repro/x.py"]
    reason = "Rename a local\n\nChangelog: none, no behaviour changes\n"
    assert changelog_gate.verdict(changed, BEFORE, BEFORE, reason) is None
    assert changelog_gate.verdict(changed, BEFORE, BEFORE, "Changelog: none") is not None


@pytest.fixture
def clone(tmp_path):
    """A repository whose branch `work` has left `main`."""

    def git(*arguments):
        author = ("-c", "user.name=a", "-c", "user.email=a@example.org")
        subprocess.run(["git", *author, *arguments], cwd=tmp_path, check=True, capture_output=True)

    def commit(message, **files):
        for name, text in files.items():
            path = tmp_path / {"log": "CHANGELOG.md", "code": "dualarm_repro/x.py"}[name]
            path.parent.mkdir(exist_ok=True)
            path.write_text(text, encoding="utf-8")
        git("add", "-A")
        git("commit", "-q", "-m", message)

    git("init", "-q", "-b", "main")
    commit("Start", log=BEFORE, code="a = 1\n")
    git("checkout", "-q", "-b", "work")
    return tmp_path, commit


def test_the_gate_judges_a_branch(clone):
    folder, commit = clone
    assert changelog_gate.gate(folder, "main") is None
    commit("Change the code", code="a = 2\n")
    assert "no new line" in changelog_gate.gate(folder, "main")
    commit("Say so", log=AFTER)
    assert changelog_gate.gate(folder, "main") is None


def test_an_unknown_base_is_no_pass(capsys):
    assert changelog_gate.main(["--base", "no-such-branch"]) == 2
    assert "no-such-branch" in capsys.readouterr().err
