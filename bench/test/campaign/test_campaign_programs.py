# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""B1 to B3: what a model is told, and what becomes of the program that it answers."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from aurora_bench.campaign.figures import draw_all
from aurora_bench.campaign.metrics import METRICS, share
from aurora_bench.campaign.plan import Configuration, Plan, Reader, Task, tasks_of
from aurora_bench.campaign.record import CampaignRun, Ending
from aurora_bench.campaign.runs import CampaignWork
from aurora_bench.campaign.tables import all_tables
from aurora_bench.campaign.written import programming_request
from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_bench.resumable.files import PromptFile
from aurora_bench.rulers.trial import Trial
from aurora_bench.sandbox.process import chosen_way
from aurora_bench.sandbox.ways import SandboxError
from aurora_cli.installed import installed
from aurora_core.pipeline.stages import RunRequest
from aurora_core.ports.language_model import ModelCall
from aurora_llm.reply_store import ReplyStore

B1, B2, B3 = Configuration.B1, Configuration.B2, Configuration.B3
MODEL = 'openai/any'
HOVER: dict[str, Any] = {
    'id': 'hover-902', 'category': 'hover', 'feasibility': 'feasible', 'paraphrase_group': None,
    'end_to_end': True, 'prompt': 'A drone hovers at 20 m for 5 seconds.',
    'requirements': [
        {'id': 'r1', 'kind': 'uav', 'ref': 'uav1'},
        {'id': 'r2', 'kind': 'mission', 'uav': 'uav1', 'mode': 'hover', 'altitude_m': 20,
         'duration_s': 5, 'ref': 'm1'},
    ],
}  # fmt: skip
TOO_HIGH: dict[str, Any] = {
    **HOVER, 'id': 'infeasible-902', 'category': 'infeasible', 'feasibility': 'infeasible',
    'prompt': 'A drone hovers at 900 m.',
    'requirements': [{'id': 'r1', 'kind': 'reject', 'because': 'altitude_limit'}],
}  # fmt: skip
PROGRAM = """
from aurora_scene import scene
lane = scene.lanes(within_m=500.0)[0]
x, y = lane['start']
scene.spawn_uav('drone', x, y)
dt = scene.begin()
scene.take_off('drone', HEIGHT)
while scene.state('drone')['z'] < HEIGHT - 0.5:
    scene.step()
scene.phase('drone', 0)
scene.fly_to('drone', x, y, HEIGHT)
scene.step(round(5.0 / dt))
scene.land('drone')
while not scene.state('drone')['landed']:
    scene.step()
"""


def asked(document: dict[str, Any]) -> RunRequest:
    """Return the request of a prompt."""
    return RunRequest(
        prompt=document['prompt'], map_name='downtown', seed=1, model=MODEL, history_frozen=True
    )


def answer(
    folder: Path, configuration: Configuration, document: dict[str, Any], text: str
) -> None:
    """Record what a model answers."""
    request = programming_request(configuration, installed(), asked(document))
    call = ModelCall(
        model=MODEL, attempt=1, request_sha256=request.sha256, request=request, reply=text
    )
    ReplyStore(folder).write(MODEL, request, (call,))


def ran(tmp_path: Path, configuration: Configuration, document: dict[str, Any]) -> CampaignRun:
    """Run a prompt with the recorded answers."""
    try:
        chosen_way()
    except SandboxError as err:
        pytest.skip(str(err))
    trial = Trial(
        key='k', file='own.jsonl', seed=1, prompt=AnnotatedPrompt.model_validate(document),
        document=document, folder='own',
    )  # fmt: skip
    reader = Reader(name='recorded', model=MODEL, transcripts=tmp_path / 'replies')
    plan = Plan(name='any', prompts=('own.jsonl',), configurations=(B1, B2, B3), readers=(reader,))
    work = CampaignWork(plan=plan, folder=tmp_path)
    work.prepare()
    return work(Task(key='k', configuration=configuration, reader=reader, trial=trial))


def test_each_configuration_is_told_more_than_the_one_before() -> None:
    told = [
        programming_request(c, installed(), asked(HOVER)).messages[0].content for c in (B1, B2, B3)
    ]
    assert 'def take_off(self, name: str, altitude_m: float) -> None' in told[0]
    assert 'Arm and climb' not in told[0]
    assert 'Arm and climb' in told[1]
    assert 'Registries: ' not in told[1]
    assert told[2].startswith(told[1])
    assert 'Registries: ' in told[2]
    # Nothing that begins with _ is for programs.
    assert '_ask' not in told[2]


