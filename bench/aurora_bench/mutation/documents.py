# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Alterations of what a trace is judged with: conditions, request, bodies, world."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from random import Random
from typing import Any

from aurora_bench.mutation.mutant import Mutant, mutant
from aurora_bench.mutation.recording import Recording
from aurora_core.agsg.build import build_agsg
from aurora_core.judging.codec import conditions_from_json
from aurora_core.knowledge.basis import Basis
from aurora_core.knowledge.limits import Limits
from aurora_core.knowledge.world import WorldModel
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.condition import conditions_to_json
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.spec.scenario import ScenarioSpec

_CONDITION, _ROSTER, _WORLD = 'finding:condition', 'finding:roster', 'finding:world'
_CONFIGURATION = 'finding:configuration'
# A request that changes shows in its conditions, or in claims that do not fit it any more, or
# leaves conditions about what it does not have, which are refused.
_REQUEST = (_CONDITION, 'finding:event', 'finding:message', 'refused')
# Of a link only what is asked of it shows in a condition, and chance has no single value.
_NOT_ASKED = frozenset({'loss', 'retransmissions', 'retransmission_interval_s', 'range_m'})

# The number in a formula that a signal is compared with.
_BOUND = re.compile(r'([<>]=? *)-?[\d.]+(?:e[+-]?\d+)?')

Rows = list[dict[str, Any]]


def document_mutants(base: Recording, random: Random) -> Iterator[Mutant]:
    """Yield alterations of each document, its digest in order again."""
    yield from _conditions(base, random)
    yield from _request(base, random)
    yield from _bodies(base, random)
    yield from _world(base, random)
    yield from _configuration(base, random)


def graph(
    base: Recording,
    spec: ScenarioSpec | None = None,
    conditions_json: str | None = None,
    grounding_json: str | None = None,
) -> Agsg:
    """Return the graph of other documents, derived as the stages derive it."""
    agsg = base.agsg
    grounding = agsg.grounding
    if grounding_json is not None:
        grounding = GroundedScenario.model_validate_json(grounding_json)
    return build_agsg(
        agsg.spec if spec is None else spec,
        map_digest=agsg.map_digest if grounding is None else grounding.map_digest,
        stage=agsg.stage,
        iteration=agsg.iteration,
        grounding=grounding,
        schedule=agsg.schedule,
        conditions=agsg.conditions
        if conditions_json is None
        else conditions_from_json(conditions_json),
    )


def _conditions(base: Recording, random: Random) -> Iterator[Mutant]:
    rows: Rows = json.loads(base.world.conditions_json)

    def forged(name: str, altered: Rows) -> Mutant:
        text = conditions_to_json(conditions_from_json(json.dumps(altered)))
        world = replace(base.world, conditions_json=text)
        agsg = graph(base, conditions_json=text)
        return mutant('condition altered', name, base, {_CONDITION}, world=world, agsg=agsg)

    for k in random.sample(range(len(rows)), 4):
        row = rows[k]
        others = [*rows[:k], *rows[k + 1 :]]
        yield forged(f'{row["id"]} removed', others)
        yield forged(f'{row["id"]} laxer', [*rows[:k], _laxer(row), *rows[k + 1 :]])
    k = random.randrange(len(rows))
    other = rows[k] | {'id': f'{rows[k]["id"]}.more'}
    yield forged(f'{other["id"]} added', [*rows, other])
    sooner = [row | {'arguments': row['arguments'] | {'horizon_s': 1.0}} for row in rows]
    yield forged('horizon of 1 s', sooner)
    yield forged('all removed but one', rows[:1])
    # In one place only: the graph and the world tell different things.
    text = conditions_to_json(conditions_from_json(json.dumps(rows[1:])))
    yield mutant(
        'condition altered',
        f'{rows[0]["id"]} removed from the world only',
        base,
        {_CONDITION},
        world=replace(base.world, conditions_json=text),
    )


def _laxer(row: dict[str, Any]) -> dict[str, Any]:
    """Return a condition that is easier to meet, with the formula that says so."""
    off = 10.0 * (1.0 + abs(row['threshold']))
    easier = row['threshold'] + (off if row['op'] in ('<=', '<') else -off)
    if row['op'] == '==':
        return row | {'tolerance': off, 'threshold': row['threshold'] + 1.0}
    formula = _BOUND.sub(rf'\g<1>{easier:.1f}', row['formula'])
    return row | {'threshold': easier, 'formula': formula}


def _request(base: Recording, random: Random) -> Iterator[Mutant]:
    document = base.agsg.spec.model_dump(mode='json')

    def forged(name: str, altered: dict[str, Any]) -> Mutant:
        spec = ScenarioSpec.model_validate_json(json.dumps(altered))
        return mutant('request altered', name, base, _REQUEST, agsg=graph(base, spec))

    paths = list(_stated(document, ()))
    for path in random.sample(paths, min(3, len(paths))):
        altered = json.loads(json.dumps(document))
        parameter: Any = altered
        for key in path:
            parameter = parameter[key]
        factor = 1.3 if parameter['value'] * 1.3 <= parameter['high'] else 0.7
        parameter['value'] *= factor
        yield forged(f'{"/".join(map(str, path))} times {factor}', altered)
    if document['events']:
        yield forged('without events', document | {'events': [], 'links': []})
    fewer = [a for a in document['agents'] if a['role'] == 'background'][:1]
    if fewer:
        kept = [a for a in document['agents'] if a is not fewer[0]]
        yield forged(f'without {fewer[0]["id"]}', document | {'agents': kept})


