"""A finished study of integration, its tables and its manifest, and the folder that keeps it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gbnbench.core import atomic_write
from gbnbench.core.errors import FormatError, InputError
from gbnbench.io import data_files
from gbnbench.runs.resumable_folder import MANIFEST, SETTINGS
from gbnbench.runs.task_folder import TaskFolder

if TYPE_CHECKING:
    import pandas as pd

TEXT = ("source", "integrand")
TABLES = ("variance", "slopes")


@dataclass(frozen=True)
class IntegrationStudy:
    """A finished study.

    Attributes
    ----------
    manifest : mapping
        JSON-ready: command, settings, seed, device, versions.
    variance : DataFrame
        A row a source, n, d and family: columns source, n, d, integrand, instances, realizations, shifts,
        variance, standard_error, low, high (95% band), bias, bias_error, foretold, foretold_error (what the
        spectra predict), beyond (most that white noise would add beyond the frequencies summed), deviation
        (of variance from the range of foretold to foretold + beyond, in standard errors of their difference,
        which is taken integrand by integrand and set by set); the last four nan for families whose spectrum
        is not known.
    slopes : DataFrame
        A row a source, d and family with two or more n: columns source, d, integrand, n_from, n_to, slope,
        standard_error, scatter (decades).
    """

    manifest: dict[str, Any]
    variance: pd.DataFrame
    slopes: pd.DataFrame


class StudyFolder(TaskFolder):
    """A study on disk."""

    kind = "study of integration"

    def write_tables(self, study: IntegrationStudy) -> None:
        """Write ``variance.csv`` and ``slopes.csv``."""
        for name in TABLES:
            atomic_write.write_whole(self.path / f"{name}.csv", data_files.to_csv(getattr(study, name)))


def is_study(folder: str | Path) -> bool:
    """Whether a folder is a study of integration, finished or not."""
    settings = Path(folder) / SETTINGS
    return settings.is_file() and "integrands" in data_files.read_json(settings)


def read_integration(folder: str | Path) -> IntegrationStudy:
    """Read a finished study.

    Raises
    ------
    InputError
        If it is none, or an unfinished one.
    FormatError
        If a file in it is missing or is not what was written.
    """
    path = Path(folder)
    if not (path / MANIFEST).is_file():
        state = "an unfinished" if (path / SETTINGS).is_file() else "no"
        raise InputError(f"{path} is {state} study of integration: it has no {MANIFEST}")
    manifest = data_files.read_json(path / MANIFEST)
    if "integrands" not in manifest.get("settings", {}):
        raise FormatError(path / MANIFEST, "is not of a study of integration")
    tables = (
        data_files.read_or_explain(path / f"{name}.csv", lambda p: data_files.read_csv(p, text=TEXT))
        for name in TABLES
    )
    return IntegrationStudy(manifest, *tables)
