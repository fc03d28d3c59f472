"""Compute the table of public arms, data/results/public_arms.parquet; goes on where it stopped."""

import argparse

from dualarm_repro.view.public_arms import PUBLIC_ARMS, summary


def main() -> None:
    """Compute every file of example-robot-data and print the counts."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--jobs", type=int, default=1, help="worker processes")
    rows = PUBLIC_ARMS.run(jobs=parser.parse_args().jobs, progress=True)
    for key, value in summary(rows).items():
        print(f"{key}: {value}")


if __name__ == "__main__":
    main()
