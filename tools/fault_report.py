"""Faults, one after the other, and what comes of each: `python -m tools.fault_report`."""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

from tests.faults.cases import CASES, CannotError, Row
from tests.faults.outages import server_faults


def line(row: Row) -> str:
    """A row of the table."""
    held = "-" if row.held_s is None else f"{row.held_s * 1000:.1f} ms"
    return f"| {row.fault} | {row.answer} | {held} | {row.lost} | {'yes' if row.well else 'NO'} |"


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", help="the faults whose function has this in its name")
    given = parser.parse_args()
    print("| fault | answer | loop held | lost | well again |\n| --- | --- | --- | --- | --- |")
    for case in (*CASES, server_faults):
        if given.only and given.only not in case.__name__:
            continue
        with tempfile.TemporaryDirectory(prefix="roadtalk-") as folder:
            try:
                for row in case(Path(folder)):
                    print(line(row).replace(folder, ""), flush=True)
            except CannotError as lack:
                print(f"| {case.__name__} | not tried: {lack} | | | |", flush=True)


if __name__ == "__main__":
    main()
