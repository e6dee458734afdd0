"""Axes that make their ticks when these are drawn: matplotlib's own make four of them for every picture."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.axis import Axis, Tick, XAxis, YAxis


class _TicksOnDemand(Axis):
    """Of an axis: without ticks until it is drawn; settings of ticks are kept for those that come."""

    def reset_ticks(self) -> None:
        """Forget the ticks."""
        self.majorTicks, self.minorTicks = [], []  # pyright: ignore[reportAttributeAccessIssue]

    def _get_ticks_position(self) -> int | str:
        """Tell on which sides the ticks are, from the first of each kind."""
        self.get_major_ticks(1)
        self.get_minor_ticks(1)
        return super()._get_ticks_position()  # type: ignore[misc, no-any-return]

    def _get_tick(self, major: bool) -> Tick:
        """Make a tick whose grid line ends at the frame."""
        tick: Tick = super()._get_tick(major)  # type: ignore[misc]  # of XAxis or YAxis
        tick.set_clip_path(self.axes.patch)
        return tick

    def _copy_tick_props(self, src: Tick, dest: Tick) -> None:
        """Leave a new tick as it is: it was made with the settings of all."""


class _X(_TicksOnDemand, XAxis):
    pass


class _Y(_TicksOnDemand, YAxis):
    pass


class PlotAxes(Axes):
    """Axes for figures of many panels, of which most show no ticks."""

    def _init_axis(self) -> None:
        """Make the two axes, as a projection of matplotlib's may."""
        self.xaxis, self.yaxis = _X(self, clear=False), _Y(self, clear=False)
        for spine in ("bottom", "top"):
            self.spines[spine].register_axis(self.xaxis)
        for spine in ("left", "right"):
            self.spines[spine].register_axis(self.yaxis)

    def clear(self) -> None:
        """Empty the axes; their frame is put in its place, as the first tick would."""
        super().clear()
        for spine in self.spines.values():
            spine.get_spine_transform()
