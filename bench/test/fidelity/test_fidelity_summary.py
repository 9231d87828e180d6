# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the user was told of a miss, what is counted on its own, and the line for programs."""

from __future__ import annotations

import hashlib
import json
import re
from pathlib import Path
from typing import Any

import pytest

from aurora_bench.fidelity.__main__ import main
from aurora_bench.fidelity.answer import Answer, offline_answer
from aurora_bench.fidelity.misses import Told
from aurora_bench.fidelity.summary import Judged, as_json, counts, judge, last_line, tables
from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_core.report.run_folder import json_text
from aurora_core.report.share import Share
from aurora_core.spec.scenario import Clause, ScenarioSpec

TEXT = 'In the rain a drone hovers at 50 m; nobody else is about.'
HOVER = {
    'id': 'r2', 'kind': 'mission', 'ref': 'm1', 'uav': 'uav1', 'mode': 'hover', 'altitude_m': 50,
}  # fmt: skip


def prompt(feasibility: str = 'feasible', *requirements: dict[str, Any]) -> AnnotatedPrompt:
    """Return an annotated prompt."""
    asked = requirements or ({'id': 'r1', 'kind': 'uav', 'ref': 'uav1'}, HOVER)
    return AnnotatedPrompt.model_validate(
        {
            'id': 'hover-1', 'category': 'hover', 'prompt': TEXT, 'feasibility': feasibility,
            'paraphrase_group': None, 'end_to_end': False, 'requirements': list(asked),
        }
    )  # fmt: skip


def spec(altitude_m: float) -> ScenarioSpec:
    """Return a hover at an altitude."""
    value = {'unit': 'm', 'low': 0, 'high': 500, 'provenance': 'inferred', 'value': altitude_m}
    return ScenarioSpec.model_validate(
        {
            'prompt': TEXT,
            'uavs': [{'id': 'uav1'}],
            'missions': [
                {'id': 'm1', 'uav': 'uav1', 'mode': 'hover', 'altitude_m': value,
                 'duration_s': value | {'unit': 's', 'value': 30}}
            ],
        }
    )  # fmt: skip


def clauses(status: str) -> tuple[Clause, ...]:
    """Return the two clauses of the text, the first with a status."""
    middle = TEXT.index(';')
    return tuple(
        Clause.model_validate(
            {'text': TEXT[start:end], 'span': {'start': start, 'end': end}, 'status': word}
        )
        for start, end, word in ((0, middle, status), (middle + 1, len(TEXT), 'no_requirement'))
    )


@pytest.mark.parametrize(
    ('answer', 'told'),
    [
        (Answer(spec=spec(30), clauses=clauses('encoded')), Told.SILENT),
        (Answer(spec=spec(30), clauses=clauses('not_encoded')), Told.ADMITTED),
        (Answer(spec=spec(30), clauses=clauses('no_requirement')), Told.DISMISSED),
        (Answer(question='How high?'), Told.ADMITTED),
        (Answer(reasons=('unsupported',)), Told.REFUSED),
        (Answer(error='ValueError: x'), Told.BROKEN),
    ],
)
def test_a_miss_says_what_the_user_was_told(answer: Answer, told: Told) -> None:
    lost = judge(prompt(), answer).misses
    assert (lost[-1].requirement_id, lost[-1].told) == ('r2', told)
    if answer.spec is not None:
        assert lost[-1].fields == ('altitude_m',)
        assert lost[-1].clause == TEXT.split(';')[0]


REJECT = {'id': 'r1', 'kind': 'reject', 'because': 'altitude_limit'}
EITHER = {
    'id': 'r1', 'kind': 'any_of',
    'any_of': [REJECT | {'id': 'r2'}, REJECT | {'id': 'r3', 'because': 'unsupported'}],
}  # fmt: skip


@pytest.mark.parametrize(
    ('requirement', 'answer', 'expected'),
    [
        (REJECT, Answer(spec=spec(500), reasons=('altitude_limit',)), (True, False, False)),
        (REJECT, Answer(spec=spec(500), reasons=('standoff',)), (False, False, True)),
        (REJECT, Answer(spec=spec(50)), (False, True, False)),
        (REJECT, Answer(question='Which?'), (False, False, False)),
        (EITHER, Answer(reasons=('unsupported',)), (True, False, False)),
    ],
)
def test_refusals(
    requirement: dict[str, Any], answer: Answer, expected: tuple[bool, bool, bool]
) -> None:
    judged = judge(prompt('infeasible', requirement), answer)
    found = (not judged.misses, judged.is_missed_infeasibility, judged.is_wrong_reason)
    assert found == expected


def four() -> list[Judged]:
    """Return a right answer, a wrong one, a false refusal and a missed infeasibility."""
    return [
        judge(prompt(), Answer(spec=spec(50), clauses=clauses('encoded'))),
        judge(prompt(), Answer(spec=spec(30), clauses=clauses('no_requirement'))),
        judge(prompt(), Answer(reasons=('missing_element',))),
        judge(prompt('infeasible', REJECT), Answer(spec=spec(50))),
    ]


def test_what_is_counted_on_its_own() -> None:
    found = {word: (n, total) for word, n, total in counts(four())}
    assert found['prompts with every requirement met'] == (1, 4)
    assert found['infeasible prompts accepted'] == (1, 1)
    assert found['feasible prompts refused'] == (1, 3)
    assert found['clauses falsely called no_requirement'] == (1, 3)
    assert found['agents and UAVs that nothing asked for'] == (0, 2)


