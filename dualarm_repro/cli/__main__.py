"""``python -m dualarm_repro.cli`` is ``dualarm``."""

from . import main

if __name__ == "__main__":
    main()
