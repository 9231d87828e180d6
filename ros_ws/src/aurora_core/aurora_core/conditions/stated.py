# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions that the prompt states itself: no tolerance, except that `==` needs one."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TypedDict

from aurora_core.conditions.stated_flight import FLIGHT_QUANTITIES, stated_flight
from aurora_core.conditions.stated_links import LINK_QUANTITIES, stated_link
from aurora_core.conditions.stated_values import (
    CannotSayError,
    missions_of,
    only,
    sentence_of,
    source_of,
    target_of,
    value_of,
)
from aurora_core.judging.build import Inputs, Target, Underivable, condition, number
from aurora_core.judging.mission import mission_arguments
from aurora_core.judging.quantities.altitude import Altitude
from aurora_core.judging.quantities.battery import Battery
from aurora_core.judging.quantities.clearance import Clearance
from aurora_core.judging.quantities.deceleration import HardestBraking
from aurora_core.judging.quantities.distance import Distance
from aurora_core.judging.quantities.event_time import EventTime
from aurora_core.judging.quantities.horizontal_distance import HorizontalDistance
from aurora_core.judging.quantities.hover_drift import HoverDrift
from aurora_core.judging.quantities.separation import Separation
from aurora_core.judging.quantities.speed import Speed, SpeedAfterMoving
from aurora_core.judging.quantities.time_headway import TimeHeadway
from aurora_core.judging.quantities.time_to_collision import TimeToCollision
from aurora_core.judging.quantities.tracked_fraction import TrackedFraction
from aurora_core.judging.quantities.vertical_speed import VerticalSpeed
from aurora_core.judging.quantities.visible_fraction import VisibleFraction
from aurora_core.judging.quantities.visible_time import VisibleTime
from aurora_core.judging.quantity import OfMission, OfSight, PerSample
from aurora_core.judging.series import StatedSeries
from aurora_core.outcomes.condition import Condition, MissionArguments, Window
from aurora_core.spec.parameter import Bound
from aurora_core.spec.quantity import OP_WORDS
from aurora_core.spec.scenario import (
    AgentAction,
    ScenarioSpec,
    StatedCondition,
    UavMission,
    is_place,
)
from aurora_core.spec.vocabulary import MissionMode

# Quantities with a value at every sample: the worst one, a stretch or a share counts.
_SERIES: dict[str, tuple[type[StatedSeries], int]] = {
    'distance': (Distance, 2),
    'horizontal_distance': (HorizontalDistance, 2),
    'separation': (Separation, 2),
    'altitude': (Altitude, 1),
    'speed': (Speed, 1),
    'clearance': (Clearance, 2),
    'battery': (Battery, 1),
    'vertical_speed': (VerticalSpeed, 1),
    'time_headway': (TimeHeadway, 2),
    'time_to_collision': (TimeToCollision, 2),
}
# Quantities of two on the ground, the one behind first.
_BEHIND = frozenset({'time_headway', 'time_to_collision'})
# Of these what is asked holds from take-off to touchdown, not in the missions alone.
_IN_THE_AIR = frozenset({'clearance', 'battery'})
# Quantities that are about mission phases, of one mode only where the third entry says so.
_PHASES: dict[str, tuple[type[OfMission] | type[OfSight], int, MissionMode | None]] = {
    'tracked_fraction': (TrackedFraction, 2, MissionMode.TRACK),
    'visible_fraction': (VisibleFraction, 2, None),
    'visible_time': (VisibleTime, 2, None),
    'hover_drift': (HoverDrift, 1, MissionMode.HOVER),
}
# What a place has, too.
_OF_PLACES = frozenset(
    {'distance', 'horizontal_distance', 'tracked_fraction', 'visible_fraction', 'visible_time'}
    | {'clearance'}
)
_BOUNDS = {'>=': Bound.AT_LEAST, '>': Bound.AT_LEAST, '<=': Bound.AT_MOST, '<': Bound.AT_MOST}


def stated_conditions(inputs: Inputs) -> Iterator[Condition | Underivable]:
    """Yield the conditions that the prompt states."""
    for stated in inputs.spec.conditions:
        try:
            made = tuple(_all(inputs, stated))
        except CannotSayError as reason:
            yield Underivable(element=stated.id, what=str(reason), span=stated.span)
        else:
            yield from made