def test_the_last_line_and_the_json_agree() -> None:
    # Met: 2, then the UAV, then nothing, then nothing: 3 of 7. Fields: 4, 3, 0, 0 of 13.
    assert last_line(four()) == 'requirement fidelity 0.429 [0.158, 0.750]  field fidelity 0.538'
    document = json.loads(json_text(as_json(four())))
    assert document['requirement_fidelity']['met'] == 3
    assert document['by_kind']['mission']['fields']['total'] == 9
    assert document['prompts'][1]['misses'][0]['told'] == 'dismissed'


def test_both_scorers_stand_side_by_side() -> None:
    landing = {'id': 'r3', 'kind': 'event', 'ref': 'e1', 'action': {'do': 'land', 'uav': 'uav1'}}
    above = HOVER | {'id': 'r2', 'target': 'City Hall', 'standoff_m': 0}
    asked = prompt('feasible', {'id': 'r1', 'kind': 'uav', 'ref': 'uav1'}, above, landing)
    found = spec(50)
    over = found.missions[0].model_copy(update={'target': 'landmark:City Hall'})
    judged = [judge(asked, Answer(spec=found.model_copy(update={'missions': (over,)})))]
    document = as_json(judged)
    assert document['requirement_fidelity']['total'] == 2
    assert document['requirement_fidelity']['met'] == 2
    assert document['strict']['requirement_fidelity']['total'] == 3
    assert document['strict']['requirement_fidelity']['met'] == 2
    assert (document['turned'], document['final_landings']) == ({'above': 1}, 1)
    assert judged[0].misses == ()
    side_by_side, forms = tables(judged)[:2]
    assert [row[:3] for row in side_by_side.rows] == [('strict', 3, 2 / 3), ('fair', 2, 1.0)]
    assert {row[0]: row[2] for row in forms.rows if row[2]} == {'above': 1, 'landing': 1}
    assert last_line(judged).startswith('requirement fidelity 1.000')


@pytest.mark.parametrize(
    ('met', 'total', 'low', 'high'),
    [(0, 10, 0.0, 0.27753), (10, 10, 0.72247, 1.0), (81, 263, 0.25529, 0.36621), (0, 0, 0.0, 1.0)],
)
def test_wilson_intervals(met: int, total: int, low: float, high: float) -> None:
    """The third row is the worked example of Newcombe (1998), 0.2553 to 0.3662."""
    assert Share(met=met, total=total).interval == pytest.approx((low, high), abs=2e-5)


def test_the_command_scores_the_offline_parser(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    simple = prompt().model_dump(mode='json', exclude_unset=True)
    simple['prompt'] = 'A drone hovers over City Hall at 50 m for 20 seconds.'
    file = tmp_path / 'mine.jsonl'
    file.write_text(json.dumps(simple) + '\n', encoding='utf-8')
    assert main([str(file), '--results', str(tmp_path / 'out')]) == 0
    captured = capsys.readouterr()
    assert re.fullmatch(
        r'requirement fidelity 1\.000 \[0\.\d{3}, 1\.000\]  field fidelity 1\.000',
        captured.out.splitlines()[-1],
    )
    assert '[1/1] hover-1: all met' in captured.err
    digest = hashlib.sha256(file.read_bytes()).hexdigest()
    line = f'{tmp_path.name}/mine.jsonl  sha256 {digest}  beyond 0'
    assert captured.out.splitlines()[-2] == line
    written = json.loads((tmp_path / 'out' / 'fidelity.json').read_text(encoding='utf-8'))
    assert written['model'] == 'offline'
    assert written['prompt_files'] == [
        {'name': f'{tmp_path.name}/mine.jsonl', 'sha256': digest, 'beyond': 0}
    ]
    assert line in (tmp_path / 'out' / 'fidelity.md').read_text(encoding='utf-8')


def test_a_campaign_is_resumed_and_workers_change_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / 'mine.jsonl'
    texts = ('A drone hovers over City Hall at 50 m for 20 seconds.', 'A bus stops.')
    lines = [
        json.dumps(prompt().model_dump(mode='json', exclude_unset=True) | {'id': i, 'prompt': t})
        for i, t in zip(('hover-1', 'hover-2'), texts, strict=True)
    ]
    file.write_text('\n'.join(lines) + '\n', encoding='utf-8')
    begin = [str(file), '--resume', str(tmp_path), '--seeds', '1,2']
    assert main([*begin, '--jobs', '2']) == 0
    first = capsys.readouterr().out
    journal = tmp_path / 'fidelity.journal.jsonl'
    kept = journal.read_bytes().splitlines()
    assert len(kept) == 1 + 2 * len(texts) + 1
    # Of a campaign that was killed the last line may be half a line.
    journal.write_bytes(b'\n'.join(kept[:3]) + b'\n' + kept[3][:20])
    assert main(begin) == 0
    assert capsys.readouterr().out.splitlines()[-2:] == first.splitlines()[-2:]
    assert main([str(file), '--resume', str(tmp_path), '--map', 'junction']) == 64
    assert 'another campaign' in capsys.readouterr().err


def test_a_file_that_is_no_prompt_file_is_a_usage_error(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / 'x.jsonl').write_text('{}\n', encoding='utf-8')
    assert main([str(tmp_path / 'x.jsonl')]) == 64
    assert 'aurora_bench.prompts' in capsys.readouterr().err


def test_the_check_of_limits_belongs_to_the_answer() -> None:
    answer = offline_answer('A drone hovers over City Hall at 500 ft.')
    assert answer.reasons == ('altitude_limit',)
