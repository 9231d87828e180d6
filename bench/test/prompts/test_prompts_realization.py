# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A realisation is what a verified run was grounded with."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_bench.prompts.realization import main
from aurora_bench.prompts.reference_spec import reference_spec

Doc = dict[str, Any]
UAV: Doc = {'id': 'r1', 'kind': 'uav', 'ref': 'uav1'}


def line(requirement: Doc, **fields: Any) -> str:
    """Return a line of a prompt file, with its reference."""
    document: Doc = {
        'id': 'hover-901', 'category': 'hover', 'prompt': 'any', 'feasibility': 'feasible',
        'paraphrase_group': None, 'end_to_end': True, 'requirements': [UAV, requirement], **fields,
    }  # fmt: skip
    spec = reference_spec(AnnotatedPrompt.model_validate(document))
    document['reference'] = spec.model_dump(mode='json', exclude_defaults=True)
    return json.dumps(document) + '\n'


def test_only_what_is_executed_and_verified_has_a_realization(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    hover: Doc = {
        'id': 'r2', 'kind': 'mission', 'ref': 'm1', 'uav': 'uav1', 'mode': 'hover',
        'target': 'City Hall', 'altitude_m': 60, 'duration_s': 5,
    }  # fmt: skip
    path = tmp_path / 'own.jsonl'
    path.write_text(line(hover) + line(hover, id='hover-902', end_to_end=False))
    assert main([str(path)]) == 0
    first, second = (json.loads(text) for text in path.read_text().splitlines())
    mission = first['realization']['uavs']['uav1']['missions']['m1']
    assert (mission['altitude_m'], mission['duration_s']) == (60, 5)
    assert first['realization']['seed'] == 1
    assert 'realization' not in second
    assert capsys.readouterr().out.startswith('hover-901: verified: ')


def test_without_a_verified_run_an_old_realization_goes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    report = SimpleNamespace(status='violated', summary='It drifted.')
    monkeypatch.setattr('aurora_bench.prompts.realization.realized', lambda *_: (None, report))
    path = tmp_path / 'own.jsonl'
    hover: Doc = {'id': 'r2', 'kind': 'mission', 'ref': 'm1', 'uav': 'uav1', 'mode': 'hover'}
    path.write_text(line(hover, realization={'seed': 7}))
    assert main([str(path)]) == 1
    assert 'realization' not in json.loads(path.read_text())
    assert capsys.readouterr().out == 'hover-901: violated: It drifted.\n'
