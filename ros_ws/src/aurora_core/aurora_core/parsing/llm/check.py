# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Judge the text of a reply: an outcome that the prompt supports, or objections to it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from pydantic import ValidationError

from aurora_core.outcomes.parse import ParseOutcome, Refusal, RefusalKind
from aurora_core.parsing.asks_nothing import set_aside
from aurora_core.parsing.assemble import build
from aurora_core.parsing.atoms import Atom, NounKind
from aurora_core.parsing.doubts.table import doubtful
from aurora_core.parsing.llm.actors import Anchors, check_missing
from aurora_core.parsing.llm.clauses import (
    aside_spans,
    check_clauses,
    clause_spans,
    read_by_the_model_alone,
    unread_spans,
)
from aurora_core.parsing.llm.extract import ReplyError, json_object
from aurora_core.parsing.llm.facts import PromptFacts, overlap
from aurora_core.parsing.llm.numbers import StatedNumbers
from aurora_core.parsing.llm.parts import Parts
from aurora_core.parsing.llm.places import check_places, check_world
from aurora_core.parsing.llm.reading import Reading
from aurora_core.parsing.llm.scene_builder import build_scene
from aurora_core.parsing.llm.turned import check_turned
from aurora_core.parsing.llm.wording import Wording
from aurora_core.parsing.parser import parse_offline
from aurora_core.parsing.rules import settle
from aurora_core.parsing.scene import ClauseDraft, Scene
from aurora_core.spec.parameter import Span
from aurora_core.spec.vocabulary import AgentType, ClauseStatus

_MOST_COMPLAINTS = 12
# Every answer has one of these keys.
_MARKS = frozenset({'clauses', 'missing', 'question'})


@dataclass(frozen=True, slots=True, kw_only=True)
class Judgement:
    """What a reply is worth.

    Attributes:
        outcome: None when there are complaints.
        complaints: What is wrong, worded for the model.
    """

    outcome: ParseOutcome | None = None
    complaints: tuple[str, ...] = ()


def judge(text: str, facts: PromptFacts) -> Judgement:
    """Judge a reply by its text alone, whatever the provider promises about it."""
    try:
        reading = Reading.model_validate_json(json_object(text, _MARKS), strict=True)
    except ReplyError as err:
        return Judgement(complaints=(str(err),))
    except ValidationError as err:
        return Judgement(complaints=_schema_complaints(err))
    complaints: list[str] = []
    outcome = _outcome(reading, facts, complaints)
    if complaints or outcome is None:
        return Judgement(complaints=tuple(dict.fromkeys(complaints))[:_MOST_COMPLAINTS])
    return Judgement(outcome=outcome)


def _outcome(reading: Reading, facts: PromptFacts, complaints: list[str]) -> ParseOutcome | None:
    if reading.question is not None and reading.question.strip():
        return ParseOutcome(question=reading.question.strip())
    spans = clause_spans(reading.clauses, facts, complaints)
    unread = unread_spans(reading.clauses, spans)
    missing = check_missing(reading, facts, complaints)
    if missing:
        return None if complaints else _refused(reading, missing, facts)
    anchors = Anchors(facts, complaints)
    # Words that ask for nothing have no part in the answer either.
    free = (*unread, *aside_spans(reading.clauses, spans, facts))
    anchors.read(reading, free)
    admitted: list[Span] = []
    check_places(reading, facts, free, complaints, admitted)
    check_world(reading, facts, free, complaints)
    check_clauses(reading, spans, facts, complaints)
    Wording(reading, facts, free, complaints, admitted).check()
    check_turned(reading, facts, complaints)
    sizes = len(reading.agents), len(reading.uavs)
    numbers = StatedNumbers(facts, free, complaints, (*sizes, sum(sizes)))
    parts = Parts(facts, numbers, complaints)
    try:
        build_scene(reading, parts, anchors)
        numbers.lost(anchors.count)
        _put_clauses(parts.scene, reading, spans, parts.ids, facts)
        settle(parts.scene)
        _set_labels_aside(parts.scene, facts)
        if parts.scene.questions:
            question = ' '.join(dict.fromkeys(parts.scene.questions))
            return ParseOutcome(question=question, clauses=parts.scene.finished_clauses())
        spec = build(parts.scene)
        admitted += doubtful(spec, facts.atoms, by_model=True)
        if admitted:
            # Not for the model to mend: the schema has nothing for these words.
            parts.scene.clauses += [
                ClauseDraft(span=span, notes=['nothing in the scenario accounts for this'])
                for span in admitted
            ]
            spec = build(parts.scene)
    except ValidationError as err:
        complaints += _schema_complaints(err)
        return None
    except ValueError as err:
        complaints.append(str(err))
        return None
    return ParseOutcome(spec=spec, clauses=spec.clauses)


