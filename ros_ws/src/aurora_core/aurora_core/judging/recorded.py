# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Arguments as they were recorded when one type with a field `aspect` served all quantities."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

# What every quantity had, whether it used it or not, and the value of those that did not.
_DEFAULTS: dict[str, Any] = {
    'mission': None,
    'missions': [],
    'event': None,
    'link': None,
    'relation': None,
    'after_s': 0.0,
    'low': 0.0,
    'high': 0.0,
    'slow_low': 0.0,
    'slow_high': 0.0,
    'slow_mps': 0.0,
    'offset_m': 0.0,
    'bound': 'exactly',
    'wanted': 0.0,
    'sample_tolerance': 0.0,
    'strict': False,
    'brake_mps2': 0.0,
    'onset_mps2': 0.0,
    'actions': None,
    'acceleration_mps2': 0.0,
    'axis': None,
    'types': [],
    'arrival_m': 0.0,
    'phase_change_s': 0.0,
    'phase_follow_m': 0.0,
    'statistics_from': 0,
}
_COMMON = ('horizon_s', 'window', 'touchdown_m')
_ABOUT = ('mission', 'missions', 'event', 'link')
_OF_EVENTS = ('brake_mps2', 'onset_mps2', 'arrival_m', 'actions', 'statistics_from')
_OF_SAMPLES = {'bound': 'bound', 'wanted': 'wanted', 'sample_tolerance': 'tolerance'}


@dataclass(frozen=True, slots=True, kw_only=True)
class _Upgrade:
    """How the arguments of one quantity and aspect are read.

    Attributes:
        kind: What they are now.
        named: Present name of the fields that it has, by their recorded name.
        plus: What the aspect said.
        samples: Field that now holds bound, number and tolerance per sample.
        unused: Recorded, but never looked at.
    """

    kind: str
    named: Mapping[str, str] = field(default_factory=dict)
    plus: Mapping[str, Any] = field(default_factory=dict)
    samples: str = ''
    unused: tuple[str, ...] = ()


_MOVING = {'slow_mps': 'moving_mps'}
_OFFSET = {'offset_m': 'offset_m'}
_AFTER = {'after_s': 'after_s'}
_CHANGE = {'phase_change_s': 'phase_change_s', 'phase_follow_m': 'phase_follow_m'}
_RELATION = {'relation': 'relation'}
_RELATED = {**_RELATION, **_OFFSET, 'high': 'near_m'}
_SERIES = ('distance', 'horizontal_distance', 'separation', 'altitude', 'speed')

