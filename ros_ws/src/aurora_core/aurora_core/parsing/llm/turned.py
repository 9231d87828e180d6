# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Readings that turn their own words round: a stop that slows, `within` as farther than.

Each looks at the words that an element quotes and objects only where they have one meaning.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.doubts.clauses import TOLD
from aurora_core.parsing.doubts.roles import deeds
from aurora_core.parsing.llm.actors import may_mean
from aurora_core.parsing.llm.facts import PromptFacts, inside, overlap
from aurora_core.parsing.llm.reading import (
    AgentReading,
    ConditionReading,
    EventReading,
    MissionReading,
    Number,
    Reading,
    UavReading,
)
from aurora_core.spec.parameter import Bound

# What an event may make somebody do that is told with a verb.
_ACTS = {
    'accelerate': ('accelerate', 'start', 'slow'),
    'brake': ('brake', 'slow', 'stop'),
    'change_lane': ('change_lane',),
    'cross': ('cross', 'start'),
    'slow': ('brake', 'slow'),
    'start': ('accelerate', 'cross', 'start'),
    'stop': ('brake', 'stop', 'yield'),
}
_OF_AGENTS = frozenset({*_ACTS, 'yield'})
_SIGHT_LOST = frozenset({'lose', 'vanish'})
_FARTHER = r'(?:above|beyond|exceed\w*|farther|faster|further|greater|higher|longer|more|over)'
_NEARER = r'(?:below|closer|fewer|less|lower|nearer|shorter|slower|under|within)'
_COMPARES = re.compile(rf'\b(?:(?P<more>{_FARTHER})|(?P<less>{_NEARER}))(?: than| of)?\s*$', re.I)
_DENIED = re.compile(r"n'?t\b|n’t\b", re.IGNORECASE)
_HIGH = re.compile(r'\s*(?:altitude|height|high|above|agl|up)\b', re.IGNORECASE)
_HIGH_BEFORE = re.compile(r'\b(?:alt|altitude|height)(?: of)?:?\s*$', re.IGNORECASE)
_AWAY = re.compile(r'\s*(?:away|standoff|stand-off|behind|horizontal\w*)\b', re.IGNORECASE)


def check_turned(reading: Reading, facts: PromptFacts, complaints: list[str]) -> None:
    """Object to elements that say the opposite, or another kind, of the words that they quote."""
    for event in reading.events:
        _check_message(event, reading, facts, complaints)
        _check_act(event, facts, complaints)
        _check_cause(event, reading, facts, complaints)
    for condition in reading.conditions:
        _check_bound(condition, facts, complaints)
    for mission in reading.missions:
        _check_heights(mission, facts, complaints)


def _within(quote: str, facts: PromptFacts) -> list[Atom]:
    spans = facts.spans(quote)[:1]
    return [a for a in facts.atoms if any(inside(a, s) for s in spans)]


def _check_message(
    event: EventReading, reading: Reading, facts: PromptFacts, complaints: list[str]
) -> None:
    """`the drone warns the car` that became a message from the car to the drone."""
    action = event.action
    if action is None or action.do != 'send_message':
        return
    bodies: tuple[AgentReading | UavReading, ...] = (*reading.agents, *reading.uavs)
    actors = {one.id: one for one in bodies}
    sender, receiver = actors.get(action.subject), actors.get(action.receiver or '')
    if sender is None or receiver is None:
        return
    for deed in deeds(_within(event.quote, facts)):
        nouns = [atom.noun for atom in (deed.doer, deed.done_to) if atom is not None]
        if deed.verb.key not in TOLD or len(nouns) != 2 or None in nouns:
            continue
        does, hears = [n for n in nouns if n is not None]
        turned = may_mean(does, receiver) and may_mean(hears, sender)
        if turned and not may_mean(does, sender) and not may_mean(hears, receiver):
            complaints.append(f'{event.id}.action: {event.quote!r} says it the other way round')


