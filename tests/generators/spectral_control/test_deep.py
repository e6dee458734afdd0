"""Deep blue noise keeps its bars: a floor past the paper's at less order, on an exponential profile."""

from __future__ import annotations

import math

import numpy as np
import pytest

import gbnbench
from gbnbench.core.errors import FormatError, InputError, RefusalError
from gbnbench.core.settings import specification
from gbnbench.generators.gauss_newton.modes import edge_binding
from gbnbench.generators.gauss_newton.solver import AmplitudeSolution
from gbnbench.generators.gbn.generator import GaussianBlueNoise
from gbnbench.generators.protocol import realization_rng
from gbnbench.generators.registry import find, generate
from gbnbench.generators.spectral_control.deep import BOUND, Deep
from gbnbench.generators.spectral_control.target_profiles import Exponential, Table
from tests.oracles.power import direct_power, half_space


def shells(x, edge):
    """Nu and mean power of the exact shells below the edge, by the definition."""
    n, d = x.shape
    f = half_space(math.ceil(edge * n ** (1 / d)), d)
    f = f[np.sum(f**2, axis=1) < edge**2 * n ** (2 / d)]
    square = np.sum(f**2, axis=1)
    power = direct_power(x, f)
    levels = np.unique(square)
    return np.sqrt(levels) * n ** (-1 / d), np.array([power[square == level].mean() for level in levels])


@pytest.fixture(scope="module")
def sets():
    return generate("deep", n=1024, realizations=4, seed=1)


@pytest.fixture(scope="module")
def measured(sets):
    return gbnbench.measures(sets)


class TestPlane:
    """The bars of the method, from four sets; the paper's 10,000 steps have 6.6e-10, .603, .426, 2.22."""

    def test_floor_and_order(self, measured):
        assert measured["noise_floor"] < 1e-19
        assert measured["valence6"] < 0.60
        assert measured["psi6"] < 0.43
        assert measured["peak"] < 2.2
        assert measured["profile_c"] == pytest.approx(10 * math.pi**2, rel=0.01)

    def test_profile_is_the_target(self, sets):
        radial = gbnbench.radial(gbnbench.periodogram(sets, 23))
        band = (radial.nu >= 0.05) & (radial.nu <= 0.65)
        target = Exponential(10 * math.pi**2, 0.72)(radial.nu[band])
        share = radial.power[band] / target
        # Mean over 4 sets of shells with about 4 free amplitudes: spread 1/4, about 1.1 dB.
        assert np.average(share, weights=radial.count[band]) == pytest.approx(1, abs=0.05)
        assert np.sqrt(np.mean((10 * np.log10(share)) ** 2)) < 1.5

    def test_power_is_as_scattered_as_noise_around_each_ring(self, measured):
        assert measured["anisotropy_db"] == pytest.approx(-10 * math.log10(4), abs=1)


@pytest.mark.parametrize(("n", "d"), [(200, 1), (50, 2), (100, 3), (150, 4), (100, 5), (150, 8)])
def test_every_dimension_follows_its_profile_down_to_rounding(n, d):
    generator = Deep()
    x = generator(n, d, realization_rng(2, 0))
    target, edge = generator.profile(d)
    nu, power = shells(x, edge)
    assert len(nu) > 1
    level = np.maximum(target(nu), 1e-28)
    assert (power < 20 * level).all()
    assert np.median(power / level) > 0.05 or (target(nu) < 1e-28).all()


def test_the_default_edge_binds_one_share_in_every_dimension():
    assert edge_binding(BOUND, 2) == pytest.approx(0.72, rel=1e-12)
    for d in range(1, 9):
        ball = math.pi ** (d / 2) / math.gamma(d / 2 + 1)
        assert ball * edge_binding(BOUND, d) ** d / d == pytest.approx(math.pi * 0.72**2 / 2, rel=1e-12)


def test_the_default_steepness_has_one_depth_in_every_dimension():
    assert Deep().profile(2)[0](np.array([0.72 / math.sqrt(2)])) == pytest.approx(
        math.exp(-(10 * math.pi**2) * 0.72**2 / 2)
    )
    for d in range(1, 9):
        assert Deep().profile(d)[0](np.zeros(1)) == pytest.approx(6.03e-23, rel=0.01)
    assert Deep(edge=0.6).profile(2)[0](np.zeros(1)) == pytest.approx(6.03e-23, rel=0.01)


def test_steepness_and_edge_are_settings():
    x = generate("deep[c=40,edge=0.6]", n=400)
    nu, power = shells(x, 0.6)
    assert np.average(power / np.exp(-40 * (0.36 - nu**2))) == pytest.approx(1, abs=0.25)


