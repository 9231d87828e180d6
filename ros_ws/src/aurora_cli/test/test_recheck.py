# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import ast
import json
from pathlib import Path
from typing import Any

import pytest

import aurora_core.recheck
from aurora_cli.main import run_command_line
from aurora_core.knowledge.map_model import load_map
from aurora_core.outcomes.feasibility import Certificate, Mend
from aurora_core.recheck import Outcome, recheck
from aurora_core.spec.parameter import Span

PROMPT = 'A drone hovers at 500 meters.'


def _mend(nearest: float, path: str = 'missions/m1/altitude_m', **more: Any) -> Mend:
    values = {'path': path, 'requested': 500.0, 'nearest': nearest, 'unit': 'm', **more}
    return Mend.model_validate(values)


def _too_high(**changes: Any) -> Certificate:
    values: dict[str, Any] = {
        'kind': 'limit_exceeded',
        'reason': 'altitude_limit',
        'path': 'missions/m1/altitude_m',
        'requested': 500.0,
        'unit': 'm',
        'limit_name': 'uav_altitude_m',
        'limit': 120.0,
        'mends': (_mend(120.0),),
        'span': Span(start=18, end=28),
        'sentence': 'too high',
    }
    return Certificate.model_validate({**values, **changes})


def _spec(**changes: Any) -> dict[str, Any]:
    altitude = {'value': 500.0, 'provenance': 'explicit', 'bound': 'exactly', **changes}
    return {'prompt': PROMPT, 'missions': [{'id': 'm1', 'altitude_m': altitude}]}


def test_a_true_proof_holds_with_and_without_the_specification() -> None:
    assert recheck(_too_high(), None).valid
    finding = recheck(_too_high(), _spec())
    assert finding.valid
    assert "holds: the prompt says '500 meters' there" in finding.steps


@pytest.mark.parametrize(
    'changes',
    [
        {'limit': 100.0},
        {'mends': (_mend(125.0),)},
        {'mends': (_mend(100.0),)},
        {'mends': (_mend(120.0, requested=400.0),)},
        {'requested': 119.0},
        {'requested': 120.0},
        {'limit_name': 'invented'},
        {'requested': None},
        {'limit_name': 'link_loss', 'requested': 0.5, 'limit': 1.0},
    ],
)
def test_a_false_proof_is_refuted(changes: dict[str, Any]) -> None:
    assert not recheck(_too_high(**changes), None).valid


@pytest.mark.parametrize(
    'changes',
    [{'value': 400.0}, {'provenance': 'default'}, {'bound': 'at_most'}],
)
def test_a_proof_must_fit_what_was_asked(changes: dict[str, Any]) -> None:
    assert not recheck(_too_high(), _spec(**changes)).valid


def test_a_proof_about_nothing_in_the_specification_is_refuted() -> None:
    assert not recheck(_too_high(path='missions/m9/altitude_m'), _spec()).valid
    assert not recheck(_too_high(), {'prompt': '', 'missions': _spec()['missions']}).valid


def test_an_unknown_kind_is_neither_valid_nor_refuted() -> None:
    assert recheck(_too_high(kind='magic'), None).outcome is Outcome.NOT_CHECKED


def test_the_recheck_knows_nothing_of_the_checker_but_its_document() -> None:
    folder = Path(aurora_core.recheck.__file__).parent
    used = {
        node.module
        for file in folder.glob('*.py')
        for node in ast.walk(ast.parse(file.read_text(encoding='utf-8')))
        if isinstance(node, ast.ImportFrom)
        and (node.module or '').startswith('aurora_core')
        and not (node.module or '').startswith('aurora_core.recheck')
    }
    assert used == {
        'aurora_core.outcomes.feasibility',
        'aurora_core.files',
        'aurora_core.knowledge.config_files',
        'aurora_core.knowledge.map_folders',
        'aurora_core.spec.vocabulary',
    }


def test_certain_loss_is_a_proof() -> None:
    proof = _too_high(limit_name='link_loss', requested=1.0, limit=1.0, mends=(), unit='1')
    assert recheck(proof, None).valid


def test_counts_are_counted() -> None:
    mend = _mend(10.0, 'uavs', requested=11.0, unit='1')
    proof = _too_high(
        path='uavs', limit_name='uavs_max', requested=11.0, limit=10.0, mends=(mend,), span=None
    )
    assert recheck(proof, {'prompt': '', 'uavs': [{}] * 11}).valid
    assert not recheck(proof, {'prompt': '', 'uavs': [{}] * 9}).valid


def _missing(word: str, listing: tuple[str, ...], path: str) -> Certificate:
    return Certificate(
        kind='missing_element',
        reason='missing_element',
        path=path,
        word=word,
        listing=listing,
        sentence='not there',
    )


def test_a_closed_list_is_read_anew_from_the_map() -> None:
    names = tuple(mark.name for mark in load_map('downtown').landmarks)
    path = 'landmarks of downtown'
    assert recheck(_missing('Eiffel Tower', names, path), None).valid
    assert not recheck(_missing('City Hall', names, path), None).valid
    # A list that hides the very place.
    shorter = tuple(name for name in names if name != 'City Hall')
    assert not recheck(_missing('City Hall', shorter, path), None).valid
    assert not recheck(_missing('', names, path), None).valid


def test_the_vocabulary_is_closed_as_well() -> None:
    assert not recheck(_missing('bus', ('car',), 'agent types'), None).valid


def _write(path: Path, document: Any) -> str:
    path.write_text(json.dumps(document))
    return str(path)


def test_the_command_answers_0_1_or_4(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    good = _too_high().model_dump(mode='json')
    verdict = {'result': 'infeasible', 'certificates': [good]}
    file = _write(tmp_path / 'feasibility.0.json', verdict)
    _write(tmp_path / 'spec.0.json', _spec())
    assert run_command_line(['certificate', 'check', file, '--json']) == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer['valid']
    assert answer['with_specification']
    bad = _write(tmp_path / 'one.json', {**good, 'limit': 90.0})
    assert run_command_line(['certificate', 'check', bad]) == 1
    assert 'REFUTED' in capsys.readouterr().out
    wrong: tuple[Any, ...] = ({'certificates': []}, {'kind': 1}, [3])
    for content in wrong:
        empty = _write(tmp_path / 'none.json', content)
        assert run_command_line(['certificate', 'check', empty]) == 4
    (tmp_path / 'broken.json').write_text('{')
    assert run_command_line(['certificate', 'check', str(tmp_path / 'broken.json')]) == 4
    assert run_command_line(['certificate', 'check', str(tmp_path / 'gone.json')]) == 4