def _put_clauses(
    scene: Scene,
    reading: Reading,
    spans: Sequence[Span | None],
    ids: dict[str, str],
    facts: PromptFacts,
) -> None:
    for clause, span in zip(reading.clauses, spans, strict=True):
        if span is None:
            continue
        encoded = clause.status is ClauseStatus.ENCODED
        alone = read_by_the_model_alone(span, facts) if encoded else ''
        scene.clauses.append(
            ClauseDraft(
                span=span,
                status=clause.status,
                ids={ids.get(one, one): None for one in clause.ids} if encoded else {},
                notes=[note for note in (clause.note, alone) if note],
            )
        )


def _set_labels_aside(scene: Scene, facts: PromptFacts) -> None:
    """`white`, `large`: words that only tell bodies apart ask for nothing; nor do thanks."""
    set_aside(scene.clauses, scene.prompt)
    labels = frozenset(word for a in facts.actors if a.noun for word in a.noun.labels)
    for clause in scene.clauses:
        words = facts.text(clause.span).lower().split()
        if clause.status is ClauseStatus.NOT_ENCODED and words and labels.issuperset(words):
            clause.status = ClauseStatus.NO_REQUIREMENT


def _refused(reading: Reading, missing: Sequence[Atom], facts: PromptFacts) -> ParseOutcome:
    """Return what is missing: as a refusal where that is certain, else as a question.

    A refusal is a proof. That a word names an actor or a place, and none of ours, is certain when
    the lexicon knows it as such, or the offline parser reads it so; not because a model says so.
    """
    known = parse_offline(facts.prompt, facts.context).refusals
    refusals: list[Refusal] = []
    doubtful: list[Refusal] = []
    for said, atom in zip(reading.missing, missing, strict=True):
        kind = atom.noun.kind if atom.noun is not None else None
        place = said.kind == 'landmark' or kind is NounKind.MISSING_LANDMARK
        types = tuple(t.value for t in AgentType)
        refusal = Refusal(
            kind=RefusalKind.MISSING_ELEMENT if place else RefusalKind.UNSUPPORTED,
            word=(atom.noun.head_text if atom.noun else '') or facts.text(atom),
            span=Span(start=atom.start, end=atom.end),
            list_name=f'landmarks of {facts.context.map_name}' if place else 'agent types',
            closed_list=facts.context.landmark_names if place else types,
        )
        certain = kind in (NounKind.UNSUPPORTED, NounKind.MISSING_LANDMARK) or any(
            overlap(r.span, atom) for r in known
        )
        (refusals if certain else doubtful).append(refusal)
    if doubtful:
        told = ' '.join(refusal.sentence() for refusal in doubtful)
        return ParseOutcome(question=f'{told} What is meant?')
    return ParseOutcome(refusals=tuple(refusals))


def _schema_complaints(err: ValidationError) -> tuple[str, ...]:
    found = []
    for one in err.errors(include_url=False)[:_MOST_COMPLAINTS]:
        where = '.'.join(str(part) for part in one['loc'])
        found.append(f'{where}: {one["msg"]}' if where else str(one['msg']))
    return tuple(found)
