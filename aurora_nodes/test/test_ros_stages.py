# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a stage answers has to be about what it was asked, whoever gave the answer."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest

pytest.importorskip('rclpy')

from aurora_core.errors import ExecutionError
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.verdict import Verdict, VerdictStatus
from aurora_core.pipeline.functions import ground_stage, parse_stage
from aurora_core.pipeline.knowledge import Knowledge, installed_knowledge
from aurora_core.pipeline.stages import RunControl, RunRequest
from aurora_core.trace.trace import Integrity
from aurora_msgs.action import ExecuteScenario
from aurora_msgs.srv import GroundScenario, ParsePrompt, VerifyTrace
from aurora_nodes.answers import PublishedVerdicts
from aurora_nodes.attendance import Attendance
from aurora_nodes.ros_stages import RosStages, StageLimits
from aurora_ros.call import Caller
from aurora_ros.conversions.messages import agsg_message
from aurora_ros.conversions.verdict import verdict_message

RUN = '20260101T000000Z-abcdef'
ASKED = 'A drone hovers at 80 meters for 5 seconds.'
OTHER = 'A drone hovers at 20 meters for 5 seconds.'
TRACE = 'a' * 64
LIMITS = StageLimits(
    parse_s=1.0,
    parse_model_s=1.0,
    ground_s=1.0,
    check_s=1.0,
    execute_fixed_s=1.0,
    execute_per_simulated_s=1.0,
    verify_s=1.0,
    repair_s=1.0,
    twin_limit_s=1.0,
)


class Graph:
    """Stands for caller, attendance and topics: one answer, one published verdict."""

    def __init__(self, answer: Any, published: Any = None) -> None:
        self.answer, self.published = answer, published

    def service(self, *_arguments: Any, **_options: Any) -> Any:
        return self.answer

    def action(self, *_arguments: Any, **_options: Any) -> Any:
        return self.answer

    def last(self, *_arguments: Any) -> Any:
        return self.published

    def __getattr__(self, _name: str) -> Any:
        return lambda *_arguments: None


def stages(answer: Any, published: Any = None) -> RosStages:
    graph = Graph(answer, published)
    return RosStages(
        cast(Caller, graph),
        cast(Attendance, graph),
        cast(PublishedVerdicts, graph),
        LIMITS,
        RUN,
        lambda: False,
    )


@pytest.fixture(scope='module')
def known() -> Knowledge:
    return installed_knowledge()


def parsed(known: Knowledge, prompt: str) -> Agsg:
    graph = parse_stage(known, prompt, 'downtown', 1).agsg
    assert graph is not None
    return graph


@lru_cache
def grounded(known: Knowledge, prompt: str, seed: int = 1) -> Agsg:
    graph = ground_stage(known, parsed(known, prompt), seed).agsg
    assert graph is not None
    return graph


def parse_answer(known: Knowledge, prompt: str) -> ParsePrompt.Response:
    outcome = parse_stage(known, prompt, 'downtown', 1)
    assert outcome.agsg is not None
    return ParsePrompt.Response(
        understood=True,
        agsg=agsg_message(outcome.agsg, ''),
        outcome_json=outcome.model_dump_json(),
    )


def test_the_reading_of_another_prompt_is_refused(known: Knowledge) -> None:
    request = RunRequest(prompt=ASKED)
    assert stages(parse_answer(known, ASKED)).parse(request).agsg == parsed(known, ASKED)
    with pytest.raises(ExecutionError, match='parser answered parse with another prompt') as found:
        stages(parse_answer(known, OTHER)).parse(request)
    assert found.value.component == 'parser'
    assert '20 meters' in found.value.message
    assert '80 meters' in found.value.message


