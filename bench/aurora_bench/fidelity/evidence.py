# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which clause of a prompt a requirement comes from.

Annotations name no spans, so the clause is the one that holds most of the requirement's numbers
and of the words people use for its values.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from aurora_bench.prompts.format import AnnotatedPrompt, AnyOfRequirement, Requirement
from aurora_bench.prompts.numerals import Dimension, stated_numbers
from aurora_core.spec.parameter import Document
from aurora_core.spec.scenario import Clause

# Beginnings of words, by annotated value. A number weighs more than a word: it is rarer.
_WORDS: dict[str, str] = {
    'car': r'car|ego|vehicle|auto|(?:we|us|my)\b', 'truck': 'truck|lorry',
    'bus': 'bus', 'van': 'van',
    'motorcycle': 'moto|bike', 'bicycle': 'bicycl|cycl|bike',
    'pedestrian': r'ped|walker|person|people|jogger|someone|(?:he|him)\b',
    'police': 'police|cop|officer',
    'ambulance': 'ambulance', 'firetruck': 'fire ?truck|fire engine', 'rsu': 'rsu|roadside unit',
    'rain': 'rain|wet', 'heavy_rain': 'heavy rain|pour|downpour', 'snow': 'snow', 'fog': 'fog',
    'cloudy': 'cloud|overcast', 'clear': 'clear', 'dawn': 'dawn', 'dusk': 'dusk|twilight',
    'night': 'night|nite|dark|midnight', 'noon': 'noon|midday', 'low': 'few|light|low',
    'high': 'heavy|dense|high|lot|packed', 'medium': 'medium|moderate', 'downtown': 'downtown',
    'ahead': 'ahead|front|leads', 'behind': 'behind|rear|back', 'left': 'left', 'right': 'right',
    'beside': 'beside|next|alongside', 'adjacent_lane': 'adjacent|lane', 'same_lane': 'lane',
    'oncoming': 'oncoming|other way|towards', 'near': 'near', 'before': 'before|short|upstream',
    'parked_at': 'park', 'at': r'at\b', 'on': r'on\b',
    'drive': r'driv|go(?:es|ing)?\b|doing|ride|mov',
    'circulate': 'circulat|round|around', 'follow': 'follow', 'tailgate': 'tailgat|tail',
    'overtake': 'overtak|pass', 'approach': 'approach|nearing|towards', 'stop': 'stop',
    'brake': 'brak', 'slow': 'slow', 'yield': 'yield|give|gives', 'cross': 'cross',
    'walk': 'walk|run|jog', 'wait': 'wait', 'park': 'park', 'change_lane': 'lane',
    'turn_left': 'turn', 'turn_right': 'turn', 'emergency_run': 'emergency',
    'hover': r'hover|hold|stay|still|wait|watch|over\b|above', 'track': 'track|follow|shadow|keep',
    'navigate': 'fl[iy]|patrol|survey|visit|orbit|circl', 'rectangle': 'rectang|square',
    'line': 'line', 'lawnmower': 'lawn|mow|grid|survey', 'orbit': 'orbit|circl',
    'waypoints': 'waypoint', 'distance_below': 'within|closer|less|below|comes|near',
    'distance_above': 'more|greater|beyond', 'visible': 'see|sight|spot|sees',
    'occluded': 'lose|lost|losing|hid|out of',
    'time': r'at\b|after', 'altitude_reached': r'reach|ascend|climb|up\b',
    'arrives': 'arriv|reach|get',
    'message_received': 'receiv|get|upon|messag', 'speed_below': 'slow|below|drop',
    'speed_above': 'fast|above|exceed', 'event_done': 'after|then|once|later',
    'mission_done': 'finish|done|after',
    'send_message': 'warn|alert|messag|msg|inform|tell|report|send',
    'accelerate': 'accelerat', 'start': 'start|leav', 'change_mission': 'follow|hover|then',
    'land': 'land', 'ascend': r'climb|ascend|up\b',
    'tracked_fraction': 'track', 'visible_time': 'see|view|sight|visible',
    'visible_fraction': 'see|view|sight|visible',
    'separation': 'apart|separat|between|nearer|closer',
    'hover_drift': 'drift', 'delivered': 'deliver|arriv|get through', 'altitude': 'altitude|above',
    'speed': 'speed|fast', 'delivery_latency': 'within|deliver|less', 'delivery_ratio': 'deliver',
    'distance': 'nearer|closer|within|distance', 'landed': 'land|ground',
    'mission_completed': 'finish|complet', 'waypoints_visited': 'waypoint|visit|reach',
}  # fmt: skip
_NUMBER_WEIGHT = 3


class Evidence(Document):
    """The clauses that speak most of a requirement; none when no word of it is found."""

    clauses: tuple[Clause, ...]


def evidence(
    prompt: AnnotatedPrompt, requirement: Requirement, clauses: Sequence[Clause]
) -> Evidence:
    """Return the clauses from which a requirement most likely comes."""
    weights = [_weight(requirement, clause.text) for clause in clauses]
    most = max(weights, default=0)
    if most == 0:
        return Evidence(clauses=())
    return Evidence(clauses=tuple(c for c, w in zip(clauses, weights, strict=True) if w == most))


def speaks_of(requirement: Requirement, text: str) -> bool:
    """Tell whether a text holds a number or a word of a requirement."""
    return _weight(requirement, text) > 0


def _weight(requirement: Requirement, text: str) -> int:
    numbers = {
        round(n.value, 3) for n in stated_numbers(text) if n.dimension is not Dimension.ANGLE
    }
    weight = 0
    for value in set(_values(requirement)):
        if isinstance(value, float):
            is_there = any(abs(n - value) <= 0.005 * abs(value) for n in numbers)
            weight += _NUMBER_WEIGHT * is_there
        else:
            pattern = _WORDS.get(value, re.escape(re.sub(r'\d+$', '', value)))
            weight += re.search(rf'\b(?:{pattern})', text, re.IGNORECASE) is not None
    return weight


def _values(requirement: Requirement) -> Iterator[str | float]:
    if isinstance(requirement, AnyOfRequirement):
        for reading in requirement.any_of:
            yield from _values(reading)
        return
    body = requirement.model_dump(
        mode='json', exclude_none=True, exclude={'id', 'kind', 'tol', 'negate', 'ref'}
    )
    yield from _leaves(body)


def _leaves(value: object) -> Iterator[str | float]:
    if isinstance(value, dict):
        for item in value.values():
            yield from _leaves(item)
    elif isinstance(value, list):
        for item in value:
            yield from _leaves(item)
    elif isinstance(value, str):
        yield value if value in _WORDS else re.sub(r'\d+$', '', value)
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield float(value)
