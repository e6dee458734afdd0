"""C headers, compiled as C99 and C++ without a warning: the numbers in them are numpy's, bit for bit."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from gbnbench.io.exports.c_header import c_header, c_name
from gbnbench.io.exports.number_types import rounded
from tests.compilers import built, said

PROGRAM = r"""
#include "{name}.h"
#include <stdio.h>
#include <string.h>
#include <{bits}>
int main(void) {{
    const size_t count = sizeof({array}) / sizeof({type});
    const {type} *flat = (const {type} *){array};
    size_t k;
    printf("%d %d\n", {upper}_N, {upper}_D);
    for (k = 0; k < count; ++k) {{
        unsigned char bytes[sizeof({type})];
        size_t b;
        memcpy(bytes, flat + k, sizeof bytes);
        for (b = 0; b < sizeof bytes; ++b) printf("%02x", (unsigned)bytes[b]);
    }}
    return 0;
}}
"""
HARD = np.array(
    [[0.0, 5e-324], [1e-300, 2**-30], [1 / 3, 1 - 2**-53], [0.1, 2**-126], [1e-45, 0.5], [0.3, 1 - 2**-24]]
)


def with_hard_numbers() -> np.ndarray:
    x = np.random.default_rng(8).random((3, 50, 2))
    x[0, : len(HARD)] = HARD
    return x


@pytest.mark.parametrize("standard", ["c99", "c++11"])
@pytest.mark.parametrize("number_type", ["float32", "float64", "uint32"])
def test_the_compiled_numbers_are_the_same_bits(number_type, standard, tmp_path: Path):
    values = rounded(with_hard_numbers(), number_type)
    name = c_name("my sets 2")
    comments = ["hostile */ comment /* with ??/ and a line\nbreak \\", "Schlömer"]
    text = c_header(name, "points", values, {"count": 3, "n": 50, "d": 2}, comments)
    (tmp_path / f"{name}.h").write_bytes(text)
    source = tmp_path / ("main.c" if standard == "c99" else "main.cpp")
    kind = {"float32": "float", "float64": "double", "uint32": "uint32_t"}[number_type]
    source.write_text(
        PROGRAM.format(name=name, array=f"{name}_points", type=kind, upper=name.upper(), bits="stdint.h")
    )
    counts, numbers = said(built(source, standard, tmp_path)).stdout.splitlines()
    assert counts == "50 2"
    assert bytes.fromhex(numbers) == values.tobytes()


def test_a_header_can_be_included_twice_and_from_two_files(tmp_path: Path):
    values = np.arange(6, dtype=np.uint16).reshape(2, 3)
    (tmp_path / "mask.h").write_bytes(c_header("mask", "ranks", values, {"rows": 2}, ["a mask"]))
    source = tmp_path / "twice.c"
    source.write_text(
        '#include "mask.h"\n#include "mask.h"\nint main(void) { return mask_ranks[1][2] == 5 ? 0 : 1; }\n'
    )
    said(built(source, "c99", tmp_path))


def test_long_rows_are_folded_and_whole():
    values = np.arange(60, dtype=np.uint32).reshape(2, 30)
    text = c_header("wide", "ranks", values, {}, []).decode()
    body = text.split("= {")[1].split("};")[0]
    assert [
        int(word.strip("u")) for word in body.replace("{", "").replace("}", "").split(",") if word.strip()
    ] == [*range(60)]
    assert max(map(len, text.splitlines())) < 80


@pytest.mark.parametrize(
    ("stem", "name"), [("double", "double"), ("9-lives", "set_9_lives"), ("__x__y", "x_y"), ("é", "set")]
)
def test_names_are_those_of_c(stem, name):
    assert c_name(stem) == name
