# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Figures of the benchmarks: one look, without a display, as PNG and SVG."""

from __future__ import annotations

from collections.abc import Sequence
from io import BytesIO
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from aurora_bench.results import write_whole

# Told apart also by colour-blind readers (after Okabe and Ito), in the order of use.
COLOURS = ('#0072B2', '#D55E00', '#009E73', '#CC79A7', '#E69F00', '#56B4E9', '#F0E442', '#7F7F7F')
_DPI = 150
_FONT_SIZE = 10.0
# Equal figures give equal files: no date, no random ids.
_SETTINGS: Any = {
    'svg.hashsalt': 'aurora',
    'svg.fonttype': 'none',
    'font.size': _FONT_SIZE,
    'axes.spines.top': False,
    'axes.spines.right': False,
    'axes.grid': True,
    'grid.color': '#dddddd',
    'axes.axisbelow': True,
    'legend.frameon': False,
}
_METADATA: dict[str, dict[str, Any]] = {
    'svg': {'Date': None},
    'png': {'Software': None},
    'pdf': {'CreationDate': None},
}


def new_figure(
    width_in: float,
    height_in: float,
    panels: int = 1,
    *,
    rows: int = 1,
    font_size: float = _FONT_SIZE,
) -> tuple[Figure, list[Axes]]:
    """Return a figure with its panels, row by row.

    Args:
        width_in: Inches.
        height_in: Inches.
        panels: How many side by side.
        rows: How many rows of them.
        font_size: Points.
    """
    with mpl.rc_context({**_SETTINGS, 'font.size': font_size}):
        figure = Figure(figsize=(width_in, height_in), layout='constrained')
        FigureCanvasAgg(figure)
        axes = figure.subplots(rows, panels, squeeze=False)
    return figure, list(axes.flat)


def save_figure(figure: Figure, folder: Path, name: str) -> tuple[Path, Path]:
    """Write `<name>.png` and `<name>.svg`, each whole.

    Returns:
        Their paths.

    Raises:
        ResultsError: A file cannot be written.
    """
    png, svg = save_as(figure, folder, name, ('png', 'svg'))
    return png, svg


def save_as(figure: Figure, folder: Path, name: str, kinds: Sequence[str]) -> tuple[Path, ...]:
    """Write a figure in some of the forms `pdf`, `png` and `svg`, each whole.

    Returns:
        Their paths, in the order of the forms.

    Raises:
        ResultsError: A file cannot be written.
    """
    paths = []
    for kind in kinds:
        buffer = BytesIO()
        with mpl.rc_context(_SETTINGS):
            figure.savefig(buffer, format=kind, dpi=_DPI, metadata=_METADATA[kind])
        paths.append(folder / f'{name}.{kind}')
        write_whole(paths[-1], buffer.getvalue())
    return tuple(paths)