class TestTarget:
    ROWS = ((0.0, 1e-12), (0.3, 1e-12), (0.6, 1e-3))

    def expected(self, nu):
        return 10 ** np.where(nu < 0.3, -12, -12 + 9 * (nu - 0.3) / 0.3)

    @pytest.mark.parametrize("head", ["", "nu,power\n", "frequency, nu ,Power,count\n"])
    def test_a_file(self, tmp_path, head):
        path = tmp_path / "target.csv"
        rows = [f"9,{nu},{power},8" if "count" in head else f"{nu},{power}" for nu, power in self.ROWS]
        path.write_text(head + "\n".join(rows) + "\n\n")
        generator = find(f"deep[target={path}]")
        assert specification(generator) == f"deep[target={path}]"
        self.check(generator(400, 2, realization_rng(0, 0)))

    def test_rows_and_a_function_are_the_same_target(self):
        rows = generate("deep", n=400, target=np.array(self.ROWS))
        self.check(rows)
        assert np.array_equal(rows, Deep(target=Table.of(self.ROWS))(400, 2, realization_rng(0, 0)))
        function = generate("deep", n=400, target=self.expected, edge=0.6)
        assert np.abs(function - rows).max() < 1e-9
        assert hash(find("deep", target=np.array(self.ROWS))) == hash(Deep(target=Table.of(self.ROWS)))

    def check(self, x):
        nu, power = shells(x, 0.6)
        share = power / self.expected(nu)
        assert share.mean() == pytest.approx(1, abs=0.25)
        assert share.max() < 10

    def test_a_smaller_edge_leaves_the_rest_of_the_table(self):
        assert Deep(target=Table.of(self.ROWS), edge=0.5).profile(2)[1] == 0.5
        assert Deep(target=Table.of(self.ROWS)).profile(2)[1] == 0.6

    @pytest.mark.parametrize(
        ("text", "says"),
        [
            ("0,1e-9\n0.5,-1\n", "line 2: the power of a target must be positive and finite; got -1.0"),
            ("0,1e-9\n0.5,nan\n", "power of a target must be positive"),
            ("0.5,1\n0.2,1\n", "line 2: the nu of a target must be >= 0 and rise; got 0.2"),
            ("0,1\n", "two rows of nu and power or more; got 1"),
            ("", "two rows of nu and power or more; got 0"),
            ("0,1\n0.2,much\n", "line 2: a target needs a number for nu and one for power; got '0.2,much'"),
            ("0,1\n0.2\n", "line 2: a target needs a number"),
        ],
    )
    def test_a_bad_file_is_named_with_its_fault(self, tmp_path, text, says):
        path = tmp_path / "bad.csv"
        path.write_text(text)
        with pytest.raises(FormatError, match=says) as caught:
            Deep(target=str(path))
        assert "bad.csv" in str(caught.value)

    def test_a_missing_file_is_named(self):
        with pytest.raises(FormatError, match=r"nowhere\.csv: a target cannot be read"):
            find("deep[target=nowhere.csv]")


@pytest.mark.parametrize(
    ("settings", "says"),
    [
        ({"c": 0.0}, "c must be above 0 and finite"),
        ({"c": math.inf}, "c must be above 0 and finite"),
        ({"edge": 0.0}, r"edge must lie in \[1e-09, 1e\+09\]"),
        ({"gradients": -1}, r"gradients must lie in \[0, 1000000\]"),
        ({"target": 3.0}, r"a target must be \(k, 2\) numbers"),
        (
            {"target": ((0.0, 1e-9), (0.5, 1.0)), "edge": 0.6},
            "edge must be at most the last nu of the target",
        ),
    ],
)
def test_settings_out_of_range_are_refused(settings, says):
    with pytest.raises(InputError, match=says):
        Deep(**settings)


def test_a_function_that_is_no_power_is_refused():
    with pytest.raises(InputError, match="target must be finite and >= 0 below the edge"):
        generate("deep", n=100, target=lambda nu: nu - 0.5)


class TestRefusals:
    def test_more_numbers_bound_than_there_are_coordinates(self):
        with pytest.raises(RefusalError, match="binds 2600 of the 2048 coordinates of n=1024 points in d=2"):
            generate("deep[edge=0.9]", n=1024)

    def test_more_work_than_can_be_done(self):
        assert "too much work" in str(Deep().refusal(2**31, 2))
        assert Deep().refusal(10**6, 2) is None

    def test_a_start_that_fails_is_drawn_longer_and_then_refused(self, monkeypatch):
        asked = []

        def never(x, target, edge, **_):
            return AmplitudeSolution(x, 7.0, 3, 9, False, "it was not to be")

        class Counted(GaussianBlueNoise):
            def draw(self, n, d, rngs, monitor):
                asked.append(self.gradients)
                return super().draw(n, d, rngs, monitor)

        monkeypatch.setattr("gbnbench.generators.spectral_control.deep.solve_for_amplitudes", never)
        monkeypatch.setattr("gbnbench.generators.spectral_control.deep.GaussianBlueNoise", Counted)
        with pytest.raises(
            RefusalError, match=r"n=64 points in d=2 do not reach .* not to be; lower the edge"
        ):
            Deep()(64, 2, realization_rng(0, 0))
        assert asked == [200, 600, 2000]


def test_sets_are_the_same_drawn_alone_or_together_and_say_how_far_they_are():
    from gbnbench.generators.monitor import Monitor, Trace
    from gbnbench.generators.registry import generate

    told, trace = [], Trace()
    monitor = Monitor(progress=lambda done, total, doing: told.append((done, total, doing)), trace=trace)
    together = generate("deep", n=100, seed=4, realizations=3, monitor=monitor)
    assert np.array_equal(together[0], generate("deep", n=100, seed=4))
    counts = [done for done, _, _ in told]
    assert counts == sorted(counts)
    assert counts[-1] < told[-1][1]
    assert "deep, set 3" in told[-1][2]
    assert trace.to_frame().gradient.max() == 200


def test_a_start_goes_on_from_its_checkpoint(tmp_path):
    from gbnbench.generators.monitor import Monitor
    from gbnbench.generators.registry import generate

    kept = Monitor(checkpoint=tmp_path / "state", seconds=0)
    once = generate("deep", n=100, seed=4, realizations=2, monitor=kept)
    counted = []
    again = Monitor(progress=lambda *told: counted.append(told), checkpoint=tmp_path / "state", seconds=0)
    assert np.array_equal(once, generate("deep", n=100, seed=4, realizations=2, monitor=again))
    assert all("deep" in doing for _, _, doing in counted)  # the descent was done
