"""Options that several commands share."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any, TypeVar

import click

F = TypeVar("F", bound=Callable[..., Any])


class Whole(click.ParamType[tuple[int, ...]]):
    """Whole numbers parted by commas, such as ``256,1024,4096``."""

    name = "numbers"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[int, ...]:
        """Read the text once; click hands back what is read already."""
        if isinstance(value, tuple):
            return value
        try:
            numbers = tuple(int(word) for word in str(value).split(","))
        except ValueError:
            self.fail(f"must be whole numbers parted by commas; got {value!r}", param, ctx)
        if bad := [number for number in numbers if number < 1]:
            self.fail(f"must be at least 1; got {bad[0]}", param, ctx)
        return numbers


def seed(command: F) -> F:
    """``--seed``."""
    return click.option(
        "--seed", type=click.IntRange(0), default=0, show_default=True,
        help="Realization k draws from stream k of this seed.",
    )(command)  # fmt: skip


def device(command: F) -> F:
    """``--device``, for this process and its workers."""

    def choose(_: click.Context, __: click.Parameter, value: str | None) -> None:
        if value is not None:
            from gbnbench.opencl import DEVICE_VARIABLE

            os.environ[DEVICE_VARIABLE] = value

    return click.option(
        "--device", metavar="NAME", expose_value=False, callback=choose,
        help="OpenCL device: a number or part of a name from 'gbnbench devices'. [default: $GBNBENCH_DEVICE, "
        "else the best]",
    )(command)  # fmt: skip
