# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers of a reading against the numbers of the prompt: none invented, none lost.

An explicit value is never taken from the model: it only points at the words, and the value, the
bound and the span are read from them.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import permutations

from aurora_core.parsing import values
from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.llm.facts import PromptFacts, inside, overlap
from aurora_core.parsing.llm.reading import Number
from aurora_core.parsing.measures import COUNT, TIME, UNREADABLE, Measure
from aurora_core.parsing.values import default
from aurora_core.spec.parameter import Bound, Parameter, Span, Unit

# A model may round `60 feet` to 18.29 m; what counts is what the prompt says.
_ROUNDING = 0.01
# Behind these `up to` is a bound, elsewhere it may be a way up.
_BOUNDING = (' at', ' of', ' to', ' altitudes', ' heights', ' from')
_ONE_SIDED = ('altitude', 'standoff', 'link_loss', 'link_latency', 'link_range')
_ACROSS = ('diameter', 'across', 'wide')
_BESIDE_CHARACTERS = 16
# What words state without a number.
_ZERO = re.compile(r'\bloss-?less\b|-free\b|\bfree of\b|\bzero\b')
_REST = re.compile(r'\bstandstill|\bhalts?\b|\bat rest\b|\bstops?\b|\bstationary')
_ALL = re.compile(r'\b(?:all|always|constant|continuous|every|whole|throughout|entire)')
_AT_ONCE = re.compile(r'\bimmediate|\binstant|\bat once\b|\bzero\b')
_EVERY_SECOND = re.compile(r'\b(?:every|each|per|a) second\b')
_EVERY_MINUTE = re.compile(r'\b(?:every|each|per|a) minute\b')
_HALF = re.compile(r'\bhalf\b')
_WORDS = {
    Unit.ONE: ((_ZERO, 0.0), (_ALL, 1.0), (_HALF, 0.5)),
    Unit.SECOND: ((_AT_ONCE, 0.0), (_EVERY_SECOND, 1.0), (_EVERY_MINUTE, 60.0)),
    Unit.METRE_PER_SECOND: ((_REST, 0.0),),
}
_ONE_IN = re.compile(r'\b(?:one|1)\b.*\b(?:in|of)\b', re.IGNORECASE)
# What opens the same number in other words.
_AGAIN = re.compile(r'(?:\(|=|i\.\s?e\.,?|that is,?)\s*$', re.IGNORECASE)
# `once a second`, `twice per minute`: per second.
_OFTEN = re.compile(r'\b(once|twice|one|every)\b.*\b(second|minute)\b')
_TIMES = {'once': 1.0, 'one': 1.0, 'every': 1.0, 'twice': 2.0}
_PERIODS_S = {'second': 1.0, 'minute': 60.0}
# What one stated number may be at once: `closing from 45 m`, `a square of 50 m`, `reaches 40 m`.
_TOGETHER = (
    {'closing_from', 'placement_distance'},
    {'pattern_length', 'pattern_width'},
)

# What the schema counts beside bodies.
_COUNTED = frozenset(
    {AtomKind.LINK, AtomKind.MESSAGE, AtomKind.PATTERN, AtomKind.ROUTE, AtomKind.THING}
)
_MULTIPLES = frozenset({'once', 'twice', 'thrice'})
# What two stated values may give: the end of what begins at one and lasts for the other, the
# distance from the middle of a zone; of a speed, what is left of one that is stated elsewhere.
_WORKED_OUT = frozenset({'condition_time', 'link_outage', 'trigger_distance', 'trigger_time'})
_LEFT_OF = frozenset({'ground_speed'})
# What is triggered, or demanded, of what a number says elsewhere.
_OF_WHAT_IS_SAID = frozenset(
    {
        *('condition_distance', 'condition_ratio', 'condition_speed', 'condition_time'),
        *('trigger_distance', 'trigger_speed', 'trigger_time'),
    }
)


