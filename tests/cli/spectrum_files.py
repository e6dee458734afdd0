"""The command ``gbnbench spectrum`` as tests run it, and its files read back."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pandas as pd

Said = Callable[..., tuple[str, str]]


def stored(path: str) -> dict[str, Any]:
    with np.load(path) as archive:
        return {name: archive[name] for name in archive.files}


def frequencies(table: pd.DataFrame, d: int) -> np.ndarray:
    return table[[f"f{a}" for a in range(d)]].to_numpy()
