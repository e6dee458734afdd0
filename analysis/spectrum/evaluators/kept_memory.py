"""Memory and kernels of the last requests, kept from call to call, by each thread its own."""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Protocol, TypeVar

KEPT_BYTES = 128 << 20  # that a thread keeps in all
KEPT_REQUESTS = 16  # whose memory a thread keeps; a gridded FFT keeps its points and its transform apart


class Sized(Protocol):
    """What can be kept: it tells how much memory it holds."""

    @property
    def nbytes(self) -> int:
        """Bytes on the device and on the host."""
        ...


Held = TypeVar("Held", bound=Sized)


class _Kept(threading.local):
    """What this thread keeps, the last used at the end."""

    def __init__(self) -> None:
        self.held: OrderedDict[Hashable, Sized] = OrderedDict()


_kept = _Kept()


def kept(kind: Callable[..., Held], *arguments: Hashable) -> Held:
    """Make something for a request, or give what this thread made of the same arguments not long ago.

    Parameters
    ----------
    kind : callable
        Class or function that makes it.
    *arguments : hashable
        All that it depends on: the precision on its device, and the sizes.

    Returns
    -------
    Sized
        What ``kind(*arguments)`` gives. No other thread has it, and no other request.
    """
    key, held = (kind, *arguments), _kept.held
    found = held.get(key)
    if found is not None:
        held.move_to_end(key)
        return found  # type: ignore[return-value] # the key says what made it
    made = kind(*arguments)
    if made.nbytes <= KEPT_BYTES:
        held[key] = made
        while len(held) > KEPT_REQUESTS or sum(one.nbytes for one in held.values()) > KEPT_BYTES:
            held.popitem(last=False)
    return made


def forget() -> None:
    """Give the memory free that this thread keeps."""
    _kept.held.clear()
