# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Elements of a reference specification, each from one requirement, as plain documents."""

from __future__ import annotations

from collections.abc import Mapping

from aurora_bench.prompts.documents import Doc
from aurora_bench.prompts.format import (
    Action,
    BehaviorRequirement,
    ConditionRequirement,
    EventRequirement,
    LinkRequirement,
    MissionRequirement,
    PlacementRequirement,
    Requirement,
    Trigger,
)
from aurora_bench.prompts.reference_names import Names, NotExpressibleError, id_of
from aurora_bench.prompts.reference_spans import StatedSpans, binding
from aurora_core.spec.parameter import unit_of
from aurora_core.spec.requirements import STATED_QUANTITIES

# What stands where an annotation is silent, and the domain in which it may move. The values are
# those of the product, so that a reference is no other scenario than the prompt: a test compares
# them. Only the speed that a trigger waits for is our own: 2 m/s says `slow`, not `stopped`.
DEFAULTS: dict[str, tuple[float, float, float]] = {
    'altitude_m': (30.0, 10.0, 100.0),
    'standoff_m': (0.0, 0.0, 50.0),
    'duration_s': (30.0, 10.0, 120.0),
    'speed_mps': (8.0, 2.0, 15.0),
    'latency_s': (0.1, 0.0, 1.0),
    'loss': (0.0, 0.0, 0.0),
    'retransmissions': (3.0, 0.0, 3.0),
    'retransmission_interval_s': (0.2, 0.2, 0.2),
    'value_m': (20.0, 5.0, 50.0),
    'value_mps': (2.0, 0.5, 5.0),
    'at_s': (10.0, 5.0, 60.0),
    'radius_m': (30.0, 20.0, 80.0),
    'waypoint_count': (4.0, 3.0, 8.0),
}
# Of a rectangle; a line has the length alone.
SIZE_M = (100.0, 60.0)
_MISSION_NUMBERS = (
    'altitude_m', 'standoff_m', 'bearing_deg', 'duration_s', 'radius_m', 'waypoint_count',
    'turns', 'speed_mps',
)  # fmt: skip


_TOWARDS_ONE = frozenset({'overtake', 'yield'})


class Numbers:
    """Parameters of one requirement; a stated range is the domain."""

    def __init__(
        self,
        r: Requirement,
        variation: Mapping[str, tuple[float, float]],
        spans: StatedSpans | None = None,
    ) -> None:
        """Take the numbers of a requirement.

        Args:
            r: The requirement.
            variation: Annotated ranges of the prompt.
            spans: Where the prompt states its numbers: they are explicit then, and judged. None:
                they are inferred.
        """
        self._id = r.id
        self._variation = variation
        self._spans = spans

    @property
    def are_judged(self) -> bool:
        """Whether the reference is one to be run."""
        return self._spans is not None

    def stated(self, path: str, value: float, unit: str | None = None) -> Doc:
        """Return the parameter of an annotated number.

        Args:
            path: Field inside the requirement, e.g. `trigger.value_m`.
            value: In the unit of the field.
            unit: Where the field's name does not say it.
        """
        low, high = self._variation.get(f'{self._id}.{path}', (value, value))
        low, high = min(low, value), max(high, value)
        name = unit or unit_of(path.split('.')[-1])
        found: Doc = {
            'value': value, 'unit': name, 'low': low, 'high': high, 'provenance': 'inferred',
        }  # fmt: skip
        if self._spans is None:
            return found
        explicit = {'provenance': 'explicit', 'span': self._spans.of(value, name)}
        return found | explicit | binding(value, low, high)

    def unsaid(self, value: float, unit: str) -> Doc:
        """Return the parameter of one point that no annotation states."""
        # Stored references called it inferred before anything was explicit in a reference.
        provenance = 'inferred' if self._spans is None else 'default'
        return {
            'value': value, 'unit': unit, 'low': value, 'high': value, 'provenance': provenance,
        }  # fmt: skip

    def of(self, holder: object, names: tuple[str, ...], prefix: str = '') -> Doc:
        """Return the parameters of all numbers of these names that are annotated."""
        values = {name: getattr(holder, name, None) for name in names}
        return {n: self.stated(prefix + n, v) for n, v in values.items() if v is not None}


def default(name: str) -> Doc:
    """Return the parameter that stands where nothing is said."""
    value, low, high = DEFAULTS[name]
    return {
        'value': value,
        'unit': unit_of(name),
        'low': low,
        'high': high,
        'provenance': 'default',
    }


def placement(r: PlacementRequirement, names: Names, numbers: Numbers) -> Doc:
    """Return a placement."""
    given = numbers.of(r, ('distance_m', 'bearing_deg'))
    given |= {'kept_in_motion': True} if r.kept else {}
    return {'relation': r.relation, 'of': names.one(r.of), **given}


