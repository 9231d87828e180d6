# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a recording shows of a report that came late."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from aurora_core.judging.evaluation import Context
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.verdict import Verdict
from aurora_core.repair.localize import localize
from aurora_core.repair.reach import reporting_tracker
from aurora_core.repair.shown import why_sent_late

PATH = 'missions/m1/standoff_m'
UP, DUE = 300, 280


def recorded(agsg: Agsg, *, captured: int) -> Context:
    """Return a run in which a tracker ends its ascent 12 m from its target, and captures then."""
    [mission] = agsg.spec.missions
    places = {mission.uav: [0.0, 0.0, 30.0], mission.target: [12.0, 0.0, 0.0]}
    flight = SimpleNamespace(ascent_end_tick=UP)
    events: Any = SimpleNamespace(
        event=lambda name: next(e for e in agsg.spec.events if e.id == name),
        due_tick=lambda _: DUE,
        reports_from=lambda _, start: max(start, captured),
        rules=SimpleNamespace(flights={mission.uav: flight}),
    )
    view: Any = SimpleNamespace(
        has=places.__contains__, reference=lambda name: np.tile(places[name], (400, 1))
    )
    run = SimpleNamespace(
        events=events, view=view, spec=agsg.spec, time_s=lambda tick: 0.05 * tick
    )
    return cast(Context, run)


@pytest.mark.parametrize(('captured', 'aim'), [(321, 24.0), (UP, None)])
def test_who_had_to_catch_up_before_it_reported_tracks_from_farther_behind(
    agsg: Agsg, captured: int, aim: float | None
) -> None:
    late = next(c for c in agsg.conditions if c.id == 'e1.within')
    tracker = reporting_tracker(agsg, late)
    assert tracker is not None
    assert tracker[0] == PATH
    found = why_sent_late(recorded(agsg, captured=captured), late, *tracker)
    if aim is None:  # the climb alone took that long
        assert found is None
        return
    assert found is not None
    assert (found.aim, found.direction) == (tracker[1].value + aim, 1)
    assert 'captured 1.1 s after its ascent, which ended 12 m from' in found.because


def test_a_late_report_has_its_tracker_in_the_neighbourhood(
    agsg: Agsg, failing: Callable[..., Verdict]
) -> None:
    """Whatever a recording shows: the neighbourhood is worked out without it."""
    moves = {(item.field, item.direction) for item in localize(agsg, failing(e1__within=-1.0))}
    assert (PATH, 1) in moves
    never = {(item.field, item.direction) for item in localize(agsg, failing(e1__within=None))}
    assert (PATH, 1) not in never
