# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""From tokens to atoms: the longest known phrase wins, its class is chosen by the neighbours."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.disambiguation import settle_verbs
from aurora_core.parsing.lexicon import Lexicon, Sense, Tag, shipped_lexicon
from aurora_core.parsing.measures import MeasureReader
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.nouns import NounReader
from aurora_core.parsing.spelling import Speller, written_out
from aurora_core.parsing.tokens import Token, TokenKind

_STOPS = frozenset('.;!?\n:')


# A known phrase goes before nouns of these kinds.
_NAME_NOBODY = (NounKind.SURROUNDINGS, NounKind.STREET, NounKind.UNKNOWN)
_HARMLESS = frozenset('"\'`()[]{}-_*#“”‘’…')


_KINDS = {
    Tag.WEATHER: AtomKind.WORLD,
    Tag.TIME_OF_DAY: AtomKind.WORLD,
    Tag.TRAFFIC: AtomKind.WORLD,
    Tag.NO_TRAFFIC: AtomKind.NO_TRAFFIC,
    Tag.STREETS_FLAG: AtomKind.STREETS_FLAG,
    Tag.RELATION: AtomKind.RELATION,
    Tag.COMPASS: AtomKind.COMPASS,
    Tag.WORLD_NOUN: AtomKind.WORLD_NOUN,
    Tag.AERIAL: AtomKind.AERIAL,
    Tag.SIREN: AtomKind.SIREN,
    Tag.THING: AtomKind.THING,
    Tag.PATTERN: AtomKind.PATTERN,
    Tag.ROUTE: AtomKind.ROUTE,
    Tag.MESSAGE: AtomKind.MESSAGE,
    Tag.LINK: AtomKind.LINK,
    Tag.SCENARIO: AtomKind.SCENARIO,
    Tag.IN_VIEW: AtomKind.IN_VIEW,
    Tag.IN_FLIGHT: AtomKind.IN_FLIGHT,
    Tag.FROM_START: AtomKind.FROM_START,
    Tag.CONTEXT: AtomKind.CONTEXT,
    Tag.NEGATION: AtomKind.NEGATION,
    Tag.SUBORDINATOR: AtomKind.SUBORDINATOR,
    Tag.CONJUNCTION: AtomKind.CONJUNCTION,
    Tag.THEN: AtomKind.THEN,
    Tag.AUXILIARY: AtomKind.AUXILIARY,
    Tag.CAUSATIVE: AtomKind.CAUSATIVE,
    Tag.VERB: AtomKind.VERB,
    Tag.PREPOSITION: AtomKind.PREPOSITION,
    Tag.FRAME: AtomKind.FRAME,
    Tag.RELATIVE: AtomKind.RELATIVE,
    Tag.FILL: AtomKind.FILL,
    Tag.LABEL: AtomKind.FILL,
    Tag.STATE: AtomKind.STATE,
    Tag.DEFINITE: AtomKind.FILL,
    Tag.INDEFINITE: AtomKind.FILL,
    Tag.BECAUSE: AtomKind.BECAUSE,
    Tag.CAUSING: AtomKind.CAUSING,
    Tag.HAPPENING: AtomKind.HAPPENING,
}


_NOUN_LIKE = (
    Tag.WEATHER,
    Tag.TIME_OF_DAY,
    Tag.THING,
    Tag.PATTERN,
    Tag.ROUTE,
    Tag.MESSAGE,
    Tag.LINK,
    Tag.SCENARIO,
    Tag.WORLD_NOUN,
    Tag.AERIAL,
)


# Behind what an opening may stand.
_OPENS = (
    AtomKind.STOP,
    AtomKind.COMMA,
    AtomKind.CONJUNCTION,
    AtomKind.FRAME,
    AtomKind.THEN,
    AtomKind.FILL,
)


# Where several classes are possible and neither noun nor verb decides: the first listed wins.
_ORDER = tuple(_KINDS)


_BEFORE_NOUN = (
    'a',
    'an',
    'the',
    'its',
    'their',
    'his',
    'her',
    'my',
    'our',
    'of',
    'no',
    'this',
    'that',
    'each',
    'any',
)


# What opens the object of a command.
_OPENS_OBJECT = frozenset({'the', 'my', 'our', 'ego', 'it'})


