"""Measure claims of the paper, all or some, into a table that keeps what was measured before.

    python -m gbnbench.benchmarks.claims [CLAIM...] OUT.csv [--sets NAME=FOLDER]... [--again]

Sets by others are no part of this project: --sets bnot=FOLDER and --sets step=FOLDER tell where text files of
1,024 points of blue noise through optimal transport and of step blue noise are.
"""

from __future__ import annotations

import argparse
import csv
import io
import json
import os
import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path

from gbnbench.benchmarks.claims.claim import COLUMNS, Claim
from gbnbench.benchmarks.claims.registry import CLAIMS
from gbnbench.benchmarks.claims.sets import MissingError, Sets
from gbnbench.benchmarks.timing.machine import describe
from gbnbench.core.atomic_write import write_whole
from gbnbench.core.errors import InputError
from gbnbench.execution.worker_pool import ONE_THREAD

Table = dict[str, list[dict[str, str]]]


def read(path: Path) -> Table:
    """Rows of a table by claim, as text."""
    table: Table = {}
    if path.exists():
        with path.open(newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                table.setdefault(row["claim"], []).append(row)
    return table


def write(path: Path, table: Mapping[str, list[dict[str, str]]]) -> None:
    """Write a table whole, its claims in the order of the paper."""
    text = io.StringIO()
    writer = csv.DictWriter(text, COLUMNS, lineterminator="\n")
    writer.writeheader()
    for claim in CLAIMS:
        writer.writerows(table.get(claim.name, []))
    write_whole(path, text.getvalue().encode())


def measure(claim: Claim, sets: Sets) -> list[dict[str, str]]:
    """Measure one claim; its rows as text, with the CPU seconds of each.

    Raises
    ------
    MissingError
        If it needs sets by others that are not there.
    """
    rows = []
    began = time.process_time()
    for row in claim.measure(sets):
        cells = {"claim": claim.name, "place": claim.place, **asdict(row)}
        cells["cpu_s"] = time.process_time() - began
        rows.append({name: _cell(cells[name]) for name in COLUMNS})
        began = time.process_time()
    return rows


def _cell(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def fill(path: Path, claims: Sequence[Claim], sets: Sets, again: bool = False) -> None:
    """Measure the claims that the table does not have, or all again; keep each as soon as it is known."""
    table = read(path)
    for claim in claims:
        if claim.name in table and not again:
            continue
        try:
            rows = measure(claim, sets)
        except MissingError as missing:
            print(f"{claim.name}: left out, {missing}", flush=True)
            continue
        table[claim.name] = rows
        write(path, table)
        for row in rows:
            print(f"{claim.name}.{row['row']}: {row['measured']} ({row['paper']}) {row['holds']}", flush=True)


def named(names: Sequence[str]) -> list[Claim]:
    """Claims of these names, or all.

    Raises
    ------
    InputError
        If there is none of a name.
    """
    known = {claim.name: claim for claim in CLAIMS}
    for name in names:
        if name not in known:
            raise InputError(f"no claim is called {name!r}; there are {', '.join(known)}")
    return [claim for claim in CLAIMS if not names or claim.name in names]


def main(arguments: Sequence[str] | None = None) -> None:
    """Fill the table in the file named."""
    parser = argparse.ArgumentParser(prog="python -m gbnbench.benchmarks.claims", description=__doc__)
    parser.add_argument("claims", nargs="*", metavar="CLAIM", help="by name; all where none is given")
    parser.add_argument("out", type=Path, metavar="OUT.csv")
    parser.add_argument("--sets", action="append", default=[], metavar="NAME=FOLDER")
    parser.add_argument("--again", action="store_true", help="measure what the table has already, too")
    asked = parser.parse_args(arguments)
    folders = {name: Path(folder) for name, _, folder in (given.partition("=") for given in asked.sets)}
    os.environ.update(ONE_THREAD)  # before the device is opened
    claims = named(asked.claims)
    write_whole(asked.out.with_name("machine.json"), (json.dumps(describe(), indent=1) + "\n").encode())
    fill(asked.out, claims, Sets(folders), asked.again)
