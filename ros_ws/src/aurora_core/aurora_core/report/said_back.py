# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The request said back: each element in one plain sentence, what was assumed set apart.

Whoever reads them sees what will be run, and where it is not what was meant, before a run and
without knowing the specification. A number of an element never goes unsaid: what no phrase of its
own says stands behind it with its name.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from aurora_core.document import Document
from aurora_core.spec.events import (
    AgentAction,
    AltitudeTrigger,
    ArrivalTrigger,
    BatteryTrigger,
    BehaviorDoneTrigger,
    DistanceTrigger,
    Event,
    EventAction,
    EventDoneTrigger,
    HeadwayTrigger,
    MessageTrigger,
    MissionDoneTrigger,
    SendMessage,
    SpeedTrigger,
    TimeTrigger,
    Trigger,
    UavAction,
    VisibilityTrigger,
)
from aurora_core.spec.flight_order import begins_where_it_is, stays_where_it_is
from aurora_core.spec.parameter import Bound, Parameter, Provenance, Unit
from aurora_core.spec.parking import parks
from aurora_core.spec.prohibitions import (
    ForbiddenAgent,
    ForbiddenBehavior,
    ForbiddenCondition,
    ForbiddenEvent,
    ForbiddenLink,
    ForbiddenMission,
    ForbiddenOrder,
    ForbiddenPlacement,
    ForbiddenWorld,
    Prohibition,
)
from aurora_core.spec.quantity import IN_PERCENT, OP_WORDS, SHARE_VERBS, QuantityName
from aurora_core.spec.reference import is_place
from aurora_core.spec.requirements import Order, SceneCount, StatedCondition
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.scene import Behavior, GroundAgent, Link, Placement, UavMission, World
from aurora_core.spec.vocabulary import (
    AgentType,
    BehaviorKind,
    LaneSide,
    MissionMode,
    Place,
    Relation,
    Role,
)


class ElementReport(Document):
    """One element of the request as a sentence.

    Attributes:
        id: Of the element, as clauses and conditions quote it.
        text: What it says.
        assumed: What the prompt leaves open and was chosen for it; '' for nothing.
    """

    id: str
    text: str
    assumed: str = ''


def said_back(spec: ScenarioSpec) -> tuple[ElementReport, ...]:
    """Return the request in the order world, bodies, flights, events, conditions."""
    return (
        _world(spec.world),
        *map(_agent, spec.agents),
        *_flights(spec),
        *(_link(link) for link in spec.links if _stated(link)),
        *(ElementReport(id=e.id, text=_event(e)) for e in spec.events),
        *(ElementReport(id=c.id, text=_condition(c, spec)) for c in spec.conditions),
        *(ElementReport(id=o.id, text=_order(o)) for o in spec.orders),
        *(ElementReport(id=c.id, text=_count(c)) for c in spec.counts),
        *(ElementReport(id=p.id, text=_forbidden(p)) for p in spec.prohibitions),
    )


# --- numbers -------------------------------------------------------------------------------------

_BOUNDS = {Bound.EXACTLY: '', Bound.AT_LEAST: 'at least ', Bound.AT_MOST: 'at most '}
# Of a UAV these count from where its missions begin to where they end.
_FLOWN = frozenset({'altitude', 'distance', 'horizontal_distance', 'separation', 'speed'})
# Quantities of which 1 says that it is so.
_YES_OR_NO = frozenset(
    {
        QuantityName.DELIVERED.value,
        QuantityName.LANDED.value,
        QuantityName.MISSION_COMPLETED.value,
    }
)


def _number(value: Parameter) -> str:
    about = 'about ' if value.approximate else ''
    unit = '' if value.unit is Unit.ONE else f' {value.unit.value}'
    return f'{_BOUNDS[value.bound]}{about}{value.value:.6g}{unit}'


def _named_numbers(element: Document, *, stated: bool, said: Sequence[str] = ()) -> list[str]:
    """Return `altitude 40 m` for each number of an element that no other phrase says."""
    texts = []
    for field in type(element).model_fields:
        value = getattr(element, field)
        values = value if isinstance(value, tuple) else (value,)
        numbers = [v for v in values if isinstance(v, Parameter)]
        if field in said or not numbers:
            continue
        if (numbers[0].provenance is Provenance.EXPLICIT) is stated:
            name = _plain(field)
            texts.append(f'{name} {" by ".join(_number(n) for n in numbers)}')
    return texts


