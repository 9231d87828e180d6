# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a clause states about a flight, and how its numbers are taken."""

from __future__ import annotations

from dataclasses import dataclass, field

from aurora_core.parsing import values
from aurora_core.parsing.adjuncts import Adjunct
from aurora_core.parsing.atoms import NounKind
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.measures import COUNT, LENGTH, Measure
from aurora_core.parsing.scene import MissionDraft
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import StatedCondition
from aurora_core.spec.vocabulary import Side

_FIELDS = (
    'altitude',
    'standoff',
    'bearing',
    'side',
    'duration',
    'size',
    'radius',
    'waypoint_count',
    'turns',
    'speed',
)


@dataclass(slots=True, kw_only=True)
class FlightValues:
    """Stated values of one clause; None where it states none."""

    altitude: Parameter | None = None
    standoff: Parameter | None = None
    bearing: Parameter | None = None
    side: Side | None = None
    duration: Parameter | None = None
    size: tuple[Parameter, Parameter] | None = None
    radius: Parameter | None = None
    waypoint_count: Parameter | None = None
    turns: Parameter | None = None
    speed: Parameter | None = None
    square: bool = False
    over_streets: bool = False
    ends_in_flight: bool = False
    target: str | None = None
    ranges: list[tuple[str, Measure]] = field(default_factory=list)
    taken: list[Adjunct] = field(default_factory=list)

    @property
    def anything(self) -> bool:
        """Some value or flag is stated."""
        flags = self.over_streets or self.ends_in_flight
        return flags or any(getattr(self, name) is not None for name in _FIELDS)

    @property
    def only_pending(self) -> bool:
        """Only what a phase that comes later can take: altitude and speed."""
        others = [n for n in _FIELDS if n not in ('altitude', 'speed')]
        return all(getattr(self, name) is None for name in others) and not self.over_streets

    def clashes(self, draft: MissionDraft) -> bool:
        """Return whether the phase has another value for something stated here."""
        for name in _FIELDS:
            mine, theirs = getattr(self, name), getattr(draft, name)
            if mine is not None and theirs is not None and mine != theirs:
                return True
        return False

    def apply(self, draft: MissionDraft) -> None:
        """Write the stated values into a phase."""
        for name in _FIELDS:
            mine = getattr(self, name)
            if mine is not None:
                setattr(draft, name, mine)
        draft.square = draft.square or self.square
        draft.over_streets = draft.over_streets or self.over_streets
        draft.ends_in_flight = draft.ends_in_flight or self.ends_in_flight

    def conditions(self, draft: MissionDraft) -> list[tuple[str, tuple[str, ...], Measure]]:
        """Return quantity, whose, and the stated range for every range of the clause."""
        made: list[tuple[str, tuple[str, ...], Measure]] = []
        for name, measure in self.ranges:
            if name == 'altitude':
                made.append(('altitude', (draft.uav.id,), measure))
            elif draft.target is not None:
                made.append(('horizontal_distance', (draft.uav.id, draft.target), measure))
        return made

    def release(self) -> None:
        """Give back what was taken: the clause was not understood after all."""
        for adjunct in self.taken:
            adjunct.used = False


def use(found: FlightValues, adjunct: Adjunct) -> None:
    adjunct.used = True
    found.taken.append(adjunct)


def stated_value(name: str, measure: Measure) -> Parameter | None:
    if measure.upper is not None and measure.dimension != COUNT:
        return None
    return values.explicit(name, measure) if values.accepts(name, measure) else None


def ranged_value(found: FlightValues, name: str, measure: Measure) -> Parameter | None:
    """`between 30 and 40 m`: free inside, and both ends become conditions."""
    if measure.upper is None or measure.dimension != LENGTH:
        return None
    found.ranges.append((name, measure))
    return values.ranged(name, measure)


def noun_target(frame: Frame, adjunct: Adjunct) -> str | None:
    for noun in adjunct.nouns:
        place = frame.resolver.place(noun)
        if place is not None:
            frame.scene.clause.places += (place,)
            return place
        if noun.kind in (NounKind.STREET, NounKind.SURROUNDINGS):
            continue
        actors = [e for e in frame.objects((noun,)) if e not in frame.scene.clause.subjects]
        if actors:
            return actors[0].id
    return None


def state_ranges(frame: Frame, draft: MissionDraft, found: FlightValues) -> None:
    """State a range as two conditions."""
    for quantity, of, measure in found.conditions(draft):
        low, high = values.range_ends('condition_distance', measure)
        for op, bound in (('>=', low), ('<=', high)):
            made = StatedCondition.model_validate(
                {
                    'id': frame.scene.new_id('c'),
                    'quantity': quantity,
                    'of': of,
                    'op': op,
                    'value': bound,
                    'span': frame.span,
                }
            )
            frame.scene.conditions.append(made)
            frame.scene.clause.ids[made.id] = None