def _check_act(event: EventReading, facts: PromptFacts, complaints: list[str]) -> None:
    if event.action is None:
        return
    words = _within(event.quote, facts)
    told = [a.key for a in words if a.kind is AtomKind.VERB]
    negated = any(a.kind is AtomKind.NEGATION for a in words)
    do = event.action.do
    if len(told) == 1 and not negated and do in _OF_AGENTS:
        said = told[0]
        if do not in _ACTS.get(said, (do,)):
            complaints.append(f'{event.id}.action.do: {event.quote!r} says {said}, found {do}')


def _check_cause(
    event: EventReading, reading: Reading, facts: PromptFacts, complaints: list[str]
) -> None:
    trigger = event.trigger
    if trigger is None:
        return
    where = f'{event.id}.trigger.on'
    less = trigger.on in ('distance_below', 'speed_below')
    acts = event.action is not None  # a milestone may be what is to be over by then
    if (
        acts
        and trigger.value is not None
        and (less or trigger.on in ('distance_above', 'speed_above'))
    ):
        told = _direction(trigger.value, facts)
        if told is not None and told is not less:
            complaints.append(f'{where}: {trigger.value.quote!r} says the opposite')
    if trigger.on in ('visible', 'occluded'):
        quotes = [event.quote, *(c.quote for c in reading.clauses if event.id in c.ids)]
        words = [a for quote in quotes for a in _within(quote, facts)]
        verbs = {a.key for a in words if a.kind is AtomKind.VERB}
        lost = bool(verbs & _SIGHT_LOST) or _unseen(words)
        seen = 'see' in verbs
        if lost is not seen and lost is not (trigger.on == 'occluded'):
            told_as = 'that sight is lost' if lost else 'that somebody is seen'
            complaints.append(f'{where}: the words say {told_as}, found {trigger.on}')


def _unseen(words: Sequence[Atom]) -> bool:
    """`no longer sees`, `cannot be seen`: a negation right before the verb."""
    return any(
        a.kind is AtomKind.NEGATION and any(b.key == 'see' for b in words[k + 1 : k + 3])
        for k, a in enumerate(words)
    )


def _check_bound(condition: ConditionReading, facts: PromptFacts, complaints: list[str]) -> None:
    if condition.value is None or condition.op in (None, '=='):
        return
    negated = any(a.kind is AtomKind.NEGATION for a in _within(condition.quote, facts))
    less = _direction(condition.value, facts)
    if less is not None and not negated and less is not (condition.op in ('<', '<=')):
        complaints.append(f'{condition.id}.op: {condition.quote!r} says the opposite')


def _direction(number: Number, facts: PromptFacts) -> bool | None:
    """Return whether the words in front of a stated number say less than it.

    None where nothing compares, or the sentence denies: `no longer within 50 m` is farther.
    """
    spans = facts.spans(number.quote)
    measures = [m for m in facts.measures if any(overlap(m, s) for s in spans)]
    if number.provenance != 'explicit' or len(measures) != 1:
        return None
    measure = measures[0]
    if measure.bound is not Bound.EXACTLY:
        return measure.bound is Bound.AT_MOST
    before = facts.prompt[: measure.start]
    found = _COMPARES.search(before)
    sentence = max(before.rfind(mark) for mark in '.;!?') + 1
    denied = any(
        a.kind is AtomKind.NEGATION and sentence <= a.start < measure.start for a in facts.atoms
    )
    denied = denied or _DENIED.search(before[sentence:]) is not None
    return None if found is None or denied else found['less'] is not None


def _check_heights(mission: MissionReading, facts: PromptFacts, complaints: list[str]) -> None:
    for name, other in (('altitude_m', 'standoff_m'), ('standoff_m', 'altitude_m')):
        number: Number | None = getattr(mission, name)
        if number is None or number.provenance != 'explicit':
            continue
        spans = facts.spans(number.quote)
        found = [m for m in facts.measures if any(overlap(m, s) for s in spans)]
        if len(found) != 1:
            continue
        behind, before = facts.prompt[found[0].end :], facts.prompt[: found[0].start]
        high = _HIGH.match(behind) is not None or _HIGH_BEFORE.search(before) is not None
        away = _AWAY.match(behind) is not None
        if high is not away and high is (name == 'standoff_m'):
            words = facts.text(found[0])
            complaints.append(f'{mission.id}.{name}: the words beside {words!r} say {other}')
