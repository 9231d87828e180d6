# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Repair in the graph: in the local engine, confirmed, cancelled, and the node by its service."""

from __future__ import annotations

import json
from itertools import pairwise
from pathlib import Path

import pytest

pytest.importorskip('rclpy')

from aurora_core.agsg.document import agsg_from_json
from aurora_core.outcomes.repair import Proposal, ProposalOutcome, Step
from aurora_core.outcomes.verdict import Verdict
from aurora_msgs.action import RunScenario
from aurora_ros import interfaces as on
from aurora_ros.conversions.messages import agsg_message
from aurora_ros.conversions.verdict import verdict_message
from aurora_system_tests.graph import RunningGraph

pytestmark = pytest.mark.ros

# Nowhere does a car get as fast: other places are tried in vain.
PROMPT = (
    'A scenario of 40 seconds. A drone tracks a car. When the car is faster than 24 m/s, the '
    'drone alerts the ego car.'
)
SHORT = PROMPT.replace('40', '15')
LIMIT_S = 300.0


def test_a_cancel_in_the_middle_of_a_repair_leaves_the_best_run_and_the_service_answers(
    graph: RunningGraph,
) -> None:
    heard: list[RunScenario.Feedback] = []

    def in_the_third_realisation() -> bool:
        stages = [now.stage for now in heard]
        judged = sum(a != 'verify' and b == 'verify' for a, b in pairwise(stages))
        return judged == 2 and stages[-1] == 'execute' and bool(heard[-1].sim_time_s > 2.0)

    result = graph.play.send_goal(
        on.RUN,
        RunScenario.Goal(prompt=PROMPT),
        LIMIT_S,
        on_feedback=heard.append,
        cancelled=in_the_third_realisation,
        cancel_limit_s=LIMIT_S,  # the page is written as well
    )
    assert result.status == 'cancelled'
    folder = Path(result.run_dir)
    names = {path.name for path in folder.iterdir()}
    assert names >= {'prompt.txt', 'spec.0.json', 'bag.0', 'bag.1', 'verdict.1.json'}
    assert not {name for name in names if '.2' in name}
    report = json.loads((folder / 'report.json').read_text())
    assert [bag['bag'] for bag in report['bags']] == ['bag.0', 'bag.1']
    assert report['trace']['bag'] in ('bag.0', 'bag.1')
    assert [repair['engine'] for repair in report['repairs'] if repair['bag']] == ['local']

    # Graph, verdict and bag in, edits out: whoever has a recording may ask the node.
    agsg = agsg_from_json((folder / 'agsg.0.json').read_bytes())
    verdict = Verdict.model_validate_json((folder / 'verdict.0.json').read_bytes())
    response = graph.play.call(
        on.REPAIR,
        LIMIT_S,
        agsg=agsg_message(agsg, result.run_id),
        verdict=verdict_message(
            verdict,
            run_id=result.run_id,
            iteration=0,
            end_s=0.0,
            trace_sha256=report['bags'][0]['trace_sha256'],
        ),
        bag_uri=str(folder / 'bag.0'),
        past_json='[]',
    )
    assert response.proposed
    proposal = Proposal.model_validate_json(response.proposal_json)
    assert proposal.outcome is ProposalOutcome.EDITED
    assert proposal.step is Step.GROUNDING
    assert proposal.plan.avoided
    assert proposal.implicated[0].field == 'grounding/anchor'


def test_the_best_candidate_is_executed_in_the_graph_with_the_same_trace(
    graph: RunningGraph,
) -> None:
    result = graph.play.send_goal(
        on.RUN,
        RunScenario.Goal(prompt=SHORT, options_json='{"repair": 2, "jobs": 2}'),
        LIMIT_S,
    )
    report = json.loads(result.report_json)
    *candidates, again = [repair for repair in report['repairs'] if repair['bag']]
    assert [repair.get('engine', '') for repair in candidates] == ['local', 'local']
    assert (again['bag'], again.get('engine', '')) == ('bag.3', '')
    assert report['trace']['bag'] == 'bag.3'
    traces = [bag['trace_sha256'] for bag in report['bags']]
    assert traces[again['confirms']] == traces[3]
    assert 'gave the same trace as the local one' in report['summary']