def _all(inputs: Inputs, stated: StatedCondition) -> Iterator[Condition]:
    if stated.quantity in _SERIES:
        yield from _each(inputs, stated)
    elif stated.quantity in _PHASES:
        yield from _phases(inputs, stated)
    elif stated.quantity == 'deceleration':
        yield from _braking(inputs, stated)
    elif stated.quantity == 'event_time':
        yield _event_time(inputs, stated)
    elif stated.quantity in LINK_QUANTITIES:
        yield from stated_link(inputs, stated)
    elif stated.quantity in FLIGHT_QUANTITIES:
        yield from stated_flight(inputs, stated)
    else:
        raise _unknown(stated)


def _unknown(stated: StatedCondition) -> CannotSayError:
    return CannotSayError(f'condition on {stated.quantity} of {", ".join(stated.of)}')


def _bodies(inputs: Inputs, stated: StatedCondition, count: int) -> tuple[str, ...]:
    """Return whom a condition is about, a group by its members; only separation is about more."""
    of = stated.of
    apart = stated.quantity == 'separation'
    if apart and len(of) == 1:
        of = _members(inputs, of)
    # All pairs of a group can be so near, or so far, but hardly have one distance.
    group = apart and len(of) > count and stated.op != '=='
    if len(set(of)) != len(of) or (len(of) != count and not group):
        raise _unknown(stated)
    known = {a.id for a in inputs.spec.agents} | {u.id for u in inputs.spec.uavs}
    flown = stated.quantity in _IN_THE_AIR or stated.quantity == 'vertical_speed'
    if flown and of[0] not in {u.id for u in inputs.spec.uavs}:
        raise _unknown(stated)
    if stated.quantity in _BEHIND and not {*of} <= {a.id for a in inputs.spec.agents}:
        raise _unknown(stated)
    for name in of:
        if name not in known and not (is_place(name) and stated.quantity in _OF_PLACES):
            raise _unknown(stated)
    return of


@dataclass(frozen=True, slots=True, kw_only=True)
class _When:
    """The samples that a condition is about, as its arguments say it."""

    window: Window
    mission: MissionArguments | None = None
    missions: tuple[MissionArguments, ...] = ()

    @property
    def told(self) -> str:
        """When that is, where it is not all along: a UAV is on its way before and after."""
        where = {Window.PHASE: f' in {getattr(self.mission, "mission", "")}'}
        where[Window.ON_MISSION] = ' on mission'
        return f'{where[self.window]} from capture on' if self.window in where else ''


def _when(inputs: Inputs, stated: StatedCondition, missions: tuple[UavMission, ...]) -> _When:
    if stated.quantity in _IN_THE_AIR:
        return _When(window=Window.AIRBORNE)
    flown = tuple(mission_arguments(inputs, mission) for mission in missions)
    if len(flown) == 1:
        return _When(window=Window.PHASE, mission=flown[0])
    if flown:
        if stated.hold_s is not None:
            raise CannotSayError('a stretch over several missions')
        return _When(window=Window.ON_MISSION, mission=flown[0], missions=flown)
    flies = any(uav.id in stated.of for uav in inputs.spec.uavs)
    # What nobody limits to a flight holds all along, after the last landing, too.
    return _When(window=Window.AIRBORNE if flies else Window.RUN)


def _each(inputs: Inputs, stated: StatedCondition) -> Iterator[Condition]:
    """Yield what is asked of one body, or of each of several: all of them have to keep to it."""
    members = _members(inputs, stated.of)
    if _SERIES[stated.quantity][1] > 1 or len(members) == 1:
        yield _series(inputs, stated)
        return
    for name in members:
        own = stated.model_copy(update={'of': (name,)})
        yield _series(inputs, own, suffix=f'.{name}')


def _members(inputs: Inputs, of: tuple[str, ...]) -> tuple[str, ...]:
    """Return bodies with groups by their members, each once."""
    found = []
    for name in of:
        group = [agent.id for agent in inputs.spec.agents if agent.group == name]
        found += group or [name]
    return tuple(dict.fromkeys(found))


