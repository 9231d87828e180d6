# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What all trials of a ruler come to: shares, causes, contradictions, times."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from statistics import median
from typing import Any

from aurora_bench.fidelity.summary import share_json
from aurora_bench.results import Cell, Table
from aurora_bench.rulers.trial import Cause, JudgedTrial
from aurora_core.report.share import Share

_MOST_WORDS = 25
VERIFIED = 'verified'


def right_share(trials: Sequence[JudgedTrial]) -> Share:
    """Return how many trials ended as they should."""
    return Share(met=sum(t.right for t in trials), total=len(trials))


def repair_line(word: str, trials: Sequence[JudgedTrial]) -> str:
    """Return what repair added: how many are right without it, and what it took.

    Args:
        word: What a right trial is called.
        trials: All of them.
    """
    added = [t for t in trials if t.right and t.repaired]
    tried = [t for t in trials if t.repairs]
    spent = f', median co-simulations {median(t.repairs for t in added):g}' if added else ''
    without = sum(t.right for t in trials) - len(added)
    return (
        f'{word} {without} of {len(trials)} without repair, {len(added)} more by it '
        f'(of {len(tried)} tried{spent})'
    )


def silent_failures(trials: Sequence[JudgedTrial]) -> tuple[JudgedTrial, ...]:
    """Return verified runs of which the checker shows that an annotated requirement fails."""
    return tuple(t for t in trials if t.contradictions)


def unchecked_share(trials: Sequence[JudgedTrial]) -> Share:
    """Return how many requirements of verified runs the checker cannot decide."""
    said = [s for t in trials for s in t.said]
    return Share(met=sum(s.outcome == 'cannot_tell' for s in said), total=len(said))


def accepted(trials: Sequence[JudgedTrial]) -> tuple[JudgedTrial, ...]:
    """Return runs that were verified and had to be refused."""
    return tuple(t for t in trials if t.cause is Cause.ACCEPTED)


def mean_seconds(trials: Sequence[JudgedTrial]) -> dict[str, float]:
    """Return mean wall seconds per trial by stage; one that a trial did not reach counts as 0."""
    stages = dict.fromkeys(name for t in trials for name in t.seconds)
    return {s: sum(t.seconds.get(s, 0.0) for t in trials) / len(trials) for s in stages}


def total_tables(trials: Sequence[JudgedTrial], word: str) -> tuple[Table, ...]:
    """Return the tables that show no prompt.

    Args:
        trials: All of them.
        word: What a right trial is called.
    """
    return (
        _share_table('category', _split(trials, lambda t: t.category), word),
        _share_table('feasibility', _split(trials, lambda t: t.feasibility), word),
        _cause_table(trials, word),
        Table(
            headings=('stage', 'mean [s]'),
            rows=tuple(mean_seconds(trials).items()),
            caption='Wall time of a trial',
        ),
    )


def detail_tables(trials: Sequence[JudgedTrial]) -> tuple[Table, ...]:
    """Return the tables about single words and prompts."""
    words = Counter((t.cause.value, word) for t in trials if t.cause for word in t.words)
    shown = sorted(words.items(), key=lambda item: (-item[1], item[0]))[:_MOST_WORDS]
    undecided = Counter(
        (s.kind, s.why) for t in trials for s in t.said if s.outcome == 'cannot_tell'
    )
    least = sorted(undecided.items(), key=lambda item: (-item[1], item[0]))[:_MOST_WORDS]
    tables = [
        Table(
            headings=('cause', 'what', 'number'),
            rows=tuple((*key, n) for key, n in shown),
            caption='Commonest causes (a trial may have several words)',
        ),
        Table(
            headings=('prompt', 'seed', 'requirement', 'kind', 'what the checker found'),
            rows=tuple(
                (t.id, t.seed, s.requirement, s.kind, s.why)
                for t in silent_failures(trials)
                for s in t.contradictions
            ),
            caption='Silent failures: verified, and the checker shows that it does not hold',
        ),
        Table(
            headings=('kind', 'why the checker cannot tell', 'number'),
            rows=tuple((*key, n) for key, n in least),
            caption='Unchecked requirements of verified runs',
        ),
        Table(
            headings=('prompt', 'seed', 'to be refused because of'),
            rows=tuple((t.id, t.seed, ', '.join(t.words)) for t in accepted(trials)),
            caption='Accepted: verified, and to be refused',
        ),
    ]
    return tuple(table for table in tables if table.rows)


def as_json(trials: Sequence[JudgedTrial], *, details: bool) -> dict[str, Any]:
    """Return everything as plain JSON values.

    Args:
        trials: All of them.
        details: With single trials; without: totals alone.
    """
    document: dict[str, Any] = {
        'right': share_json(right_share(trials)),
        'silent_failures': len(silent_failures(trials)),
        'unchecked': {
            'cannot_tell': unchecked_share(trials).met,
            'of': unchecked_share(trials).total,
        },
        'accepted': len(accepted(trials)),
        'repaired': sum(t.right and t.repaired for t in trials),
        'repair_tried': sum(t.repairs > 0 for t in trials),
        'by_category': _split_json(trials, lambda t: t.category),
        'by_feasibility': _split_json(trials, lambda t: t.feasibility),
        'by_cause': {c.value: sum(t.cause is c for t in trials) for c in Cause},
        'by_status': dict(sorted(Counter(t.status for t in trials).items())),
        'seconds_mean': mean_seconds(trials),
    }
    if details:
        document['trials'] = [t.model_dump(mode='json') for t in trials]
    return document


Key = Callable[[JudgedTrial], str]


def _split(trials: Sequence[JudgedTrial], key: Key) -> Mapping[str, list[JudgedTrial]]:
    parts: dict[str, list[JudgedTrial]] = {}
    for trial in trials:
        parts.setdefault(key(trial), []).append(trial)
    return dict(sorted(parts.items()))


def _split_json(trials: Sequence[JudgedTrial], key: Key) -> dict[str, Any]:
    return {
        name: {
            **share_json(right_share(part)),
            'silent_failures': len(silent_failures(part)),
        }
        for name, part in _split(trials, key).items()
    }


def _share_table(heading: str, parts: Mapping[str, list[JudgedTrial]], word: str) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for name, part in parts.items():
        share, unchecked = right_share(part), unchecked_share(part)
        low, high = share.interval
        rows.append(
            (
                name, share.total, share.met, share.value, f'[{low:.3f}, {high:.3f}]',
                len(silent_failures(part)), f'{unchecked.met} of {unchecked.total}',
            )
        )  # fmt: skip
    return Table(
        headings=(
            heading, 'trials', word, 'share', '95 % interval', 'silent failures', 'unchecked',
        ),
        rows=tuple(rows),
    )  # fmt: skip


def _cause_table(trials: Sequence[JudgedTrial], word: str) -> Table:
    counts = Counter(t.cause for t in trials)
    rows: list[tuple[Cell, ...]] = [(word, counts[None], _part(counts[None], trials))]
    # The causes that a reading alone can have are no rows where nothing was read.
    for cause in Cause:
        if counts[cause] or cause in _ALWAYS:
            rows.append((cause.value, counts[cause], _part(counts[cause], trials)))
    return Table(headings=('how it ended', 'trials', 'share'), rows=tuple(rows))


_ALWAYS = frozenset(
    {Cause.ERROR, Cause.CONTRADICTED, Cause.CAPABILITY, Cause.GROUNDING, Cause.CONDITION}
)


def _part(number: int, trials: Sequence[JudgedTrial]) -> float | None:
    return number / len(trials) if trials else None
