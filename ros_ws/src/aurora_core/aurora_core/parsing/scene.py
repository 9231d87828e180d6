# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The scenario while it is being read: actors, drafts of its elements, open points."""

from __future__ import annotations

from dataclasses import dataclass, field

from aurora_core.outcomes.parse import ParseContext, Refusal
from aurora_core.parsing.atoms import NounPhrase
from aurora_core.spec.parameter import Parameter, Span
from aurora_core.spec.prohibitions import Prohibition
from aurora_core.spec.scenario import (
    Behavior,
    Clause,
    Event,
    EventAction,
    Order,
    Placement,
    SceneCount,
    StatedCondition,
    Trigger,
)
from aurora_core.spec.vocabulary import (
    AgentType,
    ClauseStatus,
    LinkOcclusion,
    MissionMode,
    Pattern,
    RelativeWind,
    Role,
    Side,
    TimeOfDay,
    TrafficDensity,
    Weather,
)


@dataclass(slots=True, kw_only=True, eq=False)
class Entity:
    """One actor: a ground agent or a UAV.

    Attributes:
        group: Name shared by the members of a group.
        index: `drone 2`: 2; 0 when not numbered.
        assigned: A member picked by `one`, `the first`.
        seen: Number of the last clause that mentions it.
    """

    id: str
    is_uav: bool
    type: AgentType = AgentType.CAR
    role: Role = Role.OTHER
    group: str | None = None
    index: int = 0
    labels: frozenset[str] = frozenset()
    span: Span
    assigned: bool = False
    seen: int = 0
    generic: bool = False
    placements: list[Placement] = field(default_factory=list)
    behaviors: list[Behavior] = field(default_factory=list)


@dataclass(slots=True, kw_only=True, eq=False)
class MissionDraft:
    """A mission phase; None means that the prompt left it unsaid.

    Attributes:
        on_the_way: Only where to is said: `flies to the park`.
        told: It is flown for something that is told; who only passes messages on waits in the air.
    """

    id: str
    uav: Entity
    mode: MissionMode
    clause: int
    target: str | None = None
    target_inferred: bool = False
    start: str | None = None
    needs_target: bool = False
    altitude: Parameter | None = None
    way_at_altitude: bool = False
    standoff: Parameter | None = None
    bearing: Parameter | None = None
    side: Side | None = None
    duration: Parameter | None = None
    pattern: Pattern | None = None
    pattern_assumed: bool = False
    square: bool = False
    size: tuple[Parameter, Parameter] | None = None
    radius: Parameter | None = None
    waypoint_count: Parameter | None = None
    turns: Parameter | None = None
    speed: Parameter | None = None
    dwell: Parameter | None = None
    over_streets: bool = False
    ends_in_flight: bool = False
    watching: bool = False  # told with `watches`, `sees`
    on_the_way: bool = False
    told: bool = True
    span: Span


@dataclass(slots=True, kw_only=True, eq=False)
class LinkDraft:
    """A message link; `sender` None: its values hold for every link of the prompt."""

    id: str
    sender: str | None
    receiver: str | None
    loss: Parameter | None = None
    latency: Parameter | None = None
    range: Parameter | None = None
    retransmissions: Parameter | None = None
    interval: Parameter | None = None
    occlusion: LinkOcclusion = LinkOcclusion.SHORTENS
    outage: tuple[Parameter, Parameter] | None = None
    rate: Parameter | None = None
    span: Span


@dataclass(slots=True, kw_only=True, eq=False)
class EventDraft:
    """An event; the trigger may come from the clause before or after its action."""

    id: str
    trigger: Trigger | None = None
    action: EventAction | None = None
    delay: Parameter | None = None
    clauses: list[int] = field(default_factory=list)
    span: Span


@dataclass(slots=True, kw_only=True, eq=False)
class UntilDraft:
    """`tracks the bus until it stops`: the phase and the event that will end it.

    Attributes:
        only_waits: Nothing is said of the phase but that the UAV waits.
    """

    mission: MissionDraft
    event: EventDraft
    only_waits: bool = False


@dataclass(slots=True, kw_only=True, eq=False)
class WorldDraft:
    weather: Weather | None = None
    weather_span: Span | None = None
    time_of_day: TimeOfDay | None = None
    time_of_day_span: Span | None = None
    traffic: TrafficDensity | None = None
    wind_speed: Parameter | None = None
    gust: Parameter | None = None
    wind_from: Parameter | None = None
    wind: RelativeWind | None = None
    duration: Parameter | None = None


@dataclass(slots=True, kw_only=True, eq=False)
class ClauseDraft:
    """A clause under way; ids collect what it became; a relative clause only describes."""

    span: Span
    status: ClauseStatus = ClauseStatus.NOT_ENCODED
    ids: dict[str, None] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    subjects: tuple[Entity, ...] = ()
    objects: tuple[Entity, ...] = ()
    places: tuple[str, ...] = ()
    sentence: int = 0
    describes: bool = False
    passive: bool = False

    @property
    def topic(self) -> tuple[Entity, ...]:
        """Whom the clause is about: `the car is overtaken by a van and brakes`."""
        if not self.passive:
            return self.subjects
        first = self.objects[:1]
        group = first[0].group if first else None
        return first if group is None else tuple(e for e in self.objects if e.group == group)


