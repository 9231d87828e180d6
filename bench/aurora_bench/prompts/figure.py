# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The figure of a set of prompts: composition, annotation, diversity."""

from __future__ import annotations

import statistics
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.patches import Patch

from aurora_bench.plotting import COLOURS, new_figure, save_figure
from aurora_bench.prompts.choose import CATEGORIES
from aurora_bench.prompts.diversity import LONGEST, distinct, self_bleu
from aurora_bench.prompts.format import AgentRequirement, AnnotatedPrompt

Parts = Mapping[str, Sequence[AnnotatedPrompt]]

_FEASIBILITY = {'feasible': COLOURS[0], 'boundary': COLOURS[4], 'infeasible': COLOURS[1]}
_ORDER = (*CATEGORIES[:10], 'multi_uav', *CATEGORIES[10:])
# The page is 7.2 inches wide; what is drawn at that width is read at that width.
_SIZE_IN = (7.2, 5.6)
_FONT = 7.5
_BIN_WORDS = 5


def draw(parts: Parts, folder: Path, name: str) -> tuple[Path, Path]:
    """Write the figure as PNG and SVG.

    Args:
        parts: Prompts by the name of their part, e.g. `tune` and `held_out`.
        folder: Where to.
        name: Of the files, without ending.

    Returns:
        Their paths.

    Raises:
        ResultsError: A file cannot be written.
    """
    prompts = [p for part in parts.values() for p in part]
    figure, axes = new_figure(*_SIZE_IN, panels=3, rows=2, font_size=_FONT)
    _categories(axes[0], parts)
    _kinds(axes[1], prompts)
    _per_prompt(axes[2], prompts)
    _lengths(axes[3], prompts)
    _wording(axes[4], prompts)
    _actors(axes[5], prompts)
    return save_figure(figure, folder, name)


def _categories(ax: Axes, parts: Parts) -> None:
    present = {p.category for part in parts.values() for p in part}
    rows = [c for c in _ORDER if c in present]
    left = dict.fromkeys(rows, 0)
    shades = _shades(len(parts))
    for shade, part in zip(shades, parts.values(), strict=True):
        for feasibility, colour in _FEASIBILITY.items():
            counts = Counter(p.category for p in part if p.feasibility == feasibility)
            widths = [counts[c] for c in rows]
            starts = [left[c] for c in rows]
            ax.barh(range(len(rows)), widths, left=starts, color=colour, alpha=shade)
            left = {c: left[c] + counts[c] for c in rows}
    _rows(ax, [c.replace('_', ' ') for c in rows])
    _numbers(ax, [left[c] for c in rows])
    keys = [Patch(color=colour, label=name) for name, colour in _FEASIBILITY.items()]
    if len(parts) > 1:
        keys += [
            Patch(color='black', alpha=shade * 0.7, label=name.replace('_', ' '))
            for shade, name in zip(shades, parts, strict=True)
        ]
    _title(ax, 'a', f'{sum(left.values())} prompts by category')
    ax.legend(
        handles=keys, loc='upper center', bbox_to_anchor=(0.3, -0.02), ncols=2, frameon=False,
        handlelength=1.0, columnspacing=0.8, fontsize=_FONT - 0.5,
    )  # fmt: skip


def _kinds(ax: Axes, prompts: Sequence[AnnotatedPrompt]) -> None:
    kinds = Counter[str](r.kind for p in prompts for r in p.requirements)
    _bars(ax, kinds, COLOURS[0])
    _title(ax, 'b', f'{kinds.total()} requirements by kind')


def _per_prompt(ax: Axes, prompts: Sequence[AnnotatedPrompt]) -> None:
    asked = [p for p in prompts if p.feasibility != 'infeasible']
    counts = Counter(len(p.requirements) for p in asked)
    ax.bar([*counts], [*counts.values()], color=COLOURS[2])
    mean = statistics.mean(len(p.requirements) for p in asked) if asked else 0.0
    ax.axvline(mean, color='black', linewidth=0.8, linestyle='--')
    _title(ax, 'c', 'requirements each')
    ax.set_xlabel(f'if not infeasible; mean {mean:.1f}')
    ax.set_ylabel('prompts')