@pytest.mark.parametrize(
    ('prompt', 'seed', 'run', 'told'),
    [
        (OTHER, 1, RUN, "another request: prompt 'A drone hovers at 20 meters"),
        (ASKED, 2, RUN, 'another seed: 2 instead of 1'),
        (ASKED, 1, f'{RUN[:-1]}0', 'another run'),
    ],
)
def test_a_grounding_of_something_else_is_refused(
    known: Knowledge, prompt: str, seed: int, run: str, told: str
) -> None:
    request, asked = RunRequest(prompt=ASKED), parsed(known, ASKED)

    def answer(graph: Agsg, run_id: str) -> GroundScenario.Response:
        return GroundScenario.Response(
            grounded=True, agsg=agsg_message(graph, run_id), outcome_json='{}'
        )

    good = grounded(known, ASKED)
    assert stages(answer(good, RUN)).ground(asked, request).agsg == good
    with pytest.raises(ExecutionError, match=told) as found:
        stages(answer(grounded(known, prompt, seed), run)).ground(asked, request)
    assert found.value.component == 'grounding'


def test_a_request_whose_text_alone_is_the_one_asked_for_is_refused(known: Knowledge) -> None:
    forged = grounded(known, OTHER)
    spec = forged.spec.model_copy(update={'prompt': ASKED})
    forged = forged.model_copy(update={'spec': spec})
    outcome = SimpleNamespace(
        grounded=True, outcome_json='{}', agsg=agsg_message(forged, RUN), error_code=0
    )
    with pytest.raises(ExecutionError, match=r'altitude_m/value 20\.0 instead of 80\.0'):
        stages(outcome).ground(parsed(known, ASKED), RunRequest(prompt=ASKED))


def verdict(graph: Agsg, status: VerdictStatus = VerdictStatus.VERIFIED) -> Verdict:
    results = [
        {
            'id': condition.id,
            'sentence': condition.sentence,
            'explanation': 'it did',
            'formula': condition.formula,
            'op': condition.op,
            'threshold': condition.threshold,
            'margin': 1.0,
            'unit': condition.unit,
            'normalised': 1.0,
            'satisfied': True,
            'exercised': True,
            'provenance': condition.provenance,
        }
        for condition in graph.conditions
    ]
    return Verdict.model_validate(
        {'status': status, 'results': results, 'integrity': Integrity.INTACT}
    )


def verify(
    known: Knowledge, answered: Verdict, published: Verdict | None = None, **fields: Any
) -> Verdict:
    graph = grounded(known, ASKED)
    facts = {'run_id': RUN, 'iteration': 0, 'end_s': 1.0, 'trace_sha256': TRACE, **fields}
    run = stages(None, verdict_message(published or answered, **{**facts, 'run_id': RUN}))
    bag = Path('/runs/bag.0')
    run._caller.answer = ExecuteScenario.Result(  # type: ignore[attr-defined]
        bag_uri=str(bag), ticks=20, trace_sha256=TRACE, motion_sha256=TRACE, outcome='finished'
    )
    run.execute(graph, bag, RunRequest(prompt=ASKED), RunControl())
    run._caller.answer = VerifyTrace.Response(  # type: ignore[attr-defined]
        verdict=verdict_message(answered, **facts)
    )
    return run.verify(graph, bag)


def test_the_verdict_of_another_run_is_refused(known: Knowledge) -> None:
    good = verdict(grounded(known, ASKED))
    assert verify(known, good) == good
    bad = verdict(grounded(known, ASKED), VerdictStatus.VIOLATED)
    fewer = Verdict.model_validate({**good.model_dump(), 'results': good.results[1:]})
    refusals: dict[str, Callable[[], object]] = {
        'another run': lambda: verify(known, good, run_id=f'{RUN[:-1]}0'),
        'another trace hash': lambda: verify(known, good, trace_sha256='b' * 64),
        'another iteration': lambda: verify(known, good, iteration=1),
        'another set of conditions': lambda: verify(known, fewer),
        "than it published: status 'verified' instead of 'violated'": lambda: verify(
            known, good, bad
        ),
    }
    for told, refused in refusals.items():
        with pytest.raises(ExecutionError, match=told) as found:
            refused()
        assert found.value.component == 'monitor'


def test_the_recording_of_another_run_is_refused(known: Knowledge) -> None:
    answer = ExecuteScenario.Result(
        bag_uri='/runs/other/bag.0', trace_sha256=TRACE, motion_sha256=TRACE, outcome='finished'
    )
    with pytest.raises(ExecutionError, match='executor answered execute with another bag'):
        stages(answer).execute(
            grounded(known, ASKED), Path('/runs/bag.0'), RunRequest(prompt=ASKED), RunControl()
        )
