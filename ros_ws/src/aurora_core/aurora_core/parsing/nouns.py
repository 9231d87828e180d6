# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Noun phrases: determiner, count, ordinals, adjectives, head noun, index."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from aurora_core.parsing.atoms import Determiner, NounKind, NounPhrase
from aurora_core.parsing.lexicon import Lexicon, Sense, Tag
from aurora_core.parsing.measures import COUNT, MeasureReader
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.tokens import Token, TokenKind
from aurora_core.spec.parameter import Bound

_HEADS = {
    Tag.EGO: NounKind.EGO,
    Tag.UAV: NounKind.UAV,
    Tag.AGENT: NounKind.AGENT,
    Tag.VEHICLE: NounKind.VEHICLE,
    Tag.UNSUPPORTED: NounKind.UNSUPPORTED,
    Tag.AMBIGUOUS: NounKind.AMBIGUOUS,
    Tag.PLACE: NounKind.PLACE,
    Tag.STREET: NounKind.STREET,
    Tag.SURROUNDINGS: NounKind.SURROUNDINGS,
    Tag.LANDMARK_NOUN: NounKind.MISSING_LANDMARK,
}
# Verbs whose participle may stand before a noun without an article.
_BARE_PARTICIPLES = frozenset({'park', 'stop'})
_UAV_PARTICIPLES = frozenset({'track', 'hover', 'observe', 'navigate', 'orbit', 'follow'})
# What `I` does when it means the ego vehicle.
_EGO_ACTS = frozenset(
    {
        'come',
        'drive',
        'stop',
        'brake',
        'approach',
        'overtake',
        'reach',
        'park',
        'slow',
        'cross',
        'follow',
        'accelerate',
        'start',
        'change_lane',
        'yield',
        'turn_left',
        'turn_right',
        'wait',
    }
)
_BY_HEIGHT = frozenset({'lowest', 'lower', 'bottom', 'middle', 'highest', 'upper', 'top'})
_I_AM = (('i', 'am'), ('we', 'are'))
_MOST_UNKNOWN = 2


def landmark_words(name: str) -> tuple[str, ...]:
    """Return a landmark name as lower-case words."""
    return tuple(name.lower().replace('_', ' ').replace('-', ' ').split())


