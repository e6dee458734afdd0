"""Settings of jobs of a Slurm cluster, by submitit: each job carries out a number of calls."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

from gbnbench.core.errors import InputError
from gbnbench.execution.executors.extra import require
from gbnbench.execution.executors.slurm_workers import JobWorkers

CLUSTERS = ("slurm", "local", "debug")


@dataclass(frozen=True)
class SlurmJobs:
    """Jobs that submitit sends to Slurm.

    Attributes
    ----------
    address : str
        ``local`` or ``debug`` for submitit's stand-ins on this machine; empty for Slurm.
    tries : int
        How often a piece is tried whose job failed.
    folder : str
        Where submitit keeps calls, results and logs; all nodes reach it.
    jobs : int
        Most jobs at a time.
    calls_a_job : int
        Most pieces that one job makes, one after another.
    poll_seconds : float
        Between looks at the jobs.
    wait_seconds : float
        How long a run waits while Slurm holds all jobs, accepts no more of them, or does not answer.
    partition, account, constraint : str
        Of the jobs, as Slurm has them; empty for the cluster's own.
    timeout_min : int
        Minutes after which Slurm ends a job.
    mem_gb : int
        Memory of a job.
    gpus : int
        GPUs of a job.
    """

    name: ClassVar[str] = "slurm"
    summary: ClassVar[str] = "jobs of a Slurm cluster by submitit; slurm:local tries it on this machine"
    remote: ClassVar[bool] = True

    address: str = ""
    tries: int = 3
    folder: str = "gbnbench-slurm"
    jobs: int = 32
    calls_a_job: int = 32
    poll_seconds: float = 2.0
    wait_seconds: float = 120.0
    partition: str = ""
    account: str = ""
    constraint: str = ""
    timeout_min: int = 60
    mem_gb: int = 4
    gpus: int = 0

    def start(self, jobs: int) -> JobWorkers:  # noqa: ARG002 - the settings say how many
        """Make ready to send jobs."""
        require("submitit", "slurm", self.name)
        require("threadpoolctl", "slurm", self.name)
        cluster = self.address or "slurm"
        if cluster not in CLUSTERS:
            raise InputError(f"slurm takes no address but local or debug; got slurm:{self.address}")
        return JobWorkers(self, cluster)

    def parameters(self) -> dict[str, Any]:
        """Give the settings of the jobs in submitit's words."""
        given = {
            f"slurm_{name}": value
            for name in ("partition", "account", "constraint")
            if (value := getattr(self, name))
        }
        gpus = {"gpus_per_node": self.gpus} if self.gpus else {}
        return {"timeout_min": self.timeout_min, "mem_gb": self.mem_gb, "cpus_per_task": 1, **gpus, **given}
