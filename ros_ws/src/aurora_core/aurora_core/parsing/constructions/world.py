# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`in clear weather at midday`, `heavy traffic`, `the scenario lasts two minutes`."""

from __future__ import annotations

from aurora_core.parsing import values
from aurora_core.parsing.adjuncts import Adjunct, AdjunctKind
from aurora_core.parsing.atoms import ACTORS, AtomKind
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.measures import ANGLE, TIME
from aurora_core.spec.parameter import Bound, Span
from aurora_core.spec.vocabulary import RelativeWind, TimeOfDay, TrafficDensity, Weather

WORLD_ID = 'world'
_BETWEEN = (
    'of',
    'for',
    'exactly',
    'lasting',
    'this',
    'in',
    'with',
    'a',
    'just',
    'only',
    'over',
    'length',
)
_LASTING = ('last', 'trace', 'be', 'keep', 'finish', '')


def world_words(frame: Frame) -> bool:
    """Take weather, time of day and traffic wherever they stand."""
    found = False
    for mark in frame.free(AdjunctKind.MARK, AtomKind.WORLD.value):
        mark.used = _set(frame, mark)
        found = found or mark.used
    for mark in frame.free(AdjunctKind.MARK, AtomKind.NO_TRAFFIC.value):
        mark.used = found = True
    found = _wind(frame) or found
    found = _gusts(frame) or found
    found = _duration(frame) or found
    if found:
        frame.scene.became(WORLD_ID)
    return found


def _set(frame: Frame, mark: Adjunct) -> bool:
    if frame.negated:
        return False
    field, _, word = mark.value.partition(':')
    world = frame.scene.world
    span = Span(start=mark.start, end=mark.end)
    if field == 'weather':
        weather = Weather(word)
        if world.weather is not None and world.weather is not weather:
            return _clash(frame, 'weather', world.weather.value, word)
        world.weather, world.weather_span = weather, span
    elif field == 'time_of_day':
        time_of_day = TimeOfDay(word)
        if world.time_of_day is not None and world.time_of_day is not time_of_day:
            return _clash(frame, 'time of day', world.time_of_day.value, word)
        world.time_of_day, world.time_of_day_span = time_of_day, span
    else:
        traffic = TrafficDensity(word)
        if world.traffic is not None and world.traffic is not traffic:
            return _clash(frame, 'traffic', world.traffic.value, word)
        world.traffic = traffic
    return True


def _wind(frame: Frame) -> bool:
    """Take `a wind of 6 m/s from the west`, `an 8 m/s crosswind`, `in a headwind`."""
    names = ('wind', *(w.value for w in RelativeWind))
    told = frame.attribute(*names)
    bare = [m for m in frame.free(AdjunctKind.MARK, 'thing') if m.value in names]
    speed = told or (frame.attribute('speed') if bare and not frame.subject_nouns else None)
    if frame.negated or not (told or bare):
        return False
    name = told.key if told is not None else bare[0].value
    world = frame.scene.world
    if speed is not None and speed.measure is not None:
        if not values.accepts('wind_speed', speed.measure):
            return False
        world.wind_speed = values.explicit('wind_speed', speed.measure)
        speed.used = True
    elif name == 'wind':  # how strong it is remains open
        frame.flag(bare[0].start, bare[0].end)
        return False
    if name != 'wind':
        world.wind = RelativeWind(name)
    for mark in bare:
        mark.used = True
    ends = [(a.start, a.end) for a in (told, speed, *bare) if a is not None]
    if speed is not None and speed.measure is not None:
        ends.append((speed.measure.start, speed.measure.end))
    for place in frame.free(AdjunctKind.PLACE, 'compass'):
        if place.measure is None and not place.nouns and _beside(frame, place, ends):
            place.used = True
            bearing = float(place.value)
            world.wind_from = values.stated('wind_from', bearing, place.start, place.end)
    for angle in frame.free(AdjunctKind.MEASURE, ANGLE):
        if angle.prep == 'from' and angle.measure is not None and _beside(frame, angle, ends):
            angle.used = True
            world.wind_from = values.explicit('wind_from', angle.measure)
    return True


