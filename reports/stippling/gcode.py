"""Stipplings as G-code for plotters, by a template of lines: move, pen down, pen up."""

from __future__ import annotations

import dataclasses
import string
import tomllib
from dataclasses import dataclass
from pathlib import Path

from gbnbench.core.errors import FormatError, InputError
from gbnbench.core.readable_text import in_one_line
from gbnbench.io.points.file_format import reason
from gbnbench.reports.stippling.page import Page

FIELDS = {
    "start": ("width", "height", "title"),
    "layer": ("layer", "colour", "dots"),
    "move": ("x", "y", "r"),
    "down": ("x", "y", "r"),
    "up": ("x", "y", "r"),
    "end": ("width", "height", "title"),
}


@dataclass(frozen=True)
class GcodeTemplate:
    """Lines that a plotter is told.

    Parameters
    ----------
    start, end : str
        Before and after all; may hold ``{width}`` and ``{height}`` in millimetres, and ``{title}``.
    layer : str
        Before each ink; may hold ``{layer}``, its name, ``{colour}`` and ``{dots}``, how many.
    move, down, up : str
        For each dot; may hold ``{x}``, ``{y}`` and the radius ``{r}`` in millimetres.
    y_up : bool
        y is counted up from the lower border, as machines do, else down from the upper.

    Raises
    ------
    InputError
        If a line holds a field that it has not, or none tells where a dot is.
    """

    start: str = "; {title}\nG21 ; millimetres\nG90 ; absolute\nG0 Z5"
    layer: str = "; dots of {layer}: {dots}\nM0 ; put in the pen"
    move: str = "G0 X{x:.3f} Y{y:.3f}"
    down: str = "G1 Z0 F1000"
    up: str = "G0 Z2"
    end: str = "G0 Z5\nG0 X0 Y0\nM2"
    y_up: bool = True

    def __post_init__(self) -> None:
        for key, known in FIELDS.items():
            text = getattr(self, key)
            try:
                names = [name for _, name, _, _ in string.Formatter().parse(text) if name is not None]
                if unknown := [name for name in names if name not in known]:
                    can = ", ".join(f"{{{name}}}" for name in known)
                    raise InputError(f"{key} holds {{{unknown[0]}}}; it can hold {can}")
                sample = {name: "" if name in ("title", "layer", "colour") else 0 for name in known}
                text.format(**sample)
            except ValueError as error:
                if isinstance(error, InputError):
                    raise
                raise InputError(
                    f"{key} cannot be filled in: {error}; a brace itself is {{{{ or }}}}"
                ) from None
        told = {name for _, name, _, _ in string.Formatter().parse(self.move + self.down + self.up)}
        if not {"x", "y"} <= told:
            raise InputError("move and down hold no {x} or no {y}, so that dots would lie in one place")


def read_template(path: Path) -> GcodeTemplate:
    """Read a template.

    Parameters
    ----------
    path : Path
        TOML with any of the keys start, layer, move, down, up, end and y_up; the rest are the default's.

    Returns
    -------
    GcodeTemplate

    Raises
    ------
    FormatError
        If it is missing, cannot be read, is no TOML, or holds something else.
    """
    try:
        given = tomllib.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise FormatError(path, "there is no such file") from None
    except OSError as error:
        raise FormatError(path, f"cannot be read: {reason(error)}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise FormatError(path, f"is no TOML: {error}") from None
    kinds = {field.name: type(field.default) for field in dataclasses.fields(GcodeTemplate)}
    for key, value in given.items():
        if key not in kinds:
            raise FormatError(path, f"has {key!r}; a template has {', '.join(kinds)}")
        if not isinstance(value, kinds[key]):
            what = "true or false" if kinds[key] is bool else "a text"
            raise FormatError(path, f"{key} is {what}; got {value!r}")
    try:
        return GcodeTemplate(**given)
    except InputError as error:
        raise FormatError(path, str(error)) from None


def gcode(page: Page, template: GcodeTemplate) -> bytes:
    """Write a page as G-code.

    Parameters
    ----------
    page : Page
        The page.
    template : GcodeTemplate
        Its lines.

    Returns
    -------
    bytes
        UTF-8, ended by a newline.
    """
    whole = {"width": page.width, "height": page.height, "title": in_one_line(page.title)}
    lines = [template.start.format(**whole)]
    for layer in page.layers:
        named = {"layer": in_one_line(layer.name), "colour": layer.colour, "dots": len(layer.radii)}
        lines.append(template.layer.format(**named))
        for (x, y), r in zip(layer.centres.tolist(), layer.radii.tolist(), strict=True):
            dot = {"x": x, "y": page.height - y if template.y_up else y, "r": r}
            lines += [line.format(**dot) for line in (template.move, template.down, template.up)]
    lines.append(template.end.format(**whole))
    return ("\n".join(line.rstrip("\n") for line in lines) + "\n").encode()
