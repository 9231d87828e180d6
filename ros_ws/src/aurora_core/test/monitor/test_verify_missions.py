# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Mission conditions: satisfied, violated, without their premise; margins worked out by hand."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import numpy as np
import pytest

from aurora_core.errors import VerificationError
from aurora_core.outcomes.verdict import Reason, VerdictStatus
from aurora_core.spec.parameter import Bound, Unit
from aurora_core.trace.layout import UavCommandColumn, UavPhase


def _results(tb: ModuleType, case: Any) -> dict[str, Any]:
    return {r.id: r for r in tb.judge(case).results}


def test_a_hover_that_keeps_everything_is_verified(tb: ModuleType) -> None:
    verdict = tb.judge(tb.hover_case(drift=1.5, ego_y=-9.0))
    assert verdict.status is VerdictStatus.VERIFIED, [
        r.explanation for r in verdict.results if not r.satisfied
    ]
    found = {r.id: r for r in verdict.results}
    assert found['m1.drift'].margin == pytest.approx(0.5)  # 2 m allowed, 1.5 m drifted
    assert found['m1.drift'].worst_time_s == pytest.approx(30.15, abs=0.1)
    assert found['m1.drift'].worst_place_m == pytest.approx((101.5, 0.0, 30.0))
    assert found['m1.altitude'].margin == pytest.approx(0.05)  # all samples, 95 % asked
    # The landing is commanded at 45 s, 15 s of descent: down at 60 s of 70 s.
    assert found['uav1.landed'].margin == pytest.approx(10.0, abs=0.1)
    assert found['m1.order'].margin == pytest.approx(0.05)
    # Capture is 18 m of way at 15 m/s after the ascent; 30 s + 20 m / 8 m/s allowed.
    assert found['m1.capture'].margin == pytest.approx(32.5 - 1.2, abs=0.1)


@pytest.mark.parametrize(('weather', 'margin'), [('clear', -0.5), ('rain', 0.05)])
def test_wind_widens_the_drift_that_is_allowed(
    tb: ModuleType, weather: str, margin: float
) -> None:
    found = _results(tb, tb.hover_case(drift=2.5, weather=weather))
    assert found['m1.drift'].margin == pytest.approx(margin)
    assert found['m1.drift'].satisfied is (margin > 0)


def test_altitude_is_a_share_of_the_phase(tb: ModuleType) -> None:
    case = tb.hover_case(altitude_error=2.5)
    found = _results(tb, case)['m1.altitude']
    # The phase runs from capture to tick 900; 0.2 m per tick reach 2 m off after tick 611.
    phase = 900 - _capture_tick(tb, case)
    good = 611 - _capture_tick(tb, case)
    assert found.margin == pytest.approx(good / phase - 0.95, abs=0.01)
    assert not found.satisfied
    assert found.worst_time_s == pytest.approx(611 * 0.05, abs=0.1)


def _capture_tick(tb: ModuleType, case: Any) -> int:
    time_s: float = _results(tb, case)['m1.capture'].worst_time_s
    return round(time_s / 0.05)


def test_a_stated_duration_is_compared_with_the_end_of_the_phase(tb: ModuleType) -> None:
    case = tb.hover_case(explicit_s=36.0)
    length_s = (900 - _capture_tick(tb, case)) * 0.05
    found = _results(tb, case)
    slack = 0.02 * 36.0  # more than 0.5 s
    assert found['m1.duration'].margin == pytest.approx(slack - abs(length_s - 36.0))
    late = _results(tb, tb.hover_case(explicit_s=30.0))['m1.duration']
    assert late.margin == pytest.approx(0.6 - (length_s - 30.0))
    assert not late.satisfied


def test_a_phase_that_is_cut_short_is_not_completed(tb: ModuleType) -> None:
    case = tb.hover_case(landing=500)
    found = _results(tb, case)['m1.completed']
    length_s = (500 - _capture_tick(tb, case)) * 0.05
    assert found.margin == pytest.approx(length_s - (30.0 - 0.6))
    assert not found.satisfied


def test_a_uav_that_never_takes_off_has_no_phase(tb: ModuleType) -> None:
    case = tb.hover_case()
    case.run.flights[0].states[:] = case.run.flights[0].states[0]
    case.run.flights[0].commands[:] = 0.0
    verdict = tb.judge(case)
    assert verdict.status is VerdictStatus.VIOLATED
    found = {r.id: r for r in verdict.results}
    for name in ('m1.order', 'm1.drift', 'm1.visible', 'm1.altitude', 'm1.completed'):
        assert found[name].reason is Reason.EMPTY_PHASE, name
        assert not found[name].exercised
        assert found[name].margin is None
    assert found['uav1.landed'].margin == pytest.approx(-0.05)  # not down by the last tick