def _series(inputs: Inputs, stated: StatedCondition, suffix: str = '') -> Condition:
    kind, count = _SERIES[stated.quantity]
    of = _bodies(inputs, stated, count)
    target = target_of(inputs.tolerances, stated)
    if stated.fraction is not None:
        if stated.hold_s is not None or stated.by_s is not None:
            raise CannotSayError('a share together with a stretch or a deadline')
        when = _when(inputs, stated, missions_of(inputs, stated))
        return _share(inputs, stated, of, target, when, suffix)
    if _is_floor(inputs, stated):
        return _kept_speed(inputs, stated, of, target, suffix)
    if stated.quantity == 'time_headway' and _is_upper(stated):
        return _kept_headway(inputs, stated, of, target, suffix)
    # A deadline counts from scenario start, not from the phase.
    when = _When(window=Window.RUN)
    if stated.by_s is None:
        when = _when(inputs, stated, missions_of(inputs, stated))
    return condition(
        id=f'{stated.id}.holds{suffix}',
        sentence=f'{sentence_of(stated)}{when.told}',
        of=of,
        target=target,
        arguments=kind(
            **inputs.common, window=when.window, mission=when.mission, missions=when.missions
        ),
        source=source_of(stated),
        hold_s=value_of(stated.hold_s),
        by_s=value_of(stated.by_s),
    )


def _braking(inputs: Inputs, stated: StatedCondition) -> Iterator[Condition]:
    """Yield how hard each of some bodies on the ground brakes at its hardest."""
    only(stated)
    drivers = {agent.id for agent in inputs.spec.agents}
    for name in _members(inputs, stated.of):
        if name not in drivers:
            raise _unknown(stated)
        yield condition(
            id=f'{stated.id}.holds' + (f'.{name}' if (name,) != stated.of else ''),
            sentence=f'{name} brakes with {OP_WORDS[stated.op]} {number(stated.value.value)} '
            'm/s^2 at its hardest',
            of=(name,),
            target=target_of(inputs.tolerances, stated),
            arguments=HardestBraking(**inputs.common),
            source=source_of(stated),
            every_sample=False,
        )


def _is_floor(inputs: Inputs, stated: StatedCondition) -> bool:
    """Whether somebody on the ground is never to be slower: all stand at first."""
    grounded = {agent.id for agent in inputs.spec.agents}
    bounded = stated.hold_s is not None or stated.by_s is not None
    floor = stated.quantity == 'speed' and stated.op in ('>', '>=') and stated.value.value > 0.0
    return floor and not bounded and bool(grounded & set(stated.of))


def _is_upper(stated: StatedCondition) -> bool:
    """Whether somebody is never to be farther behind: nobody is near at a start."""
    return stated.op in ('<', '<=', '==') and stated.hold_s is None and stated.by_s is None


def _kept_headway(
    inputs: Inputs, stated: StatedCondition, of: tuple[str, ...], target: Target, suffix: str
) -> Condition:
    """Return that somebody on the move stays as close behind, once it has been."""
    first = PerSample(
        bound=_BOUNDS.get(stated.op, Bound.EXACTLY),
        wanted=stated.value.value,
        tolerance=target.tolerance or 0.0,
        strict=stated.op == '<',
    )
    return condition(
        id=f'{stated.id}.holds{suffix}',
        sentence=f'{sentence_of(stated)} while it moves, from when it is first so',
        of=of,
        target=target,
        arguments=TimeHeadway(**inputs.common, moving=True, first=first),
        source=source_of(stated),
    )


def _kept_speed(
    inputs: Inputs, stated: StatedCondition, of: tuple[str, ...], target: Target, suffix: str
) -> Condition:
    """Return that somebody is not slower any more once it has been as fast."""
    return condition(
        id=f'{stated.id}.holds{suffix}',
        sentence=f'{sentence_of(stated)} from when it is first driven on',
        of=of,
        target=target,
        arguments=SpeedAfterMoving(**inputs.common, moving_mps=stated.value.value),
        source=source_of(stated),
    )


