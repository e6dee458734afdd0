"""Pictures whatever backend of matplotlib another machine's settings name."""

from __future__ import annotations

import pytest

from tests.processes import python

DRAW = (
    "import gbnbench.reports.style\n"
    "from matplotlib.figure import Figure\n"
    "from gbnbench.reports.comparison.figure_files import png\n"
    "import matplotlib, os\n"
    "assert png(Figure()).startswith(b'\\x89PNG')\n"
    "print(matplotlib.rcParams._get('backend'), os.environ['MPLBACKEND'])"
)


@pytest.mark.parametrize(
    ("backend", "kept"),
    [
        ("no such backend", False),
        ("TkAgg", True),
        ("module://matplotlib_inline.backend_inline", True),
        ("module://nowhere.backend", True),
    ],
)
def test_any_mplbackend_leaves_pictures_and_itself(backend: str, kept: bool) -> None:
    done = python(DRAW, MPLBACKEND=backend)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    used = done.stdout.strip().removesuffix(backend).strip()
    assert (used.lower() == backend.lower()) == kept
    assert done.stdout.strip().endswith(backend)  # the environment of later processes is not changed
