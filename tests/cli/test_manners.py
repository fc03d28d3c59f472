"""What a newcomer may expect: examples, quick answers, plain pipes, one line at the end."""

import gc
import json
import os
import pty
import re
import shlex
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import get_args

import pytest
from long_tests import long_where

from dualarm_repro import __version__
from dualarm_repro.cli.app import COMMANDS, application
from dualarm_repro.cli.arguments import Kind
from dualarm_repro.interruption import uninterrupted
from dualarm_repro.ledger import schema

ROOT = Path(__file__).parents[2]
#: Libraries that no help and no kept record needs.
HEAVY = {
    "cvxpy",
    "jinja2",
    "matplotlib",
    "meshcat",
    "numba",
    "pandas",
    "pinocchio",
    "scipy",
    "sympy",
}
COMMAND = [sys.executable, "-m", "dualarm_repro.cli"]


def parsed(line):
    """Let the command line be read, and nothing be done."""
    words = shlex.split(line.partition(" >")[0])
    assert words[0] == "dualarm"
    command = application(rich=False)
    with command.make_context("dualarm", words[1:]) as context:
        name, chosen, rest = command.resolve_command(context, words[1:])
        chosen.make_context(name, rest, parent=context)


@pytest.mark.parametrize("name", COMMANDS)
def test_every_help_ends_with_examples_that_can_be_read(dualarm, name):
    code, out, err = dualarm(name, "--help")
    assert (code, err) == (0, "")
    examples = out.partition("\nExamples:\n")[2].splitlines()
    assert examples
    for line in examples:
        assert line.startswith(f"  dualarm {name} ") or line == f"  dualarm {name}"
        parsed(line.strip())


def test_every_command_speaks_json():
    for name, command in application(rich=False).commands.items():
        assert "--json" in {option for one in command.params for option in one.opts}, name


def test_the_kinds_of_the_help_are_those_of_the_ledger():
    assert list(get_args(Kind)) == [str(kind) for kind in schema.Kind]


def test_without_arguments_it_explains_itself(dualarm):
    code, out, err = dualarm()
    assert (code, err) == (2, "")
    for line in re.findall(r"^  (dualarm .*?)(?:  |$)", out, re.MULTILINE):
        parsed(line)
    assert "dualarm --help" in out


def test_version(dualarm):
    assert dualarm("--version") == (0, f"dualarm {__version__}\n", "")


DOCUMENTS = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "book").rglob("*.md"))]


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: str(path.relative_to(ROOT)))
def test_commands_in_the_documents_can_be_read(path):
    text = path.read_text(encoding="utf-8")
    found = re.findall(r"`(dualarm [^`]+)`", text)
    found += re.findall(
        r"^ {4,}(?:\.venv/bin/|uv run )?(dualarm .+?)(?: {2,}.*)?$", text, re.MULTILINE
    )
    for line in found:
        line = re.sub(r"\bN\b", "2", line.partition("#")[0].strip())
        named = line.removeprefix("dualarm ") in COMMANDS  # a mention, not a call
        if not named and line != "dualarm" and not re.search("--(help|install)", line):
            parsed(line.removesuffix("..."))


def imported(*arguments):
    """Top-level modules that a call imports, in a process of its own."""
    program = (
        "import json, sys; sys.argv = ['dualarm', *sys.argv[1:]]\n"
        "from dualarm_repro.cli import main\n"
        "try: main()\n"
        "except SystemExit as end: assert not end.code, end.code\n"
        "print('\\n' + json.dumps(sorted(sys.modules)))"
    )
    command = [sys.executable, "-c", program, *arguments]
    made = subprocess.run(command, capture_output=True, text=True, check=True)
    return set(json.loads(made.stdout.splitlines()[-1]))


def test_help_and_version_import_next_to_nothing():
    for arguments in (["--help"], ["--version"], ["show", "--help"]):
        modules = imported(*arguments)
        assert not {name.partition(".")[0] for name in modules} & (HEAVY | {"numpy", "yaml"})
        assert "dualarm_repro.ledger" not in modules
        assert "rich" not in modules


def test_show_of_a_kept_record_imports_no_method(dualarm):
    dualarm("show", "xue.tab01")  # so that there is one
    modules = imported("show", "xue.tab01")
    found = {name.partition(".")[0] for name in modules}
    assert not found & (HEAVY - {"jinja2"})  # what is obtained is told by a template
    assert not any(name.startswith("dualarm_repro.papers.xue") for name in modules)


