# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Noun phrases: determiner, count, ordinals, adjectives, head noun, index."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from aurora_core.parsing.atoms import Determiner, NounKind, NounPhrase
from aurora_core.parsing.landmarks import landmark_words
from aurora_core.parsing.lexicon import Lexicon, Tag
from aurora_core.parsing.measures import COUNT, MeasureReader
from aurora_core.parsing.noun_words import HeadReader, NounWords, prefix
from aurora_core.parsing.stand_ins import StandInReader
from aurora_core.parsing.tokens import Token, TokenKind

# Verbs whose participle may stand before a noun without an article.
_BARE_PARTICIPLES = frozenset({'park', 'stop'})
_UAV_PARTICIPLES = frozenset({'track', 'hover', 'observe', 'navigate', 'orbit', 'follow'})
_MOST_UNKNOWN = 2


# Of two, which one is meant by where it is.
_SIDES = {'ahead': 'front', 'behind': 'rear'}


class NounReader:
    """Reads noun phrases from a token list."""

    def __init__(
        self,
        tokens: Sequence[Token],
        words: Sequence[str],
        lexicon: Lexicon,
        measures: MeasureReader,
        landmarks: Mapping[tuple[str, ...], str],
    ) -> None:
        self._said = NounWords(tokens=tokens, words=words, lexicon=lexicon, measures=measures)
        self._heads = HeadReader(self._said, landmarks)
        self._stand_ins = StandInReader(self._said)

    def read(self, i: int) -> tuple[NounPhrase, int] | None:
        """Return the noun phrase that starts at token i and the next index, None if none does."""
        if self._said.measures.is_part(i):
            return None
        alone = self._stand_ins.letter(i) or self._stand_ins.ordinal_alone(i)
        if alone is not None:
            return alone
        j = i
        determiner = Determiner.BARE
        count, index, background = 0, 0, False
        labels: list[str] = []
        states: list[str] = []
        loose: list[int] = []
        while j < len(self._said.words):
            head = self._heads.read(j)
            if head is not None:
                kind, key, head_text, is_plural, stop = head
                # `the aircraft are`: one word for one and for many
                many = self._said.words[stop : stop + 1] in (['are'], ['were'], ['have'])
                is_plural = is_plural or (head_text.endswith('craft') and many)
                if kind is NounKind.SURROUNDINGS and self._heads.read(stop) is not None:
                    j = stop  # `the downtown streets`
                    continue
                if loose and kind is NounKind.UNKNOWN:
                    return None
                if self._refuses(kind, states, determiner, i, is_first=i == j):
                    return None
                proper = [k for k in loose if self._said.tokens[k].proper]
                if kind is NounKind.LANDMARK and proper and stop - j < len(landmark_words(key)):
                    # `the Eiffel Tower` is not the one tower that the map has
                    kind = NounKind.MISSING_LANDMARK
                    key = head_text = ' '.join(self._said.words[proper[0] : stop])
                    loose = []
                stop = self._heads.behind_place(kind, stop)
                named = not count and (not is_plural or self._listed(stop))
                number, stop = self._index(kind, stop) if named else (0, stop)
                return (
                    NounPhrase(
                        kind=kind,
                        key=key,
                        start=self._said.tokens[i].start,
                        end=self._said.tokens[stop - 1].end,
                        head_text=head_text,
                        determiner=determiner,
                        count=count,
                        plural=is_plural,
                        labels=frozenset(labels),
                        states=tuple(states),
                        background=background,
                        index=index or number,
                        loose=tuple(
                            (self._said.tokens[k].start, self._said.tokens[k].end) for k in loose
                        ),
                    ),
                    stop,
                )
            if count and self._said.words[j] == 'other':
                j += 1  # `ten other cars`
                continue
            if loose and self._said.words[j] == "'s":
                loose = []  # `the surveyor's drone`: whose it is says nothing
                j += 1
                continue
            one = determiner is Determiner.DEFINITE and self._said.words[j] == 'one' and not count
            placed = self._said.has(j + 1, Tag.RELATION) and not self._said.has(i, Tag.PRONOUN)
            if one and (labels or placed):
                # `the red one`, `the one behind it`
                return self._one_of_them(i, j, frozenset(labels))
            if labels and determiner is Determiner.INDEFINITE and self._said.words[j] == 'one':
                like, stop = self._one_of_them(i, j, frozenset(labels))  # `a red one`
                kin = replace(like, kind=NounKind.PRONOUN, key='another')
                return replace(kin, determiner=determiner), stop
            step = prefix(self._said, j, determiner)
            if step is None:
                if j == i or (determiner is Determiner.BARE and not count):
                    break
                if len(loose) >= _MOST_UNKNOWN or not self._said.is_unknown(j):
                    break
                loose.append(j)
                j += 1
                continue
            tag, sense_key, j = step
            if tag == 'count':
                if count or labels:
                    break
                count = int(sense_key)
                determiner = (
                    Determiner.ONE if count == 1 and determiner is Determiner.BARE else determiner
                )
            elif tag == 'determiner':
                if states or labels or index:
                    break  # `tracking the van`: the participle is a verb
                determiner = Determiner(sense_key)
            elif tag == 'ordinal':
                index = int(sense_key)
            elif tag == 'background':
                background = True
            elif tag == 'state':
                states.append(sense_key)
            elif sense_key:
                labels.append(sense_key)
        return self._stand_ins.pronoun(i) or self._unknown(i)

    def _one_of_them(self, i: int, j: int, labels: frozenset[str]) -> tuple[NounPhrase, int]:
        stop = j + 1
        where = self._said.longest(stop, Tag.RELATION)
        side = _SIDES.get(where[1].key) if where is not None else None
        if where is not None and side and self._said.is_predicate(stop + where[0]):
            stop += where[0]  # `the one in front brakes`
            labels |= {side}
        noun = NounPhrase(
            kind=NounKind.VEHICLE,
            key='vehicle',
            start=self._said.tokens[i].start,
            end=self._said.tokens[stop - 1].end,
            head_text='one',
            determiner=Determiner.DEFINITE,
            labels=labels,
        )
        return noun, stop

    def _refuses(
        self, kind: NounKind, states: list[str], determiner: Determiner, i: int, *, is_first: bool
    ) -> bool:
        """`tracking bus`: without an article the participle is a verb."""
        if determiner is not Determiner.BARE:
            return False
        if is_first and kind is NounKind.UNSUPPORTED:
            return False  # `to train the crew`
        if is_first or not states:
            return False
        if kind in (NounKind.PLACE, NounKind.LANDMARK):
            return True  # `trucks parked roadside`
        allowed = _UAV_PARTICIPLES if kind is NounKind.UAV else _BARE_PARTICIPLES
        return not all(s in allowed or s == 'oncoming' for s in states)

    def _index(self, kind: NounKind, stop: int) -> tuple[int, int]:
        """`drone 2`, `uav1`: a whole number without a unit behind the head."""
        if kind not in (NounKind.UAV, NounKind.AGENT, NounKind.VEHICLE):
            return 0, stop
        if stop < len(self._said.tokens) and self._said.tokens[stop].capital:
            letter = ord(self._said.words[stop].lower()) - ord('a') + 1
            if 1 <= letter <= 8:
                return letter, stop + 1  # `drone B`
        spelled = self._said.longest(stop, Tag.NUMBER)
        if spelled is not None and spelled[1].key.isdigit() and self._said.is_predicate(stop + 1):
            return int(spelled[1].key), stop + 1  # `drone two orbits`
        if stop >= len(self._said.tokens) or self._said.tokens[stop].kind is not TokenKind.NUMBER:
            return 0, stop
        token = self._said.tokens[stop]
        read = self._said.measures.read(stop)
        if read is None or token.value is None:
            return 0, stop
        measure, after = read
        whole = token.value.denominator == 1 and 1 <= token.value <= 200
        if measure.dimension == COUNT and whole and after == stop + 1 and measure.second is None:
            return int(token.value), after
        return 0, stop

    def _listed(self, stop: int) -> bool:
        """`drones 1 and 2`; in `pedestrians 10` the number is no name of one."""
        return stop + 1 < len(self._said.words) and self._said.words[stop + 1] in ('and', ',', '&')

    def _unknown(self, i: int) -> tuple[NounPhrase, int] | None:
        """`the unicorn`: an article and words that nobody knows."""
        article = self._said.longest(i, Tag.DEFINITE, Tag.INDEFINITE)
        if article is None or self._said.words[i] in ('that', 'this', 'some'):
            return None
        j = i + 1
        while j < len(self._said.words) and self._said.longest(j, Tag.LABEL):
            j += 1
        first = j
        while j < len(self._said.words) and j - first < 3 and self._said.is_unknown(j):
            j += 1
        if j == first or (j < len(self._said.words) and self._said.words[j] in ('one', 'ones')):
            return None  # `the higher one` names no type
        text = ' '.join(self._said.words[first:j])
        definite = article[1].tag is Tag.DEFINITE
        return (
            NounPhrase(
                kind=NounKind.UNKNOWN,
                key=text,
                start=self._said.tokens[i].start,
                end=self._said.tokens[j - 1].end,
                head_text=text,
                determiner=Determiner.DEFINITE if definite else Determiner.INDEFINITE,
            ),
            j,
        )