def _share(
    inputs: Inputs,
    stated: StatedCondition,
    of: tuple[str, ...],
    target: Target,
    when: _When,
    suffix: str,
) -> Condition:
    assert stated.fraction is not None
    fraction = stated.fraction.value
    return condition(
        id=f'{stated.id}.share{suffix}',
        sentence=f'{sentence_of(stated)} for {number(100 * fraction)} % of the time',
        signal=f'{stated.quantity}_share({",".join(of)})',
        of=of,
        target=Target(op='>=', threshold=fraction, unit='1'),
        fraction=fraction,
        arguments=_SERIES[stated.quantity][0](
            **inputs.common,
            window=when.window,
            mission=when.mission,
            missions=when.missions,
            share=PerSample(
                bound=_BOUNDS.get(stated.op, Bound.EXACTLY),
                wanted=stated.value.value,
                tolerance=target.tolerance or 0.0,
                strict=stated.op in ('<', '>'),
            ),
        ),
        source=source_of(stated),
        every_sample=False,
    )


class _AboutMissions(TypedDict):
    horizon_s: float
    touchdown_m: float
    window: Window
    mission: MissionArguments | None
    missions: tuple[MissionArguments, ...]


def _phases(inputs: Inputs, stated: StatedCondition) -> Iterator[Condition]:
    """Yield one condition per mission; the time of sight is summed up over all of them."""
    kind, count, mode = _PHASES[stated.quantity]
    of = _bodies(inputs, stated, count)
    missions = missions_of(inputs, stated, mode)
    looks = issubclass(kind, OfSight) and of[0] in {agent.id for agent in inputs.spec.agents}
    if not missions and not looks:
        raise CannotSayError(f'{stated.quantity} without a mission of {", ".join(stated.of)}')
    if kind is VisibleTime:
        only(stated, 'hold_s')
        parts = [(f'{stated.id}.holds', missions)]
    elif not missions:
        only(stated)
        parts = [(f'{stated.id}.holds', missions)]
    else:
        only(stated)
        parts = [(f'{stated.id}.holds.{m.id}', (m,)) for m in missions]
        if len(missions) == 1:
            parts = [(f'{stated.id}.holds', missions)]
    for name, group in parts:
        when = _when(inputs, stated, group)
        about: _AboutMissions = {
            **inputs.common,
            'window': when.window,
            'mission': when.mission,
            'missions': when.missions,
        }
        arguments: OfMission | OfSight
        if kind is VisibleTime:
            # With a stretch it is the longest one without a gap that counts.
            arguments = VisibleTime(**about, unbroken=stated.hold_s is not None)
        else:
            arguments = kind.model_validate(about)
        yield condition(
            id=name,
            sentence=sentence_of(stated),
            of=of,
            target=_stretched(target_of(inputs.tolerances, stated), stated),
            arguments=arguments,
            source=source_of(stated),
            every_sample=kind is HoverDrift,
        )


def _stretched(target: Target, stated: StatedCondition) -> Target:
    """Return the comparison of a time of sight: a stretch that is to be longer counts instead."""
    if stated.hold_s is None or target.op not in ('>=', '>'):
        return target
    return replace(target, threshold=max(target.threshold, stated.hold_s.value))


def _stops(spec: ScenarioSpec, name: str) -> bool:
    """Tell whether an event makes somebody stop, who slows down for other reasons, too."""
    actions = [event.action for event in spec.events if event.id == name]
    return any(isinstance(a, AgentAction) and a.do == 'stop' for a in actions)


def _event_time(inputs: Inputs, stated: StatedCondition) -> Condition:
    only(stated)
    if len(stated.of) != 1 or stated.of[0] not in {event.id for event in inputs.spec.events}:
        raise _unknown(stated)
    target = target_of(inputs.tolerances, stated)
    return condition(
        id=f'{stated.id}.holds',
        sentence=sentence_of(stated),
        of=stated.of,
        target=target,
        arguments=EventTime(
            **inputs.of_event(stated.of[0]),
            part='action',
            done=target.op in ('<', '<=') and _stops(inputs.spec, stated.of[0]),
        ),
        source=source_of(stated),
        every_sample=False,
    )
