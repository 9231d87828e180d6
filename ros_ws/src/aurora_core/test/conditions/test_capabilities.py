# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What nobody carries out is named, and not judged: the run is incomplete, not violated."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from aurora_core.conditions.capabilities import judgeable, unsupported
from aurora_core.conditions.derive import derive_conditions
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.temporal.schedule import plan_time

MAP = 'junction'


class Scene:
    """The tailgating prompt, grounded; `with_` changes what is asked afterwards."""

    def __init__(
        self, spec: ScenarioSpec, found: GroundedScenario, limits: Limits, tolerances: Tolerances
    ) -> None:
        self.spec = spec
        self.found = found
        self._limits = limits
        self._tolerances = tolerances

    def missing(self) -> tuple[str, ...]:
        return unsupported(self.spec, self.found)

    def judged(self) -> set[str]:
        facts = plan_time(self.spec, self.found, self._limits, self._tolerances).facts
        derived = derive_conditions(self.spec, facts, self._limits, self._tolerances)
        return {c.id for c in judgeable(derived.conditions, self.spec, self.found)}

    def with_(self, **values: Any) -> Scene:
        spec = ScenarioSpec.model_validate({**self.spec.model_dump(), **values})
        return Scene(spec, self.found, self._limits, self._tolerances)

    def with_van(self, **values: Any) -> Scene:
        agents = [a.model_dump() | (values if a.id == 'van1' else {}) for a in self.spec.agents]
        return self.with_(agents=agents)


@pytest.fixture
def scene(
    read_prompt: Callable[..., ScenarioSpec],
    ground: Callable[..., GroundedScenario],
    limits: Limits,
    tolerances: Tolerances,
) -> Scene:
    spec = read_prompt('tailgate', MAP)
    return Scene(spec, ground(spec, MAP), limits, tolerances)


def test_of_what_is_carried_out_nothing_is_missing(scene: Scene) -> None:
    assert scene.missing() == ()
    assert {'van1.tailgate', 'e1.within', 'm1.tracked'} <= scene.judged()


@pytest.mark.parametrize('kind', ['slow', 'yield', 'change_lane'])
def test_a_behaviour_that_is_one_action(scene: Scene, kind: str) -> None:
    asked = scene.with_van(behaviors=[{'kind': kind, 'target': 'ego'}])
    assert asked.missing() == ()
    assert f'van1.{kind}' in asked.judged()


@pytest.mark.parametrize(
    ('kind', 'target'), [('cross', 'ego'), ('walk', None), ('yield', 'crosswalk')]
)
def test_a_behaviour_that_nobody_shows(scene: Scene, kind: str, target: str | None) -> None:
    asked = scene.with_van(behaviors=[{'kind': kind, 'target': target}])
    assert asked.missing() == (f'van1: behaviour {kind}',)
    assert not {i for i in asked.judged() if i.startswith(f'van1.{kind}')}


@pytest.mark.parametrize('do', ['cross'])
def test_an_action_that_nobody_takes(scene: Scene, do: str) -> None:
    (event,) = (e.model_dump() for e in scene.spec.events)
    action = {'do': do, 'agent': 'van1'}
    waits = {
        'id': 'e2',
        'trigger': {'on': 'event_done', 'event': event['id']},
        'action': {'do': 'brake', 'agent': 'ego'},
    }
    asked = scene.with_(events=[event | {'action': action}, waits])
    assert asked.missing() == (
        f'{event["id"]}: action {do}',
        f'e2: waits for {event["id"]}, which nobody carries out',
    )
    assert not {i for i in asked.judged() if i.split('.')[0] in (event['id'], 'e2')}
    # Nor is it passed over where nobody says when.
    open_ = scene.with_(events=[event | {'action': action, 'trigger': None}])
    assert open_.missing() == (f'{event["id"]}: action {do}',)


