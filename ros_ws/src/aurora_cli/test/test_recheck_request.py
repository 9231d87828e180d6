# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every proof that the checker issues is checked again, and a forged one is refuted."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from aurora_core.feasibility.times import check_times
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import load_limits, load_tolerances
from aurora_core.knowledge.map_model import load_map
from aurora_core.outcomes.feasibility import Certificate, Rule
from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline
from aurora_core.recheck import recheck
from aurora_core.spec.scenario import ScenarioSpec

Call = Callable[..., SimpleNamespace]

HALL = 'A drone hovers over City Hall'
RULES = (
    (Rule.LIMIT, 'A drone hovers at 500 m.'),
    (Rule.COUNT, 'Eleven drones hover over City Hall at 50 m.'),
    (Rule.SIGN, 'A drone flies a rectangle of 100 m by -5 m at 40 m altitude.'),
    (Rule.SENSING, 'In fog a drone hovers over the crosswalk at 95 m.'),
    (
        Rule.RADIO,
        'The UAV hovers 110 m above the ego car for 60 s and sends it a message at 40 s over a '
        'radio with a range of 80 m.',
    ),
    (Rule.CLOSENESS, 'Two drones hover over City Hall at 50 m and keep at most 3 m apart.'),
    (
        Rule.STACKING,
        'uav 1 hovers at 30 m over the intersection, uav 2 at 31 m, exactly above the first one',
    ),
    (Rule.FLIGHT_BAND, f'{HALL} at 50 m. It must stay above 80 m.'),
    (Rule.PURSUIT, 'A drone tracks a car that drives at 30 m/s.'),
    (Rule.AFAR, 'A drone tracks a bus. It has to stay at least 300 m away horizontally.'),
    (Rule.BATTERY, f'{HALL} for 900 s, then it hovers over Mercy Hospital for 700 s.'),
    (Rule.DEADLINE, f'{HALL} for 60 seconds at 30 m. It must be on the ground by 40 s.'),
    (Rule.HORIZON, 'A scenario of 20 seconds. The bus brakes at 30 s.'),
    (Rule.PLACEMENT, 'The van is 30 m ahead of the ego and 30 m behind the ego.'),
    (Rule.ZONE, 'A drone hovers over Signal Tower at 50 m.'),
    (Rule.HIDDEN, 'A drone hovers 90 m north of City Hall at 15 m for 20 seconds.'),
    (Rule.ROUND, 'A drone circles City Hall at a radius of 50 m at 30 m altitude for 60 seconds.'),
    (Rule.ROOF, f'{HALL} at 15 m.'),
    (
        Rule.BOUNDS,
        'A drone tracks a bus. The altitude of the drone always stays above 50 m. The altitude '
        'of the drone always stays below 30 m.',
    ),
    (Rule.STILL, f'{HALL} at 50 m. It never flies slower than 10 m/s.'),
    (
        Rule.WATCH,
        'The scenario lasts 60 seconds. A drone tracks a bus at 40 m. The bus has to be visible '
        'to the drone for at least 70 seconds.',
    ),
    (
        Rule.LATENCY,
        f'{HALL} at 40 m. At 30 s the drone sends a message to a bus over a link with a latency '
        'of 3 s, and the message must be delivered within 1 s.',
    ),
    (
        Rule.SCENE,
        'There are exactly 2 vehicles in the whole scene. A bus drives, a van drives, a truck '
        'drives, and a drone tracks the bus at 40 m.',
    ),
)
PROMPTS = dict(RULES)
MORE = (
    'The bus brakes at 30 s. The drone warns the ego after that, and the warning has to be '
    'received before 20 s.',
    f'{HALL} for 30 s and only then transmits a warning to the ego, which has to arrive no later '
    'than 10 s after the start of the scenario.',
    'Two drones fly 2 m apart over the main road at 80 m.',
    'The van keeps at least 400 m from the ego and warns it over a link of 150 m range.',
    'The bus starts when the van starts, and the van starts when the bus starts.',
    'A drone hovers at 500 meters altitude over the ego car.',
    'A bus drives at 45 m/s.',
    'At night in fog a UAV tracks a bus from a standoff of 80 m.',
    'A bus is 20 m ahead of the ego. The bus is 60 m ahead of the ego.',
    'The truck is ahead of the bus. The bus is ahead of the truck.',
    'A drone orbits Mercy Hospital at a radius of 100 m, 110 m above the ground.',
)


