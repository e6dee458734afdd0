"""Arguments that are true or false, and no text that would be taken for true."""

from __future__ import annotations

import numpy as np

from gbnbench.core.errors import InputError


def check_flags(**flags: object) -> None:
    """Refuse what is neither True nor False.

    Parameters
    ----------
    **flags : object
        By the names of the arguments.

    Raises
    ------
    InputError
        If one is anything else, such as ``"no"`` or ``1``.

    Examples
    --------
    >>> check_flags(invert="no")
    Traceback (most recent call last):
    gbnbench.core.errors.InputError: invert must be True or False; got 'no'
    """
    for name, value in flags.items():
        if not isinstance(value, (bool, np.bool_)):
            raise InputError(f"{name} must be True or False; got {value!r}")
