# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""From a reading to the scene that the scene rules and defaults take: the offline parser's own.

Ids, roles, groups, defaults and inferred targets therefore come out as they do there.
"""

from __future__ import annotations

from collections.abc import Sequence

from aurora_core.parsing.constructions.pattern_values import no_width
from aurora_core.parsing.constructions.places import add_placement, default_distance
from aurora_core.parsing.llm.actors import Anchors, is_ego
from aurora_core.parsing.llm.event_reader import action_of, trigger_of
from aurora_core.parsing.llm.facts import PromptFacts
from aurora_core.parsing.llm.numbers import StatedNumbers
from aurora_core.parsing.llm.reading import (
    AgentReading,
    BehaviorReading,
    LinkReading,
    MissionReading,
    Number,
    Reading,
    UavReading,
)
from aurora_core.parsing.scene import Entity, EventDraft, LinkDraft, MissionDraft, Scene
from aurora_core.parsing.values import default
from aurora_core.spec.parameter import Parameter, Span, Unit
from aurora_core.spec.scenario import (
    Behavior,
    Placement,
    SendMessage,
    StatedCondition,
)
from aurora_core.spec.vocabulary import (
    AgentType,
    BehaviorKind,
    MissionMode,
    Pattern,
    Relation,
    Role,
    TimeOfDay,
    TrafficDensity,
    Weather,
)

# Who does this begins behind the one it is about.
_BEHIND_ITS_TARGET = (
    BehaviorKind.FOLLOW,
    BehaviorKind.TAILGATE,
    BehaviorKind.OVERTAKE,
    BehaviorKind.APPROACH,
)
_CONDITION_VALUES = {
    Unit.METRE: 'condition_distance',
    Unit.SECOND: 'condition_time',
    Unit.METRE_PER_SECOND: 'condition_speed',
    Unit.ONE: 'condition_ratio',
}
# Where an element without words of its own in the prompt is pointed to.
_START = Span(start=0, end=1)


class SceneBuilder:
    """Builds one scene.

    Args:
        facts: The prompt.
        anchors: The words of the actors.
        numbers: Turns numbers into parameters, and objects.
        complaints: Where objections go, worded for the model.
    """

    def __init__(
        self, facts: PromptFacts, anchors: Anchors, numbers: StatedNumbers, complaints: list[str]
    ) -> None:
        self._facts = facts
        self._anchors = anchors
        self._numbers = numbers
        self._complaints = complaints
        self.scene = Scene(facts.prompt, facts.context)
        self.ids: dict[str, str] = {}
        """Our id of every element by the model's."""

    def build(self, reading: Reading) -> None:
        """Fill the scene; what does not fit becomes an objection.

        Raises:
            ValueError: Parts of the reading contradict the specification's schema.
        """
        self._world(reading)
        self._actors(reading)
        self._name_all('m', [m.id for m in reading.missions])
        self._name_all('link', [link.id for link in reading.links])
        self._name_all('e', [e.id for e in reading.events])
        self._name_all('c', [c.id for c in reading.conditions])
        for agent in reading.agents:
            self._agent(agent)
        for mission in reading.missions:
            self._mission(mission)
        for link in reading.links:
            self._link(link)
        self._events(reading)
        self._conditions(reading)

    def _name_all(self, stem: str, given: Sequence[str]) -> None:
        for one in given:
            self._name(one, self.scene.new_id(stem))

    def _name(self, given: str, ours: str) -> None:
        if given in self.ids:
            self._complaints.append(f'ids must be unique, {given!r} is used twice')
        self.ids[given] = ours

    def _ref(self, given: str) -> str:
        """Return our id for the model's; a place, or what is not there, stays as it is."""
        return self.ids.get(given, given)

    def _refs(self, given: str | None) -> str | None:
        return None if given is None else self._ref(given)

    def _span(self, quote: str, where: str) -> Span:
        spans = self._facts.spans(quote)
        if not spans:
            self._complaints.append(f'{where}: the quote {quote!r} is not in the prompt')
        return spans[0] if spans else _START

    def _number(self, name: str, number: Number | None, where: str) -> Parameter | None:
        return None if number is None else self._numbers.parameter(name, number, where)

    # --- world and actors ---------------------------------------------------------------------

    def _world(self, reading: Reading) -> None:
        draft, said = self.scene.world, reading.world
        draft.weather, draft.weather_span = said.weather, self._word('weather', said.weather)
        draft.time_of_day = said.time_of_day
        draft.time_of_day_span = self._word('time_of_day', said.time_of_day)
        draft.traffic = said.traffic_density
        draft.duration = self._number('scenario_duration', said.duration_s, 'world.duration_s')

    def _word(self, kind: str, value: Weather | TimeOfDay | TrafficDensity | None) -> Span | None:
        for atom in self._facts.world_words(kind):
            if value is not None and atom.key == f'{kind}:{value.value}':
                return Span(start=atom.start, end=atom.end)
        return None

    def _actors(self, reading: Reading) -> None:
        actors: list[AgentReading | UavReading] = [*reading.agents, *reading.uavs]
        anchored = [(self._anchors.of(actor.id), actor) for actor in actors]
        # In the order of the prompt, whatever order the model took.
        anchored.sort(key=lambda pair: pair[0].start if pair[0] is not None else 0)
        groups: dict[int, str] = {}
        for atom, actor in anchored:
            noun = atom.noun if atom is not None else None
            is_agent = isinstance(actor, AgentReading)
            stem = actor.type.value if isinstance(actor, AgentReading) else 'uav'
            ego = noun is not None and is_agent and is_ego(noun)
            together = sum(other is atom for other, _ in anchored) if atom is not None else 1
            group = None
            if atom is not None and together > 1:
                if atom.start not in groups:
                    groups[atom.start] = self.scene.new_id(f'{stem}_group')
                group = groups[atom.start]
            entity = Entity(
                id='ego' if ego else self.scene.new_id(stem),
                is_uav=not is_agent,
                type=actor.type if isinstance(actor, AgentReading) else AgentType.CAR,
                role=_role(ego, noun is not None and noun.background),
                group=group,
                span=Span(start=atom.start, end=atom.end) if atom is not None else _START,
            )
            self._name(actor.id, entity.id)
            self.scene.entities.append(entity)

    def _agent(self, agent: AgentReading) -> None:
        entity = self.scene.by_id(self._ref(agent.id))
        assert entity is not None
        for i, said in enumerate(agent.placements):
            where = f'{agent.id}.placements[{i}]'
            distance = self._number('placement_distance', said.distance_m, f'{where}.distance_m')
            add_placement(
                entity,
                Placement(
                    relation=said.relation,
                    of=self._refs(said.of),
                    distance_m=distance or default_distance(said.relation),
                    bearing_deg=self._number('bearing', said.bearing_deg, f'{where}.bearing_deg'),
                    kept_in_motion=said.kept_in_motion,
                    span=self._span(said.quote, where),
                ),
            )
        for i, behavior in enumerate(agent.behaviors):
            self._behavior(entity, behavior, f'{agent.id}.behaviors[{i}]')

    def _behavior(self, entity: Entity, said: BehaviorReading, where: str) -> None:
        closing = self._number('closing_from', said.closing_from_m, f'{where}.closing_from_m')
        made = Behavior(
            kind=said.kind,
            target=self._refs(said.target),
            speed_mps=self._number('ground_speed', said.speed_mps, f'{where}.speed_mps'),
            closing_from_m=closing,
            span=self._span(said.quote, where),
        )
        entity.behaviors.append(made)
        target = self.scene.by_id(made.target or '')
        if made.kind not in _BEHIND_ITS_TARGET or target is None or target.is_uav:
            return
        beside = [p for p in entity.placements if p.relation is not Relation.BEHIND]
        if beside or any(p.of == entity.id for p in target.placements):
            return
        add_placement(
            entity,
            Placement(
                relation=Relation.BEHIND,
                of=made.target,
                distance_m=closing or default('placement_distance'),
                kept_in_motion=made.kind is BehaviorKind.FOLLOW,
                span=made.span,
            ),
        )

    # --- missions and links -------------------------------------------------------------------

    def _mission(self, said: MissionReading) -> None:
        uav = self.scene.by_id(self._ref(said.uav))
        if uav is None or not uav.is_uav:
            self._complaints.append(f'{said.id}: {said.uav!r} is no UAV of the answer')
            return
        route = said.mode is MissionMode.NAVIGATE
        where = said.id
        self.scene.missions.append(
            MissionDraft(
                id=self._ref(said.id),
                uav=uav,
                mode=said.mode,
                clause=0,
                target=self._refs(said.target),
                needs_target=said.mode is MissionMode.TRACK and said.target is None,
                altitude=self._number('altitude', said.altitude_m, f'{where}.altitude_m'),
                standoff=self._number('standoff', said.standoff_m, f'{where}.standoff_m'),
                bearing=self._number('bearing', said.bearing_deg, f'{where}.bearing_deg'),
                duration=self._number('mission_duration', said.duration_s, f'{where}.duration_s'),
                pattern=said.pattern if route else None,
                size=self._size(said),
                radius=self._number('orbit_radius', said.radius_m, f'{where}.radius_m'),
                waypoint_count=self._number(
                    'waypoint_count', said.waypoint_count, f'{where}.waypoint_count'
                ),
                speed=self._number('uav_speed', said.speed_mps, f'{where}.speed_mps'),
                over_streets=said.over_streets,
                ends_in_flight=said.ends_in_flight,
                span=self._span(said.quote, where),
            )
        )

    def _size(self, said: MissionReading) -> tuple[Parameter, Parameter] | None:
        length = self._number('pattern_length', said.length_m, f'{said.id}.length_m')
        width = self._number('pattern_width', said.width_m, f'{said.id}.width_m')
        if length is None and width is None:
            return None
        unsaid = no_width() if said.pattern is Pattern.LINE else default('pattern_width')
        return length or default('pattern_length'), width or unsaid

    def _link(self, said: LinkReading) -> None:
        where = said.id
        self.scene.links.append(
            LinkDraft(
                id=self._ref(said.id),
                sender=self._ref(said.sender),
                receiver=self._ref(said.receiver),
                loss=self._number('link_loss', said.loss, f'{where}.loss'),
                latency=self._number('link_latency', said.latency_s, f'{where}.latency_s'),
                range=self._number('link_range', said.range_m, f'{where}.range_m'),
                retransmissions=self._number(
                    'link_retransmissions', said.retransmissions, f'{where}.retransmissions'
                ),
                span=self._span(said.quote, where),
            )
        )

    # --- events and conditions ----------------------------------------------------------------

    def _events(self, reading: Reading) -> None:
        for said in reading.events:
            span = self._span(said.quote, said.id)
            trigger = trigger_of(said, self._ref, self._numbers)
            action = action_of(said, self._ref, self._numbers)
            self.scene.events.append(
                EventDraft(
                    id=self._ref(said.id),
                    trigger=trigger,
                    action=action,
                    delay=self._number('delay', said.delay_s, f'{said.id}.delay_s'),
                    span=span,
                )
            )
            if isinstance(action, SendMessage):
                self._link_for(action, span)

    def _link_for(self, message: SendMessage, span: Span) -> None:
        """A message needs a link; one that the prompt does not describe has the defaults."""
        ends = (message.sender, message.receiver)
        if all((link.sender, link.receiver) != ends for link in self.scene.links):
            self.scene.links.append(
                LinkDraft(
                    id=self.scene.new_id('link'), sender=ends[0], receiver=ends[1], span=span
                )
            )

    def _conditions(self, reading: Reading) -> None:
        for said in reading.conditions:
            name = _CONDITION_VALUES.get(said.value.unit)
            if name is None:
                self._complaints.append(
                    f'{said.id}.value: a condition has no unit {said.value.unit.value!r}'
                )
                continue
            self.scene.conditions.append(
                StatedCondition(
                    id=self._ref(said.id),
                    quantity=said.quantity,
                    of=tuple(self._ref(one) for one in said.of),
                    op=said.op,
                    value=self._numbers.parameter(name, said.value, f'{said.id}.value'),
                    hold_s=self._number('condition_time', said.hold_s, f'{said.id}.hold_s'),
                    by_s=self._number('condition_time', said.by_s, f'{said.id}.by_s'),
                    fraction=self._number('condition_ratio', said.fraction, f'{said.id}.fraction'),
                    span=self._span(said.quote, said.id),
                )
            )


def _role(ego: bool, background: bool) -> Role:
    if ego:
        return Role.EGO
    return Role.BACKGROUND if background else Role.OTHER
