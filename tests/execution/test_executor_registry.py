"""Executors by their names, addresses and files of settings, and what is wrong with these in words."""

from __future__ import annotations

from pathlib import Path

import pytest

from gbnbench.core.errors import FormatError, InputError, UnfinishedError
from gbnbench.execution.executor_choice import chosen_executor, use_executor
from gbnbench.execution.executors import extra
from gbnbench.execution.executors.dask_scheduler import DaskScheduler
from gbnbench.execution.executors.local_processes import LocalProcesses
from gbnbench.execution.executors.registry import EXECUTORS, find
from gbnbench.execution.executors.slurm_jobs import SlurmJobs


def test_names_addresses_and_files(tmp_path: Path) -> None:
    assert set(EXECUTORS) == {"local", "dask", "mpi", "slurm"}
    assert all(kind.summary for kind in EXECUTORS.values())
    assert find(None) == LocalProcesses()
    assert find("dask:tcp://head:8786") == DaskScheduler("tcp://head:8786")
    file = tmp_path / "cluster.toml"
    file.write_text(
        'executor = "slurm"\n[slurm]\npartition = "cpu"\ncalls_a_job = 8\n[dask]\nwait_seconds = 5\n'
    )
    assert find(None, file) == SlurmJobs(partition="cpu", calls_a_job=8)
    assert find("dask:local", file) == DaskScheduler("local", wait_seconds=5)
    assert SlurmJobs(partition="cpu", gpus=1).parameters() == {
        "timeout_min": 60, "mem_gb": 4, "cpus_per_task": 1, "gpus_per_node": 1, "slurm_partition": "cpu",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("text", "content", "words"),
    [
        ("ray", "", "no executor is named 'ray'; there are local, dask, mpi, slurm"),
        (None, "[slurm]\nqueue = 1", "slurm has no setting 'queue'; it has"),
        ("slurm", "[slurm]\njobs = 'many'", "jobs of slurm must be a whole number; got 'many'"),
        ("slurm", "[slurm]\njobs = 0", "jobs of slurm must be at least 1; got 0"),
        ("dask", "[dask]\ntries = true", "tries of dask must be a whole number; got True"),
        ("dask", "tries = 3", "'tries' is neither executor"),
        ("dask", "tries = ", "is no TOML"),
    ],
)
def test_what_is_wrong_is_said(tmp_path: Path, text: str | None, content: str, words: str) -> None:
    file = tmp_path / "cluster.toml"
    file.write_text(
        content if text is not None or "slurm" not in content else 'executor = "slurm"\n' + content
    )
    with pytest.raises(InputError) as error:
        find(text, file)
    assert words in str(error.value)
    with pytest.raises(FormatError, match="cannot be read"):
        find(text, tmp_path / "none.toml")


def test_addresses_that_mean_nothing_and_missing_packages(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    with pytest.raises(InputError, match="give the address of the Dask scheduler"):
        find("dask").start(1)
    with pytest.raises(InputError, match="local takes no address; got local:here"):
        find("local:here").start(1)
    with pytest.raises(InputError, match="slurm takes no address but local or debug; got slurm:here"):
        find("slurm:here").start(1)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", "")
    with pytest.raises(UnfinishedError, match="no Slurm here"):
        find("slurm").start(1)
    assert list(tmp_path.iterdir()) == []
    monkeypatch.setattr(extra, "find_spec", lambda name: None)
    for name, package in (("dask:local", "distributed"), ("mpi", "mpi4py"), ("slurm", "submitit")):
        kind = name.partition(":")[0]
        with pytest.raises(
            InputError, match=rf'executor {kind} needs the package {package}: pip install "gbnbench'
        ):
            find(name).start(1)


def test_the_executor_in_force_ends_with_its_block() -> None:
    assert not chosen_executor().remote
    with use_executor("dask:tcp://head:8786"):
        assert chosen_executor().executor == DaskScheduler("tcp://head:8786")
    with use_executor(None):
        assert chosen_executor().executor == LocalProcesses()
