"""Results of tasks that others need: in memory up to a size, beyond it read from their store."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, overload

import numpy as np

from gbnbench.core.errors import UnfinishedError
from gbnbench.runs.result_store import ResultStore

MOST_BYTES = 1 << 28  # of all results that are in memory


class HeldResults:
    """Results by key, of which a store has those that memory does not.

    Parameters
    ----------
    store : ResultStore or None
        Where each is kept before it comes here; without one all stay in memory.
    """

    def __init__(self, store: ResultStore | None) -> None:
        self._store = store
        self._held: dict[str, Any] = {}
        self._bytes = 0

    def __contains__(self, key: object) -> bool:
        """Whether there is a result of this key."""
        return key in self._held

    def __setitem__(self, key: str, result: Any) -> None:
        """Take a result; one that is beyond the size and can be read back is let go."""
        size = bytes_of(result)
        if self._store and self._bytes + size > MOST_BYTES and self._store.read(key) is not None:
            self._held[key] = _IN_STORE
        else:
            self._held[key] = result
            self._bytes += size

    def __getitem__(self, key: str) -> Any:
        """Return a result.

        Raises
        ------
        UnfinishedError
            If it cannot be read back from the store.
        """
        result = self._held[key]
        if result is not _IN_STORE:
            return result
        found = self._store.read(key) if self._store else None
        if found is None:
            where = "" if self._store is None else f" of {self._store.path}"
            raise UnfinishedError(
                f"the piece {key}{where} is no longer there; the same command makes it anew"
            )
        return found

    def __delitem__(self, key: str) -> None:
        """Let go of a result."""
        result = self._held.pop(key)
        if result is not _IN_STORE:
            self._bytes -= bytes_of(result)

    def several(self, keys: Sequence[str]) -> Sequence[Any]:
        """Give results in the order of their keys, each read when it is looked at.

        Parameters
        ----------
        keys : sequence of str
            Theirs.

        Returns
        -------
        sequence
        """
        return _Several(self, tuple(keys))


class _Several(Sequence[Any]):
    def __init__(self, held: HeldResults, keys: tuple[str, ...]) -> None:
        self._held, self._keys = held, keys

    def __len__(self) -> int:
        return len(self._keys)

    @overload
    def __getitem__(self, index: int) -> Any: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Any]: ...
    def __getitem__(self, index: int | slice) -> Any:
        if isinstance(index, slice):
            return _Several(self._held, self._keys[index])
        return self._held[self._keys[index]]

    def __iter__(self) -> Iterator[Any]:
        return (self._held[key] for key in self._keys)


class _InStore:
    """Stands for a result that only the store has."""


_IN_STORE = _InStore()


def bytes_of(result: Any) -> int:
    """Count the bytes of the arrays in a result: an array, a mapping of them, or an object that has some."""
    if isinstance(result, np.ndarray):
        return result.nbytes
    if isinstance(result, Mapping):
        return sum(bytes_of(value) for value in result.values())
    fields = getattr(result, "__dict__", {})
    return sum(value.nbytes for value in fields.values() if isinstance(value, np.ndarray))