_UPGRADES: dict[tuple[str, str], _Upgrade] = {
    **{(name, ''): _Upgrade(kind=name) for name in _SERIES},
    **{(name, 'share'): _Upgrade(kind=name, samples='share') for name in _SERIES},
    ('collision_clearance', ''): _Upgrade(kind='collision_clearance'),
    ('obstacle_clearance', ''): _Upgrade(kind='obstacle_clearance'),
    ('no_fly_distance', ''): _Upgrade(kind='no_fly_distance'),
    ('presence', ''): _Upgrade(kind='presence'),
    ('jump', ''): _Upgrade(kind='jump'),
    ('endurance', ''): _Upgrade(kind='endurance'),
    ('climb_rate', ''): _Upgrade(kind='climb_rate'),
    ('count', ''): _Upgrade(kind='count', named={'types': 'types'}),
    ('count', 'all'): _Upgrade(kind='count', named={'types': 'types'}, plus={'background': True}),
    **{
        ('world_setting', name): _Upgrade(
            kind='world_setting', named={'types': 'asked'}, plus={'setting': name}
        )
        for name in ('weather', 'time_of_day', 'map_name')
    },
    ('run_duration', ''): _Upgrade(kind='run_duration'),
    ('distance', 'closed_in'): _Upgrade(kind='closed_in'),
    ('horizontal_distance', 'centre'): _Upgrade(kind='from_centre'),
    ('altitude', 'commanded'): _Upgrade(kind='commanded_altitude'),
    ('speed', 'horizontal'): _Upgrade(kind='horizontal_speed'),
    ('speed', 'commanded'): _Upgrade(kind='commanded_speed'),
    ('speed', 'greatest'): _Upgrade(kind='greatest_speed'),
    ('speed', 'after_moving'): _Upgrade(kind='speed_after_moving', named=_MOVING),
    ('speed', 'greatest_deceleration'): _Upgrade(kind='greatest_deceleration'),
    ('speed', 'greatest_drop'): _Upgrade(kind='greatest_drop', named=_MOVING),
    ('speed', 'free'): _Upgrade(
        kind='free_speed',
        named={**_MOVING, 'low': 'settle_m', 'high': 'free_m', 'offset_m': 'lane_offset_m'},
        samples='speed',
    ),
    ('speed', 'walking'): _Upgrade(
        kind='walking_speed', named=_MOVING, samples='speed', unused=('low', 'high', 'offset_m')
    ),
    ('speed', 'before_event'): _Upgrade(kind='speed_before_event', named=_AFTER),
    ('tracked_fraction', ''): _Upgrade(kind='tracked_fraction'),
    ('visible_fraction', ''): _Upgrade(kind='visible_fraction'),
    ('visible_time', ''): _Upgrade(kind='visible_time'),
    ('visible_time', 'longest'): _Upgrade(kind='visible_time', plus={'unbroken': True}),
    ('hover_drift', ''): _Upgrade(kind='hover_drift'),
    ('capture_time', ''): _Upgrade(kind='capture_time'),
    ('phase_duration', ''): _Upgrade(kind='phase_duration'),
    ('altitude_fraction', ''): _Upgrade(kind='altitude_fraction', samples='altitude'),
    ('landed', ''): _Upgrade(kind='landed'),
    ('mission_completed', 'order'): _Upgrade(kind='phase_order', named=_CHANGE),
    ('mission_completed', 'time'): _Upgrade(kind='phase_time'),
    ('mission_completed', 'route'): _Upgrade(kind='time_after_route'),
    ('mission_completed', 'end'): _Upgrade(kind='mission_end'),
    ('waypoints_visited', 'distance'): _Upgrade(kind='waypoint_distance'),
    ('waypoints_visited', 'count'): _Upgrade(kind='waypoints_visited'),
    ('route_closed', ''): _Upgrade(kind='route_closed'),
    ('over_carriageway', ''): _Upgrade(kind='over_carriageway'),
    ('pattern_centre', ''): _Upgrade(kind='pattern_centre'),
    ('pattern_extent', ''): _Upgrade(kind='pattern_extent', named={'axis': 'axis'}),
    ('route_speed', ''): _Upgrade(kind='route_speed', named={'low': 'settle_m'}, samples='speed'),
    ('placement', ''): _Upgrade(kind='placement', named=_RELATED),
    ('placement', 'distance'): _Upgrade(kind='placed_distance', named=_RELATION),
    ('placement', 'bearing'): _Upgrade(
        kind='placed_bearing', named={**_RELATION, 'wanted': 'bearing_deg'}
    ),
    ('placement', 'distance_start'): _Upgrade(kind='distance_at_start', unused=('slow_mps',)),
    ('placement', 'distance_closing'): _Upgrade(
        kind='distance_at_closing', named={'slow_mps': 'still_mps'}
    ),
    ('placement', 'overtake'): _Upgrade(kind='overtaking', named=_OFFSET),
    ('relation_fraction', ''): _Upgrade(kind='relation_fraction', named=_RELATED),
    ('relation_fraction', 'bearing'): _Upgrade(
        kind='bearing_fraction',
        named={'wanted': 'bearing_deg', 'sample_tolerance': 'tolerance_deg'},
    ),
    ('follow_fraction', ''): _Upgrade(
        kind='follow_fraction',
        named={
            **_AFTER,
            **_OFFSET,
            'low': 'low_m',
            'high': 'high_m',
            'slow_low': 'slow_low_m',
            'slow_high': 'slow_high_m',
            'slow_mps': 'slow_mps',
        },
    ),
    ('time_gap', ''): _Upgrade(kind='time_gap', named={**_MOVING, **_OFFSET}),
    ('distance_travelled', ''): _Upgrade(kind='distance_travelled'),
    **{
        ('turn', side): _Upgrade(
            kind='turn', named={**_MOVING, 'high': 'within_s'}, plus={'side': side}
        )
        for side in ('left', 'right')
    },
    ('crossing', ''): _Upgrade(kind='crossing'),
    ('lane_change', ''): _Upgrade(kind='lane_change'),
    ('over_limit', ''): _Upgrade(kind='over_limit', named=_MOVING),
    ('yielding', 'slower'): _Upgrade(kind='slower_before_passed', named={**_MOVING, **_OFFSET}),
    ('yielding', 'passed'): _Upgrade(kind='passed_first', named=_OFFSET, unused=('slow_mps',)),
    ('yielding', 'passed_after'): _Upgrade(kind='passed_after', named=_OFFSET),
    ('event_delay', 'within'): _Upgrade(kind='event_delay', named=_AFTER),
    ('event_delay', 'not_before'): _Upgrade(kind='delay_of_first'),
    ('event_delay', 'order'): _Upgrade(kind='time_between', unused=tuple(_CHANGE)),
    **{
        ('event_time', part): _Upgrade(kind='event_time', plus={'part': part})
        for part in ('trigger', 'action')
    },
    ('completion_delay', ''): _Upgrade(
        kind='completion_delay',
        named={'wanted': 'goal_mps', 'acceleration_mps2': 'acceleration_mps2'},
    ),
    **{
        ('sent_after_capture', after): _Upgrade(kind='sent_after_capture', plus={'after': after})
        for after in ('ascent', 'capture')
    },
    ('visible_at_send', ''): _Upgrade(kind='visible_at_send'),
    ('delivered', ''): _Upgrade(kind='delivered'),
    ('delivered', 'delivered'): _Upgrade(kind='message_delivered'),
    ('delivery_latency', ''): _Upgrade(kind='delivery_latency'),
    ('delivery_latency', 'steps'): _Upgrade(kind='excess_latency', named={'wanted': 'latency_s'}),
    ('delivery_ratio', ''): _Upgrade(kind='delivery_ratio'),
    ('delivery_ratio', 'model'): _Upgrade(kind='first_attempts'),
    ('delivery_ratio', 'attempts'): _Upgrade(kind='all_attempts', named={'wanted': 'loss'}),
    ('link_range', ''): _Upgrade(kind='link_range', named={'wanted': 'range_m'}),
    ('attempts', 'count'): _Upgrade(kind='attempts', named={'wanted': 'again'}),
    ('attempts', 'interval'): _Upgrade(kind='attempt_interval', named={'wanted': 'interval_s'}),
}


