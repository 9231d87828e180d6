# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Clauses that a model says ask for nothing, and negations that deny nothing.

Both are held against their words alone: where they could be a request, it goes back to the model.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from aurora_core.parsing.asks_nothing import BESIDE, LABEL, reason_of, stands_as_label
from aurora_core.parsing.atoms import Atom, AtomKind, Determiner, NounKind, needs_nothing
from aurora_core.parsing.llm.facts import PromptFacts, inside
from aurora_core.parsing.measures import COUNT
from aurora_core.spec.parameter import Span

_SILENT = (AtomKind.STOP, AtomKind.NEGATION)
# What leaves open what follows: `we want to see whether`, `the van may`.
_WONDERS = re.compile(r'\b(?:whether|how|if|what|why)$')
_WRITERS = frozenset({'i', 'me', 'mine', 'ours', 'us', 'we'})
_LEAVES_OPEN = frozenset({'can', 'could', 'may', 'might'})
# Said of the scene as a whole, these words are a request.
_STATES = (AtomKind.WORLD, AtomKind.PATTERN, AtomKind.STREETS_FLAG, AtomKind.NO_TRAFFIC)
# Of whom these are denied nothing is asked.
_NO_DEEDS = frozenset({'be', 'contain', 'see'})
_TURNED = (AtomKind.AUXILIARY, AtomKind.FILL)


def may_ask(span: Span, facts: PromptFacts) -> bool:
    """Tell whether a clause may ask for something: then it cannot be `no_requirement`."""
    within = [a for a in facts.atoms if inside(a, span)]
    told = [
        a
        for a in within
        if a.kind not in _SILENT and not (a.is_actor and facts.is_denied(a)) and not speaks(a)
    ]
    label = stands_as_label(span, facts.prompt)
    places = frozenset(('', BESIDE, *[LABEL] * label))
    if needs_nothing(told) or reason_of(facts.text(span), places) is not None:
        return False
    if any(a.measure is not None and a.measure.dimension != COUNT for a in told):
        return True
    if label or _is_open(within):
        return False
    acts = any(a.kind is AtomKind.VERB and a.key != 'be' for a in told)
    bodies = any(a.is_actor and a.noun is not None for a in told)
    places_told = any(a.is_place for a in told)
    alone = all(a.kind in (AtomKind.RELATION, AtomKind.PREPOSITION) for a in told)
    counted = any(a.measure is not None for a in told) and bool(acts or bodies)
    return any(a.kind in _STATES for a in told) or bodies or places_told or alone or counted


def speaks(atom: Atom) -> bool:
    """Tell whether a word means who writes, or nobody that it names: `us`, `it`."""
    return writes(atom) or (atom.noun is not None and atom.noun.kind is NounKind.PRONOUN)


def writes(atom: Atom) -> bool:
    """Tell whether a word means who writes: `I`, `us`."""
    noun = atom.noun
    return noun is not None and noun.kind is NounKind.EGO and noun.head_text in _WRITERS


def _is_open(within: Sequence[Atom]) -> bool:
    """`we want to see whether …`, `the van may …`: a purpose, or a permission."""
    if any(a.kind is AtomKind.CONTEXT for a in within):
        return True
    opening = next((a for a in within if a.kind is not AtomKind.CONJUNCTION), None)
    if opening is not None and opening.kind is AtomKind.FRAME and _WONDERS.search(opening.words):
        return True
    verbs = [a for a in within if a.kind in (AtomKind.VERB, AtomKind.AUXILIARY)][:1]
    return bool(verbs) and verbs[0].key in _LEAVES_OPEN


def denies(within: Sequence[Atom], facts: PromptFacts) -> bool:
    """Tell whether a negation of a clause denies a deed or a body, and does not only tell who.

    `the black van, not the white one` and `the van that never stops` say who is meant; in `when it
    no longer sees the van` the negation belongs to the cause; nobody is made to notice something.
    """
    for k, atom in enumerate(within):
        if atom.kind is not AtomKind.NEGATION:
            continue
        if any(a.kind in (AtomKind.RELATIVE, AtomKind.SUBORDINATOR) for a in within[:k]):
            continue
        behind = next((a for a in within[k + 1 :] if a.kind not in _TURNED), None)
        noun = behind.noun if behind is not None else None
        if behind is None or (noun is not None and noun.determiner is Determiner.DEFINITE and k):
            continue
        if behind.is_actor or (behind.kind is AtomKind.VERB and behind.key not in _NO_DEEDS):
            return True
    return False
