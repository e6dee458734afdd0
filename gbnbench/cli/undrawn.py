"""The error of a command whose results are whole, but whose pictures could not be made."""

from __future__ import annotations

from pathlib import Path
from typing import NoReturn

from gbnbench.core.errors import UnfinishedError


def undrawn(folder: Path, fault: str) -> NoReturn:
    """Say where the results are and that the same command tries the pictures again; ends with exit code 2.

    Parameters
    ----------
    folder : Path
        Where the results stand.
    fault : str
        What went wrong.

    Raises
    ------
    UnfinishedError
        Always.
    """
    raise UnfinishedError(
        f"what comes last could not be made: {fault}. All results are in {folder}, and the same command "
        "tries the pictures again"
    )
