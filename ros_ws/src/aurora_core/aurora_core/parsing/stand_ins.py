# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Words that stand in for a noun: pronouns, `one` of several, letters, ordinals."""

from __future__ import annotations

from dataclasses import replace

from aurora_core.parsing.atoms import Determiner, NounKind, NounPhrase
from aurora_core.parsing.lexicon import Tag
from aurora_core.parsing.noun_words import NOUN_KINDS, NounWords

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
_FURTHER = ('second', 'third', 'fourth', 'fifth', 'further')
_SPANS = ('for', 'after', 'within', 'in', 'every', 'by', 'of', 'half', 'than')
_OWN = (['is'], ['being'], ['be'], ['was'])
_I_AM = (('i', 'am'), ('we', 'are'))


class StandInReader:
    """Reads phrases that name nobody by type."""

    def __init__(self, said: NounWords) -> None:
        self._said = said
        self._letters: dict[str, tuple[NounKind, str]] | None = None

    def pronoun(self, i: int) -> tuple[NounPhrase, int] | None:
        """`it`, `I am`, `one near the park`: the phrase and the next index."""
        word = self._said.words[i]
        if word == '#':
            return None
        moving = i + 1 if word in ("i'm", 'im', "we're") else i + 2
        told = word in ("i'm", 'im', "we're") or tuple(self._said.words[i : i + 2]) in _I_AM
        if told and self._acts(moving):  # `I am driving at 10 m/s`
            return self._phrase(i, moving, 'i', NounKind.EGO)
        if word == 'one' and i and self._said.words[i - 1] in _BY_HEIGHT:
            return None
        if word in ('one', 'other') and self._said.longest(i + 1, Tag.VERB):
            return self._phrase(i, i + 1, word)
        if word == 'one' and self._shares(i):
            return self._phrase(i, i + 1, word)
        more = self._one_more(i)
        if more:  # `one van near …, another at …`, `a drone hovers, a second tracks it`
            return self._phrase(i, more, 'another')
        if word == 'another' and self._said.has(i + 1, Tag.DEFINITE, Tag.EGO_POSSESSIVE):
            return self._phrase(i, i + 1, word)  # `one drone tracks the bus, another the van`
        second = tuple(self._said.words[i : i + 2]) == ('a', 'second')
        if second and self._said.has(i + 2, Tag.VERB, Tag.AUXILIARY):
            return self._phrase(i, i + 2, 'another')  # `one UAV …, and a second should …`
        found = self._said.longest(i, Tag.EGO_PRONOUN, Tag.PRONOUN)
        if found is None:
            return None
        length, sense = found
        aside = self._said.words[i + 1] if i + 1 < len(self._said.words) else ''
        acts = i + 2 if aside in ('then', 'now', 'also', 'only', 'just') else i + 1
        if self._said.words[i] == 'i' and not self._acts(acts):
            return None  # `I think that …`
        if self._said.words[i] in ('ours', 'mine') and self._said.words[i - 1 : i] not in _OWN:
            return None  # `a colleague of ours`
        if self._said.words[i] == 'its' and self._said.longest(i + 1, Tag.MESSAGE, Tag.LINK):
            return None  # `of its messages`
        by_height = _BY_HEIGHT.intersection(self._said.words[i : i + length])
        if by_height and ' '.join(self._said.words[i + length : i + length + 1]) != 'at':
            return None  # `the lower one lands`: who that is, only their heights tell
        if self._counts(i, i + length):
            return None  # `all six waypoints`
        kind = NounKind.EGO if sense.tag is Tag.EGO_PRONOUN else NounKind.PRONOUN
        return self._phrase(i, i + length, sense.key, kind)

    def _counts(self, i: int, stop: int) -> bool:
        number = self._said.lexicon.number_words.get(self._said.words[stop - 1], 0)
        return i + 1 < stop and number > 2

    def _one_more(self, i: int) -> int:
        """Return where `another`, `a second` ends that acts or has its place; 0 if it does not."""
        words = self._said.words
        if words[i] == 'another':
            stop = i + 1
        elif words[i] == 'a' and words[i + 1 : i + 2] and words[i + 1] in _FURTHER:
            if i and words[i - 1] in _SPANS:
                return 0  # `after a second over the park`
            stop = i + 2
        else:
            return 0
        acts = self._said.longest(stop, Tag.VERB) is not None
        return stop if acts or self._placed(stop) else 0

    def _acts(self, j: int) -> bool:
        found = self._said.longest(j, Tag.VERB)
        return found is not None and found[1].key in _EGO_ACTS

    def _shares(self, i: int) -> bool:
        """`two drones track it, one from 20 m`, `two vans, one near the park`."""
        before = self._said.words[i - 1] if i else ''
        plain = before not in ('the', 'this', 'that', 'which', 'each', 'another', 'every', 'no')
        several = any(
            a in self._said.words[:i] for a in ('two', '2', 'three', '3', 'both', 'four')
        )
        placed = self._placed(i + 1)
        return several and plain and before not in _BY_HEIGHT and placed

    def _placed(self, i: int) -> bool:
        """Return whether a place or a number with a preposition follows."""
        found = self._said.longest(i, Tag.RELATION, Tag.PREPOSITION)
        return found is not None and found[1].key not in ('of', 'to', 'by', 'within', 'beyond')

    def letter(self, i: int) -> tuple[NounPhrase, int] | None:
        """`drone A …, and B passes it on`: the letter alone, once it was given to somebody."""
        name = self._said.words[i].lower()
        if not self._said.tokens[i].capital or name not in self._named_letters():
            return None
        kind, key = self._named_letters()[name]
        if (
            self._said.words[i] == 'a'
            and (not self._said.is_predicate(i + 1))
            and (not self._ends(i + 1))
        ):
            return None  # the article
        phrase, stop = self._phrase(i, i + 1, key, kind)
        number = ord(name) - ord('a') + 1
        return replace(phrase, index=number, determiner=Determiner.DEFINITE), stop

    def _named_letters(self) -> dict[str, tuple[NounKind, str]]:
        if self._letters is None:
            self._letters = {}
            for j in range(1, len(self._said.words)):
                if not self._said.tokens[j].capital:
                    continue
                for _, senses in self._said.matches(j - 1):
                    for sense in senses:
                        if sense.tag in (Tag.UAV, Tag.AGENT, Tag.VEHICLE):
                            for name in self._listed_at(j):
                                self._letters[name] = (NOUN_KINDS[sense.tag], sense.key)
            self._letters = self._letters or self._listed_letters()
        return self._letters

    def _listed_at(self, j: int) -> list[str]:
        """`drones A, B and C`: all letters of the list that begins here."""
        words, tokens = self._said.words, self._said.tokens
        names = [words[j].lower()]
        while j + 2 < len(words) and words[j + 1] in (',', 'and', '&') and tokens[j + 2].capital:
            j += 2
            names.append(words[j].lower())
        return names

    def _listed_letters(self) -> dict[str, tuple[NounKind, str]]:
        """`3 uavs: A hover … / B patrol … / C track …`: letters in order, and only UAVs about."""
        said = self._said
        letters = [w.lower() for w, t in zip(said.words, said.tokens, strict=True) if t.capital]
        named = sorted(set(letters) - {'i'})
        flying = any(said.has(j, Tag.UAV) for j in range(len(said.words)))
        if len(named) < 2 or not flying or named != [chr(ord('a') + n) for n in range(len(named))]:
            return {}
        return dict.fromkeys(named, (NounKind.UAV, 'drone'))

    def _ends(self, j: int) -> bool:
        return j >= len(self._said.words) or self._said.words[j] in ('.', ',', ';', ')', '\n')

    def ordinal_alone(self, i: int) -> tuple[NounPhrase, int] | None:
        """`two drones: first hovers …, second tracks …`: told apart by number only."""
        order = ('first', 'second', 'third', 'fourth')
        if self._said.words[i] not in order:
            return None
        if i and self._said.words[i - 1] in ('the', 'a', 'at'):
            return None
        if self._said.longest(i + 1, Tag.VERB) is None:
            return None
        if self._said.words[i] == 'first':
            return None
        return self._phrase(i, i + 1, f'nth{order.index(self._said.words[i]) + 1}')

    def _phrase(
        self, i: int, stop: int, key: str, kind: NounKind = NounKind.PRONOUN
    ) -> tuple[NounPhrase, int]:
        return (
            NounPhrase(
                kind=kind,
                key=key,
                start=self._said.tokens[i].start,
                end=self._said.tokens[stop - 1].end,
                head_text=' '.join(self._said.words[i:stop]),
            ),
            stop,
        )
