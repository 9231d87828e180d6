# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Reads the clauses of a prompt in order and pairs causes with their effects."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing import values
from aurora_core.parsing.atoms import ACTORS, AtomKind, NounKind, NounPhrase, needs_nothing
from aurora_core.parsing.constructions import actions, messages
from aurora_core.parsing.constructions.demands import demands
from aurora_core.parsing.constructions.distances import DistanceCause
from aurora_core.parsing.constructions.flight_details import flight_details
from aurora_core.parsing.constructions.noun_places import noun_places
from aurora_core.parsing.constructions.states import adjectives
from aurora_core.parsing.constructions.triggers import ELAPSED, Cause, cause
from aurora_core.parsing.constructions.world import world_words
from aurora_core.parsing.criteria.criterion import Criterion
from aurora_core.parsing.criteria.meaning import Meaning
from aurora_core.parsing.criteria.moments import Sequel
from aurora_core.parsing.criteria.parties import Parties
from aurora_core.parsing.criteria.sequels import Sequels
from aurora_core.parsing.events import complete_event, same_cause, settled
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.main_clause import main_clause, shared_words
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pieces import Link, Piece
from aurora_core.parsing.resolver import Resolver
from aurora_core.parsing.scene import ClauseDraft, EventDraft, Scene, UntilDraft
from aurora_core.parsing.segments import clauses
from aurora_core.parsing.sequence import (
    HAPPENS,
    after_sight,
    after_told,
    before_told,
    ends_of_own,
    got_message,
    in_sequence,
    is_arrival,
    is_earlier,
    is_ellipsis,
    is_phase,
    later,
    leads_to,
    sight,
    soon,
    who_was_told,
    without_link,
)
from aurora_core.spec.parameter import Parameter, Span
from aurora_core.spec.scenario import (
    AgentAction,
    EventAction,
    EventDoneTrigger,
    MessageTrigger,
    SendMessage,
    TimeTrigger,
    UavAction,
    VisibilityTrigger,
)
from aurora_core.spec.vocabulary import ClauseStatus

# Links of clauses that go on with the story; the others only describe or condition.
_TELLING = (Link.MAIN, Link.INFINITIVE, Link.PARTICIPLE, Link.WHILE)
_CAUSES = (Link.WHEN, Link.AFTER, Link.UNTIL)


_UNTIL_THEN = re.compile(
    r'(?:and |but )?(?:(?:up )?until then|till then|before that|before then)\b'
)


_WAS_DOING = re.compile(r'\b(?:was|were|had been|has been|have been)\s+\w+ing\b')


def _waits_for(frame: Frame) -> bool:
    return frame.key in HAPPENS


def _on_ground(nouns: Sequence[NounPhrase]) -> bool:
    return bool(nouns) and nouns[0].kind in (NounKind.AGENT, NounKind.VEHICLE, NounKind.EGO)


def _is_earlier_state(frame: Frame) -> bool:
    """`…, until then it follows the bus`: what holds before the event is no effect of it."""
    told = frame.scene.prompt[frame.piece.start : frame.piece.end].lower()
    return _UNTIL_THEN.match(told) is not None or _WAS_DOING.search(told) is not None