def test_a_uav_that_never_lands_misses_the_horizon(tb: ModuleType) -> None:
    found = _results(tb, tb.hover_case(landing=None))
    assert found['uav1.landed'].margin == pytest.approx(-0.05)
    assert not found['uav1.landed'].satisfied


def test_a_mission_that_begins_before_the_ascent_has_ended_is_out_of_order(tb: ModuleType) -> None:
    case = tb.hover_case()
    phase = case.run.flights[0].commands[:, UavCommandColumn.PHASE]
    early = case.run.flights[0].ascent_end - 40
    phase[early : early + 45] = UavPhase.MISSION
    found = _results(tb, case)['m1.order']
    assert found.margin == pytest.approx(-2.0)


def test_a_target_that_leaves_before_capture_is_gone(tb: ModuleType) -> None:
    case = tb.convoy_case()
    bus = case.run.agents[1]
    bus.present = (np.arange(1401) < 50).astype(float)
    verdict = tb.judge(case)
    found = {r.id: r for r in verdict.results}
    assert verdict.status is VerdictStatus.VIOLATED
    for name in ('m1.tracked', 'm1.visible', 'm1.capture', 'm1.completed'):
        assert found[name].reason is Reason.TARGET_GONE, name
    assert found['m1.tracked'].worst_time_s == pytest.approx(2.5)
    assert found['safety.presence'].margin == -0.5
    assert found['safety.presence'].worst_time_s == pytest.approx(2.5)


def test_a_target_that_leaves_after_capture_counts_as_not_tracked(tb: ModuleType) -> None:
    case = tb.convoy_case()
    case.run.agents[1].present = (np.arange(1401) < 450).astype(float)
    found = _results(tb, case)
    capture = round(found['m1.capture'].worst_time_s / 0.05)
    share = (450 - capture) / (1050 - capture)
    assert found['m1.tracked'].margin == pytest.approx(share - 0.8)
    assert found['m1.visible'].margin == pytest.approx(share - 0.7)
    assert found['m1.tracked'].worst_time_s == pytest.approx(22.5)


def test_an_explicit_standoff_replaces_the_tracking_tolerance(tb: ModuleType) -> None:
    case = tb.convoy_case()
    assert _results(tb, case)['m1.tracked'].margin == pytest.approx(0.2)
    one = case.run.flights[0]
    one.states[400:1050, 1] += 6.0  # 41 m instead of 35 m: more than 5 m off, less than 10 m
    found = _results(tb, case)['m1.tracked']
    capture = round(_results(tb, case)['m1.capture'].worst_time_s / 0.05)
    assert found.margin == pytest.approx((400 - capture) / (1050 - capture) - 0.8)


def test_a_building_in_the_way_hides_the_target(tb: ModuleType) -> None:
    case = tb.convoy_case()
    wall = tb.building(-1000.0, 3.0, 5000.0, 8.0, 20.0)
    case.world = tb.world(buildings=(wall,))
    found = _results(tb, case)
    # At 35 m aside and 30 m up the line is at about 7 m over the wall: never visible.
    assert found['m1.visible'].margin == pytest.approx(-0.7)
    assert found['m1.tracked'].margin == pytest.approx(0.2)


def test_another_vehicle_in_the_way_hides_the_target(tb: ModuleType) -> None:
    case = tb.convoy_case()
    case.run.agents[3].y[:] = 3.0
    case.run.agents[3].x[:] = case.run.agents[1].x
    found = _results(tb, case)['m1.visible']
    # The line is 2.8 m high where it passes the car (1.5 m): below the roof of a bus.
    assert found.margin == pytest.approx(0.3)
    case.run.agents[3].type = 'bus'
    assert _results(tb, case)['m1.visible'].margin == pytest.approx(-0.7)