def behavior(r: BehaviorRequirement, names: Names, numbers: Numbers) -> Doc:
    """Return a behaviour.

    Raises:
        NotExpressibleError: It is about several bodies: a specification names one.
    """
    # Stored references stay as they are; of those that run nothing may be left out.
    several = r.target is not None and len(names.all(r.target)) > 1
    if numbers.are_judged and several and r.behavior in _TOWARDS_ONE:
        raise NotExpressibleError(f'{r.behavior} of several')
    side = {} if r.side is None else {'side': r.side}
    stated = numbers.of(r, ('speed_mps', 'headway_s', 'duration_s'))
    return {'kind': r.behavior, 'target': names.one(r.target), **stated, **side}


def behaviors(r: BehaviorRequirement, names: Names, numbers: Numbers) -> list[Doc]:
    """Return the behaviours of a requirement: who yields to several does so to each of them."""
    others = () if r.target is None else names.all(r.target)
    if not numbers.are_judged or r.behavior not in _TOWARDS_ONE or len(others) < 2:
        return [behavior(r, names, numbers)]
    stated = numbers.of(r, ('speed_mps',))
    return [{'kind': r.behavior, 'target': other, **stated} for other in others]


def mission(
    r: MissionRequirement | Action, ident: str, uav: str, names: Names, numbers: Numbers
) -> Doc:
    """Return a mission; an action that changes a mission has the same fields."""
    prefix = 'action.' if isinstance(r, Action) else ''
    mode = r.mode.value if r.mode is not None else ('track' if r.target else 'hover')
    target = names.one(r.target if r.end is None else r.end)
    found: Doc = {'id': ident, 'uav': uav, 'mode': mode, 'target': target}
    found |= {} if r.side is None else {'side': r.side}
    found |= {'altitude_m': default('altitude_m'), **numbers.of(r, _MISSION_NUMBERS, prefix)}
    if mode == 'track':
        found = {'standoff_m': default('standoff_m'), **found}
        if found['target'] is None:
            found |= {'target': names.agent(None), 'target_inferred': True}
    if mode != 'navigate':
        return {'duration_s': default('duration_s'), **found}
    sizes = (r.pattern, r.size_m, r.radius_m, r.waypoint_count, r.turns)
    # With a target and nothing of a pattern it is a flight to that.
    to_it = r.target is not None and all(size is None for size in sizes)
    goes = r.start is not None or r.end is not None or to_it
    points = goes or (r.waypoint_count is not None and r.size_m is None)
    pattern = str(r.pattern) if r.pattern is not None else 'waypoints' if points else 'rectangle'
    found = {'speed_mps': default('speed_mps'), **found, 'pattern': pattern}
    if r.start is not None:
        return found | {'start': names.one(r.start)}
    if pattern == 'orbit':
        found = {'radius_m': default('radius_m'), **found}
    elif pattern == 'waypoints':
        count = numbers.unsaid(1.0, '1') if goes else default('waypoint_count')
        found = {'waypoint_count': count, **found}
    if r.size_m is not None or pattern in ('rectangle', 'lawnmower', 'line'):
        if r.size_m is not None:
            found['size_m'] = [
                numbers.stated(f'{prefix}size_m.{k}', v, 'm') for k, v in enumerate(r.size_m)
            ]
        else:
            size = SIZE_M if pattern != 'line' else (SIZE_M[0], 0.0)
            found['size_m'] = [numbers.unsaid(v, 'm') for v in size]
    return found


def kept_off(
    r: MissionRequirement, place: str, ident: str, uav: str, names: Names, numbers: Numbers
) -> Doc:
    """Return the condition that a UAV keeps off a place, so far as is stated."""
    away = numbers.unsaid(0.0, 'm')
    if r.avoid_m is not None:
        away = numbers.stated('avoid_m', r.avoid_m, 'm')
    of = [uav, names.one(place)]
    return {'id': ident, 'quantity': 'clearance', 'of': of, 'op': '>=', 'value': away}


def hearers(r: LinkRequirement, names: Names, numbers: Numbers) -> tuple[str, ...]:
    """Return who hears over a link beside the first one: the other members of a group."""
    if r.receiver is None or not numbers.are_judged:
        return ()
    return names.all(r.receiver)[1:]


def link(r: LinkRequirement, ident: str, names: Names, numbers: Numbers) -> Doc:
    """Return a link."""
    given = numbers.of(r, ('loss', 'latency_s', 'range_m', 'retransmissions', 'rate_hz'))
    if r.outage_s is not None:
        given['outage_s'] = [
            numbers.stated(f'outage_s.{k}', v, 's') for k, v in enumerate(r.outage_s)
        ]
    return default_link(ident, names.body(r.sender), names.body(r.receiver)) | given


