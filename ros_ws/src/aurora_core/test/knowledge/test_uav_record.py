# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The record of the multirotor: above the contract limits, and a cap on what is planned."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from aurora_core.errors import ConfigError
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import Limits, load_limits
from aurora_core.knowledge.settings import Settings, load_settings
from aurora_core.knowledge.uav_record import (
    RECORDS,
    DriftRow,
    UavRecord,
    load_uav_record,
    planned_clearance_m,
    possible_limits,
    possible_settings,
    within,
)


def _shipped() -> tuple[Limits, Settings, UavRecord]:
    return load_limits(config_path('limits.json')), load_settings(), load_uav_record()


def test_every_figure_exceeds_its_limit_by_fifteen_percent() -> None:
    limits, record = load_limits(config_path('limits.json')), load_uav_record()
    assert record.speed_mps >= 1.15 * limits.uav_speed_max_mps
    assert record.climb_mps >= 1.15 * limits.uav_climb_max_mps
    assert record.descent_mps >= 1.15 * limits.uav_descent_max_mps
    assert record.hover_s >= 1.15 * limits.uav_endurance_s
    assert record.reach_sight_m >= limits.link_range_sight_m
    assert record.reach_blocked_m >= limits.link_range_blocked_m


def test_faster_means_longer_stops_wider_turns_and_more_lag() -> None:
    record = load_uav_record()
    for figures in (
        [row.distance_m for row in record.braking],
        [row.overshoot_m for row in record.turns],
        [row.lag_m for row in record.lags],
        [row.drift_m for row in record.drifts],
    ):
        assert figures == sorted(figures)
        assert len(figures) > 2


def test_the_shipped_motion_is_within_what_was_measured() -> None:
    limits, settings, record = _shipped()
    assert possible_limits(limits, record) == limits
    assert possible_settings(settings, limits, record) == settings


@pytest.mark.parametrize(
    ('measured', 'planned', 'value'),
    [
        ('speed_mps', 'speed_max_mps', 7.0),
        ('climb_mps', 'climb_mps', 1.5),
        ('descent_mps', 'descent_mps', 1.0),
        ('acceleration_mps2', 'acceleration_mps2', 2.0),
    ],
)
def test_a_weaker_vehicle_is_planned_to_do_less(measured: str, planned: str, value: float) -> None:
    limits, settings, shipped = _shipped()
    record = UavRecord.model_validate(shipped.model_dump() | {measured: value})
    flight, weaker = settings.flight, within(settings.flight, limits, record)
    assert weaker.model_dump() == flight.model_dump() | {planned: getattr(weaker, planned)}
    assert 0.5 * value < getattr(weaker, planned) <= value


@pytest.mark.parametrize(
    ('measured', 'limit', 'value', 'least'),
    [
        ('speed_mps', 'uav_speed_max_mps', 11.5, 10.0),
        ('climb_mps', 'uav_climb_max_mps', 2.3, 2.0),
        ('descent_mps', 'uav_descent_max_mps', 1.15, 1.0),
        ('reach_sight_m', 'link_range_sight_m', 320.5, 320.5),
        ('reach_blocked_m', 'link_range_blocked_m', 0.0, 0.0),
    ],
)
def test_no_limit_asks_for_more_than_the_vehicle_can_do(
    measured: str, limit: str, value: float, least: float
) -> None:
    limits, settings, shipped = _shipped()
    record = UavRecord.model_validate(shipped.model_dump() | {measured: value})
    possible = possible_limits(limits, record)
    assert possible.model_dump() == limits.model_dump() | {limit: least}
    # What is planned stays below the limit that the verdict will ask to be kept.
    assert within(settings.flight, limits, record).speed_max_mps < possible.uav_speed_max_mps


def test_no_flight_is_asked_to_last_longer_than_a_battery_did() -> None:
    limits, _, shipped = _shipped()
    rows = tuple(r.model_copy(update={'endurance_s': 1150.0}) for r in shipped.endurances)
    possible = possible_limits(limits, shipped.model_copy(update={'endurances': rows}))
    assert possible.model_dump() == limits.model_dump() | {'uav_endurance_s': 1000.0}


