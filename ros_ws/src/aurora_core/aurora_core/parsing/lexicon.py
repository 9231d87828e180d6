# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The words of `lexicon.yaml`, with their forms, ready to be matched against tokens."""

from __future__ import annotations

import marshal
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from functools import lru_cache
from itertools import product
from pathlib import Path
from typing import Any

from aurora_core.compiled import Compiled
from aurora_core.parsing.data_files import data_path, read_data
from aurora_core.parsing.morphology import VerbForm, plural, verb_forms

# Words that a pattern looks at: the longest opening is shorter.
_MOST = 24
_FAMILY = re.compile(r'<(\w+)>')


class Preludes:
    """Finds openings in the words of a prompt."""

    def __init__(self, data: Mapping[str, Any]) -> None:
        families: dict[str, str] = {}
        for name, phrases in data['words'].items():
            ordered = sorted((_filled(p, families) for p in phrases), key=len, reverse=True)
            families[name] = f'(?:{"|".join(ordered)})'
        self._texts = [_filled(p, families) + r'(?= |$)' for p in data['patterns']]
        self._starts = re.compile('|'.join(self._texts))

    def read(self, words: Sequence[str], i: int) -> int | None:
        """Return the index behind the opening that starts at word i, None when none does."""
        text = ' '.join(words[i : i + _MOST])
        if self._starts.match(text) is None:
            return None
        # Each by itself only now: most prompts open none.
        patterns = [re.compile(p) for p in self._texts]
        found = [m.end() for p in patterns if (m := p.match(text)) is not None]
        return i + text[: max(found)].count(' ') + 1


def _filled(pattern: str, families: Mapping[str, str]) -> str:
    return _FAMILY.sub(lambda m: families[m.group(1)], pattern)


_FILE = 'lexicon.yaml'
_ALTERNATIVES = re.compile(r'\(([^()]*)\)')


class Tag(StrEnum):
    """Word classes; one per section of the lexicon."""

    AGENT = 'agent'
    VEHICLE = 'vehicle'
    UAV = 'uav'
    EGO = 'ego'
    EGO_POSSESSIVE = 'ego_possessive'
    EGO_PRONOUN = 'ego_pronoun'
    UNSUPPORTED = 'unsupported'
    AMBIGUOUS = 'ambiguous'
    BACKGROUND = 'background'
    PLACE_PART = 'place_part'
    COLLECTIVE = 'collective'
    SIREN = 'siren'
    LABEL = 'label'
    STATE = 'state'
    ORDINAL = 'ordinal'
    PRONOUN = 'pronoun'
    PLACE = 'place'
    STREET = 'street'
    STREETS_FLAG = 'streets_flag'
    SURROUNDINGS = 'surroundings'
    LANDMARK_NOUN = 'landmark_noun'
    LANDMARK = 'landmark'
    RELATION = 'relation'
    PREPOSITION = 'preposition'
    COMPASS = 'compass'
    WEATHER = 'weather'
    TIME_OF_DAY = 'time_of_day'
    TRAFFIC = 'traffic'
    NO_TRAFFIC = 'no_traffic'
    WORLD_NOUN = 'world_noun'
    AERIAL = 'aerial'
    THING = 'thing'
    PATTERN = 'pattern'
    ROUTE = 'route'
    MESSAGE = 'message'
    LINK = 'link'
    SCENARIO = 'scenario'
    VERB = 'verb'
    CAUSATIVE = 'causative'
    AUXILIARY = 'auxiliary'
    FRAME = 'frame'
    CONTEXT = 'context'
    FILL = 'fill'
    THEN = 'then'
    SUBORDINATOR = 'subordinator'
    RELATIVE = 'relative'
    CONJUNCTION = 'conjunction'
    NEGATION = 'negation'
    DEFINITE = 'definite'
    INDEFINITE = 'indefinite'
    ALL = 'all'
    ANOTHER = 'another'
    IN_VIEW = 'in_view'
    IN_FLIGHT = 'in_flight'
    FROM_START = 'from_start'
    NUMBER = 'number'
    MULTIPLIER = 'multiplier'
    APPROXIMATE = 'approximate'
    AT_LEAST = 'at_least'
    AT_MOST = 'at_most'
    AFTER_APPROXIMATE = 'after_approximate'
    AFTER_AT_LEAST = 'after_at_least'
    AFTER_AT_MOST = 'after_at_most'
    UNIT = 'unit'
    HAPPENING = 'happening'
    BECAUSE = 'because'
    CAUSING = 'causing'