def _plain(field: str) -> str:
    """Return the name of a field without its unit: `closing_from_m` is `closing from`."""
    for unit in ('_mps2', '_mps', '_deg', '_m', '_s'):
        if field.endswith(unit):
            return field.removesuffix(unit).replace('_', ' ')
    return field.replace('_', ' ')


def _stated(element: Document) -> bool:
    return bool(_named_numbers(element, stated=True))


def _place(name: str | None) -> str:
    return 'the scene' if name is None else name.removeprefix('landmark:').replace('_', ' ')


# --- world and bodies ----------------------------------------------------------------------------


def _world(world: World) -> ElementReport:
    said: list[str] = []
    assumed: list[str] = []
    weather = f'{world.weather.value.replace("_", " ")} weather'
    (said if world.weather_span is not None else assumed).append(weather)
    (said if world.time_of_day_span is not None else assumed).append(world.time_of_day.value)
    if world.traffic_density is not None:
        said.append(f'{world.traffic_density.value} traffic')
    if world.wind is not None:
        said.append(world.wind.value)
    said += _named_numbers(world, stated=True)
    if world.seed is not None:
        said.append(f'seed {world.seed}')
    text = f'{world.map_name}: {", ".join(said)}' if said else world.map_name
    return ElementReport(id='world', text=text, assumed=', '.join(assumed))


def _agent(agent: GroundAgent) -> ElementReport:
    kind = f'{"an" if agent.type.value[0] in "aeiou" else "a"} {agent.type.value}'
    kind += ' car' if agent.type is AgentType.POLICE else ''
    kind += ' (the ego)' if agent.role is Role.EGO else ''
    kind += ' of the background' if agent.role is Role.BACKGROUND else ''
    parts = [f'{agent.id} is {kind}', *map(_placement, agent.placements)]
    parts += [_behavior(b) for b in agent.behaviors if not b.target_inferred]
    assumed = [
        text
        for element in (*agent.placements, *agent.behaviors)
        for text in _named_numbers(element, stated=False)
    ]
    assumed += [f'{_behavior(b)}' for b in agent.behaviors if b.target_inferred]
    return ElementReport(id=agent.id, text='; '.join(parts), assumed=', '.join(assumed))


_RELATIONS = {
    Relation.AHEAD: 'ahead of',
    Relation.LEFT: 'to the left of',
    Relation.RIGHT: 'to the right of',
    Relation.ADJACENT_LANE: 'in the lane next to that of',
    Relation.SAME_LANE: 'in the lane of',
    Relation.ONCOMING: 'on the opposite carriageway to',
    Relation.PARKED_AT: 'parked at',
}


def _placement(placement: Placement) -> str:
    where = _RELATIONS.get(placement.relation, placement.relation.value)
    distance = ''
    if placement.distance_m is not None and placement.distance_m.provenance is Provenance.EXPLICIT:
        distance = f'{_number(placement.distance_m)} '
    rest = ''.join(f', {n}' for n in _named_numbers(placement, stated=True, said=('distance_m',)))
    when = 'all along' if placement.keeps_distance else 'at the start'
    when = 'on the way' if placement.kept_in_motion and not placement.keeps_distance else when
    return f'{when} {distance}{where} {_place(placement.of)}{rest}'


_DOES = {
    BehaviorKind.CROSS: 'crosses the road',
    BehaviorKind.CHANGE_LANE: 'changes lane',
    BehaviorKind.TURN_LEFT: 'turns left',
    BehaviorKind.TURN_RIGHT: 'turns right',
    BehaviorKind.SLOW: 'slows down',
    BehaviorKind.YIELD: 'yields to',
    BehaviorKind.PARK: 'is parked',
    BehaviorKind.WAIT: 'waits',
    BehaviorKind.CIRCULATE: 'drives around',
    BehaviorKind.APPROACH: 'approaches',
    BehaviorKind.EMERGENCY_RUN: 'makes an emergency run to',
}


def _behavior(behavior: Behavior) -> str:
    does = _DOES.get(behavior.kind, f'{behavior.kind.value}s')
    whom = ''
    if behavior.target is not None:
        somewhere = is_place(behavior.target) and behavior.kind is not BehaviorKind.APPROACH
        goes = behavior.kind is BehaviorKind.DRIVE and behavior.target.startswith('landmark:')
        at = ' to' if goes else ' at' if somewhere and not does.endswith(' to') else ''
        whom = f'{at} {_place(behavior.target)}'
    else:
        does = does.removesuffix(' to')
    numbers = ''.join(f', {text}' for text in _named_numbers(behavior, stated=True))
    return f'{does}{whom}{_to_side(behavior.side)}{numbers}'


