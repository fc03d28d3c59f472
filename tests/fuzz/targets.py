"""Everything that is fuzzed: a name, and a function of a seed that judges one case."""

import math
from functools import cache, partial

import calls
import choices
import commands
import files

from dualarm_repro.cli.app import COMMANDS


@cache
def targets():
    """Target to the function that judges its case of a seed."""
    found = {f"call {name}": partial(calls.call, name) for name in calls.known()}
    found |= {f"settings {name}": partial(choices.call, name) for name in choices.known()}
    found |= {f"file {kind}": partial(files.call, kind) for kind in files.KINDS}
    found |= {f"command {name}": partial(commands.call, name) for name in COMMANDS}
    return found


def share(name):
    """Weight of a target: how many of the cases it gets."""
    kind, _, rest = name.partition(" ")
    weight = {"call": 1.0, "settings": 2.0, "file": 10.0, "command": 1.0}[kind]
    return weight * calls.SLOW.get(rest, 1.0)


@cache
def _whole():
    return sum(map(share, targets()))


def cases(name, total):
    """How many of so many cases a target gets, at least one."""
    return math.ceil(total * share(name) / _whole())
