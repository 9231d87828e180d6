# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What stated parameters of a link imply: satisfied, violated, not judged.

In `tailgate_case` one message is sent; here it is tried again every 0.2 s, at 36 m or so.
"""

from __future__ import annotations

from dataclasses import replace

import pytest
from kind_rows import Row, cut
from trace_builder import building, number, world
from trace_cases import Case, message, spec, tailgate_case

from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.parameter import Unit
from aurora_core.trace.records import LinkEventKind, LossReason, ScenarioEventKind


def _link(case: Case, **stated: float) -> Case:
    """State parameters of the one link."""
    units = {'range_m': Unit.METRE} | dict.fromkeys(
        ('retransmission_interval_s', 'latency_s'), Unit.SECOND
    )
    (link,) = case.spec.links
    numbers = {
        name: number(value, units.get(name, Unit.ONE), explicit=True)
        for name, value in stated.items()
    }
    case.spec = spec(**{**dict(case.spec), 'links': ({**dict(link), **numbers},)})
    return case


def _range(metres: float, *, lost_for_it: bool = False) -> Case:
    """The only attempt passes, or is lost for its distance."""
    case = tailgate_case()
    if lost_for_it:
        records = [
            replace(r, kind=LinkEventKind.ATTEMPT_LOST, reason=LossReason.RANGE)
            if r.kind is LinkEventKind.ATTEMPT_PASSED
            else r
            for r in case.run.links
            if r.kind is not LinkEventKind.DELIVERED
        ]
        case.run.links[:] = records
    return _link(case, range_m=metres)


def _behind(occlusion: str, *, wall: bool = True, lost_for_it: bool = False) -> Case:
    """A house stands over the van and the ego, and the UAV above it; or none does."""
    case = _range(100.0, lost_for_it=lost_for_it)
    (link,) = case.spec.links
    stated = {**dict(link), 'occlusion': occlusion, 'range_m': None}
    case.spec = spec(**{**dict(case.spec), 'links': (stated,)})
    if wall:
        case.world = world(buildings=(building(-1000.0, -50.0, 6000.0, 50.0, 5.0),))
    return case


def _apart() -> float:
    """Distance at the attempt."""
    return next(r for r in tailgate_case().run.links if r.attempt == 0).distance_m


def _tried(lost: int, allowed: float) -> Case:
    return _link(tailgate_case(lost=lost), retransmissions=allowed)


def _every(seconds: float) -> Case:
    return _link(tailgate_case(lost=2), retransmission_interval_s=seconds)


def _lossy(lost: int) -> Case:
    return _link(tailgate_case(lost=lost), loss=0.001)


def _words(said: str, *, alert: bool = True) -> Case:
    """An alert that is asked to say "van close"."""
    case = tailgate_case(alert=alert)
    (event,) = case.spec.events
    action = {**dict(event.action or ()), 'text': 'van close'}
    case.spec = spec(**{**dict(case.spec), 'events': ({**dict(event), 'action': action},)})
    case.run.events[:] = [
        replace(e, detail=said) if e.kind is ScenarioEventKind.ACTION else e
        for e in case.run.events
    ]
    return case


# Its ascent ends at 7 s, its missions at 52.5 s.
UP_TICK, HOME_TICK = 140, 1050

NEVER, SHORT = Reason.PREMISE_NEVER, Reason.TRACE_SHORT


def _nothing_sent(case: Case) -> Case:
    case.run.links.clear()
    return case


def _reports(step: int, *, every_s: float = 1.0, skip: range = range(0), late: int = 2) -> Case:
    """Reports from the ascent to the way home, each that many ticks after the one before."""
    case = tailgate_case(alert=False)
    for number_, tick in enumerate(range(UP_TICK, HOME_TICK, step), start=2):
        if tick not in skip:
            before = len(case.run.links)
            message(case, tick, latency_ticks=late)
            case.run.links[before:] = [
                replace(r, message=number_, event='l1') for r in case.run.links[before:]
            ]
    return _link(case, rate_hz=1.0 / every_s, latency_s=0.1)


def _out(from_s: float, to_s: float, skip: range = range(0)) -> Case:
    """Reports all along but in some ticks, and an outage that the prompt states."""
    case = _reports(20, skip=skip)
    (link,) = case.spec.links
    ends = tuple(number(s, Unit.SECOND, explicit=True) for s in (from_s, to_s))
    case.spec = spec(**{**dict(case.spec), 'links': ({**dict(link), 'outage_s': ends},)})
    return case


ROWS = (
    # A tenth of the time between two reports is allowed.
    Row(id='l1.rate', make=lambda: _reports(20), margin=0.1),
    Row(id='l1.rate', make=lambda: _reports(20, every_s=2.0), margin=0.2 - 0.95),
    Row(
        id='l1.rate',
        make=lambda: _reports(20, skip=range(300, 340)),
        margin=0.1 - 1.95,
        what='two-left-out',
    ),
    Row(
        id='l1.rate',
        make=lambda: _reports(20, skip=range(900, 1050)),
        margin=0.1 - 7.45,
        what='ends-early',
    ),
    Row(id='l1.rate', make=lambda: _reports(20, skip=range(1050)), reason=NEVER),
    # Two steps are allowed.
    Row(id='l1.latency', make=lambda: _reports(20), margin=2.0),
    Row(id='l1.latency', make=lambda: _reports(20, late=7), margin=2.0 - 5.0),
    Row(id='l1.latency', make=lambda: _reports(20, skip=range(1050)), reason=NEVER),
    # Reports pass every second: at 20.5 s nothing, from 20 to 30 s the middle one is 5 s deep.
    Row(id='l1.outage', make=lambda: _out(19.9, 20.8), margin=0.5 - 0.1, within=1e-6),
    Row(id='l1.outage', make=lambda: _out(20.0, 30.0), margin=0.5 - 5.0),
    Row(id='l1.outage', make=lambda: _out(60.0, 70.0), reason=NEVER),
    Row(id='l1.range', make=lambda: _range(100.0), margin=100.0 - _apart()),
    Row(id='l1.range', make=lambda: _range(20.0), margin=20.0 - _apart()),
    Row(
        id='l1.range',
        make=lambda: _range(100.0, lost_for_it=True),
        margin=_apart() - 100.0,
        what='lost',
    ),
    Row(id='l1.range', make=lambda: _nothing_sent(_range(100.0)), reason=NEVER),
    # What goes through a wall that stops it, and what a wall stops that is to be ignored.
    Row(id='l1.occlusion', make=lambda: _behind('blocks'), margin=-_apart()),
    Row(
        id='l1.occlusion',
        make=lambda: _behind('blocks', lost_for_it=True),
        margin=_apart(),
        what='blocks',
    ),
    Row(
        id='l1.occlusion',
        make=lambda: _behind('blocks', wall=False),
        margin=500.0 - _apart(),
        what='open',
    ),
    Row(
        id='l1.occlusion',
        make=lambda: _behind('ignored'),
        margin=500.0 - _apart(),
        what='ignored',
    ),
    Row(
        id='l1.occlusion',
        make=lambda: _behind('ignored', lost_for_it=True),
        margin=_apart() - 500.0,
        what='ignored',
    ),
    Row(id='l1.occlusion', make=lambda: _nothing_sent(_behind('blocks')), reason=NEVER),
    Row(id='l1.retransmissions', make=lambda: _tried(2, 2.0), margin=0.0),
    Row(id='l1.retransmissions', make=lambda: _tried(2, 1.0), margin=-1.0, what='too-often'),
    Row(id='l1.retransmissions', make=lambda: _tried(4, 5.0), margin=-2.0, what='too-rarely'),
    Row(id='l1.retransmissions', make=lambda: _nothing_sent(_tried(2, 2.0)), reason=NEVER),
    # 0.5 s are allowed.
    Row(id='l1.interval', make=lambda: _every(0.2), margin=0.5),
    Row(id='l1.interval', make=lambda: _every(1.0), margin=0.5 - 0.8),
    Row(id='l1.interval', make=lambda: cut(_every(0.2), 750), reason=SHORT),
    # Of one attempt that passes, and of three of which two are lost: none should be.
    Row(id='l1.loss', make=lambda: _lossy(0), margin=0.0),
    Row(id='l1.loss', make=lambda: _lossy(2), margin=(1 - 3) / 3),
    Row(id='l1.loss', make=lambda: _nothing_sent(_lossy(0)), reason=NEVER),
    Row(id='e1.text', make=lambda: _words('van close'), margin=1.0),
    Row(id='e1.text', make=lambda: _words('van'), margin=0.0, what='other-words'),
    Row(id='e1.text', make=lambda: _words(''), margin=0.0, what='no-words'),
    Row(id='e1.text', make=lambda: _words('', alert=False), reason=NEVER),
)


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_link_kinds(row: Row) -> None:
    row.check()
