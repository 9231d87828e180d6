# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Atoms: what tagging makes of tokens (noun phrases, measures, verbs, prepositions, marks)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from aurora_core.parsing.measures import Measure
from aurora_core.parsing.morphology import VerbForm


class AtomKind(StrEnum):
    NOUN = 'noun'  # actor, UAV, place, pronoun: see NounPhrase.kind
    MEASURE = 'measure'
    VERB = 'verb'
    CAUSATIVE = 'causative'
    AUXILIARY = 'auxiliary'
    NEGATION = 'negation'
    RELATION = 'relation'
    PREPOSITION = 'preposition'
    COMPASS = 'compass'
    WORLD = 'world'  # key: 'weather:clear', 'time_of_day:noon', 'traffic_density:low'
    WORLD_NOUN = 'world_noun'
    NO_TRAFFIC = 'no_traffic'
    AERIAL = 'aerial'
    SIREN = 'siren'
    STATE = 'state'
    THING = 'thing'
    PATTERN = 'pattern'
    ROUTE = 'route'
    MESSAGE = 'message'
    LINK = 'link'
    SCENARIO = 'scenario'
    STREETS_FLAG = 'streets_flag'
    IN_VIEW = 'in_view'
    IN_FLIGHT = 'in_flight'
    FROM_START = 'from_start'
    CONJUNCTION = 'conjunction'
    THEN = 'then'
    SUBORDINATOR = 'subordinator'
    RELATIVE = 'relative'
    COMMA = 'comma'
    STOP = 'stop'
    FILL = 'fill'
    FRAME = 'frame'
    CONTEXT = 'context'
    HAPPENING = 'happening'  # an event as a noun: `arrival`; key: that of the verb
    BECAUSE = 'because'  # `in response to`
    CAUSING = 'causing'  # `causes the car to …`
    UNKNOWN = 'unknown'


class NounKind(StrEnum):
    AGENT = 'agent'
    VEHICLE = 'vehicle'
    UAV = 'uav'
    EGO = 'ego'
    UNSUPPORTED = 'unsupported'
    AMBIGUOUS = 'ambiguous'
    PRONOUN = 'pronoun'
    PLACE = 'place'
    LANDMARK = 'landmark'
    MISSING_LANDMARK = 'missing_landmark'
    STREET = 'street'
    SURROUNDINGS = 'surroundings'
    UNKNOWN = 'unknown'


class Determiner(StrEnum):
    BARE = 'bare'
    DEFINITE = 'definite'
    INDEFINITE = 'indefinite'
    ONE = 'one'
    ANOTHER = 'another'
    OTHER = 'other'
    MY = 'my'
    ALL = 'all'


ACTORS = frozenset(
    {
        NounKind.AGENT,
        NounKind.VEHICLE,
        NounKind.UAV,
        NounKind.EGO,
        NounKind.UNSUPPORTED,
        NounKind.AMBIGUOUS,
        NounKind.PRONOUN,
    }
)
PLACES = frozenset({NounKind.PLACE, NounKind.LANDMARK, NounKind.MISSING_LANDMARK})


@dataclass(frozen=True, slots=True, kw_only=True)
class NounPhrase:
    """A noun phrase.

    Attributes:
        kind: What the head noun names.
        key: Agent type, place key, landmark name, pronoun class or the unknown word.
        count: Stated number of members, 0 when none is stated.
        labels: Words that only tell actors apart (colours, sizes).
        states: Behaviours and relations stated by adjectives (`parked`, `tracking`, `oncoming`).
        index: `drone 2`, `the second van`.
        loose: Spans inside the phrase that were not understood.
    """

    kind: NounKind
    key: str
    start: int
    end: int
    head_text: str = ''
    determiner: Determiner = Determiner.BARE
    count: int = 0
    plural: bool = False
    labels: frozenset[str] = frozenset()
    states: tuple[str, ...] = ()
    background: bool = False
    target: bool = False
    index: int = 0
    loose: tuple[tuple[int, int], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Atom:
    """One unit of meaning and where it stands in the prompt."""

    kind: AtomKind
    key: str
    start: int
    end: int
    form: VerbForm = VerbForm.BASE
    noun: NounPhrase | None = None
    measure: Measure | None = None
    other_kinds: frozenset[AtomKind] = frozenset()
    verb_key: str = ''
    verb_form: VerbForm = VerbForm.BASE
    words: str = ''  # in lower case, spelling corrected

    @property
    def is_actor(self) -> bool:
        return self.noun is not None and self.noun.kind in ACTORS

    @property
    def is_place(self) -> bool:
        return self.noun is not None and self.noun.kind in PLACES


_NOTHING = frozenset(
    {
        AtomKind.FILL,
        AtomKind.FRAME,
        AtomKind.CAUSATIVE,
        AtomKind.SCENARIO,
        AtomKind.COMMA,
        AtomKind.CONJUNCTION,
        AtomKind.AUXILIARY,
        AtomKind.THEN,
        AtomKind.RELATIVE,
        AtomKind.PREPOSITION,
        AtomKind.CONTEXT,
        AtomKind.SUBORDINATOR,
    }
)


def needs_nothing(atoms: Sequence[Atom]) -> bool:
    """Return whether a piece of a prompt asks for nothing: politeness, or what it is all for."""
    if all(a.kind in _NOTHING for a in atoms):
        return True
    told = any(a.kind is AtomKind.CONTEXT for a in atoms)
    return told and not any(
        a.kind in (AtomKind.MEASURE, AtomKind.WORLD) or a.is_actor or a.is_place for a in atoms
    )
