# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a campaign of faults gives: tables, goals and the line that programs read."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from statistics import median, median_high

from aurora_bench.repair.campaign import Episode
from aurora_bench.repair.kinds import KINDS
from aurora_bench.results import Goal, Table
from aurora_core.report.share import Share

_HEADINGS = (
    'fault',
    'faults',
    'useless draws',
    'violated',
    'repaired',
    'cause in first 3',
    'median runs',
)


def kinds_table(episodes: Sequence[Episode]) -> Table:
    """Return what came of each kind of fault."""
    rows = []
    for kind in KINDS:
        own = [e for e in episodes if e.kind == kind.name]
        shown = [e for e in own if e.showed]
        if not own:
            continue
        rows.append(
            (
                kind.name,
                len(own),
                sum(len(e.useless) for e in own),
                len(shown),
                sum(e.repaired for e in shown),
                sum(e.localized for e in shown) if kind.mends else None,
                _spent(shown) if kind.mends else None,
            )
        )
    return Table(
        headings=_HEADINGS,
        rows=tuple(rows),
        caption=(
            'Violated: while the same request holds with a good value in its place. Median runs: '
            'of all that are violated; one that stays so counts as more than any number'
        ),
    )


def steps_table(episodes: Sequence[Episode]) -> Table:
    """Return what each step of the escalation brought."""
    shown, _ = _shown(episodes)
    tried = Counter(step for e in shown for step in e.steps)
    mended = Counter(e.steps[-1] for e in shown if e.repaired and e.steps)
    return Table(
        headings=('step', 'simulated', 'after which all holds'),
        rows=tuple((step, tried[step], mended[step]) for step in sorted(tried)),
        caption='Steps of the escalation',
    )


def surrogate_table(episodes: Sequence[Episode]) -> Table:
    """Return how far off the estimates of the replay were, by name of condition."""
    found: dict[str, list[float]] = {}
    for episode in episodes:
        for name, values in episode.missed.items():
            found.setdefault(name, []).extend(values)
    rows = []
    for name, errors in sorted(found.items()):
        off = sorted(abs(error) for error in errors)
        high = off[math.ceil(0.9 * len(off)) - 1]
        rows.append((name, len(off), median(off), high, max(0.0, *errors)))
    return Table(
        headings=('condition', 'estimates', 'median error', '90 %', 'most too good'),
        rows=tuple(rows),
        caption='Estimates of the replay against what was realised (normalised margins)',
    )


def goals(episodes: Sequence[Episode]) -> tuple[Goal, ...]:
    """Return the goals of repair and whether they are met."""
    shown, locked = _shown(episodes)
    share = Share(met=sum(e.repaired for e in shown), total=len(shown))
    near = Share(met=sum(e.localized for e in shown), total=len(shown))
    spent = _spent(shown)
    every = [*shown, *locked]
    kept = sum(e.preserved for e in every)
    refused = sum(not e.repaired for e in locked)
    times = median(e.times for e in shown) if shown else 0.0
    thinking = [s / e.first_s for e in every if e.first_s for s in e.proposing_s]
    share_of_run = median(thinking) if thinking else 0.0
    seconds = median(e.seconds for e in shown) if shown else 0.0
    return (
        _goal('repaired', '>= 0.85', f'{share.value:.3f}', share.value >= 0.85),
        _goal('median co-simulations', '<= 2', _number(spent), spent is not None and spent <= 2),
        _goal('cause among the first three', '>= 0.95', f'{near.value:.3f}', near.value >= 0.95),
        _goal('nothing else changed', 'all', f'{kept} of {len(every)}', kept == len(every) > 0),
        _goal(
            'locked faults stay as they are',
            'all',
            f'{refused} of {len(locked)}',
            bool(locked) and refused == len(locked),
        ),
        _goal('median episode in first realisations', '<= 3', f'{times:.2f}', times <= 3.0),
        _goal('median episode in seconds', '<= 8', f'{seconds:.1f}', seconds <= 8.0),
        _goal(
            'median proposal in first realisations',
            '<= 1',
            f'{share_of_run:.2f}',
            share_of_run <= 1.0,
        ),
    )


def last_line(episodes: Sequence[Episode]) -> str:
    """Return the line that programs read."""
    shown, locked = _shown(episodes)
    share = Share(met=sum(e.repaired for e in shown), total=len(shown))
    low, high = share.interval
    every = [*shown, *locked]
    return (
        f'repaired {share.met} of {share.total} faults  {share.value:.3f} [{low:.3f}, {high:.3f}]'
        f'  median co-simulations {_number(_spent(shown))}  cause among first three '
        f'{sum(e.localized for e in shown)} of {len(shown)}  nothing else changed '
        f'{sum(e.preserved for e in every)} of {len(every)}'
    )


def _shown(episodes: Sequence[Episode]) -> tuple[list[Episode], list[Episode]]:
    """Return the faults that show: those that repair may mend, and those that are locked."""
    shown = [e for e in episodes if e.showed]
    return [e for e in shown if e.mends], [e for e in shown if not e.mends]


def _spent(shown: Sequence[Episode]) -> float | None:
    """Return the median of the co-simulations until all held; None: most were never repaired.

    One that stays violated counts as more than any number: it was never mended.
    """
    if not shown:
        return None
    spent = median_high(e.simulations if e.repaired else math.inf for e in shown)
    return None if math.isinf(spent) else spent


def _number(value: float | None) -> str:
    return '-' if value is None else f'{value:g}'


def _goal(name: str, target: str, figure: str, met: bool) -> Goal:
    return Goal(name=name, target=target, figure=figure, met=met)
