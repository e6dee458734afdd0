"""Worker processes on this machine, which gbnbench starts itself."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from gbnbench.core.errors import InputError
from gbnbench.execution.worker_pool import Pool


@dataclass(frozen=True)
class LocalProcesses:
    """Processes of one thread each, as many as ``--jobs`` says.

    Attributes
    ----------
    address : str
        Empty: they have none.
    tries : int
        How often a call is tried whose process died.
    """

    name: ClassVar[str] = "local"
    summary: ClassVar[str] = "processes on this machine, as many as --jobs says"
    remote: ClassVar[bool] = False

    address: str = ""
    tries: int = 2

    def start(self, jobs: int) -> Pool:
        """Make the pool; its processes start when calls need them."""
        if self.address:
            raise InputError(f"the executor local takes no address; got local:{self.address}")
        return Pool(jobs)