def _gusts(frame: Frame) -> bool:
    """Take `gusts of 12 m/s`: the speed of the wind in them, which is above that of the wind."""
    told, world = frame.attribute('gust'), frame.scene.world
    for mark in frame.free(AdjunctKind.MARK, 'thing'):
        if mark.value == 'gust':  # how strong they are remains open
            frame.flag(mark.start, mark.end)
    if told is None or told.measure is None or frame.negated:
        return False
    mean_mps = 0.0 if world.wind_speed is None else world.wind_speed.value
    if told.measure.value <= mean_mps or not values.accepts('gust_speed', told.measure):
        return False
    told.used = True
    world.gust = values.explicit('gust_speed', told.measure)
    return True


def _beside(frame: Frame, adjunct: Adjunct, ends: list[tuple[int, int]]) -> bool:
    """Tell whether an adjunct belongs to the wind that is named at some stretches."""
    text = frame.scene.prompt
    if frame.key == 'be':  # the clause is about the wind alone
        return True
    gaps = [text[min(end, adjunct.end) : max(start, adjunct.start)] for start, end in ends]
    return any(not gap.strip(' ,') for gap in gaps)


def _clash(frame: Frame, what: str, first: str, second: str) -> bool:
    frame.scene.questions.append(f'Which {what} do you mean: {first} or {second}?')
    return True


def _duration(frame: Frame) -> bool:
    """A time beside the word for the whole scenario is the horizon."""
    if _next_to_its_name(frame) or _alone(frame):
        return True
    if frame.has_mark(AtomKind.IN_VIEW.value):
        return False  # `visible for 15 s in total`
    if not frame.has_mark(AtomKind.SCENARIO.value) or frame.key not in _LASTING:
        return False
    longest = frame.negated and frame.key == 'last'  # `must not last longer than 120 s`
    if frame.subject_nouns or (frame.negated and not longest):
        return False
    for adjunct in frame.free(AdjunctKind.MEASURE, TIME) + frame.free(
        AdjunctKind.ATTRIBUTE, 'duration'
    ):
        measure = adjunct.measure
        allowed = adjunct.prep in ('', 'for', 'of', 'with', 'below', 'within')
        allowed = adjunct.prep == 'beyond' if longest else allowed
        if measure is not None and allowed and values.accepts('scenario_duration', measure):
            adjunct.used = True
            duration = values.explicit('scenario_duration', measure)
            if adjunct.prep in ('below', 'within') or longest:
                duration = values.rebound(duration, Bound.AT_MOST)
            frame.scene.world.duration = duration
            return True
    return False


def _next_to_its_name(frame: Frame) -> bool:
    """`simulate thirty minutes during which …`, `a scenario of 90 s with …`."""
    for mark in frame.free(AdjunctKind.MARK, AtomKind.SCENARIO.value):
        for adjunct in frame.free(AdjunctKind.MEASURE, TIME):
            between = frame.scene.prompt[mark.end : adjunct.start].lower().split()
            if all(word in _BETWEEN for word in between) and adjunct.start >= mark.end:
                return _take(frame, adjunct)
    return False


def _alone(frame: Frame) -> bool:
    """`duration 180 s` among words about the world, or before anything flies."""
    told = any(a.used and a.key == AtomKind.WORLD.value for a in frame.adjuncts)
    adjunct = frame.attribute('duration')
    if adjunct is None and told and len(frame.free(AdjunctKind.MEASURE)) == 1:
        adjunct = frame.time('')  # `rain, night, 90 s`
    others = [n for n in frame.nouns() if n.kind in ACTORS]
    if adjunct is None or frame.verb is not None or others:
        return False
    flown = frame.scene.missions
    timed = all(m.duration is not None for m in flown)  # they have durations of their own
    return (told or timed) and _take(frame, adjunct)


def _take(frame: Frame, adjunct: Adjunct) -> bool:
    measure = adjunct.measure
    if measure is None or not values.accepts('scenario_duration', measure):
        return False
    adjunct.used = True
    frame.scene.world.duration = values.explicit('scenario_duration', measure)
    return True
