"""Commands in a text for the shell, held against the command itself: names, options, values, generators."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator

import click

from gbnbench.analysis.integration.integrands.registry import find as find_family
from gbnbench.cli import gbnbench
from gbnbench.generators.adaptive.registry import adaptive_generator
from gbnbench.generators.registry import find

PLACEHOLDER = re.compile(r"[A-Z_]+|.*\$.*|.*\.\.\..*|<.*>")
BEFORE = {"do", "time", "nice", "$"}  # words that may stand before a command


def commands(text: str) -> Iterator[list[str]]:
    """Arguments of every gbnbench command of a text: what stands after its name."""
    for line in text.replace("\\\n", " ").splitlines():
        lexer = shlex.shlex(line, posix=True, punctuation_chars=True)
        lexer.whitespace_split = True
        words: list[str] = []
        for word in [*lexer, ";"]:
            if set(word) <= set("|&;"):
                yield from _arguments(words)
                words = []
            else:
                words.append(word)


def _arguments(words: list[str]) -> Iterator[list[str]]:
    while words and (words[0] in BEFORE or re.fullmatch(r"\w+=.*", words[0])):
        words = words[1:]
    if words[:1] == ["gbnbench"]:
        redirected = next((k for k, word in enumerate(words) if set(word) <= set("<>")), len(words))
        yield words[1:redirected]


def check(arguments: list[str], whole: bool = True) -> None:
    """Raise click.UsageError or a GbnbenchError where the command would not understand its arguments.

    A command that is no more than mentioned, not whole, may lack what it requires.
    """
    command: click.Command = gbnbench
    context = click.Context(command, info_name="gbnbench")
    rest = list(arguments)
    while isinstance(command, click.Group) and rest and not rest[0].startswith("-"):
        name = rest.pop(0)
        found = command.get_command(context, name)
        if found is None:
            raise click.UsageError(f"there is no command {name!r}", context)
        command, context = found, click.Context(found, info_name=name, parent=context)
    given, left, _ = command.make_parser(context).parse_args(rest)
    if given.get("help") or isinstance(command, click.Group):
        return
    if left:
        raise click.UsageError(f"what is {left[0]!r}?", context)
    for param in command.params:
        value = given.get(param.name)
        values = [value] if isinstance(value, str) else value if isinstance(value, (list, tuple)) else []
        spared = given.get(getattr(param, "unless", None))
        if whole and param.required and not values and not spared:
            raise click.MissingParameter(ctx=context, param=param)
        for each in values:
            if not PLACEHOLDER.fullmatch(each):
                if not isinstance(param.type, (click.Path, click.File)):
                    param.type.convert(each, param, context)
                if param.name == "integrands":
                    find_family(each)
                elif re.fullmatch(r"\w+\[.*\]", each) or (
                    command.name == "generate" and param.name == "name"
                ):
                    adaptive = command.name == "stipple" or given.get("density") is not None
                    (adaptive_generator if adaptive else find)(each)
