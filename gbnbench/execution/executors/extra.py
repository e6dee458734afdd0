"""Packages that an executor needs and gbnbench does not."""

from __future__ import annotations

from importlib.util import find_spec

from gbnbench.core.errors import InputError


def require(package: str, extra: str, executor: str) -> None:
    """Refuse an executor whose package is missing, with what to install.

    Parameters
    ----------
    package : str
        As it is imported.
    extra : str
        The extra of gbnbench that installs it.
    executor : str
        Its name.

    Raises
    ------
    InputError
        If the package is not installed.
    """
    if find_spec(package) is None:
        raise InputError(
            f'the executor {executor} needs the package {package}: pip install "gbnbench[{extra}]"'
        )