def default_link(ident: str, sender: str, receiver: str) -> Doc:
    """Return a link of which nothing is said."""
    silent = ('loss', 'latency_s', 'retransmissions', 'retransmission_interval_s')
    numbers = {name: default(name) for name in silent}
    return {'id': ident, 'sender': sender, 'receiver': receiver, **numbers}


def is_a_message_at_no_time(r: EventRequirement) -> bool:
    """Tell whether an event is a message between two who are named, without a cause."""
    action = r.action
    sends = action is not None and action.do == 'send_message' and action.receiver is not None
    return sends and r.trigger is None


def event(r: EventRequirement, names: Names, numbers: Numbers) -> Doc:
    """Return an event; a change of mission flies the mission `<event>_mission`."""
    found: Doc = {'id': id_of(r.ref)}
    if r.trigger is not None:
        found['trigger'] = _trigger(r.trigger, names, numbers)
    if r.action is not None:
        found['action'] = _action(r.action, found['id'], names, numbers)
    if r.within_s is not None:
        found['delay_s'] = numbers.stated('within_s', r.within_s) | {'bound': 'at_most'}
    return found


def _trigger(t: Trigger, names: Names, numbers: Numbers) -> Doc:
    given = numbers.of(t, ('value_m', 'value_mps', 'value_s', 'at_s', 'after_s'), 'trigger.')
    found: Doc = {'on': t.on}
    if t.on in ('distance_below', 'distance_above'):
        found |= {'a': names.body(t.a), 'b': names.one(t.b) or names.agent(None)}
        found['value_m'] = default('value_m')
    elif t.on in ('headway_below', 'ttc_below'):
        found |= {'a': names.body(t.a), 'b': names.body(t.b)}
    elif t.on in ('visible', 'occluded'):
        # Nobody named: the UAV that looks down.
        observer = names.uav(None) if t.observer is None else names.body(t.observer)
        found |= {'observer': observer}
        found['target'] = names.one(t.target) or names.agent(None)
    elif t.on == 'altitude_reached':
        found |= {'uav': names.uav(t.uav), 'value_m': default('altitude_m')}
    elif t.on == 'arrives':
        if t.place is None:
            raise NotExpressibleError('an arrival needs a place')
        found |= {'who': names.body(t.who), 'place': names.one(t.place)}
    elif t.on == 'message_received':
        found |= {'by': names.body(t.by), 'sender': names.one(t.from_)}
    elif t.on in ('speed_below', 'speed_above'):
        found |= {'who': names.body(t.who), 'value_mps': default('value_mps')}
    elif t.on in ('event_done', 'event_begun'):
        found['event'] = names.moment(t.event or '')
    elif t.on == 'battery_below':
        found['uav'] = names.uav(t.uav)
        found['value'] = numbers.stated('trigger.value', 0.5 if t.value is None else t.value, '1')
    elif t.on == 'behavior_done':
        if t.behavior is None:
            raise NotExpressibleError('nobody says what is to last')
        found |= {'who': names.agent(t.who), 'behavior': t.behavior}
    elif t.on == 'mission_done':
        found['uav'] = names.uav(t.uav)
    elif t.on == 'time':
        found['at_s'] = default('at_s')
    return found | given


def _action(a: Action, event_id: str, names: Names, numbers: Numbers) -> Doc:
    if a.do == 'send_message':
        sender = names.body(a.sender) if a.sender is not None else names.uav(None)
        text = {} if a.text is None else {'text': a.text}
        return {'do': a.do, 'sender': sender, 'receiver': names.body(a.receiver), **text}
    if a.do in ('land', 'return_home', 'ascend', 'change_mission'):
        found: Doc = {'do': a.do, 'uav': names.uav(a.uav)}
        if a.do == 'change_mission':
            return found | {'mission': f'{event_id}_mission'}
        given = numbers.of(a, ('altitude_m', 'vertical_mps'), 'action.')
        return found | ({'altitude_m': default('altitude_m')} if a.do == 'ascend' else {}) | given
    side = {} if a.side is None else {'side': a.side}
    stated = numbers.of(a, ('value_mps', 'deceleration_mps2'), 'action.')
    return {'do': a.do, 'agent': names.agent(a.agent), **stated, **side}


def condition(r: ConditionRequirement, ident: str, names: Names, numbers: Numbers) -> Doc:
    """Return a stated condition; yes is 1."""
    of = [
        i
        for ref in r.of
        for i in ((names.moment(ref),) if r.quantity == 'event_time' else names.all(ref))
    ]
    value = numbers.stated('value', float(r.value), STATED_QUANTITIES[r.quantity].value)
    optional = numbers.of(r, ('hold_s', 'by_s', 'fraction'))
    return {'id': ident, 'quantity': r.quantity, 'of': of, 'op': r.op, 'value': value, **optional}
