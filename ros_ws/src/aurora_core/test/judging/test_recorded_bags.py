# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Bags that were recorded before are judged as they were, to the last bit (recorded/README.md)."""

from __future__ import annotations

import json
import tarfile
from pathlib import Path
from typing import Any

import pytest

from aurora_core.outcomes.verdict import ConditionResult
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.pipeline.verification import Judged, judge_content, load_bag

FOLDER = Path(__file__).parent / 'recorded'
# Their requests imply another condition since: a turn counts at the place that it is asked at, and
# a wind has to be seen in the flight.
OTHERWISE = ('turn', 'wind')
VERDICTS: dict[str, dict[str, Any]] = json.loads((FOLDER / 'verdicts.json').read_text())


@pytest.fixture(scope='module', params=sorted(VERDICTS))
def judged(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> tuple[str, Judged]:
    """A bag by its name, and what is said of it now."""
    name: str = request.param
    folder = tmp_path_factory.mktemp('recorded')
    with tarfile.open(FOLDER / f'{name}.tar.xz') as archive:
        archive.extractall(folder, filter='data')
    content, agsg = load_bag(folder / name)
    # What the executor commands may change: here it is asked what the conditions find.
    return name, judge_content(
        installed_knowledge(), content, agsg, as_recorded=True, recompute=False
    )


def _row(result: ConditionResult) -> dict[str, Any]:
    return {
        'id': result.id,
        'sentence': result.sentence,
        'margin': None if result.margin is None else result.margin.hex(),
        'threshold': result.threshold,
        'satisfied': result.satisfied,
        'reason': None if result.reason is None else result.reason.value,
        'explanation': result.explanation,
    }


def test_every_condition_has_its_margin_to_the_last_bit(judged: tuple[str, Judged]) -> None:
    name, now = judged
    assert [_row(result) for result in now.verdict.results] == VERDICTS[name]['results']


def test_the_verdict_is_what_it_was(judged: tuple[str, Judged]) -> None:
    name, now = judged
    if name in OTHERWISE:
        assert {f.kind for f in now.verdict.cross_check} == {'condition'}
        return
    assert now.verdict.cross_check == ()
    assert now.verdict.status.value == VERDICTS[name]['status']