@dataclass(frozen=True, slots=True, kw_only=True)
class Sense:
    """One meaning of a phrase: its class, the key inside it, number and verb form."""

    tag: Tag
    key: str
    plural: bool = False
    form: VerbForm = VerbForm.BASE


@dataclass(frozen=True, slots=True, kw_only=True)
class UnitWord:
    dimension: str
    factor: Fraction


# Sections of `key: [phrases]`, with the class they give and whether they have plurals.
_KEYED: tuple[tuple[str, Tag, bool], ...] = (
    ('agents', Tag.AGENT, True),
    ('ambiguous_agents', Tag.AMBIGUOUS, False),
    ('pronouns', Tag.PRONOUN, False),
    ('places', Tag.PLACE, True),
    ('relations', Tag.RELATION, False),
    ('prepositions', Tag.PREPOSITION, False),
    ('weather', Tag.WEATHER, False),
    ('time_of_day', Tag.TIME_OF_DAY, False),
    ('traffic_density', Tag.TRAFFIC, False),
    ('things', Tag.THING, True),
    ('patterns', Tag.PATTERN, True),
    ('subordinators', Tag.SUBORDINATOR, False),
    ('happenings', Tag.HAPPENING, True),
)
# Sections that are plain lists.
_LISTED: tuple[tuple[str, Tag, bool], ...] = (
    ('vehicle', Tag.VEHICLE, True),
    ('uav', Tag.UAV, True),
    ('ego', Tag.EGO, True),
    ('ego_possessive', Tag.EGO_POSSESSIVE, False),
    ('ego_pronouns', Tag.EGO_PRONOUN, False),
    ('unsupported', Tag.UNSUPPORTED, True),
    ('background', Tag.BACKGROUND, False),
    ('collectives', Tag.COLLECTIVE, False),
    ('siren', Tag.SIREN, False),
    ('labels', Tag.LABEL, False),
    ('streets', Tag.STREET, True),
    ('streets_flag', Tag.STREETS_FLAG, False),
    ('surroundings', Tag.SURROUNDINGS, False),
    ('landmark_nouns', Tag.LANDMARK_NOUN, False),
    ('place_parts', Tag.PLACE_PART, False),
    ('no_traffic', Tag.NO_TRAFFIC, False),
    ('world_nouns', Tag.WORLD_NOUN, False),
    ('aerial_view', Tag.AERIAL, False),
    ('route_nouns', Tag.ROUTE, True),
    ('message_nouns', Tag.MESSAGE, True),
    ('link_nouns', Tag.LINK, True),
    ('scenario_nouns', Tag.SCENARIO, False),
    ('auxiliaries', Tag.AUXILIARY, False),
    ('frames', Tag.FRAME, False),
    ('context_markers', Tag.CONTEXT, False),
    ('fill', Tag.FILL, False),
    ('then_words', Tag.THEN, False),
    ('relative_pronouns', Tag.RELATIVE, False),
    ('conjunctions', Tag.CONJUNCTION, False),
    ('negations', Tag.NEGATION, False),
    ('determiners_definite', Tag.DEFINITE, False),
    ('determiners_indefinite', Tag.INDEFINITE, False),
    ('all_words', Tag.ALL, False),
    ('another', Tag.ANOTHER, False),
    ('in_view', Tag.IN_VIEW, False),
    ('in_flight', Tag.IN_FLIGHT, False),
    ('from_start', Tag.FROM_START, False),
    ('because', Tag.BECAUSE, False),
    ('approximate', Tag.APPROXIMATE, False),
    ('at_least', Tag.AT_LEAST, False),
    ('at_most', Tag.AT_MOST, False),
    ('after_number_approximate', Tag.AFTER_APPROXIMATE, False),
    ('after_number_at_least', Tag.AFTER_AT_LEAST, False),
    ('after_number_at_most', Tag.AFTER_AT_MOST, False),
)
_VALUED: tuple[tuple[str, Tag], ...] = (
    ('ordinals', Tag.ORDINAL),
    ('states', Tag.STATE),
    ('compass', Tag.COMPASS),
    ('number_words', Tag.NUMBER),
    ('multipliers', Tag.MULTIPLIER),
    ('number_phrases', Tag.NUMBER),
)


