"""The regression's own cases, and one of a generator that costs little."""

from __future__ import annotations

from gbnbench.regression.case_file import default_path, read_cases
from gbnbench.regression.cases import Case, Expectation

OWN = {case.name: case for case in read_cases(default_path())}
JITTERED = Case(
    "jittered", "sets", 64, 2, {"noise_floor": Expectation("lower", "ratio", "seeds")}, generator="jittered"
)