def test_a_survey_that_flies_its_rectangle_is_verified(tb: ModuleType) -> None:
    verdict = tb.judge(tb.survey_case())
    assert verdict.status is VerdictStatus.VERIFIED, [
        r.explanation for r in verdict.results if not r.satisfied
    ]
    found = {r.id: r for r in verdict.results}
    assert found['m1.waypoints'].margin == pytest.approx(3.0, abs=0.4)
    assert found['m1.closed'].margin == pytest.approx(3.0, abs=0.4)
    assert found['m1.centre'].margin == pytest.approx(10.0)
    assert found['m1.over_streets'].margin == pytest.approx(0.2)
    assert found['m1.completed'].margin == pytest.approx(1.0, abs=0.5)


def test_a_survey_that_cuts_a_corner_misses_its_waypoint(tb: ModuleType) -> None:
    found = _results(tb, tb.survey_case(skip=2))
    # From (100, 0) straight to (0, 60): (100, 60) is passed at 60 * 100 / 116.6 m.
    assert found['m1.waypoints'].margin == pytest.approx(3.0 - 51.45, abs=0.2)
    assert found['m1.completed'].margin == pytest.approx(-0.05)


def test_a_survey_that_stops_on_its_way_is_violated_in_metres(tb: ModuleType) -> None:
    case = tb.survey_case(stop_after=400)  # 80 m along the first leg
    verdict = tb.judge(case)
    found = {r.id: r for r in verdict.results}
    assert verdict.status is VerdictStatus.VIOLATED
    assert found['m1.waypoints'].margin == pytest.approx(3.0 - np.hypot(20.0, 60.0), abs=0.1)
    assert found['m1.closed'].margin == pytest.approx(3.0 - 80.0, abs=0.1)
    assert found['m1.over_streets'].reason is Reason.EMPTY_PHASE
    assert found['uav1.landed'].margin == pytest.approx(-0.05)


def test_a_pattern_beside_the_street_is_not_over_it(tb: ModuleType) -> None:
    case = tb.survey_case()
    case.world = tb.world(streets=((-1000.0, 500.0, 1000.0, 510.0),))
    found = _results(tb, case)['m1.over_streets']
    assert found.margin == pytest.approx(-0.8)


def test_a_pattern_is_centred_on_its_target_at_the_start(tb: ModuleType) -> None:
    found = _results(tb, tb.survey_case(ego_x=62.0))['m1.centre']
    assert found.margin == pytest.approx(-2.0)
    assert found.worst_time_s == 0.0


def test_explicit_route_speed(tb: ModuleType) -> None:
    mps = Unit.METRE_PER_SECOND
    asked = tb.number(8.0, mps, explicit=True)
    good = _results(tb, tb.survey_case(speed_mps=asked))['m1.speed']
    assert good.margin == pytest.approx(0.2)
    slow = _results(tb, tb.survey_case(speed=6.9, speed_mps=asked))['m1.speed']
    assert slow.margin == pytest.approx(-0.8)  # 1.1 m/s off, 1 m/s allowed
    least = tb.number(6.5, mps, explicit=True, bound=Bound.AT_LEAST)
    assert _results(tb, tb.survey_case(speed_mps=least))['m1.speed'].margin == pytest.approx(0.2)
    fast = tb.number(16.0, mps, explicit=True)
    none = _results(tb, tb.survey_case(speed_mps=fast))['m1.speed']
    assert none.reason is Reason.EMPTY_PHASE  # 69 m to reach 14.4 m/s, and to brake


def test_counted_waypoints(tb: ModuleType) -> None:
    four = tb.number(4.0, Unit.ONE, explicit=True)
    assert _results(tb, tb.survey_case(waypoint_count=four))['m1.count'].margin == 0.0
    cut = _results(tb, tb.survey_case(skip=2, waypoint_count=four))['m1.count']
    assert cut.margin == -1.0


def test_an_explicit_size_is_never_resized(tb: ModuleType) -> None:
    size = (tb.number(120.0, explicit=True), tb.number(60.0))
    with pytest.raises(VerificationError, match=r'asks for a side of 120.0 m'):
        tb.judge(tb.survey_case(size_m=size))


def test_an_explicit_bearing_from_the_target(tb: ModuleType) -> None:
    # The drone stays north of the bus: bearing 0 once it has caught up from the west.
    for asked, margin in ((10.0, 0.2), (20.0, -0.8)):
        case = tb.convoy_case()
        (one,) = case.spec.missions
        bearing = tb.number(asked, Unit.DEGREE, explicit=True)
        case.spec = tb.spec(
            **{**dict(case.spec), 'missions': (dict(one) | {'bearing_deg': bearing},)}
        )
        assert _results(tb, case)['m1.bearing'].margin == pytest.approx(margin, abs=0.1)
