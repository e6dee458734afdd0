"""An interruption by the user, found again where Python or a library has changed its form."""

from __future__ import annotations


def is_interruption(error: BaseException) -> bool:
    """Whether an error is the user's Ctrl-C, or what a library made of it.

    Parameters
    ----------
    error : BaseException
        A compiled library that is interrupted while it loads raises ImportError from KeyboardInterrupt.

    Returns
    -------
    bool
        True if a KeyboardInterrupt is the error or among its causes.
    """
    cause: BaseException | None = error
    while cause is not None:
        if isinstance(cause, KeyboardInterrupt):
            return True
        cause = cause.__cause__ or cause.__context__
    return False


def forget_interruption() -> None:
    """Let the process end with its own exit code after an interruption that was caught.

    CPython notes an interruption that leaves ``exec`` or ``eval`` of a string, of which data classes and
    named tuples are made, and kills its own process by SIGINT at the very end, although the interruption was
    caught. The next string that is run wipes the note out (``run_eval_code_obj`` in Python/pythonrun.c).
    """
    exec("")  # noqa: S102 - an empty program
