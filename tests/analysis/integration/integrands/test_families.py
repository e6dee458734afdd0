"""Every family: its protocol, and values that depend on nothing but the point."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from gbnbench.analysis.integration.integrands import kernel_values
from gbnbench.analysis.integration.integrands.protocol import Periodic
from gbnbench.analysis.integration.integrands.registry import FAMILIES, find
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.settings import specification
from gbnbench.core.torus import FloatArray
from tests.paths import DOCS

KINDS = ("oscillatory", "product-peak", "corner-peak", "gaussian", "continuous", "discontinuous")
TEXTS = (
    "gaussians", "gaussians[count=3,points=5000]", "half-space", "korobov",
    "korobov[smoothness=2,weight=0.5]", "waves", "ball", "ball[volume=0.05]",
    *(f"genz[kind={kind}]" for kind in KINDS),
)  # fmt: skip


def test_each_name_is_its_family() -> None:
    for name, family in FAMILIES.items():
        assert family.name == name
        assert family.summary
        assert specification(family()) == name


def test_the_page_has_every_family_with_its_settings() -> None:
    page = (DOCS / "integrands.md").read_text()
    for name, family in FAMILIES.items():
        row = next(line for line in page.splitlines() if line.startswith(f"| `{name}` |"))
        for field in dataclasses.fields(family):  # type: ignore[arg-type]
            default = "none" if field.default is None else str(field.default).removesuffix(".0")
            assert f"`{field.name}` ({default}" in row


@pytest.mark.parametrize("text", TEXTS)
def test_text_comes_back(text: str) -> None:
    family = find(text)
    assert find(specification(family)) == family
    assert specification(family) == text.replace("[kind=oscillatory]", "")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("gausians", r"no integrand .* 'gausians' \(did you mean 'gaussians'\?\); there are gaussians"),
        ("gaussians[", "an integrand must read name"),
        ("waves[reach=far]", "reach of waves must be a finite number; got 'far'"),
        ("korobov[smoothness=5]", "smoothness of korobov must be one of 2, 4, 6; got '5'"),
        ("genz[sort=gaussian]", "genz has no setting 'sort'"),
    ],
)  # fmt: skip
def test_wrong_texts_are_told(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        find(text)


@pytest.mark.parametrize(
    "text",
    [*TEXTS, "gaussians[count=5] by numpy", "gaussians[points=5000,count=3] by numpy", "waves by numpy"],
)
@pytest.mark.parametrize("d", [1, 2, 3, 7])
def test_values_are_bitwise_the_same_however_points_are_batched(
    text: str, d: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    if text.endswith(" by numpy"):
        monkeypatch.setattr(kernel_values, "double_device", lambda: None)
        text = text.removesuffix(" by numpy")
    family = find(text)
    one = family.draw(d, np.random.default_rng(3))
    x = np.random.default_rng(4).random((330, d))
    x[:5] = [[0.0] * d, [0.5] * d, [1 - 2.0**-53] * d, [2.0**-53] * d, [5e-324] * d]
    whole = one(x)
    assert whole.shape == (330,)
    assert whole.dtype == np.float64
    assert np.isfinite(whole).all()

    def alike(values: FloatArray) -> bool:
        return bool((values.view(np.uint64) == whole[: len(values)].view(np.uint64)).all())

    for size in (1, 7, 64, 129):
        assert alike(np.concatenate([one(x[k : k + size]) for k in range(0, min(330, 20 * size), size)]))
    assert alike(one(x.reshape(5, 66, d)).reshape(-1))
    assert alike(one(np.asfortranarray(x)))
    assert alike(one(np.repeat(x, 2, axis=0)[::2]))


@pytest.mark.parametrize("text", TEXTS)
def test_what_is_periodic_knows_its_energy(text: str) -> None:
    family = find(text)
    one = family.draw(2, np.random.default_rng(3))
    assert isinstance(one, Periodic) == family.periodic
    f = family.frequencies(2, 0.2)
    assert (len(f) > 0) == family.periodic
    assert f.dtype == np.int64
    if isinstance(one, Periodic):
        assert one.energy(f).shape == (len(f),)
        zero = one.energy(np.zeros((1, 2), dtype=np.int64))
        assert zero == pytest.approx([one.integral**2], rel=1e-12)


@pytest.mark.parametrize("text", ["gaussians", "korobov", "waves", "ball"])
@pytest.mark.parametrize("share", [0.0, 1.0, -0.1, float("nan")])
def test_shares_that_are_none_are_told(text: str, share: float) -> None:
    with pytest.raises(InputError, match=f"0 < share < 1; got {share}"):
        find(text).frequencies(2, share)
    with pytest.raises(RefusalError, match="d = 1 to 20; got d=0"):
        find(text).frequencies(0, 0.1)


@pytest.mark.parametrize("text", TEXTS)
def test_the_same_seed_draws_the_same(text: str) -> None:
    family = find(text)
    x = np.random.default_rng(0).random((50, 3))
    one, same, other = (family.draw(3, np.random.default_rng(seed))(x) for seed in (1, 1, 2))
    assert (one == same).all()
    assert (one != other).any()


@pytest.mark.parametrize("text", TEXTS)
@pytest.mark.parametrize("d", [0, 21])
def test_dimensions_out_of_range_are_refused(text: str, d: int) -> None:
    family = find(text)
    assert f"d = 1 to 20; got d={d}" in str(family.refusal(d))
    with pytest.raises(RefusalError, match="d = 1 to 20"):
        family.draw(d, np.random.default_rng(0))
    assert family.refusal(1) is None
    assert family.refusal(20) is None
