# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Margins that conditions would have on moved bodies, for all candidates at once.

Where a condition has a margin in the record, the estimate is that margin plus what the moved
bodies change; so what the model leaves out is in it as far as the record shows it. A condition
without a margin, because its event never happened, is estimated by how far inside its trigger the
bodies come, as a share of the trigger's distance.

None is said where there is no model: routes, signals and traffic that answers.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
import numpy.typing as npt

from aurora_core.errors import VerificationError
from aurora_core.judging.evaluation import Context, Missing
from aurora_core.judging.quantities.follow_fraction import FollowFraction
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.outcomes.verdict import ConditionResult
from aurora_core.quantities import motion
from aurora_core.quantities.kernels import bound_error
from aurora_core.quantities.routes import along_route
from aurora_core.quantities.sight import sight_of
from aurora_core.repair.surrogate.moved import Moved
from aurora_core.spec.quantity import QuantityName as Q
from aurora_core.spec.scenario import DistanceTrigger
from aurora_core.stl.formula import Always, Eventually, Predicate
from aurora_core.stl.syntax import parse_formula
from aurora_core.trace.layout import GroundColumn

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]
IndexArray = npt.NDArray[np.intp]

# So many samples of a line of sight are looked at per candidate; a building is not missed by much.
_SIGHT_SAMPLES = 24
# What is far above or below everything is as good as this (normalised).
_MOST = 1000.0


