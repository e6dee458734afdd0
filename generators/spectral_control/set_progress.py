"""Progress of stealthy sets: a descent, then Gauss-Newton steps."""

from __future__ import annotations

from gbnbench.generators.monitor import Monitor
from gbnbench.generators.spectral_control.core_descent import STEPS

USUAL = 10  # Gauss-Newton steps that are expected


class SetProgress:
    """Progress of one set of several, in hundredths of a set: half for the descent, half for newton.

    Parameters
    ----------
    monitor : Monitor
        Whom it is told.
    k, sets : int
        The set, from 0, and how many there are.
    """

    def __init__(self, monitor: Monitor, k: int, sets: int) -> None:
        self._progress, self._k, self._sets = monitor.progress, k, sets

    def share(self, share: float, doing: str) -> None:
        """Say which share of this set is done.

        Parameters
        ----------
        share : float
            From 0 to 1.
        doing : str
            What is being done.
        """
        if self._progress is not None:
            done = 100 * self._k + min(99, round(100 * share))
            self._progress(done, 100 * self._sets, f"stealthy, set {self._k + 1}, {doing}")

    def descent(self, step: int, cost: float) -> None:
        """Say that a step of the descent with a core is done.

        Parameters
        ----------
        step : int
            Steps done.
        cost : float
            A point.
        """
        self.share(step / STEPS / 2, f"cost {cost:.1e} a point")

    def step(self, step: int, residual: float) -> None:
        """Say that a Gauss-Newton step is done.

        Parameters
        ----------
        step : int
            Steps done.
        residual : float
            Of the amplitudes, over what is allowed.
        """
        self.share(0.5 + step / (2 * USUAL), f"{residual:.1e} times what is allowed")
