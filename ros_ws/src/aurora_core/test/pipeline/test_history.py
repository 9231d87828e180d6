# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which runs a history takes in."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from aurora_core.execution.faults import Fault
from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline
from aurora_core.pipeline.history import history_of, remember
from aurora_core.pipeline.stages import RunRequest
from aurora_core.report.run_report import Digests, RunReport
from aurora_core.report.status import Status
from aurora_core.spec.scenario import ScenarioSpec

PROMPT = 'When a van is closer than 20 m to the ego car, a drone that tracks the van lands.'
FAULT = Fault.model_validate({'kind': 'target_removed', 'subject': 'van1', 'at_s': 20})


def spec() -> ScenarioSpec:
    found = parse_offline(PROMPT, ParseContext()).spec
    assert found is not None
    return found


def report(status: Status, **changes: Any) -> RunReport:
    fields = {
        'run_id': '20260131T120000Z-0a1b2c',
        'status': status,
        'summary': '',
        'prompt': PROMPT,
        'engine': 'local',
        'model': 'offline',
        'map': 'downtown',
        'seed': 1,
        'digests': Digests(prompt='ab'),
    }
    return RunReport.model_validate(fields | changes)


def test_a_verified_run_is_kept_with_what_it_was_about(tmp_path: Path) -> None:
    request = RunRequest(prompt=PROMPT, history=tmp_path)
    assert remember(request, report(Status.VERIFIED), spec())
    store = history_of(request)
    assert store is not None
    (episode,) = store.episodes()
    assert episode.prompt == PROMPT
    assert {'track van1', 'distance_below then land'} <= set(episode.elements)


@pytest.mark.parametrize('status', [s for s in Status if s is not Status.VERIFIED])
def test_every_other_run_is_left_out(tmp_path: Path, status: Status) -> None:
    assert not remember(RunRequest(prompt=PROMPT, history=tmp_path), report(status), spec())
    assert list(tmp_path.iterdir()) == []


def test_frozen_faulty_and_without_a_history(tmp_path: Path) -> None:
    frozen = RunRequest(prompt=PROMPT, history=tmp_path, history_frozen=True)
    assert not remember(frozen, report(Status.VERIFIED), spec())
    request = RunRequest(prompt=PROMPT, history=tmp_path)
    assert not remember(request, report(Status.VERIFIED, faults=(FAULT,)), spec())
    assert not remember(RunRequest(prompt=PROMPT), report(Status.VERIFIED), spec())
    assert list(tmp_path.iterdir()) == []