def _checked(call: Call, prompt: str) -> dict[str, Any]:
    document: dict[str, Any] = json.loads(call('check', prompt, '--json').out)
    assert document['feasibility']['certificates'], prompt
    return document


def _again(call: Call, folder: Path, document: dict[str, Any]) -> SimpleNamespace:
    file = folder / 'checked.json'
    file.write_text(json.dumps(document))
    return call('certificate', 'check', str(file))


@pytest.mark.parametrize('prompt', MORE)
def test_a_refusal_checks_again(here: Path, call: Call, prompt: str) -> None:
    again = _again(call, here, _checked(call, prompt))
    assert again.code == 0, again.out


@pytest.mark.parametrize('rule', PROMPTS)
def test_a_proof_by_every_rule_checks_again(here: Path, call: Call, rule: Rule) -> None:
    document = _checked(call, PROMPTS[rule])
    assert rule in {c.get('rule') for c in document['feasibility']['certificates']}
    again = _again(call, here, document)
    assert again.code == 0, again.out


def _ordered(*orders: tuple[str, str]) -> dict[str, Any]:
    """Return a request for e1 at 10 s and e2 at 30 s with orders, and what its times rule out."""
    context = ParseContext(landmark_names=())
    plain = parse_offline('The bus brakes at 10 s. The car stops at 30 s.', context).spec
    assert plain is not None
    asked = [{'id': f'o{k}', 'first': a, 'then': b} for k, (a, b) in enumerate(orders)]
    spec = ScenarioSpec.model_validate({**plain.model_dump(mode='json'), 'orders': asked})
    proofs = check_times(
        spec,
        load_limits(config_path('limits.json')),
        load_tolerances(config_path('tolerances.json')),
    )
    found = [proof.model_dump(mode='json') for proof in proofs]
    return {'spec': spec.model_dump(mode='json'), 'feasibility': {'certificates': found}}


@pytest.mark.parametrize('orders', [(('e2', 'e1'),), (('e1', 'e2'), ('e2', 'e1'))])
def test_orders_that_cannot_be_kept_are_followed_again(
    here: Path, call: Call, orders: tuple[tuple[str, str], ...]
) -> None:
    document = _ordered(*orders)
    proofs = document['feasibility']['certificates']
    assert {c['rule'] for c in proofs} == {Rule.ORDER}
    again = _again(call, here, document)
    assert again.code == 0, again.out
    for proof in proofs:
        for forged in _forged(proof):
            document['feasibility']['certificates'] = [forged]
            assert _again(call, here, document).code == 1, forged
    # The same proof beside a request whose order can be kept.
    document['spec']['orders'] = [
        {'id': c['path'].split('/')[1], 'first': 'e1', 'then': 'e2'} for c in proofs
    ]
    document['feasibility']['certificates'] = [{**c, 'facts': []} for c in proofs]
    assert _again(call, here, document).code == 1


def test_every_rule_has_its_test() -> None:
    # No wording gives a clearance from a wall: test_conflicts.py checks that as a specification.
    assert {*PROMPTS, Rule.ORDER, Rule.WALL} == set(Rule)


def _forged(proof: dict[str, Any]) -> list[dict[str, Any]]:
    """Return the proof with one thing changed: its path, a fact, the limit, the number."""
    forged = [{**proof, 'path': 'missions/m9/altitude_m'}]
    for k, fact in enumerate(proof.get('facts', ())):
        value = f'{fact["value"]}x' if isinstance(fact['value'], str) else fact['value'] + 7.0
        for change in ({'value': value}, {'path': f'{fact["path"]}/gone'}):
            facts = [*proof['facts']]
            facts[k] = {**fact, **change}
            forged.append({**proof, 'facts': facts})
    for name in ('limit', 'requested'):
        if proof[name] is not None:
            forged.append({**proof, name: proof[name] + 7.0})
    return forged


