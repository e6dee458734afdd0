"""A piece of work: one call of a function, whose result is kept under a key."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Task:
    """One call of a function.

    Attributes
    ----------
    key : str
        Unique among the tasks, and safe as a path, such as ``gbn_n64_d2/000000``.
    label : str
        What the user reads, such as ``gbn, n=64, d=2``.
    function : callable
        A function of a module, so that a worker process can import it.
    arguments : tuple
        Its arguments; they can be pickled.
    requires : tuple of str
        Keys of the tasks that come first. The list of their results is one more argument of the function.
    assemble : callable, optional
        Makes the result that is kept from what the function returned and the list of the results collected,
        or of those required where none are. It runs in this process, so that large arrays do not travel back
        from a worker.
    done : str
        What the progress says when the task is finished; the label where it is empty.
    collects : tuple of str
        Keys of tasks that those required have required before them, whose results ``assemble`` needs and the
        function does not.
    here : bool
        Carry it out in this process: it takes little time, of much that is here already.
    """

    key: str
    label: str
    function: Callable[..., Any]
    arguments: tuple[Any, ...] = ()
    requires: tuple[str, ...] = ()
    assemble: Callable[[Any, Sequence[Any]], Any] | None = None
    done: str = ""
    collects: tuple[str, ...] = ()
    here: bool = False

    @property
    def needs(self) -> tuple[str, ...]:
        """Keys of all tasks whose results must be there, each once."""
        return tuple(dict.fromkeys((*self.requires, *self.collects)))
