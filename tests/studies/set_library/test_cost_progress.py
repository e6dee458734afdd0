"""Progress by cost: a dear step counts for more than a cheap one, and the end is the end."""

from __future__ import annotations

from gbnbench.execution.progress import Progress
from gbnbench.studies.set_library.cost_progress import PARTS, CostProgress


class Recorded(Progress):
    """What a progress is told."""

    def __init__(self) -> None:
        self.started: list[tuple[int, int]] = []
        self.parts = 0
        self.said: list[str] = []

    def say(self, text: str) -> None:
        self.said.append(text)

    def start(self, total: int, done: int, doing: str) -> None:
        self.started.append((total, done))
        self.parts = done

    def advance(self, doing: str, steps: int = 1) -> None:
        self.parts += steps


def test_steps_count_by_their_costs_over_several_rounds():
    shown = Recorded()
    progress = CostProgress(shown, {"cheap": 1.0, "dear": 7.0, "failing": 2.0})
    progress.start(2, 0, "first round")
    progress.advance("cheap")
    assert shown.parts == PARTS // 10
    progress.advance("looking", 0)
    assert shown.parts == PARTS // 10
    progress.start(2, 0, "second round")
    progress.advance("dear")
    assert shown.parts == PARTS * 8 // 10
    progress.advance("failed: failing")
    assert shown.parts == PARTS
    assert shown.started == [(PARTS, 0)]


def test_what_was_finished_before_is_counted_from_the_start():
    shown = Recorded()
    progress = CostProgress(shown, {"rest": 1.0}, done=3.0)
    progress.start(4, 3, "going on")
    assert shown.started == [(PARTS, PARTS * 3 // 4)]
    progress.say("a word")
    assert shown.said == ["a word"]
