# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Phases of a flight, from recorded commands and states.

Commands say when a phase is left (PHASE column: ascent, mission k, landing); states say when the
ascent has ended, when the mission has captured, when the UAV is down. A phase ends at the tick of
the first command of the next one; sample k was flown under command k, so the samples of a phase
are those from capture up to before that tick.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from aurora_core.quantities.kernels import TrackRule, distance_2d, track_errors
from aurora_core.quantities.motion import horizontal_speed, on_ground
from aurora_core.quantities.ticks import first_tick, last_tick
from aurora_core.quantities.view import Body, RunView
from aurora_core.trace.layout import UavColumn, UavCommandColumn, UavPhase

BoolArray = npt.NDArray[np.bool_]
FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class RestRule:
    """Where a UAV holds that hovers where it is: where it comes to rest.

    That is the point of the first sample of the phase at which it is slower over ground than
    `speed_mps`. It has to be within the way that braking takes of where the phase began: v^2 /
    (2 `braking_mps2`) for a speed of v at its first sample, and `off_m` more. Who leaves that
    circle before does not stay: where it was when the phase began is the point then.

    Attributes:
        speed_mps: Slower than that it is at rest.
        braking_mps2: Deceleration at least.
        off_m: How far a UAV may be from its set-point.
    """

    speed_mps: float
    braking_mps2: float
    off_m: float


@dataclass(frozen=True, slots=True, kw_only=True)
class CaptureRule:
    """When a mission has captured: tolerance on altitude, and on a point or a tracked target.

    Attributes:
        altitude_m: Wanted altitude above ground.
        altitude_tolerance_m: Tolerance on it.
        horizontal_tolerance_m: Tolerance on the distance from `point_m` (not used by `track`).
        point_m: Hover: the hover point; navigate: the first waypoint.
        track: Track: the tracking tolerance; then `target` is set.
        target: Body that is tracked.
        rest: Hover without a point: what is its point.
    """

    altitude_m: float
    altitude_tolerance_m: float
    horizontal_tolerance_m: float = 0.0
    point_m: tuple[float, float] | None = None
    track: TrackRule | None = None
    target: str | None = None
    rest: RestRule | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class FlightPhases:
    """Ticks at which the flight of one UAV changes; None where it never did.

    Attributes:
        takeoff_tick: First command of the ascent.
        ascent_end_tick: First sample inside the altitude tolerance of the first mission.
        landing_tick: First command of the landing phase.
        over_tick: First command after the missions: of the landing, or of the hold to the end.
        landed_tick: First sample on the ground after it.
    """

    takeoff_tick: int | None
    ascent_end_tick: int | None
    landing_tick: int | None
    over_tick: int | None
    landed_tick: int | None


@dataclass(frozen=True, slots=True, kw_only=True)
class MissionPhase:
    """One mission of a UAV.

    Attributes:
        command_tick: First command of the mission.
        ready_tick: From when on it can capture: end of the ascent, or `command_tick` of a later
            mission.
        capture_tick: First sample inside the phase's tolerance.
        end_tick: First command of the next phase; None while the mission lasts.
        stop_tick: `end_tick`, or the end of the trace.
        point_m: Hover, navigate: the hover point or the first waypoint; where it came to rest.
    """

    command_tick: int | None
    ready_tick: int | None
    capture_tick: int | None
    end_tick: int | None
    stop_tick: int
    point_m: tuple[float, float] | None = None


def flight_phases(
    view: RunView, uav: Body, first_altitude_m: float, tolerance_m: float, touchdown_m: float
) -> FlightPhases:
    """Return the phases of a flight.

    Args:
        view: The run.
        uav: Which UAV.
        first_altitude_m: Altitude of its first mission.
        tolerance_m: Tolerance on it that ends the ascent.
        touchdown_m: Height below which a UAV that reports landed is down.
    """
    phase = view.commands(uav)[:, UavCommandColumn.PHASE]
    takeoff = first_tick(phase == UavPhase.ASCENT)
    ascent_end = None
    if takeoff is not None:
        z = view.rows(uav)[:, UavColumn.Z]
        ascent_end = first_tick(np.abs(z - first_altitude_m) <= tolerance_m, takeoff)
    landing = first_tick(phase == UavPhase.LANDING)
    landed = None
    if landing is not None:
        landed = first_tick(on_ground(view, uav, touchdown_m), landing)
    return FlightPhases(
        takeoff_tick=takeoff,
        ascent_end_tick=ascent_end,
        landing_tick=landing,
        over_tick=_over_tick(phase),
        landed_tick=landed,
    )


