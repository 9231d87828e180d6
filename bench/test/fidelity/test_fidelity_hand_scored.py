# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The scorer agrees with a person on every pair of `hand_scored.yaml` and `equivalences.yaml`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from yaml_rows import rows_of

from aurora_bench.fidelity.answer import Answer
from aurora_bench.fidelity.equivalences import EQUIVALENCES
from aurora_bench.fidelity.score import PromptScore, score
from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_core.spec.requirements import STATED_QUANTITIES
from aurora_core.spec.scenario import ScenarioSpec

Doc = dict[str, Any]


def pairs_of(name: str) -> list[Doc]:
    """Return the pairs of a file beside this one."""
    return list(rows_of(Path(__file__).with_name(name)))


PAIRS = pairs_of('hand_scored.yaml')
FORMS = pairs_of('equivalences.yaml')
_NAMES = {'loss', 'retransmissions', 'waypoint_count'}
_UNITS = (('_mps', 'm/s'), ('_deg', 'deg'), ('_m', 'm'), ('_s', 's'))
# What the product puts where a request is silent.
_MISSION: Doc = {'altitude_m': 30}
_OF_MODE: dict[str, Doc] = {
    'hover': {'duration_s': 30},
    'track': {'duration_s': 30, 'standoff_m': 0},
    'navigate': {'speed_mps': 8},
}
_LINK: Doc = {
    'loss': 0, 'latency_s': 0.1, 'retransmissions': 3, 'retransmission_interval_s': 0.2,
}  # fmt: skip


def specification(document: Doc) -> ScenarioSpec:
    """Return a specification whose numbers are written plainly."""
    whole: Doc = {'prompt': 'any', **document}
    whole['missions'] = [
        {**_MISSION, **_OF_MODE[m['mode']], **m} for m in document.get('missions', [])
    ]
    whole['links'] = [{**_LINK, **link} for link in document.get('links', [])]
    return ScenarioSpec.model_validate(_with_parameters(whole))


def _with_parameters(value: Any, name: str = '', quantity: str = '') -> Any:
    unit = next((u for end, u in _UNITS if name.endswith(end)), '1')
    if name == 'value':
        unit = STATED_QUANTITIES[quantity].value
    if name in _NAMES or name == 'value' or name.endswith(tuple(end for end, _ in _UNITS)):
        given = value if isinstance(value, dict) else {'value': value}
        number = given['value']
        return {'unit': unit, 'low': number, 'high': number, 'provenance': 'inferred', **given}
    if isinstance(value, dict):
        of = str(value.get('quantity', ''))
        return {key: _with_parameters(item, key, of) for key, item in value.items()}
    return [_with_parameters(item) for item in value] if isinstance(value, list) else value


def test_there_are_forty_pairs_with_names_of_their_own() -> None:
    names = {pair['pair'] for pair in PAIRS}
    assert len(names) == len(PAIRS) >= 40


def scored(pair: Doc, *, is_fair: bool) -> PromptScore:
    """Return the score of a pair."""
    feasibility = pair.get('feasibility', 'feasible')
    prompt = AnnotatedPrompt.model_validate(
        {
            'id': 'pair-1',
            'category': 'infeasible' if feasibility == 'infeasible' else 'spatial',
            'prompt': 'any',
            'feasibility': feasibility,
            'paraphrase_group': None,
            'end_to_end': False,
            'requirements': pair['requirements'],
            'variation': pair.get('variation', {}),
        }
    )
    spec = specification(pair['spec']) if 'spec' in pair else None
    answer = Answer(spec=spec, reasons=tuple(pair.get('reasons', ())))
    return score(prompt, answer, is_fair=is_fair)


def missed(result: PromptScore) -> dict[str, list[str]]:
    """Return the fields that do not hold, by requirement."""
    return {
        r.id: sorted(name for name, held in r.fields.items() if not held)
        for r in result.requirements
        if not r.is_met
    }


def named(pairs: list[Doc]) -> list[str]:
    """Return what tests of pairs are called."""
    return [pair['pair'].replace(' ', '-') for pair in pairs]


@pytest.mark.parametrize('is_fair', [True, False], ids=['fair', 'strict'])
@pytest.mark.parametrize('pair', PAIRS, ids=named(PAIRS))
def test_the_scorer_says_what_a_person_says(pair: Doc, is_fair: bool) -> None:
    result = scored(pair, is_fair=is_fair)
    wanted = {name: sorted(fields) for name, fields in pair.get('missed', {}).items()}
    assert missed(result) == wanted
    fields = [held for r in result.requirements for held in r.fields.values()]
    met = sum(r.is_met for r in result.requirements)
    assert [met, len(result.requirements), sum(fields), len(fields)] == pair['score']
    assert list(result.extra) == pair.get('extra', [])


SAME = [pair for pair in FORMS if 'same' in pair]
NEAR = [pair for pair in FORMS if 'near' in pair]


@pytest.mark.parametrize('pair', SAME, ids=named(SAME))
def test_what_says_the_same_counts_the_same(pair: Doc) -> None:
    assert list(missed(scored(pair, is_fair=False))) == pair['turned']
    result = scored(pair, is_fair=True)
    assert missed(result) == {}
    turned = {r.id: r.form for r in result.requirements if r.id in pair['turned']}
    assert turned == dict(zip(pair['turned'], pair['forms'], strict=True))
    assert pair['same'] in ('', *pair['forms'])


@pytest.mark.parametrize('pair', NEAR, ids=named(NEAR))
def test_what_nearly_says_the_same_does_not(pair: Doc) -> None:
    result = scored(pair, is_fair=True)
    assert missed(result) == {name: sorted(lost) for name, lost in pair['missed'].items()}


def test_every_equivalence_has_a_pair_and_a_near_pair() -> None:
    keys = {equivalence.key for equivalence in EQUIVALENCES}
    assert len(keys) == len(EQUIVALENCES)
    assert {form for pair in SAME for form in pair['forms']} == keys
    assert {pair['near'] for pair in NEAR} == keys