# --- flights and radio ---------------------------------------------------------------------------


def _flights(spec: ScenarioSpec) -> Iterator[ElementReport]:
    # Who is over somebody, or goes round him, stays there when that one drives off.
    leave = {a.id for a in spec.agents if not parks(spec, a)}
    for uav, own in groupby(sorted(spec.missions, key=lambda m: m.uav), key=lambda m: m.uav):
        for k, mission in enumerate(own):
            after = 'then ' if k else ''
            stays = stays_where_it_is(spec, mission) or begins_where_it_is(spec, mission)
            told = _flies(mission, leaves=mission.target in leave, stays=stays)
            text = f'{uav} {after}{told}'
            assumed = _named_numbers(mission, stated=False)
            if mission.target_inferred:
                assumed.insert(0, f'target {_place(mission.target)}')
            yield ElementReport(id=mission.id, text=text, assumed=', '.join(assumed))


def _flies(mission: UavMission, *, leaves: bool, stays: bool) -> str:
    target = _place(mission.target)
    if leaves and mission.mode is not MissionMode.TRACK:
        target = f'where {target} is at the start'
    match mission.mode:
        case MissionMode.HOVER:
            what = 'hovers where it is' if stays else f'hovers over {target}'
        case MissionMode.TRACK:
            what = f'tracks {target}'
        case MissionMode.NAVIGATE:
            pattern = mission.pattern.value if mission.pattern is not None else 'route'
            where = 'from where it is' if stays else f'at {target}'
            what = f'flies the pattern {pattern} {where}'
            if mission.start is not None:
                what = f'flies from {_place(mission.start)} to {target}'
    if mission.side is not None:
        what += f', keeping {_RELATIONS.get(Relation(mission.side.value), mission.side.value)} it'
    if mission.over_streets:
        what += ' over the streets'
    numbers = ''.join(f', {text}' for text in _named_numbers(mission, stated=True))
    numbers += ', on the way there, too' if mission.way_at_altitude else ''
    return what + numbers + (', and stays in the air' if mission.ends_in_flight else '')


def _link(link: Link) -> ElementReport:
    said = _named_numbers(link, stated=True, said=('rate_hz',))
    if link.rate_hz is not None:
        said.insert(0, f'reports at {link.rate_hz.value:g} Hz')
    return ElementReport(
        id=link.id,
        text=f'messages from {link.sender} to {link.receiver}: {", ".join(said)}',
        assumed=', '.join(_named_numbers(link, stated=False)),
    )


# --- events --------------------------------------------------------------------------------------


def _event(event: Event) -> str:
    cause = f'when {_trigger(event.trigger)}, ' if event.trigger is not None else ''
    done = _action(event.action) if event.action is not None else 'that counts as an event'
    delay = ''
    if event.delay_s is not None:
        late = event.delay_s.bound is Bound.AT_MOST
        delay = f', {"within" if late else "after"} {event.delay_s.value:g} s'
    return f'{cause}{done}{delay}'


def _trigger(trigger: Trigger) -> str:
    match trigger:
        case DistanceTrigger(on=on, a=a, b=b, value_m=value):
            near = 'within' if on == 'distance_below' else 'beyond'
            return f'{a} comes {near} {_number(value)} of {_place(b)}{_centres((a, b))}'
        case HeadwayTrigger(on=on, a=a, b=b, value_s=value):
            what = 'headway' if on == 'headway_below' else 'time to collision'
            return f'the {what} of {a} behind {b} falls below {_number(value)}'
        case TimeTrigger(at_s=at):
            return f'{_number(at)} have passed'
        case AltitudeTrigger(uav=uav, value_m=value):
            return f'{uav} reaches {_number(value)} of altitude'
        case VisibilityTrigger(on=on, observer=observer, target=target):
            return f'{observer} {"sees" if on == "visible" else "loses sight of"} {_place(target)}'
        case ArrivalTrigger(who=who, place=place):
            return f'{who} arrives at {_place(place)}'
        case MessageTrigger(by=by, sender=sender):
            return f'{by} receives a message' + (f' of {sender}' if sender is not None else '')
        case SpeedTrigger(on=on, who=who, value_mps=value):
            over = 'falls below' if on == 'speed_below' else 'exceeds'
            return f'the speed of {who} {over} {_number(value)}'
        case EventDoneTrigger(on=on, event=event, after_s=after):
            has = 'is done' if on == 'event_done' else 'has begun'
            return f'{event} {has}' + (f' and {_number(after)} have passed' if after else '')
        case BehaviorDoneTrigger(who=who, behavior=kind):
            return f'the stated time of {who} to {kind.value.replace("_", " ")} is over'
        case BatteryTrigger(uav=uav, value=value):
            return f'the battery of {uav} falls below {_number(value)}'
        case MissionDoneTrigger(uav=uav):
            return f'{uav} has flown its missions'


