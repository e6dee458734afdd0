"""The rules that a class must keep to be a generator: a frozen dataclass of settings that text can name."""

from __future__ import annotations

import dataclasses
import typing
from collections.abc import Mapping

from gbnbench.core.errors import InputError
from gbnbench.core.readable_text import in_one_line
from gbnbench.core.settings import SPECIFICATION, is_readable
from gbnbench.generators.protocol import Generator

# Keywords of ``generate``, which no setting may be named after.
RESERVED = frozenset({"name", "n", "d", "seed", "realizations", "monitor", "device", "settings"})
# What generators have beside their settings, which no setting may hide.
MEMBERS = frozenset(
    {"summary", "family", "dimensions", "toroidal", "reference", "definition", "refusal", "draw", "explain"}
)


def check_setting_names(kind: type[object]) -> None:
    """Refuse a setting named as a keyword of ``generate``, which would never reach it, or as a member.

    Raises
    ------
    InputError
        If there is such a setting.
    """
    fields = {field.name for field in dataclasses.fields(kind)}  # type: ignore[arg-type]
    for names, what in ((RESERVED, "a keyword of generate"), (MEMBERS, "a member of generators")):
        if taken := sorted(fields & names):
            raise InputError(
                f"a setting of a generator must not be named as {what}; {kind.__name__} has "
                f"{', '.join(taken)}: rename it"
            )


def is_frozen_dataclass(kind: type[object]) -> bool:
    """Return whether a class is a frozen dataclass."""
    parameters = getattr(kind, "__dataclass_params__", None)
    return bool(getattr(parameters, "frozen", False))


def checked_kind(kind: object, name: str) -> type[Generator]:
    """Check that what somebody else offers under a name is the class of a generator.

    Parameters
    ----------
    kind : object
        Anything.
    name : str
        The name under which it is offered.

    Returns
    -------
    type
        The class.

    Raises
    ------
    InputError
        If it is no class, no frozen dataclass, lacks what ``Generator`` asks for, has another name, says
        anything but what lists can show, or has a setting without a default, of a type that text cannot
        give, or named as a keyword of ``generate`` or a member.
    """
    if not isinstance(kind, type):
        raise InputError(f"it must be a class; got {type(kind).__name__}")
    if not is_frozen_dataclass(kind):
        raise InputError(f"{kind.__name__} must be a frozen dataclass of its settings")
    if lacks := [member for member in ("name", "summary", "refusal") if not hasattr(kind, member)]:
        raise InputError(f"{kind.__name__} lacks {', '.join(lacks)}, which every generator has")
    if not any("__call__" in vars(base) for base in kind.__mro__):
        raise InputError(f"{kind.__name__} lacks __call__(n, d, rng), which draws a set")
    if kind.name != name or not SPECIFICATION.fullmatch(name):  # type: ignore[attr-defined]
        raise InputError(f"{kind.__name__} must have the name under which it is offered")
    nothing = dataclasses.MISSING
    bare = [
        field.name
        for field in dataclasses.fields(kind)
        if field.default is nothing and field.default_factory is nothing
    ]
    if bare:
        raise InputError(f"each setting needs a default; {kind.__name__} has none of {', '.join(bare)}")
    check_setting_names(kind)
    _check_listed(kind)
    _check_setting_types(kind)
    return kind


def _check_listed(kind: type[object]) -> None:
    """Refuse members that lists cannot show."""
    for member in ("summary", "family", "reference"):
        said = getattr(kind, member, "")
        is_line = isinstance(said, str) and in_one_line(said) == said
        if not is_line and (said is not None or member == "summary"):
            raise InputError(f"{member} of {kind.__name__} must be one line of text; got {said!r}")
    if not isinstance(toroidal := getattr(kind, "toroidal", None), bool | None):
        raise InputError(f"toroidal of {kind.__name__} must be True or False; got {toroidal!r}")
    ends = getattr(kind, "dimensions", (1, None))
    if not (isinstance(ends, tuple) and len(ends) == 2 and _is_range(*ends)):
        raise InputError(
            f"dimensions of {kind.__name__} must be (least, most), whole and >= 1, most None where there is "
            f"no end; got {ends!r}"
        )


def _is_range(least: object, most: object) -> bool:
    return type(least) is int and least >= 1 and (most is None or (type(most) is int and most >= least))


def _check_setting_types(kind: type[object]) -> None:
    """Refuse settings of a type that text cannot give, unless they bring a function that reads them."""
    try:
        hints = typing.get_type_hints(kind)
    except Exception as error:  # whatever a stranger's annotations raise
        raise InputError(f"the types of {kind.__name__} cannot be read: {error}") from None
    for field in dataclasses.fields(kind):  # type: ignore[arg-type]
        if "read" not in field.metadata and not is_readable(hints[field.name]):
            raise InputError(
                f"a setting must be a bool, int, float, str, Literal, or one of these or None; "
                f"{kind.__name__} has {field.name}"
            )


def of_instance(generator: object, settings: Mapping[str, object] | None = None) -> Generator:
    """Return a generator that came as an instance, of the registry or somebody's own, or say what it lacks.

    Parameters
    ----------
    generator : Generator
        An instance of a frozen dataclass with what ``Generator`` asks for.
    settings : mapping, optional
        What was given beside it: it has its settings already, so there must be none.

    Returns
    -------
    Generator
        The instance itself.

    Raises
    ------
    InputError
        If it is a class, no frozen dataclass, or no generator, if a setting of it has the name of a keyword
        of ``generate``, or if settings came with it.
    """
    kind = type(generator)
    if isinstance(generator, type):
        raise InputError(f"a generator must be an instance; got the class: write {generator.__name__}()")
    if not isinstance(generator, Generator):
        raise InputError(
            "a generator must be text such as 'gbn[sigma=0.8]', or an object with name, summary, "
            f"refusal(n, d) and __call__(n, d, rng); got {kind.__name__}"
        )
    if not is_frozen_dataclass(kind):
        raise InputError(f"a generator must be a frozen dataclass of its settings; {kind.__name__} is none")
    check_setting_names(kind)
    if settings:
        given = ", ".join(f"{name}=..." for name in settings)
        raise InputError(f"an instance has its settings already: write {kind.__name__}({given})")
    return generator