_EMPTY = frozenset(
    {
        Tag.FILL,
        Tag.FRAME,
        Tag.SURROUNDINGS,
        Tag.LABEL,
        Tag.SCENARIO,
        Tag.WORLD_NOUN,
        Tag.CONTEXT,
        Tag.ROUTE,
        Tag.THEN,
    }
)


def expanded(phrases: Iterable[str]) -> Iterator[str]:
    """Write out phrases with alternatives: `on (its|the) left( side|)` is four."""
    for phrase in phrases:
        choices = [part.split('|') for part in _ALTERNATIVES.split(str(phrase))]
        for words in product(*choices):
            yield ' '.join(''.join(words).split())


class _Phrases:
    """All phrases of the sections, each with its senses in order."""

    def __init__(self, data: Mapping[str, Any]) -> None:
        self.senses: dict[tuple[str, ...], dict[Sense, None]] = {}
        irregular = data['irregular_verbs']
        for section, tag, plurals in _KEYED:
            for key, phrases in data[section].items():
                if tag is Tag.AMBIGUOUS:
                    phrases = [key]
                for phrase in expanded(phrases):
                    self._noun(phrase, tag, key, plurals)
        for section, tag, plurals in _LISTED:
            for phrase in expanded(data[section]):
                self._noun(phrase, tag, phrase, plurals)
        for section, tag in _VALUED:
            for phrase, value in data[section].items():
                self._add(phrase, Sense(tag=tag, key=str(value)))
        for form, lemma in data['irregular_plurals'].items():
            for sense in tuple(self.senses.get((lemma,), ())):
                self._add(form, Sense(tag=sense.tag, key=sense.key, plural=True))
        for key, phrases in data['verbs'].items():
            for phrase in expanded(phrases):
                for form, kind in verb_forms(phrase, irregular):
                    self._add(form, Sense(tag=Tag.VERB, key=key, form=kind))
        for tag, phrases in (
            (Tag.CAUSATIVE, data['causative']),
            (Tag.AUXILIARY, data['auxiliaries']),
            (Tag.CAUSING, data['causing']),
        ):
            for phrase in expanded(phrases):
                for form, kind in verb_forms(phrase, irregular):
                    self._add(form, Sense(tag=tag, key=phrase, form=kind))
        for key, unit in data['units'].items():
            for phrase in unit['words']:
                self._add(phrase, Sense(tag=Tag.UNIT, key=key))
                first, _, rest = phrase.partition(' ')
                if len(first) > 2:
                    self._add(f'{plural(first)} {rest}'.strip(), Sense(tag=Tag.UNIT, key=key))

    def _noun(self, phrase: str, tag: Tag, key: str, plurals: bool) -> None:
        self._add(phrase, Sense(tag=tag, key=key))
        if plurals:
            self._add(plural(phrase), Sense(tag=tag, key=key, plural=True))

    def _add(self, phrase: str, sense: Sense) -> None:
        self.senses.setdefault(tuple(phrase.split()), {})[sense] = None


def phrase_table(data: Mapping[str, Any]) -> dict[str, Any]:
    """Return all phrases of the sections in plain values, packed by their first word."""
    longest: dict[str, int] = {}
    content: set[str] = set()
    grouped: dict[str, dict[tuple[str, ...], Any]] = {}
    for words, senses in _Phrases(data).senses.items():
        longest[words[0]] = max(len(words), longest.get(words[0], 0))
        if any(sense.tag not in _EMPTY for sense in senses):
            content.update(words)
        grouped.setdefault(words[0], {})[words] = tuple(
            (s.tag.value, s.key, s.plural, s.form.value) for s in senses
        )
    return {
        'longest': longest,
        'words': frozenset(word for group in grouped.values() for ws in group for word in ws),
        'content_words': frozenset(content),
        'phrases': {first: marshal.dumps(group) for first, group in grouped.items()},
    }


