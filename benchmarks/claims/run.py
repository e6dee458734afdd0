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
from typing import Any

from gbnbench.benchmarks.claims.claim import COLUMNS, Claim
from gbnbench.benchmarks.claims.registry import CLAIMS
from gbnbench.benchmarks.claims.sets import MissingError, SetCache
from gbnbench.benchmarks.timing.machine import describe
from gbnbench.core.atomic_write import write_whole
from gbnbench.core.errors import GbnbenchError, InputError
from gbnbench.execution.one_thread import ONE_THREAD
from gbnbench.execution.progress import Progress
from gbnbench.runs.resumable import TaskRun
from gbnbench.runs.task import Task

Table = dict[str, list[dict[str, str]]]


def read(path: Path) -> Table:
    """Read the rows of a table by claim, as text."""
    table: Table = {}
    if path.exists():
        with path.open(newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                table.setdefault(row["claim"], []).append(row)
    return table


def write(path: Path, table: Mapping[str, list[dict[str, str]]]) -> None:
    """Write a table whole, its claims in the order of the paper.

    Parameters
    ----------
    path : Path
        Where it stands.
    table : mapping of str to list of dict
        Rows by claim.
    """
    text = io.StringIO()
    writer: csv.DictWriter[str] = csv.DictWriter(text, COLUMNS, lineterminator="\n")
    writer.writeheader()
    for claim in CLAIMS:
        writer.writerows(table.get(claim.name, []))
    write_whole(path, text.getvalue().encode())


def measure(claim: Claim, sets: SetCache) -> list[dict[str, str]]:
    """Measure one claim; its rows as text, with the CPU seconds of each.

    Parameters
    ----------
    claim : Claim
        What to measure.
    sets : SetCache
        The point sets that claims are measured with.

    Returns
    -------
    list of dict
        Its rows.

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


def measure_or_explain(claim: Claim, sets: SetCache) -> list[dict[str, str]] | str:
    """Measure one claim, or say which sets by others it needs that are not there.

    Parameters
    ----------
    claim : Claim
        What to measure.
    sets : SetCache
        The point sets that claims are measured with.

    Returns
    -------
    list of dict, or str
        The rows, or what is missing.
    """
    try:
        return measure(claim, sets)
    except MissingError as missing:
        return str(missing)


class ClaimTable:
    """The table of claims as a store of results, written whole after every claim.

    Parameters
    ----------
    path : Path
        Of the table; it need not exist.
    again : bool
        Find nothing in it, so that all is measured again.
    """

    def __init__(self, path: Path, again: bool = False) -> None:
        self.path, self._again, self._table = path, again, read(path)
        self._machine = describe()

    def read(self, key: str) -> list[dict[str, str]] | None:
        """Return the rows of a claim; None where it has still to be measured."""
        return None if self._again else self._table.get(key)

    def write(self, key: str, result: list[dict[str, str]] | str) -> None:
        """Keep the rows of a claim; one that was left out has none.

        Parameters
        ----------
        key : str
            Name of the claim.
        result : list of dict, or str
            Its rows, or why it was left out.
        """
        if not isinstance(result, str):
            self._table[key] = result
            write(self.path, self._table)
            record_machine(self.path.with_name("machine.json"), key, self._machine)


def record_machine(path: Path, claim: str, machine: Mapping[str, Any]) -> None:
    """Note that a claim was measured on a machine, in a list of machines with their claims.

    Parameters
    ----------
    path : Path
        Of the list, JSON; it need not exist.
    claim : str
        Name of the claim; it is taken from the machine that measured it before.
    machine : mapping
        As ``describe`` returns it.
    """
    listed = json.loads(path.read_text(encoding="utf-8")) if path.exists() else []
    for one in listed:
        one["claims"] = [name for name in one["claims"] if name != claim]
    here = next((one for one in listed if one == {"claims": one["claims"], **machine}), None)
    if here is None:
        listed.append(here := {"claims": [], **machine})
    here["claims"].append(claim)
    kept = [one for one in listed if one["claims"]]
    write_whole(path, (json.dumps(kept, indent=1) + "\n").encode())


def _cell(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def fill(path: Path, claims: Sequence[Claim], sets: SetCache, again: bool = False) -> None:
    """Measure the claims that the table does not have, or all again; keep each as soon as it is known.

    Parameters
    ----------
    path : Path
        Of the table.
    claims : sequence of Claim
        What to measure.
    sets : SetCache
        The point sets that they are measured with.
    again : bool
        Measure also what the table has already.
    """
    tasks = [Task(claim.name, claim.name, measure_or_explain, (claim, sets)) for claim in claims]
    for done in TaskRun(tasks, ClaimTable(path, again)).complete(None, Progress()):
        if done.failure:
            raise GbnbenchError(f"{done.key} could not be measured: {done.failure}")
        if isinstance(done.value, str):
            print(f"{done.key}: left out, {done.value}", flush=True)
            continue
        for row in done.value:
            print(f"{done.key}.{row['row']}: {row['measured']} ({row['paper']}) {row['holds']}", flush=True)


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
    given = parser.parse_args(arguments)
    folders = {name: Path(folder) for name, _, folder in (text.partition("=") for text in given.sets)}
    os.environ.update(ONE_THREAD)  # before the device is opened
    claims = named(given.claims)
    fill(given.out, claims, SetCache(folders), given.again)
