# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The figures of the paper that runs of one campaign can give, each with its caption."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from statistics import fmean, median
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from aurora_bench.campaign.executed import EPISODE, episode_of, measured_of
from aurora_bench.campaign.metrics import (
    NOTHING,
    REPAIRED,
    TRIED,
    anchors_by_outcome,
    by_category,
    groups,
    repair_outcomes,
    share,
)
from aurora_bench.campaign.paper import TABLE
from aurora_bench.campaign.plan import TYPED, Configuration
from aurora_bench.campaign.record import CampaignRun, Ending
from aurora_bench.campaign.tables import ANCHOR_TERMS, once
from aurora_bench.plotting import COLOURS, new_figure, save_as
from aurora_core.report.share import Share

Runs = Sequence[CampaignRun]
_FONT = 7.5
_WIDTH_IN = 7.2
_PAPER = '#999999'
_HUES = dict(zip(TYPED, (COLOURS[7], COLOURS[0], COLOURS[1]), strict=True))
_STAGES = ('parse', 'check', 'ground', 'execute', 'verify', 'repair')


class Drawn(NamedTuple):
    """A figure that was written.

    Attributes:
        name: Of its files.
        caption: One paragraph.
        paths: PDF, SVG and PNG.
    """

    name: str
    caption: str
    paths: tuple[Path, ...]


def draw_all(runs: Runs, folder: Path) -> tuple[Drawn, ...]:
    """Write every figure.

    Args:
        runs: Of a campaign.
        folder: Where to.

    Raises:
        ResultsError: A file cannot be written.
    """
    figures: Mapping[str, tuple[Callable[[Runs], Figure], str]] = {
        'ladder': (
            _ladder,
            '(a) Completion of programs (B1 to B3) and (b) verified passes by configuration, '
            'with 95 % Wilson intervals; grey: the five models of the paper, in other simulators.',
        ),
        'overview': (
            _overview,
            '(a) What became of runs that did not hold at first, under AURORA. (b) Completion and '
            'passes of the first realisation by category. (c) Passes that repair adds.',
        ),
        'grounding': (
            _grounding,
            '(a) Distance between grounded and recorded place at t = 0, all bodies. (b) The '
            'same by agent type (median and greatest). (c) Means of the anchor score and its '
            'terms by outcome under B4. (d) to (f) Least margin of conditions on capture [s], '
            'tracking (share) and waypoints (number), one point a run, with the median; it holds '
            'from zero on.',
        ),
        'coordination': (
            _coordination,
            'Execution and missions by reader, boxes from quartile to quartile: (a) recorded to '
            'recomputed moment of events, (b) distance from the grounded place at t = 0, (c) time '
            'from ready to capture, (d) share of time on target while tracking, (e) greatest '
            'distance off the way between waypoints, (f) latency of delivered messages. The '
            'clock offset between the simulators is zero by construction (lockstep).',
        ),
        'cost': (
            _cost,
            '(a) Wall seconds by stage (median, quartiles) of AURORA. (b) Repair episodes: wall '
            'seconds after the first verdict by part, and of whole episodes. (c) Whole runs under '
            'AURORA by the number of co-simulations. A busy machine shows.',
        ),
    }
    found = []
    typed = [r for r in runs if not r.configuration.writes_program]
    for name, (draw, caption) in figures.items():
        # Programs have no grounding, no conditions and no repair: one figure shows them.
        shown = runs if name == 'ladder' else typed
        if not shown:
            continue
        paths = save_as(draw(shown), folder, name, ('pdf', 'svg', 'png'))
        found.append(Drawn(name, caption, paths))
    return tuple(found)


def _ladder(runs: Runs) -> Figure:
    figure, (left, right) = new_figure(_WIDTH_IN, 2.4, panels=2, font_size=_FONT)
    programs = [c for c in Configuration if c.writes_program]
    _rungs(left, runs, programs, 0, lambda r: r.ending is Ending.COMPLETED)
    _rungs(right, runs, TYPED, 2, lambda r: r.passed)
    left.set_title('(a)', loc='left')
    left.set_ylabel('share of programs that complete')
    right.set_title('(b)', loc='left')
    right.set_ylabel('share of runs that pass')
    return figure


def _rungs(
    ax: Axes,
    runs: Runs,
    configurations: Sequence[Configuration],
    column: int,
    of: Callable[[CampaignRun], bool],
) -> None:
    """Draw a share by configuration beside a column of the paper's table."""
    found = groups(runs)
    readers = [
        r for r in dict.fromkeys(r.reader for r in runs)
        if any((r, c) in found for c in configurations)
    ]  # fmt: skip
    width = 0.8 / max(1, len(readers))
    for n, reader in enumerate(readers):
        shares = [share(found.get((reader, c), ()), of) for c in configurations]
        places = [k - 0.4 + width * (n + 0.5) for k in range(len(configurations))]
        _bars(ax, places, shares, width, COLOURS[n % len(COLOURS)], reader)
    for k, configuration in enumerate(configurations):
        values = [v for row in TABLE[configuration.value] if (v := row[column]) is not None]
        ax.scatter(
            [k] * len(values), values, s=14, marker='D', color=_PAPER, zorder=3,
            label="the paper's models" if k == 0 else None,
        )  # fmt: skip
    ax.set_xticks(range(len(configurations)), [c.value for c in configurations])
    ax.set_ylim(0.0, 1.05)
    ax.legend(loc='lower right', fontsize=_FONT - 1)