class Lexicon:
    """Phrases by their first word, each with its senses.

    Args:
        data: The sections of `lexicon.yaml`.
        table: All phrases that these sections give, from `phrase_table`; None works them out.
    """

    def __init__(self, data: Mapping[str, Any], table: Mapping[str, Any] | None = None) -> None:
        self.preludes = Preludes(data['preludes'])
        self.ambiguous_agents: dict[str, list[str]] = dict(data['ambiguous_agents'])
        self.fractions = {word: int(part) for word, part in data['fractions'].items()}
        self.number_words = {word: int(value) for word, value in data['number_words'].items()}
        self.turns = {name: frozenset(words) for name, words in data['turns'].items()}
        self.callsigns: dict[str, str] = dict(data['callsigns'])
        self.helped = frozenset(data['helped']['behind'])
        self.helped_forms: dict[str, str] = dict(data['helped']['forms'])
        self.it_is = frozenset(data['it_is'])
        self.units = {
            key: UnitWord(dimension=unit['dimension'], factor=_fraction(unit['factor']))
            for key, unit in data['units'].items()
        }
        found = phrase_table(data) if table is None else table
        self._longest: Mapping[str, int] = found['longest']  # phrase that begins with a word
        self.words: frozenset[str] = found['words']
        # Spelling is only corrected into words that mean something: a slip is never hidden.
        self.content_words: frozenset[str] = found['content_words']
        # A prompt needs few of them: unpacked when they are asked for.
        self._packed: Mapping[str, bytes] = found['phrases']
        self._phrases: dict[str, dict[tuple[str, ...], tuple[Sense, ...]]] = {}

    def senses(self, words: tuple[str, ...]) -> tuple[Sense, ...]:
        """Return the senses of exactly this phrase."""
        first = words[0] if words else ''
        if first not in self._packed:
            return ()
        if first not in self._phrases:
            self._phrases[first] = {
                phrase: tuple(
                    Sense(tag=Tag(tag), key=key, plural=is_plural, form=VerbForm(form))
                    for tag, key, is_plural, form in senses
                )
                for phrase, senses in marshal.loads(self._packed[first]).items()  # nosec B302
            }
        return self._phrases[first].get(words, ())

    def matches(self, words: Sequence[str], i: int) -> list[tuple[int, tuple[Sense, ...]]]:
        """Return every phrase that starts at word i as (length, senses), longest first."""
        longest = self._longest.get(words[i], 0) if i < len(words) else 0
        found = []
        for length in range(min(longest, len(words) - i), 0, -1):
            senses = self.senses(tuple(words[i : i + length]))
            if senses:
                found.append((length, senses))
        return found

    def longest_of(
        self, words: Sequence[str], i: int, tags: Iterable[Tag]
    ) -> tuple[int, Sense] | None:
        """Return the longest phrase at word i that has a sense of one of the classes."""
        wanted = tuple(tags)
        for length, senses in self.matches(words, i):
            for tag in wanted:
                for sense in senses:
                    if sense.tag is tag:
                        return length, sense
        return None


def _fraction(text: object) -> Fraction:
    numerator, _, denominator = str(text).partition('/')
    return Fraction(numerator) / (Fraction(denominator) if denominator else 1)


def compiled_table() -> Compiled:
    """Return all phrases as set-up compiles them: from the words, and the code that forms them."""
    here = Path(__file__)
    sources = (data_path(_FILE), here, here.with_name('morphology.py'))
    return Compiled(
        name='lexicon.phrases', sources=sources, make=lambda: phrase_table(read_data(_FILE))
    )


@lru_cache(maxsize=1)
def shipped_lexicon() -> Lexicon:
    """Return the lexicon of the package (read once)."""
    return Lexicon(read_data(_FILE), compiled_table().value())
