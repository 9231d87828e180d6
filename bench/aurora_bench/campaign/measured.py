# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How well what was executed keeps its times, its missions and its links: measured, not judged."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import shapely
from pydantic import FiniteFloat

from aurora_core.document import Document
from aurora_core.judging.evaluation import Context, FloatArray
from aurora_core.outcomes.condition import MissionArguments
from aurora_core.pipeline.verification import Judged
from aurora_core.quantities.phases import tracked, tracking_errors
from aurora_core.spec.scenario import TimeTrigger
from aurora_core.spec.vocabulary import MissionMode
from aurora_core.trace.records import ScenarioEventKind


class Flown(Document):
    """One mission as it was flown.

    Attributes:
        mode: Of the mission.
        capture_s: From when it could capture to when it did; None: it never did.
        on_target: Share of its ticks after capture within the tolerance of tracking; None: it
            does not track.
        off_m: Median of the horizontal distances after capture from the way between its waypoints
            (navigate), from its hover point, or from its standoff (track).
        off_most_m: Greatest of them.
    """

    mode: str
    capture_s: FiniteFloat | None = None
    on_target: FiniteFloat | None = None
    off_m: FiniteFloat | None = None
    off_most_m: FiniteFloat | None = None


class Measured(Document):
    """One realisation.

    Attributes:
        missions: In the order of the request.
        event_s: Of each event that happened: its recorded moment minus the first at which the
            recorded states hold its trigger.
        stated_s: Of each event with a stated time: its moment minus that time.
        latency_s: Of each delivered message.
        sent: Messages.
    """

    missions: tuple[Flown, ...] = ()
    event_s: tuple[FiniteFloat, ...] = ()
    stated_s: tuple[FiniteFloat, ...] = ()
    latency_s: tuple[FiniteFloat, ...] = ()
    sent: int = 0


def measured(judged: Judged) -> Measured:
    """Return how a judged realisation came out."""
    context = judged.context
    messages = context.messages
    told = [m for m in messages if m.delivered_tick is not None]
    return Measured(
        missions=tuple(_flown(context, m) for m in context.mission_arguments),
        event_s=tuple(late for _, late in _events(context)),
        stated_s=tuple(_stated(context)),
        latency_s=tuple(
            context.time_s(m.delivered_tick - m.sent_tick)
            for m in told
            if m.delivered_tick is not None
        ),
        sent=len(messages),
    )


def _events(context: Context) -> Iterator[tuple[str, float]]:
    """Yield events that were recorded as happening, with how late (s) that was."""
    for record in context.view.trace.events:
        if record.kind is ScenarioEventKind.TRIGGERED:
            tick = context.events.trigger_tick(record.subject)
            if tick is not None:
                yield record.subject, context.time_s(record.tick - tick)


def _stated(context: Context) -> Iterator[float]:
    """Yield how late (s) events with a stated time were recorded."""
    wanted = {e.id: e.trigger for e in context.spec.events}
    for record in context.view.trace.events:
        trigger = wanted.get(record.subject)
        if record.kind is ScenarioEventKind.TRIGGERED and isinstance(trigger, TimeTrigger):
            yield context.time_s(record.tick) - trigger.at_s.value


def _flown(context: Context, mission: MissionArguments) -> Flown:
    touchdown_m = context.conditions[0].arguments.touchdown_m
    phase = context.phase(mission, touchdown_m)
    mode = mission.mode.value
    if phase.capture_tick is None or phase.ready_tick is None:
        return Flown(mode=mode)
    capture_s = context.time_s(phase.capture_tick - phase.ready_tick)
    span = slice(phase.capture_tick, max(phase.capture_tick + 1, phase.stop_tick))
    off_m = _off_m(context, mission)[span]
    off_m = off_m[np.isfinite(off_m)]
    return Flown(
        mode=mode,
        capture_s=capture_s,
        on_target=_on_target(context, mission, span),
        off_m=float(np.median(off_m)) if len(off_m) else None,
        off_most_m=float(off_m.max()) if len(off_m) else None,
    )


def _off_m(context: Context, mission: MissionArguments) -> FloatArray:
    """Return (T,) horizontal metres off what a mission asks for; NaN where there is nothing."""
    view = context.view
    xy = view.reference(mission.uav)[:, :2]
    if mission.mode is MissionMode.TRACK:
        rule, target = mission.track_rule, mission.target
        if rule is None or target is None or not view.has(target):
            return np.full(view.ticks, np.nan)
        off_m, _ = tracking_errors(view, view.body(mission.uav), target, rule)
        return np.where(view.present(target), off_m, np.nan)
    if mission.mode is MissionMode.NAVIGATE and len(mission.waypoints) > 1:
        way = shapely.LineString([point[:2] for point in mission.waypoints])
        return np.asarray(shapely.distance(way, shapely.points(xy)), dtype=np.float64)
    if mission.point_m is None:
        return np.full(view.ticks, np.nan)
    return np.asarray(np.linalg.norm(xy - np.asarray(mission.point_m), axis=1))


def _on_target(context: Context, mission: MissionArguments, span: slice) -> float | None:
    rule = mission.track_rule
    if rule is None or mission.target is None or not context.view.has(mission.target):
        return None
    uav = context.view.body(mission.uav)
    good = tracked(context.view, uav, mission.target, rule, context.position(mission))[span]
    return float(np.mean(good))
