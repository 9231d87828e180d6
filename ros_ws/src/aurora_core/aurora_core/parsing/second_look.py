# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A second look at sentences that were not read: is one word in the way?

People put words where no grammar expects them. A clause that was not read is read again without
one of its words, or cut at one of its commas, and what leaves least of the prompt unread is kept.
A word left out is never lost: unless it is one that says nothing by itself (an auxiliary, a
comma, `that`), it is admitted as not encoded. Words that turn a meaning round (negations,
`unless`, `when`, `or`, numbers, named actors) are never left out.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from aurora_core.parsing.atom_runs import runs
from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.attempt import Attempt, attempt
from aurora_core.parsing.measures import LENGTH
from aurora_core.parsing.new_clauses import is_placed
from aurora_core.parsing.reactions import REACTIONS
from aurora_core.parsing.scene import ClauseDraft
from aurora_core.parsing.told_pieces import is_joint_word
from aurora_core.spec.parameter import Span
from aurora_core.spec.vocabulary import ClauseStatus

# Readings tried in one look, and looks in a row. Reading takes time with the square of the words:
# tries times words times words is bounded, too.
_MOST_TRIES = 8
_MOST_WORK = 50_000
_MOST_LOOKS = 2

# Clauses that make a request which a question about another clause need not hold up.
_ENOUGH = 2

# What may be left out, what is most often in the way first (counted over the prompts to tune on).
_IN_THE_WAY: dict[AtomKind | NounKind, int] = {
    AtomKind.RELATIVE: 1,
    AtomKind.VERB: 0,
    AtomKind.LINK: 0,
    AtomKind.THING: 0,
    NounKind.PRONOUN: 0,
    AtomKind.PREPOSITION: 1,
    AtomKind.COMMA: 1,
    AtomKind.AUXILIARY: 1,
    AtomKind.CONJUNCTION: 2,
    NounKind.UNKNOWN: 2,
    AtomKind.THEN: 3,
    AtomKind.STATE: 3,
    AtomKind.ROUTE: 3,
    AtomKind.PATTERN: 3,
    NounKind.PLACE: 3,
}
_PAUSE = 1  # the same of a sentence that is cut
# What may be left out of a sentence whose unread clause is another one.
_FAR = (AtomKind.RELATIVE, AtomKind.VERB, AtomKind.COMMA, AtomKind.AUXILIARY, AtomKind.THEN)
_TURNS_ROUND = frozenset(
    {
        *(
            'past',
            'before',
            'after',
            'until',
            'within',
            'than',
            'at least',
            'at most',
            'by',
            'from',
        ),
        *('between', 'or', 'but'),
    }
)
# Without them a sentence may still be read, but as one that says something else.
_WEIGHTY = (AtomKind.VERB, AtomKind.PATTERN, AtomKind.STATE)
# What happens: without its verb the rest of a sentence is no event and must be nothing else.
_HAPPENINGS = frozenset(
    {*REACTIONS, 'lose', 'see', 'vanish', 'appear', 'receive', 'land', 'alert'}
)
_WEIGHT = 3  # words that leaving out one of them must open beside those that any word must
# Pronouns for others than who was spoken of last.
_OTHERS = ('rest', 'other', 'another', 'both')
# Verbs that say little: what stands beside them is the predicate.
_LIGHT = frozenset({'be', 'keep', 'put', 'come', 'exist', 'contain', ''})
_OF_PATTERNS = ('radius', 'diameter', 'length', 'width', 'sides')
# Between a name and its number.
_INSIDE = (AtomKind.FILL, AtomKind.PREPOSITION, AtomKind.AUXILIARY)
# Left out without a word about it.
_SAYS_NOTHING = (AtomKind.COMMA, AtomKind.AUXILIARY, AtomKind.RELATIVE)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Change:
    """One change of the atoms: a word left out, or a pause that becomes the end of a sentence."""

    at: int
    stop: bool
    weight: int
    rank: tuple[bool, int, int]

    def apply(self, atoms: tuple[Atom, ...]) -> tuple[Atom, ...]:
        here = atoms[self.at]
        put = (replace(here, kind=AtomKind.STOP, key='.'),) if self.stop else ()
        return (*atoms[: self.at], *put, *atoms[self.at + 1 :])

    def admits(self, atoms: tuple[Atom, ...]) -> tuple[Span, ...]:
        here = atoms[self.at]
        behind = atoms[self.at + 1 : self.at + 2]
        joins = here.kind is AtomKind.CONJUNCTION and any(a.measure for a in behind)
        if self.stop or here.kind in _SAYS_NOTHING or joins:  # a value that is lost is told itself
            return ()
        return (Span(start=here.start, end=here.end),)

    def cost(self, prompt: str, atoms: tuple[Atom, ...]) -> int:
        """How many words it must open to be no loss: those left out and one more."""
        lost = sum(len(prompt[s.start : s.end].split()) for s in self.admits(atoms))
        return lost + 1 + self.weight


def second_look(first: Attempt) -> Attempt:
    """Return the reading that leaves least of the prompt unread; the first one if none is better.

    Args:
        first: The reading of all words.
    """
    best = first
    left_out: tuple[Span, ...] = ()
    for _ in range(_MOST_LOOKS):
        if best.scene.refusals or not best.unread_words:
            break
        found = _one_look(best)
        if found is None:
            break
        best, admitted = found
        left_out += admitted
    for span in left_out:
        note = 'the clause was read without this'
        best.scene.clauses.append(ClauseDraft(span=span, notes=[note]))
    return best


