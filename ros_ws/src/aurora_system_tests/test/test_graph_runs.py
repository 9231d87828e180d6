# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Prompts through the whole graph: service, action, queue, cancel, records."""

from __future__ import annotations

import json
import threading
from pathlib import Path
from typing import Any

import pytest

from aurora_cli.installed import installed

pytest.importorskip('rclpy')

from aurora_core.agsg.build import build_agsg
from aurora_core.errors import ExecutionError, SpecError
from aurora_core.pipeline.functions import ground_stage, parse_stage
from aurora_core.trace.bag_reader import read_bag
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.hashing import trace_sha256
from aurora_core.trace.trace import Integrity
from aurora_msgs.action import ExecuteScenario, RunScenario
from aurora_ros import interfaces as on
from aurora_ros.conversions.messages import agsg_message
from aurora_ros.matching import wait_until
from aurora_system_tests.graph import RunningGraph

pytestmark = pytest.mark.ros

PROMPT = (
    'A scenario of 28 seconds. A drone ascends to 10 meters and then follows a motorcycle for '
    '5 seconds as it drives through the streets.'
)
LIMIT_S = 120.0


def run_prompt(graph: RunningGraph, prompt: str = PROMPT, **fields: Any) -> Any:
    return graph.play.call(
        on.RUN_PROMPT, LIMIT_S, **{'prompt': prompt, 'wait': True, 'options_json': '', **fields}
    )


def test_a_prompt_twice_gives_one_verdict_and_one_trace(graph: RunningGraph) -> None:
    reports = []
    for _ in range(2):
        response = run_prompt(graph, prompt_bytes=len(PROMPT))
        assert response.status == 'verified', (response.error_msg, graph.logs())
        report = json.loads(response.report_json)
        folder = Path(response.run_dir)
        assert json.loads((folder / 'report.json').read_text()) == report
        assert report['engine'] == 'ros'
        bag = read_bag(folder / 'bag.0', message_definitions())
        assert bag.trace.integrity is Integrity.INTACT
        assert trace_sha256(bag.trace, bag.world) == report['trace']['sha256']
        assert bag.agsg_message.run_id == response.run_id
        reports.append(report)
    assert reports[0]['trace']['sha256'] == reports[1]['trace']['sha256']
    assert reports[0]['conditions'] == reports[1]['conditions']
    assert reports[0]['run_id'] != reports[1]['run_id']


def test_an_injected_fault_is_violated(graph: RunningGraph) -> None:
    spec = parse_stage(installed(), PROMPT, 'downtown', 1).spec
    assert spec is not None
    fault = {'kind': 'target_removed', 'subject': spec.missions[0].target, 'at_s': 8.0}
    response = run_prompt(graph, options_json=json.dumps({'faults': [fault]}))
    assert response.status == 'violated', (response.error_msg, response.report_json)


def test_the_action_gives_feedback_and_the_same_report(graph: RunningGraph) -> None:
    heard: list[RunScenario.Feedback] = []
    result = graph.play.send_goal(
        on.RUN, RunScenario.Goal(prompt=PROMPT), LIMIT_S, on_feedback=heard.append
    )
    assert result.status == 'verified'
    assert {'execute'} <= {feedback.stage for feedback in heard}
    fractions = [feedback.fraction for feedback in heard]
    assert fractions == sorted(fractions)
    assert max(feedback.sim_time_s for feedback in heard) > 20.0
    assert all(feedback.run_id == result.run_id for feedback in heard)


def test_cancel_ends_the_run_and_the_next_one_works(graph: RunningGraph) -> None:
    heard: list[RunScenario.Feedback] = []
    result = graph.play.send_goal(
        on.RUN,
        RunScenario.Goal(prompt=PROMPT),
        LIMIT_S,
        on_feedback=heard.append,
        cancelled=lambda: bool(heard) and heard[-1].sim_time_s > 5.0,
    )
    assert result.status == 'cancelled'
    bag = read_bag(Path(result.run_dir) / 'bag.0', message_definitions())
    assert bag.trace.integrity is Integrity.INTACT
    assert bag.trace.ticks > 100
    assert run_prompt(graph).status == 'verified'