def _coordination(runs: Runs) -> Figure:
    figure, axes = new_figure(_WIDTH_IN, 3.6, panels=3, rows=2, font_size=_FONT)
    some = [r for r in runs if r.configuration is Configuration.AURORA]
    readers = list(dict.fromkeys(r.reader for r in some))
    whose = {reader: [r for r in some if r.reader == reader] for reader in readers}
    found = {reader: measured_of(part) for reader, part in whose.items()}
    flown = {k: [m for one in v for m in one.missions] for k, v in found.items()}
    panels: tuple[tuple[str, Mapping[str, Sequence[float]]], ...] = (
        ('event moment [s]', {k: [abs(v) for m in ms for v in m.event_s]
                              for k, ms in found.items()}),
        ('placement [m]', {k: [v for r in part for values in r.placed_m.values() for v in values]
                           for k, part in whose.items()}),
        ('capture [s]', {k: [m.capture_s for m in ms if m.capture_s is not None]
                         for k, ms in flown.items()}),
        ('time on target (share)', {k: [m.on_target for m in ms if m.on_target is not None]
                                    for k, ms in flown.items()}),
        ('off the route [m]', {
            k: [m.off_most_m for m in ms if m.mode == 'navigate' and m.off_most_m is not None]
            for k, ms in flown.items()
        }),
        ('message latency [s]', {k: [v for m in ms for v in m.latency_s]
                                 for k, ms in found.items()}),
    )  # fmt: skip
    for ax, letter, (name, values) in zip(axes, 'abcdef', panels, strict=True):
        kept = {k: v for k, v in values.items() if v}
        if kept:
            labels = [f'{k} ({len(v)})' for k, v in kept.items()]
            ax.boxplot(list(kept.values()), tick_labels=labels, flierprops={'markersize': 2})
        ax.set_ylabel(name)
        ax.set_title(f'({letter})', loc='left')
    return figure


def _overview(runs: Runs) -> Figure:
    figure, (left, middle, right) = new_figure(_WIDTH_IN, 2.8, panels=3, font_size=_FONT)
    repaired = [r for r in runs if r.configuration is Configuration.AURORA]
    counts = repair_outcomes(repaired)
    words = (REPAIRED, TRIED, NOTHING)
    left.barh(range(3), [counts[w] for w in words], color=COLOURS[:3])
    left.set_yticks(
        range(3), [w.replace(', ', ',\n').replace(' simulated', '\nsimulated') for w in words]
    )
    left.invert_yaxis()
    left.set_xlabel('runs')
    left.set_title('(a)', loc='left')
    parts = by_category(repaired)
    names = list(parts)
    rows = range(len(names))
    completed = [share(parts[n], lambda r: r.ending is Ending.COMPLETED).value for n in names]
    first = [share(parts[n], _passed_at_first).value for n in names]
    middle.barh([k - 0.2 for k in rows], completed, 0.4, color=COLOURS[5], label='completed')
    middle.barh([k + 0.2 for k in rows], first, 0.4, color=COLOURS[0], label='passes at first')
    last = [share(parts[n], lambda r: r.passed).value for n in names]
    right.barh(rows, first, 0.6, color=COLOURS[0], label='at first')
    gained = [max(0.0, b - a) for a, b in zip(first, last, strict=True)]
    right.barh(rows, gained, 0.6, left=first, color=COLOURS[2], label='by repair')
    for ax, title in ((middle, '(b)'), (right, '(c)')):
        ax.set_yticks(rows, [f'{n.replace("_", " ")} ({len(parts[n])})' for n in names])
        ax.invert_yaxis()
        ax.set_xlim(0.0, 1.0)
        ax.set_xlabel('share of runs')
        ax.set_title(title, loc='left')
        ax.legend(loc='upper center', bbox_to_anchor=(0.4, -0.2), ncols=2, fontsize=_FONT - 1)
    return figure