def landmark_phrases(names: tuple[str, ...]) -> dict[tuple[str, ...], str]:
    """Full names, and their last word where only one landmark has it (`the tower`)."""
    full = {landmark_words(name): name for name in names if landmark_words(name)}
    by_last: dict[str, list[str]] = {}
    for words, name in full.items():
        by_last.setdefault(words[-1], []).append(name)
    short = {
        (last,): found[0] for last, found in by_last.items() if len(found) == 1 and len(last) > 2
    }
    return short | full


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
        self._tokens = tokens
        self._words = words
        self._lexicon = lexicon
        self._measures = measures
        self._landmarks = landmarks
        self._letters: dict[str, tuple[NounKind, str]] | None = None
        self._longest_landmark = max((len(words) for words in landmarks), default=0)

    def read(self, i: int) -> tuple[NounPhrase, int] | None:
        """Return the noun phrase that starts at token i and the next index, None if none does."""
        if self._measures.is_part(i):
            return None
        alone = self._part_of_place(i) or self._letter(i) or self._ordinal_alone(i)
        if alone is not None:
            return alone
        if self._words[i] == 'that' and self._is_mine(i + 1):
            return None  # `the van that my car follows`
        j = i
        determiner = Determiner.BARE
        count, index, background = 0, 0, False
        labels: list[str] = []
        states: list[str] = []
        loose: list[int] = []
        while j < len(self._words):
            head = self._head(j)
            if head is not None and not (head[0] is NounKind.EGO and self._agent_follows(j)):
                kind, key, head_text, is_plural, stop = head
                # `the aircraft are`: one word for one and for many
                many = self._words[stop : stop + 1] in (['are'], ['were'], ['have'])
                is_plural = is_plural or (head_text.endswith('craft') and many)
                if head_text == 'crossing' and self._agent_at(stop):
                    states.append('cross')  # `a crossing pedestrian`
                    j = stop
                    continue
                if kind is NounKind.SURROUNDINGS and self._head(stop) is not None:
                    j = stop  # `the downtown streets`
                    continue
                if loose and kind is NounKind.UNKNOWN:
                    return None
                if self._refuses(kind, states, determiner, i == j):
                    return None
                proper = [k for k in loose if self._tokens[k].proper]
                if kind is NounKind.LANDMARK and proper and stop - j < len(landmark_words(key)):
                    # `the Eiffel Tower` is not the one tower that the map has
                    kind = NounKind.MISSING_LANDMARK
                    key = head_text = ' '.join(self._words[proper[0] : stop])
                    loose = []
                stop = self._behind_place(kind, stop)
                named = not count and (not is_plural or self._listed(stop))
                number, stop = self._index(kind, stop) if named else (0, stop)
                return (
                    NounPhrase(
                        kind=kind,
                        key=key,
                        start=self._tokens[i].start,
                        end=self._tokens[stop - 1].end,
                        head_text=head_text,
                        determiner=determiner,
                        count=count,
                        plural=is_plural,
                        labels=frozenset(labels),
                        states=tuple(states),
                        background=background,
                        index=index or number,
                        loose=tuple((self._tokens[k].start, self._tokens[k].end) for k in loose),
                    ),
                    stop,
                )
            if count and self._words[j] == 'other':
                j += 1  # `ten other cars`
                continue
            if loose and self._words[j] == "'s":
                loose = []  # `the surveyor's drone`: whose it is says nothing
                j += 1
                continue
            step = self._prefix(j, determiner)
            if step is None:
                if j == i or (determiner is Determiner.BARE and not count):
                    break
                if len(loose) >= _MOST_UNKNOWN or not self._is_unknown(j):
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
        return self._pronoun(i) or self._unknown(i)

    def _part_of_place(self, i: int) -> tuple[NounPhrase, int] | None:
        """`the helipad of the hospital`, `the middle of the junction`: the place itself."""
        j = i
        while j < len(self._words) and self._words[j] in ('the', 'a', 'its', 'main', 'very'):
            j += 1
        part = self._lexicon.longest_of(self._words, j, (Tag.PLACE_PART,))
        if part is None:
            return None
        j += part[0]
        if j >= len(self._words) or self._words[j] not in ('of', 'at', 'on', 'in'):
            return None
        j += 1
        if j < len(self._words) and self._words[j] == 'the':
            j += 1
        whole = self._head(j) if j < len(self._words) else None
        if whole is None or whole[0] not in (NounKind.LANDMARK, NounKind.PLACE):
            return None
        kind, key, text, _, stop = whole
        start, end = self._tokens[i].start, self._tokens[stop - 1].end
        return (
            NounPhrase(
                kind=kind,
                key=key,
                start=start,
                end=end,
                head_text=text,
                determiner=Determiner.DEFINITE,
            ),
            stop,
        )

    def _behind_place(self, kind: NounKind, stop: int) -> int:
        """`the hospital's roof`, `the hospital helipad`: the part adds nothing."""
        if kind is not NounKind.LANDMARK:
            return stop
        j = stop + 1 if stop < len(self._words) and self._words[stop] == "'s" else stop
        part = self._lexicon.longest_of(self._words, j, (Tag.PLACE_PART,))
        return stop if part is None else j + part[0]

    def _agent_at(self, j: int) -> bool:
        return self._lexicon.longest_of(self._words, j, (Tag.AGENT,)) is not None

    def _is_mine(self, j: int) -> bool:
        return self._lexicon.longest_of(self._words, j, (Tag.EGO_POSSESSIVE,)) is not None

    # --- heads --------------------------------------------------------------------------------

    def _head(self, j: int) -> tuple[NounKind, str, str, bool, int] | None:
        named = self._landmark(j)
        matches = self._lexicon.matches(self._words, j)
        if named is not None and not (
            self._is_agent_beyond(matches, named[1] - j) or self._parks(j, named[1])
        ):
            name, stop = named
            return NounKind.LANDMARK, name, name, False, stop
        if not matches:
            return None
        length, senses = matches[0]
        if length > 1 and self._acts_here(j, length):
            length, senses = matches[-1]
        for tag, kind in _HEADS.items():
            for sense in senses:
                if sense.tag is tag and not self._is_verb_here(j, senses, length):
                    text = ' '.join(self._words[j : j + length])
                    return kind, sense.key, text, sense.plural, j + length
        return None

    def _parks(self, j: int, stop: int) -> bool:
        """`two trucks park at the roadside`: behind who acts, no short name of a landmark."""
        verb = self._lexicon.longest_of(self._words, j, (Tag.VERB,)) is not None
        acting = (Tag.AGENT, Tag.AUXILIARY, Tag.VEHICLE)
        told = j and self._lexicon.longest_of(self._words, j - 1, acting) is not None
        return stop == j + 1 and verb and bool(told)

    @staticmethod
    def _is_agent_beyond(matches: Sequence[tuple[int, tuple[Sense, ...]]], length: int) -> bool:
        """`a school bus` is no school, although the map has one."""
        return bool(matches) and matches[0][0] > length and matches[0][1][0].tag is Tag.AGENT

    def _acts_here(self, j: int, length: int) -> bool:
        """`a pedestrian crossing at the …`: somebody who crosses, not the place."""
        after = self._words[j + length] if j + length < len(self._words) else ''
        person = self._lexicon.longest_of(self._words, j, (Tag.PLACE,)) is not None and any(
            s.tag is Tag.AGENT for s in self._lexicon.senses((self._words[j],))
        )
        return person and after in ('at', 'the', 'a', 'in', 'on', 'over', 'from')

    def _is_verb_here(self, j: int, senses: tuple[Sense, ...], length: int) -> bool:
        """`tank`, `crane`, `zone` are nouns; `crossing` before a noun phrase is a verb."""
        if not any(s.tag is Tag.VERB for s in senses):
            return False
        before = self._words[j - 1] if j else ''
        after = self._words[j + length] if j + length < len(self._words) else ''
        article = (Tag.DEFINITE, Tag.INDEFINITE, Tag.LABEL)
        if j and self._lexicon.longest_of(self._words, j - 1, article) is not None:
            return False
        articles = ('the', 'a', 'an', 'at', 'in', 'over')
        return after in articles or before not in ('at', 'to', 'zebra', 'pedestrian', 'on', 'near')

    def _agent_follows(self, j: int) -> bool:
        """`ego bus`: the type is named behind the word `ego`."""
        if self._words[j] != 'ego' or self._lexicon.matches(self._words, j)[0][0] > 1:
            return False
        return self._lexicon.longest_of(self._words, j + 1, (Tag.AGENT,)) is not None

    def _landmark(self, j: int) -> tuple[str, int] | None:
        for length in range(min(self._longest_landmark, len(self._words) - j), 0, -1):
            name = self._landmarks.get(tuple(self._words[j : j + length]))
            if name is not None:
                return name, j + length
        return None

    def _refuses(
        self, kind: NounKind, states: list[str], determiner: Determiner, is_first: bool
    ) -> bool:
        """`tracking bus`: without an article the participle is a verb."""
        if is_first or not states or determiner is not Determiner.BARE:
            return False
        allowed = _UAV_PARTICIPLES if kind is NounKind.UAV else _BARE_PARTICIPLES
        return not all(s in allowed or s == 'oncoming' for s in states)

    def _index(self, kind: NounKind, stop: int) -> tuple[int, int]:
        """`drone 2`, `uav1`: a whole number without a unit behind the head."""
        if kind not in (NounKind.UAV, NounKind.AGENT, NounKind.VEHICLE):
            return 0, stop
        if stop < len(self._tokens) and self._tokens[stop].capital:
            letter = ord(self._words[stop]) - ord('a') + 1
            if 1 <= letter <= 8:
                return letter, stop + 1  # `drone B`
        spelled = self._lexicon.longest_of(self._words, stop, (Tag.NUMBER,))
        if spelled is not None and spelled[1].key.isdigit() and self._is_predicate(stop + 1):
            return int(spelled[1].key), stop + 1  # `drone two orbits`
        if stop >= len(self._tokens) or self._tokens[stop].kind is not TokenKind.NUMBER:
            return 0, stop
        token = self._tokens[stop]
        read = self._measures.read(stop)
        if read is None or token.value is None:
            return 0, stop
        measure, after = read
        whole = token.value.denominator == 1 and 1 <= token.value <= 200
        if measure.dimension == COUNT and whole and after == stop + 1 and measure.second is None:
            return int(token.value), after
        return 0, stop

    def _listed(self, stop: int) -> bool:
        """`drones 1 and 2`; in `pedestrians 10` the number is no name of one."""
        return stop + 1 < len(self._words) and self._words[stop + 1] in ('and', ',', '&')

    def _is_predicate(self, j: int) -> bool:
        return any(
            s.tag is Tag.VERB and s.form is VerbForm.THIRD
            for _, senses in self._lexicon.matches(self._words, j)
            for s in senses
        )

    # --- what may stand before the head -------------------------------------------------------

    def _prefix(self, j: int, determiner: Determiner) -> tuple[str, str, int] | None:
        if tuple(self._words[j : j + 2]) == ('the', 'other'):
            return 'determiner', Determiner.OTHER, j + 2
        matches = self._lexicon.matches(self._words, j)
        tags = {s.tag: (length, s) for length, senses in reversed(matches) for s in senses}
        for tag, value in (
            (Tag.ANOTHER, Determiner.ANOTHER),
            (Tag.ALL, Determiner.ALL),
            (Tag.EGO_POSSESSIVE, Determiner.MY),
        ):
            if tag in tags:
                return 'determiner', value, j + tags[tag][0]
        if Tag.COLLECTIVE in tags:
            return 'label', '', j + tags[Tag.COLLECTIVE][0]
        if Tag.BACKGROUND in tags:
            return 'background', '', j + tags[Tag.BACKGROUND][0]
        counted = self._count(j)
        if counted is not None:
            return 'count', str(counted[0]), counted[1]
        if determiner in (Determiner.BARE,):
            if Tag.DEFINITE in tags:
                return 'determiner', Determiner.DEFINITE, j + tags[Tag.DEFINITE][0]
            if Tag.INDEFINITE in tags:
                return 'determiner', Determiner.INDEFINITE, j + tags[Tag.INDEFINITE][0]
        if Tag.ORDINAL in tags:
            return 'ordinal', tags[Tag.ORDINAL][1].key, j + tags[Tag.ORDINAL][0]
        if Tag.STATE in tags:
            return 'state', tags[Tag.STATE][1].key, j + tags[Tag.STATE][0]
        if Tag.LABEL in tags:
            return 'label', self._words[j], j + tags[Tag.LABEL][0]
        if self._words[j] == 'ego':
            return 'label', 'ego', j + 1
        for length, senses in matches:
            for sense in senses:
                if sense.tag is Tag.VERB and sense.form is VerbForm.ING:
                    return 'state', sense.key, j + length
        return None

    def _count(self, j: int) -> tuple[int, int] | None:
        if self._words[j] in ('a', 'an', 'second'):
            phrase = self._lexicon.longest_of(self._words, j, (Tag.NUMBER,))
            if phrase is None:
                return None
        read = self._measures.read(j)
        if read is None:
            return None
        measure, stop = read
        exact = measure.bound is Bound.EXACTLY and not measure.approximate
        if (
            measure.dimension != COUNT
            or not exact
            or measure.upper is not None
            or measure.second is not None
            or measure.value != int(measure.value)
            or not 1 <= measure.value <= 100_000
        ):
            return None
        return int(measure.value), stop

    def _is_unknown(self, j: int) -> bool:
        return self._tokens[j].kind is TokenKind.WORD and not self._lexicon.matches(self._words, j)

    # --- phrases without a known head ---------------------------------------------------------

    def _pronoun(self, i: int) -> tuple[NounPhrase, int] | None:
        word = self._words[i]
        moving = i + 1 if word in ("i'm", 'im', "we're") else i + 2
        told = word in ("i'm", 'im', "we're") or tuple(self._words[i : i + 2]) in _I_AM
        if told and self._acts(moving):  # `I am driving at 10 m/s`
            return self._pronoun_phrase(i, moving, 'i', NounKind.EGO)
        if word == 'one' and i and self._words[i - 1] in _BY_HEIGHT:
            return None
        if word in ('one', 'other') and self._lexicon.longest_of(self._words, i + 1, (Tag.VERB,)):
            return self._pronoun_phrase(i, i + 1, word)
        if word == 'one' and (self._at_its_height(i) or self._shares(i)):
            return self._pronoun_phrase(i, i + 1, word)
        if word == 'another' and self._placed(i + 1):
            return self._pronoun_phrase(i, i + 1, word)  # `one van near …, another at …`
        found = self._lexicon.longest_of(self._words, i, (Tag.EGO_PRONOUN, Tag.PRONOUN))
        if found is None:
            return None
        length, sense = found
        aside = self._words[i + 1] if i + 1 < len(self._words) else ''
        acts = i + 2 if aside in ('then', 'now', 'also', 'only', 'just') else i + 1
        if self._words[i] == 'i' and not self._acts(acts):
            return None  # `I think that …`
        if self._words[i] == 'its' and self._lexicon.longest_of(
            self._words, i + 1, (Tag.MESSAGE, Tag.LINK)
        ):
            return None  # `of its messages`
        by_height = _BY_HEIGHT.intersection(self._words[i : i + length])
        if by_height and ' '.join(self._words[i + length : i + length + 1]) != 'at':
            return None  # `the lower one lands`: who that is, only their heights tell
        kind = NounKind.EGO if sense.tag is Tag.EGO_PRONOUN else NounKind.PRONOUN
        return self._pronoun_phrase(i, i + length, sense.key, kind)

    def _at_its_height(self, i: int) -> bool:
        """`two drones, one at 40 m and one at 60 m`: `one` counts nothing."""
        before = self._words[i - 1] if i else ''
        if before not in (',', 'and', ':', ';') or i + 2 >= len(self._words):
            return False
        return self._words[i + 1] == 'at' and self._tokens[i + 2].kind is TokenKind.NUMBER

    def _shares(self, i: int) -> bool:
        """`two drones track it, one from 20 m`, `two vans, one near the park`."""
        before = self._words[i - 1] if i else ''
        plain = before not in ('the', 'this', 'that', 'which', 'each', 'another', 'every', 'no')
        several = any(a in self._words[:i] for a in ('two', '2', 'three', '3', 'both', 'four'))
        return several and plain and before not in _BY_HEIGHT and self._placed(i + 1)

    def _placed(self, i: int) -> bool:
        """Return whether a place or a number with a preposition follows."""
        found = self._lexicon.longest_of(self._words, i, (Tag.RELATION, Tag.PREPOSITION))
        return found is not None and found[1].key not in ('of', 'to', 'by', 'within', 'beyond')

    def _letter(self, i: int) -> tuple[NounPhrase, int] | None:
        """`drone A …, and B passes it on`: the letter alone, once it was given to somebody."""
        if not self._tokens[i].capital or self._words[i] not in self._named_letters():
            return None
        kind, key = self._named_letters()[self._words[i]]
        if self._words[i] == 'a' and not self._is_predicate(i + 1) and not self._helps(i + 1):
            return None  # the article
        phrase, stop = self._pronoun_phrase(i, i + 1, key, kind)
        number = ord(self._words[i]) - ord('a') + 1
        return replace(phrase, index=number, determiner=Determiner.DEFINITE), stop

    def _named_letters(self) -> dict[str, tuple[NounKind, str]]:
        if self._letters is None:
            self._letters = {}
            for j in range(1, len(self._words)):
                if not self._tokens[j].capital:
                    continue
                for _, senses in self._lexicon.matches(self._words, j - 1):
                    for sense in senses:
                        if sense.tag in (Tag.UAV, Tag.AGENT, Tag.VEHICLE):
                            self._letters[self._words[j]] = (_HEADS[sense.tag], sense.key)
        return self._letters

    def _helps(self, j: int) -> bool:
        return self._lexicon.longest_of(self._words, j, (Tag.AUXILIARY,)) is not None

    def _ordinal_alone(self, i: int) -> tuple[NounPhrase, int] | None:
        """`two drones: first hovers …, second tracks …`: told apart by number only."""
        order = ('first', 'second', 'third', 'fourth')
        if self._words[i] not in order:
            return None
        if i and self._words[i - 1] in ('the', 'a', 'at'):
            return None
        if self._at_its_height(i) and self._second_at_its_height():
            return self._pronoun_phrase(i, i + 1, f'nth{order.index(self._words[i]) + 1}')
        if self._lexicon.longest_of(self._words, i + 1, (Tag.VERB,)) is None:
            return None
        if self._words[i] == 'first' and not self._second_acts():
            return None
        return self._pronoun_phrase(i, i + 1, f'nth{order.index(self._words[i]) + 1}')

    def _second_at_its_height(self) -> bool:
        """`first at 40 m, then at 60 m` are two phases of one UAV."""
        return any(w == 'second' and self._at_its_height(j) for j, w in enumerate(self._words))

    def _second_acts(self) -> bool:
        return any(
            word == 'second'
            and (j == 0 or self._tokens[j - 1].kind is not TokenKind.NUMBER)
            and self._is_predicate(j + 1)
            for j, word in enumerate(self._words)
        )

    def _pronoun_phrase(
        self, i: int, stop: int, key: str, kind: NounKind = NounKind.PRONOUN
    ) -> tuple[NounPhrase, int]:
        return (
            NounPhrase(
                kind=kind,
                key=key,
                start=self._tokens[i].start,
                end=self._tokens[stop - 1].end,
                head_text=' '.join(self._words[i:stop]),
            ),
            stop,
        )

    def _acts(self, j: int) -> bool:
        found = self._lexicon.longest_of(self._words, j, (Tag.VERB,))
        return found is not None and found[1].key in _EGO_ACTS

    def _unknown(self, i: int) -> tuple[NounPhrase, int] | None:
        """`the unicorn`: an article and words that nobody knows."""
        article = self._lexicon.longest_of(self._words, i, (Tag.DEFINITE, Tag.INDEFINITE))
        if article is None or self._words[i] in ('that', 'this', 'some'):
            return None
        j = i + 1
        while j < len(self._words) and self._lexicon.longest_of(self._words, j, (Tag.LABEL,)):
            j += 1
        first = j
        while j < len(self._words) and j - first < 3 and self._is_unknown(j):
            j += 1
        if j == first or (j < len(self._words) and self._words[j] in ('one', 'ones')):
            return None  # `the higher one` names no type
        text = ' '.join(self._words[first:j])
        definite = article[1].tag is Tag.DEFINITE
        return (
            NounPhrase(
                kind=NounKind.UNKNOWN,
                key=text,
                start=self._tokens[i].start,
                end=self._tokens[j - 1].end,
                head_text=text,
                determiner=Determiner.DEFINITE if definite else Determiner.INDEFINITE,
            ),
            j,
        )