def test_list_of_kept_records_imports_no_method(dualarm):
    chosen = ("list", "--paper", "xue", "--kind", "equation")
    assert dualarm(*chosen)[0] == 0  # so that they are kept
    modules = imported(*chosen)
    assert not {name.partition(".")[0] for name in modules} & HEAVY
    assert not any(name.startswith("dualarm_repro.papers.xue") for name in modules)


def test_plan_imports_nothing_that_it_does_not_use(tmp_path):
    """No figures, no web server of the viewer, no other planner and no solver of one."""
    tasks = str(ROOT / "data" / "scenes" / "example_tasks.yaml")
    modules = imported("plan", tasks, "--method", "apf-bidirectional", "--out", str(tmp_path))
    assert (tmp_path / "example_tasks.html").is_file()
    found = {name.partition(".")[0] for name in modules}
    unused = {"cvxpy", "jinja2", "matplotlib", "meshcat", "ompl", "qpsolvers", "sympy", "toppra"}
    assert not found & (unused | {"IPython", "rich", "tornado", "zmq"})
    rooms = {name.split(".")[1] for name in modules if name.startswith("dualarm_repro.")}
    assert not rooms & {"arena", "baselines", "control", "papers", "welding"}


def on_terminal(command, env=None, streams=(1, 2)):
    """Output of a command whose chosen streams are a terminal of 100 columns."""
    ours, theirs = pty.openpty()
    other = subprocess.DEVNULL
    process = subprocess.Popen(
        command,
        stdin=other,
        stdout=theirs if 1 in streams else other,
        stderr=theirs if 2 in streams else other,
        env={**os.environ, "TERM": "xterm-256color", "COLUMNS": "100"} | (env or {}),
    )
    os.close(theirs)
    found = b""
    while True:
        try:
            part = os.read(ours, 65536)
        except OSError:  # the other end is closed
            break
        if not part:
            break
        found += part
    os.close(ours)
    process.wait()
    return found.decode()


def test_panels_and_colours_on_a_terminal_and_none_in_a_pipe(dualarm):
    drawn = on_terminal([*COMMAND, "show", "xue.tab02"])
    assert "╭" in drawn
    assert "\x1b[" in drawn
    assert re.search(r"\x1b\[[0-9;]*3\dm", on_terminal(listing := [*COMMAND, "list"], streams=(1,)))
    assert not re.search(r"\x1b\[[0-9;]*3\dm", on_terminal(listing, {"NO_COLOR": "1"}, (1,)))
    for arguments in (["show", "xue.tab02"], ["list", "--paper", "xue"], ["--help"]):
        out = dualarm(*arguments)[1]
        assert "\x1b" not in out
        assert "│" not in out
        assert not re.search(r" $", out, re.MULTILINE)


def test_a_pipe_cuts_no_title(dualarm):
    out = dualarm("list", "--paper", "pan")[1]
    registry_titles = [
        made["title"] for made in json.loads(dualarm("list", "--paper", "pan", "--json")[1])
    ]
    lines = out.splitlines()
    assert len(lines) == len(registry_titles) + 1
    assert all(line.endswith(title) for line, title in zip(lines[1:], registry_titles, strict=True))


SLOW = """
from time import sleep
from dualarm_repro.cli import progress
progress.PATIENCE = 0.05
with progress.waiting("computing it"):
    sleep(0.6)
for name in progress.each(["first", "second"], "reading"):
    sleep(0.3)
"""


def test_progress_on_a_terminal_and_silence_in_ci():
    command, here = [sys.executable, "-c", SLOW], {k: "" for k in ("CI",)}
    drawn = on_terminal(command, here)
    assert "computing it" in drawn
    assert "reading: second" in drawn
    assert on_terminal(command, {"CI": "true"}) == ""
    piped = subprocess.run(command, capture_output=True, text=True, check=True)
    assert (piped.stdout, piped.stderr) == ("", "")


def completing(line):
    """Variables by which bash asks what to offer after a command line."""
    last = str(len(line.split(" ")) - 1)
    return {"_DUALARM_COMPLETE": "complete_bash", "COMP_WORDS": line, "COMP_CWORD": last}


@pytest.fixture
def completions(dualarm, monkeypatch):
    """What bash is offered after a command line."""

    def offered(line):
        for name, value in completing(line).items():
            monkeypatch.setenv(name, value)
        code, out, _ = dualarm()
        assert code == 0
        return out.split()

    return offered