def _one_look(known: Attempt) -> tuple[Attempt, tuple[Span, ...]] | None:
    prompt, context = known.scene.prompt, known.scene.context
    least = known.unread_words
    best: tuple[Attempt, tuple[Span, ...]] | None = None
    # What costs more than is unread cannot pay.
    hopeful = [c for c in _changes(known) if c.cost(prompt, known.atoms) < least]
    tries = min(_MOST_TRIES, _MOST_WORK // len(known.atoms) ** 2)
    for change in sorted(hopeful, key=lambda c: c.rank)[:tries]:
        tried = attempt(prompt, context, change.apply(known.atoms))
        if tried.scene.refusals or tried.said < known.said:
            continue
        if len(tried.scene.conditions) < len(known.scene.conditions):
            continue  # a demand that was read is no description of what somebody does
        cost = tried.unread_words + change.cost(prompt, known.atoms)
        if cost < least:
            least, best = cost, (tried, change.admits(known.atoms))
            if not tried.unread_words:
                break
    return best


def _changes(known: Attempt) -> Iterator[_Change]:
    """Return what may be changed in the sentences that were not read."""
    encoded = [c for c in known.scene.clauses if c.status is ClauseStatus.ENCODED]
    # What a short request leaves open is worth asking about.
    asks = bool(known.scene.questions)
    worth_asking = asks and len(encoded) < _ENOUGH
    at = 0  # number of the first atom of the sentence
    for sentence, mark in runs(known.atoms, AtomKind.STOP):
        begin, at = at, at + len(sentence) + (mark is not None)
        if not sentence:
            continue
        first, last = sentence[0], sentence[-1]
        if not asks and not any(
            span.start < last.end and first.start < span.end for span in known.unread
        ):
            continue
        for i, atom in enumerate(sentence):
            far = _distance(atom, known.unread)
            weighty = atom.kind in _WEIGHTY and atom.key not in _LIGHT
            kind = atom.noun.kind if atom.noun is not None else atom.kind
            rank = _IN_THE_WAY.get(kind)
            if worth_asking and (weighty or kind is NounKind.PRONOUN):
                rank = None
            if far and kind not in _FAR:
                rank = None
            if atom.kind is AtomKind.VERB and atom.key in _HAPPENINGS:
                rank = None
            if rank is not None and not _binds(sentence, i):
                weight = _WEIGHT if weighty else 0
                yield _Change(at=begin + i, stop=False, weight=weight, rank=(far > 0, rank, far))
            if _may_end(sentence, i):
                yield _Change(at=begin + i, stop=True, weight=0, rank=(far > 0, _PAUSE, far))


def _binds(sentence: Sequence[Atom], i: int) -> bool:
    """Return whether the sentence would say something else without this word."""
    atom = sentence[i]
    more = atom.words.endswith('than') and sentence[max(0, i - 1)].measure is not None
    if atom.words in _TURNS_ROUND or more:  # `5 m/s faster than the ego`
        return True
    behind = sentence[min(len(sentence) - 1, i + 1)]
    if atom.kind is AtomKind.COMMA and behind.kind is AtomKind.UNKNOWN:
        return True  # what is said of somebody unknown is said of nobody else
    opens = i == 0 or sentence[i - 1].kind is AtomKind.COMMA
    if atom.kind is AtomKind.UNKNOWN and opens and is_placed(sentence[i:]):
        return True
    if _acts(sentence, i) or _names_number(sentence, i):
        return True
    if atom.kind is AtomKind.CONJUNCTION and is_joint_word(sentence, i):
        return True
    if atom.kind is AtomKind.COMMA and behind.kind is AtomKind.CONJUNCTION:
        return any(a.is_actor for a in sentence[i + 2 : i + 3])  # `6 m apart, and a van`
    beside = sentence[max(0, i - 1)], sentence[min(len(sentence) - 1, i + 1)]
    # `15 m ahead and a bus behind`, `behind the vans and drives`: who is it?
    joins = beside[1].is_actor or (beside[0].is_actor and beside[1].kind is AtomKind.VERB)
    return atom.kind is AtomKind.CONJUNCTION and joins


def _names_number(sentence: Sequence[Atom], i: int) -> bool:
    """`radius of 40 m`, `60 m width`: without its name, a length is a height or a distance."""
    if sentence[i].kind is not AtomKind.THING or sentence[i].key not in _OF_PATTERNS:
        return False
    ahead = next((a for a in sentence[i + 1 :] if a.kind not in _INSIDE), None)
    beside = (ahead, sentence[i - 1] if i else None)
    return any(a is not None and a.measure is not None and a.key == LENGTH for a in beside)


def _acts(sentence: Sequence[Atom], i: int) -> bool:
    """`the others hover`: without the words for them, somebody else would do it."""
    noun = sentence[i].noun
    if noun is None or noun.key not in _OTHERS or i + 1 == len(sentence):
        return False
    return sentence[i + 1].kind in (AtomKind.VERB, AtomKind.AUXILIARY)


def _may_end(sentence: Sequence[Atom], i: int) -> bool:
    """Return whether a sentence may be cut here: no cause may lose its effect by it."""
    kind = sentence[i].kind
    if kind is not AtomKind.COMMA and kind is not AtomKind.CONJUNCTION:
        return False
    if any(a.kind is AtomKind.SUBORDINATOR for a in sentence):
        return False
    return kind is AtomKind.COMMA or any(a.kind is AtomKind.VERB for a in sentence[i + 1 :])


def _distance(atom: Atom, unread: tuple[Span, ...]) -> int:
    """Characters from an atom to the nearest unread clause, 0 inside one."""
    gaps = [max(span.start - atom.end, atom.start - span.end, 0) for span in unread]
    return min(gaps, default=0)
