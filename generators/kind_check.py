"""The rules that a class must keep to be a generator: a frozen dataclass of settings that text can name."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping

from gbnbench.core.errors import InputError
from gbnbench.core.settings import SPECIFICATION
from gbnbench.generators.protocol import Generator

# Keywords of ``generate``, which no setting may be named after.
RESERVED = frozenset({"name", "n", "d", "seed", "realizations", "monitor", "device", "settings"})


def check_setting_names(kind: type[object]) -> None:
    """Refuse a generator with a setting of the name of a keyword of ``generate``, which would never reach it.

    Raises
    ------
    InputError
        If there is such a setting.
    """
    fields = {field.name for field in dataclasses.fields(kind)}  # type: ignore[arg-type]
    if taken := sorted(fields & RESERVED):
        raise InputError(
            f"a setting of a generator must not be named as a keyword of generate; {kind.__name__} has "
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
        If it is no class, no frozen dataclass, lacks what ``Generator`` asks for, has another name, a
        setting without a default or one of the name of a keyword of ``generate``.
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
    return kind


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
