"""Messages through the pipe between a process and its worker, each with its length before it."""

from __future__ import annotations

import struct
from typing import IO

HEADER = struct.Struct("<Q")


def send(pipe: IO[bytes] | None, message: bytes) -> None:
    """Send a message.

    Parameters
    ----------
    pipe : file or None
        To the other process; None if there is none.
    message : bytes
        Of any length.

    Raises
    ------
    EOFError
        If there is no pipe.
    OSError
        If nobody reads it.
    """
    if pipe is None:
        raise EOFError
    pipe.write(HEADER.pack(len(message)))
    pipe.write(message)
    pipe.flush()


def receive(pipe: IO[bytes] | None) -> bytes:
    """Wait for a message.

    Parameters
    ----------
    pipe : file or None
        From the other process; None if there is none.

    Returns
    -------
    bytes

    Raises
    ------
    EOFError
        If the pipe ends before the message does.
    """
    if pipe is None:
        raise EOFError
    head = pipe.read(HEADER.size)
    if len(head) < HEADER.size:
        raise EOFError
    (size,) = HEADER.unpack(head)
    message = pipe.read(size)
    if len(message) < size:
        raise EOFError
    return message
