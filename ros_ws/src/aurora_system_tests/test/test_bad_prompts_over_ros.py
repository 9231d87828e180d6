# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Bad prompts through the doors of the graph: the service, its command line, the action.

The order matters: the last test proves that the graph has survived all of them.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip('rclpy')

import yaml

from aurora_cli.testing.bad_prompts import READABLE, UNREADABLE, Unreadable
from aurora_core.errors import PromptError, SpecError
from aurora_msgs.action import RunScenario
from aurora_ros import interfaces as on
from aurora_system_tests.graph import RunningGraph

pytestmark = pytest.mark.ros

GOOD = 'A scenario of 18 seconds. A drone hovers at 5 meters over the ego car for 1 second.'
LIMIT_S = 60.0
# What needs no simulator: the answer is that it cannot be read or cannot be.
QUICK = [
    case
    for case in READABLE
    if case.may == ('not_understood',) or case.name in ('control characters', 'many clauses')
]


def sent(case: Unreadable) -> dict[str, Any]:
    """What a client sends that states the length of what it was given, and what it can say."""
    return {'prompt': case.raw.decode('utf-8', 'replace'), 'prompt_bytes': len(case.raw)}


def ask(graph: RunningGraph, **fields: Any) -> Any:
    """Call the service and return the bare response."""
    call = on.RUN_PROMPT
    client = graph.play.node.create_client(call.type, call.name)
    assert client.wait_for_service(10.0)
    response = client.call(call.type.Request(wait=True, **fields), timeout_sec=LIMIT_S)
    graph.play.node.destroy_client(client)
    assert response is not None, graph.logs()
    return response


def check_refused(response: Any) -> None:
    assert (response.status, response.error_code) == ('not_understood', 200)
    assert response.error_msg
    assert (response.run_id, response.report_json) == ('', '')


def check_report(response: Any, prompt: str, may: tuple[str, ...]) -> None:
    """The verdict is honest, and the prompt is the one that was sent, to the last byte."""
    report = json.loads(response.report_json)
    assert response.status == report['status']
    assert report['status'] in may
    assert report['prompt'] == prompt
    folder = Path(response.run_dir)
    assert (folder / 'prompt.txt').read_bytes() == prompt.encode()
    assert json.loads((folder / 'report.json').read_text(encoding='utf-8')) == report


def test_bytes_that_are_no_prompt_through_the_service(graph: RunningGraph) -> None:
    for case in UNREADABLE:
        response = ask(graph, **sent(case))
        check_refused(response)
        text = case.raw.decode('utf-8', 'replace')
        if '\0' not in text and '\ufffd' not in text:
            assert case.says in response.error_msg


def test_a_prompt_that_was_damaged_on_the_way_is_refused_without_a_length(
    graph: RunningGraph,
) -> None:
    """ROS puts U+FFFD where the bytes of a C++ client are not UTF-8."""
    response = ask(graph, prompt='A drone \ufffd hovers at 20 meters.')
    check_refused(response)
    assert 'could not be read' in response.error_msg


def test_bytes_that_are_no_prompt_through_the_action(graph: RunningGraph) -> None:
    for case in UNREADABLE:
        with pytest.raises(PromptError):
            graph.play.send_goal(on.RUN, RunScenario.Goal(**sent(case)), LIMIT_S)


def test_texts_through_the_service_and_the_action(graph: RunningGraph) -> None:
    for case in QUICK:
        check_report(ask(graph, prompt=case.text), case.text, case.may)
        goal = RunScenario.Goal(prompt=case.text, prompt_bytes=len(case.text.encode()))
        check_report(graph.play.send_goal(on.RUN, goal, LIMIT_S), case.text, case.may)


def test_instructions_behind_a_scenario_are_not_obeyed(graph: RunningGraph) -> None:
    (case,) = [case for case in READABLE if case.name == 'instructions behind a scenario']
    check_report(ask(graph, prompt=case.text), case.text, ('incomplete',))


@pytest.mark.parametrize(
    'options', [r'{"out": "/tmp/\ud800"}', r'{"out": "/tmp/\u0000"}', r'{"map": "\udcff"}', '\x1b']
)
def test_options_that_no_answer_could_carry(graph: RunningGraph, options: str) -> None:
    with pytest.raises(SpecError):
        graph.play.call(on.RUN_PROMPT, LIMIT_S, prompt=GOOD, options_json=options, wait=True)


def ros2_call(graph: RunningGraph, *arguments: str, stdin: str = '') -> tuple[int, str, str]:
    """Call the service with our own `ros2`, as a shell would."""
    code = 'import sys\nfrom aurora_ros2cli.main import main\nsys.exit(main(sys.argv[1:]))'
    domain = str(graph.play.node.context.get_domain_id())
    done = subprocess.run(
        [sys.executable, '-c', code, 'service', 'call', '/aurora/run_prompt',
         'aurora_msgs/srv/RunPrompt', *arguments],
        env={**os.environ, 'ROS_DOMAIN_ID': domain}, input=stdin, text=True, capture_output=True,
        timeout=LIMIT_S, check=False,
    )  # fmt: skip
    assert 'Traceback' not in done.stderr, done.stderr
    return done.returncode, done.stdout, done.stderr


@pytest.mark.parametrize('name', ['YAML', 'shell', 'Arabic'])
def test_signs_of_shell_and_yaml_through_ros2_service_call(graph: RunningGraph, name: str) -> None:
    (case,) = [case for case in READABLE if case.name == name]
    code, out, _ = ros2_call(graph, yaml.safe_dump({'prompt': case.text}))
    assert code == 0
    assert "status='not_understood'" in out
    newest = graph.play.call(on.LIST_RUNS, LIMIT_S, limit=1)
    assert list(newest.prompt) == [case.text]
    assert not Path('pwned').exists()


def test_a_megabyte_through_ros2_service_call(graph: RunningGraph) -> None:
    code, out, _ = ros2_call(graph, '--stdin', stdin=f'prompt: {"x" * (1 << 20)}')
    assert code == 0
    assert "status='not_understood'" in out
    assert 'may have 8192 bytes, found 1048576' in out


@pytest.mark.parametrize(
    'request_yaml', [r'{prompt: "A drone hovers\0 at 20 meters."}', r'{prompt: "\ud800"}', '{a: [']
)
def test_what_ros2_service_call_cannot_send_is_refused_there(
    graph: RunningGraph, request_yaml: str
) -> None:
    before = list(graph.play.call(on.LIST_RUNS, LIMIT_S).run_id)
    code, _, err = ros2_call(graph, request_yaml)
    assert (code, err.startswith('Failed to populate field')) == (1, True)
    assert list(graph.play.call(on.LIST_RUNS, LIMIT_S).run_id) == before


def test_the_graph_works_afterwards(graph: RunningGraph) -> None:
    check_report(ask(graph, prompt=GOOD), GOOD, ('verified',))