@pytest.mark.parametrize('rule', PROMPTS)
def test_a_forged_proof_is_refuted(here: Path, call: Call, rule: Rule) -> None:
    document = _checked(call, PROMPTS[rule])
    proofs = document['feasibility']['certificates']
    proof = next(c for c in proofs if c.get('rule') == rule)
    for forged in _forged(proof):
        document['feasibility']['certificates'] = [forged]
        again = _again(call, here, document)
        assert again.code == 1, (forged, again.out)


def test_what_cannot_be_checked_is_not_refuted(here: Path, call: Call) -> None:
    document = _checked(call, PROMPTS[Rule.ZONE])
    (proof,) = document['feasibility']['certificates']
    alone = _again(call, here, proof)
    assert alone.code == 4
    assert 'not checked: it rests on the specification' in alone.out
    del proof['rule']
    assert _again(call, here, document).code == 4


def test_a_specification_without_its_defaults_is_read_the_same(here: Path, call: Call) -> None:
    document = _checked(call, 'A bus is 20 m ahead of the ego. The bus is 60 m ahead of the ego.')
    whole = ScenarioSpec.model_validate(document['spec'])
    document['spec'] = whole.model_dump(mode='json', exclude_defaults=True) | {
        'missions': document['spec']['missions']
    }
    assert 'bound' not in json.dumps(document['spec']['agents'])
    again = _again(call, here, document)
    assert again.code == 0, again.out


NOT_PROVEN = (
    # The other one flies as well: 60 m and 40 m up they are within 30 m of each other.
    'Drone A hovers at 40 m over City Hall. Drone B tracks drone A at 60 m altitude and stays '
    'within 30 m of it.',
    # A moment is not all the time.
    f'{HALL} at 40 m for 20 s, then it hovers at 80 m over Harbor Market. It reaches at least '
    '70 m by 60 s.',
    # Two cars are no UAVs.
    'Two cars keep at most 3 m apart while a drone hovers at 40 m.',
    # It drives that fast for a part of the time only.
    'A drone tracks a car that drives at 30 m/s. After 10 s the car stops.',
)


@pytest.mark.parametrize('prompt', NOT_PROVEN)
def test_what_is_not_proven_is_not_refused(here: Path, call: Call, prompt: str) -> None:
    assert json.loads(call('check', prompt, '--json').out)['result'] != 'infeasible'


@pytest.mark.parametrize(
    ('rule', 'prompt'),
    [
        (Rule.FLIGHT_BAND, NOT_PROVEN[0]),
        (Rule.FLIGHT_BAND, NOT_PROVEN[1]),
        (Rule.CLOSENESS, NOT_PROVEN[2]),
        (Rule.PURSUIT, NOT_PROVEN[3]),
    ],
)
def test_a_proof_of_what_can_be_is_refuted(here: Path, rule: Rule, prompt: str) -> None:
    names = tuple(mark.name for mark in load_map('downtown').landmarks)
    spec = parse_offline(prompt, ParseContext(landmark_names=names)).spec
    assert spec is not None
    path = {
        Rule.FLIGHT_BAND: 'conditions/c1',
        Rule.CLOSENESS: 'conditions/c1/value',
        Rule.PURSUIT: 'missions/m1/target',
    }[rule]
    number = {Rule.CLOSENESS: 3.0, Rule.PURSUIT: 30.0}.get(rule)
    limit = {Rule.CLOSENESS: 5.0, Rule.PURSUIT: 18.0}.get(rule)
    forged = Certificate(
        kind='contradiction',
        reason='spatial_contradiction',
        path=path,
        requested=number,
        limit=limit,
        sentence='forged',
        rule=rule,
    )
    assert not recheck(forged, spec.model_dump(mode='json')).valid
