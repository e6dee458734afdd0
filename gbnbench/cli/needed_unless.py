"""An option that a command needs, unless a flag lets the command do without it."""

from __future__ import annotations

from typing import Any

import click


class NeededUnless(click.Option):
    """A required option that may be missing beside a flag.

    Parameters
    ----------
    *args : object
        As ``click.Option`` takes them.
    unless : str
        Name of the flag.
    **settings : object
        As ``click.Option`` takes them.
    """

    def __init__(self, *args: Any, unless: str, **settings: Any) -> None:
        super().__init__(*args, required=True, **settings)
        self.unless = unless

    def process_value(self, ctx: click.Context, value: Any) -> Any:
        """Let the option be missing where the flag is given; flags that are given are read before it.

        Parameters
        ----------
        ctx : click.Context
            Of the command.
        value : object
            As click found it.

        Returns
        -------
        object
            What the command gets, None if missing.

        Raises
        ------
        click.MissingParameter
            If it is missing without the flag.
        """
        if self.value_is_missing(value) and ctx.params.get(self.unless):
            return None
        return super().process_value(ctx, value)
