"""A file of two cases for the tests of the regression."""

from __future__ import annotations

import pytest

from gbnbench.regression.case_file import write_cases
from tests.regression.own_cases import JITTERED, OWN


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "cases.json"
    write_cases(path, [OWN["lattice-3d-64-double"], JITTERED])
    return path
