# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who does what to whom: a second, shallow reading of each sentence, held against the elements.

`a truck followed by a bus stops`: whoever the nouns, the voice and the place of a verb make its
subject or its object has that part in what the sentence became. The second reading knows nothing
of how the first came about. Where it is not sure of a subject it says nothing.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.doubts.bodies import bodies_called, called
from aurora_core.parsing.doubts.clauses import BREAKS, TOLD, clause_of
from aurora_core.parsing.morphology import VerbForm
from aurora_core.spec.parameter import Span
from aurora_core.spec.scenario import (
    AgentAction,
    AltitudeTrigger,
    ArrivalTrigger,
    DistanceTrigger,
    ScenarioSpec,
    SendMessage,
    SpeedTrigger,
    UavAction,
    VisibilityTrigger,
)
from aurora_core.spec.vocabulary import BehaviorKind, MissionMode, Pattern

# Verbs whose object is whoever follows them, and in the passive their subject.
_TRANSITIVE = frozenset(
    {'alert', *('approach', 'follow', 'observe', 'overtake', 'see', 'tailgate', 'track', 'yield')}
)
# What a flight can be told by, beside its own name.
_FLIGHTS = {
    MissionMode.TRACK: ('track', 'follow', 'observe'),
    MissionMode.HOVER: ('hover', 'observe'),
    MissionMode.NAVIGATE: ('fly', 'navigate'),
}
_GROUND = {
    BehaviorKind.FOLLOW: ('follow', 'track'),
    BehaviorKind.TAILGATE: ('tailgate', 'follow', 'track'),
}
_SPEEDS = ('accelerate', 'brake', 'exceed', 'slow', 'start', 'stop')
_PLACED = frozenset({'ahead', 'behind', 'left', 'right'})
# What stands before a verb whose subject is not told anew.
_NO_SUBJECT = frozenset({AtomKind.CONJUNCTION, AtomKind.THEN, AtomKind.MESSAGE})
# What an aside begins with, or the noun that it is about.
_ASIDE = frozenset({AtomKind.COMMA, AtomKind.RELATIVE, AtomKind.PREPOSITION, AtomKind.RELATION})
_CONSUMES = frozenset({AtomKind.PREPOSITION, AtomKind.RELATION})
_SILENT = frozenset({AtomKind.FILL, AtomKind.FRAME})


@dataclass(frozen=True, slots=True, kw_only=True)
class Deed:
    """What one verb says: the nouns of its subject and its object, where they are told."""

    verb: Atom
    doer: Atom | None = None
    done_to: Atom | None = None