def test_a_shell_completes_commands_ids_and_assumptions(completions):
    assert completions("dualarm sh") == ["show"]
    assert "xue.tab02" in completions("dualarm show xue.tab")
    assert completions("dualarm list --paper pat") == ["patent"]
    assert completions("dualarm run xue.tab02 --set base_d") == ["base_distance="]
    assert "xue_lottery" in completions("dualarm study xue_l")


def test_a_process_completes_as_well():
    env = {**os.environ, **completing("dualarm list --paper pat")}
    made = subprocess.run(COMMAND, capture_output=True, text=True, check=True, env=env)
    assert made.stdout.split() == ["patent"]


def interrupted(delay, *arguments):
    """Exit code and standard error of a call that is interrupted after some seconds."""
    process = subprocess.Popen(
        [*COMMAND, *arguments],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        env={**os.environ, "DUALARM_CACHE": "off"},
    )
    time.sleep(delay)
    os.killpg(process.pid, signal.SIGINT)
    return process.communicate(timeout=60)[1], process.returncode


@pytest.mark.parametrize("delay", long_where(lambda delay: delay == 1.0, [0.5, 1.0, 2.0]))
def test_an_interruption_is_one_line(delay, tmp_path):
    """While modules are imported as well as while something is computed; all files, or none."""
    item_id = "patent.claim_faster"  # takes seconds, so that it does not end before
    ending = interrupted(delay, "run", item_id, "--out", str(tmp_path))
    assert ending == ("dualarm: interrupted\n", 130)
    whole = {f"{item_id}.{kind}" for kind in ("json", "csv", "svg", "png")}
    assert {path.name for path in tmp_path.iterdir()} in (set(), whole)


def test_once_it_has_answered_nothing_interrupts_its_end():
    program = (
        "import atexit, os, signal, sys\n"
        "from dualarm_repro import cli\n"
        "atexit.register(lambda: print(signal.getsignal(signal.SIGINT) == signal.SIG_IGN))\n"
        "atexit.register(os.kill, os.getpid(), signal.SIGINT)\n"
        "sys.argv = ['dualarm', '--version']\n"
        "cli.{}()"
    )
    command = [sys.executable, "-c", program.format("process")]
    made = subprocess.run(command, capture_output=True, text=True)
    assert (made.returncode, made.stderr, made.stdout.split()[-1]) == (0, "", "True")
    command = [sys.executable, "-c", program.format("main")]
    made = subprocess.run(command, capture_output=True, text=True)
    assert made.stdout.split()[-1] == "False", "more commands may follow"


def test_a_full_disk_and_a_closed_pipe_are_no_traceback():
    with open("/dev/full", "w") as full:
        made = subprocess.run(
            [*COMMAND, "cite", "xue.tab01"], stdout=full, stderr=subprocess.PIPE, text=True
        )
    assert made.returncode == 1
    assert made.stderr.count("\n") == 1
    line = f"{shlex.join([*COMMAND, 'list'])} | head -1; exit ${{PIPESTATUS[0]}}"
    made = subprocess.run(["bash", "-c", line], capture_output=True, text=True)
    assert (made.returncode, made.stderr) == (0, "")


def test_an_unforeseen_error_is_one_line_and_shown_whole_on_demand(dualarm, monkeypatch, capsys):
    def broken():
        raise ZeroDivisionError("by\nnothing")

    monkeypatch.setattr("dualarm_repro.papers.load", broken)
    code, out, err = dualarm("show", "xue.tab01")
    assert (code, out, err.count("\n")) == (70, "", 1)
    assert "ZeroDivisionError: by nothing" in err
    monkeypatch.setenv("DUALARM_TRACEBACK", "1")
    monkeypatch.setattr(sys, "argv", ["dualarm", "show", "xue.tab01"])
    from dualarm_repro import cli

    with pytest.raises(ZeroDivisionError):
        cli.main()


@pytest.mark.parametrize("ending", [SystemExit, ZeroDivisionError, KeyboardInterrupt])
def test_however_a_command_ends_ctrl_c_belongs_to_the_caller_again(monkeypatch, ending):
    from dualarm_repro import cli

    def ends():
        if ending is KeyboardInterrupt:
            signal.raise_signal(signal.SIGINT)
        raise ending

    monkeypatch.setenv("DUALARM_TRACEBACK", "1")
    monkeypatch.setattr("dualarm_repro.papers.load", ends)
    monkeypatch.setattr(sys, "argv", ["dualarm", "show", "xue.tab01"])

    def habits():
        return signal.getsignal(signal.SIGINT), sys.unraisablehook, gc.get_threshold()

    before = habits()
    with pytest.raises(ZeroDivisionError if ending is ZeroDivisionError else SystemExit):
        cli.main()
    assert habits() == before


