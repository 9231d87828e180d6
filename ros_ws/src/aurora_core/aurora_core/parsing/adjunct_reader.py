# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Groups the atoms around a predicate into adjuncts."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from aurora_core.parsing.adjuncts import MUTUAL, Adjunct, AdjunctKind
from aurora_core.parsing.atoms import Atom, AtomKind, NounKind, NounPhrase
from aurora_core.parsing.measures import ANGLE, COUNT, LENGTH, RATIO, SPEED, TIME, Measure

_DROPPED = (
    AtomKind.FILL,
    AtomKind.FRAME,
    AtomKind.AUXILIARY,
    AtomKind.CAUSATIVE,
    AtomKind.NEGATION,
    AtomKind.THEN,
    AtomKind.SUBORDINATOR,
    AtomKind.RELATIVE,
    AtomKind.COMMA,
)


# What a measure in front of a thing may measure, so that `20 m bus stop` stays apart.
_FITS = {
    'altitude': (LENGTH, COUNT),
    'altitude_suffix': (LENGTH, COUNT),
    'standoff': (LENGTH, COUNT),
    'gap': (LENGTH, TIME, COUNT),
    'separation': (LENGTH, COUNT),
    'speed': (SPEED, COUNT),
    'radius': (LENGTH, COUNT),
    'diameter': (LENGTH, COUNT),
    'length': (LENGTH, COUNT),
    'width': (LENGTH, COUNT),
    'duration': (TIME, COUNT),
    'loss': (RATIO, COUNT),
    'latency': (TIME,),
    'radio_range': (LENGTH,),
    'retransmissions': (COUNT,),
    'waypoint': (COUNT,),
    'turn': (COUNT,),
    'gust': (SPEED,),
    'wind': (SPEED,),
    'crosswind': (SPEED,),
    'headwind': (SPEED,),
    'tailwind': (SPEED,),
    'battery': (RATIO, COUNT),
    'bearing': (ANGLE, COUNT),
    'axle_time': (TIME,),
    'drift': (LENGTH,),
}


_SIDES = ('length', 'width')


def fits(thing: str, measure: Measure) -> bool:
    """Return whether a measure can be a value of the thing; `80 x 50 m` is a size."""
    if measure.second is not None and thing not in _SIDES:
        return False
    return measure.dimension in _FITS.get(thing, ())


# Prepositions that say something even where what they govern is missing (`and until then`).
_NEEDS_MORE = frozenset({'until', 'after', 'before', 'without', 'every', 'within', 'beyond'})


