# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The four prompts of the paper: verified on both engines with one trace, and refutable."""

from __future__ import annotations

import json
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import pytest

from aurora_cli.installed import installed

pytest.importorskip('rclpy')

from aurora_cli.local_engine import LocalStages
from aurora_core.pipeline.run import run
from aurora_core.pipeline.stages import RunControl, RunRequest
from aurora_core.pipeline.verification import verify_stage
from aurora_core.report.outputs import write_report
from aurora_core.report.run_folder import RunFolder, new_run_id
from aurora_core.report.run_report import RunReport
from aurora_ros import interfaces as on
from aurora_system_tests.graph import RunningGraph

PROMPTS = {
    'survey': (
        'In clear weather at midday, a drone flies a rectangular survey route at 30 meters '
        'altitude over the streets around the ego car.'
    ),
    'motorcycle': (
        'A drone ascends to 40 meters and then follows a motorcycle as it drives through the '
        'streets.'
    ),
    'bus': (
        'A bus drives ahead of the ego car and an ambulance follows behind it while two '
        'background cars circulate; a drone tracks the bus from 35 meters.'
    ),
    'van': (
        'A van tailgates the ego car closely, closing from 45 meters; a tracking drone alerts the '
        'ego when the van comes within 20 meters.'
    ),
}

# Fault, condition that must fail, and the time (s) before which nothing can have failed.
FAULTS = [
    ('survey', {'kind': 'route_blocked', 'subject': 'uav1', 'at_s': 30.0}, 'm1.waypoints', 29.0),
    (
        'motorcycle',
        {'kind': 'target_removed', 'subject': 'motorcycle1', 'at_s': 20.0},
        'm1.tracked',
        20.0,
    ),
    ('bus', {'kind': 'target_removed', 'subject': 'bus1', 'at_s': 20.0}, 'm1.tracked', 20.0),
    ('van', {'kind': 'link_loss', 'subject': '*', 'at_s': 0.0}, 'e1.delivered', 8.0),
    ('van', {'kind': 'keep_away', 'subject': 'van1', 'at_s': 0.0}, 'van1.tailgate', 8.0),
]


class _FrozenClock:
    def seconds(self) -> float:
        return 0.0


def run_locally(
    prompt: str, folder: Path, entropy: int, faults: tuple[dict[str, Any], ...] = ()
) -> tuple[RunReport, RunFolder]:
    request = RunRequest.model_validate({'prompt': prompt, 'faults': faults})
    run_folder = RunFolder(folder, new_run_id(datetime.now(UTC), entropy.to_bytes(3, 'big')))
    report = run(
        request,
        LocalStages(installed()),
        installed(),
        run_folder,
        RunControl(),
        _FrozenClock(),
        outputs=write_report,
    )
    return report, run_folder


def margins(report: dict[str, Any]) -> dict[str, float | None]:
    return {row['id']: row['margin'] for row in report['conditions']}


@pytest.mark.ros
@pytest.mark.parametrize('name', sorted(PROMPTS))
def test_both_engines_verify_it_with_one_trace(
    name: str, graph: RunningGraph, tmp_path: Path
) -> None:
    first, folder = run_locally(PROMPTS[name], tmp_path, 1)
    second, _ = run_locally(PROMPTS[name], tmp_path, 2)
    response = graph.play.call(
        on.RUN_PROMPT, 120.0, prompt=PROMPTS[name], wait=True, options_json=''
    )
    remote = json.loads(response.report_json)
    assert (first.status, second.status, remote['status']) == ('verified',) * 3
    assert first.trace is not None
    assert second.trace is not None
    assert {second.trace.sha256, remote['trace']['sha256']} == {first.trace.sha256}
    local = margins(first.model_dump(mode='json'))
    assert margins(remote) == local
    again = verify_stage(installed(), folder.bag_path(0))
    assert {r.id: r.margin for r in again.results} == local


@pytest.mark.parametrize(('name', 'fault', 'condition', 'not_before_s'), FAULTS)
def test_a_run_time_fault_is_seen_at_its_condition_and_time(
    name: str, fault: dict[str, Any], condition: str, not_before_s: float, tmp_path: Path
) -> None:
    report, _ = run_locally(PROMPTS[name], tmp_path, 3, (fault,))
    assert report.status == 'violated'
    failed = {row.id: row for row in report.conditions if not row.satisfied}
    assert condition in failed
    worst_time_s = failed[condition].worst_time_s
    assert worst_time_s is not None
    assert worst_time_s >= not_before_s
    assert report.faults[0].kind == fault['kind']


def test_an_impossible_number_is_refused_with_its_limit(tmp_path: Path) -> None:
    report, _ = run_locally('A drone hovers over the intersection at 500 ft.', tmp_path, 4)
    assert report.status == 'infeasible'
    assert report.feasibility is not None
    certificate = report.feasibility.certificates[0]
    assert (certificate.limit, [m.nearest for m in certificate.mends]) == (120.0, [120.0])
    assert certificate.requested == pytest.approx(152.4)


def test_a_link_that_loses_all_is_refused(tmp_path: Path) -> None:
    report, _ = run_locally(
        'A van tailgates the ego car, closing from 45 meters; a tracking drone alerts the ego '
        'over a link with 100% packet loss when the van comes within 20 meters.',
        tmp_path,
        5,
    )
    assert report.status == 'infeasible'
    assert report.trace is None
