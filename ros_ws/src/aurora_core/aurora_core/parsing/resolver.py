# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who or what a noun phrase means: new actors, mentions of known ones, pronouns, places."""

from __future__ import annotations

import re
from collections.abc import Sequence

from aurora_core.outcomes.parse import Refusal, RefusalKind
from aurora_core.parsing.atoms import Determiner, NounKind, NounPhrase
from aurora_core.parsing.landmarks import landmark_words
from aurora_core.parsing.lexicon import Lexicon, shipped_lexicon
from aurora_core.parsing.pronouns import Fits, PronounResolver, anything
from aurora_core.parsing.scene import Entity, Scene
from aurora_core.spec.parameter import Span
from aurora_core.spec.scenario import Placement
from aurora_core.spec.vocabulary import AgentType, Relation, Role

_FRONT = frozenset({'front', 'leading', 'lead', 'preceding'})
_REAR = frozenset({'rear', 'trailing', 'back', 'following'})
# Labels that tell which of two is meant by where it is.
SIDES = _FRONT | _REAR


def front_or_rear(noun: NounPhrase, known: Sequence[Entity]) -> Entity | None:
    """Return which of two `the front car` is; the first of a pair drives ahead of the second."""
    if len(known) != 2 or any(e.is_uav for e in known) or not noun.labels & SIDES:
        return None
    front, rear = known
    if front.group is None:
        return None
    if not front.placements:
        front.placements.append(Placement(relation=Relation.AHEAD, of=rear.id))
    return front if noun.labels & _FRONT else rear


_MEMBER = re.compile(r'\s+of\b')
_VEHICLES = frozenset(set(AgentType) - {AgentType.PEDESTRIAN, AgentType.RSU})
MOST_AGENTS = 200


def _last_words(name: str) -> tuple[str, ...]:
    words = landmark_words(name)
    return tuple(' '.join(words[i:]) for i in range(len(words)))


def _role(noun: NounPhrase) -> Role:
    if noun.background:
        return Role.BACKGROUND
    return Role.TARGET if noun.target else Role.OTHER