@pytest.mark.parametrize(
    ('who', 'missing'), [('van', ()), ('bicycle', ('e1: action change_lane',))]
)
def test_a_change_of_lane_is_for_who_drives_in_lanes(
    scene: Scene, who: str, missing: tuple[str, ...]
) -> None:
    (event,) = (e.model_dump() for e in scene.spec.events)
    asked = scene.with_(
        agents=[
            a.model_dump() | ({'type': who} if a.id == 'van1' else {}) for a in scene.spec.agents
        ],
        events=[event | {'id': 'e1', 'action': {'do': 'change_lane', 'agent': 'van1'}}],
    )
    assert asked.missing() == missing


def test_who_waits_for_a_message_that_is_never_sent(scene: Scene) -> None:
    (warning,) = (e.model_dump() for e in scene.spec.events)
    changes = {
        'id': 'e2',
        'trigger': {'on': 'time', 'at_s': warning['trigger']['value_m'] | {'unit': 's'}},
        'action': {'do': 'cross', 'agent': 'van1'},
    }
    warning |= {'trigger': {'on': 'event_done', 'event': 'e2'}}
    brakes = {
        'id': 'e3',
        'trigger': {'on': 'message_received', 'by': 'ego', 'sender': 'uav1'},
        'action': {'do': 'brake', 'agent': 'ego'},
    }
    asked = scene.with_(events=[warning, changes, brakes])
    assert asked.missing() == (
        'e2: action cross',
        f'{warning["id"]}: waits for e2, which nobody carries out',
        f'e3: waits for {warning["id"]}, which nobody carries out',
    )
    assert not {i for i in asked.judged() if i.split('.')[0] in ('e2', 'e3', warning['id'])}


@pytest.mark.parametrize(
    ('relation', 'of', 'judged'),
    [
        ('behind', 'ego', True),
        ('adjacent_lane', 'ego', True),
        ('before', 'ego', True),
        ('on', 'main_road', True),
        ('on', 'crosswalk', False),
        ('parked_at', 'roadside', True),
        ('before', 'intersection', True),
        ('at', 'intersection', True),
        ('near', 'landmark:City Hall', True),
        ('beside', 'landmark:City Hall', True),
        ('oncoming', 'ego', True),
    ],
)
def test_a_placement_is_judged_where_it_is_realised(
    scene: Scene, relation: str, of: str, judged: bool
) -> None:
    asked = scene.with_van(placements=[{'relation': relation, 'of': of}])
    assert ('van1.placed' in asked.judged()) is judged


def test_what_grounding_lacks_comes_first(scene: Scene) -> None:
    found = scene.found.model_copy(update={'unsupported': ('p1: pedestrians',)})
    assert unsupported(scene.spec, found) == ('p1: pedestrians',)


@pytest.mark.parametrize(
    ('trigger', 'asked'),
    [('mission_done', {'e9.altitude'}), ('altitude_reached', {'e9.altitude', 'e9.completed'})],
)
def test_a_climb_is_judged_during_the_missions_and_after_them(
    scene: Scene, trigger: str, asked: set[str], parameter: Callable[..., Any]
) -> None:
    more = {'value_m': parameter(20.0).model_dump()} if trigger == 'altitude_reached' else {}
    climb = {
        'id': 'e9',
        'trigger': {'on': trigger, 'uav': 'uav1', **more},
        'action': {'do': 'ascend', 'uav': 'uav1', 'altitude_m': parameter(60.0).model_dump()},
    }
    found = scene.with_(events=[climb])
    assert 'e9: action ascend' not in found.missing()
    assert {i for i in found.judged() if i.startswith('e9.')} == asked | {'e9.within'}


@pytest.mark.parametrize(('then', 'can'), [('return_home', False), ('land', True)])
def test_nobody_flies_on_after_a_landing(scene: Scene, then: str, can: bool) -> None:
    lands = {
        'id': 'e8',
        'trigger': {'on': 'mission_done', 'uav': 'uav1'},
        'action': {'do': 'land', 'uav': 'uav1'},
    }
    flies = {
        'id': 'e9',
        'trigger': {'on': 'event_done', 'event': 'e8'},
        'action': {'do': then, 'uav': 'uav1'},
    }
    found = scene.with_(events=[lands, flies])
    assert ('e9: a flight after a landing' not in found.missing()) is can