class StatedNumbers:
    """Turns the numbers of one reading into parameters and keeps account.

    Args:
        facts: The prompt.
        unread: Clauses that are admitted not to be encoded.
        complaints: Where objections go, worded for the model.
        groups: How many bodies the answer has: on the ground, in the air, together.
    """

    def __init__(
        self,
        facts: PromptFacts,
        unread: Sequence[Span],
        complaints: list[str],
        groups: Sequence[int] = (),
    ) -> None:
        self._facts = facts
        self._groups = groups
        self._unread = unread
        self._complaints = complaints
        self._claimed: dict[tuple[int, int], str] = {}
        self._values: list[float] = []

    def parameter(self, name: str, number: Number, where: str) -> Parameter:
        """Return the parameter of a number.

        Args:
            name: Its line in `defaults.yaml`.
            number: What the model says.
            where: Field, for objections. With an objection the default stands in: the reading is
                turned down anyway, and the remaining checks go on.
        """
        line = values.default(name)
        if number.unit is not line.unit:
            self._complaints.append(
                f'{where}: expected the unit {line.unit.value!r}, found {number.unit.value!r}'
            )
            return line
        if number.provenance == 'explicit':
            self._values.append(number.value)
            return self._explicit(name, number, where)
        if number.value == line.value:
            return line
        derived = self._derived(name, number)
        if derived is not None:
            return derived
        if not line.low <= number.value <= line.high:
            self._complaints.append(
                f'{where}: an inferred value must be in {line.low:g} to {line.high:g}, found '
                f'{number.value:g}; use null for the default'
            )
            return line
        return values.inferred(name, number.value)

    def lost(self, counted: Callable[[Atom], int]) -> None:
        """Object to every stated number that is in no parameter and in no unread clause.

        Args:
            counted: How many actors stand for the words that name them.
        """
        for measure in self._facts.measures:
            if self._facts.only_names(measure) or self._is_again(measure):
                continue
            if self._is_unread(measure) or self._counts_actors(measure, counted):
                continue
            words = self._facts.text(measure)
            if measure.dimension == UNREADABLE:
                self._complaints.append(
                    f'{words!r} cannot be read as a number: its clause must be not_encoded'
                )
            elif any((measure.start, part) not in self._claimed for part in _parts(measure)):
                both = ', both of its numbers' if len(_parts(measure)) > 1 else ''
                self._complaints.append(
                    f'the prompt states {words!r}{both}, and no explicit number quotes it: encode '
                    'it, or make its clause not_encoded'
                )

    def _is_again(self, measure: Measure) -> bool:
        """`two minutes (120 s)`, `one in ten, i.e. 10 %`: the same number in other words."""
        before = self._facts.prompt[: measure.start]
        behind = self._facts.prompt[measure.end :].lstrip()
        told = _AGAIN.search(before) is not None or behind.startswith(('(', '=', 'i.e.'))
        return told and any(_close(measure.value, value) for value in self._values)

    def _counts_actors(self, measure: Measure, counted: Callable[[Atom], int]) -> bool:
        """`at least two cars` that became two; `all three`, `two of them`: who is there anyway.

        In words nothing but turns, waypoints, messages and the like is counted beside bodies.
        """
        if measure.dimension != COUNT:
            return False
        behind = next((a for a in self._facts.atoms if a.start >= measure.end), None)
        if behind is not None and behind.is_actor:
            return counted(behind) == measure.value
        text = self._facts.text(measure)
        if any(c.isdigit() for c in text) or text.lower() in _MULTIPLES:
            return False
        if behind is not None and behind.kind is AtomKind.UNKNOWN:  # `five participants`
            return measure.value in self._groups
        return behind is None or behind.kind not in _COUNTED

    def _is_unread(self, measure: Measure) -> bool:
        return any(inside(measure, clause) for clause in self._unread)

    def _explicit(self, name: str, number: Number, where: str) -> Parameter:
        spans = self._facts.spans(number.quote)
        if not spans:
            self._complaints.append(
                f'{where}: the quote {number.quote!r} is not in the prompt; quote the words that '
                'state the number, or use null'
            )
            return values.default(name)
        beside = [m for m in self._facts.measures if any(overlap(m, s) for s in spans)]
        fits = [
            (measure, part, value)
            for measure in beside
            for part, value in self._meanings(name, measure)
            if _close(value, number.value)
        ]
        if fits:
            free = [f for f in fits if (f[0].start, f[1]) not in self._claimed]
            # `80 m` twice, and one of them in an unread clause: the other is meant.
            free.sort(key=lambda fit: self._is_unread(fit[0]))
            measure, part, value = (free or fits)[0]
            before = self._claimed.setdefault((measure.start, part), name)
            if before != name and self._has_another(before, measure, fits):
                before = self._claimed[measure.start, part] = name
            if before != name and not _may_share(before, name):
                self._complaints.append(
                    f'{where}: {self._facts.text(measure)!r} is the {before} already; one stated '
                    'number has one meaning'
                )
            return self._as_stated(name, measure, part, value)
        chosen = self._out_of_a_range(name, number, beside)
        if chosen is not None:
            return chosen
        worded = self._in_words(name, number, spans)
        if worded is not None:
            return worded
        stated = ', '.join(repr(self._facts.text(m)) for m in beside) or 'no number'
        self._complaints.append(
            f'{where}: {number.value:g} {number.unit.value} is not what {number.quote!r} says '
            f'(it states {stated}); an explicit number is the stated one in SI units, anything '
            'else is null or inferred'
        )
        return values.default(name)

    def _out_of_a_range(
        self, name: str, number: Number, beside: Sequence[Measure]
    ) -> Parameter | None:
        """`at between 30 and 40 m`: any height of these; a demand has two ends instead."""
        for measure in beside:
            upper = measure.upper
            fits = values.accepts(name, replace(measure, upper=None))
            if upper is None or not fits or name in _OF_WHAT_IS_SAID:
                continue
            if measure.value <= number.value <= upper:
                self._claimed[measure.start, 0] = self._claimed[measure.start, 1] = name
                return values.ranged(name, measure)
        return None

    def _has_another(
        self, name: str, measure: Measure, fits: Sequence[tuple[Measure, int, float]]
    ) -> bool:
        """Tell whether the words `10 m` stand twice and one parameter has taken both."""
        others = [m for m, part, _ in fits if self._claimed.get((m.start, part)) == name]
        return any(other.start != measure.start for other in others)

    def _derived(self, name: str, number: Number) -> Parameter | None:
        """Return a value that two stated ones give: cut at 40 s for 5 s, so until 45 s.

        It has no other value in its domain, as they have none, and it accounts for them. Heights
        and lengths are not worked out: that of two stated ones would lose both.
        """
        if name not in _WORKED_OUT | _LEFT_OF:
            return None
        fits = [m for m in self._facts.measures if values.accepts(name, m)]
        for one, other in permutations(fits, 2):
            value = next(
                (
                    v
                    for v in (one.value + other.value, one.value - other.value)
                    if v > 0.0 and _close(v, number.value)
                ),
                None,
            )
            free = [m for m in (one, other) if (m.start, 0) not in self._claimed]
            if value is None or not free or (name in _LEFT_OF and len(free) > 1):
                continue
            for measure in free:
                self._claimed[measure.start, 0] = 'condition_time'
            bound = {'value': value, 'low': value, 'high': value, 'provenance': 'inferred'}
            return Parameter.model_validate(default(name).model_dump() | bound)
        return None

    def _meanings(self, name: str, measure: Measure) -> list[tuple[int, float]]:
        """Return what a measure may mean for a parameter: which of its numbers, and the value."""
        if name == 'link_rate' and measure.dimension == TIME and measure.value > 0.0:
            return [(0, 1.0 / measure.value)]  # `every 2 s`
        if measure.dimension == COUNT and measure.value == 0.0 and measure.upper is None:
            return [(0, 0.0)]  # `from 0 to 30 km/h`: nothing has any unit
        if not values.accepts(name, replace(measure, upper=None, second=None)):
            return []
        found = [(0, measure.value)]
        if measure.upper is not None:
            found.append((1, measure.upper))
        if measure.second is not None:
            if name not in ('pattern_length', 'pattern_width'):
                return []
            found.append((1, measure.second))
        if name == 'orbit_radius' and self._is_across(measure):
            found = [(part, value / 2) for part, value in found]
        return found

    def _is_across(self, measure: Measure) -> bool:
        start = max(0, measure.start - _BESIDE_CHARACTERS)
        beside = self._facts.prompt[start : measure.end + _BESIDE_CHARACTERS].lower()
        return any(word in beside for word in _ACROSS)

    def _as_stated(self, name: str, measure: Measure, part: int, value: float) -> Parameter:
        start = measure.start
        if part and measure.second_start is not None:
            start = measure.second_start
        found = values.explicit(name, replace(measure, value=value, start=start))
        if found.bound is Bound.EXACTLY and name in _ONE_SIDED:
            return values.bounded(found, self._preposition(measure))
        if found.bound is Bound.AT_MOST and name == 'altitude' and self._leads_up(measure):
            return found.model_copy(update={'bound': Bound.EXACTLY})
        return found

    def _leads_up(self, measure: Measure) -> bool:
        """`climbs up to 60 m`: where it goes. `At up to 60 m` it is a bound."""
        text = self._facts.prompt[: measure.end].lower()
        before, up_to, _ = text.rpartition('up to ')
        near = bool(up_to) and len(before) + len(up_to) >= measure.start - 1
        return near and not before.rstrip().endswith(_BOUNDING)

    def _preposition(self, measure: Measure) -> str:
        """Return the meaning of the word before a number (`below 50 m`: below)."""
        before = [a for a in self._facts.atoms if a.end <= measure.start]
        holds = [a for a in self._facts.atoms if a.measure is measure]
        last = [a for a in before if not holds or a.end <= holds[0].start][-1:]
        return last[0].key if last and last[0].kind is AtomKind.PREPOSITION else ''

    def _one_in(self, name: str, number: Number, spans: Sequence[Span]) -> Parameter | None:
        """`one in twenty`, `one message out of five`: a share."""
        said = [s for s in spans if _ONE_IN.search(self._facts.text(s))]
        for measure in self._facts.measures if default(name).unit is Unit.ONE else ():
            within = [s for s in said if inside(measure, s)]
            counts = measure.dimension == COUNT and measure.value > 1.0
            if within and counts and _close(1.0 / measure.value, number.value):
                self._claimed.setdefault((measure.start, 0), name)
                return values.stated(name, 1.0 / measure.value, within[0].start, within[0].end)
        return None

    def _in_words(self, name: str, number: Number, spans: Sequence[Span]) -> Parameter | None:
        """`from the north`, `lossless`, `half of the time`: stated without a number."""
        text = self._facts.text(spans[0]).lower()
        if name == 'scene_count':
            told = [a.noun for a in self._facts.actors if any(overlap(a, s) for s in spans)]
            if any(n is not None and (n.count or 1) == number.value for n in told):
                return values.stated(name, number.value, spans[0].start, spans[0].end)
        shared = self._one_in(name, number, spans)
        if shared is not None:
            return shared
        for words, value in _WORDS.get(default(name).unit, ()):
            if words.search(text) and _close(value, number.value):
                return values.stated(name, value, spans[0].start, spans[0].end)
        often = _OFTEN.search(text) if name == 'link_rate' else None
        if often is not None and _close(_TIMES[often[1]] / _PERIODS_S[often[2]], number.value):
            return values.stated(name, number.value, spans[0].start, spans[0].end)
        before = [a for a in self._facts.atoms if a.end <= spans[0].start][-1:]
        for atom in self._facts.atoms:
            if not any(overlap(atom, span) for span in spans) and atom not in before:
                continue
            north = name in ('bearing', 'wind_from') and atom.kind is AtomKind.COMPASS
            if north and _close(float(atom.key) % 360, number.value % 360):
                return values.stated(name, float(atom.key), atom.start, atom.end)
            if atom.kind is AtomKind.NEGATION and number.value == 0:
                return values.stated(name, 0, spans[0].start, spans[0].end)
        return None


def _parts(measure: Measure) -> tuple[int, ...]:
    return (0,) if measure.upper is None and measure.second is None else (0, 1)


def _may_share(one: str, other: str) -> bool:
    """Tell whether one stated number may be both: `stops out of the range of 400 m`."""
    return {one, other} in _TOGETHER or one in _OF_WHAT_IS_SAID or other in _OF_WHAT_IS_SAID


def _close(stated: float, said: float) -> bool:
    return abs(stated - said) <= _ROUNDING * abs(stated)
