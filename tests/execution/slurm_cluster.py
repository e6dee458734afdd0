"""A Slurm of one machine on the loopback, from Debian's packages: its daemons end with the block."""

from __future__ import annotations

import os
import secrets
import shutil
import socket
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from tests.execution.cluster_processes import until
from tests.processes import COMMAND

DAEMONS = {
    name: shutil.which(name, path=f"{os.environ.get('PATH', os.defpath)}:/usr/sbin")
    for name in ("munged", "slurmctld", "slurmd")
}
HERE = os.name == "posix" and os.getuid() == 0 and all(DAEMONS.values())
REASON = "no slurmctld, or not root: apt-get install slurm-wlm munge"

CONFIGURATION = """
ClusterName=tried
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller}
SlurmdPort={daemon}
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmdParameters=config_overrides
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
ReturnToService=2
SchedulerParameters=batch_sched_delay=0
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
NodeName=node NodeHostname={host} NodeAddr=127.0.0.1 CPUs=2 RealMemory=64000 State=UNKNOWN
PartitionName=cpu Nodes=node Default=YES MaxTime=120 State=UP
"""


class Slurm:
    """A controller and a node of two processors that has no accounting, so that ``sacct`` fails.

    Attributes
    ----------
    folder : Path
        Of its state, and of the commands.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._processes: list[subprocess.Popen[bytes]] = []
        for name in ("state", "spool"):
            (folder / name).mkdir()
        controller, daemon = _free_ports(2)
        host = socket.gethostname().partition(".")[0]
        conf = folder / "slurm.conf"
        conf.write_text(CONFIGURATION.format(host=host, controller=controller, daemon=daemon, folder=folder))
        (folder / "cgroup.conf").touch()
        self.environment = {**os.environ, "SLURM_CONF": str(conf)}

    def start(self) -> None:
        """Start what lets the daemons know each other, the controller and the node; wait for the node."""
        folder, conf = self.folder, self.folder / "slurm.conf"
        key = folder / "munge.key"
        key.write_bytes(secrets.token_bytes(128))
        key.chmod(0o600)
        at = {name: f"--{name}-file={folder}/munge.{name}" for name in ("key", "pid", "seed", "log")}
        self._start("munged", "--foreground", "--force", f"--socket={folder}/munge.socket", *at.values())
        until((folder / "munge.socket").exists, 30)
        self._start("slurmctld", "-D", "-f", conf)
        self._start("slurmd", "-D", "-N", "node", "-f", conf)
        try:
            until(lambda: "idle" in self.said("sinfo", "-h", "-o", "%T"), 60)
        except TimeoutError:
            last = [(folder / f"{name}.out").read_text(errors="replace").strip()[-200:] for name in DAEMONS]
            raise TimeoutError("; ".join(filter(None, last)) or "the node is not idle after 60 s") from None

    def said(self, *command: str) -> str:
        """Give the answer of a command of Slurm; an empty one if it fails."""
        done = subprocess.run(
            command, env=self.environment, capture_output=True, text=True, timeout=60, check=False
        )
        return done.stdout

    def jobs(self, state: str = "PENDING,RUNNING,SUSPENDED") -> list[str]:
        """Give the numbers of the jobs that are queued, run or are suspended."""
        return self.said("squeue", "-h", "-o", "%A", "-t", state).split()

    def suspended(self) -> list[str]:
        """Suspend one running job, so that it cannot end by itself; give its number, or none if none runs."""
        for job in self.jobs("RUNNING")[:1]:
            self.said("scontrol", "suspend", job)  # refused if the job has just ended
        return self.jobs("SUSPENDED")

    def command(self, out: Path, asked: list[str], **settings: object) -> list[str]:
        """Give what asks for something by jobs of this Slurm, with these settings beside those of all."""
        held = {"folder": str(out.parent / "jobs"), "jobs": 2, "calls_a_job": 6, "poll_seconds": 1.0}
        config = out.parent / "slurm.toml"
        lines = [f"{name} = {value!r}" for name, value in {**held, **settings}.items()]
        config.write_text("\n".join(["[slurm]", *lines]))
        return [*COMMAND, *asked, "--out", str(out), "--executor", "slurm", "--executor-config", str(config)]

    def begin(self, out: Path, asked: list[str], **settings: object) -> subprocess.Popen[str]:
        """Begin it."""
        return subprocess.Popen(
            self.command(out, asked, **settings),
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=self.environment,
        )  # fmt: skip

    def end(self) -> None:
        """End the jobs, then the daemons, last that by which they know each other."""
        self.said("scancel", "--user", "root")
        with suppress(TimeoutError):
            until(lambda: not self.said("squeue", "-h"), 20)
        for process in reversed(self._processes):
            process.terminate()
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()

    def _start(self, name: str, *arguments: object) -> None:
        with (self.folder / f"{name}.out").open("wb") as log:
            process = subprocess.Popen(
                [str(DAEMONS[name]), *map(str, arguments)],
                env=self.environment, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
            )  # fmt: skip
        self._processes.append(process)


@contextmanager
def slurm() -> Iterator[Slurm]:
    """Start a Slurm in a folder of its own, whose path is short enough for a socket's."""
    with tempfile.TemporaryDirectory(prefix="slurm-", ignore_cleanup_errors=True) as folder:
        made = Slurm(Path(folder))
        try:
            made.start()
            yield made
        finally:
            made.end()


def _free_ports(count: int) -> list[int]:
    """Give ports that nobody has just now."""
    servers = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [server.getsockname()[1] for server in servers]
    for server in servers:
        server.close()
    return ports
