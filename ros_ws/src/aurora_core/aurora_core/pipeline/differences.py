# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Commands and claims of a recording against what its executor gives again, bit by bit."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from aurora_core.outcomes.verdict import Finding
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import UavCommandColumn
from aurora_core.trace.records import EventRecord, LinkRecord, SightRecord
from aurora_core.trace.trace import Trace

FloatArray = npt.NDArray[np.float64]
_Record = TypeVar('_Record', EventRecord, LinkRecord, SightRecord)

# Findings about one body or topic; more say nothing more.
_FEW = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class Again:
    """What the executor gives from recorded states.

    Attributes:
        ticks: Ticks that it was stepped through.
        uav_commands: (ticks + 1, M, UAV_COMMAND_WIDTH); row k was to be applied to reach tick k.
        ground_commands: ticks + 1 tuples, the same.
        links: Message ledger ordered by sequence.
        sights: Ordered by tick, observer, target.
        events: Ordered by sequence.
        finished_tick: Where it ended the scenario, None when it did not.
        problem: Why it could not be stepped any further, empty when it could.
    """

    ticks: int
    uav_commands: FloatArray
    ground_commands: tuple[tuple[GroundCommand, ...], ...]
    links: tuple[LinkRecord, ...]
    sights: tuple[SightRecord, ...]
    events: tuple[EventRecord, ...]
    finished_tick: int | None = None
    problem: str = ''


def differences(trace: Trace, again: Again, *, claims: bool) -> tuple[Finding, ...]:
    """Return what is recorded otherwise than the executor gives it.

    Args:
        trace: As recorded.
        again: From its states.
        claims: Compare what the executor claims, too.
    """
    commanded = min(again.ticks + 1, trace.ticks)
    found = [*_flown(trace, again, commanded), *_driven(trace, again, commanded)]
    if claims:
        found += _claims(trace, 'the message ledger', trace.links, again.links, _link_words)
        found += _claims(trace, 'sight', trace.sights, again.sights, _sight_words)
        found += _claims(trace, 'events', trace.events, again.events, _event_words)
    end = again.finished_tick
    if end is not None and end < trace.ticks - 1:
        text = f'the executor ends the scenario here, the record goes to tick {trace.ticks - 1}'
        found.append(_finding(trace, 'command', 'executor', end, text))
    return tuple(found)


def _finding(trace: Trace, kind: str, subject: str, tick: int, text: str) -> Finding:
    return Finding(kind=kind, subject=subject, tick=tick, time_s=trace.time_s(tick), text=text)


def _few(trace: Trace, kind: str, subject: str, found: Iterable[tuple[int, str]]) -> list[Finding]:
    """Return the first findings about one subject, and how many more there are."""
    every = list(found)
    few = [_finding(trace, kind, subject, tick, text) for tick, text in every[:_FEW]]
    more = every[_FEW:]
    if more:
        text = f'… and {len(more)} more, the last at tick {more[-1][0]}'
        few.append(_finding(trace, kind, subject, more[0][0], text))
    return few


def _flown(trace: Trace, again: Again, ticks: int) -> Iterator[Finding]:
    """Yield where a UAV was commanded otherwise; row 0 is nobody's command."""
    recorded = np.ascontiguousarray(trace.uav_commands[1:ticks]).view(np.uint64)
    ours = np.ascontiguousarray(again.uav_commands[1:ticks]).view(np.uint64)
    differ = recorded != ours
    for row in np.flatnonzero(differ.any(axis=(0, 2))).tolist():
        wrong = [
            (tick, _columns(trace.uav_commands[tick, row], again.uav_commands[tick, row]))
            for tick in (np.flatnonzero(differ[:, row].any(axis=1)) + 1).tolist()
        ]
        yield from _few(trace, 'command', trace.roster.uavs[row].body_id, wrong)


def _columns(recorded: FloatArray, ours: FloatArray) -> str:
    pairs = zip(UavCommandColumn, recorded.tolist(), ours.tolist(), strict=True)
    words = [f'{c.name.lower()} {a!r}, the executor gives {b!r}' for c, a, b in pairs if a != b]
    return f'commanded {"; ".join(words[:_FEW]) or "a zero of the other sign"}'


