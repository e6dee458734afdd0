"""Settings as text, ``name[setting=value,...]``, checked against the fields of a dataclass."""

from __future__ import annotations

import dataclasses
import difflib
import math
import re
import types
import typing
from collections.abc import Callable, Iterable, Mapping
from typing import Any, ClassVar, Protocol, TypeVar, cast

import numpy as np

from gbnbench.core.errors import InputError

SPECIFICATION = re.compile(r"\s*([^\[\]=,\s]+)\s*(?:\[([^\[\]]*)\]\s*)?")
TRUE, FALSE = ("true", "yes", "on", "1"), ("false", "no", "off", "0")


class Configured(Protocol):
    """A frozen dataclass of settings with a name, such as a generator or a family of integrands."""

    name: ClassVar[str]


T = TypeVar("T", bound=Configured)


def parse(text: str, what: str = "a generator") -> tuple[str, dict[str, str]]:
    """Split a text into its name and its settings, without checking them.

    Parameters
    ----------
    text : str
        ``name`` or ``name[setting=value,...]``.
    what : str
        What it should describe, for the error.

    Returns
    -------
    name : str
        The name.
    settings : dict of str
        Texts by the names of the settings.

    Raises
    ------
    InputError
        If the text is not ``name`` or ``name[setting=value,...]``, or a setting comes twice.

    Examples
    --------
    >>> parse("gbn[sigma=0.8, iterations=1000]")
    ('gbn', {'sigma': '0.8', 'iterations': '1000'})
    """
    match = SPECIFICATION.fullmatch(text)
    if match is None:
        raise InputError(f"{what} must read name or name[setting=value,...]; got {text!r}")
    name, inside = match.group(1), match.group(2) or ""
    settings: dict[str, str] = {}
    for item in inside.split(",") if inside.strip() else []:
        key, equals, value = (part.strip() for part in item.partition("="))
        if not (key and equals and value):
            raise InputError(f"a setting must read name=value; got {item.strip()!r} in {text!r}")
        if key in settings:
            raise InputError(f"a setting must come once; got {key!r} twice in {text!r}")
        settings[key] = value
    return name, settings


def configure(kind: type[T], settings: Mapping[str, object]) -> T:
    """Make a generator, or whatever has settings, from settings given as text or as values.

    Parameters
    ----------
    kind : type
        A frozen dataclass, such as one of ``GENERATORS``.
    settings : mapping
        Setting -> text, read by its field's type, or a value of that type; a field may bring a function of
        its own as the metadata ``read``.

    Returns
    -------
    object
        An instance of ``kind``.

    Raises
    ------
    InputError
        If a setting is unknown, not of its type, or out of the range that the class allows.

    Examples
    --------
    >>> from gbnbench.generators.voronoi.lloyd import Lloyd
    >>> configure(Lloyd, {"iterations": "50"})
    Lloyd(iterations=50, tolerance=0.001, method='auto')
    """
    hints = typing.get_type_hints(kind)
    fields = {field.name: field for field in _fields(kind)}
    values = {}
    for key, value in settings.items():
        if key not in fields:
            have = ", ".join(f"{name}={_text(field.default)}" for name, field in fields.items())
            raise InputError(
                f"{kind.name} has no setting {key!r}{nearest(key, fields)}; "
                + (f"its settings and defaults: {have}" if have else "it has none")
            )
        read = fields[key].metadata.get("read")
        values[key] = read(value) if read else _convert(f"{key} of {kind.name}", hints[key], value)
    return cast(Callable[..., T], kind)(**values)


def specification(thing: Configured) -> str:
    """Canonical text: the name and the settings that are not default, in field order.

    Examples
    --------
    >>> from gbnbench.generators.voronoi.lloyd import Lloyd
    >>> specification(Lloyd(iterations=50)), specification(Lloyd())
    ('lloyd[iterations=50]', 'lloyd')
    """
    given = [
        f"{field.name}={_text(getattr(thing, field.name))}"
        for field in _fields(type(thing))
        if getattr(thing, field.name) != field.default
    ]
    return f"{thing.name}[{','.join(given)}]" if given else thing.name


def nearest(word: str, words: Iterable[str]) -> str:
    """Suggest the nearest spelling: `` (did you mean 'x'?)``, or nothing where none is near.

    Parameters
    ----------
    word : str
        What was written.
    words : iterable of str
        What could be meant.

    Returns
    -------
    str
    """
    close = difflib.get_close_matches(word.lower(), list(words), n=1)
    return f" (did you mean {close[0]!r}?)" if close else ""


def is_readable(hint: object) -> bool:
    """Tell whether text gives values of a type: bool, int, float, str, a Literal, or one of these or None.

    Examples
    --------
    >>> is_readable(float | None), is_readable(list[float])
    (True, False)
    """
    origin, choices = typing.get_origin(hint), typing.get_args(hint)
    if origin in (typing.Union, types.UnionType):
        others = [choice for choice in choices if choice is not type(None)]
        return len(others) == 1 and len(choices) == 2 and is_readable(others[0])
    return origin is typing.Literal or hint in (bool, int, float, str)


def _fields(kind: type[Configured]) -> tuple[dataclasses.Field[Any], ...]:
    return dataclasses.fields(cast(Any, kind))


def _text(value: object) -> str:
    return str(value).lower() if value is None or isinstance(value, bool) else str(value)


def _convert(what: str, hint: Any, value: object) -> object:
    """Value as the type its field declares: bool, int, float, str, a Literal, or one of these or None."""
    origin, choices = typing.get_origin(hint), typing.get_args(hint)
    if origin in (typing.Union, types.UnionType):
        if value is None or (isinstance(value, str) and value.lower() == "none"):
            return None
        return _convert(what, next(choice for choice in choices if choice is not type(None)), value)
    if origin is typing.Literal:
        for choice in choices:
            if value == choice or value == _text(choice):
                return cast(object, choice)
        raise InputError(f"{what} must be one of {', '.join(map(_text, choices))}; got {value!r}")
    read: dict[type, Callable[[Any], object]] = {bool: _bool, int: _int, float: _float, str: _str}
    try:
        return read[hint](value)
    except (TypeError, ValueError, OverflowError):
        expected = {bool: "true or false", int: "a whole number", float: "a finite number", str: "text"}[hint]
        raise InputError(f"{what} must be {expected}; got {value!r}") from None


def _bool(value: object) -> bool:
    if isinstance(value, str) and value.lower() in TRUE + FALSE:
        return value.lower() in TRUE
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    raise TypeError


def _int(value: Any) -> int:
    if isinstance(value, (int, np.integer)) and not isinstance(value, bool):
        return int(value)
    if isinstance(value, str) and re.fullmatch(r"[+-]?\d+", value):
        return int(value)
    number = _float(value)  # so that 1e4 and 300.0 are read
    if number != int(number):
        raise ValueError
    return int(number)


def _float(value: Any) -> float:
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (str, int, float, np.number)):
        raise TypeError
    number = float(value)
    if not math.isfinite(number):
        raise ValueError
    return number


def _str(value: object) -> str:
    if not isinstance(value, str):
        raise TypeError
    return value