def swallowed_by_a_bare_except():
    try:
        signal.raise_signal(signal.SIGINT)
    except BaseException:  # as libraries do while they are imported
        pass


def swallowed_in_a_finalizer():
    class Dying:
        def __del__(self):
            signal.raise_signal(signal.SIGINT)

    Dying()


@pytest.mark.parametrize("swallowed", [swallowed_by_a_bare_except, swallowed_in_a_finalizer])
def test_an_interruption_that_a_library_swallowed_comes_again(dualarm, monkeypatch, swallowed):
    from dualarm_repro import cli

    reached = []

    def long_work():
        swallowed()
        signal.raise_signal(signal.SIGINT)  # a second press of the keys disturbs nothing
        reached.append("after")
        with uninterrupted():
            time.sleep(0.2)
            reached.append("uninterrupted")
        time.sleep(30)
        reached.append("the end")

    monkeypatch.setattr(cli, "AGAIN", 0.1)
    monkeypatch.setattr("dualarm_repro.papers.load", long_work)
    before = signal.getsignal(signal.SIGALRM)
    assert dualarm("show", "xue.tab01") == (130, "", "dualarm: interrupted\n")
    assert reached == ["after", "uninterrupted"]
    assert signal.getsignal(signal.SIGALRM) == before
    assert signal.getitimer(signal.ITIMER_REAL) == (0, 0)


DAMAGES = ("[]", "{}", '{"code": 1, "cells": 1, "inputs": {}, "table_sha256": ""}', "{")


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_damaged_study_disables_neither_list_nor_cite(dualarm, tmp_path, monkeypatch, damage):
    from dualarm_repro.ledger import kept
    from dualarm_repro.ledger.study import Study
    from dualarm_repro.papers import load
    from dualarm_repro.tracking import forget

    assert "xue_lottery" in load().studies
    broken, whole = tmp_path / "broken.json", Study.meta_path.fget
    broken.write_text(damage)
    place = property(lambda self: broken if self.name == "xue_lottery" else whole(self))
    monkeypatch.setattr(Study, "meta_path", place)
    monkeypatch.setenv("DUALARM_CACHE", "off")
    forget()
    monkeypatch.setattr(
        kept,
        "read",
        lambda registry, kind, name: None if name == "xue.tab02" else _kept(name),
    )
    code, out, err = dualarm("list", "--paper", "xue")
    assert code == 0
    assert re.search(r"^xue\.tab02 .*not available", out, re.MULTILINE)
    assert re.search(r"^xue\.tab01 .*inconsistent-in-print", out, re.MULTILINE)
    assert err.count("\n") == 1
    assert "dualarm study xue_lottery" in err
    code, out, err = dualarm("cite", "xue.tab02")
    assert (code, err.count("\n")) == (0, 1)
    assert out.startswith("@")
    code, out, err = dualarm("show", "xue.tab02")
    assert (code, err.count("\n")) == (1, 1)
    assert "0.53" in out
    assert "base_distance" in out
    forget()


def _kept(name):
    """A record that stands for those that nothing is wrong with."""
    from dualarm_repro.ledger.record import _declared
    from dualarm_repro.papers import load

    return {"record": _declared(load(), name) | {"verdict": "inconsistent-in-print"}, "inputs": []}


def test_a_listing_of_kept_records_imports_no_heavy_library():
    code = (
        "import sys\n"
        "from dualarm_repro.cli import main\n"
        "from dualarm_repro.ledger import kept\n"
        "from dualarm_repro.ledger.record import _declared\n"
        "from dualarm_repro.papers import load\n"
        "load().checker = lambda name: None\n"
        "kept.read = lambda registry, kind, name: {'inputs': [], 'record':\n"
        "    _declared(registry, name) | {'verdict': 'reproduced'}}\n"
        "sys.argv = ['dualarm', 'list']\n"
        "try:\n"
        "    main()\n"
        "finally:\n"
        "    heavy = ('pandas', 'numba', 'scipy', 'pinocchio', 'coal', 'sympy', 'matplotlib')\n"
        "    print([name for name in heavy if name in sys.modules])\n"
    )
    made = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "xue.tab01" in made.stdout
    assert made.stdout.splitlines()[-1] == "[]"
