# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which clause of a prompt a requirement comes from.

Annotations name no spans, so the clause is the one that holds most of the numbers of the fields in
question and of the words people use for their values, then of the other fields of the requirement.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence

from aurora_bench.prompts.format import (
    AgentRequirement,
    AnnotatedPrompt,
    AnyOfRequirement,
    OrderRequirement,
    Requirement,
    UavRequirement,
)
from aurora_bench.prompts.numerals import Dimension, stated_numbers
from aurora_core.spec.scenario import Clause

_UAV = 'uav'
# Beginnings of words, by annotated value. A number weighs more than a word: it is rarer.
_WORDS: dict[str, str] = {
    'car': r'car|ego|vehicle|auto|(?:we|us|my)\b', 'truck': 'truck|lorry',
    'bus': 'bus', 'van': 'van',
    'motorcycle': 'moto|bike', 'bicycle': 'bicycl|cycl|bike',
    'pedestrian': r'ped|walker|person|people|jogger|someone|(?:he|him)\b',
    'police': 'police|cop|officer',
    _UAV: 'uav|drone|quad|copter|multirotor|aircraft',
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
    'event_begun': 'begin|began|start|step',
    'mission_done': 'finish|done|after', 'behavior_done': 'after|then|once|over',
    'send_message': 'warn|alert|messag|msg|inform|tell|report|send',
    'accelerate': 'accelerat', 'start': 'start|leav', 'change_mission': 'follow|hover|then',
    'land': 'land', 'return_home': 'return|home|back', 'ascend': r'climb|ascend|up\b',
    'tracked_fraction': 'track', 'visible_time': 'see|view|sight|visible',
    'visible_fraction': 'see|view|sight|visible',
    'separation': 'apart|separat|between|nearer|closer',
    'hover_drift': 'drift', 'delivered': 'deliver|arriv|get through', 'altitude': 'altitude|above',
    'speed': 'speed|fast', 'delivery_latency': 'within|deliver|less', 'delivery_ratio': 'deliver',
    'distance': 'nearer|closer|within|distance', 'landed': 'land|ground',
    'mission_completed': 'finish|complet', 'waypoints_visited': 'waypoint|visit|reach',
}  # fmt: skip
_NUMBER_WEIGHT = 3


def evidence(
    prompt: AnnotatedPrompt,
    requirement: Requirement,
    fields: Collection[str],
    clauses: Sequence[Clause],
) -> tuple[Clause, ...]:
    """Return the clauses that speak most of some fields of a requirement; none if none does.

    Args:
        prompt: That the requirement belongs to.
        requirement: One of the prompt.
        fields: Names as `RequirementScore.fields` has them.
        clauses: Of the answer.
    """
    every = _all_values(prompt, requirement)
    asked = every
    if not isinstance(requirement, OrderRequirement):
        asked = set(_values(requirement, _kinds(prompt), fields))
    weights = [(_weight(asked, c.text), _weight(every, c.text)) for c in clauses]
    most = max(weights, default=(0, 0))
    return tuple(c for c, w in zip(clauses, weights, strict=True) if w == most and any(w))


def speaks_of(prompt: AnnotatedPrompt, requirement: Requirement, text: str) -> bool:
    """Tell whether a text holds a number or a word of a requirement."""
    return _weight(_all_values(prompt, requirement), text) > 0


def _all_values(prompt: AnnotatedPrompt, requirement: Requirement) -> set[str | float]:
    """Return what a requirement says; an order says what the events and missions of it say."""
    told: list[Requirement] = [requirement]
    if isinstance(requirement, OrderRequirement):
        refs = (requirement.first, requirement.then)
        told += [r for r in prompt.requirements if getattr(r, 'ref', None) in refs]
    kinds = _kinds(prompt)
    return {value for one in told for value in _values(one, kinds)}


def _kinds(prompt: AnnotatedPrompt) -> dict[str, str]:
    """Return what stands behind every name of the annotation."""
    kinds: dict[str, str] = {}
    for r in prompt.requirements:
        for told in r.any_of if isinstance(r, AnyOfRequirement) else (r,):
            if isinstance(told, AgentRequirement):
                kinds[told.ref] = told.type
            elif isinstance(told, UavRequirement):
                kinds[told.ref] = _UAV
    return kinds


def _weight(values: Collection[str | float], text: str) -> int:
    numbers = {
        round(n.value, 3) for n in stated_numbers(text) if n.dimension is not Dimension.ANGLE
    }
    weight = 0
    for value in values:
        if isinstance(value, float):
            is_there = any(abs(n - value) <= 0.005 * abs(value) for n in numbers)
            weight += _NUMBER_WEIGHT * is_there
        else:
            pattern = _WORDS.get(value, re.escape(re.sub(r'\d+$', '', value)))
            weight += re.search(rf'\b(?:{pattern})', text, re.IGNORECASE) is not None
    return weight


def _values(
    requirement: Requirement, kinds: dict[str, str], fields: Collection[str] | None = None
) -> Iterator[str | float]:
    if isinstance(requirement, AnyOfRequirement):
        for reading in requirement.any_of:
            yield from _values(reading, kinds, fields)
        return
    body = requirement.model_dump(
        mode='json',
        exclude_none=True,
        by_alias=True,
        exclude={'id', 'kind', 'tol', 'negate', 'ref'},
    )
    for path, value in _leaves(body):
        if fields is not None and path not in fields:
            continue
        yield kinds.get(value, value) if isinstance(value, str) else value


def _leaves(value: object, path: str = '') -> Iterator[tuple[str, str | float]]:
    if isinstance(value, dict):
        for name, item in value.items():
            yield from _leaves(item, f'{path}.{name}' if path else name)
    elif isinstance(value, list):
        for item in value:
            yield from _leaves(item, path)
    elif isinstance(value, str):
        yield path, value
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield path, float(value)
