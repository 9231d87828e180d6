# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a prompt says for certain: its numbers, actors, places and world words, with their spans.

Read with the words of the offline parser (lexicon and measures, no grammar). A model may
understand more than these words; it may not contradict them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.atoms import ACTORS, Atom, AtomKind, NounKind
from aurora_core.parsing.landmarks import landmark_phrases
from aurora_core.parsing.measures import COUNT, Measure
from aurora_core.parsing.tagging import tag
from aurora_core.parsing.tokens import Token, tokenize
from aurora_core.spec.parameter import Span

_ORDINAL = re.compile(r'\d+(?:st|nd|rd|th)', re.IGNORECASE)
_VAGUE = frozenset({'one', 'several'})
_CLOCK_BEFORE = re.compile(r'\bt\s*=\s*$', re.IGNORECASE)
_WORD_BEHIND = re.compile(r'-[A-Za-z]')
# Letters that a number is glued to.
_NAME_BEFORE = re.compile(r'(?:[A-Za-z]-?|#)$')
_QUOTES = str.maketrans({'’': "'", '‘': "'", '“': '"', '”': '"'})


class PromptFacts:
    """The certain facts of one prompt.

    Attributes:
        prompt: As typed.
        context: The map.
        atoms: Units of meaning in order.
    """

    def __init__(self, prompt: str, context: ParseContext) -> None:
        self.prompt = prompt
        self.context = context
        tokens = tokenize(prompt)
        tagged = tag(tokens, landmark_phrases(context.landmark_names))
        self.atoms: tuple[Atom, ...] = tuple(_told_to_act(tagged.atoms, tokens))
        self._even = prompt.translate(_QUOTES)

    @property
    def measures(self) -> tuple[Measure, ...]:
        """Every stated number, counts of actors aside."""
        return tuple(atom.measure for atom in self.atoms if atom.measure is not None)

    def only_names(self, measure: Measure) -> bool:
        """Tell whether a number demands nothing: `V1`, `one of them`, `twelve-year-olds`."""
        text, before = self.text(measure), self.prompt[: measure.start]
        if _ORDINAL.fullmatch(text) or (measure.value == 0.0 and _CLOCK_BEFORE.search(before)):
            return True
        attached = _NAME_BEFORE.search(before) or _WORD_BEHIND.match(self.prompt[measure.end :])
        return measure.dimension == COUNT and (attached is not None or text.lower() in _VAGUE)

    @property
    def actors(self) -> tuple[Atom, ...]:
        """Every noun phrase that names an actor, pronouns aside."""
        return tuple(
            atom
            for atom in self.atoms
            if atom.noun is not None
            and atom.noun.kind in ACTORS
            and atom.noun.kind is not NounKind.PRONOUN
        )

    @property
    def places(self) -> tuple[Atom, ...]:
        """Every noun phrase that names a place of the vocabulary or the map."""
        wanted = (NounKind.PLACE, NounKind.LANDMARK)
        return tuple(a for a in self.atoms if a.noun is not None and a.noun.kind in wanted)

    def world_words(self, kind: str) -> tuple[Atom, ...]:
        """Return the words for `weather`, `time_of_day` or `traffic_density`."""
        return tuple(
            a for a in self.atoms if a.kind is AtomKind.WORLD and a.key.startswith(f'{kind}:')
        )

    def is_corrected(self, atom: Atom) -> bool:
        """Tell whether a word was read as another one: `story` as `stormy`."""
        return atom.words not in self.prompt.lower()

    def is_denied(self, atom: Atom) -> bool:
        """Return whether a negation stands right before: `no drone` asks for none."""
        before = [a for a in self.atoms if a.end <= atom.start]
        return bool(before) and before[-1].kind is AtomKind.NEGATION

    def text(self, span: Span | Atom | Measure) -> str:
        """Return the words of a span."""
        return self.prompt[span.start : span.end]

    def spans(self, quote: str) -> tuple[Span, ...]:
        """Return every place where the prompt has these words; blanks and case do not count."""
        words = quote.translate(_QUOTES).split()
        if not words:
            return ()
        pattern = r'\s+'.join(map(re.escape, words))
        # `40m` stands in `60x40m`, but `0 m` does not stand in `40 m`.
        digit, letter = words[0][0].isdigit(), words[0][0].isalnum()
        before = r'(?<![\d.,])' if digit else r'(?<!\w)' if letter else ''
        ends = words[-1][-1]
        after = r'(?!\d|[.,]\d)' if ends.isdigit() else r'(?!\w)' if ends.isalnum() else ''
        found = re.finditer(f'{before}{pattern}{after}', self._even, re.IGNORECASE)
        return tuple(Span(start=m.start(), end=m.end()) for m in found)


def _told_to_act(atoms: Sequence[Atom], tokens: Sequence[Token]) -> Iterator[Atom]:
    """Yield the atoms; `let the truck stop`: who is told to act is no place."""
    causing = False
    for atom in atoms:
        place = atom.noun is not None and atom.noun.kind is NounKind.MISSING_LANDMARK
        within = [t for t in tokens if atom.start <= t.start and t.end <= atom.end]
        if place and causing and len(within) > 1:
            yield from tag(within[:-1], {}).atoms
            yield from tag(within[-1:], {}).atoms
        else:
            yield atom
        causing = atom.kind is AtomKind.CAUSATIVE


def overlap(a: Span | Atom | Measure, b: Span | Atom | Measure) -> bool:
    """Return whether two pieces of the prompt share a character."""
    return a.start < b.end and b.start < a.end


def inside(inner: Span | Atom | Measure, outer: Span | Atom | Measure) -> bool:
    """Return whether one piece of the prompt lies within another."""
    return outer.start <= inner.start and inner.end <= outer.end