def test_a_battery_lasts_as_long_as_in_the_worst_flight_around() -> None:
    record = load_uav_record()
    known = {(r.speed_mps, r.mean_mps): r.endurance_s for r in record.endurances}
    speeds, winds = (sorted({key[part] for key in known}) for part in (0, 1))
    fast, faster, top = speeds
    for speed in speeds:
        assert record.endurance_s(speed, 0.0, 0.0) == known[speed, 0.0]
    between = (fast + faster) / 2.0
    assert record.endurance_s(between, 0.0, 0.0) == min(known[fast, 0.0], known[faster, 0.0])
    around = [known[top, wind] for wind in winds[:2]]
    assert record.endurance_s(top, winds[1] / 2.0, 0.0) == min(around)
    assert record.endurance_s(top + 1.0, 0.0, 0.0) == 0.0
    assert record.endurance_s(0.0, 99.0, 0.0) == 0.0


@pytest.mark.parametrize(('top_mps', 'target_mps'), [(9.5, 4.6), (7.0, 2.8), (3.0, 1.2)])
def test_targets_drive_no_faster_than_the_vehicle_keeps_up_with(
    top_mps: float, target_mps: float
) -> None:
    limits, settings, shipped = _shipped()
    slow = UavRecord.model_validate(shipped.model_dump() | {'speed_mps': top_mps})
    found = possible_settings(settings, limits, slow)
    planned_mps = found.flight.speed_max_mps
    assert target_mps - 0.5 < found.grounding.target_speed_mps <= target_mps
    assert found.grounding.target_speed_mps <= found.grounding.speeds.trackable_mps < planned_mps


def test_who_leaves_its_way_in_corners_keeps_farther_from_obstacles() -> None:
    limits, settings, shipped = _shipped()
    rows = tuple(row.model_copy(update={'overshoot_m': 6.0}) for row in shipped.turns)
    clumsy = shipped.model_copy(update={'turns': rows})
    drift_m = shipped.drift_m(6.0, 4.0)
    found = planned_clearance_m(settings, limits, clumsy)
    assert found == pytest.approx(limits.clearance_min_m + 6.0 + drift_m)
    assert planned_clearance_m(settings, limits, shipped) == settings.grounding.clearance_m


def test_a_wind_that_carries_it_away_widens_no_clearance() -> None:
    """Nothing would be placed in calm air for the sake of a storm that nobody asks for."""
    limits, settings, shipped = _shipped()
    rows = (*shipped.drifts, DriftRow(mean_mps=30.0, gust_mps=20.0, drift_m=900.0))
    blown = shipped.model_copy(update={'drifts': rows})
    for gust_mps in (18.0, 99.0):  # one that was measured, and one that was not
        stormy = Limits.model_validate(
            limits.model_dump()
            | {'wind_gust_mps': {**limits.wind_gust_mps, 'heavy_rain': gust_mps}}
        )
        assert planned_clearance_m(settings, stormy, blown) == settings.grounding.clearance_m


def test_figures_between_those_measured_are_of_the_next_one() -> None:
    _, _, record = _shipped()
    assert record.stop_m(7.0) == record.stop_m(10.0) > record.stop_m(5.0)
    assert record.stop_m(99.0) == record.braking[-1].distance_m
    assert record.drift_m(4.0, 1.0) == record.drift_m(6.0, 4.0)
    assert record.drift_m(99.0, 0.0) == float('inf')
    assert record.received_m(with_sight=True) > record.received_m(with_sight=False) > 0.0


def test_the_record_of_another_model_is_refused(config: Path) -> None:
    model = config / 'multirotor.json'
    model.write_text(model.read_text().replace('"mass_kg": 1.5', '"mass_kg": 2.5'))
    with pytest.raises(ConfigError, match='measured with multirotor_sha256') as caught:
        load_uav_record()
    assert caught.value.hint.startswith('measure again: aurora map measure downtown')


@pytest.mark.parametrize(
    ('change', 'named'),
    [
        (lambda t: t['multirotor'].update(climb_mps=0.0), 'climb_mps'),
        (lambda t: t['multirotor'].pop('braking'), 'braking'),
        (lambda t: t['multirotor']['endurances'].clear(), 'a hover in calm air'),
        (lambda t: t.pop('multirotor'), 'multirotor'),
        (lambda t: t.pop('made_of'), 'made_of'),
    ],
)
def test_a_bad_record_is_named(config: Path, change: Any, named: str) -> None:
    path = config.joinpath(*RECORDS)
    table = json.loads(path.read_text())
    change(table)
    path.write_text(json.dumps(table))
    with pytest.raises(ConfigError) as caught:
        load_uav_record()
    assert named in caught.value.message


def test_a_missing_record_names_the_command(config: Path) -> None:
    config.joinpath(*RECORDS).unlink()
    with pytest.raises(ConfigError) as caught:
        load_uav_record()
    assert 'aurora map measure downtown' in str(caught.value)
