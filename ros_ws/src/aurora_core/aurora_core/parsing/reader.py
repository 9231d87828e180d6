# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Reads the clauses of a prompt in order and pairs causes with their effects."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atoms import AtomKind, NounKind, needs_nothing
from aurora_core.parsing.constructions.places import place_party
from aurora_core.parsing.constructions.states import adjectives
from aurora_core.parsing.criteria.criterion import Criterion
from aurora_core.parsing.criteria.meaning import Meaning
from aurora_core.parsing.criteria.moments import Sequel
from aurora_core.parsing.criteria.parties import Parties
from aurora_core.parsing.criteria.sequels import Sequels
from aurora_core.parsing.earlier_phases import earlier_phase, tells_before
from aurora_core.parsing.effects import (
    effect_of_held,
    follows_event,
    note_fronted_time,
    so_much_later,
    told_to,
    without_cause,
)
from aurora_core.parsing.leading_causes import leading
from aurora_core.parsing.main_clause import main_clause
from aurora_core.parsing.mission_changes import changes_mission, starts_late
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pieces import Link, Piece, first_solid
from aurora_core.parsing.resolver import Resolver
from aurora_core.parsing.scene import ClauseDraft, Entity, Scene
from aurora_core.parsing.segments import clauses
from aurora_core.parsing.sequence import (
    after_others,
    after_sight,
    after_told,
    before_told,
    in_sequence,
    sight,
    soon,
    who_was_told,
)
from aurora_core.parsing.story import Story
from aurora_core.parsing.told_pieces import (
    acts_later,
    got_message,
    is_arrival,
    is_earlier,
    is_phase,
    joint_causes,
    leads_to,
    named_later,
    second_cause,
    was_doing,
)
from aurora_core.parsing.trailing_causes import effect_then_cause
from aurora_core.spec.parameter import Span
from aurora_core.spec.vocabulary import ClauseStatus

_CAUSES = (Link.WHEN, Link.AFTER, Link.UNTIL)


def _goes_on(pieces: Sequence[Piece], i: int) -> bool:
    """`it is hovering there when a bus stops; then it tracks the bus`: the effect comes last."""
    effect = pieces[i + 2] if i + 2 < len(pieces) else None
    return was_doing(pieces[i]) and effect is not None and effect.then


def _only_then(pieces: Sequence[Piece], i: int, prompt: str) -> bool:
    """`…, but only after drone A is done.`: no other clause follows that it could govern."""
    sentence = [p for p in pieces if p.sentence == pieces[i].sentence]
    caused = any(p.link in _CAUSES for p in sentence[:-1])
    return (
        pieces[i] is sentence[-1]
        and not caused
        and prompt[pieces[i].start :].lower().startswith('only ')
    )


def _acts_on(piece: Piece | None) -> bool:
    """`…, and it slows | and changes lanes`: whoever reacts does something else, too."""
    first = first_solid(piece.atoms) if piece is not None else None
    return first is not None and first.kind is AtomKind.VERB and first.form is VerbForm.THIRD


