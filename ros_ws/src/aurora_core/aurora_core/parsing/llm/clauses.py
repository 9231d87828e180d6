# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Clauses of a reading: together they are the whole prompt, and each says what it became."""

from __future__ import annotations

from collections.abc import Sequence

from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.constructions.messages import TELLING
from aurora_core.parsing.llm.asides import denies, may_ask, writes
from aurora_core.parsing.llm.facts import PromptFacts, overlap
from aurora_core.parsing.llm.reading import ClauseReading, Reading
from aurora_core.spec.parameter import Span
from aurora_core.spec.vocabulary import ClauseStatus

WORLD = 'world'
# What may stand between two clauses.
_JOINTS = (
    AtomKind.COMMA,
    AtomKind.STOP,
    AtomKind.FILL,
    AtomKind.CONJUNCTION,
    AtomKind.THEN,
    AtomKind.FRAME,
    AtomKind.SUBORDINATOR,
    AtomKind.RELATIVE,
    AtomKind.PREPOSITION,
)
# What can say that something is not so.
_CAN_DENY = frozenset({'conditions', 'counts', 'forbidden', 'links', 'orders'})
# What words of the prompt are demanded for elsewhere.
_ANCHORED = (WORLD, 'agents', 'uavs')


def clause_spans(
    clauses: Sequence[ClauseReading], facts: PromptFacts, complaints: list[str]
) -> tuple[Span | None, ...]:
    """Return where each clause stands; None with an objection for one that does not.

    The same words may stand twice: a clause is looked for behind the one before.
    """
    found: list[Span | None] = []
    reached = 0
    for clause in clauses:
        spans = facts.spans(clause.quote)
        if not spans:
            complaints.append(f'clauses: {clause.quote!r} is not in the prompt; quote it exactly')
            found.append(None)
            continue
        span = next((s for s in spans if s.start >= reached), spans[0])
        reached = max(reached, span.end)
        found.append(span)
    return tuple(found)


def unread_spans(
    clauses: Sequence[ClauseReading], spans: Sequence[Span | None]
) -> tuple[Span, ...]:
    """Return the spans of the clauses that are admitted not to be encoded."""
    return tuple(
        span
        for clause, span in zip(clauses, spans, strict=True)
        if span is not None and clause.status is ClauseStatus.NOT_ENCODED
    )


def aside_spans(
    clauses: Sequence[ClauseReading], spans: Sequence[Span | None], facts: PromptFacts
) -> tuple[Span, ...]:
    """Return the spans of the clauses that ask for nothing, where their words agree."""
    return tuple(
        span
        for clause, span in zip(clauses, spans, strict=True)
        if clause.status is ClauseStatus.NO_REQUIREMENT
        and span is not None
        and not may_ask(span, facts)
    )


def check_clauses(
    reading: Reading, spans: Sequence[Span | None], facts: PromptFacts, complaints: list[str]
) -> None:
    """Object to words in no clause, ids that are not there and elements from nowhere."""
    known = [s for s in spans if s is not None]
    for atom in facts.atoms:
        if atom.kind in _JOINTS or any(overlap(atom, s) for s in known):
            continue
        complaints.append(f'{facts.text(atom)!r} is in no clause: clauses must cover the prompt')
    elements = _elements(reading)
    for clause, span in zip(reading.clauses, spans, strict=True):
        if span is not None:
            _check_clause(clause, span, elements, facts, complaints)
    cited = {one for c in reading.clauses if c.status is ClauseStatus.ENCODED for one in c.ids}
    complaints += [
        f'{one}: no encoded clause cites it; nothing may be added that the prompt does not ask for'
        for one, kind in elements.items()
        if one not in cited and kind not in _ANCHORED
    ]


_LISTS = (
    'agents', 'uavs', 'missions', 'links', 'events', 'orders', 'conditions', 'counts', 'forbidden',
)  # fmt: skip


def _elements(reading: Reading) -> dict[str, str]:
    """Return the kind of every element by its id."""
    found = {WORLD: WORLD}
    for kind in _LISTS:
        found |= {element.id: kind for element in getattr(reading, kind)}
    return found


def _check_clause(
    clause: ClauseReading,
    span: Span,
    elements: dict[str, str],
    facts: PromptFacts,
    complaints: list[str],
) -> None:
    words = clause.quote
    unknown = [one for one in clause.ids if one not in elements]
    if unknown:
        complaints.append(f'clause {words!r} cites {", ".join(unknown)}, which is not there')
    within = [atom for atom in facts.atoms if overlap(atom, span)]
    if clause.status is ClauseStatus.ENCODED:
        if not clause.ids:
            complaints.append(f'clause {words!r} is encoded and cites no id')
        tells = any(_tells(a, facts) for a in within)
        kinds = {elements.get(one) for one in clause.ids}
        if tells and not kinds & {'events', 'links', 'conditions'}:
            complaints.append(
                f'clause {words!r} tells somebody something, and cites no event for it'
            )
        stays_up = any(a.kind is AtomKind.IN_FLIGHT or a.key == 'land' for a in within)
        if denies(within, facts) and not stays_up and not kinds & _CAN_DENY:
            complaints.append(
                f'clause {words!r} denies something: it needs a condition, or is not_encoded'
            )
    if clause.status is ClauseStatus.NO_REQUIREMENT and may_ask(span, facts):
        complaints.append(
            f'clause {words!r} may ask for something: it cannot be no_requirement; make it '
            'not_encoded when the schema cannot say it'
        )


def _tells(atom: Atom, facts: PromptFacts) -> bool:
    """Tell whether somebody of the scene is told something.

    Not in `a relay`, a noun behind its article; not in `send a drone along`; nor where who writes
    tells or is told: `we were asked`.
    """
    if atom.kind is not AtomKind.VERB or atom.key not in TELLING:
        return False
    k = facts.atoms.index(atom)
    article = facts.prompt[: atom.start].lower().split()[-1:] in (['a'], ['an'], ['the'])
    beside = facts.atoms[max(0, k - 2) : k + 2]
    behind = next((a.noun for a in facts.atoms[k + 1 : k + 2]), None)
    sent = atom.key == 'send' and behind is not None and behind.kind is NounKind.UAV
    return not (article or sent or any(writes(a) for a in beside))


def read_by_the_model_alone(span: Span, facts: PromptFacts) -> str:
    """Return a note on the words of an encoded clause that only the model can have understood."""
    unknown = [a for a in facts.atoms if a.kind is AtomKind.UNKNOWN and overlap(a, span)]
    if not unknown:
        return ''
    return 'understood by the model alone: ' + ', '.join(repr(facts.text(a)) for a in unknown)
