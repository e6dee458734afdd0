"""Columns beside the bar of a live progress: a count or a share, the times, and what is being done."""

from __future__ import annotations

from rich.progress import BarColumn, ProgressColumn, Task, TextColumn
from rich.table import Column
from rich.text import Text


class Count(ProgressColumn):
    """How much is done: steps of all, or the share of all work."""

    def __init__(self) -> None:
        super().__init__(Column(no_wrap=True))
        self.percent = False

    def render(self, task: Task) -> Text:
        """Give the count of a task; nothing before it is known."""
        done, total = int(task.completed), task.total
        if not total:
            return Text("")
        if self.percent:
            return Text(f"{100 * done / total:3.0f}%", style="progress.download")
        return Text(f"{done:{len(str(int(total)))}d}/{int(total)}", style="progress.download")


class Times(ProgressColumn):
    """How long it has taken, and how long it will still take where that is known."""

    max_refresh = 0.5

    def __init__(self) -> None:
        super().__init__(Column(no_wrap=True))

    def render(self, task: Task) -> Text:
        """Give both times of a task."""
        said = _clock(task.elapsed or 0.0)
        left = task.time_remaining
        if left and task.completed:
            said += f", {_clock(left)} left"
        return Text(said, style="progress.elapsed")


class Doing(TextColumn):
    """What is being done: where the terminal is narrow this is cut, and not the numbers."""

    def __init__(self) -> None:
        super().__init__("{task.description}", markup=False, table_column=Column())

    def render(self, task: Task) -> Text:
        """Give what is being done, in one line."""
        text = super().render(task)
        text.no_wrap, text.overflow = True, "ellipsis"
        return text


def bar_column() -> BarColumn:
    """Give a bar that leaves room for words.

    Returns
    -------
    BarColumn
    """
    return BarColumn(bar_width=20, table_column=Column(no_wrap=True))


def _clock(seconds: float) -> str:
    minutes, rest = divmod(int(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02d}:{rest:02d}"
