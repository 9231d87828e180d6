# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The figure: real-time factor over agents, and a tick's CPU time by part and process."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.patches import Patch

from aurora_bench.lockstep.figures import Engine, Measured
from aurora_bench.lockstep.goals import SPEED_GOALS
from aurora_bench.lockstep.summary import shown_parts
from aurora_bench.plotting import COLOURS, new_figure, save_figure

_ENGINE_COLOURS: dict[Engine, str] = {'local': COLOURS[0], 'ros': COLOURS[1]}
_ENGINE_NAMES: dict[Engine, str] = {'local': 'local engine', 'ros': 'ROS graph'}
_STYLES = ('-', '--', ':', '-.')
# What does the same thing in both engines has one colour.
_PARTS = {
    'sumo': ('SUMO', COLOURS[2]),
    'sumo_bridge': ('SUMO', COLOURS[2]),
    'air': ('UAV link and simulator', COLOURS[0]),
    'uav_bridge': ('UAV bridge', COLOURS[5]),
    'uav_sim': ('UAV link and simulator', COLOURS[0]),
    'executor': ('executor', COLOURS[1]),
    'recorder': ('recorder', COLOURS[4]),
    'sync': ('sync', COLOURS[3]),
    'monitor': ('monitor', COLOURS[6]),
    'others': ('idle nodes', COLOURS[7]),
}
_BAR = 0.38


def draw(measured: Sequence[Measured], folder: Path) -> tuple[Path, Path]:
    """Write `lockstep.png` and `lockstep.svg`.

    Raises:
        ResultsError: A file cannot be written.
    """
    figure, (left, right) = new_figure(12.5, 4.8, panels=2)
    one_uav = [each for each in measured if each.uavs == 1]
    _draw_speed(left, one_uav)
    _draw_shares(right, one_uav)
    return save_figure(figure, folder, 'lockstep')


def _draw_speed(axes: Axes, measured: Sequence[Measured]) -> None:
    lengths = sorted({each.seconds for each in measured})
    for engine in dict.fromkeys(each.engine for each in measured):
        for style, seconds in zip(_STYLES, lengths, strict=False):
            line = sorted(
                (each for each in measured if (each.engine, each.seconds) == (engine, seconds)),
                key=lambda each: each.agents,
            )
            factors = [each.real_time_factor for each in line]
            axes.errorbar(
                [each.agents for each in line],
                [factor.median for factor in factors],
                yerr=(
                    [factor.median - factor.low for factor in factors],
                    [factor.high - factor.median for factor in factors],
                ),
                color=_ENGINE_COLOURS[engine],
                linestyle=style,
                marker='o',
                markersize=4.5,
                capsize=3.0,
                label=f'{_ENGINE_NAMES[engine]}, {seconds} s',
            )
    agents = sorted({each.agents for each in measured})
    for engine, at, least in SPEED_GOALS:
        axes.plot(
            [at * 0.8, at * 1.25], [least, least], color=_ENGINE_COLOURS[engine], linewidth=3
        )
        axes.annotate(
            f'goal {least:g}',
            (at * 1.3, least),
            color=_ENGINE_COLOURS[engine],
            fontsize=8.5,
            verticalalignment='center',
        )
    axes.set_xscale('log')
    axes.set_yscale('log')
    axes.set_xticks(agents, [str(n) for n in agents])
    axes.minorticks_off()
    ticks = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000]
    axes.set_yticks(ticks, [str(n) for n in ticks])
    shown = [each.real_time_factor for each in measured]
    low = min([*(factor.low for factor in shown), 25.0])
    high = max([*(factor.high for factor in shown), 300.0])
    axes.set_ylim(low / 1.3, high * 2.5)
    axes.set_xlabel('ground agents (1 UAV)')
    axes.set_ylabel('simulated seconds per wall second')
    axes.set_title('Speed of the tick loop (median, least, greatest)')
    axes.set_xlim(agents[0] / 1.4, max(agents[-1], SPEED_GOALS[1][1]) * 2.2)
    axes.legend(loc='upper right', frameon=False, fontsize=8.5)


def _draw_shares(axes: Axes, measured: Sequence[Measured]) -> None:
    shortest = min(each.seconds for each in measured)
    shown = [each for each in measured if each.seconds == shortest]
    agents = sorted({each.agents for each in shown})
    engines = list(dict.fromkeys(each.engine for each in shown))
    used: dict[str, str] = {}
    for each in shown:
        side = (engines.index(each.engine) - (len(engines) - 1) / 2.0) * (_BAR + 0.04)
        x, bottom = agents.index(each.agents) + side, 0.0
        for name, us in shown_parts(each).items():
            label, colour = _PARTS.get(name, (name, COLOURS[7]))
            used.setdefault(label, colour)
            axes.bar(x, us, _BAR, bottom=bottom, color=colour, edgecolor='white', linewidth=0.4)
            bottom += us
        axes.annotate(
            {'local': 'local', 'ros': 'ROS'}[each.engine],
            (x, bottom),
            xytext=(0, 3),
            textcoords='offset points',
            horizontalalignment='center',
            fontsize=8.5,
        )
    axes.set_xticks(range(len(agents)), [str(n) for n in agents])
    axes.set_xlabel('ground agents (1 UAV)')
    axes.set_ylabel('CPU time of a tick, microseconds')
    axes.set_title(f'Where the time of a tick goes ({shortest} s runs)')
    handles = [Patch(color=colour, label=label) for label, colour in used.items()]
    beside = (1.01, 1.0)  # right of the axes: the bars need all of them
    axes.legend(
        handles=handles[::-1], loc='upper left', bbox_to_anchor=beside, frameon=False, fontsize=8.5
    )