def test_a_second_prompt_waits_in_line_and_both_are_known(graph: RunningGraph) -> None:
    first = run_prompt(graph, wait=False)
    second = run_prompt(graph, wait=False)
    assert first.status in ('queued', 'running')
    assert second.status == 'queued'
    assert first.run_id != second.run_id

    def state(run_id: str) -> Any:
        return graph.play.call(on.GET_RUN, run_id=run_id)

    assert wait_until(lambda: state(second.run_id).state == 'finished', LIMIT_S, 0.1)
    for response in (state(first.run_id), state(second.run_id)):
        assert response.found
        assert response.status == 'verified'
        assert json.loads(response.report_json)['status'] == 'verified'
    listed = graph.play.call(on.LIST_RUNS, limit=2)
    assert list(listed.run_id) == [second.run_id, first.run_id]
    assert list(listed.prompt) == [PROMPT, PROMPT]
    assert not state('20000101T000000Z-000000').found


def test_too_many_prompts_are_refused_with_a_reason(graph: RunningGraph) -> None:
    run_prompt(graph, wait=False)
    with pytest.raises(ExecutionError, match='8 runs are waiting already') as caught:  # noqa: PT012
        for _ in range(12):
            run_prompt(graph, 'A drone hovers at 500 feet.', wait=False)
    assert caught.value.component == 'orchestrator'

    def all_done() -> bool:
        return set(graph.play.call(on.LIST_RUNS).state) == {'finished'}

    assert wait_until(all_done, LIMIT_S, 0.1)


@pytest.mark.parametrize(
    ('prompt', 'prompt_bytes'),
    [('', 0), ('   ', 0), ('A drone hovers', 30), ('x' * 9000, 0)],
)
def test_what_is_no_prompt_is_not_understood(
    graph: RunningGraph, prompt: str, prompt_bytes: int
) -> None:
    call = on.RUN_PROMPT
    client = graph.play.node.create_client(call.type, call.name)
    assert client.wait_for_service(10.0)
    response = client.call(
        call.type.Request(prompt=prompt, prompt_bytes=prompt_bytes, wait=True), timeout_sec=20.0
    )
    assert response.status == 'not_understood'
    assert response.error_code == 200
    assert response.error_msg


@pytest.mark.parametrize('options', ['{', '[]', '{"sead": 1}', '{"seed": -1}', '{"out": "runs"}'])
def test_bad_options_are_refused_with_a_code_and_harm_nobody(
    graph: RunningGraph, options: str
) -> None:
    with pytest.raises(SpecError):  # the client turns the response's code into its class
        run_prompt(graph, options_json=options)
    assert graph.play.call(on.LIST_RUNS, LIMIT_S, limit=1).error_code == 0


def test_a_request_beyond_a_limit_is_infeasible(graph: RunningGraph) -> None:
    response = run_prompt(graph, 'A drone hovers at 500 feet for 20 seconds.')
    assert response.status == 'infeasible'
    assert not (Path(response.run_dir) / 'bag.0').exists()


def test_execute_alone_and_only_one_at_a_time(graph: RunningGraph, tmp_path: Path) -> None:
    untimed = PROMPT.partition('. ')[2]  # a stated duration would end it, finished or not
    spec = parse_stage(installed(), untimed, 'downtown', 1).spec
    assert spec is not None
    digest = installed().map('downtown').digest
    grounded = ground_stage(installed(), build_agsg(spec, map_digest=digest), 1).agsg
    assert grounded is not None
    goal = ExecuteScenario.Goal(
        agsg=agsg_message(grounded, 'r'), bag_directory=str(tmp_path / 'bag.0')
    )
    results: list[Any] = []
    begun = threading.Event()
    thread = threading.Thread(
        target=lambda: results.append(
            graph.play.send_goal(
                on.EXECUTE, goal, LIMIT_S, on_feedback=lambda _feedback: begun.set()
            )
        )
    )
    thread.start()
    assert begun.wait(20.0)
    with pytest.raises(ExecutionError, match='executor refused the goal'):
        graph.play.send_goal(on.EXECUTE, goal, LIMIT_S)
    thread.join(LIMIT_S)
    assert results[0].outcome == 'finished'
    bag = read_bag(Path(results[0].bag_uri), message_definitions())
    assert results[0].ticks == bag.trace.ticks
    assert results[0].trace_sha256 == trace_sha256(bag.trace, bag.world)
