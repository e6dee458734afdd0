"""Tables of experiments: rows in the order of the tasks, by whomever, from where they were left."""

from __future__ import annotations

from dataclasses import replace
from operator import itemgetter
from pathlib import Path

import pandas as pd
import pytest

from gbnbench.benchmarks.experiments import depth_order, window_coverage
from gbnbench.benchmarks.timing.table_store import TableStore
from tests.benchmarks.test_depth_order import TINY


def test_rows_stand_in_the_order_of_the_tasks_and_are_found_again(tmp_path):
    path = tmp_path / "table.csv"
    store = TableStore(path, ("name", "x"), itemgetter("name"), ["a", "b", "c"])
    store.write("c", [{"name": "c", "x": 1 / 3}])
    store.write("a", [{"name": "a", "x": float("nan")}, {"name": "a", "x": 2}])
    assert path.read_text() == "name,x\na,\na,2\nc,0.3333\n"
    again = TableStore(path, ("name", "x"), itemgetter("name"), ["b"])
    assert again.read("c") == [{"name": "c", "x": "0.3333"}]
    assert again.read("b") is None
    again.write("b", [{"name": "b", "x": 1}])
    assert path.read_text() == "name,x\nb,1\na,\na,2\nc,0.3333\n"


def without_time(path: Path) -> pd.DataFrame:
    return pd.read_csv(path).drop(columns="cpu_s")


@pytest.mark.slow
def test_two_workers_make_the_table_of_one_process(tmp_path):
    plan = (replace(TINY, seeds=1),)
    depth_order.main([str(tmp_path / "one.csv")], plan)
    depth_order.main([str(tmp_path / "two.csv"), "--jobs", "2"], plan)
    pd.testing.assert_frame_equal(without_time(tmp_path / "one.csv"), without_time(tmp_path / "two.csv"))


def test_rows_of_a_process_are_those_of_its_coverage():
    rows = pd.DataFrame(window_coverage.rows_of(0, 2))
    pd.testing.assert_frame_equal(rows, window_coverage.coverage(window_coverage.PROCESSES[0], 2))
