# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A sample of the campaign, and that its judge sees what it is there to see."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from aurora_bench.fuzz import replies
from aurora_bench.fuzz.__main__ import main
from aurora_bench.fuzz.campaign import fuzz_prompts, fuzz_replies
from aurora_bench.fuzz.judge import faults
from aurora_bench.fuzz.prompts import MUTATIONS, mutated
from aurora_bench.prompts.reading import read_prompts
from aurora_bench.prompts.shipped import first_files
from aurora_core.outcomes.parse import ParseContext, ParseOutcome
from aurora_core.parsing.parser import parse_offline
from aurora_core.spec.vocabulary import ClauseStatus

CONTEXT = ParseContext(landmark_names=('City Hall', 'Harbor Market', 'Union Station'))
ORIGINALS = [p.prompt for path in first_files('tune') for p in read_prompts(path)]


def _quiet(_text: str) -> None:
    """Say nothing."""


def test_damaged_prompts_break_nothing_and_change_no_number() -> None:
    tally = fuzz_prompts(ORIGINALS, CONTEXT, 300, 1_000_000, _quiet)
    assert tally.failures == ()
    assert sum(tally.outcomes.values()) == 300


def test_damaged_replies_break_nothing_and_change_no_number() -> None:
    tally = fuzz_replies(CONTEXT, 300, 1_000_000, _quiet)
    assert tally.failures == ()
    assert tally.outcomes['objections'] > 200


def test_a_seed_always_makes_the_same_text() -> None:
    assert mutated(random.Random(7), ORIGINALS) == mutated(random.Random(7), ORIGINALS)
    answer = {'clauses': [{'quote': 'x', 'ids': []}], 'uavs': [{'id': 'uav1', 'quote': 'a drone'}]}
    assert replies.mutated(random.Random(7), answer) == replies.mutated(random.Random(7), answer)


@pytest.mark.parametrize('name', sorted(MUTATIONS))
def test_every_mutation_changes_a_prompt(name: str) -> None:
    prompt = 'A drone hovers over City Hall at 40 m for 20 s, then it lands.'
    changed = {MUTATIONS[name](random.Random(s), prompt, [prompt]) for s in range(20)}
    assert changed - {prompt}


def _read(prompt: str) -> ParseOutcome:
    return parse_offline(prompt, CONTEXT)


def test_the_judge_sees_a_changed_number() -> None:
    outcome = _read('A drone hovers over City Hall at 40 m.')
    forged = ParseOutcome.model_validate_json(
        outcome.model_dump_json().replace('"value":40.0', '"value":41.0')
    )
    assert list(faults('A drone hovers over City Hall at 40 m.', outcome)) == []
    [fault] = faults('A drone hovers over City Hall at 40 m.', forged)
    assert '41' in fault


def test_the_judge_sees_a_dropped_number() -> None:
    prompt = 'A drone hovers over City Hall at 40 m, colour 17.'
    outcome = _read(prompt)
    assert list(faults(prompt, outcome)) == []
    fields = {name: getattr(outcome, name) for name in ParseOutcome.model_fields}
    silent = ParseOutcome(
        **{
            **fields,
            'clauses': tuple(c for c in outcome.clauses if c.status is ClauseStatus.ENCODED),
        }
    )
    assert any("'17'" in fault for fault in faults(prompt, silent))


def test_the_judge_reads_both_ends_of_a_range() -> None:
    for dash in '-–−':
        outcome = parse_offline(f'A drone hovers at 20{dash}30 m over City Hall.', CONTEXT)
        assert outcome.spec is not None
        assert {c.value.value for c in outcome.spec.conditions} == {20.0, 30.0}
        assert list(faults(outcome.spec.prompt, outcome)) == []
        changed = outcome.spec.prompt.replace('30', '40')
        assert any('30' in fault for fault in faults(changed, outcome))


def test_the_judge_reads_the_unit_of_a_list() -> None:
    prompt = 'Three drones hover over City Hall at 30, 40 and 60 ft respectively.'
    outcome = _read(prompt)
    assert list(faults(prompt, outcome)) == []
    assert outcome.spec is not None
    assert outcome.spec.missions[0].altitude_m.value == pytest.approx(9.144)
    changed = prompt.replace('ft', 'yd').replace('30', '31')
    assert any("'31'" in fault for fault in faults(changed, outcome))


def test_results_are_written(tmp_path: Path) -> None:
    assert main(['--prompts', '20', '--replies', '20', '--results', str(tmp_path)]) == 0
    assert '0 of 20' in (tmp_path / 'fuzz.md').read_text(encoding='utf-8')
