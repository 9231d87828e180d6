# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Score one answer against the requirements of its prompt."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from scipy.optimize import linear_sum_assignment

from aurora_bench.fidelity.answer import Answer
from aurora_bench.fidelity.binding import Binding, Names, bodies_of, slots
from aurora_bench.fidelity.carriers import behavior_facts, placement_facts
from aurora_bench.fidelity.denominator import beyond, final_landings
from aurora_bench.fidelity.equivalences import in_another_form
from aurora_bench.fidelity.events import (
    condition_fields,
    event_fields,
    event_names,
    implied_event_fields,
    order_fields,
)
from aurora_bench.fidelity.fields import (
    Case,
    Fields,
    Subject,
    agent_fields,
    behavior_fields,
    best,
    count_fields,
    for_all,
    link_fields,
    mission_fields,
    mission_names,
    placement_fields,
    uav_fields,
    unread_fields,
    world_fields,
)
from aurora_bench.fidelity.forms_of_events import is_chain_by, other_moments
from aurora_bench.fidelity.moments import landing_of, precedence
from aurora_bench.fidelity.numbers import NumberRule
from aurora_bench.fidelity.search import Picked, best_pick
from aurora_bench.prompts.format import (
    AgentRequirement,
    AnnotatedPrompt,
    AnyOfRequirement,
    BehaviorRequirement,
    ConditionRequirement,
    CountRequirement,
    EventRequirement,
    LinkRequirement,
    MissionRequirement,
    OrderRequirement,
    PlacementRequirement,
    RejectRequirement,
    Requirement,
    UavRequirement,
    WorldRequirement,
    flat,
)
from aurora_core.document import Document
from aurora_core.spec.scenario import Event, ScenarioSpec

# A requirement that is wholly met outweighs any number of single fields.
_WHOLE = 1000


class RequirementScore(Document):
    """One requirement and which of its annotated fields hold.

    Attributes:
        id: In the prompt.
        kind: Of the requirement.
        fields: Annotated fields and whether each holds.
        form: Key of the equivalence by which it holds; empty when the plain comparison decides.
    """

    id: str
    kind: str
    fields: dict[str, bool]
    form: str = ''

    @property
    def is_met(self) -> bool:
        """Whether every annotated field holds."""
        return all(self.fields.values())


class PromptScore(Document):
    """All requirements of a prompt that count.

    Attributes:
        requirements: In the order of the prompt.
        extra: Agents and UAVs of the specification that nothing asked for.
        beyond: Ids of requirements that no field of the format holds.
        landings: Ids of requirements that ask for the landing that ends every mission.
    """

    requirements: tuple[RequirementScore, ...]
    extra: tuple[str, ...] = ()
    beyond: tuple[str, ...] = ()
    landings: tuple[str, ...] = ()


def score(prompt: AnnotatedPrompt, answer: Answer, *, is_fair: bool = True) -> PromptScore:
    """Return the score under the binding that satisfies most requirements.

    Args:
        prompt: With its annotation.
        answer: Of the product.
        is_fair: What says the same counts the same (`equivalences.py`), and the landing that ends
            every mission is no requirement; else the form of the annotation is the only one.
    """
    spec = answer.spec
    if spec is None:
        return _Scorer(prompt, ScenarioSpec(prompt=prompt.prompt), answer, is_fair).nothing()
    scorer = _Scorer(prompt, spec, answer, is_fair)

    def under(picked: Picked) -> PromptScore:
        return scorer.under(bodies_of(picked, prompt.requirements, spec))

    def worth(picked: Picked) -> int:
        found = under(picked).requirements
        return sum(_WHOLE * r.is_met + sum(r.fields.values()) for r in found)

    return under(best_pick(slots(prompt.requirements, spec), worth))


