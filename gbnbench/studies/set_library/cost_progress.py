"""Progress of work whose steps differ in cost, counted by their estimated costs."""

from __future__ import annotations

from collections.abc import Mapping

from gbnbench.execution.progress import Progress

PARTS = 1000  # of the whole, in which it is shown


class CostProgress(Progress):
    """A progress that counts each step by its cost, so that the time left is told fairly.

    Parameters
    ----------
    shown : Progress
        Where it is shown, in thousandths of all work.
    costs : mapping of str to float
        The estimated cost of each step by what is said when it is finished, in any unit.
    done : float
        The cost of what was finished before.
    """

    def __init__(self, shown: Progress, costs: Mapping[str, float], done: float = 0.0) -> None:
        self._shown, self._costs = shown, costs
        self._done = done
        self._whole = max(done + sum(costs.values()), 1e-9)
        self._told = self._part()
        self._started = False

    def say(self, text: str) -> None:
        """Print one line beside the progress."""
        self._shown.say(text)

    def start(self, total: int, done: int, doing: str) -> None:  # noqa: ARG002 (steps of one round)
        """Begin a round of steps.

        Parameters
        ----------
        total, done : int
            Steps of the round, which have costs of their own here.
        doing : str
            What is being done now.
        """
        if self._started:
            self._shown.advance(doing, 0)
        else:
            self._started = self._shown.percent = True
            self._shown.start(PARTS, self._told, doing)

    def advance(self, doing: str, steps: int = 1) -> None:
        """Count a step, by what is said of it.

        Parameters
        ----------
        doing : str
            What was done.
        steps : int
            0 where nothing was finished.
        """
        if steps:
            self._done += self._costs.get(doing.removeprefix("failed: "), 0.0)
        part = self._part()
        self._shown.advance(doing, part - self._told)
        self._told = part

    def _part(self) -> int:
        return min(PARTS, int(PARTS * self._done / self._whole + 1e-6))