def _lengths(ax: Axes, prompts: Sequence[AnnotatedPrompt]) -> None:
    lengths = [len(p.prompt.split()) for p in prompts]
    edges = range(0, max(lengths) + _BIN_WORDS + 1, _BIN_WORDS)
    ax.hist(lengths, bins=list(edges), color=COLOURS[5], edgecolor='white', linewidth=0.5)
    median = statistics.median(lengths)
    ax.axvline(median, color='black', linewidth=0.8, linestyle='--')
    _title(ax, 'd', 'length of prompts')
    ax.set_xlabel(f'words; median {median:g}')
    ax.set_ylabel('prompts')


def _wording(ax: Axes, prompts: Sequence[AnnotatedPrompt]) -> None:
    texts = [p.prompt for p in prompts]
    orders = range(1, LONGEST + 1)
    lines = (
        ('distinct-n', [distinct(texts, n) for n in orders], COLOURS[0], 'o', 5),
        ('self-BLEU-n', [self_bleu(texts, n) for n in orders], COLOURS[1], 's', -10),
    )
    for label, values, colour, marker, lift in lines:
        ax.plot([*orders], values, color=colour, marker=marker, markersize=4, label=label)
        for n, value in zip(orders, values, strict=True):
            ax.annotate(
                f'{value:.2f}', (n, value), xytext=(0, lift), textcoords='offset points',
                ha='center', color=colour, fontsize=_FONT - 1,
            )  # fmt: skip
    ax.set_xticks([*orders])
    ax.set_xlim(0.6, LONGEST + 0.4)
    ax.set_ylim(0.0, 1.25)
    ax.set_yticks([0.0, 0.25, 0.5, 0.75, 1.0])
    _title(ax, 'e', 'diversity of wording')
    ax.set_xlabel('n')
    ax.legend(
        loc='upper center', ncols=2, handlelength=1.2, columnspacing=0.8, frameon=False,
        fontsize=_FONT,
    )  # fmt: skip


def _actors(ax: Axes, prompts: Sequence[AnnotatedPrompt]) -> None:
    types = Counter(
        r.type.value
        for p in prompts
        for r in p.requirements
        if isinstance(r, AgentRequirement) and r.count > 0
    )
    _bars(ax, types, COLOURS[3])
    _title(ax, 'f', f'{types.total()} ground actors')


def _bars(ax: Axes, counts: Counter[str], colour: str) -> None:
    ranked = sorted(counts.items(), key=lambda item: (-item[1], item[0]))
    ax.barh(range(len(ranked)), [count for _, count in ranked], color=colour)
    _rows(ax, [name.replace('_', ' ') for name, _ in ranked])
    _numbers(ax, [count for _, count in ranked])


def _rows(ax: Axes, names: Sequence[str]) -> None:
    ax.set_yticks(range(len(names)), names)
    ax.invert_yaxis()
    ax.grid(visible=False)
    ax.set_xticks([])
    ax.spines['bottom'].set_visible(False)


def _numbers(ax: Axes, values: Sequence[int]) -> None:
    for row, value in enumerate(values):
        ax.annotate(
            str(value), (value, row), xytext=(2, 0), textcoords='offset points', va='center',
            fontsize=_FONT,
        )  # fmt: skip
    ax.set_xlim(0, max(values, default=1) * 1.2)


def _title(ax: Axes, letter: str, text: str) -> None:
    ax.set_title(f'({letter}) {text}', fontsize=_FONT + 0.5, loc='left')


def _shades(number: int) -> list[float]:
    """Return how opaque each part is drawn, the first one fully."""
    return [1.0 - 0.6 * k / max(1, number - 1) for k in range(number)]