def upgraded(quantity: str, recorded: Mapping[str, Any]) -> dict[str, Any]:
    """Return recorded arguments as they are written now.

    Args:
        quantity: Of the condition.
        recorded: With one type for all quantities.

    Raises:
        ValueError: The quantity has no such aspect, or a value that means nothing there.
    """
    aspect = str(recorded.get('aspect', ''))
    known = _UPGRADES.get((quantity, aspect))
    if known is None:
        raise ValueError(f'{quantity} has no aspect {aspect!r}')
    found: dict[str, Any] = {'kind': known.kind, **known.plus}
    rest = {
        name: value
        for name, value in recorded.items()
        if name not in ('aspect', *known.unused) and value != _DEFAULTS.get(name, ())
    }
    for name in (*_COMMON, *_ABOUT):
        if name in rest:
            found[name] = rest.pop(name)
    of_events = {name: rest.pop(name) for name in _OF_EVENTS if name in rest}
    if 'event' in found:
        nothing = {name: _DEFAULTS[name] for name in _OF_EVENTS if name != 'actions'}
        found['event_tolerances'] = nothing | of_events
    elif of_events:
        rest |= of_events
    if known.samples:
        names = {**_OF_SAMPLES, 'strict': 'strict'}
        given = {new: recorded[old] for old, new in names.items() if old in recorded}
        found[known.samples] = given
        rest = {name: value for name, value in rest.items() if name not in names}
    for old, new in known.named.items():
        found[new] = recorded.get(old, _DEFAULTS[old])
        rest.pop(old, None)
    if rest:
        raise ValueError(
            f'{quantity} {aspect} has no {", ".join(sorted(rest))}'.replace('  ', ' ')
        )
    return found
