"""``python -m dualarm_repro.cli`` is ``dualarm``."""

from . import process

if __name__ == "__main__":
    process()
