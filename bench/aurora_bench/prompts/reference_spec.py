# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.prompts.reference_spec FILE…`: write the reference specifications.

A reference says what the annotation says, and nothing of the parser is in it: every requirement
becomes one element, what is not annotated has the product's default. Those that are written into
files have no spans, so no value is explicit; stated ones have a domain of one point, or the
annotated range. Those that are run (`judged`) call every annotated number explicit: else nothing
would ask of the run that the number is kept.
"""

from __future__ import annotations

import argparse
import itertools
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import get_args

from pydantic import ValidationError

from aurora_bench.prompts.documents import Doc, read_documents, write_documents
from aurora_bench.prompts.format import (
    Action,
    AgentRequirement,
    AnnotatedPrompt,
    EventRequirement,
    Requirement,
    UavRequirement,
    WorldRequirement,
)
from aurora_bench.prompts.reference_names import Names, NotExpressibleError, id_of
from aurora_bench.prompts.reference_parts import (
    Numbers,
    behavior,
    behaviors,
    condition,
    default_link,
    event,
    hearers,
    is_a_message_at_no_time,
    kept_off,
    link,
    mission,
    placement,
)
from aurora_bench.prompts.reference_sayable import check_sayable
from aurora_bench.prompts.reference_spans import StatedSpans
from aurora_core.spec.events import AgentDo
from aurora_core.spec.parameter import unit_of
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import AgentType

_MOST_READINGS = 64
# Fields of the world that are numbers.
WORLD_NUMBERS = frozenset({'duration_s', 'wind_mps', 'gust_mps', 'wind_from_deg'})


def reference_spec(prompt: AnnotatedPrompt, *, judged: bool = False) -> ScenarioSpec:
    """Return a specification that says what a prompt's annotation says.

    Of several readings the first is taken that the schema can express together with the rest.
    What is `beyond` every field is left out.

    Args:
        prompt: With its annotation.
        judged: Annotated numbers are explicit, with the span that states them, and one clause
            over the whole prompt names every element: conditions and report treat the reference
            as they treat a prompt that was read.

    Raises:
        NotExpressibleError: None can be expressed, or the prompt is to be refused.
    """
    if prompt.feasibility == 'infeasible':
        raise NotExpressibleError('a refusal has no specification')
    asked = [r for r in prompt.requirements if r.kind != 'beyond']
    choices = [r.any_of if r.kind == 'any_of' else (r,) for r in asked]
    reason = ''
    for readings in itertools.islice(itertools.product(*choices), _MOST_READINGS):
        try:
            return ScenarioSpec.model_validate(_Builder(prompt, readings, judged).document())
        except ValidationError as err:
            reason = reason or str(err.errors()[0]['msg'])
        except NotExpressibleError as err:
            reason = reason or str(err)
    raise NotExpressibleError(reason)


class _Builder:
    def __init__(
        self, prompt: AnnotatedPrompt, requirements: Sequence[Requirement], judged: bool
    ) -> None:
        self._prompt = prompt
        self._spans = StatedSpans(prompt.prompt) if judged else None
        self._requirements = requirements
        self._names = Names(requirements)
        self._agents: dict[str, Doc] = {}
        self._taken_over: list[Doc] = []
        self._spec: Doc = {
            'prompt': prompt.prompt, 'world': {}, 'uavs': [], 'missions': [], 'links': [],
            'events': [], 'conditions': [], 'orders': [], 'counts': [], 'prohibitions': [],
        }  # fmt: skip

    def document(self) -> Doc:
        """Return the specification as a document, bodies first: the others name them."""
        for r in self._requirements:
            check_sayable(r)
            if isinstance(r, AgentRequirement | UavRequirement):
                self._body(r)
        if self._names.undeclared_rsu:
            lists: Doc = {'placements': [], 'behaviors': []}
            self._agents['rsu'] = {'id': 'rsu', 'type': AgentType.RSU, **lists}
        for r in self._requirements:
            if r.negate:
                self._prohibit(r)
            else:
                self._add(r)
        # What a UAV takes over comes after what it does until then.
        self._spec['missions'] += self._taken_over
        self._link_messages()
        document = {**self._spec, 'agents': list(self._agents.values())}
        return document if self._spans is None else document | {'clauses': [self._clause()]}

    def _clause(self) -> Doc:
        """Return the whole prompt as one clause that became every element."""
        prompt = self._prompt.prompt
        elements = [e for part in self._spec.values() if isinstance(part, list) for e in part]
        return {
            'text': prompt, 'span': {'start': 0, 'end': len(prompt)}, 'status': 'encoded',
            'ids': sorted({*self._agents, *(e['id'] for e in elements)}),
        }  # fmt: skip

    def _numbers(self, r: Requirement) -> Numbers:
        return Numbers(r, self._prompt.variation, self._spans)

    def _link_messages(self) -> None:
        """Give every message that no annotated link carries a default one."""
        linked = {(found['sender'], found['receiver']) for found in self._spec['links']}
        for found in self._spec['events']:
            action = found.get('action', {})
            ends = (action.get('sender'), action.get('receiver'))
            if action.get('do') == 'send_message' and ends not in linked:
                linked.add(ends)
                self._spec['links'].append(default_link(self._new('link'), *ends))

    def _body(self, r: AgentRequirement | UavRequirement) -> None:
        if r.count == 0 or r.negate:
            what = r.type.value if isinstance(r, AgentRequirement) else 'uav'
            self._spec['prohibitions'].append(
                {'forbids': 'agent', 'id': self._new('no'), 'type': what}
            )
            return
        group = {'group': f'{id_of(r.ref)}_all'} if r.count > 1 else {}
        for ident in self._names.all(r.ref):
            if isinstance(r, UavRequirement):
                self._spec['uavs'].append({'id': ident, **group})
            else:
                role = {'role': r.role} if r.role is not None else {}
                lists: Doc = {'placements': [], 'behaviors': []}
                self._agents[ident] = {'id': ident, 'type': r.type, **role, **group, **lists}

    def _add(self, r: Requirement) -> None:
        numbers = self._numbers(r)
        names = self._names
        if r.kind == 'world':
            self._world(r, numbers)
        elif r.kind == 'placement':
            for ident in self._members(r.agent):
                self._agents[ident]['placements'].append(placement(r, names, numbers))
        elif r.kind == 'behavior':
            for ident in self._members(r.agent):
                self._agents[ident]['behaviors'] += behaviors(r, names, numbers)
        elif r.kind == 'mission':
            flyers = names.all(r.uav)
            if not set(flyers) <= set(names.uavs):
                raise NotExpressibleError(f'{r.uav!r} is no UAV')
            for k, uav in enumerate(flyers):
                ident = id_of(r.ref) if k == 0 else f'{id_of(r.ref)}_{k + 1}'
                self._spec['missions'].append(mission(r, ident, uav, names, numbers))
                for place in r.avoid or ():
                    kept = kept_off(r, place, self._new('condition'), uav, names, numbers)
                    self._spec['conditions'].append(kept)
        elif r.kind == 'link':
            first = link(r, self._new('link'), names, numbers)
            self._spec['links'].append(first)
            for other in hearers(r, names, numbers):
                more = {**first, 'id': self._new('link'), 'receiver': other}
                self._spec['links'].append(more)
        elif r.kind == 'event' and r.action is not None and r.action.do == 'hand_over':
            self._hand_over(r, r.action, numbers)
        elif r.kind == 'event':
            found = event(r, names, numbers)
            self._spec['events'] += [found, *self._for_the_others(r, found)]
            if r.action is not None and r.action.do == 'change_mission':
                ident, uav = found['action']['mission'], found['action']['uav']
                self._spec['missions'].append(mission(r.action, ident, uav, names, numbers))
        elif r.kind == 'count':
            counted = {'id': self._new('count'), 'kind': r.type, **numbers.of(r, ('value',))}
            self._spec['counts'].append(counted)
        elif r.kind == 'order':
            self._spec['orders'].append(
                {
                    'id': self._new('order'), 'first': names.moment(r.first),
                    'then': names.moment(r.then), **numbers.of(r, ('within_s',)),
                }
            )  # fmt: skip
        elif r.kind == 'condition':
            found = condition(r, self._new('condition'), names, numbers)
            self._spec['conditions'].append(found)

    def _hand_over(self, r: EventRequirement, action: Action, numbers: Numbers) -> None:
        """Let the other UAV track what the first one tracks, which then lands."""
        names = self._names
        tracks = [
            m
            for m in self._requirements
            if m.kind == 'mission' and m.mode == 'track' and m.uav == action.uav
        ]
        if not tracks or action.to is None:
            raise NotExpressibleError('a hand-over of what nobody tracks')
        ident = id_of(r.ref)
        over = action.model_copy(
            update={'do': 'change_mission', 'uav': action.to, 'target': tracks[-1].target}
        )
        leaves: Doc = {'do': 'land', 'uav': names.uav(action.uav)}
        found = event(r.model_copy(update={'action': over}), names, numbers)
        done = {'on': 'event_done', 'event': ident}
        self._spec['events'] += [found, {'id': f'{ident}_left', 'trigger': done, 'action': leaves}]
        uav = found['action']['uav']
        self._taken_over.append(mission(over, found['action']['mission'], uav, names, numbers))

    def _for_the_others(self, r: EventRequirement, first: Doc) -> Iterator[Doc]:
        """Yield the event of each further member of a group that acts, or that is told."""
        told = None if r.action is None or r.action.do != 'send_message' else r.action.receiver
        agent = None if r.action is None else r.action.agent
        # Stored references stay as they are; of those that run nothing may be left out.
        members: tuple[str, ...] = ()
        if self._spans is not None and told is not None:
            members = self._names.all(told)
        elif self._spans is not None and agent is not None:
            members = self._members(agent)
        for k, ident in enumerate(members[1:], start=2):
            action = {**first['action'], ('agent' if told is None else 'receiver'): ident}
            yield {**first, 'id': f'{first["id"]}_{k}', 'action': action}

    def _world(self, r: WorldRequirement, numbers: Numbers) -> None:
        if r.field in WORLD_NUMBERS:
            number = numbers.stated('value', float(r.value), unit_of(r.field).value)
            self._spec['world'][r.field] = number
        else:
            self._spec['world']['map_name' if r.field == 'map' else r.field] = r.value

    def _prohibit(self, r: Requirement) -> None:
        """Forbid what must not be so, for the kinds that prompts forbid."""
        numbers = self._numbers(r)
        found: Doc = {'forbids': r.kind, 'id': self._new('no')}
        if r.kind == 'world' and r.field not in WORLD_NUMBERS:
            found['map_name' if r.field == 'map' else r.field] = r.value
        elif r.kind == 'placement':
            agent = self._names.agent(r.agent)
            found |= {'agent': agent, **placement(r, self._names, numbers)}
        elif r.kind == 'behavior':
            agent = self._names.agent(r.agent)
            found |= {'agent': agent, **behavior(r, self._names, numbers)}
        elif r.kind == 'mission':
            found |= {'uav': self._names.uav(r.uav), 'mode': r.mode}
            found['target'] = self._names.one(r.target)
        elif r.kind == 'event' and r.action is not None and r.action.do in get_args(AgentDo):
            found |= event(r, self._names, numbers)
        elif r.kind == 'event' and is_a_message_at_no_time(r):
            sent = event(r, self._names, numbers)['action']
            found |= {'forbids': 'link', 'sender': sent['sender'], 'receiver': sent['receiver']}
        elif not isinstance(r, AgentRequirement | UavRequirement):
            raise NotExpressibleError(f'{r.id} forbids a {r.kind}')
        if not isinstance(r, AgentRequirement | UavRequirement):
            self._spec['prohibitions'].append(found)

    def _members(self, ref: str) -> tuple[str, ...]:
        members = self._names.all(ref)
        if not set(members) <= self._agents.keys():
            raise NotExpressibleError(f'{ref!r} is no ground agent')
        return members

    def _new(self, stem: str) -> str:
        elements = [e for part in self._spec.values() if isinstance(part, list) for e in part]
        taken = {*self._names.moments, *self._agents, *(e['id'] for e in elements)}
        return next(f'{stem}{k}' for k in itertools.count(1) if f'{stem}{k}' not in taken)


def main(arguments: Sequence[str] | None = None) -> int:
    """Give every prompt of the files its reference, or none; print those without, and why."""
    parser = argparse.ArgumentParser(prog='aurora_bench.prompts.reference_spec')
    parser.add_argument('files', nargs='+', type=Path, metavar='FILE')
    for path in parser.parse_args(arguments).files:
        documents = read_documents(path)
        for document in documents:
            document.pop('reference', None)
            prompt = AnnotatedPrompt.model_validate(document)
            try:
                spec = reference_spec(prompt)
            except NotExpressibleError as err:
                if prompt.feasibility != 'infeasible':
                    sys.stdout.write(f'{prompt.id}: {err}\n')
                continue
            document['reference'] = spec.model_dump(mode='json', exclude_defaults=True)
        write_documents(path, documents)
    return 0


if __name__ == '__main__':
    sys.exit(main())
