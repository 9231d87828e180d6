# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The numbers of a flight: altitude, standoff, bearing, duration, speed, pattern size."""

from __future__ import annotations

from aurora_core.parsing import values
from aurora_core.parsing.adjuncts import Adjunct, AdjunctKind
from aurora_core.parsing.atoms import AtomKind, NounKind
from aurora_core.parsing.constructions.demands import keeps_off
from aurora_core.parsing.constructions.flight_types import (
    FlightValues,
    noun_target,
    ranged_value,
    stated_value,
    use,
)
from aurora_core.parsing.constructions.pattern_values import take_pattern_values
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.measures import COUNT, LENGTH
from aurora_core.spec.vocabulary import MissionMode, Pattern, Side

# The relations of places that are sides of somebody tracked.
_SIDES = {side.value: side for side in Side}


def take_flight_values(
    frame: Frame, mode: MissionMode | None, pattern: Pattern | None, *, above: bool = False
) -> FlightValues:
    """Take every number of a clause that belongs to the flight.

    Args:
        frame: The clause.
        mode: Decides whether a length without a name is a standoff or the altitude.
        pattern: The flown pattern, if any.
        above: `from above`: such a length is the altitude.
    """
    found = FlightValues()
    _altitude(frame, found, mode)
    _standoff(frame, found, mode, pattern)
    _side(frame, found, mode)
    _bearing(frame, found)
    take_pattern_values(frame, found, pattern)
    _bare_length(frame, found, MissionMode.HOVER if above else mode)
    _duration_and_speed(frame, found)
    _streets(frame, found)
    if frame.mark(AtomKind.IN_FLIGHT.value) is not None:
        found.ends_in_flight = True
    return found


def _altitude(frame: Frame, found: FlightValues, mode: MissionMode | None) -> None:
    adjunct = frame.attribute('altitude')
    if adjunct is not None and adjunct.measure is not None:
        parameter = ranged_value(found, 'altitude', adjunct.measure) or stated_value(
            'altitude', adjunct.measure
        )
        if parameter is not None:
            found.altitude = values.bounded(parameter, adjunct.prep)
            use(found, adjunct)
            if adjunct.nouns:
                found.target = noun_target(frame, adjunct)
                found.over_streets = any(n.kind is NounKind.STREET for n in adjunct.nouns)
            return
    plain = frame.length('to')
    climbs = frame.key in ('ascend', 'descend', 'fly', 'reach')
    if plain is not None and climbs and plain.measure is not None:
        parameter = stated_value('altitude', plain.measure)
        if parameter is not None:
            found.altitude = parameter
            use(found, plain)


def _standoff(
    frame: Frame, found: FlightValues, mode: MissionMode | None, pattern: Pattern | None
) -> None:
    adjunct = frame.attribute('standoff', 'gap', 'away') or _round_it(frame)
    if adjunct is not None and adjunct.measure is not None:
        if adjunct.prep == 'within' or keeps_off(frame, adjunct):
            return  # `within 20 m of it` is a condition
        name = 'orbit_radius' if pattern is Pattern.ORBIT else 'standoff'
        parameter = stated_value(name, adjunct.measure)
        if name == 'standoff':
            parameter = ranged_value(found, name, adjunct.measure) or parameter
        if parameter is not None:
            if pattern is Pattern.ORBIT:
                found.radius = parameter
            else:
                found.standoff = values.bounded(parameter, adjunct.prep)
            use(found, adjunct)
            if adjunct.nouns:
                found.target = noun_target(frame, adjunct)
        return
    for place in frame.free(AdjunctKind.PLACE):
        if place.key in ('compass', 'oncoming') or place.measure is None:
            continue
        if _of_the_target(frame, place):
            continue
        if place.key in _SIDES and mode not in (MissionMode.TRACK, None):
            continue  # who hovers over it keeps to no side of it
        parameter = stated_value('standoff', place.measure)
        if parameter is None:
            continue
        found.standoff = parameter
        found.side = _SIDES.get(place.key)
        use(found, place)
        if place.nouns:
            found.target = noun_target(frame, place)
        return


def _of_the_target(frame: Frame, place: Adjunct) -> bool:
    """`follows the truck behind the ego`: where the truck is, not the UAV."""
    named = [n for n in place.nouns if n.kind is not NounKind.PRONOUN]
    return bool(named) and any(a.kind is AdjunctKind.OBJECT and a.nouns for a in frame.adjuncts)


def _side(frame: Frame, found: FlightValues, mode: MissionMode | None) -> None:
    """Take `from the left`, `ahead of the bus`: which side of whom it tracks."""
    for place in frame.free(AdjunctKind.PLACE, *_SIDES):
        tracks = mode in (MissionMode.TRACK, None) and not _of_the_target(frame, place)
        if place.measure is None and tracks and found.side is None:
            found.side = _SIDES[place.key]
            use(found, place)
            if place.nouns:
                found.target = noun_target(frame, place)


