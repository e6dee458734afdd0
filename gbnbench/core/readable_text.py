"""Names of files and labels as text that every file can hold, and their width on a terminal."""

from __future__ import annotations

import unicodedata

JOINERS = "\N{ZERO WIDTH JOINER}\N{ZERO WIDTH NON-JOINER}"


def without_bytes(name: object) -> str:
    r"""Write the bytes of a name that are not UTF-8 as ``\xe9``, so that any file can hold it as text.

    Examples
    --------
    >>> import os
    >>> print(without_bytes(os.fsdecode(b"caf\xe9.txt")), without_bytes("café"))
    caf\xe9.txt café
    """
    text = str(name)
    try:
        text.encode()
    except UnicodeEncodeError:
        return "".join(_byte(sign) if "\ud800" <= sign <= "\udfff" else sign for sign in text)
    return text


def in_one_line(name: object) -> str:
    r"""Write, besides those bytes, line ends and terminal codes in a name as ``\n`` and ``\x1b``.

    Examples
    --------
    >>> print(in_one_line("two\nlines"))
    two\nlines
    """
    return "".join(sign if _harmless(sign) else sign.encode("unicode_escape").decode() for sign in
                   without_bytes(name))  # fmt: skip


def counted(number: int, noun: str) -> str:
    """Write how many there are of something whose plural has an s.

    Parameters
    ----------
    number : int
        How many.
    noun : str
        Of one.

    Returns
    -------
    str

    Examples
    --------
    >>> counted(1, "set"), counted(200, "point")
    ('1 set', '200 points')
    """
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def display_width(text: str) -> int:
    """Count the columns of a terminal that a text takes: two for Chinese, Japanese and Korean signs.

    Examples
    --------
    >>> display_width("blue"), display_width("蓝噪声")
    (4, 6)
    """
    return sum(
        0
        if unicodedata.category(sign) in ("Mn", "Me", "Cf")
        else 2
        if unicodedata.east_asian_width(sign) in "WF"
        else 1
        for sign in text
    )


def left(text: str, width: int) -> str:
    """Fill a text with blanks behind it, to a number of columns of a terminal.

    Parameters
    ----------
    text : str
        The text.
    width : int
        Columns to fill; a wider text stays as it is.

    Returns
    -------
    str
    """
    return text + " " * (width - display_width(text))


def right(text: str, width: int) -> str:
    """Fill a text with blanks before it, to a number of columns of a terminal.

    Parameters
    ----------
    text : str
        The text.
    width : int
        Columns to fill; a wider text stays as it is.

    Returns
    -------
    str
    """
    return " " * (width - display_width(text)) + text


def _byte(sign: str) -> str:
    code = ord(sign)
    return f"\\x{code - 0xDC00:02x}" if 0xDC80 <= code <= 0xDCFF else f"\\u{code:04x}"


def _harmless(sign: str) -> bool:
    return sign.isprintable() or unicodedata.category(sign) == "Zs" or sign in JOINERS
