# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A violated run says with which stated numbers it would hold, when that is asked for alone."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

Call = Callable[..., SimpleNamespace]

# Whoever waits 45 m behind is not within 30 m: the trace says how far it was.
ASKED = 'A van waits 45 m behind the ego car. The van stays within 30 m of the ego car.'


def _run(call: Call, *options: str) -> dict[str, Any]:
    report: dict[str, Any] = json.loads(call('run', ASKED, '--no-repair', '--json', *options).out)
    return report


def test_nothing_is_said_of_other_requests_unasked(here: Path, call: Call) -> None:
    report = _run(call)
    assert report['status'] == 'violated'
    assert 'relaxed' not in report


@pytest.fixture
def edited(here: Path, call: Call) -> dict[str, Any]:
    return _run(call, '--allow-relax')


def test_the_number_is_told_beside_the_verdict_on_what_was_asked(
    edited: dict[str, Any], call: Call
) -> None:
    assert edited['status'] == 'verified_as_edited'
    assert edited['trace']['verdict'] == 'violated'
    (change,) = edited['relaxed']['changes']
    (failed,) = [c for c in edited['conditions'] if not c['satisfied']]
    assert change['stated'] == 30.0
    assert change['relaxed'] == pytest.approx(30.0 - failed['margin'], abs=0.02)
    assert edited['relaxed']['verdict'] == 'verified'
    # The bag alone gives the same; and what was asked is violated.
    again = call('verify', edited['run_id'], '--json')
    told = json.loads(again.out)
    assert again.code == 1
    assert told['outcome'] == 'violated'
    assert told['run']['doubts'] == []


def test_a_report_that_claims_more_than_its_bag_is_found(
    edited: dict[str, Any], here: Path, call: Call
) -> None:
    file = here / 'runs' / edited['run_id'] / 'report.json'
    report = json.loads(file.read_text('utf-8'))
    report['relaxed']['changes'][0]['relaxed'] = 30.5
    file.write_text(json.dumps(report), 'utf-8')
    again = json.loads(call('verify', edited['run_id'], '--json').out)
    assert 'the bag gives' in again['run']['doubts'][0]['text']