class Reader:
    """Turns pieces into drafts in a scene."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self.resolver = Resolver(scene)
        self._held: tuple[Cause, ClauseDraft, int, Parameter | None] | None = (
            None  # a cause that waits for its effect
        )
        self._unknown_cause = -1  # sentence whose leading cause was not understood
        self._seen: VisibilityTrigger | None = None  # by the clause in front, when it tells so
        self._before: Piece | None = None  # the clause in front
        self._last: tuple[EventDraft, int] | None = None  # last event that a leading cause started

    def read(self, pieces: Sequence[Piece]) -> None:
        """Read all clauses."""
        self._read(ends_of_own(pieces))
        self._drop_held(-1)

    def _read(self, pieces: Sequence[Piece]) -> None:
        i = 0
        while i < len(pieces):
            piece = pieces[i]
            self._drop_held(piece.sentence)
            nxt = pieces[i + 1] if i + 1 < len(pieces) else None
            same = nxt is not None and nxt.sentence == piece.sentence
            if piece.criterion is not None:
                self._criterion(piece, piece.criterion)
            elif piece.link is Link.UNTIL and piece.opens and same and nxt is not None:
                self._effect_then_cause(nxt, piece)  # `until it stops, the drone tracks it`
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
                self._plain(replace(nxt, then=True))
                i += 1
            elif piece.link in _CAUSES and piece.opens and same and nxt is not None:
                self._leading(piece, nxt)
            elif (
                nxt is not None
                and same
                and (nxt.then or (got_message(piece) and nxt.link is Link.MAIN))
                and (is_arrival(piece) or leads_to(piece) or got_message(piece))
            ):
                self._leading(piece, nxt)  # `the bus arrives at the station, then …`
            elif same and nxt is not None and is_earlier(nxt) and piece.link is Link.MAIN:
                self._leading(replace(nxt, opens=True), piece)
                self._plain(replace(piece, then=True))
                i += 1
            elif (
                piece.link in (Link.MAIN, Link.INFINITIVE, Link.PARTICIPLE)
                and same
                and nxt is not None
                and nxt.link in _CAUSES
                and not nxt.opens
            ):
                self._effect_then_cause(piece, nxt)
                i += 1
            elif piece.link is Link.WHILE and piece.opens and same:
                self._plain(piece, following=nxt)
            else:
                self._plain(piece)
            self._before = piece
            i += 1

    def _criterion(self, piece: Piece, told: Criterion | Sequel) -> None:
        """A success condition; read as any other clause when it is not known of whom it is."""
        waits = self._held is not None or self._unknown_cause == piece.sentence
        if not waits:
            frame = self._open(piece)
            if self._states(told, frame.span):
                self._scene.understood.append(frame.span)
                adjectives(frame)
                return
            self._scene.clauses.pop()
        self._read(clauses(piece.atoms, piece.sentence))

    def _states(self, told: Criterion | Sequel, span: Span) -> bool:
        if isinstance(told, Sequel):
            who = Parties(self._scene, self.resolver, told.nouns).actors()
            return Sequels(self._scene, span, who).state(told)
        return Meaning(told, self._scene, self.resolver, span).state()

    def _drop_held(self, sentence: int) -> None:
        """A cause whose effect never came was not understood."""
        if self._held is not None and self._held[2] != sentence:
            self._held[1].status = ClauseStatus.NOT_ENCODED
            self._held[1].notes.append('no effect follows')
            self._held = None

    # --- clause bookkeeping -------------------------------------------------------------------

    def _open(self, piece: Piece) -> Frame:
        frame = Frame(piece, self._scene, self.resolver)
        self._scene.clauses.append(
            ClauseDraft(
                span=frame.span,
                sentence=piece.sentence,
                describes=piece.link not in _TELLING,
            )
        )
        return frame

    def _close(self, frame: Frame) -> None:
        adjectives(frame)
        noun_places(frame)
        clause = self._scene.clause
        if clause.status is not ClauseStatus.ENCODED:
            return
        for span in frame.leftovers():
            self._scene.clauses.append(
                ClauseDraft(
                    span=span,
                    sentence=frame.piece.sentence,
                    subjects=clause.subjects,
                    objects=clause.objects,
                    places=clause.places,
                    notes=['this part of the clause was not understood'],
                )
            )

    # --- kinds of clauses ---------------------------------------------------------------------

    def _plain(self, piece: Piece, *, following: Piece | None = None) -> None:
        if needs_nothing(piece.atoms):
            self._scene.clauses.append(
                ClauseDraft(
                    span=Span(start=piece.start, end=piece.end),
                    sentence=piece.sentence,
                    status=ClauseStatus.NO_REQUIREMENT,
                )
            )
            return
        frame = self._open(piece)
        if following is not None:
            self._named_later(frame, following)
            self._acts_later(frame, following)
        if piece.link in (Link.UNLESS, Link.BEFORE, Link.UNTIL, Link.WHEN):
            # alone such a clause has no effect that it could govern
            if piece.link is Link.BEFORE:
                before_told(frame, self._before)
            self._close(frame)
            return
        main = piece.link is not Link.RELATIVE
        if main and self._held is not None and self._held[2] == piece.sentence:
            self._effect_of_held(frame)
        elif main and self._unknown_cause == piece.sentence:
            self._unknown_cause = -1
            self._without_cause(frame)
        elif (
            not self._told_to(frame) and not self._later(frame) and not self._follows_event(frame)
        ):
            before = len(self._scene.events)
            told = who_was_told(frame) or after_told(frame, self._before)
            if not told:
                main_clause(frame)
            self._note_fronted_time(frame, before)
            in_sequence(frame, before)
            soon(frame, before)
            after_sight(self._scene, before, self._seen)
            self._seen = sight(frame)
        self._close(frame)

    def _leading(self, piece: Piece, following: Piece) -> None:
        """`When the van comes within 20 m, …`: the effect comes next."""
        frame = self._open(piece)
        gerund = (
            frame.verb is not None and frame.verb.form is VerbForm.ING and not frame.subject_nouns
        )
        if frame.key == 'finish' and not frame.subject_nouns:
            actors = Frame(following, self._scene, self.resolver).subject_nouns
            frame.subject_nouns = () if _on_ground(actors) else actors
            gerund = False
        if gerund and piece.link is not Link.UNTIL:
            actors = Frame(following, self._scene, self.resolver).subject_nouns
            if _waits_for(frame) or piece.link is Link.WHEN or _on_ground(actors):
                frame.subject_nouns = actors
                gerund = False
        if gerund or piece.link is Link.UNTIL:
            upcoming = Frame(following, self._scene, self.resolver)
            if not frame.subject_nouns and upcoming.subject_nouns:
                frame.subject_nouns = upcoming.subject_nouns
            if piece.link is Link.AFTER:
                main_clause(frame)
            self._close(frame)
            return
        if frame.has_mark(AtomKind.MESSAGE.value) and not frame.subject_nouns:
            # `once the message has arrived, the ego slows`: with whom, is said behind
            frame.subject_nouns = Frame(following, self._scene, self.resolver).subject_nouns
        self._named_later(frame, following)
        delay = self._delay(frame)
        found = cause(frame) or self._again(frame)
        if found is not None:
            world_words(frame)
            self._scene.clause.status = ClauseStatus.ENCODED
            self._held = (found, self._scene.clause, piece.sentence, delay)
        elif (
            piece.link is Link.AFTER
            or frame.has_mark(AtomKind.LINK.value)
            or (
                frame.verb is not None
                and frame.verb.form is VerbForm.ING
                and self._is_flown(frame)
            )
        ):
            main_clause(frame)  # `if the link loses 20 % of the messages`: no event, a value
        else:
            self._unknown_cause = piece.sentence
        self._close(frame)

    @staticmethod
    def _is_flown(frame: Frame) -> bool:
        """`when tracking the bus, the drone …`: a phase that goes on."""
        return frame.key in ('hover', 'track', 'follow', 'orbit', 'navigate', 'observe', 'fly')

    def _again(self, frame: Frame) -> Cause | None:
        """`…, and when it does, …`: the cause is what the clause in front tells."""
        if not is_ellipsis(frame.piece):
            return None
        named = any(n.kind is not NounKind.PRONOUN for n in frame.subject_nouns)
        who = frame.subjects() if named else ()
        for event in reversed(self._scene.events):  # `after the truck does`
            if who and isinstance(event.action, AgentAction) and event.action.agent == who[0].id:
                return EventDoneTrigger(on='event_done', event=event.id)
        if self._before is None:
            return None
        told = Frame(without_link(self._before, frame.piece.link), self._scene, self.resolver)
        if not told.subject_nouns:
            told.subject_nouns = frame.subject_nouns
        return cause(told)

    def _named_later(self, frame: Frame, following: Piece) -> None:
        """`When it sees a bus, the drone …`: a pronoun in front of its noun."""
        if any(n.kind is not NounKind.PRONOUN for n in frame.subject_nouns):
            return
        if not frame.subject_nouns or any(c.subjects or c.objects for c in self._scene.clauses):
            return
        upcoming = Frame(following, self._scene, self.resolver).subject_nouns
        if upcoming and all(n.kind in ACTORS and n.kind is not NounKind.PRONOUN for n in upcoming):
            frame.subject_nouns = upcoming

    def _acts_later(self, frame: Frame, following: Piece) -> None:
        """`While following a van, the drone …`: who follows is named behind."""
        gerund = frame.verb is not None and frame.verb.form is VerbForm.ING
        if gerund and not frame.subject_nouns and frame.piece.head is None:
            upcoming = Frame(following, self._scene, self.resolver).subject_nouns
            if upcoming and all(n.kind in ACTORS for n in upcoming):
                frame.subject_nouns = upcoming

    def _effect_of_held(self, frame: Frame) -> None:
        assert self._held is not None
        found, clause, sentence, delay = self._held
        self._held = None
        shared_words(frame)
        flying = self._scene.uavs
        frame.watched = not isinstance(found, MessageTrigger)
        if messages.is_command(frame) and len(flying) == 1:
            frame.heir = flying[0]  # `if the van exceeds 15 m/s, notify the police`
        action = actions.action(frame)
        for one in actions.together(frame) if action is None else ():
            event = complete_event(self._scene, found, one, frame.span, (clause,))
            if event is not None:
                event.delay = delay
                self._last = (event, sentence)
            if one.do in ('brake', 'land', 'ascend') or event is not None:
                action = one
        if action is not None and self._last is not None and self._last[0].action == action:
            messages.link_values(frame)
            demands(frame)
            return
        if action is None:
            clause.status = ClauseStatus.NOT_ENCODED
            clause.notes.append('what should happen then was not understood')
            main_clause(frame)
            return
        event = complete_event(self._scene, found, action, frame.span, (clause,))
        if event is not None:
            event.delay = delay
            self._last = (event, sentence)
        messages.link_values(frame)
        demands(frame)

    def _without_cause(self, frame: Frame) -> None:
        """The effect of a cause that was not understood must not hold without it."""
        shared_words(frame)
        action = actions.action(frame)
        if action is None:
            self._scene.clause.notes.append('its cause was not understood')
            self._scene.clause.status = ClauseStatus.NOT_ENCODED
            frame.subjects()
            return
        event = EventDraft(id=self._scene.new_id('e'), action=action, span=frame.span)
        self._scene.events.append(event)
        self._scene.became(event.id)

    def _note_fronted_time(self, frame: Frame, before: int) -> None:
        """`After 15 s the bus stops and …`: the time holds for what follows, too."""
        made = self._scene.events[before:]
        if not made or not isinstance(made[-1].trigger, TimeTrigger) or frame.verb is None:
            return
        stated = made[-1].trigger.at_s.span
        if stated is not None and stated.end <= frame.verb.start:
            self._last = (made[-1], frame.piece.sentence)

    def _later(self, frame: Frame) -> bool:
        """`…, and 5 s later it starts again`: also where the sentence has a cause."""
        if not later(frame):
            return False
        self._last = None
        return True

    def _told_to(self, frame: Frame) -> bool:
        """`the RSU tells the truck to stop`: the receiver acts when the message arrives."""
        if frame.piece.link is not Link.INFINITIVE or frame.subject_nouns:
            return False
        ids = self._scene.clauses[-2].ids if len(self._scene.clauses) > 1 else {}
        told = [e for e in self._scene.events if e.id in ids]
        if not told or not isinstance(told[-1].action, SendMessage):
            return False
        message = told[-1].action
        receiver = self._scene.by_id(message.receiver)
        if receiver is None:
            return False
        frame.heir = receiver
        action = actions.action(frame)
        if action is None:
            return False
        heard = MessageTrigger(on='message_received', by=message.receiver, sender=message.sender)
        complete_event(self._scene, heard, action, frame.span, ())
        return True

    def _cause_of_message(self, frame: Frame, because: Piece) -> None:
        """`tells the truck to stop when it sees a bus`: the cause is that of the message."""
        self._close(frame)
        told = self._scene.events[-2]
        second = self._open(because)
        if isinstance(told.action, SendMessage) and not second.subject_nouns:
            second.heir = self._scene.by_id(told.action.sender)
        found = cause(second)
        if found is not None and told.trigger is None and told.action is not None:
            told.trigger = settled(self._scene, found, told.action)
            self._scene.clause.ids[told.id] = None
            self._scene.clause.status = ClauseStatus.ENCODED
        self._close(second)

    def _follows_event(self, frame: Frame) -> bool:
        """`When …, the drone alerts the ego and the ego brakes`: a second effect of one cause."""
        if self._last is None or self._last[1] != frame.piece.sentence:
            return False
        if _is_earlier_state(frame):
            return False
        if frame.piece.link is not Link.MAIN and not self._told_head(frame):
            return False
        shared_words(frame)
        action = actions.action(frame)
        if action is None:
            return False
        event = self._when_told(frame, action) or same_cause(
            self._scene, self._last[0], action, frame.span, then=frame.piece.then
        )
        self._last = (event, frame.piece.sentence)
        messages.link_values(frame)
        demands(frame)
        return True

    def _told_head(self, frame: Frame) -> bool:
        """`…, it messages the van, which then stops`: whoever is told is the head."""
        before = self._last[0].action if self._last is not None else None
        head = frame.piece.head
        if frame.piece.link is not Link.RELATIVE or head is None or head.noun is None:
            return False
        known = [e.id for e in self.resolver.known(head.noun)]
        return isinstance(before, SendMessage) and known == [before.receiver]

    def _when_told(self, frame: Frame, action: EventAction) -> EventDraft | None:
        """`…, the drone warns the car and the car brakes`: once it has the message."""
        before = self._last[0].action if self._last is not None else None
        who = action.agent if isinstance(action, AgentAction) else None
        if not isinstance(before, SendMessage) or before.receiver != who:
            return None
        heard = MessageTrigger(on='message_received', by=before.receiver, sender=before.sender)
        return complete_event(self._scene, heard, action, frame.span, ())

    def _effect_then_cause(self, piece: Piece, because: Piece) -> None:
        """`… alerts the ego when the van comes within 20 m`."""
        frame = self._open(piece)
        effect_clause = self._scene.clause
        shared_words(frame)
        if because.link is Link.UNTIL:
            self._until(frame, because)
            return
        if self._told_to(frame):
            self._cause_of_message(frame, because)
            return
        action = actions.action(frame)
        if action is None:
            main_clause(frame)
        messages.link_values(frame)
        demands(frame)
        self._close(frame)
        second = self._open(because)
        if isinstance(action, SendMessage):
            receiver = self._scene.by_id(action.receiver)
            second.avoid = (receiver,) if receiver is not None else ()
        if action is None and because.link is Link.AFTER and second.verb is not None:
            self._close(second)
            return
        delay = self._delay(second)
        found = (cause(second) or self._again(second)) if action is not None else None
        found = self._about_the_told(second, found, action)
        if found is None or action is None:
            if action is not None:
                effect_clause.notes.append('its cause was not understood')
                self._scene.events.append(
                    EventDraft(id=self._scene.new_id('e'), action=action, span=frame.span)
                )
                effect_clause.ids[self._scene.events[-1].id] = None
            self._close(second)
            return
        self._scene.clause.status = ClauseStatus.ENCODED
        clause = self._scene.clause
        event = complete_event(self._scene, found, action, frame.span, (effect_clause, clause))
        if event is not None:
            event.delay = delay
            self._shared_cause(event, effect_clause)
            flight_details(second)  # `follows it when it starts, for 1 min`
        messages.link_values(second)
        self._close(second)

    def _about_the_told(
        self, frame: Frame, found: Cause | None, action: EventAction | None
    ) -> Cause | None:
        """`alerts it when it is closer than 60 m to a bus`: no UAV drives up to a bus."""
        if not isinstance(found, DistanceCause) or not isinstance(action, SendMessage):
            return found
        told = self._scene.by_id(action.receiver)
        pronoun = all(n.kind is NounKind.PRONOUN for n in frame.subject_nouns)
        if told is None or told.is_uav or not found.a.is_uav or not pronoun:
            return found
        return found if found.b in (None, told.id) else replace(found, a=told)

    @staticmethod
    def _delay(frame: Frame) -> Parameter | None:
        """Take `5 s` of `5 s after the bus stops`."""
        adjunct = frame.time('')
        if (
            adjunct is None
            or adjunct.measure is None
            or adjunct.start != frame.piece.atoms[0].start
        ):
            return None
        if frame.verb is None or not values.accepts('delay', adjunct.measure):
            return None
        if frame.key in ELAPSED and not frame.subject_nouns:
            return None  # `when 10 s have passed`
        adjunct.used = True
        return values.explicit('delay', adjunct.measure)

    def _shared_cause(self, event: EventDraft, clause: ClauseDraft) -> None:
        """`alerts the ego and the ego slows when …`: the cause is that of both effects."""
        events = self._scene.events
        number = self._scene.clauses.index(clause)
        if len(events) < 2 or number < 1:
            return
        before = events[-2]
        earlier = self._scene.clauses[number - 1]
        same = earlier.sentence == clause.sentence and before.id in earlier.ids
        if same and before.trigger is None and before.action is not None:
            before.trigger = event.trigger
            clause.ids[before.id] = None

    def _until(self, frame: Frame, because: Piece) -> None:
        """`tracks the bus until it stops`: the phase ends with the event."""
        scene = self._scene
        before = len(scene.missions)
        main_clause(frame)
        self._close(frame)
        second = self._open(because)
        made = scene.missions[before:]
        agents = [e for e in scene.clauses[-2].subjects if not e.is_uav]
        found = cause(second) if made or len(agents) == 1 else None
        if found is not None and made:
            for mission in made:
                action = UavAction(do='land', uav=mission.uav.id)
                event = complete_event(scene, found, action, frame.span, ())
                if event is not None:
                    scene.untils.append(UntilDraft(mission=mission, event=event))
        elif found is not None:
            stop = AgentAction(do='stop', agent=agents[0].id)
            complete_event(scene, found, stop, frame.span, ())
        self._close(second)