def _over_tick(phase: FloatArray) -> int | None:
    """Return the tick from which on a UAV lands, or holds its place to the end of the run."""
    landing = first_tick(phase == UavPhase.LANDING)
    if landing is not None or len(phase) == 0 or phase[-1] != UavPhase.HOLDING:
        return landing
    flown = last_tick(phase != UavPhase.HOLDING)
    return 0 if flown is None else flown + 1


def mission_phase(
    view: RunView,
    uav: Body,
    index: int,
    flight: FlightPhases,
    rule: CaptureRule,
    point: FloatArray | None = None,
) -> MissionPhase:
    """Return the phase of the `index`-th mission of a UAV (from 0).

    Args:
        view: The run.
        uav: Which UAV.
        index: Of the mission.
        flight: The phases of its flight.
        rule: When the mission has captured.
        point: (T, 3) where the UAV is, as its mission counts heights; default: as recorded.
    """
    phase = view.commands(uav)[:, UavCommandColumn.PHASE]
    wanted = UavPhase.MISSION + index
    command = first_tick(phase == wanted)
    end = None if command is None else first_tick(phase != wanted, command)
    stop = view.ticks if end is None else end
    ready = flight.ascent_end_tick if index == 0 else command
    capture, begin, held = None, ready, rule.point_m
    if rule.rest is not None and command is not None:
        begin, held = _at_rest(view, uav, rule.rest, command, stop)
        rule = replace(rule, point_m=held)
    if command is not None and begin is not None:
        capture = first_tick(captured(view, uav, rule, point), begin, stop)
    return MissionPhase(
        command_tick=command,
        ready_tick=ready,
        capture_tick=capture,
        end_tick=end,
        stop_tick=stop,
        point_m=held,
    )


def _at_rest(
    view: RunView, uav: Body, rule: RestRule, first: int, stop: int
) -> tuple[int | None, tuple[float, float] | None]:
    """Return from when on a UAV stays where it is, and where that is; None as long as it brakes.

    Args:
        view: The run.
        uav: Which UAV.
        rule: When it is at rest.
        first: First sample of the phase.
        stop: First sample after it.
    """
    xy, speed = (
        view.reference(uav.body_id)[first:stop, :2],
        horizontal_speed(view, uav)[first:stop],
    )
    if len(xy) == 0:
        return None, None
    away_m = distance_2d(xy[:, 0] - xy[0, 0], xy[:, 1] - xy[0, 1])
    reach_m = speed[0] * speed[0] / (2.0 * rule.braking_mps2) + rule.off_m
    over = first_tick((speed < rule.speed_mps) | (away_m > reach_m))
    if over is None:
        return None, None
    at = over if away_m[over] <= reach_m else 0
    return first + at, (float(xy[at, 0]), float(xy[at, 1]))


def captured(
    view: RunView, uav: Body, rule: CaptureRule, point: FloatArray | None = None
) -> BoolArray:
    """Return where a UAV is inside the tolerance of its mission."""
    point = view.reference(uav.body_id) if point is None else point
    if rule.track is not None and rule.target is not None:
        horizontal, vertical = tracking_errors(view, uav, rule.target, rule.track, point)
        ok = (horizontal <= rule.track.horizontal_m) & (vertical <= rule.track.vertical_m)
        ok &= view.present(rule.target)
    else:
        x, y = rule.point_m if rule.point_m is not None else (0.0, 0.0)
        off = distance_2d(point[:, 0] - x, point[:, 1] - y)
        ok = off <= rule.horizontal_tolerance_m
    inside: BoolArray = ok & (np.abs(point[:, 2] - rule.altitude_m) <= rule.altitude_tolerance_m)
    return inside


def tracking_errors(
    view: RunView, uav: Body, target: str, rule: TrackRule, point: FloatArray | None = None
) -> tuple[FloatArray, FloatArray]:
    """Return horizontal and altitude error of a tracking UAV, (T,) metres each."""
    point = view.reference(uav.body_id) if point is None else point
    away = point - view.reference(target)
    return track_errors(rule, away[:, 0], away[:, 1], point[:, 2])


def tracked(
    view: RunView, uav: Body, target: str, rule: TrackRule, point: FloatArray | None = None
) -> BoolArray:
    """Return where a UAV tracks its target (never while the target is absent)."""
    horizontal, vertical = tracking_errors(view, uav, target, rule, point)
    ok = (horizontal <= rule.horizontal_m) & (vertical <= rule.vertical_m)
    result: BoolArray = ok & view.present(target)
    return result


def missions_end_tick(view: RunView) -> int:
    """Return the tick at which the last mission of all UAVs ends, the trace's end while one lasts.

    Without UAVs that is the end of the trace.
    """
    ends = []
    for uav in view.uavs:
        over = _over_tick(view.commands(uav)[:, UavCommandColumn.PHASE])
        ends.append(view.ticks if over is None else over)
    return max(ends, default=view.ticks)