class Resolver:
    """Turns noun phrases into actors of the scene, adding those that are new."""

    def __init__(self, scene: Scene, lexicon: Lexicon | None = None) -> None:
        self._scene = scene
        self._lexicon = lexicon if lexicon is not None else shipped_lexicon()
        self._pronouns = PronounResolver(scene)
        self._denied: set[tuple[int, int]] = set()
        self._none_of: set[str] = set()
        self._read: dict[tuple[int, int], tuple[Entity, ...]] = {}

    def known(self, noun: NounPhrase) -> tuple[Entity, ...]:
        """Return the actors that a phrase was resolved to, none when it was not."""
        return self._read.get((noun.start, noun.end), ())

    def deny(self, noun: NounPhrase, *, strictly: bool) -> None:
        """Note that there is nobody of this kind; whoever is asked for all the same is missing."""
        self._denied.add((noun.start, noun.end))
        if not strictly:
            return
        self._none_of.add(noun.key)
        if any(e.type.value == noun.key and not e.is_uav for e in self._scene.entities):
            self._refuse_absent(noun)

    def denied(self, noun: NounPhrase) -> bool:
        """Return whether a phrase only says that there is nobody."""
        return (noun.start, noun.end) in self._denied

    def _refuse_absent(self, noun: NounPhrase) -> None:
        kinds = tuple(t.value for t in AgentType if t.value not in self._none_of)
        self._refuse(noun, RefusalKind.MISSING_ELEMENT, 'what the scene may have', kinds)

    # --- places -------------------------------------------------------------------------------

    def place(self, noun: NounPhrase) -> str | None:
        """Return the place reference of a noun phrase; a place that the map lacks is refused."""
        if noun.kind is NounKind.PLACE:
            return noun.key
        if noun.kind is NounKind.LANDMARK:
            self._scene.landmarks.append(noun.key)
            return f'landmark:{noun.key}'
        if noun.kind is NounKind.MISSING_LANDMARK:
            return self._short_name(noun)
        if noun.kind is NounKind.PRONOUN and noun.key == 'there':
            for clause in reversed(self._scene.clauses[:-1]):
                if clause.places:
                    return clause.places[0]
        return None

    def _short_name(self, noun: NounPhrase) -> str | None:
        """`the station`, after Union Station was named; several that fit are asked about.

        Where no name says what a place is (Ateneum), the map does: a museum.
        """
        context = self._scene.context
        fitting = [name for name in context.landmark_names if noun.key in _last_words(name)]
        kinds = zip(context.landmark_names, context.landmark_kinds, strict=False)
        fitting = fitting or [name for name, kind in kinds if kind.replace('_', ' ') == noun.key]
        named = [name for name in self._scene.landmarks if name in fitting]
        if not named and len(fitting) > 1:
            self._scene.questions.append(
                f'Which one do you mean by {self._quote(noun)}: {" or ".join(fitting)}?'
            )
            return None
        if not fitting or noun.loose:
            self._refuse_place(noun)
            return None
        return f'landmark:{(named or fitting)[-1]}'

    def unknown_place(self, noun: NounPhrase) -> None:
        """Refuse an unknown name that stands where a place belongs."""
        self._refuse_place(noun)

    def _refuse_place(self, noun: NounPhrase) -> None:
        context = self._scene.context
        self._refuse(
            noun,
            RefusalKind.MISSING_ELEMENT,
            f'landmarks of {context.map_name}',
            context.landmark_names,
        )

    def unknown_actor(self, noun: NounPhrase) -> None:
        """Refuse a name that stands where an actor belongs and is none that can be simulated.

        `the faster of two cars` names a member and no type: it is asked which.
        """
        if _MEMBER.match(self._scene.prompt, noun.end):
            question = f'Which one do you mean by {self._quote(noun)}?'
            self._scene.questions.append(question)
            return
        self._refuse(
            noun, RefusalKind.UNSUPPORTED, 'agent types', tuple(t.value for t in AgentType)
        )

    def _refuse(
        self, noun: NounPhrase, kind: RefusalKind, list_name: str, closed: tuple[str, ...]
    ) -> None:
        refusal = Refusal(
            kind=kind,
            word=noun.head_text or noun.key,
            span=Span(start=noun.start, end=noun.end),
            list_name=list_name,
            closed_list=closed,
        )
        if all(r.word != refusal.word for r in self._scene.refusals):
            self._scene.refusals.append(refusal)

    # --- actors -------------------------------------------------------------------------------

    def note(self, noun: NounPhrase, meant: Sequence[Entity]) -> None:
        """Note whom a noun phrase means, when a construction found it out by itself."""
        if meant:
            self._read[noun.start, noun.end] = tuple(meant)

    def actors(
        self,
        nouns: Sequence[NounPhrase],
        *,
        accept: Fits = anything,
        exclude: Sequence[Entity] = (),
        as_object: bool = False,
    ) -> tuple[Entity, ...]:
        """Return the actors that noun phrases name, in order, without repeats."""
        found: dict[str, Entity] = {}
        for noun in nouns:
            beside = (*exclude, *found.values())  # `the ego and the car ahead of it` are two
            for entity in self._one(noun, accept, beside, as_object):
                found[entity.id] = entity
                entity.seen = len(self._scene.clauses)
        return tuple(found.values())

    def _one(
        self, noun: NounPhrase, accept: Fits, exclude: Sequence[Entity], as_object: bool
    ) -> tuple[Entity, ...]:
        if noun.kind is NounKind.PRONOUN and noun.key == 'another':
            if not self.known(noun):
                self._read[noun.start, noun.end] = self._one_more(noun)
            return self.known(noun)
        if noun.kind is NounKind.PRONOUN and (
            noun.key in ('one', 'other') or noun.key.startswith('nth')
        ):  # each mention picks a member once
            if not self.known(noun):
                picked = self._next_in_line(noun) or self._pronouns.resolve(
                    noun, accept, exclude, as_object
                )
                if not picked and noun.head_text.startswith('the other'):
                    picked = self._beside_one(noun)
                self._read[noun.start, noun.end] = picked
            return self.known(noun)
        if noun.kind is NounKind.PRONOUN:
            return self._pronouns.resolve(noun, accept, exclude, as_object)
        if self.names_ego(noun):
            self._read[noun.start, noun.end] = (self._ego(noun),)
            return self.known(noun)
        if noun.kind is NounKind.UNSUPPORTED or noun.kind is NounKind.UNKNOWN:
            self.unknown_actor(noun)
            return ()
        if noun.kind is NounKind.AMBIGUOUS:
            kinds = ', '.join(self._lexicon.ambiguous_agents[noun.key])
            self._scene.questions.append(
                f'What kind of {noun.key} do you mean by {self._quote(noun)}: {kinds}?'
            )
            return ()
        if noun.kind in (NounKind.AGENT, NounKind.VEHICLE, NounKind.UAV):
            if not self.known(noun):
                self._read[noun.start, noun.end] = self._named(noun, exclude)
            return self.known(noun)
        return ()

    def _beside_one(self, noun: NounPhrase) -> tuple[Entity, ...]:
        """`one drone tracks the bus, the other one hovers`: who makes two of it."""
        acting = [c.subjects for c in self._scene.clauses[:-1] if c.subjects]
        first = acting[-1][0] if acting and len(acting[-1]) == 1 else None
        if first is None or first.span is None or first.group is not None:
            return ()
        words = self._scene.prompt[first.span.start : first.span.end].lower().split()
        alone = sum(
            e.is_uav is first.is_uav and e.type is first.type for e in self._scene.entities
        )
        return (
            self._like(first, Span(start=noun.start, end=noun.end))
            if words[0] in ('one', '1') and alone == 1
            else ()
        )

    def _next_in_line(self, noun: NounPhrase) -> tuple[Entity, ...]:
        """`the first UAV hovers, the second one lands; the second one …`: counted as they come."""
        if not noun.key.startswith('nth') or noun.head_text in ('the former', 'the latter'):
            return ()
        number = int(noun.key[3:])
        numbered = [e for e in self._scene.entities if e.index and e.group is None]
        again = [e for e in numbered if e.index == number]
        before = [e for e in numbered if e.index == number - 1]
        if again or not before:
            return tuple(again[-1:])
        made = self._like(before[-1], Span(start=noun.start, end=noun.end))
        made[0].index = number
        return made

    def _one_more(self, noun: NounPhrase) -> tuple[Entity, ...]:
        """`one drone …, another one …`: of the kind that acted last."""
        acting = [c.subjects[0] for c in self._scene.clauses if c.subjects]
        if not acting:
            return ()
        like = acting[-1]
        members = [e for e in self._scene.entities if like.group and e.group == like.group]
        if noun.head_text.startswith('its') and members:
            return (members[-1],)  # `two drones …, one …, its partner …`
        free = [e for e in members if not e.assigned]
        if free and len(free) < len(members):  # `three drones: one …, another …`
            free[0].assigned = True
            return (free[0],)
        made = self._like(like, Span(start=noun.start, end=noun.end))
        made[0].labels = noun.labels  # `a red one`
        return made

    def _like(self, like: Entity, span: Span) -> tuple[Entity, ...]:
        made = Entity(
            id=self._scene.new_id('uav' if like.is_uav else like.type.value),
            is_uav=like.is_uav,
            type=like.type,
            span=span,
        )
        self._scene.entities.append(made)
        return (made,)

    def _quote(self, noun: NounPhrase) -> str:
        return f'"{self._scene.prompt[noun.start : noun.end]}"'

    @staticmethod
    def names_ego(noun: NounPhrase) -> bool:
        """Return whether a phrase means the ego vehicle: `the ego`, `my car`."""
        if noun.kind is NounKind.EGO:
            return True
        if noun.kind not in (NounKind.AGENT, NounKind.VEHICLE):
            return False
        return noun.determiner is Determiner.MY or 'ego' in noun.labels

    def _ego(self, noun: NounPhrase) -> Entity:
        known = self._scene.ego
        if noun.count > 1 or noun.plural or (known and noun.determiner is Determiner.ANOTHER):
            self._scene.questions.append(
                f'A scenario has one ego vehicle, but {self._quote(noun)} names more: '
                'which one is it?'
            )
        if known is not None:
            if noun.kind is NounKind.AGENT and known.generic:
                known.type, known.generic = AgentType(noun.key), False
            elif noun.kind is NounKind.AGENT and known.type.value != noun.key:
                self._scene.questions.append(
                    f'Is the ego vehicle a {known.type.value} or {self._quote(noun)}?'
                )
            return known
        kind = AgentType(noun.key) if noun.kind is NounKind.AGENT else AgentType.CAR
        entity = Entity(
            id='ego',
            is_uav=False,
            type=kind,
            role=Role.EGO,
            generic=noun.kind is not NounKind.AGENT,
            span=Span(start=noun.start, end=noun.end),
            labels=noun.labels,
        )
        self._scene.entities.append(entity)
        return entity

    def _named(self, noun: NounPhrase, exclude: Sequence[Entity]) -> tuple[Entity, ...]:
        known = [e for e in self._scene.entities if self._same_kind(e, noun)]
        if noun.index:
            numbered = [e for e in known if e.index == noun.index]
            if numbered:
                return (numbered[0],)
            grouped = [e for e in known if e.group is not None]
            members = [e for e in grouped if e.group == grouped[-1].group]
            unnamed = len(members) >= noun.index and not members[noun.index - 1].index
            if unnamed and noun.determiner is not Determiner.INDEFINITE:
                chosen = members[noun.index - 1]
                chosen.index, chosen.assigned = noun.index, True
                return (chosen,)
            return self._counted(noun, known) or self._new(noun)
        if noun.determiner in (Determiner.INDEFINITE, Determiner.ANOTHER):
            return self._new(noun)
        if noun.determiner is Determiner.ONE:
            free = [e for e in known if e.group is not None and not e.assigned]
            if free:
                free[0].assigned = True
                return (free[0],)
            return self._new(noun)
        if noun.determiner is Determiner.OTHER:
            rest = [e for e in known if e not in exclude and not e.assigned]
            if rest:
                chosen_rest = rest if noun.plural else rest[-1:]
                for entity in chosen_rest:
                    entity.assigned = True
                return tuple(chosen_rest)
            return self._new(noun)
        if not known and noun.determiner is Determiner.ALL and noun.kind is NounKind.VEHICLE:
            return ()  # `all vehicles drive at 9 m/s`, before any is named
        if not known:
            return self._shorter(noun, exclude) or self._new(noun)
        return self._again(noun, known, exclude)

    @staticmethod
    def _counted(noun: NounPhrase, known: list[Entity]) -> tuple[Entity, ...]:
        """`one drone …, a second one …; the first drone`: in the order in which they came."""
        if noun.determiner is not Determiner.DEFINITE or noun.plural or len(known) < noun.index:
            return ()
        if len(known) < 2 or any(e.group is not None for e in known):
            return ()
        chosen = known[noun.index - 1]
        if chosen.index:
            return ()
        chosen.index = noun.index
        return (chosen,)

    def _shorter(self, noun: NounPhrase, exclude: Sequence[Entity]) -> tuple[Entity, ...]:
        """`that car`, after a police car and no other: the word without its first half."""
        full = {'car': AgentType.POLICE, 'truck': AgentType.FIRETRUCK}.get(noun.key)
        fitting = [e for e in self._scene.agents if e.type is full and e not in exclude]
        definite = noun.determiner is Determiner.DEFINITE and not noun.plural and not noun.labels
        if noun.head_text == 'bike' and noun.determiner is not Determiner.ANOTHER:
            # `tracks the motorbike, and if the bike …`
            fitting = [e for e in self._scene.agents if e.type is AgentType.MOTORCYCLE]
            definite = not noun.plural and not noun.count
        return tuple(fitting) if definite and len(fitting) == 1 else ()

    def _again(
        self, noun: NounPhrase, known: list[Entity], exclude: Sequence[Entity]
    ) -> tuple[Entity, ...]:
        """A definite or bare phrase that may mean someone already named."""
        group = [e for e in known if e.group is not None]
        everyone = noun.determiner is Determiner.ALL
        if noun.count > 1:
            last = [e for e in group if e.group == group[-1].group] if group else []
            if len(last) == noun.count and noun.determiner is not Determiner.BARE:
                return tuple(last)
            if len(known) == noun.count and noun.determiner is not Determiner.BARE:
                return tuple(known)
            return self._new(noun)
        if noun.plural or (everyone and len(known) > 1):
            if noun.determiner is Determiner.BARE and not group:
                return self._new(noun)
            if group and not everyone:
                return tuple(e for e in group if e.group == group[-1].group)
            return tuple(known) if len(known) > 1 else self._new(noun)
        if everyone:
            return tuple(known)
        plain = [e for e in known if e.role is not Role.EGO] or known
        plain = [e for e in plain if e not in exclude] or plain  # `another bus follows the bus`
        if len(plain) > 1:
            not_background = [e for e in plain if e.role is not Role.BACKGROUND]
            plain = not_background or plain
        pair = front_or_rear(noun, plain)
        if pair is not None:
            return (pair,)
        if len(plain) > 1 and noun.kind is NounKind.VEHICLE:
            latest = max(e.seen for e in plain)
            plain = [e for e in plain if e.seen == latest]
        told = [e for e in plain if self._scene.speaks_of(e)]
        plain = told if len(told) == 1 else plain  # a scene is about whom something is said of
        if len(plain) > 1:
            self._scene.questions.append(
                f'Which one do you mean by {self._quote(noun)}: '
                f'there are {len(plain)} that it fits?'
            )
        chosen = plain[-1]
        only_ego = chosen.role is Role.EGO and noun.kind in (NounKind.AGENT, NounKind.VEHICLE)
        bare = noun.determiner is Determiner.BARE and noun.kind is NounKind.AGENT
        told_apart = chosen in exclude or noun.labels & SIDES  # `the lead car`
        if only_ego and (bare or told_apart):
            return self._new(noun)
        return (chosen,)

    @staticmethod
    def _same_kind(entity: Entity, noun: NounPhrase) -> bool:
        if (noun.kind is NounKind.UAV) != entity.is_uav:
            return False
        if noun.kind is NounKind.AGENT and entity.type.value != noun.key:
            return False
        if noun.kind is NounKind.VEHICLE and entity.type not in _VEHICLES:
            return False
        if noun.background and entity.role is not Role.BACKGROUND:
            return False
        if not noun.labels or not entity.labels:
            # `the red car` may be `a car` named before only if nothing tells them apart
            return not (noun.labels and noun.determiner is Determiner.BARE)
        return noun.labels <= entity.labels or entity.labels <= noun.labels

    def _new(self, noun: NounPhrase) -> tuple[Entity, ...]:
        if noun.kind is NounKind.AGENT and noun.key in self._none_of:
            self._refuse_absent(noun)
        count = noun.count or (2 if noun.plural else 1)
        if count > MOST_AGENTS + 1:  # enough to be refused by the limit on agents
            count = MOST_AGENTS + 1
        stem = (
            'uav'
            if noun.kind is NounKind.UAV
            else (noun.key if noun.kind is NounKind.AGENT else 'car')
        )
        group = self._scene.new_id(f'{stem}_group') if count > 1 else None
        made = []
        for _ in range(count):
            entity = Entity(
                id=self._scene.new_id(stem),
                is_uav=noun.kind is NounKind.UAV,
                type=AgentType(noun.key) if noun.kind is NounKind.AGENT else AgentType.CAR,
                role=_role(noun),
                group=group,
                index=noun.index if count == 1 else 0,
                labels=noun.labels,
                generic=noun.kind is NounKind.VEHICLE,
                span=Span(start=noun.start, end=noun.end),
            )
            self._scene.entities.append(entity)
            made.append(entity)
        return tuple(made)