class Margins:
    """Estimates for one recorded run.

    Args:
        context: The run, its request and all conditions.
        results: What the record says of them, by id.
    """

    def __init__(self, context: Context, results: Mapping[str, ConditionResult]) -> None:
        self._context = context
        self._results = results

    def of(self, condition: Condition, moved: Moved) -> FloatArray | None:
        """Return (C,) normalised margins of a condition, None where there is no model.

        Args:
            condition: One of the conditions of the run.
            moved: The bodies under the candidates.
        """
        recorded = self._results[condition.id].normalised
        happens = self._happens(condition, moved)
        if happens is not None and recorded is None:
            return happens
        measure = _MODELS.get(condition.quantity)
        change = None if measure is None else measure(self, condition, moved)
        if recorded is None:
            return None
        estimate = np.full(moved.candidates.number, recorded)
        if change is not None:
            estimate = estimate + np.clip(change, -_MOST, _MOST)
        elif happens is None and not self._stays(condition, moved):
            return None
        if happens is not None:
            estimate = np.where(happens < 0.0, np.minimum(estimate, happens), estimate)
        return estimate

    def _stays(self, condition: Condition, moved: Moved) -> bool:
        """Tell whether no candidate touches what a condition is about."""
        if condition.quantity is Q.PLACEMENT:
            view = self._context.view
            return not any(moved.moves(name) for name in condition.of if view.has(name))
        return condition.quantity in _UNMOVED

    def _happens(self, condition: Condition, moved: Moved) -> FloatArray | None:
        """Return how far inside the trigger of its event a condition's bodies come, (C,)."""
        spec = self._context.spec
        asked = condition.arguments.event
        event = next((e for e in spec.events if e.id == asked), None)
        if event is None or not isinstance(event.trigger, DistanceTrigger):
            return None
        trigger = event.trigger
        apart = moved.distance(trigger.a, trigger.b)
        reach_m = max(trigger.value_m.value, 1.0)
        view = self._context.view
        there = (view.present(trigger.a) & view.present(trigger.b))[moved.ticks]
        if not there.any():
            return None
        if trigger.on == 'distance_below':
            inside = (reach_m - apart[:, there].min(axis=1)) / reach_m
        else:
            inside = (apart[:, there].max(axis=1) - reach_m) / reach_m
        return np.broadcast_to(inside, moved.candidates.number)

    def _window(self, condition: Condition, moved: Moved) -> tuple[BoolArray, BoolArray] | None:
        """Return which samples are in the window of a condition: (C, S) or (1, S), and (1, S).

        The second one is as it was recorded; what happens in a flight that climbs higher is later.
        """
        arguments = condition.arguments
        if arguments.window is Window.MOMENT:
            return None
        try:
            window = self._context.window(condition)
        except VerificationError:
            return None
        if isinstance(window, Missing):
            return None
        recorded = np.isin(moved.ticks, window)
        if not recorded.any():
            return None
        own = next(
            (m.uav for m in (arguments.mission, *arguments.missions) if m is not None), None
        )
        uavs = [body.body_id for body in self._context.view.uavs]
        if own is None and arguments.window is Window.MISSIONS and len(uavs) == 1:
            own = uavs[0]
        when = None if own is None else moved.when(own)
        if when is None or arguments.window in (Window.RUN, Window.START):
            return recorded[None], recorded[None]
        later = recorded[when]
        # A window that would lie beyond the end of the record is as it was.
        later = np.where(later.any(axis=1, keepdims=True), later, recorded[None])
        return later, recorded[None]

    def _series(
        self, condition: Condition, moved: Moved, values: FloatArray, recorded: FloatArray
    ) -> FloatArray | None:
        """Return what a signal over samples changes of a margin, (C,) normalised."""
        formula = parse_formula(condition.formula)
        if not isinstance(formula, Always | Eventually):
            return None
        if not isinstance(formula.operand, Predicate):
            return None
        windows = self._window(condition, moved)
        if windows is None:
            return None
        least = isinstance(formula, Always)
        ends: list[FloatArray] = []
        for part, inside in zip((values, recorded), windows, strict=True):
            slack = np.where(inside, _slack(condition, part), np.inf if least else -np.inf)
            ends.append(slack.min(axis=1) if least else slack.max(axis=1))
        change: FloatArray = (ends[0] - ends[1]) / condition.scale
        return change

    def apart(self, condition: Condition, moved: Moved) -> FloatArray | None:
        """Model of distances between two bodies."""
        if len(condition.of) != 2 or getattr(condition.arguments, 'share', None) is not None:
            return None
        flat = condition.quantity is Q.HORIZONTAL_DISTANCE
        a, b = condition.of
        recorded = _recorded(self._context, moved, a, b, flat=flat)
        return self._series(condition, moved, moved.distance(a, b, flat=flat), recorded)

    def level(self, condition: Condition, moved: Moved) -> FloatArray | None:
        """Model of heights that are not to be left, whatever is flown at."""
        bounded = condition.op in ('<', '<=', '>', '>=')
        if not bounded or len(condition.of) != 1 or not self._context.view.has(condition.of[0]):
            return None
        [uav] = condition.of
        recorded = self._context.view.reference(uav)[moved.ticks, 2][None]
        return self._series(condition, moved, moved.position(uav)[2], recorded)

    def separated(self, condition: Condition, moved: Moved) -> FloatArray | None:
        """Model of the least distance of UAVs from each other."""
        names = [body.body_id for body in self._context.view.uavs]
        pairs = [(a, b) for k, a in enumerate(names) for b in names[k + 1 :]]
        if not pairs:
            return None
        values = np.minimum.reduce([_wide(moved.distance(a, b), moved) for a, b in pairs])
        recorded = np.minimum.reduce([_recorded(self._context, moved, a, b) for a, b in pairs])
        return self._series(condition, moved, values, recorded)

    def clear(self, condition: Condition, moved: Moved) -> FloatArray | None:
        """Model of the distance of UAVs from vehicles and persons: from their tops and sides."""
        view = self._context.view
        uavs = [body.body_id for body in view.uavs if body.body_id in condition.of]
        parts: list[FloatArray] = []
        records: list[FloatArray] = []
        for uav in uavs:
            for body in view.agents:
                radius = body.entry.width_m / 2.0
                name, top = body.body_id, body.entry.height_m
                flat = _recorded(self._context, moved, uav, name, flat=True)
                height = view.reference(uav)[moved.ticks, 2][None]
                gone = ~view.present(name)[moved.ticks]
                for found, away, up in (
                    (parts, moved.distance(uav, name, flat=True), moved.position(uav)[2]),
                    (records, flat, height),
                ):
                    off = np.maximum(away - radius, 0.0)
                    gap = np.sqrt(off**2 + np.maximum(up - top, 0.0) ** 2)
                    found.append(_wide(np.where(gone, 1e3, gap), moved))
        if not parts:
            return None
        values, recorded = np.minimum.reduce(parts), np.minimum.reduce(records)
        # Buildings are as far as they were: rising is taken to be no nearer to them.
        return self._series(condition, moved, values, recorded)

    def tracked(self, condition: Condition, moved: Moved) -> FloatArray | None:
        """Model of the share of a mission that a UAV keeps its distance from its target."""
        mission = condition.arguments.mission
        windows = self._window(condition, moved)
        if mission is None or mission.target is None or windows is None:
            return None
        rule = mission.track_rule
        if rule is None:
            return None
        shares = []
        view = self._context.view
        up = view.reference(mission.uav)[moved.ticks, 2][None]
        flat = _recorded(self._context, moved, mission.uav, mission.target, flat=True)
        moved_m = moved.distance(mission.uav, mission.target, flat=True)
        zero = np.zeros(1)
        lift, out = moved.altitude(mission.mission), moved.standoff(mission.mission)
        for away, height, more_m, more_up, inside in (
            (moved_m, moved.position(mission.uav)[2], out, lift, windows[0]),
            (flat, up, None, None, windows[1]),
        ):
            more_m = zero if more_m is None else more_m
            more_up = zero if more_up is None else more_up
            near = bound_error(away - more_m[:, None], rule.standoff_m, rule.standoff_bound)
            level = bound_error(height - more_up[:, None], rule.altitude_m, rule.altitude_bound)
            good = (near <= rule.horizontal_m) & (level <= rule.vertical_m)
            shares.append(_share(good, inside))
        return (shares[0] - shares[1]) / condition.scale

    def followed(self, condition: Condition, moved: Moved) -> FloatArray | None:
        """Model of the share of the time with a gap inside its limits."""
        asked = condition.arguments
        if not isinstance(asked, FollowFraction):
            return None
        a, b = condition.of
        windows = self._window(condition, moved)
        back = moved.along(a)
        if windows is None or back is None:
            return None
        view = self._context.view
        inside = windows[1] & (moved.ticks * view.dt_s >= asked.after_s)
        if not inside.any():
            return None
        along = along_route(view, view.body(a), view.body(b))
        gap = along.gap_m[moved.ticks][None]
        moving = motion.speed(view, view.body(a))[moved.ticks] > asked.slow_mps
        low = np.where(moving, asked.low_m, asked.slow_low_m)
        high = np.where(moving, asked.high_m, asked.slow_high_m)
        on_way = along.offset_m[moved.ticks] <= asked.offset_m
        shares = [
            _share((part >= low) & (part <= high) & on_way, inside) for part in (gap + back, gap)
        ]
        return (shares[0] - shares[1]) / condition.scale

    def seen(self, condition: Condition, moved: Moved) -> FloatArray | None:
        """Model of how much of the time, or for how long, a body is seen."""
        windows = self._window(condition, moved)
        view = self._context.view
        if windows is None or len(condition.of) != 2 or not view.has(condition.of[1]):
            return None
        step = max(1, int(windows[1].sum()) // _SIGHT_SAMPLES)
        samples = np.arange(0, len(moved.ticks), step, dtype=np.intp)
        shares = [
            _share(self._visible(*condition.of, moved, samples, as_is), inside[:, samples])
            for as_is, inside in zip((False, True), windows, strict=True)
        ]
        if condition.quantity is Q.VISIBLE_FRACTION:
            return (shares[0] - shares[1]) / condition.scale
        lasts_s = float(windows[1].sum() * np.diff(moved.ticks[:2])[0] * view.dt_s)
        return (shares[0] - shares[1]) * lasts_s / condition.scale

    def _visible(
        self, observer: str, target: str, moved: Moved, samples: IndexArray, as_is: bool
    ) -> BoolArray:
        """Return at which samples a target is seen, (C, samples) or (1, samples)."""
        view = self._context.view
        ticks = moved.ticks[samples]
        eye, point = view.eye_point(observer)[ticks], view.sight_point(target)[ticks]
        ends = []
        for name, base in ((observer, eye), (target, point)):
            if as_is or not moved.moves(name):
                ends.append(base[None])
                continue
            recorded = view.reference(name)[ticks]
            shift = np.stack(
                [
                    _wide(part, moved)[:, samples] - recorded[:, k]
                    for k, part in enumerate(moved.position(name))
                ],
                axis=-1,
            )
            ends.append(base[None] + shift)
        number = max(len(end) for end in ends)
        size = number * len(samples)
        lines = [np.broadcast_to(e, (number, len(samples), 3)).reshape(size, 3) for e in ends]
        rows = frozenset(view.body(n).row for n in (observer, target) if not view.body(n).is_uav)
        # Buildings and range only: other vehicles hide a target for moments.
        none = np.zeros((size, 0, len(GroundColumn)))
        there = np.tile((view.present(observer) & view.present(target))[ticks], number)
        sight = sight_of(view.geometry, lines[0], lines[1], none, (), rows, there)
        return sight.visible.reshape(number, -1)

    def caught(self, condition: Condition, moved: Moved) -> FloatArray | None:
        """Model of the time to capture: the way down or up takes its time, at what is seen."""
        mission = condition.arguments.mission
        if mission is None:
            return None
        out = moved.standoff(mission.mission)
        speeds = motion.horizontal_speed(self._context.view, self._context.view.body(mission.uav))
        fastest = max(1.0, float(speeds.max()))
        if out is None:
            return np.zeros(moved.candidates.number)
        return -np.maximum(np.abs(out), 0.0) / fastest / condition.scale

    def in_range(self, condition: Condition, moved: Moved) -> FloatArray | None:
        """Model of the distance over which messages are sent."""
        if len(condition.of) != 2:
            return None
        a, b = condition.of
        farther = moved.distance(a, b) - _recorded(self._context, moved, a, b)
        change: FloatArray = -farther.max(axis=1) / condition.scale
        return change


_Model = Callable[[Margins, Condition, Moved], FloatArray | None]

_MODELS: Mapping[Q, _Model] = {
    Q.DISTANCE: Margins.apart,
    Q.HORIZONTAL_DISTANCE: Margins.apart,
    Q.ALTITUDE: Margins.level,
    Q.SEPARATION: Margins.separated,
    Q.OBSTACLE_CLEARANCE: Margins.clear,
    Q.COLLISION_CLEARANCE: Margins.clear,
    Q.TRACKED_FRACTION: Margins.tracked,
    Q.FOLLOW_FRACTION: Margins.followed,
    Q.VISIBLE_FRACTION: Margins.seen,
    Q.VISIBLE_TIME: Margins.seen,
    Q.CAPTURE_TIME: Margins.caught,
    Q.LINK_RANGE: Margins.in_range,
}

# What an edit of altitude, standoff or gap does not touch: it is asked for as it is realised.
_UNMOVED = frozenset(
    {
        Q.ALTITUDE,
        Q.ALTITUDE_FRACTION,
        Q.HOVER_DRIFT,
        Q.WIND,
        Q.WORLD_SETTING,
        Q.PRESENCE,
        Q.JUMP,
        Q.COUNT,
        Q.PHASE_DURATION,
    }
)


def _share(good: BoolArray, inside: BoolArray) -> FloatArray:
    """Return the share of the samples inside a window that are good, (C,) or (1,)."""
    found: FloatArray = (good & inside).sum(axis=1) / np.maximum(inside.sum(axis=1), 1)
    return found


def _wide(values: FloatArray, moved: Moved) -> FloatArray:
    """Return values for every candidate."""
    return np.broadcast_to(values, (moved.candidates.number, values.shape[1]))


def _recorded(context: Context, moved: Moved, a: str, b: str, *, flat: bool = False) -> FloatArray:
    """Return the recorded distance of two bodies, (1, S) metres."""
    of = motion.horizontal_distance if flat else motion.distance
    found: FloatArray = of(context.view, a, b)[moved.ticks][None]
    return found


def _slack(condition: Condition, values: FloatArray) -> FloatArray:
    """Return how far values are on the right side of a threshold."""
    if condition.op in ('>=', '>'):
        return values - condition.threshold
    if condition.op in ('<=', '<'):
        return condition.threshold - values
    return (condition.tolerance or 0.0) - np.abs(values - condition.threshold)