# What stands behind a subject: the word in front of it is no command.
_BEHIND_SUBJECT = frozenset(
    {
        *(
            'must',
            'may',
            'should',
            'shall',
            'can',
            'has',
            'is',
            'will',
            ':',
            '<',
            '≤',
            '=',
            'stays',
        ),
        *('tolerance', 'limit', 'threshold', 'error', 'budget', 'allowance', 'requirement'),
    }
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Tagged:
    """The atoms of a prompt and the spelling that was assumed."""

    atoms: tuple[Atom, ...]
    corrections: tuple[tuple[int, int, str], ...] = ()


@lru_cache(maxsize=4)
def _speller(lexicon: Lexicon) -> Speller:
    return Speller(lexicon.content_words, lexicon.words)


def tag(
    tokens: Sequence[Token],
    landmarks: Mapping[tuple[str, ...], str],
    lexicon: Lexicon | None = None,
) -> Tagged:
    """Return the atoms of a token list."""
    known = lexicon if lexicon is not None else shipped_lexicon()
    tokens = written_out(tokens, known)
    landmark_vocabulary = {word for words in landmarks for word in words}
    words: list[str] = []
    corrections: list[tuple[int, int, str]] = []
    for token in tokens:
        word = token.norm
        if (
            token.kind is TokenKind.WORD
            and word not in known.words
            and word not in landmark_vocabulary
        ):
            meant = _speller(known).correct(word)
            if meant is not None:
                corrections.append((token.start, token.end, meant))
                word = meant
        words.append(word)
    for i, token in enumerate(tokens):
        if token.capital and words[i] == 'a' and _is_name(tokens, words, i, known):
            words[i] = 'A'
    tagger = _Tagger(tokens, words, known, landmarks)
    return Tagged(atoms=tagger.run(), corrections=tuple(corrections))


def _is_name(tokens: Sequence[Token], words: Sequence[str], i: int, lexicon: Lexicon) -> bool:
    """`drone A patrols the park`, `A lands before B does`: the letter is no article."""
    if i and lexicon.longest_of(words[i - 1 : i], 0, (Tag.UAV,)) is not None:
        return True
    others = any(t.capital and t.norm == 'b' for t in tokens)
    acting = lexicon.longest_of(words, i + 1, (Tag.VERB, Tag.AUXILIARY))
    finite = acting is not None and acting[1].form in (VerbForm.THIRD, VerbForm.BASE)
    placed = lexicon.longest_of(words, i + 1, (Tag.PREPOSITION,)) is not None
    return others and (finite or placed)


class _Tagger:
    def __init__(
        self,
        tokens: Sequence[Token],
        words: Sequence[str],
        lexicon: Lexicon,
        landmarks: Mapping[tuple[str, ...], str],
    ) -> None:
        self._tokens = tokens
        self._words = words
        self._lexicon = lexicon
        self._measures = MeasureReader(tokens, words, lexicon)
        self._nouns = NounReader(tokens, words, lexicon, self._measures, landmarks)
        self._atoms: list[Atom] = []

    def run(self) -> tuple[Atom, ...]:
        i = 0
        while i < len(self._tokens):
            i = self._step(i)
        starts = [token.start for token in self._tokens]
        return tuple(settle_verbs([replace(a, words=self._said(a, starts)) for a in self._atoms]))

    def _said(self, atom: Atom, starts: Sequence[int]) -> str:
        first, stop = bisect_left(starts, atom.start), bisect_left(starts, atom.end)
        inside = zip(self._tokens[first:stop], self._words[first:stop], strict=True)
        return ' '.join(word for token, word in inside if token.end <= atom.end)

    def _step(self, i: int) -> int:
        token = self._tokens[i]
        if token.kind is TokenKind.MARK and token.norm not in (
            '%',
            '°',
            '@',
            '~',
            '&',
            '<',
            '>',
            '≥',
            '≤',
            '+',
        ):
            if token.norm in _STOPS:
                self._add(AtomKind.STOP, token.norm, i, i + 1)
            elif token.norm == '→':
                self._add(AtomKind.THEN, token.norm, i, i + 1)
            elif token.norm == ',':
                self._add(AtomKind.COMMA, ',', i, i + 1)
            elif token.norm in _HARMLESS or token.norm == '=':
                self._add(AtomKind.FILL, token.norm, i, i + 1)
            else:
                self._add(AtomKind.UNKNOWN, token.norm, i, i + 1)
            return i + 1
        opening = self._prelude(i)
        if opening is not None:
            return opening
        special = self._longer_phrase(i)
        if special is not None:
            return special
        noun = None if self._measures.starts_clock(i) else self._nouns.read(i)
        if noun is not None:
            phrase, stop = noun
            self._atoms.append(
                Atom(
                    kind=AtomKind.NOUN,
                    key=phrase.key,
                    start=phrase.start,
                    end=phrase.end,
                    noun=phrase,
                )
            )
            return stop
        read = self._measures.read(i)
        if read is not None:
            measure, stop = read
            self._atoms.append(
                Atom(
                    kind=AtomKind.MEASURE,
                    key=measure.dimension,
                    start=self._tokens[i].start,
                    end=self._tokens[stop - 1].end,
                    measure=measure,
                )
            )
            return stop
        matches = self._lexicon.matches(self._words, i)
        for length, senses in matches:
            stop = i + length
            split = self._and_forth(stop)
            if length > 1 and (self._noun_here(i, senses) or split):
                continue  # `an orbit around …`
            if self._take(i, length, senses):
                return i + length
        unknown = AtomKind.FILL if token.norm in _HARMLESS else AtomKind.UNKNOWN
        self._add(unknown, self._words[i], i, i + 1)
        return i + 1

    def _prelude(self, i: int) -> int | None:
        """`what matters to us is that`: words around a request, where a clause may begin."""
        last = self._atoms[-1].kind if self._atoms else AtomKind.STOP
        if last not in _OPENS:
            return None
        stop = self._lexicon.preludes.read(self._words, i)
        known = self._lexicon.longest_of(self._words, i, (Tag.FRAME,))
        if stop is None or (known is not None and i + known[0] >= stop):
            return None
        self._add(AtomKind.FRAME, ' '.join(self._words[i:stop]), i, stop)
        return stop

    def _longer_phrase(self, i: int) -> int | None:
        """Phrases that contain nouns or numbers (`over the streets`, `the moment`) come first."""
        matches = self._lexicon.matches(self._words, i)
        if not matches or matches[0][0] == 1:
            return None
        length, senses = matches[0]
        stop = i + length
        split = self._and_forth(stop)
        if self._noun_here(i, senses) or split:
            return None  # `an orbit around …`
        if any(
            s.tag
            in (
                Tag.NUMBER,
                Tag.MULTIPLIER,
                Tag.AT_LEAST,
                Tag.AT_MOST,
                Tag.APPROXIMATE,
                Tag.INDEFINITE,
                Tag.ALL,
                Tag.ANOTHER,
            )
            for s in senses
        ):
            return None
        noun = self._nouns.read(i)
        if noun is not None:
            names = noun[0].kind not in _NAME_NOBODY
            if noun[1] > i + length or (names and noun[1] == i + length):
                return None
        return i + length if self._take(i, length, senses) else None

    def _and_forth(self, stop: int) -> bool:
        """`flies back and forth` is no return."""
        return self._words[stop - 1] == 'back' and tuple(self._words[stop : stop + 2]) == (
            'and',
            'forth',
        )

    def _noun_here(self, i: int, senses: tuple[Sense, ...]) -> bool:
        """Words that are a verb elsewhere stand behind an article; `that turns left` is one."""
        if not i or self._words[i - 1] not in _BEFORE_NOUN:
            return False
        relative = self._words[i - 1] == 'that' and any(s.form is VerbForm.THIRD for s in senses)
        return not relative and all(s.tag is Tag.VERB for s in senses)

    def _take(self, i: int, length: int, senses: tuple[Sense, ...]) -> bool:
        by_tag: dict[Tag, Sense] = {}
        for sense in senses:
            if sense.tag in _KINDS:
                by_tag.setdefault(sense.tag, sense)
        if not by_tag:
            return False
        verb = by_tag.get(Tag.VERB)
        nouns = [t for t in _NOUN_LIKE if t in by_tag]
        if verb is not None and nouns:
            chosen = by_tag[nouns[0]] if self._noun_context(i, verb) else verb
        elif verb is not None and Tag.RELATION in by_tag:
            chosen = by_tag[Tag.RELATION]
        else:
            chosen = next(by_tag[t] for t in _ORDER if t in by_tag)
        kind = _KINDS[chosen.tag]
        key = chosen.key
        if kind is AtomKind.WORLD:
            key = f'{chosen.tag}:{key}'.replace('traffic:', 'traffic_density:')
        others = frozenset(_KINDS[t] for t in by_tag)
        self._atoms.append(
            Atom(
                kind=kind,
                key=key,
                start=self._tokens[i].start,
                end=self._tokens[i + length - 1].end,
                form=chosen.form,
                other_kinds=others,
                verb_key=verb.key if verb is not None else '',
                verb_form=verb.form if verb is not None else VerbForm.BASE,
            )
        )
        return True

    def _noun_context(self, i: int, verb: Sense) -> bool:
        before = self._words[i - 1] if i else ''
        if before in _BEFORE_NOUN:
            return True
        opens = not self._atoms or self._atoms[-1].kind in _OPENS
        behind = self._words[i + 1] if i + 1 < len(self._words) else ''
        if opens and verb.form is VerbForm.BASE and behind in _BEHIND_SUBJECT:
            return True  # `drift must not exceed 2 m`
        if not self._atoms:
            return False
        last = self._atoms[-1]
        told = 'send' in (last.key, last.verb_key) and last.kind is AtomKind.CAUSATIVE
        if told or (last.kind is AtomKind.VERB and last.key in ('send', 'receive', 'trace')):
            return True  # `sends alert to it`, `makes circles`
        if last.kind in (
            AtomKind.MEASURE,
            AtomKind.PATTERN,
            AtomKind.ROUTE,
            AtomKind.LINK,
            AtomKind.MESSAGE,
            AtomKind.THING,
        ):
            if last.kind is AtomKind.MEASURE and behind in _OPENS_OBJECT:
                return False  # `above 80 km/h alert my car`
            return last.kind is not AtomKind.THING or verb.form is not VerbForm.THIRD
        if last.kind is AtomKind.PREPOSITION and before != 'to':
            return verb.form is VerbForm.BASE
        return False

    def _add(self, kind: AtomKind, key: str, i: int, stop: int) -> None:
        self._atoms.append(
            Atom(kind=kind, key=key, start=self._tokens[i].start, end=self._tokens[stop - 1].end)
        )
