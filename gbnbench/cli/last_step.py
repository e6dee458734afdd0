"""Words of a command whose results are whole, but whose tables or pictures could not be written."""

from __future__ import annotations

from pathlib import Path

from gbnbench.core.errors import UnfinishedError


def last_step_failed(folder: Path, fault: str) -> UnfinishedError:
    """Return the error that says where the results are, and that the same command tries again.

    Parameters
    ----------
    folder : Path
        Where the results stand.
    fault : str
        What went wrong.

    Returns
    -------
    UnfinishedError
        To be raised when the results are shown; it ends the command with exit code 2.
    """
    return UnfinishedError(
        f"the last step failed: {fault}. All results are in {folder}; the same command tries it again"
    )
