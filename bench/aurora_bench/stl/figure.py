# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The picture of `stl.md`: time over trace length, one panel per formula."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from aurora_bench.plotting import COLOURS, new_figure, save_figure
from aurora_bench.stl.cells import LENGTHS, Kind
from aurora_bench.stl.goals import goal_cell, seconds, shape
from aurora_bench.stl.speed import Measured
from aurora_bench.stl.tools import OURS, TOOLS

_PANELS = (Kind.ALWAYS, Kind.NESTED, Kind.UNTIL)
_MARKERS = 'osD^vP'


def draw(measured: Sequence[Measured], folder: Path) -> tuple[Path, Path]:
    """Write `stl.png` and `stl.svg`.

    Raises:
        ResultsError: A file cannot be written.
    """
    figure, panels = new_figure(14.0, 4.8, panels=len(_PANELS))
    for axes, kind in zip(panels, _PANELS, strict=True):
        for number, tool in enumerate(TOOLS):
            found = [(n, seconds(measured, tool, goal_cell(kind, n))) for n in LENGTHS]
            points = [(n, s * 1e3) for n, s in found if s is not None]
            if not points:
                continue
            axes.plot(
                [n for n, _ in points],
                [ms for _, ms in points],
                color=COLOURS[number % len(COLOURS)],
                linestyle='-' if number < len(COLOURS) else '--',
                linewidth=2.6 if tool == OURS else 1.2,
                marker=_MARKERS[number % len(_MARKERS)],
                markersize=4.5,
                label=tool,
            )
        axes.set_xscale('log')
        axes.set_yscale('log')
        axes.set_xlabel('samples')
        axes.set_title(f'{kind}: {shape(goal_cell(kind))}')
    panels[0].set_ylabel('milliseconds')
    handles, labels = panels[0].get_legend_handles_labels()
    for axes in panels[1:]:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            if label not in labels:
                handles.append(handle)
                labels.append(label)
    figure.legend(handles, labels, loc='outside right center', fontsize=8.5)
    return save_figure(figure, folder, 'stl')