class Reader:
    """Turns pieces into drafts in a scene."""

    def __init__(self, scene: Scene) -> None:
        self._story = Story(scene)

    @property
    def resolver(self) -> Resolver:
        """Whom the nouns of the prompt mean."""
        return self._story.resolver

    def read(self, pieces: Sequence[Piece]) -> None:
        """Read all clauses."""
        self._read(pieces)
        self._story.drop_held(-1)

    def _read(self, pieces: Sequence[Piece]) -> None:
        i = 0
        while i < len(pieces):
            piece = pieces[i]
            self._story.drop_held(piece.sentence)
            nxt = pieces[i + 1] if i + 1 < len(pieces) else None
            same = nxt is not None and nxt.sentence == piece.sentence
            if piece.criterion is not None:
                self._criterion(piece, piece.criterion)
            elif piece.link is Link.UNTIL and piece.opens and same and nxt is not None:
                effect_then_cause(self._story, nxt, piece)  # `until it stops, the drone tracks it`
                piece = replace(piece, link=Link.WHEN)
                i += 1
            elif (
                piece.link in _CAUSES
                and is_phase(piece)
                and same
                and nxt is not None
                and piece.opens
            ):  # `when it has hovered there for 60 s, it lands`
                self._plain(replace(piece, link=Link.MAIN), following=nxt)
                self._story.before = piece
                self._plain(replace(nxt, then=True))
                i += 1
            elif piece.link in _CAUSES and piece.opens and same and nxt is not None:
                joint = joint_causes(pieces, i)
                leading(self._story, piece, pieces[i + joint + 1])
                for second in pieces[i + 1 : i + joint + 1]:
                    second_cause(self._story, second)
                i += joint
            elif (
                nxt is not None
                and same
                and (nxt.then or (got_message(piece) and nxt.link is Link.MAIN))
                and (is_arrival(piece) or leads_to(piece) or got_message(piece))
            ):
                leading(self._story, piece, nxt)  # `the bus arrives at the station, then …`
            elif same and nxt is not None and is_earlier(nxt) and piece.link is Link.MAIN:
                leading(self._story, replace(nxt, opens=True), piece)
                self._plain(replace(piece, then=True))
                i += 1
            elif same and nxt is not None and nxt.link is Link.WHEN and _goes_on(pieces, i):
                self._plain(piece)
                then = pieces[i + 2]
                leading(self._story, replace(nxt, opens=True, sentence=then.sentence), then)
                i += 1
            elif (
                piece.link in (Link.MAIN, Link.INFINITIVE, Link.PARTICIPLE)
                and same
                and nxt is not None
                and nxt.link in _CAUSES
                and (not nxt.opens or _only_then(pieces, i + 1, self._story.scene.prompt))
            ):
                effect_then_cause(self._story, piece, nxt)
                i += 1
            elif piece.link is Link.WHILE and piece.opens and same:
                self._plain(piece, following=nxt)
            else:
                self._plain(piece, ahead=nxt if same else None)
            self._story.before = piece
            i += 1

    def _criterion(self, piece: Piece, told: Criterion | Sequel) -> None:
        """A success condition; read as any other clause when it is not known of whom it is."""
        waits = self._story.held is not None or self._story.unknown_cause == piece.sentence
        if not waits:
            frame = self._story.open(piece)
            if self._states(told, frame.span):
                self._story.scene.understood.append(frame.span)
                adjectives(frame)
                self._left_out(told)
                return
            self._story.scene.clauses.pop()
        self._read(clauses(piece.atoms, piece.sentence))

    def _left_out(self, told: Criterion | Sequel) -> None:
        for span in told.unread if isinstance(told, Criterion) else ():
            note = 'the condition was read without this'
            self._story.scene.clauses.append(ClauseDraft(span=span, notes=[note]))

    def _states(self, told: Criterion | Sequel, span: Span) -> bool:
        if isinstance(told, Sequel):
            who, first = self._who(told)
            return Sequels(self._story.scene, span, who, first).state(told)
        stated = Meaning(told, self._story.scene, self._story.resolver, span).state()
        for placed in told.placed if stated else ():
            place_party(self._story.resolver, placed)
        return stated

    def _who(self, told: Sequel) -> tuple[list[Entity], list[Entity]]:
        """`it has to brake within 5 s of the van's departure`: it, not the van."""
        parties = Parties(self._story.scene, self._story.resolver, told.nouns)
        named = parties.actors()
        begins = told.nouns[0] if told.nouns else None
        if begins is None or told.first is None or told.then is None:
            return named, []
        acts = begins.kind is NounKind.PRONOUN and begins.key in ('it', 'person')
        one = parties.it(avoid=named) if acts else None
        return ([one], named) if one is not None else (named, [])

    def _plain(
        self, piece: Piece, *, following: Piece | None = None, ahead: Piece | None = None
    ) -> None:
        if needs_nothing(piece.atoms):
            self._story.scene.clauses.append(
                ClauseDraft(
                    span=Span(start=piece.start, end=piece.end),
                    sentence=piece.sentence,
                    status=ClauseStatus.NO_REQUIREMENT,
                )
            )
            return
        frame = self._story.open(piece)
        if following is not None:
            named_later(self._story, frame, following)
            acts_later(self._story, frame, following)
        if piece.link in (Link.UNLESS, Link.BEFORE, Link.UNTIL, Link.WHEN):
            # alone such a clause has no effect that it could govern
            if piece.link is Link.BEFORE:
                before_told(frame, self._story.before)
            self._story.close(frame)
            return
        main = piece.link is not Link.RELATIVE
        if main and self._story.held is not None and self._story.held.sentence == piece.sentence:
            effect_of_held(self._story, frame)
        elif main and self._story.unknown_cause == piece.sentence:
            self._story.unknown_cause = -1
            without_cause(self._story, frame)
        elif tells_before(frame) or (
            not told_to(self._story, frame)
            and not so_much_later(self._story, frame)
            and not follows_event(self._story, frame)
        ):
            before, flown = len(self._story.scene.events), len(self._story.scene.missions)
            told = who_was_told(frame)
            if told and len(self._story.scene.events) > before and _acts_on(ahead):
                self._story.last = (self._story.scene.events[-1], piece.sentence)
            if not told and not after_told(frame, self._story.before):
                main_clause(frame)
            note_fronted_time(self._story, frame, before)
            in_sequence(frame, before)
            after_others(frame, flown, self._story.before)
            changes_mission(frame, flown, before)
            starts_late(self._story, flown)
            earlier_phase(frame, flown)
            soon(frame, before)
            after_sight(self._story.scene, before, self._story.seen)
            self._story.seen = sight(frame)
        self._story.close(frame)