def _action(action: EventAction) -> str:
    match action:
        case SendMessage(sender=sender, receiver=receiver, text=text):
            says = '' if text is None else f' that says "{text}"'
            return f'{sender} sends a message to {receiver}{says}'
        case UavAction(do='change_mission', uav=uav, mission=mission):
            return f'{uav} goes over to {mission}'
        case UavAction(do=do, uav=uav) | AgentAction(do=do, agent=uav):
            numbers = ''.join(f', {text}' for text in _named_numbers(action, stated=True))
            side = _to_side(action.side) if isinstance(action, AgentAction) else ''
            return f'{uav} is to {do.replace("_", " ")}{side}{numbers}'


def _to_side(side: LaneSide | None) -> str:
    return '' if side is None else f' to the {side.value}'


# --- requirements --------------------------------------------------------------------------------


def _condition(stated: StatedCondition, spec: ScenarioSpec | None = None) -> str:
    whom = ' and '.join(map(_place, stated.of))
    unit = '' if stated.value.unit is Unit.ONE else f' {stated.value.unit.value}'
    far = _centres(stated.of) if stated.quantity == QuantityName.DISTANCE else ''
    text = f'{stated.quantity.replace("_", " ")} of {whom}{far}'
    value = f'{stated.value.value:.6g}{unit}'
    if stated.quantity in IN_PERCENT:
        value = f'{100.0 * stated.value.value:.6g} %'
    if stated.quantity in SHARE_VERBS and len(stated.of) == 2:
        who, seen = map(_place, stated.of)
        verb = SHARE_VERBS[stated.quantity]
        text = f'{who} {verb} {seen} for {OP_WORDS[stated.op]} {value} of the time'
    elif stated.quantity not in _YES_OR_NO or not stated.value.value:
        text += f': {OP_WORDS[stated.op]} {value}'
    if stated.hold_s is not None:
        text += f', for {_number(stated.hold_s)} without a break'
    if stated.by_s is not None:
        text += f', by {_number(stated.by_s)}'
    if stated.fraction is not None:
        text += f', for {_number(stated.fraction)} of the time'
    uavs = set() if spec is None else {mission.uav for mission in spec.missions}
    flown = stated.quantity in _FLOWN and bool(uavs & set(stated.of))
    return f'{text}, on mission from capture on' if flown and not stated.by_s else text


def _centres(of: Sequence[str]) -> str:
    """Say how the distance of two bodies counts: not between their bumpers, as a gap does."""
    places = any(':' in name or name in set(Place) for name in of)
    return '' if places else ' (between their centres)'


def _order(order: Order) -> str:
    within = f', within {order.within_s.value:g} s' if order.within_s is not None else ''
    return f'{order.first} comes before {order.then}{within}'


def _count(count: SceneCount) -> str:
    exactly = 'exactly ' if count.value.bound is Bound.EXACTLY else ''
    return f'{exactly}{_number(count.value)} of the kind {count.kind} in the whole scene'


def _forbidden(prohibition: Prohibition) -> str:
    return f'must not be: {_what(prohibition)}'


def _what(prohibition: Prohibition) -> str:
    match prohibition:
        case ForbiddenAgent(type=kind):
            return f'any {kind}'
        case ForbiddenWorld():
            fields = (prohibition.weather, prohibition.time_of_day, prohibition.traffic_density)
            told = [str(f.value).replace('_', ' ') for f in fields if f is not None]
            return ', '.join(told) or str(prohibition.map_name)
        case ForbiddenPlacement(agent=agent):
            return f'{agent} {_placement(prohibition)}'
        case ForbiddenBehavior(agent=agent):
            return f'{agent} {_behavior(prohibition)}'
        case ForbiddenMission(uav=uav, mode=mode, target=target):
            return f'{uav or "any UAV"} in a mission to {mode.value}, target {_place(target)}'
        case ForbiddenLink(sender=sender, receiver=receiver):
            return f'a message from {sender} to {receiver}'
        case ForbiddenEvent():
            return _event(prohibition)
        case ForbiddenOrder():
            return _order(prohibition)
        case ForbiddenCondition():
            return _condition(prohibition)
