# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What stated parameters of a link imply: satisfied, violated, not judged.

In `tailgate_case` one message is sent; here it is tried again every 0.2 s, at 36 m or so.
"""

from __future__ import annotations

from dataclasses import replace

import pytest
from kind_rows import Row, cut
from trace_builder import number
from trace_cases import Case, spec, tailgate_case

from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.parameter import Unit
from aurora_core.trace.records import LinkEventKind, LossReason


def _link(case: Case, **stated: float) -> Case:
    """State parameters of the one link."""
    units = {'range_m': Unit.METRE, 'retransmission_interval_s': Unit.SECOND}
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


def _apart() -> float:
    """Distance at the attempt."""
    return next(r for r in tailgate_case().run.links if r.attempt == 0).distance_m


def _tried(lost: int, allowed: float) -> Case:
    return _link(tailgate_case(lost=lost), retransmissions=allowed)


def _every(seconds: float) -> Case:
    return _link(tailgate_case(lost=2), retransmission_interval_s=seconds)


def _lossy(lost: int) -> Case:
    return _link(tailgate_case(lost=lost), loss=0.001)


NEVER, SHORT = Reason.PREMISE_NEVER, Reason.TRACE_SHORT


def _nothing_sent(case: Case) -> Case:
    case.run.links.clear()
    return case


ROWS = (
    Row(id='l1.range', make=lambda: _range(100.0), margin=100.0 - _apart()),
    Row(id='l1.range', make=lambda: _range(20.0), margin=20.0 - _apart()),
    Row(
        id='l1.range',
        make=lambda: _range(100.0, lost_for_it=True),
        margin=_apart() - 100.0,
        what='lost',
    ),
    Row(id='l1.range', make=lambda: _nothing_sent(_range(100.0)), reason=NEVER),
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
)


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_link_kinds(row: Row) -> None:
    row.check()