@dataclass(frozen=True, slots=True, kw_only=True)
class Doubt:
    """Words whose meaning stays open; a question only if nothing else could be read."""

    span: Span
    question: str


@dataclass(slots=True, kw_only=True, eq=False)
class Unanchored:
    """`a bus 30 m ahead`, before anyone is named that it could be ahead of."""

    entities: tuple[Entity, ...]
    placement: Placement
    clause: ClauseDraft


class Scene:
    """Everything read so far."""

    def __init__(self, prompt: str, context: ParseContext) -> None:
        self.prompt = prompt
        self.context = context
        self.world = WorldDraft()
        self.entities: list[Entity] = []
        self.missions: list[MissionDraft] = []
        self.links: list[LinkDraft] = []
        self.events: list[EventDraft] = []
        self.conditions: list[StatedCondition] = []
        self.orders: list[Order] = []
        self.counts: list[SceneCount] = []
        self.prohibitions: list[Prohibition] = []
        self.clauses: list[ClauseDraft] = []
        self.questions: list[str] = []
        self.doubts: list[Doubt] = []
        self.refusals: list[Refusal] = []
        self.pending_altitude: dict[str, Parameter] = {}
        self.pending_speed: dict[str, Parameter] = {}
        self.pending_place: dict[str, str] = {}
        self.aerial: tuple[ClauseDraft, str | None] | None = None
        self.no_uavs = False
        # What the whole prompt says of flying, for clauses that leave the flyer out.
        self.altitude_stated = False
        self.uav_nouns: tuple[NounPhrase, ...] = ()
        self.landmarks: list[str] = []
        self.unanchored: list[Unanchored] = []
        self.reported: dict[str, str] = {}
        self.untils: list[UntilDraft] = []
        # Clauses that were read word by word: no number of them can have been lost.
        self.understood: list[Span] = []
        self._counters: dict[str, int] = {}

    # --- names --------------------------------------------------------------------------------

    def new_id(self, stem: str) -> str:
        """Return `stem1`, `stem2`, …"""
        self._counters[stem] = self._counters.get(stem, 0) + 1
        return f'{stem}{self._counters[stem]}'

    # --- actors -------------------------------------------------------------------------------

    @property
    def ego(self) -> Entity | None:
        return next((e for e in self.entities if e.role is Role.EGO), None)

    @property
    def uavs(self) -> list[Entity]:
        return [e for e in self.entities if e.is_uav]

    @property
    def agents(self) -> list[Entity]:
        return [e for e in self.entities if not e.is_uav]

    def by_id(self, wanted: str) -> Entity | None:
        """Return the actor of this id."""
        return next((e for e in self.entities if e.id == wanted), None)

    def speaks_of(self, entity: Entity) -> bool:
        """Return whether anything was read about an actor, or about another one beside it."""
        if entity.placements or entity.behaviors or entity.role is Role.EGO:
            return True
        others = [p.of for e in self.entities for p in e.placements]
        others += [b.target for e in self.entities for b in e.behaviors]
        others += [m.target for m in self.missions]
        return entity.id in others or any(entity in c.subjects for c in self._encoded())

    def _encoded(self) -> list[ClauseDraft]:
        return [c for c in self.clauses if c.status is ClauseStatus.ENCODED]

    def missions_of(self, uav: Entity) -> list[MissionDraft]:
        """Return the phases of one UAV in order."""
        return [m for m in self.missions if m.uav is uav]

    def drop_mission(self, mission: MissionDraft, event: EventDraft) -> None:
        """Leave out a phase that only said when an event lets the next one begin."""
        self.missions.remove(mission)
        for clause in self.clauses:
            if mission.id in clause.ids:
                del clause.ids[mission.id]
                clause.ids[event.id] = None

    # --- clauses ------------------------------------------------------------------------------

    @property
    def clause(self) -> ClauseDraft:
        """The clause that is being read."""
        return self.clauses[-1]

    @property
    def clause_number(self) -> int:
        return len(self.clauses) - 1

    def add_event(
        self, action: EventAction, span: Span, trigger: Trigger | None = None
    ) -> EventDraft:
        """Add an event of its own."""
        made = EventDraft(id=self.new_id('e'), trigger=trigger, action=action, span=span)
        self.events.append(made)
        return made

    def became(self, *ids: str) -> None:
        """Note which elements the current clause turned into."""
        for one in ids:
            self.clause.ids[one] = None
        self.clause.status = ClauseStatus.ENCODED

    def finished_clauses(self) -> tuple[Clause, ...]:
        """Return the clauses as values."""
        return tuple(
            Clause(
                text=self.prompt[c.span.start : c.span.end],
                span=c.span,
                status=c.status,
                ids=tuple(c.ids),
                note='; '.join(c.notes),
            )
            for c in self.clauses
        )

    def events_as_values(self) -> tuple[Event, ...]:
        """Return the events as values."""
        return tuple(
            Event(id=e.id, trigger=e.trigger, action=e.action, delay_s=e.delay, span=e.span)
            for e in self.events
        )
