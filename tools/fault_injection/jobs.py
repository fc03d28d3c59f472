"""Commands whose results are known, and what is left of them after a fault."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

from .calls import Call

TOOLS = Path(__file__).resolve().parents[1]
SCENES = TOOLS.parent / "data" / "scenes"
#: Folder below the place in which a command works, where its files belong.
OUT = "out"
_CLI = (sys.executable, "-m", "dualarm_repro.cli")
_FORWARD = (
    "from dualarm_repro import load_arm; print(load_arm('irb120').fk([0.1 * k for k in range(6)]))"
)


@dataclass(frozen=True)
class Job:
    """A command.

    Attributes
    ----------
    codes
        Exit codes of an ending that is right.
    told
        Whether what it prints belongs to its results.
    parallel
        Whether it has worker processes.
    """

    name: str
    command: tuple[str, ...]
    codes: tuple[int, ...] = (0,)
    told: bool = False
    parallel: bool = False

    def results(self, folder: Path, call: Call | None = None) -> dict[str, str]:
        """SHA-256 of every file that bears its final name, and what the command told."""
        out = folder / OUT
        found = {
            path.relative_to(out).as_posix(): _key(path)
            for path in sorted(out.rglob("*"))
            if path.is_file() and not _hidden(path.relative_to(out))
        }
        if self.told and call is not None:
            found["standard output"] = call.out
        return found

    def left_behind(self, folder: Path) -> int:
        """Number of temporary files and folders that nobody will remove."""
        out = folder / OUT
        return sum(path.name.startswith(".") for path in [*folder.glob("*"), *out.rglob("*")])

    def complaint(self, call: Call, expected: Mapping[str, str], folder: Path) -> str:
        """What is wrong with a call that has to succeed with these results; empty if nothing."""
        if call.code not in self.codes or "Traceback" in call.err:
            return f"exit code {call.code}: {last_line(call.err)}"
        found = self.results(folder, call)
        differing = sorted(k for k in found.keys() | expected if found.get(k) != expected.get(k))
        return f"other results: {', '.join(differing)}" if differing else ""

    def harmed(self, expected: Mapping[str, str], folder: Path) -> str:
        """Files with a final name that are not what they should be; empty if none."""
        found = self.results(folder)
        wrong = [name for name, key in found.items() if expected.get(name) != key]
        return f"half-written: {', '.join(wrong)}" if wrong else ""


def refusal(call: Call, codes: tuple[int, ...] = (1, 2)) -> str:
    """What is wrong with a call that has to be refused in one line; empty if nothing."""
    lines = call.err.splitlines()
    if call.code not in codes:
        return f"exit code {call.code}: {last_line(call.err)}"
    return "" if len(lines) == 1 else f"{len(lines)} lines: {last_line(call.err)}"


def last_line(text: str) -> str:
    """The last line, without the folders that differ from run to run."""
    lines = [line for line in text.splitlines() if line.strip()]
    words = (lines[-1] if lines else "").split()
    return " ".join("(…)" if word.count("/") > 1 else word for word in words)[:200]


def _key(path: Path) -> str:
    try:
        return sha256(path.read_bytes()).hexdigest()
    except OSError:
        return "cannot be read"


def _hidden(path: Path) -> bool:
    return any(part.startswith(".") for part in path.parts)


def cli(name: str, *arguments: str, codes: tuple[int, ...] = (0,), told: bool = False) -> Job:
    """A command of `dualarm`."""
    return Job(name, (*_CLI, *arguments), codes, told, "--jobs" in arguments)


def script(name: str, *arguments: str, told: bool = False) -> Job:
    """A module beside this one."""
    file = str(TOOLS / "fault_injection" / f"{arguments[0]}.py")
    return Job(name, (sys.executable, file, *arguments[1:]), told=told)


SHOW = cli("show", "show", "xue.eq01", "--json", told=True)
FORWARD = Job("forward kinematics", (sys.executable, "-c", _FORWARD), told=True)
RUN = cli("run", "run", "xue.eq01", "--out", OUT)
STUDY = script("study", "tiny_study")
ROBUSTNESS = cli("robustness", "robustness", "xue.tab02", "--samples", "2", "--json", told=True)
PLAN = cli(
    "plan", "plan", str(SCENES / "example_tasks.yaml"), "--method", "apf-bidirectional",
    "--out", OUT, codes=(0, 3),
)  # fmt: skip
ARENA = cli(
    "arena", "arena", "--method", "apf-improved", "--kind", "random", "--most", "1", "--json",
    told=True,
)  # fmt: skip
VERIFY = cli("verify", "verify", "xue.eq01", "xue.eq02", "--jobs", "2", "--json", told=True)
PRERUN = script("prerun", "small_book")
#: What is killed and interrupted.
LONG = (RUN, STUDY, ROBUSTNESS, PLAN, ARENA, PRERUN)
