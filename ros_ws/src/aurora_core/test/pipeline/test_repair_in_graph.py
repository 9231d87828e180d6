# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Repair of a run of the graph: candidates in the local engine, the best one there again."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from repair_runs import HELD, FakeStages, Traced, Workers, names, ran

from aurora_core.outcomes.agsg import Agsg
from aurora_core.pipeline.stages import ExecutionResult, RunControl, RunRequest
from aurora_core.report.run_report import RunReport
from aurora_core.report.status import Status


def in_graph(
    stages: FakeStages, root: Path, beside: Workers | None = None, **more: Any
) -> RunReport:
    return ran(stages, root, beside=Workers(1) if beside is None else beside, engine='ros', **more)


def bag_of(report: RunReport) -> str:
    assert report.trace is not None
    return report.trace.bag


@pytest.mark.parametrize('places', [1, 2])
def test_candidates_are_local_and_the_one_that_holds_is_executed_in_the_graph(
    tmp_path: Path, places: int
) -> None:
    stages, workers = Traced(-0.5, -0.4, HELD, HELD), Workers(places)
    report = in_graph(stages, tmp_path, workers)
    assert (report.status, bag_of(report)) == (Status.VERIFIED, 'bag.3')
    assert stages.executed == [0, 3]
    assert {1, 2} <= {graph.iteration for graph in workers.given}
    assert [(r.engine, r.confirms) for r in report.repairs] == [
        ('local', None),
        ('local', None),
        ('', 2),
    ]
    assert report.summary.endswith(
        'It took 3 realisations; the request is unchanged. The engine ros executed bag.2 again '
        'and gave the same trace as the local one.'
    )
    bags = report.bags or ()
    assert [bag.bag for bag in bags] == ['bag.0', 'bag.1', 'bag.2', 'bag.3']
    assert bags[2].trace_sha256 == bags[3].trace_sha256
    kinds = ('spec', 'agsg', 'grounding', 'schedule', 'feasibility', 'verdict', 'edits')
    assert names(tmp_path) >= {f'{kind}.3.json' for kind in kinds}


def test_where_none_holds_the_best_one_is_executed_in_the_graph(tmp_path: Path) -> None:
    stages = Traced(-0.5, -0.2, -0.4, -0.2)
    report = in_graph(stages, tmp_path, repair=2)
    assert (report.status, bag_of(report)) == (Status.VIOLATED, 'bag.3')
    assert stages.executed == [0, 3]
    assert report.repairs[-1].confirms == 1
    assert '2 other realisations did not hold either' in report.summary


def test_the_first_one_was_in_the_graph_already(tmp_path: Path) -> None:
    stages = Traced(-0.5, -0.6)
    report = in_graph(stages, tmp_path, repair=1)
    assert (report.status, bag_of(report), stages.executed) == (Status.VIOLATED, 'bag.0', [0])


class Otherwise(Traced):
    """Its graph gives another trace than the local engine."""

    def execute(
        self, agsg: Agsg, bag_directory: Path, request: RunRequest, control: RunControl
    ) -> ExecutionResult:
        found = super().execute(agsg, bag_directory, request, control)
        return found.model_copy(update={'trace_sha256': 'f' * 64})


@pytest.mark.parametrize(('in_graph_margin', 'best'), [(-0.3, 'bag.2'), (-0.9, 'bag.0')])
def test_another_trace_ends_the_repair_and_local_recordings_count_for_nothing(
    tmp_path: Path, in_graph_margin: float, best: str
) -> None:
    history = tmp_path / 'history'
    report = in_graph(Otherwise(-0.5, HELD, in_graph_margin, HELD), tmp_path, history=history)
    assert (report.status, bag_of(report)) == (Status.VIOLATED, best)
    assert len(report.bags or ()) == 3
    assert 'gave another trace than the local one (ffffffffffff instead of' in report.summary
    assert not list(history.glob('repairs/*'))


def test_a_cancel_while_the_graph_confirms_leaves_the_candidate(tmp_path: Path) -> None:
    class Cancelled(Traced):
        def execute(
            self, agsg: Agsg, bag_directory: Path, request: RunRequest, control: RunControl
        ) -> ExecutionResult:
            found = super().execute(agsg, bag_directory, request, control)
            outcome = 'cancelled' if agsg.iteration else 'finished'
            return found.model_copy(update={'outcome': outcome})

    report = in_graph(Cancelled(-0.5, HELD), tmp_path)
    assert (report.status, bag_of(report)) == (Status.CANCELLED, 'bag.1')
    assert [bag.bag for bag in report.bags or ()] == ['bag.0', 'bag.1']
    assert not {name for name in names(tmp_path) if '.2' in name}