class AdjunctReader:
    """Groups the atoms of one clause (predicate and subject taken out)."""

    def __init__(self, atoms: Sequence[Atom]) -> None:
        self._atoms = [a for a in atoms if a.kind not in _DROPPED]
        self._respectively = any(a.key == 'respectively' for a in atoms)
        commas = [a.start for a in atoms if a.kind is AtomKind.COMMA]
        # Atoms that a comma parts from the one in front.
        self._parted = {
            atom.start
            for before, atom in pairwise(self._atoms)
            if any(before.end <= comma < atom.start for comma in commas)
        }

    def read(self) -> list[Adjunct]:
        """Return the adjuncts in the order of the text."""
        found: list[Adjunct] = []
        i = 0
        while i < len(self._atoms):
            adjunct, i = self._one(i)
            if adjunct is not None:
                found.append(adjunct)
        return found

    def _at(self, i: int) -> Atom | None:
        return self._atoms[i] if 0 <= i < len(self._atoms) else None

    def _is(self, i: int, kind: AtomKind, *keys: str) -> bool:
        atom = self._at(i)
        return atom is not None and atom.kind is kind and (not keys or atom.key in keys)

    def _one(self, i: int) -> tuple[Adjunct | None, int]:
        atom = self._atoms[i]
        if atom.kind is AtomKind.CONJUNCTION:
            return None, i + 1
        if atom.kind is AtomKind.PREPOSITION:
            return self._after_preposition(i)
        if atom.kind is AtomKind.MEASURE:
            return self._measure(i, i, '')
        if atom.kind is AtomKind.THING:
            return self._thing(i, i, '')
        if atom.kind is AtomKind.RELATION:
            return self._relation(i, i, None)
        if atom.kind is AtomKind.COMPASS:
            return self._compass(i, i, None)
        if atom.noun is not None:
            nouns, stop = self._nouns(i)
            return self._make(AdjunctKind.OBJECT, '', i, stop, nouns=nouns), stop
        return self._make(AdjunctKind.MARK, atom.kind.value, i, i + 1, value=atom.key), i + 1

    def _make(
        self,
        kind: AdjunctKind,
        key: str,
        begin: int,
        stop: int,
        *,
        prep: str = '',
        value: str = '',
        measure: Measure | None = None,
        nouns: tuple[NounPhrase, ...] = (),
    ) -> Adjunct:
        return Adjunct(
            kind=kind,
            key=key,
            start=self._atoms[begin].start,
            end=self._atoms[stop - 1].end,
            prep=prep,
            value=value,
            measure=measure,
            nouns=nouns,
        )

    def _nouns(self, i: int) -> tuple[tuple[NounPhrase, ...], int]:
        """Coordinated nouns: `the bus and the van`."""
        nouns: list[NounPhrase] = []
        j = i
        while True:
            atom = self._at(j)
            if atom is None or atom.noun is None:
                break
            nouns.append(atom.noun)
            follows = self._at(j + 2)
            joined = self._is(j + 1, AtomKind.CONJUNCTION) and follows is not None
            if joined and follows is not None and follows.noun is not None:
                j += 2
                continue
            j += 1
            break
        return tuple(nouns), j

    def _after_preposition(self, i: int) -> tuple[Adjunct | None, int]:
        prep = self._atoms[i].key
        j = i + 1
        while self._is(j, AtomKind.PREPOSITION):  # `from over the bus`, `up to within 20 m`
            prep = self._atoms[j].key
            j += 1
        follows = self._at(j)
        if follows is None:
            if prep not in _NEEDS_MORE:
                return None, j
            return self._make(AdjunctKind.MARK, 'unknown', i, j, value=prep), j
        if follows.kind is AtomKind.MEASURE:  # `high above, 80 m` is not `above 80 m`
            return self._measure(i, j, '' if follows.start in self._parted else prep)
        if follows.kind is AtomKind.THING:
            return self._thing(i, j, prep)
        if follows.kind is AtomKind.COMPASS:
            return self._compass(i, j, None)
        if follows.kind is AtomKind.RELATION:
            return self._relation(i, j, None)
        if follows.noun is not None:
            nouns, stop = self._nouns(j)
            return self._make(AdjunctKind.PHRASE, prep, i, stop, nouns=nouns), stop
        # the preposition belongs to a mark (`in the rain`, `with rectangular …`)
        mark, stop = self._one(j)
        if mark is not None and mark.kind is AdjunctKind.MARK:
            mark.prep = prep
            mark.start = self._atoms[i].start
        return mark, stop

    def _measure(self, begin: int, i: int, prep: str) -> tuple[Adjunct, int]:
        measure = self._atoms[i].measure
        assert measure is not None
        self._merge_prepositions(i, prep)
        several, stop = self._respective(i)
        if several:
            made = self._make(AdjunctKind.MARK, 'list', begin, stop, prep=prep)
            made.measures = several
            return made, stop
        heights = [measure]
        while self._is(i + len(heights), AtomKind.MEASURE, LENGTH):
            following = self._atoms[i + len(heights)].measure
            assert following is not None
            heights.append(following)
        last = i + len(heights) + 1
        shared = self._at(last)
        if (
            self._is(last - 1, AtomKind.CONJUNCTION)
            and shared is not None
            and shared.key == measure.dimension == LENGTH
            and shared.kind is AtomKind.MEASURE
        ):  # `at 30 m, 40 m and 50 m`: each of so many has one of them
            assert shared.measure is not None
            stop = last + 2 if self._is(last + 1, AtomKind.THING) else last + 1
            made = self._make(AdjunctKind.MARK, 'list', begin, stop, prep=prep)
            made.measures = (*heights, shared.measure)
            return made, stop
        j = i + 1
        if self._is(j, AtomKind.PREPOSITION, 'of', 'in') and self._is(j + 1, AtomKind.THING):
            j += 1
        thing = self._at(j)
        if (
            thing is not None
            and thing.kind is AtomKind.THING
            and fits(thing.key, measure)
            and not self._has_its_own(j)
        ):
            stop = j + 1
            if self._is(stop, AtomKind.THING, 'altitude_suffix'):  # `30 m altitude above ground`
                stop += 1
            twice = thing.key == 'standoff' and self._is(stop, AtomKind.THING, 'standoff')
            if twice and not self._is(stop + 1, AtomKind.PREPOSITION, 'of'):
                stop += 1  # `150 m away horizontally`
            return self._attribute(thing.key, begin, stop, prep, measure)
        j = i + 1
        place = self._at(j + 1)
        upstream = self._is(j, AtomKind.PREPOSITION, 'before') and place is not None
        if upstream and place is not None and place.is_place and measure.dimension == LENGTH:
            adjunct, stop = self._relation(begin, j, measure)
            adjunct.prep = prep
            return adjunct, stop
        if self._is(j, AtomKind.RELATION) and measure.dimension in (LENGTH, COUNT):
            adjunct, stop = self._relation(begin, j, measure)
            adjunct.prep = prep
            return adjunct, stop
        if (
            measure.dimension == LENGTH
            and self._is(j, AtomKind.PREPOSITION, 'to', 'on')
            and self._is(j + 1, AtomKind.COMPASS)
        ):  # `25 m to the west of it`
            return self._compass(begin, j + 1, measure)
        if self._is(j, AtomKind.COMPASS) and measure.dimension == LENGTH:
            return self._compass(begin, j, measure)
        if self._is(j, AtomKind.PREPOSITION, 'beyond', 'below') and self._at(j + 1) is not None:
            beyond = self._at(j + 1)
            if beyond is not None and beyond.measure is None:  # `10 m higher than that`
                return self._make(
                    AdjunctKind.MARK, 'unknown', begin, j + 2, value='comparison'
                ), j + 2
        one = measure.second is None and measure.upper is None
        over_it = self._is(j, AtomKind.PREPOSITION, 'over', 'below')
        # `a line of 400 m over the road`: how long it is, not how high
        sized = prep == 'of' and self._is(begin - 1, AtomKind.PATTERN)
        if measure.dimension == LENGTH and one and over_it and not sized:
            over = self._at(j + 1)
            if over is not None and over.noun is not None and self._atoms[j].key == 'over':
                nouns, stop = self._nouns(j + 1)
                ground = all(n.kind is NounKind.SURROUNDINGS for n in nouns)
                return (
                    self._make(
                        AdjunctKind.ATTRIBUTE,
                        'altitude',
                        begin,
                        stop,
                        prep='over',
                        measure=measure,
                        nouns=() if ground else nouns,
                    ),
                    stop,
                )
            if over is None:
                return self._attribute('altitude', begin, j + 1, prep, measure)
        if measure.dimension == LENGTH and self._is(j, AtomKind.PREPOSITION, 'from', 'of', 'to'):
            away = self._at(j + 1)
            if away is not None and away.is_actor:
                nouns, stop = self._nouns(j + 1)
                return (
                    self._make(
                        AdjunctKind.ATTRIBUTE,
                        'away',
                        begin,
                        stop,
                        prep=prep,
                        measure=measure,
                        nouns=nouns,
                    ),
                    stop,
                )
        if measure.dimension == SPEED:
            return self._attribute('speed', begin, i + 1, prep, measure)
        return (
            self._make(
                AdjunctKind.MEASURE, measure.dimension, begin, i + 1, prep=prep, measure=measure
            ),
            i + 1,
        )

    def _merge_prepositions(self, i: int, prep: str) -> None:
        """`from 20 m and from 60 m`: the second preposition says nothing new."""
        again = self._at(i + 2)
        if again is None or again.key != prep or not self._is(i + 1, AtomKind.CONJUNCTION):
            return
        beyond = self._at(i + 3)
        if again.kind is AtomKind.PREPOSITION and beyond is not None and beyond.key == LENGTH:
            del self._atoms[i + 2]

    def _respective(self, i: int) -> tuple[tuple[Measure, ...], int]:
        """Read `30, 45 and 60 m respectively`."""
        if not self._respectively:
            return (), i
        found: list[Measure] = []
        j = i
        while True:
            atom = self._at(j)
            if atom is None or atom.measure is None:
                break
            found.append(atom.measure)
            j += 2 if self._is(j + 1, AtomKind.CONJUNCTION) else 1
        plain = all(m.second is None and m.upper is None for m in found)
        if len(found) < 2 or not plain:
            return (), i
        if any(m.dimension != LENGTH for m in found):
            return (), i
        return tuple(found), j

    def _has_its_own(self, i: int) -> bool:
        """`200 by 100 m, height 50`: behind a comma, a name in front of a number goes with it."""
        thing, value = self._atoms[i], self._at(i + 1)
        return (
            thing.start in self._parted
            and value is not None
            and value.measure is not None
            and fits(thing.key, value.measure)
        )

    def _attribute(
        self, key: str, begin: int, stop: int, prep: str, measure: Measure
    ) -> tuple[Adjunct, int]:
        name = 'altitude' if key == 'altitude_suffix' else key
        nouns: tuple[NounPhrase, ...] = ()
        if name in ('altitude', 'standoff', 'gap', 'radius') and self._is(
            stop, AtomKind.PREPOSITION, 'from', 'of', 'to', 'over'
        ):
            of = self._at(stop + 1)
            if of is not None and (of.is_actor or of.is_place):
                nouns, stop = self._nouns(stop + 1)
        return (
            self._make(
                AdjunctKind.ATTRIBUTE, name, begin, stop, prep=prep, measure=measure, nouns=nouns
            ),
            stop,
        )

    def _thing(self, begin: int, i: int, prep: str) -> tuple[Adjunct, int]:
        """`an altitude of 30 m`, `latency 0.3 s`, `a gap to the ego of 12 m`."""
        thing = self._atoms[i].key
        j = i + 1
        nouns: tuple[NounPhrase, ...] = ()
        if self._is(j, AtomKind.PREPOSITION, 'between', 'to', 'from', 'of'):
            other = self._at(j + 1)
            if other is not None and other.noun is not None:
                nouns, j = self._nouns(j + 1)
        inner = ''
        k = j
        while self._is(k, AtomKind.PREPOSITION):
            inner = self._atoms[k].key
            k += 1
        follows = self._at(k)
        if follows is not None and follows.measure is not None and fits(thing, follows.measure):
            name = 'altitude' if thing == 'altitude_suffix' else thing
            stop = k + 1
            other = self._at(stop + 1)
            if self._is(stop, AtomKind.CONJUNCTION) and other is not None and not nouns:
                plain = other.measure is not None and other.key == follows.key == LENGTH
                if plain and other.measure is not None:  # `from distances of 20 m and 60 m`
                    made = self._make(
                        AdjunctKind.MARK, 'list', begin, stop + 2, prep=prep or inner
                    )
                    made.measures = (follows.measure, other.measure)
                    return made, stop + 2
            if self._is(stop, AtomKind.THING, 'altitude_suffix'):
                stop += 1
            return (
                self._make(
                    AdjunctKind.ATTRIBUTE,
                    name,
                    begin,
                    stop,
                    prep=inner or prep,
                    measure=follows.measure,
                    nouns=nouns,
                ),
                stop,
            )
        if nouns:
            return (
                self._make(
                    AdjunctKind.MARK, 'thing', begin, j, prep=prep, value=thing, nouns=nouns
                ),
                j,
            )
        return (self._make(AdjunctKind.MARK, 'thing', begin, i + 1, prep=prep, value=thing), i + 1)

    def _relation(self, begin: int, i: int, measure: Measure | None) -> tuple[Adjunct, int]:
        relation = self._atoms[i].key
        j = i + 1
        if self._is(j, AtomKind.PREPOSITION, 'of', 'to', 'from'):
            j += 1
        noun = self._at(j)
        nouns: tuple[NounPhrase, ...] = ()
        parted = noun is not None and noun.start in self._parted
        mutual = parted and self._atoms[i].words.replace('-', ' ').endswith(MUTUAL)
        if noun is not None and noun.noun is not None and not mutual:
            nouns, j = self._nouns(j)
        else:
            j = i + 1
        if measure is None and self._is(j, AtomKind.PREPOSITION, 'by', 'at', 'with'):
            trailing = self._at(j + 1)
            plain = trailing is not None and trailing.key == LENGTH
            beyond = self._at(j + 2)
            free = (
                beyond is None
                or beyond.kind is not AtomKind.THING
                or beyond.key in ('standoff', 'gap')
            )
            if plain and free and trailing is not None and trailing.measure is not None:
                measure, j = trailing.measure, j + 2
                if beyond is not None and beyond.kind is AtomKind.THING:
                    j += 1
        return (self._make(AdjunctKind.PLACE, relation, begin, j, measure=measure, nouns=nouns), j)

    def _compass(self, begin: int, i: int, measure: Measure | None) -> tuple[Adjunct, int]:
        """`from the north`, `30 m east of the bus`."""
        j = i + 1
        nouns: tuple[NounPhrase, ...] = ()
        if self._is(j, AtomKind.PREPOSITION, 'of', 'from'):
            other = self._at(j + 1)
            if other is not None and other.noun is not None:
                nouns, j = self._nouns(j + 1)
        return (
            self._make(
                AdjunctKind.PLACE,
                'compass',
                begin,
                j,
                value=self._atoms[i].key,
                measure=measure,
                nouns=nouns,
            ),
            j,
        )
