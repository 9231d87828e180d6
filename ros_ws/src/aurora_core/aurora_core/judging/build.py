# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What every derivation needs: the inputs, and a way to write one condition."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypedDict

from aurora_core.document import Document
from aurora_core.judging.quantity import Quantity
from aurora_core.knowledge.limits import Limits, Tolerance, Tolerances
from aurora_core.outcomes.condition import Condition, EventTolerances, Op
from aurora_core.outcomes.schedule import AgentFacts, MissionFacts, PlanFacts
from aurora_core.quantities.actions import action_rules
from aurora_core.spec.parameter import Bound, Parameter, Provenance, Span
from aurora_core.spec.scenario import AgentAction, ArrivalTrigger, GroundAgent, ScenarioSpec
from aurora_core.spec.vocabulary import AgentType, Place
from aurora_core.stl.syntax import format_number


class Underivable(Document):
    """An element of the specification that no condition can express yet.

    Attributes:
        element: Id in the specification.
        what: What is missing, for people.
        span: Where the prompt asks for it.
    """

    element: str
    what: str
    span: Span | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Source:
    """Where a condition comes from."""

    ids: tuple[str, ...]
    spans: tuple[Span | None, ...] = ()
    provenance: Provenance = Provenance.DEFAULT
    implied: bool = True


class Common(TypedDict):
    """What the arguments of all conditions of a run have in common."""

    horizon_s: float
    touchdown_m: float


class CommonOfEvent(Common):
    """What the arguments of the conditions on one event have in common."""

    event: str
    event_tolerances: EventTolerances


@dataclass(frozen=True, slots=True, kw_only=True)
class Inputs:
    """Specification, facts of the plan, limits and tolerances."""

    spec: ScenarioSpec
    facts: PlanFacts
    limits: Limits
    tolerances: Tolerances

    def agent(self, agent_id: str) -> GroundAgent | None:
        """Return a ground agent by id."""
        return next((agent for agent in self.spec.agents if agent.id == agent_id), None)

    def mission_facts(self, mission_id: str) -> MissionFacts | None:
        """Return the facts of a mission."""
        return next((f for f in self.facts.missions if f.mission == mission_id), None)

    def agent_facts(self, agent_id: str) -> AgentFacts | None:
        """Return the facts of a ground agent, None when it has no place."""
        return next((f for f in self.facts.agents if f.agent == agent_id), None)

    def placement_tolerance(self, agent_id: str) -> Tolerance:
        """Return the tolerance of placement distances: vehicles, or walkers and parked ones."""
        agent = self.agent(agent_id)
        walks = agent is not None and agent.type is AgentType.PEDESTRIAN
        parked = agent is not None and any(p.relation == 'parked_at' for p in agent.placements)
        if walks or parked:
            return self.tolerances.placement_other_m
        return self.tolerances.placement_vehicle_m

    @property
    def common(self) -> Common:
        """What the arguments of all conditions begin with."""
        return {
            'horizon_s': self.facts.horizon_s,
            'touchdown_m': self.tolerances.touchdown_height_m,
        }

    def of_event(self, event_id: str) -> CommonOfEvent:
        """Return what the arguments of the conditions on an event begin with."""
        tolerances = self.tolerances
        return {
            **self.common,
            'event': event_id,
            'event_tolerances': EventTolerances(
                brake_mps2=tolerances.brake_mps2,
                onset_mps2=tolerances.onset_mps2,
                arrival_m=tolerances.arrival_m,
                crosswalk_m=tolerances.crosswalk_m if _walks_to_crosswalk(self.spec) else None,
                actions=action_rules(tolerances, steps_on=_somebody_crosses(self.spec)),
                statistics_from=tolerances.link_statistics_from,
            ),
        }


def _somebody_crosses(spec: ScenarioSpec) -> bool:
    """Tell whether an event lets somebody cross a street."""
    actions = (event.action for event in spec.events)
    return any(isinstance(action, AgentAction) and action.do == 'cross' for action in actions)


def _walks_to_crosswalk(spec: ScenarioSpec) -> bool:
    """Tell whether an event waits for a person to reach a crosswalk."""
    persons = {agent.id for agent in spec.agents if agent.type is AgentType.PEDESTRIAN}
    return any(
        isinstance(t, ArrivalTrigger) and t.place == Place.CROSSWALK and t.who in persons
        for t in (event.trigger for event in spec.events)
    )


# Of the conditions that no prompt has to ask for.
EVERY_RUN = Source(ids=())