def _driven(trace: Trace, again: Again, ticks: int) -> Iterator[Finding]:
    wrong: dict[str, list[tuple[int, str]]] = {}
    for tick in range(1, ticks):
        recorded, ours = trace.ground_commands[tick], again.ground_commands[tick]
        if _exact(recorded) == _exact(ours):
            continue
        agents = {c.agent for c in (*recorded, *ours)}
        of = {
            a: ([c for c in recorded if c.agent == a], [c for c in ours if c.agent == a])
            for a in sorted(agents)
        }
        apart = {a: pair for a, pair in of.items() if _exact(pair[0]) != _exact(pair[1])}
        for agent, (theirs, mine) in apart.items():
            text = f'commanded {_told(theirs)}, the executor gives {_told(mine)}'
            wrong.setdefault(_agent(trace, agent), []).append((tick, text))
        if not apart:
            text = 'the commands of one tick are recorded in another order'
            wrong.setdefault('ground commands', []).append((tick, text))
    for subject, found in wrong.items():
        yield from _few(trace, 'command', subject, found)


def _exact(commands: Sequence[GroundCommand]) -> list[tuple[object, ...]]:
    """Return commands such that zeros of different sign differ, as they do in the trace hash."""
    return [
        (c.agent, int(c.kind), float(c.value).hex(), float(c.value2).hex(), c.text)
        for c in commands
    ]


def _agent(trace: Trace, row: int) -> str:
    agents = trace.roster.agents
    return agents[row].body_id if row < len(agents) else f'row {row}'


def _told(commands: Sequence[GroundCommand]) -> str:
    words = [
        ' '.join(filter(None, (c.kind.name, f'{c.value!r}', f'{c.value2!r}', c.text[:40])))
        for c in commands[:_FEW]
    ]
    return ', '.join(words) or 'nothing'


def _claims(
    trace: Trace,
    subject: str,
    recorded: Sequence[_Record],
    ours: Sequence[_Record],
    words: Callable[[_Record], str],
) -> list[Finding]:
    """Compare claims tick by tick; their running numbers follow from the order."""
    if recorded == ours:
        return []
    theirs: dict[int, list[_Record]] = _by_tick(recorded)
    mine: dict[int, list[_Record]] = _by_tick(ours)
    wrong = []
    for tick in sorted({*theirs, *mine}):
        there, here = theirs.get(tick, []), mine.get(tick, [])
        if there != here:
            added = '; '.join(words(r) for r in there if r not in here)[:200]
            lacking = '; '.join(words(r) for r in here if r not in there)[:200]
            text = f'recorded: {added or "nothing else"}, the executor gives: '
            text += lacking or ('nothing else' if added else 'the same in another order')
            wrong.append((tick, text))
    if not wrong:
        wrong = [(recorded[0].tick, 'recorded in another order than the executor gives them')]
    known = [(min(max(tick, 0), trace.ticks - 1), text) for tick, text in wrong]
    return _few(trace, 'claim', subject, known)


def _by_tick(records: Sequence[_Record]) -> dict[int, list[_Record]]:
    by_tick: dict[int, list[_Record]] = {}
    for record in records:
        unnumbered = record if isinstance(record, SightRecord) else replace(record, sequence=0)
        by_tick.setdefault(record.tick, []).append(unnumbered)
    return by_tick


def _link_words(r: LinkRecord) -> str:
    where = f'message {r.message} on {r.link}, attempt {r.attempt}, {r.distance_m!r} m'
    return f'{r.kind.name} of {where} ({r.sender} to {r.receiver}, {r.reason.name})'


def _sight_words(r: SightRecord) -> str:
    seen = 'sees' if r.visible else 'does not see'
    return f'{r.observer} {seen} {r.target} at {r.slant_range_m!r} m'


def _event_words(r: EventRecord) -> str:
    return f'{r.kind.name} of {r.subject} {r.detail}'.rstrip()
