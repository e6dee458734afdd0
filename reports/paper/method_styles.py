"""Names and strokes of methods, the same in every figure of the paper."""

from __future__ import annotations

from gbnbench.reports import style
from gbnbench.reports.captions import shown

NAMES = {
    "random": "Random", "jittered": "Stratified", "sobol": "Owen-Sobol", "halton": "Halton", "lloyd": "CVT",
    "fpo": "FPO", "gbn": "GBN", "deep": "Deep", "stealthy": "Stealthy", "bnot": "BNOT", "kdm": "KDM",
    "vnc": "VnC", "bluenets": "BlueNets", "ccvt": "CCVT", "step": "Step", "staircase": "Staircase",
    "sliced": "Sliced OT",
}  # fmt: skip
# Methods of the paper whose sets a user may give, in place of our generator's where there is one.
GIVEN = ("bnot", "kdm", "vnc", "bluenets", "ccvt", "step", "staircase")
# Where a method's generator has another name, or as it was published other settings than its defaults.
GENERATOR_NAMES = {"vnc": "voidcluster", "step": "step[method=correlation]"}
_C, _D = style.COLOURS, style.DASHES
STROKES = {
    "gbn": style.Stroke(_C[0], _D[0]),
    "bnot": style.Stroke(_C[1], _D[0]),
    "fpo": style.Stroke(_C[2], _D[0]),
    "sobol": style.Stroke(_C[3], _D[0]),
    "vnc": style.Stroke(_C[4], _D[0]),
    "lloyd": style.Stroke(_C[5], _D[0]),
    "random": style.Stroke(_C[6], _D[0]),
    "jittered": style.Stroke(_C[7], _D[0]),
    "deep": style.Stroke(_C[1], _D[1]),
    "stealthy": style.Stroke(_C[2], _D[1]),
    "kdm": style.Stroke(_C[3], _D[1]),
    "step": style.Stroke(_C[4], _D[1]),
    "bluenets": style.Stroke(_C[5], _D[1]),
    "halton": style.Stroke(_C[6], _D[1]),
    "staircase": style.Stroke(_C[7], _D[1]),
    "ccvt": style.Stroke(_C[1], _D[2]),
    "sliced": style.Stroke(_C[2], _D[2]),
    "latin": style.Stroke(_C[3], _D[2]),
    "grid": style.Stroke(_C[6], _D[2]),
    "hexagonal": style.Stroke(_C[7], _D[2]),
}
VARIANT = {_D[0]: _D[1], _D[1]: _D[3], _D[2]: _D[3]}  # dash of a method with settings of its own


def title_of(label: str) -> str:
    """Return the name of a method for a figure, from a generator's text or from the name of user's sets."""
    name = label.partition("[")[0]
    return shown(NAMES.get(name, name), 14)


def stroke(label: str) -> style.Stroke:
    """Return the stroke of a method in every figure; a method with settings of its own has another dash.

    Examples
    --------
    >>> stroke("gbn") == stroke("gbn"), stroke("gbn").colour == stroke("gbn[sigma=0.8]").colour
    (True, True)
    >>> stroke("gbn") == stroke("gbn[sigma=0.8]")
    False
    """
    name, bracket, _ = label.partition("[")
    usual = STROKES.get(name, style.Stroke(style.FAINT, style.DASHES[3]))
    return style.Stroke(usual.colour, VARIANT.get(usual.dash, usual.dash)) if bracket else usual