class _Scorer:
    def __init__(
        self, prompt: AnnotatedPrompt, spec: ScenarioSpec, answer: Answer, is_fair: bool
    ) -> None:
        self._prompt = prompt
        self._answer = answer
        self._is_fair = is_fair
        self._asked = flat(prompt.requirements)
        self._top = frozenset(r.id for r in prompt.requirements)
        self._beyond = beyond(prompt)
        self._landings = final_landings(prompt) if is_fair else frozenset()
        left_out = self._beyond | self._landings
        self._scored = tuple(r for r in prompt.requirements if r.id not in left_out)
        self._subject = Subject(
            spec=spec,
            binding=Binding(bodies={}),
            placements=tuple(placement_facts(spec)),
            behaviors=tuple(behavior_facts(spec)),
            before=precedence(spec),
        )

    def nothing(self) -> PromptScore:
        """Without a specification only a refusal can be right."""
        scores = []
        for r in self._scored:
            fields, _ = self._fields(r)
            is_refusal = isinstance(r, RejectRequirement) or (
                isinstance(r, AnyOfRequirement) and 'because' in fields
            )
            held = fields if is_refusal else dict.fromkeys(fields, False)
            scores.append(RequirementScore(id=r.id, kind=r.kind, fields=held))
        return self._score(tuple(scores))

    def under(self, bodies: Names) -> PromptScore:
        """Return the score under one binding of agents and UAVs."""
        self._subject = replace(self._subject, binding=Binding(bodies=bodies))
        self._bind_moments()
        scores = tuple(self._scored_one(r) for r in self._scored)
        bound = frozenset().union(*bodies.values()) if bodies else frozenset()
        spec = self._subject.spec
        names = [*(a.id for a in spec.agents), *(u.id for u in spec.uavs)]
        extra = [name for name in names if name not in bound]
        return self._score(scores, tuple(extra))

    def _score(
        self, scores: tuple[RequirementScore, ...], extra: tuple[str, ...] = ()
    ) -> PromptScore:
        return PromptScore(
            requirements=scores,
            extra=extra,
            beyond=tuple(sorted(self._beyond)),
            landings=tuple(sorted(self._landings)),
        )

    def _scored_one(self, r: Requirement) -> RequirementScore:
        fields, form = self._fields(r)
        return RequirementScore(id=r.id, kind=r.kind, fields=fields, form=form)

    def _bind_moments(self) -> None:
        """Give every mission and event requirement an element of its own."""
        spec = self._subject.spec
        top = self._prompt.requirements
        missions = [r for r in top if isinstance(r, MissionRequirement)]
        events = [r for r in top if isinstance(r, EventRequirement)]
        moments: dict[str, str] = {}
        held = [
            [mission_fields(r, m, self._subject, self._rule(r)) for m in spec.missions]
            for r in missions
        ]
        for k, n in _assigned(held):
            moments[missions[k].ref] = spec.missions[n].id
        # Events name other events: the second round knows what the first has bound.
        for _ in range(2):
            self._rebind(moments, self._subject.binding.others)
            subject = self._subject
            held = [[self._event_fields(r, e, subject) for e in spec.events] for r in events]
            bound = {events[k].ref: spec.events[n].id for k, n in _assigned(held)}
            moments = {**moments, **bound, **self._landings_bound(events, bound)}
            moments = {**moments, **self._readings_bound(moments)}
            self._rebind(moments, self._others(moments))

    def _rebind(self, moments: Mapping[str, str], others: Names) -> None:
        binding = replace(self._subject.binding, moments=moments, others=others)
        self._subject = replace(self._subject, binding=binding)

    def _others(self, moments: Mapping[str, str]) -> Names:
        """Return what else the annotated events are, where that is said in another form."""
        if not self._is_fair:
            return {}
        binding = replace(self._subject.binding, moments=moments)
        subject = replace(self._subject, binding=binding)
        found: dict[str, frozenset[str]] = {}
        for r in self._asked:
            if isinstance(r, EventRequirement) and not r.negate:
                others = frozenset(other_moments(r, self._case(r, subject)))
                found[r.ref] = found.get(r.ref, frozenset()) | others
        return found

    def _case(self, r: Requirement, subject: Subject) -> Case:
        return Case(
            requirement=r,
            asked=self._asked,
            subject=subject,
            rule=self._rule(r),
            is_reading=r.id not in self._top,
        )

    def _event_fields(self, r: EventRequirement, event: Event, subject: Subject) -> Fields:
        """Compare an event, also with what says the same by other links of a chain."""
        fields = event_fields(r, event, subject, self._rule(r))
        if not self._is_fair or all(fields.values()):
            return fields
        case = self._case(r, subject)
        return dict.fromkeys(fields, True) if is_chain_by(event, case) else fields

    def _readings_bound(self, moments: Mapping[str, str]) -> dict[str, str]:
        """Bind what readings of an `any_of` name: they share elements, so each takes its best."""
        binding = replace(self._subject.binding, moments=moments)
        subject = replace(self._subject, binding=binding)
        held: dict[tuple[str, str], Fields] = {}
        for r in flat(self._prompt.requirements):
            if not isinstance(r, MissionRequirement | EventRequirement):
                continue
            if r in self._prompt.requirements:
                continue
            for name, fields in self._elements(r, subject):
                key = (r.ref, name)  # two readings may call the same thing by one name
                held[key] = max(held.get(key, {}), fields, key=_worth)
        bound: dict[str, str] = {}
        for (ref, name), fields in held.items():
            found = bound.get(ref)
            if _worth(fields) > (_worth(held[ref, found]) if found is not None else 0):
                bound[ref] = name
        return bound

    def _elements(
        self, r: MissionRequirement | EventRequirement, subject: Subject
    ) -> list[tuple[str, Fields]]:
        rule = self._rule(r)
        if isinstance(r, MissionRequirement):
            return [(m.id, mission_fields(r, m, subject, rule)) for m in subject.spec.missions]
        return [(e.id, self._event_fields(r, e, subject)) for e in subject.spec.events]

    def _landings_bound(
        self, events: Sequence[EventRequirement], bound: Mapping[str, str]
    ) -> dict[str, str]:
        """Bind landings without a cause to the end of the missions, where no event tells them."""
        told = {e.id for e in self._subject.spec.events if getattr(e.action, 'do', '') == 'land'}
        found: dict[str, str] = {}
        for r in events:
            lands = r.trigger is None and r.action is not None and r.action.do == 'land'
            if not lands or bound.get(r.ref) in told or r.action is None or r.action.uav is None:
                continue
            flyers = self._subject.binding.of(r.action.uav)
            if len(flyers) == 1:
                found[r.ref] = landing_of(next(iter(flyers)))
        return found

    def _rule(self, r: Requirement) -> NumberRule:
        return NumberRule(requirement=r, variation=self._prompt.variation)

    def _fields(self, r: Requirement) -> tuple[Fields, str]:
        """Return the fields and the equivalence by which they hold, if it takes one."""
        if isinstance(r, AnyOfRequirement):
            readings = [self._fields(one) for one in r.any_of if one.id not in self._beyond]
            # Rather the reading that holds wholly, else the one that holds most of its fields.
            return max(readings, key=lambda f: (all(f[0].values()), _share(f[0]), not f[1]))
        fields = {**self._plain_fields(r), **unread_fields(r)}
        form = ''
        if self._is_fair and not all(fields.values()) and not unread_fields(r):
            form = in_another_form(self._case(r, self._subject))
            fields = dict.fromkeys(fields, True) if form else fields
        return ({'absent': not all(fields.values())}, '') if r.negate else (fields, form)

    def _plain_fields(self, r: Requirement) -> Fields:
        subject, rule = self._subject, self._rule(r)
        if isinstance(r, WorldRequirement):
            return world_fields(r, subject, rule)
        if isinstance(r, AgentRequirement):
            return agent_fields(r, subject)
        if isinstance(r, UavRequirement):
            return uav_fields(r, subject)
        if isinstance(r, PlacementRequirement):
            return placement_fields(r, subject, rule)
        if isinstance(r, BehaviorRequirement):
            return behavior_fields(r, subject, rule)
        if isinstance(r, LinkRequirement):
            return link_fields(r, subject, rule)
        if isinstance(r, ConditionRequirement):
            return condition_fields(r, subject, rule)
        if isinstance(r, CountRequirement):
            return count_fields(r, subject, rule)
        if isinstance(r, OrderRequirement):
            return order_fields(r, subject, rule)
        if isinstance(r, MissionRequirement):
            return self._mission(r, rule)
        if isinstance(r, EventRequirement):
            return self._event(r, rule)
        if isinstance(r, RejectRequirement):
            return {'because': r.because in self._answer.reasons}
        return {}  # a kind that the format has and the scorer not: see `unread_fields`

    def _mission(self, r: MissionRequirement, rule: NumberRule) -> Fields:
        subject, names = self._subject, mission_names(r)
        missions = subject.spec.missions
        flyers = subject.binding.of(r.uav)
        if len(flyers) > 1:
            each = [[m for m in missions if m.uav == flyer] for flyer in sorted(flyers)]
        elif r in self._prompt.requirements:
            bound = subject.binding.moments.get(r.ref)
            each = [[m for m in missions if m.id == bound]]
        else:  # one of several readings: it may share its mission with another requirement
            each = [list(missions)]
        return for_all(
            [best((mission_fields(r, m, subject, rule) for m in own), names) for own in each],
            names,
        )

    def _event(self, r: EventRequirement, rule: NumberRule) -> Fields:
        subject = self._subject
        bound = subject.binding.moments.get(r.ref)
        is_own = r in self._prompt.requirements
        events = [e for e in subject.spec.events if not is_own or e.id == bound]
        held = [event_fields(r, e, subject, rule) for e in events]
        return best([*held, *implied_event_fields(r, subject, rule)], event_names(r))


def _share(fields: Fields) -> float:
    return sum(fields.values()) / len(fields)


def _worth(fields: Fields) -> int:
    return _WHOLE * (bool(fields) and all(fields.values())) + sum(fields.values())


def _assigned(held: Sequence[Sequence[Fields]]) -> list[tuple[int, int]]:
    """Return the pairs of the assignment in which most requirements, then fields, hold."""
    if not held or not held[0]:
        return []
    worth = np.array([[_worth(fields) for fields in row] for row in held])
    rows, columns = linear_sum_assignment(worth, maximize=True)
    return [(int(k), int(n)) for k, n in zip(rows, columns, strict=True) if worth[k, n] > 0]