def _grounding(runs: Runs) -> Figure:
    figure, axes = new_figure(_WIDTH_IN, 4.2, panels=3, rows=2, font_size=_FONT)
    by_type: dict[str, list[float]] = {}
    for run in once(runs):
        for name, values in run.placed_m.items():
            by_type.setdefault(name, []).extend(values)
    every = sorted(v for values in by_type.values() for v in values)
    axes[0].plot(every, [(k + 1) / len(every) for k in range(len(every))], color=COLOURS[0])
    axes[0].set_xlabel('distance at t = 0 [m]')
    axes[0].set_ylabel('share of bodies')
    names = sorted(by_type)
    rows = range(len(names))
    axes[1].barh(rows, [max(by_type[n]) for n in names], 0.6, color=COLOURS[5], label='greatest')
    axes[1].barh(rows, [median(by_type[n]) for n in names], 0.6, color=COLOURS[0], label='median')
    axes[1].set_yticks(rows, [f'{n} ({len(by_type[n])})' for n in names])
    axes[1].set_xlabel('distance at t = 0 [m]')
    axes[1].legend(fontsize=_FONT - 1)
    _anchors(axes[2], runs)
    for ax, name in zip(axes[3:], ('capture', 'tracked', 'waypoints'), strict=True):
        _margins(ax, runs, name)
    for ax, letter in zip(axes, 'abcdef', strict=True):
        ax.set_title(f'({letter})', loc='left')
    return figure


def _anchors(ax: Axes, runs: Runs) -> None:
    outcomes = anchors_by_outcome([r for r in runs if r.configuration is Configuration.B4])
    for n, (word, some) in enumerate(outcomes.items()):
        scores = [r.anchor for r in some if r.anchor is not None]
        if scores:
            values = [fmean(getattr(s, name) for s in scores) for name in ANCHOR_TERMS]
            places = [k - 0.2 + 0.4 * n for k in range(len(values))]
            ax.bar(places, values, 0.4, color=COLOURS[n], label=f'{word} ({len(scores)})')
    ax.set_xticks(range(len(ANCHOR_TERMS)), ANCHOR_TERMS)
    ax.set_ylim(0.0, 1.5)
    ax.set_ylabel('mean score')
    if ax.containers:
        ax.legend(fontsize=_FONT - 1, loc='upper left')


def _margins(ax: Axes, runs: Runs, name: str) -> None:
    found = groups(runs)
    ticks = []
    for k, ((_, configuration), part) in enumerate(found.items()):
        values = sorted(r.margins[name] for r in part if name in r.margins)
        spread = [k + 0.5 * (i / max(1, len(values) - 1) - 0.5) for i in range(len(values))]
        ax.scatter(spread, values, s=6, color=_HUES[configuration])
        if values:
            ax.plot([k - 0.35, k + 0.35], [median(values)] * 2, color='black', linewidth=1.0)
        ticks.append(f'{configuration.value}\n({len(values)})')
    ax.axhline(0.0, color='black', linewidth=0.6)
    ax.set_xticks(range(len(ticks)), ticks)
    ax.set_ylabel(f'margin of {name}')


def _cost(runs: Runs) -> Figure:
    figure, (left, middle, right) = new_figure(_WIDTH_IN, 2.4, panels=3, font_size=_FONT)
    some = [r for r in runs if r.configuration is Configuration.AURORA]
    stages = {s: [r.seconds[s] for r in some if s in r.seconds] for s in _STAGES}
    episodes = [episode for r in some if (episode := episode_of(r))]
    by_part = {name: [e[name] for e in episodes if name in e] for name in EPISODE}
    by_part['whole'] = [sum(e.values()) for e in episodes]
    for ax, values in ((left, stages), (middle, by_part)):
        shown = {k: v for k, v in values.items() if v}
        if shown:
            ax.boxplot(list(shown.values()), tick_labels=list(shown), showfliers=False)
            ax.set_yscale('log')
            ax.tick_params(axis='x', rotation=40)
        ax.set_ylabel('wall time [s]')
    timed = [r for r in some if r.simulations and 'all' in r.seconds]
    for hue, label, passes in ((COLOURS[0], 'passes', True), (COLOURS[1], 'does not', False)):
        shown_runs = [r for r in timed if r.passed is passes]
        right.scatter(
            [r.simulations for r in shown_runs], [r.seconds['all'] for r in shown_runs], s=9,
            color=hue, label=label,
        )  # fmt: skip
    if timed:
        right.set_yscale('log')
    right.set_xlabel('co-simulations of a run')
    right.set_ylabel('wall time of the run [s]')
    right.legend(fontsize=_FONT - 1)
    for ax, letter in ((left, 'a'), (middle, 'b'), (right, 'c')):
        ax.set_title(f'({letter})', loc='left')
    return figure


def _bars(
    ax: Axes,
    places: Sequence[float],
    shares: Sequence[Share],
    width: float,
    hue: str,
    label: str,
) -> None:
    values = [s.value for s in shares]
    low = [s.value - s.interval[0] for s in shares]
    high = [s.interval[1] - s.value for s in shares]
    ax.bar(places, values, width, color=hue, label=label)
    ax.errorbar(places, values, yerr=(low, high), fmt='none', ecolor='black', capsize=2)


def _passed_at_first(run: CampaignRun) -> bool:
    return run.first is not None and run.first.value == 'verified'