def test_a_program_that_does_what_was_asked_is_right(tmp_path: Path) -> None:
    text = json.dumps({'program': PROGRAM.replace('HEIGHT', '20.0')})
    answer(tmp_path / 'replies', B2, HOVER, text)
    run = ran(tmp_path, B2, HOVER)
    assert (run.ending, run.status, run.right) == (
        Ending.COMPLETED, 'completed_unverifiable', True,
    )  # fmt: skip
    assert [s.outcome for s in run.said] == ['holds', 'holds']
    assert run.trace_sha256
    assert not run.passed
    assert {p.name for p in tmp_path.rglob('bag.*')} == set()


def test_a_program_that_flies_elsewhere_completes_and_is_contradicted(tmp_path: Path) -> None:
    text = json.dumps({'program': PROGRAM.replace('HEIGHT', '35.0')})
    answer(tmp_path / 'replies', B1, HOVER, text)
    run = ran(tmp_path, B1, HOVER)
    assert (run.ending, run.right, run.contradicted) == (Ending.COMPLETED, False, True)
    # No verdict of ours claimed that it holds.
    assert not run.silent


@pytest.mark.parametrize(
    ('text', 'why'),
    [
        ('I would rather not.', 'no program in the answer'),
        (json.dumps({'program': ''}), 'no program in the answer'),
        (json.dumps({'program': 'x ='}), 'program: raised, SyntaxError'),
        (json.dumps({'program': 'import carla'}), 'program: raised, ModuleNotFoundError'),
        (json.dumps({'program': 'print(1)'}), 'program: nothing simulated'),
    ],
)
def test_what_is_no_running_program_is_a_runtime_failure(
    tmp_path: Path, text: str, why: str
) -> None:
    answer(tmp_path / 'replies', B1, HOVER, text)
    run = ran(tmp_path, B1, HOVER)
    assert (run.ending, run.why, run.right) == (Ending.FAILED, why, False)


def test_a_program_is_to_refuse_what_cannot_be_done(tmp_path: Path) -> None:
    refuses = "from aurora_scene import scene\nscene.refuse('altitude_limit')\n"
    answer(tmp_path / 'replies', B3, TOO_HIGH, json.dumps({'program': refuses}))
    run = ran(tmp_path, B3, TOO_HIGH)
    assert (run.ending, run.right) == (Ending.DECLINED, True)
    answer(tmp_path / 'replies', B3, HOVER, json.dumps({'program': refuses}))
    assert not ran(tmp_path, B3, HOVER).right


def test_tables_say_nothing_that_programs_have_not(tmp_path: Path) -> None:
    answer(tmp_path / 'replies', B1, HOVER, 'none')
    run = ran(tmp_path, B1, HOVER)
    tables = all_tables((run,))
    row = dict(zip(tables['performance'].headings, tables['performance'].rows[0], strict=True))
    assert (row['P'], row['SF'], row['verified'], row['Fid']) == (None, None, None, None)
    assert str(row['RF']).startswith('1.00')
    assert tables['programs'].rows == [('recorded', 'B1', 1, 0, 0, 0, 0, 0, 0)]
    assert share((run,), next(m.of for m in METRICS if m.name == 'RF')).met == 1


def test_a_report_of_programs_alone_has_the_one_figure_that_shows_them(tmp_path: Path) -> None:
    answer(tmp_path / 'replies', B1, HOVER, 'none')
    run = ran(tmp_path, B1, HOVER)
    assert [drawn.name for drawn in draw_all((run,), tmp_path)] == ['ladder']


def test_the_offline_reader_writes_no_programs() -> None:
    prompt = AnnotatedPrompt.model_validate(HOVER)
    file = PromptFile(name='own.jsonl', sha256='0' * 64, prompts=(prompt,), documents=(HOVER,))
    plan = Plan(
        name='any', prompts=('own.jsonl',), configurations=tuple(Configuration),
        readers=(Reader(name='offline'), Reader(name='other', model=MODEL)),
    )  # fmt: skip
    found = [(t.reader.name, t.configuration.value) for t in tasks_of(plan, (file,))]
    assert found == [
        *(('offline', c) for c in ('B4', 'B5', 'AURORA')),
        *(('other', c) for c in ('B1', 'B2', 'B3', 'B4', 'B5', 'AURORA')),
    ]
    with pytest.raises(ValueError, match='writes no programs'):
        Plan(name='any', prompts=('own.jsonl',), configurations=(B1,))