@dataclass(frozen=True, slots=True, kw_only=True)
class Target:
    """Comparison of a signal with a number.

    Attributes:
        op: Comparison.
        threshold: In `unit`.
        unit: SI unit, '1' for shares and counts.
        tolerance: With `==` the half width.
    """

    op: Op
    threshold: float
    unit: str
    tolerance: float | None = None

    @property
    def text(self) -> str:
        """The comparison as STL text."""
        text = f'{self.op} {format_number(self.threshold)}'
        if self.op == '==' and self.tolerance is not None:
            text += f' +- {format_number(self.tolerance)}'
        return f'{text} {self.unit}'

    @property
    def scale(self) -> float:
        """The tolerance, else 10 % of the threshold, else 1 (contract: Margins)."""
        if self.tolerance is not None and self.tolerance > 0.0:
            return self.tolerance
        return 0.1 * abs(self.threshold) if self.threshold != 0.0 else 1.0


def number_target(parameter: Parameter, tolerance: Tolerance) -> Target:
    """Return the comparison that an explicit number implies.

    One-sided requests ("at least") keep the number itself as the limit.
    """
    unit = parameter.unit.value
    slack = tolerance.of(parameter.value, approximate=parameter.approximate)
    if parameter.bound is Bound.AT_LEAST:
        return Target(op='>=', threshold=parameter.value, unit=unit)
    if parameter.bound is Bound.AT_MOST:
        return Target(op='<=', threshold=parameter.value, unit=unit)
    return Target(op='==', threshold=parameter.value, unit=unit, tolerance=slack)


def condition(
    *,
    id: str,
    sentence: str,
    of: tuple[str, ...],
    target: Target,
    arguments: Quantity,
    source: Source,
    signal: str | None = None,
    every_sample: bool = True,
    hold_s: float | None = None,
    by_s: float | None = None,
    fraction: float | None = None,
) -> Condition:
    """Return a condition with its formula written out.

    Args:
        id: Unique in the run.
        sentence: English.
        of: Bodies it is about.
        target: The comparison.
        arguments: What is measured, and what that needs beside the threshold.
        source: Where it comes from.
        signal: Name in the formula; default: the quantity with its bodies.
        every_sample: The worst sample counts (`always`); else there is one sample only.
        hold_s: The best stretch of this length counts instead.
        by_s: Deadline from scenario start for a stretch or sample that holds.
        fraction: Share of samples, where the threshold is one.
    """
    name = signal if signal is not None else f'{arguments.name.value}({",".join(of)})'
    text = f'{name} {target.text}'
    if hold_s is not None:
        text = f'always [0, {format_number(hold_s)}] s ({text})'
    if hold_s is not None or by_s is not None:
        within = '' if by_s is None else f'[0, {format_number(by_s)}] s '
        text = f'eventually {within}({text})'
    elif every_sample:
        text = f'always ({text})'
    return Condition(
        id=id,
        sentence=sentence,
        formula=text,
        signal=name,
        quantity=arguments.name,
        of=of,
        op=target.op,
        threshold=target.threshold,
        tolerance=target.tolerance,
        unit=target.unit,
        scale=target.scale,
        hold_s=hold_s,
        by_s=by_s,
        fraction=fraction,
        arguments=arguments,
        spec_ids=source.ids,
        spans=tuple(span for span in source.spans if span is not None),
        provenance=source.provenance,
        implied=source.implied,
    )


def share_condition(
    *,
    id: str,
    sentence: str,
    of: tuple[str, ...],
    share: float,
    arguments: Quantity,
    source: Source,
    signal: str | None = None,
) -> Condition:
    """Return that something holds in at least a share of the samples; see `condition`."""
    return condition(
        id=id,
        sentence=sentence,
        of=of,
        target=Target(op='>=', threshold=share, unit='1'),
        arguments=arguments,
        source=source,
        signal=signal,
        every_sample=False,
        fraction=share,
    )


def number(value: float) -> str:
    """Return a number as people write it: at most three decimals."""
    return format_number(round(value, 3))


def stated_by(source: Source, parameter: Parameter) -> Source:
    """Return the source of a condition whose threshold a parameter states."""
    return Source(
        ids=source.ids, spans=(parameter.span, *source.spans), provenance=parameter.provenance
    )


def bound_words(parameter: Parameter) -> str:
    """Return how a number binds, in words that stand before it."""
    if parameter.bound is Bound.AT_LEAST:
        return 'at least'
    if parameter.bound is Bound.AT_MOST:
        return 'at most'
    return 'about' if parameter.approximate else 'the requested'