def _round_it(frame: Frame) -> Adjunct | None:
    """Return the length of `circles 40 m around it`: how far away, no height."""
    round_it = (a for a in frame.adjuncts if a.kind is AdjunctKind.PHRASE and a.key == 'around')
    starts = {a.start for a in round_it}
    lengths = (a for a in frame.free(AdjunctKind.MEASURE, LENGTH) if a.prep == '')
    return next((a for a in lengths if {a.end, a.end + 1} & starts), None)


def _bearing(frame: Frame, found: FlightValues) -> None:
    compass = frame.free(AdjunctKind.PLACE, 'compass')
    if compass:
        place = compass[0]
        found.bearing = values.stated('bearing', float(place.value), place.start, place.end)
        if place.measure is not None:
            found.standoff = stated_value('standoff', place.measure)
        if place.measure is None or found.standoff is not None:
            use(found, place)
        if place.nouns:
            found.target = noun_target(frame, place)
        return
    adjunct = frame.attribute('bearing')
    if adjunct is not None and adjunct.measure is not None:
        found.bearing = stated_value('bearing', adjunct.measure)
        if found.bearing is not None:
            use(found, adjunct)


def _bare_length(frame: Frame, found: FlightValues, mode: MissionMode | None) -> None:
    """A length without a name: a standoff when tracking, else the altitude."""
    for adjunct in frame.free(AdjunctKind.MEASURE, LENGTH):
        measure = adjunct.measure
        if measure is None or measure.second is not None or keeps_off(frame, adjunct):
            continue
        behind = frame.scene.prompt[adjunct.end :].lstrip().lower()
        if behind.startswith(('between', 'apart')):
            continue  # a separation
        if frame.scene.prompt[: adjunct.start].rstrip().lower().endswith(' for'):
            continue  # a way: `follows the truck for 400 m`
        keeps = frame.key == 'keep' and mode is None and _follows_somebody(frame)
        hangs = adjunct.prep == 'at' and any(  # `above the ego at 40 m`
            a.kind is AdjunctKind.PHRASE and a.key == 'over' and a.end <= adjunct.start
            for a in frame.adjuncts
        )
        away = found.standoff is not None and adjunct.prep == 'at'  # `30 m behind it at 25 m`
        flying = _of_the_flyer(frame, adjunct)  # `a drone at 30 m tracks the bus`
        above = hangs or away or flying
        tracking = (mode is MissionMode.TRACK and not above) or keeps
        tracking = tracking or (
            mode is None
            and adjunct.prep == 'from'
            and bool(frame.scene.missions)
            and _follows_somebody(frame)
        )
        if tracking and adjunct.prep in ('from', 'at', '', 'by', 'with'):
            if found.standoff is None:
                found.standoff = ranged_value(found, 'standoff', measure) or values.explicit(
                    'standoff', measure
                )
                use(found, adjunct)
        elif (
            not tracking
            and adjunct.prep in ('at', '', 'to', 'from', 'in', 'with', 'below', 'beyond')
            and found.altitude is None
        ):
            found.altitude = ranged_value(found, 'altitude', measure) or values.bounded(
                values.explicit('altitude', measure), adjunct.prep
            )
            use(found, adjunct)


def _follows_somebody(frame: Frame) -> bool:
    """`it stays at 40 m`: away from whom it tracks; who hovers has a height only."""
    drafts = frame.scene.missions
    return not drafts or drafts[-1].mode is MissionMode.TRACK


def _of_the_flyer(frame: Frame, adjunct: Adjunct) -> bool:
    """Return whether a length stands between the UAV and what it does."""
    nouns = [n for n in frame.subject_nouns if n.kind is NounKind.UAV]
    if not nouns or frame.verb is None or adjunct.prep not in ('at', ''):
        return False
    return nouns[-1].end <= adjunct.start and adjunct.end <= frame.verb.start


def _duration_and_speed(frame: Frame, found: FlightValues) -> None:
    adjunct = frame.time('for', '', 'of', 'over') or frame.attribute('duration')
    if adjunct is not None and adjunct.measure is not None and _not_after(frame, adjunct):
        found.duration = stated_value('mission_duration', adjunct.measure)
        if found.duration is not None:
            use(found, adjunct)
    speed = frame.attribute('speed')
    if speed is not None and speed.measure is not None and speed.measure.dimension != COUNT:
        found.speed = stated_value('uav_speed', speed.measure)
        if found.speed is not None:
            use(found, speed)


def _not_after(frame: Frame, adjunct: Adjunct) -> bool:
    return not frame.has_mark(AtomKind.FROM_START.value) or adjunct.prep == 'for'


def _streets(frame: Frame, found: FlightValues) -> None:
    if frame.mark(AtomKind.STREETS_FLAG.value) is not None:
        found.over_streets = True
    for adjunct in frame.free(AdjunctKind.PHRASE, 'over', 'along'):
        if any(n.kind is NounKind.STREET for n in adjunct.nouns):
            found.over_streets = True
            use(found, adjunct)