def misplaced(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """Yield the verbs whose subject or object has another part in what they became."""
    facts = _facts(spec)
    bodies = bodies_called(spec)

    def meant(noun: Atom | None) -> set[str]:
        name = called(noun, spec.prompt)
        return {who for who, names in bodies.items() if name in names} if name else set()

    for sentence in _clauses(atoms):
        for deed in deeds(sentence):
            told = facts.get(deed.verb.key, ()) if deed.verb.key != 'land' else ()
            clause = clause_of(spec, deed.verb)
            if not told or clause is None:
                continue
            doers, objects = meant(deed.doer), meant(deed.done_to)
            by_them = [target for who, target in told if not doers or who in doers]
            lost = doers and not by_them
            if objects and deed.verb.key in _TRANSITIVE:
                lost = lost or not objects & set(by_them)
            if lost:
                yield clause.span


def misanchored(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`a bus with a car behind and a truck in front`: both are placed from the bus."""
    bodies = bodies_called(spec)
    for sentence in _clauses(atoms):
        for k, opening in enumerate(sentence):
            if opening.words not in ('with', 'has', 'have') or not k:
                continue
            head = sentence[k - 1]
            for placed, relation in _beside(sentence[k + 1 :]):
                names = called(head, spec.prompt), called(placed, spec.prompt)
                around = {who for who, own in bodies.items() if names[0] in own}
                of = {
                    p.of
                    for a in spec.agents
                    if names[1] in bodies[a.id]
                    for p in a.placements
                    if p.relation.value == relation.key
                }
                if around and of and not of & around and clause_of(spec, placed) is not None:
                    yield Span(start=placed.start, end=relation.end)


def _beside(atoms: Sequence[Atom]) -> Iterator[tuple[Atom, Atom]]:
    """Yield who stands on which side in `a car behind, and a truck in front of it`."""
    told = [a for a in atoms if a.kind not in (*_SILENT, AtomKind.MEASURE)]
    for k, atom in enumerate(told):
        if atom.kind in (AtomKind.VERB, AtomKind.AUXILIARY, AtomKind.SUBORDINATOR):
            return
        if atom.kind is not AtomKind.RELATION or atom.key not in _PLACED or not k:
            continue
        behind = told[k + 1] if k + 1 < len(told) else None
        own = behind is None or behind.noun is None or behind.noun.kind is NounKind.PRONOUN
        if own and told[k - 1].is_actor:
            yield told[k - 1], atom


# --- the second reading --------------------------------------------------------------------------


def deeds(sentence: Sequence[Atom]) -> Iterator[Deed]:
    """Yield what the verbs of a sentence say, in their order."""
    told = [a for a in sentence if a.kind not in _SILENT]
    walk = _Walk(told)
    for k in range(len(told)):
        deed = walk.step(k)
        if deed is not None:
            yield deed


class _Walk:
    """The nouns that still may become a subject, as one goes along a sentence."""

    def __init__(self, told: Sequence[Atom]) -> None:
        self._told = told
        self._free: list[Atom] = []
        self._filler: Atom | None = None

    def step(self, k: int) -> Deed | None:
        """Take the next word; return what it says when it is a verb."""
        atom = self._told[k]
        if atom.kind is AtomKind.VERB:
            return self._verb(k)
        if atom.kind is AtomKind.SUBORDINATOR:
            self._free = []
        elif atom.kind is AtomKind.CONJUNCTION:
            if self._opens(k + 1):
                self._free = []
        elif atom.is_actor and not self._joined(k):
            self._noun(k)
        return None

    def _noun(self, k: int) -> None:
        before = self._at(k - 1)
        if before is None or before.kind not in _CONSUMES:
            if before is not None and before.kind is AtomKind.RELATIVE:
                self._filler = self._near(k)
            elif before is not None and before.is_actor:
                self._filler = before
            if before is None or before.kind is not AtomKind.VERB:
                self._free.append(self._told[k])

    def _verb(self, k: int) -> Deed | None:
        """Return what a verb says; its subject is found even where that is not told further."""
        verb, before, behind = self._told[k], self._at(k - 1), self._at(k + 1)
        helped = before is not None and before.kind is AtomKind.AUXILIARY
        if self._passive(k):
            aside = not helped or self._relative(k)
            by = self._at(k + 2) if behind is not None and behind.words == 'by' else None
            done_to = self._near(k) if aside else self._take(k)
            return Deed(verb=verb, doer=by, done_to=done_to)
        past = verb.form is VerbForm.PAST and not helped
        reduced = not helped and (verb.form is VerbForm.ING or (past and self._finite_behind(k)))
        if (reduced or past) and before is not None and before.kind is AtomKind.COMMA:
            return None
        doer = self._near(k) if reduced or self._relative(k) else self._take(k)
        done_to, self._filler = behind if self._is_object(k + 1) else self._filler, None
        kind = behind.kind if behind is not None else None
        if kind is AtomKind.AUXILIARY and verb.form is VerbForm.BASE:
            return None  # `the lane change has to be`
        if kind is AtomKind.RELATION:
            return None  # `follows behind the ego`
        if doer is None:
            done_to = None  # `behind the ego follows | a van`
        return Deed(verb=verb, doer=doer, done_to=done_to)

    def _take(self, k: int) -> Atom | None:
        """Return the subject of a finite verb: the last noun that still waits for one."""
        before = self._at(k - 1)
        if not self._free or before is None or before.kind in _NO_SUBJECT:
            return None
        subject = self._free.pop()
        at = next(j for j in range(k - 1, -1, -1) if self._told[j] is subject)
        behind = self._at(at + 1)
        if before.kind is AtomKind.COMMA and behind is not None and behind.kind not in _ASIDE:
            return None
        return subject

    def _near(self, k: int) -> Atom | None:
        """Return the noun right before a participle or a relative clause."""
        j = k - 1
        while j >= 0 and self._told[j].kind in (
            AtomKind.AUXILIARY,
            AtomKind.RELATIVE,
            AtomKind.COMMA,
        ):
            j -= 1
        atom = self._at(j)
        return atom if atom is not None and atom.is_actor else None

    def _relative(self, k: int) -> bool:
        j = k - 1
        while j >= 0 and self._told[j].kind is AtomKind.AUXILIARY:
            j -= 1
        return j >= 0 and self._told[j].kind is AtomKind.RELATIVE

    def _passive(self, k: int) -> bool:
        verb, before, behind = self._told[k], self._at(k - 1), self._at(k + 1)
        if verb.form is not VerbForm.PAST or self._have(k):
            return False
        been = before is not None and before.kind is AtomKind.AUXILIARY
        return been or (behind is not None and behind.words == 'by')

    def _have(self, k: int) -> bool:
        before = self._at(k - 1)
        return before is not None and before.kind is AtomKind.AUXILIARY and before.key == 'have'

    def _finite_behind(self, k: int) -> bool:
        """Whether a finite verb follows before anybody else could be its subject."""
        for atom in self._told[k + 1 :]:
            if atom.kind in BREAKS and atom.kind is not AtomKind.COMMA:
                return False
            if atom.kind is AtomKind.AUXILIARY or (
                atom.kind is AtomKind.VERB and atom.form is VerbForm.THIRD
            ):
                return True
        return False

    def _opens(self, k: int) -> bool:
        """Whether a clause with its own subject begins: `and | the ego stops`."""
        noun = self._at(k)
        return noun is not None and noun.is_actor and self._acts(k)

    def _joined(self, k: int) -> bool:
        """`a bus in front and | a van behind`: what follows `and` and does nothing."""
        before = self._at(k - 1)
        joined = before is not None and before.kind is AtomKind.CONJUNCTION
        return joined and not self._opens(k)

    def _is_object(self, k: int) -> bool:
        """Whether a noun at a place is done something to, and does nothing itself."""
        noun = self._at(k)
        return noun is not None and noun.is_actor and not self._acts(k)

    def _acts(self, k: int) -> bool:
        behind = self._at(k + 1)
        if behind is None or behind.form is VerbForm.ING or self._passive(k + 1):
            return False
        return behind.kind in (AtomKind.VERB, AtomKind.AUXILIARY)

    def _at(self, k: int) -> Atom | None:
        return self._told[k] if 0 <= k < len(self._told) else None


def _clauses(atoms: Sequence[Atom]) -> Iterator[list[Atom]]:
    """Yield the atoms between full stops and semicolons."""
    part: list[Atom] = []
    for atom in atoms:
        if atom.kind is AtomKind.STOP:
            yield part
            part = []
        else:
            part.append(atom)
    yield part


# --- the elements --------------------------------------------------------------------------------


def _facts(spec: ScenarioSpec) -> dict[str, list[tuple[str, str | None]]]:
    """Return who does what, and to whom, by the verb that says so."""
    facts: dict[str, list[tuple[str, str | None]]] = defaultdict(list)
    for agent in spec.agents:
        for b in agent.behaviors:
            for key in _GROUND.get(b.kind, (b.kind.value,)):
                facts[key].append((agent.id, b.target))
    for mission in spec.missions:
        keys = _FLIGHTS[mission.mode]
        for key in (*keys, 'orbit') if mission.pattern is Pattern.ORBIT else keys:
            facts[key].append((mission.uav, mission.target))
    for event in spec.events:
        action, trigger = event.action, event.trigger
        if isinstance(action, AgentAction):
            facts[action.do].append((action.agent, None))
        elif isinstance(action, UavAction):
            facts[action.do].append((action.uav, None))
        elif isinstance(action, SendMessage):
            for key in TOLD:
                facts[key].append((action.sender, action.receiver))
        if isinstance(trigger, VisibilityTrigger):
            for key in ('see', 'observe'):
                facts[key].append((trigger.observer, trigger.target))
        elif isinstance(trigger, ArrivalTrigger):
            facts['reach'].append((trigger.who, None))
        elif isinstance(trigger, AltitudeTrigger):
            facts['reach'].append((trigger.uav, None))
        elif isinstance(trigger, DistanceTrigger):
            facts['approach'] += [(trigger.a, trigger.b), (trigger.b, trigger.a)]
        elif isinstance(trigger, SpeedTrigger):
            for key in _SPEEDS:
                facts[key].append((trigger.who, None))
    return facts