def _stated(value: Any, path: tuple[str | int, ...]) -> Iterator[tuple[str | int, ...]]:
    """Yield the paths of the numbers that the prompt states and that conditions quote."""
    if isinstance(value, dict):
        if value.get('provenance') == 'explicit' and 'low' in value:
            if path[-1] not in _NOT_ASKED:
                yield path
            return
        for name, item in value.items():
            yield from _stated(item, (*path, name))
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from _stated(item, (*path, index))


def _bodies(base: Recording, random: Random) -> Iterator[Mutant]:
    roster = base.trace.roster
    cases = [('time step halved', replace(roster, dt_s=roster.dt_s / 2.0))]
    uav = replace(roster.uavs[0], length_m=0.01, width_m=0.01)
    cases.append((f'{uav.body_id} made small', replace(roster, uavs=(uav, *roster.uavs[1:]))))
    if roster.agents:
        row = random.randrange(len(roster.agents))
        agent = roster.agents[row]
        for name, other in (
            ('made small', replace(agent, length_m=0.1, width_m=0.1)),
            ('made flat', replace(agent, height_m=0.1)),
            ('called a person', replace(agent, is_person=not agent.is_person)),
            ('on another route', replace(agent, route_edges=agent.route_edges[1:])),
        ):
            agents = (*roster.agents[:row], other, *roster.agents[row + 1 :])
            cases.append((f'{agent.body_id} {name}', replace(roster, agents=agents)))
    for name, altered in cases:
        trace = replace(base.trace, roster=altered)
        yield mutant('roster altered', name, base, {_ROSTER}, trace=trace)


def _world(base: Recording, random: Random) -> Iterator[Mutant]:
    world = base.world
    index = random.randrange(len(world.buildings))
    house = world.buildings[index]
    rest = (*world.buildings[:index], *world.buildings[index + 1 :])
    low = replace(house, height_m=0.5 * house.height_m)
    x, y = base.trace.ground[0, 0, :2].tolist() if base.trace.roster.agents else (0.0, 0.0)
    ring = ((x + 50.0, y), (x + 60.0, y), (x + 60.0, y + 10.0), (x + 50.0, y + 10.0))
    more = replace(house, id='forged', ring=ring, holes=())
    laxer = dict(world.limits) | {'clearance_min_m': 0.1}
    cases: list[tuple[str, Callable[[WorldModel], WorldModel]]] = [
        (f'building {house.id} removed', lambda w: replace(w, buildings=rest)),
        (f'building {house.id} lowered', lambda w: replace(w, buildings=(low, *rest))),
        ('building added', lambda w: replace(w, buildings=(*w.buildings, more))),
        ('every building removed', lambda w: replace(w, buildings=())),
        ('weather', lambda w: replace(w, weather='fog')),
        ('another map digest', lambda w: replace(w, map_digest='0' * 64)),
        ('limits laxer', lambda w: replace(w, limits=Limits.model_validate(laxer))),
        ('carriageways removed', lambda w: replace(w, surfaces=w.surfaces[1:])),
        ('no-fly zones removed', lambda w: replace(w, no_fly_zones=w.no_fly_zones[1:])),
    ]
    for name, alter in cases:
        altered = alter(world)
        if altered.no_fly_zones != world.no_fly_zones or name != 'no-fly zones removed':
            yield mutant('world altered', name, base, {_WORLD}, world=altered)


def _configuration(base: Recording, random: Random) -> Iterator[Mutant]:
    """Pretend that it was recorded with something that nobody here can compare with."""
    kind = 'configuration altered'
    document: dict[str, Any] = json.loads(base.agsg.texts.grounding)
    rows: Rows = json.loads(base.world.conditions_json)
    kept = random.sample(rows, len(rows) // 2)
    fewer = conditions_to_json(conditions_from_json(json.dumps(kept)))
    basis: dict[str, Any] = document['basis']
    laxer = {**basis['tolerances'], 'tracked_fraction': 0.01, 'stop_speed_mps': 30.0}
    lower = {**basis['limits'], 'clearance_min_m': 0.1}
    cases: list[tuple[str, dict[str, Any]]] = [
        ('foreign digest', {'configuration': 'f' * 64}),
        ('nothing told', {'basis': None, 'configuration': ''}),
        ('of another version', _of({**basis, 'version': '0.0.1'})),
        ('of unknown entries', _of({**basis, 'limits': {'of_tomorrow': 1.0}})),
        ('tolerances laxer', _of({**basis, 'tolerances': laxer})),
        ('limits laxer', _of({**basis, 'limits': lower})),
    ]
    for name, changes in cases:
        agsg = graph(base, None, fewer, _grounding({**document, **changes}))
        world = replace(base.world, conditions_json=fewer)
        whole = f'{name}, half of the conditions removed'
        yield mutant(
            'configuration altered', whole, base, {_CONFIGURATION}, world=world, agsg=agsg
        )
        agsg = graph(base, None, None, _grounding({**document, **changes}))
        yield mutant('configuration altered', name, base, {_CONFIGURATION}, agsg=agsg)
    elsewhere = {'map_digest': '0' * 64}
    agsg = graph(base, None, None, _grounding({**document, **elsewhere}))
    world = replace(base.world, map_digest='0' * 64, buildings=())
    name = 'of another map, every building removed'
    yield mutant(kind, name, base, {_CONFIGURATION}, world=world, agsg=agsg)


def _of(basis: dict[str, Any]) -> dict[str, Any]:
    return {'basis': basis, 'configuration': Basis.model_validate(basis).sha256}


def _grounding(document: dict[str, Any]) -> str:
    return GroundedScenario.model_validate_json(json.dumps(document)).canonical_json()
